//! Houses as built: placed walls, the roofs over them, and their fittings.
//!
//! [`House`] is what `lower` makes: no turns and no rows, every wall has two ends. [`Built`] adds the result of
//! `roof`, regions that cover every uncovered area exactly once and closed solids over them, and of `fit`. Nothing in
//! it refers to another house; [`Building`] and [`Shell`] are lists of houses with the images that all of them use.
//!
//! Frames: plan points are (a, b) in U, the author frame. Solids are in the house frame: metres, x east,
//! y north, z up, before azimuth and origin; x = -a * unit, y = b * unit.

mod attic;
mod contact;
mod fixture;
mod room;
mod trim;
pub mod fittings;
mod surface;

pub use crate::building::trim::{Arch, Trim};
pub use attic::{Attic, Verge};
pub use fixture::{Fixture, OUTWARD};
pub use room::{Mat, Room};
pub use surface::meeting;
pub use surface::{Beside, EdgeKind, RoofEdge, RoofFacet, RoofSurface};

use crate::ast::{
    self, Finial, Ground, Order, PlacedBy, Platform, Rare, RoofKind, RoofShape, StoreyKind, Variant,
};
use crate::building::fittings::Fitting;
use crate::program::{Age, Picture, Put, Roofs, Unit};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_base::geometry::Heading;
use hsd_base::geometry::plan::Cell;
use hsd_base::source::Span;
use serde::{Serialize, Serializer};
use smallvec::SmallVec;
use std::sync::{Arc, OnceLock};

/// All houses of a run, complete.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Building {
    /// In the order of the documents.
    pub houses: Vec<Built>,
    /// Part images in use; units refer to them by index.
    pub images: Vec<Picture>,
}

/// One house, complete. It depends on its source, its id and the options of the run, never on other houses.
#[derive(Clone, Debug, Serialize)]
pub struct Built {
    /// Its walls.
    pub house: House,
    /// Its roofs; houses of one plan share them.
    #[serde(serialize_with = "shared")]
    pub roofs: Arc<HouseRoofs>,
    /// Platforms, verandas, brackets, finials.
    pub fittings: Vec<Fitting>,
    /// Its rooms, storey by storey.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rooms: Vec<Room>,
    /// What is built into its rooms, storey by storey.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<Fixture>,
}

fn shared<S: Serializer>(roofs: &Arc<HouseRoofs>, serializer: S) -> Result<S::Ok, S::Error> {
    roofs.as_ref().serialize(serializer)
}

/// All houses of a run with their walls placed, not yet roofed.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Shell {
    /// In the order of the documents.
    pub houses: Vec<House>,
    /// Part images in use.
    pub images: Vec<Picture>,
}

/// One house with its walls placed.
#[derive(Clone, Debug, Serialize)]
pub struct House {
    /// The whole house.
    pub span: Span,
    /// Its name, empty if it has none.
    pub name: String,
    /// The variant that it belongs to, if several are made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
    /// East, north, up of the origin, metres.
    pub origin: [f64; 3],
    /// The `Place` that put it there, if it is written elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placed: Option<PlacedBy>,
    /// Compass direction of the first line's outward normal, degrees.
    pub azimuth: f64,
    /// Metres in one U.
    pub unit: f64,
    /// True if the first line faces a street.
    pub street: bool,
    /// From the ground up.
    pub storeys: Vec<Storey>,
    /// Height of the first storey's floor above the ground, metres: that of a platform or a veranda. The house's
    /// origin is raised by it.
    pub raised: f64,
    /// How far its plinth reaches below the ground, metres.
    #[serde(skip_serializing_if = "is_zero")]
    pub plinth: f64,
    /// The platform below it.
    pub platform: Option<Platform>,
    /// The finials of its roofs.
    pub finials: Vec<Finial>,
    /// Parts on the ground beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub puts: Vec<Put>,
    /// Gravel, moss and paving beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub grounds: Vec<Ground>,
    /// Set if this is no house but an outdoor object of a town.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outdoors: Option<Box<ast::Outdoors>>,
    /// Its age; `None` = not weathered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub age: Option<Age>,
    /// The roof section.
    pub roofs: Rare<Roofs>,
}

fn is_zero(length: &f64) -> bool {
    *length == 0.0
}

impl House {
    /// Returns a plan point at a height, in the house frame.
    pub fn place(&self, p: DVec2, z: f64) -> DVec3 {
        dvec3(-p.x * self.unit, p.y * self.unit, z)
    }

    /// Returns a plan point in the world, metres east and north.
    pub fn world(&self, p: DVec2) -> DVec2 {
        let [east, north, _] = self.origin;
        let turn = Heading::new(180.0 - self.azimuth).vector();
        turn.rotate(dvec2(-p.x, p.y) * self.unit) + dvec2(east, north)
    }
}

/// One storey.
#[derive(Clone, Debug, Serialize)]
pub struct Storey {
    /// The element, or its lines.
    pub span: Span,
    /// Counted from 1; a parapet has the number of the storey it crowns.
    pub number: u32,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Its floor, metres above the house's origin.
    pub z0: f64,
    /// Its top, metres above the house's origin.
    pub z1: f64,
    /// Posts, veranda and brackets.
    pub order: Order,
    /// Outer walks and courtyards.
    pub rings: Vec<Ring>,
    /// Its rooms, as written.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rooms: Vec<ast::Room>,
    /// What is built into them, as written.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<ast::Fixture>,
}

impl Storey {
    /// Returns the height of its walls and posts below the brackets, metres.
    pub fn wall_height(&self) -> f64 {
        let height = self.z1 - self.z0;
        let brackets = self.order.brackets.as_ref();
        let zone = brackets.map_or(0.0, |b| b.zone() * hsd_base::geometry::SHAKU);
        (height - zone).max(height * 0.2)
    }
}

/// A walk round a part of the storey.
#[derive(Clone, Debug, Serialize)]
pub struct Ring {
    /// The element, or its lines.
    pub span: Span,
    /// True if the solid lies outside the ring, as for a courtyard.
    pub hole: bool,
    /// True if it bounds an area: it ends where it started, and crosses and touches nothing. Only such rings
    /// carry roofs; others are facades.
    pub closed: bool,
    /// True if it is a wall inside the storey, which needs no roof.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub inner: bool,
    /// Walls in walk order; each starts where the one before ends.
    pub walls: Vec<Wall>,
}

impl Ring {
    /// Returns true for a single straight wall inside its storey; lines that only turn the walk do not count.
    pub fn is_lone_wall(&self) -> bool {
        let long = |w: &&Wall| w.units.iter().any(|u| u.width > 0.0);
        self.inner && !self.closed && self.walls.iter().filter(long).count() == 1
    }

    /// Returns the corners in U in walk order from the start or its next corner; collinear points are merged, and the
    /// first corner is not repeated.
    pub fn corners(&self) -> Vec<DVec2> {
        let n = self.walls.len();
        let straight = |i: usize| {
            let before = &self.walls[(i + n - 1) % n];
            before.direction.perp_dot(self.walls[i].direction).abs() < 1e-9
                && before.direction.dot(self.walls[i].direction) > 0.0
        };
        (0..n)
            .filter(|&i| !straight(i))
            .map(|i| self.walls[i].from)
            .collect()
    }
}

/// One straight wall; lines without length leave none.
#[derive(Clone, Debug, Serialize)]
pub struct Wall {
    /// The line as written.
    pub span: Span,
    /// Number of the facade from 1, in walk order over the storey.
    pub facade: u32,
    /// Its right end as seen from outside, (a, b) in U.
    pub from: DVec2,
    /// Its left end.
    pub to: DVec2,
    /// Unit vector of the walk in the author frame; exact for right angles.
    pub direction: DVec2,
    /// Its parts from `from` to `to`; widths add up to the wall's length.
    pub units: Vec<Unit>,
    /// True if its glass is reflective.
    pub reflection: bool,
}

/// The roofs of one house.
#[derive(Clone, Debug, Default, Serialize)]
pub struct HouseRoofs {
    /// The plans of the automatic roofs, one for each storey that leaves something open.
    pub plans: Vec<StoreyPlan>,
    /// All roofs, automatic and written.
    pub roofs: Vec<Roof>,
    /// Planes at which walls end below their storey's top, under lean-tos.
    pub ceilings: Vec<Ceiling>,
    /// Undersides of storeys that stand out over the one below.
    pub soffits: Vec<Soffit>,
    /// The upper surfaces of the roofs, made when the first is asked for: nothing shows them from afar.
    #[serde(skip)]
    pub surfaces: OnceLock<Vec<RoofSurface>>,
}

impl HouseRoofs {
    /// Returns the upper surfaces of the automatic roofs over the regions of a storey. The street pent roof is not among them.
    pub fn over_regions(&self, storey: u32) -> impl Iterator<Item = &RoofSurface> {
        let automatic = |r: &Roof| r.span.is_none() && r.shape != RoofShape::Pent;
        let roofs = self.roofs.iter().zip(self.surfaces());
        let of = move |(roof, surface): (&Roof, _)| {
            (roof.storey == storey && automatic(roof)).then_some(surface)
        };
        roofs.filter_map(of)
    }

    /// Returns the upper surfaces of all roofs: facets, ridges, hips, valleys and the other edges.
    pub fn surfaces(&self) -> &[RoofSurface] {
        self.surfaces.get_or_init(|| contact::surfaces(&self.roofs))
    }
}

/// The automatic regions of one storey (docs/contract.md 5, `dump --stage regions`).
#[derive(Clone, Debug, Default, Serialize)]
pub struct StoreyPlan {
    /// Counted from 1.
    pub storey: u32,
    /// Top of the storey, metres.
    pub z: f64,
    /// The storey's outer corners in walk order, in U; one list a ring.
    pub outlines: Vec<Vec<DVec2>>,
    /// Its courtyards, walked the other way round.
    pub holes: Vec<Vec<DVec2>>,
    /// Sorted by (b0, a0).
    pub regions: Vec<PlanRegion>,
}

/// One automatic region in U.
#[derive(Clone, Debug, Serialize)]
pub struct PlanRegion {
    /// a0, b0, a1, b1 of its rectangle, or of its bounds if it has a polygon.
    pub rect: [f64; 4],
    /// The region's own outline if the plan is not orthogonal.
    pub polygon: Option<Vec<DVec2>>,
    /// "a" (parallel to the first line), "b" or none.
    pub ridge: Option<&'static str>,
    /// F, B, L, R of a lean-to.
    pub fall: Option<&'static str>,
    /// main, branch or lean-to; the strips of a lower roof are lean-tos of the shape YOS.
    pub role: &'static str,
    /// Its roof form.
    pub shape: RoofShape,
    /// Index of the trunk of a branch.
    pub over: Option<usize>,
}

/// One roof.
#[derive(Clone, Debug, Serialize)]
pub struct Roof {
    /// The storey it covers, from 1.
    pub storey: u32,
    /// Its line in the source, if it has one.
    pub span: Option<Span>,
    /// Its form.
    pub shape: RoofShape,
    /// Its covering.
    pub kind: RoofKind,
    /// Trim beyond its solids.
    pub trim: Trim,
    /// The space between its sheets and the walls.
    #[serde(skip)]
    pub attic: Attic,
    /// The closed solids of all plain roofs on its plate, metres, house frame: stored with the first of them, and only where
    /// detail 0 alone is asked for. They are drawn instead of `solids`, which then hold just the gable walls.
    #[serde(skip)]
    pub whole: Option<Vec<Solid>>,
    /// Closed solids in the house frame, metres.
    pub solids: Vec<Solid>,
}

impl Roof {
    /// Returns all closed solids that it has, whatever they are for.
    pub fn bodies(&self) -> impl Iterator<Item = &Solid> {
        self.solids.iter().chain(self.whole.iter().flatten())
    }
}

/// Boards, beams and brackets under the part of a storey that projects over the one below.
#[derive(Clone, Debug, Serialize)]
pub struct Soffit {
    /// The storey above it, from 1.
    pub storey: u32,
    /// Closed solids in the house frame, metres.
    pub solids: Vec<Solid>,
}

/// A closed polyhedron: every edge belongs to two faces that run along it in opposite directions.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Solid {
    /// Shared corners, metres.
    pub points: Vec<DVec3>,
    /// Plane faces, counter-clockwise seen from outside.
    pub faces: Vec<Face>,
}

/// Indices into the points of a solid, used as a slice. A town has millions of faces with three to six corners; up to
/// six are stored without an allocation.
pub type Corners = SmallVec<[u32; 6]>;

/// One plane face of a solid; convex, except on flat roofs, which may have any outline.
#[derive(Clone, Debug, Serialize)]
pub struct Face {
    /// Indices into the solid's points.
    pub corners: Corners,
    /// Its surface.
    pub finish: Finish,
}

/// The surface of a roof's face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum Finish {
    /// The covering seen on the slope.
    Covering(RoofKind),
    /// The covering's edge at eaves and verges.
    Edge(RoofKind),
    /// Sheathing and rafters seen from below.
    Soffit,
    /// The filled gable above the walls.
    Gable,
    /// Purlins and brackets.
    Timber,
    /// Parapets, hidden joints.
    Plaster,
}

/// Walls on the border of `cell` end at this plane instead of their storey's top.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ceiling {
    /// The storey, from 1.
    pub storey: u32,
    /// The rectangle in U: a0, b0, a1, b1.
    pub rect: [f64; 4],
    /// Height above the house's origin at (a, b): z + slope . (a, b), metres and metres in one U.
    pub z: f64,
    /// See `z`.
    pub slope: DVec2,
}

/// Returns the rectangle of a cell, given in integer steps, in U.
pub fn rect_of(cell: Cell) -> [f64; 4] {
    let u = |s: i64| s as f64 / hsd_base::geometry::STEPS as f64;
    [u(cell.a0), u(cell.b0), u(cell.a1), u(cell.b1)]
}
