//! A storey as input to its roofs: its plan in steps, and the parapet on it.

use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_base::geometry::plan::Plan;
use hsd_base::geometry::steps;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{House, Ring, Storey};

/// A corner in plan steps.
pub(crate) type Point = (i64, i64);

/// One storey as input to the roof construction.
#[derive(Clone, Debug)]
pub(crate) struct Level<'h> {
    /// The storey.
    pub(crate) storey: &'h Storey,
    /// The region inside its closed rings.
    pub(crate) plan: Plan,
    /// True if all its walls are parallel to the axes of the plan.
    pub(crate) orthogonal: bool,
    /// True if a parapet stands on it.
    pub(crate) parapet: bool,
}

impl Level<'_> {
    /// Returns true if no ring bounds an area.
    pub(crate) fn is_open(&self) -> bool {
        self.plan.loops.is_empty()
    }

    /// Returns the closed rings, outer ones or courtyards.
    pub(crate) fn rings(&self, holes: bool) -> impl Iterator<Item = &Ring> {
        self.storey
            .rings
            .iter()
            .filter(move |r| r.closed && r.hole == holes)
    }
}

/// Returns the storeys of a house from the ground up, without parapets.
pub(crate) fn levels(house: &House) -> Vec<Level<'_>> {
    let mut levels: Vec<Level<'_>> = Vec::with_capacity(house.storeys.len());
    for storey in &house.storeys {
        let rings = storey.rings.iter().filter(|r| r.closed);
        if storey.kind == StoreyKind::Parapet {
            if let Some(below) = levels.last_mut() {
                below.parapet |= rings.count() > 0;
            }
            continue;
        }
        let plan = Plan {
            loops: rings.map(corners).filter(|l| l.len() > 2).collect(),
        };
        let orthogonal = plan.is_orthogonal();
        levels.push(Level {
            storey,
            plan,
            orthogonal,
            parapet: false,
        });
    }
    levels
}

/// Returns the corners of a ring in steps; points in mid-wall are harmless to a plan.
fn corners(ring: &Ring) -> Vec<Point> {
    ring.corners().into_iter().map(point).collect()
}

/// Converts a plan point to steps.
pub(crate) fn point(p: DVec2) -> Point {
    (steps(p.x), steps(p.y))
}

/// Returns the first wall line of a storey with all collinear walls, in walk order.
pub(crate) fn first_line(storey: &Storey) -> Option<(Point, Point)> {
    let ring = storey.rings.first()?;
    let first = ring.walls.first()?;
    let straight = |w: &&hsd_ir::building::Wall| {
        w.direction.perp_dot(first.direction).abs() < 1e-9 && w.direction.dot(first.direction) > 0.0
    };
    let last = ring.walls.iter().take_while(straight).last()?;
    let before = if ring.closed {
        ring.walls.iter().rev().take_while(straight).last()
    } else {
        None
    };
    Some((point(before.unwrap_or(first).from), point(last.to)))
}

/// Returns true if a walk is a standalone facade, not a ring that fails to close: it turns by no more than
/// half a circle (docs/contract.md 2).
pub(crate) fn is_facade(ring: &Ring) -> bool {
    let turn = |w: &[hsd_ir::building::Wall]| {
        let (p, q) = (w[0].direction, w[1].direction);
        libm::atan2(p.perp_dot(q), p.dot(q))
    };
    let turned: f64 = ring.walls.windows(2).map(turn).sum();
    // Walls that cross or touch return to their start all the same.
    let returns = match &ring.walls[..] {
        [first, .., last] => first.from.distance(last.to) < SAME,
        _ => false,
    };
    !ring.closed && !ring.hole && !returns && turned <= std::f64::consts::PI + 1e-6
}
