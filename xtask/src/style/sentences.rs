//! Splits passages into sentences and words.

use std::ops::Range;

/// Words whose full stop does not end a sentence.
const ABBREVIATIONS: &[&str] = &[
    "e.g", "i.e", "cf", "vs", "no", "nos", "fig", "figs", "p", "pp", "ca", "approx", "vol", "vols",
    "ed", "eds", "art", "sec", "ch", "st", "dr", "mr", "prof", "jap", "max", "min", "incl", "resp",
];

/// Splits prose into sentences: a full stop, exclamation or question mark, then a space and no small letter.
pub(crate) fn sentences(prose: &str) -> Vec<Range<usize>> {
    let (mut found, mut start) = (Vec::new(), 0);
    for (at, mark) in prose.match_indices(['.', '!', '?']) {
        let rest = prose[at + 1..].trim_start_matches(['"', '\'', ')', '*', ']', '”', '’']);
        let end = prose.len() - rest.len();
        let next = rest.trim_start();
        if next.len() == rest.len() || !begins_sentence(next) {
            continue;
        }
        if mark == "." && is_abbreviation(&prose[start..at]) {
            continue;
        }
        found.push(start..end);
        start = prose.len() - next.len();
    }
    if start < prose.len() {
        found.push(start..prose.len());
    }
    found
}

/// Returns true unless a text begins with a small letter. Names such as hsd and glTF may begin a sentence.
fn begins_sentence(text: &str) -> bool {
    let word = text.split_whitespace().next().unwrap_or_default();
    let is_name = word == "hsd" || word.contains(char::is_uppercase);
    is_name || text.chars().next().is_some_and(|c| !c.is_lowercase())
}

fn is_abbreviation(before: &str) -> bool {
    let word = before.rsplit([' ', '(', '[']).next().unwrap_or_default();
    let is_initial = word.chars().count() == 1 && word.chars().all(char::is_uppercase);
    is_initial || ABBREVIATIONS.contains(&word.to_lowercase().as_str())
}

/// Counts the words of a sentence. Adjacent code spans are one word, and a lone sign such as a dash is not counted.
pub(crate) fn word_count(sentence: &str) -> usize {
    let (mut count, mut after_code) = (0, false);
    for word in sentence.split_whitespace() {
        let is_code = word.contains('`') && !word.contains(char::is_alphanumeric);
        let is_word = is_code || word.contains(char::is_alphanumeric);
        if is_word && !(is_code && after_code) {
            count += 1;
        }
        after_code = is_code;
    }
    count
}

/// Returns the words of a text with letters, figures, hyphens and apostrophes, without other signs.
pub(crate) fn words(prose: &str) -> Vec<Range<usize>> {
    let (mut found, mut start) = (Vec::new(), None);
    for (at, c) in prose.char_indices() {
        let is_inside = c.is_alphanumeric() || "-'’_".contains(c);
        match (is_inside, start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                found.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    found.extend(start.map(|from| from..prose.len()));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(prose: &str) -> Vec<&str> {
        sentences(prose).into_iter().map(|s| &prose[s]).collect()
    }

    #[test]
    fn sentences_end_at_full_stops() {
        assert_eq!(
            split("One (two.) Three! \"Four?\" Five"),
            ["One (two.)", "Three!", "\"Four?\"", "Five"]
        );
        assert_eq!(split("Ends. `code` begins."), ["Ends.", "`code` begins."]);
    }

    #[test]
    fn sentences_begin_with_names_in_small_letters() {
        assert_eq!(split("Ends. hsd begins."), ["Ends.", "hsd begins."]);
        assert_eq!(split("Ends. glTF begins."), ["Ends.", "glTF begins."]);
    }

    #[test]
    fn abbreviations_initials_and_numbers_do_not_end_sentences() {
        for text in [
            "See e.g. Nishi.",
            "By K. Nishi, p. 12, cf. Fig. 3.",
            "It is 1.5 m.",
            "etc. and so on",
        ] {
            assert_eq!(split(text), [text]);
        }
    }

    #[test]
    fn words_are_counted_without_signs() {
        assert_eq!(word_count("A wall – `````` of 3.5 m, the lean-to's."), 8);
        assert_eq!(word_count("Either `` ``, ``` or ``."), 4);
        assert_eq!(words("A lean-to, 門 (b)").len(), 4);
    }
}
