//! The walk round an outline or a courtyard in it.

use super::sides::{self, SurveyedSide};
use glam::DVec2;
use hsd_base::geometry;
use hsd_base::source::Span;
use hsd_ir::program::WallLine;

/// A walk round a house or a courtyard.
pub(super) struct SurveyedRing {
    pub(super) span: Span,
    pub(super) hole: bool,
    /// Author frame, U.
    pub(super) start: DVec2,
    /// The direction of its first side, degrees to the right of the front.
    pub(super) first: f64,
    pub(super) sides: Vec<SurveyedSide>,
}

impl SurveyedRing {
    /// Returns the line that turns a walk into the direction of its first side. A walk begins along the front.
    pub(super) fn leading(&self) -> Option<WallLine> {
        (self.first != 0.0).then(|| WallLine {
            span: self.span,
            units: vec![],
            turn: self.first,
            reflection: false,
        })
    }

    /// Returns its corners, author frame, U.
    pub(super) fn corners(&self) -> Vec<DVec2> {
        self.sides.iter().map(SurveyedSide::from).collect()
    }

    /// Returns where its sides begin, and the sides.
    pub(super) fn edges(&self) -> Vec<(DVec2, Option<&SurveyedSide>)> {
        self.sides.iter().map(|s| (s.from(), Some(s))).collect()
    }

    /// Returns the direction of the longest side.
    pub(super) fn longest(&self) -> DVec2 {
        let corners = self.corners();
        sides::longest(&corners)
    }

    /// Returns true if a place lies in the ring.
    pub(super) fn holds(&self, p: DVec2) -> bool {
        geometry::holds(&self.corners(), p)
    }
}
