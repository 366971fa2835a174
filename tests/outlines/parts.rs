//! Storeys on a part of an outline, walls by the length of their sides, the wall that takes the rest (002-25), and the types
//! of the library over outlines.

use crate::outlines::{L, codes, corners, filled, first, house, points, turned};
use crate::support::compile;
use glam::DVec2;
use hsd::templates::Template;

/// The area of the first ring of a storey, square metres.
fn area(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let twice: f64 = corners.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum();
    twice.abs() / 2.0
}

/// The area of an upper storey with these attributes of `Walls`, over an outline.
fn upper(outline: &[DVec2], walls: &str) -> (f64, usize, Vec<u16>) {
    let storeys = format!("<Storey/><Storey><Walls {walls}/></Storey>");
    let run = house(&format!("points='{}'>", points(outline)), &storeys);
    let house = first(&run);
    let rings = &house.storeys[1].rings;
    assert!(rings.iter().all(|r| r.closed), "{}", run.short());
    let found = area(&corners(house, &rings[0]));
    (found, rings[0].walls.len(), codes(&run))
}

#[test]
fn an_upper_storey_has_its_shares_of_a_rectangle() {
    for degrees in [0.0, 31.0, 90.0, 200.0] {
        let plan = [(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0)].map(DVec2::from);
        let plan = turned(&plan, degrees, DVec2::new(300.0, -20.0));
        for (walls, wanted) in [
            ("long='0.5'", 48.0),
            ("long='0.5' short='0.75' at='0 0'", 36.0),
            ("short='0.5' at='1 1'", 48.0),
            ("long='0.7' short='0.6' at='0.3 0.5'", 0.42 * 96.0),
        ] {
            let (found, walls_found, messages) = upper(&plan, walls);
            assert!((found - wanted).abs() < 0.1, "{degrees} {walls}: {found}");
            assert_eq!(walls_found, 4, "{degrees} {walls}");
            assert!(!messages.contains(&1144), "{degrees} {walls}");
        }
    }
}

#[test]
fn an_upper_storey_takes_the_largest_piece_of_any_outline() {
    // The L is 12 by 6 m in front, and 7 by 5 m behind that.
    for (walls, wanted, sides) in [
        ("short='0.5' at='0 0'", 12.0 * 5.5, 4),
        ("short='0.5' at='0 1'", 7.0 * 5.0 + 12.0 * 0.5, 6),
        ("long='0.25' at='1 0'", 3.0 * 11.0, 4),
    ] {
        let (found, count, _) = upper(&L, walls);
        assert!((found - wanted).abs() < 0.3, "{walls}: {found}");
        assert!(count == sides || count == 4, "{walls}: {count}");
    }
    // The rear half of a U has two pieces, its middle none.
    let u = "0 0, 20 0, 20 12, 16 12, 16 3, 3 3, 3 12, 0 12";
    let of = |walls: &str| {
        let storeys = format!("<Storey/><Storey><Walls {walls}/></Storey>");
        house(&format!("points='{u}'>"), &storeys)
    };
    let run = of("short='0.5' at='0.5 1'");
    let found = corners(first(&run), &first(&run).storeys[1].rings[0]);
    assert!((area(&found) - 4.0 * 6.0).abs() < 0.1, "{found:?}");
    let run = of("long='0.2' short='0.2' at='0.5 1'");
    assert!(codes(&run).contains(&1144), "{}", run.short());
    let found = corners(first(&run), &first(&run).storeys[1].rings[0]);
    assert!(
        (area(&found) - area(&corners(first(&run), &first(&run).storeys[0].rings[0]))).abs() < 0.1
    );
}

#[test]
fn courtyards_are_cut_with_the_storey() {
    let court = "<Hole points='4 3, 8 3, 8 6, 4 6'/>";
    let outline = format!("points='0 0, 12 0, 12 9, 0 9'>{court}");
    let of = |walls: &str| {
        house(
            &outline,
            &format!("<Storey/><Storey><Walls {walls}/></Storey>"),
        )
    };
    // Three quarters of the length hold the court whole; half of the depth cuts it open.
    let run = of("long='0.75' at='0.5 0'");
    let rings = &first(&run).storeys[1].rings;
    assert_eq!(rings.len(), 2, "{}", run.short());
    let run = of("short='0.5' at='0 0'");
    let rings = &first(&run).storeys[1].rings;
    assert_eq!(rings.len(), 1, "{}", run.short());
    let found = area(&corners(first(&run), &rings[0]));
    assert!((found - (12.0 * 4.5 - 4.0 * 1.5)).abs() < 0.1, "{found}");
}

#[test]
fn long_and_short_sides_have_walls_of_their_own_and_the_rest_too() {
    let walls = "<Storey><Walls rest='NTI'><Side on='long'><fill>NRC  </fill></Side>\
                 <Side on='short'>MRE  MRE  MRE  MRE  MRE  MRE  MRE  MRE  MRE  MRE  MRE  </Side></Walls></Storey>";
    let run = house("points='0 0, 12 0, 12 8, 0 8'>", walls);
    let found = filled(&run, 0, 0);
    for (wall, code) in found.iter().zip(["NRC", "NTI", "NRC", "NTI"]) {
        assert!(wall.split(' ').all(|c| c == code), "{found:?}");
    }
}

#[test]
fn the_door_is_on_the_front_whichever_wall_it_is_written_in() {
    let side =
        |on: &str| format!("<Side on='{on}'>KSK  <door>TOD  </door><fill>KSK  </fill></Side>");
    let walls = format!(
        "<Storey><Walls>{}{}</Walls></Storey>",
        side("long"),
        side("short")
    );
    let run = house("points='0 0, 8 0, 8 12, 0 12' front='1'>", &walls);
    let found = filled(&run, 0, 0);
    assert!(found[0].contains("TOD"), "{found:?}");
    assert_eq!(found.iter().filter(|w| w.contains("TOD")).count(), 1);
}

/// Every type over outlines, on plans as maps have them: the walls follow the outline, one door is on the front, no wall stands
/// on a neighbour's side but a party wall, and nothing worse than a note is said.
#[test]
fn types_over_outlines_follow_any_outline() {
    let plans = [
        "0 0, 24 0, 24 9, 0 9",
        "0 0, 24 0, 24 9, 11 9, 11 17, 0 17",
        "0 0, 30 0, 30 20, 22 20, 22 8, 9 8, 9 20, 0 20",
        "0 0, 9 0, 9 5, 26 5, 26 14, 9 14, 9 21, 0 21",
        "0 0, 14 -2.6, 15 7, 3 10",
    ];
    for word in ["block", "hospital", "school", "shop-row", "temple", "house"] {
        let text = Template::named(word).expect("is a type").text();
        for plan in plans {
            let from = text.find("<Outline").expect("has an outline");
            let to = from + text[from..].find("/>").expect("ends");
            let outline = format!("<Outline points='{plan}' street='1' front='1' neighbour='2'");
            let written = format!("{}{outline}{}", &text[..from], &text[to..]);
            let run = compile("type.hsd", written.as_bytes());
            let worse = run
                .diagnostics
                .iter()
                .any(|d| d.severity != hsd::Severity::Note);
            assert!(!worse, "{word} over {plan}: {}", run.short());
            let walls = filled(&run, 0, 0);
            assert_eq!(walls.len(), plan.split(',').count(), "{word} over {plan}");
            let is_party = |wall: &&String| wall.contains("APW");
            let party: Vec<&String> = walls.iter().filter(is_party).collect();
            assert_eq!(party.len(), 1, "{word} over {plan}: {walls:?}");
            let plain = party[0]
                .split(' ')
                .all(|c| ["APW", "NRC", "NTI", "KSKO", "KSK"].contains(&c));
            assert!(plain, "{word} over {plan}: {party:?}");
            let doors = ["NAD", "TGL", "TSK", "TMA"];
            let has_door = |wall: &String| doors.iter().any(|d| wall.contains(d));
            assert!(has_door(&walls[0]), "{word} over {plan}: {walls:?}");
        }
    }
}

#[test]
fn a_storey_of_walls_inside_does_not_stand_on_the_outline() {
    let inside = "<Storey/><Storey><Loop inner='yes'><Row>KSK  KSK  </Row></Loop></Storey>";
    let run = house("points='0 0, 12 0, 12 8, 0 8'>", inside);
    let rings = &first(&run).storeys[1].rings;
    assert_eq!(rings.len(), 1, "{}", run.short());
    assert!(rings[0].inner);
    assert_eq!(filled(&run, 1, 0), ["KSK KSK"]);
}
