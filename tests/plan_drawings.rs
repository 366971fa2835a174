//! Plan drawings of houses that nobody has seen before, made for the tests of `hsd plan`.
//!
//! [`plan`] makes a house and says what it really is; [`draw`] draws it in one of three [`Convention`]s; [`degrade`]
//! makes of the clean drawing a scan or a photograph and says where each point of it went; [`svg`] and [`dxf`] write the
//! same strokes as vectors; [`nonsense`] makes pictures that show no plan. All of it is independent of the reader: the
//! two agree on nothing but what `plans.md` says of such drawings. The same seed gives the same bytes.

#[path = "plan_drawings/degrade.rs"]
mod degrade;
#[path = "plan_drawings/furnish.rs"]
mod furnish;
#[path = "plan_drawings/furniture.rs"]
mod furniture;
#[path = "plan_drawings/itazu.rs"]
mod itazu;
#[path = "plan_drawings/mask.rs"]
mod mask;
#[path = "plan_drawings/nonsense.rs"]
mod nonsense;
#[path = "plan_drawings/openings.rs"]
mod openings;
#[path = "plan_drawings/paint.rs"]
mod paint;
#[path = "plan_drawings/rng.rs"]
mod rng;
#[path = "plan_drawings/rooms.rs"]
mod rooms;
#[path = "plan_drawings/sashizu.rs"]
mod sashizu;
#[path = "plan_drawings/sheet.rs"]
mod sheet;
#[path = "plan_drawings/survey.rs"]
mod survey;
#[path = "plan_drawings/symbols.rs"]
mod symbols;
#[path = "plan_drawings/truth.rs"]
mod truth;
#[path = "plan_drawings/vectors.rs"]
mod vectors;
#[path = "plan_drawings/writing.rs"]
mod writing;

pub use degrade::{Degradation, degrade};
pub use nonsense::{Nonsense, nonsense, truncated_png};
#[allow(unused_imports, reason = "the type of what `draw` answers")]
pub use paint::{Drawing, draw};
pub use sheet::{Convention, Variant};
#[allow(
    unused_imports,
    reason = "the names of what a plan is made of, for whoever takes it apart"
)]
pub use truth::{Area, Fixture, Floor, Furnishing, Kind, Plan, Point, RoomTruth, Run, Unit};
pub use vectors::{Cad, dxf, svg};

use rng::Rng;
use std::collections::{BTreeMap, BTreeSet};

/// A house by seed.
pub fn plan(seed: u64) -> Plan {
    let mut rng = Rng::new(seed, 1);
    let (mask, _) = mask::shape(&mut rng);
    let (grid, rooms) = rooms::divide(&mask, &mut rng);
    let mut layer = openings::Layer::default();
    let outer = openings::outer(&mask, &grid, &rooms, &mut layer, &mut rng);
    let inner = openings::inner(&mask, &grid, &rooms, &mut layer, &mut rng);
    let walls: Vec<Unit> = outer.iter().chain(&inner).copied().collect();
    let fixtures = furnish::furnish(&rooms, &walls, &mut rng);
    let mut loops = mask.loops().into_iter().map(|path| mask::corners(&path));
    let outline = loops.next().expect("a house has an outline");
    let courts = loops.collect();
    let posts = posts(&walls, &mut rng);
    Plan {
        width: mask.width,
        depth: mask.depth,
        outline,
        courts,
        outer,
        inner,
        rooms,
        fixtures,
        posts,
    }
}

/// Posts stand at the ends of symbols, where walls meet or turn, and every ken of a plain wall.
fn posts(walls: &[Unit], rng: &mut Rng) -> Vec<Point> {
    let mut meeting: BTreeMap<Point, Vec<(Point, u32)>> = BTreeMap::new();
    for unit in walls {
        let along = (unit.to.0 - unit.from.0, unit.to.1 - unit.from.1);
        meeting
            .entry(unit.from)
            .or_default()
            .push((along, unit.symbol));
        meeting
            .entry(unit.to)
            .or_default()
            .push(((-along.0, -along.1), unit.symbol));
    }
    let phase = rng.whole(0, 1);
    let mut posts = BTreeSet::new();
    for (point, ends) in meeting {
        let through =
            ends.len() == 2 && (ends[0].0.0 + ends[1].0.0, ends[0].0.1 + ends[1].0.1) == (0, 0);
        let same = through && ends[0].1 == ends[1].1;
        let wall = same
            && walls
                .iter()
                .any(|u| u.symbol == ends[0].1 && u.kind == Kind::Wall);
        if !same || (wall && (point.0 + point.1 + phase) % 2 == 0) {
            posts.insert(point);
        }
    }
    posts.into_iter().collect()
}

#[cfg(test)]
mod own_checks {
    //! The oracle is checked itself: by areas and lengths, by walking through the doors, by ink where a wall should be.

    use super::*;
    use std::collections::BTreeMap;

    fn twice_area(path: &[Point]) -> i32 {
        (0..path.len())
            .map(|k| (path[k], path[(k + 1) % path.len()]))
            .map(|(p, q)| p.0 * q.1 - q.0 * p.1)
            .sum()
    }

    #[test]
    fn rooms_fill_the_outline_and_all_are_reached() {
        for seed in 0..2000 {
            let plan = plan(seed);
            let built: i32 =
                twice_area(&plan.outline) + plan.courts.iter().map(|c| twice_area(c)).sum::<i32>();
            let cells: Vec<Point> = plan
                .rooms
                .iter()
                .flat_map(|room| room.area.cells())
                .collect();
            assert_eq!(built, 2 * cells.len() as i32, "seed {seed}");
            let room: BTreeMap<Point, usize> = plan
                .rooms
                .iter()
                .enumerate()
                .flat_map(|(k, r)| r.area.cells().map(move |c| (c, k)))
                .collect();
            let mut reached = BTreeSet::from([0]);
            for _ in 0..plan.rooms.len() {
                for unit in plan
                    .inner
                    .iter()
                    .filter(|u| !matches!(u.kind, Kind::Wall | Kind::Window | Kind::Lattice))
                {
                    let low = unit.from.min(unit.to);
                    let other = if unit.from.1 == unit.to.1 {
                        (low.0, low.1 - 1)
                    } else {
                        (low.0 - 1, low.1)
                    };
                    if reached.contains(&room[&low]) || reached.contains(&room[&other]) {
                        reached.extend([room[&low], room[&other]]);
                    }
                }
            }
            assert_eq!(reached.len(), plan.rooms.len(), "seed {seed}");
            assert!(
                plan.outer
                    .iter()
                    .any(|u| matches!(u.kind, Kind::Slide | Kind::Hinged | Kind::Open)),
                "seed {seed}"
            );
        }
    }

    #[test]
    #[ignore = "takes long; `.ci/nightly tests` runs it"]
    fn ink_lies_where_the_truth_says_in_every_quality() {
        for convention in [Convention::Survey, Convention::Sashizu, Convention::Itazu] {
            for way in [
                Degradation::Clean,
                Degradation::Scanned,
                Degradation::Photographed,
            ] {
                let (mut dark, mut all) = (0, 0);
                for seed in 0..12 {
                    let plan = plan(seed);
                    let drawn = draw(
                        &plan,
                        convention,
                        Variant {
                            seed,
                            unseen: false,
                        },
                        40.0,
                    );
                    let (picture, map) = degrade(drawn.picture, way, seed);
                    let place = drawn.place.then(&map);
                    let tone = |a: f64, b: f64| {
                        let (x, y) = place.apply(a, b);
                        i32::from(picture.get_pixel(x as u32, y as u32).0[1])
                    };
                    for unit in plan.outer.iter().filter(|u| u.kind == Kind::Wall) {
                        let (a, b) = (
                            f64::from(unit.from.0 + unit.to.0) / 2.0,
                            f64::from(unit.from.1 + unit.to.1) / 2.0,
                        );
                        let (da, db) = (
                            f64::from(unit.to.1 - unit.from.1) * 0.45,
                            f64::from(unit.to.0 - unit.from.0) * -0.45,
                        );
                        let near = [-0.06, 0.0, 0.06]
                            .map(|t| tone(a + da * t / 0.45, b + db * t / 0.45))
                            .into_iter()
                            .min();
                        all += 1;
                        dark += i32::from(near.expect("three tones") + 25 < tone(a + da, b + db));
                    }
                }
                assert!(
                    dark * 100 >= all * 97,
                    "{convention:?} {way:?}: {dark} of {all}"
                );
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bytes() {
        let make = || {
            let plan = plan(5);
            let drawn = draw(
                &plan,
                Convention::Sashizu,
                Variant {
                    seed: 3,
                    unseen: true,
                },
                30.0,
            );
            degrade(drawn.picture, Degradation::Photographed, 9)
                .0
                .into_raw()
        };
        assert_eq!(make(), make());
    }
}
