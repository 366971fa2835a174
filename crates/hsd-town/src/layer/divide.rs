//! Areas divided into blocks, streets and plots (contract 5): a quarter that is too deep is cut by streets, each block that
//! remains is laid out in plots along its sides, and what no plot takes is the yard in its middle (kaisho-chi).
//!
//! A quarter is cut along and across its main direction, the one that its sides agree on best. Blocks are laid out side by
//! side, the longest first: its plots are as wide as nearly as a whole number allows, and as deep as wanted or half the way
//! to the opposite side. So the long sides take the corners, and the ends of a block get what is left, as they did in Edo.

mod cut;
mod plots;
mod split;

pub use split::Piece;

use hsd_ir::ast::town::Division;

/// What an area has been divided into.
#[derive(Clone, Debug, Default)]
pub struct Divided {
    /// The blocks between the streets.
    pub blocks: Vec<Piece>,
    /// The streets between the blocks.
    pub streets: Vec<Piece>,
    /// The plots. The ring of each begins with its front.
    pub plots: Vec<Piece>,
    /// The ground that belongs to no plot.
    pub yards: Vec<Piece>,
}

/// Divides an area.
pub fn divide(area: &Piece, division: &Division) -> Divided {
    let (blocks, streets) = cut::cut(area, division);
    let mut divided = Divided {
        streets,
        ..Divided::default()
    };
    for block in &blocks {
        let (plots, yards) = plots::plots(block, division);
        divided.plots.extend(plots);
        divided.yards.extend(yards);
    }
    divided.blocks = blocks;
    divided
}
