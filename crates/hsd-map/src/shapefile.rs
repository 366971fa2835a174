//! Shapefiles: geometry from `.shp`, fields from `.dbf`, the reference system from `.prj`. What is missing beside the `.shp`
//! is reported, and the rest is read (ESRI Shapefile Technical Description, 1998). The index `.shx` is not needed: the
//! records tell their lengths themselves.

mod dbf;
mod shape;

use super::fault::{Fault, Kind};
use super::feature::{Feature, Layer, Place};
use super::input::unreadable;
use super::{Crs, Options, Reader};
use dbf::Table;
use hsd_base::source::{Stream, World};
use std::io::{BufReader, Read};
use std::sync::Arc;

/// Bytes before the first record.
const HEAD: u64 = 100;

/// The most bytes of a `.prj` or `.cpg`.
const MOST_TEXT: u64 = 64 << 10;

/// A reader of shapefiles.
pub(super) struct Shapefile {
    records: Option<BufReader<Box<dyn Stream>>>,
    table: Option<Table>,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    number: u64,
    at: u64,
    /// The length that the head says, in bytes.
    said: u64,
    feature_bytes: usize,
    is_over: bool,
}

/// A record of the `.shp`.
struct Record {
    /// The place of its first byte.
    at: u64,
    content: Vec<u8>,
}

impl Shapefile {
    /// Begins to read a `.shp`, or a `.dbf` alone, of which no record has a geometry.
    ///
    /// # Errors
    /// If neither is there, or the head of the `.shp` is none.
    pub(super) fn open(
        world: &dyn World,
        file: &Arc<str>,
        options: &Options,
    ) -> Result<Shapefile, Fault> {
        let mut remarks = vec![];
        let mut missing = |part: &'static str| {
            remarks.push(Fault::of_file(file, Kind::MissingPart { part }));
        };
        let records = match super::has_extension(file, "dbf") {
            true => None,
            false => Some(world.open(file).map_err(|e| unreadable(file, &e))?),
        };
        let mut layer = Layer {
            name: super::stem(file).into(),
            crs: options.crs.clone(),
            ..Layer::default()
        };
        if records.is_some() && beside(world, file, "shx").is_none() {
            missing(".shx");
        }
        let prj = text_beside(world, file, "prj");
        if prj.is_none() && options.crs.is_none() && records.is_some() {
            missing(".prj");
        }
        let named = options.encoding.as_deref().map(str::to_owned);
        let encoding = named.or_else(|| text_beside(world, file, "cpg"));
        let table = match beside(world, file, "dbf") {
            Some(stream) => {
                Table::open(stream, file, encoding.as_deref(), &mut layer, &mut remarks)
            }
            None => {
                missing(".dbf");
                None
            }
        };
        if let Some(text) = prj.filter(|_| options.crs.is_none()) {
            layer.crs = Crs::from_wkt(&text);
            if layer.crs.is_none() {
                let name = text.chars().take(60).collect::<String>().into();
                remarks.push(Fault::of_file(file, Kind::UnknownCrs { name }));
            }
        }
        let mut reader = Shapefile {
            records: records.map(BufReader::new),
            table,
            file: file.clone(),
            layer,
            remarks,
            number: 0,
            at: 0,
            said: 0,
            feature_bytes: options.limits.feature_bytes,
            is_over: false,
        };
        reader.read_head()?;
        Ok(reader)
    }

    fn read_head(&mut self) -> Result<(), Fault> {
        let mut head = [0; HEAD as usize];
        let Some(records) = &mut self.records else {
            return Ok(());
        };
        let what = "the head of a shapefile";
        let damaged = Fault::of_file(&self.file, Kind::Damaged { what }).at(0);
        if records.read_exact(&mut head).is_err() || head[..4] != 9994u32.to_be_bytes() {
            return Err(damaged);
        }
        self.at = HEAD;
        self.said = 2 * u64::from(u32::from_be_bytes([head[24], head[25], head[26], head[27]]));
        Ok(())
    }

    /// Returns the next record; `None` at the end.
    fn record(&mut self) -> Option<Result<Record, Fault>> {
        let Some(records) = &mut self.records else {
            // A table alone ends with its last record.
            let goes_on = self.table.as_mut().is_some_and(Table::has_row);
            let (at, content) = (0, 0u32.to_le_bytes().to_vec());
            return goes_on.then_some(Ok(Record { at, content }));
        };
        let mut head = [0; 8];
        let at = self.at;
        let got = match read_most(records, &mut head) {
            Ok(got) => got,
            Err(error) => return Some(Err(unreadable(&self.file, &error))),
        };
        if got == 0 {
            return None;
        }
        let number =
            |at: usize| u32::from_be_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let length = 2 * u64::from(number(4));
        if at >= self.said && u64::from(number(0)) != self.number + 1 {
            let what = "what follows the last record is no record";
            self.remarks
                .push(Fault::of_file(&self.file, Kind::Damaged { what }).at(at));
            return None;
        }
        let kind = match length {
            _ if got < head.len() => Kind::Damaged {
                what: "the file ends in the middle",
            },
            length if length > self.feature_bytes as u64 => Kind::TooLarge {
                what: "bytes of a feature",
                limit: self.feature_bytes as u64,
            },
            length => {
                let mut content = vec![];
                let taken = records.take(length).read_to_end(&mut content);
                if taken.is_ok_and(|taken| taken as u64 == length) {
                    self.at = at + 8 + length;
                    return Some(Ok(Record { at, content }));
                }
                Kind::Damaged {
                    what: "the file ends in the middle",
                }
            }
        };
        Some(Err(Fault::of_file(&self.file, kind).at(at)))
    }

    /// Reports records of the table that no shape belongs to, and rows that a table alone should have.
    fn end(&mut self) {
        self.is_over = true;
        let Some(table) = &self.table else {
            return;
        };
        let (said, found) = (table.count(), self.number);
        if said != found {
            let kind = match self.records {
                Some(_) => Kind::CountsDiffer { said, found },
                None => Kind::Damaged {
                    what: "the file ends in the middle",
                },
            };
            self.remarks.push(Fault::of_file(&self.file, kind));
        }
    }

    fn feature(&mut self, record: &Record) -> Result<Feature, Fault> {
        let number = self.number;
        self.number += 1;
        let mut fields = vec![];
        if let Some(table) = &mut self.table {
            let mut found = vec![];
            fields = table.row(number, &mut self.layer.columns, &mut found);
            for (field, kind) in found {
                let fault = Fault::of_file(&self.file, kind).of_feature(number, None);
                self.remarks.push(match field {
                    Some(field) => fault.in_field(field),
                    None => fault,
                });
            }
        }
        let geometry = shape::geometry(&record.content).map_err(|kind| {
            let fault = Fault::of_file(&self.file, kind).at(record.at);
            fault.of_feature(number, None)
        })?;
        Ok(Feature {
            number,
            id: None,
            geometry,
            fields,
            place: Place::Byte(record.at),
        })
    }
}

impl Iterator for Shapefile {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        match self.record() {
            Some(Ok(record)) => Some(self.feature(&record)),
            Some(Err(fault)) => {
                self.end();
                Some(Err(fault))
            }
            None => {
                self.end();
                None
            }
        }
    }
}

impl Reader for Shapefile {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}

/// Reads until a buffer is full or the file ends; returns how many bytes.
fn read_most(from: &mut impl Read, out: &mut [u8]) -> std::io::Result<usize> {
    let mut got = 0;
    while got < out.len() {
        match from.read(&mut out[got..])? {
            0 => break,
            count => got += count,
        }
    }
    Ok(got)
}

/// Opens the file of another extension, in small or large letters.
fn beside(world: &dyn World, file: &str, extension: &str) -> Option<Box<dyn Stream>> {
    let (stem, _) = file.rsplit_once('.')?;
    let names = [extension.to_owned(), extension.to_uppercase()];
    names
        .iter()
        .find_map(|e| world.open(&format!("{stem}.{e}")).ok())
}

fn text_beside(world: &dyn World, file: &str, extension: &str) -> Option<String> {
    let mut bytes = vec![];
    let stream = beside(world, file, extension)?;
    stream.take(MOST_TEXT).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).trim().to_owned())
}
