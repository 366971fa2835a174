//! Houses written elsewhere, groups, and repetitions with the number of the round: where each house comes to stand, and that
//! nothing else about it changes.

use crate::support::{Run, compile};
use hsd::building::House;
use serde_json::Value;

fn run(inner: &str) -> Run {
    let run = compile("town.hsd", format!("<Houses>{inner}</Houses>").as_bytes());
    assert!(!run.has_errors(), "{:#?}", run.diagnostics);
    run
}

/// East, north, up and azimuth of each house, in hundredths.
fn places(inner: &str) -> Vec<[i64; 4]> {
    let hundredths = |x: f64| (x * 100.0).round() as i64;
    let place = |house: &House| {
        let [x, y, z] = house.origin;
        [x, y, z, house.azimuth].map(hundredths)
    };
    let run = run(inner);
    run.building
        .houses
        .iter()
        .map(|b| place(&b.house))
        .collect()
}

/// What is built counts, not where it is written.
fn without_spans(value: &mut Value) {
    match value {
        Value::Object(map) => {
            map.retain(|key, _| key != "span");
            map.values_mut().for_each(without_spans);
        }
        Value::Array(list) => list.iter_mut().for_each(without_spans),
        _ => {}
    }
}

/// The walls, roofs and fittings of each house, without its place and name.
fn built(inner: &str) -> Vec<Value> {
    let run = run(inner);
    let houses = run.building.houses.iter().map(|b| {
        let mut value = serde_json::to_value(b).expect("is plain data");
        let house = value["house"].as_object_mut().expect("is one");
        for key in ["origin", "azimuth", "name", "placed"] {
            house.remove(key);
        }
        without_spans(&mut value);
        value
    });
    houses.collect()
}

const HOUSE: &str = "<House x='4' y='3' z='1'><Storey><Row>KSK  KSK</Row><Row>KSK</Row><Row>KSK  KSK</Row><Row>KSK</Row></Storey></House>";

#[test]
fn groups_move_and_turn_clockwise() {
    assert_eq!(places(HOUSE), [[400, 300, 100, 18000]]);
    let moved = format!("<Group x='10' y='20' z='2'>{HOUSE}</Group>");
    assert_eq!(places(&moved), [[1400, 2300, 300, 18000]]);
    // A quarter clockwise: north becomes east, east becomes south.
    let turned = format!("<Group x='10' turn='90'>{HOUSE}</Group>");
    assert_eq!(places(&turned), [[1300, -400, 100, 27000]]);
    let twice = format!("<Group turn='90'><Group x='1' turn='-30'>{HOUSE}</Group></Group>");
    let [x, y, _, azimuth] = places(&twice)[0];
    let (sine, cosine) = 60_f64.to_radians().sin_cos();
    let (east, north) = (4.0 * cosine + 3.0 * sine, 3.0 * cosine - 4.0 * sine - 1.0);
    assert_eq!([x, y], [east, north].map(|v| (v * 100.0).round() as i64));
    assert_eq!(azimuth, 24000);
}

#[test]
fn placed_houses_are_those_of_their_types() {
    let kura = "<Place type='kura' width='6' x='9' y='-2' azimuth='90'/>";
    assert_eq!(places(kura), [[900, -200, 0, 9000]]);
    let text = hsd::templates::Template::named("kura")
        .expect("is one")
        .text();
    let alone = compile(
        "kura.hsd",
        text.replace(
            "name=\"width\" default=\"5\"",
            "name=\"width\" default=\"6\"",
        )
        .as_bytes(),
    );
    assert!(!alone.has_errors());
    let walls = |house: &House| {
        let rings = house.storeys.iter().flat_map(|s| &s.rings);
        rings
            .flat_map(|r| &r.walls)
            .map(|w| (w.from, w.to))
            .collect::<Vec<_>>()
    };
    let placed = run(kura);
    assert_eq!(
        walls(&placed.building.houses[0].house),
        walls(&alone.building.houses[0].house)
    );
    assert_eq!(
        placed.building.houses[0].roofs.roofs.len(),
        alone.building.houses[0].roofs.roofs.len()
    );
}

#[test]
fn the_centre_of_a_house_comes_to_its_place() {
    for azimuth in ["180", "90", "33"] {
        let run = run(&format!(
            "<Place type='kura' at='centre' x='100' y='50' azimuth='{azimuth}'/>"
        ));
        let (_, positions) = (
            0,
            run.scene.meshes.iter().flat_map(|m| &m.primitives).count(),
        );
        assert!(positions > 0);
        let house = &run.building.houses[0].house;
        let walls = house.storeys[0].rings.iter().flat_map(|r| &r.walls);
        let corners: Vec<_> = walls.map(|w| w.from).collect();
        let (low, high) = corners
            .iter()
            .fold((corners[0], corners[0]), |(l, h), p| (l.min(*p), h.max(*p)));
        let middle = (low + high) / 2.0 * house.unit;
        let turn = (180.0 - azimuth.parse::<f64>().expect("is one")).to_radians();
        let (sine, cosine) = turn.sin_cos();
        let east = house.origin[0] + -middle.x * cosine - middle.y * sine;
        let north = house.origin[1] + -middle.x * sine + middle.y * cosine;
        assert!(
            (east - 100.0).abs() < 1e-9 && (north - 50.0).abs() < 1e-9,
            "{azimuth}: {east} {north}"
        );
    }
}

#[test]
fn a_seed_makes_the_same_house_wherever_it_stands() {
    let here = "<Place type='so-nikai' name='a' seed='7'/>";
    let there = "<Group turn='40' x='300'><Place type='kura'/><Place type='so-nikai' name='a' seed='7' x='30'/></Group>";
    let (here, there) = (built(here), built(there));
    assert_eq!(here[0], there[1]);
    let other = built("<Place type='so-nikai' name='a' seed='8'/>");
    assert_ne!(here, other, "another seed");
    let plain = built("<Place type='so-nikai' name='a'/>");
    assert_ne!(here, plain, "nothing is drawn without a seed");
}

#[test]
fn rounds_have_numbers_and_houses_names() {
    let street = "<repeat num='3' index='i'><Place type='kura' x='{i * 10}'/></repeat>\
                  <repeat num='2' index='i'><repeat num='2' index='j'><Place type='kura' name='store' x='{i * 10}' y='{20 + 20 * j}'/></repeat></repeat>";
    let run = run(street);
    assert_eq!(run.diagnostics, vec![]);
    let houses = run
        .building
        .houses
        .iter()
        .map(|b| (&*b.house.name, b.house.origin[0], b.house.origin[1]));
    let expected = [
        ("kura", 0.0, 0.0),
        ("kura 2", 10.0, 0.0),
        ("kura 3", 20.0, 0.0),
        ("store", 0.0, 20.0),
        ("store 2", 0.0, 40.0),
        ("store 3", 10.0, 20.0),
        ("store 4", 10.0, 40.0),
    ];
    assert_eq!(houses.collect::<Vec<_>>(), expected);
    // In a row, too.
    let row = "<House><Storey><Row><repeat num='3' index='i'><Part code='KSK' width='{1 + i}'/></repeat></Row><Row>KSK</Row><Row><Part code='KSK' width='6'/></Row><Row>KSK</Row></Storey></House>";
    let run = crate::support::compile("row.hsd", row.as_bytes());
    assert_eq!(run.diagnostics, vec![]);
    let wall = &run.building.houses[0].house.storeys[0].rings[0].walls[0];
    assert_eq!(
        wall.units.iter().map(|u| u.width).collect::<Vec<_>>(),
        [1.0, 2.0, 3.0]
    );
}

#[test]
fn definitions_and_choices_of_houses_are_placed() {
    let text = format!(
        "<define name='pair' gap='2'>{HOUSE}<House y='{{gap}}'><Storey><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row></Storey></House></define>\
         <Place type='pair' gap='12' x='100'/>\
         <random><choice><Place type='kura' x='200'/></choice><choice><Place type='kura' x='200'/></choice></random>"
    );
    let places = places(&text);
    assert_eq!(
        places,
        [
            [10400, 300, 100, 18000],
            [10000, 1200, 0, 18000],
            [20000, 0, 0, 18000]
        ]
    );
}

#[test]
fn houses_in_each_other_are_told_and_party_walls_are_not() {
    let codes =
        |inner: &str| -> Vec<u16> { run(inner).diagnostics.iter().map(|d| d.code.0).collect() };
    let place = |x: f64, more: &str| {
        format!("<Place type='kura' width='5' depth='4' storeys='1' x='{x}' {more}/>")
    };
    let wide = 5.0 * 3.0 / 3.3;
    assert_eq!(
        codes(&[place(0.0, ""), place(wide, "")].concat()),
        [0; 0],
        "a party wall"
    );
    assert_eq!(
        codes(&[place(0.0, ""), place(wide - 0.1, "")].concat()),
        [420]
    );
    assert_eq!(
        codes(&[place(0.0, ""), place(0.5, "z='20'")].concat()),
        [0; 0],
        "above each other"
    );
    let turned = [
        place(0.0, ""),
        format!("<Group turn='45'>{}</Group>", place(2.0, "")),
    ]
    .concat();
    assert_eq!(codes(&turned), [420]);
    // In a court, and in the wing beside it.
    let court = "<House><Storey height='9'><Row><repeat num='20'>KSK</repeat></Row><Row><repeat num='20'>KSK</repeat></Row><Row><repeat num='20'>KSK</repeat></Row><Row><repeat num='20'>KSK</repeat></Row>\
                 <Loop hole='yes' start='2 18'><Row><repeat num='16'>KSK</repeat></Row><Row><repeat num='16'>KSK</repeat></Row><Row><repeat num='16'>KSK</repeat></Row><Row><repeat num='16'>KSK</repeat></Row></Loop></Storey></House>";
    let inside = |x: f64| format!("{court}<Place type='kura' at='centre' x='{x}' y='9'/>");
    assert_eq!(codes(&inside(-9.0)), [0; 0], "in the court");
    assert_eq!(codes(&inside(-2.0)), [420], "in the wing");
}

/// A type of the library is no file that its user could mend: what is said of it is said where it is placed.
#[test]
fn what_is_wrong_with_a_type_is_told_where_it_is_placed() {
    let text = "<Houses>\n  <Place type='chu-nikai' depth='60'/>\n</Houses>";
    let run = compile("deep.hsd", text.as_bytes());
    assert!(!run.diagnostics.is_empty(), "its roof is very wide");
    for d in &run.diagnostics {
        let span = d.span().expect("has a place");
        assert_eq!(span.file, run.source.id(), "{d:?}");
        assert!(run.source.text()[run.source.text_range(span)].starts_with("<Place"));
        assert!(d.fixes.is_empty() && d.labels.is_empty());
    }
}

#[test]
fn lengths_have_units() {
    let house = |height: &str, width: &str, x: &str| {
        format!(
            "<House x='{x}' unit='3.25'><Storey height='{height}'><Row><Part code='KSK' width='{width}'/></Row><Row>KSK</Row><Row><Part code='KSK' width='{width}'/></Row><Row>KSK</Row></Storey></House>"
        )
    };
    let plain = built(&house("8.91", "4", "10"));
    assert_eq!(built(&house("2.7 m", "2 ken", "10")), plain);
    assert_eq!(built(&house("270cm", "13尺", "33 shaku")), plain);
    assert_eq!(places(&house("2.7m", "2間", "33 shaku"))[0][0], 1000);
}

/// The default takes the place of a faulty value, so that nothing follows from it.
#[test]
fn a_faulty_parameter_is_reported_once() {
    for (value, code) in [("{1 / 0}", 254), ("60", 259), ("{nothing}", 252)] {
        let text = format!("<Houses><Place type='kura' width='{value}'/></Houses>");
        let codes: Vec<u16> = compile("kura.hsd", text.as_bytes())
            .diagnostics
            .iter()
            .map(|d| d.code.0)
            .collect();
        assert_eq!(codes, [code], "{value}");
    }
}
