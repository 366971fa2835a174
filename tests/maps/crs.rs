//! Reference systems: names, WKT, conversions.

use hsd::glam::dvec2;
use hsd::map::{Crs, Datum, Datums, Mismatch, Outside, Transform};

#[test]
fn one_system_has_many_names() {
    let six = Crs::from_epsg(6674);
    assert!(six.is_some());
    for name in [
        "EPSG:6674",
        "6674",
        "urn:ogc:def:crs:EPSG::6674",
        "urn:ogc:def:crs:EPSG:9.8:6674",
        "http://www.opengis.net/def/crs/EPSG/0/6674",
        r#"PROJCS["JGD_2011_Japan_Zone_6",GEOGCS["GCS_JGD_2011",DATUM["D_JGD_2011",SPHEROID["GRS_1980",6378137.0,298.257222101]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",136.0],PARAMETER["Scale_Factor",0.9999],PARAMETER["Latitude_Of_Origin",36.0],UNIT["Meter",1.0]]"#,
        r#"PROJCRS["JGD2011 / Japan Plane Rectangular CS VI",BASEGEOGCRS["JGD2011",DATUM["Japanese Geodetic Datum 2011",ELLIPSOID["GRS 1980",6378137,298.257222101]]],CONVERSION["x",METHOD["Transverse Mercator"]],ID["EPSG",6674]]"#,
    ] {
        assert_eq!(Crs::from_name(name), six, "{name}");
    }
    for name in [
        "",
        "EPSG:",
        "EPSG:99999999999",
        "urn:x",
        "PROJCS[",
        "GEOGCS[\"a\"]",
        "[[[[",
    ] {
        assert_eq!(Crs::from_name(name), None, "{name}");
    }
    assert_eq!(
        Crs::from_name("urn:ogc:def:crs:OGC:1.3:CRS84"),
        Some(Crs::wgs84())
    );
    let utm = Crs::from_epsg(32653).unwrap();
    assert_eq!(utm.datum, Datum::Wgs84);
}

#[test]
fn places_agree_with_proj() {
    // PROJ 9 by pyproj.
    let cases = [
        (6669, dvec2(129.9, 32.7), dvec2(37503.65695, -33196.48582)),
        (
            6674,
            dvec2(135.75, 35.0),
            dvec2(-22819.78519, -110910.11809),
        ),
        (
            6677,
            dvec2(139.7627436, 35.7286161),
            dvec2(-6385.72732, -30106.49618),
        ),
        (32653, dvec2(135.0, 35.0), dvec2(500_000.0, 3873043.06453)),
        (
            2263,
            dvec2(-73.9857, 40.7484),
            dvec2(988212.23718, 211939.27857),
        ),
        (
            2154,
            dvec2(2.3522, 48.8566),
            dvec2(652469.02271, 6862035.25942),
        ),
        (
            25832,
            dvec2(9.9937, 53.5511),
            dvec2(565834.36401, 5934037.95100),
        ),
        (
            3035,
            dvec2(9.9937, 53.5511),
            dvec2(4320582.39027, 3382601.75080),
        ),
        (
            32723,
            dvec2(-43.2, -22.9),
            dvec2(684623.67326, 7466421.40067),
        ),
        (
            3857,
            dvec2(135.75, 35.0),
            dvec2(15111620.87519, 4163881.14406),
        ),
    ];
    for (code, lon_lat, expected) in cases {
        let to = Crs::from_epsg(code).unwrap();
        let there = Transform::new(&Crs::wgs84(), &to, Datums::Exact).unwrap();
        let back = Transform::new(&to, &Crs::wgs84(), Datums::Exact).unwrap();
        let found = there.apply(lon_lat).unwrap();
        // The ellipsoids of WGS 84 and GRS 80 are taken as one.
        assert!(found.distance(expected) < 1e-3, "{code}: {found}");
        let again = back.apply(found).unwrap();
        assert!(again.distance(lon_lat) < 1e-9, "{code}: {again}");
    }
}

#[test]
fn conic_projections_are_read_from_their_parameters() {
    let long_island = r#"PROJCS["NAD_1983_StatePlane_New_York_Long_Island_FIPS_3104_Feet",GEOGCS["GCS_North_American_1983",DATUM["D_North_American_1983",SPHEROID["GRS_1980",6378137.0,298.257222101]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic"],PARAMETER["False_Easting",984250.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",-74.0],PARAMETER["Standard_Parallel_1",41.0333333333333],PARAMETER["Standard_Parallel_2",40.6666666666667],PARAMETER["Latitude_Of_Origin",40.1666666666667],UNIT["US survey foot",0.304800609601219]]"#;
    let read = Crs::from_wkt(long_island).unwrap();
    let known = Crs::from_epsg(2263).unwrap();
    let both = [read, known].map(|to| {
        let there = Transform::new(&Crs::wgs84(), &to, Datums::Exact).unwrap();
        assert!(!to.is_in_metres(), "{to:?}");
        there.apply(dvec2(-73.9857, 40.7484)).unwrap()
    });
    assert!(both[0].distance(both[1]) < 1e-3, "{both:?}");
}

#[test]
fn systems_that_are_no_plane_are_not_known() {
    // Earth-centred, heights, the meridian of Paris, axes to the south.
    for code in [4978, 5703, 27561, 2046] {
        assert_eq!(Crs::from_epsg(code), None, "{code}");
    }
    let britain = Crs::from_epsg(27700).unwrap();
    let refused = Transform::new(&britain, &Crs::wgs84(), Datums::Exact).err();
    assert_eq!(refused, Some(Mismatch::Datum));
    assert!(Transform::new(&britain, &Crs::wgs84(), Datums::ThreeParameters).is_ok());
}

#[test]
fn old_datums_are_converted_only_where_asked() {
    let (old, new) = (
        Crs::from_epsg(30166).unwrap(),
        Crs::from_epsg(6674).unwrap(),
    );
    let refused = Transform::new(&old, &new, Datums::Exact).err();
    assert_eq!(refused, Some(Mismatch::Datum));
    let shifted = Transform::new(&old, &new, Datums::ThreeParameters).unwrap();
    let by = shifted.apply(dvec2(0.0, 0.0)).unwrap();
    assert!((300.0..600.0).contains(&by.length()), "{by}");
    let local = Transform::new(&Crs::local(), &new, Datums::Exact).err();
    assert_eq!(local, Some(Mismatch::Local));
    assert!(Transform::new(&Crs::local(), &Crs::local(), Datums::Exact).is_ok());
}

#[test]
fn coordinates_outside_their_system_are_known() {
    let (degrees, metres) = (Crs::wgs84(), Crs::from_epsg(6674).unwrap());
    assert_eq!(degrees.refuses(dvec2(135.0, 35.0)), None);
    assert_eq!(degrees.refuses(dvec2(35.0, 135.0)), Some(Outside::Swapped));
    assert_eq!(
        degrees.refuses(dvec2(-22_800.0, -108_300.0)),
        Some(Outside::Metres)
    );
    assert_eq!(metres.refuses(dvec2(-22_800.0, -108_300.0)), None);
    assert_eq!(metres.refuses(dvec2(135.75, 35.0)), Some(Outside::Degrees));
    assert_eq!(metres.refuses(dvec2(35.0, 135.75)), Some(Outside::Degrees));
    assert_eq!(metres.refuses(dvec2(9e9, 0.0)), Some(Outside::Far));
}
