//! A wall seen straight on: the photograph through lens and perspective.

use super::camera::Lens;
use glam::{DMat3, DVec2, dvec2};
use hsd_scan::raster::project;
use image::RgbImage;
use rayon::prelude::*;

/// The longer side of a straight wall, pixels.
pub const LONGEST: f64 = 2800.0;
/// The most samples of a pixel along one direction.
const SAMPLES: usize = 4;

/// The size in pixels of a wall whose corners are at these pixels of the photograph: nothing that is seen gets lost, up to a limit.
pub fn size(corners: [DVec2; 4], aspect: f64) -> (u32, u32) {
    let [a, b, c, d] = corners;
    let width = a.distance(b).max(c.distance(d));
    let height = b.distance(c).max(d.distance(a));
    let tall = height.max(width / aspect);
    let fit = (LONGEST / (tall * aspect).max(tall)).min(1.0);
    let side = |s: f64| ((s * fit).round() as u32).max(8);
    (side(tall * aspect), side(tall))
}

/// The same proportions, no side longer than this.
pub fn within((width, height): (u32, u32), longest: f64) -> (u32, u32) {
    let fit = (longest / f64::from(width.max(height))).min(1.0);
    let side = |s: u32| ((f64::from(s) * fit).round() as u32).max(8);
    (side(width), side(height))
}

/// The largest part by which a size changes so that lines fall between pixels.
const EVEN: f64 = 0.01;

/// The size nearest to this at which the lines of a lattice fall between pixels, as far as they can: equal parts then have the same
/// pixels, and none of their edges is half a pixel off.
pub fn even((width, height): (u32, u32), lines: [&[f64]; 2]) -> (u32, u32) {
    let side = |side: u32, lines: &[f64]| {
        let off = |n: u32| {
            let each = lines.iter().map(|l| l * f64::from(n));
            let off = each.map(|at| (at - at.round()).powi(2)).sum::<f64>();
            // Of two sizes that are as good the nearer one.
            off + 1e-6 * f64::from(n.abs_diff(side))
        };
        let room = (EVEN * f64::from(side)) as u32;
        let tried = side - room..=side + room;
        tried
            .min_by(|a, b| off(*a).total_cmp(&off(*b)))
            .unwrap_or(side)
    };
    (side(width, lines[0]), side(height, lines[1]))
}

/// The wall of a photograph: `map` takes the unit square of the wall, from its upper left corner, to the straight picture.
///
/// What lies beyond the photograph is grey; the second picture says so by 0.
pub fn rectify(
    photo: &RgbImage,
    lens: &Lens,
    map: DMat3,
    (width, height): (u32, u32),
) -> (RgbImage, Vec<bool>) {
    let size = dvec2(f64::from(width), f64::from(height));
    let seen = |p: DVec2| lens.bent(project(map, p / size));
    let mut out = RgbImage::new(width, height);
    let mut inside = vec![true; (width * height) as usize];
    let rows = out.par_chunks_mut(width as usize * 3);
    rows.zip(inside.par_chunks_mut(width as usize))
        .enumerate()
        .for_each(|(y, (row, inside))| {
            // Each place is worked out once: it is also that to the right of the pixel before.
            let line = |y: f64| (0..=width).map(move |x| seen(dvec2(f64::from(x) + 0.5, y)));
            let here: Vec<DVec2> = line(y as f64 + 0.5).collect();
            let pixels = row.as_chunks_mut::<3>().0.iter_mut().zip(inside);
            let places = here.windows(2).zip(line(y as f64 + 1.5));
            for ((pixel, inside), (along, below)) in pixels.zip(places) {
                *inside = holds(photo, along[0]);
                *pixel = match *inside {
                    true => averaged(photo, along[0], along[1], below),
                    false => [128; 3],
                };
            }
        });
    (out, inside)
}

fn holds(photo: &RgbImage, at: DVec2) -> bool {
    at.x >= 0.0
        && at.y >= 0.0
        && at.x < f64::from(photo.width())
        && at.y < f64::from(photo.height())
}

/// The colour of a pixel that covers the parallelogram round `at` towards its neighbours.
fn averaged(photo: &RgbImage, at: DVec2, right: DVec2, below: DVec2) -> [u8; 3] {
    let (u, v) = (right - at, below - at);
    let count = |step: DVec2| ((step.length() - 0.2).ceil().max(1.0) as usize).min(SAMPLES);
    let (across, down) = (count(u), count(v));
    let mut sum = [0.0_f32; 3];
    for j in 0..down {
        for i in 0..across {
            let share = |k: usize, n: usize| (k as f64 + 0.5) / n as f64 - 0.5;
            let tone = between(photo, at + u * share(i, across) + v * share(j, down));
            sum.iter_mut().zip(tone).for_each(|(s, t)| *s += t);
        }
    }
    let all = (across * down) as f32;
    sum.map(|s| (s / all + 0.5) as u8)
}

/// The colour at a point, between the four pixels round it.
pub(super) fn between(photo: &RgbImage, at: DVec2) -> [f32; 3] {
    let (width, height) = photo.dimensions();
    let (x, y) = ((at.x - 0.5).max(0.0), (at.y - 0.5).max(0.0));
    let (left, top) = (x as u32, y as u32);
    let (fx, fy) = ((x - f64::from(left)) as f32, (y - f64::from(top)) as f32);
    let pixel = |x: u32, y: u32| photo.get_pixel(x.min(width - 1), y.min(height - 1)).0;
    let (a, b) = (pixel(left, top), pixel(left + 1, top));
    let (c, d) = (pixel(left, top + 1), pixel(left + 1, top + 1));
    std::array::from_fn(|k| {
        let [a, b, c, d] = [a, b, c, d].map(|p| f32::from(p[k]));
        let (upper, lower) = (a + (b - a) * fx, c + (d - c) * fx);
        upper + (lower - upper) * fy
    })
}
