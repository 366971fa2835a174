//! The corners that slabs and fillings share, in plan and above each other, and the faces between them.

use crate::frame::Plane;
use crate::solid::massive::lean::corners::{WELD, welded};
use crate::solid::massive::lean::faces::Patches;
use crate::solid::massive::lean::heights::Heights;
use crate::solid::massive::lean::pieces::Piece;
use glam::{DVec2, DVec3, dvec3};
use hsd_ir::building::Finish;
use smallvec::SmallVec;
use std::ops::Range;

/// A corner of an outline by its number, with true if the edge that starts there is a rim.
type Start = (u32, bool);

/// The outlines of all pieces one after another: for each piece its slab and its filling.
#[derive(Default)]
struct Rings {
    starts: Vec<Start>,
    /// The end of each outline in the list of corners.
    ends: Vec<u32>,
}

impl Rings {
    fn with_capacity(starts: usize, rings: usize) -> Rings {
        Rings {
            starts: Vec::with_capacity(starts),
            ends: Vec::with_capacity(rings),
        }
    }

    /// Returns where an outline lies in the list of corners.
    fn range(&self, ring: usize) -> Range<usize> {
        let from = ring.checked_sub(1).map_or(0, |before| self.ends[before]);
        from as usize..self.ends[ring] as usize
    }

    /// Ends an outline that starts at a place of the list; without corners if it is flat.
    fn end(&mut self, from: usize) {
        if is_flat(&self.starts[from..]) {
            self.starts.truncate(from);
        }
        self.ends.push(self.starts.len() as u32);
    }
}

/// The outlines of all pieces on shared corners.
pub(super) struct Plan {
    corners: Vec<DVec2>,
    /// The number of corners in ascending order of x; those that edges crossing at different heights need follow.
    sorted: usize,
    rings: Rings,
}

/// The points over all corners.
pub(super) struct Raised {
    pub(super) points: Vec<DVec3>,
    /// The points over each corner of each outline: upper and lower.
    pairs: Vec<[u32; 2]>,
    /// The vertical sides of slabs and fillings, those over one stretch of the plan together.
    sides: Vec<Side>,
}

/// A vertical side over a stretch between two corners of the plan.
#[derive(Clone, Copy)]
struct Side {
    /// The stretch: the lower number, then the higher one.
    over: (u32, u32),
    /// The points over both ends.
    top: [u32; 2],
    bottom: [u32; 2],
    /// Its volume lies to the left (1) or to the right (-1).
    sign: i32,
    finish: Finish,
}

impl Side {
    fn covers(&self, low: [u32; 2], high: [u32; 2]) -> bool {
        let below = |p: [u32; 2], q: [u32; 2]| p[0] <= q[0] && p[1] <= q[1];
        below(self.bottom, low) && below(high, self.top)
    }
}

impl Plan {
    pub(super) fn of(pieces: &[Piece]) -> Plan {
        let outlines = || pieces.iter().flat_map(|p| [&p.outline, &p.filled]);
        let places: Vec<DVec2> = outlines().flatten().map(|c| c.at).collect();
        let (corners, numbers) = welded(&places);
        let mut rings = Rings::with_capacity(numbers.len(), 2 * pieces.len());
        let mut numbers = numbers.into_iter();
        let starts = &mut rings.starts;
        for outline in outlines() {
            let first = starts.len();
            for (corner, id) in outline.iter().zip(&mut numbers) {
                // The later of two equal corners starts the edge.
                if starts[first..].last().is_some_and(|l| l.0 == id) {
                    starts.pop();
                }
                starts.push((id, corner.rim));
            }
            if starts.len() > first + 1 && starts[first].0 == starts[starts.len() - 1].0 {
                starts.pop();
            }
            rings.ends.push(starts.len() as u32);
        }
        let sorted = corners.len();
        Plan {
            corners,
            sorted,
            rings,
        }
    }

    /// Inserts corners into the edges that they lie on. Outlines that welding has collapsed to a line vanish.
    pub(super) fn conform(&mut self) {
        let before = std::mem::take(&mut self.rings);
        let count = before.starts.len();
        let mut whole = Rings::with_capacity(count + count / 2, before.ends.len());
        let corners = self.corners.split_at(self.sorted);
        let mut found: Vec<(f64, u32)> = Vec::with_capacity(8);
        for n in (0..before.ends.len()).step_by(2) {
            let [slab, filling] = [n, n + 1].map(|ring| &before.starts[before.range(ring)]);
            let first = whole.starts.len();
            insert(slab, corners, &mut found, &mut whole.starts);
            whole.end(first);
            let second = whole.starts.len();
            // Most slopes are filled as a whole, or not at all.
            match slab == filling {
                true => whole.starts.extend_from_within(first..second),
                false if second == first => {}
                false => insert(filling, corners, &mut found, &mut whole.starts),
            }
            whole.end(second);
        }
        self.rings = whole;
    }

    /// Returns each piece with the places of its slab and of its filling in the list of corners.
    fn placed<'p>(
        &self,
        pieces: &'p [Piece],
    ) -> impl Iterator<Item = (&'p Piece, [Range<usize>; 2])> {
        let both = |n: usize| [2 * n, 2 * n + 1].map(|ring| self.rings.range(ring));
        pieces.iter().enumerate().map(move |(n, p)| (p, both(n)))
    }

    /// Returns the points over all corners.
    pub(super) fn raised(&self, pieces: &[Piece]) -> Option<Raised> {
        let starts = &self.rings.starts;
        let mut heights = Heights::over(self.corners.len(), starts.len());
        let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(starts.len());
        for (piece, [slab, filling]) in self.placed(pieces) {
            for &(id, _) in &starts[slab] {
                let top = piece.top.at(self.corners[id as usize]);
                pairs.push([
                    heights.number(id, top),
                    heights.number(id, top - piece.drop),
                ]);
            }
            for &(id, _) in &starts[filling] {
                let at = self.corners[id as usize];
                let low = heights.number(id, piece.top.at(at) - piece.drop);
                pairs.push([low, heights.number(id, piece.bottom.at(at))]);
            }
        }
        let (points, number) = heights.points(&self.corners);
        for pair in &mut pairs {
            *pair = [number[pair[0] as usize], number[pair[1] as usize]];
        }
        let sides = self.sides(pieces, &pairs);
        Some(Raised {
            points,
            pairs,
            sides,
        })
    }

    fn sides(&self, pieces: &[Piece], pairs: &[[u32; 2]]) -> Vec<Side> {
        let mut sides: Vec<Side> = Vec::with_capacity(pairs.len());
        for (piece, both) in self.placed(pieces) {
            for (range, filled) in both.into_iter().zip([false, true]) {
                let (ring, points) = (&self.rings.starts[range.clone()], &pairs[range]);
                for (i, &(p, rim)) in ring.iter().enumerate() {
                    let j = if i + 1 == ring.len() { 0 } else { i + 1 };
                    let q = ring[j].0;
                    let (left, right) = (points[i], points[j]);
                    let (a, b) = if p < q { (left, right) } else { (right, left) };
                    sides.push(Side {
                        over: (p.min(q), p.max(q)),
                        top: [a[0], b[0]],
                        bottom: [a[1], b[1]],
                        sign: if p < q { 1 } else { -1 },
                        finish: match (filled, rim) {
                            (true, _) => Finish::Gable,
                            (false, true) => piece.kind.map_or(Finish::Gable, Finish::Edge),
                            (false, false) => Finish::Plaster,
                        },
                    });
                }
            }
        }
        let mut order = by_number(&sides, self.corners.len(), |s| s.over.0);
        let over = |n: &u32| sides[*n as usize].over;
        for same in order.chunk_by_mut(|m, n| over(m).0 == over(n).0) {
            same.sort_by_key(|n| over(n).1);
        }
        order.iter().map(|n| sides[*n as usize]).collect()
    }

    /// Adds corners where edges over one stretch cross; returns whether there were any.
    pub(super) fn split(&mut self, raised: &Raised) -> bool {
        let before = self.corners.len();
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(16);
        for same in raised.sides.chunk_by(|s, t| s.over == t.over) {
            let [first, rest @ ..] = same else { continue };
            if rest
                .iter()
                .all(|s| s.top == first.top && s.bottom == first.bottom)
            {
                continue;
            }
            let p = self.corners[first.over.0 as usize];
            let q = self.corners[first.over.1 as usize];
            edges.clear();
            edges.extend(same.iter().flat_map(|s| [s.top, s.bottom]));
            for (n, e) in edges.iter().enumerate() {
                for f in &edges[n + 1..] {
                    if (e[0] < f[0]) == (e[1] < f[1]) || e[0] == f[0] || e[1] == f[1] {
                        continue;
                    }
                    let gap =
                        |k: usize| raised.points[e[k] as usize].z - raised.points[f[k] as usize].z;
                    let (d, g) = (gap(0), gap(1));
                    let at = p.lerp(q, d / (d - g));
                    let near = |c: &DVec2| c.distance(at) < WELD;
                    if !near(&p) && !near(&q) && !self.corners[before..].iter().any(near) {
                        self.corners.push(at);
                    }
                }
            }
        }
        self.corners.len() > before
    }

    /// Returns the faces of all slabs and fillings that bound the volume they have together; none if that cannot be
    /// told.
    pub(super) fn patches(&self, pieces: &[Piece], raised: &Raised) -> Option<Patches> {
        let mut patches = Patches::with_capacity(3 * raised.pairs.len());
        for (piece, [slab, filling]) in self.placed(pieces) {
            let (slab, filling) = (&raised.pairs[slab], &raised.pairs[filling]);
            let Some(corner) = slab.first() else { continue };
            let up = upward(piece.top);
            let at = |k: usize| raised.points[corner[k] as usize];
            let covering = piece.kind.map_or(Finish::Gable, Finish::Covering);
            patches.face(slab.iter().map(|p| p[0]), up, at(0), covering);
            let soffit = patches.group(-up, at(1), Finish::Soffit);
            // A slab that is filled as a whole has no soffit.
            let whole = slab.iter().map(|p| p[1]).eq(filling.iter().map(|p| p[0]));
            if !whole {
                patches.add(slab.iter().rev().map(|p| p[1]), soffit);
                patches.add(filling.iter().map(|p| p[0]), soffit);
            }
            if let Some(corner) = filling.first() {
                let at = raised.points[corner[1] as usize];
                let floor = filling.iter().rev().map(|p| p[1]);
                patches.floor(floor, -upward(piece.bottom), at);
            }
        }
        for same in raised.sides.chunk_by(|s, t| s.over == t.over) {
            self.upright(same, raised, &mut patches)?;
        }
        Some(patches)
    }

    /// Adds the vertical faces over a stretch: the heights filled on one side only.
    fn upright(&self, same: &[Side], raised: &Raised, patches: &mut Patches) -> Option<()> {
        if cancel(same) {
            return Some(());
        }
        // Both points of an edge in one number, by which they are sorted.
        let mut edges: SmallVec<[u64; 16]> = SmallVec::new();
        let both = |[a, b]: [u32; 2]| u64::from(a) << 32 | u64::from(b);
        for side in same {
            edges.push(both(side.top));
            edges.push(both(side.bottom));
        }
        edges.sort_unstable();
        edges.dedup();
        let over = same[0].over;
        let (p, q) = (self.corners[over.0 as usize], self.corners[over.1 as usize]);
        let right = (q - p).normalize_or_zero().perp() * -1.0;
        let mut ring: SmallVec<[u32; 16]> = SmallVec::new();
        for pair in edges.windows(2) {
            let [low, high] = [
                [(pair[0] >> 32) as u32, pair[0] as u32],
                [(pair[1] >> 32) as u32, pair[1] as u32],
            ];
            if low[1] > high[1] {
                return None;
            }
            let here = |s: &&Side| s.covers(low, high);
            let net = same.iter().filter(here).fold(0_i32, |sum, s| sum + s.sign);
            let Some(own) = same.iter().filter(here).rfind(|s| s.sign * net > 0) else {
                continue;
            };
            if net.abs() > 1 {
                return None;
            }
            // Along the foot, up, back, down, through every point over both ends.
            ring.clear();
            ring.push(low[0]);
            (low[1]..=high[1]).for_each(|p| ring.push(p));
            (low[0]..=high[0]).rev().for_each(|p| ring.push(p));
            ring.dedup();
            if ring.last() == ring.first() {
                ring.pop();
            }
            if net < 0 {
                ring.reverse();
            }
            let outward = (right * f64::from(net)).extend(0.0);
            let at = raised.points[low[0] as usize];
            let group = patches.group(outward, at, own.finish);
            if ring.len() > 2 {
                patches.add(ring.iter().copied(), group);
            }
        }
        Some(())
    }
}

/// Returns true if the sides over a stretch cancel each other: inside a roof slabs lie beside slabs, and fillings beside
/// fillings.
fn cancel(same: &[Side]) -> bool {
    let net = |s: &Side| {
        let alike = same.iter();
        let alike = alike.filter(|t| t.top == s.top && t.bottom == s.bottom);
        alike.fold(0_i32, |sum, t| sum + t.sign)
    };
    same.len() < 8 && same.iter().all(|s| net(s) == 0)
}

/// Adds an outline with the corners that its edges pass through. The corners are those in ascending order of x, then
/// others; `found` is room to work in.
fn insert(
    ring: &[Start],
    (known, more): (&[DVec2], &[DVec2]),
    found: &mut Vec<(f64, u32)>,
    into: &mut Vec<Start>,
) {
    let at = |c: u32| match known.get(c as usize) {
        Some(at) => *at,
        None => more[c as usize - known.len()],
    };
    for (n, &(from, rim)) in ring.iter().enumerate() {
        let to = ring.get(n + 1).unwrap_or(&ring[0]).0;
        into.push((from, rim));
        let (p, q) = (at(from), at(to));
        let (lo, hi) = (p.min(q) - WELD, p.max(q) + WELD);
        let way = q - p;
        let most = WELD * WELD * way.length_squared();
        let start = known.partition_point(|c| c.x < lo.x);
        let near = known[start..].iter().take_while(|c| c.x <= hi.x);
        let more = more.iter().zip(known.len() as u32..);
        for (c, id) in near.zip(start as u32..).chain(more) {
            if c.y < lo.y || c.y > hi.y || c.x < lo.x || c.x > hi.x || id == from || id == to {
                continue;
            }
            let (at, off) = (way.dot(c - p), way.perp_dot(c - p));
            if off * off < most {
                found.push((at, id));
            }
        }
        if found.len() > 1 {
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        into.extend(found.drain(..).map(|(_, id)| (id, rim)));
    }
}

/// Returns the places of items in the order of their numbers below `count`, those of one number as they come.
fn by_number<T>(items: &[T], count: usize, number: impl Fn(&T) -> u32) -> Vec<u32> {
    let mut next = vec![0_u32; count + 1];
    for item in items {
        next[number(item) as usize + 1] += 1;
    }
    for n in 1..next.len() {
        next[n] += next[n - 1];
    }
    let mut order = vec![0; items.len()];
    for (place, item) in (0..).zip(items) {
        let at = &mut next[number(item) as usize];
        order[*at as usize] = place;
        *at += 1;
    }
    order
}

pub(super) fn upward(plane: Plane) -> DVec3 {
    dvec3(-plane.slope.x, -plane.slope.y, 1.0)
}

/// Returns true if an outline has fewer than three corners, or one of them twice.
fn is_flat(ring: &[Start]) -> bool {
    let twice = |n: usize| ring[..n].iter().any(|c| c.0 == ring[n].0);
    ring.len() < 3 || (1..ring.len()).any(twice)
}
