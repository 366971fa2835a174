//! What differs between two editions of a town, by their tables of decisions: what stands on a feature, as what, and with what
//! measures. Hypotheses are compared so (000-84).

use super::tables::{Row, TownTables, each};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io;

/// The most features that a page lists.
const LISTED: usize = 500;

/// The features that differ: `Difference` in `view/src/server/api.ts`.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Difference {
    /// The number of features that are the same in both.
    same: usize,
    /// The number of those that differ.
    total: usize,
    /// The first of those, in the order of the second table.
    list: Vec<Changed>,
}

#[derive(Debug, Serialize)]
struct Changed {
    layer: String,
    key: String,
    /// Metres east and north of the town's origin.
    at: [f64; 2],
    /// What stood there, and what does; empty for nothing.
    before: String,
    after: String,
}

/// What stands on a feature.
#[derive(PartialEq)]
struct Stands {
    what: [String; 6],
}

impl Stands {
    fn of(row: &Row<'_>) -> Stands {
        let columns = ["type", "what", "why", "width", "depth", "parameters"];
        Stands {
            what: columns.map(|name| row.cell(name).to_owned()),
        }
    }

    /// Returns it in words: the type with its parameters, or why there is none.
    fn words(&self) -> String {
        let [kind, _, why, _, _, parameters] = &self.what;
        match (kind.is_empty(), parameters.is_empty()) {
            (true, _) => why.clone(),
            (false, true) => kind.clone(),
            (false, false) => format!("{kind} ({parameters})"),
        }
    }
}

impl Difference {
    /// Compares two editions.
    ///
    /// # Errors
    /// If a table cannot be read.
    pub(crate) fn between(before: &TownTables, after: &TownTables) -> io::Result<Difference> {
        let mut known: BTreeMap<(String, String), (Stands, [f64; 2])> = BTreeMap::new();
        let name = |row: &Row<'_>| (row.cell("layer").to_owned(), row.cell("key").to_owned());
        let place = |row: &Row<'_>| ["x", "y"].map(|n| row.cell(n).parse().unwrap_or_default());
        each(&before.decisions, &mut |row| {
            known.insert(name(row), (Stands::of(row), place(row)));
            true
        })?;
        let mut found = Difference::default();
        each(&after.decisions, &mut |row| {
            let (name, now) = (name(row), Stands::of(row));
            match known.remove(&name) {
                Some((then, _)) if then == now => found.same += 1,
                then => {
                    let before = then.map_or_else(String::new, |(then, _)| then.words());
                    found.add(name, place(row), [before, now.words()]);
                }
            }
            true
        })?;
        for (name, (then, at)) in known {
            found.add(name, at, [then.words(), String::new()]);
        }
        Ok(found)
    }

    fn add(&mut self, (layer, key): (String, String), at: [f64; 2], [before, after]: [String; 2]) {
        self.total += 1;
        if self.list.len() < LISTED {
            self.list.push(Changed {
                layer,
                key,
                at,
                before,
                after,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_that_change_come_or_go_are_listed() {
        let folder = tempfile::tempdir().expect("can be made");
        let table = |name: &str, rows: &str| {
            let text = format!("key,layer,rule,type,x,y,width,depth,what,why,parameters\n{rows}");
            std::fs::write(folder.path().join(name), text).expect("can be written");
            TownTables::of(folder.path().to_owned(), name, "")
        };
        let before = table(
            "a.csv",
            "1,lots,1,hiraya,0,0,5,9,built,,age=3\n2,lots,1,hiraya,1,0,5,9,built,,\n3,lots,1,,2,0,,,refused,no room,\n4,lots,1,kura,9,8,4,4,built,,\n",
        );
        let after = table(
            "b.csv",
            "1,lots,1,hiraya,0,0,5,9,built,,age=3\n2,lots,1,kanban,1,0,5,9,built,,\n3,lots,2,hiraya,2,0,4,9,built,,\n5,lots,1,kura,7,7,4,4,built,,\n",
        );
        let found = Difference::between(&before, &after).expect("can be read");
        let told: Vec<[&str; 3]> = found
            .list
            .iter()
            .map(|c| [&*c.key, &*c.before, &*c.after])
            .collect();
        assert_eq!((found.same, found.total), (1, 4));
        assert_eq!(
            told,
            [
                ["2", "hiraya", "kanban"],
                ["3", "no room", "hiraya"],
                ["5", "", "kura"],
                ["4", "kura", ""]
            ]
        );
        assert_eq!(found.list[3].at, [9.0, 8.0]);
    }
}
