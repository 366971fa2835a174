//! Planned work as the steps after the plan find it: the folder, its manifest, and the town read again from its own file.

use crate::build::tiled::Folder;
use crate::build::town::{maps, print};
use crate::files::input::{Inputs, STDIN};
use crate::files::output::Committer;
use crate::options::InputArgs;
use crate::{Exit, Failure, Outcome};
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_ir::ast::town::Tiles;
use hsd_scene::Detail;
use hsd_town::TownInput;
use hsd_town::tiles::TileStore;
use hsd_town::tiles::maker::TileMeans;
use hsd_town::tiles::run::TileParts;
use hsd_town::tiles::work::{MANIFEST, Manifest, NotOpened, Worker};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Component, Path, PathBuf};

/// What whoever planned a town asked for.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Asked {
    /// The folder in which the program was started, as seen from the work where both have a common root.
    from: PathBuf,
    input: InputArgs,
    detail: Vec<u8>,
    packed: bool,
}

impl Asked {
    pub(super) fn new(
        input: &InputArgs,
        (detail, packed): (&[u8], bool),
        work: &Path,
    ) -> Result<Asked, Failure> {
        if input.inputs.iter().any(|path| path.as_os_str() == STDIN) {
            return Err(Failure::Usage(text!(
                "a town that is made in steps is read by each of them: name its file",
                "段階に分けて作る町は、段階ごとに読みます。ファイルを指定してください"
            )));
        }
        let failed = |error| Failure::at(work.display(), error);
        let here = std::env::current_dir().map_err(failed)?;
        let here = here.canonicalize().map_err(failed)?;
        let work = work.canonicalize().map_err(failed)?;
        Ok(Asked {
            from: seen(&work, &here),
            input: input.clone(),
            detail: detail.to_vec(),
            packed,
        })
    }

    /// Returns the same with paths as they are seen from where the program runs now.
    fn here(self, work: &Path) -> io::Result<Asked> {
        let from = work.canonicalize()?.join(&self.from).canonicalize()?;
        let here = std::env::current_dir()?.canonicalize()?;
        let moved = |path: &Path| {
            let whole = from.join(path);
            match whole.strip_prefix(&here) {
                Ok(below) if below.as_os_str().is_empty() => PathBuf::from("."),
                Ok(below) => below.to_owned(),
                Err(_) => whole,
            }
        };
        Ok(Asked {
            input: self.input.moved(&moved),
            ..self
        })
    }
}

/// Returns a folder as it is seen from another; both are absolute.
fn seen(from: &Path, folder: &Path) -> PathBuf {
    let (own, other): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (from.components().collect(), folder.components().collect());
    let shared = own.iter().zip(&other).take_while(|(a, b)| a == b).count();
    // On another drive nothing is shared.
    if shared == 0 {
        return folder.to_owned();
    }
    let up = own[shared..].iter().map(|_| Component::ParentDir);
    up.chain(other[shared..].iter().copied()).collect()
}

/// Reads the manifest of planned work.
fn manifest(work: &Path, folder: &Folder) -> Result<Manifest, Failure> {
    let name = work.display();
    let Some(bytes) = folder.read(MANIFEST) else {
        return Err(Failure::Usage(text!([name]
            "{name} is no folder of planned work: `hsd town plan TOWN -o {name}` makes one",
            "{name} は `hsd town plan` のフォルダーではありません。`hsd town plan TOWN -o {name}` で作れます"
        )));
    };
    Manifest::read(&bytes).ok_or_else(|| {
        Failure::Usage(text!([name]
            "{name} was planned by another hsd: plan it again with `hsd town plan TOWN -o {name}`",
            "{name} は別の版の hsd で計画されています。`hsd town plan TOWN -o {name}` でやり直してください"
        ))
    })
}

/// Opens planned work and hands it to `then`.
pub(super) fn opened(
    (work, committer): (&Path, &Committer),
    language: Language,
    then: impl FnOnce(&Worker<'_>, &Manifest, (&Source, &Folder)) -> Outcome,
) -> Outcome {
    let folder = Folder::of_planned(work, committer);
    let manifest = manifest(work, &folder)?;
    let damaged = || stale(work, &NotOpened::Damaged);
    let asked: Asked = serde_json::from_value(manifest.asked.clone()).map_err(|_| damaged())?;
    let asked = asked
        .here(work)
        .map_err(|e| Failure::at(work.display(), e))?;
    let args = &asked.input;
    args.check_folders()?;
    committer.add_inputs(args.files());
    let mut out = Diagnostics::new();
    let inputs = Inputs::read(&args.inputs, args.limits().bytes, &mut out)?;
    let detail = asked.detail.iter().copied().max().unwrap_or(3);
    let options = hsd_driver::Options {
        detail: Detail::ALL[usize::from(detail).min(3)],
        ..args.options(&inputs, &mut out)?
    };
    let world = args.world(&args.inputs);
    let world = world.recorded_in(&committer.inputs);
    let accepted = inputs.accepted();
    let mut read = hsd_driver::documents(&accepted, &world, &options, &mut out);
    let town = read.documents.iter_mut().find_map(|d| d.town.take());
    let (Some(town), [source]) = (town, &accepted[..]) else {
        print(&inputs.and(read.included), out, language)?;
        return Ok(Exit::Errors);
    };
    let input = TownInput::new(source, &world, &options);
    // The maps were read when the town was planned.
    committer.add_inputs(maps(input, &town));
    let division = Tiles {
        detail: match asked.detail.is_empty() {
            true => town.tiles.detail.clone(),
            false => asked.detail.clone(),
        },
        ..town.tiles.clone()
    };
    let parts = TileParts::of(&read, &options);
    let means = TileMeans {
        packed: asked.packed,
        ..parts.means(input, &read.catalog, &division)
    };
    let worker = Worker::open(&manifest, *town, means, &folder).map_err(|why| stale(work, &why))?;
    then(&worker, &manifest, (source, &folder))
}

/// Says why planned work cannot be gone on with.
fn stale(work: &Path, why: &NotOpened) -> Failure {
    let name = work.display();
    Failure::Usage(match why {
        NotOpened::Changed => text!([name]
            "the town has changed since {name} was planned: plan it again, what was made of tiles that stay the same is kept",
            "{name} を計画したあとで町が変わっています。計画し直してください。変わらないタイルは作ったものがそのまま使われます"
        ),
        NotOpened::Damaged => text!([name]
            "files of {name} are missing or damaged: plan it again",
            "{name} のファイルがないか、壊れています。計画し直してください"
        ),
    })
}
