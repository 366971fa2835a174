//! The table of names: what the source files of a run define, and where it is used. It is made once from their outlines,
//! so that it covers branches that are not taken and pieces that nothing uses, even in broken files; editors read it.
//!
//! | file | holds |
//! |---|---|
//! | `resolve` | fills the table |
//! | `table` | symbols with their definitions and uses |
//! | `scopes` | which values and pieces are known where |
//! | `links` | which `include` leads to which file |
//! | `ids` | floors and facades |
//! | `codes` | codes of parts and images |
//! | `file` | source files, and what their elements name |

pub(crate) mod codes;
pub(crate) mod file;
mod ids;
mod resolve;
pub(crate) mod links;
mod scopes;
pub(crate) mod table;

pub(crate) use resolve::resolve;
pub(crate) use scopes::Definition;

/// The kind of thing that a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolKind {
    /// A `let`, or the `Param` of a house or a file.
    Value,
    /// A parameter of a piece.
    Parameter,
    /// A `define`.
    Piece,
    /// A part: a custom one, or one that comes with the program.
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
