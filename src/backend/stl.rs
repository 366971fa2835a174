//! Binary STL for 3D printing: all triangles in millimetres, z up, translated so that the least x and y are 0.
//!
//! STL has no unit; slicers assume millimetres. The translation keeps numbers small: a house with map coordinates would
//! lose centimetres in f32.

use super::flat::{self, places};
use crate::scene::Scene;
use glam::{DVec3, dvec3};

const MILLIMETRES: f64 = 1000.0;
const HEADER: usize = 80;

/// Returns the bytes of an `.stl` file.
pub fn stl(scene: &Scene) -> Vec<u8> {
    let triangles = triangles(scene);
    let least = triangles
        .iter()
        .flatten()
        .fold(DVec3::MAX, |m, p| m.min(*p));
    let origin = dvec3(least.x, least.y, 0.0);
    let mut out = Vec::with_capacity(HEADER + 4 + 50 * triangles.len());
    // Readers take a file that begins with "solid" for text.
    out.extend_from_slice(
        format!("hsd {}: millimetres, z up", env!("CARGO_PKG_VERSION")).as_bytes(),
    );
    out.resize(HEADER, 0);
    out.extend_from_slice(&(triangles.len() as u32).to_le_bytes());
    for [a, b, c] in triangles {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let corners = [a, b, c].map(|p| (p - origin) * MILLIMETRES);
        for x in std::iter::once(normal)
            .chain(corners)
            .flat_map(|p| p.to_array())
        {
            // Adding 0 turns -0 into 0.
            out.extend_from_slice(&(x as f32 + 0.0).to_le_bytes());
        }
        out.extend_from_slice(&[0, 0]);
    }
    out
}

/// Returns all triangles in world coordinates, except those without area.
fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let mut all = vec![];
    for (node, place) in scene
        .nodes
        .iter()
        .zip(places(scene))
        .filter(|(_, p)| p.sound)
    {
        for primitive in flat::primitives(scene, node) {
            let at = |i: u32| place.point(flat::point(primitive.positions[i as usize]));
            let corners = primitive
                .indices
                .chunks_exact(3)
                .map(|t| [at(t[0]), at(t[1]), at(t[2])]);
            all.extend(corners.filter(|[a, b, c]| (b - a).cross(c - a) != DVec3::ZERO));
        }
    }
    all
}
