//! Weathering of a mesh (docs/evidence.md 4.9): assigns each of its triangles an aged surface.
//!
//! A mesh is made as new. Its triangles are then moved to aged surfaces according to their height, or on roofs their
//! direction. Everything in a [`Weather`] is quantised, and values with the same result share a mesh, so that a street
//! of old houses is little larger than one of new ones.

pub(crate) mod exposure;
pub(crate) mod panel_look;

use super::mesh::{Bodies, Soup};
use glam::{DVec2, dvec2};
use hsd_base::geometry::Heading;
use hsd_base::rng::Place;
use hsd_ir::material::{Luck, SurfaceId, Wear};
use std::sync::LazyLock;

/// Quantisation of years: roughly where some material changes.
const YEARS: [f64; 20] = [
    0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0, 36.0, 50.0, 80.0,
    120.0, 200.0, 400.0,
];

/// Number of steps between no exposure and full exposure.
const STEPS: f64 = 10.0;

/// Number of directions of roofs.
const TURNS: usize = 16;

/// Relative sunshine on faces that look north, east, south and west.
const SUN: [f64; 4] = [0.4, 0.7, 1.0, 0.8];

/// Moss grows sooner on slopes that the sun does not dry: their age is multiplied by this.
const MOSS: f64 = 1.5;

/// The aged surfaces of a mesh's triangles, run-length encoded.
pub(super) type AgedSurfaces = Vec<(SurfaceId, u32)>;

/// An index into [`YEARS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Years(u8);

impl Years {
    pub(super) fn new(years: f64) -> Years {
        let reached = YEARS.partition_point(|y| *y <= years);
        Years(reached.saturating_sub(1) as u8)
    }

    fn value(self) -> f64 {
        YEARS[usize::from(self.0)]
    }
}

/// The share of rain and sun in steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Exposure(u8);

impl Exposure {
    pub(super) fn new(share: f64) -> Exposure {
        Exposure((share.clamp(0.0, 1.0) * STEPS + 0.5) as u8)
    }

    fn value(self) -> f64 {
        f64::from(self.0) / STEPS
    }
}

/// The weather that a mesh was exposed to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) enum Weather {
    /// None: surfaces are as named.
    #[default]
    None,
    /// That of a wall, or of something in front of it.
    Wall {
        years: Years,
        luck: Luck,
        /// The upper limit of the foot and the lower limit of the head, centimetres in the frame of the mesh.
        limits: [i16; 2],
        /// Exposure of the foot, of the middle and of the head.
        zones: [Exposure; 3],
    },
    /// That of something open to the sky.
    Roof {
        years: Years,
        luck: Luck,
        /// Rotation of the mesh's frame on the compass.
        turn: u8,
    },
}

impl Weather {
    /// Weather that is equal everywhere.
    pub(super) fn even(years: f64, exposure: f64, luck: Luck) -> Weather {
        Weather::Wall {
            years: Years::new(years),
            luck,
            limits: [0; 2],
            zones: [Exposure::new(exposure); 3],
        }
    }

    /// Returns the weather of the same mesh in a frame that is rotated further.
    pub(super) fn turned(self, by: DVec2) -> Weather {
        match self {
            Weather::Roof { years, luck, turn } => Weather::Roof {
                years,
                luck,
                turn: turn_of(vector(turn).rotate(by)),
            },
            other => other,
        }
    }

    /// Returns the aged surface at a height.
    pub(super) fn at(self, id: SurfaceId, z: f64) -> SurfaceId {
        self.of(id, z, [0.0, -1.0, 0.0])
    }

    /// Returns the aged surface at a height, for a face with this normal.
    fn of(self, id: SurfaceId, z: f64, normal: [f32; 3]) -> SurfaceId {
        self.wear_at(z, normal).map_or(id, |wear| id.worn(wear))
    }

    /// Returns the wear at a height, of a face with this normal; `None` if there is none.
    fn wear_at(self, z: f64, normal: [f32; 3]) -> Option<Wear> {
        let (years, luck, exposure) = match self {
            Weather::None => return None,
            Weather::Wall {
                years,
                luck,
                limits,
                zones,
            } => {
                let [low, high] = limits.map(|l| f64::from(l) / 100.0);
                // Nothing splashes on what looks down, and nobody sees it.
                let foot = z < low && normal[2] > -0.5;
                let zone = usize::from(!foot) + usize::from(z >= low.max(high));
                (years.value(), luck, zones[zone].value())
            }
            Weather::Roof { years, luck, turn } => {
                let (older, exposure) = open(normal, vector(turn));
                (years.value() * older, luck, exposure)
            }
        };
        Some(Wear {
            years,
            exposure,
            luck,
        })
    }

    /// Regroups triangles by their aged surfaces, in the order of first use.
    pub(super) fn wear(self, soups: Vec<(SurfaceId, Soup)>) -> Vec<(SurfaceId, Soup)> {
        if self == Weather::None {
            return soups;
        }
        let mut worn: Vec<(SurfaceId, Soup)> = vec![];
        for (id, soup) in soups {
            let faces = soup.indices.chunks_exact(3);
            let surfaces: Vec<SurfaceId> = faces.map(|t| self.of_triangle(id, &soup, t)).collect();
            let mut kinds = surfaces.clone();
            kinds.sort_unstable();
            kinds.dedup();
            for kind in kinds {
                let at = worn.iter().position(|(s, _)| *s == kind);
                let at = at.unwrap_or_else(|| {
                    worn.push((kind, Soup::default()));
                    worn.len() - 1
                });
                let chosen = surfaces.iter().map(|s| *s == kind);
                worn[at].1.take(&soup, chosen);
            }
        }
        worn
    }

    /// Returns the aged surfaces of the triangles of bodies, in order, without those of panels.
    pub(super) fn aged_surfaces(self, bodies: &Bodies) -> AgedSurfaces {
        let mut all = vec![];
        if self == Weather::None {
            return all;
        }
        for (id, soup) in &bodies.soups {
            for triangle in soup.indices.chunks_exact(3) {
                let surface = self.of_triangle(*id, soup, triangle);
                match all.last_mut() {
                    Some((last, count)) if *last == surface => *count += 1,
                    _ => all.push((surface, 1)),
                }
            }
        }
        all
    }

    fn of_triangle(self, id: SurfaceId, soup: &Soup, triangle: &[u32]) -> SurfaceId {
        let z = triangle
            .iter()
            .map(|i| f64::from(soup.positions[*i as usize][2]));
        let (low, high) = z.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), z| {
            (lo.min(z), hi.max(z))
        });
        let normal = soup.normals[triangle[0] as usize];
        // Both triangles of an upright rectangle lie between the same heights.
        self.of(id, (low + high) / 2.0, normal)
    }
}

impl Soup {
    /// Adds the chosen triangles of another soup.
    fn take(&mut self, other: &Soup, chosen: impl Iterator<Item = bool>) {
        let mut moved: Vec<Option<u32>> = vec![None; other.positions.len()];
        for (triangle, chosen) in other.indices.chunks_exact(3).zip(chosen) {
            for i in triangle.iter().filter(|_| chosen) {
                let at = *i as usize;
                let to = *moved[at].get_or_insert_with(|| {
                    self.positions.push(other.positions[at]);
                    self.normals.push(other.normals[at]);
                    self.uvs.push(other.uvs[at]);
                    self.positions.len() as u32 - 1
                });
                self.indices.push(to);
            }
        }
    }
}

/// Returns the additional age of a face with this normal, and its share of rain and sun.
fn open(normal: [f32; 3], turn: DVec2) -> (f64, f64) {
    let [x, y, z] = normal.map(f64::from);
    if z < -0.05 {
        return (1.0, 0.0); // seen from below
    }
    let level = dvec2(x, y);
    let sun = match level.length() > 1e-6 {
        true => sun(turn.rotate(level.normalize())),
        false => 0.85,
    };
    if z < 0.3 {
        return (1.0, 0.7 * sun); // a gable, an edge
    }
    let older = if sun < 0.55 { MOSS } else { 1.0 };
    (older, (0.4 + 0.6 * sun).min(1.0))
}

/// Returns the sunshine on faces in this direction; x east, y north.
pub(super) fn sun(way: DVec2) -> f64 {
    let [north, east, south, west] = SUN;
    let across = if way.x > 0.0 { east } else { west };
    let along = if way.y > 0.0 { north } else { south };
    // Squares of sine and cosine add up to 1.
    let all = way.length_squared().max(1e-12);
    (across * way.x * way.x + along * way.y * way.y) / all
}

static VECTORS: LazyLock<[DVec2; TURNS]> = LazyLock::new(|| {
    std::array::from_fn(|i| Heading::new(i as f64 * 360.0 / TURNS as f64).vector())
});

fn vector(turn: u8) -> DVec2 {
    VECTORS[usize::from(turn) % TURNS]
}

/// Returns the nearest of the directions.
pub(super) fn turn_of(way: DVec2) -> u8 {
    let all = VECTORS.iter().enumerate();
    let near = all.max_by(|a, b| way.dot(*a.1).total_cmp(&way.dot(*b.1)));
    near.map_or(0, |(i, _)| i as u8)
}

/// Returns the random variation at a place.
pub(super) fn luck(place: Place) -> Luck {
    Luck((place.named("luck").share() * f64::from(Luck::COUNT)) as u8)
}

/// Returns a number of years as it counts at a place: exposure varies from object to object.
pub(super) fn years_at(years: f64, place: Place) -> f64 {
    years * (0.75 + 0.5 * place.named("years").share())
}
