//! Drawings to scale, read again by a reader of their SVG that knows nothing of how they were made.

use crate::support::{assert_none, compile, compile_file, on_all_processors, stem};
use crate::support::{texts, texts_in_turn, thorough};
use glam::{DVec2, DVec3, dvec2};
use hsd::Language;
use hsd::drawing::paper::Sheet;
use hsd::drawing::sheet::Paper;
use hsd::drawing::subject::Subject;
use hsd::drawing::{self, Plane, Settings, Wanted};
use hsd::geometry::SHAKU;
use hsd::scene::{Detail, Scene};
use std::collections::{BTreeMap, BTreeSet};

mod files;
mod stairs;

const SCALE: u32 = 100;

/// Millimetres on paper in a metre.
const MM: f64 = 1000.0 / SCALE as f64;

/// A path of a drawing: its view, role and code, its rings or lines with y upwards.
struct Drawn {
    view: String,
    role: String,
    code: Option<String>,
    rings: Vec<Vec<DVec2>>,
    closed: bool,
}

/// Reads the paths of an SVG: groups, attributes, `M`, `L` and `Z` with absolute numbers.
fn read(svg: &str) -> Vec<Drawn> {
    use quick_xml::events::Event;
    let mut reader = quick_xml::Reader::from_str(svg);
    let (mut groups, mut found): (Vec<BTreeMap<String, String>>, Vec<Drawn>) = (vec![], vec![]);
    loop {
        let event = reader.read_event().expect("the drawing is XML");
        let attributes = |e: &quick_xml::events::BytesStart<'_>| -> BTreeMap<String, String> {
            e.attributes()
                .map(|a| {
                    let a = a.expect("attributes are sound");
                    let key = a.key.as_ref().to_owned();
                    assert_ne!(key, "transform", "nothing is transformed");
                    (key, a.value.into_owned())
                })
                .collect()
        };
        match event {
            Event::Start(e) => groups.push(attributes(&e)),
            Event::End(_) => drop(groups.pop()),
            Event::Empty(e) if e.name().as_ref() == "path" => {
                let own = attributes(&e);
                let of = |key: &str| groups.iter().rev().find_map(|g| g.get(key)).cloned();
                let d = &own["d"];
                found.push(Drawn {
                    view: of("data-view").expect("every mark is in a view"),
                    role: of("data-role").expect("every mark has a role"),
                    code: own.get("data-code").cloned(),
                    rings: d.split('M').skip(1).map(points).collect(),
                    closed: d.ends_with('Z'),
                });
            }
            Event::Eof => return found,
            _ => (),
        }
    }
}

fn points(path: &str) -> Vec<DVec2> {
    let point = |p: &str| {
        let mut numbers = p.split(' ').map(|n| n.parse::<f64>().expect("is a number"));
        let (x, y) = (
            numbers.next().expect("has x"),
            numbers.next().expect("has y"),
        );
        assert_eq!(numbers.next(), None);
        dvec2(x, -y)
    };
    path.trim_end_matches('Z').split('L').map(point).collect()
}

fn settings() -> Settings {
    Settings {
        scale: SCALE,
        sections: vec![],
        language: Language::English,
        title: "House".to_owned(),
        source: "house.hsd".to_owned(),
        ken: 1.8,
    }
}

/// The drawing of one view of all houses, by itself.
fn draw(
    run: &crate::support::Run,
    scene: &Scene,
    wanted: Wanted,
    sections: &[Plane],
) -> Vec<Drawn> {
    let subject = Subject::new(&run.building, |_| true, scene, &run.catalog);
    let settings = Settings {
        sections: sections.to_vec(),
        ..settings()
    };
    let rows = drawing::views(&subject, &[wanted], &settings);
    let sheet = drawing::on_paper(&rows, None, &settings).expect("a view has its own paper");
    read(&drawing::svg::write(&sheet))
}

/// Triangles of each node in the frame of the first house, metres above the ground.
fn triangles(run: &crate::support::Run, scene: &Scene) -> Vec<Vec<[DVec3; 3]>> {
    let house = &run.building.houses[0].house;
    let [east, north, up] = house.origin;
    let (sin, cos) = (house.azimuth - 180.0).to_radians().sin_cos();
    let home = |p: DVec3| {
        let p = p - DVec3::new(east, north, up - house.raised);
        DVec3::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z)
    };
    let nodes = scene.nodes.iter().zip(hsd::render::view::places(scene));
    nodes
        .map(|(node, place)| {
            let mut own = vec![];
            hsd::render::view::pour(scene, node, place, &mut own);
            own.into_iter().map(|t| t.corners.map(home)).collect()
        })
        .collect()
}

/// Returns the triangles of a node that bound bodies: each set that hangs together, unless it has a border as cloth has.
fn closed(triangles: &[[DVec3; 3]]) -> Vec<[DVec3; 3]> {
    let key = |p: DVec3| (p * 2e4).round().to_array().map(|x| x as i64);
    let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
    let corners: Vec<[usize; 3]> = triangles
        .iter()
        .map(|t| {
            t.map(|p| {
                let next = numbers.len();
                *numbers.entry(key(p)).or_insert(next)
            })
        })
        .collect();
    let mut set: Vec<usize> = (0..numbers.len()).collect();
    fn root(set: &mut [usize], mut at: usize) -> usize {
        while set[at] != at {
            set[at] = set[set[at]];
            at = set[at];
        }
        at
    }
    let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
    for t in &corners {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
            let (a, b) = (root(&mut set, a), root(&mut set, b));
            set[a] = b;
        }
    }
    let open: BTreeSet<usize> = edges
        .iter()
        .filter(|(_, n)| **n != 0)
        .map(|((a, _), _)| root(&mut set, *a))
        .collect();
    let kept = triangles.iter().zip(&corners);
    kept.filter(|(_, t)| !open.contains(&root(&mut set, t[0])))
        .map(|(t, _)| *t)
        .collect()
}

/// The area in which an upright or level plane cuts closed bodies, from the triangles one by one: square metres.
fn cut_area(triangles: &[[DVec3; 3]], axis: DVec3, at: f64) -> f64 {
    let mut area = 0.0;
    for t in triangles {
        let depths = t.map(|p| axis.dot(p) - at);
        let mut ends = vec![];
        for k in 0..3 {
            let (d, e) = (depths[k], depths[(k + 1) % 3]);
            if (d < 0.0) != (e < 0.0) {
                ends.push(t[k].lerp(t[(k + 1) % 3], d / (d - e)));
            }
        }
        if let [p, q] = ends[..] {
            // The body lies against the normal of the triangle.
            let normal = (t[1] - t[0]).cross(t[2] - t[0]);
            let out = axis.cross(q - p).dot(normal);
            area += axis.dot(p.cross(q)) / 2.0 * -out.signum();
        }
    }
    area
}

fn ring_area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(p, q)| p.perp_dot(*q))
        .sum::<f64>()
        / 2.0
}

#[test]
fn a_section_has_the_area_of_the_cut() {
    let paths = texts_in_turn("examples", 2);
    let findings = on_all_processors(paths.len(), |index| {
        let run = compile_file(&paths[index]);
        let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Everything);
        let subject = Subject::new(&run.building, |_| true, &scene, &run.catalog);
        let bodies: Vec<[DVec3; 3]> = triangles(&run, &scene)
            .iter()
            .flat_map(|t| closed(t))
            .collect();
        let house = &run.building.houses[0].house;
        let mut found = vec![];
        let planes = Plane::middle(&subject);
        let in_turn = planes
            .into_iter()
            .enumerate()
            .filter(|(k, _)| thorough() || k % 2 == index % 2);
        for (_, plane) in in_turn {
            let drawn = draw(&run, &scene, Wanted::Sections, &[plane]);
            let (axis, at) = match plane {
                Plane::A(a) => (DVec3::NEG_X, a * house.unit),
                Plane::B(b) => (DVec3::Y, b * house.unit),
            };
            let exact = cut_area(&bodies, axis, at);
            let areas = drawn.iter().filter(|d| d.closed && d.role != "frame");
            let on_paper: f64 = areas.flat_map(|d| &d.rings).map(|r| ring_area(r)).sum();
            let found_area = on_paper / MM / MM;
            // Numbers are rounded to micrometres on paper.
            if (found_area - exact).abs() > exact.abs() * 1e-3 + 1e-3 {
                found.push(format!(
                    "{} {}: {found_area} m2, not {exact}",
                    stem(&paths[index]),
                    plane.word()
                ));
            }
        }
        found
    });
    assert_none(&findings);
}

#[test]
fn plans_have_the_bays_of_their_texts() {
    let paths = texts("examples");
    let findings = on_all_processors(paths.len(), |index| {
        let run = compile_file(&paths[index]);
        let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Body);
        let house = &run.building.houses[0].house;
        let own = |built: &&hsd::building::Built| built.house.azimuth == house.azimuth;
        let houses: Vec<_> = run.building.houses.iter().filter(own).collect();
        if houses.len() < run.building.houses.len() {
            return vec![]; // turned against each other: their plans are compared by the roofs
        }
        let (sin, cos) = (180.0 - house.azimuth).to_radians().sin_cos();
        let mut wanted: Vec<(DVec2, DVec2)> = vec![];
        for built in houses {
            let [dx, dy] = [0, 1].map(|k| built.house.origin[k] - house.origin[k]);
            let shift = dvec2(dx * cos + dy * sin, dy * cos - dx * sin);
            for wall in built
                .house
                .storeys
                .iter()
                .filter(|s| s.number == 1)
                .flat_map(|s| &s.rings)
                .flat_map(|r| &r.walls)
            {
                let mut at = wall.from;
                for unit in &wall.units {
                    let to = at + wall.direction * unit.width;
                    let place = |p: DVec2| (dvec2(-p.x, p.y) * built.house.unit + shift) * MM;
                    wanted.push((place(at), place(to)));
                    at = to;
                }
            }
        }
        let drawn = draw(&run, &scene, Wanted::Plan(1), &[]);
        let axes: Vec<_> = drawn
            .iter()
            .filter(|d| d.role == "axis" && d.view == "plan-1")
            .collect();
        if axes.len() != wanted.len() {
            return vec![format!(
                "{}: {} bays, not {}",
                stem(&paths[index]),
                axes.len(),
                wanted.len()
            )];
        }
        let shift = axes[0].rings[0][0] - wanted[0].0;
        let off = |(axis, (p, q)): (&&Drawn, &(DVec2, DVec2))| {
            let line = &axis.rings[0];
            (line[0] - shift - *p)
                .length()
                .max((line[1] - shift - *q).length())
        };
        let worst = axes.iter().zip(&wanted).map(off).fold(0.0, f64::max);
        let named = axes
            .iter()
            .all(|a| a.code.as_ref().is_none_or(|c| !c.is_empty()));
        match worst < 0.01 && named {
            true => vec![],
            false => vec![format!(
                "{}: bays are off by {worst} mm",
                stem(&paths[index])
            )],
        }
    });
    assert_none(&findings);
}

#[test]
fn elevations_are_as_high_and_wide_as_the_model() {
    for name in ["examples/machiya.hsd", "examples/shrine.hsd"] {
        let run = compile_file(std::path::Path::new(name));
        let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Flat);
        let corners: Vec<DVec3> = triangles(&run, &scene)
            .into_iter()
            .flatten()
            .flatten()
            .collect();
        let extent = |axis: DVec3| {
            let along = corners.iter().map(|c| axis.dot(*c));
            along.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)))
        };
        for side in drawing::Elevation::ALL {
            let drawn = draw(&run, &scene, Wanted::Elevation(side), &[]);
            let seen: Vec<DVec2> = drawn
                .iter()
                .filter(|d| d.role == "seen")
                .flat_map(|d| d.rings.iter().flatten())
                .copied()
                .collect();
            let ground = drawn
                .iter()
                .find(|d| d.role == "ground")
                .expect("stands on the ground");
            let high = seen.iter().map(|p| p.y).fold(f64::MIN, f64::max) - ground.rings[0][0].y;
            let low = seen.iter().map(|p| p.y).fold(f64::MAX, f64::min) - ground.rings[0][0].y;
            let wide = seen.iter().map(|p| p.x).fold(f64::MIN, f64::max)
                - seen.iter().map(|p| p.x).fold(f64::MAX, f64::min);
            let level = matches!(side, drawing::Elevation::Front | drawing::Elevation::Back);
            let (from, to) = extent(if level { DVec3::X } else { DVec3::Y });
            assert!(
                (high / MM - extent(DVec3::Z).1).abs() < 0.05,
                "{name} {side:?}: {high}"
            );
            assert!(
                (wide / MM - (to - from)).abs() < 0.05,
                "{name} {side:?}: {wide}"
            );
            assert!(low > -0.01, "{name} {side:?}: {low} mm below the ground");
        }
    }
}

/// A low house, and a high one behind the middle of it, or one of them alone.
fn pair(near: bool, far: bool) -> String {
    let house = |(x, y): (f64, f64), height: f64, wide: usize| {
        let front = "<Part code=\"KSK\"/>".repeat(wide);
        let side = "<Part code=\"KSK\"/>".repeat(2);
        format!(
            "<House x=\"{x}\" y=\"{y}\"><Storey height=\"{height}\"><Row>{front}</Row><Row>{side}</Row><Row>{front}</Row>\
             <Row>{side}</Row></Storey><Roofs mode=\"explicit\"/></House>"
        )
    };
    let all = [
        (near, house((0.0, 0.0), 8.0, 8)),
        (far, house((BEHIND - 4.0 * 3.0 * SHAKU, 20.0), 16.0, 4)),
    ];
    let chosen = all.into_iter().filter(|(there, _)| *there);
    chosen.map(|(_, text)| text).collect()
}

/// How far the left end of the far house is to the right of that of the near one, metres.
const BEHIND: f64 = 1.6;

/// The lines of a front, each once; relative to the ground and the left end of the view.
fn lines_of_front(text: &str) -> BTreeSet<[i64; 4]> {
    let run = compile("pair.hsd", format!("<Houses>{text}</Houses>").as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Everything);
    let drawn = draw(
        &run,
        &scene,
        Wanted::Elevation(drawing::Elevation::Front),
        &[],
    );
    let ground = drawn
        .iter()
        .find(|d| d.role == "ground")
        .expect("stands on the ground")
        .rings[0][0];
    let seen = drawn
        .iter()
        .filter(|d| d.role == "seen")
        .flat_map(|d| &d.rings);
    let fifths = |x: f64| (x * 5.0).round() as i64;
    seen.map(|l| {
        [
            l[0].x - ground.x,
            l[0].y - ground.y,
            l[1].x - ground.x,
            l[1].y - ground.y,
        ]
        .map(fifths)
    })
    .collect()
}

#[test]
fn what_one_house_hides_of_another_is_not_drawn() {
    let (near, far, both) = (
        lines_of_front(&pair(true, false)),
        lines_of_front(&pair(false, true)),
        lines_of_front(&pair(true, true)),
    );
    let shift = (BEHIND * MM * 5.0) as i64;
    let shifted = far.iter().map(|l| [l[0] + shift, l[1], l[2] + shift, l[3]]);
    let far: BTreeSet<[i64; 4]> = shifted.collect();
    // Above the near house stands what one sees of the far one alone.
    let top = near
        .iter()
        .flat_map(|l| [l[1], l[3]])
        .max()
        .expect("has lines");
    let below = |lines: &BTreeSet<[i64; 4]>| -> BTreeSet<[i64; 4]> {
        lines
            .iter()
            .filter(|l| l[1].max(l[3]) < top - 2)
            .copied()
            .collect()
    };
    let above = |lines: &BTreeSet<[i64; 4]>| -> BTreeSet<[i64; 4]> {
        lines
            .iter()
            .filter(|l| l[1].min(l[3]) > top + 2)
            .copied()
            .collect()
    };
    let (few, many) = (below(&near).len(), above(&far).len());
    assert!(few > 1 && many > 1, "{few} below, {many} above");
    // What is partly covered ends where the near house does.
    let across = |l: &&[i64; 4]| l[1].min(l[3]) < top - 2 && l[1].max(l[3]) > top + 2;
    assert!(far.iter().any(|l| across(&l)));
    assert_eq!(both.iter().find(across), None);
    assert_eq!(below(&both), below(&near));
    assert_eq!(above(&both), above(&far));
}

/// All views of an example on a sheet.
fn sheet_of(name: &str, paper: Option<Paper>, scale: u32) -> Option<Sheet> {
    let run = compile_file(std::path::Path::new(name));
    let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Flat);
    let subject = Subject::new(&run.building, |_| true, &scene, &run.catalog);
    let settings = Settings {
        scale,
        sections: Plane::middle(&subject),
        ..settings()
    };
    let rows = drawing::views(&subject, &Wanted::ALL, &settings);
    drawing::on_paper(&rows, paper, &settings)
}

#[test]
fn views_on_a_sheet_do_not_overlap_and_stay_inside() {
    for (name, paper) in [
        ("examples/machiya.hsd", Paper::A3),
        ("examples/plot.hsd", Paper::A2),
    ] {
        let sheet = sheet_of(name, Some(paper), 200).expect("there is room");
        let bounds: Vec<_> = sheet.views.iter().map(|v| (&v.name, v.bounds())).collect();
        let (frame, views) = bounds.split_last().expect("has a frame");
        for (k, (name, one)) in views.iter().enumerate() {
            assert!(
                one.low.cmpge(frame.1.low).all() && one.high.cmple(frame.1.high).all(),
                "{name}"
            );
            for (other_name, other) in &views[..k] {
                let apart = one.low.cmpge(other.high).any() || other.low.cmpge(one.high).any();
                assert!(apart, "{name} over {other_name}");
            }
        }
    }
    assert!(sheet_of("examples/machiya.hsd", Some(Paper::A4), 20).is_none());
}
