//! Shared geometry: headings with exact right angles, named tolerances, exact plan numbers.
//!
//! Two plan frames (docs/contract.md 1): the author frame (a, b) in U, a to the LEFT along the first line and
//! b BACK into the plot; and the house frame in metres, east = -a, north = +b, turned by the azimuth only
//! in the scene. Walking with the interior on the right is clockwise from above; in (a, b) read as
//! (x, y) the same walk turns counter-clockwise, so its signed area is positive.

pub mod clip;
pub mod convex;
pub mod envelope;
pub mod grid;
pub mod outline;
pub mod overlap;
pub mod plan;
pub mod tolerance;
pub mod triangulate;

pub use tolerance::SAME;

use glam::{DVec2, dvec2};

/// Height of the ground sill above the ground, metres: that of the foundation stones of a house without a platform or a
/// veranda.
pub const FOUNDATION: f64 = 0.285;
/// One shaku in metres (law of 1891).
pub const SHAKU: f64 = 10.0 / 33.0;

/// Integer steps in one U: six decimals are exact, including quarters.
pub const STEPS: i64 = 1_000_000;

/// Returns a plan coordinate in integer steps.
pub fn steps(u: f64) -> i64 {
    (u * STEPS as f64).round() as i64
}

/// The direction of a walk, in degrees clockwise seen from above from the first line's heading (+a);
/// 0 <= degrees < 360.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Heading(f64);

impl Heading {
    /// Creates a heading from degrees, right positive.
    pub fn new(degrees: f64) -> Heading {
        let turned = degrees.rem_euclid(360.0);
        Heading(if turned >= 360.0 { 0.0 } else { turned })
    }

    /// Returns the degrees from the first heading.
    pub fn degrees(self) -> f64 {
        self.0
    }

    /// Returns the heading turned to the right by `degrees`.
    #[must_use]
    pub fn turned(self, degrees: f64) -> Heading {
        Heading::new(self.0 + degrees)
    }

    /// Returns the unit vector in the author frame; exact for right angles.
    pub fn vector(self) -> DVec2 {
        match self.0 {
            0.0 => dvec2(1.0, 0.0),
            90.0 => dvec2(0.0, 1.0),
            180.0 => dvec2(-1.0, 0.0),
            270.0 => dvec2(0.0, -1.0),
            // `libm`, since the sine of the platform differs between machines.
            d => dvec2(libm::cos(d.to_radians()), libm::sin(d.to_radians())),
        }
    }
}

/// Returns true if a polygon contains a point.
pub fn holds(polygon: &[DVec2], p: DVec2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(next).filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// Returns true if polygons with holes contain a point: an odd number of their outlines does.
pub fn in_rings(rings: &[Vec<DVec2>], p: DVec2) -> bool {
    rings.iter().filter(|ring| holds(ring, p)).count() % 2 == 1
}

/// Returns twice the signed area of a closed polygon; positive = interior on the right of the walk.
pub fn area2(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum()
}
