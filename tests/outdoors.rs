//! What `Put` sets on the ground: it stands where it is put, turned and as large as it says, and on the ground; what is made
//! for outdoors is sound.

use crate::support::depths::{bounds, triangles};
use crate::support::shapes;
use crate::support::{Run, assert_none, compile, flaws};
use glam::DVec3;
use hsd::geometry::SHAKU;
use hsd::scene::{Kind, Node};

const U: f64 = 3.0 * SHAKU;

fn house(more: &str) -> Run {
    let wall = "<Row>KSK  KSK  KSK  KSK</Row>";
    let text =
        format!("<House><Storey height=\"9\">{wall}{wall}{wall}{wall}</Storey>{more}</House>");
    let run = compile("house.hsd", text.as_bytes());
    assert_none(&flaws(&run));
    run
}

/// The bounds of what stands beside the house with this code, in its frame: x to the right, y back, z up; metres.
fn stands(run: &Run, code: &str) -> (DVec3, DVec3) {
    let is_it = |n: &&Node| n.code.is_some_and(|c| c.as_str() == code);
    let node = run.scene.nodes.iter().find(is_it).expect("is there");
    let mesh = &run.scene.meshes[node.mesh.expect("has a mesh").0 as usize];
    let place = |p: DVec3| node.turn.rotate(p.truncate()).extend(p.z) + node.at;
    let all: Vec<_> = triangles(mesh).into_iter().map(|t| t.map(place)).collect();
    bounds(&all)
}

#[test]
fn every_part_for_outdoors_is_sound_and_light() {
    let parts = hsd::parse::builtin().parts().iter();
    let mut found = vec![];
    for part in parts.filter(|p| p.class() == 'O') {
        let code = part.code();
        for size in ["", " width=\"1.4\"", " width=\"6\" height=\"21\""] {
            let run = house(&format!("<Put code=\"{code}\" at=\"3 -9\"{size}/>"));
            let node = run
                .scene
                .nodes
                .iter()
                .find(|n| n.code.as_deref() == Some(code));
            let mesh = &run.scene.meshes[node.expect("is there").mesh.expect("a mesh").0 as usize];
            let flaws = shapes::flaws(mesh).into_iter();
            // Round bodies are shaded smooth.
            let flaws = flaws.filter(|flaw| !flaw.starts_with("normal against"));
            found.extend(flaws.map(|flaw| format!("{code}{size}: {flaw}")));
            let triangles = triangles(mesh).len();
            if triangles > 2000 {
                found.push(format!("{code}: {triangles} triangles"));
            }
        }
    }
    assert_none(&found);
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 0.01, "{found} instead of {wanted}");
}

#[test]
fn a_lantern_stands_on_the_ground_where_it_is_put() {
    let run = house("<Put code=\"OTO\" at=\"3 -4\"/>");
    let (lo, hi) = stands(&run, "OTO  ");
    let middle = (lo + hi) / 2.0;
    near(middle.x, -3.0 * U);
    near(middle.y, -4.0 * U);
    near(lo.z, -0.285);
    near(hi.z - lo.z, 6.0 * SHAKU);
}

#[test]
fn a_platform_raises_the_house_and_not_what_stands_beside_it() {
    let run = house("<Platform height=\"3\"/><Put code=\"OTO\" at=\"3 -8\"/>");
    let (lo, _) = stands(&run, "OTO  ");
    near(lo.z, -3.0 * SHAKU);
}

#[test]
fn a_hedge_is_as_long_as_it_says_and_turns_clockwise() {
    let along = house("<Put code=\"KIK\" at=\"2 -3\" width=\"10\" height=\"4\"/>");
    let (lo, hi) = stands(&along, "KIK  ");
    near(hi.x - lo.x, 10.0 * U);
    near(hi.z - lo.z, 4.0 * SHAKU - 0.02);
    let across = house("<Put code=\"KIK\" at=\"8 2\" turn=\"90\" width=\"10\"/>");
    let (lo, hi) = stands(&across, "KIK  ");
    near(hi.y - lo.y, 10.0 * U);
    near((lo.x + hi.x) / 2.0, -8.0 * U);
    // The bench of a basin, its front stone before it: turned by a quarter it lies to the left.
    let basin = house("<Put code=\"OTB\" at=\"8 2\"/>");
    let turned = house("<Put code=\"OTB\" at=\"8 2\" turn=\"90\"/>");
    let front = stands(&basin, "OTB  ").0.y - 2.0 * U;
    let left = stands(&turned, "OTB  ").0.x + 8.0 * U;
    assert!(front < -0.5, "{front}");
    near(left, front);
}

#[test]
fn what_stands_in_a_court_is_outdoors() {
    let walls = "<Row><repeat num=\"8\"><Part code=\"KSK\"/></repeat></Row>".repeat(4);
    let court = "<Loop hole=\"yes\" start=\"2 6\"><Row>KSK  KSK  KSK  KSK</Row><Row>KSK  KSK  KSK  KSK</Row>\
        <Row>KSK  KSK  KSK  KSK</Row><Row>KSK  KSK  KSK  KSK</Row></Loop>";
    let said = |at: &str| {
        let text = format!(
            "<House><Storey>{walls}{court}</Storey><Put code=\"OMA 4\" at=\"{at}\"/></House>"
        );
        let run = compile("court.hsd", text.as_bytes());
        run.diagnostics.iter().filter(|d| d.code.0 == 706).count()
    };
    assert_eq!([said("4 4"), said("1 4"), said("4 -3")], [0, 1, 0]);
}

/// The bounds of the n-th covered ground, in the frame of the house.
fn ground(run: &Run, n: usize) -> (DVec3, DVec3) {
    let grounds = run.scene.nodes.iter().filter(|n| n.kind == Kind::Ground);
    let node = grounds.into_iter().nth(n).expect("is there");
    let mesh = &run.scene.meshes[node.mesh.expect("has a mesh").0 as usize];
    let flaws = shapes::flaws(mesh);
    assert_none(&flaws);
    bounds(&triangles(mesh))
}

#[test]
fn covered_ground_lies_flat_where_it_is_written() {
    for surface in ["gravel", "sand", "moss", "grass", "paving", "earth"] {
        let run = house(&format!(
            "<Ground surface=\"{surface}\" at=\"3 -4\" size=\"6 4\"/>"
        ));
        let (lo, hi) = ground(&run, 0);
        for (found, wanted) in [(lo.x, -6.0), (hi.x, 0.0), (lo.y, -6.0), (hi.y, -2.0)] {
            near(found, wanted * U);
        }
        assert!(lo.z > -0.285 && hi.z < -0.26, "{surface}: {lo} {hi}");
    }
    let turned = house("<Ground surface=\"paving\" at=\"3 -4\" size=\"6 4\" turn=\"90\"/>");
    let (lo, hi) = ground(&turned, 0);
    near(hi.x - lo.x, 4.0 * U);
    near(hi.y - lo.y, 6.0 * U);
}

#[test]
fn later_ground_lies_on_earlier_ground() {
    let run = house(
        "<Ground surface=\"moss\" at=\"3 -4\" size=\"9\"/><Ground surface=\"gravel\" at=\"3 -4\" size=\"2\"/>",
    );
    assert!(ground(&run, 1).1.z > ground(&run, 0).1.z + 0.002);
}

/// The bounds of the stones before doors, in the frame of the house.
fn door_steps(text: &str) -> Vec<(DVec3, DVec3)> {
    let run = compile("doors.hsd", text.as_bytes());
    let steps = run.scene.nodes.iter().filter(|n| n.name == "door step");
    let bounds = steps.map(|node| {
        let mesh = &run.scene.meshes[node.mesh.expect("has a mesh").0 as usize];
        assert_none(&shapes::flaws(mesh));
        let all: Vec<_> = triangles(mesh);
        let all: Vec<_> = all.into_iter().map(|t| t.map(|p| p + node.at)).collect();
        bounds(&all)
    });
    bounds.collect()
}

#[test]
fn a_stone_lies_before_doors_that_stand_on_the_ground() {
    let walls = "<Row>KSK  KSK  KSK  KSK</Row>".repeat(3);
    let front = "<Row>KSK  TKD 2TTB</Row>";
    let steps = door_steps(&format!("<House><Storey>{front}{walls}</Storey></House>"));
    // Two units of doors; the shutter box is none.
    let [(lo, hi)] = steps[..] else {
        panic!("{steps:?}")
    };
    near(hi.x - lo.x, 2.0 * U - 0.24);
    near((lo.x + hi.x) / 2.0, -2.0 * U);
    near(lo.z, -0.2835);
    near(hi.z, -0.285 / 2.0);
    assert!(lo.y < -0.4 && hi.y < 0.0, "outdoors: {lo} {hi}");
    // None upstairs, on a platform or inside.
    let raised = format!("<House><Platform height=\"2\"/><Storey>{front}{walls}</Storey></House>");
    assert!(door_steps(&raised).is_empty());
    let plain = "<Row>KSK  KSK  KSK  KSK</Row>".repeat(4);
    let above = format!("<House><Storey>{plain}</Storey><Storey>{front}{walls}</Storey></House>");
    assert!(door_steps(&above).is_empty());
    let inner = format!(
        "<House><Storey>{plain}<Loop inner=\"yes\" start=\"0 2\"><Row>KSK  TKD 2KSK</Row></Loop></Storey></House>"
    );
    assert!(door_steps(&inner).is_empty());
}

#[test]
fn what_stands_outdoors_needs_no_house() {
    let text = r#"<Houses>
  <Put code="OTO" at="2 0"/>
  <House><repeat num="3"><Put code="OTB" at="0 0"/></repeat></House>
  <House name="row"><repeat num="3" index="i"><Put code="OSE 2" at="{4 * i} -3"/></repeat></House>
  <Group x="100" turn="90">
    <repeat num="2" index="i"><Put code="OID 2" at="{-10 * i} 0"/></repeat>
    <Ground surface="gravel" at="0 0" size="4"/>
  </Group>
</Houses>"#;
    let run = compile("garden.hsd", text.as_bytes());
    assert_none(&flaws(&run));
    assert!(!run.has_errors(), "{}", run.short());
    let count = |code: &str| {
        let nodes = run.scene.nodes.iter();
        nodes
            .filter(|n| n.code.is_some_and(|c| c.as_str().trim() == code))
            .count()
    };
    assert_eq!(["OTO", "OTB", "OSE 2", "OID 2"].map(count), [1, 3, 3, 2]);
    let houses = &run.building.houses;
    assert_eq!(houses.len(), 4);
    assert!(houses.iter().all(|b| b.house.storeys.is_empty()));
    // What stands directly in a group is turned and moved with it.
    let last = houses.iter().find(|b| b.house.origin[0] == 100.0);
    assert!((last.expect("is moved").house.azimuth - 270.0).abs() < 1e-9);
    let empty = compile("empty.hsd", b"<House/>");
    assert!(empty.short().contains("HSD0318"), "{}", empty.short());
}

#[test]
fn a_storey_is_repeated_beside_what_stands_outdoors() {
    let row = "<Row>KSK  KSK  KSK</Row>".repeat(4);
    let text = format!(
        "<House><repeat num=\"2\"><repeat num=\"2\"><Put code=\"OTB\" at=\"9 9\"/></repeat></repeat><repeat num=\"2\"><Storey height=\"9\">{row}</Storey></repeat></House>"
    );
    let run = compile("house.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    let house = &run.building.houses[0].house;
    assert_eq!((house.storeys.len(), house.puts.len()), (2, 4));
}

#[test]
fn purlins_of_a_round_body_close_under_its_roof() {
    let text = hsd::templates::Template::named("tahoto")
        .expect("is a type")
        .text();
    let run = compile("tahoto.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    let fittings = run.building.houses[0].fittings.iter();
    let round = fittings
        .filter_map(|f| match &f.what {
            hsd::building::fittings::FittingKind::Brackets(it) => Some(it),
            _ => None,
        })
        .next_back()
        .expect("has brackets");
    // Purlins come last, one for each of sixteen sides.
    let purlins = &round.beams[round.beams.len() - 16..];
    for (i, beam) in purlins.iter().enumerate() {
        let next = &purlins[(i + 1) % 16];
        let gap = beam.ends[1].distance(next.ends[0]);
        assert!(
            gap < 0.12,
            "{gap} m between the purlins of sides {i} and the next"
        );
        assert!((beam.ends[0].z - purlins[0].ends[0].z).abs() < 1e-9);
    }
}

#[test]
fn the_plan_of_the_page_shows_what_stands_outdoors() {
    let text = "<House><Put code=\"OTO\" at=\"3 -4\"/><Ground surface=\"moss\" at=\"2 6\" size=\"4 2\"/></House>";
    let a = crate::ide::analysis("plot.hsd", text, &[]);
    let plan = hsd::ide::plan::Plan::of(&a, hsd::Language::English);
    let json = serde_json::to_value(plan).expect("is JSON");
    let found = &json["houses"][0]["outdoors"];
    // Ground lies below the parts.
    assert_eq!(
        (&found[0]["code"], &found[1]["code"]),
        (&"moss".into(), &"OTO".into())
    );
    let bounds = |n: usize| {
        let corners = found[n]["outline"].as_array().expect("has corners");
        let at = |k: usize| {
            corners
                .iter()
                .map(move |c| c[k].as_f64().expect("is a number"))
        };
        [0, 1].map(|k| {
            [
                at(k).fold(f64::MAX, f64::min),
                at(k).fold(f64::MIN, f64::max),
            ]
        })
    };
    let [[a0, a1], [b0, b1]] = bounds(0);
    near(a0, 0.0);
    near(a1, 4.0);
    near(b0, 5.0);
    near(b1, 7.0);
    let [[a0, a1], [b0, b1]] = bounds(1);
    near((a0 + a1) / 2.0, 3.0);
    assert!(b0 < -4.0 && b1 > -4.0, "{b0} to {b1}");
}
