//! What is seen of models from outside: no face from behind (a gap, or a face inside out) and no two faces that fight
//! for one place.

use crate::support::view::View;
use crate::support::{
    assert_none, compile_file, details_in_turn, on_all_processors, stem, texts_in_turn,
};
use glam::{DVec3, dvec3};
use hsd::scene::{Detail, Kind, Scene};
use std::collections::BTreeMap;

/// Faces nearer to each other than this along the line of sight take turns in a viewer, metres.
const SAME_DEPTH: f64 = 2e-4;

/// From all round: from the height of the eaves, from a roof across the street, and from straight above.
fn ways() -> Vec<DVec3> {
    let mut ways = vec![dvec3(0.01, 0.02, -1.0)];
    for k in 0..8 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4 + 0.21).sin_cos();
        ways.push(dvec3(cos, sin, -0.06));
        ways.push(dvec3(cos, sin, -0.7));
    }
    ways
}

/// The findings about the roofs of one scene: what is seen from behind and what fights, by node and place.
fn findings(scene: &Scene, detail: Detail) -> Vec<String> {
    let mut found: BTreeMap<String, (usize, DVec3)> = BTreeMap::new();
    let mut lines = 0;
    // Every way if thorough. Less detail is looked at from every fourth way, which is from above.
    let step = match detail {
        Detail::Everything if crate::support::thorough() => 1,
        Detail::Everything => 2,
        _ => 4,
    };
    for way in ways().into_iter().step_by(step) {
        let view = View::of(scene, way, 220);
        lines += view.hits.len();
        for (place, [first, second]) in view.hits.iter().enumerate() {
            let Some(first) = first else { continue };
            let node = &scene.nodes[first.node as usize];
            if node.kind != Kind::Roof {
                continue;
            }
            let of = |what: &str| {
                format!(
                    "{what} {} ({})",
                    node.name, scene.materials[first.material as usize].name
                )
            };
            let mut note = |what: String| {
                found.entry(what).or_insert((0, view.point(place))).0 += 1;
            };
            if !first.front {
                note(of("from behind:"));
            }
            if let Some(second) = second
                && second.depth - first.depth < SAME_DEPTH
                && first.normal.dot(second.normal) > 0.999
                && second.material != first.material
            {
                let other = &scene.materials[second.material as usize].name;
                note(format!("{} and {other}", of("fight:")));
            }
        }
    }
    let many = found
        .into_iter()
        .filter(|(_, (count, _))| *count * 100_000 > lines);
    many.map(|(what, (count, at))| format!("{what}: {count} of {lines}, first at {at:.3}"))
        .collect()
}

#[test]
fn nothing_of_a_roof_is_seen_from_behind_and_nothing_fights() {
    let paths: Vec<_> = ["examples", "grammar/roofs"]
        .into_iter()
        .flat_map(|folder| texts_in_turn(folder, 1))
        .collect();
    let all = on_all_processors(paths.len(), |index| {
        let path = &paths[index];
        let run = compile_file(path);
        let all = details_in_turn(index).iter().flat_map(|&detail| {
            let scene = hsd::driver::scene(&run.building, &run.catalog, detail);
            let of = move |f: String| format!("{} at detail {detail:?}: {f}", stem(path));
            findings(&scene, detail).into_iter().map(of)
        });
        all.collect()
    });
    assert_none(&all);
}
