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

/// Numbers that look random, the same in every run.
struct Draw(u64);

impl Draw {
    /// Draws a number between two others.
    fn between(&mut self, low: usize, high: usize) -> usize {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        low + (self.0 >> 33) as usize % (high - low + 1)
    }
}

/// `count` plain houses of one storey and one kind of wall, all unlike: rectangles, L, T, U, crosses and Z in quarter
/// units, with roofs of this shape.
pub fn plain(count: usize, shape: &str) -> String {
    let mut draw = Draw(count as u64);
    let mut houses = String::from("<Houses>\n");
    for n in 0..count {
        let mut quarters = |low: usize, high: usize| draw.between(4 * low, 4 * high) as f64 / 4.0;
        let [a, b, c, d, e] = [
            quarters(4, 12),
            quarters(3, 7),
            quarters(2, 4),
            quarters(2, 5),
            quarters(2, 4),
        ];
        let (l, r) = (" turn=\"L\"", "");
        let walls = match n % 6 {
            0 => vec![(a, r), (b, r), (a, r), (b, r)],
            1 => vec![(a + c, r), (b, r), (c, l), (d, r), (a, r), (b + d, r)],
            2 => vec![
                (a + c + e, r),
                (b, r),
                (a, l),
                (d, r),
                (c, r),
                (d, l),
                (e, r),
                (b, r),
            ],
            3 => vec![
                (a + c + e, r),
                (b + d, r),
                (c, r),
                (d, l),
                (a, l),
                (d, r),
                (e, r),
                (b + d, r),
            ],
            4 => vec![
                (c, r),
                (d, l),
                (e, r),
                (b, r),
                (e, l),
                (d, r),
                (c, r),
                (d, l),
                (a, r),
                (b, r),
                (a, l),
                (d, r),
            ],
            _ => {
                let e = e.min(a - 1.0);
                vec![
                    (a, r),
                    (b, r),
                    (e, l),
                    (d, r),
                    (a, r),
                    (b, r),
                    (e, l),
                    (d, r),
                ]
            }
        };
        let height = draw.between(85, 100) as f64 / 10.0;
        houses += &format!(
            "<House x=\"{}\" y=\"{}\"><Storey height=\"{height}\">",
            n % 100 * 30,
            n / 100 * 30
        );
        for (width, turn) in walls {
            houses += &format!("<Row{turn}><Part code=\"KOB\" width=\"{width}\"/></Row>");
        }
        let pitch = draw.between(30, 55) as f64 / 10.0;
        houses += &format!("</Storey><Roofs shape=\"{shape}\" pitch=\"{pitch}\"/></House>\n");
    }
    houses + "</Houses>\n"
}

/// `count` town houses of one or two storeys with doors, lattices and windows of three shaku, all unlike. One in `aged`
/// has stood for 1 to 200 years; with 0, none.
pub fn facades(count: usize, aged: usize) -> String {
    const FRONT: [&str; 10] = [
        "GSI  ", "TKD 2", "KTU  ", "KKS  ", "MRE  ", "TIT 2", "GDE 2", "KSK  ", "TSH 2", "MMU 2",
    ];
    const SIDE: [&str; 4] = ["KSK  ", "APW  ", "KKS  ", "KTU  "];
    let mut draw = Draw(count as u64 + 1);
    let mut houses = String::from("<Houses>\n");
    for n in 0..count {
        let (a, b) = (draw.between(3, 8), draw.between(4, 10));
        let age = match aged > 0 && draw.between(1, aged) == 1 {
            true => format!(" age=\"{}\"", draw.between(1, 200)),
            false => String::new(),
        };
        let turn = draw.between(0, 359);
        houses += &format!(
            "<House x=\"{}\" y=\"{}\" azimuth=\"{turn}\"{age}>",
            n % 100 * 14,
            n / 100 * 14
        );
        for _ in 0..draw.between(1, 2) {
            houses += &format!(
                "<Storey height=\"{}\">",
                draw.between(70, 110) as f64 / 10.0
            );
            for (units, codes) in [(a, &FRONT[..]), (b, &SIDE), (a, &FRONT), (b, &SIDE)] {
                houses += &format!("<Row>{}</Row>", row(units, codes, &mut draw));
            }
            houses += "</Storey>";
        }
        let shape = ["KIR", "YOS", "IRI"][draw.between(0, 2)];
        let pitch = draw.between(30, 55) as f64 / 10.0;
        houses += &format!("<Roofs shape=\"{shape}\" pitch=\"{pitch}\"/></House>\n");
    }
    houses + "</Houses>\n"
}

/// Returns parts that fill a number of units.
fn row(units: usize, codes: &[&str], draw: &mut Draw) -> String {
    let (mut row, mut done) = (String::new(), 0);
    while done < units {
        let code = codes[draw.between(0, codes.len() - 1)];
        let width = if code.ends_with('2') { 2 } else { 1 };
        if done + width <= units {
            row += code;
            done += width;
        }
    }
    row
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
