//! The committed numbers of findings: one line `crate: rule: number` for each crate and rule.

use std::collections::{BTreeMap, BTreeSet};

/// Crate of the lines for rules without findings, which keep such rules from being taken for new ones.
const EVERYWHERE: &str = "*";

/// Number of findings per crate and rule.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts(BTreeMap<(String, String), usize>);

impl Counts {
    /// Adds one finding.
    pub(crate) fn add(&mut self, area: &str, rule: &str) {
        *self
            .0
            .entry((area.to_owned(), rule.to_owned()))
            .or_default() += 1;
    }

    /// Reads the committed file.
    ///
    /// # Errors
    /// If a line is not of the form `crate: rule: number`.
    pub(crate) fn read(text: &str) -> Result<Counts, String> {
        let line = |line: &str| {
            let (head, number) = line.rsplit_once(": ")?;
            let (area, rule) = head.split_once(": ")?;
            Some(((area.to_owned(), rule.to_owned()), number.parse().ok()?))
        };
        let lines = text
            .lines()
            .filter(|text| !text.is_empty() && !text.starts_with('#'));
        let entry =
            |text: &str| line(text).ok_or_else(|| format!("not `crate: rule: number`: {text}"));
        lines.map(entry).collect::<Result<_, String>>().map(Counts)
    }

    /// Writes the file to commit, with a line for each rule without findings.
    pub(crate) fn write<'a>(&self, rules: impl Iterator<Item = &'a str>) -> String {
        let mut lines = self.0.clone();
        for rule in rules.filter(|rule| self.total(rule) == 0) {
            lines.insert((EVERYWHERE.to_owned(), rule.to_owned()), 0);
        }
        let head = "# Findings of `cargo run -p xtask -- style`, which writes this file with `--update`. Numbers may only fall.\n";
        let line = |((area, rule), number): (&(String, String), &usize)| {
            format!("{area}: {rule}: {number}\n")
        };
        head.to_owned() + &lines.iter().map(line).collect::<String>()
    }

    /// Returns the number of findings of a rule in all crates.
    pub(crate) fn total(&self, rule: &str) -> usize {
        self.0
            .iter()
            .filter(|((_, other), _)| other == rule)
            .map(|(_, number)| number)
            .sum()
    }

    /// Returns the number of findings of all rules.
    pub(crate) fn sum(&self) -> usize {
        self.0.values().sum()
    }

    fn rules(&self) -> BTreeSet<&str> {
        self.0.keys().map(|(_, rule)| rule.as_str()).collect()
    }

    /// Returns crates and rules with more findings than `old` has, with both numbers: old and new.
    pub(crate) fn risen<'a>(&'a self, old: &Counts) -> Vec<(&'a str, &'a str, usize, usize)> {
        let entries = self
            .0
            .iter()
            .map(|(key, new)| (&*key.0, &*key.1, old.0.get(key).copied().unwrap_or(0), *new));
        entries.filter(|(_, _, old, new)| new > old).collect()
    }

    /// Returns the rules whose total has risen, with both totals. Rules that `old` does not name are new and may rise.
    pub(crate) fn risen_totals<'a>(&'a self, old: &Counts) -> Vec<(&'a str, usize, usize)> {
        let known = old.rules();
        let rules = self.rules().into_iter().filter(|rule| known.contains(rule));
        let totals = rules.map(|rule| (rule, old.total(rule), self.total(rule)));
        totals.filter(|(_, old, new)| new > old).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(entries: &[(&str, &str)]) -> Counts {
        let mut counts = Counts::default();
        for (area, rule) in entries {
            counts.add(area, rule);
        }
        counts
    }

    #[test]
    fn counts_are_read_as_written() {
        let found = counts(&[
            ("src", "of its own"),
            ("crates/hsd-roof", "is-no"),
            ("src", "of its own"),
        ]);
        let text = found.write(["is-no", "anew", "of its own"].into_iter());
        assert!(
            text.ends_with("*: anew: 0\ncrates/hsd-roof: is-no: 1\nsrc: of its own: 2\n"),
            "{text}"
        );
        let read = Counts::read(&text).unwrap();
        assert_eq!((read.sum(), read.total("of its own")), (3, 2));
        assert!(Counts::read("src: 12\n").is_err());
    }

    #[test]
    fn a_rise_in_a_crate_is_found() {
        let (old, new) = (
            counts(&[("a", "r")]),
            counts(&[("a", "r"), ("a", "r"), ("b", "r")]),
        );
        assert_eq!(new.risen(&old), [("a", "r", 1, 2), ("b", "r", 0, 1)]);
        assert_eq!(new.risen_totals(&old), [("r", 1, 3)]);
        assert!(old.risen(&new).is_empty());
    }

    #[test]
    fn moved_files_and_new_rules_do_not_raise_totals() {
        let (old, moved) = (counts(&[("a", "r")]), counts(&[("b", "r"), ("b", "new")]));
        assert!(moved.risen_totals(&old).is_empty());
        let cleared = Counts::read("*: r: 0\n").unwrap();
        assert_eq!(old.risen_totals(&cleared), [("r", 0, 1)]);
    }
}
