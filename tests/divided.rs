//! `Divide`: areas divided into blocks, streets and plots, and the Edo that is built on them.

use crate::towns::{Built, in_folder};
use hsd::ast::town::Division;
use hsd::glam::{DVec2, dvec2};
use hsd::town::layer::divide::{Divided, Piece, divide};
use hsd::town::shape::shared;
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The ken of the quarters, metres.
const KEN: f64 = 6.5 * 10.0 / 33.0;

fn rectangle(width: f64, depth: f64) -> Vec<DVec2> {
    [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)]
        .map(|(x, y)| dvec2(x, y))
        .to_vec()
}

fn sum(pieces: &[Piece]) -> f64 {
    pieces.iter().map(Piece::area).sum()
}

/// Blocks and streets are the area, plots and yards the blocks.
fn assert_whole(area: &Piece, divided: &Divided) {
    let near = |a: f64, b: f64, what: &str| {
        assert!((a - b).abs() <= 1e-4 * b + 0.2, "{what}: {a} is not {b}");
    };
    let blocks = sum(&divided.blocks);
    near(blocks + sum(&divided.streets), area.area(), "streets");
    near(sum(&divided.plots) + sum(&divided.yards), blocks, "plots");
}

#[test]
fn a_block_of_40_by_60_ken_has_two_rows_of_12_plots_and_no_yard() {
    let area = Piece::new(&rectangle(60.0 * KEN, 40.0 * KEN), &[]);
    let divided = divide(&area, &Division::default());
    assert_eq!(divided.blocks.len(), 1);
    assert!(divided.streets.is_empty());
    assert_eq!(divided.plots.len(), 24);
    for plot in &divided.plots {
        assert!((plot.area() - 100.0 * KEN * KEN).abs() < 1e-6);
    }
    assert!(sum(&divided.yards) < 1e-6);
}

#[test]
fn a_square_of_60_ken_keeps_its_middle_open() {
    // The block of early Edo and of Kyoto: rows on all sides, and the kaisho-chi of 20 ken square.
    let area = Piece::new(&rectangle(60.0 * KEN, 60.0 * KEN), &[]);
    let uncut = Division {
        deep: 100.0 * KEN,
        ..Division::default()
    };
    let divided = divide(&area, &uncut);
    assert_eq!(divided.plots.len(), 2 * 12 + 2 * 4);
    let [yard] = &divided.yards[..] else {
        panic!("one yard: {:?}", divided.yards);
    };
    assert!((yard.area() - 400.0 * KEN * KEN).abs() < 1e-6);
}

#[test]
fn a_deep_area_is_cut_by_streets_of_their_width() {
    // Three blocks of 60 ken by three of 40, and the streets between them.
    let (long, wide) = (3.0 * 64.0 - 4.0, 3.0 * 44.0 - 4.0);
    let turn = DVec2::from_angle(0.4);
    let ring = rectangle(long * KEN, wide * KEN);
    let ring: Vec<DVec2> = ring.iter().map(|p| turn.rotate(*p)).collect();
    let area = Piece::new(&ring, &[]);
    let divided = divide(&area, &Division::default());
    assert_eq!(divided.blocks.len(), 9);
    for block in &divided.blocks {
        assert!((block.area() - 2400.0 * KEN * KEN).abs() < 0.1);
    }
    assert_eq!(divided.plots.len(), 9 * 24);
    let streets = long * wide - 9.0 * 2400.0;
    assert!((sum(&divided.streets) - streets * KEN * KEN).abs() < 1.0);
    assert_whole(&area, &divided);
}

#[test]
fn a_strip_too_thin_for_two_rows_has_one() {
    let area = Piece::new(&rectangle(100.0, 12.0), &[]);
    let divided = divide(&area, &Division::default());
    assert_eq!(divided.plots.len(), 10);
    assert!(sum(&divided.yards) < 1e-6);
}

/// A quarter with corners at any angle: a star about the origin.
fn star() -> impl Strategy<Value = Vec<DVec2>> {
    prop::collection::vec(25.0..260.0f64, 3..14).prop_map(|ways| {
        let step = std::f64::consts::TAU / ways.len() as f64;
        let corner = |(n, way): (usize, &f64)| DVec2::from_angle(n as f64 * step) * *way;
        ways.iter().enumerate().map(corner).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn nothing_is_lost_and_no_plots_overlap(ring in star(), with_hole in prop::bool::ANY) {
        let fits = ring.len() > 6 && ring.iter().all(|p| p.length() > 60.0);
        let hole = [rectangle(14.0, 9.0)];
        let area = Piece::new(&ring, if with_hole && fits { &hole } else { &[] });
        let divided = divide(&area, &Division::default());
        assert_whole(&area, &divided);
        let parts = divided.plots.iter().chain(&divided.yards).chain(&divided.streets);
        for part in parts {
            prop_assert!(part.area() > 0.0);
        }
        for (n, one) in divided.plots.iter().enumerate() {
            for two in &divided.plots[..n] {
                prop_assert!(shared(&one.ring, &two.ring) < 0.05);
            }
        }
    }
}

fn example(name: &str) -> String {
    example_file(&format!("{name}.hsd"))
}

fn example_file(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/towns");
    fs::read_to_string(folder.join(name)).expect("can be read")
}

/// Evaluates a text beside the maps of the examples.
fn beside_examples(text: &str) -> Built {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/towns");
    in_folder(text, &folder, |_| {})
}

/// The lines of the table for plots with shops.
fn shops(built: &Built) -> BTreeSet<String> {
    let shops = built.rows.iter().filter(|row| row["what"] == "plot");
    shops.map(|row| format!("{row:?}")).collect()
}

#[test]
fn the_example_has_two_shops_a_plot_and_the_same_ones_at_any_density() {
    let built = beside_examples(&example("edo-1850"));
    assert_eq!(built.features, built.built + built.skipped);
    let rears = |built: &Built| {
        built
            .rows
            .iter()
            .filter(|row| row["what"] == "rear")
            .count()
    };
    let (plots, street) = (shops(&built).len(), built.houses - rears(&built));
    assert!(
        plots > 60 && street > plots * 8 / 5,
        "{street} shops on {plots} plots"
    );
    let denser =
        beside_examples(&example("edo-1850").replace(r#"default="0.11""#, r#"default="0.8""#));
    assert!(rears(&denser) > rears(&built) + 50);
    assert_eq!(denser.houses - rears(&denser), street);
    assert_eq!(shops(&built), shops(&denser));
}

#[test]
fn a_place_of_kyoto_keeps_its_house_over_all_dates() {
    let at = |year: &str| {
        let text = example("kyoto");
        let with = text.replace(r#"default="1928""#, &format!(r#"default="{year}""#));
        assert!(year == "1928" || with != text);
        beside_examples(&with)
    };
    let [early, middle, late] = ["1912", "1928", "1998"].map(at);
    assert_eq!(early.rows.len(), late.rows.len());
    let (mut kept, mut changed) = (0, 0);
    for ((one, two), three) in early.rows.iter().zip(&middle.rows).zip(&late.rows) {
        if one["layer"] != "houses" {
            continue;
        }
        assert_eq!(one, two);
        if one["type"] == three["type"] {
            assert_eq!(one, three);
            kept += 1;
        } else {
            assert_eq!((&*one["type"], &*three["type"]), ("chu-nikai", "kanban"));
            changed += 1;
        }
    }
    assert_eq!((kept, changed), (11, 4));
}

#[test]
fn lots_of_1912_bear_no_fronts_of_mortar_and_have_more_behind_them_the_deeper_they_are() {
    let built = beside_examples(&example("kyoto-taisho"));
    assert_eq!(built.features, built.built + built.skipped);
    let of = |what: &'static str| built.rows.iter().filter(move |row| row["what"] == what);
    let kinds: BTreeSet<&str> = of("plot").map(|row| &*row["type"]).collect();
    assert!(kinds.contains("chu-nikai") && !kinds.contains("kanban"));
    assert!(of("rear").count() > 0, "{}", built.houses);
    let asphalt = of("built").filter(|row| row["parameters"].contains("asphalt"));
    assert_eq!(asphalt.count(), 0);
    // The share of the fronts of mortar of 1998 belongs to the chu-nikai behind them.
    let shares = example_file("kyoto-shares.csv");
    let rows: Vec<Vec<&str>> = shares.lines().map(|l| l.split(',').collect()).collect();
    let share = |year: &str, kind: &str| -> f64 {
        let column = rows[0].iter().position(|name| *name == kind);
        let row = rows.iter().find(|row| row[0] == year).expect("a year");
        row[column.expect("a type")].parse().expect("a number")
    };
    let late = share("1998", "chu-nikai") + share("1998", "kanban");
    assert!((share("1912", "chu-nikai") - late).abs() < 0.11);
    assert!(share("1912", "kanban") < 1e-9);
}

#[test]
fn heian_has_residences_by_rank_and_plots_of_the_people() {
    let built = beside_examples(&example("heian"));
    assert_eq!(built.features, built.built + built.skipped);
    let count = |layer: &str, kind: &str| {
        let rows = built.rows.iter();
        rows.filter(|row| row["layer"] == layer && row["type"] == kind)
            .count()
    };
    assert_eq!(count("whole", "shinden"), 2);
    assert_eq!(count("halves", "shinden"), 2);
    assert_eq!(count("quarters", "hondo"), 4);
    // Plots in the middle of the longer sides of two blocks; 32 each where all are laid out.
    assert!(count("plots", "ura-nagaya") >= 40);
    assert!(built.told.is_empty(), "{:?}", built.told);
}

#[test]
fn what_is_wrong_with_a_division_is_told() {
    let text = example("edo-1850").replace(
        r#"<Divide layer="quarters"/>"#,
        r#"<Divide layer="quartets" street="40"/>"#,
    );
    let built = beside_examples(&text);
    let told: Vec<&str> = built
        .told
        .iter()
        .map(|[code, place, _]| {
            assert!(!code.is_empty());
            place.as_str()
        })
        .collect();
    assert!(
        told.iter().any(|place| place.contains("quartets")),
        "{told:?}"
    );
    assert!(told.iter().any(|place| place.contains("40")), "{told:?}");
}

#[test]
fn an_area_of_too_many_plots_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let square = r#"{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[6000,0],[6000,6000],[0,6000],[0,0]]]}}"#;
    fs::write(folder.path().join("wide.geojsonl"), square).expect("is written");
    let town = r#"<Town seed="1"><Layer name="wide" src="wide.geojsonl" crs="local"/><Divide layer="wide" frontage="2" depth="2"/>
        <for each="plots"><Skip because="counted"/></for></Town>"#;
    let built = in_folder(town, folder.path(), |_| {});
    let told = built.told.iter().find(|[code, ..]| code == "HSD1013");
    let [_, _, message] = told.expect("is told");
    assert!(message.contains("more than 2000000 plots"), "{message}");
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn all_quarters_of_edo_become_plots() {
    let data = std::env::var_os("HSD_DATA").map(std::path::PathBuf::from);
    let data = data.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"));
    let text = fs::read(data.join("edo_codh/edo-machiya-areas.geojson")).expect("is there");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("edo.geojson"), text).expect("is written");
    let town = r#"<Town seed="1"><Layer name="quarters" src="edo.geojson"/><Divide layer="quarters"/>
        <for each="plots"><Skip because="counted"/></for><for each="blocks"><Skip because="counted"/></for></Town>"#;
    let mut plots = (0, 0.0, 0.0);
    let built = in_folder(town, folder.path(), |plan| {
        let area = |name: &str| -> (usize, f64) {
            let of = plan
                .layers
                .iter()
                .find(|l| l.layer.name.value == name)
                .expect("a layer");
            let areas = of.lots.iter().map(|lot| {
                let hsd::town::layer::Shape::Area(ring, holes) = &lot.shape else {
                    return 0.0;
                };
                hsd::town::shape::area(ring, holes)
            });
            (of.lots.len(), areas.sum())
        };
        let parts = area("blocks").1 + area("streets").1;
        plots = (area("plots").0, area("plots").1, parts);
    });
    let (count, planted, whole) = plots;
    // A prototype of the contract got 42,602 plots on 80 % of 1,359 ha.
    assert!(count > 42_000, "{count} plots");
    assert!((13.5e6..13.7e6).contains(&whole), "{whole} m2");
    assert!(planted > 0.8 * whole, "{planted} of {whole} m2");
    assert_eq!(built.features, built.built + built.skipped);
}
