//! Roofs over the walls.

use super::*;
use hsd::building::Attic;
use hsd::building::Corners;

#[test]
fn low_walls_under_a_lean_to() {
    let height = 9.0 * SHAKU;
    let mut building = simple(&["KSK  KSK  ", "GSI  KSK  ", "KSK  KSK  ", "KSK  KSK  "]);
    roofs_of(&mut building).ceilings.push(Ceiling {
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
            corners: Corners::from_slice(&[i, j, n + j, n + i]),
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
    roofs_of(&mut building).roofs.push(Roof {
        whole: None,
        storey: 1,
        span: None,
        shape: RoofShape::Flat,
        kind: RoofKind::Metal,
        trim: Trim::default(),
        attic: Attic::default(),
        solids: vec![flat_roof()],
    });
    let scene = scene(&building);
    let roof = named(&scene, "roof 1");
    assert_eq!((roof.kind, roof.shape), (Kind::Roof, Some("RIK".into())));
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
            corners: Corners::from_slice(&[0, 1, 2, 3]),
            finish: Finish::Covering(RoofKind::Tiles),
        }],
    };
    let mut building = building(Vec::new());
    roofs_of(&mut building).roofs.push(Roof {
        whole: None,
        storey: 1,
        span: None,
        shape: RoofShape::LeanTo,
        kind: RoofKind::Tiles,
        trim: Trim::default(),
        attic: Attic::default(),
        solids: vec![solid],
    });
    let scene = tessellate(&building, hsd::parse::builtin(), Detail::Everything.into());
    let slope = &scene.meshes[0].primitives[0];
    let close = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-5;
    assert!(
        close(slope.uvs[0], [0.0, 0.0]) && close(slope.uvs[2], [3.0, 5.0]),
        "{:?}",
        slope.uvs
    );
}

#[test]
fn roofs_that_are_alike_share_a_mesh() {
    let text = "0 0\n9\n\nKSK  KSK  KSK  \nKSK  KSK  \nKSK  KSK  KSK  \nKSK  KSK  \n";
    let longer = text.replace("KSK  KSK  KSK  ", "KSK  KSK  KSK  KSK  ");
    let scene = |houses: &[&str]| {
        let text = houses.join("%\n");
        let source = hsd::source::Source::new(hsd::source::FileId(0), "row.hsd", text.as_bytes());
        let mut out = hsd::diagnostic::Diagnostics::new();
        let options = hsd::Options::default();
        hsd::compile(&[&source], &hsd::source::NoFiles, &options, &mut out).scene
    };
    let roofs = |scene: &Scene| -> Vec<_> {
        let nodes = scene.nodes.iter().filter(|n| n.kind == Kind::Roof);
        nodes.map(|n| n.mesh).collect()
    };
    let (one, row) = (scene(&[text]), scene(&[text, &longer, text]));
    assert_eq!(roofs(&one).len(), 1);
    let [first, second, third] = roofs(&row)[..] else {
        panic!("a roof each")
    };
    assert!(first.is_some() && first == third && first != second);
    let twice = scene(&[text, text]);
    assert_eq!(twice.meshes, one.meshes, "a second house adds no mesh");
}

/// Under raised corners a slope is twisted, and its tiles run up the slope all the same: from edge to edge the picture moves across
/// as far as one goes along the eaves.
#[test]
fn tiles_of_a_twisted_slope_run_with_its_rows() {
    let scene = at_detail(
        "<House><Hall bays=\"5 5\" bay=\"10\"/></House>",
        Detail::Openings,
    );
    let roof = scene.nodes.iter().find(|n| n.kind == Kind::Roof);
    let mesh = roof.and_then(|n| n.mesh).expect("a roof");
    let is_tiled = |p: &&Primitive| scene.materials[p.material.0 as usize].name == "hongawara";
    let tiles = scene.meshes[mesh.0 as usize]
        .primitives
        .iter()
        .find(is_tiled);
    let tiles = tiles.expect("a tiled slope");
    let (mut twisted, mut askew) = (0, 0);
    for corners in tiles.indices.chunks_exact(3) {
        let at = |k: usize| corners[k] as usize;
        let [p, q, r] = [0, 1, 2].map(|k| DVec3::from(tiles.positions[at(k)].map(f64::from)));
        let normal = (q - p).cross(r - p).normalize();
        // Along the eaves of the side that it mostly looks to.
        let along = match normal.x.abs() < normal.y.abs() {
            true => -DVec3::X * normal.y.signum(),
            false => DVec3::Y * normal.x.signum(),
        };
        twisted += usize::from(normal.dot(along).abs() > 0.02);
        for (a, b) in [(0, 1), (1, 2)] {
            let [from, to] = [a, b].map(|k| f64::from(tiles.uvs[at(k)][0]));
            let [p, q] = [a, b].map(|k| DVec3::from(tiles.positions[at(k)].map(f64::from)));
            askew += usize::from(((to - from) - (q - p).dot(along)).abs() > 1e-3);
        }
    }
    assert!(twisted > 8, "{twisted} twisted faces");
    assert_eq!(askew, 0, "of {twisted} twisted faces");
}

/// Gable fills stand in the plane of a wall that hides its posts, and back between posts that show.
#[test]
fn gable_fills_are_flush_with_plaster_over_the_posts() {
    for (code, front) in [
        ("KSKO", 0.090),
        ("KSKK", 0.090),
        ("KNB", 0.082),
        ("KTU", 0.035),
    ] {
        let side = |n: usize| {
            format!(
                "<Row>{}</Row>",
                format!("<Part code=\"{code}\"/>").repeat(n)
            )
        };
        let walls = [4, 5, 4, 5].map(side).concat();
        let text = format!(
            "<House><Storey height=\"9\">{walls}</Storey><Roofs mode=\"explicit\"><Roof kind=\"K\" shape=\"KIR\" \
             ridge=\"X\" height=\"9\" a0=\"0\" b0=\"0\" a1=\"4\" b1=\"5\" pitch=\"5\" eaves=\"1\" verge=\"1\"/></Roofs></House>"
        );
        for detail in [Detail::Everything, Detail::Flat] {
            let scene = at_detail(&text, detail);
            let roof = scene.nodes.iter().find(|n| n.kind == Kind::Roof);
            let mesh = roof.and_then(|n| n.mesh).expect("a roof");
            let faces = triangles(&scene.meshes[mesh.0 as usize]);
            let at = |x: f64| {
                let on = |p: &[f32; 3]| (f64::from(p[0]) - x).abs() < 1.1e-3;
                faces.iter().filter(|t| t.iter().all(on)).count()
            };
            let wide = 4.0 * 3.0 * SHAKU;
            for before in [0.035, 0.082, 0.090] {
                let [right, left] = [at(before), at(-wide - before)];
                let is_front = before == front;
                assert_eq!(right > 0, is_front, "{code}, {detail:?}, right, {before}");
                assert_eq!(left > 0, is_front, "{code}, {detail:?}, left, {before}");
            }
        }
    }
}

/// Compiles a text without errors.
fn at_detail(text: &str, detail: Detail) -> Scene {
    let source = hsd::source::Source::new(hsd::source::FileId(0), "gable.hsd", text.as_bytes());
    let mut out = hsd::diagnostic::Diagnostics::new();
    let options = hsd::Options {
        detail,
        ..hsd::Options::default()
    };
    let scene = hsd::compile(&[&source], &hsd::source::NoFiles, &options, &mut out).scene;
    assert!(!out.has_errors());
    scene
}
