//! Roofs: from placed walls to closed solids over everything they leave open.
//!
//! | step | module | result |
//! |---|---|---|
//! | what is open | [`plan`], `storey` | the storey's plan less the storey above less the roof lines |
//! | division | [`partition`] | rectangles that cover it once, cut by a method and merged |
//! | roles | [`plan::roles`] | main roofs, branches that run into their trunk, lean-tos |
//! | shape | [`shape`] | a [`shape::form::Form`] each: upper surface in facets, walls under it |
//! | joining | `join` | roofs of one height meet in valleys, gables make room for their neighbours |
//! | closing | [`solid`] | closed solids with gable walls |
//!
//! Plans that are not at right angles, and any plan by `method skeleton`, are roofed as a whole: the straight
//! [`skeleton`] gives one slope over each wall ([`shape::hipped`]). Towns ask for such a roof with [`over`].
//!
//! For details without joinery tessellation asks for roofs that meet as one solid with their attics
//! ([`solid::massive`]). Ridge tiles, barge boards and rafters are made by tessellation, from the solids and a small
//! [`Trim`](crate::building::Trim).
//!
//! A further shape is one further module below [`shape`]; joining and closing are the same for all.
//!
//! Frames: plans in the author frame, a to the left along the first line, b back into the plot, on
//! exact integers; nothing there depends on where a loop starts. Solids in metres in the house frame.

use crate::building::{Building, HouseRoofs, Shell};
use crate::diagnostic::Diagnostics;

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

pub use crate::roof::shape::hipped::over;

/// Roofs all houses.
pub fn roof(shell: Shell, out: &mut Diagnostics) -> Building {
    let effort = crate::roof::budget::SearchBudget::default();
    let mut firsts = crate::roof::cache::RoofCache::default();
    let mut roofs: Vec<HouseRoofs> = Vec::with_capacity(shell.houses.len());
    for (i, house) in shell.houses.iter().enumerate() {
        let plan = crate::roof::cache::Plan::of(house);
        if let Some((known, told)) = firsts.twin(house, &plan, &roofs) {
            roofs.push(known);
            told.into_iter().for_each(|d| out.push(d));
            continue;
        }
        let mut told = Diagnostics::new();
        let said = effort.has_told();
        roofs.push(house::roofs(house, &effort, &mut told));
        told.iter().for_each(|d| out.push(d.clone()));
        // That no search is left is said once a run, about one house.
        if effort.has_told() == said {
            firsts.keep(plan, house, i, told.into_sorted());
        }
    }
    Building {
        shell,
        roofs,
        fittings: vec![],
    }
}
