//! Plain roofs made at once for what is seen of them from afar are those that are joined first: the same upper surface,
//! the same volume, closed, and no more triangles.

#[path = "../benches/texts/mod.rs"]
mod texts;

use crate::support::{assert_none, on_all_processors, volume};
use glam::{DVec2, DVec3, dvec2};
use hsd::building::{Built, Solid};
use hsd::check::solid_flaws;
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Options};
use hsd::roof::solid::massive::lean;
use hsd::scene::Detail;
use hsd::source::{FileId, NoFiles, Source};

/// Plain houses of each shape of roof.
const HOUSES: usize = 1_000;
/// How much larger and smaller volumes may be, cubic metres: under verges that lie upon a lower roof, joined roofs have a
/// cavity, and walls over lean-tos lap other roofs a little.
const CAVITY: f64 = 0.15;
const LAP: f64 = 0.005;
/// The most by which a house may have more triangles: those of a wall over a lean-to, which stands by itself, or of faces that
/// are divided where a verge crosses a slope. All houses together have fewer.
const MORE: usize = 16;
/// The most by which upper surfaces may differ, metres.
const OFF: f64 = 2e-4;
/// Points of the upper surface along each side of a house.
const POINTS: usize = 13;

fn built(text: &str, all_roofs: bool) -> Vec<Built> {
    let options = Options {
        detail: Detail::Body,
        all_roofs,
        ..Options::default()
    };
    let source = Source::new(FileId(0), "plain.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let compiled = driver::compile(&[&source], &NoFiles, &options, &mut out);
    assert!(!out.has_errors(), "the text is wrong");
    compiled.building.houses
}

/// The solids of the roofs of a house, and whether they were made at once.
fn solids(house: &Built) -> (Vec<Solid>, bool) {
    let roofs = &house.roofs.roofs;
    match roofs.iter().find_map(|roof| roof.whole.clone()) {
        Some(whole) => (whole, true),
        None => (lean(roofs).expect("has an attic"), false),
    }
}

fn triangles(solids: &[Solid]) -> usize {
    let faces = solids.iter().flat_map(|solid| &solid.faces);
    faces.map(|face| face.corners.len() - 2).sum()
}

/// The height of the upper surface over a place.
fn top(solids: &[Solid], at: DVec2) -> Option<f64> {
    let heights = solids.iter().flat_map(|solid| {
        let faces = solid.faces.iter();
        faces.filter_map(|face| {
            let points = || face.corners.iter().map(|c| solid.points[*c as usize]);
            let first = points().next()?;
            let ways = || points().map(|p| p - first);
            let normal: DVec3 = ways().zip(ways().skip(1)).map(|(p, q)| p.cross(q)).sum();
            let next = points().skip(1).chain([first]);
            let passes = points().zip(next).filter(|(p, q)| {
                let across = (p.y > at.y) != (q.y > at.y);
                across && at.x < p.x + (at.y - p.y) / (q.y - p.y) * (q.x - p.x)
            });
            let over = normal.z > 1e-9 && passes.count() % 2 == 1;
            let way = (at - first.truncate()).extend(0.0);
            over.then(|| first.z - normal.dot(way) / normal.z)
        })
    });
    heights.reduce(f64::max)
}

/// Compares a roof made at once with the same roof joined first, and describes the first difference.
fn differences(once: &[Solid], joined: &[Solid]) -> Option<String> {
    let sum = |solids: &[Solid]| solids.iter().map(volume).sum::<f64>();
    let (more, corners) = (
        sum(once) - sum(joined),
        joined.iter().flat_map(|s| &s.points),
    );
    if !(-LAP..CAVITY).contains(&more) {
        return Some(format!("{more} cubic metres more"));
    }
    if let Some(flaw) = once.iter().flat_map(solid_flaws).next() {
        return Some(format!("{flaw:?}"));
    }
    let (now, before) = (triangles(once), triangles(joined));
    if now > before + MORE {
        return Some(format!("{before} triangles became {now}"));
    }
    let bounds = (DVec2::MAX, DVec2::MIN);
    let (lo, hi) = corners.fold(bounds, |(lo, hi), p| {
        (lo.min(p.truncate()), hi.max(p.truncate()))
    });
    let share = |k: usize| (k as f64 + 0.437) / POINTS as f64;
    let places = (0..POINTS * POINTS).map(|k| dvec2(share(k % POINTS), share(k / POINTS)));
    let mut places = places.map(|share| lo + (hi - lo) * share);
    let differ = |at: DVec2| match (top(once, at), top(joined, at)) {
        (Some(one), Some(other)) => (one - other).abs() > OFF,
        (one, other) => one.is_some() != other.is_some(),
    };
    // Where a place lies on an edge, one beside it counts.
    let off = |at: &DVec2| differ(*at) && differ(*at + dvec2(1.3e-3, 0.7e-3));
    let off = places.find(off)?;
    Some(format!("another height over {off}"))
}

#[test]
fn plain_roofs_made_at_once_are_those_that_are_joined() {
    // One in six is a rectangle, whose roof meets no other.
    for (shape, least) in [("KIR", 0.83), ("YOS", 0.83)] {
        let text = texts::plain(HOUSES, shape);
        let (once, joined) = (built(&text, false), built(&text, true));
        let made = once.iter().filter(|house| solids(house).1).count();
        assert!(
            made as f64 > least * HOUSES as f64,
            "{shape}: only {made} at once"
        );
        let all = |houses: &[Built]| {
            houses
                .iter()
                .map(|h| triangles(&solids(h).0))
                .sum::<usize>()
        };
        let (now, before) = (all(&once), all(&joined));
        assert!(now < before, "{shape}: {before} triangles became {now}");
        let found = on_all_processors(HOUSES, |n| {
            let found = differences(&solids(&once[n]).0, &solids(&joined[n]).0);
            found
                .map(|found| format!("{shape} {n}: {found}"))
                .into_iter()
                .collect()
        });
        assert_none(&found);
    }
}
