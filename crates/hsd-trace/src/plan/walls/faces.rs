//! Rooms: what walls and openings enclose.

use super::Stuff;
use super::field::Field;
use super::gaps::Gap;
use super::outside::distances;
use crate::plan::raster::Extent;
use std::collections::{BTreeMap, VecDeque};

/// The least room, in the square of the plan's diagonal.
const LEAST: f64 = 0.0008;
/// The least diagonal of a large wall, as a share of that of all ink.
const LARGE: f64 = 0.12;
/// The largest network of walls may be that many times as large as another that counts.
const NETWORK: usize = 8;
/// The narrowest room between walls, and between thin ones, as shares of the plan's diagonal.
const NARROW: [f64; 2] = [0.025, 0.05];
/// The share of thin walls round a room between thin ones.
const LIGHT: f64 = 0.3;

/// The lines between each two rooms: the length of light strokes, and all.
type Edges = BTreeMap<(u32, u32), (f64, f64)>;

/// A sheet divided into rooms, without walls between: 0 is outside.
#[derive(Clone, Debug)]
pub struct Faces {
    /// The room of each pixel.
    pub of: Field<u32>,
    /// The number of rooms.
    pub count: usize,
}

/// Returns walls with their openings closed.
pub fn closed(walls: &Field<bool>, gaps: &[Gap]) -> Field<bool> {
    let mut out = walls.clone();
    for gap in gaps {
        let quarter = gap.bar.thickness() / 4;
        for line in gap.bar.across[0] + quarter..=gap.bar.across[1] - quarter {
            for k in gap.bar.along[0]..=gap.bar.along[1] {
                let place = if gap.bar.upright {
                    (line, k)
                } else {
                    (k, line)
                };
                out[place] = true;
            }
        }
    }
    out
}

/// Returns the extent of all walls.
pub(super) fn bounds(walls: &Field<bool>) -> Extent {
    let extents = walls.parts(true).extents();
    extents.into_iter().reduce(Extent::with).unwrap_or_default()
}

/// Keeps the largest of the networks of walls, and those nearly as large; returns the bounds of the largest.
pub(super) fn largest(walls: &Field<bool>) -> (Field<bool>, Extent) {
    let parts = walls.parts(true);
    let extents = parts.extents();
    let size = |extent: &Extent| extent.size().iter().product::<usize>();
    let sizes: Vec<usize> = extents.iter().map(size).collect();
    let best = (0..sizes.len()).max_by_key(|k| (sizes[*k], std::cmp::Reverse(*k)));
    let bounds = extents[best.unwrap_or(0)];
    let stays = |part: u32| sizes[part as usize] * NETWORK >= size(&bounds);
    let mut out = walls.map(|_| false);
    for (x, y, _) in parts.pixels().filter(|(_, _, part)| stays(*part)) {
        out[(x as usize, y as usize)] = true;
    }
    (out, bounds)
}

impl Faces {
    /// Divides a sheet by closed walls: rooms and the outside grow into the walls until they meet.
    pub fn of(walls: &Field<bool>, diagonal: f64) -> Faces {
        let parts = walls.map(|w| !w).parts(false);
        let mut areas = vec![0_usize; parts.count + 1];
        let mut is_outside = vec![false; parts.count + 1];
        for (x, y, part) in parts.pixels() {
            let (x, y, part) = (x as usize, y as usize, part as usize);
            areas[part] += 1;
            is_outside[part] |= x == 0 || y == 0 || x + 1 == walls.width || y + 1 == walls.height;
        }
        let least = LEAST * diagonal * diagonal;
        let mut count = 0;
        let mut names = vec![u32::MAX; parts.count + 1];
        for part in 1..=parts.count {
            if is_outside[part] {
                names[part] = 0;
            } else if areas[part] as f64 >= least {
                count += 1;
                names[part] = count as u32;
            }
        }
        let mut of = walls.map(|_| u32::MAX);
        let mut open = VecDeque::new();
        for (x, y, part) in parts.pixels() {
            let name = names[part as usize];
            if name != u32::MAX {
                of[(x as usize, y as usize)] = name;
                open.push_back((x as usize, y as usize));
            }
        }
        while let Some(place) = open.pop_front() {
            let next: Vec<_> = of.beside(place).filter(|p| of[*p] == u32::MAX).collect();
            for p in next {
                of[p] = of[place];
                open.push_back(p);
            }
        }
        // Without any outside there is nothing to grow.
        let of = of.map(|f| if f == u32::MAX { 0 } else { f });
        Faces { of, count }
    }
}

/// Keeps walls within the bounds of the large ones: small ones beyond are dimensions and legends. `drawn` is the diagonal of all ink.
pub fn within_walls(walls: &Field<bool>, drawn: f64) -> Field<bool> {
    let extents = walls.parts(true).extents();
    let large = extents
        .into_iter()
        .filter(|e| e.diagonal() >= LARGE * drawn);
    let Some(bounds) = large.filter(|e| e.area > 0).reduce(Extent::with) else {
        return walls.clone();
    };
    let within = |k: usize, [a, b]: [usize; 2]| (a..=b).contains(&k);
    let inside = |x: usize, y: usize| within(x, bounds.x) && within(y, bounds.y);
    Field::new(walls.width, walls.height, |x, y| {
        walls[(x, y)] && inside(x, y)
    })
}

impl Faces {
    /// Merges rooms too narrow to be rooms, which lines of floors, stairs and furniture make, with those beside them.
    pub fn merged(mut self, stuff: &Field<Stuff>, diagonal: f64) -> Faces {
        loop {
            let (widths, beside) = self.measured(stuff);
            let narrow = (1..=self.count).filter(|k| widths[*k] > 0.0);
            let narrow = narrow.filter(|k| {
                let thin = beside.range((*k as u32, 0)..(*k as u32 + 1, 0));
                let (mut light, mut all) = (0.0, 0.0);
                for ((_, _), (l, a)) in thin {
                    (light, all) = (light + l, all + a);
                }
                let least = if light > LIGHT * all {
                    NARROW[1]
                } else {
                    NARROW[0]
                };
                widths[*k] < least * diagonal
            });
            let Some(k) = narrow.min_by(|a, b| widths[*a].total_cmp(&widths[*b])) else {
                return self;
            };
            let all = beside.range((k as u32, 0)..(k as u32 + 1, 0));
            let inner = all.clone().filter(|((_, other), _)| *other != 0);
            let best = inner.max_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let best = best.filter(|b| b.1.0 > 0.0).map(|b| b.0.1);
            let longest = all.max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map(|b| b.0.1);
            let into = best.or(longest).unwrap_or(0);
            self.of = self.of.map(|f| if f == k as u32 { into } else { f });
        }
    }

    /// Returns the inner width of each room, and what parts each two: the length of light strokes, and all.
    fn measured(&self, stuff: &Field<Stuff>) -> (Vec<f64>, Edges) {
        let rim = self.of.rims();
        let inner = distances(&rim);
        let mut widths = vec![0.0_f64; self.count + 1];
        let mut beside = Edges::new();
        for y in 0..self.of.height {
            for x in 0..self.of.width {
                let face = self.of[(x, y)];
                if face == 0 {
                    continue;
                }
                let width = &mut widths[face as usize];
                *width = width.max(2.0 * f64::from(inner[(x, y)]));
                if !rim[(x, y)] {
                    continue;
                }
                for p in self.of.beside((x, y)).filter(|p| self.of[*p] != face) {
                    let light = [stuff[p], stuff[(x, y)]].contains(&Stuff::Thin);
                    let edge = beside.entry((face, self.of[p])).or_default();
                    edge.0 += f64::from(u8::from(light));
                    edge.1 += 1.0;
                }
            }
        }
        (widths, beside)
    }
}
