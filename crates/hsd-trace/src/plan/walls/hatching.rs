//! Removes hatching: lines of floors, stairs and paving at equal distances.

use super::bars::{Bar, bars, widened};
use super::field::Field;
use super::mask::Strokes;

/// The fewest lines.
const FEWEST: usize = 4;
/// The narrowest space between two, in thicknesses of walls, and pixels: windows are lines within a wall.
const NARROW: (f64, f64) = (0.8, 3.0);
/// The widest, as a share of the diagonal of all ink. With one pen it is narrower, since walls are lines too.
const WIDE: f64 = 0.06;
const WIDE_ONE_PEN: f64 = 0.03;
/// The length of the pieces into which lines are cut, as the same share.
const PIECE: f64 = 0.03;
/// The greatest difference of two spaces, as a share of the first, and pixels.
const EQUAL: (f64, f64) = (0.25, 1.0);
/// The share of the longer of two lines along which the other runs beside it.
const BESIDE: f64 = 0.6;
/// Half of what the pen is widened by, so that lines that are not quite straight are one, pixels.
const PEN: usize = 1;

/// The longest tread, in the space between two: 0.75 to 1.1 m by 0.2 to 0.3 m. Boards of floors are longer.
const TREAD: f64 = 5.5;

/// Parallel lines at equal distances.
#[derive(Clone)]
struct Family {
    along: [usize; 2],
    across: [f64; 2],
    /// The distance from line to line, pixels.
    space: f64,
}

/// Lines of stairs: the box around them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Treads {
    /// True if the lines run down the sheet.
    pub(super) upright: bool,
    /// First and last column.
    pub(super) x: [usize; 2],
    /// First and last row.
    pub(super) y: [usize; 2],
}

/// Removes hatching along and across a sheet, and returns what of it are stairs; `drawn` is the diagonal of all ink.
pub(super) fn remove(strokes: &mut Strokes, drawn: f64) -> Vec<Treads> {
    let light = strokes.light();
    let length = (PIECE * drawn).ceil().max(8.0) as usize;
    let lines = [false, true].map(|upright| {
        // Short pieces of lines are straight, also where the whole is not, and where letters interrupt it.
        let wide = widened(&light, PEN, upright);
        let wide = Field::new(wide.width, wide.height, |x, y| {
            let along = if upright { y } else { x };
            wide[(x, y)] && along % length > 0
        });
        let mut lines = bars(&wide, strokes.usual, upright);
        lines.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.along.cmp(&b.along)));
        lines
    });
    let narrow = (NARROW.0 * strokes.usual).max(NARROW.1);
    let wide = if strokes.has_one_pen() {
        WIDE_ONE_PEN
    } else {
        WIDE
    };
    let spaces = [narrow, wide * drawn];
    let families = [0, 1].map(|k| families(&lines[k], spaces));
    let is_hatching = [0, 1].map(|k| {
        let families = &families[k];
        let within = |line: &Bar| families.iter().any(|family| family.has(line));
        lines[k].iter().map(within).collect::<Vec<bool>>()
    });
    let chosen = |k: usize, hatching: bool| {
        let all = lines[k].iter().zip(&is_hatching[k]);
        all.filter(move |(_, is)| **is == hatching)
            .map(|(line, _)| line)
    };
    for k in [0, 1] {
        // Lines across that stay are not interrupted.
        let mut kept = light.map(|_| false);
        for place in chosen(1 - k, false).flat_map(places) {
            kept[place] = true;
        }
        for place in chosen(k, true).flat_map(places) {
            if light[place] && !kept[place] {
                strokes.thickness[place] = 0.0;
            }
        }
    }
    let regions = families.map(|families| regions(families, length));
    if !strokes.has_one_pen() {
        clear(strokes, &regions, length);
    }
    let treads = regions.iter().enumerate().flat_map(|(k, regions)| {
        let treads = regions
            .iter()
            .filter_map(move |region| region.treads(k == 1));
        treads.collect::<Vec<Treads>>()
    });
    treads.collect()
}

/// Removes writing that touches hatching; walls within it stay.
fn clear(strokes: &mut Strokes, regions: &[Vec<Family>; 2], length: usize) {
    let walls = strokes.joined(&strokes.walls());
    let mut kept = walls.map(|_| false);
    for upright in [false, true] {
        let bars = bars(&walls, strokes.usual, upright).into_iter();
        let long = bars.filter(|bar| bar.along[1] - bar.along[0] >= length);
        long.collect::<Vec<_>>()
            .iter()
            .flat_map(places)
            .for_each(|place| kept[place] = true);
    }
    for (k, regions) in regions.iter().enumerate() {
        for region in regions {
            // The outermost lines may be walls.
            let [first, last] = region.across.map(|place| place as usize);
            let across = [first + 2, last.saturating_sub(2)];
            let region = Bar {
                upright: k == 1,
                along: region.along,
                across,
            };
            for place in places(&region).filter(|place| !kept[*place]) {
                strokes.thickness[place] = 0.0;
            }
        }
    }
}

/// Joins families whose lines continue each other, also across letters.
fn regions(mut families: Vec<Family>, length: usize) -> Vec<Family> {
    families.sort_by_key(|family| family.along);
    let mut out: Vec<Family> = vec![];
    for family in families {
        let is_same = |other: &&mut Family| {
            let near = |k: usize| (other.across[k] - family.across[k]).abs() <= length as f64 / 2.0;
            near(0) && near(1) && family.along[0] <= other.along[1] + 2 * length
        };
        match out.iter_mut().find(is_same) {
            Some(other) => {
                other.along[1] = other.along[1].max(family.along[1]);
                let [first, last] = family.across;
                other.across = [other.across[0].min(first), other.across[1].max(last)];
            }
            None => out.push(family),
        }
    }
    out
}

impl Family {
    /// Returns the box around the lines if they are treads.
    fn treads(&self, upright: bool) -> Option<Treads> {
        let (along, across) = (self.along, self.across.map(|place| place as usize));
        let length = (along[1] - along[0]) as f64;
        (length <= TREAD * self.space).then_some(Treads {
            upright,
            x: if upright { across } else { along },
            y: if upright { along } else { across },
        })
    }

    /// Returns true for a line between others. The outermost may be walls.
    fn has(&self, line: &Bar) -> bool {
        let [a, b] = line.along;
        let within = b.min(self.along[1]) as f64 - a.max(self.along[0]) as f64;
        let at = middle(line);
        within >= BESIDE * (b - a) as f64 && at > self.across[0] && at < self.across[1]
    }
}

/// Finds families of parallel lines; `narrow` and `wide` limit the space between two, pixels.
fn families(lines: &[Bar], [narrow, wide]: [f64; 2]) -> Vec<Family> {
    let next = |from: usize, least: f64, most: f64| {
        let apart = |k: &usize| middle(&lines[*k]) - middle(&lines[from]);
        let first = lines.partition_point(|line| middle(line) < middle(&lines[from]) + least);
        let all = (first..lines.len()).take_while(|k| apart(k) <= most);
        all.filter(|k| beside(&lines[from], &lines[*k]))
            .min_by(|a, b| apart(a).total_cmp(&apart(b)))
    };
    let mut used = vec![false; lines.len()];
    let mut out = vec![];
    for first in 0..lines.len() {
        if used[first] {
            continue;
        }
        let Some(second) = next(first, narrow, wide) else {
            continue;
        };
        let space = middle(&lines[second]) - middle(&lines[first]);
        let differs = (EQUAL.0 * space).max(EQUAL.1);
        let mut all = vec![first, second];
        while let Some(k) = next(all[all.len() - 1], space - differs, space + differs) {
            all.push(k);
        }
        if all.len() < FEWEST {
            continue;
        }
        all.iter().for_each(|k| used[*k] = true);
        let along = all.iter().map(|k| lines[*k].along);
        let along = along.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let across = [first, all[all.len() - 1]].map(|k| middle(&lines[k]));
        out.extend(along.map(|along| Family {
            along,
            across,
            space: (across[1] - across[0]) / (all.len() - 1) as f64,
        }));
    }
    out
}

fn beside(a: &Bar, b: &Bar) -> bool {
    let shared = a.along[1].min(b.along[1]) as f64 - a.along[0].max(b.along[0]) as f64;
    let longer = (a.along[1] - a.along[0]).max(b.along[1] - b.along[0]);
    shared >= BESIDE * longer as f64
}

fn middle(line: &Bar) -> f64 {
    (line.across[0] + line.across[1]) as f64 / 2.0
}

fn places(line: &Bar) -> impl Iterator<Item = (usize, usize)> {
    let line = *line;
    (line.across[0]..=line.across[1]).flat_map(move |l| {
        let place = move |k| if line.upright { (l, k) } else { (k, l) };
        (line.along[0]..=line.along[1]).map(place)
    })
}
