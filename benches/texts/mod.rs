//! Texts to measure with: as large as asked, the same in every run.
#![allow(dead_code, unreachable_pub)] // each bench uses its own share

use hsd::Options;
use hsd::building::{Building, Shell};
use hsd::diagnostic::Diagnostics;
use hsd::driver;
use hsd::source::{FileId, NoFiles, Source};

/// Source to building, as `hsd check` does it.
pub fn check(text: &str) -> (Building, Diagnostics) {
    let options = Options::default();
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "bench.hsd", text.as_bytes());
    let documents = driver::documents(&[&source], &NoFiles, &options, &mut out).documents;
    let (sources, expand) = (&[&source], &options.expand);
    let program = driver::program(
        sources,
        &documents,
        hsd::parse::builtin(),
        &NoFiles,
        expand,
        &mut out,
    );
    drop(documents);
    (
        driver::building(program, hsd::parse::builtin(), &mut out),
        out,
    )
}

/// A building that must be free of errors, or the bench measures the wrong thing.
pub fn building(text: &str) -> Building {
    let (building, out) = check(text);
    let told = out.iter().next().map(|d| d.message.clone());
    assert!(!out.has_errors(), "the text is wrong: {told:?}");
    building
}

/// The walls of houses without their roofs; free of errors as well.
pub fn shell(text: &str) -> Shell {
    let options = Options::default();
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "bench.hsd", text.as_bytes());
    let documents = driver::documents(&[&source], &NoFiles, &options, &mut out).documents;
    let (sources, expand) = (&[&source], &options.expand);
    let program = driver::program(
        sources,
        &documents,
        hsd::parse::builtin(),
        &NoFiles,
        expand,
        &mut out,
    );
    let shell = hsd::lower::lower(program, &mut out);
    assert!(!out.has_errors(), "the text is wrong");
    shell
}

/// A legacy text of `bytes` or a little more: dressed houses, one after another.
pub fn legacy(bytes: usize) -> String {
    let house = include_str!("../../examples/machiya.hsd").trim_end();
    let mut text = house.to_owned();
    while text.len() < bytes {
        text += "\n%\n";
        text += house;
    }
    text
}

/// `count` dressed machiya.
pub fn machiya(count: usize) -> String {
    let house = include_str!("../../examples/machiya.hsd").trim_end();
    vec![house; count].join("\n%\n")
}

/// A wall of so many units, then a right turn, or a left one.
fn wall(units: usize, left: bool) -> String {
    "KSK  ".repeat(units) + if left { "L\n" } else { "\n" }
}

/// `count` houses of one storey without written roofs: rectangles, L and T in turn, 4 to 15 units long.
pub fn outlines(count: usize) -> String {
    let mut state = 1_u64;
    let mut size = |low: usize, high: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (state >> 33) as usize % (high - low + 1)
    };
    let mut house = |index: usize| {
        let (a, b, c, d, e) = (size(4, 15), size(4, 15), size(1, 6), size(1, 6), size(2, 5));
        let walls = match index % 3 {
            0 => vec![(a, false), (b, false), (a, false), (b, false)],
            1 => vec![
                (a + c, false),
                (b, false),
                (c, true),
                (d, false),
                (a, false),
                (b + d, false),
            ],
            _ => vec![
                (a + c + e, false),
                (b, false),
                (a, true),
                (d, false),
                (c, false),
                (d, true),
                (e, false),
                (b, false),
            ],
        };
        wall_text(&walls)
    };
    let houses: Vec<String> = (0..count).map(&mut house).collect();
    houses.join("%\n")
}

fn wall_text(walls: &[(usize, bool)]) -> String {
    let lines: String = walls.iter().map(|&(n, left)| wall(n, left)).collect();
    format!("0 0\n9\n\n{lines}")
}

/// One house of `parts` parts: storeys of 100 parts, one above another.
pub fn parts(parts: usize) -> String {
    let walls = [(30, false), (20, false), (30, false), (20, false)];
    let storey = walls.map(|(n, left)| wall(n, left)).concat();
    let storeys = vec![storey.trim_end_matches('\n'); parts / 100].join("^\n");
    format!("0 0\n\n{storeys}\n")
}

/// A street of so many lines or a few more: every other house dressed, the others of all shapes.
pub fn legacy_lines(lines: usize) -> String {
    let dressed = include_str!("../../examples/machiya.hsd").trim_end();
    let plain = outlines(lines / 10);
    let mut text = String::new();
    for house in plain.split("%\n") {
        text += &format!("{dressed}\n%\n{house}");
        if text.lines().count() >= lines {
            break;
        }
        text += "%\n";
    }
    text
}

/// The same in the XML form.
pub fn xml_lines(lines: usize) -> String {
    // A line of the legacy form becomes a little more than one.
    let legacy = legacy_lines(lines * 3 / 4);
    let source = Source::new(FileId(0), "bench.hsd", legacy.as_bytes());
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let text = driver::convert(&source, &NoFiles, &options, &mut out);
    let told = out.iter().next().map(|d| d.message.clone());
    text.unwrap_or_else(|| panic!("the text is wrong: {told:?}"))
}
