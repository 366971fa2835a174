//! Roofs: from placed walls to closed solids over everything they leave uncovered, one house at a time.
//!
//! | step | module | result |
//! |---|---|---|
//! | uncovered area | [`plan`], `storey` | the storey's plan less the storey above less the roof lines |
//! | division | [`partition`] | rectangles that cover it once, cut by a method and merged |
//! | roles | [`plan::roles`] | main roofs, branches that run into their trunk, lean-tos |
//! | shape | [`shape`] | a [`shape::form::Form`] each: upper surface in facets, walls under it |
//! | joining | `join` | roofs of one height meet in valleys, gables are cut back for their neighbours |
//! | closing | [`solid`] | closed solids with gable walls |
//!
//! Plans that are not at right angles, and any plan by `method skeleton`, are roofed as a whole: the straight
//! [`skeleton`] gives one slope over each wall ([`shape::hipped`]). Towns ask for such a roof with [`over`].
//!
//! For details without joinery tessellation asks for roofs that meet as one solid with their attics
//! ([`solid::massive`]). Ridge tiles, barge boards and rafters are made by tessellation, from the solids and a small
//! [`Trim`](hsd_ir::building::Trim).
//!
//! A further shape is one further module below [`shape`]; joining and closing are the same for all.
//!
//! Frames: plans in the author frame, a to the left along the first line, b back into the plot, on
//! exact integers; nothing there depends on where a loop starts. Solids in metres in the house frame.

use crate::cache::Key;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_ir::building::{Building, Built, House, HouseRoofs, Shell};
use std::sync::Arc;

pub mod messages;
pub mod budget;
mod cache;
pub mod facet;
pub mod frame;
mod house;
mod join;
pub mod partition;
pub mod plan;
pub mod region;
pub mod shape;
pub mod skeleton;
pub mod solid;
mod storey;

pub use crate::cache::{KeptRoofs, RoofCache};
pub use crate::shape::hipped::over;

/// Roofs all houses, one after another.
pub fn roof(shell: Shell, out: &mut Diagnostics) -> Building {
    let mut cache = RoofCache::default();
    let mut roofed = |house| {
        let roofs = self::house(&house, &mut cache, out);
        Built {
            house,
            roofs,
            fittings: vec![],
            rooms: vec![],
            fixtures: vec![],
        }
    };
    Building {
        houses: shell.houses.into_iter().map(&mut roofed).collect(),
        images: shell.images,
    }
}

/// Roofs one house. The cache only saves time, except that one for what is seen [from afar](RoofCache::from_afar) leaves out the rest.
pub fn house(house: &House, cache: &mut RoofCache, out: &mut Diagnostics) -> Arc<HouseRoofs> {
    // Brackets end under slopes, and finials stand on them.
    let bears = house.storeys.iter().any(|s| s.order.brackets.is_some());
    let afar = cache.is_from_afar() && !bears && house.finials.is_empty();
    let key = Key::of(house, afar);
    if let Some((roofs, diagnostics)) = cache.find(house, &key) {
        diagnostics.into_iter().for_each(|d| out.push(d));
        return roofs;
    }
    let mut found = Diagnostics::new();
    let roofs = Arc::new(house::roofs(house, afar, &mut found));
    let diagnostics: Vec<Diagnostic> = found.iter().cloned().collect();
    cache.keep(key, house, &roofs, &diagnostics);
    out.append(found);
    roofs
}
