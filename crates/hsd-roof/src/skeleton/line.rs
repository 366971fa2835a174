//! The line of a wall edge with its inward normal.

use glam::DVec2;

/// The line of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeLine {
    /// Unit vector to the inside, to the left of the edge.
    pub normal: DVec2,
    /// Distance from the origin along it, metres.
    pub at: f64,
}

impl EdgeLine {
    /// Creates the line from `p` to `q`.
    pub fn through(p: DVec2, q: DVec2) -> EdgeLine {
        let normal = (q - p).perp().normalize_or_zero();
        EdgeLine {
            normal,
            at: normal.dot((p + q) / 2.0),
        }
    }

    /// Returns the signed distance of a point from the line, metres; positive inside.
    pub fn depth(&self, p: DVec2) -> f64 {
        self.normal.dot(p) - self.at
    }

    /// Returns the direction of its edge.
    pub fn way(&self) -> DVec2 {
        -self.normal.perp()
    }

    /// Returns the line after a translation.
    pub(in crate::skeleton) fn moved(self, by: DVec2) -> EdgeLine {
        EdgeLine {
            at: self.at + self.normal.dot(by),
            ..self
        }
    }
}
