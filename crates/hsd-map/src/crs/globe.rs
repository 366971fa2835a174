//! Where a plane touches the globe: the frame of a town among earth-centred coordinates (EPSG:4978).

use super::{Crs, Datums, Transform};
use glam::{DVec2, DVec3};

/// Semi-major axis of WGS 84 and GRS 80, metres.
const A: f64 = 6_378_137.0;
/// First eccentricity squared of WGS 84; that of GRS 80 differs by less than a millimetre on the ground.
const E2: f64 = 6.694_379_990_141_316e-3;
/// Half the length of the line along which the direction of the plane's x axis is measured, metres.
const REACH: f64 = 100.0;

/// Returns the matrix, column by column, that takes metres east, north and up in a plane from `origin` to earth-centred
/// metres. Its axes are those of the plane, which differ from true east and north by the convergence of the meridians;
/// its height 0 lies `rise` metres above the ellipsoid. `None` for a local survey, which is placed nowhere.
pub fn on_globe(crs: &Crs, origin: DVec2, rise: f64) -> Option<[f64; 16]> {
    let degrees = Transform::new(crs, &Crs::wgs84(), Datums::ThreeParameters).ok()?;
    let at = |p: DVec2| degrees.apply(p).map(geocentric);
    let (foot, up) = at(origin)?;
    let place = foot + up * rise;
    let (west, _) = at(origin - DVec2::new(REACH, 0.0))?;
    let (other, _) = at(origin + DVec2::new(REACH, 0.0))?;
    let along = other - west;
    let east = (along - up * along.dot(up)).try_normalize()?;
    let north = up.cross(east);
    let column = |v: DVec3, w: f64| [v.x, v.y, v.z, w];
    let columns = [
        column(east, 0.0),
        column(north, 0.0),
        column(up, 0.0),
        column(place, 1.0),
    ];
    let mut matrix = [0.0; 16];
    matrix.copy_from_slice(columns.as_flattened());
    Some(matrix)
}

/// Returns how high the sea, continued below the land, stands above the ellipsoid of WGS 84 at a place of a plane: the geoid
/// EGM96, metres rounded to centimetres so that they are the same on every machine. In Japan it is within about a metre of
/// the national geoid, from which levels are measured. `None` for a local survey.
pub fn sea_level(crs: &Crs, at: DVec2) -> Option<f64> {
    let degrees = Transform::new(crs, &Crs::wgs84(), Datums::ThreeParameters).ok()?;
    let lon_lat = degrees.apply(at)?;
    let metres = egm96::egm96_compute_altitude_offset(lon_lat.y, lon_lat.x);
    Some((metres * 100.0).round() / 100.0)
}

/// Returns the place on the ellipsoid of a longitude and latitude in degrees, and the direction up there.
fn geocentric(lon_lat: DVec2) -> (DVec3, DVec3) {
    let (lon, lat) = (lon_lat.x.to_radians(), lon_lat.y.to_radians());
    let ((sin_lon, cos_lon), (sin_lat, cos_lat)) = (libm::sincos(lon), libm::sincos(lat));
    let up = DVec3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
    let radius = A / (1.0 - E2 * sin_lat * sin_lat).sqrt();
    let place = radius * DVec3::new(up.x, up.y, up.z * (1.0 - E2));
    (place, up)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A place in Kyoto in the plane of zone VI.
    const KYOTO: DVec2 = DVec2::new(-22_000.0, -112_000.0);

    #[test]
    fn places_on_the_globe_are_those_of_the_formula() {
        // Kyoto, 135.75 E 35 N: worked out with PROJ.
        let (place, up) = geocentric(DVec2::new(0.0, 0.0));
        assert_eq!((place, up), (DVec3::new(A, 0.0, 0.0), DVec3::X));
        let (pole, _) = geocentric(DVec2::new(0.0, 90.0));
        assert!((pole.z - 6_356_752.314_245).abs() < 1e-6);
    }

    #[test]
    fn a_plane_zone_turns_by_the_convergence_of_its_meridians() {
        let zone = Crs::from_epsg(6674).expect("zone VI");
        let matrix = on_globe(&zone, KYOTO, 0.0).expect("is placed");
        let column = |n: usize| DVec3::from_slice(&matrix[4 * n..4 * n + 3]);
        let (east, north, up) = (column(0), column(1), column(2));
        assert!(east.cross(north).distance(up) < 1e-12);
        // Kyoto lies a quarter of a degree west of the zone's meridian, so its grid turns by sin(lat) times that.
        let place = column(3);
        let true_east = DVec3::new(-place.y, place.x, 0.0).normalize();
        let turn = true_east.cross(east).dot(up).asin().to_degrees();
        assert!((turn.abs() - 0.139).abs() < 0.01, "{turn}");
        assert!((place.length() - 6_371_000.0).abs() < 10_000.0);
        assert_eq!(on_globe(&Crs::local(), DVec2::ZERO, 0.0), None);
        let raised = on_globe(&zone, KYOTO, 36.5).expect("is placed");
        let way = DVec3::from_slice(&raised[12..15]) - place;
        assert!(way.distance(36.5 * up) < 1e-6, "{way}");
        assert_eq!(raised[..12], matrix[..12]);
    }

    #[test]
    fn the_sea_stands_where_the_model_of_the_earth_has_it() {
        // What the National Geospatial-Intelligence Agency gives for EGM96 at 34.99 N 135.76 E is 36.7 m; the geoid of the
        // Geospatial Information Authority of Japan has 37.0 m there.
        let zone = Crs::from_epsg(6674).expect("zone VI");
        let kyoto = sea_level(&zone, KYOTO).expect("is placed");
        assert!((kyoto - 36.7).abs() < 0.1, "{kyoto}");
        assert!((kyoto * 100.0 - (kyoto * 100.0).round()).abs() < 1e-9);
        // Joetsu lies nearer to the middle of the island, where the sea stands higher.
        let joetsu = sea_level(
            &Crs::from_epsg(6676).expect("zone VIII"),
            DVec2::new(-23_000.0, 127_000.0),
        );
        assert!(
            (joetsu.expect("is placed") - 39.0).abs() < 0.3,
            "{joetsu:?}"
        );
        assert_eq!(sea_level(&Crs::local(), DVec2::ZERO), None);
    }
}
