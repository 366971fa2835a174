//! Conversions from one reference system to another, by proj4rs.

use super::{Crs, Datum, Projection, defined};
use glam::DVec2;
use proj4rs::Proj;
use std::borrow::Cow;

/// The shift of the Tokyo datum to WGS 84 in metres (Geospatial Information Authority), good to some metres.
const TOKYO: &str = "+ellps=bessel +towgs84=-146.414,507.337,680.507";

/// How datums may be converted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Datums {
    /// Only by a grid, and none is at hand: different datums are refused.
    #[default]
    Exact,
    /// By a shift of three parameters: good to some metres.
    ThreeParameters,
}

/// The reason why two systems cannot be converted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// Their datums differ, and no grid is at hand.
    Datum,
    /// One of them is a local survey, placed nowhere.
    Local,
    /// The parameters make no projection.
    Unusable,
}

/// A conversion of points.
#[derive(Debug)]
pub struct Transform {
    /// `None` if nothing changes.
    steps: Option<(Side, Side)>,
}

/// A system as proj4rs wants it.
#[derive(Debug)]
struct Side {
    proj: Proj,
    degrees: bool,
}

impl Transform {
    /// Creates the conversion from one system to another.
    ///
    /// # Errors
    /// If there is none.
    pub fn new(from: &Crs, to: &Crs, datums: Datums) -> Result<Transform, Mismatch> {
        if from.datum == to.datum && from.projection == to.projection {
            return Ok(Transform { steps: None });
        }
        if [from, to].iter().any(|c| c.projection == Projection::Local) {
            return Err(Mismatch::Local);
        }
        let shifted = !agree(&from.datum, &to.datum);
        let known = |datum: &Datum| match datum {
            Datum::Other { definition, .. } => defined::has_shift(definition),
            _ => true,
        };
        let may = datums == Datums::ThreeParameters && known(&from.datum) && known(&to.datum);
        if shifted && !may {
            return Err(Mismatch::Datum);
        }
        let steps = Some((Side::new(from)?, Side::new(to)?));
        Ok(Transform { steps })
    }

    /// Returns a point in the other system; `None` if it lies where the projection has none.
    pub fn apply(&self, p: DVec2) -> Option<DVec2> {
        let Some((from, to)) = &self.steps else {
            return Some(p);
        };
        let mut point = match from.degrees {
            true => (p.x.to_radians(), p.y.to_radians()),
            false => (p.x, p.y),
        };
        proj4rs::transform::transform(&from.proj, &to.proj, &mut point).ok()?;
        let found = match to.degrees {
            true => DVec2::new(point.0.to_degrees(), point.1.to_degrees()),
            false => DVec2::new(point.0, point.1),
        };
        found.is_finite().then_some(found)
    }
}

/// Returns true if two datums agree as far as maps of towns do.
fn agree(one: &Datum, two: &Datum) -> bool {
    let modern = |d: &Datum| matches!(d, Datum::Wgs84 | Datum::Jgd2011);
    one == two || (modern(one) && modern(two))
}

impl Side {
    fn new(crs: &Crs) -> Result<Side, Mismatch> {
        let proj = Proj::from_proj_string(&definition(crs)).map_err(|_| Mismatch::Unusable)?;
        let degrees = crs.is_degrees();
        Ok(Side { proj, degrees })
    }
}

/// Returns the definition for proj4rs.
fn definition(crs: &Crs) -> String {
    let datum: Cow<'_, str> = match &crs.datum {
        Datum::Wgs84 | Datum::Local => "+ellps=WGS84 +towgs84=0,0,0".into(),
        Datum::Jgd2011 | Datum::Jgd2000 => "+ellps=GRS80 +towgs84=0,0,0".into(),
        Datum::Tokyo => TOKYO.into(),
        Datum::Other { definition, .. } => definition.as_ref().into(),
    };
    match &crs.projection {
        Projection::Degrees | Projection::Local => format!("+proj=longlat {datum} +no_defs"),
        Projection::WebMercator => {
            "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +no_defs".to_owned()
        }
        Projection::Defined(definition) => format!("{definition} {datum} +no_defs"),
        Projection::TransverseMercator(m) => format!(
            "+proj=tmerc +lat_0={} +lon_0={} +k={} +x_0={} +y_0={} {datum} +to_meter={} +no_defs",
            m.lat, m.lon, m.scale, m.east, m.north, m.unit
        ),
    }
}
