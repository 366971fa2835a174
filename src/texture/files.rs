//! The files of `textures/`: generated from formulas, embedded in the program.
//!
//! Colour: JPEG, quality 85, 512 px. Normals: JPEG, quality 84, without chroma subsampling,
//! 512 px; a PNG of the same relief is four times as large. Occlusion, roughness, metalness:
//! PNG, 256 px. glTF 2.0 permits both formats.

use std::sync::atomic::{AtomicUsize, Ordering};

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, Rgb as Pixel, RgbImage};

use super::{SURFACES, Surface};

/// Width and height of the colour and normal files in pixels.
pub const COLOR_SIZE: u32 = 512;

/// The quality of normal files. Relief as fine as gravel takes a third of a megabyte at 88.
const NORMAL_QUALITY: u8 = 84;

/// Width and height of the occlusion, roughness and metalness files in pixels.
pub const ORM_SIZE: u32 = COLOR_SIZE / 2;

/// Encodes the files of one surface as (file name, bytes), byte for byte as in `textures/`: one colour map per look,
/// then the normal map and the gloss map that they share.
pub fn encode(surface: &Surface) -> Vec<(String, Vec<u8>)> {
    let maps = surface.draw(COLOR_SIZE);
    let colors = maps.colors.iter().zip(surface.looks);
    let mut files: Vec<_> = colors
        .map(|(color, look)| (look.color_file(), jpeg(color, 85)))
        .collect();
    files.push((surface.normal_file(), jpeg(&maps.normal, NORMAL_QUALITY)));
    files.push((surface.orm_file(), png(halve(&maps.orm).into(), true)));
    files
}

/// Encodes the files of all surfaces as (file name, bytes), in the order of [`SURFACES`].
pub fn encode_all() -> Vec<(String, Vec<u8>)> {
    each(encode).into_iter().flatten().collect()
}

/// Maps a function over the surfaces on all processors; results are in the order of [`SURFACES`].
pub(super) fn each<T: Send>(make: impl Fn(&Surface) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let work = || {
        let mut done = vec![];
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(surface) = SURFACES.get(at) else {
                return done;
            };
            done.push((at, make(surface)));
        }
    };
    let mut made: Vec<(usize, T)> = std::thread::scope(|scope| {
        let hands: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let joined = hands.into_iter().map(|hand| hand.join());
        joined
            .flat_map(|done| done.expect("drawing does not panic"))
            .collect()
    });
    made.sort_by_key(|(at, _)| *at);
    made.into_iter().map(|(_, thing)| thing).collect()
}

/// Returns the embedded bytes of a file of `textures/` by name, such as `cedar_color.jpg`.
pub fn embedded(file: &str) -> Option<&'static [u8]> {
    EMBEDDED
        .iter()
        .find(|(name, _)| *name == file)
        .map(|(_, bytes)| *bytes)
}

/// Returns true if these are the bytes of a file of `textures/`, in its place.
pub fn is_embedded(bytes: &[u8]) -> bool {
    EMBEDDED.iter().any(|(_, own)| std::ptr::eq(*own, bytes))
}

macro_rules! embed {
    ($($surface:literal: $($look:literal)*;)*) => {
        &[$(
            $(embed!(@file concat!($look, "_color.jpg")),)*
            embed!(@file concat!($surface, "_normal.jpg")),
            embed!(@file concat!($surface, "_orm.png")),
        )*]
    };
    (@file $file:expr) => {
        ($file, include_bytes!(concat!("../../textures/", $file)))
    };
}

static EMBEDDED: &[(&str, &[u8])] = embed! {
    "cedar": "cedar_fresh" "cedar_brown" "cedar_silver" "cedar_dark" "hinoki" "sooted" "bengara" "bengara_worn" "bengara_old";
    "plank": "plank_fresh" "plank_brown" "plank_silver" "plank_dark";
    "keyaki": "keyaki_fresh" "keyaki_old";
    "boarding": "boarding_fresh" "boarding_brown" "boarding_silver" "boarding_dark";
    "clapboard": "clapboard_fresh" "clapboard_brown" "clapboard_silver" "clapboard_dark";
    "charred": "charred" "charred_worn" "charred_old";
    "bamboo": "bamboo_green" "bamboo" "bamboo_old";
    "plaster": "plaster" "plaster_worn" "plaster_old";
    "black_plaster": "black_plaster" "black_plaster_old";
    "clay": "clay" "clay_washed";
    "juraku": "juraku" "juraku_old";
    "mortar": "mortar" "mortar_old";
    "concrete": "concrete" "concrete_old";
    "namako": "namako" "namako_old";
    "tile": "tile" "tile_dirty" "tile_white";
    "kawara": "kawara_new" "kawara_worn" "kawara_old";
    "hongawara": "hongawara_new" "hongawara_worn" "hongawara_old";
    "noshi": "noshi_new" "noshi_worn" "noshi_old";
    "ibushi": "ibushi_new" "ibushi_worn" "ibushi_old";
    "board_roof": "board_roof_new" "board_roof_silver" "board_roof_mossy";
    "kokera": "kokera_new" "kokera_silver" "kokera_mossy";
    "bark": "bark_new" "bark_worn" "bark_mossy";
    "thatch": "thatch_new" "thatch_worn" "thatch_mossy";
    "seam_roof": "seam_roof" "seam_roof_rusty";
    "paper": "paper" "paper_yellow";
    "cloth": "indigo" "indigo_faded" "persimmon" "persimmon_faded" "cotton" "cotton_old";
    "tatami": "tatami" "tatami_old";
    "aluminium": "aluminium" "bronze_aluminium" "aluminium_dirty";
    "glass": "glass" "glass_mirror" "glass_dusty";
    "steel": "steel" "steel_rusty";
    "sheet": "sheet" "sheet_rusty";
    "stone": "stone" "stone_mossy";
    "gravel": "gravel";
    "foliage": "foliage";
    "rows": "rows";
    "water": "water";
    "earth": "earth";
    "doma": "doma" "doma_old";
};

/// Encodes an image as JPEG.
pub fn jpeg(picture: &RgbImage, quality: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture
        .write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, quality))
        .expect("pictures of the program fit a JPEG, and memory takes it");
    bytes
}

/// Encodes an image as PNG, as small as possible or fast.
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

/// Returns an image at half the size, each pixel the mean of four.
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
