//! Wall outlines in metres: the courts of each, and the edges that carry walls of the storey above.

use crate::skeleton::FLUSH;
use crate::skeleton::contour::Start;
use glam::DVec2;
use hsd_base::geometry::area2;
use hsd_base::geometry::convex::parts;
use hsd_base::geometry::triangulate::bridged;

/// A wall nearer to the line of another than this counts as standing on it, metres.
const UPON: f64 = 0.005;
/// The least overlap of two walls along a line, metres.
const COMMON: f64 = 0.02;

/// A part of a storey: counter-clockwise outline, clockwise courts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Part {
    pub(crate) outline: Vec<DVec2>,
    pub(crate) courts: Vec<Vec<DVec2>>,
}

impl Part {
    /// Returns its convex pieces.
    pub(crate) fn pieces(&self) -> Vec<Vec<DVec2>> {
        let ring = bridged(&self.outline, &self.courts);
        let piece = |part: Vec<usize>| part.into_iter().map(|i| ring[i]).collect();
        parts(&ring).into_iter().map(piece).collect()
    }

    /// Returns its edges.
    pub(crate) fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let rings = std::iter::once(&self.outline).chain(&self.courts);
        rings.flat_map(|r| (0..r.len()).map(|i| [r[i], r[(i + 1) % r.len()]]))
    }
}

/// Returns the parts that some loops bound, even-odd.
pub(crate) fn gathered(loops: &[Vec<DVec2>]) -> Vec<Part> {
    let around = |i: usize| {
        let p = (loops[i][0] + loops[i][1]) / 2.0;
        let others = (0..loops.len()).filter(move |j| *j != i);
        others
            .filter(move |j| within(&loops[*j], p))
            .collect::<Vec<_>>()
    };
    let outer: Vec<Vec<usize>> = (0..loops.len()).map(around).collect();
    let turned = |i: usize, turn: f64| {
        let mut ring = loops[i].clone();
        if area2(&ring) * turn < 0.0 {
            ring.reverse();
        }
        ring
    };
    let outlines = (0..loops.len()).filter(|i| outer[*i].len().is_multiple_of(2));
    let part = |i: usize| {
        let own = |c: &usize| outer[*c].len() == outer[i].len() + 1 && outer[*c].contains(&i);
        let courts = (0..loops.len()).filter(own);
        Part {
            outline: turned(i, 1.0),
            courts: courts.map(|c| turned(c, -1.0)).collect(),
        }
    };
    outlines.map(part).collect()
}

/// Returns a ring divided where walls begin and end on it; those edges are tagged [`FLUSH`].
pub(crate) fn tagged(ring: &[DVec2], walls: &[[DVec2; 2]]) -> Vec<Start> {
    let mut starts = Vec::with_capacity(ring.len());
    for (i, p) in ring.iter().enumerate() {
        let way = ring[(i + 1) % ring.len()] - *p;
        let length = way.length();
        let way = way.normalize_or_zero();
        let upon = |wall: &[DVec2; 2]| {
            let near = wall.iter().all(|q| way.perp_dot(*q - *p).abs() < UPON);
            let [r, s] = wall.map(|q| way.dot(q - *p).clamp(0.0, length));
            (near && (r - s).abs() > COMMON).then_some((r.min(s), r.max(s)))
        };
        let mut taken: Vec<(f64, f64)> = walls.iter().filter_map(upon).collect();
        taken.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut done = 0.0;
        for (from, to) in taken {
            if from - done > COMMON {
                starts.push((*p + way * done, 0));
            }
            if to > done {
                starts.push((
                    *p + way * if from - done > COMMON { from } else { done },
                    FLUSH,
                ));
                done = to;
            }
        }
        if length - done > COMMON || done == 0.0 {
            starts.push((*p + way * done, 0));
        }
    }
    starts
}

/// Returns true if a point lies inside a polygon (even-odd, half-open).
fn within(polygon: &[DVec2], p: DVec2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).fold(false, |inside, (q, r)| {
        let spans = (q.y <= p.y) != (r.y <= p.y);
        inside != (spans && p.x < q.x + (p.y - q.y) / (r.y - q.y) * (r.x - q.x))
    })
}

#[cfg(test)]
mod tests {
    use crate::skeleton::polygons::*;
    use glam::dvec2;

    fn square(x: f64, y: f64, size: f64) -> Vec<DVec2> {
        vec![
            dvec2(x, y),
            dvec2(x + size, y),
            dvec2(x + size, y + size),
            dvec2(x, y + size),
        ]
    }

    #[test]
    fn courts_go_to_the_outline_round_them_and_islands_are_parts_of_their_own() {
        let loops = vec![
            square(1.0, 1.0, 6.0),
            square(0.0, 0.0, 8.0),
            square(3.0, 3.0, 1.0),
            square(20.0, 0.0, 2.0),
        ];
        let parts = gathered(&loops);
        let courts: Vec<usize> = parts.iter().map(|p| p.courts.len()).collect();
        assert_eq!(courts, [1, 0, 0]);
        assert!(area2(&parts[0].courts[0]) < 0.0);
        let pieces: f64 = parts[0].pieces().iter().map(|p| area2(p) / 2.0).sum();
        assert!((pieces - 28.0).abs() < 1e-9);
    }

    #[test]
    fn walls_upon_an_edge_divide_it() {
        let tags = |walls: &[[DVec2; 2]]| -> Vec<(f64, u32)> {
            let starts = tagged(&square(0.0, 0.0, 4.0), walls);
            let front = starts.iter().filter(|s| s.0.y == 0.0);
            front.map(|s| (s.0.x, s.1)).collect()
        };
        let (one, other) = (dvec2(3.0, 0.001), dvec2(1.0, 0.0));
        for wall in [[one, other], [other, one]] {
            assert_eq!(tags(&[wall]), [(0.0, 0), (1.0, FLUSH), (3.0, 0), (4.0, 0)]);
        }
        let from_a_corner_on = [dvec2(0.0, 0.0), dvec2(2.0, 0.0)];
        assert_eq!(
            tags(&[from_a_corner_on]),
            [(0.0, FLUSH), (2.0, 0), (4.0, 0)]
        );
        let beyond = [dvec2(4.0, 0.0), dvec2(7.0, 0.0)];
        assert_eq!(tags(&[beyond]), [(0.0, 0), (4.0, 0)]);
    }
}
