//! Drawings as images. Texts must have become outlines before, as [`letters`](crate::letters) makes them.

use crate::paper::{Mark, Shape, Sheet};
use glam::DVec2;
use image::RgbImage;
use tiny_skia::{FillRule, LineCap, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// The maximum number of pixels of an image.
const MOST_PIXELS: f64 = 100e6;

/// Returns a sheet as an image of so many pixels to an inch; none if it would have more than a hundred million pixels.
pub fn image(sheet: &Sheet, inch: f64) -> Option<RgbImage> {
    let scale = inch / 25.4;
    let size = (sheet.size * scale).round().max(DVec2::ONE);
    if size.x * size.y > MOST_PIXELS {
        return None;
    }
    let (width, height) = (size.x as u32, size.y as u32);
    let mut pixels = Pixmap::new(width, height)?;
    pixels.fill(tiny_skia::Color::WHITE);
    let place = |p: &DVec2| {
        let at = DVec2::new(p.x, sheet.size.y - p.y) * scale;
        (at.x as f32, at.y as f32)
    };
    for mark in sheet.views.iter().flat_map(|v| &v.marks) {
        draw(mark, &place, scale, &mut pixels);
    }
    let rgb: Vec<u8> = pixels
        .data()
        .chunks_exact(4)
        .flat_map(|p| [p[0], p[1], p[2]])
        .collect();
    RgbImage::from_raw(width, height, rgb)
}

fn draw(mark: &Mark, place: &dyn Fn(&DVec2) -> (f32, f32), scale: f64, pixels: &mut Pixmap) {
    let mut path = PathBuilder::new();
    let mut line = |points: &[DVec2], closed: bool| {
        for (k, p) in points.iter().enumerate() {
            let (x, y) = place(p);
            match k {
                0 => path.move_to(x, y),
                _ => path.line_to(x, y),
            }
        }
        if closed {
            path.close();
        }
    };
    match &mark.shape {
        Shape::Lines(lines) => {
            let seen = lines.iter().filter(|[p, q]| p != q);
            seen.for_each(|l| line(l, false));
        }
        Shape::Area(rings) | Shape::Letters(rings) => rings.iter().for_each(|r| line(r, true)),
        Shape::Label(_) => return,
    }
    let Some(path) = path.finish() else {
        return;
    };
    let mut paint = Paint::default();
    let fill = match mark.shape {
        Shape::Area(_) => Some((mark.role.fill(), FillRule::Winding)),
        Shape::Letters(_) => Some((0.0, FillRule::EvenOdd)),
        _ => None,
    };
    if let Some((grey, rule)) = fill {
        let byte = (grey * 255.0).round() as u8;
        paint.set_color_rgba8(byte, byte, byte, 255);
        pixels.fill_path(&path, &paint, rule, Transform::identity(), None);
    }
    if matches!(mark.shape, Shape::Letters(_)) {
        return;
    }
    paint.set_color_rgba8(0, 0, 0, 255);
    let dashes: Vec<f32> = mark
        .role
        .dashes()
        .iter()
        .map(|d| (d * scale) as f32)
        .collect();
    let stroke = Stroke {
        width: (mark.role.pen() * scale) as f32,
        line_cap: LineCap::Round,
        dash: StrokeDash::new(dashes, 0.0),
        ..Stroke::default()
    };
    pixels.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
}
