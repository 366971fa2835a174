//! Closed bays are closed: no line of sight from outside leads through a part into the house, in any width and height and
//! between any columns.

use crate::support::depths::{Triangle, skins_below, skins_of};
use crate::support::{assert_none, compile, on_all_processors};
use glam::{DVec2, dvec2};
use hsd::catalog::PartDef;
use hsd::geometry::SHAKU;
use hsd::scene::{Detail, Kind, NodeId, Scene};

/// Lines of sight through less than this are no gap: lengths are rounded to tenths of a millimetre, metres.
const ROUNDED: f64 = 3e-4;

/// A front of three bays of one part: width and height of a bay and thickness of the columns in shaku; columns of zero are
/// the usual posts.
#[derive(Clone, Copy, Debug)]
struct Front {
    bay: f64,
    height: f64,
    post: f64,
    round: bool,
}

/// From a small house to Suzakumon and beyond.
const FRONTS: [Front; 6] = [
    front(3.0, 9.5, 0.0, false),
    front(3.15, 8.0, 0.0, false),
    front(5.0, 11.0, 0.6, false),
    front(9.0, 13.0, 1.2, true),
    front(17.0, 18.0, 2.3, true),
    front(30.0, 24.0, 2.0, false),
];

const fn front(bay: f64, height: f64, post: f64, round: bool) -> Front {
    Front {
        bay,
        height,
        post,
        round,
    }
}

/// Parts that stand open, the transom above doors within the house, and fences, which have no house behind them: every other
/// part closes its bay.
const OPEN: [&str; 34] = [
    "AKI  ", "AKI 2", "ANO  ", "ANL  ", "ANM  ", "ATN  ", "AFU  ", "TFR 2", "KTB  ", "KDB  ",
    "KIB  ", "KTBS ", "KIK  ", "KTK  ", "KTG  ", "OTO  ", "OTB  ", "OTI  ", "OID 2", "OMA 4",
    "OKI 4", "OSE 2", "OTN  ", "OKS 2", "ORI 4", "OKA 4", "OKB 4", "OKD 4", "OMU 4", "OYK 4",
    "OKR 4", "OSK 4", "OMH 4", "OKN 2",
];

#[test]
fn the_catalogue_knows_which_parts_close_their_bays() {
    let wide = hsd::parse::builtin()
        .parts()
        .iter()
        .filter(|p| p.width() > 0.0 && p.class() != ' ');
    let open: Vec<&str> = wide.filter(|p| !p.closes()).map(PartDef::code).collect();
    let sorted = |codes: &[&str]| {
        codes
            .iter()
            .map(|c| (*c).to_owned())
            .collect::<std::collections::BTreeSet<_>>()
    };
    assert_eq!(sorted(&open), sorted(&OPEN));
}

/// Parts that close their bay.
fn closed() -> Vec<&'static PartDef> {
    let parts = hsd::parse::builtin().parts().iter();
    let closes = |p: &&PartDef| p.class() != ' ' && p.width() > 0.0 && !OPEN.contains(&p.code());
    parts.filter(closes).collect()
}

fn scene(part: &PartDef, front: Front, detail: Detail) -> Scene {
    let code = part.code().replace(' ', "&#32;");
    let unit = front.bay / part.width();
    let round = if front.round { "yes" } else { "no" };
    let posts = match front.post {
        0.0 => String::new(),
        size => {
            format!("<Posts size=\"{size}\" round=\"{round}\" paint=\"hinoki\" nageshi=\"0\"/>")
        }
    };
    let wall =
        |code: &str| format!("<Row><repeat num=\"3\"><Part code=\"{code}\"/></repeat></Row>");
    let side = "<Row><Part code=\"KSK\"/><Part code=\"KSK\"/></Row>";
    let back = match part.width() {
        w if w < 1.0 => wall(&code),
        w => format!(
            "<Row><repeat num=\"{}\"><Part code=\"KSK\"/></repeat></Row>",
            3.0 * w
        ),
    };
    let text = format!(
        "<House unit=\"{unit}\">{posts}<Storey height=\"{}\">{}{side}{back}{side}</Storey>\
         <Roofs mode=\"explicit\"/></House>",
        front.height,
        wall(&code),
    );
    let run = compile("front.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{text}{}", run.short());
    hsd::driver::scene(&run.building, &run.catalog, detail)
}

/// Where level lines of sight in a plane pass between the segments: the first gap, as a place along the front.
pub fn gap(segments: &[[DVec2; 2]], angle: f64, (from, to): (f64, f64)) -> Option<(f64, f64)> {
    let across = dvec2(angle.cos(), angle.sin());
    let seen = |p: DVec2| p.dot(across);
    let mut shadows: Vec<(f64, f64)> = segments
        .iter()
        .map(|[p, q]| (seen(*p).min(seen(*q)), seen(*p).max(seen(*q))))
        .collect();
    shadows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (from, to) = (from * across.x, to * across.x);
    let mut dark = f64::NEG_INFINITY;
    for (lo, hi) in shadows.into_iter().chain([(to, to)]) {
        let (a, b) = (dark.max(from), lo.min(to));
        if b - a > ROUNDED {
            return Some((a / across.x, b / across.x));
        }
        dark = dark.max(hi);
    }
    None
}

/// The cut of a triangle with the level plane at a height.
pub fn cut(t: &Triangle, z: f64) -> Option<[DVec2; 2]> {
    let mut ends = vec![];
    for k in 0..3 {
        let (p, q) = (t[k], t[(k + 1) % 3]);
        if (p.z > z) != (q.z > z) {
            ends.push(p.lerp(q, (z - p.z) / (q.z - p.z)).truncate());
        }
    }
    <[DVec2; 2]>::try_from(ends).ok()
}

fn gaps(scene: &Scene, front: Front) -> Vec<String> {
    let facade = scene.nodes.iter().position(|n| n.kind == Kind::Facade);
    let facade = NodeId(facade.expect("a facade") as u32);
    let root = &scene.nodes[facade.0 as usize];
    assert_eq!(root.name, "facade 1");
    let triangles: Vec<Triangle> = skins_below(scene, facade)
        .into_iter()
        .map(|s| s.0)
        .collect();
    let (bay, high) = (front.bay * SHAKU, front.height * SHAKU);
    // In the facade's frame x runs from minus its length to zero.
    let middle = (-2.0 * bay, -bay);
    let mut found = vec![];
    for step in 0..40 {
        let z = 0.0531 + (high - 0.25 - 0.0531) * f64::from(step) / 39.0;
        let segments: Vec<[DVec2; 2]> = triangles.iter().filter_map(|t| cut(t, z)).collect();
        for angle in [0.0, 0.13, -0.13, 0.41, -0.41, 0.86, -0.86] {
            if let Some((a, b)) = gap(&segments, angle, middle) {
                let mm = |x: f64| ((x - middle.0) * 1000.0).round();
                found.push(format!(
                    "at height {z:.3}, {} to {} mm, {angle}",
                    mm(a),
                    mm(b)
                ));
            }
        }
    }
    found
}

#[test]
fn one_does_not_see_through_closed_bays() {
    let parts = closed();
    let thorough = crate::support::thorough();
    let findings = on_all_processors(parts.len(), |i| {
        let mut found = vec![];
        for (index, front) in FRONTS.into_iter().enumerate() {
            // Of six fronts each part is in two, its neighbours in others.
            if !thorough && (index + i) % 3 != 0 {
                continue;
            }
            // Joinery of less detail are images, which take long to bake: every second front has them.
            let images = if index % 2 == 0 {
                &[Detail::Openings, Detail::Flat][..]
            } else {
                &[]
            };
            for &detail in [Detail::Everything].iter().chain(images) {
                let gaps = gaps(&scene(parts[i], front, detail), front);
                let here = format!("{} in {front:?} at {detail:?}", parts[i].code());
                found.extend(
                    gaps.iter()
                        .take(1)
                        .map(|g| format!("{here}: {} such, {g}", gaps.len())),
                );
            }
        }
        found
    });
    assert_none(&findings);
}

/// Gates whose leaves are boards from post to post.
const GATES: [&str; 5] = ["OKB 4", "OMU 4", "OYK 4", "OKR 4", "OSK 4"];

#[test]
fn one_does_not_see_through_the_leaves_of_gates() {
    assert_none(&on_all_processors(GATES.len(), |index| {
        let code = GATES[index];
        let mut found = vec![];
        for (width, height) in [(3.5, 13.0), (4.0, 15.0), (6.0, 18.0)] {
            let text = format!(
                "<House><Put code=\"{code}\" at=\"0 0\" width=\"{width}\" height=\"{height}\"/></House>"
            );
            let run = compile("gate.hsd", text.as_bytes());
            assert!(!run.has_errors(), "{text}{}", run.short());
            let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Everything);
            let own: Vec<Triangle> = skins_of(&scene).into_iter().map(|s| s.0).collect();
            // Between the middles of its great posts.
            let half = width * 3.0 * SHAKU * 0.33;
            for z in [0.5, 1.5, 2.0] {
                let segments: Vec<[DVec2; 2]> = own.iter().filter_map(|t| cut(t, z)).collect();
                for angle in [0.0, 0.41, -0.41] {
                    if let Some((a, b)) = gap(&segments, angle, (-half, half)) {
                        found.push(format!("{text} at {z}, {angle}: {a:.4} to {b:.4}"));
                    }
                }
            }
        }
        found
    }));
}
