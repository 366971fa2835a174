//! What stands outdoors in the plan of a plot: covered ground by its edges, parts by the outline of what they cover.

use crate::Settings;
use crate::paper::{Mark, Role, Shape};
use crate::subject::Subject;
use glam::{DVec2, DVec3};
use hsd_ir::building::fittings::{FittingKind, Ground};

/// Returns the marks of what stands outdoors beside the houses.
pub(super) fn outdoors(subject: &Subject<'_>, settings: &Settings) -> Vec<Mark> {
    let scale = settings.millimetres();
    let mut marks = vec![];
    for built in &subject.houses {
        for fitting in &built.fittings {
            let FittingKind::Ground(it) = &fitting.what else {
                continue;
            };
            let place = |p: DVec3| subject.point(&built.house, p).truncate() * scale;
            marks.push(Mark::new(Role::Seen, closed(&corners(it).map(place))));
        }
    }
    for body in subject.bodies.iter().filter(|b| b.outdoors) {
        let points = body.points.iter().map(|p| p.truncate() * scale).collect();
        let mut mark = Mark::new(Role::Seen, closed(&hull(points)));
        mark.code.clone_from(&body.code);
        marks.push(mark);
    }
    marks
}

/// Returns the corners of covered ground.
fn corners(it: &Ground) -> [DVec3; 4] {
    let (along, back) = (
        it.along * (it.size.x / 2.0),
        it.along.perp() * (it.size.y / 2.0),
    );
    [-along - back, along - back, along + back, back - along].map(|by| it.at + by.extend(0.0))
}

/// Returns the lines round an outline.
fn closed(ring: &[DVec2]) -> Shape {
    let next = ring.iter().cycle().skip(1);
    Shape::Lines(ring.iter().zip(next).map(|(p, q)| [*p, *q]).collect())
}

/// Returns the convex outline of points, counter-clockwise.
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut made: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = made[..] {
                if (b - a).perp_dot(*p - b) > 0.0 {
                    break;
                }
                made.pop();
            }
            made.push(*p);
        }
        made.pop();
        made
    };
    let mut made = chain(&mut points.iter());
    made.extend(chain(&mut points.iter().rev()));
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn the_outline_of_a_square_has_its_corners() {
        let points = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 0), (0, 0)];
        let points = points
            .map(|(x, y)| dvec2(f64::from(x), f64::from(y)))
            .to_vec();
        let found = hull(points);
        assert_eq!(found.len(), 4);
        assert!((hsd_base::geometry::area2(&found) - 8.0).abs() < 1e-12);
        assert!(hull(vec![]).is_empty());
    }
}
