//! Surfaces as images show them: tables from the bytes of a texture to those of an image.

use super::FINE;
use hsd_ir::material::{self, Surface, SurfaceId};
use hsd_scene::texture::samples::{self, Samples};
use std::sync::{LazyLock, OnceLock};

/// A surface with its sampled textures.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) surface: &'static Surface,
    pub(super) samples: Option<&'static Samples>,
    /// The colour of a pixel in full daylight, by channel and byte of the texture.
    pub(super) lit: [[u8; 256]; 3],
    /// Roughness and metalness of a pixel, by byte of the texture.
    pub(super) gloss: [[u8; 256]; 2],
}

impl Shown {
    /// Returns a surface, prepared on first use.
    pub(super) fn of(id: SurfaceId) -> &'static Shown {
        static ALL: LazyLock<Vec<OnceLock<Shown>>> =
            LazyLock::new(|| (0..material::count()).map(|_| OnceLock::new()).collect());
        ALL[id.index()].get_or_init(|| Shown::new(id.surface()))
    }

    fn new(surface: &'static Surface) -> Shown {
        let shares = [surface.roughness, surface.metallic];
        Shown {
            surface,
            samples: surface.picture.and_then(samples::samples),
            lit: std::array::from_fn(|k| {
                let of = |c: u8| samples::encoded(mean(samples::linear(c) * surface.tint[k]));
                std::array::from_fn(|c| of(c as u8))
            }),
            gloss: std::array::from_fn(|k| {
                let of = |c: u8| byte(f64::from(mean(f32::from(c) / 255.0 * shares[k])));
                std::array::from_fn(|c| of(c as u8))
            }),
        }
    }
}

/// Returns the mean of a pixel's rays that all see this, as it is when they are added up one by one.
pub(super) fn mean(one: f32) -> f32 {
    let sum = (0..FINE * FINE).fold(0.0, |sum, _| sum + one);
    sum / (FINE * FINE) as f32
}

/// Converts a share to a byte.
pub(super) fn byte(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
