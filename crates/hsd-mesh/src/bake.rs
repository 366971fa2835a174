//! Bakes joinery, seen from straight ahead, to images: colours, normals, roughness and cut-outs.
//!
//! The viewer stands in front of the wall (y < 0) and looks along y. Every pixel is the mean of [`FINE`] x [`FINE`]
//! rays. Recessed areas next to protruding ones are darkened, as daylight would darken them.

pub(crate) mod atlas;
mod holes;
mod mixed;
mod rays;
mod relief;
mod shown;

use super::mesh::Soup;
use crate::mesh::panel::Rect;
use glam::DVec2;
use hsd_ir::material::SurfaceId;
use hsd_scene::texture::samples;
use image::{RgbImage, RgbaImage};
use rays::{Hit, Rays};
use relief::Relief;
use shown::Shown;
use std::cell::RefCell;

/// The settings of a bake.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    /// Resolution, pixels per metre.
    pub(super) density: f64,
    /// True if panes are drawn. Otherwise they become holes that hide everything behind them.
    pub(super) panes: bool,
}

/// For images on walls: two pixels for the finest bars and gaps. Panes stay geometry, so that they can reflect.
pub(super) const WALL: Lens = Lens {
    density: 120.0,
    panes: false,
};

/// For images of weathered joinery, of which a town has many: half as many pixels.
pub(super) const OLD: Lens = Lens {
    density: 84.0,
    panes: false,
};

/// For images of whole parts in a town, of which there are hundreds of sizes and which are seen from across the street: two
/// pixels for a lattice bar with its gap.
pub(super) const FAR: Lens = Lens {
    density: 40.0,
    panes: false,
};

/// Rays per pixel in each direction.
const FINE: usize = 2;

/// The baked image of some joinery.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) color: RgbaImage,
    pub(super) normal: RgbImage,
    pub(super) orm: RgbImage,
    /// True if any pixel is a hole.
    pub(super) holes: bool,
}

/// A pixel: its colour, its normal, its occlusion, roughness and metalness.
type Bytes = ([u8; 3], [u8; 3], [u8; 3]);

/// Memory that a thread uses for one image after the other.
#[derive(Default)]
struct Scratch {
    hits: Vec<Hit>,
    relief: Relief,
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// Bakes the image of soups inside a rectangle, each with the surface that stands for its own; `None` if none of them is
/// visible.
pub(super) fn bake(
    soups: &[(SurfaceId, Soup)],
    shown: impl Fn(SurfaceId) -> SurfaceId,
    rect: Rect,
    lens: Lens,
) -> Option<Picture> {
    let shown: Vec<&Shown> = soups.iter().map(|(id, _)| Shown::of(shown(*id))).collect();
    SCRATCH.with_borrow_mut(|scratch| {
        let ahead = (rect, DVec2::ZERO);
        let rays = Rays::cast(soups, ahead, lens, std::mem::take(&mut scratch.hits));
        let picture = develop(&rays, &shown, &mut scratch.relief);
        scratch.hits = rays.into_hits();
        picture
    })
}

/// Divides a rectangle into rows, from its foot, and returns for each row how many rays hit each surface first. The rays come from
/// all of these slants, as [`Rays::cast`] takes them.
pub(super) fn seen(
    soups: &[(SurfaceId, Soup)],
    rect: Rect,
    lens: Lens,
    slants: &[DVec2],
    rows: usize,
) -> Vec<Vec<(SurfaceId, usize)>> {
    let none: Vec<(SurfaceId, usize)> = soups.iter().map(|(id, _)| (*id, 0)).collect();
    let mut seen = vec![none; rows];
    for slant in slants {
        let rays = Rays::cast(soups, (rect, *slant), lens, vec![]);
        for (surface, height) in rays.surfaces() {
            seen[((height * rows as f64) as usize).min(rows - 1)][surface].1 += 1;
        }
    }
    seen
}

/// Returns the image that rays saw.
fn develop(rays: &Rays, shown: &[&Shown], relief: &mut Relief) -> Option<Picture> {
    let (w, h) = rays.pixels();
    let mut color = Vec::with_capacity(4 * w * h);
    let mut normal = Vec::with_capacity(3 * w * h);
    let mut orm = Vec::with_capacity(3 * w * h);
    let (mut empty, mut holes) = (true, false);
    for y in 0..h {
        for x in 0..w {
            let ([r, g, b], n, gloss) = match pixel(rays, (x, y), shown, relief) {
                Some(bytes) => {
                    empty = false;
                    color.extend_from_slice(&[bytes.0[0], bytes.0[1], bytes.0[2], 255]);
                    normal.extend_from_slice(&bytes.1);
                    orm.extend_from_slice(&bytes.2);
                    continue;
                }
                None => ([0; 3], [128, 128, 255], [255, 255, 0]),
            };
            holes = true;
            color.extend_from_slice(&[r, g, b, 0]);
            normal.extend_from_slice(&n);
            orm.extend_from_slice(&gloss);
        }
    }
    if empty {
        return None;
    }
    if holes {
        holes::fill(&mut color, w, h);
    }
    let (w, h) = (w as u32, h as u32);
    Some(Picture {
        color: RgbaImage::from_raw(w, h, color)?,
        normal: RgbImage::from_raw(w, h, normal)?,
        orm: RgbImage::from_raw(w, h, orm)?,
        holes,
    })
}

/// Returns a pixel; `None` if most of its rays hit nothing or glass.
fn pixel(
    rays: &Rays,
    (x, y): (usize, usize),
    shown: &[&Shown],
    relief: &mut Relief,
) -> Option<Bytes> {
    let Some(hit) = rays.one_hit(x, y) else {
        return mixed::pixel(rays, (x, y), shown);
    };
    // Most pixels lie on one triangle: all their rays count as the first.
    let on = rays.triangles.get(hit.triangle as usize)?;
    let of = shown[on.surface];
    if of.surface.glass && !rays.panes {
        return None;
    }
    let Some(samples) = of.samples else {
        return mixed::pixel(rays, (x, y), shown);
    };
    let (u, v) = (x * FINE, y * FINE);
    let uv = on.uv(u, v);
    let texels = samples.texels(uv.x, uv.y);
    let light = rays.light(u, v, hit.depth);
    let color = texels.color;
    let tint = of.surface.tint;
    let [_, roughness, metallic] = texels.orm;
    Some((
        match light == 1.0 {
            true => std::array::from_fn(|k| of.lit[k][usize::from(color[k])]),
            false => std::array::from_fn(|k| {
                samples::encoded(shown::mean(samples::linear(color[k]) * tint[k] * light))
            }),
        },
        relief.bytes(&on.face, texels.normal),
        [
            255,
            of.gloss[0][usize::from(roughness)],
            of.gloss[1][usize::from(metallic)],
        ],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Bodies;

    const RECT: Rect = Rect {
        x0: 0.0,
        x1: 1.0,
        z0: 0.0,
        z1: 1.0,
    };

    fn wall(name: &str, x1: f64, y: f64) -> Bodies {
        let mut bodies = Bodies::default();
        let surface = SurfaceId::named(name);
        bodies.block(
            surface,
            glam::dvec3(0.0, y, 0.0),
            glam::dvec3(x1, y + 0.1, 1.0),
        );
        bodies
    }

    #[test]
    fn what_is_not_there_is_a_hole() {
        let picture = bake(&wall("plaster", 0.5, 0.0).soups, |id| id, RECT, WALL)
            .expect("half a wall is seen");
        let shows = |x: u32| picture.color.get_pixel(x, 60).0[3] > 0;
        assert!(picture.holes && shows(10) && !shows(110));
        assert!(bake(&[], |id| id, RECT, WALL).is_none());
    }

    #[test]
    fn the_nearer_one_hides_the_farther() {
        let mut soups = wall("plaster", 1.0, 0.0).soups;
        soups.extend(wall("charred", 0.5, -0.2).soups);
        let picture = bake(&soups, |id| id, RECT, WALL).expect("a wall is seen");
        let bright = |x: u32| picture.color.get_pixel(x, 60).0[0];
        assert!(!picture.holes && bright(20) < 80 && bright(110) > 160);
    }

    #[test]
    fn flat_walls_look_out() {
        let picture =
            bake(&wall("aluminium", 1.0, 0.0).soups, |id| id, RECT, WALL).expect("a wall is seen");
        let mean: f64 = picture
            .normal
            .pixels()
            .map(|p| f64::from(p.0[2]))
            .sum::<f64>()
            / f64::from(picture.normal.width() * picture.normal.height());
        assert!(mean > 240.0, "{mean}");
    }
}
