//! Files that expand to far more than they write out end with a diagnostic, whatever their format, before they take memory.

use super::{Read, read_bytes};
use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};
use hsd::map::{Fault, Kind, Options};
use std::fmt::Write as _;
use std::io::Write as _;

fn read(name: &str, bytes: Vec<u8>) -> Result<Read, Fault> {
    let options = Options {
        layer: (!name.ends_with(".xml")).then(|| "building".into()),
        ..Options::default()
    };
    read_bytes(&[(name, bytes)], &options)
}

/// Returns true if a file was read no further than a run may go.
fn is_bounded(read: &Result<Read, Fault>) -> bool {
    let exhausted = |fault: &Fault| matches!(fault.kind, Kind::Exhausted(_));
    match read {
        Err(fault) => exhausted(fault),
        Ok(read) => read.lost.iter().any(exhausted),
    }
}

/// A field of a protocol buffer: bytes, or a number.
fn field(number: u64, bytes: &[u8]) -> Vec<u8> {
    [
        varint(number << 3 | 2),
        varint(bytes.len() as u64),
        bytes.to_vec(),
    ]
    .concat()
}

fn number(field: u64, n: u64) -> Vec<u8> {
    [varint(field << 3), varint(n)].concat()
}

fn varint(mut n: u64) -> Vec<u8> {
    let mut bytes = vec![];
    while n >= 0x80 {
        bytes.push(n as u8 | 0x80);
        n >>= 7;
    }
    bytes.push(n as u8);
    bytes
}

/// A PBF of a head and one block with these strings and this group.
fn pbf(strings: &[&str], group: &[u8]) -> Vec<u8> {
    let table = strings.iter().flat_map(|s| field(1, s.as_bytes()));
    let block = [field(1, &table.collect::<Vec<u8>>()), field(2, group)].concat();
    [blob(b"OSMHeader", b""), blob(b"OSMData", &block)].concat()
}

/// A block of a PBF, packed.
fn blob(of: &[u8], block: &[u8]) -> Vec<u8> {
    let mut packed = ZlibEncoder::new(vec![], Compression::default());
    packed.write_all(block).expect("is written");
    let packed = packed.finish().expect("is written");
    let blob = [number(2, block.len() as u64), field(3, &packed)].concat();
    let head = [field(1, of), number(3, blob.len() as u64)].concat();
    [(head.len() as u32).to_be_bytes().to_vec(), head, blob].concat()
}

#[test]
fn nodes_packed_to_almost_nothing_are_bounded() {
    let zeros = vec![0_u8; 8 << 20];
    let dense = [field(1, &zeros), field(8, &zeros), field(9, &zeros)].concat();
    let bytes = pbf(&[""], &field(2, &dense));
    assert!(bytes.len() < 100_000, "{}", bytes.len());
    assert!(is_bounded(&read("a.osm.pbf", bytes)));
}

#[test]
fn texts_that_nodes_share_are_bounded() {
    let long = "x".repeat(60_000);
    // Each node has the tag building = xxx...
    let nodes = 20_000;
    let places = vec![0_u8; nodes];
    let tags: Vec<u8> = [1, 2, 0].repeat(nodes);
    let dense = [
        field(1, &places),
        field(8, &places),
        field(9, &places),
        field(10, &tags),
    ]
    .concat();
    let bytes = pbf(&["", "building", &long], &field(2, &dense));
    assert!(is_bounded(&read("a.osm.pbf", bytes)));
}

#[test]
fn relations_that_name_one_way_are_bounded() {
    let mut text = "<osm version=\"0.6\">".to_owned();
    for n in 1..=2000 {
        let (lon, lat) = (135.0 + f64::from(n) * 1e-5, 35.0);
        let _ = write!(text, "<node id=\"{n}\" lon=\"{lon}\" lat=\"{lat}\"/>");
    }
    text += "<way id=\"1\">";
    for n in (1..=2000).chain([1]) {
        let _ = write!(text, "<nd ref=\"{n}\"/>");
    }
    text += "</way>";
    for n in 1..=300 {
        let _ = write!(
            text,
            "<relation id=\"{n}\"><tag k=\"type\" v=\"multipolygon\"/><tag k=\"building\" v=\"yes\"/>"
        );
        text += &"<member type=\"way\" ref=\"1\" role=\"outer\"/>".repeat(20);
        text += "</relation>";
    }
    text += "</osm>";
    assert!(is_bounded(&read("a.osm", text.into())));
}

#[test]
fn lots_that_name_one_curve_are_bounded() {
    let mut text = "<地図><座標系>任意座標系</座標系><空間属性><GM_Curve id=\"C\">".to_owned();
    for n in 0..5000 {
        let _ = write!(
            text,
            "<GM_PointArray.column><X>{n}</X><Y>{}</Y></GM_PointArray.column>",
            n % 7
        );
    }
    text += "</GM_Curve><GM_Surface id=\"S\"><GM_SurfaceBoundary.exterior>";
    text += &"<GM_CompositeCurve.generator idref=\"C\"/>".repeat(2000);
    text += "</GM_SurfaceBoundary.exterior></GM_Surface></空間属性><主題属性>";
    text += "<筆 id=\"H1\"><形状 idref=\"S\"/></筆></主題属性></地図>";
    assert!(is_bounded(&read("a.xml", text.into())));
}

#[test]
fn a_packed_table_of_very_many_rows_is_bounded() {
    let mut packed = GzEncoder::new(vec![], Compression::default());
    packed.write_all(b"x,y\n").expect("is written");
    packed
        .write_all(&b"1,2\n".repeat(1 << 20))
        .expect("is written");
    let bytes = packed.finish().expect("is written");
    let read = read("a.csv.gz", bytes);
    assert!(is_bounded(&read));
    // Nothing is read behind it, and it is reported once.
    let lost = read.map(|read| read.lost.len()).unwrap_or(1);
    assert_eq!(lost, 1);
}

#[test]
fn what_files_write_out_is_read() {
    let rows = b"1,2\n".repeat(100_000);
    let plain = [b"x,y\n".to_vec(), rows].concat();
    let read = read("a.csv", plain).expect("is read");
    assert_eq!((read.features.len(), read.lost.len()), (100_000, 0));
}

#[test]
fn a_line_of_too_many_values_is_no_row() {
    let many = ",".repeat(1 << 20);
    let read = read("a.csv", format!("x,y\n{many}\n1,2\n").into()).expect("is read");
    assert_eq!((read.features.len(), read.lost.len()), (1, 1));
    assert!(matches!(read.lost[0].kind, Kind::Malformed { .. }));
    let head = read_bytes(
        &[("a.csv", format!("x,y,{many}\n1,2\n").into())],
        &Options::default(),
    );
    assert!(matches!(
        head.map(drop).unwrap_err().kind,
        Kind::TooLarge { .. }
    ));
}
