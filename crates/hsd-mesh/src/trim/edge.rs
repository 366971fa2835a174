//! Trim along eaves and verges: barge boards, edge tiles, rafters, plaster bands, flashing.

pub(in crate::trim) mod arched;
pub(in crate::trim) mod barge;
pub(in crate::trim) mod flashing;
pub(in crate::trim) mod gegyo;
pub(in crate::trim) mod lattice;
pub(in crate::trim) mod plaster;
pub(in crate::trim) mod rafters;
pub(in crate::trim) mod rim;
pub(in crate::trim) mod rows;
