//! Roofs: from the plan of a storey to rectangles, each with its ridge.
//!
//! The chain inside this module: a [`plan::Plan`] (what the storey above leaves open) is
//! cut and merged into rectangles by [`partition::partition`]; [`ridge::regions`] then says
//! how each rectangle is roofed (main roof, branch running into its trunk, lean-to).
//!
//! Frame: author frame, a to the left along the first line, b back into the plot; i64 on
//! any exact grid (normally quarter units). Everything here is exact: no floating point,
//! and the result depends on the region as a point set only, never on where a loop starts
//! or on corners in mid-wall.

pub mod chord;
pub mod kd;
pub mod least_cut;
pub mod merge;
pub mod partition;
pub mod plan;
mod raster;
pub mod ridge;
mod scan;
mod sides;
mod slabs;
pub mod street;
