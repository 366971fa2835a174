//! Three buildings have the sizes that are published of them (`docs/evidence.md` 4.8, S30, S54, S55, S68, S69), to one per cent.

use crate::monuments::{example, fittings, height, sound, width};
use crate::support::{Run, assert_none};
use glam::{DVec2, DVec3};
use hsd::building::Wall;
use hsd::building::fittings::FittingKind;
use hsd::geometry::SHAKU;

/// The share by which a size may differ.
const SHARE: f64 = 0.01;

/// A dimension: its name, the source of the published value, that value, and the value in the model.
type Figure = (&'static str, &'static str, f64, f64);

fn differing(figures: &[Figure]) -> Vec<String> {
    let wrong = figures
        .iter()
        .filter(|(.., published, found)| (found / published - 1.0).abs() > SHARE);
    wrong
        .map(|(what, source, published, found)| {
            format!("{what}: {found:.3} instead of {published} ({source})")
        })
        .collect()
}

/// The outer walls of a storey.
fn walls(run: &Run, house: usize, storey: usize) -> &[Wall] {
    &run.building.houses[house].house.storeys[storey].rings[0].walls
}

/// The size of the roofs over a storey in plan, metres.
fn roofs(run: &Run, house: usize, storey: u32) -> DVec2 {
    let all = run.building.houses[house].roofs.roofs.iter();
    let own = all.filter(|r| r.storey == storey);
    let points = || own.clone().flat_map(|r| &r.solids).flat_map(|s| &s.points);
    let (low, high) = points().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| {
        (low.min(*p), high.max(*p))
    });
    (high - low).truncate()
}

/// The height of the finial, metres.
fn finial(run: &Run, house: usize) -> f64 {
    let mut heights = fittings(run, house).iter().filter_map(|f| match &f.what {
        FittingKind::Finial(it) => Some(it.height),
        _ => None,
    });
    heights.next().expect("has a finial")
}

#[test]
fn suzakumon_has_its_published_sizes() {
    let run = example("suzakumon");
    sound(&run);
    let house = &run.building.houses[0].house;
    let wall = |n: usize| {
        let wall = &walls(&run, 0, 0)[n];
        wall.from.distance(wall.to) * house.unit
    };
    let bays = walls(&run, 0, 0)[0].units.len();
    let platform = fittings(&run, 0).iter().find_map(|f| match &f.what {
        FittingKind::Platform(it) => Some(it),
        _ => None,
    });
    let outline = &platform.expect("has a platform").outline;
    let low = outline.iter().copied().fold(DVec2::MAX, DVec2::min);
    let size = outline.iter().copied().fold(DVec2::MIN, DVec2::max) - low;
    // The hipped lower roof is as wide as the walls and its eaves on both sides.
    let eaves = (roofs(&run, 0, 1).x - wall(0)) / 2.0;
    assert_eq!((bays, walls(&run, 0, 0)[1].units.len()), (5, 2));
    assert_eq!(house.storeys.len(), 2);
    assert_none(&differing(&[
        (
            "a bay of the front, shaku",
            "S30",
            17.0,
            wall(0) / 5.0 / SHAKU,
        ),
        (
            "a bay of the side, shaku",
            "S30",
            17.0,
            wall(1) / 2.0 / SHAKU,
        ),
        ("width of the platform", "S30", 33.0, size.x),
        ("depth of the platform", "S30", 18.0, size.y),
        ("eaves, shaku", "S30", 12.0, eaves / SHAKU),
        ("height with the platform", "S68", 22.0, height(&run, 0)),
    ]));
}

#[test]
fn horyuji_has_its_published_sizes() {
    let run = example("pagoda");
    sound(&run);
    // Two bays a side on top, three below.
    let bays = [0, 1, 2, 3, 4].map(|storey| walls(&run, 0, storey)[0].units.len());
    assert_eq!(bays, [3, 3, 3, 3, 2]);
    let raised = run.building.houses[0].house.raised;
    assert_none(&differing(&[
        ("first storey", "S54", 6.42, width(&run, 0, 0)),
        ("fifth storey", "S54", 3.21, width(&run, 0, 4)),
        ("taper", "S55", 0.503, width(&run, 0, 4) / width(&run, 0, 0)),
        (
            "height above the platform",
            "S54",
            31.554,
            height(&run, 0) - raised,
        ),
        (
            "height with the upper platform",
            "S54",
            32.5,
            height(&run, 0),
        ),
        ("finial", "S54", 9.7, finial(&run, 0)),
    ]));
    let [first, fifth] = [1, 5].map(|storey| roofs(&run, 0, storey).x);
    assert!((fifth / first - 0.6).abs() < 0.01, "{fifth} {first}");
}

#[test]
fn toji_has_its_published_sizes() {
    let run = example("pagoda");
    let storeys = &run.building.houses[1].house.storeys;
    assert_eq!(storeys.len(), 5);
    for storey in 0..5 {
        assert!(walls(&run, 1, storey).iter().all(|w| w.units.len() == 3));
    }
    assert_none(&differing(&[
        ("storeys", "S69", 5.0, storeys.len() as f64),
        ("first storey", "S69", 9.48, width(&run, 1, 0)),
        ("fifth storey", "S55", 0.75 * 9.48, width(&run, 1, 4)),
        ("taper", "S55", 0.75, width(&run, 1, 4) / width(&run, 1, 0)),
        ("height", "S69", 54.8, height(&run, 1)),
    ]));
}
