//! No bytes whatever disturb the readers of maps. The first byte picks the name of the file, and so the format where the
//! content does not tell it.

#![no_main]

use hsd::map;
use hsd::source::{PictureFile, Stream, World};
use libfuzzer_sys::fuzz_target;
use std::io;

/// A world of one file, which is every file that is asked for.
struct One(Vec<u8>);

impl World for One {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, path))
    }

    fn open(&self, _: &str) -> io::Result<Box<dyn Stream>> {
        Ok(Box::new(io::Cursor::new(self.0.clone())))
    }
}

fuzz_target!(|bytes: &[u8]| {
    let Some((pick, bytes)) = bytes.split_first() else {
        return;
    };
    let names = ["a.geojson", "a.shp", "a.dbf", "a.csv"];
    let name = names[usize::from(*pick) % names.len()];
    let Ok(mut reader) = map::open(&One(bytes.to_vec()), name, &map::Options::default()) else {
        return;
    };
    while let Some(found) = reader.next() {
        if let Ok(feature) = found {
            assert!(feature.geometry.points().all(|p| p.is_finite()));
            assert!(feature.geometry.points().next().is_some());
        }
        reader.remarks();
    }
});
