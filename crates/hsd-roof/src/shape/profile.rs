//! The rafter line: the height of a slope over each point between its eaves and its ridge.
//!
//! Heights are those of the LOWER surface over the wall plate, as a function of the distance inward from
//! the wall line. Every line passes through the plate (0 at 0) and reaches pitch * run at its top, curved
//! or not (docs/evidence.md 7.10): sori hangs below the straight line between them and lifts the eaves, mukuri
//! bulges over it. A curve is cut into straight strips, so that hips of equal slopes stay straight in plan.

use crate::shape::broken::Broken;
use crate::shape::look::Look;
use hsd_base::geometry::tolerance::JOINT;
use hsd_ir::ast::RoofShape;
use smallvec::SmallVec;

/// The maximum distance between a strip and the curve, metres.
const MISS: f64 = 0.01;
/// Maximum number of strips of one section.
const MOST: f64 = 8.0;
/// The minimum share of the pitch along a curve: water must run off.
const LEAST_FALL: f64 = 0.2;
/// One end of a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Distance inward from the wall line, metres; negative under the eaves.
    pub d: f64,
    /// Height over the wall plate, metres.
    pub z: f64,
}

/// The curve that strips follow.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Curve {
    /// Straight.
    Line,
    /// A parabola with this sag below the straight line at mid-run, metres; negative above it.
    Parabola(f64),
    /// One half of a karahafu: a cosine that is level at the eaves' edge and at the crown.
    Cosine,
    /// Straight in pieces, steep below and gentle above.
    Broken(Broken),
}

/// The rafter line of one slope.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Its points, ascending, at least two.
    pub knots: SmallVec<[Knot; 8]>,
    pitch: f64,
    eaves: f64,
    run: f64,
    curve: Curve,
}

impl Profile {
    /// Creates the line over `run` metres from the wall line to the ridge, with knots at these distances as well.
    pub fn new(look: &Look, run: f64, at: &[f64]) -> Profile {
        let mut profile = Profile {
            knots: SmallVec::new(),
            pitch: look.pitch,
            eaves: look.eaves,
            run,
            curve: Curve::of(look, run),
        };
        if profile.curve == Curve::Cosine {
            // Wider ones would leave nothing else.
            profile.eaves = profile.eaves.min(2.0 * run);
        }
        profile.cut(at);
        profile
    }

    /// Divides the line at its ends, at the wall line if it is curved, at some distances, and between these as often as
    /// the curve demands.
    fn cut(&mut self, at: &[f64]) {
        let mut stops: SmallVec<[f64; 8]> = SmallVec::new();
        stops.extend([-self.eaves, self.run]);
        stops.extend((self.curve != Curve::Line).then_some(0.0));
        if let Curve::Broken(line) = self.curve {
            stops.push(line.at);
        }
        stops.extend(
            at.iter()
                .copied()
                .filter(|d| *d > -self.eaves && *d < self.run),
        );
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|p, q| *p - *q < JOINT);
        // The ends are exact even if other points lie just beside them.
        match &mut stops[..] {
            [_, .., last] => *last = self.run,
            _ => stops = SmallVec::from_slice(&[-self.eaves, self.run]),
        }
        let step = self.step();
        for pair in stops.windows(2) {
            let parts = ((pair[1] - pair[0]) / step).ceil().clamp(1.0, MOST);
            for i in 0..parts as u32 {
                let d = pair[0] + (pair[1] - pair[0]) * f64::from(i) / parts;
                self.knots.push(self.knot(d));
            }
        }
        self.knots.push(self.knot(self.run));
    }

    /// Returns the width of strips that keep to the curve.
    fn step(&self) -> f64 {
        // A chord over a width misses a curve by its second derivative times width squared over 8.
        let bend = match self.curve {
            Curve::Line | Curve::Broken(_) => return f64::INFINITY,
            Curve::Parabola(sag) => 8.0 * sag.abs() / (self.run * self.run),
            Curve::Cosine => {
                let turn = std::f64::consts::PI / (self.run + self.eaves);
                self.swell() * turn * turn / 2.0
            }
        };
        (8.0 * MISS / bend.max(1e-9)).sqrt()
    }

    /// Returns the height of the cosine's crown over its edge.
    fn swell(&self) -> f64 {
        let at_wall = self.share(0.0);
        self.pitch * self.run / (1.0 - at_wall)
    }

    /// Returns the share of the rise that a cosine has reached.
    fn share(&self, d: f64) -> f64 {
        let way = (d + self.eaves) / (self.run + self.eaves);
        (1.0 - libm::cos(std::f64::consts::PI * way)) / 2.0
    }

    /// Returns a point of the curve at a distance.
    pub fn knot(&self, d: f64) -> Knot {
        let straight = self.pitch * d;
        let z = match self.curve {
            Curve::Line => straight,
            Curve::Broken(line) => line.height(d),
            Curve::Parabola(sag) => {
                straight - 4.0 * sag * d * (self.run - d) / (self.run * self.run)
            }
            // The crown is where a straight slope would have its ridge.
            Curve::Cosine => self.swell() * (self.share(d) - self.share(0.0)),
        };
        Knot { d, z }
    }

    /// Returns the strips from the eaves up: their lower and their upper knot.
    pub fn strips(&self) -> impl Iterator<Item = (Knot, Knot)> + '_ {
        self.knots.windows(2).map(|w| (w[0], w[1]))
    }

    /// Returns true if it is a single straight line.
    pub fn is_straight(&self) -> bool {
        self.curve == Curve::Line
    }

    /// Returns the height at a distance; the outermost strips are extended beyond the knots.
    pub fn height(&self, d: f64) -> f64 {
        let strips = self.knots.len() - 1;
        let i = self.knots[1..strips].partition_point(|k| k.d < d);
        let (p, q) = (self.knots[i], self.knots[i + 1]);
        p.z + (q.z - p.z) * (d - p.d) / (q.d - p.d)
    }

    /// The distance at which it reaches a height above the plate, metres; `None` if it does not.
    pub fn reach(&self, z: f64) -> Option<f64> {
        let within = |(p, q): &(Knot, Knot)| p.z <= z + 1e-9 && z <= q.z + 1e-6 && q.z > p.z;
        let (p, q) = self.strips().find(within)?;
        Some(p.d + (q.d - p.d) * (z - p.z) / (q.z - p.z))
    }
}

impl Curve {
    fn of(look: &Look, run: f64) -> Curve {
        if look.shape == RoofShape::Karahafu {
            return Curve::Cosine;
        }
        if run < 0.1 {
            return Curve::Line;
        }
        if let Some(line) = Broken::of(look.shape, look.pitch, run) {
            return Curve::Broken(line);
        }
        if look.sori == 0.0 {
            return Curve::Line;
        }
        // The sagitta is perpendicular to a slope of this length; the line is measured vertically.
        let sag = look.sori * run * (1.0 + look.pitch * look.pitch);
        let most = (1.0 - LEAST_FALL) * look.pitch * run / 4.0;
        let hanging = most * run / (run + 2.0 * look.eaves);
        Curve::Parabola(sag.clamp(-most, hanging))
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::profile::*;
    use hsd_base::source::{Span, Spanned};
    use hsd_ir::ast::RoofStyle;

    fn look(sori: f64, shape: RoofShape) -> Look {
        let style = RoofStyle {
            sori: Some(Spanned::new(sori, Span::default())),
            shape: Some(Spanned::new(shape, Span::default())),
            pitch: Some(Spanned::new(5.0, Span::default())),
            eaves: Some(Spanned::new(3.3, Span::default())),
            ..RoofStyle::default()
        };
        Look::gable(Some(&style), &RoofStyle::default(), 10.0, 0.909)
    }

    #[test]
    fn every_line_passes_through_the_plate_and_reaches_its_ridge() {
        for (sori, shape) in [
            (0.0, RoofShape::Gable),
            (4.0, RoofShape::Gable),
            (-3.0, RoofShape::Gable),
            (60.0, RoofShape::Gable),
            (-60.0, RoofShape::Gable),
            (0.0, RoofShape::Karahafu),
            (0.0, RoofShape::Gambrel),
            (3.0, RoofShape::Mansard),
        ] {
            let line = Profile::new(&look(sori, shape), 5.0, &[1.25]);
            assert!(line.height(0.0).abs() < 1e-12, "{line:?}");
            assert!((line.height(5.0) - 2.5).abs() < 1e-12, "{line:?}");
            assert!((line.reach(2.5).unwrap_or(0.0) - 5.0).abs() < 1e-6);
            assert!(line.knots.iter().any(|k| k.d == 1.25));
            assert!(
                line.strips().all(|(p, q)| q.z > p.z && q.d > p.d),
                "{line:?}"
            );
        }
    }

    #[test]
    fn strips_are_as_many_as_the_curve_needs() {
        assert_eq!(
            Profile::new(&look(0.0, RoofShape::Gable), 5.0, &[])
                .knots
                .len(),
            2
        );
        let line = Profile::new(&look(4.0, RoofShape::Gable), 5.0, &[]);
        let sag = 0.04 * 5.0 * 1.25;
        assert!((2.5 / 2.0 - line.knot(2.5).z - sag).abs() < 1e-12);
        assert!((4..=9).contains(&line.knots.len()), "{}", line.knots.len());
        for i in 0..100 {
            let d = -1.0 + 6.0 * f64::from(i) / 100.0;
            assert!((line.height(d) - line.knot(d).z).abs() < 0.0101);
        }
    }
}
