//! True accounts: every feature of every layer is built, skipped with a code, or unused, whatever the maps are.

use super::towns::{Built, in_folder};
use crate::support::cpu::assert_linear;
use proptest::prelude::*;
use std::fmt::Write;
use std::fs;

/// Evaluates a town beside maps of these names and features.
fn town(text: &str, maps: &[(&str, String)]) -> Built {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, features) in maps {
        let map = format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#);
        fs::write(folder.path().join(format!("{name}.geojson")), map).expect("is written");
    }
    in_folder(text, folder.path(), |_| {})
}

fn feature(geometry: &str, properties: &str) -> String {
    format!(r#"{{"type":"Feature","properties":{{{properties}}},"geometry":{geometry}}}"#)
}

/// An outline, whose ring is closed.
fn outline(corners: &[(f64, f64)], properties: &str) -> String {
    let mut ring = String::new();
    for (x, y) in corners.iter().chain(corners.first()) {
        let _ = write!(ring, "{}[{x},{y}]", if ring.is_empty() { "" } else { "," });
    }
    let geometry = format!(r#"{{"type":"Polygon","coordinates":[[{ring}]]}}"#);
    feature(&geometry, properties)
}

fn square(x: f64, y: f64) -> String {
    let (e, n) = (x + 8.0, y + 8.0);
    outline(&[(x, y), (e, y), (e, n), (x, n)], "")
}

/// A line of 36,000 km that stays near the middle of the town.
fn winding() -> String {
    let corners = (0..400).flat_map(|n| {
        let (x, y) = (45_000.0 * f64::from(n % 2), 40.0 * f64::from(n));
        [[x, y], [45_000.0 - x, y]].map(|[x, y]| format!("[{x},{y}]"))
    });
    let corners: Vec<String> = corners.collect();
    let corners = corners.join(",");
    let geometry = format!(r#"{{"type":"LineString","coordinates":[{corners}]}}"#);
    feature(&geometry, "")
}

fn line(length: f64) -> String {
    let geometry = format!(r#"{{"type":"LineString","coordinates":[[0,0],[{length},0]]}}"#);
    feature(&geometry, "")
}

const ONE: &str = r#"<Layer name="a" src="a.geojson" crs="local"/>"#;

fn skipped(built: &Built) -> Vec<&str> {
    let rows = built.rows.iter();
    let rows = rows.filter(|row| ["left out", "refused", "not read"].contains(&&*row["what"]));
    rows.map(|row| &*row["key"]).collect()
}

#[test]
fn what_is_drawn_twice_is_built_once() {
    let mut turned = vec![(8.0, 8.0), (0.0, 8.0), (0.0, 0.0), (8.0, 0.0)];
    let second = outline(&turned, "");
    turned.reverse();
    let third = outline(&turned, "");
    let part = outline(&turned, r#""building:part":"yes","min_height":6"#);
    let map = [square(0.0, 0.0), second, square(20.0, 0.0), third, part].join(",");
    let rules = r#"<for each="a"><Place type="block" on="outline"/></for>"#;
    let built = town(&format!("<Town>{ONE}{rules}</Town>"), &[("a", map)]);
    assert_eq!((built.features, built.built, built.skipped), (5, 3, 2));
    assert_eq!(skipped(&built), ["1", "3"]);
    assert!(
        built.found.contains(&"HSD1118".to_owned()),
        "{:?}",
        built.found
    );
}

#[test]
fn lines_and_zones_may_be_drawn_twice() {
    let text = format!(r#"<Town>{ONE}<for each="a"><Road width="4"/></for></Town>"#);
    let built = town(&text, &[("a", [line(50.0), line(50.0)].join(","))]);
    assert_eq!((built.built, built.skipped), (2, 0));
    let text = format!(r#"<Town>{ONE}<for each="a"><Zone gradient="1.5"/></for></Town>"#);
    let built = town(
        &text,
        &[("a", [square(0.0, 0.0), square(0.0, 0.0)].join(","))],
    );
    assert_eq!((built.built, built.skipped), (2, 0));
}

#[test]
fn no_house_is_built_where_the_loops_of_an_outline_cancel_out() {
    let tie = outline(&[(20.0, 0.0), (30.0, 8.0), (30.0, 0.0), (20.0, 8.001)], "");
    for place in [r#"type="kura" on="centre""#, r#"type="hiraya""#] {
        let text = format!(r#"<Town>{ONE}<for each="a"><Place {place}/></for></Town>"#);
        let built = town(&text, &[("a", [square(0.0, 0.0), tie.clone()].join(","))]);
        assert_eq!((built.built, built.skipped, built.houses), (1, 1, 1));
        assert_eq!(skipped(&built), ["1"]);
        assert!(
            built.found.contains(&"HSD1119".to_owned()),
            "{:?}",
            built.found
        );
    }
}

#[test]
fn layers_that_no_rule_names_are_counted() {
    let layers = r#"<Layer name="a" src="a.geojson" crs="local"/><Layer name="other" src="b.geojson" crs="local"/><Layer name="empty" src="c.geojson" crs="local"/><Layer name="roads" src="d.geojson" crs="local"/>"#;
    let text = format!(r#"<Town>{layers}<for each="a"><Place type="block"/></for></Town>"#);
    let maps = [
        ("a", square(0.0, 0.0)),
        ("b", [square(50.0, 0.0), square(70.0, 0.0)].join(",")),
        ("c", String::new()),
        ("d", line(30.0)),
    ];
    let built = town(&text, &maps);
    assert_eq!((built.features, built.built, built.unused), (1, 1, 3));
    let idle = built.told.iter().filter(|told| told[0] == "HSD1120");
    let idle: Vec<&str> = idle.map(|told| &*told[1]).collect();
    assert_eq!(idle, ["other", "empty"]);
}

#[test]
fn units_along_a_line_are_counted_before_they_are_made() {
    for wish in [
        "<Fence/>",
        r#"<Pole spacing="30"/>"#,
        "<Rail/>",
        "<Arcade/>",
        r#"<Network spacing="30"/>"#,
    ] {
        let text = format!(r#"<Town>{ONE}<for each="a">{wish}</for></Town>"#);
        let map = [winding(), line(40.0)].join(",");
        let built = town(&text, &[("a", map)]);
        assert_eq!(
            (built.built, built.skipped),
            (1, 1),
            "{wish}: {:?}",
            built.told
        );
        assert_eq!(skipped(&built), ["0"], "{wish}");
        assert!(built.found.contains(&"HSD1170".to_owned()), "{wish}");
    }
}

/// A rectangle with a corner at a place.
fn rectangle([x, y]: [f64; 2], [w, d]: [f64; 2], properties: &str) -> String {
    outline(
        &[(x, y), (x + w, y), (x + w, y + d), (x, y + d)],
        properties,
    )
}

#[test]
fn a_house_inside_of_another_is_skipped() {
    let court = r#"{"type":"Polygon","coordinates":[[[100,0],[130,0],[130,30],[100,30],[100,0]],[[105,5],[105,25],[125,25],[125,5],[105,5]]]}"#;
    let map = [
        rectangle([0.0, 0.0], [30.0, 20.0], ""),
        rectangle([7.0, 6.0], [9.0, 8.0], ""),
        // A tower on its podium, a house that overlaps, one in a courtyard.
        rectangle([18.0, 6.0], [6.0, 6.0], r#""building:part":"yes""#),
        rectangle([25.0, 15.0], [12.0, 12.0], ""),
        feature(court, ""),
        rectangle([110.0, 10.0], [8.0, 8.0], ""),
        // Nothing is built of what is round this one.
        rectangle([200.0, 0.0], [90.0, 90.0], r#""landuse":"school""#),
        rectangle([210.0, 10.0], [9.0, 9.0], ""),
    ];
    let layer = r#"<Layer name="a" src="a.geojson" crs="local"><Field name="use" from="landuse" type="text" default="-"/></Layer>"#;
    let rule = r#"<for each="a" test="{use != '-'}"><Skip because="land"/></for><for each="a" test="{use == '-'}"><Place type="block" on="outline"/></for>"#;
    let built = town(
        &format!("<Town>{layer}{rule}</Town>"),
        &[("a", map.join(","))],
    );
    assert_eq!(skipped(&built), ["1"], "{:?}", built.told);
    let told = built.told.iter().find(|told| told[0] == "HSD1118");
    assert!(
        told.is_some_and(|told| told[2].contains("`0`")),
        "{:?}",
        built.told
    );
}

#[test]
fn something_is_built_on_every_area_of_a_feature() {
    let ring = |x: f64, w: f64, d: f64| {
        let e = x + w;
        format!("[[[{x},0],[{e},0],[{e},{d}],[{x},{d}],[{x},0]]]")
    };
    // The second lies half on the first.
    let areas = [
        ring(0.0, 10.0, 8.0),
        ring(5.0, 10.0, 8.0),
        ring(40.0, 20.0, 12.0),
    ];
    let areas = format!(
        r#"{{"type":"MultiPolygon","coordinates":[{}]}}"#,
        areas.join(",")
    );
    let points = r#"{"type":"MultiPoint","coordinates":[[70,0],[80,0],[90,0]]}"#;
    let text = r#"<Town><Layer name="a" src="a.geojson" crs="local"/><Layer name="b" src="b.geojson" crs="local"/>
      <for each="a"><Place type="block" on="outline"/></for><for each="b"><Tree/></for></Town>"#;
    let built = town(
        text,
        &[("a", feature(&areas, "")), ("b", feature(points, ""))],
    );
    assert_eq!(skipped(&built), ["0/2"], "{:?}", built.told);
    assert_eq!((built.built, built.skipped), (5, 1), "{:?}", built.told);
    let told = built.told.iter().find(|told| told[0] == "HSD1118");
    assert!(
        told.is_some_and(|told| told[2].contains("50 %")),
        "{:?}",
        built.told
    );
}

#[test]
fn a_row_of_overlapping_outlines_takes_linear_time() {
    // Each covers three quarters of the next.
    let make = |count: usize| {
        let outline =
            |n: usize| rectangle([n as f64 * 2.5, 0.0], [10.0 - n as f64 * 0.001, 8.0], "");
        (0..count).map(outline).collect::<Vec<_>>().join(",")
    };
    let text = r#"<Town><Layer name="a" src="a.geojson" crs="local"/><for each="a"><Place type="block" on="outline"/></for></Town>"#;
    assert_linear("a row of outlines", 100, make, |map| {
        let built = town(text, &[("a", map.clone())]);
        assert!(built.built > 0 && built.skipped > 0, "{:?}", built.told);
    });
}

#[test]
fn long_outlines_across_many_take_linear_time() {
    let make = |count: usize| {
        let long = count as f64 * 0.9 + 10.0;
        let across = (0..20).map(|n| rectangle([-5.0, f64::from(n) * 0.9], [long, 0.8], ""));
        let others = (0..count).map(|n| rectangle([n as f64 * 0.9, -5.0], [0.8, 30.0], ""));
        across.chain(others).collect::<Vec<_>>().join(",")
    };
    let text = r#"<Town><Layer name="a" src="a.geojson" crs="local"/><for each="a"><Place type="block" on="outline"/></for></Town>"#;
    assert_linear("long outlines across others", 100, make, |map| {
        let built = town(text, &[("a", map.clone())]);
        assert!(built.built > 0, "{:?}", built.told);
    });
}

/// A line that is scribbled over a square meets itself as often as it has pieces, squared.
#[test]
fn scribbled_lines_are_refused_before_they_are_cut() {
    let scribble = |count: u32| {
        let at = |n: u32| {
            let [x, y] = [2_654_435_761u32, 2_246_822_519].map(|k| (n.wrapping_mul(k) >> 8) % 200);
            format!("[{x},{y}]")
        };
        let corners: Vec<String> = (0..count).map(at).collect();
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"LineString","coordinates":[{}]}}}}"#,
            corners.join(",")
        )
    };
    for made in ["<Road/>", "<Rail/>", r#"<Water width="4"/>"#, "<Network/>"] {
        let text = format!(
            r#"<Town><Layer name="a" src="a.geojson" crs="local"/><for each="a">{made}</for></Town>"#
        );
        let few = town(&text, &[("a", scribble(40))]);
        assert_eq!((few.built, few.skipped), (1, 0), "{made}: {:?}", few.told);
        let many = town(&text, &[("a", scribble(4_000))]);
        let told: Vec<&str> = many.told.iter().map(|told| &*told[0]).collect();
        assert_eq!(
            (many.built, many.skipped),
            (0, 1),
            "{made}: {:?}",
            many.told
        );
        assert!(told.contains(&"HSD1170"), "{made}: {:?}", many.told);
    }
}

#[test]
fn combs_are_refused_before_they_are_divided() {
    let comb = |teeth: u32| {
        let tooth = |n: u32| {
            let [w, e] = [2 * n, 2 * n + 1];
            format!("[{w},0],[{w},200],[{e},200],[{e},0]")
        };
        let teeth: Vec<String> = (0..teeth).map(tooth).collect();
        let (teeth, east) = (teeth.join(","), 2 * teeth.len());
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[[{teeth},[{east},-5],[0,-5],[0,0]]]}}}}"#
        )
    };
    for made in ["<Farmland/>", r#"<Water bank="stone"/>"#] {
        let text = format!(
            r#"<Town><Layer name="a" src="a.geojson" crs="local"/><for each="a">{made}</for></Town>"#
        );
        let few = town(&text, &[("a", comb(10))]);
        assert_eq!((few.built, few.skipped), (1, 0), "{made}: {:?}", few.told);
        let many = town(&text, &[("a", comb(2_500))]);
        assert_eq!(
            (many.built, many.skipped),
            (0, 1),
            "{made}: {:?}",
            many.told
        );
    }
}

#[test]
fn words_in_fields_of_numbers_are_reported_once_per_field() {
    let heights = ["about 9", "11,5 m", "?", "1e999", "12", "high", "3;4", ""];
    let map = heights.iter().zip(0u8..).map(|(height, n)| {
        let properties = format!(r#""h":"{height}","w":"{n}""#);
        rectangle([f64::from(n) * 20.0, 0.0], [8.0, 8.0], &properties)
    });
    let fields = r#"<Field name="h" type="number" default="7"/><Field name="w" type="number"/>"#;
    let layer = format!(r#"<Layer name="a" src="a.geojson" crs="local">{fields}</Layer>"#);
    let text = format!(r#"<Town>{layer}<for each="a"><Place type="block"/></for></Town>"#);
    let built = town(&text, &[("a", map.collect::<Vec<String>>().join(","))]);
    assert_eq!((built.built, built.skipped), (8, 0));
    let told: Vec<&str> = built
        .told
        .iter()
        .filter(|t| t[0] == "HSD1010")
        .map(|t| &*t[2])
        .collect();
    assert!(
        matches!(told[..], [one] if one.contains("`about 9`") && one.contains("field `h`") && one.contains("3 more")),
        "{told:?}"
    );
}

#[test]
fn wires_are_counted_before_they_are_drawn() {
    let text = format!(r#"<Town>{ONE}<for each="a"><Wire wires="1000000000"/></for></Town>"#);
    let built = town(&text, &[("a", line(40.0))]);
    assert!(
        built.found.contains(&"HSD0226".to_owned()),
        "{:?}",
        built.told
    );
}

#[test]
fn spreadsheets_run_no_key() {
    let run = r#""key":"=HYPERLINK(1)""#;
    let map = [
        outline(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)], run),
        outline(
            &[(9.0, 0.0), (17.0, 0.0), (17.0, 8.0), (9.0, 8.0)],
            r#""key":"-3.5""#,
        ),
    ];
    let layer = r#"<Layer name="a" src="a.geojson" crs="local" key="key"/>"#;
    let text = format!(r#"<Town>{layer}<for each="a"><Place type="block"/></for></Town>"#);
    let built = town(&text, &[("a", map.join(","))]);
    let keys: Vec<&str> = built.rows.iter().map(|row| &*row["key"]).collect();
    assert_eq!(keys, ["'=HYPERLINK(1)", "-3.5"]);
}

/// Returns a feature of a kind: sound, doubled, crossing itself, without area, unreadable.
fn of_kind(kind: u8, number: usize) -> String {
    let at = number as f64 * 12.0;
    match kind {
        0 | 1 => square(at, 0.0),
        2 => square(0.0, 40.0),
        3 => outline(
            &[(at, 20.0), (at + 9.0, 28.0), (at + 9.0, 20.0), (at, 28.001)],
            "",
        ),
        4 => outline(&[(at, 20.0), (at + 5.0, 20.0), (at + 2.0, 20.0)], ""),
        5 => line(at + 5.0),
        6 => feature(&format!(r#"{{"type":"Point","coordinates":[{at},0]}}"#), ""),
        7 => feature("null", ""),
        8 => feature(r#"{"type":"Polygon","coordinates":[]}"#, ""),
        _ => feature(r#"{"type":"Point","coordinates":["x",0]}"#, ""),
    }
}

/// A rule that takes some of its features.
const RULES: [&str; 7] = [
    "",
    r#"<for each="L"><Place type="block" on="outline"/></for>"#,
    r#"<for each="L" test="{area > 20}"><Place type="kura" on="centre"/></for>"#,
    r#"<for each="L" test="{area > 20}"><Skip because="large"/></for>"#,
    r#"<for each="L"><Fence/></for>"#,
    r#"<for each="L"><Tree/></for>"#,
    r#"<for each="L"><Road width="3"/><Water/></for>"#,
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// The helper that evaluates towns compares the report with the table: built, skipped and unused add up.
    #[test]
    fn features_are_built_skipped_or_unused(
        layers in prop::collection::vec((prop::collection::vec(0u8..10, 0..8), 0..RULES.len()), 1..4),
    ) {
        let (mut text, mut rules, mut maps) = (String::from("<Town>"), String::new(), vec![]);
        let mut asked = 0;
        for (name, (kinds, rule)) in ["a", "b", "c"].into_iter().zip(&layers) {
            let _ = write!(text, r#"<Layer name="{name}" src="{name}.geojson" crs="local"/>"#);
            rules.push_str(&RULES[*rule].replace('L', name));
            let features: Vec<String> = kinds.iter().zip(0..).map(|(k, n)| of_kind(*k, n)).collect();
            asked += features.len();
            maps.push((name, features.join(",")));
        }
        let built = town(&format!("{text}{rules}</Town>"), &maps);
        // A town whose maps are all empty is not evaluated.
        if !built.csv().is_empty() {
            prop_assert_eq!(built.features + built.unused, asked);
        }
    }
}
