//! `hsd draw`.

use super::{code, folder, hsd, stderr};
use std::fs;

#[test]
fn drawings_have_the_format_of_their_name() {
    let folder = folder();
    for (name, start) in [
        ("a.svg", &b"<svg "[..]),
        ("a.pdf", b"%PDF-"),
        ("a.dxf", b"0\nSECTION\n"),
    ] {
        let output = hsd(folder.path(), &["draw", "sound.hsd", "-o", name]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(
            stderr(&output).contains("plan-1, roof, site, front, right, back, left, section-a=")
        );
        assert!(
            fs::read(folder.path().join(name))
                .unwrap()
                .starts_with(start),
            "{name}"
        );
    }
    // Texts become outlines where a font is found; without one the image has none.
    let output = hsd(
        folder.path(),
        &[
            "draw",
            "sound.hsd",
            "-o",
            "a.png",
            "--view",
            "front",
            "--dpi",
            "60",
        ],
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let image = image::open(folder.path().join("a.png")).unwrap().to_luma8();
    assert!(image.pixels().any(|p| p.0[0] < 60));
}

#[test]
fn scales_and_sheets_fit_each_other() {
    let folder = folder();
    let said = |arguments: &[&str]| {
        let output = hsd(
            folder.path(),
            &[&["draw", "sound.hsd", "-o", "a.svg"], arguments].concat(),
        );
        (code(&output), stderr(&output))
    };
    let (status, text) = said(&[]);
    assert!(status == 0 && text.contains(" on 420 x 297 mm"), "{text}");
    let (status, text) = said(&["--scale", "1:20"]);
    assert!(status == 0 && text.contains("1:20 on "), "{text}");
    let (status, text) = said(&["--sheet", "a4", "--scale", "1:10"]);
    assert!(
        status == 2 && text.contains("do not fit on A4 at 1:10"),
        "{text}"
    );
    let (status, text) = said(&["--view", "plan-1", "--scale", "50"]);
    assert!(
        status == 0 && text.contains("a.svg: plan-1 at 1:50"),
        "{text}"
    );
}

#[test]
fn wishes_that_cannot_be_drawn_are_refused() {
    let folder = folder();
    fs::write(folder.path().join("no.ttf"), "no font").unwrap();
    let cases: [(&[&str], i32, &str); 8] = [
        (&["sound.hsd", "-o", "a.gif"], 2, ".svg, .pdf, .dxf or .png"),
        (
            &["sound.hsd", "-o", "a.svg", "--view", "attic"],
            2,
            "expected plan",
        ),
        (
            &["sound.hsd", "-o", "a.svg", "--view", "plan-3"],
            2,
            "the highest is 1",
        ),
        (
            &["sound.hsd", "-o", "a.svg", "--section", "c=1"],
            2,
            "as in `a=3.5`",
        ),
        (
            &["sound.hsd", "-o", "a.svg", "--scale", "big"],
            2,
            "as in 1:100",
        ),
        (
            &["sound.hsd", "-o", "a.svg", "--house", "kura"],
            2,
            "no house is called kura",
        ),
        (
            &["sound.hsd", "-o", "a.svg", "--font", "no.ttf"],
            2,
            "is no font",
        ),
        (&["broken.hsd", "-o", "a.svg"], 1, "HSD"),
    ];
    for (arguments, status, words) in cases {
        let output = hsd(folder.path(), &[&["draw"], arguments].concat());
        let said = stderr(&output);
        assert!(
            code(&output) == status && said.contains(words),
            "{arguments:?}: {said}"
        );
        assert!(!folder.path().join("a.svg").exists(), "{arguments:?}");
    }
}
