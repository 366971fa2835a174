//! Outlines as surveyed: where the walls come to stand, what is squared and joined, what fills the sides
//! (docs/contract.md 8).

mod parts;
mod roofs;

use crate::support::{Numbers, Run, compile};
use glam::{DVec2, dvec2};
use hsd::ast::RoofShape;
use hsd::building::{House, Ring};
use hsd::geometry::Heading;
use hsd::program::Content;
use std::fmt::Write;

fn run(text: &str) -> Run {
    compile("outline.hsd", text.as_bytes())
}

fn house(outline: &str, storeys: &str) -> Run {
    run(&format!(
        "<House><Outline {outline}</Outline>{storeys}</House>"
    ))
}

fn points(points: &[DVec2]) -> String {
    let mut text = String::new();
    for p in points {
        let _ = write!(text, "{} {}, ", p.x, p.y);
    }
    text
}

/// The codes of the messages of a run.
fn codes(run: &Run) -> Vec<u16> {
    run.diagnostics.iter().map(|d| d.code.0).collect()
}

fn first(run: &Run) -> &House {
    &run.building.houses[0].house
}

/// The corners of a ring, metres east and north in the world.
fn corners(house: &House, ring: &Ring) -> Vec<DVec2> {
    let turn = Heading::new(180.0 - house.azimuth).vector();
    let [x, y, _] = house.origin;
    let place = |p: DVec2| dvec2(x, y) + turn.rotate(dvec2(-p.x, p.y) * house.unit);
    ring.walls.iter().map(|w| place(w.from)).collect()
}

fn ground(run: &Run, ring: usize) -> Vec<DVec2> {
    let house = first(run);
    corners(house, &house.storeys[0].rings[ring])
}

/// How far the farthest of some points lies from the nearest of others.
fn apart(from: &[DVec2], to: &[DVec2]) -> f64 {
    let nearest = |p: &DVec2| to.iter().map(|q| p.distance(*q)).fold(f64::MAX, f64::min);
    from.iter().map(nearest).fold(0.0, f64::max)
}

/// The codes of the parts of each wall of a storey's ring, walls divided by blanks.
fn filled(run: &Run, storey: usize, ring: usize) -> Vec<String> {
    let part = |content: &Content| match content {
        Content::Part(id) => run.catalog.part(*id).code().trim().to_owned(),
        other => format!("{other:?}"),
    };
    let walls = &first(run).storeys[storey].rings[ring].walls;
    let wall = walls
        .iter()
        .map(|w| w.units.iter().map(|u| part(&u.content)).collect());
    wall.map(|parts: Vec<String>| parts.join(" ")).collect()
}

const L: [DVec2; 6] = [
    dvec2(0.0, 0.0),
    dvec2(12.0, 0.0),
    dvec2(12.0, 6.0),
    dvec2(7.0, 6.0),
    dvec2(7.0, 11.0),
    dvec2(0.0, 11.0),
];

fn turned(points: &[DVec2], degrees: f64, to: DVec2) -> Vec<DVec2> {
    let turn = DVec2::from_angle(degrees.to_radians());
    points.iter().map(|p| to + turn.rotate(*p)).collect()
}

#[test]
fn walls_stand_where_they_were_surveyed() {
    let far = dvec2(-21_340.5, 1_204.25);
    for degrees in [0.0, 17.3, 90.0, 133.0, -44.9, -45.0, 240.0] {
        let survey = turned(&L, degrees, far);
        let mut backwards = survey.clone();
        backwards.reverse();
        let mut closed = survey.clone();
        closed.push(survey[0]);
        for ring in [survey.clone(), backwards, closed] {
            let run = house(&format!("points='{}'>", points(&ring)), "");
            assert_eq!(codes(&run), [0; 0], "{degrees}: {}", run.short());
            let found = ground(&run, 0);
            assert_eq!(found.len(), 6);
            assert!(apart(&found, &survey) < 1.5e-3, "{degrees}: {found:?}");
            assert!(apart(&survey, &found) < 1.5e-3, "{degrees}: {found:?}");
            let roofs = &run.building.houses[0].roofs.roofs;
            assert!(
                roofs.iter().all(|r| r.shape == RoofShape::Gable),
                "{roofs:?}"
            );
        }
    }
}

#[test]
fn noise_is_squared_and_told() {
    for seed in 0..40 {
        let mut numbers = Numbers(seed);
        let mut noise = || numbers.below(200) as f64 / 1000.0 - 0.1;
        let survey = turned(&L, seed as f64 * 9.7, DVec2::ZERO);
        let survey: Vec<DVec2> = survey
            .iter()
            .map(|p| *p + dvec2(noise(), noise()))
            .collect();
        let run = house(&format!("points='{}'>", points(&survey)), "");
        assert_eq!(codes(&run), [421], "{seed}: {}", run.short());
        let found = ground(&run, 0);
        assert_eq!(found.len(), 6, "{seed}");
        assert!(apart(&found, &survey) < 0.3, "{seed}");
        let straight = |ring: &Ring| {
            ring.walls
                .iter()
                .all(|w| w.direction.abs().max_element() == 1.0)
        };
        assert!(first(&run).storeys[0].rings.iter().all(straight), "{seed}");
    }
}

#[test]
fn what_slants_keeps_its_corners_and_says_why() {
    let slant = "0 0, 9 0, 12 4, 12 8, 0 8";
    let run = house(&format!("points='{slant}'>"), "");
    assert_eq!(codes(&run), [422], "{}", run.short());
    assert!(run.short().contains("side 2 slants by"));
    assert_eq!(ground(&run, 0).len(), 5);

    let rough = "0 0, 9 0.9, 9 8, 0 8";
    let run = house(&format!("points='{rough}'>"), "");
    assert_eq!(codes(&run), [422], "{}", run.short());
    assert!(run.short().contains("would move by"), "{}", run.short());
    // The corner that is named is the one that is marked, whichever way round they are written.
    for rough in [rough, "0 8, 9 8, 9 0.9, 0 0"] {
        let said = house(&format!("points='{rough}'>"), "").short();
        let named = (1..=4).find(|n| said.contains(&format!("corner {n} would move")));
        let corner = rough.split(", ").nth(named.expect("a corner is named") - 1);
        assert!(
            said.contains(&format!("marked: \"{}\"", corner.unwrap())),
            "{said}"
        );
    }
    let run = house(&format!("points='{rough}' square='0.6'>"), "");
    assert_eq!(codes(&run), [421], "{}", run.short());
    let run = house(&format!("points='{rough}' square='no'>"), "");
    assert_eq!(codes(&run), [520], "{}", run.short());
}

#[test]
fn what_does_not_slant_is_squared_and_joined_and_says_how_far() {
    // A front that steps back by 25 cm, a corner 10 cm aside, a wing at 37 degrees.
    let wing = "0 0, 6 0, 6 0.25, 14 0.25, 14.1 3, 18 6, 16.8 7.6, 14 5.5, 14 9, 0 9";
    let run = house(&format!("points='{wing}'>"), "");
    let said = run.short();
    assert_eq!(codes(&run), [422], "{said}");
    assert!(said.contains("corners moving by up to"), "{said}");
    let walls = &first(&run).storeys[0].rings[0].walls;
    let slanting = walls
        .iter()
        .filter(|w| w.direction.abs().max_element() < 1.0);
    assert_eq!((walls.len(), slanting.count()), (8, 3), "{said}");
    let run = house(&format!("points='{wing}' square='no'>"), "");
    assert_eq!(ground(&run, 0).len(), 10, "{}", run.short());
}

#[test]
fn short_sides_at_any_angle_are_squared_away() {
    // A corner cut by 20 cm.
    let run = house("points='0 0, 8.8 0, 9 0.2, 9 6, 0 6'>", "");
    assert_eq!(codes(&run), [421], "{}", run.short());
    assert_eq!(ground(&run, 0).len(), 4);
}

#[test]
fn walls_nearly_in_line_are_put_on_one() {
    let steps = "0 0, 6 0, 6 0.25, 12 0.25, 12 8, 0 8";
    let run = house(&format!("points='{steps}'>"), "");
    assert_eq!(codes(&run), [421], "{}", run.short());
    assert_eq!(ground(&run, 0).len(), 4);
    assert_eq!(run.building.houses[0].roofs.roofs.len(), 1);
    let run = house(&format!("points='{steps}' join='0'>"), "");
    assert_eq!(ground(&run, 0).len(), 6);
}

#[test]
fn doubled_corners_and_spikes_are_left_out() {
    let run = house("points='0 0, 9 0, 9 0.004, 9 6, 4 6, 4 8, 4 6, 0 6'>", "");
    assert_eq!(codes(&run), [423], "{}", run.short());
    assert_eq!(ground(&run, 0).len(), 4);
}

#[test]
fn courts_are_open() {
    for court in ["5 4, 5 7, 9 7, 9 4", "5 4, 9 4, 9 7, 5 7, 5 4"] {
        let run = house(
            &format!("points='0 0, 14 0, 14 11, 0 11'><Hole points='{court}'/>"),
            "",
        );
        assert_eq!(codes(&run), [0; 0], "{}", run.short());
        let rings = &first(&run).storeys[0].rings;
        assert!(rings.len() == 2 && rings[1].hole && rings[1].closed);
        let court = [
            dvec2(5.0, 4.0),
            dvec2(9.0, 4.0),
            dvec2(9.0, 7.0),
            dvec2(5.0, 7.0),
        ];
        assert!(apart(&ground(&run, 1), &court) < 1.5e-3);
    }
    let run = house(
        "points='0 0, 14 0, 14 11, 0 11'><Hole points='5 4, 9 4'/>",
        "",
    );
    assert_eq!(codes(&run), [424]);
    assert_eq!(first(&run).storeys[0].rings.len(), 1);
}

#[test]
fn the_front_is_given_or_on_a_street_or_in_the_south() {
    let azimuth = |attributes: &str| {
        let run = house(&format!("points='{}' {attributes}>", points(&L)), "");
        assert_eq!(codes(&run), [0; 0], "{}", run.short());
        first(&run).azimuth
    };
    assert_eq!(azimuth(""), 180.0);
    assert_eq!(azimuth("front='2'"), 90.0);
    assert_eq!(azimuth("street='4,6'"), 270.0);
    assert_eq!(azimuth("street='4,6' front='5'"), 0.0);
}

#[test]
fn groups_and_places_turn_outlines() {
    let outline = "<House><Outline points='10 0, 22 0, 22 6, 10 6'/></House>";
    let run = run(&format!(
        "<Houses>
           <define name='kado'><House><Outline points='10 0, 22 0, 22 6, 10 6'/></House></define>
           {outline}
           <Group x='100' turn='90'>{outline}</Group>
           <Place type='kado' x='200' y='5' azimuth='90'/>
           <House x='300' azimuth='0'><Outline points='10 0, 22 0, 22 6, 10 6'/></House>
         </Houses>"
    ));
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    let stands = |n: usize| {
        let house = &run.building.houses[n].house;
        let corners = corners(house, &house.storeys[0].rings[0]);
        let low = corners.iter().fold(DVec2::MAX, |a, b| a.min(*b));
        let high = corners.iter().fold(DVec2::MIN, |a, b| a.max(*b));
        [low.x, low.y, high.x, high.y].map(|x| x.round() as i64)
    };
    assert_eq!(stands(0), [10, 0, 22, 6]);
    // Clockwise about 100, 0: what was east is south.
    assert_eq!(stands(1), [100, -22, 106, -10]);
    // The front's right end at the place, the house behind it.
    assert_eq!(stands(2), [194, -7, 200, 5], "looks east");
    assert_eq!(stands(3), [300, -6, 312, 0], "looks north");
}

const WALLS: &str = "<Storey><Walls of='outline'>
    <Side on='5'><fill>KNA  </fill></Side>
    <Side on='front'>KUD 0<door>TOD  </door><fill>TKD 2</fill>KUD 0</Side>
    <Side on='street'><fill>MMU 2</fill></Side>
    <Side on='neighbour'><fill>KTU  </fill></Side>
    <Side on='court'><fill>TSH 2</fill></Side>
    <Side on='back'><fill>MRE  </fill></Side>
    <Side on='any'><fill>KSM  </fill></Side>
  </Walls></Storey>";

#[test]
fn sides_are_filled_by_their_kind() {
    let run = house(
        &format!(
            "points='{}' street='1,6' front='1' neighbour='2'><Hole points='2 2, 5 2, 5 5, 2 5'/>",
            points(&L)
        ),
        &WALLS.repeat(2),
    );
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    // From the right end of the front: side 1 is walked backwards, then 6, 5, 4, 3, 2.
    let kinds = ["TKD", "MMU", "KNA", "KSM", "MRE", "KTU"];
    for storey in 0..2 {
        let walls = filled(&run, storey, 0);
        assert_eq!(walls.len(), 6);
        for (wall, kind) in walls.iter().zip(kinds) {
            assert!(wall.contains(kind), "{wall} should hold {kind}");
        }
        assert!(walls[0].starts_with("KUD") && walls[0].ends_with("KUD 0"));
        assert!(
            filled(&run, storey, 1)
                .iter()
                .all(|wall| wall.contains("TSH"))
        );
    }
    let doors: usize = (0..2)
        .flat_map(|storey| filled(&run, storey, 0))
        .map(|wall| wall.matches("TOD").count())
        .sum();
    assert_eq!(doors, 1, "the house has one door");
    let front = &filled(&run, 0, 0)[0];
    assert!(front.starts_with("KUD 0 TOD"), "{front}");
}

#[test]
fn runs_fill_walls_of_any_length_and_stretch_little() {
    let storey = "<Storey><Walls><Side on='street'><fill>MMU 2</fill></Side></Walls></Storey>";
    for centimetres in (60..2400).step_by(37) {
        let width = f64::from(centimetres) / 100.0;
        let run = house(
            &format!("points='0 0, {width} 0, {width} 5, 0 5' front='1'>"),
            storey,
        );
        assert_eq!(codes(&run), [0; 0], "{width}: {}", run.short());
        let wall = &first(&run).storeys[0].rings[0].walls[0];
        let sum: f64 = wall.units.iter().map(|u| u.width).sum();
        let length = wall.from.distance(wall.to);
        assert!((sum - length).abs() < 1e-9, "{width}: {sum} of {length}");
        let windows = filled(&run, 0, 0)[0].clone();
        for (unit, code) in wall
            .units
            .iter()
            .zip(windows.split(' ').filter(|w| w.len() > 1))
        {
            let stretch = unit.width / 2.0 - 1.0;
            assert!(
                code != "MMU" || stretch.abs() <= 0.08 + 1e-9,
                "{width}: {stretch}"
            );
        }
        let count = windows.matches("MMU").count();
        assert!(count >= (length / 2.17) as usize, "{width}: {windows}");
    }
}

#[test]
fn the_door_stands_where_there_is_room() {
    // The front is too narrow for the door, so it stands on the longest other side of its kind.
    let storey = "<Storey><Walls><Side on='any'><door>TAG 2</door><fill>KSK  </fill></Side></Walls></Storey>";
    let run = house("points='0 0, 1.2 0, 1.2 7, 0 7' front='1'>", storey);
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    let walls = filled(&run, 0, 0);
    let with: Vec<bool> = walls.iter().map(|wall| wall.contains("TAG")).collect();
    assert_eq!(with, [false, true, false, false], "{walls:?}");
}

#[test]
fn storeys_with_rows_stand_beside_storeys_on_the_outline() {
    let rows = "<Storey start='2 2'><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row></Storey>";
    let run = house("points='0 0, 9 0, 9 6, 0 6'>", &format!("<Storey/>{rows}"));
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    let storeys = &first(&run).storeys;
    assert_eq!(
        storeys
            .iter()
            .map(|s| s.rings[0].walls.len())
            .collect::<Vec<_>>(),
        [4, 4]
    );
    assert_eq!(storeys[1].rings[0].walls[0].from, dvec2(2.0, 2.0));
    let parapet = "<Storey/><Storey height='2' kind='parapet'/>";
    let run = house("points='0 0, 9 0, 9 6, 0 6'>", parapet);
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    assert_eq!(first(&run).storeys.len(), 2);
}

#[test]
fn edits_reach_the_walls_of_an_outline() {
    let storey = "<Storey><Walls><Side><fill>KSK  MRE  </fill></Side></Walls><replace code='MRE' with='MMM'/></Storey>";
    let run = house("points='0 0, 9 0, 9 6, 0 6'>", storey);
    assert_eq!(codes(&run), [0; 0], "{}", run.short());
    let walls = filled(&run, 0, 0).join(" ");
    assert!(walls.contains("MMM") && !walls.contains("MRE"), "{walls}");
}

#[test]
fn outlines_of_too_many_corners_are_refused() {
    let circle = (0..10_001).map(|n| DVec2::from_angle(f64::from(n) * 6e-4) * 900.0);
    let circle: Vec<DVec2> = circle.collect();
    let run = house(&format!("points='{}'>", points(&circle)), "<Storey/>");
    assert!(codes(&run).contains(&281), "{}", run.short());
}

#[test]
fn any_points_make_a_house_or_a_message() {
    for seed in 0..600 {
        let mut numbers = Numbers(seed);
        let count = 1 + numbers.below(14);
        let size = [3, 12, 60][numbers.below(3)];
        let grid = [1.0, 0.5, 0.01][numbers.below(3)];
        let mut point = || {
            let mut along = || numbers.below((f64::from(size) / grid) as usize) as f64 * grid;
            dvec2(along(), along())
        };
        let ring: Vec<DVec2> = (0..count).map(|_| point()).collect();
        let run = house(&format!("points='{}'>", points(&ring)), WALLS);
        let said = codes(&run);
        for wall in run
            .building
            .houses
            .iter()
            .flat_map(|b| &b.house.storeys)
            .flat_map(|s| &s.rings)
            .flat_map(|r| &r.walls)
        {
            let sum: f64 = wall.units.iter().map(|u| u.width).sum();
            assert!((sum - wall.from.distance(wall.to)).abs() < 1e-6, "{seed}");
        }
        let closed = run.building.houses.iter().any(|b| {
            b.house
                .storeys
                .iter()
                .any(|s| s.rings.iter().any(|r| r.closed))
        });
        assert!(
            closed || run.has_errors(),
            "{seed}: {said:?}\n{}",
            points(&ring)
        );
    }
}
