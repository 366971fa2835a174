//! Coordinate reference systems: what the numbers of a map mean. The EPSG codes of Japan are in a table ([`table`]). PROJ
//! defines all others ([`defined`]). Files name them ([`names`]) or describe them as WKT ([`wkt`]). Conversions are by proj4rs
//! ([`transform`]). Then come the zone of a town (`zones`) and its place on the globe ([`globe`]).
//!
//! Whatever order an authority gives the axes, here x is east and y is north; readers swap what their format has the
//! other way round.

mod defined;
mod globe;
mod names;
mod table;
mod transform;
mod wkt;
mod zones;

pub use globe::{on_globe, sea_level};
pub use transform::{Datums, Mismatch, Transform};

use glam::DVec2;

/// A coordinate reference system.
#[derive(Clone, Debug, PartialEq)]
pub struct Crs {
    /// `EPSG:6674`, or the name in the file if it has no code.
    pub name: Box<str>,
    /// The datum.
    pub datum: Datum,
    /// How longitude and latitude become x and y.
    pub projection: Projection,
}

/// A geodetic datum.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// The World Geodetic System of 1984.
    Wgs84,
    /// Japan since 2011. Taken as equal to WGS 84, from which it differs by less than the survey of a map.
    Jgd2011,
    /// Japan from 2002 to 2011; up to 5 m off in the north-east after the earthquake of 2011.
    Jgd2000,
    /// Japan until 2002; some 450 m off.
    Tokyo,
    /// Another one, which agrees with itself only.
    Other {
        /// Its name.
        name: Box<str>,
        /// The ellipsoid and, where it is known, the shift to WGS 84, in the words of PROJ: `+ellps=airy`.
        definition: Box<str>,
    },
    /// None: coordinates of a local survey.
    Local,
}

/// How longitude and latitude become x and y.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// Longitude and latitude in degrees.
    Degrees,
    /// Gauss-Krüger: the plane zones of Japan, UTM.
    TransverseMercator(Meridian),
    /// Mercator on a sphere, as map tiles of the web have it (EPSG:3857).
    WebMercator,
    /// Any other, with its unit, in the words of PROJ: `+proj=lcc +lat_1=49 +lat_2=44`.
    Defined(Box<str>),
    /// Metres of a local survey, placed nowhere.
    Local,
}

/// The parameters of a transverse Mercator projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meridian {
    /// Longitude of the central meridian in degrees.
    pub lon: f64,
    /// Latitude of the origin in degrees.
    pub lat: f64,
    /// Scale on the central meridian.
    pub scale: f64,
    /// x of the origin in metres.
    pub east: f64,
    /// y of the origin in metres.
    pub north: f64,
    /// Metres in a unit of the coordinates.
    pub unit: f64,
}

/// Bounds of longitudes and latitudes in Japan, in degrees.
const JAPAN: (DVec2, DVec2) = (DVec2::new(122.0, 20.0), DVec2::new(154.5, 46.5));

/// The distance from the origin of a transverse Mercator projection, east and north, beyond which no map lies, in metres.
const FARTHEST: DVec2 = DVec2::new(1_500_000.0, 10_100_000.0);

/// Distance from the origin of a local survey or of any other projection on each axis beyond which no place is, in its unit.
const LOCAL_SIDE: f64 = 1e8;

/// Half the side of the square that the web's Mercator covers, in metres, rounded up.
const WEB_SIDE: f64 = 20_040_000.0;

/// The reason why coordinates cannot be of a reference system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// They are degrees, and the system has metres.
    Degrees,
    /// They are latitude and longitude in this order.
    Swapped,
    /// They are metres, and the system has degrees.
    Metres,
    /// They are too far off.
    Far,
}

impl Crs {
    /// Returns WGS 84 with longitude first, which GeoJSON has (RFC 7946).
    pub fn wgs84() -> Crs {
        Crs {
            name: "EPSG:4326".into(),
            datum: Datum::Wgs84,
            projection: Projection::Degrees,
        }
    }

    /// Returns metres of a local survey.
    pub fn local() -> Crs {
        Crs {
            name: "local".into(),
            datum: Datum::Local,
            projection: Projection::Local,
        }
    }

    /// Returns the system of an EPSG code: longitude and latitude, or a projection that proj4rs knows. `None` for codes of
    /// heights alone and of earth-centred coordinates, and for meridians other than that of Greenwich.
    pub fn from_epsg(code: u32) -> Option<Crs> {
        table::of_code(code).or_else(|| defined::of_code(code))
    }

    /// Returns the system of a name: `EPSG:6674`, `urn:ogc:def:crs:EPSG::6674`,
    /// `http://www.opengis.net/def/crs/EPSG/0/6674`, `CRS84`, `6674`, `local`, or WKT.
    pub fn from_name(name: &str) -> Option<Crs> {
        names::crs(name)
    }

    /// Returns the system that WKT (of either version) describes, as in a `.prj` file. An EPSG code counts if it is in the
    /// table; otherwise the name and the parameters do.
    pub fn from_wkt(text: &str) -> Option<Crs> {
        wkt::crs(text)
    }

    /// Returns the plane zone of Japan in which a place lies, else its UTM zone, in metres: the natural system for a town
    /// there. Near the border of two zones of Japan, which follows prefectures, the nearest city decides. The datum is that
    /// of the data as far as it has such a zone, so that nothing needs to be converted from datum to datum.
    pub fn zone_at(lon_lat: DVec2, datum: &Datum) -> Crs {
        zones::at(lon_lat, datum)
    }

    /// Returns true if the coordinates are degrees.
    pub fn is_degrees(&self) -> bool {
        self.projection == Projection::Degrees
    }

    /// Returns true if the authority that defined the system has north before east: longitude and latitude, and the plane
    /// zones of Japan. Formats that follow it are turned by their readers.
    pub fn authority_has_north_first(&self) -> bool {
        match &self.projection {
            Projection::Degrees => true,
            Projection::TransverseMercator(m) => m.east == 0.0 && m.north == 0.0,
            Projection::WebMercator | Projection::Local | Projection::Defined(_) => false,
        }
    }

    /// Returns true if the coordinates are metres in a plane, so that a town may be built in it.
    pub fn is_in_metres(&self) -> bool {
        match &self.projection {
            Projection::Degrees => false,
            Projection::TransverseMercator(m) => m.unit == 1.0,
            Projection::Defined(definition) => defined::is_in_metres(definition),
            Projection::WebMercator | Projection::Local => true,
        }
    }

    /// Returns why a point cannot lie in this system, if it cannot. Numbers in degrees that stand in a system of metres
    /// are recognised in Japan, where a map of 30 m at this very distance from the origin of its zone is less likely.
    pub fn refuses(&self, p: DVec2) -> Option<Outside> {
        let inside = |p: DVec2| p.cmpge(JAPAN.0).all() && p.cmple(JAPAN.1).all();
        match &self.projection {
            Projection::Local | Projection::Defined(_) if p.abs().max_element() > LOCAL_SIDE => {
                Some(Outside::Far)
            }
            Projection::Local => None,
            Projection::Degrees if p.x.abs() <= 180.0 && p.y.abs() <= 90.0 => None,
            Projection::Degrees if p.x.abs() <= 90.0 && p.y.abs() <= 180.0 => {
                Some(Outside::Swapped)
            }
            Projection::Degrees if p.x.abs() > 400.0 || p.y.abs() > 400.0 => Some(Outside::Metres),
            Projection::Degrees => Some(Outside::Far),
            _ if inside(p) || inside(DVec2::new(p.y, p.x)) => Some(Outside::Degrees),
            Projection::Defined(_) => None,
            Projection::TransverseMercator(m) => {
                let off = p * m.unit - DVec2::new(m.east, m.north);
                off.abs().cmpgt(FARTHEST).any().then_some(Outside::Far)
            }
            Projection::WebMercator => (p.abs().max_element() > WEB_SIDE).then_some(Outside::Far),
        }
    }
}
