//! Maps: features out of files. One reader a format, all behind [`Reader`]; nothing else in the program knows formats.
//!
//! [`open`] looks at the first bytes of a file, picks the reader and puts [`checked`] before it, so that every feature
//! that comes out has a usable geometry. Readers stream: what they keep does not grow with the file. Files come through
//! [`World`], so nothing outside its roots is read.
//!
//! A reader loses nothing in silence. It yields a [`Feature`] or, in place of each one that cannot be used, a [`Fault`];
//! what is wrong with features that are built nevertheless, and with the file, it keeps as remarks
//! ([`Reader::remarks`]).
//!
//! Grids of heights are no features: [`heights`] reads them.

pub mod messages;
mod checked;
pub mod crs;
mod csv;
mod fault;
mod feature;
mod flatgeobuf;
mod format;
mod geojson;
pub mod heights;
mod input;
mod osm;
pub mod pack;
mod rings;
mod shapefile;
#[cfg(any(feature = "geopackage", feature = "geoparquet"))]
mod wkb;
mod xml;

pub use checked::{crosses, tidied};
pub use crs::{Crs, Datum, Datums, Mismatch, Outside, Projection, Transform, on_globe, sea_level};
pub use fault::{Fault, Faults, Kind, OtherGrid, VertexFault, Which, diagnostic};
pub use feature::{
    Area, Chain, Column, ColumnType, Columns, Feature, Geometry, Layer, Place, Value,
};

use format::Format;
use hsd_base::budget::Account;
use hsd_base::source::World;
use std::io::{Seek, SeekFrom};
use std::sync::Arc;

/// Features of a layer, in the order of the file. `Err` stands in the place of a feature that is not built, or at the end of
/// a file of which the rest cannot be read.
pub trait Reader: Iterator<Item = Result<Feature, Fault>> + Send {
    /// Returns what is known of the layer; columns may be added while features are read.
    fn layer(&self) -> &Layer;

    /// Returns the faults, since the last call, of features that were built nevertheless and of the file as a whole. To be
    /// asked after each feature, or memory grows.
    fn remarks(&mut self) -> Vec<Fault>;
}

/// What is said of a map beside its file.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The layer, or the theme of OpenStreetMap data; the only or first one if none is named.
    pub layer: Option<Box<str>>,
    /// The encoding of texts, by its name such as `cp932`; what the file says or its bytes show if none is named.
    pub encoding: Option<Box<str>>,
    /// The reference system; what the file says if none is given.
    pub crs: Option<Crs>,
    /// Bounds.
    pub limits: Limits,
}

/// Bounds on maps, so that no file exhausts memory.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Bytes of one feature as the file writes it.
    pub feature_bytes: usize,
    /// Points of one feature.
    pub points: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            feature_bytes: 64 << 20,
            points: 2_000_000,
        }
    }
}

/// Opens a map, a path that [`World::text`] has found. The format is told by the first bytes; for tables of text, by the
/// extension.
///
/// # Errors
/// If it cannot be read at all: it is not there, or of no known format, or its head is damaged.
pub fn open(world: &dyn World, path: &str, options: &Options) -> Result<Box<dyn Reader>, Fault> {
    let file: Arc<str> = path.into();
    if has_extension(path, "shp") || has_extension(path, "dbf") {
        let account = Account::new(world.budget());
        account.read(length(world, &file)?);
        let reader = Box::new(shapefile::Shapefile::open(world, &file, options)?);
        let checked = checked::Checked::new(reader, account, file, options);
        return Ok(Box::new(checked));
    }
    let mut input = input::Input::open(world, &file)?;
    let account = input.account();
    let format = format::of(input.head(&file)?, path);
    let reader: Box<dyn Reader> = match format {
        Format::GeoJson => Box::new(geojson::GeoJson::open(input, &file, options)?),
        Format::OsmXml => Box::new(osm::Osm::open(input, &file, options, false)?),
        Format::OsmPbf => Box::new(osm::Osm::open(input, &file, options, true)?),
        Format::FlatGeobuf => Box::new(flatgeobuf::FlatGeobuf::open(input, &file, options)?),
        Format::Moj => Box::new(xml::moj::Moj::open(input, &file, options)?),
        Format::CityGml => Box::new(xml::citygml::CityGml::open(input, &file, options)?),
        #[cfg(feature = "geopackage")]
        Format::GeoPackage => {
            drop(input);
            account.read(length(world, &file)?);
            Box::new(wkb::geopackage::GeoPackage::open(world, &file, options)?)
        }
        #[cfg(feature = "geoparquet")]
        Format::GeoParquet => {
            drop(input);
            account.read(length(world, &file)?);
            Box::new(wkb::geoparquet::GeoParquet::open(world, &file, options)?)
        }
        #[cfg(not(feature = "geopackage"))]
        Format::GeoPackage => {
            let feature = "geopackage";
            return Err(Fault::of_file(&file, Kind::NotBuilt { feature }));
        }
        #[cfg(not(feature = "geoparquet"))]
        Format::GeoParquet => {
            let feature = "geoparquet";
            return Err(Fault::of_file(&file, Kind::NotBuilt { feature }));
        }
        Format::Csv => Box::new(csv::Csv::open(input, &file, options)?),
        Format::Unknown => return Err(Fault::of_file(&file, Kind::UnknownFormat)),
    };
    let checked = checked::Checked::new(reader, account, file, options);
    Ok(Box::new(checked))
}

/// Returns the length of a file.
fn length(world: &dyn World, file: &Arc<str>) -> Result<u64, Fault> {
    let length = world
        .open(file)
        .and_then(|mut file| file.seek(SeekFrom::End(0)));
    length.map_err(|error| input::unreadable(file, &error))
}

/// Half of the features of a map in degrees, at least, are narrower than this; those of a town in metres are wider.
const WIDEST: f64 = 3.0;
/// The width up to which a feature can only be in degrees: a kilometre, or a centimetre.
const TINIEST: f64 = 0.01;

/// The widths of features, as far as they tell degrees from metres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Widths {
    tiny: usize,
    narrow: usize,
    all: usize,
}

impl Widths {
    /// Adds that of a feature, if it has one.
    pub fn add(&mut self, width: Option<f64>) {
        let Some(width) = width else {
            return;
        };
        self.all += 1;
        self.narrow += usize::from(width <= WIDEST);
        self.tiny += usize::from(width <= TINIEST);
    }

    /// Returns true if features of such widths can only be in degrees: as metres, most of them would be specks.
    pub fn are_degrees(&self) -> bool {
        2 * self.tiny > self.all
    }

    /// Returns true if features of such widths can only be in metres: as degrees, most of them would be several degrees wide.
    /// Countries are so wide; houses, lots and streets are not.
    pub fn are_metres(&self) -> bool {
        2 * self.narrow < self.all
    }
}

/// Returns true if a path has an extension, in small or large letters.
pub fn has_extension(path: &str, extension: &str) -> bool {
    let own = path.rsplit_once('.').map(|(_, own)| own);
    own.is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

/// Returns the name of a file without folders and extensions.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.split('.')
        .next()
        .filter(|stem| !stem.is_empty())
        .unwrap_or(name)
}
