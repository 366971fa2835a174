//! Operations on pixels: the level between ink and paper, connected parts, an image seen through a projective map.

use glam::{DMat3, DVec2, DVec3, dvec2};
use image::{GrayImage, Rgb, RgbImage};
use rayon::prelude::*;

/// Returns the tone that parts an image best into dark and light, by the method of Otsu: the mean tones of both differ most.
///
/// The darker class includes the level.
pub fn otsu_level(picture: &GrayImage) -> u8 {
    let mut counts = [0_u64; 256];
    for pixel in picture.pixels() {
        counts[usize::from(pixel[0])] += 1;
    }
    let all = picture.pixels().len() as f64;
    let weighted = |(tone, count): (usize, &u64)| tone as f64 * *count as f64;
    let sum: f64 = counts.iter().enumerate().map(weighted).sum();
    let (mut below, mut sum_below) = (0.0, 0.0);
    let (mut best, mut level) = (0.0, 0);
    for (tone, count) in counts.iter().enumerate() {
        below += *count as f64;
        sum_below += weighted((tone, count));
        let above = all - below;
        if below == 0.0 || above == 0.0 {
            continue;
        }
        let apart = sum_below / below - (sum - sum_below) / above;
        let variance = below * above * apart * apart;
        if variance > best {
            (best, level) = (variance, tone as u8);
        }
    }
    level
}

/// The connected parts of an image.
pub struct Parts {
    /// The part of each pixel, by rows: from 1, in the order of their first pixels; 0 is the background.
    pub of: Vec<u32>,
    /// The number of parts.
    pub count: usize,
    width: u32,
}

impl Parts {
    /// Finds the parts of the pixels that are not 0. Pixels that meet at a corner hang together if `diagonal`.
    pub fn of(picture: &GrayImage, diagonal: bool) -> Parts {
        let set = |x: u32, y: u32| picture.get_pixel(x, y)[0] > 0;
        Parts::of_set(picture.dimensions(), set, diagonal)
    }

    /// Finds the connected parts of the pixels for which `set` is true.
    pub fn of_set(
        (width, height): (u32, u32),
        set: impl Fn(u32, u32) -> bool,
        diagonal: bool,
    ) -> Parts {
        let row = width as usize;
        let mut of = vec![0_u32; row * height as usize];
        // Provisional labels, each with a label of its part that is not larger: a forest of disjoint sets.
        let mut parents = vec![0_u32];
        for y in 0..height {
            for x in (0..width).filter(|x| set(*x, y)) {
                let at = y as usize * row + x as usize;
                let label_at = |is_in: bool, back: usize| if is_in { of[at - back] } else { 0 };
                let before = [
                    label_at(x > 0, 1),
                    label_at(y > 0, row),
                    label_at(diagonal && x > 0 && y > 0, row + 1),
                    label_at(diagonal && x + 1 < width && y > 0, row - 1),
                ];
                let mut label = 0;
                for near in before {
                    if near == 0 || near == label {
                        continue;
                    }
                    let other = root(&mut parents, near);
                    if other == label {
                        continue;
                    }
                    if label == 0 {
                        label = other;
                    } else {
                        let (low, high) = (label.min(other), label.max(other));
                        parents[high as usize] = low;
                        label = low;
                    }
                }
                if label == 0 {
                    label = parents.len() as u32;
                    parents.push(label);
                }
                of[at] = label;
            }
        }
        let mut numbers = vec![0_u32; parents.len()];
        let mut count = 0;
        for label in of.iter_mut().filter(|label| **label > 0) {
            let number = &mut numbers[root(&mut parents, *label) as usize];
            if *number == 0 {
                count += 1;
                *number = count;
            }
            *label = *number;
        }
        Parts {
            of,
            count: count as usize,
            width,
        }
    }

    /// Returns the part of a pixel.
    pub fn at(&self, (x, y): (usize, usize)) -> usize {
        self.of[y * self.width as usize + x] as usize
    }

    /// Returns the extent of each part by its number; that of the background is empty.
    pub fn extents(&self) -> Vec<Extent> {
        let mut out = vec![Extent::default(); self.count + 1];
        for (x, y, part) in self.pixels() {
            out[part as usize].add(x as usize, y as usize);
        }
        out
    }

    /// Returns the pixels of all parts: column, row and part.
    pub fn pixels(&self) -> impl Iterator<Item = (u32, u32, u32)> {
        let rows = (0..).zip(self.of.chunks(self.width.max(1) as usize));
        rows.flat_map(|(y, row)| {
            let all = (0..).zip(row).filter(|(_, part)| **part > 0);
            all.map(move |(x, part)| (x, y, *part))
        })
    }
}

/// The place and size of a connected part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// First and last column.
    pub x: [usize; 2],
    /// First and last row.
    pub y: [usize; 2],
    /// Number of pixels.
    pub area: usize,
}

impl Default for Extent {
    fn default() -> Extent {
        let none = [usize::MAX, 0];
        Extent {
            x: none,
            y: none,
            area: 0,
        }
    }
}

impl Extent {
    /// Adds a pixel.
    pub fn add(&mut self, x: usize, y: usize) {
        self.x = [self.x[0].min(x), self.x[1].max(x)];
        self.y = [self.y[0].min(y), self.y[1].max(y)];
        self.area += 1;
    }

    /// Returns the extent that covers both.
    pub fn with(self, other: Extent) -> Extent {
        Extent {
            x: [self.x[0].min(other.x[0]), self.x[1].max(other.x[1])],
            y: [self.y[0].min(other.y[0]), self.y[1].max(other.y[1])],
            area: self.area + other.area,
        }
    }

    /// Returns width and height, pixels; 0 without any.
    pub fn size(&self) -> [usize; 2] {
        [self.x, self.y].map(|[a, b]| (b + 1).saturating_sub(a))
    }

    /// Returns the length of the diagonal, pixels.
    pub fn diagonal(&self) -> f64 {
        let [w, h] = self.size().map(|s| s as f64);
        w.hypot(h)
    }
}

/// The smallest label of a set; paths get shorter on the way.
fn root(parents: &mut [u32], mut label: u32) -> u32 {
    while parents[label as usize] != label {
        let next = parents[parents[label as usize] as usize];
        parents[label as usize] = next;
        label = next;
    }
    label
}

/// Returns an image seen through a map from pixels of the result to those of the image, interpolated between four pixels. What
/// lies beyond its edges has the tone `beyond`.
pub fn warp(
    picture: &RgbImage,
    map: DMat3,
    (width, height): (u32, u32),
    beyond: Rgb<u8>,
) -> RgbImage {
    let mut out = RgbImage::new(width, height);
    let at = |x: i64, y: i64| {
        let inside = (0..i64::from(picture.width())).contains(&x)
            && (0..i64::from(picture.height())).contains(&y);
        if inside {
            picture.get_pixel(x as u32, y as u32).0
        } else {
            beyond.0
        }
    };
    out.par_chunks_mut(3 * width.max(1) as usize)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
                let p = project(map, dvec2(x as f64, y as f64));
                let (left, top) = (p.x.floor() as i64, p.y.floor() as i64);
                let (right, below) = (left.saturating_add(1), top.saturating_add(1));
                let share = p - p.floor();
                let corners = [
                    (at(left, top), at(right, top)),
                    (at(left, below), at(right, below)),
                ];
                for (c, tone) in pixel.iter_mut().enumerate() {
                    let [upper, lower] =
                        corners.map(|(a, b)| mixed(f64::from(a[c]), f64::from(b[c]), share.x));
                    *tone = mixed(upper, lower, share.y) as u8;
                }
            }
        });
    out
}

/// Takes a point by a projective map.
pub fn project(map: DMat3, at: DVec2) -> DVec2 {
    let p = map * DVec3::new(at.x, at.y, 1.0);
    dvec2(p.x, p.y) / p.z
}

/// A value between two: `a` at 0, `b` at 1.
fn mixed(a: f64, b: f64, share: f64) -> f64 {
    a + (b - a) * share
}

#[cfg(test)]
mod tests {
    use super::{Parts, otsu_level, warp};
    use glam::{DMat3, DVec2};
    use image::{GrayImage, Luma, Rgb, RgbImage};

    /// An image of characters: `#` is ink.
    fn drawn(rows: &[&str]) -> GrayImage {
        let ink = |x: u32, y: u32| rows[y as usize].as_bytes()[x as usize] == b'#';
        GrayImage::from_fn(rows[0].len() as u32, rows.len() as u32, |x, y| {
            Luma([u8::from(ink(x, y))])
        })
    }

    #[test]
    fn arms_that_meet_late_are_one_part() {
        let picture = drawn(&["#.#.#", "#.#.#", "#####", ".....", "##..#"]);
        let parts = Parts::of(&picture, false);
        assert_eq!(parts.count, 3);
        assert!(
            parts
                .pixels()
                .filter(|(_, y, _)| *y < 3)
                .all(|(_, _, part)| part == 1)
        );
        assert_eq!(parts.of[4 * 5], 2);
        assert_eq!(parts.of[4 * 5 + 4], 3);
    }

    #[test]
    fn corners_join_only_where_asked() {
        let picture = drawn(&["#..", ".#.", "#.#"]);
        assert_eq!(Parts::of(&picture, false).count, 4);
        assert_eq!(Parts::of(&picture, true).count, 1);
    }

    #[test]
    fn level_lies_between_two_tones() {
        let picture = GrayImage::from_fn(20, 20, |x, _| Luma([if x < 6 { 40 } else { 200 }]));
        assert_eq!(otsu_level(&picture), 40);
        assert_eq!(otsu_level(&GrayImage::from_pixel(4, 4, Luma([77]))), 0);
        assert_eq!(otsu_level(&GrayImage::new(0, 0)), 0);
    }

    #[test]
    fn half_a_pixel_is_the_mean_and_the_outside_has_its_tone() {
        let picture = RgbImage::from_fn(2, 1, |x, _| Rgb([if x == 0 { 10 } else { 30 }, 0, 0]));
        let half = DMat3::from_translation(DVec2::new(0.5, 0.0));
        let seen = warp(&picture, half, (1, 1), Rgb([255; 3]));
        assert_eq!(seen.get_pixel(0, 0).0, [20, 0, 0]);
        let far = DMat3::from_translation(DVec2::new(-9.0, 1e300));
        assert_eq!(
            warp(&picture, far, (1, 1), Rgb([7; 3])).get_pixel(0, 0).0,
            [7; 3]
        );
    }
}
