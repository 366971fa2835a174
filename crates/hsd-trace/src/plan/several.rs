//! Separates the plans of one sheet, such as the storeys of a house.

use super::flatten::Region;
use super::raster::{Extent, Parts};
use super::sheet::Ink;
use super::walls;
use glam::{DVec2, dvec2};
use std::cell::Cell;
use std::ops::Range;

/// The least diagonal of a drawn part, as a share of that of all ink: letters are smaller.
const PART: f64 = 0.05;
/// The least space between two plans, as a share of the same diagonal.
const SPACE: f64 = 0.008;
/// The least box of a plan, as a share of that of the largest.
const LEAST: f64 = 0.2;
/// The most plans of a sheet. A sheet with more boxes does not show plans.
const MOST: usize = 12;
/// The most boxes that are read to see if they are plans, so that time stays bounded.
const READINGS: usize = 2 * MOST;
/// The least thickness of the walls of a storey, as a share of that of the largest: tables have thin lines.
const PEN: f64 = 0.5;
/// The greatest ratio of the sides of storeys that count as equal.
const ALIKE: f64 = 1.15;
/// The least share of its box that a plan fills.
const FILLED: f64 = 0.35;
/// The greatest margin round a plan, as a share of its diagonal. Dimensions are within it, titles often are not.
const MARGIN: f64 = 0.15;
/// The distance from a band within which walls line it, as a share of the diagonal, and the least share of its length with strokes.
const LINING: f64 = 0.03;
const LINED: f64 = 0.6;
/// The fewest rooms of a plan.
const FEWEST_ROOMS: usize = 2;
/// The least share of the width and depth of all ink that a frame has. Its line is also thinner than those within, by a share of
/// the mean line of the largest part.
const FRAME: f64 = 0.85;
const FRAME_PEN: f64 = 0.5;

/// Plans of one sheet.
pub(super) struct Several {
    /// The boxes of all, from the upper left.
    pub(super) regions: Vec<Region>,
    /// The box of the largest.
    pub(super) largest: Region,
}

/// Finds separate plans on a sheet; `None` if there are fewer than two.
///
/// A part of the sheet is a plan if it reads as one by itself, with walls about as thick as those of the largest. Storeys of a house
/// often share a side, so a part as wide or as deep as the largest counts too.
pub(super) fn plans(ink: &Ink) -> Option<Several> {
    let parts = parts(ink)?;
    let space = SPACE * bounds(&parts).diagonal();
    let leaves = leaves(&parts, space);
    let least = LEAST * leaves.iter().map(|leaf| area(leaf)).max()? as f64;
    let large = leaves.iter().filter(|leaf| area(leaf) as f64 >= least);
    if !(2..=MOST).contains(&large.count()) {
        return None;
    }
    let search = Search {
        ink,
        space,
        least,
        readings: Cell::new(READINGS),
    };
    let found = search.plans(&parts);
    let largest = *found.iter().max_by_key(|plan| plan.rooms)?;
    let is_storey = |plan: &&Plan| match plan.rooms {
        0 => have_one_side(&plan.drawn, &largest.drawn),
        _ => plan.walls >= PEN * largest.walls,
    };
    let boxes: Vec<Extent> = found.iter().map(|plan| plan.at).collect();
    let region = |plan: &Plan| region(&plan.at, &boxes, ink.dark.dimensions());
    let mut regions: Vec<Region> = found.iter().filter(is_storey).map(region).collect();
    regions.sort_by(|a, b| a[0].y.total_cmp(&b[0].y).then(a[0].x.total_cmp(&b[0].x)));
    (regions.len() > 1).then(|| Several {
        regions,
        largest: region(&largest),
    })
}

/// A plan on a sheet.
#[derive(Clone, Copy)]
struct Plan {
    /// The box round its walls, and that round all that is drawn there.
    at: Extent,
    drawn: Extent,
    /// The area of its rooms, square pixels; 0 if it does not read as a plan but lies beside one.
    rooms: usize,
    /// The usual thickness of its walls, pixels.
    walls: f64,
}

/// Returns true if two boxes are about as wide or about as deep.
fn have_one_side(a: &Extent, b: &Extent) -> bool {
    let (a, b) = (a.size(), b.size());
    (0..2).any(|axis| {
        let (short, long) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        long as f64 <= ALIKE * short as f64
    })
}

/// Returns the connected parts of the ink, without letters and frames; `None` without ink.
fn parts(ink: &Ink) -> Option<Vec<Extent>> {
    let is_dark = |x: u32, y: u32| ink.dark.get_pixel(x, y)[0] > ink.threshold;
    let extents = Parts::of_set(ink.dark.dimensions(), is_dark, true).extents();
    let all: Vec<Extent> = extents.into_iter().filter(|e| e.area > 0).collect();
    let drawn = all.iter().copied().reduce(Extent::with)?;
    let large = |e: &Extent| e.diagonal() >= PART * drawn.diagonal();
    let mut parts: Vec<Extent> = all.into_iter().filter(large).collect();
    let [width, height] = drawn.size().map(|side| FRAME * side as f64);
    // The mean thickness of a line round a box.
    let pen = |e: &Extent| e.area as f64 / (2 * e.size().iter().sum::<usize>()).max(1) as f64;
    let spans = |e: &Extent| e.size()[0] as f64 >= width && e.size()[1] as f64 >= height;
    let within = parts.iter().filter(|e| !spans(e));
    let largest = within.max_by(|a, b| a.diagonal().total_cmp(&b.diagonal()));
    let walls = largest.map_or(0.0, pen);
    parts.retain(|e| !spans(e) || pen(e) > FRAME_PEN * walls);
    Some(parts)
}

fn bounds(parts: &[Extent]) -> Extent {
    parts
        .iter()
        .copied()
        .reduce(Extent::with)
        .unwrap_or_default()
}

/// Returns the area of the box of some parts, square pixels.
fn area(parts: &[Extent]) -> usize {
    bounds(parts).size().iter().product()
}

/// Parts on both sides of a blank band right across all of them.
struct Halves {
    /// The axis across the band, and its first and last pixel.
    axis: usize,
    band: [usize; 2],
    sides: [Vec<Extent>; 2],
}

impl Halves {
    /// Divides parts at the widest blank band; `None` if there is none.
    fn of(parts: &[Extent], space: f64) -> Option<Halves> {
        let band = |axis: usize| {
            let mut sides: Vec<[usize; 2]> = parts.iter().map(|e| [e.x, e.y][axis]).collect();
            sides.sort_unstable();
            let mut end = sides.first()?[1];
            let mut widest: Option<(usize, usize, [usize; 2])> = None;
            for [low, high] in sides {
                let width = low.saturating_sub(end);
                if width as f64 >= space && widest.is_none_or(|w| width > w.0) {
                    widest = Some((width, axis, [end, low]));
                }
                end = end.max(high);
            }
            widest
        };
        let (_, axis, band) = band(0).into_iter().chain(band(1)).max()?;
        let (before, after) = parts.iter().partition(|e| [e.x, e.y][axis][1] <= band[0]);
        Some(Halves {
            axis,
            band,
            sides: [before, after],
        })
    }

    /// Returns true if strokes line most of the band on both sides, as walls round two plans do.
    fn is_lined(&self, ink: &Ink) -> bool {
        let boxes = [0, 1].map(|k| bounds(&self.sides[k]));
        let along = |e: &Extent| [e.y, e.x][self.axis];
        let [a, b] = boxes.map(|e| along(&e));
        let shared = a[0].max(b[0])..a[1].min(b[1]);
        let depth = (LINING * boxes[0].with(boxes[1]).diagonal()) as usize;
        let is_dark = |across: usize, k: usize| {
            let (x, y) = if self.axis == 0 {
                (across, k)
            } else {
                (k, across)
            };
            ink.dark.get_pixel(x as u32, y as u32)[0] > ink.threshold
        };
        let [from, to] = self.band;
        let end = [ink.dark.width(), ink.dark.height()][self.axis] as usize;
        let sides = [
            from.saturating_sub(depth)..from + 1,
            to..(to + depth).min(end),
        ];
        let lined = |strip: &Range<usize>| {
            let dark = |k: &usize| strip.clone().any(|across| is_dark(across, *k));
            shared.clone().filter(dark).count() as f64 >= LINED * shared.len().max(1) as f64
        };
        sides.iter().all(lined)
    }
}

/// Divides parts at all blank bands.
fn leaves(parts: &[Extent], space: f64) -> Vec<Vec<Extent>> {
    match Halves::of(parts, space) {
        None => vec![parts.to_vec()],
        Some(both) => both
            .sides
            .iter()
            .flat_map(|half| leaves(half, space))
            .collect(),
    }
}

/// A sheet whose plans are searched.
struct Search<'a> {
    ink: &'a Ink,
    /// The least space between two plans, pixels.
    space: f64,
    /// The least area of the box of a plan, square pixels.
    least: f64,
    /// The number of readings that are left.
    readings: Cell<usize>,
}

impl Search<'_> {
    fn is_large(&self, parts: &[Extent]) -> bool {
        !parts.is_empty() && area(parts) as f64 >= self.least
    }

    /// Returns the plans among some parts, and what lies beside them and does not read as one.
    fn plans(&self, parts: &[Extent]) -> Vec<Plan> {
        if !self.is_large(parts) {
            return vec![];
        }
        let whole = || self.plan(bounds(parts)).into_iter().collect();
        let Some(halves) = Halves::of(parts, self.space) else {
            return whole();
        };
        let [a, b] = &halves.sides;
        let (mut plans, other) = match [a, b].map(|half| self.plans(half)) {
            [a, b] if !a.is_empty() && !b.is_empty() => return [a, b].concat(),
            [a, b] if a.is_empty() && b.is_empty() => return whole(),
            [plans, none] if none.is_empty() => (plans, b),
            [_, plans] => (plans, a),
        };
        if !self.is_large(other) {
            return plans;
        }
        if plans.len() > 1 || halves.is_lined(self.ink) {
            plans.push(Plan {
                at: bounds(other),
                drawn: bounds(other),
                rooms: 0,
                walls: 0.0,
            });
            return plans;
        }
        // Walls on both sides of openings in one line belong to one plan.
        reaching(whole(), other).unwrap_or(plans)
    }

    /// Returns the plan within an extent, if that reads as one.
    fn plan(&self, extent: Extent) -> Option<Plan> {
        self.readings.set(self.readings.get().checked_sub(1)?);
        let [width, height] = extent.size().map(|side| side as u32);
        let [x, y] = [extent.x[0] as u32, extent.y[0] as u32];
        let ink = self.ink.within([x, y], [width, height]);
        let reading = walls::read(&ink).filter(walls::Reading::is_whole)?;
        let corners = &reading.graph.corners;
        let low = corners.iter().copied().reduce(DVec2::min)?;
        let size = corners.iter().copied().reduce(DVec2::max)? - low;
        let faces = &reading.divided.faces.of;
        let rooms = faces.iter().filter(|face| *face != 0).count();
        let is_plan = reading.rooms() >= FEWEST_ROOMS && rooms as f64 >= FILLED * size.x * size.y;
        let side = |from: u32, low: f64, size: f64| {
            let from = from as usize + low.max(0.0) as usize;
            [from, from + size as usize]
        };
        let at = Extent {
            x: side(x, low.x, size.x),
            y: side(y, low.y, size.y),
            area: 0,
        };
        is_plan.then_some(Plan {
            at,
            drawn: extent,
            rooms,
            walls: reading.divided.strokes.usual,
        })
    }
}

/// Returns plans if they cover most of some parts.
fn reaching(plans: Vec<Plan>, parts: &[Extent]) -> Option<Vec<Plan>> {
    let (half, whole) = (bounds(parts), plans.first()?.at);
    let covered = |axis: usize| {
        let ([low, high], [from, to]) = ([half.x, half.y][axis], [whole.x, whole.y][axis]);
        (high.min(to) + 1).saturating_sub(low.max(from)) * 2 > high + 1 - low
    };
    (covered(0) && covered(1)).then_some(plans)
}

/// Returns the box round a plan with its margin, to the middle of the space between it and other plans.
fn region(plan: &Extent, plans: &[Extent], (width, height): (u32, u32)) -> Region {
    let side = |plan: &Extent, axis: usize| [plan.x, plan.y][axis].map(|k| k as f64);
    let gap = |other: &Extent, axis: usize| {
        let (a, b) = (side(plan, axis), side(other, axis));
        (b[0] - a[1]).max(a[0] - b[1])
    };
    let corner = |k: usize| dvec2(plan.x[k] as f64, plan.y[k] as f64);
    let margin = MARGIN * plan.diagonal();
    let sheet = dvec2(width.into(), height.into());
    let mut region = [
        (corner(0) - margin).max(DVec2::ZERO),
        (corner(1) + margin).min(sheet),
    ];
    for other in plans.iter().filter(|other| *other != plan) {
        let axis = usize::from(gap(other, 1) > gap(other, 0));
        let (own, next) = (side(plan, axis), side(other, axis));
        if next[0] > own[1] {
            region[1][axis] = region[1][axis].min(own[1].midpoint(next[0]));
        } else if own[0] > next[1] {
            region[0][axis] = region[0][axis].max(own[0].midpoint(next[1]));
        }
    }
    region
}
