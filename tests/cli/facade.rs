//! `hsd facade`.

use super::{code, hsd, names, stderr};
use crate::fronts::plain;
use crate::fronts::scene::{Facade, Shot};
use crate::view::web::Web;
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// Puts the photograph of a wall into a folder; returns the option that gives its size.
fn draw(folder: &Path, name: &str, seed: u64) -> String {
    let facade = Facade::new(seed);
    let picture = Shot::new(&facade, seed, 640, 1).draw(&facade);
    picture.save(folder.join(name)).unwrap();
    format!("{:.3},{:.3}", facade.width, facade.height)
}

#[test]
fn a_photograph_becomes_parts_that_build() {
    let folder = tempfile::tempdir().unwrap();
    let size = draw(folder.path(), "photo.png", 0);
    let facade = [
        "facade",
        "photo.png",
        "-o",
        "front",
        "--size",
        &size,
        "--fronts",
        "kanban",
    ];
    let output = hsd(folder.path(), &facade);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let written = names(&folder.path().join("front"));
    for name in [
        "compared.png",
        "facade.json",
        "front-street.hsd",
        "front.hsd",
        "kanban.1.png",
        "kanban-upper.1.png",
        "parts.csv",
        "rectified.png",
    ] {
        assert!(
            written.iter().any(|w| w == name),
            "{name} is not in {written:?}"
        );
    }
    let json = fs::read_to_string(folder.path().join("front/facade.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        record["photos"][0]["homography"].as_array().unwrap().len(),
        9
    );
    for part in record["parts"].as_array().unwrap() {
        let picture = format!("front/{}.png", part["same_as"].as_str().unwrap());
        assert!(folder.path().join(&picture).exists(), "{picture}");
    }
    let text = fs::read_to_string(folder.path().join("front/front.hsd")).unwrap();
    assert!(text.contains("<repeat num=\""), "{text}");
    let output = hsd(
        folder.path(),
        &["build", "front/front.hsd", "-o", "front.glb"],
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // It stands in a street, too.
    let street = ["build", "front/front-street.hsd", "-o", "street.glb"];
    let output = hsd(folder.path(), &street);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(!stderr(&output).contains("warning"), "{}", stderr(&output));
    // The same again, and the next number for the front.
    let again = hsd(folder.path(), &facade);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    assert_eq!(
        json,
        fs::read_to_string(folder.path().join("front/facade.json")).unwrap()
    );
    assert!(folder.path().join("front/kanban.2.png").exists());
}

#[test]
fn what_cannot_be_read_is_said() {
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "photo.png", 1);
    fs::write(folder.path().join("notes.png"), "no picture").unwrap();
    image::RgbImage::new(64, 48)
        .save(folder.path().join("blank.png"))
        .unwrap();
    let corners = "10,10 50,10 50,40 10,40";
    let cases: [(&[&str], &str); 5] = [
        (&["notes.png"], "HSD1302"),
        (&["blank.png"], "HSD1301"),
        (&["blank.png", "--corners", corners], "HSD1305"),
        (
            &[
                "photo.png",
                "--corners",
                "100,100 500,100 500,400 100,400",
                "--grid",
                "60x60",
            ],
            "HSD1306",
        ),
        (
            &[
                "photo.png",
                "--corners",
                "100,100 500,100 500,400 100,400",
                "--grid",
                "3x2",
            ],
            "HSD1303",
        ),
    ];
    for (arguments, said) in cases {
        let output = hsd(
            folder.path(),
            &[&["facade"], arguments, &["-o", "out"]].concat(),
        );
        assert!(
            stderr(&output).contains(said),
            "{arguments:?}: {}",
            stderr(&output)
        );
    }
}

#[test]
fn masks_hide_what_stands_before_the_wall() {
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "photo.png", 2);
    let white = image::GrayImage::from_pixel(640, 480, image::Luma([255]));
    white.save(folder.path().join("all.png")).unwrap();
    image::GrayImage::new(10, 10)
        .save(folder.path().join("small.png"))
        .unwrap();
    let facade = [
        "facade",
        "photo.png",
        "-o",
        "out",
        "--grid",
        "3x3",
        "--mask",
    ];
    let output = hsd(folder.path(), &[&facade[..], &["all.png"]].concat());
    assert!(stderr(&output).contains("HSD1304"), "{}", stderr(&output));
    let output = hsd(folder.path(), &[&facade[..], &["small.png"]].concat());
    assert_eq!(code(&output), 2, "{}", stderr(&output));
}

/// `hsd view --facade`, until the end of a test.
struct Page(Child);

impl Page {
    fn open(folder: &Path, arguments: &[&str]) -> (Page, Web) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
        command
            .current_dir(folder)
            .args(["view", "--no-open", "--facade"])
            .args(arguments)
            .env("LC_ALL", "C")
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut url = String::new();
        let output = child.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut url).unwrap();
        (Page(child), Web::new(url.trim()))
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn the_page_of_photographs_builds_what_the_command_writes() {
    if !hsd::view::is_built() {
        return; // Built without its page.
    }
    let folder = tempfile::tempdir().unwrap();
    let size = draw(folder.path(), "photo.png", 0);
    let output = hsd(
        folder.path(),
        &["facade", "photo.png", "-o", "front", "--size", &size],
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let (_page, web) = Page::open(folder.path(), &["photo.png"]);
    assert_eq!(web.get("/api/hello").json()["front"], json!(true));
    let about = web.get("/api/front").json();
    assert_eq!(about["folder"], json!("photo"));
    assert_eq!(about["told"], Value::Null);
    assert_eq!(&web.get("/api/front/photo?number=0").body[..2], b"\xff\xd8");
    assert_eq!(web.get("/api/front/photo?number=1").status, 404);
    let size: Vec<f64> = size.split(',').map(|n| n.parse().unwrap()).collect();
    let corners = &about["photos"][0]["corners"];
    let ask = |corners: &Value, quick: bool| {
        let marked = json!({ "corners": corners, "mask": [] });
        let asked =
            json!({ "photo": 0, "marked": marked, "size": size, "finds": true, "quick": quick });
        web.post("/api/front/straight", &asked).json()
    };
    let (straight, quick) = (ask(corners, false), ask(corners, true));
    let starts = |s: &Value, kind: &str| s["picture"].as_str().unwrap().starts_with(kind);
    assert!(starts(&straight, "data:image/jpeg;base64,") && starts(&quick, "data:image/bmp;"));
    assert!(quick["size"][0].as_u64() < straight["size"][0].as_u64());
    // Corners that are no wall are refused in words.
    let crossed = json!([[300, 100], [100, 100], [100, 300], [300, 300]]);
    let refused = ask(&crossed, false)["refused"].to_string();
    assert!(refused.contains("clockwise"), "{refused}");
    let lattice = &straight["lattice"];
    let told = json!({
        "photos": [{ "corners": corners, "mask": [] }], "size": size,
        "columns": lattice["columns"], "rows": lattice["rows"],
    });
    let built = web.post("/api/front/build", &told).json();
    assert!(built["said"].is_string(), "{built}");
    let read = |path: &str| fs::read(folder.path().join(path)).unwrap();
    for name in names(&folder.path().join("front")) {
        // Found corners are trusted less than told ones.
        if name != "facade.json" && !name.ends_with(".hsd") {
            let (by_command, by_page) = (
                read(&format!("front/{name}")),
                read(&format!("photo/{name}")),
            );
            assert!(by_command == by_page, "{name} differs");
        }
    }
    assert_eq!(read("front/front.hsd"), read("photo/photo.hsd"));
    // The model is there, and what was told comes again.
    let state = web.state("photo/photo.hsd");
    assert!(
        state["diagnostics"].as_array().unwrap().is_empty(),
        "{}",
        state["diagnostics"]
    );
    assert_eq!(web.get("/api/front").json()["told"], told);
}

#[test]
fn masks_painted_in_the_page_are_written_for_the_command() {
    if !hsd::view::is_built() {
        return; // Built without its page.
    }
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "photo.png", 0);
    let (_page, web) = Page::open(folder.path(), &["photo.png", "-o", "out"]);
    let about = web.get("/api/front").json();
    let stroke = json!({ "erases": false, "width": 60, "points": [[300, 200], [330, 260]] });
    let marked = json!({ "corners": about["photos"][0]["corners"], "mask": [stroke] });
    let even = [0.25, 0.5, 0.75];
    let told = json!({ "photos": [marked], "size": null, "columns": even, "rows": even });
    let built = web.post("/api/front/build", &told).json();
    assert!(built["said"].is_string(), "{built}");
    for file in ["front", "street"] {
        let file = about["files"][file].as_str().unwrap();
        let state = web.state(file);
        assert_eq!(state["diagnostics"], json!([]), "{file}");
    }
    let mask = image::open(folder.path().join("out/mask-1.png"))
        .unwrap()
        .into_luma8();
    let white = mask.pixels().filter(|p| p[0] > 0).count() as f64;
    let length = 30.0_f64.hypot(60.0);
    let area = 60.0 * length + 900.0 * std::f64::consts::PI;
    assert!((white / area - 1.0).abs() < 0.02, "{white} {area}");
    // A server that is to write nothing says so; what is no photograph is no page.
    let (_page, web) = Page::open(folder.path(), &["photo.png", "--read-only", "-o", "none"]);
    let refused = web.post("/api/front/build", &told).json()["refused"].to_string();
    assert!(refused.contains("--read-only"), "{refused}");
    assert!(!folder.path().join("none").exists());
    fs::write(folder.path().join("notes.png"), "no picture").unwrap();
    let output = hsd(
        folder.path(),
        &["view", "--no-open", "--facade", "notes.png"],
    );
    assert!(stderr(&output).contains("HSD1302"), "{}", stderr(&output));
    assert_eq!(code(&output), 1);
}

#[test]
fn parts_have_variations() {
    let folder = tempfile::tempdir().unwrap();
    let (mut picture, _) = plain(1.0);
    // Something small in each window, never at the same place as beside it.
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let is_wall = (80..560).contains(&x) && (60..420).contains(&y);
        let (row, column) = ((y + 60) / 120, (x + 40) / 120);
        let left = 30 + 9 * ((4 * row + column) % 5);
        let is_there = (left..left + 18).contains(&((x + 40) % 120));
        if is_wall && is_there && (40..63).contains(&((y + 60) % 120)) {
            pixel.0 = [200, 190, 150];
        }
    }
    picture.save(folder.path().join("photo.png")).unwrap();
    let corners = "80,60 560,60 560,420 80,420";
    let grid = ["--corners", corners, "--size", "4,3", "--grid", "4x3"];
    let facade = ["facade", "photo.png", "-o", "front", "--variations", "2"];
    let output = hsd(folder.path(), &[&facade[..], &grid].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let written = names(&folder.path().join("front"));
    let of = |end: &str| {
        let parts = written.iter().filter(|n| n.starts_with("f1"));
        parts.filter(|n| n.ends_with(end)).count()
    };
    let (first, second, third) = (of("v1.png"), of("v2.png"), of("v3.png"));
    assert!(first > 0 && second > 0 && third == 0, "{written:?}");
    // Each place draws one of the set.
    let text = fs::read_to_string(folder.path().join("front/front.hsd")).unwrap();
    assert!(text.contains("<random code=\"f1f"), "{text}");
    let catalogue = fs::read_to_string(folder.path().join("front/parts.csv")).unwrap();
    assert_eq!(catalogue.matches("v1.png").count(), first);
    let output = hsd(folder.path(), &["check", "front/front.hsd"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}
