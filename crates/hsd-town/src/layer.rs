//! The layers of a town: features of its maps in the frame of the town, with the fields that rules ask for.

pub mod divide;
mod divided;
mod files;
mod ground;
mod join;
mod kept;
mod left;
mod outlined;
mod packed;
mod raw;
mod spread;
mod units;

pub use files::{MapFile, NoFiles, files, with_side_files};
pub use ground::{Ground, GroundLayer, NoGround};
pub use join::{Joined, NoJoin, Unjoined};
pub use kept::KeptMaps;
pub(crate) use left::LEVELS;
pub use left::{LeftLot, LeftWhy, Sieve};
pub use outlined::NoOutlines;
pub use raw::{NotPlaced, Raw, read};

pub(crate) use files::part;
pub(crate) use spread::Spread;
pub(crate) use units::measured;

use super::shape::{centroid, cleaned, contains, sides};
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, bounds};
use hsd_ir::ast::town::{FieldType, Known, Layer};
use hsd_ir::ast::{self, Value};
use hsd_map::{Crs, Fault, Faults, Geometry};
use hsd_syntax::parse::fields::{FieldTest, NoTruth};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Distance between an outline and one that is inside of it, metres.
const INSIDE: f64 = 0.05;

/// A feature in the frame of the town.
#[derive(Clone, Debug)]
pub struct Lot {
    /// Its number in its layer, after what the layer leaves out.
    pub number: u32,
    /// Its name in the layer.
    pub key: Box<str>,
    /// Its geometry.
    pub shape: Shape,
    /// Its fields, by column, ascending.
    fields: Vec<(usize, hsd_map::Value)>,
    /// The mean height of its points, metres.
    pub z: f64,
}

/// The geometry of a feature.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A ring, counter-clockwise, with holes.
    Area(Vec<DVec2>, Vec<Vec<DVec2>>),
    /// Lines.
    Lines(Vec<Vec<DVec2>>),
    /// A point.
    Point(DVec2),
}

impl Lot {
    /// Returns its fields as the file has them, by column.
    pub(super) fn fields(&self) -> &[(usize, hsd_map::Value)] {
        &self.fields
    }

    /// Gives its fields the columns of a layer of several files.
    pub(crate) fn renumber(&mut self, columns: &BTreeMap<usize, usize>) {
        for (column, _) in &mut self.fields {
            *column = columns.get(column).copied().unwrap_or(*column);
        }
        self.fields.sort_by_key(|(column, _)| *column);
    }
}

impl Shape {
    /// Returns the centroid.
    pub fn centre(&self) -> DVec2 {
        match self {
            Shape::Area(ring, _) => centroid(ring),
            Shape::Lines(lines) => {
                let mut weighted = (DVec2::ZERO, 0.0);
                for ends in lines.iter().flat_map(|line| line.windows(2)) {
                    let length = ends[0].distance(ends[1]);
                    weighted.0 += ends[0].midpoint(ends[1]) * length;
                    weighted.1 += length;
                }
                match weighted.1 > 0.0 {
                    true => weighted.0 / weighted.1,
                    false => lines.iter().flatten().next().copied().unwrap_or_default(),
                }
            }
            Shape::Point(point) => *point,
        }
    }

    /// Returns the ring of an area.
    pub fn ring(&self) -> Option<&[DVec2]> {
        match self {
            Shape::Area(ring, _) => Some(ring),
            Shape::Lines(_) | Shape::Point(_) => None,
        }
    }

    /// Returns true if a ring is inside of it without touching it, and in none of its holes.
    pub fn encloses(&self, ring: &[DVec2]) -> bool {
        let Shape::Area(own, holes) = self else {
            return false;
        };
        let is_apart = |other: &[DVec2]| {
            sides(other).all(|side| sides(ring).all(|s| s.distance(side) > INSIDE))
        };
        let is_in = |other: &[DVec2]| ring.first().is_some_and(|corner| contains(other, *corner));
        is_in(own) && is_apart(own) && holes.iter().all(|hole| !is_in(hole) && is_apart(hole))
    }

    /// Returns the box around it.
    pub fn bounds(&self) -> Bounds {
        let found = match self {
            Shape::Area(ring, _) => bounds(ring.iter().copied()),
            Shape::Lines(lines) => bounds(lines.iter().flatten().copied()),
            Shape::Point(point) => Some([*point; 2]),
        };
        found.unwrap_or_default()
    }
}

/// A layer that has been read.
#[derive(Clone, Debug)]
pub struct Lots {
    /// As written.
    pub layer: Layer,
    /// In the order of the file; none once the features of the town wait in a spool.
    pub lots: Vec<Lot>,
    /// The box of those that wait in a spool since they were read.
    pub bounds: Option<Bounds>,
    /// Columns of the file by name.
    columns: BTreeMap<Box<str>, usize>,
    /// What is wrong with the map, counted by kind.
    pub faults: Faults,
    /// The features that cannot be read.
    pub unread: Vec<Fault>,
    /// The features that can be read but are left out.
    pub left: Vec<LeftLot>,
    /// The path of the file.
    file: Arc<str>,
}

/// The frame of a town.
#[derive(Clone, Debug)]
pub struct TownFrame {
    /// The plane.
    pub crs: Crs,
    /// Metres east and north in it that are 0 0 of the model.
    pub origin: DVec2,
    /// The middle of the features of the first layer, metres from the origin. What lies far from it is left out.
    pub middle: DVec2,
}

/// Returns the key of a feature in a layer of several files.
fn led(lead: Option<&str>, key: &str) -> Box<str> {
    match lead {
        Some(lead) => format!("{lead}:{key}").into(),
        None => key.into(),
    }
}

/// Divides the geometry of a feature into single areas or points; lines stay together.
fn parted(geometry: Geometry) -> Vec<Geometry> {
    let parts: Vec<Geometry> = match geometry {
        Geometry::Areas(areas) if areas.len() > 1 => {
            let areas = areas.into_iter().map(|area| vec![area]);
            areas.map(Geometry::Areas).collect()
        }
        Geometry::Points(chain) if chain.points.len() > 1 => {
            let heights = chain.heights.into_iter().map(|z| vec![z]);
            let heights = heights.chain(std::iter::repeat(vec![]));
            let points = chain
                .points
                .into_iter()
                .map(|point| vec![point])
                .zip(heights);
            let points = points.map(|(points, heights)| hsd_map::Chain { points, heights });
            points.map(Geometry::Points).collect()
        }
        whole => vec![whole],
    };
    parts
}

fn height(geometry: &Geometry) -> f64 {
    let heights = geometry.chains().flat_map(|chain| &chain.heights);
    let (sum, count) = heights.fold((0.0, 0usize), |(sum, n), z| (sum + z, n + 1));
    if count > 0 { sum / count as f64 } else { 0.0 }
}

/// Returns the geometry of one of the `parted` geometries of a feature.
fn shape(geometry: Geometry) -> Shape {
    match geometry {
        Geometry::Points(chain) => Shape::Point(chain.points.first().copied().unwrap_or_default()),
        Geometry::Lines(lines) => Shape::Lines(lines.into_iter().map(|l| l.points).collect()),
        Geometry::Areas(areas) => {
            let area = areas.into_iter().next().unwrap_or_default();
            let ring = cleaned(&area.outline.points);
            let holes = area.holes.iter().map(|h| cleaned(&h.points));
            Shape::Area(ring, holes.filter(|h| h.len() > 2).collect())
        }
    }
}

/// Returns a value as rules and tables see it; `None` for none.
pub(super) fn as_text(value: &hsd_map::Value) -> Option<String> {
    match value {
        hsd_map::Value::Null => None,
        hsd_map::Value::Bool(truth) => Some(if *truth { "yes" } else { "no" }.to_owned()),
        hsd_map::Value::Integer(n) => Some(n.to_string()),
        hsd_map::Value::Number(n) => Some(n.to_string()),
        hsd_map::Value::Text(text) => Some(text.to_string()),
    }
}

impl Lots {
    /// Adds the features of another file of the layer.
    pub fn append(&mut self, mut other: Lots) {
        let lots = std::mem::take(&mut other.lots);
        let columns = self.adopt(&other);
        self.lots.extend(lots.into_iter().map(|mut lot| {
            lot.renumber(&columns);
            lot
        }));
        self.merge_faults(other);
    }

    /// Adds the columns of another file of the layer; returns the numbers that they have here.
    pub(crate) fn adopt(&mut self, other: &Lots) -> BTreeMap<usize, usize> {
        let mut next = self.columns.values().max().map_or(0, |last| last + 1);
        let mut columns = BTreeMap::new();
        for (name, column) in &other.columns {
            let own = *self.columns.entry(name.clone()).or_insert_with(|| {
                next += 1;
                next - 1
            });
            columns.insert(*column, own);
        }
        // What concerns them all is said of the layer's files as they are written.
        self.file = self.layer.src.value.as_str().into();
        columns
    }

    /// Adds what is wrong with another file of the layer.
    pub(crate) fn merge_faults(&mut self, other: Lots) {
        self.faults.append(other.faults);
        self.unread.extend(other.unread);
        self.left.extend(other.left);
    }

    /// Returns the layer without features and faults.
    pub(crate) fn head(&self) -> Lots {
        Lots {
            layer: self.layer.clone(),
            lots: vec![],
            bounds: None,
            columns: self.columns.clone(),
            faults: Faults::default(),
            unread: vec![],
            left: vec![],
            file: self.file.clone(),
        }
    }

    /// Returns whether a feature passes a test.
    ///
    /// # Errors
    /// If the test has no truth.
    pub(crate) fn passes(&self, lot: &Lot, test: &FieldTest) -> Result<bool, NoTruth> {
        test.holds(|name| self.field(lot, name))
    }

    /// Leaves out the features that do not pass a test; returns how many there were.
    ///
    /// # Errors
    /// If the test has no truth.
    pub fn keep(&mut self, test: &FieldTest) -> Result<usize, NoTruth> {
        let before = self.lots.len();
        let lots = std::mem::take(&mut self.lots);
        let mut kept = vec![];
        for lot in lots {
            if self.passes(&lot, test)? {
                kept.push(lot);
            }
        }
        self.lots = kept;
        Ok(before)
    }

    /// Returns the value of a field of a feature, after what the layer says of it.
    pub fn field(&self, lot: &Lot, name: &str) -> Known {
        let rule = self.layer.fields.iter().find(|f| f.name.value == name);
        let Some(rule) = rule else {
            return match self.text(lot, name) {
                Some(text) => Known::Value(Value::read(&text)),
                None if self.columns.contains_key(name) => Known::Missing,
                None => Known::Unknown,
            };
        };
        let text = self.source_text(lot, rule);
        let value = text.and_then(|text| typed(&text, rule.kind));
        match value.or_else(|| rule.default.clone()) {
            Some(value) => Known::Value(value),
            None => Known::Missing,
        }
    }

    /// Checks the numbers of all features.
    pub(crate) fn check_all_numbers(&mut self) {
        let lots = std::mem::take(&mut self.lots);
        lots.iter().for_each(|lot| self.check_numbers(lot));
        self.lots = lots;
    }

    /// Adds a fault for each field of numbers in which a feature has a text that is not a number.
    pub(crate) fn check_numbers(&mut self, lot: &Lot) {
        for rule in &self.layer.fields {
            if rule.kind != Some(FieldType::Number) {
                continue;
            }
            let Some(text) = self.source_text(lot, rule) else {
                continue;
            };
            if typed(&text, rule.kind).is_none() {
                let kind = hsd_map::Kind::NotANumber { text: text.into() };
                let fault = Fault::of_file(&self.file, kind).in_field(&*rule.from.value);
                let number = u64::from(lot.number);
                self.faults
                    .push(fault.of_feature(number, Some(lot.key.clone())));
            }
        }
    }

    /// Returns the text from which a `Field` makes the value of a feature.
    fn source_text(&self, lot: &Lot, rule: &ast::town::Field) -> Option<String> {
        let text = self.text(lot, &rule.from.value)?;
        let other = rule.map.iter().find(|(from, _)| *from == text.trim());
        Some(other.map_or(text, |(_, to)| to.clone()))
    }

    /// Returns the text of a column at a feature, unless it is blank.
    fn text(&self, lot: &Lot, column: &str) -> Option<String> {
        let column = self.columns.get(column)?;
        let at = lot.fields.binary_search_by_key(column, |f| f.0).ok()?;
        as_text(&lot.fields[at].1).filter(|text| !text.trim().is_empty())
    }

    /// Returns the columns of the file by name.
    pub(super) fn columns(&self) -> impl Iterator<Item = (&str, usize)> {
        self.columns.iter().map(|(name, column)| (&**name, *column))
    }

    /// Returns the names of all fields.
    pub fn names(&self) -> Vec<String> {
        let own = self.layer.fields.iter().map(|f| f.name.value.clone());
        let words = self.columns.keys().map(|name| name.to_string());
        own.chain(words.filter(|name| is_name(name))).collect()
    }

    /// Returns the number that a field gives.
    pub fn number(&self, lot: &Lot, name: &str) -> Option<f64> {
        match self.field(lot, name) {
            Known::Value(ast::Value::Number(number)) => Some(number),
            _ => None,
        }
    }

    /// Returns the text that a field gives.
    pub fn word(&self, lot: &Lot, name: &str) -> Option<String> {
        match self.field(lot, name) {
            Known::Value(value) => Some(value.to_string()),
            Known::Missing | Known::Unknown => None,
        }
    }
}

/// Returns true if expressions can name a field.
pub(super) fn is_name(name: &str) -> bool {
    let first = name
        .chars()
        .next()
        .is_some_and(|c| c.is_alphabetic() || c == '_');
    first && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// Returns a text as a value of a type; `None` if it is none.
fn typed(text: &str, kind: Option<FieldType>) -> Option<Value> {
    let read = Value::read(text);
    match (kind, &read) {
        (Some(FieldType::Text), _) => Some(Value::Text(text.to_owned())),
        (Some(FieldType::Number), Value::Number(_)) | (Some(FieldType::Truth), Value::Truth(_)) => {
            Some(read)
        }
        // "12.5 m" and "3階" are numbers for whoever reads them.
        (Some(FieldType::Number), _) => measured(text).map(Value::Number),
        (Some(FieldType::Truth), _) => None,
        (None, _) => Some(read),
    }
}
