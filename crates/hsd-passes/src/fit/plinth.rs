//! The plinth under a house on a slope: stone from its ground down to that of the slope, under whatever stands on the ground.

use super::around::outline;
use super::rings;
use hsd_ir::building::House;
use hsd_ir::building::fittings::{Fitting, FittingKind, Plinth, Veranda};

/// Returns the plinth of a house; `None` if it has none, or nothing to carry. `made` are its fittings so far, `deck` is the
/// veranda of its ground storey.
pub(super) fn plinth(house: &House, made: &[Fitting], deck: Option<&Veranda>) -> Option<Plinth> {
    if house.plinth <= 0.0 {
        return None;
    }
    let platforms = made.iter().filter_map(|fitting| match &fitting.what {
        FittingKind::Platform(platform) => Some(platform.outline.clone()),
        _ => None,
    });
    let mut outlines: Vec<_> = platforms.collect();
    if outlines.is_empty() {
        let ground = house.storeys.first()?;
        outlines = rings(ground)
            .filter(|ring| !ring.inner)
            .map(|ring| outline(house, ring))
            .collect();
    }
    let decks = deck.iter().flat_map(|deck| &deck.sides);
    outlines.extend(decks.map(|side| {
        let [from, to] = side.inner;
        vec![side.outer[0], side.outer[1], to, from]
    }));
    outlines.retain(|outline| outline.len() > 2);
    let z = (-house.raised - house.plinth, -house.raised);
    (!outlines.is_empty()).then_some(Plinth { outlines, z })
}
