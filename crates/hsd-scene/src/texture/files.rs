//! Files of `textures/`, which the program embeds, and encoders of images.

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageBuffer, ImageEncoder, PixelWithColorType, Rgb, RgbImage};

use hsd_textures::FILES;

/// Width and height of the colour and normal files in pixels.
pub const COLOR_SIZE: u32 = 512;

/// Width and height of the occlusion, roughness and metalness files in pixels.
pub const ORM_SIZE: u32 = COLOR_SIZE / 2;

/// Returns the embedded bytes of a file of `textures/` by name, such as `cedar_color.jpg`.
pub fn embedded(file: &str) -> Option<&'static [u8]> {
    FILES
        .iter()
        .find(|(name, _)| *name == file)
        .map(|(_, bytes)| *bytes)
}

/// Returns true if these are the bytes of a file of `textures/`, in its place.
pub fn is_embedded(bytes: &[u8]) -> bool {
    FILES.iter().any(|(_, own)| std::ptr::eq(*own, bytes))
}

/// Encodes an image as JPEG.
pub fn jpeg(picture: &RgbImage, quality: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture
        .write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, quality))
        .expect("pictures of the program fit a JPEG, and memory takes it");
    bytes
}

/// The time that a PNG may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// As small as possible.
    Tight,
    /// Packed quickly, with the best filter for each row.
    Quick,
    /// Packed quickly, with one filter: for textures that are drawn while a model is built.
    Quickest,
}

/// Encodes an image as PNG.
pub fn png<P>(picture: &ImageBuffer<P, Vec<u8>>, packing: Packing) -> Vec<u8>
where
    P: PixelWithColorType<Subpixel = u8>,
{
    png_of(
        picture.as_raw(),
        picture.dimensions(),
        P::COLOR_TYPE,
        packing,
    )
}

/// Does the work of [`png`] for all kinds of pixels, so that the encoder is compiled once.
fn png_of(
    pixels: &[u8],
    (width, height): (u32, u32),
    colour: ExtendedColorType,
    packing: Packing,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (compression, filter) = match packing {
        Packing::Tight => (CompressionType::Best, FilterType::Adaptive),
        Packing::Quick => (CompressionType::Fast, FilterType::Adaptive),
        Packing::Quickest => (CompressionType::Fast, FilterType::Up),
    };
    PngEncoder::new_with_quality(&mut bytes, compression, filter)
        .write_image(pixels, width, height, colour)
        .expect("pictures of the program fit a PNG, and memory takes it");
    bytes
}

/// Returns an image at half the size, each pixel the mean of four.
pub fn halve(picture: &RgbImage) -> RgbImage {
    RgbImage::from_fn(picture.width() / 2, picture.height() / 2, |x, y| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(i, j)| picture.get_pixel(2 * x + i, 2 * y + j).0);
        Rgb([0, 1, 2].map(|c| {
            let sum: u32 = four.iter().map(|pixel| u32::from(pixel[c])).sum();
            ((sum + 2) / 4) as u8
        }))
    })
}
