//! The bounds of a plan on its sheet: those of the large walls, and of small ones in line with them.

use super::bars::{Bar, bars};
use super::field::Field;
use super::mask::Strokes;
use crate::plan::raster::Extent;

/// The least diagonal of a large wall, as a share of that of all ink.
const LARGE: f64 = 0.12;
/// The widest opening between a wall and a small one in line with it, as a share of the same diagonal.
const OPENING: f64 = 0.14;
/// The least share of the thickness of a wall that another in line with it has.
const ALIKE: f64 = 0.6;

/// Keeps the walls of a plan. Small ones beyond its bounds are dimensions and legends. `drawn` is the diagonal of all ink.
pub(super) fn of_plan(strokes: &Strokes, drawn: f64) -> Field<bool> {
    let walls = strokes.walls();
    let parts = walls.parts(true);
    let extents = parts.extents();
    let large = extents.iter().filter(|e| e.area > 0);
    let large = large.filter(|e| e.diagonal() >= LARGE * drawn).copied();
    let Some(mut bounds) = large.reduce(Extent::with) else {
        return walls;
    };
    // With one pen, dimensions are as thick as walls.
    if !strokes.has_one_pen() {
        let all = [false, true].map(|upright| bars(&walls, strokes.usual, upright));
        // A corner beyond a window may have another window on its other side.
        while let Some(next) = all.iter().find_map(|bars| {
            let beyond = in_line(bars, &bounds, OPENING * drawn)?;
            let [x, y] = place(beyond);
            Some(extents[parts.at((x, y))])
        }) {
            bounds = bounds.with(next);
        }
    }
    let within = |k: usize, [a, b]: [usize; 2]| (a..=b).contains(&k);
    Field::new(walls.width, walls.height, |x, y| {
        walls[(x, y)] && within(x, bounds.x) && within(y, bounds.y)
    })
}

/// Returns a pixel in the middle of a wall.
fn place(bar: &Bar) -> [usize; 2] {
    let [along, across] = [bar.along, bar.across].map(|[a, b]| (a + b) / 2);
    if bar.upright {
        [across, along]
    } else {
        [along, across]
    }
}

/// Returns true if a wall lies within bounds.
fn is_within(bar: &Bar, bounds: &Extent) -> bool {
    let [along, across] = match bar.upright {
        true => [bounds.y, bounds.x],
        false => [bounds.x, bounds.y],
    };
    let within = |[a, b]: [usize; 2], [low, high]: [usize; 2]| low <= a && b <= high;
    within(bar.along, along) && within(bar.across, across)
}

/// Returns a wall beyond some bounds, of all walls of one direction, that continues one within them after an opening.
fn in_line<'a>(bars: &'a [Bar], bounds: &Extent, reach: f64) -> Option<&'a Bar> {
    let (inside, beyond): (Vec<&Bar>, Vec<&Bar>) =
        bars.iter().partition(|bar| is_within(bar, bounds));
    beyond.into_iter().find(|bar| {
        inside.iter().any(|wall| {
            let shared = bar.across[1].min(wall.across[1]) + 1;
            let shared = shared.saturating_sub(bar.across[0].max(wall.across[0])) as f64;
            let thick = bar.thickness().max(wall.thickness()) as f64;
            let between = bar.along[0].saturating_sub(wall.along[1]);
            let between = between.max(wall.along[0].saturating_sub(bar.along[1]));
            shared >= ALIKE * thick && between > 0 && between as f64 <= reach
        })
    })
}
