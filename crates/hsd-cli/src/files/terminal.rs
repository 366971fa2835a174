//! Terminal style, text width and counted nouns.

use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::text;
use hsd_report::Style;
use std::io::IsTerminal;

/// The default number of columns.
const WIDTH: usize = 100;

/// Returns the report style for a stream: colours only on a terminal, and not if `NO_COLOR` is set.
pub(crate) fn style(stream: &impl IsTerminal) -> Style {
    let set = |name: &str| std::env::var_os(name).is_some_and(|v| !v.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|t| t == "dumb");
    let columns = std::env::var("COLUMNS").ok().and_then(|c| c.parse().ok());
    Style {
        color: stream.is_terminal() && !set("NO_COLOR") && !dumb,
        width: columns.unwrap_or(WIDTH),
    }
}

/// Returns the display width of a string in columns: two for Han, kana and full-width forms, none for combining marks.
pub(crate) fn width(text: &str) -> usize {
    text.chars().map(columns).sum()
}

fn columns(c: char) -> usize {
    match c as u32 {
        0x0300..=0x036f | 0x3099 | 0x309a | 0x200b..=0x200f | 0xfe00..=0xfe0f => 0,
        0x1100..=0x115f | 0x2e80..=0x303e | 0x3041..=0xa4cf | 0xac00..=0xd7a3 => 2,
        0xf900..=0xfaff | 0xfe30..=0xfe6f | 0xff01..=0xff60 | 0xffe0..=0xffe6 => 2,
        0x1f300..=0x1faff | 0x20000..=0x3fffd => 2,
        _ => 1,
    }
}

/// Pads a string with spaces to a display width.
pub(crate) fn padded(text: &str, columns: usize) -> String {
    let blanks = columns.saturating_sub(width(text));
    format!("{text}{}", " ".repeat(blanks))
}

/// Formats a size in bytes, such as `1.2 MB`.
pub(crate) fn bytes(count: usize) -> Text {
    match count {
        0..1_000 => text!([count] "{count} bytes", "{count} バイト"),
        1_000..1_000_000 => format!("{:.1} kB", count as f64 / 1e3).into(),
        _ => format!("{:.1} MB", count as f64 / 1e6).into(),
    }
}

/// The noun for files.
pub(crate) const FILE: Noun = noun("file", "{}ファイル");

/// The noun for houses.
pub(crate) const HOUSE: Noun = noun("house", "家{}軒");

/// Returns a counted noun, such as `2 houses`. The Japanese noun has `{}` in place of the number.
pub(crate) fn counted(count: usize, Noun { en, ja }: Noun) -> Text {
    let plural = match (count, en.ends_with('h')) {
        (1, _) => "",
        (_, true) => "es",
        (_, false) => "s",
    };
    let ja = ja.replace("{}", &count.to_string());
    text!([count, en, plural, ja] "{count} {en}{plural}", "{ja}")
}
