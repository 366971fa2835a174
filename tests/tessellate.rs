//! Walls and parts in triangles: closed, outward, inside their bays, counted, shared.

mod looks;
mod parts;
mod roofs;

use glam::{DVec2, DVec3, Vec3, dvec2};
use hsd::ast::{CodeText, Order, RoofKind, RoofShape, StoreyKind};
use hsd::building::{
    Building, Built, Ceiling, Face, Finish, House, HouseRoofs, Ring, Roof, Solid, Storey, Trim,
    Wall,
};
use hsd::catalog::PartId;
use hsd::geometry::SHAKU;
use hsd::program::{Content, Picture, PictureId, Roofs, Split, Unit};
use hsd::scene::{Detail, Image, Kind, Mesh, Node, Primitive, Scene};
use hsd::source::Span;
use hsd::tessellate::tessellate;
use std::collections::BTreeMap;
use std::sync::Arc;

const UNIT: f64 = 3.0 * SHAKU;

fn span() -> Span {
    Span::default()
}

fn id(code: &str) -> PartId {
    let found = hsd::parse::builtin().find(&CodeText::new(code));
    found.unwrap_or_else(|| panic!("no part {code:?}"))
}

fn unit(content: Content, width: f64) -> Unit {
    Unit {
        span: span(),
        width,
        content,
        height: None,
        reflection: None,
        picture: None,
    }
}

fn part(code: &str) -> Unit {
    let width = hsd::parse::builtin().part(id(code)).width();
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
        order: Order::default(),
        rings: vec![Ring {
            span: span(),
            hole: false,
            closed: true,
            inner: false,
            walls,
        }],
        rooms: vec![],
        fixtures: vec![],
    }
}

fn building(storeys: Vec<Storey>) -> Building {
    let house = House {
        span: span(),
        name: "shop".into(),
        variant: None,
        placed: None,
        origin: [1.0, 2.0, 3.0],
        azimuth: 180.0,
        unit: UNIT,
        street: false,
        age: None,
        storeys,
        raised: 0.0,
        plinth: 0.0,
        platform: None,
        finials: vec![],
        puts: vec![],
        grounds: vec![],
        outdoors: None,
        roofs: Roofs::default().into(),
    };
    Building {
        houses: vec![Built {
            house,
            roofs: Arc::new(HouseRoofs::default()),
            fittings: vec![],
            rooms: vec![],
            fixtures: vec![],
        }],
        images: vec![],
    }
}

/// The roofs of the only house.
fn roofs_of(building: &mut Building) -> &mut HouseRoofs {
    Arc::make_mut(&mut building.houses[0].roofs)
}

fn scene(building: &Building) -> Scene {
    let scene = tessellate(building, hsd::parse::builtin(), Detail::Everything.into());
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

/// Closed, outward, no sliver, no NaN, unit normals that agree with the winding as far as round shading allows.
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
                cross.normalize().dot(normal) > 0.8,
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
        building.houses[0].house.azimuth = azimuth;
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
    building.images.push(Picture {
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
