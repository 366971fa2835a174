//! The rules of style, applied to one passage at a time. Each function appends its findings.

use super::glossary::WordTable;
use super::passage::{Passage, Source};
use super::sentences::{sentences, word_count, words};
use std::ops::Range;

/// Maximum number of words in a sentence.
const SENTENCE_WORDS: usize = 25;

/// Maximum number of words in an item of a changelog.
const BULLET_WORDS: usize = 30;

/// Beginnings that a doc comment must not have.
const OPENINGS: &[&str] = &[
    "What", "How", "Where", "Why", "Whether", "Its", "Their", "The same", "As above",
];

/// Words after "is no" that make it plain English: "is no longer".
const AFTER_NO: &[&str] = &[
    "longer",
    "more",
    "less",
    "fewer",
    "better",
    "worse",
    "different",
    "matter",
    "such",
];

/// Words that may follow a clause. A phrase such as `of its own` ends its clause before one of them.
const CLAUSE_STARTS: &[&str] = &[
    "a", "after", "also", "an", "and", "are", "as", "at", "because", "before", "behind", "below",
    "beside", "between", "but", "by", "can", "for", "from", "has", "have", "if", "in", "into",
    "is", "it", "may", "nor", "not", "on", "or", "over", "so", "than", "that", "the", "then",
    "they", "this", "to", "too", "under", "unless", "until", "when", "where", "which", "while",
    "with", "without",
];

/// Last words of phrases that count only at the end of a clause: `a file of its own`, but not `of its own feature`.
const CLAUSE_ENDS: &[&str] = &["own", "is", "are", "was", "were", "words"];

/// A place where a passage breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Finding {
    /// Name of the rule; for a row of the glossary its first phrase.
    pub(crate) rule: String,
    /// Number of the line, from 1.
    pub(crate) line: usize,
    /// The text as found.
    pub(crate) found: String,
    /// Replacement, or what to do.
    pub(crate) advice: String,
}

/// Names and meanings of the rules that are not rows of the glossary.
pub(crate) const SENTENCE_RULES: &[(&str, &str)] = &[
    (
        "opening",
        "a doc comment begins with What, How, Where, Why, Whether, Its, Their, The same, As above",
    ),
    ("long-sentence", "a sentence has more than 25 words"),
    ("semicolons", "a sentence has more than one semicolon"),
    ("is-no", "\"is no\" + noun, \"is none\""),
    (
        "long-bullet",
        "an item of a changelog has more than 30 words",
    ),
];

/// Applies all rules to a passage.
pub(crate) fn check(passage: &Passage, table: &WordTable, is_changelog: bool) -> Vec<Finding> {
    let mut findings = Vec::new();
    if passage.source == Source::Doc && passage.is_first {
        opening(passage, &mut findings);
    }
    if is_changelog && passage.is_item {
        long_bullet(passage, &mut findings);
    } else {
        long_sentences(passage, &mut findings);
    }
    let words = words(&passage.prose);
    is_no(passage, &words, &mut findings);
    odd_words(passage, &words, table, &mut findings);
    findings.sort_by_key(|finding| finding.line);
    findings
}

fn finding(passage: &Passage, rule: &str, range: Range<usize>, advice: &str) -> Finding {
    Finding {
        rule: rule.to_owned(),
        line: passage.line_at(range.start),
        found: passage.raw[range].to_owned(),
        advice: advice.to_owned(),
    }
}

fn opening(passage: &Passage, out: &mut Vec<Finding>) {
    let starts = |opening: &&&str| {
        let rest = passage.prose.strip_prefix(**opening);
        rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    if let Some(opening) = OPENINGS.iter().find(starts) {
        let advice = "begin with a verb (\"Returns\") or a noun";
        out.push(finding(passage, "opening", 0..opening.len(), advice));
    }
}

fn long_sentences(passage: &Passage, out: &mut Vec<Finding>) {
    for sentence in parts(passage) {
        let text = &passage.prose[sentence.clone()];
        let count = word_count(text);
        if count > SENTENCE_WORDS {
            let advice = format!("split the sentence: {count} words, at most {SENTENCE_WORDS}");
            out.push(finding(passage, "long-sentence", sentence.clone(), &advice));
        }
        let semicolons = text.trim_end_matches(';').matches(';').count();
        if semicolons > 1 {
            let advice = format!("split the sentence: {semicolons} semicolons, at most 1");
            out.push(finding(passage, "semicolons", sentence, &advice));
        }
    }
}

/// Returns the sentences of a passage. A cell of a table has no room for a list, so semicolons divide it too.
fn parts(passage: &Passage) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    for sentence in sentences(&passage.prose) {
        let mut start = sentence.start;
        let text = &passage.prose[sentence.clone()];
        for (at, _) in text.match_indices(';').filter(|_| passage.is_cell) {
            parts.push(start..sentence.start + at);
            start = sentence.start + at + 1;
        }
        parts.push(start..sentence.end);
    }
    parts
}

fn long_bullet(passage: &Passage, out: &mut Vec<Finding>) {
    let count = word_count(&passage.prose);
    if count > BULLET_WORDS {
        let advice = format!("one change per item: {count} words, at most {BULLET_WORDS}");
        out.push(finding(
            passage,
            "long-bullet",
            0..passage.raw.len(),
            &advice,
        ));
    }
}

/// Finds `is no square` and `are none`, but not `there is no wall`, `is no longer` and `none of them`.
fn is_no(passage: &Passage, words: &[Range<usize>], out: &mut Vec<Finding>) {
    let word = |index: usize| {
        words
            .get(index)
            .map_or("", |range| &passage.prose[range.clone()])
    };
    for index in 0..words.len().saturating_sub(1) {
        let (verb, no) = (word(index), word(index + 1));
        if !matches!(verb, "is" | "are")
            || !matches!(no, "no" | "none")
            || !are_joined(passage, words, index, 2)
        {
            continue;
        }
        let before = [index.wrapping_sub(1), index.wrapping_sub(2)].map(word);
        let is_there = before.iter().any(|w| w.eq_ignore_ascii_case("there"));
        let after = word(index + 2);
        let is_idiom = match no {
            "none" => after == "of",
            _ => {
                AFTER_NO.contains(&after)
                    || word(index + 3) == "than"
                    || !are_joined(passage, words, index, 3)
            }
        };
        if is_there || is_idiom {
            continue;
        }
        let last = if no == "no" { index + 2 } else { index + 1 };
        let range = words[index].start..words[last].end;
        let advice = if no == "no" {
            "is not a …"
        } else {
            "is missing, is not one"
        };
        out.push(finding(passage, "is-no", range, advice));
    }
}

/// Returns true if only spaces separate a number of words.
fn are_joined(passage: &Passage, words: &[Range<usize>], first: usize, count: usize) -> bool {
    let Some(words) = words.get(first..first + count) else {
        return false;
    };
    let is_blank =
        |pair: &[Range<usize>]| passage.prose[pair[0].end..pair[1].start].trim().is_empty();
    words.windows(2).all(is_blank)
}

fn odd_words(passage: &Passage, words: &[Range<usize>], table: &WordTable, out: &mut Vec<Finding>) {
    for (index, range) in words.iter().enumerate() {
        let first = passage.prose[range.clone()].to_lowercase();
        for &(row, phrase) in table.starting_with(&first) {
            let row = &table.rows[row];
            let Some(length) = matched(passage, words, index, &row.phrases[phrase]) else {
                continue;
            };
            let range = range.start..words[index + length - 1].end;
            let advice = format!("write: {}", row.replacement(phrase));
            out.push(finding(passage, row.rule(), range, &advice));
        }
    }
}

/// Returns the number of words of a phrase, if it begins at a word of the passage.
fn matched(passage: &Passage, words: &[Range<usize>], index: usize, phrase: &str) -> Option<usize> {
    let parts: Vec<&str> = phrase.split(' ').collect();
    let length = parts.len();
    let found = words.get(index..index + length)?;
    let word = |range: &Range<usize>| passage.prose[range.clone()].to_lowercase();
    let is_equal = found
        .iter()
        .zip(&parts)
        .all(|(range, part)| word(range) == *part);
    if !is_equal || !are_joined(passage, words, index, length) {
        return None;
    }
    let goes_on = length > 1
        && CLAUSE_ENDS.contains(&parts[length - 1])
        && are_joined(passage, words, index, length + 1)
        && !CLAUSE_STARTS.contains(&word(&words[index + length]).as_str());
    (!goes_on).then_some(length)
}
