//! The table of names: the definitions of the source files of a run, and their uses. It is built once from their
//! outlines, so that it covers branches that are not taken and unused definitions, even in malformed files; editors
//! read it.
//!
//! | file | holds |
//! |---|---|
//! | `resolve` | fills the table |
//! | `table` | symbols with their definitions and uses |
//! | `scopes` | the values and definitions known at each place |
//! | `links` | the files that `include` elements refer to |
//! | `ids` | floors and facades |
//! | `codes` | codes of parts and images |
//! | `file` | source files, and the names in their elements |

pub mod codes;
pub mod file;
mod ids;
mod resolve;
pub mod links;
mod scopes;
pub mod table;

pub use resolve::resolve;
pub use scopes::Definition;

/// The kind of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolKind {
    /// A `let`, or the `Param` of a house or a file.
    Value,
    /// A parameter of a definition.
    Parameter,
    /// A `define`.
    Piece,
    /// A part, custom or built-in.
    Part,
    /// An image that a `Texture` names.
    Picture,
    /// A `Floor` by its id.
    Floor,
    /// A `Facade` by its id.
    Facade,
    /// An included file.
    File,
}
