//! Several plans on one sheet: the storeys of a house.

use super::walls::{read_with, wall};
use super::{legends, picture};
use glam::{DMat3, DVec2, dvec2};
use hsd::plan::text::Era;
use hsd::plan::walls::scale::{Evidence, Scale};
use hsd::plan::walls::writing::{self, Storey};
use hsd::plan::walls::{Found, stacked};
use hsd::plan::{self, Options, Plan};
use image::{Rgb, RgbImage};

/// Pixels in half a ken.
const UNIT: f64 = 40.0;

/// Draws the walls round a box and across it, each wall across with an opening in its middle. Places are half ken from `at`.
fn draw(sheet: &mut RgbImage, at: DVec2, size: DVec2, across: &[f64]) {
    let p = |x: f64, y: f64| at + dvec2(x, y) * UNIT;
    let round = [
        p(0.0, 0.0),
        p(size.x, 0.0),
        p(size.x, size.y),
        p(0.0, size.y),
    ];
    for k in 0..4 {
        wall(sheet, round[k], round[(k + 1) % 4], 10.0);
    }
    for x in across {
        let middle = size.y / 2.0;
        wall(sheet, p(*x, 0.0), p(*x, middle - 0.5), 8.0);
        wall(sheet, p(*x, middle + 0.5), p(*x, size.y), 8.0);
    }
}

/// The ground of 9.3 by 6.2 half ken and an upper storey of 5.6 by 6.2, whose walls stand on three of the ground.
pub(crate) fn sheet() -> RgbImage {
    let mut sheet = RgbImage::from_pixel(900, 420, Rgb([250; 3]));
    draw(&mut sheet, dvec2(60.0, 80.0), dvec2(9.3, 6.2), &[3.7, 7.1]);
    draw(&mut sheet, dvec2(560.0, 90.0), dvec2(5.6, 6.2), &[3.4]);
    sheet
}

fn read(sheet: &RgbImage, region: Option<[DVec2; 2]>) -> Box<Found> {
    let options = Options {
        unit: Some(UNIT),
        region,
        ..Options::default()
    };
    read_with(sheet.clone(), &options)
}

/// The width and depth of a storey, half ken.
fn size(found: &Found) -> DVec2 {
    let head = ("h", &[][..], Era::named("edo").unwrap());
    let traced = writing::write(&[found.storey(10.0)], head).expect("a house");
    found.size(&traced.storeys[0]) / writing::UNIT
}

#[test]
fn the_largest_plan_is_read_and_all_are_named() {
    let sheet = sheet();
    let largest = read(&sheet, None);
    assert!(
        size(&largest).abs_diff_eq(dvec2(9.3, 6.2), 0.15),
        "{}",
        size(&largest)
    );
    let flat = &largest.flat;
    let regions: Vec<_> = flat.plans.iter().map(|r| flat.in_picture(*r)).collect();
    let [ground, upper] = regions[..] else {
        panic!("{regions:?}")
    };
    // The boxes meet in the space between the two at most.
    assert!(ground[1].x <= upper[0].x, "{regions:?}");
    for x in [ground[1].x, upper[0].x] {
        assert!((440.0..550.0).contains(&x), "{regions:?}");
    }
    let upper = read(&sheet, Some(upper));
    assert!(upper.flat.plans.is_empty());
    assert!(
        size(&upper).abs_diff_eq(dvec2(5.6, 6.2), 0.15),
        "{}",
        size(&upper)
    );
    // Places are those of the whole image.
    let corner = upper.in_picture(upper.reading.graph.corners[0]);
    assert!(corner.x > 540.0, "{corner}");
}

#[test]
fn upper_walls_are_laid_on_those_of_the_ground() {
    let sheet = sheet();
    let ground = read(&sheet, Some([dvec2(0.0, 0.0), dvec2(500.0, 420.0)]));
    let upper = read(&sheet, Some([dvec2(500.0, 0.0), dvec2(900.0, 420.0)]));
    let plan = |found: &Found| (found.reading.graph.clone(), found.scale.metres);
    let ((below, metres), (above, of_above)) = (plan(&ground), plan(&upper));
    let shift = stacked::register((&below, metres), (&above, of_above));
    let storeys = [
        ground.storey(9.5),
        Storey {
            shift,
            ..upper.storey(9.0)
        },
    ];
    let head = ("h", &[][..], Era::named("edo").unwrap());
    let traced = writing::write(&storeys, head).expect("a house");
    // Upright walls stand 3.4 and 5.6 half ken apart on both storeys, from 3.7 to 9.3 on the ground. So both fronts begin at the
    // same corner.
    let starts: Vec<&str> = traced
        .text
        .lines()
        .filter(|l| l.contains("<Storey"))
        .collect();
    let start = starts[1]
        .split_once("start=\"")
        .map_or("0 0", |(_, rest)| rest);
    let numbers: Vec<f64> = start
        .trim_end_matches("\">")
        .split(' ')
        .map(|n| n.parse().expect("a number"))
        .collect();
    assert!(numbers.iter().all(|n| n.abs() < 0.1), "{starts:?}");
}

#[test]
fn openings_in_one_line_do_not_divide_a_plan() {
    let mut sheet = RgbImage::from_pixel(700, 420, Rgb([250; 3]));
    let p = |x: f64, y: f64| dvec2(80.0, 70.0) + dvec2(x, y) * UNIT;
    // Walls on both sides of a passage whose ends are open.
    for (a, b) in [
        (p(0.0, 0.0), p(5.3, 0.0)),
        (p(6.2, 0.0), p(11.4, 0.0)),
        (p(0.0, 7.3), p(5.3, 7.3)),
        (p(6.2, 7.3), p(11.4, 7.3)),
        (p(0.0, 0.0), p(0.0, 7.3)),
        (p(11.4, 0.0), p(11.4, 7.3)),
        (p(0.0, 2.7), p(5.3, 2.7)),
        (p(6.2, 4.4), p(11.4, 4.4)),
    ] {
        wall(&mut sheet, a, b, 10.0);
    }
    let read = plan::read(&picture(sheet), &legends(), &Options::default());
    let flat = match read.map_err(|stopped| stopped.why).expect("a plan") {
        Plan::Grid(found) => found.flat,
        Plan::Walls(found) => found.flat,
    };
    assert!(flat.plans.is_empty(), "{:?}", flat.plans);
}

#[test]
fn a_table_beside_a_plan_is_no_storey() {
    let mut sheet = RgbImage::from_pixel(900, 420, Rgb([250; 3]));
    draw(&mut sheet, dvec2(60.0, 80.0), dvec2(9.3, 6.2), &[3.7, 7.1]);
    // Lines of a schedule, farther apart than letters are high.
    for k in 0..6 {
        let (y, right) = (180.0 + 30.0 * f64::from(k), dvec2(780.0, 0.0));
        wall(&mut sheet, dvec2(600.0, y), right + dvec2(0.0, y), 2.0);
    }
    for x in [600.0, 690.0, 780.0] {
        wall(&mut sheet, dvec2(x, 180.0), dvec2(x, 330.0), 2.0);
    }
    let found = read(&sheet, None);
    assert!(found.flat.plans.is_empty(), "{:?}", found.flat.plans);
    assert!(
        size(&found).abs_diff_eq(dvec2(9.3, 6.2), 0.15),
        "{}",
        size(&found)
    );
}

#[test]
fn a_box_along_the_outer_walls_keeps_them() {
    let tight = [dvec2(55.0, 75.0), dvec2(437.0, 333.0)];
    let found = read(&sheet(), Some(tight));
    assert!(
        size(&found).abs_diff_eq(dvec2(9.3, 6.2), 0.15),
        "{}",
        size(&found)
    );
}

#[test]
fn boxes_come_back_from_a_turned_sheet() {
    let turned = DMat3::from_angle(0.05);
    let mut flat = read(&sheet(), None).flat.clone();
    flat.to_picture = turned;
    let region = [dvec2(100.0, 100.0), dvec2(400.0, 300.0)];
    let back = flat.on_sheet(flat.in_picture(region));
    for (a, b) in region.into_iter().zip(back) {
        assert!(a.abs_diff_eq(b, 2.0), "{back:?}");
    }
}

#[test]
fn the_surest_scale_of_a_sheet_counts() {
    let scale = |metres, evidence| Scale { metres, evidence };
    let doors = scale(0.02, Evidence::Doors(9));
    let printed = scale(0.03, Evidence::Printed(2));
    assert_eq!(doors.surer(printed), printed);
    assert_eq!(printed.surer(doors), printed);
    assert_eq!(printed.surer(scale(0.04, Evidence::Printed(2))), printed);
    // Walls at quarters of a ken are found from doors, so they say more.
    let half_ken = scale(0.021, Evidence::HalfKen);
    assert_eq!(doors.surer(half_ken), half_ken);
}
