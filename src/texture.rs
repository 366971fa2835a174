//! The textures of the materials: each surface of a house, computed by a formula.
//!
//! Nothing here is a photograph. A surface is a function from a point to a height, a colour and
//! a roughness; [`Surface::draw`] samples it and derives the normal map from the heights, so
//! colour and relief always agree. Every random number comes from an integer hash of a lattice
//! that closes on itself, hence the textures are seamless and the same bytes on every machine.
//!
//! The kernel is `noise` (random fields), `cells` (joints, grains and straws), `color` (ramps),
//! `grain` (wood) and `paint` (sampling, relief); the materials are built from it and listed in
//! `table`; `files` encodes textures as the files of `textures/`, `samples` samples them at points, `means`
//! has their mean colours, and `palette` is one picture of all plain colours.
//!
//! Orientation: `u` runs to the right in the texture, `v` upwards (towards its top edge). On a
//! roof `v` points up the slope.

mod surface;
mod color;
mod contact;
mod files;
mod means;
mod noise;
mod paint;
pub mod palette;
pub mod samples;
mod table;

pub use contact::contact_sheet;
pub use files::{COLOR_SIZE, ORM_SIZE, embedded, encode, encode_all, is_embedded, jpeg, png};
pub use means::mean;
pub use table::SURFACES;

use image::RgbImage;
use std::fmt;

/// The textures of a material: seamless in both axes, `size` px square. Its looks share the relief.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Maps {
    /// Base colour, sRGB, of each look.
    pub colors: Vec<RgbImage>,
    /// Unit normals in tangent space, OpenGL convention: red to the right, green up.
    pub normal: RgbImage,
    /// Red: occlusion, always 255. Green: roughness. Blue: metalness. Linear.
    pub orm: RgbImage,
}

/// One colouring of a surface: an age, a dye, a glaze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Lower-case name, unique among the looks of all surfaces, the stem of its colour file.
    pub name: &'static str,
    /// Its mean colour as a hexadecimal sRGB number, such as 0xF2EFE6, if known (docs/evidence.md 4.9).
    pub mean: Option<u32>,
}

impl Look {
    /// Returns the file name of the base colour, a JPEG of [`COLOR_SIZE`] px.
    pub fn color_file(&self) -> String {
        format!("{}_color.jpg", self.name)
    }
}

/// A material whose textures can be computed.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Lower-case name, the stem of the files that its looks share.
    pub name: &'static str,
    /// Width and height of one repeat in metres, at true scale.
    pub metres: f64,
    /// Mean roughness and metalness of its gloss map, 0 to 1, for materials without one.
    pub gloss: [f32; 2],
    /// Its possible looks; the first is the new one.
    pub looks: &'static [Look],
    /// Computes the textures with `size` px a side, before their mean colours are adjusted.
    paint: fn(size: u32) -> Maps,
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Surface")
            .field("name", &self.name)
            .field("metres", &self.metres)
            .field("looks", &self.looks)
            .finish()
    }
}

impl Surface {
    /// Returns its textures with `size` px a side, a colour map for each look.
    pub fn draw(&self, size: u32) -> Maps {
        let mut maps = (self.paint)(size);
        debug_assert_eq!(maps.colors.len(), self.looks.len(), "{}", self.name);
        for (color, look) in maps.colors.iter_mut().zip(self.looks) {
            if let Some(mean) = look.mean {
                paint::tone(color, color::hex(mean));
            }
        }
        maps
    }

    /// Returns the file name of the normal map, a JPEG of [`COLOR_SIZE`] px.
    pub fn normal_file(&self) -> String {
        format!("{}_normal.jpg", self.name)
    }

    /// Returns the file name of the occlusion, roughness and metalness map, a PNG of [`ORM_SIZE`] px.
    pub fn orm_file(&self) -> String {
        format!("{}_orm.png", self.name)
    }
}

/// Converts a colour from a hexadecimal sRGB number to linear RGB.
pub fn linear(number: u32) -> [f32; 3] {
    let [_, red, green, blue] = number.to_be_bytes();
    [red, green, blue].map(samples::linear)
}

/// Returns the surface that has a look of that name, and the look.
pub fn look(name: &str) -> Option<(&'static Surface, &'static Look)> {
    let of = |surface: &'static Surface| {
        let look = surface.looks.iter().find(|look| look.name == name)?;
        Some((surface, look))
    };
    SURFACES.iter().find_map(of)
}
