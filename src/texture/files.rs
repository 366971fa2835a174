//! The files of `textures/`: encoded from the formulas, embedded in the program.
//!
//! Colour: JPEG, quality 88, 512 px. Normals: JPEG, quality 92, without chroma subsampling,
//! 512 px; a PNG of the same relief is four times as large. Occlusion, roughness, metalness:
//! PNG, 256 px. glTF 2.0 permits both formats.

use std::io;
use std::path::{Path, PathBuf};

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, Rgb as Pixel, RgbImage};

use super::{SURFACES, Surface};

/// Width and height of the colour and normal files in pixels.
pub const COLOR_SIZE: u32 = 512;

/// Width and height of the occlusion, roughness and metalness files in pixels.
pub const ORM_SIZE: u32 = COLOR_SIZE / 2;

/// The files of one surface as (file name, bytes), the very bytes that lie in `textures/`.
pub fn encode(surface: &Surface) -> Vec<(String, Vec<u8>)> {
    let maps = (surface.draw)(COLOR_SIZE);
    vec![
        (surface.color_file(), jpeg(&maps.color, 88)),
        (surface.normal_file(), jpeg(&maps.normal, 92)),
        (surface.orm_file(), png(halve(&maps.orm).into(), true)),
    ]
}

/// Writes the files of all surfaces into a directory, which is made where it is missing.
/// Returns their paths in the order of [`SURFACES`].
///
/// # Errors
/// When the directory or a file cannot be written.
pub fn write_all(dir: &Path) -> io::Result<Vec<PathBuf>> {
    std::fs::create_dir_all(dir)?;
    let mut paths = Vec::new();
    for (file, bytes) in SURFACES.iter().flat_map(encode) {
        let path = dir.join(file);
        std::fs::write(&path, bytes)?;
        paths.push(path);
    }
    Ok(paths)
}

/// The embedded bytes of a file of `textures/`, by its name, such as `cedar_color.jpg`.
pub fn embedded(file: &str) -> Option<&'static [u8]> {
    EMBEDDED
        .iter()
        .find(|(name, _)| *name == file)
        .map(|(_, bytes)| *bytes)
}

macro_rules! embed {
    ($($name:literal)*) => {
        &[$(
            embed!(@file concat!($name, "_color.jpg")),
            embed!(@file concat!($name, "_normal.jpg")),
            embed!(@file concat!($name, "_orm.png")),
        )*]
    };
    (@file $file:expr) => {
        ($file, include_bytes!(concat!("../../textures/", $file)))
    };
}

static EMBEDDED: &[(&str, &[u8])] = embed! {
    "cedar" "cedar_board" "clapboard" "charred" "bamboo"
    "plaster" "clay" "namako"
    "kawara" "board_roof" "bark" "thatch"
    "paper" "cloth" "tatami"
    "aluminium" "glass" "steel" "concrete" "mortar" "tile"
    "stone" "earth"
};

/// A picture as JPEG.
pub fn jpeg(picture: &RgbImage, quality: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture
        .write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, quality))
        .expect("pictures of the program fit a JPEG, and memory takes it");
    bytes
}

/// A picture as PNG, as small as it gets, or quickly.
pub fn png(picture: DynamicImage, small: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (compression, filter) = match small {
        true => (CompressionType::Best, FilterType::Adaptive),
        false => (CompressionType::Fast, FilterType::Up),
    };
    picture
        .write_with_encoder(PngEncoder::new_with_quality(
            &mut bytes,
            compression,
            filter,
        ))
        .expect("pictures of the program fit a PNG, and memory takes it");
    bytes
}

/// Half the size, each pixel the mean of four.
pub(super) fn halve(picture: &RgbImage) -> RgbImage {
    RgbImage::from_fn(picture.width() / 2, picture.height() / 2, |x, y| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(i, j)| picture.get_pixel(2 * x + i, 2 * y + j).0);
        Pixel([0, 1, 2].map(|c| {
            let sum: u32 = four.iter().map(|pixel| u32::from(pixel[c])).sum();
            ((sum + 2) / 4) as u8
        }))
    })
}
