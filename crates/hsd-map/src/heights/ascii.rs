//! ESRI ASCII grid: a head of words and numbers, then the heights of each row from north to south. The reference system
//! stands in a `.prj` beside it.

use super::cut::Raster;
use super::{Heights, Wish};
use crate::Crs;
use crate::fault::{Fault, Kind};
use crate::input::{Input, unreadable};
use glam::DVec2;
use std::io::{BufRead, Read};

/// The words of the head, in small letters.
pub(super) const KEYS: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "yllcorner",
    "xllcenter",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];

/// The longest word.
const WORD: usize = 64;
/// The most bytes of a `.prj`.
const PRJ: u64 = 64 << 10;

/// Reads a grid.
pub(super) fn read(
    input: Input,
    wish: &Wish<'_>,
    remarks: &mut Vec<Fault>,
) -> Result<Heights, Fault> {
    let mut words = Words { input, wish };
    let mut head: [Option<f64>; KEYS.len()] = [None; KEYS.len()];
    // The first word that is none of the head is the first height.
    let mut next = words.next()?;
    while let Some(word) = &next {
        let small = word.to_ascii_lowercase();
        let Some(key) = KEYS.iter().position(|key| *key == small) else {
            break;
        };
        let value = words.next()?.and_then(|word| word.parse().ok());
        let what = "a word of the head has no number behind it";
        head[key] = Some(value.ok_or_else(|| words.damaged(what))?);
        next = words.next()?;
    }
    let raster = raster(&head, wish)?;
    let crs = wish.crs(beside(wish, remarks));
    let mut cut = raster.cut(crs.as_ref(), wish)?;
    let empty = head[9].unwrap_or(-9999.0);
    let mut found = 0;
    let last = cut.rows().end;
    while let Some(word) = next {
        let value: f64 = word
            .parse()
            .map_err(|_| words.damaged("a height is no number"))?;
        let (column, row) = (found % raster.columns, found / raster.columns);
        if value != empty {
            cut.set(column, row, value);
        }
        found += 1;
        if found / raster.columns >= last {
            break;
        }
        next = words.next()?;
    }
    let said = raster.columns * last;
    if found < said {
        remarks.push(wish.fault(Kind::CellsDiffer { said, found }));
    }
    Ok(Heights::of(crs, cut))
}

/// Returns the place of a grid with this head.
fn raster(head: &[Option<f64>; KEYS.len()], wish: &Wish<'_>) -> Result<Raster, Fault> {
    let what = "its head lacks the number of rows, the size of a cell or the place of the first";
    let missing = || wish.fault(Kind::Damaged { what });
    let count = |n: Option<f64>| n.filter(|n| *n >= 1.0 && *n < 1e15).map(|n| n as u64);
    let columns = count(head[0]).ok_or_else(missing)?;
    let rows = count(head[1]).ok_or_else(missing)?;
    let side = |own: Option<f64>| own.or(head[6]).filter(|side| *side > 0.0);
    let dx = side(head[7]).ok_or_else(missing)?;
    let dy = side(head[8]).ok_or_else(missing)?;
    let low = |corner: Option<f64>, centre: Option<f64>, side: f64| {
        centre.or_else(|| Some(corner? + side / 2.0))
    };
    let x = low(head[2], head[4], dx).ok_or_else(missing)?;
    let y = low(head[3], head[5], dy).ok_or_else(missing)?;
    Ok(Raster {
        first: DVec2::new(x, y + dy * (rows as f64 - 1.0)),
        step: DVec2::new(dx, -dy),
        columns,
        rows,
    })
}

/// Returns the system in the `.prj`.
fn beside(wish: &Wish<'_>, remarks: &mut Vec<Fault>) -> Option<Crs> {
    let stem = wish.file.strip_suffix(".gz").unwrap_or(wish.file);
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    let stream = wish.world.open(&format!("{stem}.prj")).ok()?;
    let mut text = vec![];
    stream.take(PRJ).read_to_end(&mut text).ok()?;
    let text = String::from_utf8_lossy(&text);
    let found = Crs::from_name(&text);
    if found.is_none() && wish.options.crs.is_none() {
        let name = text.chars().take(60).collect::<String>().into();
        remarks.push(wish.fault(Kind::UnknownCrs { name }));
    }
    found
}

/// The words of a file.
struct Words<'w> {
    input: Input,
    wish: &'w Wish<'w>,
}

impl Words<'_> {
    fn damaged(&self, what: &'static str) -> Fault {
        self.wish.fault(Kind::Damaged { what }).at(self.input.at())
    }

    /// Returns the next word; `None` at the end.
    fn next(&mut self) -> Result<Option<String>, Fault> {
        let mut word = vec![];
        loop {
            let buffer = self.input.fill_buf();
            let buffer = buffer.map_err(|error| unreadable(self.wish.file, &error))?;
            if buffer.is_empty() {
                break;
            }
            let start = match word.is_empty() {
                true => buffer.iter().take_while(|b| is_space(**b)).count(),
                false => 0,
            };
            let rest = &buffer[start..];
            let end = rest.iter().position(|b| is_space(*b));
            word.extend_from_slice(&rest[..end.unwrap_or(rest.len())]);
            let taken = start + end.unwrap_or(rest.len());
            self.input.consume(taken);
            if word.len() > WORD {
                return Err(self.damaged("a number is longer than any number"));
            }
            if end.is_some() && !word.is_empty() {
                break;
            }
        }
        let text = String::from_utf8_lossy(&word).into_owned();
        Ok((!word.is_empty()).then_some(text))
    }
}

fn is_space(byte: u8) -> bool {
    byte.is_ascii_whitespace()
}
