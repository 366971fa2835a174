//! The catalogue to look at: `hsd parts --sheet`.

use hsd::catalog::PartDef;
use hsd::scene::{Detail, Kind};
use hsd::tessellate::part_sheet;
use std::path::Path;
use std::process::{Command, Output};

fn sheet(output: &Path, filter: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    command.args(["parts", "--sheet"]).arg(output).args(filter);
    command.output().expect("hsd runs")
}

/// Codes of all parts that can be seen.
fn codes() -> Vec<&'static str> {
    let codes = hsd::parse::builtin().parts().iter().map(|p| p.code());
    codes.filter(|code| !code.trim().is_empty()).collect()
}

#[test]
fn a_page_shows_every_part() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let page = folder.path().join("parts.html");
    assert!(sheet(&page, &[]).status.success());
    let text = std::fs::read_to_string(&page).expect("the page is written");
    for code in codes() {
        assert!(text.contains(&format!("<code>{code}</code>")), "{code}");
    }
    assert_eq!(text.matches("<img ").count(), codes().len());
    assert!(text.contains("虫籠窓") && text.contains("mushiko-mado"));
    // One file that needs nothing beside it.
    assert!(!text.contains("http"));
}

#[test]
fn a_model_holds_every_part() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let model = folder.path().join("parts.glb");
    assert!(sheet(&model, &[]).status.success());
    let bytes = std::fs::read(&model).expect("the model is written");
    let read = gltf::Gltf::from_slice(&bytes).expect("it is glTF");
    let shown = read.nodes().filter(|n| n.mesh().is_some()).count();
    assert_eq!(shown, codes().len());
}

#[test]
fn a_filter_leaves_the_rest_out() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let page = folder.path().join("lattices.html");
    assert!(sheet(&page, &["G"]).status.success());
    let text = std::fs::read_to_string(&page).expect("the page is written");
    let lattices = codes().iter().filter(|c| c.starts_with('G')).count();
    assert_eq!(text.matches("<img ").count(), lattices);
}

#[test]
fn other_endings_are_wrong_usage() {
    let output = sheet(Path::new("parts.txt"), &[]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains(".html or .glb"), "{told}");
}

#[test]
fn every_part_but_the_void_is_pictured() {
    for part in hsd::parse::builtin().parts() {
        let picture = part_sheet::picture(part, 40.0);
        assert_eq!(picture.is_some(), part.class() != ' ', "{}", part.code());
        let Some(picture) = picture else { continue };
        let paper = *picture.get_pixel(0, 0);
        let drawn = picture.pixels().filter(|p| **p != paper).count();
        let share = drawn as f64 / f64::from(picture.width() * picture.height());
        assert!(share > 0.02, "{}: {share}", part.code());
    }
}

#[test]
fn every_part_stands_apart_from_its_neighbours() {
    let all: Vec<&PartDef> = hsd::parse::builtin().parts().iter().collect();
    let scene = part_sheet::scene(&all, Detail::Everything);
    let parts = scene.nodes.iter().filter(|n| n.kind == Kind::Part);
    assert_eq!(parts.count(), all.len() - 1);
}
