//! The pictures of parts: clean, equally bright, and without seams where they meet.

pub mod composed;

use super::Front;
use super::cells::{self, Cell};
use super::kinds::Shown;
use super::tone::{CORRECTED, Light, levels, linear};
use image::{Rgb, RgbImage};

/// The width of the band in which borders are fitted to their neighbours, as a part of the picture.
const BAND: f64 = 0.06;
/// The largest difference of borders that is a seam, as a part of their brightness: more is another material.
const SEAM: f32 = 0.25;
/// Places along a border at which it is compared.
const PLACES: usize = 24;

/// A wall with even light.
pub fn lit(wall: &RgbImage, light: &Light) -> RgbImage {
    let (width, height) = (f64::from(wall.width()), f64::from(wall.height()));
    let mut out = wall.clone();
    // Light is smooth: it is worked out for blocks of pixels.
    const BLOCK: u32 = 8;
    for top in (0..wall.height()).step_by(BLOCK as usize) {
        for left in (0..wall.width()).step_by(BLOCK as usize) {
            let middle = |t: u32| f64::from(t) + f64::from(BLOCK) / 2.0;
            let by = light.correction(middle(left) / width, middle(top) / height) as f32;
            for y in top..(top + BLOCK).min(wall.height()) {
                for x in left..(left + BLOCK).min(wall.width()) {
                    let pixel = out.get_pixel_mut(x, y);
                    *pixel = Rgb(levels(linear(pixel.0).map(|c| c * by)));
                }
            }
        }
    }
    out
}

/// The picture of a cell, so many times as bright.
pub fn cut(wall: &RgbImage, cell: &Cell, gain: f32) -> RgbImage {
    let [left, top, ..] = cell.frame;
    let (width, height) = cell.size();
    let gain = gain.clamp(CORRECTED.0 as f32, CORRECTED.1 as f32);
    RgbImage::from_fn(width, height, |x, y| {
        let tone = linear(wall.get_pixel(left + x, top + y).0);
        Rgb(levels(tone.map(|c| c * gain)))
    })
}

/// How bright each kind is to be made: as the middle one of its cells.
pub fn gains(shown: &[Shown]) -> Vec<f32> {
    let of = |core: usize| {
        let own = shown.iter().filter(|s| s.as_cell == core && !s.is_replaced);
        // `gain` says how much brighter the clean one is than the cell.
        let mut ratios: Vec<f32> = own.map(|s| 1.0 / s.gain).collect();
        ratios.sort_by(f32::total_cmp);
        ratios.get(ratios.len() / 2).copied().unwrap_or(1.0)
    };
    (0..shown.len()).map(of).collect()
}

/// The part of what is seen of a cell that has to differ for it to be another variation.
const UNLIKE: f64 = 0.02;

/// Further clean pictures of a part, so many at the most: of what shows the same, those that differ most, as bright as it; `lit` is
/// the wall with even light, `core` the cell of the part and how many times as bright it is made.
pub fn variations(
    front: &Front,
    lit: &RgbImage,
    (core, gain): (usize, f32),
    most: usize,
) -> Vec<RgbImage> {
    let own = front.shown.iter().enumerate().filter(|(k, s)| {
        let is_clean = !s.is_replaced && !s.is_spoiled && front.cells[*k].is_whole();
        s.as_cell == core && *k != core && is_clean
    });
    let mut left: Vec<usize> = own.map(|(k, _)| k).collect();
    let mut taken = vec![core];
    while taken.len() <= most {
        let unlike = |k: usize| {
            let others = taken.iter().filter_map(|other| {
                let likeness = cells::compare(&front.cells[*other], &front.cells[k])?;
                Some(1.0 - likeness.share)
            });
            others.fold(1.0, f64::min)
        };
        let next = (0..left.len())
            .rev()
            .max_by(|a, b| unlike(left[*a]).total_cmp(&unlike(left[*b])));
        let Some(next) = next.filter(|k| unlike(left[*k]) >= UNLIKE) else {
            break;
        };
        taken.push(left.remove(next));
    }
    let picture = |k: &usize| cut(lit, &front.cells[*k], front.shown[*k].gain * gain);
    taken[1..].iter().map(picture).collect()
}

/// The four borders of a picture: left, top, right, bottom; colours at even distances along each.
type Borders = [[[f32; 3]; PLACES]; 4];

fn borders(picture: &RgbImage) -> Borders {
    let (width, height) = picture.dimensions();
    let depth = |n: u32| (n / 40).max(1);
    std::array::from_fn(|side| {
        std::array::from_fn(|k| {
            let part = |n: u32, k: usize| (n as usize * k / PLACES) as u32;
            let (xs, ys) = match side {
                0 => (
                    0..depth(width),
                    part(height, k)..part(height, k + 1).max(part(height, k) + 1),
                ),
                1 => (
                    part(width, k)..part(width, k + 1).max(part(width, k) + 1),
                    0..depth(height),
                ),
                2 => (
                    width - depth(width)..width,
                    part(height, k)..part(height, k + 1).max(part(height, k) + 1),
                ),
                _ => (
                    part(width, k)..part(width, k + 1).max(part(width, k) + 1),
                    height - depth(height)..height,
                ),
            };
            let mut sum = [0.0; 3];
            let mut count = 0.0;
            for y in ys {
                for x in xs.clone() {
                    if let Some(pixel) = picture.get_pixel_checked(x, y) {
                        let tone = linear(pixel.0);
                        sum.iter_mut().zip(tone).for_each(|(s, t)| *s += t);
                        count += 1.0;
                    }
                }
            }
            sum.map(|s| s / f32::max(count, 1.0))
        })
    })
}

/// Closes the seams between pictures: `meetings` are pairs of pictures that stand side by side (a left one, a right one) or one
/// above the other (an upper one, a lower one, `true`).
pub fn closed(pictures: &mut [RgbImage], meetings: &[(usize, usize, bool)]) {
    let own: Vec<Borders> = pictures.iter().map(borders).collect();
    for (which, picture) in pictures.iter_mut().enumerate() {
        let mut change: Borders = [[[0.0; 3]; PLACES]; 4];
        for (side, change) in change.iter_mut().enumerate() {
            let is_upright = side % 2 == 1;
            let others: Vec<(usize, usize)> = meetings
                .iter()
                .filter(|m| m.2 == is_upright)
                .filter_map(|(a, b, _)| match side < 2 {
                    true => (*b == which).then_some((*a, side + 2)),
                    false => (*a == which).then_some((*b, side - 2)),
                })
                .collect();
            for (k, change) in change.iter_mut().enumerate() {
                let mine = own[which][side][k];
                let near: Vec<[f32; 3]> = others
                    .iter()
                    .map(|(o, s)| own[*o][*s][k])
                    .filter(|t| is_seam(mine, *t))
                    .collect();
                for (c, change) in change.iter_mut().enumerate() {
                    let mean = near.iter().map(|t| t[c]).sum::<f32>() / near.len().max(1) as f32;
                    *change = if near.is_empty() {
                        0.0
                    } else {
                        (mean - mine[c]) / 2.0
                    };
                }
            }
        }
        fit(picture, &change);
    }
}

fn is_seam(a: [f32; 3], b: [f32; 3]) -> bool {
    let (most, off) = (0..3).fold((0.02_f32, 0.0_f32), |(most, off), c| {
        (most.max(a[c].max(b[c])), off.max((a[c] - b[c]).abs()))
    });
    off < SEAM * most
}

/// Adds changes at the borders, less and less inwards.
fn fit(picture: &mut RgbImage, change: &Borders) {
    let (width, height) = picture.dimensions();
    let (band_x, band_y) = (BAND * f64::from(width), BAND * f64::from(height));
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let away = [
            px / band_x,
            py / band_y,
            (f64::from(width) - px) / band_x,
            (f64::from(height) - py) / band_y,
        ];
        if away.iter().all(|a| *a >= 1.0) {
            continue;
        }
        let mut tone = linear(pixel.0);
        for (side, away) in away.into_iter().enumerate().filter(|(_, a)| *a < 1.0) {
            let along = if side % 2 == 0 {
                py / f64::from(height)
            } else {
                px / f64::from(width)
            };
            let at = (along * PLACES as f64 - 0.5).clamp(0.0, PLACES as f64 - 1.001);
            let (k, t) = (at as usize, at.fract() as f32);
            let (a, b) = (change[side][k], change[side][(k + 1).min(PLACES - 1)]);
            for (c, tone) in tone.iter_mut().enumerate() {
                *tone += (a[c] + (b[c] - a[c]) * t) * (1.0 - away) as f32;
            }
        }
        *pixel = Rgb(levels(tone));
    }
}
