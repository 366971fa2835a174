//! The corners that slabs and fillings share, in plan and above each other, and the faces between them.

use crate::building::Finish;
use crate::geometry::tolerance::JOINT;
use crate::roof::frame::Plane;
use crate::roof::solid::massive::lean::faces::Patches;
use crate::roof::solid::massive::lean::pieces::Piece;
use glam::{DVec2, DVec3, dvec3};

/// Corners nearer in plan are one, metres.
pub(super) const WELD: f64 = 2e-5;

/// An outline by the numbers of its corners, each with true if the edge that starts there is a rim.
type Ring = Vec<(u32, bool)>;

/// The outlines of all pieces on shared corners.
pub(super) struct Plan {
    corners: Vec<DVec2>,
    /// The number of corners in ascending order of x; those that edges crossing at different heights need follow.
    sorted: usize,
    /// For each piece its slab and its filling.
    rings: Vec<[Ring; 2]>,
}

/// The points over all corners.
pub(super) struct Raised {
    pub(super) points: Vec<DVec3>,
    /// For each piece the points over its slab's corners and its filling's: upper and lower.
    rings: Vec<[Vec<[u32; 2]>; 2]>,
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
        let (place, places) = distinct(outlines().flatten().map(|c| c.at));
        let mut order: Vec<(DVec2, u32)> = places.into_iter().zip(0..).collect();
        order.sort_unstable_by(|p, q| p.0.x.total_cmp(&q.0.x).then(p.0.y.total_cmp(&q.0.y)));
        let mut number = vec![0; order.len()];
        let mut corners: Vec<DVec2> = Vec::with_capacity(order.len());
        for (at, n) in order {
            let near = corners.iter().rev().take_while(|c| at.x - c.x < WELD);
            let same = near.enumerate().find(|(_, c)| (c.y - at.y).abs() < WELD);
            let id = match same.map(|s| s.0) {
                Some(back) => corners.len() - 1 - back,
                None => {
                    corners.push(at);
                    corners.len() - 1
                }
            };
            number[n as usize] = id as u32;
        }
        let mut numbers = place.into_iter().map(|place| number[place as usize]);
        let mut ring = |outline: &[crate::roof::facet::Corner]| {
            let mut ring: Ring = Vec::with_capacity(outline.len() + 4);
            for (corner, id) in outline.iter().zip(&mut numbers) {
                // The later of two equal corners starts the edge.
                if ring.last().is_some_and(|l| l.0 == id) {
                    ring.pop();
                }
                ring.push((id, corner.rim));
            }
            if ring.len() > 1 && ring[0].0 == ring[ring.len() - 1].0 {
                ring.pop();
            }
            ring
        };
        let rings = pieces
            .iter()
            .map(|p| [ring(&p.outline), ring(&p.filled)])
            .collect();
        let sorted = corners.len();
        Plan {
            corners,
            sorted,
            rings,
        }
    }

    /// Inserts corners into the edges that they lie on.
    pub(super) fn conform(&mut self) {
        let corners = self.corners.split_at(self.sorted);
        let mut found: Vec<(f64, u32)> = vec![];
        for [slab, filling] in &mut self.rings {
            // Most slopes are filled as a whole, or not at all.
            let same = slab == filling;
            insert(slab, corners, &mut found);
            match same {
                true => filling.clone_from(slab),
                false => insert(filling, corners, &mut found),
            }
        }
        for rings in &mut self.rings {
            // Welding may collapse an outline to a line.
            rings.iter_mut().filter(|r| is_flat(r)).for_each(Vec::clear);
            if rings[0].is_empty() {
                rings[1].clear();
            }
        }
    }

    /// Returns the points over all corners.
    pub(super) fn raised(&self, pieces: &[Piece]) -> Option<Raised> {
        let count: usize = self.rings.iter().flatten().map(Vec::len).sum();
        let mut heights: Vec<(u32, f64)> = Vec::with_capacity(2 * count);
        for ([slab, filling], piece) in self.rings.iter().zip(pieces) {
            for (ring, filled) in [(slab, false), (filling, true)] {
                for (id, _) in ring {
                    let top = piece.top.at(self.corners[*id as usize]);
                    let low = top - piece.drop;
                    let both = match filled {
                        true => [low, piece.bottom.at(self.corners[*id as usize])],
                        false => [top, low],
                    };
                    heights.extend(both.map(|z| (*id, z)));
                }
            }
        }
        let z = |place: &u32| heights[*place as usize].1;
        let mut order = by_number(&heights, self.corners.len(), |h| h.0);
        let mut points: Vec<DVec3> = Vec::with_capacity(heights.len() / 2);
        let mut number = vec![0; heights.len()];
        for over in order.chunk_by_mut(|p, q| heights[*p as usize].0 == heights[*q as usize].0) {
            over.sort_by(|p, q| z(p).total_cmp(&z(q)));
            let corner = self.corners[heights[over[0] as usize].0 as usize];
            let mut last: Option<f64> = None;
            for place in over.iter() {
                let z = z(place);
                if last.is_none_or(|last| z - last > JOINT) {
                    points.push(corner.extend(z));
                    last = Some(z);
                }
                number[*place as usize] = points.len() as u32 - 1;
            }
        }
        let mut pairs = number.chunks_exact(2).map(|p| [p[0], p[1]]);
        let mut of = |ring: &Ring| -> Vec<[u32; 2]> { pairs.by_ref().take(ring.len()).collect() };
        let rings: Vec<_> = self.rings.iter().map(|[s, f]| [of(s), of(f)]).collect();
        let sides = self.sides(pieces, &rings, count);
        Some(Raised {
            points,
            rings,
            sides,
        })
    }

    fn sides(&self, pieces: &[Piece], raised: &[[Vec<[u32; 2]>; 2]], count: usize) -> Vec<Side> {
        let mut sides: Vec<Side> = Vec::with_capacity(count);
        for ((rings, points), piece) in self.rings.iter().zip(raised).zip(pieces) {
            for ((ring, points), filled) in rings.iter().zip(points).zip([false, true]) {
                for (i, &(p, rim)) in ring.iter().enumerate() {
                    let j = (i + 1) % ring.len();
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
        for same in raised.sides.chunk_by(|s, t| s.over == t.over) {
            let [first, rest @ ..] = same else { continue };
            if rest
                .iter()
                .all(|s| s.top == first.top && s.bottom == first.bottom)
            {
                continue;
            }
            let [p, q] = [first.over.0, first.over.1].map(|c| self.corners[c as usize]);
            let edges = || same.iter().flat_map(|s| [s.top, s.bottom]);
            for (n, e) in edges().enumerate() {
                for f in edges().skip(n + 1) {
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
        let mut patches = Patches::default();
        for ([slab, filling], piece) in raised.rings.iter().zip(pieces) {
            if slab.is_empty() {
                continue;
            }
            let up = upward(piece.top);
            let at = |ring: &[[u32; 2]], k: usize| raised.points[ring[0][k] as usize];
            let covering = piece.kind.map_or(Finish::Gable, Finish::Covering);
            patches.face(slab.iter().map(|p| p[0]), up, at(slab, 0), covering);
            let soffit = patches.group(-up, at(slab, 1), Finish::Soffit);
            patches.add(slab.iter().rev().map(|p| p[1]), soffit);
            if !filling.is_empty() {
                patches.add(filling.iter().map(|p| p[0]), soffit);
                let floor = filling.iter().rev().map(|p| p[1]).collect();
                patches.floor(floor, -upward(piece.bottom), at(filling, 1));
            }
        }
        for same in raised.sides.chunk_by(|s, t| s.over == t.over) {
            self.upright(same, raised, &mut patches)?;
        }
        Some(patches)
    }

    /// Adds the vertical faces over a stretch: the heights filled on one side only.
    fn upright(&self, same: &[Side], raised: &Raised, patches: &mut Patches) -> Option<()> {
        if let [a, b] = same
            && a.sign + b.sign == 0
            && a.top == b.top
            && a.bottom == b.bottom
        {
            return Some(());
        }
        let mut edges: Vec<[u32; 2]> = same.iter().flat_map(|s| [s.top, s.bottom]).collect();
        edges.sort_unstable();
        edges.dedup();
        let over = same[0].over;
        let [p, q] = [over.0, over.1].map(|c| self.corners[c as usize]);
        let right = (q - p).normalize_or_zero().perp() * -1.0;
        for pair in edges.windows(2) {
            let (low, high) = (pair[0], pair[1]);
            if low[1] > high[1] {
                return None;
            }
            let here = |s: &&Side| s.covers(low, high);
            let net: i32 = same.iter().filter(here).map(|s| s.sign).sum();
            let Some(own) = same.iter().filter(here).rfind(|s| s.sign * net > 0) else {
                continue;
            };
            if net.abs() > 1 {
                return None;
            }
            // Along the foot, up, back, down, through every point over both ends.
            let (up, down) = (low[1]..high[1], (low[0]..high[0]).rev());
            let ring = [low[0]].into_iter().chain(up).chain([high[1]]);
            let ring = ring.chain([high[0]]).chain(down);
            let outward = (right * f64::from(net)).extend(0.0);
            let at = raised.points[low[0] as usize];
            let group = patches.group(outward, at, own.finish);
            let mut ring: Vec<u32> = ring.collect();
            ring.dedup();
            if ring.last() == ring.first() {
                ring.pop();
            }
            if net < 0 {
                ring.reverse();
            }
            if ring.len() > 2 {
                patches.add(ring.into_iter(), group);
            }
        }
        Some(())
    }
}

/// Returns for each corner the number of its place, and the places in the order of their first corners. Slabs, fillings
/// and slopes side by side have most corners in common, to the last bit; only those that differ are left to be sorted.
fn distinct(corners: impl Iterator<Item = DVec2> + Clone) -> (Vec<u32>, Vec<DVec2>) {
    const NONE: u32 = u32::MAX;
    let count = corners.clone().count();
    let mut slots = vec![NONE; (2 * count).next_power_of_two()];
    let (mut numbers, mut places) = (Vec::with_capacity(count), Vec::with_capacity(count / 2));
    let bits = |at: DVec2| at.to_array().map(f64::to_bits);
    for at in corners {
        let own = bits(at);
        let mixed = own.iter().fold(0, |mixed: u64, n| {
            (mixed.rotate_left(5) ^ n).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        });
        // The upper half of a product depends on all bits.
        let mut slot = (mixed >> 32) as usize & (slots.len() - 1);
        let same = |known: u32| known == NONE || bits(places[known as usize]) == own;
        while !same(slots[slot]) {
            slot = (slot + 1) & (slots.len() - 1);
        }
        if slots[slot] == NONE {
            slots[slot] = places.len() as u32;
            places.push(at);
        }
        numbers.push(slots[slot]);
    }
    (numbers, places)
}

/// Inserts corners into the edges of an outline that they lie on. The corners are those in ascending order of x, then
/// others; `found` is room to work in.
fn insert(ring: &mut Ring, (known, more): (&[DVec2], &[DVec2]), found: &mut Vec<(f64, u32)>) {
    let at = |c: u32| match known.get(c as usize) {
        Some(at) => *at,
        None => more[c as usize - known.len()],
    };
    let mut n = 0;
    while n < ring.len() {
        let (from, rim) = ring[n];
        let to = ring[(n + 1) % ring.len()].0;
        n += 1;
        let [p, q] = [from, to].map(at);
        let (lo, hi) = (p.min(q) - WELD, p.max(q) + WELD);
        let way = q - p;
        let most = WELD * WELD * way.length_squared();
        let start = known.partition_point(|c| c.x < lo.x);
        let near = known[start..].iter().take_while(|c| c.x <= hi.x);
        let more = more.iter().zip(known.len() as u32..);
        for (c, id) in near.zip(start as u32..).chain(more) {
            let (at, off) = (way.dot(c - p), way.perp_dot(c - p));
            if off * off < most && c.cmpge(lo).all() && c.cmple(hi).all() && id != from && id != to
            {
                found.push((at, id));
            }
        }
        if found.is_empty() {
            continue;
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let count = found.len();
        ring.splice(n..n, found.drain(..).map(|(_, id)| (id, rim)));
        n += count;
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

fn upward(plane: Plane) -> DVec3 {
    dvec3(-plane.slope.x, -plane.slope.y, 1.0)
}

/// Returns true if an outline has fewer than three corners, or one of them twice.
fn is_flat(ring: &Ring) -> bool {
    let twice = |n: usize| ring[..n].iter().any(|c| c.0 == ring[n].0);
    ring.len() < 3 || (1..ring.len()).any(twice)
}
