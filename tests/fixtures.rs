//! Fixtures: where they stand, what they are made of, and how stairs join storeys.

use crate::support::shapes::{bounds, flaws, triangles};
use crate::support::{Numbers, Run, assert_none, compile, on_all_processors};
use glam::{DVec2, DVec3, dvec2};
use hsd::ast::FixtureKind;
use hsd::building::{Fixture, Room};
use hsd::scene::{Detail, Kind, Node};
use std::fmt::Write;

/// A house of 8 by 8 units with rooms below and above, and this in either.
fn text(ground: &str, upper: &str) -> String {
    let side = |first: &str, count| format!("<Row>{first}{}</Row>", "KSK  ".repeat(count));
    let rows = |first: &str| {
        let rest = side("", 8);
        format!("{}{rest}{rest}{rest}", side(first, 6))
    };
    let (ground_rows, upper_rows) = (rows("TSH 2"), rows("KSK  KSK  "));
    format!(
        "<House><Storey height=\"9\">{ground_rows}{ground}</Storey>
         <Storey height=\"8\">{upper_rows}{upper}</Storey></House>"
    )
}

fn run(ground: &str, upper: &str) -> Run {
    compile("house.hsd", text(ground, upper).as_bytes())
}

fn fixtures(run: &Run) -> &[Fixture] {
    &run.building.houses[0].fixtures
}

fn rooms(run: &Run) -> &[Room] {
    &run.building.houses[0].rooms
}

/// Returns the codes of what is said about rooms and fixtures.
fn told(run: &Run) -> Vec<u16> {
    let codes = run.diagnostics.iter().map(|d| d.code.0);
    codes.filter(|code| (440..460).contains(code)).collect()
}

fn node(run: &Run, kind: Kind) -> Vec<&Node> {
    run.scene.nodes.iter().filter(|n| n.kind == kind).collect()
}

/// The triangles of a fixture's node in the frame of its house.
fn placed(run: &Run, node: &Node) -> Vec<[DVec3; 3]> {
    let storey = node.parent.expect("a storey");
    let foot = run.scene.nodes[storey.0 as usize].at;
    let mesh = &run.scene.meshes[node.mesh.expect("a mesh").0 as usize];
    let turned = |p: DVec3| {
        let p = p / 1000.0;
        node.turn.rotate(p.truncate()).extend(p.z) + node.at + foot
    };
    let all = triangles(mesh);
    all.iter().map(|t| t.map(turned)).collect()
}

/// The corner of the rectangle, and its size, for a fixture against a side of the house.
fn against(side: char, kind: FixtureKind) -> (DVec2, DVec2) {
    let (width, depth) = kind.usual_size();
    match side {
        'F' => (dvec2(2.0, 8.0 - depth), dvec2(width, depth)),
        'B' => (dvec2(2.0, 0.0), dvec2(width, depth)),
        'L' => (dvec2(0.0, 2.0), dvec2(depth, width)),
        _ => (dvec2(8.0 - depth, 2.0), dvec2(depth, width)),
    }
}

#[test]
fn every_kind_is_whole_and_stays_in_its_place() {
    assert_none(&on_all_processors(FixtureKind::ALL.len(), |number| {
        let (word, kind) = FixtureKind::ALL[number];
        let mut found = vec![];
        for side in ['F', 'B', 'L', 'R'] {
            let (low, size) = against(side, kind);
            let across = matches!(side, 'F' | 'B');
            // Against a wall, in a corner, and free in the room; stairs end before a wall.
            let low = match (kind.climbs(), across) {
                (false, _) => low,
                (true, true) => dvec2(2.0, 2.5),
                (true, false) => dvec2(2.5, 2.0),
            };
            let corner = if across {
                dvec2(0.0, low.y)
            } else {
                dvec2(low.x, 0.0)
            };
            for at in [low, corner, dvec2(3.0, 3.0)] {
                let fixture = format!(
                    r#"<Fixture kind="{word}" at="{} {}" faces="{side}"/><Room name="a" at="7.9 7.9"/>"#,
                    at.x, at.y
                );
                let run = run(&fixture, "");
                let place = format!("{word} facing {side} at {at}");
                if !told(&run).is_empty() {
                    found.push(format!("{place}: {}", run.short()));
                    continue;
                }
                let [node] = node(&run, Kind::Fixture)[..] else {
                    found.push(format!("{place}: not one node"));
                    continue;
                };
                let mesh = &run.scene.meshes[node.mesh.expect("a mesh").0 as usize];
                found.extend(flaws(mesh).into_iter().map(|f| format!("{place}: {f}")));
                // Lids, posts and handrails may reach out by a hand, up into the storey above only from stairs.
                let unit = run.building.houses[0].house.unit;
                let room = if kind.climbs() {
                    20.0
                } else {
                    9.0 * 10.0 / 33.0
                };
                for p in placed(&run, node).into_iter().flatten() {
                    let (a, b) = (-p.x / unit, p.y / unit);
                    let hand = 0.2;
                    let beside = a < at.x - hand
                        || a > at.x + size.x + hand
                        || b < at.y - hand
                        || b > at.y + size.y + hand;
                    if beside || p.z < -0.1 || p.z > room {
                        found.push(format!("{place}: reaches {a:.2} {b:.2} {:.2}", p.z));
                        break;
                    }
                }
            }
        }
        found
    }));
}

#[test]
fn stairs_rise_away_from_the_side_they_face() {
    for word in ["stairs", "hako-kaidan"] {
        for (side, out) in [
            ('F', DVec2::NEG_Y),
            ('B', DVec2::Y),
            ('L', DVec2::X),
            ('R', DVec2::NEG_X),
        ] {
            let fixture = format!(r#"<Fixture kind="{word}" at="3 3" faces="{side}"/>"#);
            let run = run(&fixture, "");
            let [node] = node(&run, Kind::Fixture)[..] else {
                panic!("{word} {side}: {}", run.short())
            };
            let middle = fixtures(&run)[0].middle();
            let unit = run.building.houses[0].house.unit;
            // Level faces as large as treads: the farther to the back, the higher.
            let mut treads: Vec<(f64, f64)> = vec![];
            for [p, q, r] in placed(&run, node) {
                let normal = (q - p).cross(r - p);
                let level = normal.z > 0.08 && normal.truncate().length() < 1e-9;
                let centre = (p + q + r) / 3.0;
                if level && centre.z < 2.6 {
                    let place = dvec2(-centre.x, centre.y) / unit - middle;
                    treads.push((place.dot(out), centre.z));
                }
            }
            treads.sort_by(|p, q| q.0.total_cmp(&p.0));
            assert!(treads.len() > 15, "{word} {side}: {} treads", treads.len());
            for (i, (place, height)) in treads.iter().enumerate() {
                let behind = treads[i..].iter().filter(|t| place - t.0 > 0.3);
                let lower = behind.filter(|t| t.1 <= *height).count();
                assert_eq!(lower, 0, "{word} {side}: {treads:?}");
            }
            assert!(treads[0].1 < 0.3 && treads[treads.len() - 1].1 > 2.3);
        }
    }
}

/// Whether a level triangle of some mesh covers a point of the plan.
fn covers(triangles: &[[DVec3; 3]], p: DVec2, heights: std::ops::Range<f64>) -> bool {
    triangles.iter().any(|t| {
        let flat = t.map(|p| p.truncate());
        let side = |i: usize| (flat[(i + 1) % 3] - flat[i]).perp_dot(p - flat[i]);
        let all = [side(0), side(1), side(2)];
        let inside = all.iter().all(|s| *s > 0.0) || all.iter().all(|s| *s < 0.0);
        inside && t.iter().all(|p| heights.contains(&p.z))
    })
}

#[test]
fn stairs_open_the_ceiling_and_the_floor_above_and_nothing_else() {
    let run = run(
        r#"<Fixture kind="stairs" at="0 2"/><Room name="a" at="5 5"/>"#,
        r#"<Room name="b" at="5 5" floor="tatami"/>"#,
    );
    assert!(told(&run).is_empty(), "{}", run.short());
    let unit = run.building.houses[0].house.unit;
    let mut level: Vec<[DVec3; 3]> = vec![];
    for node in node(&run, Kind::Room) {
        let Some(parent) = node.parent else { continue };
        if run.scene.nodes[parent.0 as usize].kind == Kind::Storey {
            level.extend(placed(&run, node));
        }
    }
    let storey = 9.0 * 10.0 / 33.0;
    for i in 0..80 {
        for j in 0..80 {
            let p = dvec2(f64::from(i) + 0.43, f64::from(j) + 0.37) / 10.0;
            let opening = p.x < 1.0 && p.y > 2.0 && p.y < 5.0;
            let place = dvec2(-p.x, p.y) * unit;
            assert!(covers(&level, place, -0.4..0.1), "the ground floor at {p}");
            for heights in [storey - 0.02..storey + 0.02, storey - 0.11..storey - 0.07] {
                assert_eq!(
                    covers(&level, place, heights.clone()),
                    !opening,
                    "{p} {heights:?}"
                );
            }
        }
    }
    // No mat hangs in the air.
    let mats = rooms(&run).iter().flat_map(|r| &r.mats);
    let over = |low: DVec2, high: DVec2| low.x < 1.0 && high.x > 0.0 && low.y < 5.0 && high.y > 2.0;
    assert_eq!(mats.filter(|m| over(m.low, m.high)).count(), 0);
}

#[test]
fn mats_lie_round_fixtures() {
    assert_none(&on_all_processors(200, |seed| {
        let mut random = Numbers(seed as u64);
        let mut inside = String::new();
        for _ in 0..1 + random.below(4) {
            let [a, b] = [0; 2].map(|_| random.below(7));
            let [wide, deep] = [0; 2].map(|_| 1 + random.below(2));
            let _ = write!(
                inside,
                r#"<Fixture kind="well" at="{a} {b}" size="{wide} {deep}"/>"#
            );
        }
        let run = run(
            &(inside + r#"<Room name="a" at="7.999 7.999" floor="tatami"/>"#),
            "",
        );
        let taken = fixtures(&run);
        let mut found = vec![];
        // Cells of one unit: each has a mat, boards, or a fixture in it, and never two of them.
        let mut cells = [[0_u32; 8]; 8];
        let rectangles = taken.iter().map(|f| (f.low, f.high));
        let mats = rooms(&run).iter().flat_map(|r| &r.mats);
        for (low, high) in rectangles.chain(mats.map(|m| (m.low, m.high))) {
            for (a, column) in cells.iter_mut().enumerate() {
                for (b, count) in column.iter_mut().enumerate() {
                    let middle = dvec2(a as f64 + 0.5, b as f64 + 0.5);
                    let within = middle.cmpgt(low).all() && middle.cmplt(high).all();
                    *count += u32::from(within);
                }
            }
        }
        let twice = cells.iter().flatten().filter(|n| **n > 1).count();
        let bare = cells.iter().flatten().filter(|n| **n == 0).count();
        if twice > 0 || bare > 0 {
            found.push(format!("seed {seed}: {twice} cells twice, {bare} bare"));
        }
        found
    }));
}

#[test]
fn upper_rooms_are_reached_by_stairs_alone() {
    let wall = r#"<Loop inner="yes" start="0 4"><Row>KSK  KSK  KSK  KSK  KSK  KSK  KSK  KSK  </Row></Loop>"#;
    let (front, back) = (
        r#"<Room name="a" at="4 1"/>"#,
        r#"<Room name="b" at="4 6"/>"#,
    );
    let stairs = |b: f64| format!(r#"<Fixture kind="stairs" at="0 {b}"/>"#);
    let of = |ground: &str, upper: &str| told(&run(ground, upper));
    assert_eq!(of(front, front), [452]);
    assert!(of(&stairs(0.5), front).is_empty());
    let divided = format!("{wall}{front}{back}");
    assert_eq!(
        of(&stairs(0.5), &divided),
        [443],
        "upstairs no door leads on"
    );
    assert_eq!(
        of(&format!("{wall}{}", stairs(4.5)), front),
        [443],
        "nobody gets to the foot of the stairs"
    );
    let both = format!("{wall}{}{}", stairs(0.5), stairs(4.5));
    assert_eq!(of(&both, &divided), [443], "only the front is reached");
    assert_eq!(
        of(&format!("{}{}", stairs(0.5), stairs(4.5)), &divided),
        [] as [u16; 0]
    );
}

#[test]
fn what_stands_wrong_is_told_and_left_out() {
    let wall = r#"<Loop inner="yes" start="0 4"><Row>KSK  KSK  KSK  KSK  KSK  KSK  KSK  TSH 2</Row></Loop>"#
        .replace("KSK  TSH 2", "TSH 2");
    for (fixture, code, left) in [
        (r#"<Fixture kind="well" at="7.5 1"/>"#, 447, 0),
        (r#"<Fixture kind="well" at="20 1"/>"#, 447, 0),
        (r#"<Fixture kind="well" at="1 3.5"/>"#, 447, 0),
        (
            r#"<Fixture kind="well" at="1 1"/><Fixture kind="sink" at="0.5 1.5"/>"#,
            448,
            1,
        ),
        (r#"<Fixture kind="oshi-ire" at="1 4"/>"#, 449, 1),
        (r#"<Fixture kind="stairs" at="1 1" faces="B"/>"#, 451, 1),
        (r#"<Fixture kind="stairs" at="1 0" faces="B"/>"#, 450, 0),
    ] {
        let fixture = match code {
            451 => fixture.replace("at=", r#"size="1 1.5" at="#),
            _ => fixture.to_owned(),
        };
        let run = run(&format!("{wall}{fixture}"), "");
        assert_eq!(told(&run), [code], "{fixture}");
        assert_eq!(fixtures(&run).len(), left, "{fixture}");
    }
}

#[test]
fn from_afar_nothing_changes() {
    let bytes = |ground: &str, detail: Detail| {
        let options = hsd::Options {
            detail,
            ..hsd::Options::default()
        };
        let source = text(ground, "");
        let source = hsd::source::Source::new(hsd::source::FileId(0), "h.hsd", source.as_bytes());
        let mut out = hsd::diagnostic::Diagnostics::new();
        let made = hsd::compile(&[&source], &hsd::source::NoFiles, &options, &mut out);
        let meshes = made
            .scene
            .meshes
            .iter()
            .map(|m| format!("{:?}", m.primitives));
        (meshes.collect::<Vec<_>>(), made.scene.nodes.len())
    };
    for detail in [Detail::Body, Detail::Flat] {
        let with = bytes(r#"<Fixture kind="stairs" at="0 2"/>"#, detail);
        assert_eq!(with, bytes("", detail));
    }
    let fine = bytes(r#"<Fixture kind="stairs" at="0 2"/>"#, Detail::Openings);
    assert_ne!(fine, bytes("", Detail::Openings));
}

#[test]
fn names_of_fixtures_are_understood_in_japanese() {
    for (name, kind) in [
        ("床の間", FixtureKind::Tokonoma),
        ("押入れ", FixtureKind::OshiIre),
        ("箱階段", FixtureKind::HakoKaidan),
        ("かまど", FixtureKind::Kamado),
    ] {
        let run = run(&format!(r#"<Fixture kind="{name}" at="3 3"/>"#), "");
        let kinds: Vec<FixtureKind> = fixtures(&run).iter().map(|f| f.kind).collect();
        assert_eq!(kinds, [kind], "{name}: {}", run.short());
    }
}

#[test]
fn bodies_are_of_a_carpenters_size() {
    let fixtures = r#"<Fixture kind="tokonoma" at="0 7"/><Fixture kind="kamado" at="4 7.25"/>"#;
    let run = run(fixtures, "");
    let heights: Vec<f64> = node(&run, Kind::Fixture)
        .iter()
        .map(|n| {
            bounds(&triangles(
                &run.scene.meshes[n.mesh.expect("a mesh").0 as usize],
            ))
            .size()
            .z / 1000.0
        })
        .collect();
    // An alcove reaches the ceiling; pots stand on a hearth below the waist.
    assert!(heights[0] > 2.5 && heights[0] < 2.73, "{heights:?}");
    assert!(heights[1] > 0.6 && heights[1] < 0.9, "{heights:?}");
}

/// What lies over rooms without a ceiling has no floor, unless a room is written there.
#[test]
fn a_passage_is_open_up_to_the_roof() {
    let wall = r#"<Loop inner="yes" start="2 0"><Row turn="R"/><Row>TSH 2KTU  KTU  KTU  KTU  KTU  KTU  </Row></Loop>"#;
    let across = r#"<Loop inner="yes" start="0 5"><Row>KTU  KTU  </Row></Loop>"#;
    let ground = |ceiling: &str| {
        format!(
            r#"{wall}<Room name="a" at="1 1" floor="earth" ceiling="{ceiling}"/><Room name="b" at="4 4"/>
               <Fixture kind="stairs" at="4 2"/>"#
        )
    };
    let floors = |ceiling: &str, upper: &str| {
        let run = run(&ground(ceiling), upper);
        assert_eq!(told(&run), Vec::<u16>::new(), "{}", run.short());
        let mut at: Vec<[i64; 2]> = rooms(&run)
            .iter()
            .filter(|r| r.storey == 2)
            .map(|r| [r.at.x.floor() as i64 / 2, r.at.y.floor() as i64 / 5])
            .collect();
        at.sort_unstable();
        at
    };
    let room = r#"<Room name="c" at="5 7"/>"#;
    let both = format!("{wall}{across}{room}");
    assert_eq!(floors("none", &format!("{wall}{room}")).len(), 1);
    assert_eq!(floors("battens", &format!("{wall}{room}")).len(), 2);
    assert_eq!(floors("none", &both).len(), 1, "both areas lie over it");
    let written = format!("{both}<Room name=\"d\" at=\"1 7\"/>");
    let run = run(&ground("none"), &written);
    assert_eq!(
        told(&run),
        [443],
        "nobody gets to the room over the passage"
    );
    assert_eq!(rooms(&run).iter().filter(|r| r.storey == 2).count(), 2);
    // A wall elsewhere: a part of the area lies over a ceiling.
    let beyond = format!("{}{room}", wall.replace("start=\"2 0\"", "start=\"3 0\""));
    assert_eq!(floors("none", &beyond).len(), 2);
}
