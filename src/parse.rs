//! From a source to a document, whatever the syntax.
//!
//! The first character that is no white space decides: `<` opens the XML form, everything else is
//! legacy text (language.md 2 and 3). What concerns a file as a whole is said here, once for both
//! readers: its size, its encoding, bytes without a meaning, a file that is no text at all.
//!
//! Reading never fails. A reader reports what it cannot take, reads on as if the mend it proposes had
//! been made, and returns every house it found.

use crate::ast::Document;
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::file as say;
use crate::source::{Limits, Source};

mod faults;
pub mod legacy;
pub mod xml;

/// Reads a file of either syntax.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    if source.size() > limits.bytes {
        out.push(say::too_large(
            source.span(0..0),
            source.size(),
            limits.bytes,
        ));
        return Document::default();
    }
    let text = source.text();
    if looks_binary(text) {
        let nul = text.find('\0').unwrap_or(0);
        out.push(say::not_a_text(source.span(nul..nul + 1)));
        return Document::default();
    }
    encoding(source, out);
    match text.trim_start().chars().next() {
        None => {
            out.push(say::no_house(source.span(0..0)));
            Document::default()
        }
        Some('<' | '＜') => xml::parse(source, limits, out),
        Some(_) => legacy::parse(source, limits, out),
    }
}

/// A tenth of NUL characters among the first thousand: a picture, an archive, or UTF-16 without a mark.
fn looks_binary(text: &str) -> bool {
    let head = &text.as_bytes()[..text.len().min(1000)];
    let nuls = head.iter().filter(|&&b| b == 0).count();
    nuls > 0 && nuls * 10 >= head.len()
}

/// Says once how the bytes were read, where that is not plain UTF-8.
fn encoding(source: &Source, out: &mut Diagnostics) {
    let start = source.span(0..0);
    match source.encoding() {
        "UTF-8" => {}
        "Shift_JIS" => out.push(say::shift_jis(start)),
        other => out.push(say::other_encoding(start, other)),
    }
    if source.malformed() {
        let text = source.text();
        let at = text.find('\u{fffd}').unwrap_or(0);
        let count = text.matches('\u{fffd}').count();
        let span = source.span(at..at + '\u{fffd}'.len_utf8());
        out.push(say::malformed(span, source.encoding(), count));
    }
}
