//! Water and farmland of a town: areas that are covered once, fields of one grid.

use crate::town_streets::{area, feature, folder, holds, line, made, square, text, tops};
use crate::town_works::{inside, off};
use crate::towns::in_folder;
use hsd::ast::Sheet;
use hsd::glam::{DVec2, dvec2};

#[test]
fn water_and_banks_cover_their_area_once() {
    let pond = feature(
        "",
        "Polygon",
        "[[[0,0],[40,-4],[44,30],[22,12],[2,34],[0,0]],[[10,4],[16,4],[16,10],[10,10],[10,4]]]",
    );
    let stream = line("", &[(60.0, 0.0), (60.0, 40.0), (90.0, 60.0)]);
    let road = line(r#""width":4"#, &[(50.0, 20.0), (70.0, 20.0)]);
    let folder = folder(&[("water", &[pond, stream]), ("roads", &[road])]);
    let rules = "<for each=\"water\"><Water width=\"6\" bank_width=\"0.8\"/></for><for each=\"roads\"><Road/></for>";
    let houses = made(&text(&["water", "roads"], rules), folder.path());
    let outline = [
        (0.0, 0.0),
        (40.0, -4.0),
        (44.0, 30.0),
        (22.0, 12.0),
        (2.0, 34.0),
    ]
    .map(DVec2::from);
    let island = [(10.0, 4.0), (16.0, 4.0), (16.0, 10.0), (10.0, 10.0)].map(DVec2::from);
    let is_top = |sheet: &Sheet| sheet.least == 0 && ["water", "stone"].contains(&sheet.finish);
    let faces = tops(&houses, is_top);
    let water = tops(&houses, |sheet| sheet.finish == "water");
    for n in 0..6000 {
        let p = dvec2(
            f64::from(n * 37 % 1201) / 12.0 - 3.05,
            f64::from(n * 91 % 997) / 14.0 - 6.93,
        );
        let count = faces.iter().filter(|face| holds(face, p)).count();
        assert!(count <= 1, "{p} is covered {count} times");
        if p.x > 48.0 {
            continue;
        }
        let shore = off(&outline, p).min(off(&island, p));
        let within = inside(&outline, p) && !inside(&island, p);
        if within && shore > 0.01 {
            assert_eq!(count, 1, "{p} lies in the pond");
        }
        if shore > 0.01 && (shore - 0.8).abs() > 0.01 {
            let wet = water.iter().any(|face| holds(face, p));
            // At corners banks reach a little farther.
            assert!(
                wet == (within && shore > 0.8) || (within && shore < 1.7),
                "{p}"
            );
        }
    }
    // No bank in the road, water under it.
    let bridge = |x: f64| {
        faces
            .iter()
            .filter(|face| holds(face, dvec2(x, 20.13)))
            .count()
    };
    assert_eq!((bridge(57.3), bridge(60.2)), (0, 1));
}

#[test]
fn fields_line_up_over_the_town_and_lose_no_ground() {
    let cho = 360.0 / 3.3;
    let areas = [
        square("", (0.0, 0.0), cho),
        feature(
            "",
            "Polygon",
            "[[[150,20],[260,-10],[300,90],[190,140],[220,60],[150,20]]]",
        ),
    ];
    let folder = folder(&[("fields", &areas)]);
    let rules = "<for each=\"fields\"><Farmland/></for>";
    let built = in_folder(&text(&["fields"], rules), folder.path(), |_| {});
    let rows: Vec<&str> = built.rows.iter().map(|r| &*r["parameters"]).collect();
    assert_eq!(rows[0], "crop=rice fields=10 area=11900.83");
    let houses = made(&text(&["fields"], rules), folder.path());
    let all = tops(&houses, |sheet| sheet.least == 0);
    let rings = [
        vec![(0.0, 0.0), (cho, 0.0), (cho, cho), (0.0, cho)],
        vec![
            (150.0, 20.0),
            (260.0, -10.0),
            (300.0, 90.0),
            (190.0, 140.0),
            (220.0, 60.0),
        ],
    ];
    let whole = |ring: &Vec<(f64, f64)>| {
        let at = |i: usize| DVec2::from(ring[i % ring.len()]);
        (0..ring.len())
            .map(|i| at(i).perp_dot(at(i + 1)))
            .sum::<f64>()
            / 2.0
    };
    let wanted: f64 = rings.iter().map(whole).sum();
    let found: f64 = all.iter().map(|face| area(face)).sum();
    assert!((found / wanted - 1.0).abs() < 1e-3, "{found} of {wanted}");
    // Middles of ridges of all fields: multiples of a tenth of a cho to the east, and of a cho to the north.
    let crops = tops(&houses, |sheet| sheet.finish == "crop_rice");
    let grown = |x: f64, y: f64| crops.iter().any(|face| holds(face, dvec2(x, y)));
    let strip = cho / 10.0;
    for n in 0..28 {
        let x = f64::from(n) * strip;
        assert!(!grown(x, 55.0), "a ridge lies at {x}");
        if n < 10 {
            assert!(grown(x + 0.5 * strip, 55.0), "a crop grows at {x}");
        }
    }
    assert!(!grown(245.0, cho) && grown(245.0, cho - 2.0));
    // The same turned: the grid turns with it, about the origin.
    let turned = made(
        &text(
            &["fields"],
            "<for each=\"fields\"><Farmland azimuth=\"30\"/></for>",
        ),
        folder.path(),
    );
    let found: f64 = tops(&turned, |sheet| sheet.least == 0)
        .iter()
        .map(|face| area(face))
        .sum();
    assert!((found / wanted - 1.0).abs() < 1e-3, "{found} of {wanted}");
    let azimuth = turned[0]
        .settings
        .azimuth
        .as_ref()
        .expect("is turned")
        .value;
    assert!((azimuth - 210.0).abs() < 1e-9, "{azimuth}");
}
