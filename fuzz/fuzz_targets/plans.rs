//! No image and no drawing disturbs the reader of plans, and a house that it writes has no errors.

#![no_main]

use hsd::Diagnostics;
use hsd::plan::drawing::{self, Content};
use hsd::plan::house::{Wanted, write};
use hsd::plan::legend::Legend;
use hsd::plan::text::Era;
use hsd::plan::vector::{self, roles::Roles};
use hsd::plan::{Front, LEGENDS, Options};
use hsd::source::{FileId, NoFiles, Source};
use libfuzzer_sys::fuzz_target;

/// Memory of a run, bytes.
const MEMORY: u64 = 64 << 20;

fuzz_target!(|bytes: &[u8]| {
    let legends = LEGENDS
        .iter()
        .filter_map(|(_, text)| Legend::read(text).ok());
    let legends: Vec<Legend> = legends.collect();
    let roles = Roles::read(vector::CAD).expect("is a legend");
    let found = match drawing::open(bytes, 1, MEMORY) {
        Ok(Content::Picture(picture)) => {
            hsd::plan::find(&picture, &legends, &Options::default()).ok()
        }
        Ok(Content::Lines(lines)) => {
            let drawn = drawing::find(lines, &roles, None, &legends, Front::Bottom);
            drawn.ok().map(|drawn| drawn.found)
        }
        Ok(Content::House(_)) | Err(_) => None,
    };
    let Some(found) = found else { return };
    let wanted = Wanted {
        name: "house".to_owned(),
        era: Era::named("edo").expect("is an era"),
        heights: vec![],
        unit: None,
        shifts: vec![],
    };
    let Some(house) = write(&[&found.shape], &["a plan".to_owned()], &wanted) else {
        return;
    };
    let source = Source::new(FileId(0), "house.hsd", house.written.text.as_bytes());
    let mut out = Diagnostics::new();
    hsd::check(&[&source], &NoFiles, &hsd::Options::default(), &mut out);
    assert!(!out.has_errors(), "{}", house.written.text);
});
