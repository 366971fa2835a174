//! Surface textures, one module per family of materials: formulas for colour, height and gloss.

pub(in crate::textures) mod bamboo;
pub(in crate::textures) mod boards;
pub(in crate::textures) mod cells;
pub(in crate::textures) mod cement;
pub(in crate::textures) mod clay;
pub(in crate::textures) mod grain;
pub(in crate::textures) mod ground;
pub(in crate::textures) mod plants;
pub(in crate::textures) mod plaster;
pub(in crate::textures) mod roof_tiles;
pub(in crate::textures) mod sheet;
pub(in crate::textures) mod shingles;
pub(in crate::textures) mod thatch;
pub(in crate::textures) mod timber;
pub(in crate::textures) mod wall_tiles;
pub(in crate::textures) mod weave;
