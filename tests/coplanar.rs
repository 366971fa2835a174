//! Faces of unlike materials that lie in one plane, one over the other, flicker. No example and no type has more of them that
//! an eye could see than a hand covers.

use crate::support::coplanar::{Fight, fights};
use crate::support::depths::{Skin, skins_of};
use crate::support::{assert_none, compile_file, on_all_processors, stem, texts};
use hsd::scene::Scene;
use std::collections::BTreeMap;

/// The most that the faces of two materials may share in one scene, square metres.
const MOST: f64 = 0.03;

/// Scenes with more triangles are left to `HSD_THOROUGH`.
const LARGE: usize = 60_000;

/// What is more than that, by materials.
pub fn told(scene: &Scene, skins: &[Skin], found: &[Fight]) -> Vec<String> {
    let mut pairs: BTreeMap<[&str; 2], (f64, &Fight)> = BTreeMap::new();
    for fight in found {
        let name = |i: usize| scene.materials[skins[i].1 as usize].name.as_str();
        let mut pair = fight.pair.map(name);
        pair.sort_unstable();
        pairs.entry(pair).or_insert((0.0, fight)).0 += fight.area;
    }
    let many = pairs.into_iter().filter(|(_, (area, _))| *area > MOST);
    many.map(|([a, b], (area, first))| {
        let (at, out) = (first.at, first.out);
        format!("{a} and {b} share {area:.4} m2, first at {at:.3} towards {out:.2}")
    })
    .collect()
}

#[test]
fn no_two_materials_share_a_plane() {
    let thorough = crate::support::thorough();
    let mut paths = texts("examples");
    paths.extend(texts("library"));
    assert_none(&on_all_processors(paths.len(), |index| {
        let run = compile_file(&paths[index]);
        if !thorough && run.scene.stats().triangles > LARGE {
            return vec![];
        }
        let skins = skins_of(&run.scene);
        let all = told(&run.scene, &skins, &fights(&skins));
        let name = stem(&paths[index]);
        all.into_iter().map(|f| format!("{name}: {f}")).collect()
    }));
}
