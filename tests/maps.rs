//! Maps as they are: the readers of `map`, on small files of our own and, where it is there, on the data beside the
//! repository.

use hsd::FolderWorld;
use hsd::map::{self, Fault, Feature, Options};
use hsd::source::{PictureFile, Stream, World};
use std::io;
use std::path::Path;

mod budget;
mod crs;
mod damage;
mod faults;
mod hamlet;
mod real;

/// What a map holds.
struct Read {
    features: Vec<Feature>,
    lost: Vec<Fault>,
    remarks: Vec<Fault>,
    columns: Vec<String>,
    crs: Option<map::Crs>,
}

impl Read {
    /// The number of features and of faults in their place.
    fn counts(&self) -> (usize, usize) {
        (self.features.len(), self.lost.len())
    }
}

/// Reads a map below a folder.
fn read_in(folder: &Path, name: &str, options: &Options) -> Result<Read, Fault> {
    let world = FolderWorld::new(vec![], 0).with_roots(vec![folder.to_owned()]);
    let path = folder.join(name);
    Ok(read(map::open(&world, path.to_str().unwrap(), options)?))
}

fn read(mut reader: Box<dyn map::Reader>) -> Read {
    let mut read = Read {
        features: vec![],
        lost: vec![],
        remarks: vec![],
        columns: vec![],
        crs: None,
    };
    while let Some(found) = reader.next() {
        match found {
            Ok(feature) => read.features.push(feature),
            Err(fault) => read.lost.push(fault),
        }
        read.remarks.extend(reader.remarks());
    }
    read.remarks.extend(reader.remarks());
    let layer = reader.layer();
    let names = layer.columns.list().iter().map(|c| c.name.to_string());
    read.columns = names.collect();
    read.crs = layer.crs.clone();
    read
}

/// Reads a map of bytes at hand; files beside it are named too.
fn read_bytes(files: &[(&str, Vec<u8>)], options: &Options) -> Result<Read, Fault> {
    struct Memory(Vec<(String, Vec<u8>)>);
    impl World for Memory {
        fn picture(&self, _: &str) -> Option<PictureFile> {
            None
        }

        fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
            Err(io::Error::new(io::ErrorKind::NotFound, path))
        }

        fn open(&self, path: &str) -> io::Result<Box<dyn Stream>> {
            let found = self.0.iter().find(|(name, _)| name == path);
            let (_, bytes) = found.ok_or(io::ErrorKind::NotFound)?;
            Ok(Box::new(io::Cursor::new(bytes.clone())))
        }
    }
    let named = files
        .iter()
        .map(|(name, bytes)| ((*name).to_owned(), bytes.clone()));
    let world = Memory(named.collect());
    Ok(read(map::open(&world, files[0].0, options)?))
}
