//! Walls and parts in triangles: closed, outward, inside their bays, counted, shared.

use glam::{DVec2, Vec3, dvec2};
use hsd::ast::{CodeText, RoofKind, RoofShape, StoreyKind};
use hsd::building::{
    Building, Ceiling, Face, Finish, House, HouseRoofs, Ring, Roof, Shell, Solid, Storey, Wall,
};
use hsd::catalog::{Catalog, PartId};
use hsd::geometry::SHAKU;
use hsd::program::{Content, Picture, PictureId, Roofs, Split, Unit};
use hsd::scene::{Image, Kind, Mesh, Node, Scene};
use hsd::source::Span;
use hsd::tessellate::tessellate;
use std::collections::BTreeMap;

const UNIT: f64 = 3.0 * SHAKU;

fn span() -> Span {
    Span::default()
}

fn id(code: &str) -> PartId {
    let found = Catalog::builtin().find(&CodeText::new(code));
    found.unwrap_or_else(|| panic!("no part {code:?}"))
}

fn unit(content: Content, width: f64) -> Unit {
    Unit {
        span: span(),
        width,
        content,
        height: None,
        reflection: None,
    }
}

fn part(code: &str) -> Unit {
    let width = Catalog::builtin().part(id(code)).width();
    let content = if code.trim().is_empty() {
        Content::Void
    } else {
        Content::Part(id(code))
    };
    unit(content, width)
}

/// The units of rows of codes of five columns.
fn rows(rows: &[&str]) -> Vec<Vec<Unit>> {
    let row = |row: &&str| {
        let codes = row.as_bytes().chunks(5);
        codes
            .map(|c| part(std::str::from_utf8(c).expect("ascii")))
            .collect()
    };
    rows.iter().map(row).collect()
}

/// Walls of a walk with right turns.
fn walls(rows: Vec<Vec<Unit>>) -> Vec<Wall> {
    turned(rows, &[90.0; 4])
}

fn turned(rows: Vec<Vec<Unit>>, turns: &[f64]) -> Vec<Wall> {
    let mut at = DVec2::ZERO;
    let mut angle = 0.0_f64;
    let mut walls = Vec::new();
    for (i, units) in rows.into_iter().enumerate() {
        let length: f64 = units.iter().map(|u| u.width).sum();
        let direction = hsd::geometry::Heading::new(angle).vector();
        let to = at + direction * length;
        walls.push(Wall {
            span: span(),
            facade: i as u32 + 1,
            from: at,
            to,
            direction,
            units,
            reflection: true,
        });
        at = to;
        angle += turns[i % turns.len()];
    }
    walls
}

fn storey(number: u32, z0: f64, height: f64, walls: Vec<Wall>) -> Storey {
    Storey {
        span: span(),
        number,
        kind: StoreyKind::Storey,
        z0,
        z1: z0 + height,
        rings: vec![Ring {
            span: span(),
            hole: false,
            closed: true,
            walls,
        }],
    }
}

fn building(storeys: Vec<Storey>) -> Building {
    let house = House {
        span: span(),
        name: "shop".into(),
        origin: [1.0, 2.0, 3.0],
        azimuth: 180.0,
        unit: UNIT,
        street: false,
        storeys,
        roofs: Roofs::default(),
    };
    Building {
        shell: Shell {
            houses: vec![house],
            pictures: Vec::new(),
        },
        roofs: vec![HouseRoofs::default()],
    }
}

fn scene(building: &Building) -> Scene {
    let scene = tessellate(building, Catalog::builtin());
    for mesh in &scene.meshes {
        sound(mesh);
    }
    scene
}

/// One storey of nine shaku with these rows.
fn simple(codes: &[&str]) -> Building {
    building(vec![storey(1, 0.0, 9.0 * SHAKU, walls(rows(codes)))])
}

/// The mesh of a part alone in its wall.
fn mesh_of(code: &str, height: f64) -> Mesh {
    let building = building(vec![storey(1, 0.0, height, walls(vec![vec![part(code)]]))]);
    let scene = scene(&building);
    let node = scene
        .nodes
        .iter()
        .find(|n| n.kind == Kind::Part)
        .expect("a part");
    scene.meshes[node.mesh.expect("a mesh").0 as usize].clone()
}

type Corner = [i64; 3];

fn key(p: [f32; 3]) -> Corner {
    p.map(|x| (f64::from(x) * 1e6).round() as i64)
}

/// Every triangle as three points.
fn triangles(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    let triangles = mesh.primitives.iter().flat_map(|p| {
        let at = |i: &u32| p.positions[*i as usize];
        p.indices
            .chunks(3)
            .map(move |t| [at(&t[0]), at(&t[1]), at(&t[2])])
    });
    triangles.collect()
}

/// Bodies that hang together by their corners: their triangles.
fn bodies(mesh: &Mesh) -> Vec<Vec<[[f32; 3]; 3]>> {
    let triangles = triangles(mesh);
    let mut parent: BTreeMap<Corner, Corner> = BTreeMap::new();
    fn root(parent: &BTreeMap<Corner, Corner>, mut c: Corner) -> Corner {
        while parent[&c] != c {
            c = parent[&c];
        }
        c
    }
    for t in &triangles {
        for p in t {
            parent.entry(key(*p)).or_insert(key(*p));
        }
        for p in &t[1..] {
            let (a, b) = (root(&parent, key(t[0])), root(&parent, key(*p)));
            parent.insert(a, b);
        }
    }
    let mut bodies: BTreeMap<Corner, Vec<[[f32; 3]; 3]>> = BTreeMap::new();
    for t in triangles {
        bodies.entry(root(&parent, key(t[0]))).or_default().push(t);
    }
    bodies.into_values().collect()
}

/// Closed, outward, no sliver, no NaN, unit normals that agree with the winding.
fn sound(mesh: &Mesh) {
    let name = &mesh.name;
    for p in &mesh.primitives {
        assert_eq!(p.positions.len(), p.normals.len());
        assert_eq!(p.positions.len(), p.uvs.len());
        assert!(p.indices.len().is_multiple_of(3));
        let numbers = p.positions.iter().chain(&p.normals).flatten();
        assert!(
            numbers.chain(p.uvs.iter().flatten()).all(|x| x.is_finite()),
            "{name}"
        );
        for t in p.indices.chunks(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| Vec3::from(p.positions[i as usize]));
            let cross = (b - a).cross(c - a);
            assert!(cross.length() > 1e-8, "{name}: sliver {a} {b} {c}");
            let normal = Vec3::from(p.normals[t[0] as usize]);
            assert!((normal.length() - 1.0).abs() < 1e-4, "{name}");
            assert!(
                cross.normalize().dot(normal) > 0.99,
                "{name}: winding at {a}"
            );
        }
    }
    for body in bodies(mesh) {
        let mut edges: BTreeMap<(Corner, Corner), i32> = BTreeMap::new();
        let mut volume = 0.0;
        for t in &body {
            let [a, b, c] = t.map(Vec3::from);
            volume += f64::from(a.dot(b.cross(c)));
            for i in 0..3 {
                let (p, q) = (key(t[i]), key(t[(i + 1) % 3]));
                *edges.entry((p, q)).or_default() += 1;
                *edges.entry((q, p)).or_default() -= 1;
            }
        }
        assert!(
            edges.values().all(|n| *n == 0),
            "{name}: open at {:?}",
            body[0]
        );
        assert!(volume > 0.0, "{name}: inside out");
    }
}

/// Smallest and largest corner.
fn bounds<'a>(triangles: impl IntoIterator<Item = &'a [[f32; 3]; 3]>) -> (Vec3, Vec3) {
    let points = triangles.into_iter().flatten().map(|p| Vec3::from(*p));
    points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| {
        (lo.min(p), hi.max(p))
    })
}

#[test]
fn every_part_is_sound_and_in_its_bay() {
    for height in [9.0, 5.0, 7.0, 11.55, 2.0] {
        let height = height * SHAKU;
        for part in Catalog::builtin()
            .parts()
            .iter()
            .filter(|p| p.class() != ' ')
        {
            let mesh = mesh_of(part.code(), height);
            let (lo, hi) = bounds(&triangles(&mesh));
            let code = part.code();
            assert!(!mesh.primitives.is_empty(), "{code} at {height}");
            let side = if part.width() > 0.0 { 1e-4 } else { 0.3 };
            assert!(lo.x > -side as f32, "{code}: x from {}", lo.x);
            assert!(
                f64::from(hi.x) < part.width() * UNIT + side,
                "{code}: x to {}",
                hi.x
            );
            assert!(lo.z > -1e-4, "{code}: z from {}", lo.z);
            assert!(
                f64::from(hi.z) < height + 1e-4,
                "{code}: z to {} of {height}",
                hi.z
            );
        }
    }
}

#[test]
fn parts_are_unlike() {
    let parts = Catalog::builtin().parts().iter();
    let mut seen: Vec<(String, Mesh)> = Vec::new();
    for part in parts.filter(|p| p.class() != ' ') {
        let mesh = mesh_of(part.code(), 9.0 * SHAKU);
        for (other, shape) in &seen {
            // Party walls are built like plaster walls.
            let like = part.code() == "APW  " && other == "KSK  ";
            let painted = ["KSKO ", "KSKK ", "KTU  ", "KJU  ", "ASH  "];
            if !like && !painted.contains(&part.code()) && !painted.contains(&other.as_str()) {
                assert_ne!(
                    triangles(shape),
                    triangles(&mesh),
                    "{} = {other}",
                    part.code()
                );
            }
        }
        seen.push((part.code().to_owned(), mesh));
    }
}

/// Bodies whose outermost plane lies so many millimetres outside the centre line.
fn bodies_at(mesh: &Mesh, front: f64) -> Vec<(Vec3, Vec3)> {
    let all = bodies(mesh).into_iter().map(|b| bounds(&b));
    all.filter(|(lo, _)| (f64::from(lo.y) + front / 1000.0).abs() < 1e-4)
        .collect()
}

#[test]
fn bars_are_counted() {
    for (code, front, count) in [
        ("GSB", 54.0, 27),
        ("GIT", 54.0, 20),
        ("GOR", 54.0, 20),
        ("GGO", 54.0, 18),
        ("GKO", 56.0, 6),
        ("GSA", 56.0, 6),
        ("GSU", 50.0, 9),
        ("GFU", 54.0, 10),
        ("GSI", 54.0, 21),
        ("GOY", 54.0, 18),
        ("GDE", 414.0, 21),
        ("GKK h", 54.0, 10),
        ("MRE", 52.0, 13),
        ("MMU", 92.0, 6),
        ("MMU 2", 92.0, 12),
        ("MMS 2", 335.0, 13),
        ("AIN", 527.0, 25),
    ] {
        let found = bodies_at(&mesh_of(code, 9.0 * SHAKU), front).len();
        assert_eq!(found, count, "{code}");
    }
}

#[test]
fn children_are_cut() {
    let mesh = mesh_of("GIT", 9.0 * SHAKU);
    let bars = bodies_at(&mesh, 54.0);
    let top = bars.iter().map(|(_, hi)| hi.z).fold(0.0, f32::max);
    let long = bars
        .iter()
        .filter(|(_, hi)| (hi.z - top).abs() < 1e-4)
        .count();
    assert_eq!((long, bars.len() - long), (5, 15));
    let width = |i: usize| f64::from(bars[i].1.x - bars[i].0.x);
    let widths: Vec<f64> = (0..bars.len()).map(width).collect();
    assert_eq!(
        widths.iter().filter(|w| (**w - 0.030).abs() < 1e-4).count(),
        5
    );
    assert_eq!(
        widths.iter().filter(|w| (**w - 0.018).abs() < 1e-4).count(),
        15
    );
}

#[test]
fn narrow_bays_keep_the_ratio_of_bar_to_gap() {
    let bars = bodies_at(&mesh_of("GSI", 9.0 * SHAKU), 54.0);
    let mut ends: Vec<(f32, f32)> = bars.iter().map(|(lo, hi)| (lo.x, hi.x)).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let bar = ends[0].1 - ends[0].0;
    let gap = ends[1].0 - ends[0].1;
    assert!((gap / bar - 23.0 / 20.0).abs() < 1e-3, "{bar} {gap}");
}

fn named<'a>(scene: &'a Scene, name: &str) -> &'a Node {
    let found = scene.nodes.iter().find(|n| n.name == name);
    found.unwrap_or_else(|| panic!("no node {name:?}"))
}

fn count(scene: &Scene, kind: Kind) -> usize {
    scene.nodes.iter().filter(|n| n.kind == kind).count()
}

#[test]
fn the_tree_of_a_house() {
    let scene = scene(&simple(&[
        "GSI  GDE 2KSK  ",
        "APW  APW  ",
        "KTU  TIT 2KTU  ",
        "APW  APW  ",
    ]));
    let house = &scene.nodes[0];
    assert_eq!(
        (house.name.as_str(), house.kind, house.parent),
        ("house shop", Kind::House, None)
    );
    assert_eq!((house.at.x, house.turn), (1.0, DVec2::X));
    assert_eq!(named(&scene, "storey 1").parent.expect("a house").0, 0);
    let facade = named(&scene, "facade 2");
    assert!((facade.at.x + 4.0 * UNIT).abs() < 1e-9 && facade.at.y.abs() < 1e-9);
    // The second wall looks west: its right is the south.
    assert_eq!(facade.turn, dvec2(0.0, -1.0));
    let part = named(&scene, "GDE 2 2");
    assert_eq!(part.code.as_deref(), Some("GDE 2"));
    assert_eq!(part.storey, Some(1));
    assert!((part.at.x + 3.0 * UNIT).abs() < 1e-9);
    assert_eq!(count(&scene, Kind::Facade), 4);
    assert_eq!(count(&scene, Kind::Part), 10);
    // Four corners, and borders: 2 + 1 + 2 + 1; none inside the two-unit part.
    assert_eq!(count(&scene, Kind::Post), 10);
    for (i, node) in scene.nodes.iter().enumerate() {
        assert!(
            node.parent.is_none_or(|p| (p.0 as usize) < i),
            "parents first"
        );
    }
    assert_eq!(scene.stats().nodes, scene.nodes.len());
    assert!(scene.stats().triangles > scene.stats().unique_triangles);
}

#[test]
fn equal_parts_share_a_mesh() {
    let scene = scene(&simple(&[
        "GSI  KSK  GSI  KTU  GSI  ",
        "KSK  ",
        "KSK  KSK  KSK  KSK  KSK  ",
        "KSK  ",
    ]));
    let mesh = |name: &str| named(&scene, name).mesh.expect("a mesh");
    // The nearest wall of two is KTU, on the left of the third and on the right of the fifth.
    assert_eq!(mesh("GSI 3"), mesh("GSI 5"));
    assert_ne!(mesh("GSI 1"), mesh("GSI 5"));
    let walls = scene
        .nodes
        .iter()
        .filter(|n| n.code.as_deref() == Some("KSK  "));
    let mut meshes: Vec<u32> = walls.map(|n| n.mesh.expect("a mesh").0).collect();
    meshes.dedup();
    assert_eq!(meshes.len(), 1);
}

#[test]
fn posts_show_where_walls_show_them() {
    let posts = |codes: &[&str]| count(&scene(&simple(codes)), Kind::Post);
    let okabe = "KSKO KSKO ";
    assert_eq!(posts(&[okabe, okabe, okabe, okabe]), 0);
    let modern = "NGC  NAP  ";
    assert_eq!(posts(&[modern, modern, modern, modern]), 0);
    // A bay between okabe walls has a post at each side.
    assert_eq!(
        posts(&["KSKO GSI  KSKO ", okabe, "KSKO KSKO KSKO ", okabe]),
        2
    );
    // A post of one's own replaces the drawn one.
    assert_eq!(
        posts(&["KSK  HHA 0KSK  ", "KSK  ", "KSK  KSK  ", "KSK  "]),
        5
    );
    assert_eq!(posts(&["KSK  KSK  ", "KSK  ", "KSK  KSK  ", "KSK  "]), 6);
    // Voids have none of their own: the corners of KSK and its left side remain.
    assert_eq!(
        posts(&["KSK       KSKO ", okabe, "KSKO KSKO KSKO ", okabe]),
        2
    );
}

#[test]
fn no_two_posts_in_one_place() {
    let scene = scene(&simple(&[
        "KSK  GSI  TIT 2",
        "KSK  KSK  ",
        "KSK  KSK  KSK  KSK  ",
        "KSK  KSK  ",
    ]));
    let mut places: Vec<[i64; 2]> = Vec::new();
    for node in scene.nodes.iter().filter(|n| n.kind == Kind::Post) {
        let facade = &scene.nodes[node.parent.expect("a facade").0 as usize];
        let at = facade.at.truncate() + facade.turn.rotate(node.at.truncate());
        places.push([at.x, at.y].map(|x| (x * 1000.0).round() as i64));
    }
    let n = places.len();
    places.sort();
    places.dedup();
    assert_eq!(places.len(), n);
    assert_eq!(n, 11);
}

#[test]
fn corners_without_posts_are_filled() {
    let square = scene(&simple(&["NAP  ", "NAP  ", "NAP  ", "NAP  "]));
    let fillers = square.nodes.iter().filter(|n| n.name == "corner");
    assert_eq!(fillers.count(), 4);
    let corner = named(&square, "corner").mesh.expect("a mesh");
    let (lo, hi) = bounds(&triangles(&square.meshes[corner.0 as usize]));
    assert!(
        (lo.y + 0.075).abs() < 1e-5 && (hi.x - 0.075).abs() < 1e-5,
        "{lo} {hi}"
    );
    // A round tower of 24 facades.
    let ring = vec![vec![part("NGC")]; 24];
    let tower = building(vec![storey(1, 0.0, 3.5, turned(ring, &[15.0]))]);
    let tower = scene(&tower);
    assert_eq!(
        tower.nodes.iter().filter(|n| n.name == "corner").count(),
        24
    );
}

#[test]
fn the_azimuth_turns_the_house() {
    let mut building = simple(&["KSK  ", "KSK  ", "KSK  ", "KSK  "]);
    for (azimuth, normal) in [
        (180.0, dvec2(0.0, -1.0)),
        (270.0, dvec2(-1.0, 0.0)),
        (0.0, dvec2(0.0, 1.0)),
        (90.0, dvec2(1.0, 0.0)),
    ] {
        building.shell.houses[0].azimuth = azimuth;
        let turn = scene(&building).nodes[0].turn;
        assert_eq!(turn.rotate(dvec2(0.0, -1.0)), normal, "{azimuth}");
    }
}

#[test]
fn splits_and_pictures() {
    let upper = vec![part("NWI"), part("NWI")];
    let split = Split {
        ratio: 0.6,
        upper,
        lower: vec![part("NSP")],
    };
    let mut picture = unit(Content::Picture(PictureId(0)), 1.5);
    picture.reflection = Some(0.25);
    let row = vec![
        unit(Content::Split(Box::new(split)), 2.0),
        picture,
        part("NAP"),
    ];
    let mut building = building(vec![storey(1, 0.0, 3.5, walls(vec![row]))]);
    building.shell.pictures.push(Picture {
        name: "f1f1f1".into(),
        path: "f1f1f1.png".into(),
        size: (64, 128),
    });
    let scene = scene(&building);
    let nodes: Vec<&Node> = scene
        .nodes
        .iter()
        .filter(|n| n.kind == Kind::Part)
        .collect();
    let names: Vec<&str> = nodes.iter().map(|n| n.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "NSP lower 1",
            "NWI upper 1",
            "NWI upper 1",
            "picture 2",
            "NAP 3"
        ]
    );
    assert!((nodes[1].at.z - 1.4).abs() < 1e-9);
    let mesh = &scene.meshes[nodes[3].mesh.expect("a mesh").0 as usize];
    let front = &mesh.primitives[0];
    let material = &scene.materials[front.material.0 as usize];
    assert_eq!(
        (&material.image, material.reflection),
        (&Image::Picture(0), Some(0.25))
    );
    assert_eq!(front.uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert_eq!(scene.pictures, ["f1f1f1.png"]);
    let (lo, hi) = bounds(&triangles(
        &scene.meshes[nodes[0].mesh.expect("a mesh").0 as usize],
    ));
    assert!((f64::from(hi.x - lo.x) - 2.0 * UNIT).abs() < 1e-4);
}

#[test]
fn glass_mirrors_where_its_facade_does() {
    let shares = |reflection: bool| {
        let mut building = simple(&["NAS 2"]);
        building.shell.houses[0].storeys[0].rings[0].walls[0].reflection = reflection;
        let scene = scene(&building);
        let glass: Vec<f32> = scene
            .materials
            .iter()
            .filter_map(|m| m.reflection)
            .collect();
        glass
    };
    assert_eq!(shares(true), [0.3]);
    assert_eq!(shares(false), [0.0]);
}

#[test]
fn low_walls_under_a_lean_to() {
    let height = 9.0 * SHAKU;
    let mut building = simple(&["KSK  KSK  ", "GSI  KSK  ", "KSK  KSK  ", "KSK  KSK  "]);
    building.roofs[0].ceilings.push(Ceiling {
        storey: 1,
        rect: [0.0, 0.0, 2.0, 2.0],
        z: height,
        slope: dvec2(0.0, -0.3),
    });
    let scene = scene(&building);
    let top = |name: &str| {
        let facade = scene
            .nodes
            .iter()
            .position(|n| n.name == name)
            .expect("a facade");
        let here = |n: &&Node| n.parent.is_some_and(|p| p.0 as usize == facade);
        let nodes = scene
            .nodes
            .iter()
            .filter(here)
            .filter_map(|n| Some((n, n.mesh?)));
        let tops =
            nodes.map(|(n, m)| n.at.z as f32 + bounds(&triangles(&scene.meshes[m.0 as usize])).1.z);
        tops.fold(0.0, f32::max)
    };
    assert!((f64::from(top("facade 1")) - height).abs() < 2e-3);
    assert!((f64::from(top("facade 2")) - height).abs() < 2e-3);
    assert!((f64::from(top("facade 3")) - (height - 0.6)).abs() < 2e-3);
    assert_eq!(
        scene
            .nodes
            .iter()
            .filter(|n| n.name.starts_with("wedge"))
            .count(),
        4
    );
}

/// A prism whose cross-section is not convex, as a flat roof of an L.
fn flat_roof() -> Solid {
    let plan = [
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 2.0),
        (2.0, 2.0),
        (2.0, 4.0),
        (1.0, 4.0),
        (0.0, 4.0),
    ];
    let n = plan.len() as u32;
    let at = |z: f64| plan.iter().map(move |(x, y)| glam::dvec3(*x, *y, z));
    let mut faces = vec![
        Face {
            corners: (0..n).rev().collect(),
            finish: Finish::Soffit,
        },
        Face {
            corners: (n..2 * n).collect(),
            finish: Finish::Covering(RoofKind::Metal),
        },
    ];
    for i in 0..n {
        let j = (i + 1) % n;
        faces.push(Face {
            corners: [i, j, n + j, n + i].into(),
            finish: Finish::Edge(RoofKind::Metal),
        });
    }
    Solid {
        points: at(3.0).chain(at(3.2)).collect(),
        faces,
    }
}

#[test]
fn roofs_become_one_mesh() {
    let mut building = simple(&["KSK  ", "KSK  ", "KSK  ", "KSK  "]);
    building.roofs[0].roofs.push(Roof {
        storey: 1,
        span: None,
        shape: RoofShape::Flat,
        kind: RoofKind::Metal,
        solids: vec![flat_roof()],
    });
    let scene = scene(&building);
    let roof = named(&scene, "roof 1");
    assert_eq!((roof.kind, roof.shape), (Kind::Roof, Some("RIK")));
    let mesh = &scene.meshes[roof.mesh.expect("a mesh").0 as usize];
    // Metal's edge has the covering's surface.
    assert_eq!(mesh.primitives.len(), 2);
    assert_eq!(triangles(mesh).len(), 2 * 5 + 7 * 2);
}

#[test]
fn courses_lie_level_and_run_up_the_slope() {
    let points = [
        (0.0, 0.0, 0.0),
        (3.0, 0.0, 0.0),
        (3.0, 4.0, 3.0),
        (0.0, 4.0, 3.0),
    ];
    let solid = Solid {
        points: points.map(|(x, y, z)| glam::dvec3(x, y, z)).to_vec(),
        faces: vec![Face {
            corners: [0, 1, 2, 3].into(),
            finish: Finish::Covering(RoofKind::Tiles),
        }],
    };
    let mut building = building(Vec::new());
    building.roofs[0].roofs.push(Roof {
        storey: 1,
        span: None,
        shape: RoofShape::LeanTo,
        kind: RoofKind::Tiles,
        solids: vec![solid],
    });
    let scene = tessellate(&building, Catalog::builtin());
    let slope = &scene.meshes[0].primitives[0];
    let close = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-5;
    assert!(
        close(slope.uvs[0], [0.0, 0.0]) && close(slope.uvs[2], [3.0, 5.0]),
        "{:?}",
        slope.uvs
    );
}

#[test]
fn every_surface_has_a_name_of_its_own() {
    let mut names: Vec<&str> = hsd::material::all().iter().map(|s| s.name).collect();
    let n = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), n);
    for name in [
        "cedar",
        "hinoki",
        "boards",
        "boards_dark",
        "bamboo",
        "paper",
        "plaster",
        "mortar",
        "earth",
        "stone",
        "kawara",
        "kawara_edge",
        "board_roof",
        "shingle",
        "bark",
        "thatch",
        "sheet_roof",
        "soffit",
    ] {
        assert_eq!(hsd::material::SurfaceId::named(name).surface().name, name);
    }
}

#[test]
fn every_picture_is_in_the_library() {
    for surface in hsd::material::all() {
        if let Some(picture) = surface.picture {
            assert!(hsd::texture::surface(picture).is_some(), "{picture}");
        }
    }
}
