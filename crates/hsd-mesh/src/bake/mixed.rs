//! Pixels whose rays hit several triangles: edges, joints, thin bars.

use super::rays::{Hit, Rays};
use super::relief::encoded;
use super::shown::{Shown, byte};
use super::{Bytes, FINE};
use glam::DVec3;
use hsd_scene::texture::samples;

/// Share of a pixel's rays that must hit something; below it the pixel is a hole.
const COVERED: f64 = 0.5;

/// The result of one ray.
#[derive(Clone, Copy)]
struct Seen {
    color: [f32; 3],
    normal: DVec3,
    /// Roughness and metalness.
    gloss: [f32; 2],
}

/// Averages the rays of a pixel; `None` if most of them hit nothing or glass.
pub(super) fn pixel(rays: &Rays, (x, y): (usize, usize), shown: &[&Shown]) -> Option<Bytes> {
    let mut color = [0.0; 3];
    let mut gloss = [0.0; 2];
    let (mut normal, mut count) = (DVec3::ZERO, 0.0);
    // Rays on the same triangle share what the first of them sees.
    let mut before: Option<(u32, Seen)> = None;
    for (i, j) in (0..FINE * FINE).map(|n| (n % FINE, n / FINE)) {
        let (u, v) = (x * FINE + i, y * FINE + j);
        let hit = rays.hit(u, v);
        let seen = match before {
            Some((triangle, seen)) if triangle == hit.triangle => seen,
            _ => match ray(rays, (u, v), hit, shown) {
                Some(seen) => seen,
                None => continue,
            },
        };
        before = Some((hit.triangle, seen));
        count += 1.0;
        for (sum, c) in color.iter_mut().zip(seen.color) {
            *sum += c;
        }
        for (sum, g) in gloss.iter_mut().zip(seen.gloss) {
            *sum += g;
        }
        normal += seen.normal;
    }
    let rays = (FINE * FINE) as f64;
    (count >= rays * COVERED).then(|| {
        let n = count as f32;
        let [roughness, metallic] = gloss.map(|g| byte(f64::from(g / n)));
        (
            color.map(|c| samples::encoded(c / n)),
            encoded(normal),
            [255, roughness, metallic],
        )
    })
}

/// Shades one ray; `None` if it hits nothing, or glass that stays a hole.
fn ray(rays: &Rays, (u, v): (usize, usize), hit: Hit, shown: &[&Shown]) -> Option<Seen> {
    let on = rays.triangles.get(hit.triangle as usize)?;
    let of = shown[on.surface];
    if of.surface.glass && !rays.panes {
        return None;
    }
    let light = rays.light(u, v, hit.depth);
    let uv = on.uv(u, v);
    let sample = of.samples.map_or(samples::PLAIN, |s| s.at(uv.x, uv.y));
    let tint = of.surface.tint;
    Some(Seen {
        color: std::array::from_fn(|k| sample.color[k] * tint[k] * light),
        normal: on.face.seen(sample.normal),
        gloss: [
            sample.roughness * of.surface.roughness,
            sample.metallic * of.surface.metallic,
        ],
    })
}
