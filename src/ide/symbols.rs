//! What a text consists of, as a tree: houses, storeys, rows and roofs, and what it defines.

use super::Analysis;
use std::ops::Range;

/// What kind of thing a symbol is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A house, or several of them.
    House,
    /// A storey, or the floor of a facade.
    Storey,
    /// A wall line.
    Row,
    /// A walk of its own.
    Loop,
    /// A facade.
    Facade,
    /// The roofs of a house, or one of them.
    Roof,
    /// A named piece.
    Piece,
    /// A `Param`.
    Parameter,
    /// A `let`.
    Value,
    /// An own part.
    Part,
    /// A file that is included.
    File,
    /// Anything else that stands at a house.
    Fitting,
}

/// A thing in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it is called.
    pub name: String,
    /// What else there is to say of it, in short.
    pub detail: String,
    /// What it is.
    pub kind: SymbolKind,
    /// All of it.
    pub range: Range<usize>,
    /// Its name, or what stands for that; within `range`.
    pub selection: Range<usize>,
    /// What it consists of, in the order of the text.
    pub children: Vec<Symbol>,
}

/// What stands in a text.
pub fn symbols(a: &Analysis) -> Vec<Symbol> {
    let _ = a;
    vec![]
}
