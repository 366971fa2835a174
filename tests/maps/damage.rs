//! Five hundred random damages of each format: nothing panics, and what does not come out is told.

use super::faults::MOJ;
use super::read_bytes;
use crate::support::root;
use hsd::map::Options;
use std::fs;

/// A source of numbers that look random.
struct Random(u64);

impl Random {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below.max(1) as u64) as usize
    }
}

/// Changes, removes, repeats or cuts off some bytes.
fn damaged(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.next(3) {
        if bytes.is_empty() {
            break;
        }
        let at = random.next(bytes.len());
        let end = (at + 1 + random.next(12)).min(bytes.len());
        match random.next(5) {
            0 | 1 => bytes[at] = random.next(256) as u8,
            2 => drop(bytes.drain(at..end)),
            3 => {
                let again = bytes[at..end].to_vec();
                bytes.splice(at..at, again);
            }
            _ => bytes.truncate(at),
        }
    }
    bytes
}

/// Damages each of some files 500 times. `tells` is false for a format in which one changed letter makes a thing that is
/// none of the theme.
fn endure(files: &[(&str, Vec<u8>)], tells: bool) {
    let whole = read_bytes(files, &Options::default()).unwrap();
    let count = whole.features.len();
    assert!(count > 0, "{}", files[0].0);
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for round in 0..500 {
        let which = random.next(files.len());
        let mut changed = files.to_vec();
        changed[which].1 = damaged(&changed[which].1, &mut random);
        let Ok(read) = read_bytes(&changed, &Options::default()) else {
            continue; // refused as a whole, with its reason
        };
        let (built, lost) = read.counts();
        let told = lost + read.remarks.len();
        assert!(
            !tells || built >= count || told > 0,
            "{} round {round}: {built} of {count} features, and nothing is told",
            files[0].0
        );
    }
}

fn of_hamlet(names: &[&'static str]) -> Vec<(&'static str, Vec<u8>)> {
    let read = |name: &&'static str| {
        (
            *name,
            fs::read(root().join("tests/data").join(name)).unwrap(),
        )
    };
    names.iter().map(read).collect()
}

#[test]
fn damaged_geojson() {
    endure(&of_hamlet(&["houses.geojson"]), true);
    let (name, bytes) = of_hamlet(&["houses.geojson"]).remove(0);
    let json: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    let lines = json["features"].as_array().unwrap().iter();
    let lines: Vec<String> = lines.map(ToString::to_string).collect();
    endure(&[(name, lines.join("\n").into())], true);
}

#[test]
fn damaged_flatgeobuf() {
    endure(&of_hamlet(&["houses.fgb"]), true);
}

#[test]
#[cfg(feature = "geopackage")]
fn damaged_geopackage() {
    // A page of the database that is not used may change.
    endure(&of_hamlet(&["houses.gpkg"]), false);
}

#[test]
#[cfg(feature = "geoparquet")]
fn damaged_geoparquet() {
    // Pages have no checksums.
    endure(&of_hamlet(&["houses.parquet"]), false);
}

#[test]
fn damaged_shapefiles() {
    endure(&of_hamlet(&["houses.shp"]), true);
    endure(
        &of_hamlet(&["houses.shp", "houses.dbf", "houses.prj", "houses.shx"]),
        true,
    );
}

#[test]
fn damaged_xml() {
    endure(&of_hamlet(&["houses.gml"]), false);
    endure(&of_hamlet(&["hamlet.osm"]), false);
    endure(&[("a.xml", MOJ.into())], false);
}

#[test]
fn damaged_tables() {
    let table = b"name,lon,lat\na,135.75,35.02\nb,135.76,35.03\nc,135.77,35.04\n";
    endure(&[("a.csv", table.to_vec())], false); // a line that is gone leaves no trace
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn damaged_pbf() {
    let path = crate::support::maps::data().join("osm_meijimura/MeijiMura.osm.pbf");
    endure(&[("a.pbf", fs::read(path).unwrap())], false);
}
