//! The walls of a storey and the areas between them, as rooms and fixtures see them.

use crate::fit::areas::{Areas, MOST};
use glam::DVec2;
use hsd_base::geometry::{holds, in_rings};
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{Fixture, Storey};

/// The plan of a storey.
pub(super) struct Plan<'h> {
    pub(super) storey: &'h Storey,
    /// Its place in `House::storeys`.
    pub(super) level: usize,
    pub(super) areas: Areas,
    /// The least and the greatest corner of its outer walls, U.
    pub(super) bounds: [DVec2; 2],
}

/// Why a storey has no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoPlan {
    /// Its outer walls, or those of a courtyard, do not close.
    Open,
    /// Its walls meet in too many places.
    Crowded,
}

/// Locates a point in a storey: in a wall, in a room, in an enclosed area without a room, or outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InStorey {
    /// A wall.
    Wall,
    /// Nothing: it is outside, in a courtyard, or walls do not close.
    Outside,
    /// The area of a room, by its number among those of the storey.
    Room(usize),
    /// An area without a room.
    Free,
}

/// A polygon with holes: its outline, then the outlines of the holes; U.
pub(super) type Area = Vec<Vec<DVec2>>;

/// From the edge of a fixture to the place before it where one stands, U.
const BEFORE: f64 = 0.2;

impl<'h> Plan<'h> {
    /// Works out the plan of a storey.
    pub(super) fn of(storey: &'h Storey, level: usize) -> Result<Plan<'h>, NoPlan> {
        let bounds = bounds(storey).ok_or(NoPlan::Open)?;
        let walls = walls(storey);
        if walls.len() + 4 * storey.fixtures.len() > MOST {
            return Err(NoPlan::Crowded);
        }
        Ok(Plan {
            storey,
            level,
            areas: Areas::new(&walls).ok_or(NoPlan::Crowded)?,
            bounds,
        })
    }

    /// Returns true for rooms under a roof or another storey, not for the wall round a flat roof.
    pub(super) fn is_storey(&self) -> bool {
        self.storey.kind == StoreyKind::Storey
    }

    /// Returns true for a point within the outer walls and in no courtyard.
    pub(super) fn holds(&self, p: DVec2) -> bool {
        let rings = self.storey.rings.iter();
        let closed = rings.filter(|r| r.closed && !r.inner);
        let around = closed.filter(|r| holds(&r.corners(), p));
        let (mut solid, mut court) = (false, false);
        for ring in around {
            (solid, court) = (solid || !ring.hole, court || ring.hole);
        }
        solid && !court
    }

    /// Returns what there is at a point.
    pub(super) fn at(&self, p: DVec2) -> InStorey {
        if self.areas.on_wall(p) {
            return InStorey::Wall;
        }
        let around = |p: DVec2| {
            let there = !self.areas.on_wall(p) && self.holds(p);
            self.areas.around(p).filter(|_| there)
        };
        let Some(walk) = around(p) else {
            return InStorey::Outside;
        };
        let mut rooms = self.storey.rooms.iter();
        let own = rooms.position(|r| around(r.at.value.into()) == Some(walk));
        own.map_or(InStorey::Free, InStorey::Room)
    }

    /// Returns true if a wall runs through a rectangle, not only along its edges.
    pub(super) fn crosses(&self, fixture: &Fixture) -> bool {
        let mut walls = walls(self.storey).into_iter();
        walls.any(|(from, to)| runs_through(from, to, fixture.low, fixture.high))
    }

    /// Returns the place before an edge of a rectangle, U.
    pub(super) fn before(fixture: &Fixture, way: DVec2) -> DVec2 {
        fixture.edge(way) + way * BEFORE
    }

    /// Returns the place at the top of stairs, U.
    pub(super) fn landing(stairs: &Fixture) -> DVec2 {
        Plan::before(stairs, -stairs.faces.outward())
    }

    /// Cuts other areas out of those of the storey; `None` if there are none, or if walls and outlines meet in too many places.
    pub(super) fn without(&self, taken: Vec<Area>) -> Option<Rest<'_, 'h>> {
        if taken.is_empty() {
            return None;
        }
        let mut walls = walls(self.storey);
        for ring in taken.iter().flatten() {
            let next = ring.iter().cycle().skip(1);
            walls.extend(ring.iter().copied().zip(next.copied()));
        }
        Some(Rest {
            plan: self,
            areas: Areas::new(&walls)?,
            taken,
        })
    }
}

/// The areas of a storey with other areas cut out of them.
pub(super) struct Rest<'p, 'h> {
    plan: &'p Plan<'h>,
    areas: Areas,
    taken: Vec<Area>,
}

impl Rest<'_, '_> {
    /// Returns the pieces of an area, and for each whether it is taken.
    fn parts(&self, walk: usize) -> impl Iterator<Item = (usize, bool)> {
        self.areas.walks().filter_map(move |part| {
            let point = self.areas.point_in(part)?;
            let own = self.plan.areas.around(point) == Some(walk);
            own.then(|| (part, self.taken.iter().any(|area| in_rings(area, point))))
        })
    }

    /// Returns the pieces that are left of an area.
    pub(super) fn pieces(&self, walk: usize) -> Vec<Area> {
        let left = self.parts(walk).filter(|(_, taken)| !taken);
        left.map(|(part, _)| self.areas.area(part)).collect()
    }

    /// Returns true if nothing of an area is taken.
    pub(super) fn is_whole(&self, walk: usize) -> bool {
        !self.parts(walk).any(|(_, taken)| taken)
    }

    /// Returns true if all of an area is taken.
    pub(super) fn is_gone(&self, walk: usize) -> bool {
        let mut parts = self.parts(walk).peekable();
        parts.peek().is_some() && parts.all(|(_, taken)| taken)
    }
}

/// Returns the ends of all walls, U.
fn walls(storey: &Storey) -> Vec<(DVec2, DVec2)> {
    let walls = storey.rings.iter().flat_map(|ring| &ring.walls);
    walls.map(|wall| (wall.from, wall.to)).collect()
}

/// Returns the bounds of the outer walls, U; none where they, or those of a courtyard, do not close.
fn bounds(storey: &Storey) -> Option<[DVec2; 2]> {
    let rings = || storey.rings.iter().filter(|r| !r.inner);
    let corners = rings().flat_map(|r| &r.walls).map(|w| w.from);
    let around = corners.fold(None, |around: Option<[DVec2; 2]>, p| {
        let [low, high] = around.unwrap_or([p, p]);
        Some([low.min(p), high.max(p)])
    });
    around.filter(|_| rings().all(|r| r.closed))
}

/// Returns true if a line from one point to another meets the inside of a rectangle.
fn runs_through(from: DVec2, to: DVec2, low: DVec2, high: DVec2) -> bool {
    /// Walls along an edge do not count, nor do those that reach in by less than a finger, U.
    const TOUCH: f64 = 0.02;
    let (low, high) = (low + TOUCH, high - TOUCH);
    let way = to - from;
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for (at, way, low, high) in [
        (from.x, way.x, low.x, high.x),
        (from.y, way.y, low.y, high.y),
    ] {
        if way.abs() < 1e-12 {
            if at <= low || at >= high {
                return false;
            }
            continue;
        }
        let (one, other) = ((low - at) / way, (high - at) / way);
        start = start.max(one.min(other));
        end = end.min(one.max(other));
    }
    start < end
}
