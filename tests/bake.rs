//! `hsd build --bake`: what glass mirrors, against lines that are followed here one by one.

use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd::backend::images::Library;
use hsd::backend::{flat, gltf as write, obj};
use hsd::diagnostic::Diagnostics;
use hsd::render::mirror::{BakeOptions, bake};
use hsd::scene::Scene;
use hsd::source::{FileId, NoFiles, Source};
use serde_json::Value;

/// Six metres of glass that faces south, before it a street.
const GLASS: &str = r#"<Structure size="60">
  <Texture texturecode="NGC" reflection="0.75"/>
  <Texture texturecode="NWI" reflection="0.25"/>
  <Facades>
    <Facade ratio="1" reflection="enable"><Floor id="1" height="20"><Part code="NGC"/><Part code="NGC"/><Part code="NWI"/><Part code="NGC"/></Floor></Facade>
    <Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/><Part code="NGC"/></Floor></Facade>
    <Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/><Part code="NGC"/></Floor></Facade>
    <Facade ratio="1" angle="90"><Floor id="1" height="20"><Part code="NGC"/><Part code="NGC"/></Floor></Facade>
  </Facades>
</Structure>"#;

/// A house of charred boards across it.
const DARK: &str = "-6 -9 0\n7.0\n\nKYI  KYI  KYI  KYI  KYI  KYI\nKYI  KYI  KYI\nKYI  KYI  KYI  KYI  KYI  KYI\nKYI  KYI  KYI\n";

const EYE: DVec3 = dvec3(-4.0, -5.0, 1.6);

const WISHES: BakeOptions = BakeOptions {
    eye: Some(EYE),
    longest: 160,
};

fn scene(texts: &[&str]) -> Scene {
    let sources: Vec<Source> = texts
        .iter()
        .enumerate()
        .map(|(n, text)| Source::new(FileId(n as u32), format!("{n}.hsd"), text.as_bytes()))
        .collect();
    let mut out = Diagnostics::new();
    let sources: Vec<&Source> = sources.iter().collect();
    let made = hsd::compile(&sources, &NoFiles, &hsd::Options::default(), &mut out);
    let errors = out.into_sorted();
    let errors = errors
        .iter()
        .filter(|d| d.severity == hsd::diagnostic::Severity::Error);
    assert_eq!(errors.count(), 0);
    made.scene
}

fn baked(texts: &[&str]) -> (Scene, usize) {
    let mut scene = scene(texts);
    let count = bake(&mut scene, WISHES, &|_| None);
    (scene, count)
}

/// All triangles in the world, each with the name of its material and whether it is below a facade of the first house.
fn triangles(scene: &Scene) -> Vec<([DVec3; 3], String, bool)> {
    let mut found = vec![];
    let mut glass = vec![];
    for (node, place) in scene.nodes.iter().zip(flat::places(scene.whole())) {
        let above = node.parent.is_some_and(|p| glass[p.0 as usize]);
        let south =
            node.kind == hsd::scene::Kind::Facade && place.turn.x > 0.99 && place.at.y.abs() < 0.1;
        glass.push(above || south);
        for p in flat::primitives(scene.whole(), node) {
            for t in p.indices.chunks_exact(3) {
                let corners =
                    [0, 1, 2].map(|k| place.point(flat::point(p.positions[t[k] as usize])));
                let name = scene.materials[p.material.0 as usize].name.clone();
                found.push((corners, name, above || south));
            }
        }
    }
    found
}

/// How far along a line a triangle is met.
fn met([a, b, c]: [DVec3; 3], from: DVec3, way: DVec3) -> Option<f64> {
    let normal = (b - a).cross(c - a);
    let along = normal.dot(a - from) / normal.dot(way);
    let p = from + way * along;
    let inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(s, e)| (*e - *s).cross(p - *s).dot(normal) >= 0.0);
    (along.is_finite() && along > 0.0 && inside).then_some(along)
}

/// A pane's corners in the world and in its picture.
fn panes(scene: &Scene) -> Vec<(DVec3, DVec2)> {
    let mut found = vec![];
    for (node, place) in scene.nodes.iter().zip(flat::places(scene.whole())) {
        for p in flat::primitives(scene.whole(), node).filter(|p| !p.mirror_uvs.is_empty()) {
            for (at, uv) in p.positions.iter().zip(&p.mirror_uvs) {
                found.push((
                    place.point(flat::point(*at)),
                    DVec2::from_array(uv.map(f64::from)),
                ));
            }
        }
    }
    found
}

#[test]
fn a_picture_shows_what_followed_lines_meet() {
    let (scene, count) = baked(&[GLASS, DARK]);
    assert_eq!((count, scene.mirrored.len()), (1, 1));
    let picture = &scene.mirrored[0];
    // Two corners far apart tell how the picture lies on the wall.
    let panes = panes(&scene);
    let (first, last) = (
        panes[0],
        *panes
            .iter()
            .max_by(|a, b| {
                (a.1 - panes[0].1)
                    .length()
                    .total_cmp(&(b.1 - panes[0].1).length())
            })
            .unwrap(),
    );
    let flat = |p: DVec3| dvec2(p.x, p.z);
    let scale = (flat(last.0) - flat(first.0)) / (last.1 - first.1);
    let all = triangles(&scene);
    let plane = panes.iter().map(|(p, _)| p.y).sum::<f64>() / panes.len() as f64;
    let mirrored = dvec3(EYE.x, 2.0 * plane - EYE.y, EYE.z);
    let seen = |uv: DVec2| {
        let on = flat(first.0) + (uv - first.1) * scale;
        let from = dvec3(on.x, plane, on.y);
        let way = (from - mirrored).normalize();
        let hits = all.iter().filter(|(.., own)| !own);
        // What is nearer than this to the plane belongs to the wall itself.
        let near = 0.2 / way.y.abs();
        let hits = hits.filter_map(|(t, name, _)| Some((met(*t, from, way)?, name)));
        let hits = hits.filter(|(along, _)| *along > near);
        let nearest = hits
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, name)| name.clone());
        nearest.unwrap_or(if way.z > 0.0 { "sky" } else { "ground" }.into())
    };
    let (width, height) = picture.dimensions();
    let mut checked = std::collections::BTreeMap::<String, usize>::new();
    for y in (2..height - 2).step_by(3) {
        for x in (2..width - 2).step_by(3) {
            let at = |dx: f64, dy: f64| {
                dvec2(
                    (f64::from(x) + 0.5 + dx) / f64::from(width),
                    1.0 - (f64::from(y) + 0.5 + dy) / f64::from(height),
                )
            };
            let there = seen(at(0.0, 0.0));
            // Edges are left to the smoothing.
            if [(1.5, 0.0), (-1.5, 0.0), (0.0, 1.5), (0.0, -1.5)]
                .iter()
                .any(|(dx, dy)| seen(at(*dx, *dy)) != there)
            {
                continue;
            }
            let [r, g, b] = picture.get_pixel(x, y).0.map(i32::from);
            let right = match &*there {
                "sky" => b > 150 && b > r + 15,
                "ground" => r > 90 && r >= b,
                name if name.starts_with("charred") => r.max(g).max(b) < 110,
                _ => b < 200,
            };
            assert!(right, "{there} at {x} {y} is {r} {g} {b}");
            *checked.entry(there).or_default() += 1;
        }
    }
    assert!(
        checked["sky"] > 100 && checked["ground"] > 20,
        "{checked:?}"
    );
    let charred = checked
        .iter()
        .filter(|(name, _)| name.starts_with("charred"));
    let charred: usize = charred.map(|(_, n)| n).sum();
    assert!(charred > 40, "{checked:?}");
}

#[test]
fn shapes_stay_as_they_are() {
    let before = scene(&[GLASS, DARK]);
    let (after, _) = baked(&[GLASS, DARK]);
    let sorted = |scene: &Scene| {
        let rounded = |p: &DVec3| p.to_array().map(|x| (x * 1e4).round() as i64);
        let mut all: Vec<[[i64; 3]; 3]> = triangles(scene)
            .iter()
            .map(|(t, ..)| t.each_ref().map(rounded))
            .collect();
        all.sort();
        all
    };
    assert_eq!(sorted(&before), sorted(&after));
    // Parts are still counted by their codes, and parents stand before their children.
    let codes = |scene: &Scene| {
        scene
            .nodes
            .iter()
            .filter_map(|n| n.code.map(|c| c.to_string()))
            .collect::<Vec<_>>()
    };
    assert_eq!(codes(&before), codes(&after));
    assert!(
        after
            .nodes
            .iter()
            .enumerate()
            .all(|(n, node)| node.parent.is_none_or(|p| (p.0 as usize) < n))
    );
}

#[test]
fn nothing_is_baked_where_nothing_mirrors() {
    let plain = GLASS.replace(r#" reflection="enable""#, "");
    let (after, count) = baked(&[&plain, DARK]);
    assert_eq!(count, 0);
    let library = Library::default();
    assert_eq!(
        write::glb(&after, &library),
        write::glb(&scene(&[&plain, DARK]), &library)
    );
}

/// The JSON of a GLB.
fn json(glb: &[u8]) -> Value {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&glb[20..20 + length]).unwrap()
}

#[test]
fn panes_weigh_the_picture_by_their_shares() {
    let written = || {
        let (scene, _) = baked(&[GLASS, DARK]);
        let mut library = Library::default();
        library.mirror(&scene.mirrored);
        (write::glb(&scene, &library), scene, library)
    };
    let (glb, scene, library) = written();
    assert_eq!(glb, written().0, "same input, same bytes");
    let json = json(&glb);
    let materials = json["materials"].as_array().unwrap();
    let mut shares = vec![];
    for material in materials.iter().filter(|m| !m["emissiveTexture"].is_null()) {
        assert_eq!(material["emissiveTexture"]["texCoord"], 1);
        let share = material["extras"]["reflection"].as_f64().unwrap();
        let light = material["emissiveFactor"][0].as_f64().unwrap();
        let opacity = material["pbrMetallicRoughness"]["baseColorFactor"][3]
            .as_f64()
            .unwrap();
        // Blended over what is behind, so much of the picture is seen.
        assert!((light * opacity - share).abs() < 1e-6, "{material}");
        shares.push(share);
    }
    shares.sort_by(f64::total_cmp);
    assert_eq!(shares, [0.25, 0.75]);
    let files = obj::obj(&scene, &library, "street");
    let mtl = files.iter().find(|f| f.name == "street.mtl").unwrap();
    let mtl = String::from_utf8(mtl.bytes.to_vec()).unwrap();
    assert_eq!(
        mtl.matches("map_Ke street_textures/mirrored_1.jpg").count(),
        2
    );
}

#[test]
fn an_eye_of_its_own_stays_in_the_street() {
    // Nobody says where the eye is: the dark house is 9 m away, and the glass shows all of what its middle faces.
    let own = BakeOptions {
        eye: None,
        ..WISHES
    };
    let near = |texts: &[&str]| {
        let mut scene = scene(texts);
        bake(&mut scene, own, &|_| None);
        scene.mirrored.remove(0)
    };
    let dark = |picture: &image::RgbImage| {
        picture
            .pixels()
            .filter(|p| p.0.iter().all(|c| *c < 110))
            .count()
    };
    let (with, without) = (near(&[GLASS, DARK]), near(&[GLASS]));
    assert_eq!(with.dimensions(), without.dimensions());
    // The eaves of its own are dark as well.
    assert!(
        dark(&with) > dark(&without) + 500,
        "{} {}",
        dark(&with),
        dark(&without)
    );
}

#[test]
fn the_command_line_bakes() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("glass.hsd"), GLASS).unwrap();
    std::fs::write(folder.path().join("dark.hsd"), DARK).unwrap();
    let hsd = |arguments: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hsd"));
        command
            .current_dir(folder.path())
            .args(["--lang", "en", "build", "--quiet"])
            .args(arguments);
        command.output().unwrap()
    };
    let wide = ["glass.hsd", "dark.hsd", "--bake", "--bake-size", "64", "-o"];
    for name in ["a.gltf", "b.gltf"] {
        let output = hsd(&[&wide[..], &[name]].concat());
        assert!(output.status.success(), "{output:?}");
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let picture = read("a_textures/mirrored_1.jpg");
    assert_eq!(picture, read("b_textures/mirrored_1.jpg"));
    let picture = image::load_from_memory(&picture).unwrap();
    assert_eq!(picture.width().max(picture.height()), 64);
    for wrong in [
        &["--bake-eye", "0,0,0"][..],
        &["--bake", "--bake-eye", "1,2"],
        &["--bake", "--bake-size", "8"],
    ] {
        let output = hsd(&[&["glass.hsd", "-o", "c.glb"], wrong].concat());
        assert_eq!(output.status.code(), Some(2), "{output:?}");
    }
}
