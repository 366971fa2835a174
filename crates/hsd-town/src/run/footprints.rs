//! The outlines of the houses of a feature as they are built: trees of the same feature keep out of them.

use super::TownInput;
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_ir::ast::town::Made;
use hsd_ir::ast::{self, Outdoor};
use hsd_passes::expand::{Expander, HouseContext, HouseId};
use hsd_passes::lower;
use hsd_syntax::parse::builtin;
use hsd_syntax::parse::xml::RuleMade;

/// Returns the outlines of what rules made of a feature with this ring, if trees were made besides; else nothing asks for them.
pub(super) fn footprints(
    made: &[RuleMade],
    ring: Option<&[DVec2]>,
    input: TownInput<'_>,
) -> Vec<Vec<DVec2>> {
    let is_tree = |made: &RuleMade| matches!(&made.made, Made::Outdoor { wish, .. } if matches!(wish, Outdoor::Tree(_)));
    if !made.iter().any(is_tree) {
        return vec![];
    }
    let mut found = vec![];
    for made in made {
        let Made::Houses { houses, stood, .. } = &made.made else {
            continue;
        };
        match (&stood.walls, ring) {
            // It takes the whole outline.
            (Some(_), Some(ring)) => found.push(ring.to_vec()),
            _ => found.extend(houses.iter().flat_map(|house| outlines(house, input))),
        }
    }
    found
}

/// Returns the outlines of the ground storey of a house, metres in the plane of the town.
fn outlines(house: &ast::House, input: TownInput<'_>) -> Vec<Vec<DVec2>> {
    let catalog = builtin();
    let mut unsaid = Diagnostics::new();
    let context = HouseContext {
        source: input.source,
        scope: catalog.known_in(0, 0),
        variant: None,
    };
    let mut expander = Expander::new(catalog, input.world, &input.options.expand);
    let Some(made) = expander.house(house, HouseId(0), context, &mut unsaid) else {
        return vec![];
    };
    let house = lower::house(made, &mut unsaid);
    let storey = house.storeys.first();
    let rings = storey.iter().flat_map(|storey| &storey.rings);
    let rings = rings.filter(|ring| !ring.inner && !ring.hole);
    let corners = rings.map(|ring| {
        let corners = ring.walls.iter().map(|wall| house.world(wall.from));
        corners.collect::<Vec<DVec2>>()
    });
    corners.filter(|corners| corners.len() > 2).collect()
}
