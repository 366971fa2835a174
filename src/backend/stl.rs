//! Binary STL for 3D printing: all triangles in millimetres, z up, translated so that the least x and y are 0.
//!
//! STL has no unit; slicers assume millimetres. The translation keeps numbers small: a house with map coordinates would
//! lose centimetres in f32. It is known when the last house is there, so triangles wait in a spool until then.

use super::flat::{self, places};
use super::spool::{NewSpool, Section, in_memory};
use crate::scene::{Scene, ScenePart};
use bytemuck::{bytes_of, cast_slice};
use glam::{DVec2, DVec3};
use std::io::{self, Write};

const MILLIMETRES: f64 = 1000.0;
const HEADER: usize = 80;

/// Returns the bytes of an `.stl` file.
pub fn stl(scene: &Scene) -> Vec<u8> {
    let write = || {
        let mut writer = Writer::new(&in_memory)?;
        writer.add(scene.whole())?;
        let mut out = vec![];
        writer.write(&mut out)?;
        Ok::<_, io::Error>(out)
    };
    write().expect("memory takes every byte")
}

/// A model that takes houses one after another. Meshes of all houses must be in the parts that show them: see
/// [`SceneBuilder::forget_twins`](crate::tessellate::SceneBuilder::forget_twins).
pub struct Writer {
    /// Nine coordinates a triangle, metres.
    triangles: Section,
    count: u64,
    least: DVec2,
}

/// The corners of a triangle in world coordinates, metres.
type Corners = [[f64; 3]; 3];

impl Writer {
    /// Creates a model without houses that keeps its content in a spool.
    ///
    /// # Errors Those of the spool.
    pub fn new(new: NewSpool<'_>) -> io::Result<Writer> {
        Ok(Writer {
            triangles: Section::new("triangles", new)?,
            count: 0,
            least: DVec2::MAX,
        })
    }

    /// Adds the triangles of houses, except those without area.
    ///
    /// # Errors Those of the spool.
    pub fn add(&mut self, part: ScenePart<'_>) -> io::Result<()> {
        let placed = part.nodes.iter().zip(places(part));
        for (node, place) in placed.filter(|(_, p)| p.sound) {
            for primitive in flat::primitives(part, node) {
                let at = |i: u32| place.point(flat::point(primitive.positions[i as usize]));
                self.triangles.append(|out| {
                    for t in primitive.indices.chunks_exact(3) {
                        let corners = [at(t[0]), at(t[1]), at(t[2])];
                        if normal(corners) != DVec3::ZERO {
                            self.count += 1;
                            let least = corners.map(DVec3::truncate);
                            self.least = least.into_iter().fold(self.least, DVec2::min);
                            let corners: Corners = corners.map(|p| p.to_array());
                            out.extend_from_slice(bytes_of(&corners));
                        }
                    }
                    Ok(())
                })?;
            }
        }
        Ok(())
    }

    /// Writes the file; returns the number of bytes.
    ///
    /// # Errors
    /// Those of the spool and of `out`, and models of more than 2^32 - 1 triangles, the limit of `.stl`.
    pub fn write(mut self, out: &mut dyn Write) -> io::Result<u64> {
        let Ok(count) = u32::try_from(self.count) else {
            let message =
                "more than 4,294,967,295 triangles do not fit an .stl; write several files";
            return Err(io::Error::other(message));
        };
        // Readers take a file that begins with "solid" for text.
        let header = format!("hsd {}: millimetres, z up", env!("CARGO_PKG_VERSION"));
        let mut bytes = header.into_bytes();
        bytes.resize(HEADER, 0);
        bytes.extend_from_slice(&count.to_le_bytes());
        out.write_all(&bytes)?;
        let origin = self.least.extend(0.0);
        let all = self.triangles.read()?;
        let mut block = vec![0.0; BLOCK * 9];
        let mut left = count as usize;
        while left > 0 {
            let some = &mut block[..9 * left.min(BLOCK)];
            all.read_exact(bytemuck::cast_slice_mut(some))?;
            bytes.clear();
            for corners in cast_slice::<f64, Corners>(some) {
                record(corners.map(DVec3::from_array), origin, &mut bytes);
            }
            out.write_all(&bytes)?;
            left -= some.len() / 9;
        }
        Ok(HEADER as u64 + 4 + 50 * self.count)
    }
}

/// The number of triangles that are read back at a time.
const BLOCK: usize = 1 << 10;

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Adds the record of a triangle: its normal, its corners and two bytes that mean nothing.
fn record(corners: [DVec3; 3], origin: DVec3, out: &mut Vec<u8>) {
    let normal = normal(corners).normalize_or_zero();
    let corners = corners.map(|p| (p - origin) * MILLIMETRES);
    let all = std::iter::once(normal).chain(corners);
    for x in all.flat_map(|p| p.to_array()) {
        // Adding 0 turns -0 into 0.
        out.extend_from_slice(&(x as f32 + 0.0).to_le_bytes());
    }
    out.extend_from_slice(&[0, 0]);
}
