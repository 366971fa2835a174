//! Rooms: areas between walls, mats, and ways in. What a room must be is worked out by dividing rectangles, not by following
//! walls.

use crate::support::{Numbers, Run, assert_none, compile, on_all_processors};
use hsd::Options;
use hsd::ast::Flooring;
use hsd::building::Room;
use hsd::diagnostic::Diagnostics;
use hsd::scene::{Kind, Shown};
use hsd::source::{FileId, NoFiles, Source};
use std::fmt::Write;

/// A part of a plan: a, b of its least corner, then of its greatest, U.
pub(crate) type Cell = [usize; 4];

/// Divides a cell by walls across it, each with a door; returns the walls and what is left of the cell.
fn divide(cell: Cell, random: &mut Numbers, walls: &mut String, cells: &mut Vec<Cell>) {
    let [a0, b0, a1, b1] = cell;
    let (width, depth) = (a1 - a0, b1 - b0);
    if width.max(depth) < 5 || random.below(4) == 0 {
        cells.push(cell);
        return;
    }
    // Walls are at least two units from the ones beside them, so that a door fits.
    let (one, other) = if width >= depth {
        let at = a0 + 2 + random.below(width - 3);
        let plain = "KTU  ".repeat(depth - 2);
        let _ = write!(
            walls,
            r#"<Loop inner="yes" start="{at} {b0}"><Row turn="R"/><Row>{plain}TSH 2</Row></Loop>"#
        );
        ([a0, b0, at, b1], [at, b0, a1, b1])
    } else {
        let at = b0 + 2 + random.below(depth - 3);
        let plain = "KTU  ".repeat(width - 2);
        let _ = write!(
            walls,
            r#"<Loop inner="yes" start="{a0} {at}"><Row>TSH 2{plain}</Row></Loop>"#
        );
        ([a0, b0, a1, at], [a0, at, a1, b1])
    };
    divide(one, random, walls, cells);
    divide(other, random, walls, cells);
}

/// A house of random size whose cells all are rooms.
pub(crate) fn divided(seed: usize) -> (String, Vec<Cell>, [usize; 2]) {
    let mut random = Numbers(seed as u64 + 1);
    let (width, depth) = (3 + random.below(14), 3 + random.below(14));
    let (mut walls, mut cells) = (String::new(), vec![]);
    divide([0, 0, width, depth], &mut random, &mut walls, &mut cells);
    let side = |n: usize| format!("<Row>TSH 2{}</Row>", "KSK  ".repeat(n - 2));
    let rows: String = [width, depth, width, depth].map(side).concat();
    let mut rooms = String::new();
    for (number, [a0, b0, a1, b1]) in cells.iter().enumerate() {
        let (a, b) = ((a0 + a1) as f64 / 2.0, (b0 + b1) as f64 / 2.0);
        let _ = write!(
            rooms,
            r#"<Room name="r{number}" at="{a} {b}" floor="tatami"/>"#
        );
    }
    let text = format!("<House><Storey>{rows}{walls}{rooms}</Storey></House>");
    (text, cells, [width, depth])
}

fn rooms(run: &Run) -> &[Room] {
    &run.building.houses[0].rooms
}

/// Returns the codes of what is said about rooms.
fn told(run: &Run) -> Vec<u16> {
    let codes = run.diagnostics.iter().map(|d| d.code.0);
    codes.filter(|code| (440..450).contains(code)).collect()
}

#[test]
fn rooms_of_a_divided_house_are_its_cells() {
    assert_none(&on_all_processors(300, |seed| {
        let (text, cells, [width, depth]) = divided(seed);
        let run = compile("divided.hsd", text.as_bytes());
        let mut found = vec![];
        if !told(&run).is_empty() {
            found.push(format!("seed {seed}: {}\n{text}", run.short()));
        }
        let whole: f64 = rooms(&run).iter().map(Room::area).sum();
        if whole != (width * depth) as f64 || rooms(&run).len() != cells.len() {
            found.push(format!("seed {seed}: {whole} of {}", width * depth));
        }
        for (room, [a0, b0, a1, b1]) in rooms(&run).iter().zip(&cells) {
            let area = ((a1 - a0) * (b1 - b0)) as f64;
            if room.area() != area || room.mat_count() != area / 2.0 {
                let (own, mats) = (room.area(), room.mat_count());
                found.push(format!(
                    "seed {seed}, {}: {own} and {mats} mats, not {area}",
                    room.name
                ));
            }
        }
        found
    }));
}

#[test]
fn rooms_have_floors_and_mats_in_the_model_and_none_far_off() {
    let (text, cells, _) = divided(7);
    let run = compile("divided.hsd", text.as_bytes());
    let nodes = |kind| run.scene.nodes.iter().filter(move |n| n.kind == kind);
    let mats: usize = rooms(&run).iter().map(|r| r.mats.len()).sum();
    assert!(cells.len() > 1 && mats > cells.len());
    assert_eq!(nodes(Kind::Room).count(), cells.len() + mats);
    // Equal mats share a mesh.
    let own = nodes(Kind::Room).filter(|n| n.name.starts_with("mat "));
    let meshes: std::collections::BTreeSet<u32> = own.filter_map(|n| n.mesh).map(|m| m.0).collect();
    assert!(meshes.len() <= 2 * 16, "{} meshes of mats", meshes.len());
}

/// A house of 6 by 6 with walls and rooms in it.
fn house(inside: &str) -> Run {
    let side = |first: &str| format!("<Row>{first}{}</Row>", "KSK  ".repeat(4));
    let rows: String = ["TSH 2", "KSK 2", "KSK 2", "KSK 2"]
        .map(side)
        .concat()
        .replace("KSK 2", "KSK  KSK  ");
    compile(
        "house.hsd",
        format!("<House><Storey>{rows}{inside}</Storey></House>").as_bytes(),
    )
}

#[test]
fn walls_may_end_anywhere_and_stand_free() {
    // One wall that ends in the room, and a closed box in its middle.
    let run = house(
        r#"<Loop inner="yes" start="0 1"><Row>KTU  KTU  </Row></Loop>
           <Loop inner="yes" start="3 3"><Row>TSH 2</Row><Row>KTU  KTU  </Row><Row>KTU  KTU  </Row><Row>KTU  KTU  </Row></Loop>
           <Room name="a" at="5.5 5.5"/><Room name="b" at="4 4" floor="earth"/>"#,
    );
    assert!(told(&run).is_empty());
    let areas: Vec<(&str, f64, usize)> = rooms(&run)
        .iter()
        .map(|r| (r.name.as_str(), r.area(), r.area.len()))
        .collect();
    assert_eq!(areas, [("a", 32.0, 2), ("b", 4.0, 1)]);
}

#[test]
fn what_no_room_names_has_boards() {
    let run = house(
        r#"<Loop inner="yes" start="0 3"><Row>TSH 2TSH 2TSH 2</Row></Loop><Room name="a" at="1 1" floor="earth"/>"#,
    );
    assert!(told(&run).is_empty());
    let floors: Vec<(&str, Flooring, f64)> = rooms(&run)
        .iter()
        .map(|r| (r.name.as_str(), r.floor, r.area()))
        .collect();
    assert_eq!(
        floors,
        [("a", Flooring::Earth, 18.0), ("", Flooring::Boards, 18.0)]
    );
}

#[test]
fn ways_lead_through_rooms_open_bays_and_courtyards() {
    let wall = |at: f64, way: &str| {
        format!(r#"<Loop inner="yes" start="0 {at}"><Row>KTU  KTU  {way}KTU  KTU  </Row></Loop>"#)
    };
    let rooms = r#"<Room name="a" at="1 1"/><Room name="b" at="1 3"/><Room name="c" at="1 5"/>"#;
    let of = |ways: [&str; 2]| {
        let walls = wall(2.0, ways[0]) + &wall(4.0, ways[1]);
        told(&house(&(walls + rooms)))
    };
    assert!(of(["TSH 2", "AKI 2"]).is_empty());
    assert!(of(["          ", "TIT 2"]).is_empty());
    assert_eq!(of(["TSH 2", "GSI  GSI  "]), [443], "a lattice is no way in");
    assert_eq!(of(["KTU  KTU  ", "TSH 2"]), [443, 443]);
    let court = r#"<Loop hole="yes" start="2 4"><Row>KSK  KSK  </Row><Row>TSH 2</Row><Row>KSK  KSK  </Row><Row>KSK  KSK  </Row></Loop><Room name="a" at="1 1"/>"#;
    assert!(told(&house(court)).is_empty());
    let outside = r#"<Loop hole="yes" start="2 4"><Row>KSK  KSK  </Row><Row>TSH 2</Row><Row>KSK  KSK  </Row><Row>KSK  KSK  </Row></Loop><Room name="a" at="3 3"/>"#;
    assert_eq!(told(&house(outside)), [440], "a courtyard is outside");
}

#[test]
fn rooms_of_slanting_houses_lie_within_their_walls() {
    let text = r#"<House><Outline points="0 0, 7 1, 6 8, -1 6"/><Storey><Room name="a" at="3 3" floor="tatami"/></Storey></House>"#;
    let run = compile("slanting.hsd", text.as_bytes());
    let [room] = rooms(&run) else {
        panic!("{}", run.short())
    };
    let metres = run.building.houses[0].house.unit;
    // By the shoelace formula, by hand.
    let area = (0.0 * 1.0 - 7.0 * 0.0 + 7.0 * 8.0 - 6.0 * 1.0 + 6.0 * 6.0 + 1.0 * 8.0) / 2.0;
    assert!(
        (room.area() * metres * metres - area).abs() < 1e-4,
        "{}",
        room.area()
    );
    assert!(room.mat_count() > 10.0);
}

/// The kinds and storeys of the nodes of a model that shows so much of a house of two storeys.
fn nodes(shown: Shown) -> Vec<(Kind, Option<u32>)> {
    let storey = |room: &str| {
        let side = "<Row>KSK  KSK  KSK  KSK  </Row>";
        format!("<Storey><Row>TSH 2KSK  KSK  </Row>{side}{side}{side}{room}</Storey>")
    };
    let room = r#"<Room name="a" at="2 2" height="8"/>"#;
    let text = format!(
        "<House>{}{}<Finial kind=\"hoju\"/></House>",
        storey(room),
        storey(room)
    );
    let source = Source::new(FileId(0), "two.hsd", text.as_bytes());
    let options = Options {
        shown,
        ..Options::default()
    };
    let mut out = Diagnostics::new();
    let made = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    let nodes = made.scene.nodes.iter();
    nodes.map(|n| (n.kind, n.storey)).collect()
}

#[test]
fn a_model_may_be_cut_open_at_any_storey() {
    let count = |nodes: &[(Kind, Option<u32>)], kind, storey| {
        let own = nodes
            .iter()
            .filter(|n| n.0 == kind && (storey == 0 || n.1 == Some(storey)));
        own.count()
    };
    let whole = nodes(Shown::Whole);
    assert!(count(&whole, Kind::Roof, 0) > 0 && count(&whole, Kind::Finial, 0) > 0);
    let roofless = nodes(Shown::Roofless);
    assert_eq!(count(&roofless, Kind::Roof, 0), 0);
    assert_eq!(count(&roofless, Kind::Finial, 0), 0);
    assert_eq!(count(&roofless, Kind::Room, 2), 1);
    let lower = nodes(Shown::Storeys(1));
    assert_eq!(count(&lower, Kind::Room, 1), 1);
    for kind in [Kind::Room, Kind::Storey, Kind::Part] {
        assert_eq!(count(&lower, kind, 2), 0);
    }
    assert_eq!(nodes(Shown::Storeys(2)), roofless);
}

#[test]
fn walls_like_a_grid_are_refused_before_they_have_many_areas() {
    let mut walls = String::new();
    for i in 1..200 {
        let at = f64::from(i) / 34.0;
        let _ = write!(
            walls,
            r#"<Loop inner="yes" start="0 {at}"><Row><repeat num="6"><Part code="KTU"/></repeat></Row></Loop>
               <Loop inner="yes" start="{at} 0"><Row turn="R"/><Row><repeat num="6"><Part code="KTU"/></repeat></Row></Loop>"#
        );
    }
    let run = house(&format!(r#"{walls}<Room at="5.99 5.99"/>"#));
    assert_eq!(told(&run), [445]);
}
