//! Interiors seen through open bays and clear glass: the floor of a storey and the ceiling over it.

use crate::mesh::{Axis, Bodies};
use crate::store::look::Share;
use crate::wall::{Line, PlacedUnit};
use crate::weather::Weather;
use crate::{Level, Walker};
use glam::{DVec2, DVec3};
use hsd_base::geometry::{SAME, area2, holds};
use hsd_ir::building::Ring;
use hsd_ir::catalog::body::{Element, Shape};
use hsd_ir::catalog::{Below, Era, PartDef, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::{Content, Unit};
use hsd_scene::{Detail, Kind, MeshId};
use std::collections::HashMap;

/// Top of a floor relative to the storey's zero, so that it is not coplanar with sills, metres.
pub(crate) const UNDER: f64 = -0.004;

/// Top of a floor of earth (土間 doma) below the boards, metres: three sun above the ground.
pub(crate) const DOMA: f64 = -0.190;

/// Foot of a floor: that of the foundation on the ground, otherwise the depth of boards and joists; metres.
pub(crate) const GROUND: f64 = -0.280;
pub(crate) const BOARDS: f64 = -0.060;

/// Foot and top of a ceiling relative to the storey's top, metres.
pub(crate) const CEILING: (f64, f64) = (-0.100, -0.075);

/// How far the floors behind closed walls stay inside the lines of these, metres.
const IN: f64 = 0.012;

/// Interiors made so far, by outline and surfaces. Never iterated.
#[derive(Debug, Default)]
pub(crate) struct Rooms(HashMap<(Vec<i64>, SurfaceId, Weather), MeshId>);

impl Walker<'_> {
    /// Returns floor and ceiling of a storey whose inside is visible, of every storey of a monument, whose storeys stand over
    /// each other without a house's joists, and with every detail of all houses that say nothing of their rooms.
    pub(crate) fn interior(&mut self, level: Level<'_>, lines: &[(&Ring, Vec<Line<'_>>)]) {
        // Through columns and walls inside one looks from one part of it into another.
        let around = || {
            let around = lines.iter().filter(|(ring, _)| !ring.inner);
            around.flat_map(|(_, l)| l).flat_map(|l| &l.units)
        };
        let seen = around().find_map(|s| self.floor(level, s.unit));
        let ordered = level.storey.order.posts.is_some();
        let walled = self.detail == Detail::Everything && !self.furnished;
        let walled = walled && around().all(|s| s.stance != Stance::Fence);
        let floor = seen.or((ordered || walled).then(|| self.usual_floor(around())));
        let Some(floor) = floor.filter(|_| level.framed() && self.detail > Detail::Flat) else {
            return;
        };
        let mut outlines = outlines(level, lines);
        if seen.is_none() && !ordered {
            // Between walls that nobody looks through; some have their face on their line.
            outlines = outlines.iter().map(|o| inset(o)).collect();
        }
        if outlines.is_empty() {
            return;
        }
        // No ceiling over yards behind fences, and none that would stick out of a lean-to. Posts of a porch and walls inside
        // may be lower.
        let own = |c: &&hsd_ir::building::Ceiling| c.storey == level.storey.number;
        let covered = self.shown.has_ceiling(level.storey.number, self.storeys)
            && !level.ceilings.iter().any(|c| own(&c))
            && around().all(|s| s.stance != Stance::Fence && is_full(level, s));
        let mesh = self.room_mesh(level, &outlines, floor, covered);
        let node = self.node(Some(level.node), Kind::Member, "room".into(), DVec3::ZERO);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }

    /// Returns the mesh of a floor, and of the ceiling over it where the storey has one.
    fn room_mesh(
        &mut self,
        level: Level<'_>,
        outlines: &[Vec<DVec2>],
        floor: SurfaceId,
        covered: bool,
    ) -> MeshId {
        let rise = level.floor_rise();
        let foot = if level.grounded() {
            GROUND
        } else {
            BOARDS + rise
        };
        let step = |metres: f64| (metres * 10_000.0).round() as i64;
        let points = outlines.iter().flatten().flat_map(|p| [p.x, p.y]);
        let mut key: Vec<i64> = points.map(step).collect();
        let height = if covered { ceiling(level) } else { 0.0 };
        key.extend([step(foot), step(height)]);
        self.weather(|aged| aged.even("room", 0.0));
        let key = (key, floor, self.store.weather);
        match self.rooms.0.get(&key) {
            Some(mesh) => *mesh,
            None => {
                let mut bodies = Bodies::default();
                // Earth lies lower than boards: one walks in from the ground.
                let top = match level.grounded() && floor == SurfaceId::named("earth") {
                    true => DOMA,
                    false => UNDER + rise,
                };
                for outline in outlines {
                    bodies.prism(floor, outline, Axis::Z, foot, top);
                    if covered {
                        let (lo, hi) = (height + CEILING.0, height + CEILING.1);
                        bodies.prism(SurfaceId::named("soffit"), outline, Axis::Z, lo, hi);
                    }
                }
                let mesh = self.store.finish("room".into(), bodies, Share::default());
                let mesh = self.store.push(mesh);
                self.rooms.0.insert(key, mesh);
                mesh
            }
        }
    }

    /// Returns the floor behind closed walls.
    fn usual_floor<'u>(&self, mut around: impl Iterator<Item = &'u PlacedUnit<'u>>) -> SurfaceId {
        let modern = around.any(|s| match &s.unit.content {
            Content::Part(id) => self.catalog.part(*id).era == Era::Modern,
            _ => false,
        });
        SurfaceId::named(if modern { "concrete" } else { "boards" })
    }

    /// Returns the floor that is visible through a unit; `None` if none is.
    fn floor(&self, level: Level<'_>, unit: &Unit) -> Option<SurfaceId> {
        match &unit.content {
            Content::Part(id) => {
                let part = self.catalog.part(*id);
                let name = match (part.era, level.grounded(), is_open(part)) {
                    _ if part.floor.is_some() => return part.floor,
                    _ if !is_open(part) && !is_clear(part) => return None,
                    (Era::Modern, ..) => "concrete",
                    (_, true, true) => "earth",
                    _ => "boards",
                };
                Some(SurfaceId::named(name))
            }
            Content::Split(split) => {
                let mut both = split.lower.iter().chain(&split.upper);
                both.find_map(|u| self.floor(level, u))
            }
            _ => None,
        }
    }
}

/// Returns the height that ceilings hang from, metres above the floor: the top of the storey, or of its posts under
/// brackets.
fn ceiling(level: Level<'_>) -> f64 {
    level.height.min(level.storey.wall_height())
}

/// Returns true if a unit reaches the ceiling.
fn is_full(level: Level<'_>, placed: &PlacedUnit<'_>) -> bool {
    placed.is_post() || (placed.top() - ceiling(level)).abs() < SAME
}

/// Returns true if a part is an opening that is empty or holds only cloth.
pub(crate) fn is_open(part: &PartDef) -> bool {
    let closed = |e: &Element| !matches!(e.shape, Shape::Slab(_) | Shape::Cloth(_));
    part.class() == 'A' && part.below == Below::Open && !part.body.iter().any(closed)
}

/// Returns true if a part has clear panes with nothing behind them.
fn is_clear(part: &PartDef) -> bool {
    let all = || {
        part.body
            .iter()
            .flat_map(|e| std::iter::once(e).chain(&e.children))
    };
    let glass = |s: SurfaceId| s.surface().glass && s.surface().tint[3] < 0.6;
    let clear = |e: &Element| match &e.shape {
        Shape::Leaf(leaf) => glass(leaf.pane),
        _ => glass(e.place.finish),
    };
    all().any(clear) && !all().any(|e| e.place.finish == SurfaceId::named("dark"))
}

/// Returns the outlines of the storey in the house's frame, holes joined to them by a seam.
fn outlines(level: Level<'_>, lines: &[(&Ring, Vec<Line<'_>>)]) -> Vec<Vec<DVec2>> {
    let outline = |lines: &[Line<'_>]| {
        let from = lines.iter().map(|l| level.house.place(l.wall.from, 0.0));
        let mut points: Vec<DVec2> = from.map(|p| p.truncate()).collect();
        points.dedup_by(|a, b| a.distance(*b) < SAME);
        points
    };
    let mut outer: Vec<Vec<DVec2>> = Vec::new();
    for (_, lines) in lines.iter().filter(|(ring, _)| ring.closed && !ring.hole) {
        let mut points = outline(lines);
        if area2(&points) < 0.0 {
            points.reverse();
        }
        if points.len() > 2 && area2(&points) > SAME {
            outer.push(points);
        }
    }
    for (_, lines) in lines.iter().filter(|(ring, _)| ring.hole) {
        let mut hole = outline(lines);
        if area2(&hole) > 0.0 {
            hole.reverse();
        }
        let around = outer
            .iter_mut()
            .find(|o| hole.first().is_some_and(|p| holds(o, *p)));
        if let Some(around) = around.filter(|_| hole.len() > 2) {
            seam(around, &hole);
        }
    }
    outer
}

/// Returns a counter-clockwise outline drawn in a little; where it turns back it stays.
fn inset(outline: &[DVec2]) -> Vec<DVec2> {
    let n = outline.len();
    let inwards = |i: usize| {
        (outline[(i + 1) % n] - outline[i % n])
            .normalize_or_zero()
            .perp()
    };
    let moved = |i: usize| {
        let (before, after) = (inwards(i + n - 1), inwards(i));
        let turn = 1.0 + before.dot(after);
        match turn > 0.1 {
            true => outline[i] + (before + after) * (IN / turn),
            false => outline[i],
        }
    };
    (0..n).map(moved).collect()
}

/// Joins a hole to the polygon around it by two mutually visible corners, trying the nearest first.
fn seam(around: &mut Vec<DVec2>, hole: &[DVec2]) {
    let all = |n: usize| (0..n).map(move |i| (i, (i + 1) % n));
    let crosses = |p: DVec2, q: DVec2| {
        let here = all(around.len()).map(|(i, j)| (around[i], around[j]));
        let there = all(hole.len()).map(|(i, j)| (hole[i], hole[j]));
        here.chain(there).any(|(a, b)| {
            let side = |o: DVec2, d: DVec2, x: DVec2| (d - o).perp_dot(x - o);
            side(p, q, a) * side(p, q, b) < -1e-9 && side(a, b, p) * side(a, b, q) < -1e-9
        })
    };
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, p) in around.iter().enumerate() {
        pairs.extend(hole.iter().enumerate().map(|(j, q)| (p.distance(*q), i, j)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let found = pairs
        .iter()
        .find(|(_, i, j)| !crosses(around[*i], hole[*j]));
    let Some((_, i, j)) = found.copied() else {
        return;
    };
    let ring = hole.iter().cycle().skip(j).take(hole.len() + 1).copied();
    let back = around[i];
    let there: Vec<DVec2> = ring.chain([back]).collect();
    around.splice(i + 1..i + 1, there);
}
