//! Fittings of a house: dimensions of platform, veranda, brackets, beams and finials. `fit` works them out,
//! `tessellate` draws them by detail. House frame, metres.

use crate::ast::{FinialKind, Rail};
use crate::material::SurfaceId;
use crate::source::Span;
use glam::{DVec2, DVec3};
use serde::Serialize;

/// One fitting.
#[derive(Clone, Debug, Serialize)]
pub struct Fitting {
    /// Its element.
    pub span: Span,
    /// The storey it belongs to, from 1; 0 = the house.
    pub storey: u32,
    /// Its kind and dimensions.
    pub what: Thing,
}

/// A fitting's kind and dimensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Thing {
    /// A stone platform.
    Platform(Platform),
    /// Boards round a storey.
    Veranda(Veranda),
    /// Bracket complexes and the beams on them.
    Brackets(Brackets),
    /// Tie beams before the posts of a storey.
    Beams(Vec<Beam>, SurfaceId),
    /// A finial on a roof.
    Finial(Finial),
}

/// A stone platform.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Platform {
    /// Its edge, counter-clockwise seen from above.
    pub outline: Vec<DVec2>,
    /// Ground and top.
    pub z: (f64, f64),
    /// Up to it.
    pub stairs: Vec<Stairs>,
}

/// A flight of steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stairs {
    /// The middle of its upper end, at the edge it leads to.
    pub at: DVec2,
    /// Down and out, unit length.
    pub out: DVec2,
    /// Across.
    pub width: f64,
    /// Foot and top.
    pub z: (f64, f64),
}

/// Boards round a storey.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Veranda {
    /// A stretch along each wall.
    pub sides: Vec<Deck>,
    /// The outline of the walls, counter-clockwise.
    pub walls: Vec<DVec2>,
    /// The height that carries it from below: the ground, or the storey's foot where brackets reach out from the walls.
    pub foot: f64,
    /// Its floor.
    pub top: f64,
    /// Whether it stands on the ground.
    pub grounded: bool,
    /// Railing.
    pub rail: Rail,
    /// Timber.
    pub paint: SurfaceId,
    /// Up to it.
    pub stairs: Vec<Stairs>,
}

/// The veranda along one wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Deck {
    /// At the wall, counter-clockwise round the house.
    pub inner: [DVec2; 2],
    /// At the edge.
    pub outer: [DVec2; 2],
    /// Posts of the wall, metres from its first corner.
    pub posts: Vec<f64>,
    /// The gap in its railing where stairs lead up: metres from the first corner of the edge.
    pub gap: Option<(f64, f64)>,
}

/// Bracket complexes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Brackets {
    /// On posts.
    pub heads: Vec<Head>,
    /// In the middle of bays: struts that carry the wall beams.
    pub struts: Vec<Head>,
    /// Beams and purlins over them.
    pub beams: Vec<Beam>,
    /// White wall between them.
    pub frieze: Vec<Beam>,
    /// The number of steps out.
    pub steps: u32,
    /// From the top of a post to that of the storey.
    pub height: f64,
    /// From the wall to the purlin.
    pub reach: f64,
    /// From the top of a post to the foot of the purlin.
    pub purlin: f64,
    /// Side of a post.
    pub post: f64,
    /// The least distance from post to post.
    pub bay: f64,
    /// Timber.
    pub paint: SurfaceId,
}

/// The place of a bracket complex: the middle of the top of a post.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Head {
    /// Where.
    pub at: DVec3,
    /// Out of the house.
    pub out: DVec2,
    /// Out of the house by the other wall of a corner.
    pub corner: Option<DVec2>,
}

/// A beam with upright sides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Beam {
    /// The middle of its ends at its foot.
    pub ends: [DVec3; 2],
    /// Across.
    pub width: f64,
    /// Upright.
    pub height: f64,
}

/// A finial on a roof.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finial {
    /// Which.
    pub kind: FinialKind,
    /// The apex, or the ends of the ridge it stands on.
    pub ridge: [DVec3; 2],
    /// Above it.
    pub height: f64,
    /// Logs between crossed boards.
    pub count: u32,
}
