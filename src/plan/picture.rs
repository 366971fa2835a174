//! A picture as it comes from a camera or a scanner.

use image::error::{ImageError, LimitErrorKind};
use image::imageops::{self, FilterType};
use image::{DynamicImage, ImageDecoder, ImageReader, Limits, RgbImage};
use std::io::Cursor;

/// The most pixels of a picture.
const MOST: u64 = 100_000_000;
/// The longer side of the picture that is read, pixels: a plan of 30 units still has 80 pixels a unit.
const LONGEST: u32 = 2600;

/// A picture, upright, on white where it is clear, small enough to be read quickly.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its pixels.
    pub pixels: RgbImage,
    /// Pixels of the file in one of them.
    pub shrink: f64,
}

/// Why a picture cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// Not PNG, JPEG, TIFF or WebP.
    Format,
    /// More pixels than are read.
    TooLarge,
    /// It ends too early, or its data make no sense.
    Damaged(String),
}

impl Picture {
    /// Decodes a picture and turns it as its camera was held.
    ///
    /// # Errors
    /// If it is none, damaged or too large.
    pub fn decode(bytes: &[u8]) -> Result<Picture, Unreadable> {
        let damaged = |e: &ImageError| Unreadable::Damaged(e.to_string());
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|_| Unreadable::Format)?;
        reader.format().ok_or(Unreadable::Format)?;
        let mut limits = Limits::default();
        limits.max_alloc = Some(1 << 30);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(|e| refused(&e))?;
        let (width, height) = decoder.dimensions();
        if u64::from(width) * u64::from(height) > MOST {
            return Err(Unreadable::TooLarge);
        }
        let orientation = decoder.orientation().map_err(|e| damaged(&e))?;
        let mut image = DynamicImage::from_decoder(decoder).map_err(|e| refused(&e))?;
        image.apply_orientation(orientation);
        Ok(Picture::of(&image))
    }

    fn of(image: &DynamicImage) -> Picture {
        let pixels = on_white(image);
        let longest = pixels.width().max(pixels.height());
        if longest <= LONGEST {
            return Picture {
                pixels,
                shrink: 1.0,
            };
        }
        let shrink = f64::from(longest) / f64::from(LONGEST);
        let size = |s: u32| ((f64::from(s) / shrink).round() as u32).max(1);
        let pixels = imageops::resize(
            &pixels,
            size(pixels.width()),
            size(pixels.height()),
            FilterType::Triangle,
        );
        Picture { pixels, shrink }
    }
}

fn refused(error: &ImageError) -> Unreadable {
    match error {
        ImageError::Limits(limit)
            if matches!(
                limit.kind(),
                LimitErrorKind::DimensionError | LimitErrorKind::InsufficientMemory
            ) =>
        {
            Unreadable::TooLarge
        }
        ImageError::Unsupported(_) => Unreadable::Format,
        other => Unreadable::Damaged(other.to_string()),
    }
}

/// Colours without transparency: clear parts are paper.
fn on_white(image: &DynamicImage) -> RgbImage {
    if !image.color().has_alpha() {
        return image.to_rgb8();
    }
    let clear = image.to_rgba8();
    RgbImage::from_fn(clear.width(), clear.height(), |x, y| {
        let [r, g, b, a] = clear.get_pixel(x, y).0.map(u16::from);
        image::Rgb([r, g, b].map(|c| ((c * a + 255 * (255 - a)) / 255) as u8))
    })
}
