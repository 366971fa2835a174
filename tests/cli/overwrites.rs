//! Inputs that an output of the same run would replace: every command refuses, names the file and leaves it unchanged.

use super::*;
#[cfg(unix)]
use crate::heights::files::{AT, TIFF, cells, tiff};
use crate::support::root;
use std::collections::BTreeMap;

/// A house with three further files: one that it includes, and a texture where the model of `pictured.hsd` has one.
const PICTURED: &str = "<House><include href='part.svg'/>\
    <Texture texturecode='sign' src='pictured_textures/sign.png'/>\
    <Storey><Row>KSK  sign </Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row></Storey></House>";

/// A house without further files.
const PLAIN: &str = "<House><Storey><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row>\
    <Row>KSK  KSK</Row></Storey></House>";

/// A lot of 12 m by 10 m.
const LOT: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"key":"a"},
    "geometry":{"type":"Polygon","coordinates":[[[0,0],[12,0],[12,10],[0,10],[0,0]]]}}]}"#;

/// Layers whose names are those of outputs; the town of each is named after it.
const LAYERS: [&str; 9] = [
    "decisions.csv",
    "report.json",
    "tileset.json",
    "work.json",
    "out.decisions.csv",
    "out.report.json",
    "out.city.json",
    "houses.shp",
    "tiles/lot.geojson",
];

/// A town that plants trees on the points of a table and houses on lots.
fn town(layer: &str) -> String {
    let made = match layer.ends_with(".csv") {
        true => "<Tree/>",
        false => "<Place type='hiraya' on='outline'/>",
    };
    format!(
        "<Town name='t'><Layer name='a' src='{layer}' crs='local'/><for each='a'>{made}</for></Town>"
    )
}

/// A folder with houses, towns, layers and images.
fn fixture() -> TempDir {
    let folder = folder();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    };
    for name in ["text.obj", "text.mtl", "text.svg", "text.png", "text.html"] {
        write(name, SOUND.as_bytes());
    }
    write(
        "part.svg",
        b"<Catalog><Param name='w' default='1'/></Catalog>",
    );
    write("pictured.hsd", PICTURED.as_bytes());
    let including = PLAIN.replace("<Storey>", "<include href='part.svg'/><Storey>");
    write("including.hsd", including.as_bytes());
    for name in [
        "pictured_textures/sign.png",
        "p.review.png",
        "q.sheet-2.jpg",
        "1-flat.png",
        "front/rectified.png",
        "front/compared.png",
        "mask.png",
    ] {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        image::RgbImage::new(96, 64).save(path).unwrap();
    }
    for layer in LAYERS {
        let bytes = match layer.ends_with(".csv") {
            true => "x,y\n1,2\n",
            false => LOT,
        };
        write(layer, bytes.as_bytes());
        let name = layer.replace('/', "-");
        write(&format!("town-{name}.hsd"), town(layer).as_bytes());
    }
    for ending in ["shp", "shx", "dbf", "prj"] {
        let name = format!("houses.{ending}");
        fs::copy(
            root().join("tests/data").join(&name),
            folder.path().join(name),
        )
        .unwrap();
    }
    let shares = "<Town name='t'><Layer name='a' src='report.json' crs='local'/>\
        <Table name='s' src='decisions.csv' key='x'/>\
        <for each='a'><Place type='hiraya' on='outline'/></for></Town>";
    write("shares.hsd", shares.as_bytes());
    write("x/sound-1.png", br#"[{"from":[0,-9,2],"to":[0,0,2]}]"#);
    folder
}

/// Returns all files below a folder with their bytes.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for name in names(folder) {
        let path = folder.join(&name);
        match path.symlink_metadata().unwrap().is_dir() {
            true => {
                let below = tree(&path).into_iter();
                all.extend(below.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
            }
            false => drop(all.insert(name, fs::read(path).unwrap_or_default())),
        }
    }
    all
}

/// Returns what is wrong unless a command is refused because of this file and leaves every file unchanged.
fn fault(folder: &Path, file: &str, line: &str) -> Option<String> {
    let before = tree(folder);
    let arguments: Vec<&str> = line.split(' ').collect();
    let output = hsd(folder, &arguments);
    let said = stderr(&output);
    let named = said.contains(&format!("{file} is an input of this run"));
    if code(&output) == 0 || !named || !said.contains("choose another output") {
        return Some(format!("{line}: {said}"));
    }
    let after = tree(folder);
    let mut changed = before.iter();
    let changed = changed.find(|(name, bytes)| after.get(*name) != Some(bytes));
    changed.map(|(name, _)| format!("{line}: {name} has changed"))
}

fn assert_refused(folder: &Path, file: &str, line: &str) {
    assert_eq!(fault(folder, file, line), None);
}

#[test]
fn an_output_that_is_an_input_is_refused() {
    let mut faults = vec![];
    for (file, line) in [
        (
            "text.obj",
            "build sound.hsd --catalog text.obj -o ./x/../text.obj",
        ),
        (
            "text.obj",
            "build sound.hsd --catalog text.obj -o text.obj --watch",
        ),
        ("text.obj", "build sound.hsd --catalog text.obj -o text.obj"),
        ("text.mtl", "build text.mtl -o text.obj"),
        ("text.mtl", "build sound.hsd --catalog text.mtl -o text.obj"),
        ("text.png", "build text.png --variants 2 --sheet text.png"),
        (
            "text.png",
            "build text.png --variants 2 --sheet text.png -o x/",
        ),
        (
            "pictured_textures/sign.png",
            "build pictured.hsd -o pictured.obj",
        ),
        (
            "pictured_textures/sign.png",
            "build pictured.hsd -o pictured.gltf",
        ),
        (
            "pictured_textures/sign.png",
            "build pictured.hsd -o pictured.glb --textures-beside",
        ),
        (
            "pictured_textures/sign.png",
            "build pictured.hsd --bake -o pictured.gltf",
        ),
        ("text.svg", "draw text.svg -o text.svg"),
        ("part.svg", "draw pictured.hsd -o part.svg"),
        ("text.svg", "draw sound.hsd --font text.svg -o text.svg"),
        ("p.review.png", "plan p.review.png -o p.hsd"),
        ("q.sheet-2.jpg", "plan mask.png q.sheet-2.jpg -o q.hsd"),
        ("text.svg", "plan text.svg -o text.svg --force"),
        ("1-flat.png", "plan 1-flat.png -o p.hsd --steps ."),
        (
            "text.html",
            "plan mask.png --legend text.html -o text.html --force",
        ),
        ("front/rectified.png", "facade front/rectified.png -o front"),
        (
            "front/compared.png",
            "facade mask.png --mask front/compared.png -o front",
        ),
        ("text.mtl", "fmt sound.hsd --catalog text.mtl -o text.mtl"),
        ("part.svg", "fmt --to legacy including.hsd -o part.svg"),
        ("text.html", "parts --catalog text.html --sheet text.html"),
        ("text.png", "render text.png -o text.png"),
        (
            "x/sound-1.png",
            "render sound.hsd --camera x/sound-1.png -o x",
        ),
        ("decisions.csv", "town town-decisions.csv.hsd -o ."),
        ("report.json", "town town-report.json.hsd -o ."),
        ("report.json", "town town-report.json.hsd -o x/.."),
        ("tileset.json", "town town-tileset.json.hsd -o ."),
        ("decisions.csv", "town shares.hsd -o ."),
        (
            "out.decisions.csv",
            "town town-out.decisions.csv.hsd -o out.glb",
        ),
        (
            "out.decisions.csv",
            "town town-out.decisions.csv.hsd -o out.obj",
        ),
        (
            "out.report.json",
            "town town-out.report.json.hsd -o out.hsd",
        ),
        (
            "out.city.json",
            "town town-out.city.json.hsd -o out.city.json",
        ),
        (
            "town-report.json.hsd",
            "town town-report.json.hsd -o town-report.json.hsd",
        ),
        (
            "text.png",
            "town candidates --catalog text.png --key 1 -o text.png town-report.json.hsd",
        ),
        ("work.json", "town plan town-work.json.hsd -o ."),
        (
            "tileset.json",
            "town init tileset.json -o tileset.json --force",
        ),
    ] {
        faults.extend(fault(fixture().path(), file, line));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[cfg(unix)]
#[test]
fn links_to_an_input_are_recognised() {
    use std::os::unix::fs::symlink;
    for (to, link, line) in [
        ("sound.hsd", "link.glb", "build sound.hsd -o link.glb"),
        ("sound.hsd", "x/link.mtl", "build sound.hsd -o x/link.obj"),
        (
            "pictured_textures/sign.png",
            "link.glb",
            "build pictured.hsd -o link.glb",
        ),
        ("part.svg", "link.glb", "build pictured.hsd -o link.glb"),
        (
            "houses.prj",
            "link.glb",
            "town town-houses.shp.hsd -o link.glb",
        ),
        (
            "houses.dbf",
            "link.city.json",
            "town town-houses.shp.hsd -o link.city.json",
        ),
        (
            "houses.shx",
            "x/decisions.csv",
            "town town-houses.shp.hsd -o x",
        ),
        ("mask.png", "x/facade.json", "facade mask.png -o x"),
        ("mask.png", "p.plan.json", "plan mask.png -o p.hsd"),
    ] {
        for hard in [false, true] {
            let folder = fixture();
            let (to, link) = (folder.path().join(to), folder.path().join(link));
            match hard {
                true => fs::hard_link(&to, &link).unwrap(),
                false => symlink(&to, &link).unwrap(),
            }
            let shown = link.strip_prefix(folder.path()).unwrap();
            assert_refused(folder.path(), shown.to_str().unwrap(), line);
        }
    }
}

#[cfg(unix)]
#[test]
fn an_input_through_a_linked_folder_is_recognised() {
    let folder = fixture();
    std::os::unix::fs::symlink(".", folder.path().join("here")).unwrap();
    assert_refused(
        folder.path(),
        "here/text.obj",
        "build sound.hsd --catalog text.obj -o here/text.obj",
    );
    assert_refused(
        folder.path(),
        "decisions.csv",
        "town here/town-decisions.csv.hsd -o here",
    );
}

#[cfg(unix)]
#[test]
fn the_grid_of_the_ground_is_an_input() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    write("ground.tif", &tiff(TIFF, &cells().collect::<Vec<f64>>()));
    let corner = |x: f64, y: f64| format!("[{},{}]", AT.x + 100.0 + x, AT.y + 100.0 + y);
    let corners = [
        (0.0, 0.0),
        (12.0, 0.0),
        (12.0, 10.0),
        (0.0, 10.0),
        (0.0, 0.0),
    ];
    let ring = corners.map(|(x, y)| corner(x, y)).join(",");
    let start = LOT.find("[[[").unwrap();
    let lot = format!("{}[[{ring}]]}}}}]}}", &LOT[..start]);
    write("lot.geojson", lot.as_bytes());
    let town = "<Town name='t'><Layer name='a' src='lot.geojson' crs='EPSG:6674'/>\
        <Layer name='ground' src='ground.tif'/>\
        <for each='a'><Place type='hiraya' on='outline'/></for></Town>";
    write("t.hsd", town.as_bytes());
    let built = hsd(folder.path(), &["town", "t.hsd", "-o", "t.glb"]);
    assert_eq!(code(&built), 0, "{}", stderr(&built));
    for link in ["report.json", "out.glb", "out.decisions.csv"] {
        fs::hard_link(folder.path().join("ground.tif"), folder.path().join(link)).unwrap();
        let out = if link == "report.json" {
            "."
        } else {
            "out.glb"
        };
        assert_refused(folder.path(), link, &format!("town t.hsd -o {out}"));
        fs::remove_file(folder.path().join(link)).unwrap();
    }
}

/// A town in tiles has its images in the folder in which those of parts are looked for.
#[test]
fn images_of_parts_are_not_replaced_by_those_of_tiles() {
    let folder = tempfile::tempdir().unwrap();
    let textures = folder.path().join("textures");
    fs::create_dir(&textures).unwrap();
    // Not a power of two, so tiles have another image.
    image::RgbImage::new(97, 61)
        .save(textures.join("sign.png"))
        .unwrap();
    fs::write(textures.join("other.png"), "of another house").unwrap();
    let house = "<House><Storey><Row>KSK  sign </Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row>\
        <Row>KSK  KSK</Row></Storey></House>";
    let town = format!(
        "<Town name='t'><Layer name='a' src='lot.csv' crs='local'/><for each='a'>{house}</for></Town>"
    );
    fs::write(folder.path().join("t.hsd"), town).unwrap();
    fs::write(folder.path().join("lot.csv"), "x,y\n1,2\n").unwrap();
    let before = tree(folder.path());
    let output = hsd(folder.path(), &["town", "t.hsd", "-o", "."]);
    let after = tree(folder.path());
    for (name, bytes) in &before {
        assert!(
            after.get(name) == Some(bytes),
            "{name}: {}",
            stderr(&output)
        );
    }
}

/// An image that the second model or tile needs has the name of one beside the first.
#[test]
fn an_input_that_is_read_after_an_output_was_made_is_kept() {
    for (file, line) in [
        (
            "sound_textures/stone_color.jpg",
            "build sound.hsd two.hsd --format gltf -o .",
        ),
        (
            "o-0_0_textures/stone_color.jpg",
            "town two-tiles.hsd -o o.obj",
        ),
    ] {
        let folder = fixture();
        let image = folder.path().join(file);
        fs::create_dir_all(image.parent().unwrap()).unwrap();
        image::RgbImage::new(96, 64).save(image).unwrap();
        let pictured = PICTURED.replace("pictured_textures/sign.png", file);
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("two.hsd", &pictured);
        write("near.csv", "x,y\n1,2\n");
        write("far.csv", "x,y\n900,900\n");
        let second = pictured.replace("<include href='part.svg'/>", "");
        let town = format!(
            "<Town name='t'><Layer name='a' src='near.csv' crs='local'/>\
            <Layer name='b' src='far.csv' crs='local'/>\
            <for each='a'>{PLAIN}</for><for each='b'>{second}</for></Town>"
        );
        write("two-tiles.hsd", &town);
        assert_refused(folder.path(), file, line);
    }
}

#[test]
fn a_town_in_steps_keeps_its_layers() {
    let folder = fixture();
    let plan = ["town", "plan", "town-decisions.csv.hsd", "-o", "work"];
    let planned = hsd(folder.path(), &plan);
    assert_eq!(code(&planned), 0, "{}", stderr(&planned));
    let made = hsd(folder.path(), &["town", "tile", "work", "--all"]);
    assert_eq!(code(&made), 0, "{}", stderr(&made));
    assert_refused(folder.path(), "decisions.csv", "town seal work -o .");
}

#[test]
fn a_layer_in_the_folder_of_tiles_is_not_swept() {
    let folder = fixture();
    let line = ["town", "town-tiles-lot.geojson.hsd", "-o", "."];
    let output = hsd(folder.path(), &line);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let kept = fs::read(folder.path().join("tiles/lot.geojson")).unwrap();
    assert_eq!(kept, LOT.as_bytes());
}

#[test]
fn two_outputs_with_one_path_are_refused() {
    let folder = fixture();
    let listed = hsd(folder.path(), &["textures", "-o", "m"]);
    assert_eq!(code(&listed), 0, "{}", stderr(&listed));
    let one = names(&folder.path().join("m"));
    let one = one.iter().find(|name| name.ends_with(".jpg")).unwrap();
    let camera = r#"{"name":"a","from":[0,-9,2],"to":[0,0,2]}"#;
    let cameras = format!("[{camera},{camera}]");
    fs::write(folder.path().join("cameras.json"), cameras).unwrap();
    let render = "render sound.hsd --camera cameras.json -o x";
    let textures = format!("textures -o m --sheet m/{one}");
    let sheet = "build sound.hsd --variants 2 -o v.gltf --sheet v_textures/stone_color.jpg";
    for line in [&*textures, render, sheet] {
        let arguments: Vec<&str> = line.split(' ').collect();
        let output = hsd(folder.path(), &arguments);
        let said = stderr(&output);
        assert_ne!(code(&output), 0, "{line}: {said}");
        assert!(said.contains("would be written twice"), "{line}: {said}");
    }
}

#[test]
fn outputs_of_earlier_runs_and_files_edited_in_place_are_replaced() {
    let folder = fixture();
    for line in [
        "build sound.hsd -o a.obj",
        "build pictured.hsd -o b.gltf",
        "draw sound.hsd -o a.svg",
        "town town-report.json.hsd -o out",
        "town town-report.json.hsd -o out.glb",
        "town town-report.json.hsd -o out.city.jsonl",
        "fmt sound.hsd sound.hsd ./sound.hsd",
        "fmt sound.hsd -o sound.hsd",
        "fmt sound.hsd text.mtl -o .",
        "man pages",
    ] {
        for run in 0..2 {
            let arguments: Vec<&str> = line.split(' ').collect();
            let output = hsd(folder.path(), &arguments);
            assert_eq!(code(&output), 0, "{line}, run {run}: {}", stderr(&output));
        }
    }
}
