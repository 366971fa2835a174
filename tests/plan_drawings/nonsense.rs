//! Pictures that show no plan: a reader has to refuse them in words.

use super::paint::Clouds;
use super::rng::Rng;
use image::{ImageFormat, Rgb, RgbImage};
use std::io::Cursor;
use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// Kinds of nonsense.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Nonsense {
    /// Noise of all colours.
    Noise,
    /// Paper with nothing on it.
    Blank,
    /// Something like a photograph of a street: sky, road, boxes with windows.
    Street,
    /// Something like a map: winding roads, plots with no right angle.
    Map,
}

/// A picture without a plan.
pub fn nonsense(kind: Nonsense, seed: u64, size: (u32, u32)) -> RgbImage {
    let mut rng = Rng::new(seed, 41);
    let clouds = Clouds::new(&mut rng);
    match kind {
        Nonsense::Noise => RgbImage::from_fn(size.0, size.1, |_, _| {
            let bits = rng.next();
            Rgb([bits as u8, (bits >> 8) as u8, (bits >> 16) as u8])
        }),
        Nonsense::Blank => RgbImage::from_fn(size.0, size.1, |x, y| {
            let tone = 236.0 + 8.0 * clouds.at(x as f32 / 90.0, y as f32 / 90.0) + 3.0 * rng.bell();
            Rgb([tone as u8, (tone - 6.0) as u8, (tone - 22.0) as u8])
        }),
        Nonsense::Street => street(&mut rng, &clouds, size),
        Nonsense::Map => map(&mut rng, size),
    }
}

/// The first half of a PNG.
pub fn truncated_png(picture: &RgbImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, ImageFormat::Png)
        .expect("a picture has a PNG");
    let mut bytes = bytes.into_inner();
    bytes.truncate(bytes.len() / 2);
    bytes
}

fn street(rng: &mut Rng, clouds: &Clouds, size: (u32, u32)) -> RgbImage {
    let horizon = size.1 as f32 * 0.45;
    let mut picture = RgbImage::from_fn(size.0, size.1, |x, y| {
        let (fx, fy) = (x as f32, y as f32);
        let rough = 10.0 * clouds.at(fx / 60.0, fy / 40.0) + 4.0 * clouds.at(fx, fy);
        let (r, g, b) = if fy < horizon {
            (150.0, 175.0, 205.0)
        } else {
            (120.0, 115.0, 108.0)
        };
        let t = (fy - horizon).abs() / 12.0;
        Rgb([
            (r + rough + t * 0.4) as u8,
            (g + rough) as u8,
            (b + rough - t * 0.2) as u8,
        ])
    });
    for _ in 0..rng.whole(6, 12) {
        let (x0, w) = (
            rng.unit() * size.0 as f32,
            rng.between(0.06, 0.25) * size.0 as f32,
        );
        let (top, low) = (
            rng.between(0.1, 0.42) * size.1 as f32,
            rng.between(0.5, 0.75) * size.1 as f32,
        );
        let tint: [f32; 3] = [
            rng.between(70.0, 200.0),
            rng.between(60.0, 180.0),
            rng.between(50.0, 160.0),
        ];
        let (step, slope) = (rng.between(18.0, 50.0), rng.between(-0.25, 0.25));
        for x in x0 as u32..((x0 + w) as u32).min(size.0) {
            let shift = (x as f32 - x0) * slope;
            for y in (top + shift).max(0.0) as u32..((low - shift) as u32).min(size.1) {
                let pane = ((x as f32 - x0) % step) / step > 0.5
                    && ((y as f32 - top) % (step * 1.4)) / step > 0.8;
                let k =
                    if pane { 0.45 } else { 1.0 } + 0.1 * clouds.at(x as f32 / 9.0, y as f32 / 9.0);
                picture.put_pixel(x, y, Rgb(tint.map(|c| (c * k).clamp(0.0, 255.0) as u8)));
            }
        }
    }
    image::imageops::fast_blur(&picture, 1.2)
}

fn map(rng: &mut Rng, size: (u32, u32)) -> RgbImage {
    let mut pixels = Pixmap::new(size.0, size.1).expect("a map has a size");
    pixels.fill(Color::from_rgba8(244, 238, 220, 255));
    let mut paint = Paint::default();
    let (w, h) = (size.0 as f32, size.1 as f32);
    for _ in 0..rng.whole(60, 140) {
        let (x, y, r) = (rng.unit() * w, rng.unit() * h, rng.between(0.015, 0.05) * w);
        let mut builder = PathBuilder::new();
        let corners = rng.whole(4, 7);
        for k in 0..corners {
            let turn = (k as f32 + rng.between(0.0, 0.7)) * std::f32::consts::TAU / corners as f32;
            let p = (x + r * turn.cos(), y + r * turn.sin() * 0.8);
            if k == 0 {
                builder.move_to(p.0, p.1)
            } else {
                builder.line_to(p.0, p.1)
            }
        }
        builder.close();
        let Some(path) = builder.finish() else {
            continue;
        };
        paint.set_color_rgba8(
            rng.whole(200, 240) as u8,
            rng.whole(190, 220) as u8,
            rng.whole(150, 200) as u8,
            255,
        );
        pixels.fill_path(
            &path,
            &paint,
            FillRule::Winding,
            Transform::identity(),
            None,
        );
        paint.set_color_rgba8(70, 60, 55, 255);
        pixels.stroke_path(
            &path,
            &paint,
            &Stroke {
                width: 1.5,
                ..Stroke::default()
            },
            Transform::identity(),
            None,
        );
    }
    for _ in 0..rng.whole(4, 9) {
        let mut builder = PathBuilder::new();
        builder.move_to(rng.unit() * w, 0.0);
        let mut place = || (rng.unit() * w, rng.unit() * h);
        let (p, q, r) = (place(), place(), place());
        builder.cubic_to(p.0, p.1, q.0, q.1, r.0, r.1);
        let Some(path) = builder.finish() else {
            continue;
        };
        for (width, tone) in [(16.0, 80), (12.0, 250)] {
            paint.set_color_rgba8(tone, tone, tone, 255);
            pixels.stroke_path(
                &path,
                &paint,
                &Stroke {
                    width,
                    ..Stroke::default()
                },
                Transform::identity(),
                None,
            );
        }
    }
    let pixels = pixels.pixels();
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let p = pixels[(y * size.0 + x) as usize];
        Rgb([p.red(), p.green(), p.blue()])
    })
}
