//! GeoParquet (geoparquet.org, 1.0 and 1.1): a Parquet table with a column of well-known binary. The metadata `geo` of the
//! file names the column and its reference system, without one degrees of longitude and latitude.
//!
//! Columns are unpacked page by page.

use super::in_memory;
use crate::fault::{Fault, Kind};
use crate::feature::{Feature, Layer, Place, Value};
use crate::input::unreadable;
use crate::{Crs, Options, Reader, stem, wkb};
use hsd_base::source::World;
use parquet::data_type::AsBytes;
use parquet::file::reader::{ChunkReader, FileReader};
use parquet::file::serialized_reader::SerializedFileReader;
use parquet::record::Field;
use parquet::record::reader::RowIter;
use serde_json::Value as Json;
use std::fs::File;
use std::sync::Arc;

/// Days from the beginning of the era to 1970.
const DAYS_BEFORE_1970: i64 = 719_468;

/// A reader of GeoParquet.
pub(crate) struct GeoParquet {
    rows: RowIter<'static>,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    /// The name of the column of geometries.
    geometry: Box<str>,
    number: u64,
    points: usize,
    is_over: bool,
}

impl GeoParquet {
    /// Begins to read.
    ///
    /// # Errors
    /// If it is no GeoParquet, or its geometries are written in another way than as well-known binary.
    pub(crate) fn open(
        world: &dyn World,
        file: &Arc<str>,
        options: &Options,
    ) -> Result<GeoParquet, Fault> {
        let table = match world.on_disk(file) {
            Some(path) => {
                let opened = File::open(path).map_err(|e| unreadable(file, &e))?;
                table(opened)
            }
            None => table(bytes::Bytes::from(in_memory(world, file)?)),
        };
        let damaged = |what| Fault::of_file(file, Kind::Damaged { what });
        let table = table.ok_or_else(|| damaged("the metadata of Parquet"))?;
        let metadata = table.metadata().file_metadata();
        let geo = metadata.key_value_metadata().into_iter().flatten();
        let geo = geo.filter(|pair| pair.key == "geo").find_map(|pair| {
            let text = pair.value.as_deref()?;
            serde_json::from_str::<Json>(text).ok()
        });
        let geo = geo.ok_or_else(|| damaged("the metadata `geo` of GeoParquet"))?;
        let name = geo["primary_column"].as_str().unwrap_or("geometry");
        let column = &geo["columns"][name];
        let encoding = column["encoding"].as_str().unwrap_or("WKB");
        if !encoding.eq_ignore_ascii_case("wkb") {
            let name = format!("geometries as `{encoding}`; write them as WKB").into();
            return Err(Fault::of_file(file, Kind::OtherGeometry { name }));
        }
        let mut reader = GeoParquet {
            layer: Layer {
                name: stem(file).into(),
                crs: options.crs.clone(),
                count: u64::try_from(metadata.num_rows()).ok(),
                ..Layer::default()
            },
            geometry: name.into(),
            file: file.clone(),
            remarks: vec![],
            number: 0,
            points: options.limits.points,
            is_over: false,
            rows: RowIter::from_file_into(table),
        };
        if reader.layer.crs.is_none() {
            reader.read_crs(column.get("crs"));
        }
        Ok(reader)
    }

    /// Takes the reference system as PROJJSON writes it.
    fn read_crs(&mut self, crs: Option<&Json>) {
        let Some(crs) = crs else {
            self.layer.crs = Crs::from_epsg(4326);
            return;
        };
        let id = &crs["id"];
        let code = &id["code"];
        let number = code.as_u64().or_else(|| code.as_str()?.parse().ok());
        self.layer.crs = match id["authority"].as_str() {
            // Longitude first, which is how all coordinates are read.
            Some("OGC") if code == "CRS84" => Crs::from_epsg(4326),
            Some("EPSG") => number.and_then(|n| Crs::from_epsg(u32::try_from(n).ok()?)),
            _ => None,
        };
        if self.layer.crs.is_none() && !crs.is_null() {
            let name = crs["name"].as_str().unwrap_or("PROJJSON").into();
            let fault = Fault::of_file(&self.file, Kind::UnknownCrs { name });
            self.remarks.push(fault);
        }
    }

    fn feature(&mut self, columns: Vec<(String, Field)>) -> Result<Feature, Fault> {
        let number = self.number;
        self.number += 1;
        let mut shape = Err(Kind::NoGeometry);
        let (mut id, mut fields) = (None, vec![]);
        for (name, field) in columns {
            if *name == *self.geometry {
                if let Field::Bytes(bytes) = &field {
                    shape = wkb::geometry(bytes.as_bytes(), self.points);
                }
                continue;
            }
            let Some(value) = value(&field) else {
                continue;
            };
            if name == "id"
                && let Value::Text(_) | Value::Integer(_) = value
            {
                id = Some(text_of(&value));
            }
            if let Some(column) = self.layer.columns.number(&name) {
                self.layer.columns.note(column, &value);
                fields.push((column, value));
            }
        }
        fields.sort_by_key(|field| field.0);
        let geometry = shape
            .map_err(|kind| Fault::of_file(&self.file, kind).of_feature(number, id.clone()))?;
        Ok(Feature {
            number,
            id,
            geometry,
            fields,
            place: Place::Record(number + 1),
        })
    }
}

fn table(of: impl ChunkReader + 'static) -> Option<Box<dyn FileReader>> {
    let reader = SerializedFileReader::new(of).ok()?;
    Some(Box::new(reader))
}

/// Returns the value of a field; `None` for structures, such as the bounds that files carry for their readers, and bytes.
fn value(field: &Field) -> Option<Value> {
    let number = |x: f64| match x.is_finite() {
        true => Value::Number(x),
        false => Value::Null,
    };
    Some(match field {
        Field::Null => Value::Null,
        Field::Bool(b) => Value::Bool(*b),
        Field::Byte(n) => Value::Integer((*n).into()),
        Field::Short(n) => Value::Integer((*n).into()),
        Field::Int(n) => Value::Integer((*n).into()),
        Field::Long(n) => Value::Integer(*n),
        Field::UByte(n) => Value::Integer((*n).into()),
        Field::UShort(n) => Value::Integer((*n).into()),
        Field::UInt(n) => Value::Integer((*n).into()),
        Field::ULong(n) => i64::try_from(*n).map_or(Value::Number(*n as f64), Value::Integer),
        Field::Float(x) => number((*x).into()),
        Field::Double(x) => number(*x),
        Field::Str(text) => Value::Text(text.as_str().into()),
        Field::Date(days) => Value::Text(date((*days).into()).into()),
        Field::TimestampMillis(t) => Value::Text(date(t.div_euclid(86_400_000)).into()),
        Field::TimestampMicros(t) => Value::Text(date(t.div_euclid(86_400_000_000)).into()),
        _ => return None,
    })
}

fn text_of(value: &Value) -> Box<str> {
    match value {
        Value::Text(text) => text.clone(),
        Value::Integer(n) => n.to_string().into(),
        _ => "".into(),
    }
}

/// Returns a day, counted from 1970, as `YYYY-MM-DD`, by the usual arithmetic of 400-year periods that begin in March.
fn date(days: i64) -> String {
    let days = days + DAYS_BEFORE_1970;
    let (era, day) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year + 400 * era + i64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

impl Iterator for GeoParquet {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        let row = self.rows.next().filter(|_| !self.is_over)?;
        Some(match row {
            Ok(row) => self.feature(row.into_columns()),
            Err(_) => {
                self.is_over = true;
                let what = "the rows of the table";
                Err(Fault::of_file(&self.file, Kind::Damaged { what }))
            }
        })
    }
}

impl Reader for GeoParquet {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn days_are_dates() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (-1, "1969-12-31"),
            (11_016, "2000-02-29"),
            (19_782, "2024-02-29"),
            (-719_468, "0000-03-01"),
        ] {
            assert_eq!(date(days), expected);
        }
    }
}
