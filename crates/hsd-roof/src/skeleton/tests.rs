//! Skeletons with known answers, and random outlines that must pass their own checks.

use super::*;
use glam::dvec2;

fn ring(points: &[(f64, f64)]) -> Vec<(DVec2, u32)> {
    points.iter().map(|p| (dvec2(p.0, p.1), 0)).collect()
}

fn of(outline: &[(f64, f64)], courts: &[&[(f64, f64)]]) -> Skeleton {
    let courts: Vec<_> = courts.iter().map(|c| ring(c)).collect();
    let contours = Contours::new(&ring(outline), &courts).expect("is simple");
    skeleton(&contours).expect("has a skeleton")
}

/// Returns the inner nodes, sorted.
fn inner(skeleton: &Skeleton) -> Vec<(f64, f64, f64)> {
    let round = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
    let inside = skeleton.nodes.iter().filter(|n| n.time > 0.0);
    let mut nodes: Vec<_> = inside
        .map(|n| (round(n.at.x), round(n.at.y), round(n.time)))
        .collect();
    nodes.sort_by(|p, q| p.partial_cmp(q).expect("are numbers"));
    nodes
}

/// The meeting point of two lines that move inwards at speed 1 moves at speed 1 along both normals, however sharp the
/// corner: at 1e-6 rad the sum of the normals has lost half of its digits.
#[test]
fn corners_move_with_both_of_their_edges() {
    for turn in [0.0, 0.3, 1.9, 3.7, 5.2] {
        let left = DVec2::from_angle(turn);
        for angle in [1e-6, 1e-5, 1e-3, 0.1, 1.0, 1.5, 2.0, 3.0] {
            for side in [-1.0, 1.0] {
                let right = DVec2::from_angle(turn + side * (std::f64::consts::PI - angle));
                let velocity = wave::velocity(left, right).expect("the lines meet");
                for normal in [left, right] {
                    let speed = velocity.dot(normal);
                    assert!((speed - 1.0).abs() < 1e-8, "{turn} {angle} {side}: {speed}");
                }
            }
        }
        assert_eq!(wave::velocity(left, left), Some(left));
        assert_eq!(wave::velocity(left, -left), None);
    }
}

#[test]
fn a_rectangle_has_a_ridge_as_long_as_its_sides_differ() {
    let skeleton = of(&[(0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (0.0, 4.0)], &[]);
    assert_eq!(inner(&skeleton), [(2.0, 2.0, 2.0), (8.0, 2.0, 2.0)]);
    let sides: Vec<usize> = skeleton.faces.iter().map(|f| f.nodes.len()).collect();
    assert_eq!(sides, [4, 3, 4, 3]);
}

#[test]
fn a_square_has_one_peak() {
    let skeleton = of(&[(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)], &[]);
    assert_eq!(inner(&skeleton), [(3.0, 3.0, 3.0)]);
}

#[test]
fn an_l_of_equal_wings_has_two_ridges_that_meet() {
    let l = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 4.0),
        (4.0, 4.0),
        (4.0, 12.0),
        (0.0, 12.0),
    ];
    let skeleton = of(&l, &[]);
    assert_eq!(
        inner(&skeleton),
        [(2.0, 2.0, 2.0), (2.0, 10.0, 2.0), (8.0, 2.0, 2.0)]
    );
}

#[test]
fn an_l_of_unequal_wings_has_a_lower_ridge_that_runs_into_the_higher() {
    let l = [
        (0.0, 0.0),
        (12.0, 0.0),
        (12.0, 4.0),
        (6.0, 4.0),
        (6.0, 12.0),
        (0.0, 12.0),
    ];
    let skeleton = of(&l, &[]);
    let expected = [
        (3.0, 3.0, 3.0),
        (3.0, 9.0, 3.0),
        (4.0, 2.0, 2.0),
        (10.0, 2.0, 2.0),
    ];
    assert_eq!(inner(&skeleton), expected);
}

#[test]
fn a_court_in_the_middle_has_a_ridge_all_round() {
    let outer = [(0.0, 0.0), (12.0, 0.0), (12.0, 12.0), (0.0, 12.0)];
    let court = [(4.0, 4.0), (8.0, 4.0), (8.0, 8.0), (4.0, 8.0)];
    let skeleton = of(&outer, &[&court]);
    let expected = [
        (2.0, 2.0, 2.0),
        (2.0, 10.0, 2.0),
        (10.0, 2.0, 2.0),
        (10.0, 10.0, 2.0),
    ];
    assert_eq!(inner(&skeleton), expected);
}

#[test]
fn several_arms_meet_in_one_point() {
    // A plus: four reflex corners meet in the middle.
    let plus = [
        (4.0, 0.0),
        (6.0, 0.0),
        (6.0, 4.0),
        (10.0, 4.0),
        (10.0, 6.0),
        (6.0, 6.0),
        (6.0, 10.0),
        (4.0, 10.0),
        (4.0, 6.0),
        (0.0, 6.0),
        (0.0, 4.0),
        (4.0, 4.0),
    ];
    let expected = [
        (1.0, 5.0, 1.0),
        (5.0, 1.0, 1.0),
        (5.0, 5.0, 1.0),
        (5.0, 9.0, 1.0),
        (9.0, 5.0, 1.0),
    ];
    assert_eq!(inner(&of(&plus, &[])), expected);
}

#[test]
fn an_h_splits_at_both_ends_of_its_bar() {
    let h = [
        (0.0, 0.0),
        (6.0, 0.0),
        (6.0, 7.0),
        (14.0, 7.0),
        (14.0, 0.0),
        (20.0, 0.0),
        (20.0, 18.0),
        (14.0, 18.0),
        (14.0, 11.0),
        (6.0, 11.0),
        (6.0, 18.0),
        (0.0, 18.0),
    ];
    let skeleton = of(&h, &[]);
    assert!((skeleton.depth() - 3.0).abs() < 1e-9);
    assert!(inner(&skeleton).contains(&(4.0, 9.0, 2.0)));
}

/// A running random generator, for tests only.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn found(outline: &[(f64, f64)], courts: &[&[(f64, f64)]]) -> Result<bool, Invalid> {
    let courts: Vec<_> = courts.iter().map(|c| ring(c)).collect();
    let contours = Contours::new(&ring(outline), &courts)?;
    Ok(skeleton(&contours).is_some())
}

#[test]
fn random_stars_have_skeletons() {
    let mut draw = Draw(7);
    let (mut sound, mut failed) = (0, vec![]);
    for case in 0..1500 {
        let n = 3 + (draw.next() * if case % 10 == 0 { 120.0 } else { 14.0 }) as usize;
        let star: Vec<(f64, f64)> = (0..n)
            .map(|i| {
                let (turn, far) = (
                    std::f64::consts::TAU * i as f64 / n as f64,
                    1.0 + 9.0 * draw.next(),
                );
                (far * libm::cos(turn), far * libm::sin(turn))
            })
            .collect();
        match found(&star, &[]) {
            Ok(true) => sound += 1,
            Ok(false) => failed.push((case, star)),
            Err(_) => {}
        }
    }
    assert!(failed.is_empty(), "{} {:?}", failed.len(), failed[0]);
    assert!(sound > 1400, "{sound}");
}

/// A union of random rectangles on a coarse grid: everything happens at once there.
#[test]
fn random_orthogonal_outlines_have_skeletons() {
    use hsd_base::geometry::plan::{Cell, Plan};
    let mut draw = Draw(99);
    let (mut sound, mut failed) = (0, vec![]);
    for _ in 0..1500 {
        let mut plan = Plan::default();
        for _ in 0..2 + (draw.next() * 5.0) as usize {
            let mut span = || {
                let from = (draw.next() * 10.0) as i64;
                (from, from + 1 + (draw.next() * 6.0) as i64)
            };
            let ((a0, a1), (b0, b1)) = (span(), span());
            plan = plan.union(&Plan::from_cells(&[Cell { a0, b0, a1, b1 }]));
        }
        let points = |l: &Vec<(i64, i64)>| -> Vec<(f64, f64)> {
            l.iter().map(|p| (p.0 as f64, p.1 as f64)).collect()
        };
        let loops: Vec<Vec<(f64, f64)>> = plan.clean().loops.iter().map(points).collect();
        for outline in &loops {
            match found(outline, &[]) {
                Ok(true) => sound += 1,
                Ok(false) => failed.push(outline.clone()),
                Err(_) => {}
            }
        }
    }
    assert!(failed.is_empty(), "{} {:?}", failed.len(), failed[0]);
    assert!(sound > 1400, "{sound}");
}

#[test]
fn combs_and_spirals_have_skeletons() {
    for teeth in [2, 5, 20, 80] {
        let mut comb = vec![(0.0, 0.0), (2.0 * teeth as f64 - 1.0, 0.0)];
        for k in (0..teeth).rev() {
            let x = 2.0 * k as f64;
            comb.extend([(x + 1.0, 3.0), (x, 3.0)]);
            if k > 0 {
                comb.extend([(x, 1.0), (x - 1.0, 1.0)]);
            }
        }
        // The corners at the notches were written for all but the last tooth.
        assert_eq!(found(&comb, &[]), Ok(true), "{teeth} teeth");
    }
    for turns in [2, 6, 12] {
        let (mut outer, mut inner) = (vec![], vec![]);
        for k in 0..4 * turns {
            let far = 1.0 + k as f64 / 2.0;
            let (x, y) = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][k % 4];
            outer.push((x * far, y * far));
            inner.push((x * (far - 0.7), y * (far - 0.7)));
        }
        outer.extend(inner.into_iter().rev());
        assert_eq!(found(&outer, &[]), Ok(true), "{turns} turns");
    }
}

#[test]
fn regular_polygons_meet_in_their_middle() {
    for n in 3..64 {
        let corner = |i: usize| {
            let turn = std::f64::consts::TAU * i as f64 / n as f64 + 0.3;
            (5.0 * libm::cos(turn), 5.0 * libm::sin(turn))
        };
        let polygon: Vec<_> = (0..n).map(corner).collect();
        let skeleton = of(&polygon, &[]);
        let apothem = 5.0 * libm::cos(std::f64::consts::PI / n as f64);
        assert!((skeleton.depth() - apothem).abs() < 1e-6, "{n}");
    }
}

#[test]
fn courts_anywhere_have_skeletons() {
    let mut draw = Draw(5);
    let outer = [(0.0, 0.0), (20.0, 0.0), (20.0, 14.0), (0.0, 14.0)];
    for case in 0..400 {
        let mut court = |x0: f64, x1: f64| {
            let (w, h) = (1.0 + 4.0 * draw.next(), 1.0 + 4.0 * draw.next());
            let (x, y) = (
                x0 + (x1 - x0 - w) * draw.next(),
                1.0 + (12.0 - h) * draw.next(),
            );
            let (x, y) = if case % 2 == 0 {
                (x.round(), y.round())
            } else {
                (x, y)
            };
            let skew = if case % 3 == 0 {
                0.4 * draw.next()
            } else {
                0.0
            };
            [(x, y), (x + w, y + skew), (x + w, y + h), (x, y + h)]
        };
        let (first, second) = (court(1.0, 9.0), court(11.0, 19.0));
        match found(&outer, &[&first, &second]) {
            Ok(sound) => assert!(sound, "{case} {first:?} {second:?}"),
            Err(why) => panic!("{case} {why}"),
        }
    }
}

#[test]
fn what_is_no_outline_says_why() {
    assert_eq!(
        found(&[(0.0, 0.0), (1.0, 0.0)], &[]),
        Err(Invalid::TooFewCorners)
    );
    let bow = [(0.0, 0.0), (4.0, 4.0), (5.0, 0.0), (0.0, 5.0)];
    assert!(matches!(found(&bow, &[]), Err(Invalid::Crosses { .. })));
    let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    let beside = [(6.0, 0.0), (8.0, 0.0), (8.0, 2.0), (6.0, 2.0)];
    assert!(matches!(
        found(&square, &[&beside]),
        Err(Invalid::CourtOutside { .. })
    ));
    assert_eq!(
        found(&[(0.0, 0.0), (f64::NAN, 0.0), (1.0, 1.0)], &[]),
        Err(Invalid::TooFar)
    );
}

#[test]
fn outlines_that_are_almost_at_right_angles_have_skeletons() {
    use hsd_base::geometry::plan::{Cell, Plan};
    let mut draw = Draw(2024);
    let (mut sound, mut failed) = (0, vec![]);
    for case in 0..3000 {
        let mut plan = Plan::default();
        for _ in 0..2 + (draw.next() * 6.0) as usize {
            let mut span = || {
                let from = (draw.next() * 10.0) as i64;
                (from, from + 1 + (draw.next() * 6.0) as i64)
            };
            let ((a0, a1), (b0, b1)) = (span(), span());
            plan = plan.union(&Plan::from_cells(&[Cell { a0, b0, a1, b1 }]));
        }
        let off = libm::exp10(-1.0 - f64::from(case % 12));
        let turn = if case % 2 == 0 { 0.0 } else { draw.next() };
        let (sine, cosine) = (libm::sin(turn), libm::cos(turn));
        for corners in &plan.clean().loops {
            let mut place = |p: &(i64, i64)| {
                let (x, y) = (
                    p.0 as f64 + off * draw.next(),
                    p.1 as f64 + off * draw.next(),
                );
                (x * cosine - y * sine, x * sine + y * cosine)
            };
            let outline: Vec<(f64, f64)> = corners.iter().map(&mut place).collect();
            match found(&outline, &[]) {
                Ok(true) => sound += 1,
                Ok(false) => failed.push((off, outline)),
                Err(_) => {}
            }
        }
    }
    assert!(failed.is_empty(), "{} {:?}", failed.len(), failed[0]);
    assert!(sound > 2800, "{sound}");
}

/// Towers with many walls of nearly one length: pairs of opposite walls are parallel but for the last digits, and meet at
/// nearly one time. No ridge may run past the centre.
#[test]
fn nearly_regular_outlines_end_at_their_centre() {
    for (corners, seed) in (4..17).flat_map(|n| (0..40).map(move |seed| (2 * n, seed))) {
        let mut state = 0x9e37_79b9_u64 * (seed + 1);
        let ring: Vec<(f64, f64)> = (0..corners)
            .map(|i| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                let far = 16.0 + 1e-7 * (state >> 60) as f64;
                let turn = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
                (far * turn.cos(), far * turn.sin())
            })
            .collect();
        let skeleton = of(&ring, &[]);
        let inner = skeleton.nodes.iter().filter(|n| n.time > 0.0);
        let off = inner.map(|n| n.at.length()).fold(0.0, f64::max);
        assert!(off < 1e-3, "{corners} corners, {seed}: {off} m off");
    }
}
