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

/// The most straight walls. A sheet with more is not searched, so that time stays bounded.
const MOST_WALLS: usize = 4_000;

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
        let is_searched = all.iter().map(Vec::len).sum::<usize>() <= MOST_WALLS;
        // A corner beyond a window may have another window on its other side.
        while let Some(beyond) = all
            .iter()
            .filter(|_| is_searched)
            .find_map(|bars| in_line(bars, &bounds, OPENING * drawn))
        {
            let part = extents[parts.at(middle(beyond))];
            bounds = bounds.with(extent(beyond)).with(part);
        }
    }
    let within = |k: usize, [a, b]: [usize; 2]| (a..=b).contains(&k);
    Field::new(walls.width, walls.height, |x, y| {
        walls[(x, y)] && within(x, bounds.x) && within(y, bounds.y)
    })
}

/// Returns the pixel in the middle of a wall.
fn middle(bar: &Bar) -> (usize, usize) {
    let Extent { x, y, .. } = extent(bar);
    (x[0].midpoint(x[1]), y[0].midpoint(y[1]))
}

/// Returns the box of a wall.
fn extent(bar: &Bar) -> Extent {
    let [x, y] = if bar.upright {
        [bar.across, bar.along]
    } else {
        [bar.along, bar.across]
    };
    let area = bar.thickness() * bar.length() as usize;
    Extent { x, y, area }
}

/// Returns true if a wall is within bounds.
fn is_within(bar: &Bar, bounds: &Extent) -> bool {
    let Extent { x, y, .. } = extent(bar);
    let within = |[a, b]: [usize; 2], [low, high]: [usize; 2]| low <= a && b <= high;
    within(x, bounds.x) && within(y, bounds.y)
}

/// Finds a wall beyond some bounds that continues one within them after an opening. All `bars` have one direction.
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
