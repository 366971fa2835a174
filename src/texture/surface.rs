//! Surface textures, one module per family of materials: formulas for colour, height and gloss.

pub(in crate::texture) mod bamboo;
pub(in crate::texture) mod boards;
pub(in crate::texture) mod cells;
pub(in crate::texture) mod cement;
pub(in crate::texture) mod clay;
pub(in crate::texture) mod grain;
pub(in crate::texture) mod ground;
pub(in crate::texture) mod plants;
pub(in crate::texture) mod plaster;
pub(in crate::texture) mod roof_tiles;
pub(in crate::texture) mod sheet;
pub(in crate::texture) mod shingles;
pub(in crate::texture) mod thatch;
pub(in crate::texture) mod timber;
pub(in crate::texture) mod wall_tiles;
pub(in crate::texture) mod weave;
