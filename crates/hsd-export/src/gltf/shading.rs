//! The directions of vertices: unit normals, and tangents, the direction in which u grows, for materials with normal maps.
//! glTF expects tangents with the normals; without them each renderer computes its own.

use glam::{Vec2, Vec3};
use hsd_scene::Primitive;

/// Normalises a vector: validators reject normals of other lengths.
#[inline]
pub(super) fn unit(n: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = n;
    let squared = x * x + y * y + z * z;
    if (0.9999..1.0001).contains(&squared) {
        n
    } else if squared > 1e-12 && squared.is_finite() {
        n.map(|x| x / squared.sqrt())
    } else {
        [0.0, 0.0, 1.0]
    }
}

/// Rounds to a millionth: a direction along an axis is one whatever the scale of the texture coordinates.
fn rounded(x: f32) -> f32 {
    const PARTS: f32 = (1 << 20) as f32;
    (x * PARTS + 0.5f32.copysign(x)) as i32 as f32 / PARTS
}

/// Returns one tangent per vertex, at right angles to its normal: x, y, z in the scene's frame, then 1 if v grows along
/// normal x tangent and -1 if the texture is mirrored.
pub(super) fn tangents(p: &Primitive) -> Vec<[f32; 4]> {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); p.positions.len()];
    for triangle in p.indices.chunks_exact(3) {
        let corner = [0, 1, 2].map(|k| triangle[k] as usize);
        let [a, b, c] = corner.map(|i| Vec3::from(p.positions[i]));
        let [ua, ub, uc] = corner.map(|i| Vec2::from(p.uvs[i]));
        let (first, second) = (ub - ua, uc - ua);
        let mirrored = first.perp_dot(second);
        // Larger triangles count more where a vertex has several.
        let along = ((b - a) * second.y - (c - a) * first.y) * 1f32.copysign(mirrored);
        if mirrored != 0.0 {
            for i in corner {
                sums[i].0 += along;
                sums[i].1 += mirrored;
            }
        }
    }
    let tangent = |((sum, mirrored), normal): (&(Vec3, f32), &[f32; 3])| {
        let normal = Vec3::from(unit(*normal));
        let flat = *sum - normal * normal.dot(*sum);
        let t = flat
            .try_normalize()
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        let [x, y, z] = t.to_array().map(rounded);
        [x, y, z, if *mirrored < 0.0 { -1.0 } else { 1.0 }]
    };
    sums.iter().zip(&p.normals).map(tangent).collect()
}
