//! The zone in which a place lies.

use super::{Crs, Datum, table};
use glam::{DVec2, dvec2};

/// Cities and islands of Japan with the plane zone of their prefecture: longitude and latitude in tenths of a degree, zone.
/// The zones follow prefectures, so the nearest of these tells the zone.
#[rustfmt::skip]
const CITIES: &[(i32, i32, u32)] = &[
    (1299, 327, 1), (1297, 332, 1), (1293, 342, 1), (1288, 327, 1), (1295, 284, 1), (1305, 316, 2),
    (1304, 336, 2), (1309, 339, 2), (1303, 332, 2), (1307, 328, 2), (1316, 332, 2), (1314, 319, 2), (1309, 318, 2), (1305, 304, 2),
    (1315, 342, 3), (1309, 340, 3), (1325, 344, 3), (1334, 345, 3), (1331, 355, 3), (1327, 354, 3), (1333, 362, 3), (1321, 349, 3),
    (1340, 343, 4), (1346, 341, 4), (1328, 338, 4), (1335, 336, 4), (1325, 332, 4), (1330, 340, 4),
    (1339, 347, 5), (1342, 355, 5), (1340, 351, 5), (1347, 348, 5), (1352, 347, 5), (1348, 354, 5), (1333, 354, 5), (1349, 343, 5),
    (1355, 347, 6), (1358, 350, 6), (1351, 353, 6), (1358, 347, 6), (1359, 350, 6), (1362, 353, 6), (1352, 342, 6), (1358, 337, 6),
    (1365, 347, 6), (1362, 361, 6), (1361, 357, 6), (1366, 351, 6), (1362, 340, 6),
    (1369, 352, 7), (1367, 354, 7), (1372, 361, 7), (1374, 348, 7), (1366, 366, 7), (1372, 367, 7), (1369, 374, 7), (1370, 367, 7),
    (1384, 350, 8), (1377, 347, 8), (1386, 357, 8), (1382, 366, 8), (1380, 362, 8), (1390, 379, 8), (1382, 371, 8), (1384, 380, 8),
    (1389, 351, 8), (1378, 355, 8),
    (1397, 357, 9), (1396, 354, 9), (1401, 356, 9), (1396, 359, 9), (1391, 364, 9), (1399, 366, 9), (1405, 364, 9), (1405, 378, 9),
    (1399, 375, 9), (1409, 371, 9), (1394, 347, 9), (1398, 331, 9), (1399, 351, 9), (1392, 358, 9),
    (1407, 408, 10), (1415, 405, 10), (1411, 397, 10), (1420, 396, 10), (1401, 397, 10), (1403, 383, 10), (1398, 389, 10),
    (1409, 383, 10), (1413, 384, 10), (1410, 413, 10),
    (1407, 418, 11), (1410, 432, 11), (1401, 420, 11), (1410, 423, 11), (1395, 422, 11),
    (1414, 431, 12), (1424, 438, 12), (1417, 454, 12), (1423, 430, 12), (1428, 421, 12), (1420, 442, 12), (1412, 452, 12),
    (1432, 429, 13), (1444, 430, 13), (1439, 438, 13), (1443, 440, 13), (1456, 433, 13), (1451, 444, 13), (1479, 450, 13),
    (1422, 271, 14), (1413, 248, 14),
    (1277, 262, 15), (1281, 268, 15), (1268, 263, 15),
    (1242, 243, 16), (1253, 248, 16), (1230, 245, 16),
    (1312, 258, 17), (1361, 204, 18), (1540, 243, 19),
];

/// The greatest distance from a city of the table in degrees, beyond which a place is not in Japan.
const FARTHEST: f64 = 1.6;

/// Returns the plane zone of Japan, else the UTM zone.
pub(super) fn at(lon_lat: DVec2, datum: &Datum) -> Crs {
    let modern = match datum {
        Datum::Wgs84 | Datum::Local | Datum::Other { .. } => &Datum::Jgd2011,
        of_japan => of_japan,
    };
    let zone = plane_zone(lon_lat).and_then(|zone| table::plane(zone, modern));
    zone.unwrap_or_else(|| {
        let number = ((lon_lat.x + 180.0).rem_euclid(360.0) / 6.0) as u32 + 1;
        table::utm(number, lon_lat.y < 0.0, datum)
    })
}

/// Returns the plane zone of Japan in which a place lies, from 1.
fn plane_zone(lon_lat: DVec2) -> Option<u32> {
    // A degree of longitude is shorter than one of latitude; 0.8 in the middle of Japan.
    let distance = |(lon, lat, _): &(i32, i32, u32)| {
        let off = lon_lat - dvec2(f64::from(*lon), f64::from(*lat)) / 10.0;
        (off * dvec2(0.8, 1.0)).length()
    };
    let nearest = CITIES
        .iter()
        .min_by(|p, q| distance(p).total_cmp(&distance(q)))?;
    (distance(nearest) < FARTHEST && !is_abroad(lon_lat)).then_some(nearest.2)
}

/// Returns true for the coasts that face Japan.
fn is_abroad(lon_lat: DVec2) -> bool {
    let korea = lon_lat.x < 129.7 && lon_lat.y > 34.8;
    let taiwan = lon_lat.x < 122.5;
    let sakhalin = lon_lat.y > 45.9;
    korea || taiwan || sakhalin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_in_the_zone_of_their_prefecture() {
        let zone = |lon, lat| at(dvec2(lon, lat), &Datum::Wgs84).name;
        assert_eq!(&*zone(135.75, 35.0), "EPSG:6674", "Kyoto, VI");
        assert_eq!(&*zone(139.76, 35.73), "EPSG:6677", "Yanaka, IX");
        assert_eq!(&*zone(136.99, 35.34), "EPSG:6675", "Inuyama, VII");
        assert_eq!(&*zone(138.25, 37.15), "EPSG:6676", "Joetsu, VIII");
        assert_eq!(&*zone(141.35, 43.06), "EPSG:6680", "Sapporo, XII");
        assert_eq!(&*zone(127.7, 26.2), "EPSG:6683", "Naha, XV");
        assert_eq!(&*zone(130.4, 33.6), "EPSG:6670", "Fukuoka, II");
        assert_eq!(&*zone(135.2, 34.7), "EPSG:6673", "Kobe, V");
        assert_eq!(&*zone(129.08, 35.18), "EPSG:32652", "Busan");
        assert_eq!(&*zone(4.9, 52.37), "EPSG:32631", "Amsterdam");
        assert_eq!(&*zone(-43.2, -22.9), "EPSG:32723", "Rio de Janeiro");
        let old = at(dvec2(135.75, 35.0), &Datum::Tokyo);
        assert_eq!(&*old.name, "EPSG:30166");
    }
}
