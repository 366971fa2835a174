//! `hsd town` to a `.hsd`: the houses of a town as one source file.

use crate::Failure;
use crate::build::tiled::{Progress, check_outputs, features, tables};
use crate::files::messages::Teller;
use crate::files::output::Committer;
use crate::files::terminal::{HOUSE, counted};
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_driver::{FeatureHouse, Read};
use hsd_syntax::print;
use hsd_town::decision::problems;
use hsd_town::stream::{Ledger, TownStream};
use hsd_town::{Plan, TownInput};
use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

/// Writes the houses of a town as a source file; returns whether something is missing that the author wanted, the files
/// that were read, and what was found.
pub(super) fn build(
    (path, quiet): (&Path, bool),
    (input, committer): (TownInput<'_>, &Committer),
    (read, plan): (Read, &Plan),
    mut out: Diagnostics,
    teller: Teller,
) -> Result<(bool, Vec<Source>, Diagnostics), Failure> {
    let input = TownInput {
        texts: true,
        ..input
    };
    let limits = &input.options.expand.limits;
    let progress = Progress::new(plan.features(), quiet, teller);
    let advance = |n| progress.advance(n);
    let mut town = TownStream::new(input, plan).telling(&advance);
    let mut file = head(input, plan);
    file.push_str(&parts(&read, input.source));
    let mut written = vec![];
    let lost = town.build(input, read, &mut out, &mut |house| {
        written.push(WrittenHouse::of(house))
    });
    let lost: HashSet<&str> = lost.iter().map(|house| &*house.name).collect();
    // Those that are lost are reported as skipped.
    written.retain(|house| !lost.contains(&*house.name));
    let (count, open, unwritten) = write_houses(written, &mut file);
    file.push_str("</Houses>\n");
    let source = Source::new(FileId(0), path.to_string_lossy(), file.as_bytes());
    let laid_out = print::format(&source, limits, &mut Diagnostics::new());
    let file = laid_out.unwrap_or(file);
    let corrected = problems(&out);
    let (mut ledger, included) = town.finish(&mut out);
    ledger.report.corrected.extend(corrected);
    progress.finish()?;
    if out.has_errors() {
        return Ok((true, included, out));
    }
    check_outputs((path, &ledger), Some(path), committer)?;
    committer.write_all(vec![(path.to_owned(), file.into_bytes())])?;
    tables(path, &mut ledger, committer)?;
    let failed = |error| Failure::at(path.display(), error);
    let language = teller.language;
    not_written(&unwritten, language).map_err(failed)?;
    left_out(open, language).map_err(failed)?;
    if !quiet {
        summary(path, &ledger, count, language).map_err(failed)?;
    }
    Ok((
        ledger.is_incomplete() || !unwritten.is_empty(),
        included,
        out,
    ))
}

/// Writes houses; returns their number, that of things which are not houses, and the names of those that have no text.
fn write_houses(houses: Vec<WrittenHouse>, file: &mut String) -> (usize, usize, Vec<String>) {
    let (mut count, mut open, mut unwritten) = (0, 0, vec![]);
    for house in houses {
        if house.is_outdoors {
            open += 1;
        } else if house.text.is_empty() {
            unwritten.push(house.name);
        } else {
            count += 1;
            file.push_str(&house.text);
            file.push('\n');
        }
    }
    (count, open, unwritten)
}

/// The source text of a house of a town.
struct WrittenHouse {
    name: String,
    text: String,
    is_outdoors: bool,
}

impl WrittenHouse {
    fn of(house: &FeatureHouse) -> WrittenHouse {
        let text = house.text.as_ref().map_or("", |text| text.text());
        WrittenHouse {
            name: house.name.clone(),
            text: text.to_owned(),
            is_outdoors: house.house.fittings.outdoors.is_some(),
        }
    }
}

/// Tells of houses that cannot be written by themselves.
fn not_written(names: &[String], language: Language) -> io::Result<()> {
    let Some(first) = names.first() else {
        return Ok(());
    };
    let number = names.len();
    let line = text!([first, number]
        "{number} houses cannot be written by themselves, the first of them `{first}`",
        "{number} 棟は単独のテキストにできません。最初は `{first}` です"
    );
    writeln!(io::stderr(), "{}", line.in_language(language))
}

/// Prints how many things are no houses.
fn left_out(open: usize, language: Language) -> io::Result<()> {
    if open == 0 {
        return Ok(());
    }
    let line = text!([open]
        "{open} pieces of road, rows of trees and the like are no houses, and are left out",
        "道や木などの {open} 件は建物ではないため書きません"
    );
    writeln!(io::stderr(), "{}", line.in_language(language))
}

/// Prints what was written.
fn summary(path: &Path, ledger: &Ledger, count: usize, language: Language) -> io::Result<()> {
    let (name, report) = (path.display(), &ledger.report);
    let features = features(report);
    let houses = counted(count, HOUSE);
    let line = text!([name, features, houses]
        "{name}: {features}, {houses}",
        "{name}: {features}、{houses}"
    );
    writeln!(io::stderr(), "{}", line.in_language(language))
}

/// Returns the start of the file.
fn head(input: TownInput<'_>, plan: &Plan) -> String {
    let town = Path::new(input.source.name())
        .file_name()
        .unwrap_or_default();
    let town = town.to_string_lossy().replace("--", "- -");
    let (crs, origin) = (&plan.frame.crs, plan.frame.origin);
    let (east, north) = (origin.x, origin.y);
    let plane = crs.name.replace("--", "- -");
    format!(
        "<!-- The houses of {town}: metres east and north of {east} {north} in the plane {plane}. -->\n<Houses>\n"
    )
}

/// Returns the text of the parts that the town defines.
fn parts(read: &Read, town: &Source) -> String {
    let mut text = String::new();
    for part in read.documents.iter().flat_map(|document| &document.parts) {
        let span = part.whole.unwrap_or_default();
        text.push_str(written(span, town, &read.included));
        text.push('\n');
    }
    text
}

/// Returns what is written at a place.
fn written<'s>(span: Span, town: &'s Source, included: &'s [Source]) -> &'s str {
    let sources = std::iter::once(town).chain(included);
    let source = sources.into_iter().find(|source| source.id() == span.file);
    let range = span.start as usize..span.end as usize;
    source
        .and_then(|source| source.text().get(range))
        .unwrap_or_default()
}
