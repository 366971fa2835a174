//! The solids that building law lets stand on lots (002-28 to 002-32): closed forms, volumes against samples of random lots, faces
//! on the planes of their rules, roads that grow.

use glam::{DVec2, DVec3, dvec2};
use hsd::ast::law::{DistrictPlan, Terms};
use hsd::geometry::Heading;
use hsd::geometry::envelope::{Bound, faces};
use hsd::town::shape::{area, contains, distance};
use hsd::town::site::law::{Envelope, Facet, Front, Ground, Rule, envelope};

/// Numbers that are the same in every run (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64;
        low + share * (high - low)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next(0.0, count as f64) as usize).min(count - 1)
    }
}

fn rectangle(width: f64, depth: f64) -> Vec<DVec2> {
    [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)]
        .map(|(x, y)| dvec2(x, y))
        .to_vec()
}

/// An envelope of a lot without holes, with roads at these sides of these widths.
fn of(ring: &[DVec2], roads: &[(usize, f64)], terms: &Terms) -> Envelope {
    let fronts = roads
        .iter()
        .map(|(side, width)| Front::at(ring, *side, *width));
    envelope(ring, &[], &fronts.collect::<Vec<Front>>(), terms)
}

fn is(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-9, "{value} is not {expected}");
}

/// Terms under which adjacent land limits nothing.
fn of_roads(limit: f64) -> Terms {
    Terms {
        limit,
        side_height: 1000.0,
        ..Terms::default()
    }
}

#[test]
fn a_rectangle_on_one_road_has_the_closed_form() {
    let (width, depth) = (6.0, 20.0);
    let lot = rectangle(width, depth);
    let made = of(&lot, &[(0, 4.0)], &of_roads(60.0));
    // From 1.5 x 4 at the front to 1.5 x 24 at the rear.
    is(made.volume(), width * depth * (6.0 + 36.0) / 2.0);
    is(made.height(), 36.0);
    is(made.height_at(dvec2(3.0, 0.0)).expect("inside"), 6.0);
    // The application ends 30 m from the far side, behind which the greatest height counts.
    let long = rectangle(width, 40.0);
    let made = of(&long, &[(0, 4.0)], &of_roads(60.0));
    is(
        made.volume(),
        width * (26.0 * (6.0 + 45.0) / 2.0 + 14.0 * 60.0),
    );
    // The height limit cuts the slope 20 / 1.5 m from the far side.
    let made = of(&lot, &[(0, 4.0)], &of_roads(20.0));
    let slope = 20.0 / 1.5 - 4.0;
    is(
        made.volume(),
        width * (slope * (6.0 + 20.0) / 2.0 + (depth - slope) * 20.0),
    );
    // Set back by 2 m, the far side counts 2 m farther, and the house stands 2 m behind.
    let back = Terms {
        setback: 2.0,
        ..of_roads(60.0)
    };
    let made = of(&lot, &[(0, 4.0)], &back);
    is(made.height_at(dvec2(3.0, 2.0)).expect("inside"), 1.5 * 8.0);
    is(made.volume(), width * 18.0 * 1.5 * (8.0 + 26.0) / 2.0);
    assert_eq!(made.height_at(dvec2(3.0, 1.0)), None);
}

#[test]
fn a_rectangle_on_two_roads_has_the_closed_form() {
    let (a, b) = (12.0, 16.0);
    let lot = rectangle(a, b);
    // Equal roads at a corner: z = 1.5 (4 + min(x, y)), whose integral over a rectangle a <= b is a^2 (3 b - a) / 6.
    let made = of(&lot, &[(0, 4.0), (3, 4.0)], &of_roads(60.0));
    is(
        made.volume(),
        1.5 * (4.0 * a * b + a * a * (3.0 * b - a) / 6.0),
    );
    // A through lot: the ridge lies where both roads are equally far.
    let made = of(&lot, &[(0, 4.0), (2, 6.0)], &of_roads(60.0));
    let ridge = (b + 6.0 - 4.0) / 2.0;
    let wing = |width: f64, depth: f64| 1.5 * a * (width * depth + depth * depth / 2.0);
    is(made.volume(), wing(4.0, ridge) + wing(6.0, b - ridge));
    // Two walls on one road: rules that agree count once.
    let step = [
        (0.0, 0.0),
        (6.0, 0.0),
        (6.0, 2.0),
        (12.0, 2.0),
        (12.0, 16.0),
        (0.0, 16.0),
    ];
    let step = step.map(|(x, y)| dvec2(x, y));
    let made = of(&step, &[(0, 4.0), (2, 6.0)], &of_roads(60.0));
    is(
        made.volume(),
        6.0 * 1.5 * (4.0 * 16.0 + 128.0) + 6.0 * 1.5 * (6.0 * 14.0 + 98.0),
    );
    is(
        made.cells.iter().map(|cell| cell.area()).sum(),
        area(&step, &[]),
    );
    // Adjacent land on all sides: a hip roof from 31 m.
    let made = of(
        &lot,
        &[],
        &Terms {
            limit: 1000.0,
            ..Terms::default()
        },
    );
    let hip = a * a * (3.0 * b - a) / 12.0;
    is(made.volume(), 31.0 * a * b + 2.5 * hip);
}

#[test]
fn floors_fill_the_ratio_of_the_road() {
    let lot = rectangle(6.0, 20.0);
    let terms = Terms {
        ratio: Some(4.0),
        ..of_roads(60.0)
    };
    // 4 m x 0.4 = 160 % (002-30).
    let made = of(&lot, &[(0, 4.0)], &terms);
    is(made.ratio.expect("a road limits it"), 1.6);
    let floors = made.floors();
    is(floors.iter().sum(), 1.6 * 120.0);
    is(floors[0], 120.0);
    is(floors[1], 72.0);
    // From 12 m of width the designated ratio counts, and where a plan relaxes that of the road.
    is(
        of(&lot, &[(0, 12.0)], &terms).ratio.expect("designated"),
        4.0,
    );
    let guided = Terms {
        plan: DistrictPlan::Guided,
        limit: 12.0,
        setback: 0.5,
        ..terms
    };
    let made = of(&lot, &[(0, 4.0)], &guided);
    is(made.ratio.expect("designated"), 4.0);
    is(made.volume(), 6.0 * 19.5 * 12.0);
    is(made.floors().iter().sum(), 4.0 * 6.0 * 19.5);
    // The third storey reaches 9 m, which the slope has 2 m behind the front.
    let open = Terms {
        ratio: None,
        factor: 10.0,
        ..terms
    };
    is(of(&lot, &[(0, 4.0)], &open).floors()[2], 6.0 * 18.0);
    // As in the paper's figure: cut where a house on the whole lot has used up its 160 %.
    let cut = Terms {
        by_ratio: true,
        ..terms
    };
    let made = of(&lot, &[(0, 4.0)], &cut);
    is(made.volume(), 120.0 * 4.8);
    let rules: Vec<String> = made
        .binding()
        .iter()
        .map(|(n, _)| made.rules[*n].name())
        .collect();
    assert_eq!(rules, ["ratio"]);
}

/// A random lot: a star, which is concave more often than not, or a rectangle with one corner taken out.
fn random_lot(numbers: &mut Numbers) -> Vec<DVec2> {
    if numbers.below(3) == 0 {
        let (a, b) = (numbers.next(6.0, 30.0), numbers.next(6.0, 30.0));
        let (c, d) = (numbers.next(0.2, 0.8) * a, numbers.next(0.2, 0.8) * b);
        return [(0.0, 0.0), (a, 0.0), (a, d), (c, d), (c, b), (0.0, b)]
            .map(|(x, y)| dvec2(x, y))
            .to_vec();
    }
    let count = 3 + numbers.below(7);
    let turn = numbers.next(0.0, 1.0);
    let corner = |n: usize, numbers: &mut Numbers| {
        let angle = (n as f64 + turn + numbers.next(-0.3, 0.3)) / count as f64 * 360.0;
        Heading::new(angle).vector() * numbers.next(4.0, 20.0)
    };
    (0..count).map(|n| corner(n, numbers)).collect()
}

fn random_terms(numbers: &mut Numbers) -> Terms {
    Terms {
        gradient: [1.25, 1.5][numbers.below(2)],
        distance: [20.0, 25.0, 30.0][numbers.below(3)],
        limit: numbers.next(8.0, 60.0),
        setback: [0.0, 0.0, numbers.next(0.3, 2.0)][numbers.below(3)],
        side_height: [20.0, 31.0, 6.0][numbers.below(3)],
        side_gradient: [1.25, 2.5][numbers.below(2)],
        ..Terms::default()
    }
}

fn random_case(numbers: &mut Numbers) -> (Vec<DVec2>, Vec<(usize, f64)>, Terms) {
    let lot = random_lot(numbers);
    let mut roads = vec![];
    for side in 0..lot.len() {
        if numbers.below(3) == 0 {
            roads.push((side, numbers.next(1.8, 20.0)));
        }
    }
    (lot, roads, random_terms(numbers))
}

/// The height that the law allows over a place, found by itself, side by side.
fn allowed(lot: &[DVec2], roads: &[(usize, f64)], terms: &Terms, p: DVec2) -> f64 {
    let n = lot.len();
    let side = |i: usize| (lot[i % n], lot[(i + 1) % n]);
    let way = |i: usize| (side(i).1 - side(i).0).normalize();
    // Metres behind the line of a side, and along it.
    let behind = |i: usize| way(i).perp_dot(p - side(i).0);
    let mut least = terms.limit;
    for i in 0..n {
        let (from, to) = side(i);
        let length = from.distance(to);
        if let Some((_, width)) = roads.iter().find(|(road, _)| *road == i) {
            let along = way(i).dot(p - from);
            let (b, s) = (behind(i), terms.setback);
            if (0.0..s).contains(&b) && (-2.0 * s..length + 2.0 * s).contains(&along) {
                return 0.0;
            }
            let far = width + s + b;
            if b >= 0.0 && far <= terms.distance {
                least = least.min(terms.gradient * far);
            }
            continue;
        }
        let turns_in = |i: usize, j: usize| way(i).perp_dot(way(j)) < 0.0;
        let (before, after) = ((i + n - 1) % n, (i + 1) % n);
        let governs = |other: usize, reflex: bool| match reflex {
            true => behind(i) >= behind(other),
            false => behind(other) >= 0.0,
        };
        let mine = behind(i) >= 0.0
            && governs(before, turns_in(before, i))
            && governs(after, turns_in(i, after));
        if mine {
            least = least.min(terms.side_height + terms.side_gradient * behind(i));
        }
    }
    least
}

#[test]
fn volumes_are_those_of_samples_on_random_lots() {
    const LOTS: usize = 1000;
    const SIDE: usize = 32;
    let mut numbers = Numbers(18);
    let (mut concave, mut worst) = (0, 0.0f64);
    for number in 0..LOTS {
        let (lot, roads, terms) = random_case(&mut numbers);
        let made = of(&lot, &roads, &terms);
        let turns = |i: usize| {
            let [p, q, r] = [i, i + 1, i + 2].map(|k| lot[k % lot.len()]);
            (q - p).perp_dot(r - q) < 0.0
        };
        concave += usize::from((0..lot.len()).any(turns));
        let low = lot.iter().copied().reduce(DVec2::min).expect("has corners");
        let high = lot.iter().copied().reduce(DVec2::max).expect("has corners");
        let step = (high - low) / SIDE as f64;
        let (mut sum, mut square) = (0.0, 0.0);
        for cell in 0..SIDE * SIDE {
            let at = dvec2((cell % SIDE) as f64, (cell / SIDE) as f64);
            let p = low + step * (at + dvec2(numbers.next(0.0, 1.0), numbers.next(0.0, 1.0)));
            if contains(&lot, p) {
                let height = allowed(&lot, &roads, &terms, p);
                sum += height;
                square += height * height;
                let own = made.height_at(p).unwrap_or(0.0);
                assert!(
                    (own - height).abs() < 1e-5,
                    "lot {number} at {p}: {own} is not {height}"
                );
            }
        }
        let count = (SIDE * SIDE) as f64;
        let (mean, ground) = (sum / count, (high - low).element_product());
        // Samples in a grid scatter less than free ones.
        let scatter = ((square / count - mean * mean) / count).sqrt();
        let off = (made.volume() - mean * ground) / (scatter * ground).max(1e-9);
        worst = worst.max(off.abs());
        assert!(off.abs() < 4.0, "lot {number} is {off} deviations off");
        let whole: f64 = made.cells.iter().map(|cell| cell.area()).sum();
        assert!(whole <= area(&lot, &[]) + 1e-6);
    }
    assert!(concave > LOTS / 3, "only {concave} lots are concave");
    assert!(worst > 0.0);
}

/// The volume that faces enclose (Gauss).
fn enclosed(rings: &[Vec<DVec3>]) -> f64 {
    let fan = |ring: &Vec<DVec3>| {
        let first = ring[0];
        let corners = ring[1..].windows(2);
        corners
            .map(|two| first.dot(two[0].cross(two[1])))
            .sum::<f64>()
            / 6.0
    };
    rings.iter().map(fan).sum()
}

#[test]
fn every_face_lies_on_the_plane_of_a_rule() {
    const NEAR: f64 = 1e-5;
    let mut numbers = Numbers(56);
    for number in 0..300 {
        let (lot, roads, terms) = random_case(&mut numbers);
        let made = of(&lot, &roads, &terms);
        let found = faces(&made.cells, &made.limits);
        for face in &found {
            let places = || face.ring.iter().map(|p| (p.truncate(), p.z));
            let on_line = |of: &dyn Fn(DVec2) -> f64| places().all(|(p, _)| of(p).abs() < NEAR);
            let fits = match face.bound {
                Bound::Ground => places().all(|(_, z)| z == 0.0),
                Bound::Limit(n) => {
                    places().all(|(p, z)| (made.limits[n].height(p) - z).abs() < NEAR)
                }
                Bound::End(n) => {
                    let within = &made.limits[n].within;
                    within.iter().any(|half| on_line(&|p| half.depth(p)))
                }
                Bound::Side => {
                    let on_border = places().all(|(p, _)| distance(&lot, p + made.at) < NEAR);
                    let on_strip = roads.iter().any(|(side, _)| {
                        let (p, q) = (lot[*side], lot[(side + 1) % lot.len()]);
                        let (way, at) = ((q - p).normalize(), p - made.at);
                        let along = |x: DVec2| way.dot(x - at);
                        let (s, length) = (terms.setback, p.distance(q));
                        on_line(&|x| way.perp_dot(x - at) - s)
                            || on_line(&|x| way.perp_dot(x - at))
                            || on_line(&|x| along(x) + 2.0 * s)
                            || on_line(&|x| along(x) - length - 2.0 * s)
                    });
                    on_border || on_strip
                }
            };
            assert!(fits, "lot {number}: {face:?}");
        }
        let rings: Vec<Vec<DVec3>> = found.into_iter().map(|face| face.ring).collect();
        let (volume, solid) = (made.volume(), enclosed(&rings));
        assert!(
            (volume - solid).abs() < 1e-4 * volume.max(1.0),
            "lot {number}: {volume} {solid}"
        );
    }
}

#[test]
fn a_wider_road_never_shrinks_an_envelope() {
    let mut numbers = Numbers(43);
    for number in 0..300 {
        let (lot, mut roads, mut terms) = random_case(&mut numbers);
        (terms.ratio, terms.by_ratio) = (Some(numbers.next(1.0, 8.0)), numbers.below(2) == 0);
        if roads.is_empty() {
            roads.push((0, 3.0));
        }
        let (mut volume, mut floor) = (0.0, 0.0);
        for _ in 0..5 {
            let made = of(&lot, &roads, &terms);
            assert!(
                made.volume() >= volume - 1e-6,
                "lot {number} shrinks from {volume}"
            );
            let floors: f64 = made.floors().iter().sum();
            assert!(floors >= floor - 1e-6, "lot {number} loses floor area");
            (volume, floor) = (made.volume(), floors);
            let widened = numbers.below(roads.len());
            roads[widened].1 += numbers.next(0.1, 4.0);
        }
    }
}

#[test]
fn houses_above_their_envelope_are_measured() {
    let lot = rectangle(6.0, 20.0);
    let made = of(&lot, &[(0, 4.0)], &of_roads(60.0));
    is(made.exceeded(&lot, 6.0), 0.0);
    is(made.exceeded(&lot, 9.0), 3.0);
    let rear = rectangle(6.0, 10.0)
        .iter()
        .map(|p| *p + dvec2(0.0, 10.0))
        .collect::<Vec<DVec2>>();
    is(made.exceeded(&rear, 21.0), 0.0);
    is(made.exceeded(&rear, 22.0), 1.0);
}

#[test]
fn faces_tell_their_rule_and_its_arithmetic() {
    let made = of(
        &rectangle(6.0, 40.0),
        &[(0, 4.0)],
        &Terms {
            side_height: 50.0,
            ..Terms::default()
        },
    );
    let road = made
        .rules
        .iter()
        .find(|rule| matches!(rule, Rule::Road { .. }));
    let road = road.expect("a road is in front");
    assert_eq!(road.arithmetic(), "1.5 x d; d = 4 + x <= 30");
    let named: Vec<String> = made.faces().iter().map(|face| face.ground.name()).collect();
    for name in ["ground", "border", "road 1", "side 2", "end of road 1"] {
        assert!(
            named.iter().any(|own| own == name),
            "no face is of {name}: {named:?}"
        );
    }
    let is_end = |face: &Facet| matches!(face.ground, Ground::End(Rule::Road { .. }));
    let ends: Vec<Facet> = made.faces().into_iter().filter(is_end).collect();
    assert!(
        ends.iter()
            .all(|face| face.ring.iter().all(|p| (p.y - 26.0).abs() < 1e-9))
    );
}
