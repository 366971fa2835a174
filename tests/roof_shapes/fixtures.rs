//! The fixtures of the messages, through the whole chain up to the roofs.

use crate::roof_shapes::common::assert_sound;
use hsd::diagnostic::Diagnostics;
use hsd::source::{FileId, Limits, NoFiles, Source};

#[test]
fn every_fixture_triggers_its_message() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/diagnostics");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let Some(code) = name
            .strip_prefix("HSD05")
            .and_then(|n| n.get(..2)?.parse::<u16>().ok())
        else {
            continue;
        };
        if !name.ends_with(".hsd") {
            continue;
        }
        let source = Source::new(FileId(0), name.clone(), &std::fs::read(&path).unwrap());
        let mut out = Diagnostics::new();
        let document = hsd::parse::parse(&source, &Limits::default(), &mut out);
        let (catalog, options) = (hsd::parse::builtin(), hsd::expand::Options::default());
        let documents = [(&source, &document)];
        let program = hsd::expand::expand(&documents, catalog, &NoFiles, &options, &mut out);
        let building = hsd::roof::roof(hsd::lower::lower(program, &mut out), &mut out);
        building.houses.iter().for_each(|_| assert_sound(&building));
        // The plan itself says that it is open.
        let codes: Vec<u16> = out
            .iter()
            .map(|d| d.code.0)
            .filter(|c| *c / 100 != 4)
            .collect();
        if !building.houses.is_empty() {
            assert_eq!(codes, vec![500 + code], "{name}");
            seen += 1;
        }
    }
    assert!(seen > 10);
}
