//! The tables beside a town in tiles. They may be large, so they are read from their files when something is asked.

use hsd_town::decision::SkippedFeature;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

/// The most skipped features that a page lists.
const LISTED: usize = 500;

/// How the names of the tables begin.
pub(super) const DECISIONS: &str = "decisions";
pub(super) const ENVELOPES: &str = "envelopes";

/// The tables of a town.
#[derive(Clone, Debug)]
pub(crate) struct TownTables {
    pub(crate) folder: PathBuf,
    pub(super) decisions: PathBuf,
    /// That of envelopes, which a town without any has not.
    pub(super) envelopes: PathBuf,
    report: PathBuf,
}

/// Skipped features, with their places where they are known.
#[derive(Debug, Default, Serialize)]
pub(crate) struct SkippedList {
    /// The number of all.
    total: usize,
    /// The first ones.
    list: Vec<Skipped>,
}

#[derive(Debug, Serialize)]
struct Skipped {
    #[serde(flatten)]
    feature: SkippedFeature,
    /// The number of the rule, from 1; 0 for none.
    rule: usize,
    /// Metres east and north of the town's origin.
    at: Option<[f64; 2]>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Report {
    features: usize,
    built: usize,
    unused: usize,
    skipped: Vec<SkippedFeature>,
}

impl TownTables {
    /// Names the tables in the folder of a town.
    pub(super) fn of(folder: PathBuf, decisions: &str, report: &str) -> TownTables {
        TownTables {
            decisions: folder.join(decisions),
            envelopes: folder.join(decisions.replace(DECISIONS, ENVELOPES)),
            report: folder.join(report),
            folder,
        }
    }

    fn report(&self) -> Report {
        let file = File::open(&self.report).map(BufReader::new);
        let read = file.ok().map(serde_json::from_reader);
        read.and_then(Result::ok).unwrap_or_default()
    }

    /// Returns the numbers of features that rules name, of built and of skipped ones; 0 without a report.
    pub(super) fn counts(&self) -> (usize, usize, usize) {
        let report = self.report();
        let features = report.features.saturating_sub(report.unused);
        (features, report.built, report.skipped.len())
    }

    /// Returns the line of a feature in the table of decisions, by the names of its columns; of any layer if none is named.
    ///
    /// # Errors
    /// If the table cannot be read.
    pub(crate) fn feature(&self, layer: &str, key: &str) -> io::Result<Option<Value>> {
        let mut found = None;
        each(&self.decisions, &mut |row| {
            let same = row.cell("key") == key && (layer.is_empty() || row.cell("layer") == layer);
            if same {
                let cells = row.head.iter().zip(&row.cells);
                let cells = cells.map(|(name, cell)| (name.clone(), Value::from(cell.as_str())));
                found = Some(Value::Object(Map::from_iter(cells)));
            }
            !same
        })?;
        Ok(found)
    }

    /// Returns the skipped features.
    ///
    /// # Errors
    /// If the table of decisions cannot be read.
    pub(crate) fn skipped(&self) -> io::Result<SkippedList> {
        let report = self.report();
        let total = report.skipped.len();
        let list: Vec<SkippedFeature> = report.skipped.into_iter().take(LISTED).collect();
        let mut places = BTreeMap::new();
        let wanted = |layer: &str, key: &str| list.iter().any(|s| s.layer == layer && s.key == key);
        let mut left = list.len();
        if left > 0 {
            each(&self.decisions, &mut |row| {
                let (layer, key) = (row.cell("layer"), row.cell("key"));
                if wanted(layer, key) {
                    let number = |name| row.cell(name).parse::<f64>().unwrap_or_default();
                    let rule = row.cell("rule").parse().unwrap_or(0);
                    let place = (rule, [number("x"), number("y")]);
                    places.insert((layer.to_owned(), key.to_owned()), place);
                    left -= 1;
                }
                left > 0
            })?;
        }
        let list = list.into_iter().map(|feature| {
            let place = places.get(&(feature.layer.clone(), feature.key.clone()));
            Skipped {
                rule: place.map_or(0, |(rule, _)| *rule),
                at: place.map(|(_, at)| *at),
                feature,
            }
        });
        Ok(SkippedList {
            total,
            list: list.collect(),
        })
    }
}

/// A line of a table.
pub(super) struct Row<'r> {
    head: &'r [String],
    cells: Vec<String>,
}

impl Row<'_> {
    /// Returns the cell of a column; empty if there is none.
    pub(super) fn cell(&self, name: &str) -> &str {
        let at = self.head.iter().position(|own| own == name);
        at.and_then(|at| self.cells.get(at)).map_or("", |c| c)
    }
}

/// Calls `then` with each line of a table until it returns false. A missing table has none.
pub(super) fn each(path: &Path, then: &mut dyn FnMut(&Row<'_>) -> bool) -> io::Result<()> {
    let file = match File::open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        file => file?,
    };
    let mut lines = BufReader::new(file).lines();
    let head = lines.next().transpose()?.unwrap_or_default();
    let head = cells(&head);
    while let Some(line) = lines.next().transpose()? {
        let mut whole = line;
        // A cell in quotes may go on in the next line.
        while whole.matches('"').count() % 2 == 1
            && let Some(more) = lines.next().transpose()?
        {
            whole = format!("{whole}\n{more}");
        }
        let cells = cells(&whole);
        let head = &head;
        if !then(&Row { head, cells }) {
            return Ok(());
        }
    }
    Ok(())
}

/// Divides a line of a table.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (vec![], String::new(), false);
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '"' if quoted && rest.peek() == Some(&'"') => {
                cell.push('"');
                rest.next();
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(plain(std::mem::take(&mut cell))),
            c => cell.push(c),
        }
    }
    cells.push(plain(cell));
    cells
}

/// Returns a cell without the apostrophe that keeps spreadsheets from running it.
fn plain(cell: String) -> String {
    const RUN: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];
    match cell.strip_prefix('\'') {
        Some(run) if run.starts_with(RUN) => run.to_owned(),
        _ => cell,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_found_in_the_tables() {
        let folder = tempfile::tempdir().expect("can be made");
        let write = |name: &str, text: &str| {
            std::fs::write(folder.path().join(name), text).expect("can be written");
        };
        write(
            "decisions.csv",
            "key,layer,rule,type,x,y,why\n1,houses,2,hiraya,3.5,-4,\n2,houses,0,,7,8,\"a \"\"shed\"\",\nby the road\"\n",
        );
        write(
            "report.json",
            r#"{"features":3,"built":1,"skipped":[{"layer":"houses","key":"2","code":"skipped","reason":"a shed"},
            {"layer":"houses","key":"","code":"HSD1006","reason":"no outline"}],"corrected":[]}"#,
        );
        let tables = TownTables::of(folder.path().to_owned(), "decisions.csv", "report.json");
        assert_eq!(tables.counts(), (3, 1, 2));
        let row = tables
            .feature("houses", "2")
            .expect("can be read")
            .expect("is there");
        assert_eq!(row["why"], "a \"shed\",\nby the road");
        assert_eq!(
            tables
                .feature("", "1")
                .expect("can be read")
                .expect("is there")["type"],
            "hiraya"
        );
        assert_eq!(tables.feature("roads", "1").expect("can be read"), None);
        let skipped = tables.skipped().expect("can be read");
        assert_eq!((skipped.total, skipped.list.len()), (2, 2));
        assert_eq!(skipped.list[0].at, Some([7.0, 8.0]));
        assert_eq!(skipped.list[1].at, None);
    }

    #[test]
    fn a_folder_without_tables_has_nothing_to_tell() {
        let tables = TownTables::of(PathBuf::from("/nowhere"), "decisions.csv", "report.json");
        assert_eq!(tables.counts(), (0, 0, 0));
        assert_eq!(tables.feature("", "1").expect("is empty"), None);
        assert_eq!(tables.skipped().expect("is empty").total, 0);
    }
}
