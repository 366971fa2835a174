//! From strokes to pixels: antialiased ink, then the tone of the paper or of the board.

use super::degrade::Homography;
use super::rng::Rng;
use super::sheet::{Convention, Item, Place, Shape, Sheet, Variant};
use super::truth::Plan;
use super::{itazu, sashizu, survey};
use image::RgbImage;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};

/// A picture and where each place of the truth lies in it.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The picture.
    pub picture: RgbImage,
    /// From (a, b) to pixels; pixel (0, 0) covers 0..1 in x and y.
    pub place: Homography,
}

/// The strokes of a plan.
pub fn strokes(plan: &Plan, convention: Convention, variant: Variant) -> Sheet {
    match convention {
        Convention::Survey => survey::sheet(plan, variant),
        Convention::Sashizu => sashizu::sheet(plan, variant),
        Convention::Itazu => itazu::sheet(plan, variant),
    }
}

/// Draw a plan at so many pixels a unit.
pub fn draw(plan: &Plan, convention: Convention, variant: Variant, px: f32) -> Drawing {
    let sheet = strokes(plan, convention, variant);
    let (w, h) = (
        (sheet.size.0 * px).ceil() as u32,
        (sheet.size.1 * px).ceil() as u32,
    );
    let mut map = Pixmap::new(w, h).expect("a sheet has a size");
    map.fill(Color::WHITE);
    for item in &sheet.items {
        ink(&mut map, item, px);
    }
    let mut picture = RgbImage::new(w, h);
    for (out, pixel) in picture.pixels_mut().zip(map.pixels()) {
        out.0 = [pixel.red(), pixel.green(), pixel.blue()];
    }
    tone(&mut picture, convention, variant, px);
    let (p, s) = (f64::from(px), sheet.origin);
    let place = Homography([
        -p,
        0.0,
        f64::from(s.0) * p,
        0.0,
        -p,
        f64::from(s.1) * p,
        0.0,
        0.0,
        1.0,
    ]);
    Drawing { picture, place }
}

fn ink(map: &mut Pixmap, item: &Item, px: f32) {
    let Some(path) = path(&item.shape) else {
        return;
    };
    let mut paint = Paint::default();
    paint.set_color_rgba8(item.ink[0], item.ink[1], item.ink[2], 255);
    paint.anti_alias = true;
    let scale = Transform::from_scale(px, px);
    if matches!(item.shape, Shape::Fill(_) | Shape::Disc(..)) {
        map.fill_path(&path, &paint, FillRule::Winding, scale, None);
    } else {
        let width = item.width.max(0.9 / px);
        let stroke = Stroke {
            width,
            line_cap: LineCap::Round,
            line_join: LineJoin::Miter,
            ..Stroke::default()
        };
        map.stroke_path(&path, &paint, &stroke, scale, None);
    }
}

fn path(shape: &Shape) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let mut through = |list: &[Place], close: bool| {
        for (k, p) in list.iter().enumerate() {
            if k == 0 {
                builder.move_to(p.0, p.1)
            } else {
                builder.line_to(p.0, p.1)
            }
        }
        if close {
            builder.close();
        }
    };
    match shape {
        Shape::Line(list) => through(list, false),
        Shape::Loop(list) | Shape::Fill(list) => through(list, true),
        Shape::Disc(c, r) | Shape::Ring(c, r) => builder.push_circle(c.0, c.1, *r),
        Shape::Arc(centre, from, to) => through(&arc(*centre, *from, *to), false),
    }
    builder.finish()
}

/// Points of the shorter arc.
pub fn arc(centre: Place, from: Place, to: Place) -> Vec<Place> {
    let turn = |p: Place| (p.1 - centre.1).atan2(p.0 - centre.0);
    let radius = (from.0 - centre.0).hypot(from.1 - centre.1);
    let start = turn(from);
    let mut sweep = turn(to) - start;
    while sweep > std::f32::consts::PI {
        sweep -= std::f32::consts::TAU;
    }
    while sweep < -std::f32::consts::PI {
        sweep += std::f32::consts::TAU;
    }
    (0..=12)
        .map(|k| start + sweep * k as f32 / 12.0)
        .map(|t| (centre.0 + radius * t.cos(), centre.1 + radius * t.sin()))
        .collect()
}

/// Smooth noise in -1..1 from a small table, wide as `cell` pixels.
pub struct Clouds {
    table: Vec<f32>,
}

impl Clouds {
    /// A table by seed.
    pub fn new(rng: &mut Rng) -> Self {
        Self {
            table: (0..64 * 64).map(|_| rng.between(-1.0, 1.0)).collect(),
        }
    }

    /// The value at a place.
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (fx, fy) = (x.floor(), y.floor());
        let (tx, ty) = (x - fx, y - fy);
        let (tx, ty) = (tx * tx * (3.0 - 2.0 * tx), ty * ty * (3.0 - 2.0 * ty));
        let get = |dx: i32, dy: i32| {
            self.table[(((fy as i32 + dy) & 63) * 64 + ((fx as i32 + dx) & 63)) as usize]
        };
        let top = get(0, 0) + (get(1, 0) - get(0, 0)) * tx;
        let low = get(0, 1) + (get(1, 1) - get(0, 1)) * tx;
        top + (low - top) * ty
    }
}

/// A tone by age: all channels go together, blue a little further.
fn aged(base: [f32; 3], spread: f32, rng: &mut Rng) -> [f32; 3] {
    let age = rng.between(-spread, spread);
    [
        base[0] + age * 0.8,
        base[1] + age,
        base[2] + age * 1.4 + rng.between(-5.0, 5.0),
    ]
}

/// Multiply by the tone of what is drawn on: white paper, old paper with folds, a board with its grain.
fn tone(picture: &mut RgbImage, convention: Convention, variant: Variant, px: f32) {
    let mut rng = Rng::new(variant.seed, 21);
    let clouds = Clouds::new(&mut rng);
    let (w, h) = picture.dimensions();
    let mut base = match convention {
        Convention::Survey => [254.0 - rng.between(0.0, 8.0); 3],
        Convention::Sashizu => aged([238.0, 224.0, 192.0], 12.0, &mut rng),
        Convention::Itazu => aged([202.0, 164.0, 120.0], 18.0, &mut rng),
    };
    base.iter_mut().for_each(|c| *c /= 255.0);
    let folds = if convention == Convention::Sashizu {
        (rng.whole(1, 4) as f32, rng.whole(1, 3) as f32)
    } else {
        (0.0, 0.0)
    };
    let rings = rng.between(2.0, 4.0) / px;
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let (fx, fy) = (x as f32, y as f32);
        let shade = match convention {
            Convention::Survey => 1.0,
            Convention::Sashizu => {
                let fold = |t: f32, n: f32, size: f32| {
                    let off = ((t * n).fract() - 0.5).abs() * size / n;
                    if n > 0.0 && off < px * 0.06 {
                        0.12 * (1.0 - off / (px * 0.06))
                    } else {
                        0.0
                    }
                };
                1.0 + 0.04 * clouds.at(fx / px / 2.5, fy / px / 2.5)
                    + 0.025 * clouds.at(fx * 0.45, fy * 0.11)
                    - fold(fx / w as f32, folds.0, w as f32)
                    - fold(fy / h as f32, folds.1, h as f32)
            }
            Convention::Itazu => {
                let bend = clouds.at(fx / px / 5.0, fy / px / 1.6) * 1.6
                    + clouds.at(fx / px / 1.7, fy / px) * 0.15;
                let ring = (fy * rings + bend).fract().abs();
                0.97 - 0.17 * ring * ring + 0.05 * clouds.at(fx * 0.03, fy * 0.6)
            }
        };
        for (value, base) in pixel.0.iter_mut().zip(base) {
            *value = (f32::from(*value) * base * shade).clamp(0.0, 255.0) as u8;
        }
    }
}
