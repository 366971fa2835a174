//! Back ends: a scene to the bytes of files. They know formats, not houses.
//!
//! Scene frame: x east, y north, z up, metres. glTF and OBJ: (x, y, z) = (east, up, -north), the frame of
//! 000-33. STL keeps z upwards. No back end writes a file itself: each returns [`OutFile`]s, so that a shell
//! can put all of them in place or none.

pub mod cityjson;
pub mod flat;
pub mod gltf;
pub mod merged;
pub mod names;
pub mod number;
pub mod obj;
pub mod images;
pub mod pieces;
pub mod regions_svg;
pub mod sound;
pub mod spool;
pub mod stl;
pub mod tileset;

use std::borrow::Cow;

/// Access to the images of materials.
pub trait Images {
    /// Returns the image files of a look, by the name in [`hsd_scene::Image::Surface`].
    fn files(&self, look: &str) -> Option<SurfaceFiles<'_>>;

    /// Returns a part image, by its index in [`hsd_scene::Scene::pictures`]; PNG or JPEG.
    fn picture(&self, index: u32) -> Option<PictureBytes<'_>>;

    /// Returns a page of baked images, by its index in [`hsd_scene::Scene::baked`].
    fn baked(&self, index: u32) -> Option<SurfaceFiles<'_>>;

    /// Returns the reflection of a wall, by its index in [`hsd_scene::Scene::mirrored`].
    fn mirrored(&self, _index: u32) -> Option<PictureBytes<'_>> {
        None
    }
}

/// An image file: its name without a folder, and its bytes as PNG or JPEG.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureBytes<'a> {
    /// For example `cedar_color.jpg`.
    pub name: Cow<'a, str>,
    /// The encoded image.
    pub bytes: &'a [u8],
}

/// The images of one surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceFiles<'a> {
    /// Width and height of one repeat, metres.
    pub metres: f64,
    /// Base colour, sRGB.
    pub color: PictureBytes<'a>,
    /// Unit normals in tangent space, green upwards.
    pub normal: Option<PictureBytes<'a>>,
    /// Green: roughness, blue: metalness.
    pub orm: Option<PictureBytes<'a>>,
    /// The means of both, for materials without that image.
    pub gloss: [f32; 2],
}

/// Access to no images: surfaces have plain colours.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoImages;

impl Images for NoImages {
    fn files(&self, _: &str) -> Option<SurfaceFiles<'_>> {
        None
    }

    fn picture(&self, _: u32) -> Option<PictureBytes<'_>> {
        None
    }

    fn baked(&self, _: u32) -> Option<SurfaceFiles<'_>> {
        None
    }
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutFile<'a> {
    /// Path below the output's folder, with `/`.
    pub name: String,
    /// The whole content; images are borrowed, since copying a megabyte of them takes longer than building the model.
    pub bytes: Cow<'a, [u8]>,
}

/// Returns the folder of images beside an output with this stem.
fn picture_folder(stem: &str) -> String {
    format!("{stem}_textures")
}

/// Returns a name without blanks and slashes, for formats that use them as separators.
fn one_word(name: &str) -> String {
    let fits = |c: char| !(c.is_whitespace() || c.is_control() || "/\\#\"".contains(c));
    name.chars()
        .map(|c| if fits(c) { c } else { '_' })
        .collect()
}
