//! `hsd facade`.

use super::{code, hsd, names, stderr};
use crate::fronts::scene::{Facade, Shot};
use std::fs;
use std::path::Path;

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
