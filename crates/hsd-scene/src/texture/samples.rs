//! Downscaled surface textures for point lookup, from which images are baked.
//!
//! Read from the embedded files once per run, and halved to about the resolution of a baked image.

use super::{Look, SURFACES, Surface, embedded};
use image::RgbImage;
use std::sync::{LazyLock, OnceLock};

/// Minimum resolution, pixels per metre.
const DENSITY: f64 = 200.0;

/// The properties of a surface at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Base colour, linear RGB.
    pub color: [f32; 3],
    /// Normal in tangent space: right, up, out.
    pub normal: [f32; 3],
    /// From 0, mirror-smooth, to 1, dull.
    pub roughness: f32,
    /// 0 or 1.
    pub metallic: f32,
}

/// The bytes of the maps of a surface at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texels {
    /// Base colour, sRGB.
    pub color: [u8; 3],
    /// Normal in tangent space, as [`normal`] decodes it.
    pub normal: [u8; 3],
    /// Occlusion, roughness and metalness.
    pub orm: [u8; 3],
}

/// A surface without a texture.
pub const PLAIN: Sample = Sample {
    color: [1.0; 3],
    normal: [0.0, 0.0, 1.0],
    roughness: 1.0,
    metallic: 1.0,
};

/// The maps of one surface.
#[derive(Debug)]
pub struct Samples {
    metres: f64,
    /// Width and height of the colours and normals.
    size: [u32; 2],
    /// Colour and normal of each pixel, side by side in memory since they are used together.
    face: Vec<[u8; 6]>,
    orm: RgbImage,
}

/// Every look with its surface, and its samples once loaded.
type Shelf = Vec<(&'static Surface, &'static Look, OnceLock<Option<Samples>>)>;

/// Returns the samples of a look by name.
pub fn samples(name: &str) -> Option<&'static Samples> {
    static READ: LazyLock<Shelf> = LazyLock::new(|| {
        let looks = SURFACES.iter().flat_map(|surface| {
            let looks = surface.looks.iter();
            looks.map(move |look| (surface, look, OnceLock::new()))
        });
        looks.collect()
    });
    let (surface, look, read) = READ.iter().find(|(_, look, _)| look.name == name)?;
    read.get_or_init(|| Samples::read(surface, look)).as_ref()
}

impl Samples {
    fn read(surface: &Surface, look: &Look) -> Option<Samples> {
        let small = |file: String| {
            let mut picture = image::load_from_memory(embedded(&file)?).ok()?.into_rgb8();
            while f64::from(picture.width()) >= 2.0 * DENSITY * surface.metres
                && picture.width() > 8
            {
                picture = super::files::halve(&picture);
            }
            Some(picture)
        };
        let (color, normal) = (small(look.color_file())?, small(surface.normal_file())?);
        let (w, h) = color.dimensions();
        let pixels = color.pixels().zip(normal.pixels());
        let face = pixels.map(|(c, n)| [c.0[0], c.0[1], c.0[2], n.0[0], n.0[1], n.0[2]]);
        (normal.dimensions() == (w, h)).then_some(())?;
        Some(Samples {
            metres: surface.metres,
            size: [w, h],
            face: face.collect(),
            orm: small(surface.orm_file())?,
        })
    }

    /// Returns the sample at a point; metres, u to the right, v up.
    pub fn at(&self, u: f64, v: f64) -> Sample {
        let texels = self.texels(u, v);
        let [_, roughness, metallic] = texels.orm.map(|c| f32::from(c) / 255.0);
        Sample {
            color: texels.color.map(linear),
            normal: normal(texels.normal),
            roughness,
            metallic,
        }
    }

    /// Returns the bytes of the maps at a point; metres, u to the right, v up.
    pub fn texels(&self, u: f64, v: f64) -> Texels {
        let (u, v) = (fraction(u / self.metres), fraction(-v / self.metres));
        let index = |share: f64, size: u32| ((share * f64::from(size)) as u32).min(size - 1);
        let [w, h] = self.size;
        let [r, g, b, x, y, z] = self.face[(index(v, h) * w + index(u, w)) as usize];
        let (w, h) = self.orm.dimensions();
        Texels {
            color: [r, g, b],
            normal: [x, y, z],
            orm: self.orm.get_pixel(index(u, w), index(v, h)).0,
        }
    }
}

/// Returns what is left of a number above the next lower integer.
fn fraction(t: f64) -> f64 {
    // `floor` would be a call of its own on most machines.
    let cut = t as i64 as f64;
    let floor = if cut > t { cut - 1.0 } else { cut };
    t - floor
}

/// Decodes a normal of a texture: right, up, out.
pub fn normal(texel: [u8; 3]) -> [f32; 3] {
    texel.map(|c| f32::from(c) / 127.5 - 1.0)
}

/// Decodes an sRGB channel to linear light.
pub fn linear(channel: u8) -> f32 {
    static LIGHT: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|c| {
            let c = c as f64 / 255.0;
            let light = match c <= 0.040_45 {
                true => c / 12.92,
                false => libm::pow((c + 0.055) / 1.055, 2.4),
            };
            light as f32
        })
    });
    LIGHT[usize::from(channel)]
}

/// Encodes linear light as an sRGB channel.
pub fn encoded(light: f32) -> u8 {
    // The table is finer than a step of the darkest channel values.
    static CHANNEL: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let one = |i: u32| {
            let light = f64::from(i) / f64::from(STEPS);
            let c = match light <= 0.003_130_8 {
                true => light * 12.92,
                false => 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055,
            };
            (c * 255.0).round() as u8
        };
        (0..=STEPS).map(one).collect()
    });
    const STEPS: u32 = 4096;
    CHANNEL[(light.clamp(0.0, 1.0) * STEPS as f32 + 0.5) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_and_channels_are_inverse() {
        for channel in 0..=255 {
            assert!(encoded(linear(channel)).abs_diff(channel) <= 1, "{channel}");
        }
    }

    #[test]
    fn fractions_count_from_the_next_lower_integer() {
        for (t, share) in [
            (2.25, 0.25),
            (-2.25, 0.75),
            (-3.0, 0.0),
            (0.0, 0.0),
            (7.0, 0.0),
        ] {
            assert_eq!(fraction(t), share, "{t}");
        }
    }

    #[test]
    fn samples_repeat_every_so_many_metres() {
        let cedar = samples("cedar_brown").expect("cedar is drawn");
        let metres = cedar.metres;
        assert_eq!(cedar.at(0.1, 0.2), cedar.at(0.1 + metres, 0.2 - metres));
        assert_eq!(samples("no such surface").map(|s| s.metres), None);
    }
}
