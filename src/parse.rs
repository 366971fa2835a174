//! From a source to a document, whatever the syntax.
//!
//! The first character that is no white space decides: `<` opens the XML form, everything else is
//! legacy form (docs/contract.md 2 and 3). What concerns a file as a whole is stated here, once for both
//! readers: its size, its encoding, bytes without a meaning, a file that is no text at all.
//!
//! Reading never fails. A reader reports what it cannot take, reads on as if the fix it proposes had
//! been made, and returns every house it found.

pub use builtin::builtin;
pub use values::{Seen, Values};

use crate::ast::Document;
use crate::diagnostic::messages::file as say;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::source::{Limits, NoFiles, Source, SourceCache, World};

mod builtin;
mod expr;
mod reporter;
pub mod legacy;
pub mod names;
pub mod outline;
pub mod syntax;
mod values;
pub mod xml;
pub mod schema;

/// The settings with which a file is read.
#[derive(Clone, Copy)]
pub struct ReadContext<'a> {
    /// Bounds on what is taken in.
    pub limits: Limits,
    /// Parameters and their values; the last of a name counts.
    pub parameters: &'a [(String, String)],
    /// Takes the place of the seed of every house. With it parameters that may be are drawn.
    pub seed: Option<u64>,
    /// Where the files lie that others include.
    pub world: &'a dyn World,
    /// Where those that were read are kept.
    pub cache: &'a SourceCache,
    /// Where it is taken down what expressions and names come to, if requested.
    pub values: Option<&'a Values>,
}

impl<'a> ReadContext<'a> {
    /// No parameters, no other files.
    pub fn alone(limits: &Limits, cache: &'a SourceCache) -> ReadContext<'a> {
        ReadContext {
            limits: *limits,
            parameters: &[],
            seed: None,
            world: &NoFiles,
            cache,
            values: None,
        }
    }
}

/// The known word that is nearest to one, if it may be a slip of that.
pub fn nearest<'k>(word: &str, known: impl Iterator<Item = &'k str> + Clone) -> Option<&'k str> {
    xml::nearest(word, known)
}

/// Reads a file of either syntax that stands for itself.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    let cache = SourceCache::new(0, 0);
    let setting = ReadContext::alone(limits, &cache);
    parse_in(source, setting, &mut xml::Trees::default(), out)
}

/// Reads a file of either syntax. What was read before is taken from `trees`.
pub fn parse_in<'a>(
    source: &'a Source,
    setting: ReadContext<'a>,
    trees: &mut xml::Trees<'a>,
    out: &mut Diagnostics,
) -> Document {
    let limits = &setting.limits;
    if !is_readable(source, limits, &mut |d| out.push(d)) {
        return Document::default();
    }
    match source.text().trim_start().chars().next() {
        None => {
            out.push(say::no_house(source.span(0..0)));
            Document::default()
        }
        Some('<' | '＜') => xml::parse_from(source, 0, setting, trees, out),
        Some(_) => legacy::parse(source, limits, out),
    }
}

/// Whether a file is a source file of tolerable length; says how its bytes were read.
fn is_readable(source: &Source, limits: &Limits, out: &mut dyn FnMut(Diagnostic)) -> bool {
    if source.size() > limits.bytes {
        let start = source.span(0..0);
        out(say::too_large(start, source.size(), limits.bytes));
        return false;
    }
    let text = source.text();
    if looks_binary(text) {
        let nul = text.find('\0').unwrap_or(0);
        out(say::not_a_text(source.span(nul..nul + 1)));
        return false;
    }
    encoding(source, out);
    true
}

/// A tenth of NUL characters among the first thousand: a picture, an archive, or UTF-16 without a mark.
fn looks_binary(text: &str) -> bool {
    let head = &text.as_bytes()[..text.len().min(1000)];
    let nuls = head.iter().filter(|&&b| b == 0).count();
    nuls > 0 && nuls * 10 >= head.len()
}

/// Says once how the bytes were read, where that is not plain UTF-8.
fn encoding(source: &Source, out: &mut dyn FnMut(Diagnostic)) {
    let start = source.span(0..0);
    match source.encoding() {
        "UTF-8" => {}
        "Shift_JIS" => out(say::shift_jis(start)),
        other => out(say::other_encoding(start, other)),
    }
    if source.malformed() {
        let text = source.text();
        let at = text.find('\u{fffd}').unwrap_or(0);
        let count = text.matches('\u{fffd}').count();
        let span = source.span(at..at + '\u{fffd}'.len_utf8());
        out(say::malformed(span, source.encoding(), count));
    }
}
