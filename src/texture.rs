//! The pictures of the materials: each surface a house can show, drawn by a formula.
//!
//! Nothing here is a photograph. A surface is a function from a point to a height, a colour and
//! a roughness; [`Surface::draw`] samples it and derives the normal map from the heights, so
//! colour and relief always agree. Every random number comes from an integer hash of a lattice
//! that closes on itself, hence the pictures are seamless and the same bytes on every machine.
//!
//! The kernel is `noise` (random fields), `cells` (joints, grains and straws), `color` (ramps),
//! `grain` (wood) and `paint` (sampling, relief); the materials are built from it; `files` turns
//! pictures into the files of `textures/`, `samples` looks points up in them.
//!
//! Orientation: `u` runs to the right in the picture, `v` upwards (towards its top edge). On a
//! roof `v` points up the slope.

mod bamboo;
mod boards;
mod cells;
mod color;
mod files;
mod grain;
mod ground;
mod noise;
mod paint;
mod plaster;
pub mod samples;
mod sheet;
mod shingles;
mod tiles;
mod weave;

pub use files::{COLOR_SIZE, ORM_SIZE, embedded, encode, jpeg, png, write_all};

use std::fmt;

/// A material's pictures: seamless in both axes, `size` px square.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Maps {
    /// Base colour, sRGB.
    pub color: image::RgbImage,
    /// Unit normals in tangent space, OpenGL convention: red to the right, green up.
    pub normal: image::RgbImage,
    /// Red: occlusion, always 255. Green: roughness. Blue: metalness. Linear.
    pub orm: image::RgbImage,
}

/// A material that can be drawn.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Lower-case name, the stem of its files.
    pub name: &'static str,
    /// Width and height of one repeat in metres, at true scale.
    pub metres: f64,
    /// Draws the pictures with `size` px a side.
    pub draw: fn(size: u32) -> Maps,
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Surface")
            .field("name", &self.name)
            .field("metres", &self.metres)
            .finish()
    }
}

impl Surface {
    /// File name of the base colour, a JPEG of [`COLOR_SIZE`] px.
    pub fn color_file(&self) -> String {
        format!("{}_color.jpg", self.name)
    }

    /// File name of the normal map, a JPEG of [`COLOR_SIZE`] px.
    pub fn normal_file(&self) -> String {
        format!("{}_normal.jpg", self.name)
    }

    /// File name of the occlusion, roughness and metalness map, a PNG of [`ORM_SIZE`] px.
    pub fn orm_file(&self) -> String {
        format!("{}_orm.png", self.name)
    }
}

const fn entry(name: &'static str, metres: f64, draw: fn(u32) -> Maps) -> Surface {
    Surface { name, metres, draw }
}

/// All surfaces, in a fixed order: timber, walls, roofs, infill, later materials, ground.
pub static SURFACES: &[Surface] = &[
    entry("cedar", boards::CEDAR, boards::cedar),
    entry("cedar_board", boards::CEDAR_BOARD, boards::cedar_board),
    entry("clapboard", boards::CLAPBOARD, boards::clapboard),
    entry("charred", boards::CHARRED, boards::charred),
    entry("bamboo", bamboo::BAMBOO, bamboo::bamboo),
    entry("plaster", plaster::PLASTER, plaster::plaster),
    entry("clay", plaster::CLAY, plaster::clay),
    entry("namako", tiles::NAMAKO, tiles::namako),
    entry("kawara", tiles::KAWARA, tiles::kawara),
    entry("board_roof", shingles::BOARD_ROOF, shingles::board_roof),
    entry("bark", shingles::BARK, shingles::bark),
    entry("thatch", shingles::THATCH, shingles::thatch),
    entry("paper", weave::PAPER, weave::paper),
    entry("cloth", weave::CLOTH, weave::cloth),
    entry("tatami", weave::TATAMI, weave::tatami),
    entry("aluminium", sheet::ALUMINIUM, sheet::aluminium),
    entry("glass", sheet::GLASS, sheet::glass),
    entry("steel", sheet::STEEL, sheet::steel),
    entry("concrete", plaster::CONCRETE, plaster::concrete),
    entry("mortar", plaster::MORTAR, plaster::mortar),
    entry("tile", tiles::TILE, tiles::tile),
    entry("stone", ground::STONE, ground::stone),
    entry("earth", ground::EARTH, ground::earth),
];

/// The surface of that name.
pub fn surface(name: &str) -> Option<&'static Surface> {
    SURFACES.iter().find(|surface| surface.name == name)
}
