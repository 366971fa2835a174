//! Outlines as surveyed, and the walls that stand on their sides (docs/contract.md 8).

use super::{CodeText, Half, Item, Piece};
use glam::DVec2;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// The outline of a house in metres: the walk of every storey without rows of its own.
#[derive(Clone, Debug, Serialize)]
pub struct Outline {
    /// The element.
    pub span: Span,
    /// Its corners: metres east and north of the house's place, in either direction.
    pub points: Points,
    /// Farthest that a corner may move to make the walls square, metres; 0 = none may.
    pub square: Option<Spanned<f64>>,
    /// Farthest that a wall may move onto the line of another, metres.
    pub join: Option<Spanned<f64>>,
    /// The number of the side that is the first line, from 1.
    pub front: Option<Spanned<u32>>,
    /// The sides on streets, as inclusive ranges.
    pub street: Option<Spanned<Vec<(u32, u32)>>>,
    /// The sides on which a neighbour stands, as inclusive ranges.
    pub neighbour: Option<Spanned<Vec<(u32, u32)>>>,
    /// How the house stands.
    pub stand: Stand,
    /// Its courtyards.
    pub holes: Vec<Hole>,
}

/// Corners with their places in the text.
pub type Points = Spanned<Vec<Spanned<DVec2>>>;

/// How a house with an outline stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Stand {
    /// As surveyed, then turned by these degrees clockwise about the house's place.
    Surveyed(f64),
    /// As any house: the right end of its front at its place, the front facing its azimuth.
    Facing,
}

/// A courtyard in an outline.
#[derive(Clone, Debug, Serialize)]
pub struct Hole {
    /// The element.
    pub span: Span,
    /// Its corners, as those of the outline.
    pub points: Points,
}

/// What stands on the sides of an outline, in one storey.
#[derive(Clone, Debug, Serialize)]
pub struct Walls {
    /// The start tag.
    pub span: Span,
    /// The part of the outline that they stand on, if not the whole.
    pub part: Option<OutlinePart>,
    /// The part of walls that nothing else fills.
    pub rest: Option<Spanned<CodeText>>,
    /// In the order of the file.
    pub sides: Vec<SideWall>,
}

/// A rectangle in an outline, along its longest side (002-25).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OutlinePart {
    /// Its share of the extent along the longest side, and across it.
    pub shares: [f64; 2],
    /// Its place in the rest, along and across: 0 = at the front or at the right end, 1 = at the other.
    pub at: [f64; 2],
}

/// The wall of sides of one kind.
#[derive(Clone, Debug, Serialize)]
pub struct SideWall {
    /// The element.
    pub span: Span,
    /// Which sides.
    pub on: Spanned<On>,
    /// Its parts from right to left as seen from outside.
    pub parts: Vec<SidePart>,
}

/// A kind of side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum On {
    /// The side with this number, from 1.
    Number(u32),
    /// The first line.
    Front,
    /// On a street.
    Street,
    /// A neighbour stands there.
    Neighbour,
    /// Round a courtyard.
    Court,
    /// Opposite the front, within 45 degrees.
    Back,
    /// Along the longest side, within 45 degrees.
    Long,
    /// Across the longest side.
    Short,
    /// All others.
    Any,
}

/// A stretch of a side.
#[derive(Clone, Debug, Serialize)]
pub enum SidePart {
    /// Parts of a width of their own.
    Pieces(Vec<Item<Piece>>),
    /// Parts that are repeated and stretched until the side is full.
    Fill(Half),
    /// Parts that stand once in the house.
    Door(Half),
}
