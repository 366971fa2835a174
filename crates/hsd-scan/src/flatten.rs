//! A picture of a sheet made flat: the perspective of a photograph and the skew of a scan taken away.

use glam::{DMat3, DVec2, dvec2};
use image::imageops::{self, FilterType};
use image::{GrayImage, Rgb, RgbImage};

pub use super::raster::project;
use super::raster::{self, Parts, otsu_level};
use super::sheet::Ink;

/// The longer side of the pictures in which sheets and angles are looked for, pixels.
const SMALL: u32 = 900;
/// The largest skew that is looked for, degrees.
const SKEW: f64 = 7.0;

/// A flat sheet, and where each of its points was in the picture.
#[derive(Clone, Debug)]
pub struct Flat {
    /// The sheet.
    pub sheet: RgbImage,
    /// Takes pixels of the sheet to pixels of the picture.
    pub to_picture: DMat3,
    /// The corners of the sheet in the picture, clockwise from the upper left, where it lies on something darker.
    pub corners: Option<[DVec2; 4]>,
    /// The skew that was taken away, degrees, clockwise in the picture.
    pub skew: f64,
    /// Boxes of the plans on the sheet if there are several, pixels of the sheet. After a crop they may lie beyond its edges.
    pub plans: Vec<Region>,
}

/// A box: its upper left and lower right corner.
pub type Region = [DVec2; 2];

impl Flat {
    /// Returns the box of the image that a box of the sheet covers.
    pub fn in_picture(&self, region: Region) -> Region {
        mapped(region, self.to_picture)
    }

    /// Returns the box of the sheet that a box of the image covers.
    pub fn on_sheet(&self, region: Region) -> Region {
        mapped(region, self.to_picture.inverse())
    }

    /// Crops the sheet to a box of it. Returns the first column and row that remain, the width and the height; `None` if nothing
    /// would remain.
    pub fn crop(&mut self, region: Region) -> Option<[u32; 4]> {
        let size = dvec2(self.sheet.width().into(), self.sheet.height().into());
        let [a, b] = region.map(|p| p.round().clamp(DVec2::ZERO, size));
        if (b - a).min_element() < 1.0 {
            return None;
        }
        let kept = [a.x, a.y, b.x - a.x, b.y - a.y].map(|k| k as u32);
        let [x, y, width, height] = kept;
        self.sheet = imageops::crop_imm(&self.sheet, x, y, width, height).to_image();
        self.to_picture *= DMat3::from_translation(a);
        self.plans.iter_mut().flatten().for_each(|p| *p -= a);
        Some(kept)
    }
}

/// Returns a box seen through a map: through the middles of its mapped sides, so that a small turn there and back leaves its size.
fn mapped([a, b]: Region, map: DMat3) -> Region {
    let middle = a.midpoint(b);
    let sides = [
        dvec2(a.x, middle.y),
        dvec2(b.x, middle.y),
        dvec2(middle.x, a.y),
        dvec2(middle.x, b.y),
    ];
    let sides = sides.map(|p| project(map, p));
    let fold = |of: fn(DVec2, DVec2) -> DVec2| sides.into_iter().reduce(of).unwrap_or_default();
    [fold(DVec2::min), fold(DVec2::max)]
}

/// What is known of how a picture was taken.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// The corners of the sheet or of any rectangle on it, clockwise from the upper left, pixels.
    pub corners: Option<[DVec2; 4]>,
    /// The skew, degrees clockwise.
    pub turn: Option<f64>,
}

/// Makes a picture flat.
pub fn flatten(picture: &RgbImage, given: &Given) -> Flat {
    let corners = given.corners.or_else(|| sheet_corners(picture));
    let (size, to_picture) = match corners {
        Some(corners) => from_corners(corners),
        None => ((picture.width(), picture.height()), DMat3::IDENTITY),
    };
    let shrink = f64::from(SMALL) / f64::from(size.0.max(size.1)).max(f64::from(SMALL));
    let small = (
        (f64::from(size.0) * shrink).round() as u32,
        (f64::from(size.1) * shrink).round() as u32,
    );
    let rough = warp(
        picture,
        to_picture * DMat3::from_scale(DVec2::splat(1.0 / shrink)),
        small,
    );
    let skew = given.turn.unwrap_or_else(|| skew(&rough));
    let to_picture = to_picture * turned(size, skew);
    Flat {
        sheet: warp(picture, to_picture, size),
        to_picture,
        corners,
        skew,
        plans: vec![],
    }
}

/// The picture as seen through a map from its result's pixels to its own.
pub fn warp(picture: &RgbImage, map: DMat3, (width, height): (u32, u32)) -> RgbImage {
    let (width, height) = (width.max(1), height.max(1));
    if map == DMat3::IDENTITY {
        let mut out = RgbImage::new(width, height);
        imageops::replace(&mut out, picture, 0, 0);
        return out;
    }
    raster::warp(picture, map, (width, height), edge_tone(picture))
}

/// The middle tone of a picture's edges: what lies beyond them.
fn edge_tone(picture: &RgbImage) -> Rgb<u8> {
    let (width, height) = picture.dimensions();
    let along = (0..width).flat_map(|x| [(x, 0), (x, height - 1)]);
    let edge: Vec<[u8; 3]> = along
        .chain((0..height).flat_map(|y| [(0, y), (width - 1, y)]))
        .map(|(x, y)| picture.get_pixel(x, y).0)
        .collect();
    Rgb(std::array::from_fn(|c| {
        let mut tones: Vec<u8> = edge.iter().map(|p| p[c]).collect();
        let half = tones.len() / 2;
        *tones.select_nth_unstable(half).1
    }))
}

/// The map from a turned sheet to the sheet as it is: about its middle.
fn turned((width, height): (u32, u32), degrees: f64) -> DMat3 {
    let middle = dvec2(f64::from(width), f64::from(height)) / 2.0;
    DMat3::from_translation(middle)
        * DMat3::from_angle(degrees.to_radians())
        * DMat3::from_translation(-middle)
}

/// The size of a flat sheet with these corners, and the map to the picture.
fn from_corners([a, b, c, d]: [DVec2; 4]) -> ((u32, u32), DMat3) {
    let width = (a.distance(b) + c.distance(d)) / 2.0;
    let height = (b.distance(c) + d.distance(a)) / 2.0;
    let flat = [
        DVec2::ZERO,
        dvec2(width, 0.0),
        dvec2(width, height),
        dvec2(0.0, height),
    ];
    let size = (width.round() as u32, height.round() as u32);
    (size, homography(flat, [a, b, c, d]))
}

/// The projective map that takes four points to four others.
pub fn homography(from: [DVec2; 4], to: [DVec2; 4]) -> DMat3 {
    basis(to) * basis(from).inverse()
}

/// The map from the projective frame (1,0,0), (0,1,0), (0,0,1), (1,1,1) to four points.
fn basis([a, b, c, d]: [DVec2; 4]) -> DMat3 {
    let m = DMat3::from_cols(a.extend(1.0), b.extend(1.0), c.extend(1.0));
    let s = m.inverse() * d.extend(1.0);
    DMat3::from_cols(m.x_axis * s.x, m.y_axis * s.y, m.z_axis * s.z)
}

/// The corners of a sheet that lies on something darker: clockwise from the upper left.
fn sheet_corners(picture: &RgbImage) -> Option<[DVec2; 4]> {
    let shrink = (f64::from(picture.width().max(picture.height())) / 500.0).max(1.0);
    let size = |s: u32| ((f64::from(s) / shrink).round() as u32).max(1);
    let small = imageops::resize(
        picture,
        size(picture.width()),
        size(picture.height()),
        FilterType::Triangle,
    );
    let grey = imageops::blur(&imageops::grayscale(&small), 2.0);
    let level = otsu_level(&grey);
    let light = GrayImage::from_fn(grey.width(), grey.height(), |x, y| {
        image::Luma([if grey.get_pixel(x, y)[0] > level {
            255
        } else {
            0
        }])
    });
    if !dark_round(&light) {
        return None;
    }
    let parts = Parts::of(&light, false);
    let points = largest(&parts)?;
    // Paper on a table, not a light spot in a dark picture.
    let area = f64::from(light.width()) * f64::from(light.height());
    let quad = sides(&points)?;
    let covered = points.iter().filter(|&&p| inside(quad, p)).count() as f64;
    let size = quad_area(quad);
    if size < 0.2 * area || covered < 0.7 * size || covered < 0.9 * points.len() as f64 {
        return None;
    }
    let scale = dvec2(
        f64::from(picture.width()) / f64::from(light.width()),
        f64::from(picture.height()) / f64::from(light.height()),
    );
    Some(quad.map(|p| (p + DVec2::splat(0.5)) * scale))
}

/// Whether most of a picture's edge is dark.
fn dark_round(light: &GrayImage) -> bool {
    let (width, height) = light.dimensions();
    let edge = (0..width)
        .flat_map(|x| [(x, 0), (x, height - 1)])
        .chain((0..height).flat_map(|y| [(0, y), (width - 1, y)]));
    let (mut dark, mut all) = (0, 0);
    for (x, y) in edge {
        all += 1;
        dark += usize::from(light.get_pixel(x, y)[0] == 0);
    }
    dark * 10 > all * 7
}

/// The pixels of the largest part.
fn largest(parts: &Parts) -> Option<Vec<DVec2>> {
    let mut sizes = vec![0_usize; parts.count];
    for (_, _, part) in parts.pixels() {
        sizes[part as usize - 1] += 1;
    }
    let (most, _) = sizes.iter().enumerate().max_by_key(|(_, n)| **n)?;
    let pixels = parts.pixels().filter(|p| p.2 as usize == most + 1);
    Some(
        pixels
            .map(|(x, y, _)| dvec2(f64::from(x), f64::from(y)))
            .collect(),
    )
}

/// The four corners of an area with four straight sides: lines through the outermost pixels of each side.
fn sides(points: &[DVec2]) -> Option<[DVec2; 4]> {
    let extreme = |key: fn(DVec2) -> f64| {
        points
            .iter()
            .copied()
            .max_by(|a, b| key(*a).total_cmp(&key(*b)))
    };
    let rough = [
        extreme(|p| -p.x - p.y)?,
        extreme(|p| p.x - p.y)?,
        extreme(|p| p.x + p.y)?,
        extreme(|p| p.y - p.x)?,
    ];
    let mut lines = Vec::new();
    for k in 0..4 {
        let (a, b) = (rough[k], rough[(k + 1) % 4]);
        lines.push(side(points, a, b)?);
    }
    let corner = |k: usize| meet(lines[(k + 3) % 4], lines[k]);
    Some([corner(0)?, corner(1)?, corner(2)?, corner(3)?])
}

/// A line as a point and a direction.
type Line = (DVec2, DVec2);

/// The line along the outermost pixels between two corners, clockwise.
fn side(points: &[DVec2], a: DVec2, b: DVec2) -> Option<Line> {
    let along = (b - a).try_normalize()?;
    let length = a.distance(b);
    let out = dvec2(along.y, -along.x);
    let mut edge = vec![f64::NEG_INFINITY; length.ceil() as usize + 1];
    for p in points {
        let t = (*p - a).dot(along);
        if t >= 0.08 * length && t <= 0.92 * length {
            let slot = &mut edge[t as usize];
            *slot = slot.max((*p - a).dot(out));
        }
    }
    let found: Vec<(f64, f64)> = edge
        .iter()
        .enumerate()
        .filter(|(_, d)| d.is_finite())
        .map(|(t, d)| (t as f64, *d))
        .collect();
    let (slope, offset) = straight(&found)?;
    let from = a + out * (offset + 0.5);
    Some((from, along + out * slope))
}

/// The line through most of some points: by least squares, three times, each time without what lies far off.
fn straight(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = points.to_vec();
    let mut line = (0.0, 0.0);
    for _ in 0..4 {
        let n = kept.len() as f64;
        if n < 4.0 {
            return None;
        }
        let (sx, sy) = kept.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
        let (mx, my) = (sx / n, sy / n);
        let (xx, xy) = kept.iter().fold((0.0, 0.0), |s, p| {
            (s.0 + (p.0 - mx) * (p.0 - mx), s.1 + (p.0 - mx) * (p.1 - my))
        });
        let slope = xy / xx;
        line = (slope, my - slope * mx);
        let off = |p: &(f64, f64)| (p.1 - line.0 * p.0 - line.1).abs();
        let mut offs: Vec<f64> = kept.iter().map(off).collect();
        let half = offs.len() / 2;
        let middle = *offs.select_nth_unstable_by(half, f64::total_cmp).1;
        kept.retain(|p| off(p) <= (2.5 * middle).max(1.0));
    }
    Some(line)
}

/// Where two lines meet.
fn meet((a, d): Line, (b, e): Line) -> Option<DVec2> {
    let cross = d.perp_dot(e);
    (cross.abs() > 1e-9).then(|| a + d * ((b - a).perp_dot(e) / cross))
}

fn inside(quad: [DVec2; 4], p: DVec2) -> bool {
    (0..4).all(|k| (quad[(k + 1) % 4] - quad[k]).perp_dot(p - quad[k]) >= 0.0)
}

fn quad_area(quad: [DVec2; 4]) -> f64 {
    ((quad[2] - quad[0]).perp_dot(quad[3] - quad[1]) / 2.0).abs()
}

/// The angle at which the strokes of a sheet stand upright and level, degrees.
///
/// The sums of ink along lines at the right angle have the sharpest peaks (Postl's method).
fn skew(sheet: &RgbImage) -> f64 {
    let ink = Ink::of(sheet);
    let dots: Vec<DVec2> = ink
        .dark
        .enumerate_pixels()
        .filter(|(x, y, _)| ink.is(*x, *y))
        .map(|(x, y, _)| dvec2(f64::from(x), f64::from(y)))
        .collect();
    let size = f64::from(sheet.width() + sheet.height());
    let sharp = |degrees: f64| {
        let (sin, cos) = (
            libm::sin(degrees.to_radians()),
            libm::cos(degrees.to_radians()),
        );
        let mut level = vec![0_u32; size as usize * 2];
        let mut upright = vec![0_u32; size as usize * 2];
        for d in &dots {
            level[(d.y * cos - d.x * sin + size / 2.0) as usize] += 1;
            upright[(d.x * cos + d.y * sin + size / 2.0) as usize] += 1;
        }
        let peaks = |sums: &[u32]| {
            sums.windows(2)
                .map(|w| f64::from(w[0].abs_diff(w[1])) * f64::from(w[0].abs_diff(w[1])))
                .sum::<f64>()
        };
        peaks(&level) + peaks(&upright)
    };
    let best = |around: f64, reach: f64, step: f64| {
        let steps = (2.0 * reach / step).round() as i32;
        (0..=steps)
            .map(|k| around - reach + f64::from(k) * step)
            .map(|angle| (angle, sharp(angle)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0.0, |(angle, _)| angle)
    };
    let rough = best(0.0, SKEW, 0.25);
    let found = best(rough, 0.25, 0.025);
    // A sheet that is straight stays as sharp as it is.
    if sharp(0.0) >= 0.97 * sharp(found) {
        0.0
    } else {
        found
    }
}
