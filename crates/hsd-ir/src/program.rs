//! The program of a house: only steps. No repeat, split list, random, replace or unknown code is left;
//! every unit knows its part and width. `expand` makes it, `lower` follows it.

use crate::ast::{
    Anchor, Era, Finial, Fixture, Ground, Order, PlacedBy, Platform, Purpose, Rare, RoofLine,
    RoofMethod, RoofMode, RoofStyle, Room, StoreyKind, Usual, Variant,
};
use crate::catalog::PartId;
use glam::DVec2;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;
use std::sync::LazyLock;

/// All houses of a run, in order.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Program {
    /// In the order of the documents.
    pub houses: Vec<House>,
    /// Part images in use, in the order of first use.
    pub pictures: Vec<Picture>,
}

/// An image that represents a whole part (003-01), found by its name.
#[derive(Clone, Debug, Serialize)]
pub struct Picture {
    /// The name by which a code refers to it.
    pub name: String,
    /// The path below one of the texture folders.
    pub path: String,
    /// Its size in pixels; it gives the proportion of a part without a width of its own.
    pub size: (u32, u32),
}

/// Index into [`Program::pictures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct PictureId(pub u32);

/// One house.
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
    /// How far its plinth reaches below its ground, metres.
    #[serde(skip_serializing_if = "is_zero")]
    pub plinth: f64,
    /// The point of the house that stands there.
    #[serde(skip_serializing_if = "is_corner")]
    pub anchor: Anchor,
    /// The `Place` that put it there, if it is written elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placed: Option<PlacedBy>,
    /// Compass direction of the first line's outward normal, degrees.
    pub azimuth: f64,
    /// One U in shaku.
    pub unit_shaku: f64,
    /// True if the first line faces a street.
    pub street: bool,
    /// What the house is for; it fills in what its roofs do not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub purpose: Option<Spanned<Purpose>>,
    /// From the ground up.
    pub storeys: Vec<Storey>,
    /// The platform under it.
    pub platform: Option<Platform>,
    /// The finial of its roofs.
    pub finials: Vec<Finial>,
    /// Parts on the ground beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub puts: Vec<Put>,
    /// Gravel, moss and paving beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub grounds: Vec<Ground>,
    /// Set if this is no house but an outdoor object of a town.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outdoors: Option<Box<crate::ast::Outdoors>>,
    /// Its age; `None` = no weathering.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub age: Option<Age>,
    /// The roof section.
    pub roofs: Rare<Roofs>,
}

fn is_zero(length: &f64) -> bool {
    *length == 0.0
}

fn is_corner(anchor: &Anchor) -> bool {
    *anchor == Anchor::Corner
}

/// A part that stands by itself on the ground beside a house.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Put {
    /// The element.
    pub span: Span,
    /// The part.
    pub part: PartId,
    /// Its middle in the author frame, U.
    pub at: DVec2,
    /// By how much it is turned clockwise from facing the front of the house, degrees.
    pub turn: f64,
    /// Its width, U.
    pub width: f64,
    /// Its height, shaku.
    pub height: f64,
}

/// The age of a house.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Age {
    /// Years since it was built.
    pub years: f64,
    /// Era of construction; parts of a later era were added later.
    pub era: Era,
    /// Random seed of the house, so that every part weathers differently.
    pub key: u64,
}

/// The roof section, with its defaults filled in.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Roofs {
    /// Automatic roofs or not.
    pub mode: RoofMode,
    /// The method of the automatic ones.
    pub method: RoofMethod,
    /// The place that requests roofs, if any: only then is an open plan an error.
    pub wished: Option<Span>,
    /// The style of automatic roofs.
    pub style: RoofStyle,
    /// The word that leaves their shape to what the house is for.
    pub by_use: Option<Span>,
    /// Written roofs.
    pub lines: Vec<RoofLine>,
    /// True if a note says already that the outline slants, so that one hip roof covers it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub slant_told: bool,
}

impl Usual for Roofs {
    fn usual() -> &'static Roofs {
        static USUAL: LazyLock<Roofs> = LazyLock::new(Roofs::default);
        &USUAL
    }
}

/// One storey.
#[derive(Clone, Debug, Serialize)]
pub struct Storey {
    /// The element, or its lines.
    pub span: Span,
    /// Height in shaku.
    pub height: f64,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Its posts, veranda and brackets; by default the house's.
    pub order: Order,
    /// Outer walks and courtyards.
    pub loops: Vec<Loop>,
    /// Its rooms.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rooms: Vec<Room>,
    /// What is built into them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<Fixture>,
}

/// A walk.
#[derive(Clone, Debug, Serialize)]
pub struct Loop {
    /// The element, or its lines.
    pub span: Span,
    /// True if the solid lies outside the loop.
    pub hole: bool,
    /// True if it is a wall inside the storey, which does not close.
    pub inner: bool,
    /// What its lines come from.
    pub drawn: Drawn,
    /// Start point (a, b) in U.
    pub start: (f64, f64),
    /// Wall lines in walk order.
    pub lines: Vec<WallLine>,
}

/// What the lines of a walk come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Drawn {
    /// Rows, which close exactly unless their angles are measured.
    Rows,
    /// The facades of a ring: a small closing error is distributed, not reported.
    Facades,
    /// The sides of an outline, which is closed, and squared as far as it may be.
    Outline,
}

/// One wall line, then a turn.
#[derive(Clone, Debug, Serialize)]
pub struct WallLine {
    /// The line as written.
    pub span: Span,
    /// From right to left as seen from outside.
    pub units: Vec<Unit>,
    /// The turn at the end, degrees, right positive; that of the last line is ignored, since the walk closes.
    pub turn: f64,
    /// True if the glass of this line is reflective.
    pub reflection: bool,
}

/// One step along a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unit {
    /// Its place in the source.
    pub span: Span,
    /// Width in U; 0 for posts and wing walls.
    pub width: f64,
    /// The content.
    pub content: Content,
    /// Height in shaku if given.
    pub height: Option<f32>,
    /// Share of light it reflects, if a `Texture` specifies it.
    pub reflection: Option<f32>,
    /// The image that its part's texture shows here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<PictureId>,
}

/// The content of a unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Content {
    /// Nothing: the walk goes on, no wall is built.
    Void,
    /// A part of the catalogue.
    Part(PartId),
    /// A part image.
    Picture(PictureId),
    /// Units above and below.
    Split(Box<Split>),
}

/// A unit divided into an upper and a lower half; both are as wide as the unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Split {
    /// Share of the height that the upper half takes.
    pub ratio: f64,
    /// Above, from right to left as seen from outside.
    pub upper: Vec<Unit>,
    /// Below.
    pub lower: Vec<Unit>,
}
