//! The roofs of one storey: roof lines as written, automatic regions for the rest, and the space available to each roof.

pub(in crate::roof) mod abutment;
pub(in crate::roof) mod automatic;
pub(in crate::roof) mod corridor;
pub(in crate::roof) mod explicit;
pub(in crate::roof) mod forms;
pub(in crate::roof) mod headroom;
pub(in crate::roof) mod overhang;
pub(in crate::roof) mod placed_line;
pub(in crate::roof) mod polygonal;
pub(in crate::roof) mod porch;
pub(in crate::roof) mod skirt;
pub(in crate::roof) mod standing;
pub(in crate::roof) mod street_pent;
pub(in crate::roof) mod written;
