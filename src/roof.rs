//! Roofs: from placed walls to closed solids over everything they leave open.
//!
//! The way of a storey: its plan less the storey above ([`plan`]) less roof lines (`explicit`) is
//! cut and merged into rectangles ([`partition`]); [`ridge::regions`] says how each is roofed (main
//! roof, branch running into its trunk, lean-to); a shape ([`hall`], [`lean_to`], [`pent`],
//! [`flat`]) turns each into a [`form::Form`]; roofs of one height meet in valleys (`meet`); what
//! remains of each becomes a closed solid ([`sheet`]) with gable walls, which the neighbours cut (`fills`). What it wears (ridge tiles, barge boards,
//! rafters) is made by tessellation, from the solids and a small [`Dress`](crate::building::Dress).
//!
//! Plans that are not at right angles, and any plan by `method skeleton`, are roofed as a whole (`polygonal`): the
//! straight skeleton ([`skeleton`]) gives one slope over each wall ([`hipped`]). Towns ask for such a roof with [`over`].
//!
//! For details without joinery tessellation asks for roofs that meet as one solid with their attics ([`massive`]).
//!
//! A further shape is one further file that makes a [`form::Form`]: upper facets, their drop, and
//! what stands under them. Meeting and closing are the same for all.
//!
//! Frames: plans in the author frame, a to the left along the first line, b back into the plot, on
//! exact integers; nothing there depends on where a loop starts. Solids in metres in the house frame.

use crate::building::{Building, HouseRoofs, Shell};
use crate::diagnostic::Diagnostics;

mod assemble;
mod automatic;
pub mod board;
pub mod branch_cut;
pub mod chord;
mod convex;
mod corners;
mod eaves;
pub mod effort;
pub mod end;
mod explicit;
pub mod facet;
mod fills;
pub mod flat;
pub mod form;
mod forms;
pub mod frame;
pub mod gable_wall;
pub mod hall;
mod headroom;
pub mod hipped;
mod house;
pub mod kd;
pub mod lean_to;
pub mod least_cut;
mod level;
pub mod look;
pub mod massive;
mod meet;
pub mod merge;
mod nearby;
pub mod outline;
mod overhang;
pub mod partition;
pub mod pent;
pub mod plan;
mod porch;
pub mod profile;
mod raster;
mod report;
mod polygonal;
mod polygons;
pub mod ridge;
mod run_in;
mod scan;
pub mod sheet;
mod sides;
pub mod six_vertex;
pub mod skeleton;
mod skirt;
mod slabs;
pub mod solid;
pub mod street;
mod tops;
pub mod triangulate;
mod verges;
mod twins;
mod written;

pub use hipped::over;

/// Roofs all houses.
pub fn roof(shell: Shell, out: &mut Diagnostics) -> Building {
    let effort = effort::Effort::default();
    let mut firsts = twins::Firsts::default();
    let mut roofs: Vec<HouseRoofs> = Vec::with_capacity(shell.houses.len());
    for (i, house) in shell.houses.iter().enumerate() {
        let plan = twins::Plan::of(house);
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
