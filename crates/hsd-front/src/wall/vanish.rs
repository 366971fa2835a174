//! Where parallel edges of a wall meet in a photograph, and the lens that makes them straight.

use super::lines::Edge;
use crate::camera::Lens;
use glam::{DMat3, DVec2, DVec3};

/// The most edges that are tried in pairs.
const TRIED: usize = 70;
/// The sine of how far an edge may point past the place where it should meet the others: 1.4 degrees.
const TURN: f64 = 0.025;
/// The same while places are refined.
const FINE: f64 = 0.006;
/// The edges that say how a lens bends, as a part of the longer side of the picture.
const LONG: f64 = 0.16;
/// Half of the weight of an edge is lost if its places lie so far off a line, pixels.
const BENT_OFF: f64 = 0.4;
/// The most such edges.
const BENT: usize = 60;

/// An edge in the straight picture.
#[derive(Clone, Copy, Debug)]
pub struct Straight {
    /// One end.
    pub a: DVec2,
    /// The other end.
    pub b: DVec2,
    /// How far it counts: its length, more where brightness changes much.
    pub weight: f64,
}

impl Straight {
    /// An edge of a photograph, through a lens.
    pub fn of(edge: &Edge, lens: &Lens) -> Straight {
        let places: Vec<DVec2> = edge.places.iter().map(|p| lens.straight(*p)).collect();
        let (middle, along, _) = through(&places);
        let (first, last) = (places[0], places[places.len() - 1]);
        let on = |p: DVec2| middle + along * (p - middle).dot(along);
        let (a, b) = (on(first), on(last));
        Straight {
            a,
            b,
            weight: a.distance(b) * (edge.step / 20.0).clamp(0.3, 1.0),
        }
    }

    /// The line on which several edges lie.
    pub fn joined<'s>(edges: impl Iterator<Item = &'s Straight> + Clone) -> Straight {
        // A place for each so many pixels, so that long edges count as much as they are long.
        let places: Vec<DVec2> = edges
            .clone()
            .flat_map(|e| {
                let count = (e.a.distance(e.b) / 4.0).ceil().max(1.0) as usize;
                (0..=count).map(move |k| e.a.lerp(e.b, k as f64 / count as f64))
            })
            .collect();
        let (middle, along, _) = through(&places);
        let at = |p: &DVec2| (*p - middle).dot(along);
        let from = places.iter().map(at).fold(f64::INFINITY, f64::min);
        let to = places.iter().map(at).fold(f64::NEG_INFINITY, f64::max);
        Straight {
            a: middle + along * from,
            b: middle + along * to,
            weight: edges.map(|e| e.weight).sum(),
        }
    }

    fn line(&self, middle: DVec2, scale: f64) -> DVec3 {
        let (a, b) = ((self.a - middle) / scale, (self.b - middle) / scale);
        a.extend(1.0).cross(b.extend(1.0)).normalize_or_zero()
    }

    /// The sine of the angle between the edge and the way from its middle to a place, both of the straight picture.
    fn turn(&self, to: DVec3) -> f64 {
        let middle = (self.a + self.b) / 2.0;
        let way = to.truncate() - middle * to.z;
        let along = (self.b - self.a).normalize_or_zero();
        way.normalize_or(DVec2::ZERO).perp_dot(along).abs()
    }
}

/// The line that lies best through places: a point, a direction, and the sum of the squared distances.
pub(super) fn through(places: &[DVec2]) -> (DVec2, DVec2, f64) {
    let middle = places.iter().sum::<DVec2>() / places.len() as f64;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in places {
        let d = *p - middle;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    let half = (xx - yy) / 2.0;
    let root = (half * half + xy * xy).sqrt();
    let along = match half > 0.0 {
        true => DVec2::new(half + root, xy),
        false => DVec2::new(xy, root - half),
    };
    let along = along.normalize_or(DVec2::X);
    let rest: f64 = places
        .iter()
        .map(|p| (*p - middle).perp_dot(along).powi(2))
        .sum();
    (middle, along, rest)
}

/// The greatest coefficients of a lens, either way (plans.md 5.3).
const MOST_BENT: f64 = 0.4;

/// The bending of a lens with which long edges become straight; the focal length is given. `None` with fewer than four such edges.
pub fn bending(edges: &[Edge], lens: &Lens, longest: f64) -> Option<[f64; 2]> {
    let long: Vec<&Edge> = edges
        .iter()
        .filter(|e| e.length() > LONG * longest)
        .take(BENT)
        .collect();
    if long.len() < 4 {
        return None;
    }
    let rest = |bend: [f64; 2]| {
        let lens = Lens { bend, ..*lens };
        let each = long.iter().map(|edge| {
            let steps = (edge.places.len() / 20).max(1);
            let sampled = edge.places.iter().step_by(steps);
            let places: Vec<DVec2> = sampled.map(|p| lens.straight(*p)).collect();
            let off = through(&places).2 / places.len() as f64;
            // What is no straight line at all says nothing.
            edge.length() * off / (off + BENT_OFF * BENT_OFF)
        });
        each.sum::<f64>()
    };
    let none = rest([0.0; 2]);
    let mut best = ([0.0; 2], none);
    // Up to `MOST_BENT`.
    for step in -20..=20 {
        let bend = [f64::from(step) * 0.02, 0.0];
        let r = rest(bend);
        if r < best.1 {
            best = (bend, r);
        }
    }
    let mut width = 0.02;
    while width > 2e-4 {
        let [k1, k2] = best.0;
        let near = [-1.0, 0.0, 1.0]
            .map(|i| [-2.0, -1.0, 0.0, 1.0, 2.0].map(|j| [k1 + i * width, k2 + j * width]));
        let before = best.1;
        // Without a bound, edges become ever straighter as the lens shrinks the image to a point.
        let bounded = |bend: &[f64; 2]| bend.iter().all(|k| k.abs() <= MOST_BENT);
        for bend in near.into_iter().flatten().filter(bounded) {
            let r = rest(bend);
            if r < best.1 {
                best = (bend, r);
            }
        }
        if best.1 == before {
            width /= 2.0;
        }
    }
    // A gain of a few per cent is noise.
    Some(if best.1 < 0.985 * none {
        best.0
    } else {
        [0.0; 2]
    })
}

/// Where the edges of the two directions of a wall meet, in the straight picture, and how far edges agree with each.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// Of the edges that run across the wall.
    pub across: DVec3,
    /// Of the edges that run down.
    pub down: DVec3,
    /// The lengths of the edges that agree, pixels.
    pub support: [f64; 2],
}

/// Finds where edges meet, by trying all pairs of the longest ones.
pub fn meeting(edges: &[Straight], lens: &Lens) -> Option<Meeting> {
    let scale = lens.focal;
    let steep = |e: &&Straight| (e.b - e.a).y.abs() > 1.2 * (e.b - e.a).x.abs();
    let down: Vec<Straight> = edges.iter().filter(steep).copied().collect();
    let across: Vec<Straight> = edges
        .iter()
        .filter(|e| (e.b - e.a).y.abs() < 1.3 * (e.b - e.a).x.abs())
        .copied()
        .collect();
    let (down, support_down) = best(&down, lens.middle, scale)?;
    let square = |v: DVec3| {
        let (a, b) = (lens.ray(v).normalize(), lens.ray(down).normalize());
        a.dot(b).abs() < 0.25
    };
    let (across, support_across) = best_of(&across, lens.middle, scale, square)?;
    Some(Meeting {
        across,
        down,
        support: [support_across, support_down],
    })
}

/// The most turns by which the frame of the wall is settled.
const TURNS: usize = 12;

impl Meeting {
    /// The same as long lines across and down say it.
    pub fn refined(self, [across, down]: &[Vec<Straight>; 2], lens: &Lens) -> Option<Meeting> {
        let (middle, scale) = (lens.middle, lens.focal);
        let back = DMat3::from_translation(middle) * DMat3::from_scale(DVec2::splat(scale));
        let place = |edges: &[Straight], mut place: DVec3| {
            let lines: Vec<DVec3> = edges.iter().map(|e| e.line(middle, scale)).collect();
            for _ in 0..3 {
                place = back * refined(edges, &lines, place, FINE)?;
            }
            Some(place)
        };
        Some(Meeting {
            across: place(across, self.across)?,
            down: place(down, self.down)?,
            ..self
        })
    }

    /// The same with directions that are square to each other on the wall, as true for the edges of both together as can be; the
    /// focal length is known.
    pub fn squared(self, [across, down]: &[Vec<Straight>; 2], lens: &Lens) -> Option<Meeting> {
        let axes = |a: DVec3, b: DVec3| {
            let a = a.try_normalize()?;
            let b = (b - a * a.dot(b)).try_normalize()?;
            Some(DMat3::from_cols(a, b, a.cross(b)))
        };
        let place = |way: DVec3| (lens.middle * way.z + way.truncate() * lens.focal).extend(way.z);
        let mut frame = axes(lens.ray(self.across), lens.ray(self.down))?;
        for _ in 0..TURNS {
            // A small turn `t` of the frame moves an axis by its cross product with it.
            let (mut sums, mut right) = (DMat3::ZERO, DVec3::ZERO);
            for (edges, axis) in [(across, frame.x_axis), (down, frame.y_axis)] {
                for edge in edges {
                    let normal = edge.line(lens.middle, lens.focal);
                    let turn = edge.turn(place(axis)) / FINE;
                    if turn < 1.0 {
                        let sharp = 1.0 - turn * turn;
                        let weight = edge.weight * edge.a.distance(edge.b) * sharp * sharp;
                        let by = axis.cross(normal);
                        sums += DMat3::from_cols(by * by.x, by * by.y, by * by.z) * weight;
                        right -= by * (normal.dot(axis) * weight);
                    }
                }
            }
            if sums.determinant().abs() < 1e-20 {
                return None;
            }
            let turn = sums.inverse() * right;
            let turned = |axis: DVec3| axis + turn.cross(axis);
            frame = axes(turned(frame.x_axis), turned(frame.y_axis))?;
        }
        Some(Meeting {
            across: place(frame.x_axis),
            down: place(frame.y_axis),
            ..self
        })
    }
}

fn best(edges: &[Straight], middle: DVec2, scale: f64) -> Option<(DVec3, f64)> {
    best_of(edges, middle, scale, |_| true)
}

fn best_of(
    edges: &[Straight],
    middle: DVec2,
    scale: f64,
    may_be: impl Fn(DVec3) -> bool,
) -> Option<(DVec3, f64)> {
    let back = DMat3::from_translation(middle) * DMat3::from_scale(DVec2::splat(scale));
    let lines: Vec<DVec3> = edges.iter().map(|e| e.line(middle, scale)).collect();
    let tried = edges.len().min(TRIED);
    let mut found: Option<(DVec3, f64)> = None;
    for i in 0..tried {
        for j in i + 1..tried {
            let place = back * lines[i].cross(lines[j]);
            if place.length_squared() < 1e-20 || inside(edges, place) || !may_be(place) {
                continue;
            }
            let support = support(edges, place, TURN);
            if found.is_none_or(|f| support > f.1) {
                found = Some((place, support));
            }
        }
    }
    let (mut place, _) = found?;
    for limit in [TURN, FINE, FINE, FINE] {
        place = back * refined(edges, &lines, place, limit)?;
    }
    let support = support(edges, place, FINE);
    (support > 0.0).then_some((place, support))
}

/// Whether edges meet amid their own lengths: then they are no parallels.
fn inside(edges: &[Straight], place: DVec3) -> bool {
    let Some(first) = edges.first() else {
        return true;
    };
    let reach = edges
        .iter()
        .flat_map(|e| [e.a, e.b])
        .fold((first.a, first.a), |r, p| (r.0.min(p), r.1.max(p)));
    if place.z.abs() < 1e-12 {
        return false;
    }
    let at = place.truncate() / place.z;
    at.cmpge(reach.0).all() && at.cmple(reach.1).all()
}

fn support(edges: &[Straight], place: DVec3, limit: f64) -> f64 {
    let each = edges.iter().map(|e| {
        let turn = e.turn(place) / limit;
        e.weight * (1.0 - turn * turn).max(0.0)
    });
    each.sum()
}

/// The place where the edges that point to it nearly meet best.
fn refined(edges: &[Straight], lines: &[DVec3], place: DVec3, limit: f64) -> Option<DVec3> {
    let mut sum = DMat3::ZERO;
    for (edge, line) in edges.iter().zip(lines) {
        let turn = edge.turn(place) / limit;
        if turn < 1.0 {
            let weight = edge.weight * edge.a.distance(edge.b) * (1.0 - turn * turn).powi(2);
            let l = *line / line.truncate().length().max(1e-3);
            sum += DMat3::from_cols(l * l.x, l * l.y, l * l.z) * weight;
        }
    }
    least(sum)
}

/// The direction in which a symmetric matrix is least, by inverse iteration.
fn least(sum: DMat3) -> Option<DVec3> {
    let scale = sum.x_axis.x + sum.y_axis.y + sum.z_axis.z;
    if scale.is_nan() || scale <= 0.0 {
        return None;
    }
    let back = (sum * (1.0 / scale) + DMat3::from_diagonal(DVec3::splat(1e-12))).inverse();
    let mut v = DVec3::new(0.3, 0.5, 0.8);
    for _ in 0..40 {
        v = (back * v).try_normalize()?;
    }
    Some(v)
}

#[test]
fn edges_that_no_lens_makes_straight_end_the_search() {
    // Waves become straighter the more a lens shrinks the image.
    let wave = |y: f64| Edge {
        places: (0..200)
            .map(|x| DVec2::new(f64::from(x), y + 6.0 * libm::sin(f64::from(x) * 0.1)))
            .collect(),
        step: 40.0,
    };
    let edges: Vec<Edge> = [10.0, 40.0, 90.0, 120.0, 140.0].map(wave).into();
    let lens = Lens {
        focal: 180.0,
        middle: DVec2::new(110.0, 73.0),
        bend: [0.0; 2],
    };
    let bend = bending(&edges, &lens, 220.0).expect("five long edges");
    assert!(bend.iter().all(|k| k.abs() <= MOST_BENT), "{bend:?}");
}
