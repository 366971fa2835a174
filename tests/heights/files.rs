//! Grids of heights as files, written from surfaces that are known at every place.

use hsd::glam::{DVec2, dvec2};

/// Where the plane grids begin: near Kyoto, in zone 6 of Japan.
pub(crate) const AT: DVec2 = dvec2(-22_000.0, -108_000.0);
pub(crate) const SIDE: f64 = 10.0;
pub(crate) const COLUMNS: usize = 30;
pub(crate) const ROWS: usize = 20;

/// The surface of the plane grids, which bilinear steps give back exactly.
pub(crate) fn slope(p: DVec2) -> f64 {
    let p = p - AT;
    40.0 + 0.05 * p.x - 0.03 * p.y + 0.0004 * p.x * p.y
}

/// The middle of a cell, its row counted from the north.
pub(crate) fn middle(column: usize, row: usize) -> DVec2 {
    AT + dvec2(column as f64 + 0.5, (ROWS - 1 - row) as f64 + 0.5) * SIDE
}

pub(crate) fn cells() -> impl Iterator<Item = f64> {
    (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| slope(middle(column, row))))
}

pub(crate) fn ascii() -> Vec<u8> {
    let mut text = format!(
        "NCOLS {COLUMNS}\nNROWS {ROWS}\nXLLCORNER {}\nYLLCORNER {}\nCELLSIZE {SIDE}\nNODATA_VALUE -1\n",
        AT.x, AT.y
    );
    for row in cells().collect::<Vec<f64>>().chunks(COLUMNS) {
        let words: Vec<String> = row.iter().map(|h| format!("{h:.4}")).collect();
        text.push_str(&(words.join(" ") + "\n"));
    }
    text.into_bytes()
}

/// How a GeoTIFF is written.
#[derive(Clone, Copy)]
pub(crate) struct Tiff {
    pub(crate) big_endian: bool,
    pub(crate) bits: u16,
    /// 1 unsigned, 2 signed, 3 floating.
    pub(crate) format: u16,
    pub(crate) bands: u16,
    pub(crate) of_points: bool,
    pub(crate) vertical: u16,
    pub(crate) code: u16,
    pub(crate) turn: f64,
}

pub(crate) const TIFF: Tiff = Tiff {
    big_endian: false,
    bits: 32,
    format: 3,
    bands: 1,
    of_points: false,
    vertical: 9001,
    code: 6674,
    turn: 0.0,
};

/// Writes a GeoTIFF in strips of seven rows.
pub(crate) fn tiff(how: Tiff, values: &[f64]) -> Vec<u8> {
    const STRIP: usize = 7;
    let in_order = |mut bytes: Vec<u8>| {
        if how.big_endian {
            bytes.reverse();
        }
        bytes
    };
    let two = |n: u16| in_order(n.to_le_bytes().to_vec());
    let four = |n: u32| in_order(n.to_le_bytes().to_vec());
    let eight = |n: f64| in_order(n.to_le_bytes().to_vec());
    let big = how.big_endian;
    let value = |h: f64| match (how.bits, how.format) {
        (8, _) => vec![h as u8],
        (16, _) => two((h as i16) as u16),
        (64, _) => eight(h),
        (_, 3) => four((h as f32).to_bits()),
        _ => four((h as i32) as u32),
    };
    let mut data: Vec<u8> = if big {
        b"MM\0*".to_vec()
    } else {
        b"II*\0".to_vec()
    };
    data.extend([0; 4]);
    let (mut offsets, mut lengths) = (vec![], vec![]);
    for strip in values.chunks(STRIP * COLUMNS) {
        let bytes: Vec<u8> = strip
            .iter()
            .flat_map(|h| value(*h).repeat(how.bands.into()))
            .collect();
        offsets.push(data.len() as u32);
        lengths.push(bytes.len() as u32);
        data.extend(bytes);
    }
    let top = AT + dvec2(0.0, ROWS as f64 * SIDE);
    let first = if how.of_points {
        top + dvec2(SIDE, -SIDE) / 2.0
    } else {
        top
    };
    let shorts = |all: &[u16]| {
        (
            3u16,
            all.len(),
            all.iter().flat_map(|n| two(*n)).collect::<Vec<u8>>(),
        )
    };
    let longs = |all: &[u32]| {
        (
            4u16,
            all.len(),
            all.iter().flat_map(|n| four(*n)).collect::<Vec<u8>>(),
        )
    };
    let doubles = |all: &[f64]| {
        (
            12u16,
            all.len(),
            all.iter().flat_map(|n| eight(*n)).collect::<Vec<u8>>(),
        )
    };
    let keys = [
        1,
        1,
        0,
        4,
        1024,
        0,
        1,
        1,
        1025,
        0,
        1,
        1 + u16::from(how.of_points),
        3072,
        0,
        1,
        how.code,
        4099,
        0,
        1,
        how.vertical,
    ];
    let mut tags = vec![
        (256, longs(&[COLUMNS as u32])),
        (257, longs(&[ROWS as u32])),
        (258, shorts(&vec![how.bits; how.bands.into()])),
        (259, shorts(&[1])),
        (262, shorts(&[if how.bands == 3 { 2 } else { 1 }])),
        (273, longs(&offsets)),
        (277, shorts(&[how.bands])),
        (278, longs(&[STRIP as u32])),
        (279, longs(&lengths)),
        (339, shorts(&vec![how.format; how.bands.into()])),
        (33550, doubles(&[SIDE, SIDE, 0.0])),
        (33922, doubles(&[0.0, 0.0, 0.0, first.x, first.y, 0.0])),
        (34735, shorts(&keys)),
        (42113, (2, 6, b"-9999\0".to_vec())),
    ];
    if how.turn != 0.0 {
        let turned = [
            SIDE, how.turn, 0.0, AT.x, how.turn, -SIDE, 0.0, AT.y, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
            0.0, 1.0,
        ];
        tags[10] = (34264, doubles(&turned));
        tags.remove(11);
    }
    tags.sort_by_key(|(tag, _)| *tag);
    let mut directory = two(tags.len() as u16);
    let mut extra = vec![];
    let after = data.len() + 2 + 12 * tags.len() + 4;
    for (tag, (kind, count, mut bytes)) in tags {
        directory.extend([two(tag), two(kind), four(count as u32)].concat());
        if bytes.len() > 4 {
            directory.extend(four((after + extra.len()) as u32));
            extra.extend(bytes);
        } else {
            bytes.resize(4, 0);
            directory.extend(bytes);
        }
    }
    let at = four(data.len() as u32);
    data[4..8].copy_from_slice(&at);
    data.extend(directory);
    data.extend([0; 4]);
    data.extend(extra);
    data
}

/// A grid of GSI's: 9 columns and 6 rows over a hundredth of a degree, with the cells from `start` on and the last left out.
pub(crate) fn gml(start: usize, count: usize) -> Vec<u8> {
    let mut lines = String::new();
    for cell in start..start + count {
        let (column, row) = (cell % 9, cell / 9);
        let p = dvec2(
            135.75 + (column as f64 + 0.5) * 0.001,
            34.985 - (row as f64 + 0.5) * 0.001,
        );
        let kind = ["地表面", "表層面", "その他"][cell % 3];
        lines.push_str(&format!("{kind},{:.4}\n", of_degrees(p)));
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Dataset xmlns:gml=\"http://www.opengis.net/gml/3.2\"><DEM><type>5mメッシュ（標高）</type><coverage>\
         <gml:boundedBy><gml:Envelope srsName=\"fguuid:jgd2011.bl\"><gml:lowerCorner>34.979 135.75</gml:lowerCorner><gml:upperCorner>34.985 135.759</gml:upperCorner></gml:Envelope></gml:boundedBy>\
         <gml:gridDomain><gml:Grid><gml:limits><gml:GridEnvelope><gml:low>0 0</gml:low><gml:high>8 5</gml:high></gml:GridEnvelope></gml:limits></gml:Grid></gml:gridDomain>\
         <gml:rangeSet><gml:DataBlock><gml:tupleList>\n{lines}</gml:tupleList></gml:DataBlock></gml:rangeSet>\
         <gml:coverageFunction><gml:GridFunction><gml:sequenceRule order=\"+x-y\">Linear</gml:sequenceRule><gml:startPoint>{} {}</gml:startPoint></gml:GridFunction></gml:coverageFunction>\
         </coverage></DEM></Dataset>\n",
        start % 9,
        start / 9
    )
    .into_bytes()
}

/// The surface of the grid of GSI's.
pub(crate) fn of_degrees(p: DVec2) -> f64 {
    50.0 + 3000.0 * (p.x - 135.75) - 2000.0 * (p.y - 34.98)
}

/// A tile of text, in which the last row has no heights.
pub(crate) fn tile() -> Vec<u8> {
    let row = |row: usize| -> String {
        let cell = |column: usize| match row {
            255 => "e".to_owned(),
            row => format!("{:.2}", 5.0 + 0.25 * row as f64 + 0.5 * column as f64),
        };
        (0..256).map(cell).collect::<Vec<String>>().join(",") + "\n"
    };
    (0..256).map(row).collect::<String>().into_bytes()
}

pub(crate) const TILE: &str = "dem/14/14547/6463.txt";
