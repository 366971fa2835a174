//! Wings: the slopes of one plain roof. Over a rectangle, of which each has its own part, they are one convex body.
//!
//! A wing that reaches into another has narrower strips of slopes under its eaves, which end at the wall of that. Where they
//! would go on they lie below the other, unseen, so that they are made as wide as the strips above them, and one with these.

use crate::facet::{Convex, Corner, area};
use crate::frame::{Plane, Rect, round};
use glam::DVec2;
use hsd_base::geometry::tolerance::{CUT, HEIGHT, JOINT, POINT, SLIVER};
use hsd_ir::ast::RoofKind;
use smallvec::SmallVec;

/// A slope of a roof over an attic.
pub(crate) struct Slope {
    /// Its convex outline, counter-clockwise.
    pub(crate) outline: Convex,
    /// The convex part of it that takes the place of lower slopes: without verges, with its gable walls.
    pub(crate) body: Convex,
    /// The parts of it beyond, which stand over lower slopes.
    pub(crate) verges: SmallVec<[Convex; 2]>,
    /// Its upper surface.
    pub(crate) top: Plane,
}

/// The properties that all slopes of a solid share.
pub(crate) struct Plate {
    /// Their vertical thickness, metres.
    pub(crate) drop: f64,
    /// The floor of the attic, metres; `None` if there is none below.
    pub(crate) floor: Option<f64>,
    /// Their covering.
    pub(crate) kind: RoofKind,
}

/// The slopes of a roof.
pub(crate) struct Wing {
    pub(crate) slopes: Vec<Slope>,
    /// The rectangle that their bodies fill, if each is the lowest over its own.
    pub(super) body: Option<Rect>,
}

impl Wing {
    fn of(slopes: Vec<Slope>) -> Wing {
        let body = rectangle(&slopes);
        Wing { slopes, body }
    }

    /// Returns the wings of some roofs, each given by its slopes. Strips of one slope are one where others cover what is added to
    /// them; the lower one becomes a wing of its own where none does.
    pub(crate) fn joined(roofs: Vec<Vec<Slope>>) -> Vec<Wing> {
        let covers: SmallVec<[Option<Cover>; 6]> = roofs.iter().map(|r| Cover::of(r)).collect();
        let is_covered = |own: usize, outline: &Convex, plane: Plane| {
            let others = covers.iter().enumerate().filter(|(n, _)| *n != own);
            let mut others = others.filter_map(|(_, cover)| cover.as_ref());
            outline.is_empty() || others.any(|cover| cover.hides(outline, plane))
        };
        let mut wings: Vec<Wing> = Vec::with_capacity(2 * roofs.len());
        for (own, roof) in roofs.into_iter().enumerate() {
            let mut slopes: Vec<Slope> = Vec::with_capacity(roof.len());
            for upper in roof {
                let joined = slopes.last().and_then(|lower| lower.under(&upper));
                if let Some((joined, added)) = joined {
                    let lower = slopes.pop();
                    if added.iter().all(|a| is_covered(own, a, joined.top)) {
                        slopes.push(joined);
                        continue;
                    }
                    wings.extend(lower.map(|lower| Wing::of(vec![lower])));
                }
                slopes.push(upper);
            }
            wings.push(Wing::of(slopes));
        }
        wings
    }
}

/// A roof over a rectangle, under which other slopes are hidden.
struct Cover {
    rect: Rect,
    tops: SmallVec<[Plane; 4]>,
}

impl Cover {
    fn of(slopes: &[Slope]) -> Option<Cover> {
        let rect = rectangle(slopes)?.grown(CUT);
        let tops = slopes.iter().map(|slope| slope.top).collect();
        Some(Cover { rect, tops })
    }

    /// Returns true if no plane lies below another over an outline inside of it: all above, but for places on its border, or
    /// the same.
    fn hides(&self, outline: &[Corner], plane: Plane) -> bool {
        let Rect { min, max } = self.rect;
        let above = |top: &Plane| {
            let gap = |c: &Corner| top.at(c.at) - plane.at(c.at);
            let apart = outline.iter().any(|c| gap(c) > JOINT) || is_same(*top, plane);
            apart && outline.iter().all(|c| gap(c) > -HEIGHT)
        };
        let inside = |c: &Corner| min.cmple(c.at).all() && c.at.cmple(max).all();
        outline.iter().all(inside) && self.tops.iter().all(above)
    }
}

impl Slope {
    /// Returns this strip of a slope with the one above it, and what both have not; none if they are not such strips.
    fn under(&self, upper: &Slope) -> Option<(Slope, [Convex; 2])> {
        if !is_same(self.top, upper.top) {
            return None;
        }
        let (outline, added) = under(&self.outline, &upper.outline, self.top)?;
        let (body, _) = under(&self.body, &upper.body, self.top)?;
        let slope = Slope {
            outline,
            body,
            verges: self.verges.iter().chain(&upper.verges).cloned().collect(),
            top: self.top,
        };
        Some((slope, added))
    }
}

/// Returns the outline of a strip of a slope that is made as wide as the one above it, with that, and what is added at both
/// ends. The first edge of each is its lower one, and that of the upper strip the third of the lower one.
fn under(lower: &[Corner], upper: &[Corner], plane: Plane) -> Option<(Convex, [Convex; 2])> {
    let (&[a, b, c, d], &[e, f, _, ..]) = (lower, upper) else {
        return None;
    };
    let (along, ways) = (c.at - d.at, [e.at - d.at, f.at - c.at]);
    let beside = |at: DVec2| (at.dot(plane.slope)).abs() < POINT * plane.slope.length();
    let wider = ways[0].dot(along) < POINT && ways[1].dot(along) > -POINT;
    if !(wider && beside(along) && ways.into_iter().all(beside)) {
        return None;
    }
    let moved = |c: Corner, by: DVec2| Corner { at: c.at + by, ..c };
    let (first, second) = (moved(a, ways[0]), moved(b, ways[1]));
    let ends = [[first, a, d, e], [b, second, f, c]];
    let added = [0, 1].map(|n| match ways[n].length_squared() < POINT * POINT {
        true => Convex::new(),
        false => Convex::from_slice(&ends[n]),
    });
    let mut whole = Convex::from_slice(&[first, second]);
    whole.extend_from_slice(&upper[2..]);
    let parts: f64 = [lower, upper, &added[0], &added[1]].map(area).iter().sum();
    ((area(&whole) - parts).abs() < SLIVER).then_some((whole, added))
}

/// Returns the rectangle that the bodies of some slopes fill, if each is the lowest over its own.
fn rectangle(slopes: &[Slope]) -> Option<Rect> {
    let body = round(slopes.iter().flat_map(|s| &s.body).map(|c| c.at));
    let filled: f64 = slopes.iter().map(|s| area(&s.body)).sum();
    let size = body.max - body.min;
    if (size.x * size.y - filled).abs() > SLIVER {
        return None;
    }
    let lowest = |own: &Slope| {
        let lower = |at: DVec2| {
            let least = own.top.at(at) - HEIGHT;
            slopes.iter().all(|o| o.top.at(at) > least)
        };
        own.body.iter().all(|c| lower(c.at))
    };
    slopes.iter().all(lowest).then_some(body)
}

pub(super) fn is_same(one: Plane, other: Plane) -> bool {
    let slope = (one.slope - other.slope).abs().max_element();
    slope < 1e-9 && (one.z - other.z).abs() < 1e-6
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    /// A slope without verges over a rectangle.
    fn slope(x: [f64; 2], y: [f64; 2], top: Plane, first: usize) -> Slope {
        let corners = [
            dvec2(x[0], y[0]),
            dvec2(x[1], y[0]),
            dvec2(x[1], y[1]),
            dvec2(x[0], y[1]),
        ];
        let mut corners = corners.map(|at| Corner { at, rim: false });
        corners.rotate_left(first);
        let outline = Convex::from_slice(&corners);
        Slope {
            body: outline.clone(),
            outline,
            verges: SmallVec::new(),
            top,
        }
    }

    fn plane(z: f64, x: f64, y: f64) -> Plane {
        Plane {
            z,
            slope: dvec2(x, y),
        }
    }

    /// A roof with its ridge along x from 0 to 10, and one with its ridge along y that reaches into it, with eaves to x = `right`.
    fn roofs(right: f64) -> Vec<Vec<Slope>> {
        let trunk = vec![
            slope([0.0, 10.0], [0.0, 3.0], plane(3.0, 0.0, 0.5), 0),
            slope([0.0, 10.0], [3.0, 6.0], plane(6.0, 0.0, -0.5), 2),
        ];
        // Its walls stand a metre inside of its eaves, those of the trunk at y = 5.
        let falling = plane(3.0 + 0.5 * right, -0.5, 0.0);
        let rising = plane(3.0 - 0.5 * (right - 6.0), 0.5, 0.0);
        let wing = vec![
            slope([right - 1.0, right], [5.0, 9.0], falling, 1),
            slope([right - 3.0, right - 1.0], [4.0, 9.0], falling, 1),
            slope([right - 6.0, right - 5.0], [5.0, 9.0], rising, 3),
            slope([right - 5.0, right - 3.0], [4.0, 9.0], rising, 3),
        ];
        vec![trunk, wing]
    }

    #[test]
    fn strips_under_eaves_go_on_where_another_roof_covers_them() {
        let wings = Wing::joined(roofs(8.0));
        assert_eq!(
            wings.iter().map(|w| w.slopes.len()).collect::<Vec<_>>(),
            [2, 2]
        );
        let body = wings[1].body.expect("it fills a rectangle");
        assert_eq!([body.min, body.max], [dvec2(2.0, 4.0), dvec2(8.0, 9.0)]);
    }

    #[test]
    fn strips_beside_the_end_of_another_roof_stay_as_they_are() {
        // Its right eaves would go on past the end of the trunk.
        let wings = Wing::joined(roofs(10.5));
        assert_eq!(
            wings.iter().map(|w| w.slopes.len()).collect::<Vec<_>>(),
            [2, 1, 2]
        );
        let strip = wings[1].body.expect("it is a rectangle");
        assert_eq!([strip.min, strip.max], [dvec2(9.5, 5.0), dvec2(10.5, 9.0)]);
        let rest = wings[2].body.expect("it fills a rectangle");
        assert_eq!([rest.min, rest.max], [dvec2(4.5, 4.0), dvec2(9.5, 9.0)]);
    }

    #[test]
    fn slopes_that_rise_outwards_are_no_body() {
        let valley = vec![
            slope([0.0, 10.0], [0.0, 3.0], plane(6.0, 0.0, -0.5), 0),
            slope([0.0, 10.0], [3.0, 6.0], plane(3.0, 0.0, 0.5), 2),
        ];
        assert!(Wing::of(valley).body.is_none());
    }
}
