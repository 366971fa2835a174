//! Towns over real maps, which lie beside the repository; `HSD_DATA=FOLDER cargo test --release real_towns --
//! --include-ignored` reads them from elsewhere.

use crate::support::root;
use crate::towns::{Built, in_folder, number};
use glam::{DVec2, dvec2};
use hsd::glam;
use hsd::town::layer::Shape;
use hsd::town::plan::Plan;
use hsd::town::shape::shared;
use std::path::PathBuf;

/// How far a street is looked for, metres.
const FAR: f64 = 30.0;
/// The greatest angle between a front and the way to its street, degrees.
const LOOKS: f64 = 30.0;
/// The length of outline from which a street house sees its street, metres, and the distance of the places that look.
const SEEN: f64 = 1.8;
const STEP: f64 = 0.3;
/// The area that houses may share beyond what their outlines do, square metres: the tables round to millimetres.
const SHARED: f64 = 0.3;
/// Of an outline drawn inside another one, a rectangle may be larger than its outline by so much.
const INSIDE: f64 = 1.05;

/// A straight piece of a street: its ends and half its width.
type Street = (DVec2, DVec2, f64);

/// What the oracle finds in a town.
#[derive(Default)]
struct Fronts {
    /// Houses from which a street is seen.
    houses: usize,
    /// Those that look at the nearest one from the edge nearest to it.
    right: usize,
    /// The others: corner houses, those that the tables say see no street from 1.8 m, and the rest.
    others: [usize; 3],
}

impl Fronts {
    fn share(&self) -> f64 {
        100.0 * self.right as f64 / self.houses as f64
    }
}

fn data(folder: &str) -> PathBuf {
    let data = std::env::var_os("HSD_DATA").map(PathBuf::from);
    data.unwrap_or_else(|| root().join("../shared/data"))
        .join(folder)
}

/// Builds a house on every feature of a layer.
fn everywhere(folder: &str, layers: &str, look: impl FnOnce(&Plan)) -> Built {
    let text = format!(
        r#"<Town seed="1998">{layers}<for each="houses"><Place type="so-nikai"/></for></Town>"#
    );
    in_folder(&text, &data(folder), look)
}

/// Returns the rings of the first layer and the streets of the second, by the classes of OpenStreetMap.
fn geometry(plan: &Plan) -> (Vec<Vec<DVec2>>, Vec<Street>) {
    let rings = plan.layers[0].lots.iter();
    let rings = rings
        .map(|l| l.shape.ring().unwrap_or_default().to_vec())
        .collect();
    let mut streets = vec![];
    for lot in plan.layers.get(1).iter().flat_map(|l| &l.lots) {
        let class = plan.layers[1].word(lot, "highway").unwrap_or_default();
        let half = match class.trim_end_matches("_link") {
            "trunk" => 14.0,
            "primary" | "secondary" => 11.5,
            "tertiary" => 7.5,
            "unclassified" => 3.0,
            "residential" | "living_street" | "pedestrian" => 2.0,
            "service" => 1.25,
            _ => continue,
        };
        let own = plan.layers[1].number(lot, "width").map(|w| w / 2.0);
        if let Shape::Lines(lines) = &lot.shape {
            for ends in lines.iter().flat_map(|l| l.windows(2)) {
                streets.push((ends[0], ends[1], own.unwrap_or(half)));
            }
        }
    }
    (rings, streets)
}

/// Measures which houses look at the nearest street that they see, from the edge nearest to it, within 30 degrees.
///
/// The oracle samples outlines and tests sight lines by itself; it shares only the street layer with the placing. It takes
/// three things from the contract: a street house sees a street from 1.8 m of its outline (else its access is `rear`); of
/// places that lie in one street, as wide as its class says, the one nearest to its line counts; and a house that stands
/// askew to its street, with no wall within 30 degrees of the way, looks at it if its front is the edge nearest to it.
fn fronts(built: &Built, rings: &[Vec<DVec2>], streets: &[Street]) -> Fronts {
    let mut found = Fronts::default();
    for (at, row) in built.rows.iter().enumerate() {
        if row["what"] != "plot" && row["what"] != "outline" {
            continue;
        }
        let Some((way, edge)) = nearest_seen(rings, at, streets) else {
            continue;
        };
        found.houses += 1;
        let facing = number(row, "facing").to_radians();
        let off = |to: DVec2| {
            dvec2(facing.sin(), facing.cos())
                .angle_to(to)
                .abs()
                .to_degrees()
        };
        let walls = edges(&rings[at]).filter(|(p, q)| p.distance(*q) >= 0.9);
        let askew = walls
            .map(|(p, q)| outward(p, q).angle_to(way).abs().to_degrees())
            .all(|off| off > LOOKS);
        if off(way) <= LOOKS || askew && off(edge) <= LOOKS {
            found.right += 1;
        } else {
            let kind = match (&*row["corner"], &*row["access"]) {
                ("yes", _) => 0,
                (_, "rear") => 1,
                _ => 2,
            };
            found.others[kind] += 1;
        }
    }
    found
}

fn edges(ring: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    (0..ring.len()).map(|n| (ring[n], ring[(n + 1) % ring.len()]))
}

fn outward(p: DVec2, q: DVec2) -> DVec2 {
    dvec2(q.y - p.y, p.x - q.x).normalize_or_zero()
}

/// Returns the way from an outline to the nearest street that is seen from it, and the normal of the edge that sees it;
/// `None` if it sees none within 30 m from 1.8 m of its length.
fn nearest_seen(rings: &[Vec<DVec2>], own: usize, streets: &[Street]) -> Option<(DVec2, DVec2)> {
    let ring = &rings[own];
    let first = *ring.first()?;
    let near: Vec<&Vec<DVec2>> = rings
        .iter()
        .enumerate()
        .filter(|(n, r)| *n != own && r.first().is_some_and(|p| p.distance(first) < 120.0))
        .map(|(_, r)| r)
        .collect();
    let close = |s: &&Street| foot(s.0, s.1, first).distance(first) < 100.0;
    let streets: Vec<_> = streets.iter().filter(close).collect();
    let mut best: Option<((f64, f64), DVec2, DVec2)> = None;
    let (mut run, mut longest) = (0.0f64, 0.0f64);
    // Twice round, so that a stretch over the first corner counts as one.
    for (p, q) in edges(ring).chain(edges(ring)) {
        let normal = outward(p, q);
        let steps = (p.distance(q) / STEP).ceil().max(1.0) as usize;
        for step in 0..steps {
            let eye = p.lerp(q, (step as f64 + 0.5) / steps as f64);
            let mut sees = false;
            for (a, b, half) in &streets {
                let way = foot(*a, *b, eye) - eye;
                let gap = (way.length() - half).max(0.0);
                if gap > FAR || way.dot(normal) <= 0.0 {
                    continue;
                }
                let far = (gap, way.length());
                let better = best.is_none_or(|(least, ..)| far < least);
                if sees && !better {
                    continue;
                }
                let end = eye + way.normalize_or_zero() * gap;
                if !near.iter().any(|r| crosses(r, eye + normal * 0.05, end)) {
                    sees = true;
                    if better {
                        best = Some((far, way, normal));
                    }
                }
            }
            run = if sees {
                run + p.distance(q) / steps as f64
            } else {
                0.0
            };
            longest = longest.max(run);
        }
    }
    best.filter(|_| longest >= SEEN)
        .map(|(_, way, normal)| (way, normal))
}

fn foot(a: DVec2, b: DVec2, p: DVec2) -> DVec2 {
    let way = b - a;
    let square = way.length_squared();
    let share = if square > 0.0 {
        (p - a).dot(way) / square
    } else {
        0.0
    };
    a + way * share.clamp(0.0, 1.0)
}

fn crosses(ring: &[DVec2], from: DVec2, to: DVec2) -> bool {
    let side = |a: DVec2, b: DVec2, p: DVec2| (b - a).perp_dot(p - a);
    edges(ring).any(|(p, q)| {
        side(p, q, from) * side(p, q, to) < 0.0 && side(from, to, p) * side(from, to, q) < 0.0
    })
}

/// Returns pairs of rectangles that share more than their outlines do.
fn overlaps(built: &Built, rings: &[Vec<DVec2>]) -> Vec<(String, String, f64)> {
    let mut placed: Vec<(usize, [DVec2; 4])> = vec![];
    for (at, row) in built.rows.iter().enumerate() {
        if row["what"] != "plot" {
            continue;
        }
        let end = |n: u8| {
            dvec2(
                number(row, &format!("front_x{n}")),
                number(row, &format!("front_y{n}")),
            )
        };
        let (p, q) = (end(1), end(2));
        let back = -outward(p, q) * number(row, "depth");
        placed.push((at, [p, q, q + back, p + back]));
    }
    let mut found = vec![];
    for (n, (one, a)) in placed.iter().enumerate() {
        for (two, b) in &placed[..n] {
            if a[0].distance(b[0]) > 100.0 {
                continue;
            }
            let both = shared(a, b);
            let before = shared(&rings[*one], &rings[*two]);
            if both > before * INSIDE + SHARED {
                let key = |n: usize| built.rows[n]["key"].clone();
                found.push((key(*one), key(*two), both));
            }
        }
    }
    found
}

fn share_of(built: &Built, is: impl Fn(&Row) -> bool) -> f64 {
    let count = built.rows.iter().filter(|r| is(r)).count();
    100.0 * count as f64 / built.rows.len() as f64
}

type Row = std::collections::BTreeMap<String, String>;

/// Prints what is known of a town, and asserts what holds for all.
fn counted(name: &str, built: &Built, rings: &[Vec<DVec2>]) {
    assert_eq!(built.features, built.built + built.skipped, "{name}");
    assert_eq!(built.features, built.rows.len(), "{name}");
    assert_eq!(overlaps(built, rings), [], "{name}");
    let iou: Vec<f64> = built
        .rows
        .iter()
        .filter_map(|r| r["iou"].parse().ok())
        .collect();
    println!(
        "{name}: {} features, {} built; {:.1} % outlines, {:.1} % corner houses, {:.1} % through, {:.1} % rear; mean iou {:.3}",
        built.features,
        built.built,
        share_of(built, |r| r["what"] == "outline"),
        share_of(built, |r| r["corner"] == "yes"),
        share_of(built, |r| r["measures"].contains("through=yes")),
        share_of(built, |r| r["access"] == "rear"),
        iou.iter().sum::<f64>() / iou.len().max(1) as f64,
    );
}

const OSM: &str =
    r#"<Layer name="houses" src="buildings.geojson"/><Layer name="roads" src="roads.geojson"/>"#;

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn fronts_of_kyoto_look_at_the_street() {
    let mut parts = (vec![], vec![]);
    let built = everywhere("osm_kyoto_route18", OSM, |plan| parts = geometry(plan));
    counted("Kyoto", &built, &parts.0);
    let found = fronts(&built, &parts.0, &parts.1);
    let (right, houses, share) = (found.right, found.houses, found.share());
    let [corner, rear, rest] = found.others;
    println!(
        "{right} of {houses} street houses look at the street: {share:.1} %; of the others {corner} stand at corners, {rear} at the rear, {rest} elsewhere"
    );
    assert_eq!((built.features, houses > 1600), (1771, true));
    assert!(share >= 92.0, "{right} of {houses}: {share:.1} %");
    let corners = share_of(&built, |r| r["corner"] == "yes");
    assert!((12.0..=25.0).contains(&corners), "{corners:.1} %");
    let through = share_of(&built, |r| r["measures"].contains("through=yes"));
    assert!((5.0..=7.0).contains(&through), "{through:.1} %");
}

/// Narrow lanes that the map calls footways are no streets: more houses than in Kyoto see none.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn fronts_of_asakusa_look_at_the_street() {
    let mut parts = (vec![], vec![]);
    let built = everywhere("osm_tokyo_asakusa", OSM, |plan| parts = geometry(plan));
    counted("Asakusa", &built, &parts.0);
    let found = fronts(&built, &parts.0, &parts.1);
    let (right, houses, share) = (found.right, found.houses, found.share());
    println!("{right} of {houses} street houses look at the street: {share:.1} %");
    assert_eq!((built.features, houses > 1200), (1489, true));
    assert!(share >= 88.0, "{right} of {houses}: {share:.1} %");
}

/// A Shapefile in CP932 without a .cpg, and no streets at hand.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn houses_of_yanaka_stand_without_streets() {
    let layers = r#"<Layer name="houses" src="shapefile_cp932/tatemono.shp" encoding="cp932"/>"#;
    let mut parts = (vec![], vec![]);
    let built = everywhere("plateau_tokyo_yanaka", layers, |plan| {
        parts = geometry(plan)
    });
    counted("Yanaka", &built, &parts.0);
    assert_eq!(built.features, 1307);
    assert!(built.built >= 1270, "{}", built.built);
    assert!(built.found.contains(&"HSD1110".to_owned()), "no streets");
    assert!(built.rows.iter().all(|r| r["access"] == "none"));
}

/// Lots of the land registry: as a Shapefile in CP932, as GeoJSON, and as the registry's own XML.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn houses_stand_on_lots_of_the_registry() {
    let layer = |src: &str| format!(r#"<Layer name="houses" src="{src}"/>"#);
    let mut parts = (vec![], vec![]);
    let maps = [
        ("joetsu_shapefile_cp932/fude.shp", 541, 520),
        ("joetsu_15222.geojson", 541, 520),
        ("12103-0400-76.xml", 1, 1),
    ];
    for (src, features, least) in maps {
        let built = everywhere("moj_parcels", &layer(src), |plan| parts = geometry(plan));
        counted(src, &built, &parts.0);
        assert_eq!(built.features, features, "{src}");
        assert!(built.built >= least, "{src}: {}", built.built);
    }
}
