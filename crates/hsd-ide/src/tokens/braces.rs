//! Words of expressions.

use super::{List, TokenKind};
use hsd_syntax::parse::syntax::Expression;

/// Reserved words of expressions.
const WORDS: [&str; 8] = ["and", "or", "not", "true", "false", "yes", "no", "k"];

/// Adds the words of an expression with its braces.
pub(super) fn tokens(expression: &Expression, list: &mut List<'_>) {
    let text = list.text;
    let range = &expression.range;
    let mut at = range.start;
    while at < range.end {
        let rest = &text[at..range.end];
        let Some(c) = rest.chars().next() else { return };
        let length = match c {
            _ if c.is_whitespace() => c.len_utf8(),
            '\'' | '"' => quoted(rest, at, list),
            '0'..='9' | '.' => number(rest, at, list),
            '&' => {
                let length = rest.find(';').map_or(1, |i| i + 1);
                list.add(at..at + length, TokenKind::Operator);
                length
            }
            _ if c.is_alphabetic() || c == '_' => word(rest, at, list),
            _ => {
                list.add(at..at + c.len_utf8(), TokenKind::Operator);
                c.len_utf8()
            }
        };
        at += length.max(1);
    }
}

/// Adds a quoted string, often a code.
fn quoted(rest: &str, at: usize, list: &mut List<'_>) -> usize {
    let length = rest[1..].find(&rest[..1]).map_or(rest.len(), |i| i + 2);
    let inner = rest.get(1..length.saturating_sub(1)).unwrap_or_default();
    match list.known(inner).filter(|_| !inner.trim().is_empty()) {
        Some(known) => list.put(at..at + length, TokenKind::Code, known),
        None => list.add(at..at + length, TokenKind::String),
    }
    length
}

fn number(rest: &str, at: usize, list: &mut List<'_>) -> usize {
    let fits = |c: char| c.is_alphanumeric() || c == '.' || c == '_';
    let length = rest.find(|c| !fits(c)).unwrap_or(rest.len());
    list.add(at..at + length, TokenKind::Number);
    length
}

fn word(rest: &str, at: usize, list: &mut List<'_>) -> usize {
    let fits = |c: char| c.is_alphanumeric() || c == '_';
    let length = rest.find(|c| !fits(c)).unwrap_or(rest.len());
    let kind = match &rest[..length] {
        word if WORDS.contains(&word) => TokenKind::Keyword,
        _ if rest[length..].trim_start().starts_with('(') => TokenKind::Function,
        _ => TokenKind::Variable,
    };
    list.add(at..at + length, kind);
    length
}
