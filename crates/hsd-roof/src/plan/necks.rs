//! Wings at odd angles: they are cut off at their necks, so that the rest of a storey is roofed by rectangles and only
//! they get hip roofs of their own (docs/contract.md 8).
//!
//! A neck is a line along an axis of the plan, from a corner to the next wall, that is short beside what lies on both
//! sides of it. One side has slanting walls; the other is at right angles, or becomes so by further necks. A rectangle
//! with a splayed corner has no neck and stays whole.

use crate::plan::level::Point;
use hsd_base::geometry::plan::Plan;

/// The greatest share of a neck's squared length in the area on either side of it.
const SHORT: f64 = 1.2;
/// A wall off an axis by no more is parallel to it, steps: a fifth of a millimetre, as rounding leaves.
const STRAIGHT: i64 = 200;
/// Outlines of more corners are not searched.
const MOST_CORNERS: usize = 200;
/// The least way to which the roof of a wing goes on in the rest, steps.
const LEAST_REACH: f64 = 100_000.0;

/// A storey divided at the necks of its wings.
#[derive(Clone, Debug)]
pub(crate) struct Necks {
    /// What is at right angles.
    pub(crate) rest: Plan,
    /// The wings at odd angles.
    pub(crate) wings: Vec<Wing>,
}

/// A wing at an odd angle, in walk order.
#[derive(Clone, Debug)]
pub(crate) struct Wing {
    /// Its walls and necks.
    pub(crate) outline: Vec<Point>,
    /// The outline of its roof, which goes on beyond the necks until it has ended in the roofs there.
    pub(crate) roof: Vec<Point>,
}

/// Divides a plan; none if nothing is gained by it.
pub(crate) fn divided(plan: &Plan) -> Option<Necks> {
    let mut outer: Vec<Vec<Point>> = plan.loops.iter().map(|l| straightened(l)).collect();
    let area = |n: &usize| area2(&outer[*n]).abs();
    let first = (0..outer.len()).max_by(|p, q| area(p).total_cmp(&area(q)))?;
    let ring = outer.swap_remove(first);
    let courts = outer;
    let around = |c: &Vec<Point>| slants(c) == 0 && c.iter().all(|p| holds(&ring, *p));
    if slants(&ring) == 0 || ring.len() > MOST_CORNERS || !courts.iter().all(around) {
        return None;
    }
    let mut search = Search {
        courts: &courts,
        cuts: vec![],
        left: 64,
    };
    let mut parts = Parts::default();
    search.divide(oriented(ring), &mut parts);
    let court_of = |ring: &Vec<Point>| courts.iter().filter(|c| holds(ring, c[0])).count();
    let in_wings: usize = parts.wings.iter().map(court_of).sum();
    if parts.rest.is_empty() || in_wings > 0 {
        return None;
    }
    let loops = parts.rest.into_iter().chain(courts.iter().cloned());
    let rest = Plan::from_loops(loops.collect()).clean();
    let wing = |outline: Vec<Point>| {
        let roof = continued(&outline, &search.cuts, &rest);
        Wing { outline, roof }
    };
    let wings = parts.wings.into_iter().map(wing).collect();
    Some(Necks { rest, wings })
}

/// The parts of a plan that were found.
#[derive(Default)]
struct Parts {
    rest: Vec<Vec<Point>>,
    wings: Vec<Vec<Point>>,
}

impl Parts {
    fn rest_area(&self) -> f64 {
        self.rest.iter().map(|r| area2(r).abs()).sum()
    }
}

/// A line that divides an outline.
struct Neck {
    ends: [Point; 2],
    /// The part without slanting walls, or with fewer, and the other one.
    parts: [Vec<Point>; 2],
    /// Its length, weighed by the slanting walls that it leaves on the better side.
    rank: f64,
}

struct Search<'p> {
    courts: &'p [Vec<Point>],
    cuts: Vec<[Point; 2]>,
    /// The divisions that may still be tried.
    left: usize,
}

impl Search<'_> {
    /// Divides an outline, walked like the first; adds its parts.
    fn divide(&mut self, ring: Vec<Point>, parts: &mut Parts) {
        if slants(&ring) == 0 {
            return parts.rest.push(ring);
        }
        for neck in self.necks(&ring) {
            if self.left == 0 {
                break;
            }
            self.left -= 1;
            let (mut found, cuts) = (Parts::default(), self.cuts.len());
            self.cuts.push(neck.ends);
            let [better, other] = neck.parts;
            let whole = area2(&better).abs();
            self.divide(better, &mut found);
            if found.rest_area() < 0.5 * whole {
                self.cuts.truncate(cuts);
                continue;
            }
            self.divide(other, &mut found);
            parts.rest.extend(found.rest);
            return parts.wings.extend(found.wings);
        }
        parts.wings.push(ring);
    }

    /// Returns the necks of an outline, the best first.
    fn necks(&self, ring: &[Point]) -> Vec<Neck> {
        let corners = 0..ring.len();
        let ways = [(1, 0), (-1, 0), (0, 1), (0, -1)];
        let all = corners.flat_map(|n| ways.into_iter().map(move |way| (n, way)));
        let mut found: Vec<Neck> = all.filter_map(|(n, way)| self.neck(ring, n, way)).collect();
        found.sort_by(|p, q| p.rank.total_cmp(&q.rank).then(p.ends.cmp(&q.ends)));
        found.dedup_by(|p, q| p.ends == q.ends);
        found
    }

    /// Returns the neck from a corner along an axis to the next wall.
    fn neck(&self, ring: &[Point], from: usize, way: (i64, i64)) -> Option<Neck> {
        let start = ring[from];
        let (length, edge, end) = hit(ring, start, way)?;
        let blocked = |court: &Vec<Point>| hit(court, start, way).is_some_and(|h| h.0 <= length);
        let count = ring.len();
        let next = (edge + 1) % count;
        // Along a wall, or outside.
        let beside = [(from + 1) % count, (from + count - 1) % count];
        let along = beside.iter().any(|n| ring[*n] == end);
        let middle = (i64::midpoint(start.0, end.0), i64::midpoint(start.1, end.1));
        if along || self.courts.iter().any(blocked) || !holds(ring, middle) {
            return None;
        }
        let walk = |from: usize, to: usize| {
            let steps = (to + count - from) % count;
            (0..=steps).map(move |k| ring[(from + k) % count])
        };
        let one: Vec<Point> = walk(from, edge).chain([end]).collect();
        let other: Vec<Point> = std::iter::once(end).chain(walk(next, from)).collect();
        let [one, other] = [one, other].map(tidy);
        let (one_slants, other_slants) = (slants(&one), slants(&other));
        let least = area2(&one).min(area2(&other)).abs() / 2.0;
        if one.len() < 3 || other.len() < 3 || length * length > SHORT * least {
            return None;
        }
        let whole = slants(ring);
        let (kept, parts) = match one_slants <= other_slants {
            true => (one_slants, [one, other]),
            false => (other_slants, [other, one]),
        };
        (kept < whole).then(|| Neck {
            ends: [start.min(end), start.max(end)],
            parts,
            rank: length * (1 + kept) as f64,
        })
    }
}

/// Returns the first wall that a ray from a point meets: its distance, the wall's number, and the place.
fn hit(ring: &[Point], from: Point, (da, db): (i64, i64)) -> Option<(f64, usize, Point)> {
    let mut best: Option<(i64, usize, Point)> = None;
    for n in 0..ring.len() {
        let (p, q) = (ring[n], ring[(n + 1) % ring.len()]);
        // Along the ray, and across it.
        let turn = |p: Point| match da {
            0 => ((p.1 - from.1) * db, p.0 - from.0),
            _ => ((p.0 - from.0) * da, p.1 - from.1),
        };
        let (p, q) = (turn(p), turn(q));
        let far = match (p.1, q.1) {
            (0, 0) => p.0.min(q.0),
            (0, _) => p.0,
            (_, 0) => q.0,
            (s, t) if (s < 0) != (t < 0) => {
                let share = s as f64 / (s as f64 - t as f64);
                p.0 + ((q.0 - p.0) as f64 * share).round() as i64
            }
            _ => continue,
        };
        if far > 0 && best.is_none_or(|b| far < b.0) {
            let at = (from.0 + da * far, from.1 + db * far);
            best = Some((far, n, at));
        }
    }
    best.map(|(far, n, at)| (far as f64, n, at))
}

/// Returns the outline of the roof of a wing: beyond each neck it goes on by the neck's length, as far as the rest goes.
fn continued(outline: &[Point], cuts: &[[Point; 2]], rest: &Plan) -> Vec<Point> {
    let mut roof = vec![];
    let inward = area2(outline).signum();
    for (n, p) in outline.iter().enumerate() {
        let q = outline[(n + 1) % outline.len()];
        roof.push(*p);
        if !cuts.iter().any(|cut| lies_on(*p, q, cut)) {
            continue;
        }
        let (a, b) = ((q.0 - p.0) as f64, (q.1 - p.1) as f64);
        let length = a.hypot(b);
        let out = (b / length * inward, -a / length * inward);
        let middle = (i64::midpoint(p.0, q.0), i64::midpoint(p.1, q.1));
        let way = (out.0.round() as i64, out.1.round() as i64);
        let walls = rest.loops.iter().filter_map(|ring| hit(ring, middle, way));
        let room = walls.map(|h| h.0).fold(f64::MAX, f64::min);
        let reach = length.min(room);
        if reach < LEAST_REACH || room == f64::MAX {
            continue;
        }
        let on = |p: Point| {
            let by = |way: f64| (way * reach).round() as i64;
            (p.0 + by(out.0), p.1 + by(out.1))
        };
        roof.extend([on(*p), on(q)]);
    }
    roof
}

/// Returns true if the line from p to q is a part of a neck.
fn lies_on(p: Point, q: Point, [from, to]: &[Point; 2]) -> bool {
    let within = |x: Point| {
        (from.0..=to.0).contains(&x.0) && (from.1.min(to.1)..=from.1.max(to.1)).contains(&x.1)
    };
    within(p) && within(q)
}

/// Returns the number of walls that are parallel to no axis.
fn slants(ring: &[Point]) -> usize {
    let next = ring.iter().cycle().skip(1);
    let walls = ring.iter().zip(next);
    walls.filter(|(p, q)| p.0 != q.0 && p.1 != q.1).count()
}

/// Returns twice the area of a ring, square steps, positive if it turns to the left in (a, b).
fn area2(ring: &[Point]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let cross = |(p, q): (&Point, &Point)| {
        i128::from(p.0) * i128::from(q.1) - i128::from(p.1) * i128::from(q.0)
    };
    ring.iter().zip(next).map(cross).sum::<i128>() as f64
}

fn oriented(mut ring: Vec<Point>) -> Vec<Point> {
    if area2(&ring) < 0.0 {
        ring.reverse();
    }
    ring
}

/// Returns true if a point lies inside a ring; on it both are possible.
fn holds(ring: &[Point], (a, b): Point) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |(p, q): &(&Point, &Point)| {
        let above = (p.1 > b) != (q.1 > b);
        let at = || {
            let share = (b - p.1) as f64 / (q.1 - p.1) as f64;
            p.0 as f64 + share * (q.0 - p.0) as f64
        };
        above && at() > a as f64
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}

/// Returns a ring whose walls are exactly parallel to an axis where they nearly are.
fn straightened(ring: &[Point]) -> Vec<Point> {
    let mut ring = ring.to_vec();
    for n in 0..ring.len() {
        let (p, next) = (ring[n], (n + 1) % ring.len());
        let q = &mut ring[next];
        if (q.0 - p.0).abs() <= STRAIGHT {
            q.0 = p.0;
        } else if (q.1 - p.1).abs() <= STRAIGHT {
            q.1 = p.1;
        }
    }
    tidy(ring)
}

/// Returns a ring without repeated corners and corners in mid-wall.
fn tidy(mut ring: Vec<Point>) -> Vec<Point> {
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    let needless =
        |p: Point, q: Point, r: Point| (p.0 == q.0 && q.0 == r.0) || (p.1 == q.1 && q.1 == r.1);
    let mut n = 0;
    while ring.len() > 3 && n < ring.len() {
        let count = ring.len();
        let (before, after) = (ring[(n + count - 1) % count], ring[(n + 1) % count]);
        match needless(before, ring[n], after) {
            true => {
                ring.remove(n);
                n = n.saturating_sub(1);
            }
            false => n += 1,
        }
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    const U: i64 = 1_000_000;

    fn plan(corners: &[(f64, f64)]) -> Plan {
        let at = |x: f64| (x * U as f64).round() as i64;
        Plan::from_loops(vec![corners.iter().map(|p| (at(p.0), at(p.1))).collect()])
    }

    #[test]
    fn a_skew_corridor_is_cut_off_where_it_begins() {
        let palace = plan(&[
            (0.0, 0.0),
            (20.0, 0.0),
            (20.0, 4.0),
            (32.0, 8.0),
            (31.4, 9.8),
            (20.0, 6.0),
            (20.0, 14.0),
            (0.0, 14.0),
        ]);
        let found = divided(&palace).expect("is divided");
        assert_eq!(
            found.rest.as_cell().map(|c| (c.a1 / U, c.b1 / U)),
            Some((20, 14))
        );
        let [corridor] = &found.wings[..] else {
            panic!("{:?}", found.wings)
        };
        assert_eq!(corridor.outline.len(), 4);
        assert_eq!(corridor.roof.len(), 6);
        assert_eq!(corridor.roof.iter().map(|p| p.0).min(), Some(18 * U));
    }

    #[test]
    fn a_corridor_between_two_halls_leaves_both() {
        let halls = plan(&[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 4.0),
            (20.0, 10.0),
            (20.0, 6.0),
            (30.0, 6.0),
            (30.0, 18.0),
            (20.0, 18.0),
            (20.0, 12.0),
            (10.0, 6.0),
            (10.0, 12.0),
            (0.0, 12.0),
        ]);
        let found = divided(&halls).expect("is divided");
        assert_eq!(found.rest.loops.len(), 2);
        assert_eq!(found.wings.len(), 1);
        assert_eq!(found.wings[0].roof.len(), 8);
    }

    #[test]
    fn a_splayed_corner_and_a_skew_house_stay_whole() {
        let splayed = plan(&[(0.0, 0.0), (7.0, 0.0), (8.0, 1.0), (8.0, 8.0), (0.0, 8.0)]);
        assert!(divided(&splayed).is_none());
        let skew = plan(&[(0.0, 0.0), (8.0, 1.0), (7.0, 9.0), (-1.0, 8.0)]);
        assert!(divided(&skew).is_none());
        let right = plan(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
        assert!(divided(&right).is_none());
    }
}
