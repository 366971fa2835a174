//! Towns: rules evaluated at features, where houses stand, what is reported.

use hsd::diagnostic::Language;
use hsd::driver::Options;
use hsd::town::decision::LayerCount;
use hsd::town::plan::Plan;
use hsd::town::stream::TownStream;
use hsd::town::{TownInput, TownReport, run};
use hsd::{Diagnostics, FileId, FolderWorld, Source};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A town that has been evaluated.
pub(crate) struct Built {
    /// The lines of the table, those of unused features left out.
    pub(crate) rows: Vec<BTreeMap<String, String>>,
    /// The number of features of layers that rules name.
    pub(crate) features: usize,
    /// The number of features of other layers.
    pub(crate) unused: usize,
    pub(crate) built: usize,
    pub(crate) skipped: usize,
    pub(crate) houses: usize,
    csv: String,
    /// Layer, key, code and reason of what was corrected.
    pub(crate) corrected: Vec<[String; 4]>,
    pub(crate) found: Vec<String>,
    /// The code of each diagnostic, the text at its place, and its message.
    pub(crate) told: Vec<[String; 3]>,
}

impl Built {
    /// Returns the table of decisions; empty for a town that cannot be read.
    pub(crate) fn csv(&self) -> &str {
        &self.csv
    }
}

/// Evaluates a town beside maps of these names and texts.
fn town(text: &str, files: &[(&str, &str)]) -> Built {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("is written");
    }
    in_folder(text, folder.path(), |_| {})
}

/// Evaluates a town whose maps lie in a folder; `look` sees its features and streets.
pub(crate) fn in_folder(text: &str, folder: &Path, look: impl FnOnce(&Plan)) -> Built {
    let name = folder.join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let written = read.documents.into_iter().find_map(|d| d.town);
    let input = TownInput::new(&source, &world, &options);
    let plan = written.and_then(|town| run::plan(input, &town, &mut out));
    let mut built = Built {
        rows: vec![],
        features: 0,
        unused: 0,
        built: 0,
        skipped: 0,
        houses: 0,
        csv: String::new(),
        corrected: vec![],
        found: vec![],
        told: vec![],
    };
    if let Some(plan) = plan {
        let mut houses = TownStream::new(input, &plan);
        built.houses = houses.by_ref().count();
        let (ledger, _) = houses.finish(&mut out);
        built.rows = rows(ledger.decisions.text());
        check_accounts(&built.rows, &ledger.report);
        built.rows.retain(|row| row["what"] != "unused");
        built.csv = ledger.decisions.text().to_owned();
        built.features = ledger.report.features - ledger.report.unused;
        built.unused = ledger.report.unused;
        built.built = ledger.report.built;
        built.skipped = ledger.report.skipped.len();
        let corrected = ledger.report.corrected.into_iter();
        built.corrected = corrected
            .map(|c| [c.layer, c.key, c.code, c.reason])
            .collect();
        look(&plan);
    }
    for found in out.into_sorted() {
        let place = found.span().map(|span| &text[source.text_range(span)]);
        let (code, message) = (
            found.code.to_string(),
            found.message.in_language(Language::English).into_owned(),
        );
        built.found.push(code.clone());
        let place = place.unwrap_or_default().to_owned();
        built.told.push([code, place, message]);
    }
    built
}

/// Every feature has one state, in the report as in the table.
fn check_accounts(rows: &[BTreeMap<String, String>], report: &TownReport) {
    let TownReport {
        features,
        built,
        unused,
        layers,
        skipped,
        ..
    } = report;
    assert_eq!(*features, built + skipped.len() + unused);
    let of_layers = |count: fn(&LayerCount) -> usize| layers.iter().map(count).sum::<usize>();
    assert_eq!(of_layers(|layer| layer.features), *features);
    assert_eq!(of_layers(|layer| layer.built), *built);
    assert_eq!(of_layers(|layer| layer.skipped), skipped.len());
    assert_eq!(of_layers(|layer| layer.unused), *unused);
    // Houses behind houses have lines too.
    assert!(rows.len() >= *features, "{} lines", rows.len());
    let said = |what: &str| rows.iter().filter(|row| row["what"] == what).count();
    assert_eq!(said("unused"), *unused);
}

fn rows(csv: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = csv.lines();
    let head = cells(lines.next().unwrap_or_default());
    lines
        .map(|line| head.iter().cloned().zip(cells(line)).collect())
        .collect()
}

fn cells(line: &str) -> Vec<String> {
    let (mut all, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(String::new()),
            c => all.last_mut().expect("one at least").push(c),
        }
    }
    all
}

/// Returns a number of a row of the table of decisions.
pub(crate) fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name]
        .parse()
        .unwrap_or_else(|_| panic!("{name} of {row:?}"))
}

/// A map in metres of rectangles: key, west, south, width, depth.
fn map(houses: &[(&str, f64, f64, f64, f64)]) -> String {
    let features: Vec<String> = houses
        .iter()
        .map(|(key, x, y, w, d)| {
            let (e, n) = (x + w, y + d);
            format!(
                r#"{{"type":"Feature","properties":{{"key":"{key}","levels":{}}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{n}],[{x},{n}],[{x},{y}]]]}}}}"#,
                key.len()
            )
        })
        .collect();
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        features.join(",")
    )
}

const ROAD: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"width":4},"geometry":{"type":"LineString","coordinates":[[-50,-3],[50,-3]]}}]}"#;

fn rules(rules: &str) -> String {
    format!(
        r#"<Town seed="1"><Layer name="houses" src="houses.geojson" crs="local" key="key"/><Layer name="roads" src="roads.geojson" crs="local"/>{rules}</Town>"#
    )
}

fn small(text: &str, houses: &[(&str, f64, f64, f64, f64)]) -> Built {
    let map = map(houses);
    town(
        &rules(text),
        &[("houses.geojson", &map), ("roads.geojson", ROAD)],
    )
}

const ROW: &[(&str, f64, f64, f64, f64)] = &[
    ("a", 0.0, 0.0, 5.4, 9.0),
    ("bb", 5.4, 0.0, 4.6, 8.0),
    ("ccc", 10.0, 0.0, 7.0, 12.0),
    ("shed", 3.0, 14.0, 2.0, 2.0),
];

#[test]
fn houses_front_their_street_and_every_feature_is_listed() {
    let found = small(
        r#"<for each="houses" test="{area &lt; 9}"><Skip because="a shed"/></for>
           <for each="houses" test="{area >= 9}"><Place type="so-nikai"/></for>"#,
        ROW,
    );
    assert_eq!(found.found, [""; 0], "nothing is wrong");
    assert_eq!(
        (found.features, found.built, found.skipped, found.houses),
        (4, 3, 1, 3)
    );
    for row in &found.rows[..3] {
        assert_eq!(number(row, "facing"), 180.0, "{row:?}");
        assert_eq!(row["what"], "plot");
        assert!(number(row, "depth") <= 8.0, "capped (000-58)");
        assert_eq!(row["access"], "street");
    }
    assert_eq!(number(&found.rows[0], "width"), 5.4);
    assert_eq!(
        (&*found.rows[3]["what"], &*found.rows[3]["why"]),
        ("skipped", "a shed")
    );
}

#[test]
fn measures_and_fields_are_names_and_parameters_follow_them() {
    let found = small(
        r#"<for each="houses" test="{levels = 1 and frontage > 5 and left = 0 or key = 'bb'}"><Place type="chu-nikai" upper="{if(levels = 2, 6, 5)}"/></for>"#,
        ROW,
    );
    let built: Vec<&str> = found
        .rows
        .iter()
        .filter(|r| r["what"] == "plot")
        .map(|r| &*r["key"])
        .collect();
    assert_eq!(built, ["bb"], "a has no neighbour on its left");
    let parameters = &found.rows[1]["parameters"];
    for wanted in ["frontage=4.6", "depth=8", "upper=6"] {
        assert!(parameters.contains(wanted), "{parameters}");
    }
    assert_eq!(found.found, ["HSD1107"], "the rest meets no rule");
}

#[test]
fn draws_belong_to_places_not_to_the_order_of_features() {
    let text = r#"<for each="houses"><random><choice weight="1"><Place type="so-nikai" ground="{9 + round(draw(8)) / 4}"/></choice><choice weight="1"><Place type="kanban"/></choice><choice weight="1"><Place type="chu-nikai"/></choice></random></for>"#;
    let many: Vec<(String, f64)> = (0..40)
        .map(|n| (format!("h{n}"), f64::from(n) * 5.0))
        .collect();
    let forth: Vec<_> = many
        .iter()
        .map(|(k, x)| (&**k, *x, 0.0, 5.0, 8.0))
        .collect();
    let back: Vec<_> = forth.iter().rev().copied().collect();
    let by_key = |built: Built| -> BTreeMap<String, (String, String)> {
        let rows = built.rows.into_iter();
        rows.map(|r| {
            (
                r["key"].clone(),
                (r["type"].clone(), r["parameters"].clone()),
            )
        })
        .collect()
    };
    let (one, two) = (by_key(small(text, &forth)), by_key(small(text, &back)));
    assert_eq!(one, two);
    let kinds: std::collections::BTreeSet<&String> = one.values().map(|(kind, _)| kind).collect();
    assert_eq!(kinds.len(), 3, "all choices are drawn");
}

#[test]
fn threads_change_nothing() {
    let text = r#"<for each="houses"><Place type="so-nikai"/></for>"#;
    let many: Vec<(String, f64)> = (0..400)
        .map(|n| (format!("h{n}"), f64::from(n) * 5.0))
        .collect();
    let houses: Vec<_> = many
        .iter()
        .map(|(k, x)| (&**k, *x, 0.0, 5.0, 8.0))
        .collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        pool.install(|| small(text, &houses).csv)
    };
    assert_eq!(run(1), run(4));
}

#[test]
fn mistakes_are_named() {
    let cases = [
        (
            r#"<for each="houses"><Place type="so-nikai" ground="{levls}"/></for>"#,
            "HSD0252",
        ),
        (
            r#"<for each="houses"><Place type="so-nikai" azimuth="90"/></for>"#,
            "HSD1105",
        ),
        (
            r#"<for each="houses"><Place type="so-nikai" on="plott"/></for>"#,
            "HSD0227",
        ),
        (
            r#"<for each="houses" test="{look('t', 1, 'x') = 1}"><Place type="so-nikai"/></for>"#,
            "HSD1104",
        ),
        (
            r#"<Table name="t" src="none.csv" key="k"/><for each="houses"><Place type="so-nikai"/></for>"#,
            "HSD1103",
        ),
    ];
    for (text, code) in cases {
        let found = small(text, ROW).found;
        assert!(found.iter().any(|c| c == code), "{text}: {found:?}");
    }
    let text = rules(r#"<for each="houses"><Place type="so-nikai"/></for>"#);
    let found = town(&text, &[("roads.geojson", ROAD)]).found;
    assert_eq!(found, ["HSD1115"], "no map");
    let found = town(
        &text.replace("<Town ", r#"<Town crs="EPSG:99999" "#),
        &[("houses.geojson", &map(ROW)), ("roads.geojson", ROAD)],
    )
    .found;
    assert_eq!(found, ["HSD1117"]);
    let sparse = map(&ROW[..3]).replace(r#","levels":1"#, "");
    let text = rules(
        r#"<for each="houses" test="{levels > 1}"><Place type="so-nikai"/></for><for each="houses"><Place type="so-nikai"/></for>"#,
    );
    let found = town(
        &text,
        &[("houses.geojson", &sparse), ("roads.geojson", ROAD)],
    )
    .found;
    assert_eq!(found, ["HSD1106"]);
    let twice = map(ROW).replace(r#""key":"bb""#, r#""key":"a""#);
    let found = town(
        &rules(r#"<for each="houses"><Place type="so-nikai"/></for>"#),
        &[("houses.geojson", &twice), ("roads.geojson", ROAD)],
    )
    .found;
    assert!(found.contains(&"HSD1112".to_owned()), "{found:?}");
    let alone = r#"<Town><Layer name="houses" src="houses.geojson" crs="local"/><for each="houses"><Place type="so-nikai"/></for></Town>"#;
    let found = town(alone, &[("houses.geojson", &map(ROW))]).found;
    assert!(found.contains(&"HSD1110".to_owned()), "{found:?}");
}

#[test]
fn a_layer_leaves_out_what_does_not_pass_its_where() {
    let built = |test: &str| {
        let text = rules(r#"<for each="houses"><Place type="so-nikai"/></for>"#);
        let text = text.replace(r#"key="key"/>"#, &format!(r#"key="key" where="{test}"/>"#));
        let found = town(
            &text,
            &[("houses.geojson", &map(ROW)), ("roads.geojson", ROAD)],
        );
        let keys: Vec<String> = found.rows.iter().map(|r| r["key"].clone()).collect();
        (keys.join(" "), found.found.join(" "))
    };
    assert_eq!(
        built("levels > 1 and key != 'shed'"),
        ("bb ccc".into(), String::new())
    );
    assert_eq!(built("levels > 9").1, "HSD1142");
    for (test, code) in [
        ("levls > 1", "HSD1141"),
        ("levels >", "HSD1140"),
        ("levels + 1", "HSD1140"),
    ] {
        let found = built(test).1;
        assert!(found.contains(code), "{test}: {found}");
    }
}

#[test]
fn a_misspelt_field_of_a_where_names_the_nearest_one() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("houses.geojson"), map(ROW)).expect("is written");
    let text = r#"<Town><Layer name="houses" src="houses.geojson" crs="local" where="levls > 1"/><for each="houses"><Place type="so-nikai"/></for></Town>"#;
    let name = folder.path().join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.path().to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let input = TownInput::new(&source, &world, &options);
    let depth = hsd::town::CheckDepth::Rules(&|| true);
    hsd::town::check(input, depth, &mut vec![], &mut out);
    let list = out.into_sorted();
    let wrong = list.iter().find(|d| d.code.to_string() == "HSD1141");
    let found = wrong.expect("the field is not there");
    assert!(format!("{found:?}").contains("levels"), "{found:?}");
}

/// Metres without a word about their plane could stand anywhere.
#[test]
fn a_map_without_coordinates_stops_the_town() {
    let csv = "x,y,name\n-21000,-110000,a\n-21010,-110020,b\n";
    let text = |crs: &str| {
        format!(
            r#"<Town><Layer name="places" src="places.csv"{crs}/><for each="places"><Place type="hiraya" on="centre"/></for></Town>"#
        )
    };
    let built = |crs: &str| town(&text(crs), &[("places.csv", csv)]);
    let found = built("");
    assert_eq!((found.found, found.houses), (vec!["HSD1143".to_owned()], 0));
    assert_eq!(built(r#" crs="EPSG:6674""#).houses, 2);
    assert_eq!(built(r#" crs="local""#).houses, 2);
}

#[test]
fn what_cannot_stand_is_refused_with_its_reason() {
    let narrow = small(
        r#"<for each="houses"><Place type="so-nikai" on="plot"/></for>"#,
        &[("n", 0.0, 0.0, 2.0, 9.0)],
    );
    assert_eq!(narrow.found, ["HSD1108"]);
    assert_eq!((&*narrow.rows[0]["what"], narrow.skipped), ("refused", 1));
}

#[test]
fn the_block_of_the_examples_is_built() {
    let folder = PathBuf::from("examples/towns");
    let text = fs::read_to_string(folder.join("block.hsd")).expect("is there");
    let found = in_folder(&text, &folder, |_| {});
    assert_eq!(found.found, [""; 0]);
    assert_eq!((found.features, found.skipped), (17, 1), "all but the shed");
    let row = |key: &str| {
        found
            .rows
            .iter()
            .find(|r| r["key"] == key)
            .expect("is there")
    };
    assert_eq!(
        number(row("n2"), "facing").rem_euclid(360.0),
        0.0,
        "the north side looks north"
    );
    assert_eq!(row("w1")["what"], "outline", "an L");
    assert_eq!(row("e1")["access"], "street");
}
