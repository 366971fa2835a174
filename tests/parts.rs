//! Every part in its bay: sound, within its lines, counted as the sheet of parts says, no two faces at one depth.

use crate::support::depths::{Skin, bodies, bounds, fights, sizes, skins_below, triangles};
use crate::support::{assert_none, compile, flaws_of_mesh, on_all_processors, open_edges};
use hsd::catalog::PartDef;
use hsd::geometry::SHAKU;
use hsd::scene::{Kind, Mesh, NodeId, Scene};

/// A closed house of one storey whose front holds these codes, left to right.
fn house(front: &[&str], height: f64, unit: f64) -> Scene {
    let width = |code: &str| match code.as_bytes()[4] {
        b'2' => 2.0,
        b'0' => 0.0,
        b'h' => 0.5,
        _ => 1.0,
    };
    let total: f64 = front.iter().map(|c| width(c)).sum();
    let mut text = format!("0 0 180\n{height}\nunit {unit}\nroofs explicit\n\n");
    // Walls are written from right to left.
    text.extend(front.iter().rev().copied());
    let mut back = "KSK  ".repeat(total as usize);
    if total.fract() > 0.0 {
        back += "GKK h";
    }
    text += &format!("\nKSK  KSK  KSK  \n{back}\nKSK  KSK  KSK  \n");
    let run = compile("part.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{text}{}", run.short());
    run.scene
}

/// The mesh of a part beside plaster walls.
fn part(code: &str, height: f64, unit: f64) -> Mesh {
    let front: &[&str] = match code.as_bytes()[4] {
        b'0' => &["KSK  ", code, "KSK  "],
        _ => &["KSK  ", code],
    };
    let scene = house(front, height, unit);
    let node = scene.nodes.iter().find(|n| n.code.as_deref() == Some(code));
    let node = node.unwrap_or_else(|| panic!("no {code:?}"));
    let mesh = node.mesh.unwrap_or_else(|| panic!("{code:?} is empty"));
    scene.meshes[mesh.0 as usize].clone()
}

/// Every part but the void, and what stands outdoors by itself: see `outdoors`.
fn drawn() -> impl Iterator<Item = &'static PartDef> {
    hsd::parse::builtin()
        .parts()
        .iter()
        .filter(|p| !" O".contains(p.class()))
}

fn built() -> Vec<&'static PartDef> {
    drawn().filter(|p| "KT".contains(p.class())).collect()
}

#[test]
fn every_part_is_closed_and_within_its_lines() {
    let parts: Vec<&PartDef> = drawn().collect();
    let findings = on_all_processors(parts.len(), |i| {
        let mut found = vec![];
        let code = parts[i].code();
        for (height, unit) in [
            (9.5, 3.0),
            (9.0, 3.25),
            (7.0, 3.0),
            (5.0, 3.0),
            (3.0, 3.15),
            (9.5, 1.5),
        ] {
            let mesh = part(code, height, unit);
            let here = format!("{code} in {height} by {unit}");
            found.extend(
                flaws_of_mesh(&mesh)
                    .into_iter()
                    .map(|f| format!("{here}: {f}")),
            );
            let open = open_edges(&mesh);
            if open > 0 {
                found.push(format!("{here}: {open} open edges"));
            }
            let (lo, hi) = bounds(&triangles(&mesh));
            let wide = parts[i].width() * unit * SHAKU;
            let side = if wide > 0.0 { 1e-4 } else { 0.3 };
            if lo.x < -side || hi.x > wide + side || lo.z < -0.2851 || hi.z > height * SHAKU + 1e-4
            {
                found.push(format!("{here}: from {lo} to {hi}"));
            }
            for body in bodies(&triangles(&mesh)) {
                let volume: f64 = body.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum();
                if volume <= 0.0 {
                    found.push(format!("{here}: inside out at {}", body[0][0]));
                }
            }
        }
        found
    });
    assert_none(&findings);
}

/// The whole house, so that what meets at corners is there.
fn all(scene: &Scene) -> Vec<Skin> {
    let at = scene.nodes.iter().position(|n| n.kind == Kind::Storey);
    skins_below(scene, NodeId(at.expect("a storey") as u32))
}

#[test]
fn no_two_faces_at_one_depth() {
    let parts = built();
    let findings = on_all_processors(parts.len(), |i| {
        let code = parts[i].code();
        let mut found = vec![];
        let plaster = [(9.5, 3.0), (8.0, 3.25), (6.0, 3.0)].map(|(h, u)| (h, u, "KSK  "));
        let others = ["KSKO ", "KSM  ", "GSI  ", code].map(|beside| (9.5, 3.0, beside));
        for (height, unit, beside) in plaster.into_iter().chain(others) {
            let scene = house(&["KSK  ", code, beside, "KSK  "], height, unit);
            let fights = fights(&all(&scene), height * SHAKU);
            let here = format!("{code} beside {beside} in {height}");
            found.extend(fights.iter().take(4).map(|f| format!("{here}: {f}")));
        }
        found
    });
    assert_none(&findings);
}

/// How many bodies are about so large: width, depth and height in millimetres, 0 = whatever.
fn count(code: &str, size: [f64; 3]) -> usize {
    let all = sizes(&triangles(&part(code, 9.5, 3.0)));
    let like = |s: &&[f64; 3]| {
        let same = |i: usize| size[i] == 0.0 || (s[i] - size[i]).abs() < 0.6;
        (0..3).all(same)
    };
    all.iter().filter(like).count()
}

/// The sheet's counts, found in the shapes.
#[test]
fn bars_and_rails_are_counted() {
    for (code, what, size, wanted) in [
        ("KSM  ", "battens of 24 x 12", [24.0, 12.0, 0.0], 3),
        ("KTI  ", "whole strips of 45 x 12", [45.0, 12.0, 0.0], 2),
        ("KIB  ", "rails", [0.0, 34.0, 90.0], 2),
        ("TIT  ", "rails", [0.0, 0.0, 26.0], 4),
        ("TIT 2", "rails", [0.0, 0.0, 26.0], 8),
        ("TKD  ", "bars", [15.0, 0.0, 0.0], 9),
        ("TKD  ", "rails", [0.0, 0.0, 18.0], 3),
        ("TKD 2", "bars", [15.0, 0.0, 0.0], 18),
        ("TSH  ", "uprights", [12.0, 0.0, 0.0], 2),
        ("TSH  ", "levels", [0.0, 0.0, 12.0], 4),
        ("TSH 2", "uprights", [9.0, 0.0, 0.0], 8),
        ("TSH 2", "levels", [0.0, 0.0, 9.0], 12),
        ("TAM  ", "rails", [0.0, 0.0, 30.0], 4),
        ("TMA  ", "rails", [0.0, 0.0, 20.0], 17),
        ("TGL 2", "uprights", [12.0, 0.0, 0.0], 4),
        ("TGL 2", "levels", [0.0, 0.0, 12.0], 8),
        ("TKR  ", "steps of the leaves", [37.5, 0.0, 0.0], 8),
        ("TOD  ", "studs of the rails", [34.0, 14.0, 34.0], 15),
    ] {
        assert_eq!(count(code, size), wanted, "{code}: {what}");
    }
}

/// The outermost planes of walls and doors, millimetres outside the centre line; the post's face is at 60.6.
#[test]
fn recess_and_projection() {
    for (code, wanted) in [
        ("KSK  ", 45.0),
        ("KSKO ", 90.0),
        ("KSKK ", 90.0),
        ("KTU  ", 45.0),
        ("KJU  ", 45.0),
        ("KNA  ", 108.0),
        ("KNB  ", 108.0),
        ("KKS  ", 100.0),
        ("KTB  ", 375.0),
        ("KUD 0", 878.0),
        ("TTB  ", 245.0),
        ("TIT  ", 57.0),
    ] {
        let (lo, _) = bounds(&triangles(&part(code, 9.5, 3.0)));
        assert!((lo.y * -1000.0 - wanted).abs() < 1.0, "{code}: {lo}");
    }
}

/// A leaf on two tracks hides a stile of the one behind, and the left one is in front.
#[test]
fn the_left_leaf_is_in_front() {
    for code in ["TIT 2", "TKD 2", "TSH 2", "TGL 2"] {
        let all = triangles(&part(code, 9.5, 3.0));
        let all = bodies(&all);
        // Stiles: upright, in the leaves' planes.
        let at = |front: f64| -> Vec<(f64, f64)> {
            let bounds = all.iter().map(|b| bounds(b));
            let leaf = |(lo, hi): &(glam::DVec3, glam::DVec3)| {
                (lo.y * -1000.0 - front).abs() < 0.1 && hi.z - lo.z > 1.5
            };
            bounds.filter(leaf).map(|(lo, hi)| (lo.x, hi.x)).collect()
        };
        let (front, back) = (at(40.0), at(7.0));
        let least = |v: &[(f64, f64)]| v.iter().map(|s| s.0).fold(f64::INFINITY, f64::min);
        let most = |v: &[(f64, f64)]| v.iter().map(|s| s.1).fold(f64::NEG_INFINITY, f64::max);
        assert!(least(&front) < least(&back), "{code}");
        let overlap = most(&front) - least(&back);
        assert!((0.030..0.046).contains(&overlap), "{code}: {overlap}");
    }
}

/// Parts stay light: a dressed front has a dozen of them.
#[test]
fn parts_stay_light() {
    let mut heavy = vec![];
    for p in drawn() {
        let n = triangles(&part(p.code(), 9.5, 3.0)).len();
        if n > 1800 {
            heavy.push(format!("{}: {n} triangles", p.code()));
        }
    }
    assert_none(&heavy);
}

/// Two fences at a corner: their roofs meet in a hip, and nothing stands above them.
#[test]
fn fences_turn_corners() {
    for code in ["KTB  ", "KDB  "] {
        let text = format!(
            "0 0 180\n9.5\nroofs explicit\n\n{code}{code}\n{code}{code}\n{code}{code}\n{code}{code}\n"
        );
        let scene = compile("yard.hsd", text.as_bytes()).scene;
        let hips = scene.nodes.iter().filter(|n| n.name == "hip");
        assert_eq!(hips.count(), 4, "{code}");
        for mesh in &scene.meshes {
            assert_eq!(open_edges(mesh), 0, "{code}: {}", mesh.name);
            assert_none(&flaws_of_mesh(mesh));
        }
        let shaku = if code == "KTB  " { 9.0 } else { 7.5 };
        let triangles: Vec<_> = all(&scene).into_iter().map(|s| s.0).collect();
        let (_, hi) = bounds(&triangles);
        assert!((hi.z - shaku * SHAKU).abs() < 1e-3, "{code}: {hi}");
        assert_none(&fights(&all(&scene), shaku * SHAKU));
    }
}
