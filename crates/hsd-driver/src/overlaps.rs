//! Houses that stand in each other, or leave a gap: compared by the ground storeys of all houses of a run, in their order.
//! Those of a town are compared district by district; see `spilled`.

#[cfg(feature = "models")]
mod bytes;
#[cfg(feature = "models")]
mod spilled;

#[cfg(feature = "models")]
pub(super) use spilled::SpilledGrounds;

use super::gaps::{self, Gap, PASSAGE, WallEnd};
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::overlap::Area;
use hsd_base::source::Span;
use hsd_ir::building::{House, Ring};
use hsd_ir::catalog::{Catalog, Stance};
use hsd_ir::program::Content;
use hsd_passes::messages::plan::{gap_in_wall, in_each_other};
use std::collections::HashMap;

/// The area that neighbours may share, square metres.
const SHARED: f64 = 0.1;

/// The height over which they may stand in each other, metres.
const LOW: f64 = 0.1;

/// The product of the numbers of walls beyond which two houses are not compared.
const SIDES: usize = 40_000;

/// The side of a cell of the grid in which neighbours are looked for, metres.
const CELL: f64 = 16.0;

/// The number of cells of a house beyond which it is compared with all others.
const CELLS: i64 = 64;

/// Pairs that are compared at most, for each house and at least.
const PAIRS: usize = 64;

/// The numbers of the houses in each cell of the grid.
type Cells = HashMap<(i64, i64), Vec<u32>>;

/// An outline; true if it is a court.
type Outline = (Line, bool);

/// Corners, or the ends of walls, in their order.
type Line = Box<[DVec2]>;

/// The ground storeys of the houses so far.
#[derive(Debug)]
pub(super) struct Grounds {
    list: Vec<Ground>,
    /// True if houses of different files stand in one scene.
    together: bool,
}

/// The ground storey of a house, in the world.
#[derive(Debug)]
pub(super) struct Ground {
    /// Where the house is written, or placed.
    span: Span,
    name: Box<str>,
    low: DVec2,
    high: DVec2,
    /// From its floor to the top of its walls, metres.
    heights: [f64; 2],
    rings: Box<[Outline]>,
    /// Walls that enclose nothing.
    open: Box<[Line]>,
    /// The ends of walls and of a corridor.
    ends: Box<[WallEnd]>,
}

/// Returns true if all that stands in a ring is fences.
fn is_fence(ring: &Ring, catalog: &Catalog) -> bool {
    let units = ring.walls.iter().flat_map(|wall| &wall.units);
    let mut standing = units
        .filter(|unit| unit.content != Content::Void)
        .peekable();
    standing.peek().is_some()
        && standing.all(|unit| match &unit.content {
            Content::Part(id) => catalog.part(*id).stance == Stance::Fence,
            _ => false,
        })
}

impl Ground {
    /// Returns the ground storey of a house; `None` if its walls enclose nothing. A ring of fences is a line, not a building:
    /// houses stand in the yard round which it runs.
    pub(super) fn of(house: &House, catalog: &Catalog) -> Option<Ground> {
        let storey = house.storeys.first()?;
        let z = house.origin[2];
        let all: Vec<&Ring> = storey.rings.iter().filter(|r| !r.inner).collect();
        let (closed, open): (Vec<&Ring>, Vec<&Ring>) =
            all.iter().partition(|r| r.closed && !is_fence(r, catalog));
        let rings: Box<[Outline]> = closed
            .iter()
            .map(|r| {
                (
                    r.walls.iter().map(|w| house.world(w.from)).collect(),
                    r.hole,
                )
            })
            .collect();
        let line = |r: &&Ring| -> Line {
            let first = r.walls.first().map(|w| w.from);
            let places = first.into_iter().chain(r.walls.iter().map(|w| w.to));
            places.map(|p| house.world(p)).collect()
        };
        let open: Box<[Line]> = open.iter().map(line).collect();
        let top = house.storeys.iter().map(|s| s.z1).fold(0.0, f64::max);
        let span = house.placed.map_or(house.span, |by| by.span);
        let place = (span, house.name.as_str().into());
        Ground::new(place, [z, z + top], (rings, open), gaps::ends(house, &all))
    }

    fn new(
        (span, name): (Span, Box<str>),
        heights: [f64; 2],
        (rings, open): (Box<[Outline]>, Box<[Line]>),
        ends: Box<[WallEnd]>,
    ) -> Option<Ground> {
        let closed = rings.iter().flat_map(|(ring, _)| ring.iter());
        let corners = || closed.clone().chain(open.iter().flatten()).copied();
        let low = corners().reduce(DVec2::min)?;
        let high = corners().reduce(DVec2::max)?;
        Some(Ground {
            span,
            name,
            low,
            high,
            heights,
            rings,
            open,
            ends,
        })
    }

    /// Returns its walls.
    pub(super) fn walls(&self) -> impl Iterator<Item = [DVec2; 2]> {
        let rings = self.rings.iter().flat_map(|(ring, _)| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(p, q)| [*p, *q])
        });
        let open = self.open.iter();
        rings.chain(open.flat_map(|line| line.windows(2).map(|w| [w[0], w[1]])))
    }

    fn area(&self) -> Area {
        let mut area = Area::default();
        for (ring, hole) in &self.rings {
            area.add(ring, *hole, self.low);
        }
        area
    }

    fn sides(&self) -> usize {
        self.rings.iter().map(|(ring, _)| ring.len()).sum()
    }

    fn meets(&self, other: &Ground) -> bool {
        let apart = |[a, b]: [f64; 2], [c, d]: [f64; 2]| b.min(d) - a.max(c) < LOW;
        let wide = self.high.min(other.high) - self.low.max(other.low);
        wide.cmpgt(DVec2::ZERO).all()
            && self.sides() * other.sides() < SIDES
            && wide.x * wide.y > SHARED
            && !apart(self.heights, other.heights)
    }

    fn cells(&self) -> Option<impl Iterator<Item = (i64, i64)> + use<>> {
        let [(x0, y0), (x1, y1)] = [cell(self.low), cell(self.high)];
        let few = (x1 - x0 + 1).saturating_mul(y1 - y0 + 1) <= CELLS;
        few.then(|| cells_at(self.low, self.high))
    }
}

fn cell(p: DVec2) -> (i64, i64) {
    ((p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64)
}

/// Returns the cells of a rectangle.
fn cells_at(low: DVec2, high: DVec2) -> impl Iterator<Item = (i64, i64)> {
    let ((x0, y0), (x1, y1)) = (cell(low), cell(high));
    (x0..=x1).flat_map(move |x| (y0..=y1).map(move |y| (x, y)))
}

/// Overlaps and gaps between some houses, by their numbers in the list.
#[derive(Debug, Default)]
struct Findings {
    met: Vec<Met>,
    gaps: Vec<Near>,
}

/// A house that stands in another one; the area that they share, square metres.
#[derive(Debug)]
struct Met {
    own: u32,
    other: u32,
    shared: f64,
}

/// A house with a wall that ends before another one; the length of the gap, metres.
#[derive(Debug)]
struct Near {
    own: u32,
    other: u32,
    length: f64,
}

impl Grounds {
    /// Creates the list for houses of one scene, or of files that are only checked together.
    pub(super) fn new(together: bool) -> Grounds {
        Grounds {
            list: vec![],
            together,
        }
    }

    /// Adds houses, in their order.
    pub(super) fn add(&mut self, grounds: impl IntoIterator<Item = Ground>) {
        self.list.extend(grounds);
    }

    /// Reports the houses that stand in each other, and the walls that end a little before another house. `head` returns
    /// the first line of a house.
    pub(super) fn report(&self, head: impl Fn(Span) -> Span, out: &mut Diagnostics) {
        let found = self.findings(|_| true);
        let place = |number: u32| {
            let ground = &self.list[number as usize];
            (head(ground.span), &*ground.name)
        };
        for Met { own, other, shared } in found.met {
            let [(own, name), (other, second)] = [own, other].map(place);
            out.push(in_each_other([own, other], [name, second], shared));
        }
        for Near { own, other, length } in found.gaps {
            let [(own, name), (other, second)] = [own, other].map(place);
            out.push(gap_in_wall([own, other], [name, second], length));
        }
    }

    /// Finds the houses that stand in each other, each with the first one before it that it stands in; and the gaps before
    /// those ends of walls that are `here`.
    fn findings(&self, here: impl Fn(DVec2) -> bool) -> Findings {
        let mut cells = Cells::new();
        let mut large: Vec<u32> = vec![];
        let mut found = Findings::default();
        // Ten thousand houses in one place are compared with some of the others only.
        let mut pairs = PAIRS * self.list.len().max(4096);
        for (number, ground) in self.list.iter().enumerate() {
            let mut near: Vec<u32> = match ground.cells() {
                Some(own) => own
                    .filter_map(|cell| cells.get(&cell))
                    .flatten()
                    .chain(&large)
                    .copied()
                    .take(pairs)
                    .collect(),
                None => (0..number as u32).take(pairs).collect(),
            };
            pairs -= near.len();
            near.sort_unstable();
            near.dedup();
            let mut own = None;
            found
                .met
                .extend(near.into_iter().find_map(|number_of_other| {
                    let other = &self.list[number_of_other as usize];
                    let beside = self.together || ground.span.file == other.span.file;
                    if !beside || !ground.meets(other) {
                        return None;
                    }
                    let own = own.get_or_insert_with(|| ground.area());
                    let shared = own.shared(&other.area());
                    (shared > SHARED).then_some(Met {
                        own: number as u32,
                        other: number_of_other,
                        shared,
                    })
                }));
            match ground.cells() {
                Some(own) => own.for_each(|c| cells.entry(c).or_default().push(number as u32)),
                None => large.push(number as u32),
            }
        }
        found.gaps = self.gaps((&cells, &large), here);
        found
    }

    /// Finds the walls that end a little before another house, which is found in the cells of the grid, or among the large
    /// ones.
    fn gaps(&self, (cells, large): (&Cells, &[u32]), here: impl Fn(DVec2) -> bool) -> Vec<Near> {
        let mut gaps = vec![];
        for (number, ground) in self.list.iter().enumerate() {
            let own = number as u32;
            for end in ground.ends.iter().filter(|end| here(end.at)) {
                let near = cells_at(end.at - PASSAGE, end.at + PASSAGE);
                let near = near.filter_map(|cell| cells.get(&cell)).flatten();
                let near = near.chain(large).copied().take(PAIRS);
                gaps.extend(self.gap(own, *end, near).map(|gap| Near {
                    own,
                    other: gap.other,
                    length: gap.length,
                }));
            }
        }
        gaps
    }

    /// Returns the gap after the end of a wall; of two ends that face each other only the later house has one.
    fn gap(&self, own: u32, end: WallEnd, near: impl Iterator<Item = u32>) -> Option<Gap> {
        let ground = &self.list[own as usize];
        let others = near.filter(|other| *other != own);
        let others = others.map(|other| (other, &self.list[other as usize]));
        let beside = others.filter(|(_, other)| {
            let [low, high] = [0, 1].map(|k| (ground.heights[k], other.heights[k]));
            (self.together || ground.span.file == other.span.file)
                && high.0.min(high.1) - low.0.max(low.1) > LOW
        });
        let gap = end.gap(beside.map(|(number, other)| (number, other.walls())))?;
        let facing = self.list[gap.other as usize].ends.iter();
        let twice = gap.other > own && facing.clone().any(|e| e.is_at(gap.to));
        (!twice).then_some(gap)
    }
}
