//! Prepares an outline with courts for a skeleton, or returns the reason why it has none.

use super::line::EdgeLine;
use super::pairs::{Segment, distance, near_pairs};
use super::{Face, Skeleton};
use glam::{DVec2, dvec2};
use hsd_base::geometry::tolerance::POINT;

/// Corners nearer to each other become one, metres.
const ONE: f64 = 0.005;
/// A corner is left out if it lies nearer to the line between its neighbours, metres.
const STRAIGHT: f64 = 0.001;
/// The least area of an outline or of a court, square metres.
const LEAST_AREA: f64 = 1e-3;
/// Maximum distance of corners from the middle, metres.
const FARTHEST: f64 = 100_000.0;
/// Maximum number of corners.
const MOST_CORNERS: usize = 4000;

/// The reason why an outline has no roof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Invalid {
    /// Fewer than three distinct corners.
    TooFewCorners,
    /// It bounds no area.
    NoArea,
    /// A coordinate is not a number or farther away than any plan is wide.
    TooFar,
    /// It has too many corners.
    TooManyCorners,
    /// It crosses or touches itself or a court here.
    Crosses {
        /// The place.
        at: DVec2,
    },
    /// A court lies outside the outline or inside another court.
    CourtOutside {
        /// A corner of it.
        at: DVec2,
    },
    /// No skeleton passed the checks.
    NotFound,
}

impl std::fmt::Display for Invalid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Invalid::TooFewCorners => write!(f, "the outline has fewer than three corners"),
            Invalid::NoArea => write!(f, "the outline bounds no area"),
            Invalid::TooFar => write!(f, "a corner of the outline lies too far away"),
            Invalid::TooManyCorners => write!(f, "the outline has too many corners"),
            Invalid::Crosses { at } => {
                write!(
                    f,
                    "the outline crosses or touches itself at {:.2} {:.2} m",
                    at.x, at.y
                )
            }
            Invalid::CourtOutside { at } => {
                write!(
                    f,
                    "the court at {:.2} {:.2} m lies outside the outline",
                    at.x, at.y
                )
            }
            Invalid::NotFound => write!(f, "the outline is too intricate"),
        }
    }
}

/// A corner and the caller's tag of the edge that starts there.
pub type Start = (DVec2, u32);

/// A simple outline with its courts, ready to be swept.
#[derive(Clone, Debug, PartialEq)]
pub struct Contours {
    /// The offset added to coordinates: the plan is computed about its centre.
    origin: DVec2,
    /// The outline counter-clockwise, then courts clockwise.
    pub(super) rings: Vec<Vec<Start>>,
    /// Half the longer side of its bounding box, metres.
    pub(super) size: f64,
}

impl Contours {
    /// Prepares an outline and its courts, either way round, metres. Corners at one place, spikes and dents below a
    /// millimetre are left out; edges in one line with different tags stay apart.
    ///
    /// # Errors
    /// The reason why it is not a simple polygon.
    pub fn new(outline: &[Start], courts: &[Vec<Start>]) -> Result<Contours, Invalid> {
        let all = || outline.iter().chain(courts.iter().flatten()).map(|s| s.0);
        if all().count() > MOST_CORNERS {
            return Err(Invalid::TooManyCorners);
        }
        let lo = all().fold(DVec2::MAX, DVec2::min);
        let hi = all().fold(DVec2::MIN, DVec2::max);
        let (origin, size) = ((lo + hi) / 2.0, (hi - lo).max_element() / 2.0);
        if !all().all(DVec2::is_finite) || !origin.is_finite() || size.is_nan() || size > FARTHEST {
            return Err(if outline.len() < 3 {
                Invalid::TooFewCorners
            } else {
                Invalid::TooFar
            });
        }
        let rings = |dent: f64| -> Result<Contours, Invalid> {
            let mut rings = vec![ring(outline, origin, 1.0, dent)?];
            for court in courts {
                // A court without area is ignored.
                rings.extend(ring(court, origin, -1.0, dent).ok());
            }
            let contours = Contours {
                origin,
                rings,
                size,
            };
            contours.check()?;
            Ok(contours)
        };
        // Removing dents may make edges meet that only just pass each other.
        rings(STRAIGHT).or_else(|_| rings(1e-9))
    }

    /// Returns the number of edges.
    pub fn edges(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Returns the area inside, square metres.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|r| area2(r) / 2.0).sum()
    }

    /// Returns every edge: its ends, its tag, and the number of the one before it.
    pub(super) fn each(&self) -> impl Iterator<Item = (Segment, u32, u32)> + '_ {
        let mut first = 0;
        self.rings.iter().flat_map(move |ring| {
            let (n, start) = (ring.len(), first);
            first += n;
            (0..n).map(move |i| {
                let ends = [ring[i].0, ring[(i + 1) % n].0];
                (ends, ring[i].1, (start + (i + n - 1) % n) as u32)
            })
        })
    }

    /// Returns the same contours with slightly moved corners, differently for each attempt but the first.
    pub(super) fn shaken(&self, attempt: u32) -> Contours {
        let mut moved = self.clone();
        if attempt == 0 {
            return moved;
        }
        let reach = 1e-6 * f64::from(attempt) * self.size.clamp(1.0, 50.0);
        let mut state = u64::from(attempt);
        let mut next = || {
            // splitmix64
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for (at, _) in moved.rings.iter_mut().flatten() {
            *at += reach * dvec2(next(), next());
        }
        moved
    }

    /// Moves a skeleton of these contours back to the place of the outline.
    pub(super) fn back(&self, mut skeleton: Skeleton) -> Skeleton {
        let moved = |face: &mut Face| face.line = face.line.moved(self.origin);
        skeleton.nodes.iter_mut().for_each(|n| n.at += self.origin);
        skeleton.faces.iter_mut().for_each(moved);
        skeleton
    }

    /// Returns an error if edges cross or touch, or if a court lies outside the outer ring or in another court.
    fn check(&self) -> Result<(), Invalid> {
        let edges: Vec<(Segment, u32, u32)> = self.each().collect();
        let segments: Vec<Segment> = edges.iter().map(|e| e.0).collect();
        let mut bad = None;
        near_pairs(&segments, POINT, |i, j| {
            let follows = edges[j].2 as usize == i || edges[i].2 as usize == j;
            if !follows && distance(segments[i], segments[j]) < POINT {
                bad = Some(self.origin + meeting(segments[i], segments[j]));
            }
            bad.is_some()
        });
        if let Some(at) = bad {
            return Err(Invalid::Crosses { at });
        }
        for (n, court) in self.rings.iter().enumerate().skip(1) {
            let p = court[0].0;
            let around = |ring: &Vec<Start>| surrounds(ring, p);
            let others = self.rings.iter().enumerate().skip(1);
            let nested = others
                .filter(|(k, _)| *k != n)
                .any(|(_, ring)| around(ring));
            if nested || !around(&self.rings[0]) {
                return Err(Invalid::CourtOutside {
                    at: self.origin + p,
                });
            }
        }
        Ok(())
    }
}

/// Returns the approximate meeting point of two segments.
fn meeting([p, q]: Segment, [r, s]: Segment) -> DVec2 {
    let (way, other) = (q - p, s - r);
    let share = (r - p).perp_dot(other) / way.perp_dot(other);
    if share.is_finite() {
        p + way * share.clamp(0.0, 1.0)
    } else {
        p.max(r)
    }
}

/// Returns true if a ring surrounds a point (even-odd).
fn surrounds(ring: &[Start], p: DVec2) -> bool {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .fold(false, |inside, ((q, _), (r, _))| {
            let spans = (q.y <= p.y) != (r.y <= p.y);
            inside != (spans && p.x < q.x + (p.y - q.y) / (r.y - q.y) * (r.x - q.x))
        })
}

/// Returns twice the signed area.
fn area2(ring: &[Start]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(p, q)| p.0.perp_dot(q.0)).sum()
}

/// Returns one ring about the origin, in the given orientation, without redundant corners.
fn ring(corners: &[Start], origin: DVec2, turn: f64, dent: f64) -> Result<Vec<Start>, Invalid> {
    let mut ring: Vec<Start> = corners.iter().map(|(p, tag)| (*p - origin, *tag)).collect();
    if area2(&ring) * turn < 0.0 {
        // The edge that started at a corner now ends there.
        ring.reverse();
        let tags: Vec<u32> = ring.iter().map(|s| s.1).collect();
        let n = tags.len();
        (0..n).for_each(|i| ring[i].1 = tags[(i + 1) % n]);
    }
    loop {
        let before = ring.len();
        one_place(&mut ring);
        dents(&mut ring, dent);
        if ring.len() == before || ring.len() < 3 {
            break;
        }
    }
    match ring.len() {
        0..3 => Err(Invalid::TooFewCorners),
        _ if area2(&ring) * turn < 2.0 * LEAST_AREA => Err(Invalid::NoArea),
        _ => Ok(ring),
    }
}

/// Merges corners at one place.
fn one_place(ring: &mut Vec<Start>) {
    let mut kept: Vec<Start> = Vec::with_capacity(ring.len());
    for start in ring.drain(..) {
        match kept.last_mut() {
            // The short edge is lost, the next one starts here.
            Some(last) if last.0.distance(start.0) < ONE => last.1 = start.1,
            _ => kept.push(start),
        }
    }
    while kept.len() > 1 && kept[0].0.distance(kept[kept.len() - 1].0) < ONE {
        kept.pop();
    }
    *ring = kept;
}

/// Removes corners in mid-edge, those that project by less than `dent`, and spikes without area.
fn dents(ring: &mut Vec<Start>, dent: f64) {
    let mut kept: Vec<Start> = Vec::with_capacity(ring.len());
    let n = ring.len();
    // Corners removed since the last kept one must stay near the new edge as well.
    let mut skipped: Vec<DVec2> = vec![];
    for i in 0..n {
        let (p, (q, tag), r) = (
            kept.last().copied().unwrap_or(ring[n - 1]),
            ring[i],
            ring[(i + 1) % n].0,
        );
        let (way, back) = (q - p.0, r - q);
        let off = |s: &DVec2| (r - p.0).normalize_or_zero().perp_dot(*s - p.0).abs();
        let spike =
            way.dot(back) < 0.0 && way.perp_dot(back).abs() < 1e-6 * way.length() * back.length();
        let straight = p.1 == tag
            && way.dot(back) > 0.0
            && off(&q) < dent
            && skipped.iter().all(|s| off(s) < dent);
        if straight || spike {
            skipped.push(q);
        } else {
            skipped.clear();
            kept.push((q, tag));
        }
    }
    *ring = kept;
}

/// Returns the lines of all edges.
pub(super) fn lines(contours: &Contours) -> Vec<EdgeLine> {
    contours
        .each()
        .map(|([p, q], ..)| EdgeLine::through(p, q))
        .collect()
}
