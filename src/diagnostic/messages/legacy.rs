//! Messages about the legacy text (HSD01xx): 0101 to 0119 the header and the sections, 0120 to 0139 the
//! walls (and 0137 heights), 0140 and on the roof lines.

mod header;
mod roofs;
mod walls;

pub use header::*;
pub use roofs::*;
pub use walls::*;

/// Words in a sentence, each in backquotes.
fn list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// What an author wrote, in backquotes, not longer than a line of a report.
fn quote(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("`{short}`")
}
