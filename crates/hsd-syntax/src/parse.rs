//! Reads a source into a document, in either syntax.
//!
//! The first character that is not white space decides: `<` opens the XML form, everything else is legacy form
//! (docs/contract.md 2 and 3). Checks of a file as a whole are here, once for both readers: its size, its encoding,
//! invalid bytes, binary files.
//!
//! Reading never fails. A reader reports what it cannot accept, continues as if the proposed fix had been applied, and
//! returns every house it found.

pub use builtin::builtin;
pub use values::{Seen, Values};

use hsd_base::diagnostic::messages::{file as say, limits};
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{Limits, NoFiles, Source, SourceCache, World};
use hsd_ir::ast::Document;

mod builtin;
mod columns;
pub mod divide;
mod expr;
pub mod fields;
pub mod meanings;
mod reporter;
pub mod legacy;
pub mod names;
pub mod outline;
pub mod over;
pub mod syntax;
mod values;
pub mod xml;
pub mod schema;

/// The settings with which a file is read.
#[derive(Clone, Copy)]
pub struct ReadContext<'a> {
    /// Limits on the input.
    pub limits: Limits,
    /// Parameters and their values; the last value of a name counts.
    pub parameters: &'a [(String, String)],
    /// Overrides the seed of every house. With it, parameters with `random` are chosen at random.
    pub seed: Option<u64>,
    /// Access to included files.
    pub world: &'a dyn World,
    /// The cache of files already read.
    pub cache: &'a SourceCache,
    /// Records the values of expressions, if requested.
    pub values: Option<&'a Values>,
    /// What stands before the source in the file that it is a piece of, if it is one.
    pub before: Option<Before>,
}

/// What stands before a piece of a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Before {
    /// The number of houses.
    pub houses: u64,
}

impl<'a> ReadContext<'a> {
    /// Creates a context without parameters and other files.
    pub fn alone(limits: &Limits, cache: &'a SourceCache) -> ReadContext<'a> {
        ReadContext {
            limits: *limits,
            parameters: &[],
            seed: None,
            world: &NoFiles,
            cache,
            values: None,
            before: None,
        }
    }
}

/// Returns the known word nearest to a misspelt one, if it is near enough.
pub fn nearest<'k>(word: &str, known: impl Iterator<Item = &'k str> + Clone) -> Option<&'k str> {
    xml::nearest(word, known)
}

/// Reads a file of either syntax that includes no other.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    let cache = SourceCache::new(0, 0, 0);
    let setting = ReadContext::alone(limits, &cache);
    parse_in(source, setting, &mut xml::Trees::default(), out)
}

/// Reads a file of either syntax. Elements that were read before are taken from `trees`.
pub fn parse_in<'a>(
    source: &'a Source,
    setting: ReadContext<'a>,
    trees: &mut xml::Trees<'a>,
    out: &mut Diagnostics,
) -> Document {
    let limits = &setting.limits;
    // The file of a piece has been looked at.
    let alone = setting.before.is_none();
    if alone && !is_readable(source, limits, &mut |d| out.push(d)) {
        return Document::default();
    }
    match source.text().trim_start().chars().next() {
        None => {
            if alone {
                out.push(say::no_house(source.span(0..0)));
            }
            Document::default()
        }
        Some('<' | '＜') => xml::parse_from(source, 0, setting, trees, out),
        Some(_) => legacy::parse_in(source, setting, out),
    }
}

/// Returns true if a file is a source file within the size limit; reports its encoding.
fn is_readable(source: &Source, limits: &Limits, out: &mut dyn FnMut(Diagnostic)) -> bool {
    if source.size() > limits.bytes {
        let start = source.span(0..0);
        out(limits::too_large(start, source.size(), limits.bytes));
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

/// Returns true if a tenth of the first thousand characters is NUL: an image, an archive, or UTF-16 without a mark.
fn looks_binary(text: &str) -> bool {
    let head = &text.as_bytes()[..text.len().min(1000)];
    let nuls = head.iter().filter(|&&b| b == 0).count();
    nuls > 0 && nuls * 10 >= head.len()
}

/// Reports the encoding of a file once, if it is not plain UTF-8.
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
