//! Every example compiles without a word, and what it becomes is sound and stays what it is.
//! `HSD_UPDATE=1 cargo test --release examples` writes the descriptions in `tests/suite/examples/` anew.

use crate::support::{Run, assert_none, compile_file, expect, flaws, root, stem, texts, volume};
use glam::DVec3;
use hsd::building::{Building, Built, StoreyPlan};
use hsd::scene::{Kind, Scene};
use std::fmt::Write;

/// A number to three places, without a negative zero.
fn number(x: f64) -> String {
    let rounded = (x * 1000.0).round() / 1000.0 + 0.0;
    format!("{rounded}")
}

fn rect(r: &[f64; 4]) -> String {
    r.map(number).join(" ")
}

fn area(r: &[f64; 4]) -> f64 {
    (r[2] - r[0]) * (r[3] - r[1])
}

fn describe_plan(plan: &StoreyPlan, text: &mut String) {
    let _ = writeln!(text, "  storey {} top {} m", plan.storey, number(plan.z));
    for (word, rings) in [("outline", &plan.outlines), ("hole", &plan.holes)] {
        for ring in rings {
            let corners = ring
                .iter()
                .map(|p| format!("{} {}", number(p.x), number(p.y)));
            let _ = writeln!(
                text,
                "    {word} {}",
                corners.collect::<Vec<_>>().join(", ")
            );
        }
    }
    for region in &plan.regions {
        let _ = write!(
            text,
            "    region {} area {} {} {}",
            rect(&region.rect),
            number(area(&region.rect)),
            region.role,
            region.shape.letters()
        );
        let words = [
            region.ridge.map(|r| format!(" ridge {r}")),
            region.fall.map(|f| format!(" fall {f}")),
            region.over.map(|o| format!(" over {o}")),
            region
                .polygon
                .as_ref()
                .map(|p| format!(" polygon of {}", p.len())),
        ];
        let _ = writeln!(text, "{}", words.into_iter().flatten().collect::<String>());
    }
}

fn describe_roofs(building: &Building, text: &mut String) {
    for Built { house, roofs, .. } in &building.houses {
        let _ = writeln!(
            text,
            "house {:?}, {} storeys",
            house.name,
            house.storeys.len()
        );
        for plan in &roofs.plans {
            describe_plan(plan, text);
        }
        for roof in &roofs.roofs {
            let points = || roof.solids.iter().flat_map(|s| &s.points).copied();
            let low = points().fold(DVec3::INFINITY, DVec3::min);
            let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
            let corner = |p: DVec3| p.to_array().map(number).join(" ");
            let _ = writeln!(
                text,
                "  roof {} {:?} over storey {}: {} solids, {} m3, from {} to {}",
                roof.shape.letters(),
                roof.kind,
                roof.storey,
                roof.solids.len(),
                number(roof.solids.iter().map(volume).sum()),
                corner(low),
                corner(high)
            );
        }
    }
}

fn describe_scene(scene: &Scene, text: &mut String) {
    let kinds = [
        Kind::House,
        Kind::Storey,
        Kind::Facade,
        Kind::Part,
        Kind::Post,
        Kind::Member,
        Kind::Roof,
    ];
    let triangles = |mesh: usize| -> usize {
        let primitives = scene.meshes[mesh].primitives.iter();
        primitives.map(|p| p.indices.len() / 3).sum()
    };
    let _ = writeln!(
        text,
        "scene of {} meshes, {} materials, {} pictures",
        scene.meshes.len(),
        scene.materials.len(),
        scene.pictures.len()
    );
    for kind in kinds {
        let nodes = || scene.nodes.iter().filter(move |n| n.kind == kind);
        let shown: usize = nodes()
            .filter_map(|n| n.mesh)
            .map(|mesh| triangles(mesh.0 as usize))
            .sum();
        let _ = writeln!(
            text,
            "  {} {}: {shown} triangles",
            nodes().count(),
            kind.word()
        );
    }
}

fn describe(run: &Run) -> String {
    let mut text = String::new();
    describe_roofs(&run.building, &mut text);
    describe_scene(&run.scene, &mut text);
    text
}

#[test]
fn examples_compile_without_a_word() {
    let mut findings = vec![];
    for path in texts("examples") {
        let run = compile_file(&path);
        if !run.diagnostics.is_empty() {
            findings.push(format!("{}\n{}", stem(&path), run.short()));
        }
    }
    assert_none(&findings);
}

#[test]
fn examples_are_sound() {
    let mut findings = vec![];
    for path in texts("examples") {
        let run = compile_file(&path);
        let name = stem(&path);
        findings.extend(flaws(&run).iter().map(|flaw| format!("{name}: {flaw}")));
        if run.scene.nodes.iter().all(|n| n.mesh.is_none()) {
            findings.push(format!("{name}: shows nothing"));
        }
    }
    assert_none(&findings);
}

#[test]
fn examples_stay_what_they_are() {
    let mut findings = vec![];
    let folder = root().join("tests/suite/examples");
    for path in texts("examples") {
        let wanted = folder.join(stem(&path)).with_extension("txt");
        expect(&wanted, &describe(&compile_file(&path)), &mut findings);
    }
    assert_none(&findings);
}
