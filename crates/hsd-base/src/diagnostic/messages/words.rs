//! Words that several messages are made of.

use crate::diagnostic::{Noun, Text, noun};
use crate::text;
use std::fmt::Display;

/// Words of the language as a choice: "`K`, `I` or `S`". Nothing for none.
pub fn any_of<T: Display>(words: &[T]) -> Text {
    listed(words, noun("or", "か"))
}

/// Words of the language one and all: "`K`, `I` and `S`". Nothing for none.
pub fn all_of<T: Display>(words: &[T]) -> Text {
    listed(words, noun("and", "と"))
}

fn listed<T: Display>(words: &[T], last: Noun) -> Text {
    let mut quoted: Vec<Text> = words.iter().map(|w| format!("`{w}`").into()).collect();
    let Some(end) = quoted.pop() else {
        return Text::default();
    };
    if quoted.is_empty() {
        return end;
    }
    let rest = Text::joined(quoted, ", ", "、");
    text!([rest, last, end] "{rest} {last} {end}", "{rest} {last} {end}")
}

/// Quotes the author's text in backquotes, shortened to fit on one line of a report.
pub fn quote(text: &str) -> String {
    format!("`{}`", shortened(text))
}

/// The same without the backquotes, for longer examples.
pub fn shortened(text: &str) -> String {
    let mut chars = text.chars();
    let head: String = chars.by_ref().take(40).collect();
    let end = if chars.next().is_some() { "…" } else { "" };
    format!("{}{end}", head.replace(['\n', '\r', '\t'], " "))
}

/// A number without needless decimals.
pub fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
