//! Reads the table "Words not to use" of `docs/glossary.md`, the list of odd words and their replacements.

use super::markdown::table_cells;
use std::collections::HashMap;

/// Heading of the section that holds the table. The linter does not examine this section.
pub(crate) const SECTION: &str = "## Words not to use";

/// A row of the table that can be checked without context.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct WordRow {
    /// Odd phrases, in small letters.
    pub(crate) phrases: Vec<String>,
    /// Replacements: one for each phrase, or one for all.
    replacements: Vec<String>,
}

impl WordRow {
    /// Name of the rule: the first phrase of the row.
    pub(crate) fn rule(&self) -> &str {
        self.phrases.first().map_or("", String::as_str)
    }

    /// Returns what to write instead of a phrase of this row.
    pub(crate) fn replacement(&self, phrase: usize) -> &str {
        let single = self.replacements.first();
        self.replacements
            .get(phrase)
            .or(single)
            .map_or("", String::as_str)
    }
}

/// The rows that can be checked, found by the first word of a phrase.
#[derive(Debug)]
pub(crate) struct WordTable {
    /// Rows in the order of the page.
    pub(crate) rows: Vec<WordRow>,
    by_first_word: HashMap<String, Vec<(usize, usize)>>,
}

impl WordTable {
    /// Returns the phrases that begin with a word in small letters, as row and phrase.
    pub(crate) fn starting_with(&self, word: &str) -> &[(usize, usize)] {
        self.by_first_word.get(word).map_or(&[], Vec::as_slice)
    }

    /// Reads the table from the text of the page.
    ///
    /// # Errors
    /// If the section or its column `checked` is missing. If a cell of that column is neither `yes` nor `no`, or two
    /// rows have the same first phrase.
    pub(crate) fn read(page: &str) -> Result<WordTable, String> {
        let section = page.lines().skip_while(|line| *line != SECTION).skip(1);
        let mut table = section
            .take_while(|line| !line.starts_with("## "))
            .filter(|line| line.starts_with('|'));
        let head = table.next().map(table_cells).unwrap_or_default();
        if head != ["not", "but", "reason", "checked"] {
            return Err(format!(
                "\"{SECTION}\" needs a table `| not | but | reason | checked |`"
            ));
        }
        let mut rows: Vec<WordRow> = Vec::new();
        for line in table.skip(1) {
            let Some(row) = word_row(line)? else {
                continue;
            };
            if rows.iter().any(|other| other.rule() == row.rule()) {
                return Err(format!("duplicate row `{}`", row.rule()));
            }
            rows.push(row);
        }
        Ok(WordTable::new(rows))
    }

    fn new(rows: Vec<WordRow>) -> WordTable {
        let mut by_first_word: HashMap<String, Vec<(usize, usize)>> = HashMap::new();
        for (row, phrase, text) in rows.iter().enumerate().flat_map(|(r, row)| {
            row.phrases
                .iter()
                .enumerate()
                .map(move |(p, text)| (r, p, text))
        }) {
            let first = text.split(' ').next().unwrap_or_default();
            by_first_word
                .entry(first.to_owned())
                .or_default()
                .push((row, phrase));
        }
        WordTable {
            rows,
            by_first_word,
        }
    }
}

/// Reads one row; `None` if it needs context.
fn word_row(line: &str) -> Result<Option<WordRow>, String> {
    let [not, but, _, checked] = table_cells(line)[..] else {
        return Err(format!("four cells expected: {line}"));
    };
    match checked {
        "no" => return Ok(None),
        "yes" => {}
        _ => return Err(format!("`checked` is `yes` or `no`: {line}")),
    }
    let phrases = listed(&not.to_lowercase());
    let mut replacements = listed(but);
    if replacements.len() != phrases.len() {
        replacements = vec![but.to_owned()];
    }
    if phrases.is_empty() || but.is_empty() {
        return Err(format!("empty cell: {line}"));
    }
    Ok(Some(WordRow {
        phrases,
        replacements,
    }))
}

fn listed(cell: &str) -> Vec<String> {
    cell.split(',')
        .map(|part| part.trim().to_owned())
        .filter(|part| !part.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str =
        "# G\n\n## Words not to use\n\n| not | but | reason | checked |\n|---|---|---|---|\n";

    #[test]
    fn rows_marked_yes_are_read() {
        let page = format!(
            "{HEAD}| Gray, color | grey, colour | | yes |\n| text | file | x | no |\n| anew | again | | yes |\n\n## Next\n| a | b | c | d |\n"
        );
        let table = WordTable::read(&page).unwrap();
        let rules: Vec<_> = table.rows.iter().map(WordRow::rule).collect();
        assert_eq!(rules, ["gray", "anew"]);
        assert_eq!(table.rows[0].replacement(1), "colour");
        assert_eq!(table.starting_with("color"), [(0, 1)]);
        assert!(table.starting_with("text").is_empty());
    }

    #[test]
    fn mistakes_are_reported() {
        for page in [
            "# G\n",
            "## Words not to use\n\n| not | but | reason |\n|---|---|---|\n",
            &format!("{HEAD}| a | b | c | maybe |\n"),
            &format!("{HEAD}| a | b | yes |\n"),
            &format!("{HEAD}| a | b | | yes |\n| a, c | d | | yes |\n"),
            &format!("{HEAD}| a | | | yes |\n"),
        ] {
            assert!(WordTable::read(page).is_err(), "{page}");
        }
    }

    #[test]
    fn the_glossary_of_the_repository_can_be_read() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/glossary.md");
        let page = std::fs::read_to_string(page).unwrap();
        let table = WordTable::read(&page).unwrap();
        assert!(table.rows.len() > 10);
        assert!(!table.starting_with("anew").is_empty());
    }
}
