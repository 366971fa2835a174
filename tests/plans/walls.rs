//! Plans that keep to no grid, drawn here: walls of any thickness, length and direction.

use super::{legends, picture};
use glam::{DVec2, dvec2};
use hsd::plan::legend::Role;
use hsd::plan::text::Era;
use hsd::plan::walls::openings::pieces;
use hsd::plan::walls::scale::Evidence;
use hsd::plan::walls::writing::{self, Drawn, Traced};
use hsd::plan::walls::{self, Found};
use hsd::plan::{self, Plan};
use image::{Rgb, RgbImage};

/// Draws a wall between two places, pixels.
pub(super) fn wall(sheet: &mut RgbImage, a: DVec2, b: DVec2, thickness: f64) {
    for (x, y, pixel) in sheet.enumerate_pixels_mut() {
        let at = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let along = ((at - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        let off = (at - a.lerp(b, along)).abs();
        if off.max_element() <= thickness / 2.0 {
            *pixel = Rgb([20; 3]);
        }
    }
}

/// A house of six rooms off every grid: 613 by 437 pixels, with five doors and a cut corner.
fn sheet(at: DVec2) -> RgbImage {
    sheet_in(at, [14.0, 9.0])
}

/// That house with outer and inner walls of the given thicknesses.
fn sheet_in(at: DVec2, [outer, inner]: [f64; 2]) -> RgbImage {
    let mut sheet = RgbImage::from_pixel(1000, 700, Rgb([250; 3]));
    let (w, h) = (613.0, 437.0);
    let p = |x: f64, y: f64| at + dvec2(x, y);
    let round = [
        p(0.0, 0.0),
        p(w - 97.0, 0.0),
        p(w, 97.0),
        p(w, h),
        p(0.0, h),
    ];
    for k in 0..round.len() {
        wall(&mut sheet, round[k], round[(k + 1) % round.len()], outer);
    }
    // Walls inside, each with a door of 50 pixels.
    wall(&mut sheet, p(251.0, 0.0), p(251.0, 150.0), inner);
    wall(&mut sheet, p(251.0, 200.0), p(251.0, h), inner);
    wall(&mut sheet, p(251.0, 263.0), p(400.0, 263.0), inner);
    wall(&mut sheet, p(450.0, 263.0), p(w, 263.0), inner);
    wall(&mut sheet, p(0.0, 331.0), p(97.0, 331.0), inner);
    wall(&mut sheet, p(147.0, 331.0), p(251.0, 331.0), inner);
    wall(&mut sheet, p(341.0, 0.0), p(341.0, 119.0), inner);
    wall(&mut sheet, p(341.0, 169.0), p(341.0, 263.0), inner);
    wall(&mut sheet, p(489.0, 263.0), p(489.0, 287.0), inner);
    wall(&mut sheet, p(489.0, 337.0), p(489.0, h), inner);
    sheet
}

fn read(sheet: RgbImage, unit: Option<f64>) -> Box<Found> {
    let options = plan::Options {
        unit,
        ..plan::Options::default()
    };
    read_with(sheet, &options)
}

/// Reads a sheet wall by wall.
pub(super) fn read_with(sheet: RgbImage, options: &plan::Options) -> Box<Found> {
    match plan::read(&picture(sheet), &legends(), options) {
        Ok(Plan::Walls(found)) => found,
        other => panic!(
            "not read wall by wall: {:?}",
            other.map(|_| "on a grid").map_err(|e| e.why)
        ),
    }
}

fn traced(found: &Found) -> Traced {
    let head = ("h", &[][..], Era::named("edo").unwrap());
    writing::write(&[found.storey(10.0)], head).expect("a house")
}

fn written(found: &Found) -> Drawn {
    traced(found).storeys[0].clone()
}

#[test]
fn walls_keep_their_lengths_and_directions() {
    let found = read(sheet(dvec2(150.0, 120.0)), Some(50.0));
    assert_eq!(found.reading.rooms(), 6);
    assert_eq!(found.scale.evidence, Evidence::Given);
    let size = found.size(&written(&found));
    let metres = walls::writing::UNIT / 50.0;
    let off = size - dvec2(613.0, 437.0) * metres;
    assert!(off.abs().max_element() < 0.06, "{size}");
    // The cut corner is a separate wall.
    let outline = written(&found).outline;
    let turns = (0..outline.len()).filter(|k| {
        let at = |step: usize| outline[(k + step) % outline.len()];
        let (before, after) = (at(1) - at(0), at(2) - at(1));
        before.normalize().perp_dot(after.normalize()).abs() > 0.02
    });
    // Pixels may leave a short side at its end.
    assert!((5..=6).contains(&turns.count()), "{outline:?}");
    let explained = found.reading.explained;
    assert!(explained > 0.97, "{explained}");
}

/// Draws over the back wall, 120 pixels along it.
fn over_the_back_wall(sheet: &mut RgbImage, colour: [u8; 3]) {
    for (x, y) in (200..320).flat_map(|x| (112..128).map(move |y| (x, y))) {
        sheet.put_pixel(x, y, Rgb(colour));
    }
}

/// The pieces of the back wall, with their lengths in pixels.
fn back_wall(found: &Found) -> Vec<(Role, f64)> {
    let (divided, graph) = (&found.reading.divided, &found.reading.graph);
    let mut out = vec![];
    for line in &graph.lines {
        let ends = line.ends.map(|k| graph.corners[k]);
        let mut from = 0.0;
        for piece in pieces((divided, graph), line, found.scale.metres) {
            if ends.iter().all(|p| (p.y - 120.0).abs() < 4.0) {
                out.push((piece.role, (piece.to - from).round()));
            }
            from = piece.to;
        }
    }
    out
}

#[test]
fn windows_in_another_colour_are_read() {
    let blue = [90, 160, 250];
    let mut coloured = sheet(dvec2(150.0, 120.0));
    over_the_back_wall(&mut coloured, blue);
    // A red line across a wall does not open it.
    wall(&mut coloured, dvec2(380.0, 60.0), dvec2(380.0, 160.0), 3.0);
    for y in 60..160 {
        (378..382).for_each(|x| coloured.put_pixel(x, y, Rgb([230, 30, 30])));
    }
    let found = back_wall(&read(coloured, Some(50.0)));
    let windows: Vec<f64> = found
        .iter()
        .filter(|(role, _)| *role != Role::Wall)
        .map(|(role, length)| {
            assert_eq!(*role, Role::Window);
            *length
        })
        .collect();
    assert!(
        matches!(windows[..], [length] if (length - 120.0).abs() < 16.0),
        "{found:?}"
    );
    // Where most walls are blue, blue says nothing.
    let mut blue_walls = sheet(dvec2(150.0, 120.0));
    for pixel in blue_walls.pixels_mut().filter(|p| p[0] < 128) {
        *pixel = Rgb([20, 40, 160]);
    }
    over_the_back_wall(&mut blue_walls, [20; 3]);
    let found = back_wall(&read(blue_walls, Some(50.0)));
    assert!(
        found.iter().all(|(role, _)| *role == Role::Wall),
        "{found:?}"
    );
}

#[test]
fn what_is_read_builds_and_says_where_its_size_is_from() {
    let found = read(sheet(dvec2(150.0, 120.0)), None);
    assert_eq!(found.scale.evidence, Evidence::Openings);
    // The openings, of 41 pixels between the ends of walls, are taken for doors.
    assert!(
        (found.scale.metres * 41.0 - 0.85).abs() < 0.05,
        "{:?}",
        found.scale
    );
    let text = traced(&found).text;
    let source = hsd::Source::new(hsd::FileId(0), "h.hsd", text.as_bytes());
    let mut out = hsd::Diagnostics::new();
    let made = hsd::check(
        &[&source],
        &hsd::NoFiles,
        &hsd::Options::default(),
        &mut out,
    );
    // Walls that meet on the sheet meet in the house, and the roof suits the cut corner; only a way in is missing.
    let told = out.into_sorted();
    let others: Vec<_> = told.iter().filter(|d| d.code != hsd::Code(443)).collect();
    assert!(others.is_empty(), "{others:?}\n{text}");
    assert_eq!(made.building.houses[0].rooms.len(), 6, "{text}");
}

#[test]
fn hollow_walls_of_a_thicker_pen_are_filled() {
    // Only the faces of the walls are drawn, with a pen of 2 pixels; a bed in one of 1.
    let solid = sheet(dvec2(150.0, 120.0));
    let is_wall = |x: i64, y: i64| {
        let inside = (0..1000).contains(&x) && (0..700).contains(&y);
        inside && solid.get_pixel(x as u32, y as u32)[0] < 128
    };
    let mut hollow = RgbImage::from_fn(1000, 700, |x, y| {
        let (x, y) = (i64::from(x), i64::from(y));
        let within = (-2..=2).all(|dx| (-2..=2).all(|dy| is_wall(x + dx, y + dy)));
        Rgb([if is_wall(x, y) && !within { 20 } else { 250 }; 3])
    });
    for (x, y) in (180..240).flat_map(|x| [(x, 300), (x, 380)]) {
        hollow.put_pixel(x, y, Rgb([60; 3]));
    }
    let found = read(hollow, Some(50.0));
    let size = found.size(&written(&found));
    let metres = walls::writing::UNIT / 50.0;
    let off = size - dvec2(613.0, 437.0) * metres;
    assert!(off.abs().max_element() < 0.1, "{size}");
    assert_eq!(found.reading.rooms(), 6);
}

#[test]
fn corner_between_two_windows_belongs_to_the_house() {
    let at = dvec2(150.0, 120.0);
    let mut open = sheet(at);
    // One arm of the corner ends at a window in the left wall, the other at a window in the front wall.
    let windows = [
        (at + dvec2(0.0, 331.0 + 20.0), at + dvec2(0.0, 437.0 - 45.0)),
        (at + dvec2(45.0, 437.0), at + dvec2(130.0, 437.0)),
    ];
    for (a, b) in windows {
        for (x, y, pixel) in open.enumerate_pixels_mut() {
            let p = dvec2(f64::from(x), f64::from(y));
            if p.cmpge(a - 8.0).all() && p.cmple(b + 8.0).all() {
                let thin =
                    (p.x - a.x).abs() < 1.0 && a.x == b.x || (p.y - a.y).abs() < 1.0 && a.y == b.y;
                *pixel = Rgb([if thin { 60 } else { 250 }; 3]);
            }
        }
    }
    let found = read(open, Some(50.0));
    let off = found.size(&written(&found)) - dvec2(613.0, 437.0) * (walls::writing::UNIT / 50.0);
    assert!(off.abs().max_element() < 0.1, "{off}");
    assert_eq!(found.reading.rooms(), 6);
}

#[test]
fn partitions_much_thinner_than_outer_walls_divide_rooms() {
    let at = dvec2(150.0, 120.0);
    let mut thick = sheet_in(at, [32.0, 6.0]);
    // A table in hairlines stands apart.
    for k in 0..60 {
        for (x, y) in [(k, 0), (k, 40), (0, k * 2 / 3), (60, k * 2 / 3)] {
            thick.put_pixel(520 + x, 320 + y, Rgb([20; 3]));
        }
    }
    // The door beside a stub that is shorter than outer walls are thick may stay open: two rooms are one then.
    let rooms = read(thick, Some(50.0)).reading.rooms();
    assert!((5..=6).contains(&rooms), "{rooms}");
}

#[test]
fn another_house_on_the_sheet_is_counted() {
    let mut two = sheet(dvec2(40.0, 40.0));
    let p = |x: f64, y: f64| dvec2(725.0, 300.0) + dvec2(x, y);
    let round = [p(0.0, 0.0), p(150.0, 0.0), p(150.0, 330.0), p(0.0, 330.0)];
    for k in 0..4 {
        wall(&mut two, round[k], round[(k + 1) % 4], 14.0);
    }
    let found = read(two, Some(50.0));
    let metres = walls::writing::UNIT / 50.0;
    let apart = written(&found).apart;
    let drawn = 150.0 * 330.0 * metres * metres;
    assert!((apart / drawn - 1.0).abs() < 0.1, "{apart} m2 of {drawn}");
}

/// Each unit of a grid is sampled by each legend, so a fine grid on a large sheet is not read.
#[test]
fn grid_of_too_many_cells_is_not_sampled() {
    let ruled = RgbImage::from_fn(1400, 1400, |x, y| match x.min(y) >= 40 && x.max(y) < 1350 {
        true if x % 12 < 2 || y % 12 < 2 => Rgb([20; 3]),
        _ => Rgb([250; 3]),
    });
    let read = plan::read(&picture(ruled), &legends(), &plan::Options::default());
    match read.map_err(|stopped| stopped.why) {
        Err(plan::Refused::TooFine(cells)) => assert!(cells > 10_000, "{cells} cells"),
        other => panic!("{:?}", other.map(|_| "a house")),
    }
}

#[test]
fn nonsense_is_no_house() {
    use crate::plan_drawings::{Nonsense, nonsense};
    let kinds = [
        Nonsense::Noise,
        Nonsense::Blank,
        Nonsense::Street,
        Nonsense::Map,
    ];
    let cases: Vec<(Nonsense, u64)> = kinds
        .into_iter()
        .flat_map(|kind| {
            (100..100 + crate::support::part_of(12) as u64).map(move |seed| (kind, seed))
        })
        .collect();
    let findings = crate::support::on_all_processors(cases.len(), |k| {
        let (kind, seed) = cases[k];
        let read = plan::read(
            &picture(nonsense(kind, seed, (700, 500))),
            &legends(),
            &plan::Options::default(),
        );
        let is_house = read.is_ok().then(|| format!("{kind:?} {seed} is a house"));
        is_house.into_iter().collect()
    });
    crate::support::assert_none(&findings);
}
