//! The code being typed in a run of codes of five columns, and the range that a whole one would replace.

use std::ops::Range;

/// Number of columns of a code.
const CELL: usize = 5;

/// A code being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    /// The range that a whole code replaces.
    pub(super) range: Range<usize>,
    /// The typed part of the code, up to the requested position.
    pub(super) typed: String,
    /// Blanks that must come before the code, so that it begins in its column.
    pub(super) pad: usize,
}

/// Returns the code at an offset of a run of codes; `known` tests whether a string is a code of the catalogue.
pub(super) fn under_way(
    text: &str,
    run: Range<usize>,
    at: usize,
    known: &dyn Fn(&str) -> bool,
) -> Cell {
    let before = &text[run.start..at];
    let word = before.rfind(' ').map_or(run.start, |i| run.start + i + 1);
    match name_start(text, run.start, word..at) {
        Some(start) => named(text, run, start, at),
        None => coded(text, run, at, known),
    }
}

/// Returns the start of a name in a word, if it has one: no code has small letters, except the `h` of half a unit.
fn name_start(text: &str, run: usize, word: Range<usize>) -> Option<usize> {
    let written = &text[word.clone()];
    let column = columns(&text[run..word.start]) % CELL;
    if written == "h" && column == CELL - 1 || written.ends_with('h') && columns(written) == CELL {
        return None;
    }
    let first = written.find(foreign)?;
    // `Koshi` as a word of its own begins with its capital.
    let capital = first == 1 && written.starts_with(|c: char| c.is_ascii_uppercase());
    match capital {
        true => Some(word.start),
        false => Some(word.start + first),
    }
}

/// Returns true for characters of names that no code has.
fn foreign(c: char) -> bool {
    c.is_ascii_lowercase() || !c.is_ascii()
}

/// Returns a name in any script: it keeps its length, and its code begins in a column where a code may begin.
fn named(text: &str, run: Range<usize>, mut start: usize, at: usize) -> Cell {
    let typed = text[start..at].to_owned();
    let more = text[at..run.end].find(|c| !foreign(c));
    let end = more.map_or(run.end, |i| at + i);
    let off = columns(&text[run.start..start]) % CELL;
    let before = &text[run.start..start];
    let blanks = before.len() - before.trim_end_matches(' ').len();
    let mut pad = 0;
    if blanks >= off {
        start -= off;
    } else {
        pad = CELL - off;
    }
    Cell {
        range: start..end,
        typed,
        pad,
    }
}

/// Returns a code by its columns.
fn coded(text: &str, run: Range<usize>, at: usize, known: &dyn Fn(&str) -> bool) -> Cell {
    let before = &text[run.start..at];
    let into = columns(before) % CELL;
    let start = at - tail(before, into).len();
    let whole = head(&text[start..run.end], CELL);
    let rest = head(&text[at..run.end], CELL);
    let typed = text[start..at].trim().to_owned();
    // A code after the place that stays whole keeps its columns if nothing of it is replaced.
    let blank = whole.trim().is_empty();
    let own = blank || into > 0 && known(whole);
    let apart = !own && (into == 0 || !rest.starts_with(' ') && known(rest));
    let end = if apart { at } else { start + whole.len() };
    Cell {
        range: start..end,
        typed,
        pad: 0,
    }
}

/// Returns the number of columns, which are characters.
pub(super) fn columns(text: &str) -> usize {
    text.chars().count()
}

/// Returns the first columns of a string.
fn head(text: &str, columns: usize) -> &str {
    let end = text.char_indices().nth(columns).map(|(i, _)| i);
    &text[..end.unwrap_or(text.len())]
}

/// Returns the last columns of a string.
fn tail(text: &str, columns: usize) -> &str {
    if columns == 0 {
        return "";
    }
    let start = text.char_indices().nth_back(columns - 1).map(|(i, _)| i);
    &text[start.unwrap_or(0)..]
}

/// Returns a code padded to its five columns.
pub(super) fn padded(code: &str) -> String {
    format!("{code:<CELL$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(marked: &str) -> (String, String, usize) {
        let at = marked.find('|').expect("is marked");
        let text = marked.replacen('|', "", 1);
        let known = |code: &str| ["GSI", "GDE 2", "KKS", "GKK h"].contains(&code.trim_end());
        let cell = under_way(&text, 0..text.len(), at, &known);
        (text[cell.range].to_owned(), cell.typed, cell.pad)
    }

    #[test]
    fn codes_are_found_by_their_columns_and_names_by_their_letters() {
        let said = |range: &str, typed: &str, pad| (range.to_owned(), typed.to_owned(), pad);
        assert_eq!(at("KKS  GS|"), said("GS", "GS", 0));
        assert_eq!(at("KKS  GS|I  GDE 2"), said("GSI  ", "GS", 0));
        assert_eq!(at("KKS  G|GDE 2KKS"), said("G", "G", 0));
        assert_eq!(at("KKS  |GDE 2"), said("", "", 0));
        assert_eq!(at("GDE 2KK|"), said("KK", "KK", 0));
        assert_eq!(at("KKS  格子|GSI"), said("格子", "格子", 0));
        assert_eq!(at("KKS  koshido|GSI"), said("koshido", "koshido", 0));
        assert_eq!(at("KKS koshi|"), said("koshi", "koshi", 1));
        assert_eq!(at("KKS   koshi|"), said(" koshi", "koshi", 0));
        assert_eq!(at("GDE 2od|"), said("od", "od", 0));
        assert_eq!(at("KKS  Koshi|"), said("Koshi", "Koshi", 0));
        assert_eq!(at("KKS  GKK h|"), said("", "", 0));
        assert_eq!(at("KKS  G|     KKS"), said("G    ", "G", 0));
    }
}
