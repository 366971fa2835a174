//! Materials, pictures and glass.

use super::*;

#[test]
fn glass_mirrors_where_its_facade_does() {
    let shares = |reflection: bool| {
        let mut building = simple(&["NAS 2"]);
        building.houses[0].house.storeys[0].rings[0].walls[0].reflection = reflection;
        let scene = scene(&building);
        let glass: Vec<f32> = scene
            .materials
            .iter()
            .filter_map(|m| m.reflection)
            .collect();
        glass
    };
    assert_eq!(shares(true), [0.3]);
    assert_eq!(shares(false), [0.0]);
}

#[test]
fn every_surface_has_a_name_of_its_own() {
    let mut names: Vec<&str> = hsd::material::all().iter().map(|s| s.name).collect();
    let n = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), n);
    for name in [
        "cedar",
        "hinoki",
        "boards",
        "boards_dark",
        "bamboo",
        "paper",
        "plaster",
        "mortar",
        "earth",
        "stone",
        "kawara",
        "kawara_edge",
        "board_roof",
        "shingle",
        "bark",
        "thatch",
        "sheet_roof",
        "soffit",
    ] {
        assert_eq!(hsd::material::SurfaceId::named(name).surface().name, name);
    }
}

#[test]
fn every_picture_is_in_the_library() {
    for surface in hsd::material::all() {
        if let Some(picture) = surface.picture {
            assert!(hsd::texture::look(picture).is_some(), "{picture}");
        }
    }
}
