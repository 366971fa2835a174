//! GPU textures: KTX2 in ETC1S with all mip levels. They stay compressed in GPU memory, where a JPEG takes four bytes
//! per pixel.

use crate::{Images, PictureBytes, SurfaceFiles};
use hsd_scene::Scene;
use hsd_scene::texture::{self, palette};
use ktx::dfd::khr_df::KHR_DF_PRIMARIES_UNSPECIFIED;
use ktx::encode_params::{BasisParams, KTX_BASIS_CODEC_ETC1S, KTX_BASIS_PARAMS_SIZE};
use ktx::texture::{TextureCreateInfo, TextureCreateStorage};
use ktx::{KtxResult, Texture2, VkFormat};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread;

/// Quality from 1 to 255; higher is better and larger. At 128, grey tiles turn violet.
const QUALITY: u32 = 192;

/// Encoder effort, from 0 to 6.
const EFFORT: u32 = 1;

/// The images of a scene, with colours and gloss as KTX2. Normal maps, and images whose sides are not multiples of
/// four, are unchanged.
pub struct Ktx2<'a> {
    plain: &'a dyn Images,
    made: Vec<(Task<'a>, Option<Arc<[u8]>>)>,
}

/// An image to encode.
#[derive(Clone, Copy, PartialEq)]
struct Task<'a> {
    bytes: &'a [u8],
    content: Content,
}

/// The meaning of an image's values.
#[derive(Clone, Copy, PartialEq)]
enum Content {
    /// sRGB colours and opacity.
    Color,
    /// Linear values.
    Gloss,
}

impl<'a> Ktx2<'a> {
    /// Encodes the images of materials on all processors; the bytes do not depend on their number.
    pub fn new(scene: &Scene, plain: &'a dyn Images) -> Ktx2<'a> {
        let tasks = tasks(used(scene), plain, true);
        let encoded = all(&tasks).into_iter().map(|bytes| bytes.map(Arc::from));
        Ktx2 {
            plain,
            made: tasks.into_iter().zip(encoded).collect(),
        }
    }

    /// The same for a tile, on the thread that makes it, with or without gloss. Images of surfaces, which are the program's
    /// own and the same in all tiles, are encoded once.
    pub fn of_tile(
        materials: &[hsd_scene::Material],
        plain: &'a dyn Images,
        gloss: bool,
    ) -> Ktx2<'a> {
        let tasks = tasks(materials, plain, gloss);
        let made = tasks.into_iter().map(|task| {
            let bytes = match texture::is_embedded(task.bytes) {
                true => kept(task),
                false => encoded(task).map(Arc::from),
            };
            (task, bytes)
        });
        Ktx2 {
            plain,
            made: made.collect(),
        }
    }

    /// Returns an image in its output form.
    fn put<'b>(&'b self, picture: PictureBytes<'b>, content: Content) -> PictureBytes<'b> {
        let same = |t: &Task<'_>| std::ptr::eq(t.bytes, picture.bytes) && t.content == content;
        let made = self.made.iter().find(|(task, _)| same(task));
        let Some(bytes) = made.and_then(|(_, bytes)| bytes.as_deref()) else {
            return picture;
        };
        let stem = picture.name.rsplit_once('.').map(|(stem, _)| stem);
        PictureBytes {
            name: Cow::Owned(format!("{}.ktx2", stem.unwrap_or(&picture.name))),
            bytes,
        }
    }

    fn put_all<'b>(&'b self, files: SurfaceFiles<'b>) -> SurfaceFiles<'b> {
        SurfaceFiles {
            color: self.put(files.color, Content::Color),
            orm: files.orm.map(|orm| self.put(orm, Content::Gloss)),
            ..files
        }
    }
}

impl Images for Ktx2<'_> {
    fn files(&self, look: &str) -> Option<SurfaceFiles<'_>> {
        self.plain.files(look).map(|files| self.put_all(files))
    }

    fn picture(&self, index: u32) -> Option<PictureBytes<'_>> {
        let picture = self.plain.picture(index)?;
        Some(self.put(picture, Content::Color))
    }

    fn mirrored(&self, index: u32) -> Option<PictureBytes<'_>> {
        let picture = self.plain.mirrored(index)?;
        Some(self.put(picture, Content::Color))
    }

    fn baked(&self, index: u32) -> Option<SurfaceFiles<'_>> {
        self.plain.baked(index).map(|files| self.put_all(files))
    }
}

/// Lists the images of materials, each once.
fn tasks<'a, 'm>(
    materials: impl IntoIterator<Item = &'m hsd_scene::Material>,
    plain: &'a dyn Images,
    gloss: bool,
) -> Vec<Task<'a>> {
    let mut tasks: Vec<Task<'a>> = vec![];
    let mut add = |bytes, content| {
        let task = Task { bytes, content };
        if !tasks.contains(&task) {
            tasks.push(task);
        }
    };
    for material in materials {
        let mirrored = material.mirrored.and_then(|index| plain.mirrored(index));
        if let Some(picture) = mirrored {
            add(picture.bytes, Content::Color);
        }
        let files = match &material.image {
            hsd_scene::Image::None => None,
            // Blocks of the format would mix neighbouring colours.
            hsd_scene::Image::Surface(name) if *name == palette::COLOURS => None,
            hsd_scene::Image::Surface(name) => plain.files(name),
            hsd_scene::Image::Baked(index) => plain.baked(*index),
            hsd_scene::Image::Picture(index) => {
                if let Some(picture) = plain.picture(*index) {
                    add(picture.bytes, Content::Color);
                }
                None
            }
        };
        if let Some(files) = files {
            add(files.color.bytes, Content::Color);
            if let Some(orm) = files.orm.filter(|_| gloss) {
                add(orm.bytes, Content::Gloss);
            }
        }
    }
    tasks
}

/// Encodes an image of the program once; other threads wait for it.
fn kept(task: Task<'_>) -> Option<Arc<[u8]>> {
    type Slot = Arc<OnceLock<Option<Arc<[u8]>>>>;
    static KEPT: Mutex<BTreeMap<(usize, bool), Slot>> = Mutex::new(BTreeMap::new());
    let key = (task.bytes.as_ptr().addr(), task.content == Content::Gloss);
    let slot = {
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        kept.entry(key).or_default().clone()
    };
    slot.get_or_init(|| encoded(task).map(Arc::from)).clone()
}

/// Returns the materials of meshes that nodes show.
fn used(scene: &Scene) -> impl Iterator<Item = &hsd_scene::Material> {
    let mut shown = vec![false; scene.materials.len()];
    let meshes = scene.nodes.iter().filter_map(|n| n.mesh);
    let mut seen = vec![false; scene.meshes.len()];
    for mesh in meshes.map(|m| m.0 as usize) {
        let new = seen
            .get_mut(mesh)
            .is_some_and(|s| !std::mem::replace(s, true));
        if new {
            for primitive in &scene.meshes[mesh].primitives {
                if let Some(shown) = shown.get_mut(primitive.material.0 as usize) {
                    *shown = true;
                }
            }
        }
    }
    let both = scene.materials.iter().zip(shown);
    both.filter(|(_, shown)| *shown)
        .map(|(material, _)| material)
}

/// Encodes in parallel; the results are in the order of the tasks.
fn all(tasks: &[Task<'_>]) -> Vec<Option<Vec<u8>>> {
    let results: Vec<Mutex<Option<Vec<u8>>>> = tasks.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some(i) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|i| *i < tasks.len())
        {
            let made = encoded(tasks[i]);
            *results[i].lock().unwrap_or_else(PoisonError::into_inner) = made;
        }
    };
    let workers = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..workers.min(tasks.len()) {
            scope.spawn(work);
        }
    });
    let inner = |m: Mutex<_>| m.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().map(inner).collect()
}

/// Encodes one image; `None` if the extension or the encoder does not support it.
fn encoded(task: Task<'_>) -> Option<Vec<u8>> {
    let picture = image::load_from_memory(task.bytes).ok()?;
    let size = [picture.width(), picture.height()];
    let fits = |side: &u32| *side > 0 && side.is_multiple_of(4);
    if !size.iter().all(fits) {
        return None;
    }
    let holes = task.content == Content::Color && picture.color().has_alpha();
    packed(picture.into_rgba8(), task.content, holes).ok()
}

fn packed(picture: image::RgbaImage, content: Content, holes: bool) -> KtxResult<Vec<u8>> {
    let (width, height) = picture.dimensions();
    let levels = width.max(height).ilog2() + 1;
    let mut texture = Texture2::create(
        &TextureCreateInfo {
            gl_internalformat: 0,
            vk_format: match (content, holes) {
                (Content::Color, true) => VkFormat::R8G8B8A8_SRGB,
                (Content::Color, false) => VkFormat::R8G8B8_SRGB,
                (Content::Gloss, _) => VkFormat::R8G8B8_UNORM,
            },
            dfd: None,
            base_width: width,
            base_height: height,
            base_depth: 1,
            num_dimensions: 2,
            num_levels: levels,
            num_layers: 1,
            num_faces: 1,
            is_array: false,
            generate_mipmaps: false,
        },
        TextureCreateStorage::AllocStorage,
    )?;
    if content == Content::Gloss {
        texture.set_primaries(KHR_DF_PRIMARIES_UNSPECIFIED)?; // the extension wants it of plain numbers
    }
    let mut level = picture;
    for number in 0..levels {
        let pixels = level.pixels();
        let bytes: Vec<u8> = match holes {
            true => level.as_raw().clone(),
            false => pixels.flat_map(|p| [p[0], p[1], p[2]]).collect(),
        };
        texture.set_image_from_memory(number, 0, 0, &bytes)?;
        level = halved(&level, content);
    }
    texture.compress_basis_ex(&BasisParams {
        struct_size: KTX_BASIS_PARAMS_SIZE,
        codec: KTX_BASIS_CODEC_ETC1S,
        thread_count: 1,
        etc1s_compression_level: EFFORT,
        quality_level: QUALITY,
        ..BasisParams::default()
    })?;
    texture.write_to_memory()
}

/// Returns the image at half width and height. Colours are averaged as light, approximated by the square of their
/// values, and weighted by opacity; integer arithmetic gives equal results on all machines.
fn halved(picture: &image::RgbaImage, content: Content) -> image::RgbaImage {
    let (width, height) = picture.dimensions();
    let pixel = |x: u32, y: u32| picture.get_pixel(x.min(width - 1), y.min(height - 1)).0;
    image::RgbaImage::from_fn((width / 2).max(1), (height / 2).max(1), |x, y| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| pixel(2 * x + i, 2 * y + j));
        let mean = |k: usize| {
            let numbers = four.map(|p| u32::from(p[k]));
            if k == 3 || content == Content::Gloss {
                return (numbers.iter().sum::<u32>() + 2) / 4;
            }
            let weights = four.map(|p| u32::from(p[3]));
            let light = numbers.iter().zip(weights).map(|(n, w)| n * n * w);
            let square = light.sum::<u32>() / weights.iter().sum::<u32>().max(1);
            square.isqrt()
        };
        image::Rgba([0, 1, 2, 3].map(|k| mean(k) as u8))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgba, RgbaImage};

    #[test]
    fn smaller_pictures_keep_their_light() {
        let checks = RgbaImage::from_fn(4, 2, |x, y| match (x + y) % 2 {
            0 => Rgba([255, 255, 255, 255]),
            _ => Rgba([0, 0, 0, 255]),
        });
        let color = halved(&checks, Content::Color);
        assert_eq!(color.dimensions(), (2, 1));
        assert_eq!(color.get_pixel(0, 0).0, [180, 180, 180, 255]);
        let gloss = halved(&checks, Content::Gloss);
        assert_eq!(gloss.get_pixel(1, 0).0, [128, 128, 128, 255]);
        assert_eq!(halved(&gloss, Content::Gloss).dimensions(), (1, 1));
        // Nothing has no colour.
        let half = RgbaImage::from_fn(2, 2, |x, _| Rgba([200, 0, 0, 255 * x as u8]));
        assert_eq!(
            halved(&half, Content::Color).get_pixel(0, 0).0,
            [200, 0, 0, 128]
        );
    }
}
