//! Bakes joinery, seen from straight ahead, to images: colours, normals, roughness and cut-outs.
//!
//! The viewer stands in front of the wall (y < 0) and looks along y. Every pixel is the mean of [`FINE`] x [`FINE`]
//! rays. Recessed areas next to protruding ones are darkened, as daylight would darken them.

pub(in crate::tessellate) mod atlas;

use super::mesh::Soup;
use crate::material::{Surface, SurfaceId};
use crate::tessellate::mesh::panel::Rect;
use crate::texture::samples::{self, Samples};
use glam::{DVec2, DVec3, dvec2, dvec3};
use image::{Rgb, RgbImage, Rgba, RgbaImage};

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

/// Rays per pixel in each direction.
const FINE: usize = 2;

/// The largest size of an image in each direction, pixels; larger objects get a lower resolution.
const LARGEST: f64 = 500.0;

/// Share of a pixel's rays that must hit something; below it the pixel is a hole.
const COVERED: f64 = 0.5;

/// Depth below the surroundings at which darkening is strongest, metres.
const DEEP: f32 = 0.070;

/// Share of light that is left in the deepest corner.
const DARKEST: f32 = 0.45;

/// The baked image of some joinery.
pub(super) struct Picture {
    pub(super) color: RgbaImage,
    pub(super) normal: RgbImage,
    pub(super) orm: RgbImage,
    /// True if any pixel is a hole.
    pub(super) holes: bool,
}

/// A triangle in ray coordinates: all its attributes vary linearly with the ray's position.
struct Triangle {
    surface: usize,
    normal: DVec3,
    /// Direction of the image's u axis.
    right: DVec3,
    /// Texture coordinates at ray (0, 0), and their change per ray and per row.
    uv: [DVec2; 3],
}

/// The first hit of a ray: its depth and triangle.
#[derive(Clone, Copy)]
struct Hit {
    depth: f32,
    triangle: u32,
}

impl Hit {
    const NOTHING: Hit = Hit {
        depth: f32::INFINITY,
        triangle: u32::MAX,
    };
}

/// The grid of rays over a rectangle.
struct Rays {
    rect: Rect,
    width: usize,
    height: usize,
    triangles: Vec<Triangle>,
    hits: Vec<Hit>,
    panes: bool,
}

/// Bakes the image of soups inside a rectangle; `None` if none of them is visible.
pub(super) fn bake(soups: &[(SurfaceId, Soup)], rect: Rect, lens: Lens) -> Option<Picture> {
    let rays = Rays::cast(soups, rect, lens);
    let shown: Vec<Shown> = soups.iter().map(|(id, _)| Shown::new(*id)).collect();
    let pixels = (rays.width / FINE, rays.height / FINE);
    let (w, h) = (pixels.0 as u32, pixels.1 as u32);
    let mut picture = Picture {
        color: RgbaImage::new(w, h),
        normal: RgbImage::from_pixel(w, h, Rgb([128, 128, 255])),
        orm: RgbImage::from_pixel(w, h, Rgb([255, 255, 0])),
        holes: false,
    };
    let mut empty = true;
    for y in 0..pixels.1 {
        for x in 0..pixels.0 {
            let pixel = rays.pixel(x, y, &shown);
            picture.holes |= pixel.is_none();
            let Some(pixel) = pixel else { continue };
            empty = false;
            let [r, g, b] = pixel.color.map(samples::encoded);
            picture
                .color
                .put_pixel(x as u32, y as u32, Rgba([r, g, b, 255]));
            let byte = |t: f64| (t.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
            let n = pixel.normal * 0.5 + 0.5;
            picture
                .normal
                .put_pixel(x as u32, y as u32, Rgb([byte(n.x), byte(n.y), byte(n.z)]));
            let [roughness, metallic] = pixel.gloss.map(|t| byte(f64::from(t)));
            picture
                .orm
                .put_pixel(x as u32, y as u32, Rgb([255, roughness, metallic]));
        }
    }
    if empty {
        return None;
    }
    fill_holes(&mut picture);
    Some(picture)
}

/// A surface with its sampled textures.
struct Shown {
    surface: &'static Surface,
    samples: Option<&'static Samples>,
}

impl Shown {
    fn new(id: SurfaceId) -> Shown {
        let surface = id.surface();
        Shown {
            surface,
            samples: surface.picture.and_then(samples::samples),
        }
    }
}

/// The result of one ray, or the mean of a pixel's rays.
#[derive(Clone, Copy)]
struct Pixel {
    color: [f32; 3],
    normal: DVec3,
    /// Roughness and metalness.
    gloss: [f32; 2],
}

impl Rays {
    fn cast(soups: &[(SurfaceId, Soup)], rect: Rect, lens: Lens) -> Rays {
        let size = |metres: f64| (metres * lens.density).ceil().clamp(1.0, LARGEST) as usize * FINE;
        let (width, height) = (size(rect.width()), size(rect.height()));
        let mut rays = Rays {
            rect,
            width,
            height,
            triangles: vec![],
            hits: vec![Hit::NOTHING; width * height],
            panes: lens.panes,
        };
        for (i, (_, soup)) in soups.iter().enumerate() {
            for triangle in soup.indices.chunks_exact(3) {
                rays.triangle(i, soup, [triangle[0], triangle[1], triangle[2]]);
            }
        }
        rays
    }

    /// Records the rays that hit this triangle before anything else.
    fn triangle(&mut self, surface: usize, soup: &Soup, corners: [u32; 3]) {
        let point = |i: u32| soup.positions[i as usize].map(f64::from);
        let normal = DVec3::from(soup.normals[corners[0] as usize].map(f64::from));
        // Seen edge-on or from behind.
        if normal.y > -1e-6 {
            return;
        }
        let p = corners.map(|i| DVec3::from(point(i)));
        let uv = corners.map(|i| DVec2::from(soup.uvs[i as usize].map(f64::from)));
        let flat = p.map(|p| self.ray_of(p));
        let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        if area.abs() < 1e-9 {
            return;
        }
        // The shares of the second and third corner at a ray, and their change along a row and down.
        let (e1, e2) = ((flat[1] - flat[0]) / area, (flat[2] - flat[0]) / area);
        let share = |at: DVec2| dvec2((at - flat[0]).perp_dot(e2), e1.perp_dot(at - flat[0]));
        let (start, along, down) = (
            share(DVec2::splat(0.5)),
            dvec2(e2.y, -e1.y),
            dvec2(-e2.x, e1.x),
        );
        let spread = |t: DVec2| (uv[1] - uv[0]) * t.x + (uv[2] - uv[0]) * t.y;
        let number = self.triangles.len() as u32;
        self.triangles.push(Triangle {
            surface,
            normal,
            right: right_of(p, uv),
            uv: [uv[0] + spread(start), spread(along), spread(down)],
        });
        let lo = flat[0].min(flat[1]).min(flat[2]).max(DVec2::ZERO);
        let last = dvec2(self.width as f64, self.height as f64) - 1.0;
        let hi = flat[0]
            .max(flat[1])
            .max(flat[2])
            .min(last + 0.5)
            .max(DVec2::ZERO);
        let (first, last) = (lo.x.floor() as usize, hi.x as usize);
        for y in lo.y.floor() as usize..=hi.y as usize {
            let mut t = start + along * first as f64 + down * y as f64;
            let Some(row) = self.hits.get_mut(y * self.width..(y + 1) * self.width) else {
                return;
            };
            for hit in row.iter_mut().take(last + 1).skip(first) {
                if t.x >= 0.0 && t.y >= 0.0 && t.x + t.y <= 1.0 {
                    let depth = p[0].y + (p[1].y - p[0].y) * t.x + (p[2].y - p[0].y) * t.y;
                    let depth = depth as f32;
                    if depth < hit.depth {
                        *hit = Hit {
                            depth,
                            triangle: number,
                        };
                    }
                }
                t += along;
            }
        }
    }

    /// Converts a point to ray coordinates, y down.
    fn ray_of(&self, p: DVec3) -> DVec2 {
        let x = (p.x - self.rect.x0) / self.rect.width() * self.width as f64;
        let y = (self.rect.z1 - p.z) / self.rect.height() * self.height as f64;
        dvec2(x, y)
    }

    /// Averages the rays of a pixel; `None` if most of them hit nothing or glass.
    fn pixel(&self, x: usize, y: usize, shown: &[Shown]) -> Option<Pixel> {
        let mut color = [0.0; 3];
        let mut gloss = [0.0; 2];
        let (mut normal, mut count) = (DVec3::ZERO, 0.0);
        // Most pixels lie on one triangle: rays on the same one share what the first of them sees.
        let mut before: Option<(u32, Pixel)> = None;
        for (i, j) in (0..FINE * FINE).map(|n| (n % FINE, n / FINE)) {
            let (u, v) = (x * FINE + i, y * FINE + j);
            let hit = self.hits[v * self.width + u];
            let seen = match before {
                Some((triangle, seen)) if triangle == hit.triangle => seen,
                _ => match self.ray(u, v, hit, shown) {
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
            Pixel {
                color: color.map(|c| c / n),
                normal: normal.normalize_or(DVec3::Z),
                gloss: gloss.map(|g| g / n),
            }
        })
    }

    /// Shades one ray; `None` if it hits nothing, or glass that stays a hole.
    fn ray(&self, u: usize, v: usize, hit: Hit, shown: &[Shown]) -> Option<Pixel> {
        let on = self.triangles.get(hit.triangle as usize)?;
        let of = &shown[on.surface];
        if of.surface.glass && !self.panes {
            return None;
        }
        let light = self.light(u, v, hit.depth);
        let uv = on.uv[0] + on.uv[1] * u as f64 + on.uv[2] * v as f64;
        let sample = of.samples.map_or(samples::PLAIN, |s| s.at(uv.x, uv.y));
        let tint = of.surface.tint;
        Some(Pixel {
            color: std::array::from_fn(|k| sample.color[k] * tint[k] * light),
            normal: seen(on, sample.normal),
            gloss: [
                sample.roughness * of.surface.roughness,
                sample.metallic * of.surface.metallic,
            ],
        })
    }

    /// Returns the share of daylight at a point, reduced where its neighbours protrude.
    fn light(&self, u: usize, v: usize, depth: f32) -> f32 {
        const REACH: isize = 4 * FINE as isize;
        const ROUND: [(isize, isize); 8] = [
            (1, 0),
            (-1, 0),
            (0, -1),
            (0, -2),
            (1, -1),
            (-1, -1),
            (0, 1),
            (0, -3),
        ];
        let mut shade = 0.0;
        for (du, dv) in ROUND {
            let (x, y) = (u as isize + du * REACH, v as isize + dv * REACH);
            if x < 0 || y < 0 || x >= self.width as isize || y >= self.height as isize {
                continue;
            }
            let hit = self.hits[y as usize * self.width + x as usize];
            if hit.depth.is_finite() {
                shade += ((depth - hit.depth) / DEEP).clamp(0.0, 1.0);
            }
        }
        1.0 - (1.0 - DARKEST) * shade / ROUND.len() as f32
    }
}

/// Returns the direction of the image's u axis on a triangle.
fn right_of(p: [DVec3; 3], uv: [DVec2; 3]) -> DVec3 {
    let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
    let (d1, d2) = (uv[1] - uv[0], uv[2] - uv[0]);
    let det = d1.perp_dot(d2);
    ((e1 * d2.y - e2 * d1.y) / det).normalize_or(DVec3::X)
}

/// Converts a normal of a textured surface on a triangle to the frame of the image: right, up, out.
fn seen(on: &Triangle, drawn: [f32; 3]) -> DVec3 {
    let [x, y, z] = drawn.map(f64::from);
    let up = on.normal.cross(on.right);
    let n = on.right * x + up * y + on.normal * z;
    dvec3(n.x, n.z, -n.y).normalize_or(DVec3::Z)
}

/// Fills holes with the colour of their nearest neighbours in a few steps, so that edges do not darken in smaller mip
/// levels.
fn fill_holes(picture: &mut Picture) {
    if !picture.holes {
        return;
    }
    let (w, h) = picture.color.dimensions();
    let mut known: Vec<bool> = picture.color.pixels().map(|p| p.0[3] > 0).collect();
    for _ in 0..8 {
        let before = known.clone();
        for y in 0..h {
            for x in 0..w {
                let at = (y * w + x) as usize;
                if before[at] {
                    continue;
                }
                let near = [
                    (x.wrapping_sub(1), y),
                    (x + 1, y),
                    (x, y.wrapping_sub(1)),
                    (x, y + 1),
                ];
                let mut near = near.into_iter().filter(|(x, y)| *x < w && *y < h);
                if let Some((i, j)) = near.find(|(x, y)| before[(y * w + x) as usize]) {
                    let [r, g, b, _] = picture.color.get_pixel(i, j).0;
                    picture.color.put_pixel(x, y, Rgba([r, g, b, 0]));
                    known[at] = true;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tessellate::mesh::Bodies;

    const RECT: Rect = Rect {
        x0: 0.0,
        x1: 1.0,
        z0: 0.0,
        z1: 1.0,
    };

    fn wall(name: &str, x1: f64, y: f64) -> Bodies {
        let mut bodies = Bodies::default();
        let surface = SurfaceId::named(name);
        bodies.block(surface, dvec3(0.0, y, 0.0), dvec3(x1, y + 0.1, 1.0));
        bodies
    }

    #[test]
    fn what_is_not_there_is_a_hole() {
        let picture =
            bake(&wall("plaster", 0.5, 0.0).soups, RECT, WALL).expect("half a wall is seen");
        let shows = |x: u32| picture.color.get_pixel(x, 60).0[3] > 0;
        assert!(picture.holes && shows(10) && !shows(110));
        assert!(bake(&[], RECT, WALL).is_none());
    }

    #[test]
    fn the_nearer_one_hides_the_farther() {
        let mut soups = wall("plaster", 1.0, 0.0).soups;
        soups.extend(wall("charred", 0.5, -0.2).soups);
        let picture = bake(&soups, RECT, WALL).expect("a wall is seen");
        let bright = |x: u32| picture.color.get_pixel(x, 60).0[0];
        assert!(!picture.holes && bright(20) < 80 && bright(110) > 160);
    }

    #[test]
    fn flat_walls_look_out() {
        let picture = bake(&wall("aluminium", 1.0, 0.0).soups, RECT, WALL).expect("a wall is seen");
        let mean: f64 = picture
            .normal
            .pixels()
            .map(|p| f64::from(p.0[2]))
            .sum::<f64>()
            / f64::from(picture.normal.width() * picture.normal.height());
        assert!(mean > 240.0, "{mean}");
    }
}
