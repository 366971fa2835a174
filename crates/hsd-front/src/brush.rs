//! Masks painted by hand: strokes of a brush and of an eraser over a photograph.

use glam::{DVec2, dvec2};
use image::{GrayImage, Luma};
use serde::{Deserialize, Serialize};

/// A stroke, in pixels of the photograph.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Whether it takes away what was painted before.
    pub erases: bool,
    /// The width of the brush.
    pub width: f64,
    /// Where it was led along; one place makes a dot.
    pub points: Vec<[f64; 2]>,
}

/// What strokes cover, white, in a photograph that is shown so many times as large.
pub fn painted((width, height): (u32, u32), strokes: &[Stroke], scale: f64) -> GrayImage {
    let mut mask = GrayImage::new(width, height);
    for stroke in strokes {
        let tone = Luma([if stroke.erases { 0 } else { 255 }]);
        let half = (stroke.width * scale / 2.0).max(0.5);
        let at = |p: &[f64; 2]| dvec2(p[0], p[1]) * scale;
        let points: Vec<DVec2> = stroke.points.iter().map(at).collect();
        match points[..] {
            [dot] => draw(&mut mask, dot, dot, half, tone),
            _ => points
                .windows(2)
                .for_each(|line| draw(&mut mask, line[0], line[1], half, tone)),
        }
    }
    mask
}

/// Draws a line with round ends.
fn draw(mask: &mut GrayImage, a: DVec2, b: DVec2, half: f64, tone: Luma<u8>) {
    let pixel = |t: f64, n: u32| t.clamp(0.0, f64::from(n)) as u32;
    let (least, most) = (a.min(b) - half, a.max(b) + half);
    let along = b - a;
    let long = along.length_squared();
    for y in pixel(least.y, mask.height())..pixel(most.y + 1.0, mask.height()) {
        for x in pixel(least.x, mask.width())..pixel(most.x + 1.0, mask.width()) {
            let at = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let part = match long > 0.0 {
                true => ((at - a).dot(along) / long).clamp(0.0, 1.0),
                false => 0.0,
            };
            if at.distance_squared(a + along * part) <= half * half {
                mask.put_pixel(x, y, tone);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stroke(erases: bool, width: f64, points: &[[f64; 2]]) -> Stroke {
        Stroke {
            erases,
            width,
            points: points.to_vec(),
        }
    }

    #[test]
    fn a_brush_paints_and_an_eraser_takes_away() {
        let line = stroke(false, 4.0, &[[2.0, 5.0], [18.0, 5.0]]);
        let dot = stroke(true, 2.0, &[[10.0, 5.0]]);
        let mask = painted((20, 10), &[line.clone(), dot], 1.0);
        let white = mask.pixels().filter(|p| p[0] == 255).count();
        // 16 by 4, two half discs, less a dot of four pixels.
        assert!((64..=76).contains(&white), "{white}");
        assert_eq!(mask.get_pixel(10, 5)[0], 0);
        assert_eq!(mask.get_pixel(5, 5)[0], 255);
        // The same over a photograph half as large, and one that lies beyond it.
        let small = painted((10, 5), &[line], 0.5);
        assert_eq!(small.get_pixel(2, 2)[0], 255);
        assert_eq!(small.get_pixel(2, 0)[0], 0);
        let beyond = stroke(false, 4.0, &[[-50.0, f64::NAN], [900.0, -3.0]]);
        painted((20, 10), &[beyond, stroke(false, 4.0, &[])], 1.0);
    }
}
