//! The elevation model of the Geospatial Information Authority of Japan (基盤地図情報 数値標高モデル) in GML: a rectangle of
//! latitude and longitude, the number of cells, and a line for each cell from the north-west, of which the first may be
//! skipped and the last left out.

use super::cut::Raster;
use super::{Heights, Wish};
use crate::fault::{Fault, Kind};
use crate::input::Input;
use crate::xml::{Token, Xml};
use crate::{Crs, Datum};
use glam::{DVec2, dvec2};

/// The most cells of a file; those of 1 m have 1,125 x 750, those of 10 m the same.
const MOST: usize = 16 << 20;
/// The number that stands for no height.
const EMPTY: f64 = -9999.0;

/// What the file says.
#[derive(Default)]
struct Read {
    /// The south-western and the north-eastern corner.
    corners: [Option<DVec2>; 2],
    /// The numbers of the first and the last cell.
    cells: [Option<(u64, u64)>; 2],
    start: (u64, u64),
    datum: Option<Crs>,
    order: String,
    values: Vec<f32>,
    /// What is left of a line that is cut between two pieces of text.
    rest: String,
}

/// Reads a grid.
pub(super) fn read(
    input: Input,
    wish: &Wish<'_>,
    remarks: &mut Vec<Fault>,
) -> Result<Heights, Fault> {
    let mut xml = Xml::open(input, wish.file, wish.options.encoding.as_deref())?;
    let (mut read, mut open) = (Read::default(), vec![]);
    let mut text = String::new();
    loop {
        let at = xml.at();
        match xml.next()? {
            Some(Token::Start(element)) => {
                if &*element.name == "Envelope" {
                    read.datum = element.attribute("srsName").and_then(system);
                }
                text.clear();
                open.push(element.name);
            }
            Some(Token::Text(piece)) => match open.last().map(|name| &**name) {
                Some("tupleList") => read.tuples(&piece, wish, at)?,
                Some(_) if text.len() < 256 => text.push_str(&piece),
                _ => {}
            },
            Some(Token::End) => {
                if let Some(name) = open.pop() {
                    read.end(&name, text.trim(), wish, at)?;
                }
            }
            None if open.is_empty() => break,
            None => {
                let what = "the file ends in the middle";
                return Err(wish.fault(Kind::Damaged { what }).at(at));
            }
        }
    }
    read.heights(wish, remarks)
}

/// Returns the system of a name such as `fguuid:jgd2011.bl`.
fn system(name: &str) -> Option<Crs> {
    let small = name.to_ascii_lowercase();
    match () {
        () if small.contains("jgd2011") || small.contains("jgd2024") => Crs::from_epsg(6668),
        () if small.contains("jgd2000") => Crs::from_epsg(4612),
        () => Crs::from_name(name),
    }
}

fn pair<T: std::str::FromStr>(text: &str) -> Option<(T, T)> {
    let mut words = text.split_whitespace();
    Some((words.next()?.parse().ok()?, words.next()?.parse().ok()?))
}

impl Read {
    fn end(&mut self, name: &str, text: &str, wish: &Wish<'_>, at: u64) -> Result<(), Fault> {
        // Latitude comes first.
        let corner = || pair(text).map(|(north, east): (f64, f64)| dvec2(east, north));
        match name {
            "lowerCorner" => self.corners[0] = corner(),
            "upperCorner" => self.corners[1] = corner(),
            "low" => self.cells[0] = pair(text),
            "high" => self.cells[1] = pair(text),
            "startPoint" => self.start = pair(text).unwrap_or_default(),
            "sequenceRule" => text.clone_into(&mut self.order),
            "tupleList" => {
                let rest = std::mem::take(&mut self.rest);
                self.tuple(&rest, wish, at)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Takes a piece of the list of cells.
    fn tuples(&mut self, piece: &str, wish: &Wish<'_>, at: u64) -> Result<(), Fault> {
        let mut lines = piece.split('\n');
        self.rest.push_str(lines.next().unwrap_or_default());
        for line in lines {
            let whole = std::mem::replace(&mut self.rest, line.to_owned());
            self.tuple(&whole, wish, at)?;
        }
        Ok(())
    }

    /// Takes a cell: the kind of its surface and its height.
    fn tuple(&mut self, line: &str, wish: &Wish<'_>, at: u64) -> Result<(), Fault> {
        let line = line.trim();
        if line.is_empty() {
            return Ok(());
        }
        if self.values.len() >= MOST {
            let (what, limit) = ("the cells of a grid of heights", MOST as u64);
            return Err(wish.fault(Kind::TooLarge { what, limit }));
        }
        let what = "a height is no number";
        let value = line.rsplit(',').next().and_then(|word| word.parse().ok());
        let value: f64 = value.ok_or_else(|| wish.fault(Kind::Damaged { what }).at(at))?;
        let value = if value == EMPTY { f64::NAN } else { value };
        self.values.push(super::height(value));
        Ok(())
    }

    fn heights(self, wish: &Wish<'_>, remarks: &mut Vec<Fault>) -> Result<Heights, Fault> {
        let what = "it lacks its corners or the number of its cells";
        let missing = || wish.fault(Kind::Damaged { what });
        let [low, high] = self.corners;
        let (low, high) = low.zip(high).ok_or_else(missing)?;
        let [first, last] = self.cells;
        let (first, last) = first.zip(last).ok_or_else(missing)?;
        let count = |first: u64, last: u64| last.checked_sub(first)?.checked_add(1);
        let columns = count(first.0, last.0).ok_or_else(missing)?;
        let rows = count(first.1, last.1).ok_or_else(missing)?;
        if !self.order.is_empty() && self.order.trim() != "Linear" {
            let what = "its cells are in an order that is not read";
            return Err(wish.fault(Kind::Damaged { what }));
        }
        let side = (high - low) / dvec2(columns as f64, rows as f64);
        let raster = Raster {
            first: dvec2(low.x + side.x / 2.0, high.y - side.y / 2.0),
            step: dvec2(side.x, -side.y),
            columns,
            rows,
        };
        let crs = wish.crs(self.datum.or_else(|| Some(degrees())));
        let mut cut = raster.cut(crs.as_ref(), wish)?;
        let start = self.start.1.saturating_mul(columns);
        let start = start.saturating_add(self.start.0);
        for (number, value) in self.values.iter().enumerate() {
            let number = start.saturating_add(number as u64);
            cut.set(number % columns, number / columns, f64::from(*value));
        }
        let (said, found) = (
            columns * rows,
            start.saturating_add(self.values.len() as u64),
        );
        if found > said {
            remarks.push(wish.fault(Kind::CellsDiffer { said, found }));
        }
        Ok(Heights::of(crs, cut))
    }
}

/// Returns longitude and latitude of Japan since 2011.
fn degrees() -> Crs {
    Crs::from_epsg(6668).unwrap_or(Crs {
        datum: Datum::Jgd2011,
        ..Crs::wgs84()
    })
}
