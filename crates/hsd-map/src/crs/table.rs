//! The EPSG codes that are known, and the plane zones of Japan (Geospatial Information Authority notice 9 of 2002).

use super::{Crs, Datum, Meridian, Projection};

/// Latitude and longitude of the origins of the plane zones I to XIX of Japan, in minutes.
const PLANE_ZONES: [(u32, u32); 19] = [
    (33 * 60, 129 * 60 + 30),
    (33 * 60, 131 * 60),
    (36 * 60, 132 * 60 + 10),
    (33 * 60, 133 * 60 + 30),
    (36 * 60, 134 * 60 + 20),
    (36 * 60, 136 * 60),
    (36 * 60, 137 * 60 + 10),
    (36 * 60, 138 * 60 + 30),
    (36 * 60, 139 * 60 + 50),
    (40 * 60, 140 * 60 + 50),
    (44 * 60, 140 * 60 + 15),
    (44 * 60, 142 * 60 + 15),
    (44 * 60, 144 * 60 + 15),
    (26 * 60, 142 * 60),
    (26 * 60, 127 * 60 + 30),
    (26 * 60, 124 * 60),
    (26 * 60, 131 * 60),
    (20 * 60, 136 * 60),
    (26 * 60, 154 * 60),
];

/// The codes of plane zone I in each datum.
const PLANE_CODES: [(u32, Datum); 3] = [
    (6669, Datum::Jgd2011),
    (2443, Datum::Jgd2000),
    (30161, Datum::Tokyo),
];

/// The code of plane zone I of JGD2011 with heights; PLATEAU uses those of zones I to XIII.
const PLANE_WITH_HEIGHTS: u32 = 10162;

/// The codes of UTM zones: the first code, the first zone, the number of zones, whether they are of the south, the datum.
const UTM_CODES: [(u32, u32, u32, bool, Datum); 5] = [
    (32601, 1, 60, false, Datum::Wgs84),
    (32701, 1, 60, true, Datum::Wgs84),
    (6688, 51, 5, false, Datum::Jgd2011),
    (3097, 51, 5, false, Datum::Jgd2000),
    (3092, 51, 5, false, Datum::Tokyo),
];

/// The codes of longitude and latitude, with and without heights.
const DEGREES: [(u32, Datum); 10] = [
    (4326, Datum::Wgs84),
    (4979, Datum::Wgs84),
    (6668, Datum::Jgd2011),
    (6667, Datum::Jgd2011),
    (6697, Datum::Jgd2011),
    (4612, Datum::Jgd2000),
    (4947, Datum::Jgd2000),
    (4301, Datum::Tokyo),
    (7414, Datum::Tokyo),
    (6695, Datum::Jgd2000),
];

/// The codes of the web's Mercator, among them those of old programs.
const WEB_MERCATOR: [u32; 4] = [3857, 3785, 900_913, 102_100];

/// The most degrees, metres or parts by which parameters in a file may differ from those of the table, as some files
/// round them.
const SAME: f64 = 1e-7;

/// Returns the meridian of a plane zone of Japan, from 1.
fn plane_zone(zone: u32) -> Option<Meridian> {
    let (lat, lon) = *PLANE_ZONES.get(zone.checked_sub(1)? as usize)?;
    Some(Meridian {
        lat: f64::from(lat) / 60.0,
        lon: f64::from(lon) / 60.0,
        scale: 0.9999,
        east: 0.0,
        north: 0.0,
        unit: 1.0,
    })
}

fn utm_zone(zone: u32, south: bool) -> Meridian {
    Meridian {
        lat: 0.0,
        lon: f64::from(zone) * 6.0 - 183.0,
        scale: 0.9996,
        east: 500_000.0,
        north: if south { 10_000_000.0 } else { 0.0 },
        unit: 1.0,
    }
}

fn system(code: u32, datum: &Datum, projection: Projection) -> Crs {
    Crs {
        name: format!("EPSG:{code}").into(),
        datum: datum.clone(),
        projection,
    }
}

/// Returns the system of a code.
pub(super) fn of_code(code: u32) -> Option<Crs> {
    if let Some((_, datum)) = DEGREES.iter().find(|(c, _)| *c == code) {
        return Some(system(code, datum, Projection::Degrees));
    }
    if WEB_MERCATOR.contains(&code) {
        return Some(system(3857, &Datum::Wgs84, Projection::WebMercator));
    }
    if (PLANE_WITH_HEIGHTS..PLANE_WITH_HEIGHTS + 13).contains(&code) {
        return plane(code - PLANE_WITH_HEIGHTS + 1, &Datum::Jgd2011);
    }
    let planes = PLANE_CODES.iter().filter(|(first, _)| code >= *first);
    let mut planes = planes.filter_map(|(first, datum)| plane(code - first + 1, datum));
    planes.next().or_else(|| {
        let (first, zone, _, south, datum) = UTM_CODES
            .iter()
            .find(|(first, _, count, ..)| (*first..first + count).contains(&code))?;
        let meridian = utm_zone(zone + code - first, *south);
        Some(system(
            code,
            datum,
            Projection::TransverseMercator(meridian),
        ))
    })
}

/// Returns a plane zone of Japan, from 1, in a datum that has them.
pub(super) fn plane(zone: u32, datum: &Datum) -> Option<Crs> {
    let (first, _) = PLANE_CODES.iter().find(|(_, d)| d == datum)?;
    let projection = Projection::TransverseMercator(plane_zone(zone)?);
    Some(system(first + zone - 1, datum, projection))
}

/// Returns a UTM zone in a datum; that of WGS 84 if the datum has none.
pub(super) fn utm(zone: u32, south: bool, datum: &Datum) -> Crs {
    let zone = zone.clamp(1, 60);
    let has_it = |(_, first, count, of_south, of): &&(u32, u32, u32, bool, Datum)| {
        of == datum && *of_south == south && (*first..first + count).contains(&zone)
    };
    let meridian = Projection::TransverseMercator(utm_zone(zone, south));
    match UTM_CODES.iter().find(has_it) {
        Some((first, from, ..)) => system(first + zone - from, datum, meridian),
        None => {
            let first = if south { 32700 } else { 32600 };
            system(first + zone, &Datum::Wgs84, meridian)
        }
    }
}

/// Returns the system of the table with this datum and meridian.
pub(super) fn of_meridian(datum: &Datum, meridian: &Meridian) -> Option<Crs> {
    let same = |other: Option<Meridian>| {
        other.is_some_and(|m| {
            let of = |m: &Meridian| [m.lat, m.lon, m.scale, m.east, m.north, m.unit];
            let pairs = of(&m).into_iter().zip(of(meridian));
            pairs.into_iter().all(|(p, q)| (p - q).abs() < SAME)
        })
    };
    if let Some(zone) = (1..=19).find(|zone| same(plane_zone(*zone))) {
        return plane(zone, datum);
    }
    let south = meridian.north > 0.0;
    let zone = (1..=60).find(|zone| same(Some(utm_zone(*zone, south))))?;
    let found = utm(zone, south, datum);
    (found.datum == *datum).then_some(found)
}
