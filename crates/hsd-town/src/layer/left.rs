//! Features that can be read but are left out before any rule sees them. Their centre is outside their outline, or they are
//! drawn twice.

use super::{Lot, Lots, Shape};
use crate::shape::hull;
use glam::DVec2;
use hsd_base::diagnostic::Code;
use hsd_base::geometry::grid::{bounds, wider};
use std::collections::HashSet;
use twox_hash::XxHash3_128;

/// The distance by which rounding may move the centre of an outline out of its hull, metres.
const ROUNDING: f64 = 0.01;
/// Coordinates that round to the same multiple of this are the same, metres.
const SAME: f64 = 0.001;

/// Fields that differ where one part of a building is above another.
pub(crate) const LEVELS: [&str; 4] = [
    "building:part",
    "min_height",
    "building:min_level",
    "min_level",
];

/// A feature that is left out.
#[derive(Clone, Debug)]
pub struct LeftLot {
    /// The key.
    pub key: Box<str>,
    /// A point of it.
    pub at: DVec2,
    /// The reason.
    pub why: LeftWhy,
}

/// The reason to leave out a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeftWhy {
    /// Another feature before it has the same outline.
    Twice,
    /// The centroid of its ring is outside the hull of this ring: the ring crosses itself.
    Outside,
}

impl LeftWhy {
    /// Returns the code of the diagnostic.
    pub fn code(self) -> Code {
        match self {
            LeftWhy::Twice => Code(1118),
            LeftWhy::Outside => Code(1119),
        }
    }

    /// Returns the reason.
    pub fn reason(self) -> &'static str {
        match self {
            LeftWhy::Twice => "a feature before it has the same outline",
            LeftWhy::Outside => "its centroid is outside its outline, which crosses itself",
        }
    }
}

/// Finds the features of a layer that are left out. They come in their order.
#[derive(Debug)]
pub struct Sieve {
    /// The hashes of the outlines so far; `None` where features may be drawn twice.
    seen: Option<HashSet<u128>>,
}

impl Sieve {
    /// Begins a layer. On outlines with houses nothing may be drawn twice.
    pub fn new(is_housed: bool) -> Sieve {
        Sieve {
            seen: is_housed.then(HashSet::new),
        }
    }

    /// Returns why a feature of a layer is left out; `None` if it is not.
    pub fn refuse(&mut self, layer: &Lots, lot: &Lot) -> Option<LeftWhy> {
        let Shape::Area(ring, holes) = &lot.shape else {
            return None;
        };
        if !is_centre_inside(ring, lot.shape.centre()) {
            return Some(LeftWhy::Outside);
        }
        let seen = self.seen.as_mut()?;
        let level = LEVELS.map(|field| layer.word(lot, field).unwrap_or_default());
        let is_new = seen.insert(outline_hash((ring, holes), lot.z, &level));
        (!is_new).then_some(LeftWhy::Twice)
    }
}

impl Lots {
    /// Leaves out what a sieve refuses.
    pub fn sift(&mut self, sieve: &mut Sieve) {
        let lots = std::mem::take(&mut self.lots).into_iter();
        let mut kept = vec![];
        for lot in lots {
            match sieve.refuse(self, &lot) {
                Some(why) => self.left.push(LeftLot::of(&lot, why)),
                None => kept.push(lot),
            }
        }
        self.lots = kept;
    }
}

impl LeftLot {
    /// Returns a feature that is left out for this reason.
    pub fn of(lot: &Lot, why: LeftWhy) -> LeftLot {
        let ring = lot.shape.ring().unwrap_or_default();
        LeftLot {
            key: lot.key.clone(),
            at: ring.first().copied().unwrap_or_default(),
            why,
        }
    }
}

/// Returns true if the centre of a ring is in its convex hull.
fn is_centre_inside(ring: &[DVec2], centre: DVec2) -> bool {
    let Some(around) = bounds(ring.iter().copied()) else {
        return true;
    };
    let [low, high] = wider(around, ROUNDING);
    low.cmple(centre).all() && centre.cmple(high).all() && {
        let hull = hull(ring);
        let sides = crate::shape::sides(&hull);
        let mut sides = sides.filter(|side| side.length() > 0.0);
        hull.len() < 3 || sides.all(|side| (centre - side.from).dot(side.normal()) <= ROUNDING)
    }
}

/// Returns the hash of an outline: the same wherever its rings begin.
fn outline_hash((ring, holes): (&[DVec2], &[Vec<DVec2>]), z: f64, level: &[String]) -> u128 {
    let mut all: Vec<Vec<[i64; 2]>> = holes.iter().map(|hole| from_least(hole)).collect();
    all.sort();
    all.insert(0, from_least(ring));
    let mut hasher = XxHash3_128::new();
    hasher.write(&((z / SAME).round() as i64).to_le_bytes());
    for text in level {
        hasher.write(&text.len().to_le_bytes());
        hasher.write(text.as_bytes());
    }
    for ring in all {
        hasher.write(&ring.len().to_le_bytes());
        for x in ring.into_iter().flatten() {
            hasher.write(&x.to_le_bytes());
        }
    }
    hasher.finish_128()
}

/// Returns the corners of a ring in whole units, from the least one on.
fn from_least(ring: &[DVec2]) -> Vec<[i64; 2]> {
    let unit = |x: f64| (x / SAME).round() as i64;
    let mut corners: Vec<[i64; 2]> = ring.iter().map(|p| [unit(p.x), unit(p.y)]).collect();
    let least = corners
        .iter()
        .enumerate()
        .min_by_key(|(_, corner)| **corner);
    let first = least.map_or(0, |(n, _)| n);
    corners.rotate_left(first);
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|(x, y)| dvec2(*x, *y)).collect()
    }

    #[test]
    fn an_outline_is_the_same_wherever_it_begins() {
        let one = ring(&[(0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0)]);
        let mut other = one.clone();
        other.rotate_left(2);
        let hash = |ring: &[DVec2], z, level: &str| outline_hash((ring, &[]), z, &[level.into()]);
        assert_eq!(hash(&one, 0.0, ""), hash(&other, 0.0, ""));
        other[0].x += 0.1;
        assert_ne!(hash(&one, 0.0, ""), hash(&other, 0.0, ""));
        assert_ne!(hash(&one, 0.0, ""), hash(&one, 3.0, ""));
        assert_ne!(hash(&one, 0.0, ""), hash(&one, 0.0, "yes"));
    }

    #[test]
    fn the_centre_of_a_bow_tie_is_elsewhere() {
        let square = ring(&[(0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0)]);
        assert!(is_centre_inside(&square, crate::shape::centroid(&square)));
        let tie = ring(&[(20.0, 0.0), (30.0, 8.0), (30.0, 0.0), (20.0, 8.001)]);
        assert!(!is_centre_inside(&tie, crate::shape::centroid(&tie)));
        // Inside the box of the ring, outside its hull.
        let corner = ring(&[(0.0, 0.0), (8.0, 0.0), (0.0, 5.0)]);
        assert!(!is_centre_inside(&corner, dvec2(7.0, 4.0)));
    }
}
