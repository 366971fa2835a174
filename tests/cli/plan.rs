//! `hsd plan`.

use super::{code, hsd, names, stderr};
use crate::plan_drawings::{self as drawings, Cad, Convention, Degradation, Variant};
use std::fs;
use std::path::Path;

/// Puts the scan of a plan into a folder.
fn draw(folder: &Path, name: &str, seed: u64, way: Degradation) {
    let plan = drawings::plan(seed);
    let variant = Variant {
        seed,
        unseen: false,
    };
    let drawn = drawings::draw(&plan, Convention::Sashizu, variant, 40.0);
    let (picture, _) = drawings::degrade(drawn.picture, way, seed);
    picture.save(folder.join(name)).unwrap();
}

#[test]
fn a_scan_becomes_a_house_that_stands() {
    let folder = tempfile::tempdir().unwrap();
    draw(folder.path(), "scan.png", 2, Degradation::Scanned);
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
    assert!(text.contains("Read by hsd plan from scan.png: legend sashizu"));
    assert!(text.contains("heights of storeys: 10 shaku"));
}

#[test]
fn a_second_reading_keeps_what_was_changed_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let house = folder.path().join("house.hsd");
    draw(folder.path(), "scan.png", 2, Degradation::Scanned);
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
    draw(folder.path(), "ground.png", 2, Degradation::Clean);
    draw(folder.path(), "upper.png", 2, Degradation::Scanned);
    let plan = ["plan", "ground.png", "upper.png", "-o", "house.hsd"];
    let output = hsd(folder.path(), &plan);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("house.hsd")).unwrap();
    // The same plan twice: no storey is shifted.
    assert!(text.contains("<Storey height=\"9.5\">\n") && text.contains("<Storey height=\"9\">\n"));
    assert!(folder.path().join("house.review-2.png").exists());
    assert!(folder.path().join("house.sheet-2.jpg").exists());
}

/// Reads a sheet with two plans, then its storeys by the boxes that are named; returns the text of the house.
fn storeys_of(folder: &Path, plan: &[&str]) -> String {
    let output = hsd(folder, plan);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let said = stderr(&output);
    assert!(said.contains("HSD1208"), "{said}");
    let boxes = said.split("--region \"").skip(1);
    let boxes = boxes.map(|rest| rest.split('"').next().unwrap_or(""));
    let regions: Vec<&str> = boxes.flat_map(|region| ["--region", region]).collect();
    assert_eq!(regions.len(), 4, "{said}");
    let output = hsd(folder, &[plan, &regions].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(folder.join("house.hsd")).unwrap();
    assert_eq!(text.matches("<Storey").count(), 2, "{text}");
    text
}

/// Asserts the width and depth of two storeys, metres, by the comment of a house.
fn assert_sizes(text: &str, sizes: [[f64; 2]; 2]) {
    let lines = text.lines().filter(|line| line.contains(" m2, "));
    for (line, expected) in lines.zip(sizes) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let size = [words[0], words[2]].map(|word| word.parse::<f64>().unwrap());
        let off = (size[0] - expected[0])
            .abs()
            .max((size[1] - expected[1]).abs());
        assert!(off < 0.12, "{line}: {expected:?} expected");
    }
}

#[test]
fn storeys_on_one_sheet_are_named_by_their_boxes() {
    // The larger image is reduced before it is read.
    for times in [1, 3] {
        let folder = tempfile::tempdir().unwrap();
        let sheet = crate::plans::several::sheet();
        let (width, height) = (sheet.width() * times, sheet.height() * times);
        let nearest = image::imageops::FilterType::Nearest;
        let sheet = image::imageops::resize(&sheet, width, height, nearest);
        sheet.save(folder.path().join("sheet.png")).unwrap();
        let unit = (40 * times).to_string();
        let plan = ["plan", "sheet.png", "-o", "house.hsd", "--unit-px", &unit];
        let text = storeys_of(folder.path(), &plan);
        let metres = |units: [f64; 2]| units.map(|u| u * hsd::plan::walls::writing::UNIT);
        assert_sizes(&text, [metres([9.3, 6.2]), metres([5.6, 6.2])]);
        for name in ["house.review-2.png", "house.sheet-2.jpg"] {
            assert!(folder.path().join(name).exists(), "{name}");
        }
        let beyond = ["--region", "90000,1 90001,9", "--force"];
        let output = hsd(folder.path(), &[&plan[..], &beyond].concat());
        assert_eq!(code(&output), 1);
        assert!(stderr(&output).contains("outside the image"));
        // Three boxes do not belong to two files.
        let three = ["--region", "1,1 9,9"].repeat(3);
        let both = [&plan[..], &["sheet.png"], &three].concat();
        assert_eq!(code(&hsd(folder.path(), &both)), 2);
    }
}

#[test]
fn storeys_of_one_drawing_have_one_scale() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("two.dxf"),
        crate::plan_vectors::two_storeys(),
    )
    .unwrap();
    let text = storeys_of(folder.path(), &["plan", "two.dxf", "-o", "house.hsd"]);
    assert_sizes(&text, [[6.99, 5.13], [3.99, 5.13]]);
}

#[test]
fn an_upper_storey_may_stand_back_from_the_street() {
    let folder = tempfile::tempdir().unwrap();
    let depth = |seed: &u64| drawings::plan(*seed).depth;
    let (shallow, deep) = (
        (1..40).min_by_key(depth).unwrap(),
        (1..40).max_by_key(depth).unwrap(),
    );
    draft(folder.path(), "ground.dxf", deep, "");
    draft(folder.path(), "upper.dxf", shallow, "");
    // About ten units behind the street.
    let plan = ["plan", "ground.dxf", "upper.dxf", "-o", "house.hsd"];
    let back = ["--register", "0,-9000=0,0"];
    let output = hsd(folder.path(), &[&plan[..], &back].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("house.hsd")).unwrap();
    assert_eq!(text.matches("<Storey").count(), 2);
    assert!(text.contains("<Storey height=\"9\" start="), "{text}");
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
    draw(folder.path(), "scan.png", 2, Degradation::Clean);
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
    // Where nothing was found, one sees how far the steps came.
    let steps = ["plan", "blank.png", "-o", "house.hsd", "--steps", "steps"];
    assert_eq!(code(&hsd(folder.path(), &steps)), 1);
    let drawn = names(&folder.path().join("steps"));
    assert_eq!(drawn, ["1-flat.png", "2-ink.png"]);
    // A house of another hand is not replaced.
    fs::write(folder.path().join("house.hsd"), "mine").unwrap();
    let output = hsd(folder.path(), &["plan", "scan.png", "-o", "house.hsd"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--force"));
}

/// Puts the DXF of a plan into a folder, its layers with a prefix.
fn draft(folder: &Path, name: &str, seed: u64, prefix: &str) {
    let variant = Variant {
        seed,
        unseen: false,
    };
    let text = drawings::dxf(&drawings::plan(seed), Cad::Lines, variant);
    let layers = ["WALL", "SLIDE", "HINGED", "WINDOW", "LATTICE", "POST"];
    let text = layers.iter().fold(text, |text, layer| {
        text.replace(&format!("\n{layer}\n"), &format!("\n{prefix}{layer}\n"))
    });
    fs::write(folder.join(name), text).unwrap();
}

#[test]
fn a_drawing_is_read_by_its_layers_and_reviewed_like_a_scan() {
    let folder = tempfile::tempdir().unwrap();
    // The ending says nothing.
    draft(folder.path(), "plan.dwg", 1, "");
    let output = hsd(folder.path(), &["plan", "plan.dwg", "-o", "house.hsd"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let beside = ["house.plan.json", "house.review.png", "house.sheet-1.jpg"];
    let there = names(folder.path());
    assert!(beside.iter().all(|name| there.iter().any(|n| n == name)));
    let text = fs::read_to_string(folder.path().join("house.hsd")).unwrap();
    assert!(text.contains("Read by hsd plan from plan.dwg: legend cad"));
    let output = hsd(folder.path(), &["build", "house.hsd", "-o", "house.glb"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let given = ["plan", "plan.dwg", "-o", "turned.hsd", "--turn", "2"];
    let output = hsd(folder.path(), &given);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("plan.dwg is a drawing"));
    // From the other side the same walls, and the street at the other end.
    let turned = ["plan", "plan.dwg", "-o", "turned.hsd", "--front", "top"];
    let output = hsd(folder.path(), &turned);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let turned = fs::read_to_string(folder.path().join("turned.hsd")).unwrap();
    let parts = |text: &str, part: &str| text.matches(part).count();
    for part in ["KTU", "TSH", "GSI"] {
        assert_eq!(parts(&text, part), parts(&turned, part), "{part}");
    }
    assert_ne!(text.replace("house", ""), turned.replace("turned", ""));
}

#[test]
fn layers_of_other_names_are_told_and_a_legend_gives_them_roles() {
    let folder = tempfile::tempdir().unwrap();
    let dxf = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n下書き\n10\n0\n20\n0\n11\n90\n21\n40\n0\nLINE\n8\n下書き\n10\n3\n20\n7\n11\n50\n21\n2\n0\nENDSEC\n0\nEOF\n";
    fs::write(folder.path().join("sketch.dxf"), dxf).unwrap();
    let output = hsd(folder.path(), &["plan", "sketch.dxf", "-o", "house.hsd"]);
    assert_eq!(code(&output), 1);
    let said = stderr(&output);
    // Long lines are broken, kanji anywhere.
    let words: String = said
        .chars()
        .filter(|c| !c.is_whitespace() && *c != '│')
        .collect();
    assert!(
        said.contains("HSD1203") && words.contains("`下書き`"),
        "{said}"
    );
    // Roles of a legend hold before the usual ones.
    draft(folder.path(), "plan.dxf", 1, "");
    let none = "<Legend name=\"none\">\n  <Layer name=\"*\" role=\"ignore\"/>\n</Legend>\n";
    fs::write(folder.path().join("none.xml"), none).unwrap();
    let read = |legend: &str| {
        let plan = ["plan", "plan.dxf", "-o", "house.hsd", "--legend", legend];
        let output = hsd(folder.path(), &plan);
        (code(&output), stderr(&output))
    };
    assert_eq!(read("none.xml").0, 1);
    let wrong = "<Legend name=\"mine\">\n  <Layer name=\"A\" role=\"kamoi\"/>\n</Legend>\n";
    fs::write(folder.path().join("wrong.xml"), wrong).unwrap();
    let (status, said) = read("wrong.xml");
    assert_eq!(status, 1);
    assert!(
        said.contains("HSD1205") && said.contains("wrong.xml:2:3"),
        "{said}"
    );
}

#[test]
fn damaged_drawings_are_refused_at_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    file("cut.dxf", b"0\nSECTION\n2\nENTITIES\n0\nLINE\n");
    file("odd.dxf", b"0\nSECTION\nENTITIES\n");
    file(
        "open.svg",
        b"<svg xmlns=\"http://www.w3.org/2000/svg\">\n<g>\n",
    );
    file(
        "empty.svg",
        b"<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n",
    );
    file("plan.pdf", b"%PDF-1.4\nnothing\n");
    file("plan.dwg", b"AC1032\0\0\0\0");
    for (name, code_said, said) in [
        ("cut.dxf", "HSD1204", "`EOF` is missing"),
        ("odd.dxf", "HSD1204", "odd.dxf:3:1"),
        ("open.svg", "HSD1204", "open.svg:3:1"),
        ("empty.svg", "HSD1203", "no lines"),
        ("plan.pdf", "HSD1204", "PDF"),
        ("plan.dwg", "HSD1204", "save it as DXF"),
    ] {
        let output = hsd(folder.path(), &["plan", name, "-o", "house.hsd"]);
        let words = stderr(&output);
        assert_eq!(code(&output), 1, "{name}: {words}");
        assert!(words.contains(code_said) && words.contains(said), "{words}");
        assert!(!folder.path().join("house.hsd").exists(), "{name}");
    }
}

#[test]
fn a_plan_of_hsd_draw_comes_back_as_its_house() {
    let folder = tempfile::tempdir().unwrap();
    let rooms = crate::support::root().join("examples/rooms.hsd");
    let rooms = rooms.to_str().unwrap();
    let run = |arguments: &[&str]| {
        let output = hsd(folder.path(), arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    };
    run(&["draw", rooms, "--view", "plan-1", "-o", "plan.svg"]);
    run(&["plan", "plan.svg", "-o", "again.hsd"]);
    run(&["draw", "again.hsd", "--view", "plan-1", "-o", "again.svg"]);
    run(&["plan", "again.svg", "-o", "third.hsd"]);
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(text("again.hsd"), text("third.hsd"));
    assert!(text("again.hsd").contains("座敷"));
    // It is a whole house, not a sheet among others.
    let both = ["plan", "plan.svg", "again.svg", "-o", "both.hsd"];
    let output = hsd(folder.path(), &both);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("read it alone"));
}
