//! Faces in one plane with one finish become one face where they lie side by side; corners at which no face turns are
//! left out.

use crate::building::Finish;
use crate::geometry::tolerance::STRAIGHT;
use crate::geometry::triangulate::{bridged, ears};
use crate::roof::solid::massive::closed::flat;
use crate::roof::solid::massive::merge::Polygon;
use glam::{DVec2, DVec3};

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

/// An edge on the border of a group: group, from, to.
type Border = (u32, u32, u32);

/// Faces whose edges add up to closed surfaces, each in the group of its plane and finish.
#[derive(Default)]
pub(super) struct Patches {
    groups: Vec<Group>,
    /// The edges of all faces: group, lower point, higher point, then 0 if it runs from the lower one.
    edges: Vec<u64>,
    /// The floors one by one, with their groups, for those that have holes.
    floors: Vec<(Vec<u32>, u32)>,
}

const POINT_BITS: u32 = 23;
const GROUP_BITS: u32 = 16;
const POINT: u64 = (1 << POINT_BITS) - 1;

impl Patches {
    /// Returns the number of a group; `at` is in its plane.
    pub(super) fn group(&mut self, normal: DVec3, at: DVec3, finish: Finish) -> u64 {
        let same = |g: &Group| {
            g.finish == finish
                && (g.normal - normal).abs().max_element() < TURNED
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
            let (lo, hi) = (u64::from(from.min(to)), u64::from(from.max(to)));
            let turned = u64::from(from > to);
            self.edges
                .push((((group << POINT_BITS | lo) << POINT_BITS) | hi) << 1 | turned);
            from = to;
        }
    }

    /// Adds a convex face that is shown on its own where the whole of its group has holes.
    pub(super) fn floor(&mut self, corners: Vec<u32>, normal: DVec3, at: DVec3) {
        let group = self.group(normal, at, Finish::Soffit);
        self.add(corners.iter().copied(), group);
        self.floors.push((corners, group as u32));
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

    /// Returns the edges on the border of each group, sorted; none if one occurs twice.
    fn borders(mut self) -> Option<(Vec<Group>, Vec<Border>)> {
        self.edges.sort_unstable();
        let mut borders = Vec::with_capacity(self.edges.len());
        for same in self.edges.chunk_by(|p, q| p >> 1 == q >> 1) {
            let turned = same.iter().filter(|e| **e & 1 == 1).count();
            let [from, to] = match same.len() as i64 - 2 * turned as i64 {
                0 => continue,
                1 => [POINT_BITS + 1, 1],
                -1 => [1, POINT_BITS + 1],
                _ => return None,
            };
            let point = |shift: u32| (same[0] >> shift & POINT) as u32;
            let group = (same[0] >> (2 * POINT_BITS + 1)) as u32;
            borders.push((group, point(from), point(to)));
        }
        borders.sort_unstable();
        Some((self.groups, borders))
    }
}

/// Returns the faces that bound what the patches bound; none if they meet in a way that leaves the faces open.
pub(super) fn merged(points: &[DVec3], mut patches: Patches) -> Option<Vec<Polygon>> {
    if points.len() > POINT as usize || patches.groups.len() >= 1 << GROUP_BITS {
        return None;
    }
    let floors = std::mem::take(&mut patches.floors);
    let (groups, borders) = patches.borders()?;
    let mut loops: Vec<(Vec<u32>, u32)> = Vec::with_capacity(groups.len() + 8);
    for border in borders.chunk_by(|p, q| p.0 == q.0) {
        let (number, first) = (border[0].0, loops.len());
        let normal = groups[number as usize].normal;
        traced(points, normal, border, &mut loops)?;
        let mut own = floors.iter().filter(|f| f.1 == number).peekable();
        if own.peek().is_some()
            && loops[first..]
                .iter()
                .any(|l| facing(points, normal, &l.0) < 0.0)
        {
            loops.truncate(first);
            loops.extend(own.cloned());
        }
    }
    let turns = turns(points, &loops);
    let mut faces = Vec::with_capacity(loops.len());
    for own in loops.chunk_by_mut(|p, q| p.1 == q.1) {
        for (corners, _) in own.iter_mut() {
            corners.retain(|c| turns[*c as usize]);
        }
        polygons(points, &groups[own[0].1 as usize], own, &mut faces)?;
    }
    faces.iter().all(|f| is_simple(&f.0)).then_some(faces)
}

/// Returns true if a face passes no point twice.
fn is_simple(corners: &[u32]) -> bool {
    let once = |n: usize| !corners[..n].contains(&corners[n]);
    (1..corners.len()).all(once)
}

/// Adds the loops that the border of a group consists of.
fn traced(
    points: &[DVec3],
    normal: DVec3,
    border: &[Border],
    loops: &mut Vec<(Vec<u32>, u32)>,
) -> Option<()> {
    let mut used = vec![false; border.len()];
    for first in 0..border.len() {
        if used[first] {
            continue;
        }
        let mut corners = Vec::with_capacity(12);
        let mut at = first;
        while !used[at] {
            used[at] = true;
            let (group, from, to) = border[at];
            corners.push(from);
            let start = border.partition_point(|e| e.1 < to);
            let after = border[start..].iter().take_while(|e| e.1 == to).count();
            at = match after {
                0 => return None,
                1 => start,
                // Parts of the border touch here: to the left, round one of them.
                _ => {
                    let at = |c: u32| points[c as usize] - points[to as usize];
                    let back = at(from);
                    let turn = |n: &usize| {
                        let way = at(border[*n].2);
                        libm::atan2(normal.dot(way.cross(back)), normal.length() * way.dot(back))
                    };
                    let inward = |n: &usize| match turn(n) {
                        t if t <= 0.0 => t + std::f64::consts::TAU,
                        t => t,
                    };
                    (start..start + after).min_by(|m, n| inward(m).total_cmp(&inward(n)))?
                }
            };
            debug_assert_eq!(group, border[at].0);
        }
        if at != first {
            return None;
        }
        loops.push((corners, border[first].0));
    }
    Some(())
}

/// Returns twice the area that a loop bounds seen against a normal, times the length of that.
fn facing(points: &[DVec3], normal: DVec3, corners: &[u32]) -> f64 {
    let at = |k: usize| points[corners[k] as usize] - points[corners[0] as usize];
    let fan = 1..corners.len().max(2) - 1;
    let sum: DVec3 = fan.map(|k| at(k).cross(at(k + 1))).sum();
    sum.dot(normal)
}

/// Returns for each point whether a loop turns there.
fn turns(points: &[DVec3], loops: &[(Vec<u32>, u32)]) -> Vec<bool> {
    let mut turns = vec![false; points.len()];
    for (corners, _) in loops {
        let at = |k: usize| points[corners[k % corners.len()] as usize];
        let n = corners.len();
        let mut before = at(0) - at(n - 1);
        for k in 0..n {
            let after = at(k + 1) - at(k);
            let sine = before.cross(after).length_squared();
            let most = STRAIGHT * STRAIGHT * before.length_squared() * after.length_squared();
            turns[corners[k] as usize] |= sine > most || before.dot(after) <= 0.0;
            before = after;
        }
    }
    turns
}

/// Adds the faces that the loops of a group bound.
fn polygons(
    points: &[DVec3],
    group: &Group,
    loops: &[(Vec<u32>, u32)],
    faces: &mut Vec<Polygon>,
) -> Option<()> {
    let facing = |corners: &[u32]| facing(points, group.normal, corners);
    let loops = || loops.iter().map(|l| &l.0).filter(|l| l.len() > 2);
    if loops().any(|l| facing(l) <= 0.0) {
        let mut outer = loops().filter(|l| facing(l) > 0.0);
        let (outline, None) = (outer.next()?, outer.next()) else {
            return None;
        };
        let mut holes = loops().filter(|l| facing(l) <= 0.0);
        let (hole, None) = (holes.next()?, holes.next()) else {
            return None;
        };
        return around(points, group, outline, hole, faces);
    }
    let off = |c: &u32| (group.normal.dot(points[*c as usize]) - group.at).abs();
    for corners in loops() {
        let face = (corners.clone(), group.finish);
        if corners.iter().all(|c| off(c) < BENT) {
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
    let (x, y) = group.normal.normalize_or_zero().any_orthonormal_pair();
    let place = |c: &u32| DVec2::new(x.dot(points[*c as usize]), y.dot(points[*c as usize]));
    let plan = |l: &[u32]| -> Vec<DVec2> { l.iter().map(place).collect() };
    let ring = bridged(&plan(outline), &[plan(hole)]);
    let known = || outline.iter().chain(hole);
    let number = |p: &DVec2| known().find(|c| place(c) == *p).copied();
    let numbers: Vec<u32> = ring.iter().map(number).collect::<Option<_>>()?;
    let first = faces.len();
    ears(&ring, |t| {
        faces.push((t.map(|k| numbers[k as usize]).to_vec(), group.finish));
    });
    let whole = |f: &Polygon| facing(points, group.normal, &f.0) > SLIVER;
    faces[first..].iter().all(whole).then_some(())
}
