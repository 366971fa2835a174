//! Images changed for MTL, whose readers disagree on how a factor meets a map: most of them ignore the factor. The tint
//! of a material is therefore multiplied into its image, and the roughness is an image of its own.

use crate::PictureBytes;
use hsd_scene::texture::samples::{encoded, linear};
use hsd_scene::texture::{Packing, jpeg, png};
use image::GrayImage;

/// Quality of tinted JPEGs, on the scale of 1 to 100.
const QUALITY: u8 = 92;

/// A tint in steps of a screen: materials that differ by less share an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tint([u8; 3]);

impl Tint {
    /// Rounds a linear tint; channels over 1 become 1.
    pub(super) fn of(linear: [f32; 4]) -> Tint {
        let [r, g, b, _] = linear;
        Tint([r, g, b].map(encoded))
    }

    /// Returns true if the tint changes nothing.
    pub(super) fn is_white(self) -> bool {
        self.0 == [u8::MAX; 3]
    }

    /// Returns the name of an image in this tint, for example `cedar_color_bc9584.jpg`.
    pub(super) fn name(self, picture: &str) -> String {
        let [r, g, b] = self.0;
        suffixed(picture, &format!("{r:02x}{g:02x}{b:02x}"))
    }

    /// Returns the image multiplied by the tint in linear light, in the format that it had; `None` if it cannot be read.
    pub(super) fn apply(self, picture: &PictureBytes<'_>) -> Option<Vec<u8>> {
        let tables = self
            .0
            .map(linear)
            .map(|factor| std::array::from_fn::<u8, 256, _>(|x| encoded(factor * linear(x as u8))));
        let tint = |pixel: &mut [u8]| {
            for (channel, table) in pixel.iter_mut().zip(&tables) {
                *channel = table[usize::from(*channel)];
            }
        };
        let image = image::load_from_memory(picture.bytes).ok()?;
        if image.color().has_alpha() {
            let mut image = image.into_rgba8();
            image.pixels_mut().for_each(|p| tint(&mut p.0));
            return Some(png(&image, Packing::Quickest));
        }
        let mut image = image.into_rgb8();
        image.pixels_mut().for_each(|p| tint(&mut p.0));
        Some(match picture.name.ends_with(".png") {
            true => png(&image, Packing::Quickest),
            false => jpeg(&image, QUALITY),
        })
    }
}

/// Returns a channel of an image of occlusion, roughness and metalness, multiplied by a factor, as a grey PNG; `None` if
/// it is black or the image cannot be read.
pub(super) fn channel(orm: &PictureBytes<'_>, channel: usize, factor: f32) -> Option<Vec<u8>> {
    if factor <= 0.0 {
        return None;
    }
    let image = image::load_from_memory(orm.bytes).ok()?.into_rgb8();
    let (width, height) = image.dimensions();
    let grey: Vec<u8> = image
        .pixels()
        .map(|p| (f32::from(p.0[channel]) * factor.min(1.0)).round() as u8)
        .collect();
    let is_black = grey.iter().all(|x| *x == 0);
    let grey = GrayImage::from_raw(width, height, grey).filter(|_| !is_black)?;
    Some(png(&grey, Packing::Quickest))
}

/// Inserts a suffix before the extension.
fn suffixed(name: &str, suffix: &str) -> String {
    match name.rsplit_once('.') {
        Some((stem, extension)) => format!("{stem}_{suffix}.{extension}"),
        None => format!("{name}_{suffix}"),
    }
}
