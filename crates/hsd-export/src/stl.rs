//! Binary STL for 3D printing: closed bodies to scale in millimetres, z up, translated so that the least x, y and z are 0.
//!
//! STL has no unit; slicers assume millimetres. The translation keeps numbers small: a house with map coordinates would
//! lose centimetres in f32. It is known when the last house is there, so triangles wait in a spool until then.

mod shells;

use super::flat::{self, places};
use super::spool::{NewSpool, Section, in_memory};
use bytemuck::{bytes_of, cast_slice};
use glam::DVec3;
use hsd_base::source::Span;
use hsd_scene::{MeshId, Scene, ScenePart};
use shells::Shells;
use std::collections::HashMap;
use std::io::{self, Write};

const MILLIMETRES: f64 = 1000.0;
const HEADER: usize = 80;

/// The thickness of what has only a front, metres: pictures of joinery, and walls at detail 0.
const SHEET: f64 = 0.06;

/// How a model is printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Print {
    /// The length in reality of one unit of the model: 100 at 1:100.
    pub scale: f64,
    /// The least thickness that the printer makes, millimetres.
    pub min_wall: f64,
}

impl Default for Print {
    /// Life size, for a nozzle of 0.4 mm.
    fn default() -> Print {
        Print {
            scale: 1.0,
            min_wall: 0.4,
        }
    }
}

impl Print {
    /// Returns the millimetres of the model for a metre.
    fn millimetres(self) -> f64 {
        MILLIMETRES / self.scale
    }

    /// Returns the thickness of a sheet in reality, metres.
    fn sheet(self) -> f64 {
        SHEET.max(self.min_wall / self.millimetres())
    }
}

/// How many bodies of a model are too thin to be printed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThinBodies {
    /// The number of all bodies.
    pub all: u64,
    /// The number of those that are too thin.
    pub thin: u64,
    /// The thickness of the thinnest, millimetres of the model, with the name of what it belongs to and its place.
    pub thinnest: Option<(f64, String, Option<Span>)>,
}

/// Returns the bytes of an `.stl` file.
pub fn stl(scene: &Scene, print: Print) -> Vec<u8> {
    let write = || {
        let mut writer = Writer::new(print, &in_memory)?;
        writer.add(scene.whole())?;
        let mut out = vec![];
        writer.write(&mut out)?;
        Ok::<_, io::Error>(out)
    };
    write().expect("memory takes every byte")
}

/// A model that takes houses one after another. Meshes of all houses must be in the parts that show them: see
/// `SceneBuilder::forget_twins`.
pub struct Writer {
    /// Nine coordinates a triangle, metres.
    triangles: Section,
    count: u64,
    least: DVec3,
    print: Print,
    thin: ThinBodies,
}

/// The corners of a triangle in world coordinates, metres.
type Corners = [[f64; 3]; 3];

impl Writer {
    /// Creates a model without houses that keeps its content in a spool.
    ///
    /// # Errors Those of the spool.
    pub fn new(print: Print, new: NewSpool<'_>) -> io::Result<Writer> {
        Ok(Writer {
            triangles: Section::new("triangles", new)?,
            count: 0,
            least: DVec3::MAX,
            print,
            thin: ThinBodies::default(),
        })
    }

    /// Adds the bodies of houses.
    ///
    /// # Errors Those of the spool.
    pub fn add(&mut self, part: ScenePart<'_>) -> io::Result<()> {
        let mut known: HashMap<MeshId, Shells> = HashMap::new();
        let placed = part.nodes.iter().zip(places(part));
        for (node, place) in placed.filter(|(_, p)| p.sound) {
            let Some(mesh) = node.mesh else { continue };
            let shells = known.entry(mesh).or_insert_with(|| {
                let primitives = flat::primitives(part, node);
                let arrays = primitives.map(|p| (&*p.positions, &*p.indices));
                Shells::of(arrays, self.print.sheet())
            });
            let points: Vec<DVec3> = shells.points.iter().map(|p| place.point(*p)).collect();
            self.least = points.iter().copied().fold(self.least, DVec3::min);
            self.count += shells.triangles.len() as u64;
            self.triangles.append(|out| {
                for triangle in &shells.triangles {
                    let corners: Corners = triangle.map(|i| points[i as usize].to_array());
                    out.extend_from_slice(bytes_of(&corners));
                }
                Ok(())
            })?;
            for metres in &shells.thicknesses {
                let thickness = metres * self.print.millimetres();
                self.thin.all += 1;
                if thickness >= self.print.min_wall - 1e-6 {
                    continue;
                }
                self.thin.thin += 1;
                let least = self.thin.thinnest.as_ref();
                if least.is_none_or(|(least, ..)| thickness < *least) {
                    self.thin.thinnest = Some((thickness, node.called().to_owned(), node.span));
                }
            }
        }
        Ok(())
    }

    /// Returns how many bodies so far are too thin.
    pub fn thin(&self) -> &ThinBodies {
        &self.thin
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
        let version = env!("CARGO_PKG_VERSION");
        let header = format!("hsd {version}: millimetres, z up, 1:{}", self.print.scale);
        let mut bytes = header.into_bytes();
        bytes.truncate(HEADER);
        bytes.resize(HEADER, 0);
        bytes.extend_from_slice(&count.to_le_bytes());
        out.write_all(&bytes)?;
        let (origin, scale) = (self.least, self.print.millimetres());
        let all = self.triangles.read()?;
        let mut block = vec![0.0; BLOCK * 9];
        let mut left = count as usize;
        while left > 0 {
            let some = &mut block[..9 * left.min(BLOCK)];
            all.read_exact(bytemuck::cast_slice_mut(some))?;
            bytes.clear();
            for corners in cast_slice::<f64, Corners>(some) {
                record(corners.map(DVec3::from_array), (origin, scale), &mut bytes);
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
fn record(corners: [DVec3; 3], (origin, scale): (DVec3, f64), out: &mut Vec<u8>) {
    let normal = normal(corners).normalize_or_zero();
    let corners = corners.map(|p| (p - origin) * scale);
    let all = std::iter::once(normal).chain(corners);
    for x in all.flat_map(|p| p.to_array()) {
        // Adding 0 turns -0 into 0.
        out.extend_from_slice(&(x as f32 + 0.0).to_le_bytes());
    }
    out.extend_from_slice(&[0, 0]);
}
