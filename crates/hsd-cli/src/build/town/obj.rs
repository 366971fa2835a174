//! `hsd town` to a `.obj`: a file for each tile, beside each its materials and images.

use crate::Failure;
use crate::build::tiled::{Progress, features, spools_beside, tables};
use crate::files::messages::Teller;
use crate::files::output::{Committer, folder_of};
use crate::files::terminal::{bytes, counted};
use hsd_base::diagnostic::{Diagnostics, Language, noun};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_export::obj;
use hsd_scene::Detail;
use hsd_town::stream::Ledger;
use hsd_town::tiles::run::{TileJob, TileParts};
use hsd_town::tiles::scenes::scenes;
use hsd_town::{Plan, TownInput};
use std::io::{self, Write};
use std::path::Path;

/// Builds a town and writes `OUT-TILE.obj` for each of its tiles and pieces of ground; returns whether something is missing that
/// the author wanted, the files that were read, and what was found.
pub(super) fn build(
    (path, detail, quiet): (&Path, Detail, bool),
    (input, committer): (TownInput<'_>, &Committer),
    (read, plan): (hsd_driver::Read, &Plan),
    mut out: Diagnostics,
    teller: Teller,
) -> Result<(bool, Vec<Source>, Diagnostics), Failure> {
    let parts = TileParts::of(&read, input.options);
    let spool = spools_beside(path);
    let job = TileJob {
        spool: plan.lodged.is_some().then_some(&spool),
        ..parts.job(input, plan, &read.catalog, &plan.town.tiles)
    };
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // A house in one tile may have an image in the place of one beside another tile.
    let committer = committer.holding();
    let (mut files, mut size) = (0, 0);
    let mut failure = None;
    let progress = Progress::new(plan.features(), quiet, teller);
    let made = scenes(
        job,
        detail,
        (
            &mut |tile, scene, library| {
                let written = obj::obj(scene, library, &format!("{stem}-{tile}")).into_iter();
                let written = written.map(|file| {
                    let target = folder_of(path).join(&file.name);
                    (target, file.bytes.into_owned())
                });
                let written: Vec<_> = written.collect();
                files += 1;
                size += written.iter().map(|(_, bytes)| bytes.len()).sum::<usize>();
                committer.write_all(written).map_err(|why| {
                    failure = Some(why);
                    io::ErrorKind::Other.into()
                })
            },
            &|n| progress.advance(n),
        ),
        &mut out,
    );
    progress.clear();
    let (mut ledger, included) = made.map_err(|error| match failure.take() {
        Some(why) => why,
        None => Failure::at(path.display(), error),
    })?;
    progress.finish()?;
    tables(path, &mut ledger, &committer)?;
    committer.publish()?;
    if !quiet {
        summary(path, &ledger, (files, size), teller.language)
            .map_err(|error| Failure::at(path.display(), error))?;
    }
    Ok((ledger.is_incomplete(), included, out))
}

/// Prints the number of files that were written, and the bytes in them.
fn summary(
    path: &Path,
    ledger: &Ledger,
    (files, size): (usize, usize),
    language: Language,
) -> io::Result<()> {
    let (name, report) = (path.display(), &ledger.report);
    let features = features(report);
    let (files, size) = (counted(files, noun("model", "モデル{}個")), bytes(size));
    let line = text!([name, features, files, size]
        "{name}: {features}, {files}, {size}",
        "{name}: {features}、{files}、{size}"
    );
    writeln!(io::stderr(), "{}", line.in_language(language))
}
