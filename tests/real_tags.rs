//! Roofs by use against the tags of OpenStreetMap: the shapes (`roof:shape`) and ridges (`roof:orientation`,
//! `roof:direction`) that mappers saw. The maps lie beside the repository; without them the test is reported as ignored.
//!
//! `HSD_OUTLINES=FOLDER cargo test --release real_tags -- --include-ignored --nocapture` prints the figures for the
//! GeoJSON files of another folder.

use crate::real_outlines::text_of;
use crate::support::compile;
use crate::support::maps::{Plan, maps, maps_in, plans};
use glam::DVec2;
use hsd::ast::{Purpose, RoofShape};
use hsd::building::{Built, Roof, RoofSurface};
use std::path::Path;

/// The shares of shapes and of ridges that must be right, per cent.
const SHAPES_RIGHT: usize = 85;
const RIDGES_RIGHT: usize = 90;
/// The sine of the angle by which a ridge may miss its tag: 15 degrees.
const ASIDE: f64 = 0.259;

/// What a building is for, by its tags.
fn purpose(plan: &Plan) -> Purpose {
    let is_shrine = plan.tag("religion") == Some("shinto");
    match plan.tag("building").unwrap_or("yes") {
        "pagoda" | "chapel" => Purpose::Hall,
        "shrine" => Purpose::Shrine,
        "temple" | "religious" | "monastery" if is_shrine => Purpose::Shrine,
        "temple" | "religious" | "monastery" => Purpose::Temple,
        "gatehouse" | "gate" => Purpose::Gate,
        "storehouse" | "warehouse" | "retail" | "barn" => Purpose::Store,
        "shed" | "garage" | "carport" | "roof" | "hut" => Purpose::Shed,
        "apartments" | "office" | "commercial" | "hotel" | "school" | "hospital" => Purpose::Block,
        _ => Purpose::Dwelling,
    }
}

/// The shape that a tag means; none for those that no roof here has.
fn tagged(plan: &Plan) -> Option<RoofShape> {
    let word = plan.tag("roof:shape")?;
    let known = RoofShape::MAPPED.iter();
    known.clone().find(|(w, _)| *w == word).map(|(_, s)| *s)
}

fn house(plan: &Plan) -> Option<Built> {
    let purpose = purpose(plan);
    let word = Purpose::ALL.iter().find(|(_, p)| *p == purpose)?.0;
    let plain = text_of(plan);
    let used = format!("<House use=\"{word}\">\n  <Roofs shape=\"use\"/>");
    let run = compile("tagged.hsd", plain.replacen("<House>", &used, 1).as_bytes());
    assert!(!run.has_errors(), "{}\n{}", plan.name, run.short());
    run.building.houses.into_iter().next()
}

/// The roof over the largest part of a house, and its surface.
fn main_roof(built: &Built) -> Option<(&Roof, &RoofSurface)> {
    let area = |surface: &RoofSurface| -> f64 {
        let facets = surface.facets.iter();
        facets.map(|facet| surface.area(facet)).sum()
    };
    let roofs = built.roofs.roofs.iter().zip(built.roofs.surfaces());
    roofs.max_by(|(_, p), (_, q)| area(p).total_cmp(&area(q)))
}

/// The direction in which the ridge of a roof runs in the world.
fn ridge(built: &Built, surface: &RoofSurface) -> Option<DVec2> {
    let lines = surface.lines(hsd::building::EdgeKind::Ridge);
    let (house, unit) = (&built.house, built.house.unit);
    let world = |p: &glam::DVec3| house.world(DVec2::new(-p.x, p.y) / unit);
    let line = |[p, q]: &[glam::DVec3; 2]| world(q) - world(p);
    let longest = lines
        .iter()
        .map(line)
        .max_by(|p, q| p.length().total_cmp(&q.length()))?;
    longest.try_normalize()
}

/// The direction of the ridge that the tags of a gable mean: across the fall, along or across the longest side; none
/// without such a tag.
fn tagged_ridge(plan: &Plan) -> Option<DVec2> {
    if let Some(fall) = plan
        .tag("roof:direction")
        .and_then(|d| d.parse::<f64>().ok())
    {
        let (sin, cos) = fall.to_radians().sin_cos();
        return Some(DVec2::new(sin, cos).perp());
    }
    let sides = plan.outline.windows(2).map(|w| w[1] - w[0]);
    let longest = sides
        .max_by(|p, q| p.length().total_cmp(&q.length()))?
        .normalize();
    match plan.tag("roof:orientation") {
        Some("across") => Some(longest.perp()),
        Some("along") => Some(longest),
        _ => None,
    }
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_roofs_by_use_have_the_tagged_shapes_and_ridges() {
    let asked = std::env::var_os("HSD_OUTLINES");
    let maps = match &asked {
        Some(folder) => maps_in(Path::new(folder)),
        None => maps(),
    };
    let [mut shapes, mut right, mut ridges, mut along] = [0; 4];
    for plan in maps.iter().flat_map(|map| plans(map)) {
        let Some(shape) = tagged(&plan) else { continue };
        let built = house(&plan).expect("a house is built");
        let (roof, surface) = main_roof(&built).expect("a house has a roof");
        shapes += 1;
        right += usize::from(roof.shape == shape);
        if roof.shape != shape {
            eprintln!(
                "{}: {} for {}",
                plan.name,
                roof.shape.letters(),
                shape.letters()
            );
        }
        if roof.shape == RoofShape::Gable
            && shape == RoofShape::Gable
            && let (Some(own), Some(tag)) = (ridge(&built, surface), tagged_ridge(&plan))
        {
            ridges += 1;
            along += usize::from(own.perp_dot(tag).abs() < ASIDE);
        }
    }
    eprintln!("shapes {right} of {shapes}, ridges {along} of {ridges}");
    assert!(shapes > 0, "no building has a roof:shape");
    assert!(
        100 * right >= SHAPES_RIGHT * shapes,
        "{right} of {shapes} shapes"
    );
    assert!(
        100 * along >= RIDGES_RIGHT * ridges,
        "{along} of {ridges} ridges"
    );
}
