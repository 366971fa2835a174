//! Corridors (回廊 kairo): wings of one bay that go round a court mitre where they meet at a corner. The ridge turns with
//! them, a hip runs to the outer corner and a valley to the inner one. Free ends and ends at gates keep their gables.
//!
//! A corner is that of a corridor if its wings are equally wide, at most [`WIDEST`], and each is at least [`SLENDER`]
//! times as long as wide, corners included. Where the author gives the roofs a shape, that shape decides.

use crate::frame::{end_sides, near_side};
use crate::region::{Region, Side};
use crate::shape::end::{Cap, End};
use crate::storey::automatic::Automatic;
use hsd_base::geometry::plan::Cell;
use hsd_ir::ast::RoofShape;

/// The widest corridor, metres: one bay of up to 13 shaku.
const WIDEST: f64 = 4.0;
/// How many times as long as wide each of its wings is at least.
const SLENDER: f64 = 4.0;

impl Automatic<'_, '_> {
    /// Returns the end of roof `n` at `side`: a hip if a corridor turns there, otherwise as given.
    pub(crate) fn mitred(&self, n: usize, side: Side, end: End) -> End {
        if !end.wall || end.reach > 0.0 || !self.is_mitred(n, side) {
            return end;
        }
        let run = self.context.metres(self.regions[n].span()) / 2.0;
        End {
            cap: Cap::Hip { run },
            ..end
        }
    }

    /// Returns true if a corridor turns the corner at the end `side` of region `n`.
    fn is_mitred(&self, n: usize, side: Side) -> bool {
        let region = &self.regions[n];
        let Some(near) = region.ridge.map(near_side).filter(|_| self.is_corridor(n)) else {
            return false;
        };
        let Some(sides) = &self.sides else {
            return false;
        };
        let corner = square_at(region, side);
        [near, near.opposite()].into_iter().any(|flank| {
            let wing = sides.beyond(&corner, flank);
            wing.is_some_and(|m| self.turns_into(n, m, flank))
        })
    }

    /// Returns true if region `m` continues the corridor `n` round the corner beyond its side `flank`.
    fn turns_into(&self, n: usize, m: usize, flank: Side) -> bool {
        let (own, wing) = (&self.regions[n], &self.regions[m]);
        let runs_in = wing.ridge == Some(flank.ridge_into()) && wing.span() == own.span();
        m < self.own_regions().len() && runs_in && self.is_corridor(m)
    }

    /// Returns true if a region is long and narrow, and no shape is asked for.
    fn is_corridor(&self, n: usize) -> bool {
        let region = &self.regions[n];
        let Some(ridge) = region.ridge else {
            return false;
        };
        let width = self.context.metres(region.span());
        let [first, last] = end_sides(near_side(ridge));
        let length = near_side(ridge).measure(&region.cell).0;
        // A wing between two others reaches to their outer walls.
        let corners = [first, last]
            .into_iter()
            .filter(|s| self.ends_in_wing(n, *s));
        let length = self.context.metres(length) + width * corners.count() as f64;
        let plain = self.context.corridors && self.context.style.shape.is_none();
        let plain = plain && self.looks[n].shape == RoofShape::Gable;
        plain && width <= WIDEST && length >= SLENDER * width
    }

    /// Returns true if a region ends at the flank of another that is as wide.
    fn ends_in_wing(&self, n: usize, side: Side) -> bool {
        let sides = self.sides.as_ref();
        let Some(other) = sides.and_then(|s| s.beyond(&self.regions[n].cell, side)) else {
            return false;
        };
        let other = &self.regions[other];
        other.ridge.is_some_and(|r| r != side.ridge_into())
            && other.span() == self.regions[n].span()
    }
}

/// Returns the square at an end of a region.
fn square_at(region: &Region, side: Side) -> Cell {
    let (cell, span) = (region.cell, region.span());
    match side {
        Side::Front => Cell {
            b1: cell.b0 + span,
            ..cell
        },
        Side::Back => Cell {
            b0: cell.b1 - span,
            ..cell
        },
        Side::Left => Cell {
            a0: cell.a1 - span,
            ..cell
        },
        Side::Right => Cell {
            a1: cell.a0 + span,
            ..cell
        },
    }
}
