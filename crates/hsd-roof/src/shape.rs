//! Roof shapes: each module turns one region into a [`form::Form`], its upper surface and the walls under it.
//!
//! Shapes share the frame of a roof ([`frame`](super::frame)), its [`facet`](super::facet)s, the rafter line
//! ([`profile`]), the treatment of its ends ([`end`]) and its dimensions ([`look`]).

pub mod board;
mod broken;
pub(crate) mod corners;
pub(crate) mod deck;
pub mod end;
pub mod flat;
pub mod form;
pub mod gable_wall;
pub mod hipped;
pub mod lean_to;
pub mod look;
pub mod pent;
pub mod profile;
pub mod ridge_roof;
pub mod strip;
