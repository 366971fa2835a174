//! Textures of the materials: surfaces, their looks, and the files of `textures/`.
//!
//! No texture is a photograph: `xtask` draws each from a formula (`xtask/src/textures/`), the same bytes on every machine.
//! `table` lists the surfaces, `files` finds and encodes images, `samples` samples textures at points, `means` has their
//! mean colours, and `palette` is one image of all plain colours.
//!
//! Orientation: `u` runs to the right in the texture, `v` upwards (towards its top edge). On a roof `v` points up the
//! slope.

mod contact;
mod files;
mod means;
pub mod palette;
pub mod samples;
mod table;

pub use contact::contact_sheet;
pub use files::{COLOR_SIZE, ORM_SIZE, Packing, embedded, halve, is_embedded, jpeg, png};
pub use hsd_textures::FILES;
pub use means::mean;
pub use table::SURFACES;

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

/// A material with textures.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Lower-case name, the stem of the files that its looks share.
    pub name: &'static str,
    /// Width and height of one repeat in metres, at true scale.
    pub metres: f64,
    /// Mean roughness and metalness of its gloss map, 0 to 1, for materials without one.
    pub gloss: [f32; 2],
    /// Its possible looks; the first is the new one.
    pub looks: &'static [Look],
}

impl Surface {
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
