//! A direction in which a subject is looked at, and the plane from which on it is seen.

use glam::{DVec2, DVec3, dvec2};

/// A parallel projection, and the plane in front of which nothing is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// To the right on paper.
    pub(super) right: DVec3,
    /// Up on paper.
    pub(super) up: DVec3,
    /// Away from whoever looks.
    pub(super) way: DVec3,
    /// The depth along `way` at which the subject is cut, metres; minus infinity if it is not.
    pub(super) cut: f64,
    /// Millimetres on paper in a metre.
    pub(super) scale: f64,
}

impl Look {
    /// Looks down, as a plan does, with the front below.
    pub(super) fn down(scale: f64) -> Look {
        Look::new(DVec3::X, DVec3::Y, scale)
    }

    /// Returns true if it looks down.
    pub(super) fn is_down(&self) -> bool {
        self.way.z < -0.5
    }

    /// Looks at the front.
    pub(super) fn front(scale: f64) -> Look {
        Look::new(DVec3::X, DVec3::Z, scale)
    }

    /// Looks at the side on the right of somebody who stands before the front.
    pub(super) fn from_right(scale: f64) -> Look {
        Look::new(DVec3::Y, DVec3::Z, scale)
    }

    /// Looks at the back.
    pub(super) fn back(scale: f64) -> Look {
        Look::new(-DVec3::X, DVec3::Z, scale)
    }

    /// Looks at the side on the left of somebody who stands before the front.
    pub(super) fn from_left(scale: f64) -> Look {
        Look::new(-DVec3::Y, DVec3::Z, scale)
    }

    fn new(right: DVec3, up: DVec3, scale: f64) -> Look {
        Look {
            right,
            up,
            way: up.cross(right),
            cut: f64::NEG_INFINITY,
            scale,
        }
    }

    /// Returns it with the subject cut at the place of a point.
    pub(super) fn cut_at(self, place: DVec3) -> Look {
        Look {
            cut: self.way.dot(place),
            ..self
        }
    }

    /// Projects a point to paper, millimetres.
    pub(super) fn paper(&self, p: DVec3) -> DVec2 {
        dvec2(self.right.dot(p), self.up.dot(p)) * self.scale
    }

    /// Returns how far away a point is, metres.
    pub(super) fn depth(&self, p: DVec3) -> f64 {
        self.way.dot(p)
    }
}
