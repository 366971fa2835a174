//! Broken rafter lines: gambrel (koshiore, KOS) and mansard (MAN), whose slopes are steep below and gentle above.
//!
//! The pitch of such a roof is that of the straight line from the wall plate to the ridge, so that it is as high as a
//! gable of that pitch. Both shapes break at [`HEIGHT`] of the rise, a gambrel further in than a mansard, whose lower slope
//! is nearly a wall. Under the eaves the line is as gentle as above the break: steep eaves would hang over the windows.

use hsd_ir::ast::RoofShape;

/// The share of the rise at which the slope breaks.
const HEIGHT: f64 = 0.6;
/// The share of the run at which a gambrel breaks: at 8 sun its slopes are 58 and 25 degrees steep.
const GAMBREL_AT: f64 = 0.3;
/// The same of a mansard: 67 and 22 degrees.
const MANSARD_AT: f64 = 0.2;

/// The rise of a broken roof whose author gives no pitch, per horizontal metre.
pub(super) const PITCH: f64 = 0.8;

/// A broken line over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Broken {
    /// Distance inward of the break, metres.
    pub(super) at: f64,
    /// Rise per horizontal metre below and above the break.
    lower: f64,
    upper: f64,
}

impl Broken {
    /// Returns the line of a shape that reaches `pitch * run` at its ridge; `None` for shapes that do not break.
    pub(super) fn of(shape: RoofShape, pitch: f64, run: f64) -> Option<Broken> {
        let share = match shape {
            RoofShape::Gambrel => GAMBREL_AT,
            RoofShape::Mansard => MANSARD_AT,
            _ => return None,
        };
        Some(Broken {
            at: share * run,
            lower: pitch * HEIGHT / share,
            upper: pitch * (1.0 - HEIGHT) / (1.0 - share),
        })
    }

    /// Returns the height over the wall plate at a distance inward, metres.
    pub(super) fn height(&self, d: f64) -> f64 {
        match d {
            _ if d < 0.0 => self.upper * d,
            _ if d < self.at => self.lower * d,
            _ => self.lower * self.at + self.upper * (d - self.at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_lines_are_as_high_as_straight_ones() {
        for shape in [RoofShape::Gambrel, RoofShape::Mansard] {
            let line = Broken::of(shape, 0.8, 3.0).expect("breaks");
            assert!((line.height(3.0) - 2.4).abs() < 1e-12);
            assert!((line.height(line.at) - 1.44).abs() < 1e-12);
            assert_eq!(line.height(0.0), 0.0);
            assert!(line.lower > 2.0 * line.upper && line.height(-0.5) > -0.25);
        }
        assert!(Broken::of(RoofShape::Gable, 0.8, 3.0).is_none());
    }
}
