//! Random towns: every feature is accounted for, and every wall is on its outline.

use glam::{DVec2, dvec2};
use hsd::ast;
use hsd::diagnostic::{Diagnostics, Origin};
use hsd::driver::fs::FolderWorld;
use hsd::driver::{FeatureHouse, HouseBuilder, HouseContext, HouseId, Options};
use hsd::source::{FileId, Source};
use hsd::town::stream::TownStream;
use hsd::town::{TownInput, TownReport, run, shape};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::{env, fs};

/// Towns of a run; a thorough run has five times as many.
const TOWNS: u64 = 300;

/// Distance of a wall from the hull of its outline, metres.
const OFF: f64 = 0.5;

/// Types with walls on an outline or a plot. One that is too large for its plot makes way for plain walls.
const TYPES: [&str; 19] = [
    "hiraya",
    "so-nikai",
    "chu-nikai",
    "sangai",
    "kanban",
    "shimotaya",
    "hei-tsuki",
    "ura-nagaya",
    "buke-nagaya",
    "kura",
    "hondo",
    "temple",
    "block",
    "house",
    "shop-row",
    "school",
    "hospital",
    "office",
    "modern-house",
];

/// Numbers that follow from a seed (splitmix64).
struct Draws(u64);

impl Draws {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed >> 33) as usize % count
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.below(10_001) as f64 / 10_000.0
    }

    fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// Returns a ring of one of several kinds round the origin: rectangles, forms of letters, crossed, thin and ragged ones.
fn ring(draws: &mut Draws) -> Vec<DVec2> {
    let (w, d) = (draws.between(3.0, 24.0), draws.between(3.0, 24.0));
    let (a, b) = (draws.between(0.25, 0.75) * w, draws.between(0.25, 0.75) * d);
    let points = match draws.below(9) {
        0..=2 => vec![(0.0, 0.0), (w, 0.0), (w, d), (0.0, d)],
        3 => vec![(0.0, 0.0), (w, 0.0), (w, b), (a, b), (a, d), (0.0, d)],
        4 => vec![(0.0, 0.0), (a, 0.0), (a, -b), (w, -b), (w, d), (0.0, d)],
        5 => vec![(0.0, 0.0), (w, d), (w, 0.0), (0.0, d + 0.01)],
        6 => vec![(0.0, 0.0), (w, 0.0), (w, 0.02), (0.0, 0.01)],
        7 => vec![
            (0.0, 0.0),
            (w, b / 3.0),
            (w - a / 3.0, d),
            (a / 4.0, d - b / 3.0),
        ],
        _ => {
            let corner = |k: usize| {
                let (sin, cos) = (k as f64 * std::f64::consts::TAU / 11.0).sin_cos();
                (w * cos, d * sin)
            };
            (0..11).map(corner).collect()
        }
    };
    let turn = DVec2::from_angle(draws.one_of(&[0.0, 0.0, 0.3, 1.1, 2.0]));
    let points = points.into_iter().map(|(x, y)| turn.rotate(dvec2(x, y)));
    points.collect()
}

/// Returns features with the rings on which houses may be, by key.
fn features(draws: &mut Draws) -> (Vec<String>, BTreeMap<String, Vec<DVec2>>) {
    let (mut list, mut rings) = (vec![], BTreeMap::<String, Vec<DVec2>>::new());
    for key in (0..1 + draws.below(9)).map(|n| format!("f{n}")) {
        let at = dvec2(draws.between(0.0, 90.0), draws.between(0.0, 90.0));
        let last = rings.values().next_back().cloned();
        let own: Vec<DVec2> = match (draws.below(8), last) {
            (0, Some(last)) => last,
            (1, Some(last)) => {
                let middle = last.iter().sum::<DVec2>() / last.len() as f64;
                last.iter().map(|p| middle.lerp(*p, 0.4)).collect()
            }
            _ => ring(draws).iter().map(|p| *p + at).collect(),
        };
        let corners = own.iter().chain(own.first());
        let corners: Vec<String> = corners.map(|p| format!("[{},{}]", p.x, p.y)).collect();
        let corners = corners.join(",");
        list.push(match draws.below(12) {
            0 => format!(r#"{{"type":"Feature","properties":{{"key":"{key}"}},"geometry":null}}"#),
            1 => format!(
                r#"{{"type":"Feature","properties":{{"key":"{key}"}},"geometry":{{"type":"Point","coordinates":[{},1e22]}}}}"#,
                at.x
            ),
            _ => format!(
                r#"{{"type":"Feature","properties":{{"key":"{key}","levels":"{}"}},"geometry":{{"type":"Polygon","coordinates":[[{corners}]]}}}}"#,
                draws.one_of(&["1", "3", "unknown"])
            ),
        });
        rings.insert(key, own);
    }
    (list, rings)
}

/// Returns the distance of a place from the hull of a ring; 0 inside of it.
fn off(hull: &[DVec2], place: DVec2) -> f64 {
    match shape::contains(hull, place) {
        true => 0.0,
        false => shape::sides(hull)
            .map(|side| side.nearest(place).distance(place))
            .fold(f64::MAX, f64::min),
    }
}

/// Builds a town; returns its report and what is wrong with its walls.
fn build(
    text: &str,
    map: &str,
    rings: &BTreeMap<String, Vec<DVec2>>,
) -> (Option<TownReport>, Vec<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.geojson"), map).expect("is written");
    let name = folder.path().join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.path().to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let mut read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let town = read.documents.iter_mut().find_map(|d| d.town.take());
    let input = TownInput::new(&source, &world, &options);
    let Some(plan) = run::plan(input, &town.expect("is a town"), &mut out) else {
        return (None, vec![]);
    };
    let mut builder = HouseBuilder::new(&read.catalog, &world, &options.expand);
    let mut stream = TownStream::new(input, &plan);
    let mut wrong = vec![];
    for house in stream.by_ref() {
        let FeatureHouse {
            house,
            origin,
            plain,
            within,
            ..
        } = house;
        let Origin::Feature { key, .. } = origin else {
            continue;
        };
        let mut far = |house: &ast::House| {
            let context = HouseContext {
                source: &source,
                scope: read.catalog.known_in(0, 0),
                variant: None,
            };
            let built = builder.house(house, HouseId(0), context, &mut out)?;
            let hull = shape::hull(&rings[&*key]);
            let house = &built.house;
            let rings = house.storeys.iter().flat_map(|storey| &storey.rings);
            let walls = rings
                .filter(|ring| ring.closed)
                .flat_map(|ring| &ring.walls);
            let off = walls.map(|wall| off(&hull, house.world(wall.from)));
            Some(off.fold(0.0, f64::max))
        };
        let Some(far) = far(&house).map(|own| match plain.filter(|_| within.is_some()) {
            // Plain walls replace a house that leaves its plot.
            Some(plain) if own > OFF => far(&plain).unwrap_or(0.0),
            _ => own,
        }) else {
            continue;
        };
        if far > OFF {
            wrong.push(format!("{key}: a wall is {far:.2} m off its outline"));
        }
    }
    let (ledger, _) = stream.finish(&mut out);
    (Some(ledger.report), wrong)
}

#[test]
fn features_are_accounted_for_and_walls_are_on_their_outlines() {
    let factor = env::var("HSD_INPUTS").ok().and_then(|n| n.parse().ok());
    let (mut built, mut skipped) = (0, 0);
    for seed in 0..TOWNS * factor.unwrap_or(1) {
        let mut draws = Draws(seed);
        let (features, rings) = features(&mut draws);
        let map = features.join(",");
        let map = format!(r#"{{"type":"FeatureCollection","features":[{map}]}}"#);
        let mut text = format!(
            r#"<Town seed="{seed}"><Layer name="a" src="a.geojson" crs="local" key="key"><Field name="n" from="levels" type="number" default="2"/></Layer>"#
        );
        for test in ["area > 60", "not (area > 60)"] {
            let kind = draws.one_of(&TYPES);
            let on = draws.one_of(&["", r#" on="outline""#, r#" on="plot""#]);
            let test = test.replace('>', "&gt;");
            let _ = write!(
                text,
                r#"<for each="a" test="{{{test}}}"><Place type="{kind}"{on}/></for>"#
            );
        }
        text.push_str("</Town>");
        let (report, wrong) = build(&text, &map, &rings);
        assert!(wrong.is_empty(), "seed {seed}: {wrong:?}\n{text}\n{map}");
        let Some(report) = report else { continue };
        let sum = report.built + report.skipped.len() + report.unused;
        assert_eq!(report.features, sum, "seed {seed}: {text}\n{map}");
        assert_eq!(
            report.features,
            features.len(),
            "seed {seed}: {text}\n{map}"
        );
        (built, skipped) = (built + report.built, skipped + report.skipped.len());
    }
    assert!(
        built > 100 && skipped > 30,
        "{built} built, {skipped} skipped"
    );
}
