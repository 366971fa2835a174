//! Rooms: what walls and openings enclose.

use super::Stuff;
use super::field::Field;
use super::gaps::Gap;
use super::outside::distances;
use crate::plan::raster::Extent;
use std::collections::{BTreeMap, VecDeque};

/// The least room, in the square of the plan's diagonal.
const LEAST: f64 = 0.0008;
/// The largest network of walls may be that many times as large as another that counts.
const NETWORK: usize = 8;
/// The narrowest room between walls, and between thin ones, as shares of the plan's diagonal.
const NARROW: [f64; 2] = [0.025, 0.05];
/// The share of thin walls round a room between thin ones.
const LIGHT: f64 = 0.3;

/// The line between each room and another: the length of light strokes, and all.
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
        let mut of = Field::new(walls.width, walls.height, |x, y| names[parts.at((x, y))]);
        let at_rim = |p: &(usize, usize)| {
            of[*p] != u32::MAX && of.beside(*p).any(|near| of[near] == u32::MAX)
        };
        let mut open: VecDeque<_> = of.places().filter(at_rim).collect();
        while let Some(place) = open.pop_front() {
            for p in of.beside(place) {
                if of[p] == u32::MAX {
                    of[p] = of[place];
                    open.push_back(p);
                }
            }
        }
        // Without any outside there is nothing to grow.
        let of = of.map(|f| if f == u32::MAX { 0 } else { f });
        Faces { of, count }
    }
}

impl Faces {
    /// Merges rooms too narrow to be rooms, which lines of floors, stairs and furniture make, with those beside them.
    pub fn merged(mut self, stuff: &Field<Stuff>, diagonal: f64) -> Faces {
        let mut extents = self.extents();
        let mut widths: Vec<f64> = (0..=self.count)
            .map(|k| self.width(k, extents[k]))
            .collect();
        let mut edges = self.edges(stuff);
        loop {
            let narrow = (1..=self.count).filter(|k| widths[*k] > 0.0);
            let narrow = narrow.filter(|k| {
                let (mut light, mut all) = (0.0, 0.0);
                for (_, (l, a)) in edges.range(sides(*k as u32)) {
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
            let all = edges.range(sides(k as u32));
            let inner = all.clone().filter(|((_, other), _)| *other != 0);
            let best = inner.max_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let best = best.filter(|b| b.1.0 > 0.0).map(|b| b.0.1);
            let longest = all.max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map(|b| b.0.1);
            let into = best.or(longest).unwrap_or(0);
            self.rename(k as u32, into, extents[k]);
            move_edges(&mut edges, k as u32, into);
            widths[k] = 0.0;
            let both = extents[k].with(extents[into as usize]);
            extents[into as usize] = both;
            widths[into as usize] = self.width(into as usize, both);
        }
    }

    /// Returns the extent of each room by its number; that of the outside is the sheet's.
    pub(super) fn extents(&self) -> Vec<Extent> {
        let mut extents = vec![Extent::default(); self.count + 1];
        for (x, y) in self.of.places() {
            extents[self.of[(x, y)] as usize].add(x, y);
        }
        extents
    }

    /// Gives the pixels of a room another number.
    fn rename(&mut self, room: u32, into: u32, extent: Extent) {
        for y in extent.y[0]..=extent.y[1] {
            for x in extent.x[0]..=extent.x[1] {
                if self.of[(x, y)] == room {
                    self.of[(x, y)] = into;
                }
            }
        }
    }

    /// Returns the inner width of a room, pixels; 0 for the outside.
    fn width(&self, room: usize, extent: Extent) -> f64 {
        if room == 0 || extent.area == 0 {
            return 0.0;
        }
        let [width, height] = extent.size();
        let other = |p: (usize, usize)| self.of[p] as usize != room;
        let rim = Field::new(width, height, |x, y| {
            let p = (x + extent.x[0], y + extent.y[0]);
            other(p) || self.of.beside(p).any(other)
        });
        2.0 * f64::from(distances(&rim).iter().fold(0.0, f32::max))
    }

    /// Measures what parts each two rooms.
    fn edges(&self, stuff: &Field<Stuff>) -> Edges {
        let mut edges = Edges::new();
        for at in self.of.places() {
            let room = self.of[at];
            if room == 0 {
                continue;
            }
            for p in self.of.beside(at).filter(|p| self.of[*p] != room) {
                let light = [stuff[p], stuff[at]].contains(&Stuff::Thin);
                let edge = edges.entry((room, self.of[p])).or_default();
                edge.0 += f64::from(u8::from(light));
                edge.1 += 1.0;
            }
        }
        edges
    }
}

/// The keys of all edges of a room.
fn sides(room: u32) -> std::ops::Range<(u32, u32)> {
    (room, 0)..(room + 1, 0)
}

/// Makes the edges of a room those of another.
fn move_edges(edges: &mut Edges, room: u32, into: u32) {
    let own: Vec<u32> = edges.range(sides(room)).map(|edge| edge.0.1).collect();
    let mut take = |from: (u32, u32), to: (u32, u32)| {
        let taken = edges.remove(&from);
        if let Some((light, all)) = taken.filter(|_| to.0 != to.1 && to.0 != 0) {
            let edge = edges.entry(to).or_default();
            *edge = (edge.0 + light, edge.1 + all);
        }
    };
    for other in own {
        take((room, other), (into, other));
        take((other, room), (other, into));
    }
}
