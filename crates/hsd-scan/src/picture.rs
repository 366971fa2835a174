//! A picture as it comes from a camera or a scanner.

use hsd_base::budget::Budget;
use image::error::{ImageError, LimitErrorKind};
use image::imageops;
use image::metadata::Orientation;
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, Limits, RgbImage};
use std::io::Cursor;

/// The most bytes that an image may take while it is decoded.
pub const MOST_BYTES: u64 = most_bytes(Budget::MEMORY);
/// The most bytes that a decoder may take for what stands before the pixels, such as a colour profile.
const MOST_BESIDE: u64 = 32 << 20;
/// The longer side of the picture that is read, pixels: a plan of 30 units still has 70 pixels a unit.
const LONGEST: u32 = 2200;

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
        Ok(Picture::of(upright(bytes, MOST_BYTES)?.0))
    }

    /// Decodes an image like [`decode`](Picture::decode) in a run that may take about this memory, bytes.
    ///
    /// # Errors
    /// Those of `decode`.
    pub fn decode_within(bytes: &[u8], memory: u64) -> Result<Picture, Unreadable> {
        Ok(Picture::of(upright(bytes, most_bytes(memory))?.0))
    }

    /// Decodes a photograph in its full size, with what its camera wrote (Exif).
    ///
    /// # Errors
    /// If it is none, damaged or too large.
    pub fn whole(bytes: &[u8]) -> Result<(Picture, Option<Vec<u8>>), Unreadable> {
        let (image, exif) = upright(bytes, MOST_BYTES)?;
        let pixels = on_white(image);
        Ok((
            Picture {
                pixels,
                shrink: 1.0,
            },
            exif,
        ))
    }

    /// Shrinks an image so that it can be read quickly.
    pub fn of(image: DynamicImage) -> Picture {
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
        let pixels = imageops::thumbnail(&pixels, size(pixels.width()), size(pixels.height()));
        Picture { pixels, shrink }
    }
}

/// Returns the most bytes that an image may take while it is decoded, in a run that may take about this memory.
pub const fn most_bytes(memory: u64) -> u64 {
    memory - memory / 8
}

/// The picture of a file, turned as its camera was held, and its Exif block.
fn upright(bytes: &[u8], most: u64) -> Result<(DynamicImage, Option<Vec<u8>>), Unreadable> {
    let damaged = |e: &ImageError| Unreadable::Damaged(e.to_string());
    let format = image::guess_format(bytes).map_err(|_| Unreadable::Format)?;
    if format == ImageFormat::Jpeg && !is_whole(bytes) {
        return Err(Unreadable::Damaged(
            "the picture ends before its end mark".to_owned(),
        ));
    }
    let mut limits = Limits::default();
    // A decoder of PNG takes its pixels elsewhere; others need memory for rows or blocks of them.
    limits.max_alloc = Some(match format {
        ImageFormat::Png => MOST_BESIDE,
        _ => most,
    });
    let mut file = Cursor::new(bytes);
    let mut decoder = hsd_image::decoder(&mut file, format, limits).map_err(|e| refused(&e))?;
    let exif = decoder.exif_metadata().ok().flatten();
    let orientation = decoder.orientation().map_err(|e| damaged(&e))?;
    if bytes_of(&decoder, orientation) > most {
        return Err(Unreadable::TooLarge);
    }
    let mut image = DynamicImage::from_decoder(decoder).map_err(|e| refused(&e))?;
    image.apply_orientation(orientation);
    Ok((image, exif))
}

/// Returns the most bytes that an image takes while it is decoded, turned and made RGB of 8 bits.
fn bytes_of(decoder: &impl ImageDecoder, orientation: Orientation) -> u64 {
    let (width, height) = decoder.dimensions();
    let pixels = u64::from(width) * u64::from(height);
    let own = decoder.total_bytes();
    let copies = match decoder.color_type() {
        ColorType::Rgb8 => 0,
        // Without what is clear, after that as RGB.
        colour if colour.has_alpha() => 7,
        _ => 3,
    };
    let turned = match orientation {
        Orientation::NoTransforms => 0,
        _ => own,
    };
    own.saturating_add(pixels.saturating_mul(copies).max(turned))
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

/// Whether a JPEG ends with its end mark. Its decoder fills what is missing with grey, which would be read as paper.
///
/// The small picture within the head of a photograph has an end mark of its own, so the head is left out.
fn is_whole(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let [0xff, kind, high, low, ..] = bytes.get(at..).unwrap_or_default() {
        if *kind == 0xda {
            return bytes[at..].windows(2).any(|pair| pair == [0xff, 0xd9]);
        }
        // Marks may be filled up with 0xff.
        at += if *kind == 0xff {
            1
        } else {
            2 + usize::from(u16::from_be_bytes([*high, *low]))
        };
    }
    false
}

/// Colours without transparency: clear parts are paper.
fn on_white(image: DynamicImage) -> RgbImage {
    if !image.color().has_alpha() {
        return image.into_rgb8();
    }
    let clear = image.into_rgba8();
    RgbImage::from_fn(clear.width(), clear.height(), |x, y| {
        let [r, g, b, a] = clear.get_pixel(x, y).0.map(u16::from);
        image::Rgb([r, g, b].map(|c| ((c * a + 255 * (255 - a)) / 255) as u8))
    })
}
