//! From plan to metres: rectangles and planes in the house frame, and the frame of one roof.
//!
//! A roof's frame has its origin at a low side: u runs along that side, v goes in from it, both in metres. The frame is
//! right-handed seen from above whatever the side, so a shape is written once and never mirrored.

use crate::region::{Ridge, Side};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::Cell;

/// A rectangle in the house frame, metres: x east, y north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Least corner.
    pub min: DVec2,
    /// Greatest corner.
    pub max: DVec2,
}

impl Rect {
    /// Converts a cell of plan steps to the house frame; `unit` is one U in metres.
    pub fn of(cell: &Cell, unit: f64) -> Rect {
        let at = |s: i64| metres(s, unit);
        Rect {
            min: dvec2(-at(cell.a1), at(cell.b0)),
            max: dvec2(-at(cell.a0), at(cell.b1)),
        }
    }

    /// Returns the rectangle enlarged by a distance on every side, metres.
    #[must_use]
    pub fn grown(self, by: f64) -> Rect {
        Rect {
            min: self.min - by,
            max: self.max + by,
        }
    }

    /// Returns the corners, counter-clockwise seen from above.
    pub fn corners(&self) -> [DVec2; 4] {
        [
            self.min,
            dvec2(self.max.x, self.min.y),
            self.max,
            dvec2(self.min.x, self.max.y),
        ]
    }

    /// Returns true if two rectangles share area, not merely a border.
    pub fn overlaps(&self, other: &Rect) -> bool {
        self.min.cmplt(other.max).all() && other.min.cmplt(self.max).all()
    }
}

/// Returns the bounding box of some corners.
pub(crate) fn round(corners: impl Iterator<Item = DVec2>) -> Rect {
    let none = Rect {
        min: DVec2::MAX,
        max: DVec2::MIN,
    };
    corners.fold(none, |r: Rect, p| Rect {
        min: r.min.min(p),
        max: r.max.max(p),
    })
}

/// Converts plan steps to metres.
pub fn metres(steps: i64, unit: f64) -> f64 {
    steps as f64 / STEPS as f64 * unit
}

/// A plane z = `z` + `slope` . (x, y) over the house frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Height over the origin.
    pub z: f64,
    /// Rise per metre along x and y.
    pub slope: DVec2,
}

impl Plane {
    /// Creates a level plane.
    pub fn level(z: f64) -> Plane {
        Plane {
            z,
            slope: DVec2::ZERO,
        }
    }

    /// Returns the plane through three points; `None` if they are collinear in plan.
    pub fn through([p, q, r]: [DVec3; 3]) -> Option<Plane> {
        let normal = (q - p).cross(r - p);
        let slope = -normal.truncate() / normal.z;
        (normal.z.abs() > 1e-9).then(|| Plane {
            z: p.z - slope.dot(p.truncate()),
            slope,
        })
    }

    /// Returns the plane of a flat polygon; `None` if it is vertical or has no area.
    pub fn around(points: impl Iterator<Item = DVec3> + Clone) -> Option<Plane> {
        let first = points.clone().next()?;
        let next = points.clone().skip(1);
        let fan = points.zip(next).skip(1);
        let normal: DVec3 = fan.map(|(p, q)| (p - first).cross(q - first)).sum();
        let slope = -normal.truncate() / normal.z;
        slope.is_finite().then(|| Plane {
            z: first.z - slope.dot(first.truncate()),
            slope,
        })
    }

    /// Returns the height over a point.
    pub fn at(&self, p: DVec2) -> f64 {
        self.z + self.slope.dot(p)
    }

    /// Returns the plane raised by a height, metres.
    #[must_use]
    pub fn raised(self, by: f64) -> Plane {
        Plane {
            z: self.z + by,
            ..self
        }
    }
}

/// The frame of one roof over a wall rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    origin: DVec2,
    along: DVec2,
    inward: DVec2,
    /// Extent along u, metres.
    pub length: f64,
    /// Extent along v, metres.
    pub depth: f64,
}

impl Frame {
    /// Creates the frame with `near` at v = 0.
    pub fn new(rect: &Rect, near: Side) -> Frame {
        let (lo, hi, size) = (rect.min, rect.max, rect.max - rect.min);
        let (origin, along, length, depth) = match near {
            Side::Front => (lo, DVec2::X, size.x, size.y),
            Side::Back => (hi, DVec2::NEG_X, size.x, size.y),
            Side::Right => (dvec2(hi.x, lo.y), DVec2::Y, size.y, size.x),
            Side::Left => (dvec2(lo.x, hi.y), DVec2::NEG_Y, size.y, size.x),
        };
        Frame {
            origin,
            along,
            inward: along.perp(),
            length,
            depth,
        }
    }

    /// Returns a plan point.
    pub fn at(&self, u: f64, v: f64) -> DVec2 {
        self.origin + self.along * u + self.inward * v
    }

    /// Returns the place (u, v) of a plan point.
    pub fn place(&self, p: DVec2) -> DVec2 {
        let from = p - self.origin;
        dvec2(from.dot(self.along), from.dot(self.inward))
    }

    /// Returns a point.
    pub fn point(&self, u: f64, v: f64, z: f64) -> DVec3 {
        self.at(u, v).extend(z)
    }

    /// Returns the plane of height `z` at v = 0 that rises inwards.
    pub fn rising(&self, z: f64, pitch: f64) -> Plane {
        let slope = self.inward * pitch;
        Plane {
            z: z - slope.dot(self.origin),
            slope,
        }
    }

    /// Returns the direction of u.
    pub fn along(&self) -> DVec2 {
        self.along
    }

    /// Returns the direction of v.
    pub fn inward(&self) -> DVec2 {
        self.inward
    }
}

/// Returns the low side at v = 0 of a gable with this ridge.
pub fn near_side(ridge: Ridge) -> Side {
    match ridge {
        Ridge::A => Side::Front,
        Ridge::B => Side::Right,
    }
}

/// Returns the sides at u = 0 and at u = length of a frame.
pub fn end_sides(near: Side) -> [Side; 2] {
    match near {
        Side::Front => [Side::Left, Side::Right],
        Side::Back => [Side::Right, Side::Left],
        Side::Right => [Side::Front, Side::Back],
        Side::Left => [Side::Back, Side::Front],
    }
}

#[cfg(test)]
mod tests {
    use crate::frame::*;

    #[test]
    fn every_frame_puts_its_sides_where_the_plan_has_them() {
        let cell = Cell {
            a0: STEPS,
            b0: 2 * STEPS,
            a1: 4 * STEPS,
            b1: 7 * STEPS,
        };
        let rect = Rect::of(&cell, 1.0);
        let middle = |side: Side| match side {
            Side::Front => dvec2(-2.5, 2.0),
            Side::Back => dvec2(-2.5, 7.0),
            Side::Right => dvec2(-1.0, 4.5),
            Side::Left => dvec2(-4.0, 4.5),
        };
        for near in Side::ALL {
            let f = Frame::new(&rect, near);
            let [start, end] = end_sides(near);
            assert_eq!(f.at(f.length / 2.0, 0.0), middle(near));
            assert_eq!(f.at(f.length / 2.0, f.depth), middle(near.opposite()));
            assert_eq!(f.at(0.0, f.depth / 2.0), middle(start));
            assert_eq!(f.at(f.length, f.depth / 2.0), middle(end));
            assert!(f.along().perp_dot(f.inward()) > 0.0);
            assert_eq!(f.rising(3.0, 0.5).at(f.at(1.0, 2.0)), 4.0);
        }
    }
}
