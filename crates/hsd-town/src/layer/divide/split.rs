//! Areas cut by lines. An area may be concave and have holes, so a cut can leave any number of pieces on either side.

use crate::shape::contains;
use glam::DVec2;
use hsd_base::geometry::area2;

/// The area below which a piece is left out, square metres.
const SLIVER: f64 = 0.01;
/// The distance at which points are one, metres.
const SAME: f64 = 1e-6;

/// An area: a counter-clockwise ring with clockwise holes.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// The outer ring.
    pub ring: Vec<DVec2>,
    /// The holes.
    pub holes: Vec<Vec<DVec2>>,
}

/// A line through a point in a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) at: DVec2,
    pub(super) way: DVec2,
}

/// The pieces to the left of a line, and those to its right.
pub(super) struct Split {
    pub(super) left: Vec<Piece>,
    pub(super) right: Vec<Piece>,
}

/// Where a ring crosses the line.
struct Crossing {
    /// The place along the line.
    t: f64,
    at: DVec2,
    /// True from its left to its right.
    leaves: bool,
}

/// A run of a ring on one side of the line: from a crossing to another, by number, and the corners between.
struct Chain {
    from: usize,
    to: usize,
    corners: Vec<DVec2>,
}

impl Piece {
    /// Creates a piece; its rings may run either way.
    pub fn new(ring: &[DVec2], holes: &[Vec<DVec2>]) -> Piece {
        let turned = |ring: &[DVec2], wanted: bool| {
            let mut ring = ring.to_vec();
            if (area2(&ring) > 0.0) != wanted {
                ring.reverse();
            }
            ring
        };
        Piece {
            ring: turned(ring, true),
            holes: holes.iter().map(|hole| turned(hole, false)).collect(),
        }
    }

    /// Returns its area, square metres.
    pub fn area(&self) -> f64 {
        let rings = std::iter::once(&self.ring).chain(&self.holes);
        rings.map(|ring| signed(ring)).sum()
    }

    fn rings(&self) -> impl Iterator<Item = &Vec<DVec2>> {
        std::iter::once(&self.ring).chain(&self.holes)
    }

    /// Cuts it by a line. One that numbers cannot tell stays whole, on the side where more of its corners lie.
    pub(super) fn split(&self, line: Line) -> Split {
        let is_left = |p: &DVec2| line.way.perp_dot(*p - line.at) >= 0.0;
        let count = self.ring.iter().filter(|p| is_left(p)).count();
        if count == 0 || count == self.ring.len() {
            return self.whole(count > 0);
        }
        let mut crossings = vec![];
        let [mut lefts, mut rights] = [vec![], vec![]];
        let mut loose = vec![];
        for ring in self.rings() {
            match chains(ring, line, &mut crossings) {
                Some([left, right]) => {
                    lefts.extend(left);
                    rights.extend(right);
                }
                None => loose.push(ring.clone()),
            }
        }
        let partners = partners(&crossings);
        let made = partners.and_then(|partners| {
            let left = linked(&lefts, &crossings, &partners)?;
            Some((left, linked(&rights, &crossings, &partners)?))
        });
        let Some((left, right)) = made else {
            return self.whole(2 * count >= self.ring.len());
        };
        let mut split = Split {
            left: pieces(left),
            right: pieces(right),
        };
        for hole in loose {
            let side = match is_left(&hole[0]) {
                true => &mut split.left,
                false => &mut split.right,
            };
            if let Some(round) = side.iter_mut().find(|piece| contains(&piece.ring, hole[0])) {
                round.holes.push(hole);
            }
        }
        split
    }

    fn whole(&self, left: bool) -> Split {
        let own = vec![self.clone()];
        match left {
            true => Split {
                left: own,
                right: vec![],
            },
            false => Split {
                left: vec![],
                right: own,
            },
        }
    }
}

/// Returns the area of a ring about its first corner; below 0 if it runs clockwise.
fn signed(ring: &[DVec2]) -> f64 {
    let from = ring.first().copied().unwrap_or_default();
    let about: Vec<DVec2> = ring.iter().map(|p| *p - from).collect();
    area2(&about) / 2.0
}

fn pieces(rings: Vec<Vec<DVec2>>) -> Vec<Piece> {
    let rings = rings.into_iter().map(|mut ring| {
        ring.dedup_by(|p, q| p.distance(*q) < SAME);
        while ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) < SAME {
            ring.pop();
        }
        ring
    });
    let rings = rings.filter(|ring| ring.len() > 2 && signed(ring) > SLIVER);
    rings
        .map(|ring| Piece {
            ring,
            holes: vec![],
        })
        .collect()
}

/// Divides a ring into its runs to the left and to the right; `None` if it does not cross the line.
fn chains(ring: &[DVec2], line: Line, crossings: &mut Vec<Crossing>) -> Option<[Vec<Chain>; 2]> {
    let height = |p: DVec2| line.way.perp_dot(p - line.at);
    let is_left: Vec<bool> = ring.iter().map(|p| height(*p) >= 0.0).collect();
    let n = ring.len();
    let starts: Vec<usize> = (0..n)
        .filter(|i| is_left[*i] != is_left[(i + n - 1) % n])
        .collect();
    if starts.is_empty() {
        return None;
    }
    let first = crossings.len();
    for start in &starts {
        let (p, q) = (ring[(start + n - 1) % n], ring[*start]);
        let (s, t) = (height(p), height(q));
        let at = p.lerp(q, s / (s - t));
        crossings.push(Crossing {
            t: (at - line.at).dot(line.way),
            at,
            leaves: !is_left[*start],
        });
    }
    let mut made = [vec![], vec![]];
    for (k, start) in starts.iter().enumerate() {
        let end = starts[(k + 1) % starts.len()];
        let count = (end + n - start - 1) % n + 1;
        made[usize::from(!is_left[*start])].push(Chain {
            from: first + k,
            to: first + (k + 1) % starts.len(),
            corners: (0..count).map(|i| ring[(start + i) % n]).collect(),
        });
    }
    Some(made)
}

/// Returns for each crossing the one at the other end of its stretch of the line inside the area; `None` if they do not pair.
fn partners(crossings: &[Crossing]) -> Option<Vec<usize>> {
    let mut order: Vec<usize> = (0..crossings.len()).collect();
    order.sort_by(|a, b| crossings[*a].t.total_cmp(&crossings[*b].t));
    let mut partners = vec![0; crossings.len()];
    for pair in order.chunks(2) {
        let &[one, two] = pair else { return None };
        if crossings[one].leaves == crossings[two].leaves {
            return None;
        }
        partners[one] = two;
        partners[two] = one;
    }
    Some(partners)
}

/// Joins runs along the line to rings.
fn linked(chains: &[Chain], crossings: &[Crossing], partners: &[usize]) -> Option<Vec<Vec<DVec2>>> {
    let mut begins = vec![None; crossings.len()];
    for (number, chain) in chains.iter().enumerate() {
        begins[chain.from] = Some(number);
    }
    let mut used = vec![false; chains.len()];
    let mut rings = vec![];
    for first in 0..chains.len() {
        let (mut ring, mut at) = (vec![], first);
        while !used[at] {
            used[at] = true;
            let chain = &chains[at];
            ring.push(crossings[chain.from].at);
            ring.extend(&chain.corners);
            ring.push(crossings[chain.to].at);
            at = begins[partners[chain.to]]?;
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    Some(rings)
}
