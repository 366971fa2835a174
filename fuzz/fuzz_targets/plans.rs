//! No image and no drawing disturbs the reader of plans, and a house that it writes has no errors.

#![no_main]

use hsd::Diagnostics;
use hsd::plan::drawing::{self, Content, DrawnPlan};
use hsd::plan::house::{Wanted, write};
use hsd::plan::legend::Legend;
use hsd::plan::text::Era;
use hsd::plan::vector::{self, roles::Roles};
use hsd::plan::walls::writing;
use hsd::plan::{self, Front, LEGENDS, Options, Plan};
use hsd::source::{FileId, NoFiles, Source};
use libfuzzer_sys::fuzz_target;

/// Memory of a run, bytes.
const MEMORY: u64 = 64 << 20;
/// The most pixels that are read: larger images take too long to find anything.
const PIXELS: u32 = 250_000;

fuzz_target!(|bytes: &[u8]| {
    let legends = LEGENDS
        .iter()
        .filter_map(|(_, text)| Legend::read(text).ok());
    let legends: Vec<Legend> = legends.collect();
    let roles = Roles::read(vector::CAD).expect("is a legend");
    let found = match drawing::open(bytes, 1, MEMORY) {
        Ok(Content::Picture(picture)) => {
            let (width, height) = picture.pixels.dimensions();
            if width.saturating_mul(height) > PIXELS {
                return;
            }
            plan::read(&picture, &legends, &Options::default()).ok()
        }
        Ok(Content::Lines(lines)) => {
            match drawing::read(lines, &roles, None, &legends, Front::Bottom) {
                Ok(DrawnPlan::Grid(drawn)) => Some(Plan::Grid(Box::new(drawn.found))),
                Ok(DrawnPlan::Walls(found)) => Some(Plan::Walls(found)),
                Err(_) => None,
            }
        }
        Ok(Content::House(_)) | Err(_) => None,
    };
    let era = Era::named("edo").expect("is an era");
    let written = match found {
        Some(Plan::Grid(found)) => {
            let wanted = Wanted {
                name: "house".to_owned(),
                era,
                heights: vec![],
                unit: None,
                shifts: vec![],
            };
            let house = write(&[&found.shape], &["a plan".to_owned()], &wanted);
            house.map(|house| house.written.text)
        }
        Some(Plan::Walls(found)) => {
            let lines = ["a plan".to_owned()];
            let storey = found.storey(10.0);
            // Both storeys have the same plan.
            let traced = writing::write(&[storey, storey], ("house", &lines[..], era));
            traced.map(|traced| traced.text)
        }
        None => None,
    };
    let Some(text) = written else { return };
    let source = Source::new(FileId(0), "house.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    hsd::check(&[&source], &NoFiles, &hsd::Options::default(), &mut out);
    assert!(!out.has_errors(), "{text}");
});
