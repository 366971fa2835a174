//! Straight skeletons: the areas swept by a plan's edges when all move inwards at one speed, for hipped roofs over any
//! outline.
//!
//! | file | idea |
//! |---|---|
//! | [`contour`] | an outline with courts prepared: turned one way, small dents left out, or the reason why it is invalid |
//! | [`wave`] | the moving outline: loops of corners, each on the way of two lines |
//! | `queue` | the next events |
//! | `collide` | handling of all events at one point |
//! | `faces` | one polygon for each edge from the paths of the corners |
//! | `verify` | checks that these tile the outline at the right heights |
//!
//! Nothing is exact here, so everything is checked afterwards; if the check fails, the corners are moved by a few
//! hundredths of a millimetre, always by the same amounts, and the sweep is repeated. No library with a compatible
//! licence computes this in f64.
//!
//! Frame: plan metres, whatever the origin; outlines counter-clockwise, courts clockwise, interior on the left. A time
//! is a distance from the edge, so the height of a roof of pitch p is p times the time.

use glam::DVec2;

mod collide;
pub mod contour;
pub(crate) mod eaves;
mod faces;
pub mod line;
pub(crate) mod pairs;
pub(crate) mod polygons;
mod queue;
mod verify;
pub mod wave;

pub use contour::{Contours, Invalid};

/// The tag of edges without eaves, above which a wall continues.
pub const FLUSH: u32 = 1;

/// A corner of the plan or a place where edges met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkeletonNode {
    /// Its position, metres.
    pub at: DVec2,
    /// Distance from the edges whose faces meet here, metres; 0 on the outline.
    pub time: f64,
}

/// An edge of the prepared outline and its face.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// The line of the edge.
    pub line: line::EdgeLine,
    /// The caller's tag of the edge.
    pub tag: u32,
    /// The edge before it in its ring.
    pub before: u32,
    /// Its nodes, counter-clockwise; the first two are the ends of the edge.
    pub nodes: Vec<u32>,
}

/// A straight skeleton.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    /// Corners first, in the order of the edges that start there.
    pub nodes: Vec<SkeletonNode>,
    /// One face for each edge.
    pub faces: Vec<Face>,
}

impl Skeleton {
    /// Returns the greatest distance from the outline, metres.
    pub fn depth(&self) -> f64 {
        self.nodes.iter().map(|n| n.time).fold(0.0, f64::max)
    }
}

/// The maximum number of attempts with moved corners.
const ATTEMPTS: u32 = 4;

/// Returns the skeleton of prepared contours; `None` if every attempt fails, which has happened with no tested outline.
///
/// Takes some microseconds per edge for plans of houses, and grows with the square of the edges.
pub fn skeleton(contours: &Contours) -> Option<Skeleton> {
    (0..ATTEMPTS).find_map(|attempt| {
        let moved = contours.shaken(attempt);
        let swept = collide::sweep(&moved)?;
        let skeleton = faces::faces(&moved, swept)?;
        verify::holds(&moved, &skeleton).then(|| contours.back(skeleton))
    })
}

#[cfg(test)]
#[path = "skeleton/tests.rs"]
mod tests;
