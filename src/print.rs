//! Documents back to files: `hsd fmt` lays a source file out anew, in its own form or in the other.
//!
//! A source file is laid out from what its author wrote, not from what the program makes of it: comments stay where they
//! are, numbers keep their spelling, the order of everything is the author's. What a layout may never do is change
//! the meaning, so each result is read again, and where the tree of the document is not the same but for its places,
//! the file stays as it is.
//!
//! | file | does |
//! |---|---|
//! | `legacy`, `table` | lays out a legacy form; its roof lines |
//! | `xml` | lays out an XML file |
//! | `to_xml`, `to_legacy` | write a house in the other form |
//! | `essence` | a tree without its places, to compare |
//! | `encode` | a source file as bytes in the encoding it came in |
//! | `lines` | how two files differ |

mod encode;
mod essence;
mod legacy;
mod lines;
mod table;
mod to_legacy;
mod to_xml;
mod xml;

pub use encode::encode;
pub use essence::essence;
pub use lines::changes;
pub use to_legacy::to_legacy;
pub use to_xml::to_xml;

use crate::ast::Document;
use crate::diagnostic::messages::print as say;
use crate::diagnostic::{Diagnostics, Severity, Text};
use crate::parse;
use crate::source::{Limits, Source};

/// The forms of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines of five-column codes.
    Legacy,
    /// XML.
    Xml,
}

impl Form {
    /// The form of a source file: its first character that is no white space decides (docs/contract.md 2).
    pub fn of(source: &Source) -> Form {
        match source.text().trim_start().starts_with(['<', '＜']) {
            true => Form::Xml,
            false => Form::Legacy,
        }
    }

    /// The other one.
    pub fn other(self) -> Form {
        match self {
            Form::Legacy => Form::Xml,
            Form::Xml => Form::Legacy,
        }
    }

    /// The name.
    pub fn name(self) -> Text {
        match self {
            Form::Legacy => say::legacy_form(),
            Form::Xml => say::xml_form(),
        }
    }
}

/// Lays a source file out anew in its own form, with its own line ends. A legacy file has to be without errors, an XML file
/// to be well-formed: whether its elements make sense does not matter here.
///
/// # Errors
/// `None` where the meaning of the file is in doubt; `out` says why.
pub fn format(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Option<String> {
    let mut told = Diagnostics::new();
    let document = parse::parse(source, limits, &mut told);
    let sound = !told.has_errors();
    let end = line_end(source.text());
    let text = match Form::of(source) {
        Form::Legacy if sound => Some(with_ends(legacy::format(source, limits, &document), end)),
        Form::Legacy => None,
        Form::Xml => xml::format(source.text(), end),
    };
    let kept = text.filter(|text| same(source, &document, text, limits));
    if kept.is_none() {
        pass_on(told, out);
        if sound {
            out.push(say::left_alone(source.span(0..0)));
        }
    }
    kept
}

/// Errors only: to say the rest is the business of other commands.
fn pass_on(told: Diagnostics, out: &mut Diagnostics) {
    let errors = told.into_sorted().into_iter();
    errors
        .filter(|d| d.severity == Severity::Error)
        .for_each(|d| out.push(d));
}

/// Whether a source file says the same as the document.
fn same(source: &Source, document: &Document, text: &str, limits: &Limits) -> bool {
    if text == source.text() {
        return true;
    }
    // A layout may be longer than what a file is allowed to have.
    let limits = Limits {
        bytes: usize::MAX,
        ..*limits
    };
    let again = Source::new(source.id(), source.name(), &encode(text, source));
    let read = parse::parse(&again, &limits, &mut Diagnostics::new());
    essence(&read) == essence(document)
}

/// The line end that a source file has most.
fn line_end(text: &str) -> &'static str {
    let (mut windows, mut old, mut unix) = (0usize, 0usize, 0usize);
    let bytes = text.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        match byte {
            b'\n' if at > 0 && bytes[at - 1] == b'\r' => windows += 1,
            b'\n' => unix += 1,
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => old += 1,
            _ => {}
        }
    }
    match () {
        () if windows > unix.max(old) => "\r\n",
        () if old > unix.max(windows) => "\r",
        () => "\n",
    }
}

/// A text of line feeds with other line ends.
fn with_ends(text: String, end: &str) -> String {
    match end {
        "\n" => text,
        end => text.replace('\n', end),
    }
}
