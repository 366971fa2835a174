//! Fillers at convex corners of walls without posts: without them, the outer faces of two panels that end on their
//! centre lines leave a notch.

use crate::mesh::{Axis, Bodies};
use crate::part::shelter;
use crate::store::look::Share;
use crate::wall::{Line, PlacedUnit};
use crate::{Walker, turn_of};
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::catalog::Stance;
use hsd_ir::catalog::body::Shape;
use hsd_ir::catalog::value::Level;
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_scene::{Kind, Node, NodeId};

/// Mitres longer than this number of faces are cut off, at sharp corners of unlike walls.
const LONGEST: f64 = 4.0;

impl Walker<'_> {
    /// Adds the filler at the start of a wall, if one is needed.
    pub(crate) fn corners(
        &mut self,
        level: crate::Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        before: Option<&Line<'_>>,
    ) {
        let Some(before) = before else { return };
        let (Some(last), Some(first)) = (before.end(true), line.end(false)) else {
            return;
        };
        if last.stance == Stance::Posts && first.stance == Stance::Posts {
            return;
        }
        let Some(outline) = mitre(before, line, last.face, first.face) else {
            return;
        };
        let top = [last, first].map(|s| self.filled(s));
        let top = (last.tops.1 - top[0]).min(first.tops.0 - top[1]);
        let mut bodies = Bodies::default();
        let slim = [last, first].map(|s| self.upper_face(s));
        let upper = mitre(before, line, slim[0], slim[1]);
        match upper.filter(|upper| upper.len() == outline.len() && slim != [last.face, first.face])
        {
            Some(upper) => frustum(&mut bodies, self.finish(first), [&outline, &upper], top),
            None => bodies.prism(self.finish(first), &outline, Axis::Z, 0.0, top),
        }
        let mesh = self.store.finish("corner".into(), bodies, Share::default());
        let mesh = self.store.push(mesh);
        let node = self.node(Some(facade), Kind::Member, "corner".into(), DVec3::ZERO);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
        if let Some(hip) = self.hip(facade, line, before, (last, first)) {
            hip.storey = Some(level.storey.number);
        }
    }

    /// Adds the roof of a fence at its corner.
    fn hip(
        &mut self,
        facade: NodeId,
        line: &Line<'_>,
        before: &Line<'_>,
        (last, first): (&PlacedUnit<'_>, &PlacedUnit<'_>),
    ) -> Option<&mut Node> {
        let Content::Part(id) = first.unit.content else {
            return None;
        };
        let alike = last.unit.content == first.unit.content;
        let body = self.catalog.part(id).body.iter();
        let (place, coping) = body.filter(|_| alike).find_map(|e| match &e.shape {
            Shape::Coping(coping) => Some((&e.place, coping)),
            _ => None,
        })?;
        let reach = shelter::coping_reach(coping, place);
        let outline = mitre(before, line, reach, reach)?;
        let outline: [DVec2; 4] = outline.try_into().ok()?;
        let top = first.top();
        let heights = (place.from.at(0.0, top).max(0.0), top);
        let bodies = shelter::coping_corner(coping, place, heights, &outline);
        let mesh = self.store.finish("hip".into(), bodies, Share::default());
        let mesh = self.store.push(mesh);
        let node = self.node(Some(facade), Kind::Member, "hip".into(), DVec3::ZERO);
        node.mesh = Some(mesh);
        Some(node)
    }

    /// Returns how far the outer face of a unit lies before its line at the top: less than at the foot with a batter.
    fn upper_face(&self, placed: &PlacedUnit<'_>) -> f64 {
        let Content::Part(id) = &placed.unit.content else {
            return placed.face;
        };
        let leaning = self.catalog.part(*id).body.iter().filter_map(|e| {
            let Shape::Wall(wall) = &e.shape else {
                return None;
            };
            let at = |level: &Level| level.at(0.0, placed.top());
            let (front, thick) = (e.place.front.0, e.place.thick.0);
            let lean = wall.batter * (at(&e.place.to) - at(&e.place.from));
            (wall.batter > 0.0).then(|| front - lean.clamp(0.0, (thick / 2.0 - 0.01).max(0.0)))
        });
        leaning.reduce(f64::min).unwrap_or(placed.face)
    }

    /// Returns how far below its top a unit's wall ends: under the coping of a fence.
    fn filled(&self, placed: &PlacedUnit<'_>) -> f64 {
        let Content::Part(id) = &placed.unit.content else {
            return 0.0;
        };
        let part = self.catalog.part(*id);
        let walls = part
            .body
            .iter()
            .filter(|e| matches!(e.shape, Shape::Wall(_)));
        let below = walls.filter_map(|e| match e.place.to {
            Level::End(below) if part.stance == Stance::Fence => Some(below),
            _ => None,
        });
        below.reduce(f64::min).unwrap_or(0.0)
    }

    /// Returns the surface of a corner beside a unit.
    fn finish(&self, placed: &PlacedUnit<'_>) -> SurfaceId {
        match &placed.unit.content {
            Content::Part(id) => {
                let part = self.catalog.part(*id);
                let wall = part.body.first().map(|e| e.place.finish);
                match part.from {
                    // Panels over a dark ground show at the corner, not the ground.
                    None => part.finish.or(wall).unwrap_or(placed.around),
                    Some(_) => placed.around,
                }
            }
            _ => SurfaceId::named("mortar"),
        }
    }
}

/// Adds the body between an outline at the foot and one with as many corners at a height.
fn frustum(bodies: &mut Bodies, finish: SurfaceId, [foot, head]: [&[DVec2]; 2], top: f64) {
    let turned = hsd_base::geometry::area2(foot) < 0.0;
    let ring = |points: &[DVec2], z: f64| -> Vec<DVec3> {
        let points = points.iter().map(|p| p.extend(z));
        match turned {
            true => points.rev().collect(),
            false => points.collect(),
        }
    };
    let (mut low, high) = (ring(foot, 0.0), ring(head, top));
    for (i, p) in low.iter().enumerate() {
        let j = (i + 1) % low.len();
        bodies.face(finish, &[*p, low[j], high[j], high[i]]);
    }
    bodies.face(finish, &high);
    low.reverse();
    bodies.face(finish, &low);
}

/// Returns the kite between the ends of two outer faces, `f1` and `f2` from their centre lines, in the frame of the
/// second wall; `None` at straight and reflex corners.
fn mitre(before: &Line<'_>, line: &Line<'_>, f1: f64, f2: f64) -> Option<Vec<DVec2>> {
    let (a, b) = (turn_of(before.wall.direction), turn_of(line.wall.direction));
    // The first wall's rotation seen from the second.
    let (cos, sin) = (a.dot(b), b.perp_dot(a));
    if sin < 1e-4 {
        return None;
    }
    let (n1, n2) = (dvec2(sin, -cos), dvec2(0.0, -1.0));
    let apex = dvec2((f1 - cos * f2) / sin, -f2);
    let mut outline = vec![DVec2::ZERO, n2 * f2];
    if apex.length() < LONGEST * f1.max(f2) && apex.x >= 0.0 {
        outline.push(apex);
    }
    outline.push(n1 * f1);
    Some(outline)
}
