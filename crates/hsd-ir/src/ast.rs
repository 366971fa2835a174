//! The document as written, from either syntax: every construct that the author used, with its place.
//!
//! Invariants: spans lie in the source; numbers are finite (the readers report others and leave them out); elements
//! nest at most `Limits::nesting` deep. Codes are still strings: only `expand`, which opens the catalogue, decides
//! whether a part exists.

mod era;
mod fittings;
mod fixtures;
mod frame;
mod monuments;
mod outdoors;
mod outline;
mod parts;
mod pieces;
mod purpose;
mod rare;
mod rooms;
mod roofs;
pub mod town;
mod value;
mod view;

pub use era::Era;
pub use fittings::{
    Brackets, Finial, FinialKind, Fittings, Ground, GroundSurface, Order, Paint, Platform, Posts,
    Put, Rail, Side, Veranda,
};
pub use fixtures::{Fixture, FixtureKind};
pub use frame::{Anchor, Frame, PlacedBy, Placement};
pub use monuments::{Gate, Given, Hall, Measures, Monument, Pagoda, Pair};
pub use outdoors::{
    Fence, Outdoor, Outdoors, Railway, Road, Sheet, Species, Surface, Tree, TreeWish,
};
pub use outdoors::{land, law, street};
pub use outline::{Hole, On, Outline, OutlinePart, Points, SidePart, SideWall, Stand, Walls};
pub use parts::{WrittenAttribute, WrittenBody, WrittenPart, attribute_value};
pub use pieces::{CodeText, Half, Part, Piece, Split};
pub use purpose::Purpose;
pub use rare::{Rare, Usual};
pub use roofs::{
    GableWall, RoofDirection, RoofKind, RoofLine, RoofMethod, RoofMode, RoofShape, RoofStyle, Roofs,
};
pub use rooms::{Flooring, MatOrder, Room, RoomCeiling};
pub use value::{Parameter, Value};
pub use view::{NamedView, ViewTime};

use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// All houses of one file.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Document {
    /// In the order of the file.
    pub houses: Vec<House>,
    /// The town, if the file is one; its houses are made from its maps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub town: Option<Box<town::Town>>,
    /// The parameters of the file and its houses, and of the files it includes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<Parameter>,
    /// Custom parts that every house of the file may use.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<WrittenPart>,
    /// Named views, each name once.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub views: Vec<NamedView>,
    /// The variant that this document belongs to, if several are made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
}

/// One of several houses, or groups of houses, built from one file; each makes its random choices with a seed of its
/// own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Variant {
    /// From 0.
    pub number: u32,
    /// The seed with which the file alone builds the same variant.
    pub seed: u64,
}

/// One house: settings, then storeys or facades, then roofs.
#[derive(Clone, Debug, Default, Serialize)]
pub struct House {
    /// The whole house.
    pub span: Span,
    /// Its name, if it has one.
    pub name: Option<Spanned<String>>,
    /// The header values.
    pub settings: Rare<Settings>,
    /// Storey heights of a legacy header in shaku; a missing one is the default.
    pub heights: Vec<Spanned<f64>>,
    /// Storeys from the ground up.
    pub storeys: Vec<Item<Storey>>,
    /// The outline of storeys without rows, if it is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outline: Option<Box<Outline>>,
    /// Walls given facade by facade (the `Structure` of 003), if the house is written that way.
    pub structures: Vec<Structure>,
    /// The monument, if the house is written as one element.
    pub monument: Option<Box<Monument>>,
    /// Fittings of the house.
    pub fittings: Rare<Fittings>,
    /// Gloss of single textures (003-13).
    pub textures: Vec<Texture>,
    /// The roof section.
    pub roofs: Rare<Roofs>,
    /// The groups around it, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placement: Option<Box<Placement>>,
    /// Custom parts known only in this house.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<WrittenPart>,
}

impl House {
    /// Returns true if something stands outdoors beside it, or alone: parts, or covered ground.
    pub fn stands_outdoors(&self) -> bool {
        !self.fittings.puts.is_empty() || !self.fittings.grounds.is_empty()
    }
}

/// Values that hold for a whole house; `None` means the default of docs/contract.md.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Settings {
    /// Metres east of the house's origin.
    pub x: Option<Spanned<f64>>,
    /// Metres north of the house's origin.
    pub y: Option<Spanned<f64>>,
    /// The point of the house that stands there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub anchor: Option<Anchor>,
    /// Height of the house's origin, metres.
    pub z: Option<Spanned<f64>>,
    /// How far its plinth reaches below its ground, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plinth: Option<Spanned<f64>>,
    /// Compass direction of the first line's outward normal, degrees; 180 = south.
    pub azimuth: Option<Spanned<f64>>,
    /// One U in shaku: 3.0 Edo-ma, 3.25 Kyo-ma.
    pub unit: Option<Spanned<f64>>,
    /// Seed of all random choices.
    pub seed: Option<Spanned<u64>>,
    /// True if the first line faces a street.
    pub street: Option<Spanned<bool>>,
    /// What the house is for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub purpose: Option<Spanned<Purpose>>,
    /// Years since it was built; without it nothing weathers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub age: Option<Spanned<f64>>,
    /// Era of construction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub era: Option<Spanned<Era>>,
}

/// An item of a list, or an operation on the items beside it. Operations are rare and boxed, so that they do not
/// enlarge the items.
#[derive(Clone, Debug, Serialize)]
pub enum Item<T> {
    /// A single item.
    One(T),
    /// The content several times (003-08).
    Repeat(Box<Repeat<T>>),
    /// A random choice (003-10).
    Random(Box<Random>),
    /// A substitution (003-11).
    Replace(Box<Replace>),
}

/// `<repeat num="8">`.
#[derive(Clone, Debug, Serialize)]
pub struct Repeat<T> {
    /// The start tag.
    pub span: Span,
    /// Number of repetitions; 0 leaves the content out.
    pub num: Spanned<u32>,
    /// The repeated content.
    pub body: Vec<Item<T>>,
}

/// `<random code="a 2, b">`: an edit where the enclosing element has parts of its own, otherwise a slot.
#[derive(Clone, Debug, Serialize)]
pub struct Random {
    /// The element.
    pub span: Span,
    /// The list as written, not yet divided.
    pub codes: Spanned<String>,
    /// Weights, as many as codes.
    pub weights: Option<Spanned<Vec<f64>>>,
}

/// `<replace code="x y" with="z" at="2,5-7"/>`.
#[derive(Clone, Debug, Serialize)]
pub struct Replace {
    /// The element.
    pub span: Span,
    /// The list as written; `None` = every part at the positions.
    pub codes: Option<Spanned<String>>,
    /// The replacement.
    pub with: Spanned<String>,
    /// Positions from 1, as inclusive ranges; `None` = everywhere.
    pub at: Option<Spanned<Vec<(u32, u32)>>>,
}

/// The kind of a storey.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum StoreyKind {
    /// Rooms, and a roof above them.
    #[default]
    Storey,
    /// A wall round the flat roof of the storey below; not counted.
    Parapet,
}

/// One storey of a house.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Storey {
    /// The element, or its lines.
    pub span: Span,
    /// Height in shaku.
    pub height: Option<Spanned<f64>>,
    /// Start point (a, b) in U, author frame.
    pub start: Option<Spanned<(f64, f64)>>,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Its own posts, veranda and brackets.
    pub order: Order,
    /// Rows that stand in the storey itself form one loop; further ones are courtyards or wings.
    pub loops: Vec<Loop>,
    /// What stands on the sides of the house's outline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub walls: Option<Box<Walls>>,
    /// Its rooms, in the order of the file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rooms: Vec<Room>,
    /// Its fixtures, such as stairs and alcoves, in the order of the file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixtures: Vec<Fixture>,
    /// `random` and `replace` directly in the storey: edits of all its rows.
    pub edits: Vec<Edit>,
}

/// An operation on a whole storey or floor, in document order.
#[derive(Clone, Debug, Serialize)]
pub enum Edit {
    /// A random choice.
    Random(Random),
    /// A substitution.
    Replace(Replace),
}

/// A closed walk.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Loop {
    /// The element, or its lines.
    pub span: Span,
    /// True for a courtyard, whose solid lies outside the loop.
    pub hole: bool,
    /// True for a wall inside the storey, which does not close.
    pub inner: bool,
    /// Start point (a, b) in U, author frame.
    pub start: Option<Spanned<(f64, f64)>>,
    /// Wall lines.
    pub rows: Vec<Item<Row>>,
}

/// One wall line and the turn at its end.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Row {
    /// The line without its line end; the whole element in XML.
    pub span: Span,
    /// Parts from right to left as seen from outside.
    pub pieces: Vec<Item<Piece>>,
    /// The turn at the end, in degrees, right positive; `None` = the default of its loop.
    pub turn: Option<Spanned<f64>>,
}

/// Walls given facade by facade (003-12, 003-15).
#[derive(Clone, Debug, Serialize)]
pub struct Structure {
    /// The start tag.
    pub span: Span,
    /// Size; a facade is size x ratio x scale metres wide. `None` = not given.
    pub size: Option<Spanned<f64>>,
    /// Metres per size unit.
    pub scale: Option<Spanned<f64>>,
    /// True if parts run from left to right as seen from outside (default: to the left).
    pub rightwards: bool,
    /// Clockwise seen from above.
    pub facades: Vec<Item<Facade>>,
}

/// One plane wall over all storeys.
#[derive(Clone, Debug, Serialize)]
pub struct Facade {
    /// The start tag.
    pub span: Span,
    /// Its name in names of part images; without one, its number from 1.
    pub id: Option<Spanned<String>>,
    /// Share of the structure's size.
    pub ratio: Option<Spanned<f64>>,
    /// Turn from the previous facade's direction, degrees, right positive; `None` = 0 for the first, 90.
    pub angle: Option<Spanned<f64>>,
    /// True if its glass reflects the surroundings.
    pub reflection: bool,
    /// From the ground up.
    pub floors: Vec<Item<Floor>>,
}

/// The part of a facade that belongs to one storey.
#[derive(Clone, Debug, Serialize)]
pub struct Floor {
    /// The start tag.
    pub span: Span,
    /// Its name; `k` in it stands for the storey's number.
    pub id: Option<Spanned<String>>,
    /// Height in shaku.
    pub height: Option<Spanned<f64>>,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Parts and, in document order among them, edits or slots.
    pub pieces: Vec<Item<Piece>>,
}

/// `<Texture texturecode="x" reflection="0.5"/>`.
#[derive(Clone, Debug, Serialize)]
pub struct Texture {
    /// The element.
    pub span: Span,
    /// The part or image it applies to.
    pub code: Spanned<String>,
    /// Share of light that it reflects, 0 to 1.
    pub reflection: Option<Spanned<f64>>,
    /// The image file of the code.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub src: Option<Picture>,
}

/// The path of an image file, relative to the file in which it is written.
#[derive(Clone, Debug, Serialize)]
pub struct Picture {
    /// Its path.
    pub path: Spanned<String>,
    /// The name of the file in which the path is written.
    pub from: String,
}
