//! Faces in one plane with one finish become one face where they lie side by side; corners at which no face turns are
//! left out.

use crate::solid::massive::closed::flat;
use crate::solid::massive::merge::Polygon;
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::STRAIGHT;
use hsd_base::geometry::triangulate::{bridged, ears};
use hsd_ir::building::{Corners, Finish};
use smallvec::SmallVec;

/// Faces are in one plane if their normals differ by less.
const TURNED: f64 = 1e-8;
/// And their distance along it is less, metres.
const APART: f64 = 2e-7;
/// Faces whose corners are farther from their plane are divided, metres.
const BENT: f64 = 8e-7;
/// But not into triangles of less area, square metres.
const SLIVER: f64 = 1e-7;

/// The plane and finish of some faces.
struct Group {
    /// Outward, of any length.
    normal: DVec3,
    at: f64,
    finish: Finish,
}

/// Faces whose edges add up to closed surfaces, each in the group of its plane and finish.
#[derive(Default)]
pub(super) struct Patches {
    groups: Vec<Group>,
    /// The edges of all faces: group, lower point, higher point, then 0 if it runs from the lower one.
    edges: Vec<u64>,
    /// The floors one by one, for those that have holes.
    floors: Loops,
}

/// Closed paths along points one after another, each in a group.
#[derive(Default)]
struct Loops {
    corners: Vec<u32>,
    /// For each where it ends in the list of corners, and its group.
    ends: Vec<(u32, u32)>,
}

impl Loops {
    fn corners(&self, n: usize) -> &[u32] {
        let from = n.checked_sub(1).map_or(0, |before| self.ends[before].0);
        &self.corners[from as usize..self.ends[n].0 as usize]
    }

    fn all(&self) -> impl Iterator<Item = (&[u32], u32)> {
        (0..self.ends.len()).map(|n| (self.corners(n), self.ends[n].1))
    }

    /// Ends a path whose corners have been added.
    fn end(&mut self, group: u32) {
        self.ends.push((self.corners.len() as u32, group));
    }

    fn truncate(&mut self, count: usize) {
        self.ends.truncate(count);
        let end = self.ends.last().map_or(0, |last| last.0);
        self.corners.truncate(end as usize);
    }
}

const POINT_BITS: u32 = 23;
const GROUP_BITS: u32 = 16;
const POINT: u64 = (1 << POINT_BITS) - 1;
const GROUP: u32 = 2 * POINT_BITS + 1;

impl Patches {
    pub(super) fn with_capacity(edges: usize) -> Patches {
        Patches {
            groups: Vec::with_capacity(32),
            edges: Vec::with_capacity(edges),
            floors: Loops::default(),
        }
    }

    /// Returns the number of a group; `at` is in its plane.
    pub(super) fn group(&mut self, normal: DVec3, at: DVec3, finish: Finish) -> u64 {
        let same = |g: &Group| {
            g.finish == finish
                && (g.normal.x - normal.x).abs() < TURNED
                && (g.normal.y - normal.y).abs() < TURNED
                && (g.normal.z - normal.z).abs() < TURNED
                && (g.normal.dot(at) - g.at).abs() < APART
        };
        let known = self.groups.iter().position(same);
        let number = known.unwrap_or_else(|| {
            self.groups.push(Group {
                normal,
                at: normal.dot(at),
                finish,
            });
            self.groups.len() - 1
        });
        number as u64
    }

    /// Adds a face to a group.
    pub(super) fn add(&mut self, mut corners: impl Iterator<Item = u32>, group: u64) {
        let Some(first) = corners.next() else { return };
        let mut from = first;
        for to in corners.chain([first]) {
            self.edge(from, to, group);
            from = to;
        }
    }

    /// Adds an edge of a face to a group; all its edges must come.
    pub(super) fn edge(&mut self, from: u32, to: u32, group: u64) {
        let (lo, hi) = (u64::from(from.min(to)), u64::from(from.max(to)));
        let turned = u64::from(from > to);
        self.edges
            .push((((group << POINT_BITS | lo) << POINT_BITS) | hi) << 1 | turned);
    }

    /// Adds a convex face that is shown on its own where the whole of its group has holes.
    pub(super) fn floor(
        &mut self,
        corners: impl Iterator<Item = u32> + Clone,
        normal: DVec3,
        at: DVec3,
    ) {
        let group = self.group(normal, at, Finish::Soffit);
        self.add(corners.clone(), group);
        self.floors.corners.extend(corners);
        self.floors.end(group as u32);
    }

    /// Adds a face in a plane.
    pub(super) fn face(
        &mut self,
        corners: impl Iterator<Item = u32>,
        normal: DVec3,
        at: DVec3,
        finish: Finish,
    ) {
        let group = self.group(normal, at, finish);
        self.add(corners, group);
    }

    /// Returns the edges of each group together.
    fn by_group(&self) -> Vec<u64> {
        let mut next = vec![0_u32; self.groups.len() + 1];
        for edge in &self.edges {
            next[(edge >> GROUP) as usize + 1] += 1;
        }
        for n in 1..next.len() {
            next[n] += next[n - 1];
        }
        let mut sorted = vec![0; self.edges.len()];
        for edge in &self.edges {
            let place = &mut next[(edge >> GROUP) as usize];
            sorted[*place as usize] = *edge;
            *place += 1;
        }
        sorted
    }
}

/// Replaces the border that some edges of one group have by its edges, each as from and to; none if one occurs twice.
fn border(edges: &mut [u64], border: &mut Vec<(u32, u32)>) -> Option<()> {
    border.clear();
    edges.sort_unstable();
    for same in edges.chunk_by(|p, q| p >> 1 == q >> 1) {
        let turned = same.iter().filter(|e| **e & 1 == 1).count();
        let [from, to] = match same.len() as i64 - 2 * turned as i64 {
            0 => continue,
            1 => [POINT_BITS + 1, 1],
            -1 => [1, POINT_BITS + 1],
            _ => return None,
        };
        let point = |shift: u32| (same[0] >> shift & POINT) as u32;
        border.push((point(from), point(to)));
    }
    Some(())
}

/// Returns the faces that bound what the patches bound; none if they meet in a way that leaves the faces open.
pub(super) fn merged(points: &[DVec3], patches: &Patches) -> Option<Vec<Polygon>> {
    let Patches { groups, floors, .. } = patches;
    if points.len() > POINT as usize || groups.len() >= 1 << GROUP_BITS {
        return None;
    }
    let mut loops = Loops {
        corners: Vec::with_capacity(patches.edges.len() / 2),
        ends: Vec::with_capacity(groups.len() + 8),
    };
    let mut edges = patches.by_group();
    let mut around = Vec::with_capacity(32);
    let mut onward = Onward::over(points.len());
    for own in edges.chunk_by_mut(|p, q| p >> GROUP == q >> GROUP) {
        let (number, first) = ((own[0] >> GROUP) as u32, loops.ends.len());
        let normal = groups[number as usize].normal;
        border(own, &mut around)?;
        onward.lead(&around);
        traced(points, normal, (&around, number), &onward, &mut loops)?;
        onward.forget(&around);
        let turned = |n: usize| facing(points, normal, loops.corners(n)) < 0.0;
        let is_floor = floors.ends.iter().any(|end| end.1 == number);
        if is_floor && (first..loops.ends.len()).any(turned) {
            loops.truncate(first);
            for (corners, group) in floors.all().filter(|f| f.1 == number) {
                loops.corners.extend_from_slice(corners);
                loops.end(group);
            }
        }
    }
    let turns = turns(points, &loops);
    let mut faces = Vec::with_capacity(loops.ends.len());
    let mut own: Vec<Corners> = Vec::with_capacity(4);
    let mut straight: Vec<u32> = Vec::with_capacity(32);
    for (n, (corners, group)) in loops.all().enumerate() {
        straight.clear();
        straight.extend(corners.iter().filter(|c| turns[**c as usize]));
        if straight.len() > 2 {
            own.push(Corners::from_slice(&straight));
        }
        if loops.ends.get(n + 1).is_none_or(|next| next.1 != group) {
            polygons(points, &groups[group as usize], &mut own, &mut faces)?;
        }
    }
    Some(faces)
}

/// Returns true if a face passes no point twice.
fn is_simple(corners: &[u32]) -> bool {
    let once = |n: usize| !corners[..n].contains(&corners[n]);
    (1..corners.len()).all(once)
}

/// The edges of a border by the points they start from.
struct Onward {
    /// The last edge from each point.
    last: Vec<u32>,
    /// For each edge the one before it from the same point.
    before: Vec<u32>,
}

impl Onward {
    const NONE: u32 = u32::MAX;

    fn over(points: usize) -> Onward {
        Onward {
            last: vec![Self::NONE; points],
            before: Vec::with_capacity(32),
        }
    }

    /// Takes the edges of a border; those of the one before must be forgotten.
    fn lead(&mut self, border: &[(u32, u32)]) {
        self.before.clear();
        for (n, (from, _)) in (0..).zip(border) {
            self.before.push(self.last[*from as usize]);
            self.last[*from as usize] = n;
        }
    }

    fn forget(&mut self, border: &[(u32, u32)]) {
        for (from, _) in border {
            self.last[*from as usize] = Self::NONE;
        }
    }

    /// Returns the edges from a point.
    fn from(&self, point: u32) -> impl Iterator<Item = u32> + Clone {
        let known = |n: u32| (n != Self::NONE).then_some(n);
        let first = known(self.last[point as usize]);
        std::iter::successors(first, move |n| known(self.before[*n as usize]))
    }
}

/// Adds the loops that the border of a group consists of.
fn traced(
    points: &[DVec3],
    normal: DVec3,
    (border, group): (&[(u32, u32)], u32),
    onward: &Onward,
    loops: &mut Loops,
) -> Option<()> {
    let mut used: SmallVec<[bool; 64]> = SmallVec::from_elem(false, border.len());
    let used = &mut used[..];
    for first in 0..border.len() {
        if used[first] {
            continue;
        }
        let mut at = first;
        while !used[at] {
            used[at] = true;
            let (from, to) = border[at];
            loops.corners.push(from);
            let mut ways = onward.from(to);
            let way = ways.next()?;
            let next = match ways.next() {
                None => way,
                // Parts of the border touch here: to the left, round one of them.
                Some(_) => leftmost(points, normal, (from, to), onward.from(to), border)?,
            };
            at = next as usize;
        }
        if at != first {
            return None;
        }
        loops.end(group);
    }
    Some(())
}

/// Returns the edge, of some that go on from the end of another, that goes farthest to the left.
fn leftmost(
    points: &[DVec3],
    normal: DVec3,
    (from, to): (u32, u32),
    ways: impl Iterator<Item = u32>,
    border: &[(u32, u32)],
) -> Option<u32> {
    let at = |c: u32| points[c as usize] - points[to as usize];
    let back = at(from);
    let inward = |n: u32| {
        let way = at(border[n as usize].1);
        let turn = libm::atan2(normal.dot(way.cross(back)), normal.length() * way.dot(back));
        match turn <= 0.0 {
            true => turn + std::f64::consts::TAU,
            false => turn,
        }
    };
    ways.min_by(|m, n| inward(*m).total_cmp(&inward(*n)))
}

/// Returns twice the area that a loop bounds seen against a normal, times the length of that.
fn facing(points: &[DVec3], normal: DVec3, corners: &[u32]) -> f64 {
    let [first, rest @ ..] = corners else {
        return 0.0;
    };
    let first = points[*first as usize];
    let mut sum = DVec3::ZERO;
    for pair in rest.windows(2) {
        sum += (points[pair[0] as usize] - first).cross(points[pair[1] as usize] - first);
    }
    sum.dot(normal)
}

/// Returns for each point whether a loop turns there.
fn turns(points: &[DVec3], loops: &Loops) -> Vec<bool> {
    let mut turns = vec![false; points.len()];
    for (corners, _) in loops.all() {
        let at = |c: &u32| points[*c as usize];
        let [.., last] = corners else { continue };
        let (mut here, mut place) = (*last, at(last));
        let mut before = place - at(&corners[corners.len().max(2) - 2]);
        for next in corners {
            let after = at(next) - place;
            let sine = before.cross(after).length_squared();
            let most = STRAIGHT * STRAIGHT * before.length_squared() * after.length_squared();
            turns[here as usize] |= sine > most || before.dot(after) <= 0.0;
            (here, place, before) = (*next, at(next), after);
        }
    }
    turns
}

/// Adds the faces that the loops of a group bound.
fn polygons(
    points: &[DVec3],
    group: &Group,
    loops: &mut Vec<Corners>,
    faces: &mut Vec<Polygon>,
) -> Option<()> {
    let facing = |corners: &[u32]| facing(points, group.normal, corners);
    if loops.iter().any(|l| facing(l) <= 0.0) {
        let mut outer = loops.iter().filter(|l| facing(l) > 0.0);
        let (outline, None) = (outer.next()?, outer.next()) else {
            return None;
        };
        let mut holes = loops.iter().filter(|l| facing(l) <= 0.0);
        let (hole, None) = (holes.next()?, holes.next()) else {
            return None;
        };
        around(points, group, outline, hole, faces)?;
        loops.clear();
        return Some(());
    }
    let off = |c: &u32| (group.normal.dot(points[*c as usize]) - group.at).abs();
    for corners in loops.drain(..) {
        // Its border touches itself in a point.
        if !is_simple(&corners) {
            triangles(
                points,
                group,
                &plan(points, group, &corners),
                &corners,
                faces,
            )?;
            continue;
        }
        let lies = corners.iter().all(|c| off(c) < BENT);
        let face = (corners, group.finish);
        if lies {
            faces.push(face);
            continue;
        }
        let triangles = flat(points, face.clone());
        match triangles.iter().all(|t| facing(&t.0).abs() > SLIVER) {
            true => faces.extend(triangles),
            false => faces.push(face),
        }
    }
    Some(())
}

/// Adds triangles of a face with a hole.
fn around(
    points: &[DVec3],
    group: &Group,
    outline: &[u32],
    hole: &[u32],
    faces: &mut Vec<Polygon>,
) -> Option<()> {
    let (outer, inner) = (plan(points, group, outline), plan(points, group, hole));
    let places = outer.iter().chain(&inner);
    let known = || places.clone().zip(outline.iter().chain(hole));
    let number = |p: &DVec2| known().find(|k| k.0 == p).map(|k| *k.1);
    let ring = bridged(&outer, std::slice::from_ref(&inner));
    let numbers: Vec<u32> = ring.iter().map(number).collect::<Option<_>>()?;
    triangles(points, group, &ring, &numbers, faces)
}

/// Returns the places of corners in the plane of their group.
fn plan(points: &[DVec3], group: &Group, corners: &[u32]) -> Vec<DVec2> {
    let (x, y) = group.normal.normalize_or_zero().any_orthonormal_pair();
    let place = |c: &u32| DVec2::new(x.dot(points[*c as usize]), y.dot(points[*c as usize]));
    corners.iter().map(place).collect()
}

/// Adds the triangles of a ring that may pass a point twice; none if one is a sliver.
fn triangles(
    points: &[DVec3],
    group: &Group,
    ring: &[DVec2],
    numbers: &[u32],
    faces: &mut Vec<Polygon>,
) -> Option<()> {
    let first = faces.len();
    ears(ring, |t| {
        let corners = t.map(|k| numbers[k as usize]).into_iter().collect();
        faces.push((corners, group.finish));
    });
    let whole = |f: &Polygon| facing(points, group.normal, &f.0) > SLIVER;
    faces[first..].iter().all(whole).then_some(())
}
