//! The roads that the rules of a town make, with their borders: each is laid by itself, and knows the others that it meets.

use crate::grid::{Bounds, Grid, wider};
use crate::shape::Segment;
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// The number of borders of a road: its side, the inside of its pavement, that of its drain.
pub const BORDERS: usize = 3;

/// How far from the features of a part its roads are kept, metres: more than a road and its surroundings are wide.
const PACKED: f64 = 120.0;

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

    /// Adds the roads near a box, and how far all reach, so that a part finds what the whole town does.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let pieces: Vec<RoadPiece> = self.near(bounds, PACKED).collect();
        out.float(self.reach);
        out.count(pieces.len());
        for piece in pieces {
            out.point(piece.line.from);
            out.point(piece.line.to);
            piece.half.into_iter().for_each(|half| out.float(half));
        }
    }

    /// Takes roads from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Roads> {
        let reach = from.float()?;
        let pieces = (0..from.count()?).map(|_| {
            let line = Segment::new(from.point()?, from.point()?);
            let mut half = [0.0; BORDERS];
            for border in &mut half {
                *border = from.float()?;
            }
            Ok(RoadPiece { line, half })
        });
        let pieces = pieces.collect::<io::Result<Vec<RoadPiece>>>()?;
        Ok(Roads {
            reach,
            ..Roads::new(pieces)
        })
    }
}
