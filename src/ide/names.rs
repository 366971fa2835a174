//! What is named in a text and where it is used: pieces and their parameters, values, own parts, floors, facades, files.

use super::{Analysis, Place};
use crate::diagnostic::Text;
use crate::source::FileId;
use std::ops::Range;

/// What kind of thing a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolKind {
    /// A `let`, or the `Param` of a house or a file.
    Value,
    /// A parameter of a piece.
    Parameter,
    /// A `define`.
    Piece,
    /// A part: one's own, or one that comes with the program.
    Part,
    /// A picture that a `Texture` names.
    Picture,
    /// A `Floor` by its id.
    Floor,
    /// A `Facade` by its id.
    Facade,
    /// A file that is included.
    File,
}

/// Something with a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it is.
    pub kind: SymbolKind,
    /// Its name; a code with its padding.
    pub name: String,
    /// The name of the file that defines it, and where in its text; `None` = it comes with the program, or nobody
    /// defines it.
    pub defined: Option<(String, Range<usize>)>,
}

/// What is named at an offset.
pub fn symbol_at(a: &Analysis, at: usize) -> Option<Symbol> {
    let _ = (a, at);
    None
}

/// Where what stands at an offset is defined.
pub fn definition(a: &Analysis, at: usize) -> Vec<Place> {
    let _ = (a, at);
    vec![]
}

/// Where what stands at an offset is used, in this text and the files that were read for it.
pub fn references(a: &Analysis, at: usize, with_declaration: bool) -> Vec<Place> {
    let _ = (a, at, with_declaration);
    vec![]
}

/// Where a thing is used that another text may define.
pub fn uses_of(a: &Analysis, symbol: &Symbol) -> Vec<Place> {
    let _ = (a, symbol);
    vec![]
}

/// What a rename at an offset would change, and what it is called now; `None` where nothing can be renamed.
pub fn prepare_rename(a: &Analysis, at: usize) -> Option<(Range<usize>, String)> {
    let _ = (a, at);
    None
}

/// The edits that give what stands at an offset another name.
///
/// # Errors
/// Where the name is none, or means something else already.
pub fn rename(
    a: &Analysis,
    at: usize,
    new: &str,
) -> Result<Vec<(FileId, Range<usize>, String)>, Text> {
    let _ = (a, at, new);
    Err(crate::text!(
        "there is no name here",
        "ここに名はありません"
    ))
}

/// Where what stands at an offset stands in this text, and whether it is defined there.
pub fn highlights(a: &Analysis, at: usize) -> Vec<(Range<usize>, bool)> {
    let _ = (a, at);
    vec![]
}
