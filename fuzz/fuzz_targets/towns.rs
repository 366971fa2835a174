//! No map disturbs a town: whatever its bytes, each feature is built, skipped or unused. The first byte picks the format.

#![no_main]

use hsd::Diagnostics;
use hsd::driver::Options;
use hsd::source::{FileId, IncludeError, PictureFile, Source, Stream, World};
use hsd::town::stream::TownStream;
use hsd::town::{TownInput, run};
use libfuzzer_sys::fuzz_target;
use std::io;

/// Names of maps, one for each format.
const NAMES: [&str; 9] = [
    "a.geojson",
    "a.shp",
    "a.fgb",
    "a.osm",
    "a.osm.pbf",
    "a.xml",
    "a.gml",
    "a.csv",
    "a.geojson.gz",
];

/// A world of one map.
struct OneMap(Vec<u8>);

impl World for OneMap {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, path))
    }

    fn text(&self, _: &str, href: &str) -> Result<String, IncludeError> {
        match NAMES.contains(&href) {
            true => Ok(href.to_owned()),
            false => Err(IncludeError::Missing),
        }
    }

    fn open(&self, path: &str) -> io::Result<Box<dyn Stream>> {
        match NAMES.contains(&path) {
            true => Ok(Box::new(io::Cursor::new(self.0.clone()))),
            false => Err(io::Error::new(io::ErrorKind::NotFound, path)),
        }
    }
}

fuzz_target!(|bytes: &[u8]| {
    let Some((pick, bytes)) = bytes.split_first() else {
        return;
    };
    let name = NAMES[usize::from(*pick) % NAMES.len()];
    let text = format!(
        r#"<Town><Layer name="a" src="{name}"/><for each="a"><if test="{{area > 0}}"><Place type="block" on="outline"/></if><else><Fence/></else></for></Town>"#
    );
    let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
    let (world, options) = (OneMap(bytes.to_vec()), Options::default());
    let mut out = Diagnostics::new();
    let mut read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let town = read.documents.iter_mut().find_map(|d| d.town.take());
    let input = TownInput::new(&source, &world, &options);
    let Some(plan) = run::plan(input, &town.expect("is a town"), &mut out) else {
        assert!(out.has_errors());
        return;
    };
    let mut stream = TownStream::new(input, &plan);
    stream.build(input, read, &mut out, &mut |_| {});
    let (ledger, _) = stream.finish(&mut out);
    let report = ledger.report;
    assert_eq!(
        report.features,
        report.built + report.skipped.len() + report.unused
    );
});
