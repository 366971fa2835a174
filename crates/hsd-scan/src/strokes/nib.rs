//! What a sheet is drawn with: how wide its thinnest strokes are, and how blurred.

use super::super::grid::Grid;
use super::super::sheet::Ink;

/// What counts as full ink, in the share of the darkest.
const FULL: f64 = 0.995;
/// Of the edges of strokes, the share that is less sharp than those of broad strokes.
const SHARP: f64 = 0.8;

/// A width and a blur, units.
#[derive(Clone, Copy, Debug)]
pub struct Nib {
    /// About the width of the thinnest strokes.
    pub width: f64,
    /// How far ink is spread about where it belongs (the spread of a bell curve).
    pub blur: f64,
}

impl Nib {
    /// What follows from a sheet alone, before anything on it is known.
    pub fn of(ink: &Ink, grid: &Grid) -> Nib {
        let blur = blur(ink) / grid.unit;
        let width = thinnest(ink, grid.unit) / grid.unit;
        Nib {
            width: width.clamp(0.02, 0.12),
            blur: blur.min(0.08),
        }
    }

    /// The same, wider.
    pub(super) fn wider(self, factor: f64) -> Nib {
        Nib {
            width: self.width * factor,
            ..self
        }
    }
}

/// The most frequent length of ink across the sheet, small ones, pixels.
fn thinnest(ink: &Ink, unit: f64) -> f64 {
    let most = (unit * 0.5) as usize;
    let mut counts = vec![0_u32; most.max(3) + 1];
    for y in (0..ink.dark.height()).step_by(2) {
        let mut run = 0;
        for x in 0..ink.dark.width() {
            if ink.is(x, y) {
                run += 1;
            } else {
                if run > 0 && run < counts.len() {
                    counts[run] += 1;
                }
                run = 0;
            }
        }
    }
    let most = counts.iter().copied().max().unwrap_or(0);
    let common = (1..counts.len()).find(|k| counts[*k] * 4 >= most);
    common.unwrap_or(1) as f64
}

/// How far ink is spread, pixels: the steepest edges of a blurred sheet are no cliffs.
fn blur(ink: &Ink) -> f64 {
    let (width, height) = ink.dark.dimensions();
    let mut steps = [0_u32; 256];
    let mut tones = [0_u32; 256];
    for y in (0..height).step_by(2) {
        for x in 1..width.saturating_sub(2) {
            if ink.is(x, y) != ink.is(x + 1, y) {
                let tone = |x: u32| i32::from(ink.dark.get_pixel(x, y)[0]);
                steps[(tone(x + 1) - tone(x)).unsigned_abs() as usize] += 1;
            }
            if ink.is(x, y) {
                tones[usize::from(ink.dark.get_pixel(x, y)[0])] += 1;
            }
        }
    }
    let full = quantile(&tones, FULL);
    let steepest = quantile(&steps, SHARP).max(1.0);
    // A cliff of full ink has its step within a pixel; a bell curve rises by 0.4 of its height within its spread.
    (0.3 * full / steepest - 0.3).max(0.0)
}

/// The tone below or at which the given share of the pixels lies; `counts` has the number of pixels of each tone.
pub(super) fn quantile(counts: &[u32], share: f64) -> f64 {
    let stop = f64::from(counts.iter().sum::<u32>()) * share;
    let mut below = 0.0;
    let at = counts.iter().position(|n| {
        below += f64::from(*n);
        below >= stop
    });
    at.unwrap_or(0) as f64
}
