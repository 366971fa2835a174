//! A picture to judge a front by: the photograph, the wall seen straight, the wall put together again, and how they differ.

use super::{Front, Photo};
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

/// The height of each of the four pictures, pixels.
const HEIGHT: u32 = 480;
/// Pixels between them.
const GAP: u32 = 8;
/// The colours of corners and of the lattice.
const RED: Rgb<u8> = Rgb([220, 30, 30]);

/// Draws the picture.
pub fn draw(photo: &Photo, front: &Front) -> RgbImage {
    let rebuilt = front.rebuilt();
    let mut seen = fitted(&photo.pixels);
    let scale = f64::from(seen.height()) / f64::from(photo.pixels.height());
    let corners = front.views[0].corners.map(|c| c * scale);
    for k in 0..4 {
        stroke(&mut seen, corners[k], corners[(k + 1) % 4]);
    }
    let mut wall = fitted(&front.wall);
    let again = fitted(&rebuilt);
    let off = difference(&wall, &again);
    lattice(&mut wall, front);
    let pictures = [seen, wall, again, off];
    let width = pictures.iter().map(|p| p.width() + GAP).sum::<u32>() + GAP;
    let mut out = RgbImage::from_pixel(width, HEIGHT + 2 * GAP, Rgb([255; 3]));
    let mut left = GAP;
    for picture in pictures {
        imageops::replace(&mut out, &picture, left.into(), GAP.into());
        left += picture.width() + GAP;
    }
    out
}

fn fitted(picture: &RgbImage) -> RgbImage {
    let width = f64::from(picture.width()) / f64::from(picture.height()) * f64::from(HEIGHT);
    let width = (width.round() as u32).clamp(1, 8 * HEIGHT);
    match picture.height() > HEIGHT {
        true => imageops::thumbnail(picture, width, HEIGHT),
        false => imageops::resize(picture, width, HEIGHT, FilterType::Triangle),
    }
}

/// How far two pictures differ: black where they agree, white by a quarter of the range and more.
fn difference(a: &RgbImage, b: &RgbImage) -> RgbImage {
    RgbImage::from_fn(a.width(), a.height(), |x, y| {
        let (a, b) = (a.get_pixel(x, y).0, b.get_pixel(x.min(b.width() - 1), y).0);
        let off = (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0);
        Rgb([off.saturating_mul(4); 3])
    })
}

fn lattice(wall: &mut RgbImage, front: &Front) {
    let (width, height) = wall.dimensions();
    let at = |t: f64, n: u32| ((t * f64::from(n)) as u32).min(n - 1);
    for u in &front.grid.columns {
        (0..height).for_each(|y| wall.put_pixel(at(*u, width), y, RED));
    }
    for v in &front.grid.rows {
        (0..width).for_each(|x| wall.put_pixel(x, at(*v, height), RED));
    }
}

fn stroke(picture: &mut RgbImage, from: glam::DVec2, to: glam::DVec2) {
    let steps = (2.0 * from.distance(to)).ceil().min(1e5) as usize;
    for k in 0..=steps {
        let at = from.lerp(to, k as f64 / steps.max(1) as f64);
        if at.x >= 0.0
            && at.y >= 0.0
            && (at.x as u32) < picture.width()
            && (at.y as u32) < picture.height()
        {
            picture.put_pixel(at.x as u32, at.y as u32, RED);
        }
    }
}
