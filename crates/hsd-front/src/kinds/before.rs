//! Obstacles before a wall, known by their colours: trees, wires and cars hide several cells, and some of these cells show clearly
//! which pixels are hidden.

use super::Shown;
use crate::cells::{Cell, Likeness, SIDE};

/// Added to colours before they are compared: what is darker is noise.
const DARK: f32 = 0.02;
/// How much the logarithms of two ratios of colours may differ.
const HUE: f32 = 0.22;
/// How much the logarithms of two brightnesses may differ.
const LEVEL: f32 = 0.8;
/// The most colours that are kept.
const MOST: usize = 600;

/// The colours of obstacles before the wall: the logarithms of red and blue over green, and of green.
#[derive(Clone, Debug)]
pub(super) struct Before {
    colours: Vec<[f32; 3]>,
    /// Colours of the wall: where nothing else is known, what is of no such colour stands before it.
    wall: Vec<[f32; 3]>,
}

impl Before {
    /// The colours of what differs in cells for which others stand.
    pub(super) fn of<'p>(
        cells: &[Cell],
        shown: &[Option<Shown>],
        pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
    ) -> Before {
        let mut colours = vec![];
        for (k, cell) in cells.iter().enumerate() {
            let core = shown[k].filter(|s| s.is_replaced).map(|s| s.as_cell);
            if let Some(likeness) = core.and_then(|core| pair(k, core)) {
                // Amid what differs: its border is mixed with the wall, and edges of windows may be off by a sample.
                let amid = (0..SIDE * SIDE).filter(|at| around(*at).all(|n| likeness.off[n]));
                colours.extend(amid.map(|at| colour(cell.tones[at])));
            }
        }
        let clean = cells.iter().zip(shown);
        let clean = clean.filter(|(_, s)| s.is_some_and(|s| !s.is_replaced));
        let wall = clean.flat_map(|(cell, _)| cell.tones.iter().map(|t| colour(*t)));
        Before {
            colours: sampled(colours),
            wall: sampled(wall.collect()),
        }
    }

    /// Whether anything stands before the wall.
    pub(super) fn is_known(&self) -> bool {
        !self.colours.is_empty()
    }

    fn is_of_it(&self, tone: [f32; 3]) -> bool {
        let own = colour(tone);
        let near = |c: &[f32; 3]| {
            let off = [0, 1, 2].map(|k| (c[k] - own[k]).abs());
            off[0] < HUE && off[1] < HUE && off[2] < LEVEL
        };
        match self.is_known() {
            true => self.colours.iter().any(near),
            false => !self.wall.iter().any(near),
        }
    }

    /// The part of a cell, 0 to 1, that differs from another and has none of these colours, nor has anything beside it.
    pub(super) fn untold(&self, cell: &Cell, likeness: &Likeness) -> f64 {
        let told: Vec<bool> = (cell.tones.iter().zip(&likeness.off))
            .map(|(tone, off)| *off && self.is_of_it(*tone))
            .collect();
        let untold = |k: &usize| likeness.off[*k] && !around(*k).any(|n| told[n]);
        (0..SIDE * SIDE).filter(untold).count() as f64 / (SIDE * SIDE) as f64
    }
}

fn sampled(colours: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
    let step = colours.len().div_ceil(MOST).max(1);
    colours.into_iter().step_by(step).collect()
}

fn colour([red, green, blue]: [f32; 3]) -> [f32; 3] {
    let log = |c: f32| libm::logf(c + DARK);
    [log(red) - log(green), log(blue) - log(green), log(green)]
}

/// A sample and those beside it.
fn around(k: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (k % SIDE, k / SIDE);
    let reach = |t: usize| t.saturating_sub(1)..=(t + 1).min(SIDE - 1);
    reach(y).flat_map(move |ny| reach(x).map(move |nx| ny * SIDE + nx))
}
