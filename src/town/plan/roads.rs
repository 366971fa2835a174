//! The roads that the rules of a town make, with their borders: each is laid by itself, and knows the others that it meets.

use crate::town::grid::{Bounds, Grid, wider};
use crate::town::shape::Segment;

/// The number of borders of a road: its side, the inside of its pavement, that of its drain.
pub const BORDERS: usize = 3;

/// A straight piece of a road.
#[derive(Clone, Copy, Debug)]
pub struct RoadPiece {
    /// Its middle.
    pub line: Segment,
    /// The distance of its borders from the middle, from the outside inwards, metres.
    pub half: [f64; BORDERS],
}

/// All roads of a town.
#[derive(Debug, Default)]
pub struct Roads {
    pieces: Vec<RoadPiece>,
    index: Grid,
    reach: f64,
}

impl Roads {
    /// Collects pieces.
    pub fn new(pieces: Vec<RoadPiece>) -> Roads {
        let reach = pieces.iter().map(|piece| piece.half[0]).fold(0.0, f64::max);
        let boxes = pieces.iter().map(|piece| piece.line.bounds()).collect();
        Roads {
            index: Grid::new(boxes),
            pieces,
            reach,
        }
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Returns the pieces whose sides may be within `far` of a box.
    pub fn near(&self, bounds: Bounds, far: f64) -> impl Iterator<Item = RoadPiece> + '_ {
        let found = self.index.near(wider(bounds, far + self.reach));
        found.into_iter().map(|n| self.pieces[n as usize])
    }
}
