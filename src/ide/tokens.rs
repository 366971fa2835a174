//! What each word of a text is, for colours that know the language.

use super::Analysis;
use std::ops::Range;

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TokenKind {
    /// For human readers.
    Comment,
    /// A word of the language: a setting of the legacy form, a covering, a shape; `and`, `yes` in expressions.
    Keyword,
    /// The name of an element (LSP `type`).
    Element,
    /// The name of an attribute (LSP `property`).
    Attribute,
    /// A value that is a text.
    String,
    /// A number.
    Number,
    /// The code of a part (LSP `enumMember`).
    Code,
    /// A parameter of a piece.
    Parameter,
    /// A name in an expression, of a `let` or a `Param` (LSP `variable`).
    Variable,
    /// A piece, or a function of an expression (LSP `function`).
    Function,
    /// A turn, the end of a storey or a house, a sign in an expression.
    Operator,
}

/// What else is to be said of a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// It is named here.
    pub declaration: bool,
    /// It comes with the program.
    pub default_library: bool,
    /// It is one's own part.
    pub own: bool,
    /// Nobody knows it.
    pub unknown: bool,
}

/// A word; it stands on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Where.
    pub range: Range<usize>,
    /// What it is.
    pub kind: TokenKind,
    /// More of it.
    pub modifiers: Modifiers,
}

/// The words of a text in their order; none overlaps another.
pub fn tokens(a: &Analysis) -> Vec<Token> {
    let _ = a;
    vec![]
}
