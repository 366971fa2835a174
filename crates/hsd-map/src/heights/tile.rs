//! GSI's elevation tiles as text: `z/x/y.txt`, 256 rows of 256 heights with commas between them, `e` where there is none.
//! The path says where a tile lies on the web's Mercator.

use super::cut::Raster;
use super::{Heights, Wish};
use crate::Crs;
use crate::fault::{Fault, Kind};
use crate::input::{Input, unreadable};
use glam::DVec2;
use std::f64::consts::PI;
use std::io::Read;

/// The cells of a side.
const SIDE: u32 = 256;
/// The radius of the sphere of the web's Mercator, metres.
const RADIUS: f64 = 6_378_137.0;
/// The most bytes of a tile: some ten times what GSI's have.
const MOST: u64 = 4 << 20;

/// Returns zoom, column and row of a tile, if its path names them and its text is of heights.
pub(super) fn place(path: &str, head: &str) -> Option<(u32, u32, u32)> {
    let stem = path.strip_suffix(".gz").unwrap_or(path);
    let stem = stem.strip_suffix(".txt")?;
    let mut parts = stem.rsplit(['/', '\\']);
    let mut number = || parts.next()?.parse::<u32>().ok();
    let (y, x, zoom) = (number()?, number()?, number()?);
    let first = head.split([',', '\n', '\r']).next()?.trim();
    let of_heights = first == "e" || first.parse::<f64>().is_ok();
    let inside = zoom <= 24 && x < 1 << zoom && y < 1 << zoom;
    (of_heights && inside && head.contains(',')).then_some((zoom, x, y))
}

/// Reads a tile.
pub(super) fn read(
    mut input: Input,
    wish: &Wish<'_>,
    (zoom, x, y): (u32, u32, u32),
    remarks: &mut Vec<Fault>,
) -> Result<Heights, Fault> {
    let mut bytes = vec![];
    let read = input.by_ref().take(MOST).read_to_end(&mut bytes);
    read.map_err(|error| unreadable(wish.file, &error))?;
    let text = String::from_utf8_lossy(&bytes);
    let half = PI * RADIUS;
    let step = 2.0 * half / f64::from(SIDE) / f64::from(1u32 << zoom);
    let cell = |tile: u32| (f64::from(tile) * f64::from(SIDE) + 0.5) * step;
    let side = u64::from(SIDE);
    let raster = Raster {
        first: DVec2::new(cell(x) - half, half - cell(y)),
        step: DVec2::new(step, -step),
        columns: side,
        rows: side,
    };
    let crs = wish.crs(Crs::from_epsg(3857));
    let mut cut = raster.cut(crs.as_ref(), wish)?;
    let mut found = 0;
    let rows = text.lines().filter(|line| !line.trim().is_empty());
    for (row, line) in (0..side).zip(rows) {
        for (column, word) in (0..side).zip(line.split(',')) {
            let word = word.trim();
            found += 1;
            if word == "e" {
                continue;
            }
            let value = word.parse();
            let what = "a height is no number";
            let at = word.as_ptr() as u64 - text.as_ptr() as u64;
            let value = value.map_err(|_| wish.fault(Kind::Damaged { what }).at(at))?;
            cut.set(column, row, value);
        }
    }
    let said = side * side;
    if found != said {
        remarks.push(wish.fault(Kind::CellsDiffer { said, found }));
    }
    Ok(Heights::of(crs, cut))
}
