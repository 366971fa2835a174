//! Images of a plan that was read wall by wall.

use super::writing::Drawn;
use super::{Found, Reading, Stuff};
use crate::plan::flatten::{Flat, warp};
use crate::plan::marks;
use glam::{DMat3, DVec2, dvec2};
use image::{Rgb, RgbImage};

/// The most pixels of the longer side of the image under the plan.
const LONGEST: f64 = 2400.0;
/// The colours of walls of the outline and of others, and of ink that no wall explains.
const OUTER: [u8; 3] = [200, 0, 120];
const INNER: [u8; 3] = [0, 110, 200];
const UNEXPLAINED: [u8; 3] = [255, 150, 0];

/// Returns the sheet for `hsd view`, and what takes its pixels to metres in the frame of the house.
pub fn underlay(found: &Found, drawn: &Drawn) -> (RgbImage, [f64; 6]) {
    let (width, height) = found.flat.sheet.dimensions();
    let shrink = (LONGEST / f64::from(width.max(height))).min(1.0);
    let size = [width, height].map(|s| (f64::from(s) * shrink).round().max(1.0) as u32);
    let to_sheet = DMat3::from_scale(DVec2::splat(1.0 / shrink));
    let picture = warp(&found.flat.sheet, to_sheet, (size[0], size[1]));
    let metres = found.scale.metres;
    let s = metres / shrink;
    let origin = drawn.origin * metres;
    (picture, [-s, 0.0, 0.0, -s, origin.x, origin.y])
}

/// Returns the sheet, pale, with the walls that were found on it, ink of walls that none of them explains, and rings round doubts.
pub fn review(flat: &Flat, reading: &Reading, doubts: &[DVec2]) -> RgbImage {
    let mut out = marks::pale(&flat.sheet);
    let divided = &reading.divided;
    let graph = &reading.graph;
    for (x, y, pixel) in out.enumerate_pixels_mut() {
        let place = (x as usize, y as usize);
        let is_wall = f64::from(divided.strokes.thickness[place]) >= divided.strokes.wall;
        if is_wall && divided.strokes.wall > 0.0 && divided.stuff[place] == Stuff::Free {
            *pixel = Rgb(UNEXPLAINED);
        }
    }
    for line in &graph.lines {
        let [a, b] = line.ends.map(|k| graph.corners[k]);
        let colour = if line.rooms.contains(&0) {
            OUTER
        } else {
            INNER
        };
        marks::line(&mut out, a, b, colour, 1);
    }
    for at in doubts {
        marks::ring(&mut out, *at, divided.strokes.usual.max(4.0) * 1.5);
    }
    out
}

/// Returns images of what each step found, with the names of their files.
pub fn steps(flat: &Flat, reading: &Reading) -> Vec<(&'static str, RgbImage)> {
    let divided = &reading.divided;
    let strokes = &divided.strokes.thickness;
    let size = (strokes.width as u32, strokes.height as u32);
    let drawn = |colour: &dyn Fn((usize, usize)) -> [u8; 3]| {
        RgbImage::from_fn(size.0, size.1, |x, y| Rgb(colour((x as usize, y as usize))))
    };
    let thick = drawn(&|p| match f64::from(strokes[p]) {
        0.0 => [255; 3],
        t if t >= divided.strokes.wall => [0; 3],
        _ => [255, 150, 150],
    });
    let stuff = drawn(&|p| match divided.stuff[p] {
        Stuff::Free => [255; 3],
        Stuff::Wall => [0; 3],
        Stuff::Tinted => [0, 160, 200],
        Stuff::Thin => [0, 160, 0],
        Stuff::Gap => [230, 0, 0],
        Stuff::Chord => [0, 0, 230],
    });
    let rooms = drawn(&|p| match divided.faces.of[p] {
        0 => [255; 3],
        room => [131, 57, 211].map(|k| (120 + room * 97 % 255 * k % 135) as u8),
    });
    vec![
        ("1-flat.png", flat.sheet.clone()),
        ("2-strokes.png", thick),
        ("3-walls.png", stuff),
        ("4-rooms.png", rooms),
        ("5-house.png", review(flat, reading, &[])),
    ]
}

impl Found {
    /// Returns the pixel of the original image at a pixel of the sheet.
    pub fn in_picture(&self, at: DVec2) -> DVec2 {
        crate::plan::raster::project(self.flat.to_picture, at)
    }

    /// Returns the width and depth of a house, metres.
    pub fn size(&self, drawn: &Drawn) -> DVec2 {
        let first = drawn.outline.first().copied().unwrap_or_default();
        let bounds = drawn
            .outline
            .iter()
            .fold((first, first), |(a, b), p| (a.min(*p), b.max(*p)));
        let size = (bounds.1 - bounds.0) * self.scale.metres;
        dvec2(size.x, size.y)
    }
}
