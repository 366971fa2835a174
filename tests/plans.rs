//! `hsd plan`: houses out of drawn plans, judged by drawings that the tests make themselves.

mod inside;
mod real;
pub(crate) mod several;
mod trial;
mod walls;

use crate::plan_drawings::{self as drawings, Convention, Degradation, Nonsense, Variant};
use hsd::plan::legend::Legend;
use hsd::plan::{self, Found, LEGENDS, Picture, Refused, Unreadable};
use std::io::Cursor;

/// All legends of the program.
pub(crate) fn legends() -> Vec<Legend> {
    LEGENDS
        .iter()
        .map(|(name, text)| Legend::read(text).unwrap_or_else(|e| panic!("{name}: {e:?}")))
        .collect()
}

/// A picture as the reader gets it.
fn picture(pixels: image::RgbImage) -> Picture {
    Picture::decode(&png(&pixels)).expect("a picture of the tests is sound")
}

fn png(pixels: &image::RgbImage) -> Vec<u8> {
    let mut bytes = Cursor::new(vec![]);
    let written = pixels.write_to(&mut bytes, image::ImageFormat::Png);
    written.expect("a picture can be written");
    bytes.into_inner()
}

/// The drawing of a plan by seed, of so many pixels a unit.
fn drawing(seed: u64, convention: Convention, way: Degradation, px: f32) -> image::RgbImage {
    let plan = drawings::plan(seed);
    let variant = Variant {
        seed,
        unseen: false,
    };
    let drawn = drawings::draw(&plan, convention, variant, px);
    drawings::degrade(drawn.picture, way, seed).0
}

fn find(pixels: image::RgbImage) -> Result<Found, Refused> {
    let found = plan::find(&picture(pixels), &legends(), &plan::Options::default());
    found.map_err(|stopped| stopped.why)
}

#[test]
fn pictures_without_a_plan_are_refused() {
    let cases: Vec<(Nonsense, u64)> = [
        Nonsense::Noise,
        Nonsense::Blank,
        Nonsense::Street,
        Nonsense::Map,
    ]
    .into_iter()
    .flat_map(|kind| (0..3).map(move |seed| (kind, seed)))
    .collect();
    let findings = crate::support::on_all_processors(cases.len(), |k| {
        let (kind, seed) = cases[k];
        match find(drawings::nonsense(kind, seed, (700, 500))) {
            Err(_) => vec![],
            Ok(found) => vec![format!(
                "{kind:?} {seed}: a house of {} cells",
                found.shape.cells.len()
            )],
        }
    });
    crate::support::assert_none(&findings);
}

#[test]
fn files_that_are_no_pictures_are_told_from_damaged_ones() {
    assert_eq!(
        Picture::decode(b"no picture").err(),
        Some(Unreadable::Format)
    );
    assert_eq!(Picture::decode(b"").err(), Some(Unreadable::Format));
    for seed in 0..4 {
        let read = {
            let whole = drawing(seed, Convention::Survey, Degradation::Clean, 24.0);
            Picture::decode(&drawings::truncated_png(&whole)).err()
        };
        assert!(matches!(read, Some(Unreadable::Damaged(_))), "{read:?}");
    }
}

#[test]
fn tiny_and_empty_pictures_are_refused() {
    for (width, height) in [(1, 1), (1, 400), (400, 1), (7, 9), (300, 300)] {
        for tone in [0, 128, 255] {
            let pixels = image::RgbImage::from_pixel(width, height, image::Rgb([tone; 3]));
            assert!(find(pixels).is_err(), "{width} x {height} of {tone}");
        }
    }
}

#[test]
fn a_faulty_legend_is_told_at_its_place() {
    for (text, part, what) in [
        (
            "<Legend name=\"a\"><Symbol role=\"door\"/></Legend>",
            "<Symbol role=\"door\"/>",
            "door",
        ),
        (
            "<Legend><Symbol role=\"wall\"><Dot/></Symbol></Legend>",
            "<Dot/>",
            "Dot",
        ),
        (
            "<Legend><Symbol role=\"wall\" spread=\"a\"/></Legend>",
            "<Symbol role=\"wall\" spread=\"a\"/>",
            "spread",
        ),
        (
            "<Legend><Line at=\"0\"/></Legend>",
            "<Line at=\"0\"/>",
            "Symbol",
        ),
    ] {
        let wrong = Legend::read(text).expect_err(text);
        assert_eq!(&text[wrong.at.clone()], part);
        assert!(wrong.what.contains(what), "{}", wrong.what);
    }
    assert!(Legend::read("<Legend><Symbol").is_err());
    assert!(Legend::read("<Legend><Symbol></Legend>").is_err());
}

#[test]
fn the_same_picture_gives_the_same_house() {
    let read = || {
        let found = find(drawing(1, Convention::Survey, Degradation::Scanned, 30.0));
        let found = found.expect("a plan");
        (format!("{:?}", found.shape), found.grid.to_sheet)
    };
    assert_eq!(read(), read());
}

/// The drawings of `examples/plans`, by convention and seed.
const EXAMPLES: [(&str, Convention, u64); 3] = [
    ("survey", Convention::Survey, 1),
    ("sashizu", Convention::Sashizu, 3),
    ("itazu", Convention::Itazu, 2),
];

/// `HSD_UPDATE=1` draws them anew.
#[test]
fn the_examples_are_drawn_here_and_read() {
    let folder = crate::support::root().join("examples/plans");
    for (name, convention, seed) in EXAMPLES {
        let drawn = png(&drawing(seed, convention, Degradation::Clean, 36.0));
        let path = folder.join(format!("{name}.png"));
        if std::env::var_os("HSD_UPDATE").is_some() {
            std::fs::create_dir_all(&folder).expect("a folder can be made");
            std::fs::write(&path, &drawn).expect("a picture can be written");
        }
        let there = std::fs::read(&path).expect("the example is there");
        assert!(there == drawn, "{name}: HSD_UPDATE=1 draws it anew");
        let found = find(picture_of(&there)).expect(name);
        assert_eq!(found.legend, name);
    }
}

fn picture_of(bytes: &[u8]) -> image::RgbImage {
    image::load_from_memory(bytes)
        .expect("it is a picture")
        .to_rgb8()
}
