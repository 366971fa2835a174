//! Trim along eaves and verges: barge boards, edge tiles, rafters, plaster bands, flashing.

pub(in crate::tessellate::trim) mod arched;
pub(in crate::tessellate::trim) mod barge;
pub(in crate::tessellate::trim) mod flashing;
pub(in crate::tessellate::trim) mod gegyo;
pub(in crate::tessellate::trim) mod lattice;
pub(in crate::tessellate::trim) mod plaster;
pub(in crate::tessellate::trim) mod rafters;
pub(in crate::tessellate::trim) mod rim;
pub(in crate::tessellate::trim) mod rows;
