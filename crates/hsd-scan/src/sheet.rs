//! A sheet: the picture of a plan as it came, turned upright, and the ink on it.

pub mod ground;

use glam::{DVec2, dvec2};
use image::imageops::crop_imm;
use image::{GrayImage, Luma, Rgb, RgbImage};

use super::raster::{Parts, otsu_level};

/// Blocks of the paper's tone along the longer side of a picture.
const BLOCKS: u32 = 120;
/// The share of a block's pixels that may be darker than its paper.
const PAPER: f64 = 0.85;

/// How far what a sheet lies on may reach into a picture, of its side.
const EDGE: f64 = 0.1;

/// How clearly a stroke must run one way, 0 to 1.
const SLANT_CLEAR: f64 = 0.5;
/// A stroke slants that runs at more than half the angle of which this is the tangent: 17 degrees.
const SLANT: f64 = 0.67;

/// The ink on a sheet: how much darker than the paper round it a pixel is, 0 to 255.
#[derive(Clone, Debug)]
pub struct Ink {
    /// Ink of any colour.
    pub dark: GrayImage,
    /// Red ink alone: what takes green and blue light but not red.
    pub red: GrayImage,
    /// What counts as ink in `dark`.
    pub threshold: u8,
}

impl Ink {
    /// Finds the ink: each pixel beside the tone of the paper round it, colour by colour, so that stains, shadows and
    /// coloured slips are paper.
    pub fn of(sheet: &RgbImage) -> Ink {
        let paper = Paper::of(sheet);
        let (width, height) = sheet.dimensions();
        let mut dark = GrayImage::new(width, height);
        let mut red = GrayImage::new(width, height);
        for (x, y, pixel) in sheet.enumerate_pixels() {
            let [r, g, b] = paper.absorbed(x, y, *pixel);
            dark.put_pixel(x, y, Luma([level(r.max(g).max(b))]));
            red.put_pixel(x, y, Luma([level(g.min(b) - r)]));
        }
        let threshold = otsu_level(&dark).clamp(38, 100);
        let mut ink = Ink {
            dark,
            red,
            threshold,
        };
        ink.clear_edges();
        ink
    }

    /// Clears ink that runs in from the edges of the picture a little way: what the sheet lies on, not what is drawn on it.
    fn clear_edges(&mut self) {
        let (width, height) = self.dark.dimensions();
        for (lines, length, upright) in [(height, width, false), (width, height, true)] {
            let reach = (f64::from(length) * EDGE) as u32;
            for (line, back) in (0..lines).flat_map(|line| [(line, false), (line, true)]) {
                let place = |k: u32| {
                    let k = if back { length - 1 - k } else { k };
                    if upright { (line, k) } else { (k, line) }
                };
                let run = (0..length)
                    .take_while(|k| {
                        self.dark.get_pixel(place(*k).0, place(*k).1)[0] > self.threshold / 2
                    })
                    .count() as u32;
                // A stroke that is cut off by the edge goes on.
                if run <= reach {
                    for (x, y) in (0..run).map(place) {
                        self.dark.put_pixel(x, y, Luma([0]));
                        self.red.put_pixel(x, y, Luma([0]));
                    }
                }
            }
        }
    }

    /// The share of the sheet that is ink.
    pub fn share(&self) -> f64 {
        let dark = self.dark.pixels().filter(|p| p[0] > self.threshold).count();
        dark as f64 / f64::from(self.dark.width() * self.dark.height())
    }

    /// The ink without what is small in both directions and stands alone: writing, specks. `most` is in pixels; `keep` tells
    /// of the middle and size of a part whether it stays all the same.
    pub fn without_writing(&self, most: f64, keep: impl Fn(DVec2, DVec2) -> bool) -> Ink {
        let black = GrayImage::from_fn(self.dark.width(), self.dark.height(), |x, y| {
            Luma([u8::from(self.is(x, y))])
        });
        let parts = Parts::of(&black, true);
        let mut boxes = vec![[u32::MAX, u32::MAX, 0, 0]; parts.count];
        for (x, y, part) in parts.pixels() {
            let b = &mut boxes[part as usize - 1];
            *b = [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)];
        }
        let stays: Vec<bool> = boxes
            .iter()
            .map(|[x0, y0, x1, y1]| {
                let size = dvec2(f64::from(x1 + 1 - x0), f64::from(y1 + 1 - y0));
                let middle = dvec2(f64::from(*x0), f64::from(*y0)) + size / 2.0;
                size.max_element() > most || keep(middle, size)
            })
            .collect();
        let mut ink = self.clone();
        for (x, y, part) in parts.pixels() {
            if !stays[part as usize - 1] {
                ink.dark.put_pixel(x, y, Luma([0]));
                ink.red.put_pixel(x, y, Luma([0]));
            }
        }
        ink
    }

    /// Returns the ink of a box of the sheet: its upper left corner and its size, pixels.
    pub fn within(&self, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> Ink {
        let part = |of: &GrayImage| crop_imm(of, x, y, width, height).to_image();
        Ink {
            dark: part(&self.dark),
            red: part(&self.red),
            threshold: self.threshold,
        }
    }

    /// The ink without strokes that run across the sheet: hatching, leaves that stand open.
    ///
    /// The way a stroke runs follows from the changes of tone round it (the tensor of their products).
    pub fn without_slanting(&self) -> Ink {
        let (width, height) = self.dark.dimensions();
        let at = |x: i64, y: i64| {
            let (x, y) = (
                x.clamp(0, i64::from(width) - 1),
                y.clamp(0, i64::from(height) - 1),
            );
            f64::from(self.dark.get_pixel(x as u32, y as u32)[0])
        };
        let mut ink = self.clone();
        let slope =
            |x: i64, y: i64| dvec2(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
        for y in 0..height {
            for x in 0..width {
                if !self.is(x, y) {
                    continue;
                }
                let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
                for (dx, dy) in (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy))) {
                    let s = slope(i64::from(x) + dx, i64::from(y) + dy);
                    (xx, yy, xy) = (xx + s.x * s.x, yy + s.y * s.y, xy + s.x * s.y);
                }
                let (one, two) = (xx - yy, 2.0 * xy);
                let clear = libm::sqrt(one * one + two * two) > SLANT_CLEAR * (xx + yy);
                if clear && two.abs() > SLANT * one.abs() {
                    ink.dark.put_pixel(x, y, Luma([0]));
                    ink.red.put_pixel(x, y, Luma([0]));
                }
            }
        }
        ink
    }

    /// Whether there is ink at a pixel.
    pub fn is(&self, x: u32, y: u32) -> bool {
        self.dark.get_pixel(x, y)[0] > self.threshold
    }
}

/// Returns how far from grey the ink on a sheet is, 0 to 255.
///
/// It differs from grey both by itself and beside the paper round it. The lesser difference counts: coloured rooms are paper, and
/// the tone of paper is unknown inside a thick wall.
pub fn tints(sheet: &RgbImage) -> GrayImage {
    let paper = Paper::of(sheet);
    let range = |shares: [f64; 3]| {
        let most = shares.into_iter().fold(0.0, f64::max);
        most - shares.into_iter().fold(1.0, f64::min)
    };
    GrayImage::from_fn(sheet.width(), sheet.height(), |x, y| {
        let pixel = *sheet.get_pixel(x, y);
        let own = pixel.0.map(|c| f64::from(c) / 255.0);
        Luma([level(range(own).min(range(paper.absorbed(x, y, pixel))))])
    })
}

/// A share of 0 to 1 as a level of 0 to 255.
fn level(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// The tone of the paper without what is drawn on it, by blocks.
struct Paper {
    block: u32,
    across: u32,
    tones: Vec<[f64; 3]>,
}

impl Paper {
    fn of(sheet: &RgbImage) -> Paper {
        let (width, height) = sheet.dimensions();
        let block = (width.max(height) / BLOCKS).max(6);
        let (across, down) = (width.div_ceil(block), height.div_ceil(block));
        let mut light = Vec::with_capacity((across * down) as usize);
        for v in 0..down {
            for u in 0..across {
                light.push(lightest(sheet, [u * block, v * block], block));
            }
        }
        // A block that a wall fills has the tone of the blocks beside it.
        let grown = spread(&light, across, down, |a, b| a.max(b));
        let tones = spread(&grown, across, down, |a, b| a.min(b));
        Paper {
            block,
            across,
            tones,
        }
    }

    /// The share of each colour that the ink at a pixel absorbs.
    fn absorbed(&self, x: u32, y: u32, pixel: Rgb<u8>) -> [f64; 3] {
        let tone = self.at(x, y);
        std::array::from_fn(|c| 1.0 - (f64::from(pixel[c]) / tone[c]).min(1.0))
    }

    /// Tones between the middles of blocks.
    fn at(&self, x: u32, y: u32) -> [f64; 3] {
        let down = self.tones.len() as u32 / self.across;
        let place = |p: u32, most: u32| {
            let at = (f64::from(p) / f64::from(self.block) - 0.5).clamp(0.0, f64::from(most - 1));
            let low = at.floor();
            (low as u32, (low as u32 + 1).min(most - 1), at - low)
        };
        let (u0, u1, fu) = place(x, self.across);
        let (v0, v1, fv) = place(y, down);
        let tone = |u: u32, v: u32, c: usize| self.tones[(v * self.across + u) as usize][c];
        std::array::from_fn(|c| {
            let top = tone(u0, v0, c) * (1.0 - fu) + tone(u1, v0, c) * fu;
            let bottom = tone(u0, v1, c) * (1.0 - fu) + tone(u1, v1, c) * fu;
            (top * (1.0 - fv) + bottom * fv).max(8.0)
        })
    }
}

/// The tone that all but the lightest pixels of a block stay under.
fn lightest(sheet: &RgbImage, [x, y]: [u32; 2], block: u32) -> [f64; 3] {
    let mut counts = [[0_u32; 256]; 3];
    let mut total = 0;
    for v in y..(y + block).min(sheet.height()) {
        for u in x..(x + block).min(sheet.width()) {
            let pixel = sheet.get_pixel(u, v);
            (0..3).for_each(|c| counts[c][usize::from(pixel[c])] += 1);
            total += 1;
        }
    }
    std::array::from_fn(|c| {
        let mut below = 0;
        let stop = (f64::from(total) * PAPER) as u32;
        let tone = counts[c].iter().position(|n| {
            below += n;
            below > stop
        });
        tone.unwrap_or(255) as f64
    })
}

/// The extreme of each block and the eight round it.
fn spread(
    tones: &[[f64; 3]],
    across: u32,
    down: u32,
    pick: impl Fn(f64, f64) -> f64,
) -> Vec<[f64; 3]> {
    let mut out = Vec::with_capacity(tones.len());
    for v in 0..down {
        for u in 0..across {
            let mut tone = tones[(v * across + u) as usize];
            for y in v.saturating_sub(1)..=(v + 1).min(down - 1) {
                for x in u.saturating_sub(1)..=(u + 1).min(across - 1) {
                    let other = tones[(y * across + x) as usize];
                    (0..3).for_each(|c| tone[c] = pick(tone[c], other[c]));
                }
            }
            out.push(tone);
        }
    }
    out
}
