//! FlatGeobuf (flatgeobuf.org, version 3): a head, an index of places, which is skipped, and features one after another.

mod table;

use super::fault::{Fault, Kind};
use super::feature::{Area, Chain, Feature, Geometry, Layer, Place, Value};
use super::input::{Input, unreadable};
use super::{Crs, Options, Reader};
use glam::dvec2;
use hsd_base::budget::{Account, Resource};
use std::io::Read;
use std::sync::Arc;
use table::Table;

/// The first bytes of a file; the last byte is a minor version.
pub(super) const MAGIC: &[u8] = b"fgb\x03fgb";

/// The most bytes of a head.
const MOST_HEAD: usize = 16 << 20;

/// The head is not as the format demands.
const DAMAGED: Kind = Kind::Damaged {
    what: "the head of FlatGeobuf",
};

/// Bytes of a node of the index.
const NODE: u64 = 40;

/// The nesting of geometries that is read; collections are one deep.
const DEEPEST: usize = 4;

/// A reader of FlatGeobuf.
pub(super) struct FlatGeobuf {
    input: Input,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    /// The number and type of each column.
    columns: Vec<(usize, u8)>,
    /// The kind of all geometries, 0 if each tells its own.
    kind: u8,
    number: u64,
    feature_bytes: usize,
    account: Arc<Account>,
    is_over: bool,
}

impl FlatGeobuf {
    /// Begins to read.
    ///
    /// # Errors
    /// If the head is damaged.
    pub(super) fn open(
        input: Input,
        file: &Arc<str>,
        options: &Options,
    ) -> Result<FlatGeobuf, Fault> {
        let mut reader = FlatGeobuf {
            account: input.account(),
            input,
            file: file.clone(),
            layer: Layer {
                name: super::stem(file).into(),
                crs: options.crs.clone(),
                ..Layer::default()
            },
            remarks: vec![],
            columns: vec![],
            kind: 0,
            number: 0,
            feature_bytes: options.limits.feature_bytes,
            is_over: false,
        };
        let fault = |kind| Fault::of_file(file, kind).at(0);
        let head = reader
            .exactly(MAGIC.len() + 1)
            .and_then(|_| reader.sized(MOST_HEAD).ok()?);
        let head = head.ok_or_else(|| fault(DAMAGED))?;
        let index = Table::root(&head).ok_or(DAMAGED);
        let index = index.and_then(|head| reader.read_head(&head));
        let index = index.map_err(fault)?;
        let skipped = std::io::copy(&mut (&mut reader.input).take(index), &mut std::io::sink());
        skipped.map_err(|e| unreadable(file, &e))?;
        Ok(reader)
    }

    /// Takes what the head says; returns the bytes of the index.
    ///
    /// # Errors
    /// If it is damaged, or its columns share what they name.
    fn read_head(&mut self, head: &Table<'_>) -> Result<u64, Kind> {
        self.kind = head.scalar::<1>(2).map_or(0, |b| b[0]);
        if let Some(name) = head.text(0).filter(|name| !name.is_empty()) {
            self.layer.name = name.into();
        }
        for column in head.tables(7).unwrap_or_default() {
            let length = column.list(0, 1).map_or(0, |(_, length)| length);
            self.account.charge(Resource::Features, 1)?;
            self.account.charge(Resource::TextBytes, length as u64)?;
            let name = column.text(0).ok_or(DAMAGED)?;
            let number = self.layer.columns.number(&name).ok_or(DAMAGED)?;
            self.columns
                .push((number, column.scalar::<1>(1).map_or(0, |b| b[0])));
        }
        if let Some(crs) = head.table(10).filter(|_| self.layer.crs.is_none()) {
            let code = crs.scalar(1).map(i32::from_le_bytes).unwrap_or_default();
            let by_code = u32::try_from(code).ok().and_then(Crs::from_epsg);
            let wkt = crs.text(4);
            let found = by_code.or_else(|| Crs::from_wkt(wkt.as_deref()?));
            if found.is_none() && (code > 0 || wkt.is_some()) {
                let name = format!("EPSG:{code}").into();
                self.remarks
                    .push(Fault::of_file(&self.file, Kind::UnknownCrs { name }));
            }
            self.layer.crs = found;
        }
        let count = head.scalar(8).map_or(0, u64::from_le_bytes);
        let node_size = head.scalar(9).map_or(16, u16::from_le_bytes);
        self.layer.count = (count > 0).then_some(count);
        index_bytes(count, u64::from(node_size)).ok_or(DAMAGED)
    }

    fn exactly(&mut self, count: usize) -> Option<Vec<u8>> {
        let mut bytes = vec![];
        let taken = (&mut self.input).take(count as u64).read_to_end(&mut bytes);
        (taken.ok()? == count).then_some(bytes)
    }

    /// Reads what is preceded by its length; `None` at the end of the file, and if it ends too early.
    fn sized(&mut self, most: usize) -> Result<Option<Vec<u8>>, Kind> {
        let mut length = vec![];
        let taken = (&mut self.input).take(4).read_to_end(&mut length);
        taken.map_err(|error| unreadable(&self.file, &error).kind)?;
        let what = "the file ends in the middle";
        let length = match length.first_chunk::<4>() {
            Some(length) => u32::from_le_bytes(*length) as usize,
            None if length.is_empty() => return Ok(None),
            None => return Err(Kind::Damaged { what }),
        };
        if length > most {
            let (what, limit) = ("bytes of a feature", most as u64);
            return Err(Kind::TooLarge { what, limit });
        }
        match self.exactly(length) {
            Some(bytes) => Ok(Some(bytes)),
            None => Err(Kind::Damaged { what }),
        }
    }

    fn feature(&mut self, bytes: &[u8], at: u64) -> Result<Feature, Fault> {
        let number = self.number;
        self.number += 1;
        let fault = |kind: Kind| {
            Fault::of_file(&self.file, kind)
                .at(at)
                .of_feature(number, None)
        };
        let malformed = |what: &str| fault(Kind::Malformed { what: what.into() });
        let table = Table::root(bytes).ok_or_else(|| malformed("the feature has no table"))?;
        let shape = table.table(0).ok_or_else(|| fault(Kind::NoGeometry))?;
        let geometry = geometry(&shape, self.kind, 0, &self.account).map_err(fault)?;
        let mut fields = vec![];
        if let Some((properties, _)) = table.list(1, 1) {
            let found = fields_of(properties, &self.columns);
            fields = found.ok_or_else(|| malformed("the fields are cut off"))?;
        }
        for (column, value) in &fields {
            self.layer.columns.note(*column, value);
        }
        Ok(Feature {
            number,
            id: None,
            geometry,
            fields,
            place: Place::Byte(at),
        })
    }

    /// Ends the reading; a file with fewer features than its head says is damaged.
    fn end(&mut self) -> Option<Fault> {
        self.is_over = true;
        let said = self.layer.count?;
        let what = "the file has fewer features than its head says";
        let fault = Fault::of_file(&self.file, Kind::Damaged { what }).at(self.input.at());
        (said > self.number).then_some(fault)
    }
}

/// Returns the bytes of an index over so many features.
fn index_bytes(count: u64, node_size: u64) -> Option<u64> {
    if count == 0 || node_size < 2 {
        return Some(0);
    }
    let (mut level, mut nodes) = (count, count);
    while level > 1 {
        level = level.div_ceil(node_size);
        nodes = nodes.checked_add(level)?;
    }
    // A single feature has a root above it.
    let nodes = if count == 1 { 2 } else { nodes };
    nodes.checked_mul(NODE)
}

fn fields_of(bytes: &[u8], columns: &[(usize, u8)]) -> Option<Vec<(usize, Value)>> {
    let (mut fields, mut rest) = (vec![], bytes);
    while !rest.is_empty() {
        let (head, after) = rest.split_first_chunk::<2>()?;
        let (column, of) = *columns.get(usize::from(u16::from_le_bytes(*head)))?;
        let (value, after) = value(of, after)?;
        fields.push((column, value));
        rest = after;
    }
    fields.sort_by_key(|field| field.0);
    fields.dedup_by_key(|field| field.0);
    Some(fields)
}

/// Reads a value of a type of the format; returns what follows.
fn value(of: u8, bytes: &[u8]) -> Option<(Value, &[u8])> {
    macro_rules! number {
        ($type:ty, $value:expr) => {{
            let (chunk, rest) = bytes.split_first_chunk()?;
            let make = $value;
            (make(<$type>::from_le_bytes(*chunk)), rest)
        }};
    }
    let finite = |n: f64| {
        if n.is_finite() {
            Value::Number(n)
        } else {
            Value::Null
        }
    };
    let large = |n: u64| i64::try_from(n).map_or(Value::Number(n as f64), Value::Integer);
    Some(match of {
        0 => number!(i8, |n: i8| Value::Integer(n.into())),
        1 => number!(u8, |n: u8| Value::Integer(n.into())),
        2 => number!(u8, |n: u8| Value::Bool(n != 0)),
        3 => number!(i16, |n: i16| Value::Integer(n.into())),
        4 => number!(u16, |n: u16| Value::Integer(n.into())),
        5 => number!(i32, |n: i32| Value::Integer(n.into())),
        6 => number!(u32, |n: u32| Value::Integer(n.into())),
        7 => number!(i64, Value::Integer),
        8 => number!(u64, large),
        9 => number!(f32, |n: f32| finite(n.into())),
        10 => number!(f64, finite),
        11..=14 => {
            let (length, rest) = bytes.split_first_chunk::<4>()?;
            let (text, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
            (Value::Text(String::from_utf8_lossy(text).into()), rest)
        }
        _ => return None,
    })
}

fn geometry(
    shape: &Table<'_>,
    of_layer: u8,
    depth: usize,
    account: &Account,
) -> Result<Geometry, Kind> {
    account.charge(Resource::Features, 1)?;
    let own = shape.scalar::<1>(6).map_or(0, |b| b[0]);
    let of = if own == 0 { of_layer } else { own };
    let parts = || -> Result<Vec<Geometry>, Kind> {
        let parts = shape.tables(7).filter(|_| depth < DEEPEST);
        let kind = if of == 6 { 3 } else { 0 };
        parts
            .into_iter()
            .flatten()
            .map(|part| geometry(&part, kind, depth + 1, account))
            .collect()
    };
    match of {
        1 | 4 => Ok(Geometry::Points(whole(shape, account)?)),
        2 | 5 => Ok(Geometry::Lines(chains(shape, account)?)),
        3 => {
            let mut rings = chains(shape, account)?.into_iter();
            let outline = rings.next().unwrap_or_default();
            let holes = rings.collect();
            Ok(Geometry::Areas(vec![Area { outline, holes }]))
        }
        6 | 7 => Geometry::joined(parts()?),
        other => Err(Kind::OtherGeometry {
            name: format!("curve or surface (type {other})").into(),
        }),
    }
}

/// Returns all points of a shape.
fn whole(shape: &Table<'_>, account: &Account) -> Result<Chain, Kind> {
    for list in [1, 2] {
        let count = shape.list(list, 8).map_or(0, |(_, count)| count as u64);
        account.charge(Resource::Points, count.div_ceil(2))?;
    }
    let xy = shape.numbers(1).ok_or(Kind::NoGeometry)?;
    let points = xy.chunks_exact(2).map(|p| dvec2(p[0], p[1])).collect();
    let heights = shape.numbers(2).unwrap_or_default();
    Ok(Chain { points, heights })
}

/// Returns the points of a shape, cut at the ends of its parts.
fn chains(shape: &Table<'_>, account: &Account) -> Result<Vec<Chain>, Kind> {
    let all = whole(shape, account)?;
    let Some((ends, _)) = shape.list(0, 4).filter(|(_, count)| *count > 0) else {
        return Ok(vec![all]);
    };
    let ends = ends
        .chunks_exact(4)
        .filter_map(|b| b.first_chunk().copied());
    let (mut chains, mut from) = (vec![], 0);
    for end in ends.map(|b| u32::from_le_bytes(b) as usize) {
        let points = all.points.get(from..end).ok_or_else(|| Kind::Malformed {
            what: "its parts do not follow each other".into(),
        })?;
        chains.push(Chain {
            points: points.to_vec(),
            heights: all.heights.get(from..end).unwrap_or_default().to_vec(),
        });
        from = end;
    }
    Ok(chains)
}

impl Iterator for FlatGeobuf {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        let at = self.input.at();
        match self.sized(self.feature_bytes) {
            Ok(Some(bytes)) => Some(self.feature(&bytes, at)),
            Ok(None) => self.end().map(Err),
            Err(kind) => {
                self.is_over = true;
                Some(Err(Fault::of_file(&self.file, kind).at(at)))
            }
        }
    }
}

impl Reader for FlatGeobuf {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
