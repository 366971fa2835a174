//! Maps as they are: the readers of `map`, on small files of our own and, where it is there, on the data beside the
//! repository.

use crate::support::root;
use hsd::map::{self, Fault, Feature, Options};
use hsd::{FolderWorld, glam::DVec2};
use std::path::Path;

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
    let mut reader = map::open(&world, path.to_str().unwrap(), options)?;
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
    Ok(read)
}

/// The middle of the bounds of a feature.
fn middle(feature: &Feature) -> DVec2 {
    let first = feature.geometry.points().next().unwrap();
    let bounds = feature
        .geometry
        .points()
        .fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    (bounds.0 + bounds.1) / 2.0
}

#[test]
fn the_hamlet_is_read_from_geojson() {
    let read = read_in(
        &root().join("tests/data"),
        "houses.geojson",
        &Options::default(),
    );
    let read = read.unwrap();
    assert_eq!(read.counts(), (5, 0));
    assert!(read.remarks.is_empty(), "{:?}", read.remarks);
    let street = read_in(
        &root().join("tests/data"),
        "street.geojson",
        &Options::default(),
    );
    assert_eq!(street.unwrap().counts(), (2, 0));
    let first = middle(&read.features[0]);
    assert!((first - DVec2::new(135.75, 35.0)).length() < 1.0, "{first}");
}
