//! Decoders of image files: PNG, JPEG, TIFF and WebP.
//!
//! The decoders of `image` are generic over the file, so each crate that makes one compiles them all again. This crate compiles
//! them once, for any file.

use image::error::ImageResult;
use image::{ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::{BufRead, Seek};

/// A file that can be read from any position.
pub trait ImageFile: BufRead + Seek {}

impl<T: BufRead + Seek> ImageFile for T {}

/// Opens an image file, which must be of that format, and reads its header.
///
/// # Errors
/// If the header is damaged, or needs more memory than the limits allow.
pub fn decoder(
    file: &mut dyn ImageFile,
    format: ImageFormat,
    limits: Limits,
) -> ImageResult<Box<dyn ImageDecoder + '_>> {
    let mut reader = ImageReader::with_format(file, format);
    reader.limits(limits);
    Ok(Box::new(reader.into_decoder()?))
}
