//! The houses of a town as a source file build what the town builds.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn hsd(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    command.current_dir(folder).args(arguments);
    command.output().expect("hsd runs")
}

fn done(folder: &Path, arguments: &[&str]) {
    let output = hsd(folder, arguments);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {told}");
}

/// Returns the description and the binary part of a model.
fn model(path: &Path) -> (Value, Vec<u8>) {
    let bytes = fs::read(path).expect("there is a model");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let json = serde_json::from_slice(&bytes[20..20 + length]).expect("it is JSON");
    (json, bytes[20 + length + 8..].to_vec())
}

/// Removes where things are written: a town file and the text of its houses are different files.
fn without_places(json: &mut Value) {
    if let Some(asset) = json["asset"].as_object_mut() {
        asset.remove("extras");
    }
    for node in json["nodes"].as_array_mut().expect("nodes") {
        if let Some(extras) = node.get_mut("extras").and_then(Value::as_object_mut) {
            for name in ["span", "file", "source", "line", "column"] {
                extras.remove(name);
            }
        }
    }
}

/// Builds a town as one model, and as a text and that as a model; both must be the same.
fn same_model(folder: &Path, town: &str) -> String {
    // A feature that nobody builds gives 1.
    hsd(folder, &["town", town, "-o", "town.glb", "--quiet"]);
    let output = hsd(folder, &["town", town, "-o", "houses.hsd", "--quiet"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(!told.contains("by themselves"), "{told}");
    done(folder, &["check", "houses.hsd"]);
    done(
        folder,
        &["build", "houses.hsd", "-o", "houses.glb", "--quiet"],
    );
    let (mut of_town, shapes) = model(&folder.join("town.glb"));
    let (mut of_text, own) = model(&folder.join("houses.glb"));
    assert!(shapes == own, "the shapes differ");
    without_places(&mut of_town);
    without_places(&mut of_text);
    assert!(of_town == of_text, "the nodes differ");
    fs::read_to_string(folder.join("houses.hsd")).expect("there is a text")
}

fn examples() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for file in fs::read_dir("examples/towns").expect("examples") {
        let file = file.expect("a file").path();
        fs::copy(&file, folder.path().join(file.file_name().expect("a name"))).expect("a copy");
    }
    folder
}

#[test]
fn the_text_of_a_block_is_the_block() {
    let folder = examples();
    let text = same_model(folder.path(), "block.hsd");
    assert_eq!(text.matches("<Place ").count(), 16, "{text}");
    assert!(text.contains("<Outline "), "{text}");
    assert!(
        !text.contains("<define "),
        "types of the library are named: {text}"
    );
}

#[test]
fn the_text_of_lots_has_what_stands_behind_their_houses() {
    let folder = examples();
    let text = same_model(folder.path(), "lots.hsd");
    assert!(text.contains("type=\"roji\""), "{text}");
}

#[test]
fn houses_of_own_types_come_with_a_definition() {
    let folder = examples();
    let town = r#"<Town name="own" seed="4">
  <Layer name="houses" src="block-houses.geojson" crs="local" key="key"/>
  <Layer name="roads" src="block-roads.geojson" crs="local"/>
  <define name="box" frontage="" depth="" high="9">
    <House unit="3.3"><Storey height="{high}">
      <Row><repeat num="{max(1, floor(frontage))}"><random><choice>GIT</choice><choice>KTU</choice></random></repeat></Row>
      <Row><repeat num="{max(1, floor(depth))}">APW</repeat></Row>
      <Row><repeat num="{max(1, floor(frontage))}">KTU</repeat></Row>
      <Row><repeat num="{max(1, floor(depth))}">APW</repeat></Row>
    </Storey><Roofs kind="K"/></House>
  </define>
  <for each="houses" test="{use = 'shop'}"><Place type="box" on="plot" high="{8 + round(draw(4))}"/></for>
  <for each="houses" test="{use != 'shop'}">
    <House unit="3"><Storey><Row>KTU  GIT</Row><Row>APW</Row><Row>KTU  KTU</Row><Row>APW</Row></Storey></House>
  </for>
</Town>
"#;
    fs::write(folder.path().join("own.hsd"), town).expect("written");
    let text = same_model(folder.path(), "own.hsd");
    assert!(text.contains("<define "), "{text}");
}

#[test]
fn a_town_is_not_overwritten_by_its_houses() {
    let folder = examples();
    let before = fs::read(folder.path().join("block.hsd")).expect("a town");
    let output = hsd(folder.path(), &["town", "block.hsd", "-o", "block.hsd"]);
    assert!(!output.status.success());
    assert_eq!(
        fs::read(folder.path().join("block.hsd")).expect("a town"),
        before
    );
}

/// A town builds what it can of walls that cross each other, a file of houses does not: such a house is named, and the file
/// builds the others.
#[test]
fn houses_whose_walls_cross_are_named_and_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let ring = |corners: &str, key: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"key":"{key}"}},"geometry":{{"type":"Polygon","coordinates":[[{corners}]]}}}}"#
        )
    };
    // The wall from 7 10 to 7 7 crosses the one from 12 8 to 6 8.
    let crossing = "[0,0],[12,0],[12,8],[6,8],[6,10],[7,10],[7,7],[0,7],[0,0]";
    let sound = "[20,0],[28,0],[28,8],[24,8],[24,6],[20,6],[20,0]";
    let map = format!(
        r#"{{"type":"FeatureCollection","features":[{},{}]}}"#,
        ring(crossing, "a"),
        ring(sound, "b")
    );
    fs::write(folder.path().join("houses.geojson"), map).expect("is written");
    let town = r#"<Town seed="1"><Layer name="houses" src="houses.geojson" crs="local" key="key"/>
        <for each="houses"><Place type="hiraya" on="outline"/></for></Town>"#;
    fs::write(folder.path().join("town.hsd"), town).expect("is written");
    let output = hsd(folder.path(), &["town", "town.hsd", "-o", "houses.hsd"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("1 houses cannot be written by themselves, the first of them `houses a`"),
        "{told}"
    );
    assert_eq!(output.status.code(), Some(1));
    done(folder.path(), &["check", "houses.hsd"]);
    let text = fs::read_to_string(folder.path().join("houses.hsd")).expect("is written");
    assert!(
        text.contains("houses b") && !text.contains("houses a"),
        "{text}"
    );
}

/// A front wider than a type allows repeats it, in a town as in a file that places the house.
#[test]
fn wide_fronts_on_outlines_are_the_same_in_text() {
    let folder = tempfile::tempdir().expect("a folder");
    let lot = |n: i32, width: i32| {
        let (w, e) = (n * 40, n * 40 + width);
        let (inner, north) = (w + 5, 14 + n);
        format!(
            r#"{{"type":"Feature","properties":{{"key":"{n}"}},"geometry":{{"type":"Polygon","coordinates":[[[{w},0],[{e},0],[{e},9],[{inner},9],[{inner},{north}],[{w},{north}],[{w},0]]]}}}}"#
        )
    };
    // The widest kanban has 9 m.
    let lots: Vec<String> = [8, 11, 14, 20, 24]
        .into_iter()
        .zip(0..)
        .map(|(width, n)| lot(n, width))
        .collect();
    let map = format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        lots.join(",")
    );
    fs::write(folder.path().join("houses.geojson"), map).expect("is written");
    let roads = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"width":4},"geometry":{"type":"LineString","coordinates":[[-9,-3],[209,-3]]}}]}"#;
    fs::write(folder.path().join("roads.geojson"), roads).expect("is written");
    let town = r#"<Town seed="1"><Layer name="houses" src="houses.geojson" crs="local" key="key"/>
        <Layer name="roads" src="roads.geojson" crs="local"/>
        <for each="houses"><Place type="kanban"/></for></Town>"#;
    fs::write(folder.path().join("town.hsd"), town).expect("is written");
    let text = same_model(folder.path(), "town.hsd");
    assert_eq!(text.matches("<Outline").count(), 5, "{text}");
    assert_eq!(text.matches("<Place").count(), 5, "{text}");
}
