//! `hsd town seal`: puts a town together of the tiles of planned work.

use super::open::opened;
use crate::build::tiled::{self, Folder, TILESET, Wish};
use crate::build::town::print;
use crate::files::output::Committer;
use crate::files::terminal::counted;
use crate::options::exit;
use crate::{Failure, Outcome};
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::text;
use hsd_town::tiles::TileStore;
use hsd_town::tiles::run::TiledTown;
use hsd_town::tiles::work::{self, Manifest};
use std::io;
use std::path::PathBuf;

/// The number of missing tiles that are named.
const NAMED: usize = 20;

/// Put a town together of the tiles that `hsd town tile` has made.
///
/// OUT becomes what `hsd town TOWN -o OUT/` writes, to the byte: tiles, tables, and the tileset last. What is left in OUT and WORK
/// of other inputs or of killed processes is swept. Tiles are shared between WORK and OUT where the system can (hard links).
#[derive(Debug, Args)]
#[command(after_help = "\
Exit status: 0 success; 1 a feature has no house that nobody asked to skip; 2 tiles are missing (nothing is written), WORK is no
planned work, or the town has changed since; 3 a file could not be read or written.

Examples:
  hsd town seal work/ -o kyoto/
  hsd town seal work/ -o kyoto/ --lacking    without the tiles that cannot be made")]
pub(crate) struct TownSeal {
    /// The folder of the planned work.
    #[arg(value_name = "WORK")]
    work: PathBuf,

    /// Write the town to this folder.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    /// Leave out tiles that are missing; their features are in the report.
    #[arg(long)]
    lacking: bool,

    /// Print triangles, bytes and an estimate of graphics memory of the tiles.
    #[arg(long)]
    stats: bool,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl TownSeal {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let committer = Committer::default();
        let work = (&*self.work, &committer);
        opened(work, language, |worker, manifest, (source, from)| {
            if self.output.is_dir() {
                committer.check([self.output.join(TILESET)])?;
                committer.check(tiled::table_paths(&self.output))?;
            }
            let mut out = Diagnostics::new();
            let failed = |error| Failure::at(self.work.display(), error);
            let spool = tiled::spools_beside(&self.work.join(work::MANIFEST));
            let sealed = work::seal(worker, (self.lacking, &spool), &mut out).map_err(failed)?;
            let mut made = match sealed {
                Ok(made) => made,
                Err(unmade) => return Err(self.missing(&unmade, manifest)),
            };
            let failed = |error| Failure::at(self.output.display(), error);
            let folder = Folder::of_town(&self.output, &committer).map_err(failed)?;
            for tile in &made.tiles {
                made.kept += usize::from(folder.has(&tile.file()));
            }
            for name in &made.files() {
                folder.adopt(from, name).map_err(failed)?;
            }
            let wish = Wish {
                output: &self.output,
                levels: None,
                packed: false,
                stats: self.stats,
                quiet: self.quiet,
            };
            tiled::finish(&wish, (&mut made, worker.town()), &folder, language)?;
            if !self.lacking {
                let swept = sweep(from, manifest, &made);
                swept.map_err(|error| Failure::at(self.work.display(), error))?;
            }
            let (incomplete, spoiled) = (made.ledger.is_incomplete(), out.has_errors());
            let mut sources = vec![source.clone()];
            sources.extend(made.included);
            print(&sources, out, language)?;
            Ok(exit(incomplete || spoiled))
        })
    }

    /// Says which tiles are missing.
    fn missing(&self, unmade: &[String], manifest: &Manifest) -> Failure {
        let count = counted(unmade.len(), tiled::TILE);
        let (name, all) = (self.work.display(), manifest.tiles.len());
        let mut keys = unmade[..unmade.len().min(NAMED)].join(" ");
        if unmade.len() > NAMED {
            keys.push_str(" ...");
        }
        Failure::Usage(text!([name, count, all, keys]
            "{name}: {count} of {all} missing, make them with `hsd town tile {name} --all` or leave them out with `--lacking`: {keys}",
            "{name}: {all} 枚のうち {count}がありません。`hsd town tile {name} --all` で作るか、`--lacking` で省いてください: {keys}"
        ))
    }
}

/// Removes what is left in the folder of work of other inputs.
fn sweep(folder: &Folder, manifest: &Manifest, made: &TiledTown) -> io::Result<()> {
    let own = manifest.files().chain(made.files()).collect();
    folder.sweep(&own, &std::collections::BTreeSet::new())
}
