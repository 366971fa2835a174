//! The roofs of one storey: roof lines as written, automatic regions for the rest, and the space available to each roof.

pub(crate) mod abutment;
pub(crate) mod automatic;
pub(crate) mod corridor;
pub(crate) mod explicit;
pub(crate) mod forms;
pub(crate) mod headroom;
pub(crate) mod overhang;
pub(crate) mod placed_line;
pub(crate) mod polygonal;
pub(crate) mod porch;
pub(crate) mod skirt;
pub(crate) mod standing;
pub(crate) mod street_pent;
pub(crate) mod written;
