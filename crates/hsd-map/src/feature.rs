//! Features of maps: geometry and fields, whatever format they were read from.
//!
//! Coordinates are in the file's own reference system with x = east and y = north, whichever order the file has them in:
//! degrees (longitude, latitude) or metres. Rings do not repeat their first point; outlines run counter-clockwise, holes
//! clockwise.

use super::crs::Crs;
use super::fault::Kind;
use glam::DVec2;
use std::collections::HashMap;

/// A feature of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its number in the layer, from 0. Features that cannot be read are counted too.
    pub number: u64,
    /// Its id, if the file has one beside the fields.
    pub id: Option<Box<str>>,
    /// Points, lines or areas.
    pub geometry: Geometry,
    /// The fields that the file gives, by column, ascending.
    pub fields: Vec<(usize, Value)>,
    /// Its place in the file.
    pub place: Place,
}

impl Feature {
    /// Returns the value of a column; `None` if the feature lacks the field.
    pub fn field(&self, column: usize) -> Option<&Value> {
        let at = self.fields.binary_search_by_key(&column, |f| f.0).ok()?;
        Some(&self.fields[at].1)
    }

    /// Returns its id, or its number if it has none.
    pub fn key(&self) -> Box<str> {
        let number = || self.number.to_string().into();
        self.id.clone().unwrap_or_else(number)
    }
}

/// The place of a feature in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The first byte, in a file of text or of variable records.
    Byte(u64),
    /// The number of the record or row, from 1.
    Record(u64),
}

/// The geometry of a feature. None is empty.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// One point, or several.
    Points(Chain),
    /// Lines of at least two points.
    Lines(Vec<Chain>),
    /// Areas of at least three corners.
    Areas(Vec<Area>),
}

impl Geometry {
    /// Joins geometries of one kind, as a collection of them.
    pub(super) fn joined(parts: Vec<Geometry>) -> Result<Geometry, Kind> {
        let mut parts = parts.into_iter();
        let mut joined = parts.next().ok_or(Kind::NoGeometry)?;
        for part in parts {
            match (&mut joined, part) {
                (Geometry::Points(own), Geometry::Points(mut more)) => {
                    own.points.append(&mut more.points);
                    own.heights.append(&mut more.heights);
                }
                (Geometry::Lines(own), Geometry::Lines(mut more)) => own.append(&mut more),
                (Geometry::Areas(own), Geometry::Areas(mut more)) => own.append(&mut more),
                _ => {
                    let name = "collection of different kinds".into();
                    return Err(Kind::OtherGeometry { name });
                }
            }
        }
        Ok(joined)
    }

    /// Returns all points.
    pub fn points(&self) -> impl Iterator<Item = DVec2> + '_ {
        self.chains().flat_map(|chain| chain.points.iter().copied())
    }

    /// Returns the larger side of the box around it; `None` for points, which have none.
    pub fn width(&self) -> Option<f64> {
        let is_point = matches!(self, Geometry::Points(_));
        let (low, high) = self
            .points()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| {
                (low.min(p), high.max(p))
            });
        (!is_point).then(|| (high - low).max_element())
    }

    /// Returns all sequences of points.
    pub fn chains(&self) -> Box<dyn Iterator<Item = &Chain> + '_> {
        match self {
            Geometry::Points(points) => Box::new(std::iter::once(points)),
            Geometry::Lines(lines) => Box::new(lines.iter()),
            Geometry::Areas(areas) => Box::new(areas.iter().flat_map(Area::rings)),
        }
    }

    /// Returns all sequences of points, to be changed.
    pub fn chains_mut(&mut self) -> Box<dyn Iterator<Item = &mut Chain> + '_> {
        match self {
            Geometry::Points(points) => Box::new(std::iter::once(points)),
            Geometry::Lines(lines) => Box::new(lines.iter_mut()),
            Geometry::Areas(areas) => Box::new(
                areas
                    .iter_mut()
                    .flat_map(|a| std::iter::once(&mut a.outline).chain(&mut a.holes)),
            ),
        }
    }
}

/// A sequence of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// East and north.
    pub points: Vec<DVec2>,
    /// The height of each point in metres; empty if the file has none.
    pub heights: Vec<f64>,
}

impl Chain {
    /// Creates a chain without heights.
    pub fn flat(points: Vec<DVec2>) -> Chain {
        Chain {
            points,
            heights: vec![],
        }
    }

    /// Returns twice the area that a ring encloses, positive if it runs counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        let Some(&from) = self.points.first() else {
            return 0.0;
        };
        let ends = self.points.iter().skip(1);
        let sides = self.points.iter().zip(ends);
        sides.map(|(p, q)| (p - from).perp_dot(q - from)).sum()
    }

    /// Reverses the order of the points.
    pub fn reverse(&mut self) {
        self.points.reverse();
        self.heights.reverse();
    }
}

/// An area with its holes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Area {
    /// The ring around it, counter-clockwise.
    pub outline: Chain,
    /// The rings of its holes, clockwise.
    pub holes: Vec<Chain>,
}

impl Area {
    /// Returns the outline, then the holes.
    pub fn rings(&self) -> impl Iterator<Item = &Chain> {
        std::iter::once(&self.outline).chain(&self.holes)
    }
}

/// The value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// No value.
    Null,
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// A number; finite.
    Number(f64),
    /// A text; dates as `YYYY-MM-DD`, lists and objects of JSON as JSON.
    Text(Box<str>),
}

impl Value {
    /// Returns the number that it is, or that its text says.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Integer(n) => Some(*n as f64),
            Value::Number(n) => Some(*n),
            Value::Text(text) => text.trim().parse().ok().filter(|n: &f64| n.is_finite()),
            Value::Null | Value::Bool(_) => None,
        }
    }
}

/// The type of a column, as far as the file says or its values show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColumnType {
    /// No value was seen.
    #[default]
    Unknown,
    /// Yes or no.
    Bool,
    /// Numbers, all whole.
    Integer,
    /// Numbers.
    Number,
    /// Texts, or values of different types.
    Text,
}

impl ColumnType {
    /// Returns the type of a value.
    pub fn of(value: &Value) -> ColumnType {
        match value {
            Value::Null => ColumnType::Unknown,
            Value::Bool(_) => ColumnType::Bool,
            Value::Integer(_) => ColumnType::Integer,
            Value::Number(_) => ColumnType::Number,
            Value::Text(_) => ColumnType::Text,
        }
    }

    /// Returns the type that holds the values of both.
    #[must_use]
    pub fn with(self, other: ColumnType) -> ColumnType {
        use ColumnType::{Integer, Number, Text, Unknown};
        match (self, other) {
            (Unknown, t) | (t, Unknown) => t,
            (one, two) if one == two => one,
            (Integer, Number) | (Number, Integer) => Number,
            _ => Text,
        }
    }
}

/// A column of a layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name in the file.
    pub name: Box<str>,
    /// The type of its values so far.
    pub of: ColumnType,
}

/// The columns of a layer. Formats whose features name their fields add columns while they are read; a column keeps its
/// number.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    list: Vec<Column>,
    by_name: HashMap<Box<str>, usize>,
}

impl Columns {
    /// The most columns of a layer; raw OpenStreetMap data of a country has some thousand tags.
    pub const MOST: usize = 65_536;

    /// Returns the columns in the order of the file.
    pub fn list(&self) -> &[Column] {
        &self.list
    }

    /// Returns the number of a column by its name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// Returns the number of the column of this name, which is added if it is new; `None` if there would be more than
    /// [`Columns::MOST`].
    pub fn number(&mut self, name: &str) -> Option<usize> {
        if let Some(known) = self.find(name) {
            return Some(known);
        }
        let number = self.list.len();
        if number == Columns::MOST {
            return None;
        }
        self.list.push(Column {
            name: name.into(),
            of: ColumnType::Unknown,
        });
        self.by_name.insert(name.into(), number);
        Some(number)
    }

    /// Widens the type of a column by that of a value.
    pub fn note(&mut self, column: usize, value: &Value) {
        if let Some(column) = self.list.get_mut(column) {
            column.of = column.of.with(ColumnType::of(value));
        }
    }
}

/// What is known of a layer.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    /// The name in the file, else that of the file.
    pub name: Box<str>,
    /// The columns that are known so far.
    pub columns: Columns,
    /// The reference system of the coordinates; `None` if the file says nothing.
    pub crs: Option<Crs>,
    /// True if that is what the format has where a file says nothing, as many files in metres do.
    pub crs_is_usual: bool,
    /// The number of features, if the file says it; a damaged file may say a wrong one.
    pub count: Option<u64>,
}
