//! The images in outputs: surface textures, and part textures converted for glTF.
//!
//! glTF supports PNG and JPEG. A part texture in a valid file of either format is copied unchanged; one that only a
//! lenient decoder reads (CMYK colours, a truncated end) is re-encoded as PNG; anything else is rejected.

mod png;

use crate::{Images, PictureBytes, SurfaceFiles};
use hsd_base::source::World;
use hsd_scene::Baked;
use hsd_scene::texture::{self, palette};
use std::borrow::Cow;
use std::io::{BufRead, Cursor, Seek};
use std::sync::Arc;

pub use png::PNG;

/// The signature of a JPEG.
pub const JPEG: &[u8] = b"\xff\xd8\xff";

/// The media type of GPU textures.
pub const KTX2: &str = "image/ktx2";

/// The reason that a part texture is missing from the output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureError {
    /// The file cannot be read; the reason.
    Unreadable(String),
    /// Neither PNG nor JPEG, or damaged.
    NoPicture,
    /// More pixels than the limit.
    TooLarge(u64),
}

/// All images of a scene.
#[derive(Clone, Debug, Default)]
pub struct Library {
    parts: Vec<Option<(String, Vec<u8>)>>,
    baked: Vec<Page>,
    mirrored: Vec<(String, Vec<u8>)>,
}

/// The files of a page of baked images: colour, normals, gloss.
type Page = [(String, Arc<[u8]>); 3];

impl Library {
    /// Loads part textures; calls `trouble` with the index of each that cannot be shown.
    pub fn load(
        paths: &[String],
        world: &dyn World,
        pixels: u64,
        mut trouble: impl FnMut(usize, PictureError),
    ) -> Library {
        let mut library = Library::default();
        for (i, path) in paths.iter().enumerate() {
            library.add(path, world, pixels, |error| trouble(i, error));
        }
        library
    }

    /// Loads one more part texture; calls `trouble` if it cannot be shown.
    pub fn add(
        &mut self,
        path: &str,
        world: &dyn World,
        pixels: u64,
        trouble: impl FnOnce(PictureError),
    ) {
        let read = world.picture_bytes(path);
        let bytes = read.map_err(|e| PictureError::Unreadable(e.to_string()));
        let file = bytes.and_then(|b| fit(path, b, pixels));
        self.parts.push(file.map_err(trouble).ok());
    }

    /// Adds the images baked for a scene.
    pub fn bake(&mut self, pages: &[Baked]) {
        self.baked = pages.iter().enumerate().map(page).collect();
    }

    /// Adds the images of reflections.
    pub fn mirror(&mut self, pictures: &[image::RgbImage]) {
        let one = |(n, picture): (usize, &image::RgbImage)| {
            (
                format!("mirrored_{}.jpg", n + 1),
                texture::jpeg(picture, 90),
            )
        };
        self.mirrored = pictures.iter().enumerate().map(one).collect();
    }

    /// Returns the pixels of a part texture, by its index.
    pub fn pixels(&self, index: u32) -> Option<image::RgbImage> {
        let (_, bytes) = self.parts.get(index as usize)?.as_ref()?;
        Some(image::load_from_memory(bytes).ok()?.into_rgb8())
    }
}

/// Names the files of a page.
fn page((index, baked): (usize, &Baked)) -> Page {
    let file = |kind: &str, bytes: &Arc<[u8]>| {
        let extension = if bytes.starts_with(PNG) { "png" } else { "jpg" };
        let name = format!("joinery_{}_{kind}.{extension}", index + 1);
        (name, bytes.clone())
    };
    [
        file("color", &baked.color),
        file("normal", &baked.normal),
        file("orm", &baked.orm),
    ]
}

impl Images for Library {
    fn files(&self, look: &str) -> Option<SurfaceFiles<'_>> {
        if look == palette::COLOURS {
            return Some(SurfaceFiles {
                metres: 1.0,
                color: PictureBytes {
                    name: Cow::Borrowed(palette::FILE),
                    bytes: palette::picture(),
                },
                normal: None,
                orm: None,
                gloss: palette::GLOSS,
            });
        }
        let (surface, look) = texture::look(look)?;
        let file = |name: String| {
            Some(PictureBytes {
                bytes: texture::embedded(&name)?,
                name: Cow::Owned(name),
            })
        };
        Some(SurfaceFiles {
            metres: surface.metres,
            color: file(look.color_file())?,
            normal: file(surface.normal_file()),
            orm: file(surface.orm_file()),
            gloss: surface.gloss,
        })
    }

    fn baked(&self, index: u32) -> Option<SurfaceFiles<'_>> {
        let page = self.baked.get(index as usize)?;
        let [color, normal, orm] = page.each_ref().map(|(name, bytes)| PictureBytes {
            name: Cow::Borrowed(name),
            bytes,
        });
        Some(SurfaceFiles {
            metres: 1.0,
            color,
            normal: Some(normal),
            orm: Some(orm),
            gloss: [1.0; 2],
        })
    }

    fn mirrored(&self, index: u32) -> Option<PictureBytes<'_>> {
        let (name, bytes) = self.mirrored.get(index as usize)?;
        Some(PictureBytes {
            name: Cow::Borrowed(name),
            bytes,
        })
    }

    fn picture(&self, index: u32) -> Option<PictureBytes<'_>> {
        let (name, bytes) = self.parts.get(index as usize)?.as_ref()?;
        Some(PictureBytes {
            name: Cow::Borrowed(name),
            bytes,
        })
    }
}

/// Returns the media type of an image by its signature.
pub fn mime(bytes: &[u8]) -> Option<&'static str> {
    if bytes.starts_with(PNG) {
        Some("image/png")
    } else if bytes.starts_with(JPEG) {
        Some("image/jpeg")
    } else if bytes.starts_with(b"\xabKTX 20\xbb\r\n\x1a\n") {
        Some(KTX2)
    } else {
        None
    }
}

/// Returns the width and height of a KTX2 in pixels.
pub fn ktx2_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| {
        bytes
            .get(at..at + 4)?
            .try_into()
            .ok()
            .map(u32::from_le_bytes)
    };
    Some((number(20)?, number(24)?))
}

/// Returns the width and height of an image file in pixels, from its first bytes.
pub fn size(mut file: impl BufRead + Seek) -> Option<(u32, u32)> {
    let start = file.fill_buf().ok()?;
    if start.starts_with(PNG) {
        return png::size(start);
    }
    let format = image::guess_format(start).ok()?;
    let decoder = hsd_image::decoder(&mut file, format, image::Limits::no_limits()).ok()?;
    Some(decoder.dimensions())
}

/// Converts a file to a format that glTF supports, named after its content.
fn fit(path: &str, bytes: Vec<u8>, limit: u64) -> Result<(String, Vec<u8>), PictureError> {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let bytes = png::without_packed(bytes);
    let (width, height) = size(Cursor::new(&bytes)).ok_or(PictureError::NoPicture)?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels > limit {
        return Err(PictureError::TooLarge(pixels));
    }
    if png::is_sound(&bytes) {
        return Ok((format!("{stem}.png"), bytes));
    }
    if whole_jpeg(&bytes) {
        return Ok((format!("{stem}.jpg"), bytes));
    }
    let picture = image::load_from_memory(&bytes).map_err(|_| PictureError::NoPicture)?;
    let encoded = if picture.color().has_alpha() {
        texture::png(&picture.into_rgba8(), texture::Packing::Quick)
    } else {
        texture::png(&picture.into_rgb8(), texture::Packing::Quick)
    };
    Ok((format!("{stem}.png"), encoded))
}

/// Returns true if a PNG or JPEG is truncated.
pub fn is_cut(bytes: &[u8]) -> bool {
    bytes.starts_with(PNG) && !png::is_whole(bytes) || bytes.starts_with(JPEG) && !ends(bytes)
}

/// Returns true if a JPEG has an end marker, possibly with other data after it.
fn ends(jpeg: &[u8]) -> bool {
    let mut pairs = jpeg.windows(2).rev().take(4096);
    pairs.any(|pair| pair == b"\xff\xd9")
}

/// Returns true if a JPEG has one or three channels of eight bits and an end marker.
fn whole_jpeg(bytes: &[u8]) -> bool {
    let Some(mut rest) = bytes.strip_prefix(b"\xff\xd8") else {
        return false;
    };
    while let [0xff, marker, high, low, after @ ..] = rest {
        let length = usize::from(u16::from_be_bytes([*high, *low]));
        match marker {
            0xff => rest = &rest[1..], // padding before a marker
            0xc0..=0xc2 => {
                let (depth, channels) = (after.first(), after.get(5));
                return ends(bytes) && depth == Some(&8) && matches!(channels, Some(1 | 3));
            }
            _ if length < 2 || rest.len() < length + 2 => return false,
            _ => rest = &rest[length + 2..],
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use crate::images::*;

    fn encoded(format: image::ImageFormat) -> Vec<u8> {
        let mut out = Cursor::new(vec![]);
        let picture = image::RgbImage::from_pixel(4, 2, image::Rgb([200, 100, 50]));
        picture.write_to(&mut out, format).expect("memory takes it");
        out.into_inner()
    }

    #[test]
    fn sound_files_are_copied() {
        let (png, jpeg) = (
            encoded(image::ImageFormat::Png),
            encoded(image::ImageFormat::Jpeg),
        );
        assert_eq!(
            fit("a/戸.jpg", png.clone(), 8),
            Ok(("戸.png".into(), png.clone()))
        );
        assert_eq!(fit("戸.PNG", jpeg.clone(), 8), Ok(("戸.jpg".into(), jpeg)));
        assert_eq!(fit("戸.png", png, 7), Err(PictureError::TooLarge(8)));
    }

    #[test]
    fn damaged_files_are_encoded_anew_or_refused() {
        let mut open = encoded(image::ImageFormat::Jpeg);
        open.truncate(open.len() - 2);
        let fixed = fit("a.jpg", open, 8);
        assert!(
            matches!(&fixed, Ok((name, bytes)) if name == "a.png" && png::is_whole(bytes)),
            "{fixed:?}"
        );
        let mut cut = encoded(image::ImageFormat::Png);
        let last = cut.len() - 20; // in the pixels
        let mut wrong = cut.clone();
        wrong[last] ^= 0x55;
        assert_eq!(fit("a.png", wrong, 8), Err(PictureError::NoPicture));
        cut.truncate(40);
        assert_eq!(fit("a.png", cut, 8), Err(PictureError::NoPicture));
        assert_eq!(
            fit("a.png", b"BM not a picture".to_vec(), 8),
            Err(PictureError::NoPicture)
        );
    }
}
