//! The items of a wall line.

use super::Item;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// An item of a wall line. Files hold hundreds of thousands of codes, so a code takes as little memory as possible, and
/// rare items are boxed.
#[derive(Clone, Debug, Serialize)]
pub enum Piece {
    /// A code of five columns without attributes; its span may be shorter.
    Code(#[serde(serialize_with = "as_text")] [u8; 5], Span),
    /// A part with a name of another length, a width or a height.
    Part(Box<Part>),
    /// A part of one storey divided into an upper and a lower half (003-09).
    Split(Box<Split>),
    /// A unit that could not be read and was reported: it counts as 1 U without a shape.
    Error(Span),
}

impl Piece {
    /// Creates an item for a code without attributes.
    pub fn new(code: CodeText, span: Span) -> Piece {
        match code {
            CodeText::Five(five) => Piece::Code(five, span),
            name => Piece::Part(Box::new(Part {
                code: Spanned::new(name, span),
                width: None,
                height: None,
            })),
        }
    }

    /// Returns its code, if it has one.
    pub fn code(&self) -> Option<Spanned<CodeText>> {
        match self {
            Piece::Code(five, span) => Some(Spanned::new(CodeText::Five(*five), *span)),
            Piece::Part(part) => Some(part.code.clone()),
            Piece::Split(_) | Piece::Error(_) => None,
        }
    }
}

fn as_text<S: serde::Serializer>(five: &[u8; 5], s: S) -> Result<S::Ok, S::Error> {
    CodeText::Five(*five).serialize(s)
}

/// A code with the attributes of this use of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// The code as written, with its span. Shorter than 5 columns if blanks were lost.
    pub code: Spanned<CodeText>,
    /// Width in U instead of the catalogue's.
    pub width: Option<Spanned<f64>>,
    /// Height in shaku instead of the storey's.
    pub height: Option<Spanned<f64>>,
}

/// `<split ratio="0.5"><upper/><lower/></split>`.
#[derive(Clone, Debug, Serialize)]
pub struct Split {
    /// The start tag.
    pub span: Span,
    /// Share of the height that the upper half takes, 0 to 1.
    pub ratio: Option<Spanned<f64>>,
    /// Above.
    pub upper: Half,
    /// Below.
    pub lower: Half,
}

/// One half of a split.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Half {
    /// The element.
    pub span: Span,
    /// From right to left as seen from outside.
    pub pieces: Vec<Item<Piece>>,
}

/// The text of a code: up to five bytes in place, since files hold hundreds of thousands of them.
#[derive(Clone, PartialEq, Eq, Hash)]
pub enum CodeText {
    /// A code of the catalogue's form, padded with blanks.
    Five([u8; 5]),
    /// A name of any other length: a custom part or a part image.
    Name(Box<str>),
}

impl CodeText {
    /// Converts a string: ASCII of at most five bytes is padded to a code; everything else is a name.
    pub fn new(text: &str) -> CodeText {
        if text.len() > 5 || !text.is_ascii() {
            return CodeText::Name(text.into());
        }
        let mut five = [b' '; 5];
        five[..text.len()].copy_from_slice(text.as_bytes());
        CodeText::Five(five)
    }

    /// Returns the string, with its padding.
    pub fn as_str(&self) -> &str {
        match self {
            CodeText::Five(five) => std::str::from_utf8(five).unwrap_or_default(),
            CodeText::Name(name) => name,
        }
    }
}

impl std::fmt::Debug for CodeText {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.as_str())
    }
}

impl Serialize for CodeText {
    fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self.as_str())
    }
}
