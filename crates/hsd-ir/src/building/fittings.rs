//! Fittings of a house: dimensions of platform, veranda, brackets, beams and finials. `fit` works them out,
//! `tessellate` draws them by detail. House frame, metres.

use crate::ast::{FinialKind, GroundSurface, Rail};
use crate::catalog::PartId;
use crate::material::SurfaceId;
use glam::{DVec2, DVec3};
use hsd_base::source::Span;
use serde::Serialize;

/// One fitting.
#[derive(Clone, Debug, Serialize)]
pub struct Fitting {
    /// The source range of its element.
    pub span: Span,
    /// The storey it belongs to, from 1; 0 = the house.
    pub storey: u32,
    /// Its kind and dimensions.
    pub what: FittingKind,
}

/// A fitting's kind and dimensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum FittingKind {
    /// A stone platform.
    Platform(Platform),
    /// Boards round a storey.
    Veranda(Veranda),
    /// Bracket complexes and the beams on them.
    Brackets(Brackets),
    /// Tie beams in front of the posts of a storey.
    Beams(Vec<Beam>, SurfaceId),
    /// A finial on a roof.
    Finial(Finial),
    /// The base of a house on a slope.
    Plinth(Plinth),
    /// A part on the ground beside the house.
    Put(Put),
    /// Gravel, moss or paving.
    Ground(Ground),
}

/// A part that stands by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Put {
    /// The part.
    pub part: PartId,
    /// The middle of its foot.
    pub at: DVec3,
    /// Direction to its right as seen from before it, unit length.
    pub right: DVec2,
    /// Width and height.
    pub size: DVec2,
}

/// Ground that is covered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ground {
    /// With what.
    pub surface: GroundSurface,
    /// The middle of its foot.
    pub at: DVec3,
    /// The direction in which its width runs, unit length.
    pub along: DVec2,
    /// Width and depth.
    pub size: DVec2,
    /// Its top above its foot.
    pub thick: f64,
}

/// A stone platform.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Platform {
    /// Its edge, counter-clockwise seen from above.
    pub outline: Vec<DVec2>,
    /// Heights of ground and top.
    pub z: (f64, f64),
    /// Stairs up to it.
    pub stairs: Vec<Stairs>,
}

/// The base of a house on a slope: stone down to the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plinth {
    /// Its parts, counter-clockwise seen from above: under the walls, the platform, the decks of a veranda.
    pub outlines: Vec<Vec<DVec2>>,
    /// Heights of foot and top.
    pub z: (f64, f64),
}

/// A flight of steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stairs {
    /// The middle of its upper end, at the edge it leads to.
    pub at: DVec2,
    /// Direction down and out, unit length.
    pub out: DVec2,
    /// Width.
    pub width: f64,
    /// Heights of foot and top.
    pub z: (f64, f64),
}

impl Stairs {
    /// The depth of a step, metres.
    pub const TREAD: f64 = 0.3;

    /// Returns the number of risers, none higher than 20 cm unless the flight is endless.
    pub fn risers(&self) -> u32 {
        (((self.z.1 - self.z.0) / 0.2).ceil() as u32).clamp(1, 120)
    }

    /// Returns how far it extends from the edge it leads to, metres.
    pub fn run(&self) -> f64 {
        Stairs::TREAD * f64::from(self.risers())
    }

    /// Returns the corners of its plan: left and right at the top, right and left at the foot, seen from below.
    pub fn plan(&self) -> [DVec2; 4] {
        let half = DVec2::new(-self.out.y, self.out.x) * (self.width / 2.0);
        let foot = self.at + self.out * self.run();
        [self.at - half, self.at + half, foot + half, foot - half]
    }
}

/// Boards round a storey.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Veranda {
    /// One deck along each wall.
    pub sides: Vec<Deck>,
    /// The outline of the walls, counter-clockwise.
    pub walls: Vec<DVec2>,
    /// The height of what supports it: the ground, or the storey's foot if brackets project from the walls.
    pub foot: f64,
    /// Height of its floor.
    pub top: f64,
    /// True if it is supported from the ground.
    pub grounded: bool,
    /// The style of its railing.
    pub rail: Rail,
    /// Timber.
    pub paint: SurfaceId,
    /// Stairs up to it.
    pub stairs: Vec<Stairs>,
}

/// The veranda along one wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Deck {
    /// The line at the wall, counter-clockwise round the house.
    pub inner: [DVec2; 2],
    /// The line of the outer edge.
    pub outer: [DVec2; 2],
    /// Posts of the wall, metres from its first corner.
    pub posts: Vec<f64>,
    /// The gap in its railing where stairs lead up: metres from the first corner of the edge.
    pub gap: Option<(f64, f64)>,
}

/// Bracket complexes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Brackets {
    /// Complexes on posts.
    pub heads: Vec<Head>,
    /// Struts in the middle of bays, which carry the wall beams.
    pub struts: Vec<Head>,
    /// Beams and purlins over them.
    pub beams: Vec<Beam>,
    /// White wall panels between them.
    pub frieze: Vec<Beam>,
    /// The number of steps out.
    pub steps: u32,
    /// Height from the top of a post to that of the storey.
    pub height: f64,
    /// Distance from the wall to the purlin.
    pub reach: f64,
    /// Height from the top of a post to the foot of the purlin.
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
    /// Position.
    pub at: DVec3,
    /// Direction out of the house.
    pub out: DVec2,
    /// Direction out of the house by the other wall of a corner.
    pub corner: Option<DVec2>,
}

/// A beam with vertical sides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Beam {
    /// The centres of its ends, at its underside.
    pub ends: [DVec3; 2],
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

/// A finial on a roof.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finial {
    /// Its kind.
    pub kind: FinialKind,
    /// The apex, or the ends of the ridge that carries it.
    pub ridge: [DVec3; 2],
    /// Height above the ridge.
    pub height: f64,
    /// Number of billets between the forked finials.
    pub count: u32,
}
