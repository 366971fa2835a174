//! What the strokes of a drawing cover of each unit of its grid.

use super::fit::{Grid, sides};
use super::leaves::{self, At, Leaf};
use super::lines::Stroke;
use super::roles::Means;
use crate::plan::legend::Role;
use crate::plan::strokes::{Read, Units};
use glam::{DVec2, dvec2};
use std::collections::{BTreeMap, BTreeSet};

/// Pieces that a unit is divided into.
const PIECES: u32 = 40;
/// The pieces at each end that posts and corners may cover.
const END: u32 = 6;
/// How far from the line of the grid a stroke of a wall, an opening, a mat may lie, units.
const BAND: [f64; 3] = [0.3, 0.36, 0.22];
/// The share of a unit that must be covered.
const COVERED: f64 = 0.55;
/// Longer strokes are no bars and no dashes, units.
const SHORT: f64 = 0.45;
/// Lines of the grid farther out are none.
const FARTHEST: f64 = 1e6;
/// Steps in a unit for what lies in rooms.
const FINE: f64 = 20.0;
/// How near to the line between two cells a thing lies in both, units.
const MARGIN: f64 = 0.15;
/// What speaks against a place where something stands, and the least lead of a place that is sure.
const TAKEN: i32 = 20;
const CLEAR: i32 = 2;
/// How often doors on hinges are looked at.
const ROUNDS: usize = 4;
/// The most a wall may lean, as a share of its length.
const LEAN: f64 = 0.2;
/// The most units along a side.
pub(super) const MOST: i32 = 130;

/// What covers a unit.
#[derive(Clone, Debug, Default)]
pub(super) struct Cover {
    /// Pieces, by what covers them.
    pieces: BTreeMap<Means, u64>,
    /// Doors on hinges that stand there.
    hung: u32,
    /// Whether such a door may as well stand elsewhere.
    is_unsure: bool,
    /// Bars across it, by tenths.
    bars: u16,
    /// Pieces that short strokes cover, and how many these are.
    dashed: (u64, u32),
}

impl Cover {
    fn share(&self, means: &[Means]) -> f64 {
        pieces_share(
            means
                .iter()
                .filter_map(|m| self.pieces.get(m))
                .fold(0, |a, b| a | b),
        )
    }

    /// Whether a wall or an opening covers it.
    pub(super) fn is_closed(&self) -> bool {
        self.hung > 0 || self.opening().is_some() || self.share(&[Means::Wall]) >= COVERED
    }

    /// The opening that covers it.
    fn opening(&self) -> Option<(Role, f64)> {
        use Means::{Door, Glazing, Lattice, Open, Slide, Window};
        let share = |m: &[Means]| Some(self.share(m)).filter(|s| *s >= COVERED);
        // Dashes cover half of what they run along.
        let is_dashed = self.dashed.1 >= 2
            && pieces_share(self.dashed.0) > 0.3
            && self.share(&[Door, Slide]) < COVERED;
        if let Some(share) = share(&[Open]).or((is_dashed).then_some(1.0)) {
            return Some((Role::Open, share));
        }
        if let Some(share) = share(&[Glazing, Window, Lattice]) {
            let is_lattice = self.share(&[Lattice]) >= COVERED
                || self.pieces.contains_key(&Glazing) && self.bars.count_ones() >= 2;
            return Some((
                if is_lattice {
                    Role::Lattice
                } else {
                    Role::Window
                },
                share,
            ));
        }
        share(&[Door, Slide]).map(|share| (Role::Slide, share))
    }

    fn read(&self) -> Read {
        let (wall, mat) = (
            self.share(&[Means::Wall]),
            self.share(&[Means::Mat, Means::Inside]),
        );
        let read = |role: Role, likeness: f64| Read {
            role,
            likeness,
            lead: 1.0,
            ink: 0.0,
            unlike: 0.0,
        };
        match self.opening() {
            Some((role, share)) => read(role, share),
            None if wall >= COVERED => read(Role::Wall, wall),
            None if self.share(&[Means::Mat]) >= COVERED => read(Role::Mat, mat),
            None => Read::EMPTY,
        }
    }
}

/// The share of a unit that pieces cover between its ends.
fn pieces_share(pieces: u64) -> f64 {
    let within = (pieces >> END) & ((1 << (PIECES - 2 * END)) - 1);
    f64::from(within.count_ones()) / f64::from(PIECES - 2 * END)
}

/// What covers the units of a grid.
pub(super) struct Covers {
    /// Those that anything covers.
    pub(super) units: BTreeMap<At, Cover>,
    /// Posts.
    pub(super) posts: BTreeSet<(i32, i32)>,
    /// Places in rooms, in fine steps.
    ink: BTreeSet<(i32, i32)>,
    across: (i32, i32),
    down: (i32, i32),
}

impl Covers {
    /// Lays the strokes of a drawing over its grid; none if the grid would be too large.
    pub(super) fn of(strokes: &[Stroke], means: &[Option<Means>], grid: &Grid) -> Option<Covers> {
        let (mut low, mut high) = (DVec2::MAX, DVec2::MIN);
        let stands = |m: &Option<Means>| m.is_some_and(|m| m == Means::Wall || m.is_opening());
        for (stroke, _) in strokes.iter().zip(means).filter(|(_, m)| stands(m)) {
            for p in &stroke.points {
                let at = grid.units_of(*p);
                (low, high) = (low.min(at), high.max(at));
            }
        }
        let line = |at: f64| at.clamp(-FARTHEST, FARTHEST).round() as i32;
        let lines = |low: f64, high: f64| (line(low - 0.5) - 1, line(high + 0.5) + 1);
        let (across, down) = (lines(low.x, high.x), lines(low.y, high.y));
        let is_small = |(from, to): (i32, i32)| to > from && to.saturating_sub(from) <= MOST;
        if !is_small(across) || !is_small(down) {
            return None;
        }
        let mut covers = Covers {
            units: BTreeMap::new(),
            posts: BTreeSet::new(),
            ink: BTreeSet::new(),
            across,
            down,
        };
        let found = leaves::find(strokes, means, grid);
        let is_leaf: BTreeSet<usize> = found
            .iter()
            .flat_map(|l| l.strokes.iter().copied())
            .collect();
        for (k, (stroke, role)) in strokes.iter().zip(means).enumerate() {
            covers.lay(stroke, *role, grid, is_leaf.contains(&k));
        }
        covers.hang(&found);
        Some(covers)
    }

    fn lay(&mut self, stroke: &Stroke, role: Option<Means>, grid: &Grid, is_leaf: bool) {
        let (low, high) = stroke
            .points
            .iter()
            .fold((DVec2::MAX, DVec2::MIN), |(l, h), p| {
                (l.min(grid.units_of(*p)), h.max(grid.units_of(*p)))
            });
        let size = (high - low).max_element();
        let is_bar =
            size < SHORT && role.is_some_and(|m| matches!(m, Means::Glazing | Means::Lattice));
        match role {
            Some(Means::Ignore | Means::Grid) => {}
            Some(Means::Post) => {
                let middle = (low + high) / 2.0;
                self.posts
                    .insert((middle.x.round() as i32, middle.y.round() as i32));
            }
            Some(m) if m == Means::Wall || m.is_opening() || m == Means::Mat => {
                if is_bar {
                    self.bar((low, high));
                }
                if !is_leaf {
                    let is_dash = size < SHORT * 0.7
                        && matches!(m, Means::Door | Means::Slide | Means::Open)
                        && !stroke.is_closed;
                    sides(stroke)
                        .for_each(|side| self.cover(side.map(|p| grid.units_of(p)), m, is_dash));
                }
                if m == Means::Mat {
                    self.ink(stroke, grid);
                }
            }
            _ => self.ink(stroke, grid),
        }
    }

    /// Adds a bar to the units that it may stand on.
    fn bar(&mut self, (low, high): (DVec2, DVec2)) {
        let (middle, size) = ((low + high) / 2.0, high - low);
        for upright in [false, true] {
            let (along, across) = if upright { (1, 0) } else { (0, 1) };
            let line = middle[across].round();
            if size[across] < size[along] * 0.8 || (middle[across] - line).abs() > BAND[1] {
                continue;
            }
            let start = middle[along].floor();
            let tenth = ((middle[along] - start) * 10.0) as u32;
            if (1..9).contains(&tenth) {
                self.unit(start, line, upright).bars |= 1 << tenth;
            }
        }
    }

    fn unit(&mut self, along: f64, line: f64, upright: bool) -> &mut Cover {
        let at = if upright {
            (line as i32, along as i32)
        } else {
            (along as i32, line as i32)
        };
        self.units.entry((at, upright)).or_default()
    }

    /// Covers the units along a side of a stroke.
    fn cover(&mut self, [p, q]: [DVec2; 2], role: Means, is_dash: bool) {
        let way = (q - p).abs();
        let upright = way.y > way.x;
        let (along, across) = if upright { (1, 0) } else { (0, 1) };
        let line = ((p[across] + q[across]) / 2.0).round();
        let off = ((p[across] + q[across]) / 2.0 - line).abs();
        let band = match role {
            Means::Wall => BAND[0],
            Means::Mat => BAND[2],
            _ => BAND[1],
        };
        let lean = if is_dash { 3.0 * LEAN } else { LEAN };
        if way[across] > way[along] * lean || off > band || way[along] == 0.0 {
            return;
        }
        let (limits, lines) = if upright {
            (self.down, self.across)
        } else {
            (self.across, self.down)
        };
        if line < f64::from(lines.0) || line > f64::from(lines.1) {
            return;
        }
        let (from, to) = (
            p[along].min(q[along]).max(f64::from(limits.0)),
            p[along].max(q[along]).min(f64::from(limits.1)),
        );
        let mut start = from.floor();
        while start < to {
            let piece = |at: f64| {
                (((at - start) * f64::from(PIECES))
                    .round()
                    .clamp(0.0, f64::from(PIECES))) as u32
            };
            let (first, end) = (piece(from), piece(to));
            let bits = ((1_u64 << end) - 1) & !((1_u64 << first) - 1);
            let unit = self.unit(start, line, upright);
            if is_dash {
                unit.dashed = (unit.dashed.0 | bits, unit.dashed.1 + 1);
            } else {
                *unit.pieces.entry(role).or_default() |= bits;
            }
            start += 1.0;
        }
    }

    /// Notes the places of a stroke that lies in a room.
    fn ink(&mut self, stroke: &Stroke, grid: &Grid) {
        let ((u0, u1), (v0, v1)) = (self.across, self.down);
        let mut note = |p: DVec2| {
            let is_within = p.x > f64::from(u0)
                && p.x < f64::from(u1)
                && p.y > f64::from(v0)
                && p.y < f64::from(v1);
            if is_within {
                self.ink
                    .insert(((p.x * FINE).floor() as i32, (p.y * FINE).floor() as i32));
            }
        };
        stroke.points.iter().for_each(|p| note(grid.units_of(*p)));
        for [p, q] in sides(stroke) {
            let (p, q) = (grid.units_of(p), grid.units_of(q));
            let steps = (p.distance(q) * 5.0).ceil().min(f64::from(MOST) * 5.0) as u32;
            (1..steps).for_each(|k| note(p.lerp(q, f64::from(k) / f64::from(steps))));
        }
    }

    /// The cells with something in them. What lies near the line between two cells that nothing parts lies in both: names stand
    /// in the middle of rooms, not of cells.
    fn inked(&self) -> BTreeSet<(i32, i32)> {
        let mut cells = BTreeSet::new();
        let parted = |at: At| self.units.get(&at).is_some_and(Cover::is_closed);
        for &(x, y) in &self.ink {
            let at = (dvec2(f64::from(x), f64::from(y)) + 0.5) / FINE;
            let (cell, off) = (at.floor(), at - at.floor());
            let (u, v) = (cell.x as i32, cell.y as i32);
            let side = |off: f64| i32::from(off > 1.0 - MARGIN) - i32::from(off < MARGIN);
            let (right, down) = (side(off.x), side(off.y));
            let (upright, level) = (
                ((u + i32::from(right > 0), v), true),
                ((u, v + i32::from(down > 0)), false),
            );
            let blocked = (right != 0 && parted(upright), down != 0 && parted(level));
            // Strokes along a wall may belong to the wall.
            if blocked.0 || blocked.1 {
                continue;
            }
            cells.extend([(u, v), (u + right, v), (u, v + down)]);
        }
        cells
    }

    /// Puts doors on hinges on their units; where several are possible, on those that close a wall. Each is looked at again when
    /// the others hang.
    fn hang(&mut self, leaves: &[Leaf]) {
        let mut chosen: Vec<Option<&leaves::Place>> = vec![None; leaves.len()];
        for _ in 0..ROUNDS {
            for (leaf, own) in leaves.iter().zip(&mut chosen) {
                for at in own.take().into_iter().flat_map(|place| place.units()) {
                    self.unit_at(at).hung -= 1;
                }
                // Of places that suit equally the one that the leaf leans to.
                *own = leaf
                    .places
                    .iter()
                    .min_by_key(|place| std::cmp::Reverse(self.suits(place)));
                for at in own.iter().flat_map(|place| place.units()) {
                    self.unit_at(at).hung += 1;
                }
            }
        }
        for (leaf, own) in leaves.iter().zip(chosen) {
            let Some(own) = own else { continue };
            let other = leaf
                .places
                .iter()
                .filter(|p| *p != own)
                .map(|p| self.suits(p))
                .max();
            // Its own units are taken by itself.
            let suits = self.suits(own) + TAKEN * own.units().len() as i32;
            if other.is_some_and(|other| other + CLEAR > suits) {
                own.units()
                    .into_iter()
                    .for_each(|at| self.unit_at(at).is_unsure = true);
            }
        }
    }

    fn unit_at(&mut self, at: At) -> &mut Cover {
        self.units.entry(at).or_default()
    }

    /// How much speaks for a door on hinges there: nothing else stands there, posts or walls at its ends.
    fn suits(&self, place: &leaves::Place) -> i32 {
        let is_closed = |at: &At| self.units.get(at).is_some_and(Cover::is_closed);
        let taken = place.units().iter().filter(|u| is_closed(u)).count() as i32;
        let posts = place
            .ends()
            .iter()
            .filter(|p| self.posts.contains(p))
            .count() as i32;
        let goes_on = place.beyond().iter().filter(|u| is_closed(u)).count() as i32;
        let meets = place
            .ends()
            .iter()
            .filter(|p| leaves::around(**p).iter().any(is_closed))
            .count() as i32;
        posts * 3 + goes_on * 2 + meets - taken * TAKEN
    }

    /// The units of the grid as the picture reader has them.
    pub(super) fn units(&self) -> Units {
        let read = |at: At| match self.units.get(&at) {
            Some(unit) if unit.hung > 0 => Read {
                role: Role::Hinged,
                likeness: 1.0,
                lead: if unit.is_unsure { 0.0 } else { 1.0 },
                ink: 0.0,
                unlike: 0.0,
            },
            Some(unit) => unit.read(),
            None => Read::EMPTY,
        };
        let ((u0, u1), (v0, v1)) = (self.across, self.down);
        let level = (v0..=v1)
            .map(|v| (u0..u1).map(|u| read(((u, v), false))).collect())
            .collect();
        let upright = (u0..=u1)
            .map(|u| (v0..v1).map(|v| read(((u, v), true))).collect())
            .collect();
        Units::new((self.across, self.down), level, upright, self.inked())
    }
}
