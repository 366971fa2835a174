//! The places of houses that are moved and turned together.

use glam::{DVec2, dvec2};
use hsd_base::geometry::Heading;
use hsd_base::source::Span;
use serde::Serialize;

/// A frame of metres east, north and up, turned clockwise as seen from above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Frame {
    /// Its origin, metres.
    pub origin: [f64; 3],
    /// Degrees clockwise.
    pub turn: f64,
}

impl Frame {
    /// Returns a frame inside this one in terms of the world.
    #[must_use]
    pub fn within(&self, inner: Frame) -> Frame {
        Frame {
            origin: self.point(inner.origin),
            turn: self.turn + inner.turn,
        }
    }

    /// Returns a point of the frame in the world.
    pub fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let turned = self.turned(dvec2(x, y), -self.turn);
        let [east, north, up] = self.origin;
        [east + turned.x, north + turned.y, up + z]
    }

    /// Returns a place of the world in the frame: metres east and north.
    pub fn local(&self, place: DVec2) -> DVec2 {
        let [east, north, _] = self.origin;
        self.turned(place - dvec2(east, north), self.turn)
    }

    fn turned(&self, place: DVec2, degrees: f64) -> DVec2 {
        Heading::new(degrees).vector().rotate(place)
    }
}

/// The point of a house that stands at its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Anchor {
    /// The origin: the right end of the front.
    #[default]
    Corner,
    /// The centre of the ground storey's bounds.
    Centre,
}

/// The groups around a house, and the `Place` that put it there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Placement {
    /// All groups around it together. The settings of the house count in the world already.
    pub frame: Frame,
    /// The innermost `Place`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<PlacedBy>,
}

/// A `Place` that put a house somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlacedBy {
    /// Its start tag.
    pub span: Span,
    /// True if the house is a type of the library, which is no file that an author could change.
    pub library: bool,
}
