//! A drawing whose layers say nothing, as a clean picture for the reader of pictures.

use super::fit::sides;
use super::lines::{Lines, Stroke};
use crate::plan::Picture;
use glam::{DMat3, DVec2};
use image::{Rgb, RgbImage};
use tiny_skia::{Color, FillRule, LineCap, Paint, PathBuilder, Pixmap, Transform};

/// The longer side of the picture, pixels.
const LONGEST: f64 = 2400.0;
/// White round the drawing, pixels.
const MARGIN: f64 = 60.0;
/// The thinnest pen, pixels.
const PEN: f64 = 1.6;
/// Places that are far from the others are left out: what lies beyond so many times the extent of most.
const BEYOND: f64 = 2.0;

/// A drawing that was painted.
#[derive(Clone, Debug)]
pub struct Painted {
    /// The picture.
    pub picture: Picture,
    /// Takes its pixels to places of the drawing.
    pub to_drawing: DMat3,
}

/// Draws all strokes but texts on white; none if there is nothing to draw.
pub fn paint(lines: &Lines) -> Option<Painted> {
    let drawn: Vec<&Stroke> = lines
        .strokes
        .iter()
        .filter(|s| !s.is_text && s.points.len() > 1)
        .collect();
    let (low, high) = bounds(&drawn)?;
    let size = high - low;
    let scale = (LONGEST - 2.0 * MARGIN) / size.max_element();
    let pixels = |length: f64| (length * scale + 2.0 * MARGIN).ceil() as u32;
    let mut map = Pixmap::new(pixels(size.x).max(1), pixels(size.y).max(1))?;
    map.fill(Color::WHITE);
    let at = |p: DVec2| (p - low) * scale + MARGIN;
    for stroke in drawn {
        let is_near = |p: &DVec2| at(*p).abs().max_element() < LONGEST * 4.0;
        if stroke.points.iter().all(is_near) {
            // CAD programs show layers in colours for a dark screen.
            let colour = if lines.is_model {
                [0; 3]
            } else {
                stroke.colour
            };
            draw((stroke, colour), &at, scale, &mut map);
        }
    }
    let pixels = RgbImage::from_fn(map.width(), map.height(), |x, y| {
        map.pixel(x, y)
            .map_or(Rgb([255; 3]), |p| Rgb([p.red(), p.green(), p.blue()]))
    });
    let to_drawing = DMat3::from_translation(low)
        * DMat3::from_scale(DVec2::splat(1.0 / scale))
        * DMat3::from_translation(DVec2::splat(-MARGIN));
    Some(Painted {
        picture: Picture {
            pixels,
            shrink: 1.0,
        },
        to_drawing,
    })
}

fn draw(
    (stroke, [r, g, b]): (&Stroke, [u8; 3]),
    at: &dyn Fn(DVec2) -> DVec2,
    scale: f64,
    map: &mut Pixmap,
) {
    let mut path = PathBuilder::new();
    for (k, p) in stroke.points.iter().map(|p| at(*p)).enumerate() {
        if k == 0 {
            path.move_to(p.x as f32, p.y as f32)
        } else {
            path.line_to(p.x as f32, p.y as f32)
        }
    }
    if stroke.is_closed {
        path.close();
    }
    let Some(path) = path.finish() else { return };
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    if let Some([r, g, b]) = stroke.fill {
        paint.set_color_rgba8(r, g, b, 255);
        map.fill_path(
            &path,
            &paint,
            FillRule::EvenOdd,
            Transform::identity(),
            None,
        );
    }
    if stroke.fill.is_none() || stroke.width > 0.0 {
        paint.set_color_rgba8(r, g, b, 255);
        let pen = tiny_skia::Stroke {
            width: (stroke.width * scale).clamp(PEN, LONGEST) as f32,
            line_cap: LineCap::Butt,
            ..tiny_skia::Stroke::default()
        };
        map.stroke_path(&path, &paint, &pen, Transform::identity(), None);
    }
}

/// The rectangle round what is drawn, without what lies far from most of it.
fn bounds(strokes: &[&Stroke]) -> Option<(DVec2, DVec2)> {
    let mut limits = [DVec2::ZERO; 2];
    for axis in 0..2 {
        let mut all: Vec<f64> = strokes
            .iter()
            .flat_map(|s| sides(s).map(|[p, _]| p[axis]))
            .collect();
        all.sort_by(f64::total_cmp);
        let part = |share: f64| {
            all.get((all.len().saturating_sub(1) as f64 * share).round() as usize)
                .copied()
        };
        let (low, high) = (part(0.02)?, part(0.98)?);
        let room = (high - low) * BEYOND;
        let within: Vec<f64> = all
            .into_iter()
            .filter(|v| *v >= low - room && *v <= high + room)
            .collect();
        limits[0][axis] = *within.first()?;
        limits[1][axis] = *within.last()?;
    }
    let [low, high] = limits;
    ((high - low).max_element() > 0.0).then_some((low, high))
}
