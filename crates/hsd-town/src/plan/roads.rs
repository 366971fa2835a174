//! The roads that the rules of a town make, with their borders: each is laid by itself, and knows the others that it meets.

use crate::shape::Segment;
use hsd_base::geometry::grid::{Bounds, Grid, wider};
use hsd_map::pack::{Packer, Unpacker};
use std::collections::BTreeSet;
use std::io;

/// The number of borders of a road: its side, the inside of its pavement, that of its drain.
pub const BORDERS: usize = 3;

/// How far from the features of a part its roads are kept, metres: more than a road and its surroundings are wide.
const PACKED: f64 = 120.0;

/// The pieces round a feature that are looked at, at most. Of more the nearest count.
const MOST: usize = 4096;

/// The longest stretch of a line that looks round by itself, metres: the box of a long line that runs aslant is nearly empty.
const STRETCH: f64 = 64.0;

/// The number of stretches of a line, at most.
const STRETCHES: f64 = 64.0;

/// The pieces whose boxes are looked at round a stretch, at most. Of more the nearest count.
const LOOKED_AT: usize = 256;

/// The pieces that are beside a stretch, at most. Of more the nearest count.
const BESIDE: usize = 128;

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

/// Returns the stretches of a line that look round by themselves.
fn stretches(line: Segment) -> impl Iterator<Item = Segment> {
    let count = (line.length() / STRETCH).ceil().clamp(1.0, STRETCHES);
    let at = move |n: usize| line.from.lerp(line.to, n as f64 / count);
    (0..count as usize).map(move |n| Segment::new(at(n), at(n + 1)))
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

    /// Returns the pieces whose sides may be within `far` of a box; of very many the nearest.
    pub fn near(&self, bounds: Bounds, far: f64) -> Vec<RoadPiece> {
        let found = self.index.nearest(bounds, far + self.reach, MOST);
        found.iter().map(|n| self.pieces[*n as usize]).collect()
    }

    /// Returns the pieces whose middles are within `far` and the reach of all roads of some lines, each once, in their order.
    /// Where very many meet, those count that are nearest to a stretch of a line.
    pub fn beside(&self, lines: &[Segment], far: f64) -> Vec<RoadPiece> {
        let far = far + self.reach;
        let mut found = BTreeSet::new();
        for stretch in lines.iter().flat_map(|line| stretches(*line)) {
            let near = self.index.nearest(stretch.bounds(), far, LOOKED_AT);
            let off = |n: u32| self.pieces[n as usize].line.distance(stretch);
            let near = near.into_iter().map(|n| (off(n), n));
            let mut near: Vec<(f64, u32)> = near.filter(|(off, _)| *off <= far).collect();
            if near.len() > BESIDE {
                near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                near.truncate(BESIDE);
            }
            found.extend(near.into_iter().map(|(_, n)| n));
        }
        found.iter().map(|n| self.pieces[*n as usize]).collect()
    }

    /// Adds the roads near a box, and how far all reach, so that a part finds what the whole town does.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let pieces = self.index.near(wider(bounds, PACKED + self.reach));
        out.float(self.reach);
        out.count(pieces.len());
        for piece in pieces.iter().map(|n| self.pieces[*n as usize]) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    /// Returns roads from one place in all directions.
    fn star(count: usize) -> Vec<RoadPiece> {
        let way = |n: usize| DVec2::new(libm::cos(n as f64), libm::sin(n as f64)) * 200.0;
        let piece = |n| RoadPiece {
            line: Segment::new(DVec2::ZERO, way(n)),
            half: [2.0; BORDERS],
        };
        (0..count).map(piece).collect()
    }

    #[test]
    fn a_road_looks_at_no_more_others_where_more_meet() {
        for count in [1000, 4000] {
            let pieces = star(count);
            let roads = Roads::new(pieces.clone());
            for piece in pieces.iter().step_by(97) {
                let beside = roads.beside(&[piece.line], 7.0).len();
                assert!(
                    (BESIDE..=4 * BESIDE).contains(&beside),
                    "{beside} of {count}"
                );
            }
        }
    }

    #[test]
    fn a_road_knows_all_others_where_few_meet() {
        let pieces = star(60);
        let roads = Roads::new(pieces.clone());
        assert_eq!(roads.beside(&[pieces[7].line], 7.0).len(), 60);
        assert!(
            roads
                .beside(
                    &[Segment::new(DVec2::splat(900.0), DVec2::splat(950.0))],
                    7.0
                )
                .is_empty()
        );
    }
}
