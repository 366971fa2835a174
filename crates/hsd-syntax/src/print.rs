//! Documents back to files: `hsd fmt` formats a source file, in its own form or in the other.
//!
//! A source file is formatted from what its author wrote, not from the result of parsing: comments stay where they are,
//! numbers keep their spelling, and the order stays. Formatting must never change the meaning, so each result is parsed
//! again; if its tree differs in more than its places, the file is left unchanged.
//!
//! | file | does |
//! |---|---|
//! | `legacy`, `table` | lays out a legacy form; its roof lines |
//! | `xml` | lays out an XML file |
//! | `to_xml`, `to_legacy` | write a house in the other form |
//! | `own_widths` | facades in the widths of their codes |
//! | `essence` | a tree without its places, to compare |
//! | `encode` | a source file as bytes in the encoding it came in |
//! | `lines` | how two files differ |

mod encode;
mod essence;
mod legacy;
mod lines;
mod own_widths;
mod table;
mod to_legacy;
mod to_xml;
mod xml;

pub use encode::encode;
pub use essence::essence;
pub use lines::changes;
pub use own_widths::in_own_widths;
pub use to_legacy::to_legacy;
pub use to_xml::to_xml;

use crate::messages::print as say;
use crate::parse;
use hsd_base::diagnostic::{Diagnostics, Severity, Text};
use hsd_base::source::{Limits, Source};
use hsd_ir::ast::Document;

/// The forms of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines of five-column codes.
    Legacy,
    /// XML.
    Xml,
}

impl Form {
    /// Returns the form of a source file: its first character that is not white space decides (docs/contract.md 2).
    pub fn of(source: &Source) -> Form {
        match source.text().trim_start().starts_with(['<', '＜']) {
            true => Form::Xml,
            false => Form::Legacy,
        }
    }

    /// Returns the other form.
    pub fn other(self) -> Form {
        match self {
            Form::Legacy => Form::Xml,
            Form::Xml => Form::Legacy,
        }
    }

    /// Returns the name of the form.
    pub fn name(self) -> Text {
        match self {
            Form::Legacy => say::legacy_form(),
            Form::Xml => say::xml_form(),
        }
    }
}

/// Formats a source file in its own form, with its own line ends. A legacy file must be free of errors, an XML file
/// well-formed; its elements need not be valid.
///
/// # Errors `None` if the meaning of the file is in doubt; `out` receives the reason.
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

/// Passes on errors only: other commands report the rest.
fn pass_on(told: Diagnostics, out: &mut Diagnostics) {
    let errors = told.into_sorted().into_iter();
    errors
        .filter(|d| d.severity == Severity::Error)
        .for_each(|d| out.push(d));
}

/// Returns true if a source file has the same meaning as the document.
fn same(source: &Source, document: &Document, text: &str, limits: &Limits) -> bool {
    if text == source.text() {
        return true;
    }
    // Formatted output may exceed the size limit of a source file.
    let limits = Limits {
        bytes: usize::MAX,
        ..*limits
    };
    let again = Source::new(source.id(), source.name(), &encode(text, source));
    let read = parse::parse(&again, &limits, &mut Diagnostics::new());
    essence(&read) == essence(document)
}

/// Returns the most frequent line end of a source file.
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

/// Replaces the line feeds of a string by other line ends.
fn with_ends(text: String, end: &str) -> String {
    match end {
        "\n" => text,
        end => text.replace('\n', end),
    }
}
