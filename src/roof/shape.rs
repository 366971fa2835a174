//! Roof shapes: each module turns one region into a [`form::Form`], its upper surface and the walls under it.
//!
//! The frames and formulas that shapes share are [`frame`], [`facet`], [`profile`], [`end`] and [`look`].

pub mod board;
pub mod end;
pub mod facet;
pub mod flat;
pub mod form;
pub mod frame;
pub mod gable_wall;
pub mod hipped;
pub mod lean_to;
pub mod look;
pub mod pent;
pub mod profile;
pub mod ridge_roof;
pub(in crate::roof) mod corners;
