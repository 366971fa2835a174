//! A feature of GeoJSON from its text: fields in their order, coordinates of any depth.

use crate::fault::Kind;
use crate::feature::{Area, Chain, Columns, Geometry, Value};
use glam::dvec2;
use serde::de::{
    DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use serde::{Deserialize, de};
use std::fmt;

/// A feature as it is written.
pub(super) struct Decoded {
    pub(super) id: Option<Box<str>>,
    pub(super) fields: Vec<(usize, Value)>,
    /// The geometry, or why it is none.
    pub(super) geometry: Result<Geometry, Kind>,
}

/// A fault of a field that does not cost the feature.
pub(super) struct Flaw {
    pub(super) field: Box<str>,
    pub(super) kind: Kind,
}

/// Reads a feature or a bare geometry.
///
/// # Errors
/// If it is no JSON, or no feature.
pub(super) fn feature(
    raw: &[u8],
    columns: &mut Columns,
    flaws: &mut Vec<Flaw>,
) -> Result<Decoded, Box<str>> {
    let read = |raw: &[u8], columns: &mut Columns, flaws: &mut Vec<Flaw>| {
        let mut from = serde_json::Deserializer::from_slice(raw);
        let member = ObjectSeed { columns, flaws }.deserialize(&mut from)?;
        from.end().map(|()| member)
    };
    let object: Object = match read(raw, columns, flaws) {
        Ok(object) => object,
        // Programs in Python write NaN, which is no JSON.
        Err(error) => match without_nan(raw) {
            Some(mended) => read(&mended, columns, flaws).map_err(words)?,
            None => return Err(words(error)),
        },
    };
    object.into_decoded()
}

/// Returns what a JSON reader says, without the line, which is one of the feature only.
fn words(error: serde_json::Error) -> Box<str> {
    let text = error.to_string();
    let end = text.find(" at line ").unwrap_or(text.len());
    text[..end].into()
}

/// Returns the text with `null` in place of `NaN` and `Infinity` outside of strings; `None` if there is none.
fn without_nan(raw: &[u8]) -> Option<Vec<u8>> {
    let (mut out, mut at, mut in_string, mut changed) =
        (Vec::with_capacity(raw.len()), 0, false, false);
    while at < raw.len() {
        let rest = &raw[at..];
        let word = [&b"-Infinity"[..], b"Infinity", b"NaN", b"nan"];
        let word = word.iter().find(|w| !in_string && rest.starts_with(w));
        if let Some(word) = word {
            out.extend_from_slice(b"null");
            at += word.len();
            changed = true;
            continue;
        }
        if in_string && rest[0] == b'\\' && rest.len() > 1 {
            out.extend_from_slice(&rest[..2]);
            at += 2;
            continue;
        }
        in_string ^= rest[0] == b'"';
        out.push(rest[0]);
        at += 1;
    }
    changed.then_some(out)
}

/// Returns the name in a `crs` member, `{"type": "name", "properties": {"name": "urn:..."}}`.
pub(super) fn crs_name(value: &[u8]) -> Option<String> {
    let value: serde_json::Value = serde_json::from_slice(value).ok()?;
    if value.is_null() {
        return None;
    }
    let name = &value["properties"]["name"];
    let code = || {
        value["properties"]["code"]
            .as_u64()
            .map(|c| format!("EPSG:{c}"))
    };
    name.as_str()
        .map(str::to_owned)
        .or_else(code)
        .or_else(|| Some(value.to_string()))
}

/// The members of a feature, a geometry or a collection.
#[derive(Default)]
struct Object {
    of: Option<String>,
    id: Option<Box<str>>,
    geometry: Option<Shape>,
    fields: Vec<(usize, Value)>,
    own: Shape,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(field_identifier, rename_all = "lowercase")]
enum Member {
    Type,
    Id,
    Geometry,
    Properties,
    Coordinates,
    Geometries,
    #[serde(other)]
    Other,
}

impl Member {
    /// Returns its name, if what it says counts.
    fn name(self) -> Option<&'static str> {
        Some(match self {
            Member::Type => "type",
            Member::Id => "id",
            Member::Geometry => "geometry",
            Member::Properties => "properties",
            Member::Coordinates => "coordinates",
            Member::Geometries => "geometries",
            Member::Other => return None,
        })
    }
}

impl Object {
    fn into_decoded(self) -> Result<Decoded, Box<str>> {
        let Object {
            of,
            id,
            geometry,
            fields,
            mut own,
        } = self;
        match of.as_deref() {
            Some("Feature") => {
                let geometry = geometry.ok_or(Kind::NoGeometry).and_then(Shape::geometry);
                Ok(Decoded {
                    id,
                    fields,
                    geometry,
                })
            }
            Some("FeatureCollection") => Err("the collection has no list of features".into()),
            Some(of) => {
                own.of = of.into();
                let geometry = own.geometry();
                Ok(Decoded {
                    id: None,
                    fields,
                    geometry,
                })
            }
            None => Err("it has no `type`".into()),
        }
    }
}

struct ObjectSeed<'a> {
    columns: &'a mut Columns,
    flaws: &'a mut Vec<Flaw>,
}

impl<'de> DeserializeSeed<'de> for ObjectSeed<'_> {
    type Value = Object;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Object, D::Error> {
        from.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for ObjectSeed<'_> {
    type Value = Object;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a feature")
    }

    fn visit_map<M: MapAccess<'de>>(mut self, mut map: M) -> Result<Object, M::Error> {
        let mut found = Object::default();
        let mut seen = vec![];
        while let Some(member) = map.next_key::<Member>()? {
            if seen.contains(&member) {
                self.flaws.extend(member.name().map(|name| Flaw {
                    field: name.into(),
                    kind: Kind::DuplicateField,
                }));
            }
            seen.push(member);
            match member {
                Member::Type => found.of = map.next_value()?,
                Member::Id => found.id = id(map.next_value()?),
                Member::Geometry => found.geometry = map.next_value()?,
                Member::Properties => found.fields = map.next_value_seed(FieldsSeed(&mut self))?,
                Member::Coordinates => found.own.coordinates = map.next_value()?,
                Member::Geometries => found.own.geometries = map.next_value()?,
                Member::Other => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(found)
    }
}

fn id(value: serde_json::Value) -> Option<Box<str>> {
    match value {
        serde_json::Value::Null => None,
        serde_json::Value::String(text) => Some(text.into()),
        other => Some(other.to_string().into()),
    }
}

/// The fields, into columns.
struct FieldsSeed<'a, 'b>(&'a mut ObjectSeed<'b>);

impl<'de> DeserializeSeed<'de> for FieldsSeed<'_, '_> {
    type Value = Vec<(usize, Value)>;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Self::Value, D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for FieldsSeed<'_, '_> {
    type Value = Vec<(usize, Value)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of properties")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Self::Value, E> {
        Ok(vec![])
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
        let ObjectSeed { columns, flaws } = self.0;
        let mut fields: Vec<(usize, Value)> = vec![];
        while let Some(column) = map.next_key_seed(ColumnSeed(columns))? {
            let Scalar(value) = map.next_value()?;
            columns.note(column, &value);
            fields.push((column, value));
        }
        fields.sort_by_key(|field| field.0);
        let name = |column: usize| columns.list()[column].name.clone();
        for pair in fields.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let field = name(pair[0].0);
            let kind = Kind::DuplicateField;
            flaws.push(Flaw { field, kind });
        }
        // The last of equal ones counts, as in JavaScript.
        fields.reverse();
        fields.dedup_by_key(|field| field.0);
        fields.reverse();
        let garbled = |value: &Value| matches!(value, Value::Text(t) if t.contains('\u{fffd}'));
        for (column, _) in fields.iter().filter(|(_, value)| garbled(value)) {
            let field = name(*column);
            flaws.push(Flaw {
                field,
                kind: Kind::Encoding,
            });
        }
        Ok(fields)
    }
}

/// The column of a key.
struct ColumnSeed<'a>(&'a mut Columns);

impl<'de> DeserializeSeed<'de> for ColumnSeed<'_> {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<usize, D::Error> {
        from.deserialize_str(self)
    }
}

impl Visitor<'_> for ColumnSeed<'_> {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a property")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<usize, E> {
        let number = self.0.number(name);
        number.ok_or_else(|| E::custom("the layer has too many different properties"))
    }
}

/// A value of a field; lists and objects become JSON again.
struct Scalar(Value);

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Scalar, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Value;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a value")
            }

            fn visit_unit<E>(self) -> Result<Value, E> {
                Ok(Value::Null)
            }

            fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
                Ok(Value::Bool(value))
            }

            fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
                Ok(Value::Integer(value))
            }

            fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
                Ok(i64::try_from(value).map_or(Value::Number(value as f64), Value::Integer))
            }

            fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
                Ok(Value::Number(value))
            }

            fn visit_str<E>(self, value: &str) -> Result<Value, E> {
                Ok(Value::Text(value.into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Value, A::Error> {
                let value =
                    serde_json::Value::deserialize(de::value::SeqAccessDeserializer::new(seq))?;
                Ok(Value::Text(value.to_string().into()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Value, A::Error> {
                let value =
                    serde_json::Value::deserialize(de::value::MapAccessDeserializer::new(map))?;
                Ok(Value::Text(value.to_string().into()))
            }
        }
        from.deserialize_any(Any).map(Scalar)
    }
}

/// A geometry as it is written.
#[derive(Default, Deserialize)]
struct Shape {
    #[serde(rename = "type", default)]
    of: String,
    coordinates: Option<Nested>,
    geometries: Option<Vec<Shape>>,
}

/// Coordinates of any depth.
enum Nested {
    Position { x: f64, y: f64, z: Option<f64> },
    List(Vec<Nested>),
    Number(f64),
}

impl<'de> Deserialize<'de> for Nested {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Nested, D::Error> {
        from.deserialize_any(NestedVisitor)
    }
}

struct NestedVisitor;

impl<'de> Visitor<'de> for NestedVisitor {
    type Value = Nested;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("coordinates")
    }

    /// A missing number, as programs write NaN.
    fn visit_unit<E>(self) -> Result<Nested, E> {
        Ok(Nested::Number(f64::NAN))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Nested, E> {
        Ok(Nested::Number(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Nested, E> {
        Ok(Nested::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Nested, E> {
        Ok(Nested::Number(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Nested, A::Error> {
        let x = match seq.next_element()? {
            None => return Ok(Nested::List(vec![])),
            Some(Nested::Number(x)) => x,
            Some(first) => {
                let mut list = vec![first];
                while let Some(next) = seq.next_element()? {
                    list.push(next);
                }
                return Ok(Nested::List(list));
            }
        };
        let y: Option<f64> = seq
            .next_element::<Option<f64>>()?
            .map(|y| y.unwrap_or(f64::NAN));
        let y = y.ok_or_else(|| A::Error::custom("a position has fewer than two numbers"))?;
        let z = seq.next_element::<Option<f64>>()?.flatten();
        while seq.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Nested::Position { x, y, z })
    }
}

/// The reason for a geometry whose coordinates are nested wrongly.
fn wrong_depth() -> Kind {
    Kind::Malformed {
        what: "the coordinates are not nested as its type demands".into(),
    }
}

impl Shape {
    fn geometry(self) -> Result<Geometry, Kind> {
        if self.of == "GeometryCollection" {
            let parts = self.geometries.unwrap_or_default().into_iter();
            let parts: Result<Vec<_>, _> = parts.map(Shape::geometry).collect();
            return Geometry::joined(parts?);
        }
        let coordinates = self.coordinates.ok_or(Kind::NoGeometry)?;
        match self.of.as_str() {
            "Point" => Ok(Geometry::Points(chain(vec![coordinates])?)),
            "MultiPoint" => Ok(Geometry::Points(chain(list(coordinates)?)?)),
            "LineString" => Ok(Geometry::Lines(vec![chain(list(coordinates)?)?])),
            "MultiLineString" => Ok(Geometry::Lines(chains(coordinates)?)),
            "Polygon" => Ok(Geometry::Areas(vec![area(coordinates)?])),
            "MultiPolygon" => {
                let areas: Result<_, _> = list(coordinates)?.into_iter().map(area).collect();
                Ok(Geometry::Areas(areas?))
            }
            other => Err(Kind::OtherGeometry { name: other.into() }),
        }
    }
}

fn list(nested: Nested) -> Result<Vec<Nested>, Kind> {
    match nested {
        Nested::List(list) => Ok(list),
        Nested::Position { .. } | Nested::Number(_) => Err(wrong_depth()),
    }
}

fn chain(positions: Vec<Nested>) -> Result<Chain, Kind> {
    let mut chain = Chain::default();
    for position in positions {
        match position {
            Nested::Position { x, y, z } => {
                chain.points.push(dvec2(x, y));
                chain.heights.extend(z);
            }
            // The position of an empty point.
            Nested::List(list) if list.is_empty() => {}
            Nested::List(_) | Nested::Number(_) => return Err(wrong_depth()),
        }
    }
    if chain.heights.len() != chain.points.len() {
        chain.heights.clear();
    }
    Ok(chain)
}

fn chains(nested: Nested) -> Result<Vec<Chain>, Kind> {
    let lines = list(nested)?.into_iter();
    lines.map(|line| chain(list(line)?)).collect()
}

fn area(nested: Nested) -> Result<Area, Kind> {
    let mut rings = chains(nested)?.into_iter();
    Ok(Area {
        outline: rings.next().unwrap_or_default(),
        holes: rings.collect(),
    })
}
