//! Outlines as surveyed: rings of points in metres that are nearly at right angles, to rings that roofs can divide
//! (docs/contract.md 8).
//!
//! - [`clean`]: doubled points, spikes and needless corners;
//! - [`square`]: rings that are nearly at right angles, along two axes;
//! - [`join`]: lines that nearly agree become one.
//!
//! Frame: metres, x and y in either sense; all is exact in the sense that a wall of a squared ring is parallel to its axis
//! to the last bit.

pub mod clean;
pub mod join;
pub mod square;

pub use square::{Axis, Crooked, Squared};

use glam::DVec2;

/// A side of a ring; it ends where the next one begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Where it begins.
    pub from: DVec2,
    /// The index of the point, as surveyed, where it begins.
    pub corner: usize,
    /// The index of the side, as surveyed, or of the longest of those that it unites.
    pub number: usize,
    /// What stands on it; sides in line unite only if they agree in it.
    pub mark: u32,
}

/// The sides of a closed ring, in order.
pub type Ring = Vec<Side>;

/// Returns the corners of a ring.
pub fn corners(ring: &[Side]) -> Vec<DVec2> {
    ring.iter().map(|side| side.from).collect()
}

/// Returns the ends of a side.
pub fn ends(ring: &[Side], side: usize) -> (DVec2, DVec2) {
    (ring[side].from, ring[(side + 1) % ring.len()].from)
}

/// Sides that are compared in pairs; rings of more are left to the check of all walls of a storey.
const MOST_SIDES: usize = 3000;

/// Returns true if no sides cross or touch but at the corner that they share.
pub fn are_simple(rings: &[Ring]) -> bool {
    let sides = rings.iter().flat_map(|ring| {
        let count = ring.len();
        (0..count).map(move |side| (ends(ring, side), ring.as_ptr(), side, count))
    });
    let sides: Vec<_> = sides.collect();
    if sides.len() > MOST_SIDES {
        return true;
    }
    let apart = |one: (DVec2, DVec2), two: (DVec2, DVec2)| {
        let (low, high) = (one.0.min(one.1), one.0.max(one.1));
        let (from, to) = (two.0.min(two.1), two.0.max(two.1));
        high.cmplt(from).any() || to.cmplt(low).any()
    };
    sides
        .iter()
        .enumerate()
        .all(|(n, (one, ring, side, count))| {
            sides[n + 1..].iter().all(|(two, other, next, _)| {
                let beside = ring == other && (next - side == 1 || next - side == count - 1);
                match beside {
                    true => !turns_back(*one, *two),
                    false => apart(*one, *two) || !meet(*one, *two),
                }
            })
        })
}

/// Returns true if two neighbours lie on each other.
fn turns_back(one: (DVec2, DVec2), two: (DVec2, DVec2)) -> bool {
    let (p, q) = (one.1 - one.0, two.1 - two.0);
    p.perp_dot(q) == 0.0 && p.dot(q) <= 0.0
}

fn meet(one: (DVec2, DVec2), two: (DVec2, DVec2)) -> bool {
    let side = |(p, q): (DVec2, DVec2), r: DVec2| (q - p).perp_dot(r - p);
    let divides = |line, (p, q)| side(line, p) * side(line, q) <= 0.0;
    divides(one, two) && divides(two, one)
}
