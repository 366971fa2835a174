//! Sloping ceilings: walls under a lean-to end at its plane, in rectangular bays below a wedge.

use crate::mesh::{Axis, Bodies, THIN};
use crate::part::bay::Layer;
use crate::part::wall_layer;
use crate::store::look::Share;
use crate::wall::PlacedUnit;
use crate::{Level, Walker};
use compact_str::format_compact;
use glam::{DVec2, dvec2, dvec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Kind, NodeId};

/// Tolerance in plan for points on the border of a rectangle, U.
const NEAR: f64 = 1e-3;

/// The lowest wall, metres.
const LOWEST: f64 = 0.05;

/// A section of a unit's top, under one ceiling or none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    /// Its ends, distances from the right end of the unit, U.
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Heights above the storey's floor at its right and left end, metres.
    pub(crate) tops: (f64, f64),
}

/// Returns the heights above the storey's floor at which a unit from `from` to `to` (plan, U) ends; the storey's own
/// top if no ceiling is lower. A unit that lies under a ceiling with a part of its width ends level, at its lowest
/// place; its [`sections`] go on to the top.
pub(crate) fn tops(level: Level<'_>, from: DVec2, to: DVec2, top: f64) -> (f64, f64) {
    let sections = sections(level, from, to, top);
    match sections[..] {
        [] => (top, top),
        [only] => only.tops,
        _ => {
            let lowest = sections.iter().map(|s| s.tops.0.min(s.tops.1));
            let lowest = lowest.fold(top, f64::min);
            (lowest, lowest)
        }
    }
}

/// Returns the sections into which ceilings divide the top of a unit, from its right end; none without a ceiling.
pub(crate) fn sections(level: Level<'_>, from: DVec2, to: DVec2, top: f64) -> Vec<Section> {
    let (length, along) = (from.distance(to), (to - from).normalize_or_zero());
    let own = level.ceilings.iter();
    let own = own.filter(|ceiling| ceiling.storey == level.storey.number);
    let under = own.filter_map(|c| Some((on_border(c.rect, from, to)?, c)));
    let mut under: Vec<_> = under.collect();
    under.sort_by(|p, q| p.0.0.total_cmp(&q.0.0));
    let mut sections: Vec<Section> = vec![];
    let level_section = |from: f64, to: f64| Section {
        from,
        to,
        tops: (top, top),
    };
    let mut done = 0.0;
    for ((start, end), ceiling) in under {
        let start = start.max(done);
        if end - start <= NEAR {
            continue;
        }
        if start - done > NEAR {
            sections.push(level_section(done, start));
        }
        let at = |u: f64| {
            let z = ceiling.z + ceiling.slope.dot(from + along * u) - level.storey.z0;
            z.min(top).max(LOWEST)
        };
        sections.push(Section {
            from: start,
            to: end,
            tops: (at(start), at(end)),
        });
        done = end;
    }
    if !sections.is_empty() && length - done > NEAR {
        sections.push(level_section(done, length));
    }
    sections
}

/// Returns the part of a section of wall, as distances from its start, that lies on one edge of a rectangle.
fn on_border([a0, b0, a1, b1]: [f64; 4], p: DVec2, q: DVec2) -> Option<(f64, f64)> {
    let on = |line: f64, x: f64, y: f64| (x - line).abs() < NEAR && (y - line).abs() < NEAR;
    let shared = |from: f64, to: f64, low: f64, high: f64| {
        let (start, end) = (from.clamp(low, high), to.clamp(low, high));
        let (start, end) = ((start - from).abs(), (end - from).abs());
        (end - start > NEAR).then_some((start, end))
    };
    if on(b0, p.y, q.y) || on(b1, p.y, q.y) {
        shared(p.x, q.x, a0, a1)
    } else if on(a0, p.x, q.x) || on(a1, p.x, q.x) {
        shared(p.y, q.y, b0, b1)
    } else {
        None
    }
}

impl Walker<'_> {
    /// Adds the wall between the level top of a unit and one section of its ceiling.
    pub(super) fn above(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        placed: &PlacedUnit<'_>,
        section: Section,
        (number, n): (usize, usize),
    ) {
        let base = placed.top();
        let (right, left) = section.tops;
        if right.max(left) - base < 1e-3 {
            return;
        }
        let unit = level.house.unit;
        let width = (section.to - section.from) * unit;
        let layer = wall_layer(placed.stance);
        let bodies = wedge(placed.around, layer, width, base, left - base, right - base);
        let mesh = self.store.finish("wedge".into(), bodies, Share::default());
        let mesh = self.store.push(mesh);
        let at = dvec3(-(placed.offset + section.to * unit), 0.0, 0.0);
        let name = match n {
            0 => format_compact!("wedge {number}"),
            _ => format_compact!("wedge {number}.{n}"),
        };
        let node = self.node(Some(facade), Kind::Member, name, at);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }
}

/// Builds the wedge between a bay's level top and the sloping plane: x from 0 to the width, heights at the left and
/// right end above the level top.
pub(crate) fn wedge(
    finish: SurfaceId,
    layer: Layer,
    width: f64,
    base: f64,
    left: f64,
    right: f64,
) -> Bodies {
    let mut bodies = Bodies::default();
    let mut outline = vec![dvec2(base, 0.0), dvec2(base, width)];
    for (rise, x) in [(right, width), (left, 0.0)] {
        if rise > THIN {
            outline.push(dvec2(base + rise, x));
        }
    }
    if outline.len() > 2 {
        bodies.prism(
            finish,
            &outline,
            Axis::Y,
            -layer.front,
            layer.thick - layer.front,
        );
    }
    bodies
}
