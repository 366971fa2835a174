//! GeoPackage (geopackage.org, OGC 12-128): layers as tables of a SQLite database, geometries as well-known binary behind
//! a small header.
//!
//! SQLite is a library of its own that opens files itself, so this reader needs a file of the disk, or takes the whole of
//! it into memory. Rows are read some hundred at a time. Only tables are read: a view could make the reader wait for ever.

use super::in_memory;
use crate::fault::{Fault, Kind};
use crate::feature::{Feature, Geometry, Layer, Place, Value};
use crate::{Crs, Limits, Options, Reader, wkb};
use hsd_base::source::World;
use percent_encoding::{AsciiSet, CONTROLS, utf8_percent_encode};
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, MAIN_DB, OpenFlags, OptionalExtension, params};
use std::collections::VecDeque;
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// Rows that are read at a time.
const ROWS: usize = 256;

/// Bytes of the header of a geometry without its envelope.
const HEADER: usize = 8;

/// Characters that are percent-encoded in the path of a URI.
const RESERVED: &AsciiSet = &CONTROLS.add(b'?').add(b'#').add(b'%').add(b'\\');

/// A reader of GeoPackage.
pub(crate) struct GeoPackage {
    base: Connection,
    file: Arc<str>,
    layer: Layer,
    remarks: Vec<Fault>,
    /// The query for the rows behind a key.
    query: Box<str>,
    /// The columns of the layer in the order of the query, behind key and geometry; true if it holds yes and no.
    columns: Vec<(usize, bool)>,
    rows: VecDeque<Result<Feature, Fault>>,
    /// The key of the last row.
    last: i64,
    number: u64,
    limits: Limits,
    is_over: bool,
}

impl GeoPackage {
    /// Begins to read.
    ///
    /// # Errors
    /// If it is no GeoPackage, or has no such layer.
    pub(crate) fn open(
        world: &dyn World,
        file: &Arc<str>,
        options: &Options,
    ) -> Result<GeoPackage, Fault> {
        let damaged = |_| {
            Fault::of_file(
                file,
                Kind::Damaged {
                    what: "a GeoPackage",
                },
            )
        };
        let base = match world.on_disk(file) {
            Some(path) => on_disk(&path).map_err(damaged)?,
            None => of_bytes(&in_memory(world, file)?).map_err(damaged)?,
        };
        harden(&base, options.limits.feature_bytes).map_err(damaged)?;
        let found = layer_of(&base, options.layer.as_deref()).map_err(damaged)?;
        let found = match (found, &options.layer) {
            (Some(found), _) if found.is_table => found,
            (Some(found), _) => {
                let why = format!("its layer `{}` is a view; save it as a table", found.name);
                let why = why.into();
                return Err(Fault::of_file(file, Kind::Unreadable { why }));
            }
            (None, Some(layer)) => {
                let layer = layer.clone();
                return Err(Fault::of_file(file, Kind::NoLayer { layer }));
            }
            (None, None) => {
                let why = "it has no layer of features".into();
                return Err(Fault::of_file(file, Kind::Unreadable { why }));
            }
        };
        let mut reader = GeoPackage {
            base,
            file: file.clone(),
            layer: Layer {
                name: found.name.as_str().into(),
                crs: options.crs.clone(),
                ..Layer::default()
            },
            remarks: vec![],
            query: "".into(),
            columns: vec![],
            rows: VecDeque::new(),
            last: i64::MIN,
            number: 0,
            limits: options.limits,
            is_over: false,
        };
        reader
            .prepare(&found.name, &found.geometry)
            .map_err(damaged)?;
        if reader.layer.crs.is_none() {
            reader.read_crs(found.system).map_err(damaged)?;
        }
        Ok(reader)
    }

    /// Finds the columns and writes the query.
    fn prepare(&mut self, table: &str, geometry: &str) -> rusqlite::Result<()> {
        let mut key = "rowid".to_owned();
        let mut chosen = vec![];
        {
            let mut statement = self
                .base
                .prepare("SELECT name, type, pk FROM pragma_table_info(?1)")?;
            let mut rows = statement.query([table])?;
            while let Some(row) = rows.next()? {
                let (name, of): (String, String) = (row.get(0)?, row.get(1)?);
                let is_key: bool = row.get::<_, i64>(2)? > 0;
                if is_key && of.eq_ignore_ascii_case("integer") {
                    key = name;
                } else if !name.eq_ignore_ascii_case(geometry) {
                    chosen.push((name, of.eq_ignore_ascii_case("boolean")));
                }
            }
        }
        let mut query = format!("SELECT {}, {}", quoted(&key), quoted(geometry));
        for (name, is_bool) in chosen {
            if let Some(number) = self.layer.columns.number(&name) {
                self.columns.push((number, is_bool));
                query += ", ";
                query += &quoted(&name);
            }
        }
        let (key, table) = (quoted(&key), quoted(table));
        query += &format!(" FROM {table} WHERE {key} > ?1 ORDER BY {key} LIMIT {ROWS}");
        self.query = query.into();
        let count = format!("SELECT count(*) FROM {table}");
        let count: i64 = self.base.query_row(&count, [], |row| row.get(0))?;
        self.layer.count = u64::try_from(count).ok();
        Ok(())
    }

    /// Finds the reference system of this number in the file.
    fn read_crs(&mut self, system: i64) -> rusqlite::Result<()> {
        let query = "SELECT organization, organization_coordsys_id, definition \
                     FROM gpkg_spatial_ref_sys WHERE srs_id = ?1";
        let row = |row: &rusqlite::Row<'_>| {
            Ok((
                row.get::<_, String>(0)?,
                row.get::<_, i64>(1)?,
                row.get::<_, String>(2)?,
            ))
        };
        let found = self.base.query_row(query, [system], row).optional()?;
        let Some((by, code, wkt)) = found else {
            return Ok(());
        };
        let epsg = by.eq_ignore_ascii_case("epsg").then_some(code);
        let epsg = epsg.and_then(|code| Crs::from_epsg(u32::try_from(code).ok()?));
        self.layer.crs = epsg.or_else(|| Crs::from_wkt(&wkt));
        // -1 and 0 say that nothing is known.
        if self.layer.crs.is_none() && system > 0 {
            let name = format!("{by}:{code}").into();
            let fault = Fault::of_file(&self.file, Kind::UnknownCrs { name });
            self.remarks.push(fault);
        }
        Ok(())
    }

    /// Reads the next rows.
    fn fill(&mut self) -> rusqlite::Result<()> {
        let mut statement = self.base.prepare_cached(&self.query)?;
        let mut rows = statement.query(params![self.last])?;
        while let Some(row) = rows.next()? {
            self.last = row.get(0)?;
            let number = self.number;
            self.number += 1;
            let fault = |kind: Kind| Fault::of_file(&self.file, kind).of_feature(number, None);
            let geometry = match row.get_ref(1)? {
                ValueRef::Blob(bytes) => geometry(bytes, self.limits.points),
                ValueRef::Null => Err(Kind::NoGeometry),
                _ => Err(Kind::Malformed {
                    what: "the geometry is no geometry".into(),
                }),
            };
            let geometry = match geometry {
                Ok(geometry) => geometry,
                Err(kind) => {
                    self.rows.push_back(Err(fault(kind)));
                    continue;
                }
            };
            let mut fields = vec![];
            for (at, (column, is_bool)) in self.columns.iter().enumerate() {
                let (value, is_text) = value(row.get_ref(at + 2)?, *is_bool);
                if !is_text {
                    self.remarks.push(fault(Kind::Encoding));
                }
                self.layer.columns.note(*column, &value);
                fields.push((*column, value));
            }
            fields.sort_by_key(|field| field.0);
            self.rows.push_back(Ok(Feature {
                number,
                id: Some(self.last.to_string().into()),
                geometry,
                fields,
                place: Place::Record(number + 1),
            }));
        }
        Ok(())
    }
}

/// Opens a file of the disk. Nothing is written: what another program has not yet put into the file itself is read if it
/// lies beside, else not even a lock is taken.
fn on_disk(path: &Path) -> rusqlite::Result<Connection> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let mut beside = path.as_os_str().to_owned();
    beside.push("-wal");
    if fs::metadata(&beside).is_ok_and(|m| m.len() > 0) {
        return Connection::open_with_flags(path, flags);
    }
    match path.to_str() {
        Some(text) => {
            let text = utf8_percent_encode(text, RESERVED);
            let slash = if cfg!(windows) { "/" } else { "" };
            let uri = format!("file:{slash}{text}?immutable=1");
            Connection::open_with_flags(uri, flags | OpenFlags::SQLITE_OPEN_URI)
        }
        None => Connection::open_with_flags(path, flags),
    }
}

/// Opens the bytes of a file.
fn of_bytes(bytes: &[u8]) -> rusqlite::Result<Connection> {
    let mut base = Connection::open_in_memory()?;
    base.deserialize_read_exact(MAIN_DB, bytes, bytes.len(), true)?;
    Ok(base)
}

/// Trusts nothing in the file: it runs no functions, and no value is longer than a feature may be.
fn harden(base: &Connection, most: usize) -> rusqlite::Result<()> {
    base.pragma_update(None, "trusted_schema", false)?;
    base.pragma_update(None, "cell_size_check", true)?;
    base.pragma_update(None, "query_only", true)?;
    let most = i32::try_from(most).unwrap_or(i32::MAX);
    base.set_limit(Limit::SQLITE_LIMIT_LENGTH, most)?;
    Ok(())
}

/// A layer as the file describes it.
struct Found {
    name: String,
    /// The column of geometries.
    geometry: String,
    /// The number of the reference system.
    system: i64,
    /// False if it is a view.
    is_table: bool,
}

/// Returns the layer of this name, else the first, a table if there is one.
fn layer_of(base: &Connection, name: Option<&str>) -> rusqlite::Result<Option<Found>> {
    let query = "SELECT c.table_name, g.column_name, g.srs_id, m.type = 'table' \
                 FROM gpkg_contents c \
                 JOIN gpkg_geometry_columns g ON g.table_name = c.table_name \
                 JOIN sqlite_master m ON m.name = c.table_name AND m.type IN ('table', 'view') \
                 WHERE c.data_type = 'features' \
                 AND (?1 IS NULL OR c.table_name = ?1 OR c.identifier = ?1) \
                 ORDER BY m.type, c.rowid LIMIT 1";
    let row = |row: &rusqlite::Row<'_>| {
        Ok(Found {
            name: row.get(0)?,
            geometry: row.get(1)?,
            system: row.get(2)?,
            is_table: row.get(3)?,
        })
    };
    base.query_row(query, params![name], row).optional()
}

/// Returns a name as SQL quotes it.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// Returns the geometry behind the header of the format.
fn geometry(bytes: &[u8], most: usize) -> Result<Geometry, Kind> {
    let malformed = |what: &str| Kind::Malformed { what: what.into() };
    let flags = match bytes {
        [b'G', b'P', _, flags, ..] => *flags,
        _ => return Err(malformed("the geometry does not begin with `GP`")),
    };
    if flags & 0x10 != 0 {
        return Err(Kind::NoGeometry);
    }
    let envelope = match flags >> 1 & 7 {
        0 => 0,
        1 => 32,
        2 | 3 => 48,
        4 => 64,
        _ => {
            return Err(malformed(
                "the envelope of the geometry is of no known kind",
            ));
        }
    };
    let rest = bytes.get(HEADER + envelope..);
    wkb::geometry(
        rest.ok_or_else(|| malformed("the geometry is cut off"))?,
        most,
    )
}

/// Returns the value of a column; false if its text is no UTF-8. Bytes, such as pictures, are no value.
fn value(of: ValueRef<'_>, is_bool: bool) -> (Value, bool) {
    let value = match of {
        ValueRef::Integer(n) if is_bool => Value::Bool(n != 0),
        ValueRef::Integer(n) => Value::Integer(n),
        ValueRef::Real(x) if x.is_finite() => Value::Number(x),
        ValueRef::Null | ValueRef::Blob(_) | ValueRef::Real(_) => Value::Null,
        ValueRef::Text(text) => {
            let sound = std::str::from_utf8(text).is_ok();
            return (Value::Text(String::from_utf8_lossy(text).into()), sound);
        }
    };
    (value, true)
}

impl Iterator for GeoPackage {
    type Item = Result<Feature, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rows.is_empty() && !self.is_over {
            let before = self.number;
            let read = self.fill();
            self.is_over = read.is_err() || self.number == before;
            if read.is_err() {
                let what = "a row of the table";
                let fault = Fault::of_file(&self.file, Kind::Damaged { what });
                self.rows.push_back(Err(fault));
            }
        }
        self.rows.pop_front()
    }
}

impl Reader for GeoPackage {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn remarks(&mut self) -> Vec<Fault> {
        std::mem::take(&mut self.remarks)
    }
}
