//! Houses that stand in each other: compared by the ground storeys of all houses of a run, in their order.

use crate::building::House;
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::plan::in_each_other;
use crate::geometry::overlap::Area;
use crate::source::{Source, Span};
use glam::DVec2;
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
    /// Its outlines, each with true if it is a court.
    rings: Box<[(Box<[DVec2]>, bool)]>,
}

impl Ground {
    /// Returns the ground storey of a house; `None` if its walls enclose nothing.
    pub(super) fn of(house: &House) -> Option<Ground> {
        let storey = house.storeys.first()?;
        let z = house.origin[2];
        let closed = storey.rings.iter().filter(|r| r.closed && !r.inner);
        let rings: Box<[(Box<[DVec2]>, bool)]> = closed
            .map(|r| {
                (
                    r.walls.iter().map(|w| house.world(w.from)).collect(),
                    r.hole,
                )
            })
            .collect();
        let corners = || rings.iter().flat_map(|(ring, _)| ring.iter().copied());
        let low = corners().reduce(DVec2::min)?;
        let high = corners().reduce(DVec2::max)?;
        let top = house.storeys.iter().map(|s| s.z1).fold(0.0, f64::max);
        Some(Ground {
            span: house.placed.map_or(house.span, |by| by.span),
            name: house.name.as_str().into(),
            low,
            high,
            heights: [z, z + top],
            rings,
        })
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

    fn cells(&self) -> Option<impl Iterator<Item = (i64, i64)>> {
        let cell = |p: DVec2| ((p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64);
        let ((x0, y0), (x1, y1)) = (cell(self.low), cell(self.high));
        let few = (x1 - x0 + 1).saturating_mul(y1 - y0 + 1) <= CELLS;
        few.then(|| (x0..=x1).flat_map(move |x| (y0..=y1).map(move |y| (x, y))))
    }
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

    /// Reports the houses that stand in each other, each with the first one before it that it stands in.
    pub(super) fn report<'s>(
        &self,
        sources: impl Iterator<Item = &'s Source> + Clone,
        out: &mut Diagnostics,
    ) {
        let head = |span: Span| {
            let source = sources.clone().find(|source| source.id() == span.file);
            source.map_or(span, |source| first_line(source, span))
        };
        let mut cells: HashMap<(i64, i64), Vec<u32>> = HashMap::new();
        let mut large: Vec<u32> = vec![];
        // Ten thousand houses in one place are compared with some of the others only.
        let mut pairs = PAIRS * self.list.len().max(4096);
        for (number, ground) in self.list.iter().enumerate() {
            let mut near: Vec<u32> = match ground.cells() {
                Some(own) => own
                    .filter_map(|cell| cells.get(&cell))
                    .flatten()
                    .chain(&large)
                    .copied()
                    .collect(),
                None => (0..number as u32).collect(),
            };
            near.truncate(pairs);
            pairs -= near.len();
            near.sort_unstable();
            near.dedup();
            let mut own = None;
            let met = near.into_iter().find_map(|other| {
                let other = &self.list[other as usize];
                let beside = self.together || ground.span.file == other.span.file;
                if !beside || !ground.meets(other) {
                    return None;
                }
                let own = own.get_or_insert_with(|| ground.area());
                let shared = own.shared(&other.area());
                (shared > SHARED).then_some((other, shared))
            });
            if let Some((other, shared)) = met {
                let names = [&*ground.name, &*other.name];
                let heads = [ground.span, other.span].map(head);
                out.push(in_each_other(heads, names, shared));
            }
            match ground.cells() {
                Some(own) => own.for_each(|c| cells.entry(c).or_default().push(number as u32)),
                None => large.push(number as u32),
            }
        }
    }
}

/// Returns the first line of a span.
fn first_line(source: &Source, span: Span) -> Span {
    let range = source.text_range(span);
    let first = source.text()[range.clone()].lines().next();
    let length = first.map_or(0, |line| line.trim_end().len());
    source.span(range.start..range.start + length)
}
