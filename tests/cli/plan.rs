//! `hsd plan`.

use super::{code, hsd, names, stderr};
use crate::plan_drawings::{self as drawings, Convention, Degradation, Variant};
use std::fs;
use std::path::Path;

/// Puts the scan of a plan into a folder.
fn draw(folder: &Path, name: &str, seed: u64, way: Degradation) {
    let plan = drawings::plan(seed);
    let variant = Variant {
        seed,
        unseen: false,
    };
    let drawn = drawings::draw(&plan, Convention::Survey, variant, 40.0);
    let (picture, _) = drawings::degrade(drawn.picture, way, seed);
    picture.save(folder.join(name)).unwrap();
}

#[test]
fn a_scan_becomes_a_house_that_stands() {
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "scan.png", 1, Degradation::Scanned);
    let output = hsd(
        folder.path(),
        &["plan", "scan.png", "-o", "house.hsd", "--steps", "steps"],
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(
        names(folder.path()),
        [
            "house.hsd",
            "house.plan.json",
            "house.review.png",
            "house.sheet-1.jpg",
            "scan.png",
            "steps"
        ]
    );
    assert_eq!(names(&folder.path().join("steps")).len(), 5);
    let output = hsd(folder.path(), &["build", "house.hsd", "-o", "house.glb"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // What is in doubt is said of the text and of the picture, as often as rings are drawn.
    let text = fs::read_to_string(folder.path().join("house.hsd")).unwrap();
    assert!(text.contains("Read by hsd plan from scan.png: legend survey"));
    assert!(text.contains("heights of storeys: 10 shaku"));
}

#[test]
fn a_second_reading_keeps_what_was_changed_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let house = folder.path().join("house.hsd");
    draw(folder.path(), "scan.png", 1, Degradation::Scanned);
    let read = |arguments: &[&str]| {
        let plan = ["plan", "scan.png", "-o", "house.hsd", "-q"];
        let output = hsd(folder.path(), &[&plan, arguments].concat());
        (code(&output), stderr(&output))
    };
    assert_eq!(read(&[]).0, 0);
    let first = fs::read_to_string(&house).unwrap();
    let changed = first
        .replacen("<Room name=\"1\"", "<Room name=\"座敷\"", 1)
        .replacen("pitch=\"4.5\"", "pitch=\"4\"", 1);
    assert_ne!(first, changed);
    fs::write(&house, &changed).unwrap();
    // The same scan brings nothing new.
    let (status, said) = read(&[]);
    assert_eq!(status, 0, "{said}");
    assert_eq!(fs::read_to_string(&house).unwrap(), changed);
    // Another reading, with other parts: the changes stay in it.
    assert_eq!(read(&["--era", "showa"]).0, 0);
    let second = fs::read_to_string(&house).unwrap();
    assert!(second.contains("座敷") && second.contains("pitch=\"4\""));
    assert!(second.contains("KSS  ") && !first.contains("KSS  "));
    assert_eq!(read(&["--force"]).0, 0);
    assert_eq!(fs::read_to_string(&house).unwrap(), first);
}

#[test]
fn two_storeys_lie_over_each_other() {
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "ground.png", 1, Degradation::Clean);
    draw(folder.path(), "upper.png", 1, Degradation::Scanned);
    let plan = ["plan", "ground.png", "upper.png", "-o", "house.hsd"];
    let output = hsd(folder.path(), &plan);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("house.hsd")).unwrap();
    // The same plan twice: no storey is shifted.
    assert!(text.contains("<Storey height=\"9.5\">\n") && text.contains("<Storey height=\"9\">\n"));
    assert!(folder.path().join("house.review-2.png").exists());
    assert!(folder.path().join("house.sheet-2.jpg").exists());
}

#[test]
fn what_cannot_be_read_is_told_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "a note").unwrap();
    let blank = image::RgbImage::from_pixel(300, 200, image::Rgb([250; 3]));
    blank.save(folder.path().join("blank.png")).unwrap();
    fs::write(
        folder.path().join("mine.xml"),
        "<Legend name=\"mine\">\n  <Symbol role=\"door\"/>\n</Legend>\n",
    )
    .unwrap();
    draw(folder.path(), "scan.png", 1, Degradation::Clean);
    for (arguments, status, said) in [
        (&["notes.txt"][..], 1, "HSD1204"),
        (&["blank.png"], 1, "HSD1203"),
        (&["scan.png", "--legend", "mine.xml"], 1, "HSD1205"),
        (&["scan.png", "--legend", "nowhere.xml"], 3, "nowhere.xml"),
        (&["missing.png"], 3, "missing.png"),
        (&["scan.png", "--corners", "1,1 2,2"], 2, "four points"),
        (
            &["scan.png", "--corners", "0,0 0,90 90,90 90,0"],
            2,
            "clockwise",
        ),
        (&["scan.png", "--unit", "ken"], 2, "kyo-ma"),
    ] {
        let plan = [&["plan"], arguments, &["-o", "house.hsd"]].concat();
        let output = hsd(folder.path(), &plan);
        assert_eq!(code(&output), status, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
        assert!(!folder.path().join("house.hsd").exists(), "{arguments:?}");
    }
    // A house of another hand is not replaced.
    fs::write(folder.path().join("house.hsd"), "mine").unwrap();
    let output = hsd(folder.path(), &["plan", "scan.png", "-o", "house.hsd"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--force"));
}
