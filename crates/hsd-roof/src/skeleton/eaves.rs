//! The overhangs of a hipped roof's slopes, and the points where neighbouring slopes meet outside the walls.
//!
//! Slopes continue in their own planes, hips and valleys in their own lines. Very sharp corners are cut off two overhangs
//! from the wall. Where eaves of one roof would touch each other, in a narrow court or notch, those of both sides are
//! shortened step by step until they do not.

use crate::skeleton::line::EdgeLine;
use crate::skeleton::pairs::{Segment, distance, near_pairs};
use crate::skeleton::wave::velocity;
use crate::skeleton::{Face, Skeleton};
use glam::DVec2;
use hsd_base::geometry::tolerance::POINT;

/// Eaves reach out from a corner by at most this many overhangs.
const SPIKE: f64 = 2.0;
/// The gap kept between eaves across a court, metres.
const GAP: f64 = 0.04;
/// The share of an overhang that remains after one step.
const STEP: f64 = 0.88;
/// After this many steps, eaves that still touch get no overhang.
const MOST_STEPS: u32 = 30;
/// The least length of an eaves edge, metres.
const LEAST: f64 = 1e-3;

/// The ends of the slopes on both sides of a corner. Each path begins on the line both share, the hip or valley.
#[derive(Clone, Debug, Default)]
struct Corner {
    /// On the side of the edge that ends here.
    before: Vec<DVec2>,
    /// On the side of the edge that starts here.
    after: Vec<DVec2>,
}

/// The lower ends of the slopes: for each face the points that replace the ends of its edge.
pub(crate) struct Eaves {
    corners: Vec<Corner>,
    /// For each face the face after it.
    next: Vec<usize>,
}

impl Eaves {
    /// Returns the eaves of a skeleton's faces with a requested overhang for each, metres.
    pub(crate) fn of(skeleton: &Skeleton, wished: &[f64]) -> Eaves {
        let faces = &skeleton.faces;
        let mut next = vec![0; faces.len()];
        for (i, face) in faces.iter().enumerate() {
            next[face.before as usize] = i;
        }
        let mut over = wished.to_vec();
        for step in 0..2 * MOST_STEPS {
            if step + 1 == 2 * MOST_STEPS {
                over.fill(0.0);
            }
            let corners = (0..faces.len())
                .map(|i| corner(skeleton, i, &over))
                .collect();
            let eaves = Eaves {
                corners,
                next: next.clone(),
            };
            let touching = eaves.touching(faces, &over);
            if touching.is_empty() {
                return eaves;
            }
            let left = if step < MOST_STEPS { STEP } else { 0.0 };
            touching.iter().for_each(|i| over[*i] *= left);
        }
        Eaves {
            corners: vec![Corner::default(); faces.len()],
            next,
        }
    }

    /// Returns the lower end of a face from its first hip or valley to its second.
    pub(crate) fn run(&self, face: usize) -> impl Iterator<Item = DVec2> + '_ {
        let (from, to) = (
            &self.corners[face].after,
            &self.corners[self.next[face]].before,
        );
        from.iter().chain(to.iter().rev()).copied()
    }

    /// Returns the faces whose eaves touch others or are reversed, each once.
    fn touching(&self, faces: &[Face], over: &[f64]) -> Vec<usize> {
        let mut bad = vec![false; faces.len()];
        let mut segments: Vec<Segment> = Vec::with_capacity(faces.len() + 8);
        let mut owners: Vec<usize> = Vec::with_capacity(faces.len() + 8);
        for (i, face) in faces.iter().enumerate() {
            let run: Vec<DVec2> = self.run(i).collect();
            segments.extend(run.windows(2).map(|w| [w[0], w[1]]));
            owners.resize(segments.len(), i);
            let (from, to) = (&self.corners[i].after, &self.corners[self.next[i]].before);
            let ends = (from.last(), to.last());
            let length = ends
                .0
                .zip(ends.1)
                .map_or(0.0, |(p, q)| face.line.way().dot(*q - *p));
            if length < LEAST && over.iter().any(|o| *o > 0.0) {
                for k in [face.before as usize, i, self.next[i]] {
                    bad[k] = over[k] > 0.0;
                }
            }
        }
        near_pairs(&segments, GAP, |s, t| {
            let (i, j) = (owners[s], owners[t]);
            let open = over[i] > 0.0 || over[j] > 0.0;
            // Walls that are near each other do not concern the eaves.
            if open && self.touch(faces, [i, j], segments[s], segments[t]) {
                bad[i] |= over[i] > 0.0;
                bad[j] |= over[j] > 0.0;
            }
            false
        });
        (0..faces.len()).filter(|i| bad[*i]).collect()
    }

    fn touch(&self, faces: &[Face], [i, j]: [usize; 2], s: Segment, t: Segment) -> bool {
        let ends = [s[0] == t[0], s[0] == t[1], s[1] == t[0], s[1] == t[1]];
        if i == j || ends.contains(&true) {
            return false;
        }
        let follows = self.next[i] == j || self.next[j] == i;
        let facing = faces[i].line.normal.dot(faces[j].line.normal) < 0.0;
        let gap = distance(s, t);
        gap <= 0.0 || (facing && !follows && gap < GAP)
    }
}

/// Returns the ends of the edge `i` and the one before it outside their common corner.
fn corner(skeleton: &Skeleton, i: usize, over: &[f64]) -> Corner {
    let face = &skeleton.faces[i];
    let before = &skeleton.faces[face.before as usize];
    let at = skeleton.nodes[face.nodes[0] as usize].at;
    let overs = [over[face.before as usize], over[i]];
    let lines = [before.line, face.line];
    let least = overs[0].min(overs[1]);
    let Some(way) = velocity(lines[0].normal, lines[1].normal) else {
        return Corner {
            before: vec![at],
            after: vec![at],
        };
    };
    let convex = lines[0].way().perp_dot(lines[1].way()) > 0.0;
    if convex && way.length() > SPIKE {
        return cut_off(at, way.normalize_or_zero(), lines, overs);
    }
    let shared = at - way * least;
    let side = |own: usize| {
        if overs[own] <= least + POINT {
            return vec![shared];
        }
        let straight = lines[0].normal.perp_dot(lines[1].normal).abs() < 0.02;
        let end = match convex && !straight {
            // Along the neighbour's eaves to its own.
            true => shared + along(lines[1 - own], lines[own], shared, overs[own]),
            false => at - way * overs[own],
        };
        vec![shared, end]
    };
    Corner {
        before: side(0),
        after: side(1),
    }
}

/// Returns the path along one line from a point to the eaves of another.
fn along(line: EdgeLine, to: EdgeLine, from: DVec2, over: f64) -> DVec2 {
    let way = line.way();
    way * ((-over - to.depth(from)) / to.normal.dot(way))
}

/// Returns a sharp corner, cut off square to its bisector.
fn cut_off(at: DVec2, inward: DVec2, lines: [EdgeLine; 2], overs: [f64; 2]) -> Corner {
    let middle = at - inward * SPIKE * overs[0].min(overs[1]);
    let across = inward.perp();
    let end = |own: usize| {
        let share = (-overs[own] - lines[own].depth(middle)) / lines[own].normal.dot(across);
        vec![middle, middle + across * share]
    };
    Corner {
        before: end(0),
        after: end(1),
    }
}
