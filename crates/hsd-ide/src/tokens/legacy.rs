//! Words of the legacy form.

use super::{List, TokenKind};
use hsd_syntax::parse::syntax::LineKind;
use hsd_syntax::parse::syntax::{LegacyLine, Outline};
use std::ops::Range;

/// Adds the words of all lines.
pub(super) fn tokens(outline: &Outline, list: &mut List<'_>) {
    for line in &outline.lines {
        match line.kind {
            LineKind::Blank | LineKind::Comment => {}
            LineKind::Separator => list.add(line.range.clone(), TokenKind::Operator),
            LineKind::Header => header(line, list),
            LineKind::Wall => {
                line.codes.iter().for_each(|code| list.code(code));
                if let Some(turn) = &line.turn {
                    list.add(turn.clone(), TokenKind::Operator);
                }
            }
            LineKind::Roof => roof(line, list),
        }
    }
}

/// Returns the words of a line.
fn words<'a>(line: &LegacyLine, text: &'a str) -> Vec<(Range<usize>, &'a str)> {
    let written = &text[line.range.clone()];
    let place = |word: &str| word.as_ptr() as usize - written.as_ptr() as usize + line.range.start;
    let words = written.split_whitespace();
    words
        .map(|word| (place(word)..place(word) + word.len(), word))
        .collect()
}

fn is_number(word: &str) -> bool {
    word.parse::<f64>().is_ok()
}

/// Adds numbers, or a setting.
fn header(line: &LegacyLine, list: &mut List<'_>) {
    let words = words(line, list.text);
    let Some((first, key)) = words.first() else {
        return;
    };
    if is_number(key) {
        for (range, word) in words {
            let kind = match is_number(word) {
                true => TokenKind::Number,
                false => TokenKind::String,
            };
            list.add(range, kind);
        }
        return;
    }
    list.add(first.clone(), TokenKind::Keyword);
    let Some((last, _)) = words.last().filter(|_| words.len() > 1) else {
        return;
    };
    if *key == "name" {
        list.add(words[1].0.start..last.end, TokenKind::String);
        return;
    }
    for (range, word) in &words[1..] {
        let kind = match is_number(word) {
            true => TokenKind::Number,
            false => TokenKind::Keyword,
        };
        list.add(range.clone(), kind);
    }
}

/// Adds a roof line: covering, direction and shape are words of the language; options a letter and a number.
fn roof(line: &LegacyLine, list: &mut List<'_>) {
    for (range, word) in words(line, list.text) {
        let option = word.chars().next().filter(|c| c.is_ascii_alphabetic());
        match option.filter(|_| word.len() > 1 && is_number(&word[1..])) {
            Some(_) => {
                let split = range.start + 1;
                list.add(range.start..split, TokenKind::Attribute);
                list.add(split..range.end, TokenKind::Number);
            }
            None if is_number(word) || word == "*" => list.add(range, TokenKind::Number),
            None => list.add(range, TokenKind::Keyword),
        }
    }
}
