//! The bytes of normals: the relief of a texture on a face, in the frame of the image.

use super::FINE;
use super::shown::byte;
use glam::{DVec3, dvec3};
use hsd_scene::texture::samples;

/// Number of normals that are remembered.
const ENTRIES: usize = 1 << 14;

/// Distance from a byte's limits within which a face's small deviation from an upright one may change it.
const CLOSE: f64 = 0.01;

/// Deviation of the axes of an upright face, far too small for [`CLOSE`].
const UPRIGHT: f64 = 5e-6;

/// The directions of the u axis of an upright texture.
const WAYS: [DVec3; 4] = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];

/// The direction in which a textured face looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    normal: DVec3,
    /// Direction of the texture's u axis.
    right: DVec3,
    /// The number of its direction among [`WAYS`], if the face looks straight at the viewer.
    way: Option<u8>,
}

impl Face {
    pub(super) fn new(normal: DVec3, right: DVec3) -> Face {
        let upright = normal.abs_diff_eq(DVec3::NEG_Y, UPRIGHT);
        let way = WAYS.iter().position(|w| w.abs_diff_eq(right, UPRIGHT));
        Face {
            normal,
            right,
            way: way.filter(|_| upright).map(|at| at as u8),
        }
    }

    /// Converts a drawn normal to the frame of the image: right, up, out.
    pub(super) fn seen(&self, drawn: [f32; 3]) -> DVec3 {
        let [x, y, z] = drawn.map(f64::from);
        let up = self.normal.cross(self.right);
        let n = self.right * x + up * y + self.normal * z;
        dvec3(n.x, n.z, -n.y).normalize_or(DVec3::Z)
    }
}

/// Normals of upright faces, remembered by the bytes of the texture. Results are those of an exact calculation.
#[derive(Debug)]
pub(super) struct Relief {
    known: Vec<Known>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Known {
    /// The way and bytes of the texture; 0 = none.
    key: u32,
    bytes: [u8; 3],
    /// True if a face that is not exactly upright may have other bytes.
    close: bool,
}

impl Default for Relief {
    fn default() -> Relief {
        Relief {
            known: vec![Known::default(); ENTRIES],
        }
    }
}

impl Relief {
    /// Returns the normal of a pixel that shows this texel on one triangle.
    pub(super) fn bytes(&mut self, on: &Face, texel: [u8; 3]) -> [u8; 3] {
        let Some(way) = on.way else {
            return bytes(on.seen(samples::normal(texel)));
        };
        let [x, y, z] = texel.map(u32::from);
        let key = 1 << 31 | u32::from(way) << 24 | z << 16 | y << 8 | x;
        let slot = (key.wrapping_mul(0x9E37_79B1) >> 18) as usize % ENTRIES;
        if self.known[slot].key != key {
            self.known[slot] = known(key, way, texel);
        }
        let known = self.known[slot];
        match known.close {
            true => bytes(on.seen(samples::normal(texel))),
            false => known.bytes,
        }
    }
}

fn known(key: u32, way: u8, texel: [u8; 3]) -> Known {
    let upright = Face::new(DVec3::NEG_Y, WAYS[usize::from(way)]);
    let normal = upright.seen(samples::normal(texel));
    let exact = (normal * 0.5 + 0.5) * 255.0 + 0.5;
    let near = |t: f64| (t - (t + 0.5).trunc()).abs() < CLOSE;
    Known {
        key,
        bytes: bytes(normal),
        close: near(exact.x) || near(exact.y) || near(exact.z),
    }
}

/// Returns the bytes of a pixel whose rays all see this normal.
fn bytes(one: DVec3) -> [u8; 3] {
    let sum = (0..FINE * FINE).fold(DVec3::ZERO, |sum, _| sum + one);
    encoded(sum)
}

/// Returns the bytes of the direction of a sum of normals.
pub(super) fn encoded(sum: DVec3) -> [u8; 3] {
    let n = sum.normalize_or(DVec3::Z) * 0.5 + 0.5;
    [n.x, n.y, n.z].map(byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remembered_normals_are_those_of_an_exact_calculation() {
        let mut relief = Relief::default();
        for (i, way) in WAYS.iter().enumerate() {
            let right = (*way + dvec3(1e-6, 0.0, -2e-6)).normalize();
            let normal = dvec3(-1e-6, -1.0, 1e-6).normalize();
            let on = Face::new(normal, right);
            assert_eq!(on.way, Some(i as u8));
            for texel in (0..=255).flat_map(|x| (0..=255).step_by(5).map(move |y| [x, y, 250])) {
                let exact = bytes(on.seen(samples::normal(texel)));
                assert_eq!(relief.bytes(&on, texel), exact, "{texel:?}");
                assert_eq!(relief.bytes(&on, texel), exact, "{texel:?}");
            }
        }
        assert_eq!(Face::new(DVec3::NEG_Y, dvec3(0.6, 0.0, 0.8)).way, None);
    }
}
