//! Houses written short, and what stands at any house: the documented measures of Suzakumon and of two pagodas come
//! out of the elements, other measures work as well, all bodies are closed, and nothing absurd makes them fail.

use crate::support::Words;
use crate::support::{Run, assert_none, compile, flaws, open_edges, root};
use glam::DVec3;
use hsd::ast::CodeText;
use hsd::building::fittings::{Fitting, FittingKind};
use hsd::geometry::SHAKU;
use hsd::program::Content;
use hsd::scene::{Kind, Scene};

fn house(content: &str) -> Run {
    compile(
        "house.hsd",
        format!("<House>\n{content}\n</House>\n").as_bytes(),
    )
}

/// Without errors, warnings, or flaws in any body, the closed ones closed.
pub fn sound(run: &Run) {
    let mut findings = own_flaws(run);
    findings.extend(
        run.diagnostics
            .iter()
            .map(|d| format!("{}: {}", d.code, d.message.en())),
    );
    findings.extend(open_fittings(&run.scene));
    assert_none(&findings);
}

/// The roofs themselves are tested elsewhere, over more outlines than these.
fn own_flaws(run: &Run) -> Vec<String> {
    let all = flaws(run).into_iter();
    all.filter(|f| !f.starts_with("mesh roof") && !f.starts_with("roof node"))
        .collect()
}

fn open_fittings(scene: &Scene) -> Vec<String> {
    let kinds = [Kind::Platform, Kind::Veranda, Kind::Bracket, Kind::Finial];
    let nodes = scene.nodes.iter().filter(|n| kinds.contains(&n.kind));
    let mut seen: Vec<_> = nodes.filter_map(|n| Some((n.mesh?, &n.name))).collect();
    seen.sort_by_key(|(mesh, _)| mesh.0);
    seen.dedup_by_key(|(mesh, _)| mesh.0);
    seen.into_iter()
        .filter_map(|(mesh, name)| {
            let open = open_edges(&scene.meshes[mesh.0 as usize]);
            (open > 0).then(|| format!("{name}: {open} open edges"))
        })
        .collect()
}

/// Extent of everything of one house, from the ground up, metres: across, deep, high.
fn size_of(run: &Run, index: usize, kind: Kind) -> DVec3 {
    let scene = &run.scene;
    let roots: Vec<usize> = (0..scene.nodes.len())
        .filter(|i| scene.nodes[*i].parent.is_none())
        .collect();
    let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for node in scene.nodes.iter().filter(|n| n.kind == kind) {
        let parent = node.parent.map(|p| p.0 as usize);
        let Some(mesh) = node.mesh.filter(|_| parent == Some(roots[index])) else {
            continue;
        };
        for p in scene.meshes[mesh.0 as usize]
            .primitives
            .iter()
            .flat_map(|p| &p.positions)
        {
            let p = DVec3::from(p.map(f64::from)) + node.at;
            (lo, hi) = (lo.min(p), hi.max(p));
        }
    }
    hi - lo
}

pub fn fittings(run: &Run, house: usize) -> &[Fitting] {
    &run.building.houses[house].fittings
}

/// The side of a storey along the front, metres.
pub fn width(run: &Run, house: usize, storey: usize) -> f64 {
    let house = &run.building.houses[house].house;
    let walls = &house.storeys[storey].rings[0].walls;
    walls[0].from.distance(walls[0].to) * house.unit
}

/// The top of everything above the ground, metres.
pub fn height(run: &Run, house: usize) -> f64 {
    let raised = run.building.houses[house].house.raised;
    let tops = fittings(run, house).iter().filter_map(|f| match &f.what {
        FittingKind::Finial(it) => Some(it.ridge[0].z + it.height),
        _ => None,
    });
    let roofs = run.building.houses[house].roofs.roofs.iter();
    let points = roofs.flat_map(|r| &r.solids).flat_map(|s| &s.points);
    raised + tops.chain(points.map(|p| p.z)).fold(0.0, f64::max)
}

fn near(found: f64, wanted: f64, by: f64) {
    assert!((found - wanted).abs() <= by, "{found} instead of {wanted}");
}

pub fn example(name: &str) -> Run {
    let path = root().join(format!("examples/{name}.hsd"));
    compile(name, &std::fs::read(path).expect("the example is there"))
}

#[test]
fn storeys_taper_evenly_whatever_their_number() {
    for (n, taper) in [(3_u32, 0.6), (2, 0.9), (7, 0.5), (13, 0.75), (1, 0.7)] {
        let text = format!("<Pagoda storeys=\"{n}\" width=\"20\" taper=\"{taper}\"/>");
        let run = house(&text);
        sound(&run);
        for i in 0..n {
            let down = f64::from(i) / f64::from((n - 1).max(1));
            let wanted = 20.0 * SHAKU * (1.0 - (1.0 - taper) * down);
            near(width(&run, 0, i as usize), wanted, 5e-4);
        }
    }
}

/// A pagoda of three and more bays has its four posts round the altar, one bay from the walls, and none besides.
#[test]
fn four_posts_stand_round_the_altar() {
    for bays in 1..=5 {
        let run = house(&format!("<Pagoda width=\"20\" bays=\"{bays}\"/>"));
        sound(&run);
        let storeys = &run.building.houses[0].house.storeys;
        let inner = |storey: usize| storeys[storey].rings.iter().filter(|r| r.inner).count();
        let within: Vec<_> = storeys[0].rings.iter().filter(|r| r.inner).collect();
        let corners = within.iter().flat_map(|ring| &ring.walls);
        let posts: std::collections::BTreeSet<_> = corners
            .flat_map(|wall| [wall.from, wall.to])
            .map(|p| p.to_array().map(|x| (x * 1000.0).round() as i64))
            .collect();
        assert_eq!(
            posts.len(),
            if bays < 3 { 0 } else { 4 },
            "{bays} bays: {posts:?}"
        );
        assert!(
            within
                .iter()
                .flat_map(|r| &r.walls)
                .all(|w| w.units.len() <= 3),
            "{bays} bays"
        );
        assert_eq!(inner(1), 0, "{bays} bays");
    }
}

#[test]
fn other_measures_work_too() {
    for text in [
        "<Gate bays=\"3 2\" bay=\"12\"/>",
        "<Gate bays=\"3 2\" bay=\"10 9\" storeys=\"1\" platform=\"0\"/>",
        "<Gate bays=\"1\" bay=\"8\" storeys=\"1\" steps=\"0\" kind=\"H\" shape=\"KIR\"/>",
        "<Gate bays=\"9 3\" bay=\"20\" paint=\"keyaki\" inset=\"6\"/>",
        "<Pagoda storeys=\"3\" width=\"9\" bays=\"1\" sorin=\"0\" platform=\"0\"/>",
        "<Pagoda storeys=\"5\" width=\"100\" bays=\"5\" taper=\"0.8\"/>",
        "<Hall bays=\"3 3\" shape=\"HOG\"/>",
        "<Hall bays=\"7 6\" bay=\"11 10\" aisle=\"9\" paint=\"vermilion\" veranda=\"0\" platform=\"4\"/>",
        "<Hall bays=\"5 4\" bay=\"9\" kind=\"Y\" pitch=\"9\" thickness=\"2\" shape=\"IRI\"/>",
        "<Shrine bays=\"1\" bay=\"4\" katsuogi=\"0\"/>",
        "<Shrine bays=\"5 3\" bay=\"12\" paint=\"vermilion\" kind=\"S\" shape=\"IRI\"/>",
    ] {
        let run = house(text);
        let mut findings = own_flaws(&run);
        findings.extend(open_fittings(&run.scene));
        assert!(!run.has_errors(), "{text}: {}", run.short());
        assert!(findings.is_empty(), "{text}: {findings:?}");
    }
}

#[test]
fn general_elements_stand_at_any_house() {
    let wall = "<Row>KSK  TSH 2KSK</Row><Row>KSK  KSK  KSK</Row>";
    let run = house(&format!(
        "<Platform height=\"2\" margin=\"5 6\" stairs=\"F B\"/>\
         <Posts size=\"0.6\" round=\"yes\" paint=\"hinoki\" nageshi=\"2\"/><Brackets steps=\"1\"/>\
         <Storey height=\"14\"><Veranda width=\"4\" height=\"2\" rail=\"knobbed\" stairs=\"F\"/>{wall}{wall}</Storey>\
         <Finial kind=\"hoju\"/><Roofs shape=\"HOG\" eaves=\"5\"/>"
    ));
    sound(&run);
    // The jewel that was written stands in place of the usual one.
    let mut roofs = run.building.houses[0].roofs.roofs.iter();
    assert!(roofs.any(|r| r.trim.crowned));
    near(run.building.houses[0].house.raised, 4.0 * SHAKU, 1e-9);
    near(run.building.houses[0].house.origin[2], 4.0 * SHAKU, 1e-9);
    let platform = size_of(&run, 0, Kind::Platform);
    near(platform.x, (12.0 + 10.0) * SHAKU, 1e-4);
    for kind in [Kind::Platform, Kind::Veranda, Kind::Bracket, Kind::Finial] {
        let node = run.scene.nodes.iter().find(|n| n.kind == kind);
        assert!(node.is_some_and(|n| n.span.is_some()), "{kind:?}");
    }
    // A complex on each post of 3 by 3 bays, and a strut between any two.
    let heads = run.scene.nodes.iter().filter(|n| n.name == "bracket");
    assert_eq!(heads.count(), 12 + 12);
}

#[test]
fn what_an_author_writes_beside_a_short_form_takes_the_place_of_its_own() {
    let run = house(
        "<Gate/><Platform height=\"9\"/><Brackets steps=\"1\"/><Roofs kind=\"H\" eaves=\"8\"/>",
    );
    sound(&run);
    let house = &run.building.houses[0].house;
    near(house.raised, 9.0 * SHAKU, 1e-9);
    assert!(
        house
            .storeys
            .iter()
            .all(|s| s.order.brackets.as_ref().is_some_and(|b| b.steps == 1))
    );
    let kinds = run.building.houses[0].roofs.roofs.iter().map(|r| r.kind);
    assert!(kinds.into_iter().all(|k| k == hsd::ast::RoofKind::Bark));
}

#[test]
fn custom_parts_are_used_in_every_bay() {
    let own = r#"<PartDef code="KSK" base="KSK" finish="juraku"/>"#;
    let run = house(&format!("{own}<Pagoda storeys=\"3\"/>"));
    sound(&run);
    let built_in = hsd::parse::builtin()
        .find(&CodeText::new("KSK"))
        .expect("is known");
    let storeys = &run.building.houses[0].house.storeys;
    let walls = storeys.iter().flat_map(|s| &s.rings).flat_map(|r| &r.walls);
    let (mut split, mut walled) = (0, 0);
    for unit in walls.flat_map(|w| &w.units) {
        let halves = match &unit.content {
            Content::Split(halves) => {
                split += 1;
                halves.upper.iter().chain(&halves.lower).collect()
            }
            _ => vec![unit],
        };
        for unit in halves {
            walled += usize::from(matches!(unit.content, Content::Part(_)));
            assert_ne!(unit.content, Content::Part(built_in));
        }
    }
    assert!(split > 0 && walled > split, "{split} of {walled}");
}

#[test]
fn every_detail_is_sound() {
    use hsd::scene::Detail;
    let run = example("suzakumon");
    let mut before = 0;
    for detail in Detail::ALL {
        let scene = hsd::driver::scene(&run.building, &run.catalog, detail);
        assert_none(&open_fittings(&scene));
        let count = scene.stats().triangles;
        assert!(count > before, "{detail:?}: {count} after {before}");
        before = count;
    }
}

#[test]
fn nothing_absurd_makes_it_fail() {
    for text in [
        "<Pagoda storeys=\"15\" width=\"300\" bays=\"9\" taper=\"0.2\" rise=\"3\" pitch=\"30\" eaves=\"33\"/>",
        "<Pagoda storeys=\"15\" width=\"0.1\" taper=\"0.99\" post=\"20\" sori=\"50\" thickness=\"6\"/>",
        "<Pagoda columns=\"0.1\" rise=\"0.1\" margin=\"0 300\" platform=\"300\"/>",
        "<Gate bays=\"60 60\" bay=\"40\" doors=\"60\" inset=\"300\" steps=\"4\"/>",
        "<Gate bays=\"1 1\" bay=\"0.1\" columns=\"0.1\" upper=\"0.1\" sori=\"-50\"/>",
        "<Gate inset=\"0\" pitch=\"30\" eaves=\"0\" thickness=\"6\"/>",
        "<Hall bays=\"60 1\" bay=\"0.1 200\" aisle=\"300\" veranda=\"300\" floor=\"300\"/>",
        "<Shrine bays=\"1 60\" katsuogi=\"99\" thickness=\"6\" post=\"20\" steps=\"4\"/>",
        "<Platform height=\"300\" margin=\"300\" stairs=\"F B L R\" width=\"1000\"/><Gate/>",
        "<Gate/><Finial kind=\"sorin\" height=\"1000\" at=\"1e8 -1e8\"/><Finial kind=\"chigi\" count=\"99\"/>",
        "<Gate/><Gate/><Pagoda/><Hall/><Shrine/>",
        "<Gate bays=\"2.5 nan\" bay=\"-1\" storeys=\"9\" taper=\"1\"/>",
        "<Brackets steps=\"4\" height=\"300\" out=\"300\"/><Posts size=\"20\" nageshi=\"5\"/><Storey height=\"1\">\
         <Veranda width=\"1e5\" height=\"300\"/><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row></Storey>",
        "<Storey><Loop inner=\"yes\"><Row>KSK  KSK</Row></Loop></Storey>",
    ] {
        let run = house(text);
        let numbers = run.scene.meshes.iter().flat_map(|m| &m.primitives);
        let all = numbers.flat_map(|p| p.positions.iter().flatten());
        assert!(all.into_iter().all(|x| x.is_finite()), "{text}");
    }
}
