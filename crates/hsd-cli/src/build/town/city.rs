//! `hsd town` to a `.city.json` or `.city.jsonl`: a town as CityJSON.

use crate::Failure;
use crate::build::tiled::{Progress, check_outputs, features, spools_beside, tables};
use crate::files::messages::Teller;
use crate::files::output::Committer;
use crate::files::terminal::{HOUSE, bytes, counted};
use hsd_base::diagnostic::{Diagnostics, Text};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_export::cityjson::CityHouse;
use hsd_town::stream::Ledger;
use hsd_town::tiles::city;
use hsd_town::tiles::run::{TileJob, TileParts};
use hsd_town::{Plan, TownInput};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// The form of a city.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CityForm {
    /// One object of JSON: CityJSON.
    Whole,
    /// A line for each house: CityJSONSeq.
    Lines,
}

impl CityForm {
    /// Returns the form for the name of an output.
    pub(super) fn of(path: &Path) -> Option<CityForm> {
        let name = path.file_name()?.to_string_lossy().to_lowercase();
        let ends = |end: &str| name.ends_with(end);
        match () {
            () if ends(".city.jsonl") => Some(CityForm::Lines),
            () if ends(".city.json") => Some(CityForm::Whole),
            () => None,
        }
    }
}

/// Builds a town and writes it as CityJSON, at LoD 1, 2, and with `openings` 3; returns whether something is missing that
/// the author wanted, the files that were read, and what was found.
pub(super) fn build(
    (path, form, openings, quiet): (&Path, CityForm, bool, bool),
    (input, committer): (TownInput<'_>, &Committer),
    (read, plan): (hsd_driver::Read, &Plan),
    mut out: Diagnostics,
    teller: Teller,
) -> Result<(bool, Vec<Source>, Diagnostics), Failure> {
    let failed = |error| Failure::at(path.display(), error);
    let parts = TileParts::of(&read, input.options);
    let spool = spools_beside(path);
    let job = TileJob {
        spool: plan.lodged.is_some().then_some(&spool),
        ..parts.job(input, plan, &read.catalog, &plan.town.tiles)
    };
    let mut file = committer.draft(path)?;
    let head = city::city(plan);
    let mut written = BufWriter::new(file.as_file_mut());
    let (mut houses, mut kept) = (0, vec![]);
    let mut size = 0;
    let mut write = |text: String| -> io::Result<()> {
        size += text.len();
        written.write_all(text.as_bytes())
    };
    if form == CityForm::Lines {
        write(head.first_line()).map_err(failed)?;
    }
    let mut take = |house: CityHouse| {
        houses += usize::from(house.is_building());
        match form {
            CityForm::Lines => write(house.line()),
            CityForm::Whole => {
                kept.push(house);
                Ok(())
            }
        }
    };
    let progress = Progress::new(plan.features(), quiet, teller);
    let advance = |n| progress.advance(n);
    let made = city::houses(job, openings, (&mut take, &advance), &mut out);
    progress.clear();
    let (mut ledger, included) = made.map_err(failed)?;
    progress.finish()?;
    if form == CityForm::Whole {
        write(head.file(kept)).map_err(failed)?;
    }
    written.flush().map_err(failed)?;
    drop(written);
    check_outputs((path, &ledger), Some(path), committer)?;
    file.finish()?;
    tables(path, &mut ledger, committer)?;
    if !quiet {
        let line = summary(path, &ledger, houses, size);
        writeln!(io::stderr(), "{}", line.in_language(teller.language))?;
    }
    Ok((ledger.is_incomplete(), included, out))
}

/// Returns the line that tells what was built.
fn summary(path: &Path, ledger: &Ledger, houses: usize, size: usize) -> Text {
    let (name, report) = (path.display(), &ledger.report);
    let features = features(report);
    let (houses, size) = (counted(houses, HOUSE), bytes(size));
    text!([name, features, houses, size]
        "{name}: {features}, {houses}, {size}",
        "{name}: {features}、{houses}、{size}"
    )
}
