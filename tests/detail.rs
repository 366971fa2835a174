//! Levels of detail: the same house with less and less shape, never another outline.

use crate::support::{
    compile, compile_changed, compile_file, details_in_turn, root, stem, texts_in_turn, thorough,
};
use glam::{DVec3, dvec3};
use hsd::backend::{flat, sound};
use hsd::driver;
use hsd::scene::{Detail, Image, Kind, Scene};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// How far the outlines of two details may lie apart, metres: flat parts lie in the plane of their wall, and
/// gutters, studs and the like vanish.
const OUTLINE: f64 = 0.35;

/// How far ridges with their end tiles and finials stand over a roof at most, metres.
const RIDGE: f64 = 2.0;

/// The scenes of an example at all details.
fn scenes(run: &crate::support::Run) -> [Scene; 4] {
    Detail::ALL.map(|detail| driver::scene(&run.building, &run.catalog, detail))
}

/// Triangles on the screen.
fn triangles(scene: &Scene) -> usize {
    let shown = scene.nodes.iter();
    let primitives = shown.flat_map(|node| flat::primitives(scene.whole(), node));
    primitives.map(|p| p.indices.len() / 3).sum()
}

/// Least and largest coordinates of what is shown.
fn extent(scene: &Scene) -> (DVec3, DVec3) {
    let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (node, place) in scene.nodes.iter().zip(flat::places(scene.whole())) {
        for primitive in flat::primitives(scene.whole(), node) {
            for p in &primitive.positions {
                let p = place.point(flat::point(*p));
                (lo, hi) = (lo.min(p), hi.max(p));
            }
        }
    }
    (lo, hi)
}

#[test]
fn every_example_is_sound_at_every_detail() {
    for (index, path) in texts_in_turn("examples", 1).into_iter().enumerate() {
        let run = compile_file(&path);
        for &detail in details_in_turn(index) {
            let scene = driver::scene(&run.building, &run.catalog, detail);
            let name = stem(&path);
            assert_eq!(sound::flaws(scene.whole()).count(), 0, "{name} {detail:?}");
            for mesh in &scene.meshes {
                for p in &mesh.primitives {
                    assert!(slivers(p) == 0, "{name} {detail:?} {}", mesh.name);
                    assert!(crossed(p) == 0, "{name} {detail:?} {}", mesh.name);
                }
            }
        }
    }
}

/// Boards with pictures hang where they hang at full detail; beside them one sees the wall.
#[test]
fn boards_keep_their_size_from_afar() {
    let run = compile_file(&root().join("examples/tea-shop.hsd"));
    let [body, .., all] = scenes(&run);
    let places = [body, all].map(|scene| {
        let mut found = vec![];
        for (node, place) in scene.nodes.iter().zip(flat::places(scene.whole())) {
            for primitive in flat::primitives(scene.whole(), node) {
                let material = &scene.materials[primitive.material.0 as usize];
                if !matches!(material.image, Image::Picture(_)) {
                    continue;
                }
                let points = primitive.positions.iter();
                for corners in points.collect::<Vec<_>>().chunks(4) {
                    let at = corners.iter().map(|p| place.point(flat::point(**p)));
                    let at: Vec<DVec3> = at.collect();
                    let lo = at.iter().copied().reduce(DVec3::min).expect("corners");
                    let hi = at.iter().copied().reduce(DVec3::max).expect("corners");
                    found.push((lo, hi));
                }
            }
        }
        found.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        found
    });
    let [from_afar, near] = places;
    assert_eq!((from_afar.len(), near.len()), (3, 3));
    for (a, b) in from_afar.iter().zip(&near) {
        for (p, q) in [(a.0, b.0), (a.1, b.1)] {
            let off = (p - q) * dvec3(1.0, 0.0, 1.0);
            assert!(off.length() < 0.03, "{p} instead of {q}");
        }
    }
}

/// A wall with a board on it is as large as one without: what is cut out behind the board is the board.
#[test]
fn boards_leave_the_wall_whole_from_afar() {
    let area = |unit: &str| {
        let path = root().join("examples/tea-shop.hsd");
        let side = format!("<Row>{unit}KSK  KSK  </Row>");
        let text = format!(
            "<House><include href=\"tea-shop/parts.hsd\"/><Storey height=\"12\"><Row>KSK  KSK  KSK  </Row>{side}\
             <Row>KSK  KSK  KSK  </Row>{side}</Storey><Roofs mode=\"explicit\"><Roof kind=\"K\" shape=\"KIR\" ridge=\"X\" \
             height=\"12\" a0=\"0\" b0=\"0\" a1=\"3\" b1=\"3\" pitch=\"3\"/></Roofs></House>"
        );
        let run = compile_changed(
            &path,
            BTreeMap::from([("tea-shop.hsd".into(), text.into())]),
        );
        assert!(!run.has_errors(), "{}", run.short());
        let [body, ..] = scenes(&run);
        let mut sum = 0.0;
        for p in body.meshes.iter().flat_map(|m| &m.primitives) {
            for corners in p.indices.chunks_exact(3) {
                let at = |k: usize| flat::point(p.positions[corners[k] as usize]);
                let out = (at(1) - at(0)).cross(at(2) - at(0));
                if out.z.abs() < 0.01 * out.length() {
                    sum += out.length() / 2.0;
                }
            }
        }
        sum
    };
    let [plain, hung] = ["KSK  ", "<Part code=\"signboard\"/>"].map(area);
    assert!((plain - hung).abs() < 1e-3, "{hung} instead of {plain}");
}

/// Triangles without area.
fn slivers(p: &hsd::scene::Primitive) -> usize {
    let area = |t: &[u32]| normal(p, t).length();
    p.indices.chunks_exact(3).filter(|t| area(t) < 1e-9).count()
}

/// Triangles that look another way than their vertices say.
fn crossed(p: &hsd::scene::Primitive) -> usize {
    let told = |i: u32| flat::point(p.normals[i as usize]);
    let wrong = |t: &&[u32]| normal(p, t).dot(told(t[0])) <= 0.0;
    p.indices.chunks_exact(3).filter(wrong).count()
}

fn normal(p: &hsd::scene::Primitive, t: &[u32]) -> DVec3 {
    let [a, b, c] = [0, 1, 2].map(|k| flat::point(p.positions[t[k] as usize]));
    (b - a).cross(c - a)
}

#[test]
fn less_detail_has_fewer_triangles_and_the_same_outline() {
    let step = if thorough() { 1 } else { 2 };
    for path in texts_in_turn("examples", 2).into_iter().step_by(step) {
        let run = compile_file(&path);
        let all = scenes(&run);
        let counts = all.each_ref().map(triangles);
        let name = stem(&path);
        assert!(counts.is_sorted(), "{name}: {counts:?}");
        let (lo, hi) = extent(&all[3]);
        for (detail, scene) in Detail::ALL.into_iter().zip(&all).skip(1) {
            let (least, most) = extent(scene);
            let apart = (least - lo).abs().max((most - hi).abs());
            assert!(apart.max_element() < OUTLINE, "{name} {detail:?}: {apart}");
        }
        // Bodies leave out what stands before the walls and on the roofs, but keep their walls and roofs.
        let (least, most) = extent(&all[0]);
        let (foot, ridge) = ((least.z - lo.z).abs(), hi.z - most.z);
        assert!(foot < OUTLINE, "{name}: {foot}");
        assert!((-OUTLINE..RIDGE).contains(&ridge), "{name}: {ridge}");
    }
}

#[test]
fn pictures_of_parts_are_shared_and_only_made_where_they_show() {
    let text = "0 0\n9\n\n".to_owned() + &"GIT  KSK  \n".repeat(4);
    let run = compile("shop.hsd", text.as_bytes());
    let all = scenes(&run);
    assert!(all[3].baked.is_empty() && all[0].baked.is_empty());
    for scene in &all[1..3] {
        assert!(!scene.baked.is_empty());
        let baked = |m: &hsd::scene::Material| matches!(m.image, Image::Baked(_));
        assert!(scene.materials.iter().any(baked));
        let parts = scene.nodes.iter().filter(|n| n.kind == Kind::Part);
        let mut meshes: Vec<_> = parts.filter_map(|n| n.mesh).collect();
        meshes.sort();
        meshes.dedup();
        assert_eq!(meshes.len(), 2);
    }
}

#[test]
fn a_lattice_keeps_its_bars_as_a_picture() {
    // What stands behind an itoya lattice shows through: bars and gaps alternate along a level row of the picture.
    let run = compile("shop.hsd", b"0 0\n9\n\nGIT  \nGIT  \nGIT  \nGIT  \n");
    let scene = driver::scene(&run.building, &run.catalog, Detail::Flat);
    let page = image::load_from_memory(&scene.baked[0].color).expect("is a picture");
    let page = page.into_rgba8();
    let row: Vec<i32> = (0..110)
        .map(|x| {
            let p = page.get_pixel(4 + x, 150).0;
            i32::from(p[3] > 0) * (i32::from(p[0]) + i32::from(p[1]) + i32::from(p[2]))
        })
        .collect();
    let middle = row.iter().sum::<i32>() / row.len() as i32;
    let changes = row
        .windows(2)
        .filter(|w| (w[0] < middle) != (w[1] < middle))
        .count();
    assert!(changes >= 8, "{changes} changes in {row:?}");
}

#[test]
fn the_same_pictures_every_time() {
    let run = compile(
        "shop.hsd",
        b"0 0\n9\n\nGIT  TOD  \nKSM  KSK  \nGIT  MMU  \nKSK  NCW  \n",
    );
    let told = |scene: &Scene| {
        let mut out = String::new();
        for page in &scene.baked {
            let sum = |bytes: &[u8]| {
                bytes
                    .iter()
                    .fold(0_u64, |s, b| s.wrapping_mul(31) + u64::from(*b))
            };
            let _ = write!(
                out,
                "{} {} {} ",
                sum(&page.color),
                sum(&page.normal),
                sum(&page.orm)
            );
        }
        out
    };
    let once = driver::scene(&run.building, &run.catalog, Detail::Flat);
    let again = driver::scene(&run.building, &run.catalog, Detail::Flat);
    assert_eq!(told(&once), told(&again));
    assert!(!told(&once).is_empty());
}

#[test]
fn walls_of_a_body_meet_at_their_corners() {
    let run = compile(
        "box.hsd",
        b"0 0\n9\n\nKSKO KSKO \nKSKO \nKSKO KSKO \nKSKO \n",
    );
    let scene = driver::scene(&run.building, &run.catalog, Detail::Body);
    let mesh = scene.nodes[0].mesh.expect("the house shows its walls");
    let points = scene.meshes[mesh.0 as usize]
        .primitives
        .iter()
        .flat_map(|p| &p.positions);
    let mut corners: Vec<[i64; 3]> = points
        .map(|p| p.map(|x| (f64::from(x) * 1000.0).round() as i64))
        .collect();
    corners.sort_unstable();
    // Every corner of a wall belongs to two of them, and every corner of the roof to several faces.
    corners
        .chunk_by(|a, b| a == b)
        .for_each(|same| assert!(same.len() >= 2, "{same:?}"));
    let (lo, hi) = extent(&scene);
    assert!(hi.cmpgt(lo + dvec3(1.0, 0.5, 2.0)).all());
}

#[test]
fn a_wall_beside_a_lean_to_reaches_the_corner_up_to_the_eaves() {
    // One part takes the whole front, and the lean-to covers a quarter of it.
    let walls = [
        (4.0, ""),
        (3.0, ""),
        (3.0, "L"),
        (2.5, ""),
        (4.0, ""),
        (3.0, ""),
        (3.0, "L"),
        (2.5, ""),
    ];
    let row = |(width, turn): (f64, &str)| {
        format!("<Row turn=\"{turn}\"><Part code=\"KOB\" width=\"{width}\"/></Row>")
            .replace(" turn=\"\"", "")
    };
    let rows: String = walls.map(row).concat();
    let text = format!(
        "<Houses><House><Storey height=\"9.4\">{rows}</Storey><Roofs shape=\"YOS\" pitch=\"5.5\"/></House></Houses>"
    );
    let run = compile("offset.hsd", text.as_bytes());
    let scene = driver::scene(&run.building, &run.catalog, Detail::Body);
    let mesh = scene.nodes[0].mesh.expect("the house shows its walls");
    // The least x of the front between two heights.
    let left = |low: f32, high: f32| {
        let front = scene.meshes[mesh.0 as usize]
            .primitives
            .iter()
            .flat_map(|p| {
                let points = |t: &[u32]| [0, 1, 2].map(|k| p.positions[t[k] as usize]);
                p.indices.chunks(3).map(points).collect::<Vec<_>>()
            });
        let flat = |t: &[[f32; 3]; 3]| {
            t.iter()
                .all(|p| (p[1] - t[0][1]).abs() < 1e-4 && p[1].abs() < 0.15)
        };
        let within = |t: &[[f32; 3]; 3]| {
            let middle = t.iter().map(|p| p[2]).sum::<f32>() / 3.0;
            (low..high).contains(&middle)
        };
        let corners = front.filter(|t| flat(t) && within(t)).flatten();
        corners.map(|p| p[0]).fold(f32::MAX, f32::min)
    };
    let (below, above) = (left(0.3, 2.2), left(2.4, 2.84));
    assert!(
        below < -3.6 && (below - above).abs() < 1e-3,
        "{below} {above}"
    );
}

#[test]
fn a_plain_body_is_walls_and_a_roof() {
    for (shape, most) in [("KIR", 40), ("YOS", 32)] {
        let wall = |units: usize| "KSKO ".repeat(units) + "\n";
        let walls = [wall(8), wall(5), wall(8), wall(5)].concat();
        let text = format!("0 0\n9\n\n{walls}\nK X * {shape} 0 0 8 5\n");
        let run = compile("plain.hsd", text.as_bytes());
        let count = triangles(&driver::scene(&run.building, &run.catalog, Detail::Body));
        assert!(count <= most, "{shape}: {count}");
    }
}

#[test]
fn nothing_is_seen_through_glass_where_there_are_no_rooms() {
    let run = compile_file(&crate::support::root().join("examples/office.hsd"));
    for (detail, scene) in Detail::ALL.into_iter().zip(scenes(&run)).take(2) {
        let glass = scene.materials.iter().filter(|m| m.reflection.is_some());
        assert!(glass.clone().count() > 0, "{detail:?}");
        for material in glass {
            assert!(material.tint[3] == 1.0, "{detail:?}: {}", material.name);
        }
    }
}

#[test]
fn bodies_of_glass_look_like_glass() {
    let wall = "NGC  NGC  NGC  NGC  \n".repeat(4);
    let run = compile("tower.hsd", format!("0 0\n12\n\n{wall}").as_bytes());
    let scene = driver::scene(&run.building, &run.catalog, Detail::Body);
    let panes =
        |p: &&hsd::scene::Primitive| scene.materials[p.material.0 as usize].reflection.is_some();
    let shown = scene.meshes.iter().flat_map(|m| &m.primitives);
    assert!(shown.filter(panes).count() > 0);
}
