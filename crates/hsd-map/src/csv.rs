//! Points in tables of text: comma, tab or semicolon between values (RFC 4180), the first line names the columns. The
//! columns of coordinates are known by their names.

use super::fault::{Fault, Kind};
use super::feature::{Chain, Columns, Feature, Geometry, Layer, Place, Value};
use super::input::{Input, unreadable};
use super::{Crs, Options, Reader};
use glam::dvec2;
use std::io::{BufRead, Read};
use std::sync::Arc;

/// Names of columns of longitude and latitude.
const DEGREES: ([&str; 5], [&str; 5]) = (
    ["lon", "lng", "long", "longitude", "経度"],
    ["lat", "latitude", "緯度", "北緯", "y緯度"],
);

/// Names of columns of metres to the east and to the north. The letters x and y alone mean this, as in programs for maps.
const METRES: ([&str; 4], [&str; 4]) = (
    ["x", "east", "easting", "x座標"],
    ["y", "north", "northing", "y座標"],
);

/// Names of columns of heights.
const HEIGHTS: [&str; 4] = ["z", "標高", "elevation", "z座標"];

/// A reader of tables of text.
pub(super) struct Csv {
    input: Input,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    separator: u8,
    /// The columns of east and north.
    coordinates: (usize, usize),
    /// The column of heights.
    height: Option<usize>,
    columns: usize,
    number: u64,
    most: usize,
    is_over: bool,
}

impl Csv {
    /// Begins to read.
    ///
    /// # Errors
    /// If the first line has no columns of coordinates.
    pub(super) fn open(input: Input, file: &Arc<str>, options: &Options) -> Result<Csv, Fault> {
        let (input, _) = input.into_text(file, options.encoding.as_deref())?;
        let mut csv = Csv {
            input,
            file: file.clone(),
            layer: Layer {
                name: super::stem(file).into(),
                ..Layer::default()
            },
            remarks: vec![],
            separator: b',',
            coordinates: (0, 0),
            height: None,
            columns: 0,
            number: 0,
            most: options.limits.feature_bytes,
            is_over: false,
        };
        let head = csv.line()?.unwrap_or_default();
        let count = |separator: u8| head.iter().filter(|b| **b == separator).count();
        csv.separator = [b',', b'\t', b';']
            .into_iter()
            .max_by_key(|s| (count(*s), *s == b','))
            .unwrap_or(b',');
        if count_values(&head, csv.separator) > Columns::MOST {
            let (what, limit) = ("columns", Columns::MOST as u64);
            return Err(Fault::of_file(file, Kind::TooLarge { what, limit }));
        }
        let names = split(&head, csv.separator);
        csv.columns = names.len();
        let plain: Vec<String> = names.iter().map(|n| n.trim().to_lowercase()).collect();
        let find = |names: &[&str]| plain.iter().position(|name| names.contains(&name.as_str()));
        let degrees = find(&DEGREES.0).zip(find(&DEGREES.1));
        let metres = find(&METRES.0).zip(find(&METRES.1));
        let none = || Fault::of_file(file, Kind::NoCoordinates);
        csv.coordinates = degrees.or(metres).ok_or_else(none)?;
        csv.height = find(&HEIGHTS);
        csv.layer.crs = options
            .crs
            .clone()
            .or_else(|| degrees.map(|_| Crs::wgs84()));
        for name in names {
            csv.add_column(name.trim());
        }
        Ok(csv)
    }

    fn add_column(&mut self, name: &str) {
        let columns = &mut self.layer.columns;
        let before = columns.list().len();
        columns.number(name);
        if columns.list().len() == before {
            let fault = Fault::of_file(&self.file, Kind::DuplicateColumn).in_field(name);
            self.remarks.push(fault);
            columns.number(&format!("{name}_{before}"));
        }
    }

    /// Returns the next line, in which quoted values may hold line ends.
    fn line(&mut self) -> Result<Option<Vec<u8>>, Fault> {
        let (mut line, mut is_whole) = (vec![], true);
        loop {
            let before = line.len();
            let room = (self.most - line.len().min(self.most)) as u64 + 1;
            let taken = (&mut self.input).take(room).read_until(b'\n', &mut line);
            let taken = taken.map_err(|e| unreadable(&self.file, &e))?;
            if line.len() > self.most {
                let (what, limit) = ("bytes of a feature", self.most as u64);
                return Err(Fault::of_file(&self.file, Kind::TooLarge { what, limit }));
            }
            let quotes = line[before..].iter().filter(|b| **b == b'"');
            is_whole ^= quotes.count() % 2 == 1;
            if taken == 0 || is_whole {
                break;
            }
        }
        let is_end = line.is_empty();
        while line.last().is_some_and(|b| matches!(b, b'\n' | b'\r')) {
            line.pop();
        }
        Ok((!is_end).then_some(line))
    }

    fn feature(&mut self, line: &[u8], at: u64) -> Result<Feature, Fault> {
        let number = self.number;
        self.number += 1;
        let fault = |kind: Kind| {
            Fault::of_file(&self.file, kind)
                .at(at)
                .of_feature(number, None)
        };
        // Counted before anything is made of them.
        let count = count_values(line, self.separator);
        if count != self.columns {
            let what = format!("{count} values for {} columns", self.columns);
            return Err(fault(Kind::Malformed { what: what.into() }));
        }
        let values = split(line, self.separator);
        let coordinate = |column: usize| {
            let text = values[column].trim();
            let name = || self.layer.columns.list()[column].name.clone();
            match text.parse::<f64>() {
                Ok(value) => Ok(value),
                Err(_) if text.is_empty() => Err(fault(Kind::NoGeometry).in_field(name())),
                Err(_) => Err(fault(Kind::NotANumber { text: text.into() }).in_field(name())),
            }
        };
        let place = dvec2(
            coordinate(self.coordinates.0)?,
            coordinate(self.coordinates.1)?,
        );
        let height = self.height.and_then(|at| values[at].trim().parse().ok());
        let mut fields = vec![];
        for (column, text) in values.iter().enumerate() {
            let value = value(text);
            if text.contains('\u{fffd}') {
                let name = self.layer.columns.list()[column].name.clone();
                self.remarks.push(fault(Kind::Encoding).in_field(name));
            }
            self.layer.columns.note(column, &value);
            fields.push((column, value));
        }
        Ok(Feature {
            number,
            id: None,
            geometry: Geometry::Points(Chain {
                points: vec![place],
                heights: height.into_iter().collect(),
            }),
            fields,
            place: Place::Byte(at),
        })
    }
}

/// Returns the number of values of a line.
fn count_values(line: &[u8], separator: u8) -> usize {
    let (mut count, mut is_quoted) = (1, false);
    for byte in line {
        is_quoted ^= *byte == b'"';
        count += usize::from(*byte == separator && !is_quoted);
    }
    count
}

/// Returns the values of a line.
fn split(line: &[u8], separator: u8) -> Vec<String> {
    let (mut values, mut value, mut is_quoted) = (vec![], vec![], false);
    let mut bytes = line.iter().copied().peekable();
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' if is_quoted && bytes.peek() == Some(&b'"') => {
                value.push(b'"');
                bytes.next();
            }
            b'"' => is_quoted = !is_quoted,
            _ if byte == separator && !is_quoted => values.push(std::mem::take(&mut value)),
            _ => value.push(byte),
        }
    }
    values.push(value);
    let text = |value: Vec<u8>| String::from_utf8_lossy(&value).into_owned();
    values.into_iter().map(text).collect()
}

fn value(text: &str) -> Value {
    let text = text.trim();
    let is_code = text.len() > 1 && text.starts_with('0') && !text.starts_with("0.");
    if text.is_empty() {
        return Value::Null;
    }
    if let Some(whole) = text.parse().ok().filter(|_| !is_code) {
        return Value::Integer(whole);
    }
    let is_number = text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '.');
    let number = text
        .parse()
        .ok()
        .filter(|n: &f64| n.is_finite() && is_number && !is_code);
    number.map_or_else(|| Value::Text(text.into()), Value::Number)
}

impl Iterator for Csv {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.is_over {
            let at = self.input.at();
            match self.line() {
                Ok(Some(line)) if line.trim_ascii().is_empty() => {}
                Ok(Some(line)) => return Some(self.feature(&line, at)),
                Ok(None) => self.is_over = true,
                Err(fault) => {
                    self.is_over = true;
                    return Some(Err(fault));
                }
            }
        }
        None
    }
}

impl Reader for Csv {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
