//! Completion: part codes, elements, attributes and their values, names, keys, roof words.
//!
//! The file is being edited and may be malformed. Where the reader cannot interpret it, the characters before the place
//! decide (see `place`).

mod cells;
mod fields;
pub(super) mod legacy;
pub(super) mod names;
pub(super) mod parts;
mod place;
pub(super) mod roofs;
pub(super) mod types;
mod values;
mod xml;

use super::{Analysis, card};
use hsd_base::diagnostic::{Language, Text};
use hsd_ir::catalog::PartDef;
use hsd_syntax::print::Form;
use std::ops::Range;

/// The kind of a completion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A part of the catalogue, by its code.
    Part,
    /// A custom part.
    OwnPart,
    /// An element of the XML form.
    Element,
    /// The end tag of an open element.
    EndTag,
    /// An attribute.
    Attribute,
    /// A word that a value or a field allows.
    Value,
    /// A name in expressions: a `let`, a `Param`, a parameter of a definition, `k`.
    Name,
    /// A function of expressions.
    Function,
    /// A definition, at a `use`.
    Piece,
    /// A file: a source file or an image.
    File,
    /// A key of the legacy header.
    Key,
    /// The letter at the end of a wall line.
    Turn,
    /// A name that another element has: the id of a floor, the code of a base.
    Reference,
}

/// A proposal at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The label in the list.
    pub label: String,
    /// The kind.
    pub kind: CompletionKind,
    /// The description, in one line.
    pub detail: Text,
    /// The range that it replaces; it contains the requested place and lies in one line.
    pub replace: Range<usize>,
    /// The inserted text.
    pub insert: String,
    /// The same in the snippet syntax of the protocol, if it has tab stops.
    pub snippet: Option<String>,
    /// The string that a client compares with the typed one; begins with it, in its script.
    pub filter: String,
    /// The sort key in the list.
    pub sort: String,
    /// The key by which [`documentation`] finds details.
    pub part: Option<PartKey>,
}

/// The part that a proposal represents.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartKey {
    /// Its code as in the catalogue: five columns, or a longer name.
    pub code: String,
}

/// Returns the completions at an offset, best first. `files` lists those below the folder of this file whose names have
/// an extension such as `hsd` or `png`, by their paths from that folder.
///
/// The list depends on the typed characters, in any script, so a client should ask again as typing continues
/// (`isIncomplete`).
pub fn complete(a: &Analysis, at: usize, files: &dyn Fn(&str) -> Vec<String>) -> Vec<Completion> {
    let text = a.text();
    if !text.is_char_boundary(at) {
        return vec![];
    }
    let request = Request { a, text, at, files };
    let mut found = match Form::of(&a.source) {
        Form::Xml => xml::complete(&request),
        Form::Legacy => legacy::complete(&request),
    };
    found.retain(|c| {
        let typed = text.get(c.replace.start..at).unwrap_or_default();
        answers(&c.filter, typed.trim())
    });
    found.sort_by(|x, y| (&x.sort, &x.label).cmp(&(&y.sort, &y.label)));
    found
}

/// Returns details about the part of a proposal, in Markdown: its card, with an image if `pictures` is set.
pub fn documentation(
    a: &Analysis,
    key: &PartKey,
    language: Language,
    pictures: bool,
) -> Option<String> {
    let catalog = a.catalog();
    let same = |p: &&PartDef| p.code() == key.code;
    let part = catalog.parts().iter().rev().find(same)?;
    Some(card::card(a, part, 0, language, pictures))
}

/// Returns true if the string contains the typed letters in order, the way clients compare them.
fn answers(filter: &str, typed: &str) -> bool {
    let mut letters = filter.chars().flat_map(char::to_lowercase);
    let mut typed = typed.chars().flat_map(char::to_lowercase);
    typed.all(|wanted| letters.any(|letter| letter == wanted))
}

/// A completion request.
struct Request<'a> {
    a: &'a Analysis,
    text: &'a str,
    at: usize,
    files: &'a dyn Fn(&str) -> Vec<String>,
}

impl Completion {
    /// Creates a completion that replaces the word being typed; clients compare the typed characters.
    fn word(label: &str, kind: CompletionKind, detail: Text, replace: &Range<usize>) -> Completion {
        Completion {
            label: label.to_owned(),
            kind,
            detail,
            replace: replace.clone(),
            insert: label.to_owned(),
            snippet: None,
            filter: label.to_owned(),
            sort: "5".to_owned(),
            part: None,
        }
    }

    /// Returns the same completion with another sort key.
    fn sorted(self, sort: impl Into<String>) -> Completion {
        Completion {
            sort: sort.into(),
            ..self
        }
    }
}
