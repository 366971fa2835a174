//! What the strokes on each unit of the grid stand for: the ink round it beside the symbols of a legend.

use super::grid::{Grid, dark_at};
use super::legend::{Legend, Role, Symbol};
use super::sheet::Ink;
use alike::Walls;
use glam::DVec2;
use learnt::Learnt;
pub use nib::Nib;
use patch::{InkSheet, Patch, Raw};
use rayon::prelude::*;
use runs::{Habits, Line, Sum};
use stamp::Stamp;
use std::collections::BTreeSet;

mod alike;
mod blank;
mod learnt;
mod loose;
mod nib;
mod patch;
mod proof;
mod runs;
mod stamp;
mod tones;

/// Lines of the grid by which the width of the pen is found.
const SAMPLES: usize = 8;
/// Nibs that are tried, by the first guess.
const NIBS: [f64; 4] = [0.8, 1.0, 1.2, 1.5];

/// How far beside their place strokes may lie that belong to a symbol, units.
const BESIDE: f64 = 0.03;

/// What a unit was read as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Read {
    /// What stands there.
    pub role: Role,
    /// How well the ink agrees with the symbol, 0 to 1.
    pub likeness: f64,
    /// How much better than with the best symbol of another role.
    pub lead: f64,
    /// How thick its ink is, units.
    pub ink: f64,
    /// How unlike the walls of the sheet it is: beyond 1 it is none of them.
    pub unlike: f64,
}

impl Read {
    /// Nothing.
    pub const EMPTY: Read = Read {
        role: Role::Empty,
        likeness: 1.0,
        lead: 1.0,
        ink: 0.0,
        unlike: 0.0,
    };
}

/// All units of a grid.
#[derive(Clone, Debug)]
pub struct Units {
    /// The lines of the grid: first and last, to the right.
    pub across: (i32, i32),
    /// The same, downwards.
    pub down: (i32, i32),
    /// Level units, line by line from above.
    level: Vec<Vec<Read>>,
    /// Upright units, line by line from the left.
    upright: Vec<Vec<Read>>,
    /// How well the symbols agree with the ink, 0 to 1.
    pub likeness: f64,
    /// Cells with ink in their middle: writing, mats, what is built in.
    inked: BTreeSet<(i32, i32)>,
    /// How clearly posts stand at the crossings, 0 to 1, line by line from above.
    posts: Vec<Vec<f64>>,
}

impl Units {
    /// Units that were read elsewhere: level ones line by line from above, upright ones from the left; `inked` are cells with
    /// something in them.
    pub fn new(
        (across, down): ((i32, i32), (i32, i32)),
        level: Vec<Vec<Read>>,
        upright: Vec<Vec<Read>>,
        inked: BTreeSet<(i32, i32)>,
    ) -> Units {
        Units {
            across,
            down,
            level,
            upright,
            likeness: 1.0,
            inked,
            posts: Vec::new(),
        }
    }

    /// The same, with what lies in the cells.
    #[must_use]
    pub fn with_cells(self, ink: &Ink, grid: &Grid) -> Units {
        Units {
            inked: inked(ink, grid),
            ..self
        }
    }

    /// Takes walls of less ink for edges of mats.
    #[must_use]
    pub fn without_thin_walls(mut self, least: f64) -> Units {
        let all = self.level.iter_mut().chain(&mut self.upright).flatten();
        for read in all.filter(|read| read.role == Role::Wall && read.ink < least) {
            read.role = Role::Mat;
        }
        self
    }

    /// Takes units for edges of mats: the crossings at which they begin, and whether they run downwards.
    #[must_use]
    pub fn with_mats(mut self, units: &[((i32, i32), bool)]) -> Units {
        for &((u, v), upright) in units {
            let (across, down) = ((u - self.across.0) as usize, (v - self.down.0) as usize);
            let read = match upright {
                true => &mut self.upright[across][down],
                false => &mut self.level[down][across],
            };
            read.role = Role::Mat;
        }
        self
    }

    /// Whether there is ink in the middle of the cell below and to the right of a crossing.
    pub fn is_inked(&self, cell: (i32, i32)) -> bool {
        self.inked.contains(&cell)
    }

    /// How clearly a post stands at a crossing, 0 to 1.
    pub fn post(&self, (u, v): (i32, i32)) -> f64 {
        let line = usize::try_from(v - self.down.0).ok();
        let line = line.and_then(|line| self.posts.get(line));
        let post = line.and_then(|l| l.get(usize::try_from(u - self.across.0).ok()?));
        post.copied().unwrap_or(0.0)
    }

    /// The unit that begins at a crossing and runs to the right.
    pub fn level(&self, u: i32, v: i32) -> Read {
        look(&self.level, v - self.down.0, u - self.across.0)
    }

    /// The unit that begins at a crossing and runs downwards.
    pub fn upright(&self, u: i32, v: i32) -> Read {
        look(&self.upright, u - self.across.0, v - self.down.0)
    }
}

fn look(lines: &[Vec<Read>], line: i32, at: i32) -> Read {
    let line = usize::try_from(line).ok().and_then(|l| lines.get(l));
    let unit = line.and_then(|l| usize::try_from(at).ok().and_then(|a| l.get(a)));
    unit.copied().unwrap_or(Read::EMPTY)
}

/// The ink along a line of the grid, unit by unit, and how clearly posts stand between them.
struct Strip {
    patches: Vec<Patch>,
    posts: Vec<f64>,
}

/// All lines of a grid as they were sampled, whatever legend they are read by.
pub struct Lines {
    sides: [Vec<RawStrip>; 2],
}

struct RawStrip {
    units: Vec<Raw>,
    posts: Vec<f64>,
}

impl Lines {
    /// Level and upright lines; `ink` is that of walls, `all` has what slants too.
    pub fn of(ink: &Ink, all: &Ink, grid: &Grid) -> Lines {
        let ((u0, u1), (v0, v1)) = (grid.across, grid.down);
        let sheet = InkSheet::new(ink, all);
        let post = |(u, v): (i32, i32)| sheet.post(grid, DVec2::new(f64::from(u), f64::from(v)));
        let (wide, high) = ((u1 - u0) as usize + 1, (v1 - v0) as usize + 1);
        let posts: Vec<f64> = (0..wide * high)
            .into_par_iter()
            .map(|k| post((u0 + (k % wide) as i32, v0 + (k / wide) as i32)))
            .collect();
        let strip = |from: (i32, i32), count: i32, upright: bool| {
            let at = |k: i32| match upright {
                true => (from.0, from.1 + k),
                false => (from.0 + k, from.1),
            };
            let unit = |k: i32| {
                let from = DVec2::new(f64::from(at(k).0), f64::from(at(k).1));
                Raw::of(&sheet, grid, from, upright)
            };
            let post = |k: i32| posts[(at(k).1 - v0) as usize * wide + (at(k).0 - u0) as usize];
            RawStrip {
                units: (0..count).map(unit).collect(),
                posts: (0..=count).map(post).collect(),
            }
        };
        let level = (v0..=v1).map(|v| ((u0, v), u1 - u0, false));
        let lines: Vec<_> = level
            .chain((u0..=u1).map(|u| ((u, v0), v1 - v0, true)))
            .collect();
        let strips = lines.par_iter();
        let mut level: Vec<RawStrip> = strips.map(|line| strip(line.0, line.1, line.2)).collect();
        let upright = level.split_off((v1 - v0) as usize + 1);
        Lines {
            sides: [level, upright],
        }
    }

    /// How far strokes sway within a unit, at the quarter of all from the straightest on, units: leaves that change sides seem to
    /// sway most, strokes by hand all do, those along a ruler hardly.
    pub fn sway(&self) -> f64 {
        let units = self.sides.iter().flatten().flat_map(|strip| &strip.units);
        let mut all: Vec<f64> = units.filter_map(Raw::sway).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 4).copied().unwrap_or(0.0)
    }

    fn strips(&self, legend: &Legend) -> [Vec<Strip>; 2] {
        let reach = legend.is_by_hand.then(|| reach(legend));
        self.sides.each_ref().map(|side| {
            let strip = |raw: &RawStrip| Strip {
                patches: raw.units.iter().map(|r| Patch::of(r, reach)).collect(),
                posts: raw.posts.clone(),
            };
            side.iter().map(strip).collect()
        })
    }
}

/// How far from the lines of the grid the strokes of panes and leaves lie: with one of them left out, the middle of the others would
/// be beside the line.
fn reach(legend: &Legend) -> f64 {
    let is_lines = |s: &&Symbol| matches!(s.role, Role::Window | Role::Slide);
    let spreads = legend.symbols.iter().filter(is_lines).map(|s| s.spread[1]);
    spreads.fold(0.0, f64::max) + BESIDE
}

/// The nib under which the symbols of a legend agree best with the fullest lines of a sheet.
fn fitting(strips: &[Vec<Strip>; 2], legend: &Legend, nib: Nib) -> Nib {
    let ink = |s: &Strip| s.patches.iter().filter(|p| p.is_inked).count();
    let mut fullest: Vec<&Strip> = strips.iter().flatten().collect();
    fullest.sort_by_key(|s| std::cmp::Reverse(ink(s)));
    fullest.truncate(SAMPLES);
    let agreement = |nib: Nib| {
        let stamps = stamp::stamps(legend, nib);
        let none = Habits::none(&stamps);
        let sum = |strip: &&Strip| -> f64 {
            let runs = Line::of(strip, &stamps, nib).best(&stamps, &none);
            runs.iter().map(runs::Run::agreement).sum()
        };
        fullest.iter().map(sum).sum::<f64>()
    };
    let tried = NIBS.map(|factor| (nib.wider(factor), agreement(nib.wider(factor))));
    let best = tried
        .into_iter()
        .reduce(|a, b| if b.1 > a.1 { b } else { a });
    best.map_or(nib, |b| b.0)
}

/// What a sheet is drawn with.
pub fn pen(ink: &Ink, grid: &Grid) -> Nib {
    Nib::of(ink, grid)
}

/// A first look at all lines of a grid by a legend.
pub struct Look {
    /// How well the symbols of the legend agree with the ink, 0 to 1.
    pub likeness: f64,
    /// How many of the strips are level.
    rows: usize,
    strips: Vec<Strip>,
    stamps: Vec<Stamp>,
    lines: Vec<Line>,
    habits: Habits,
    nib: Nib,
}

impl Look {
    /// Looks at the units of a grid by a legend; `nib` is about what it is drawn with.
    pub fn of(lines: &Lines, legend: &Legend, nib: Nib) -> Look {
        let strips = lines.strips(legend);
        let nib = fitting(&strips, legend, nib);
        let stamps = stamp::stamps(legend, nib);
        let rows = strips[0].len();
        let strips: Vec<Strip> = strips.into_iter().flatten().collect();
        let lines: Vec<Line> = strips.iter().map(|s| Line::of(s, &stamps, nib)).collect();
        let habits = habits(&lines, &stamps);
        let mut sum = Sum::default();
        for line in &lines {
            line.reads(&line.best(&stamps, &habits), &mut sum);
        }
        Look {
            likeness: sum.mean(),
            rows,
            strips,
            stamps,
            lines,
            habits,
            nib,
        }
    }

    /// The share of ink on lines of the grid that is red in walls and openings with red strokes.
    pub fn red(&self) -> f64 {
        if self.stamps.iter().all(|stamp| !stamp.is_red) {
            return 0.0;
        }
        let (mut red, mut all) = (0.0, 0.0);
        let of_red = |p: &Patch| f64::from(p.reds[3]);
        for (strip, line) in self.strips.iter().zip(&self.lines) {
            let inked = strip.patches.iter().filter(|p| p.is_inked);
            all += inked
                .map(|p| of_red(p) + f64::from(p.blacks[3]))
                .sum::<f64>();
            for run in line.best(&self.stamps, &self.habits) {
                let is_red = |k: usize| self.stamps[k].is_red && self.stamps[k].role.parts();
                let units = run
                    .stamp()
                    .filter(|(k, _)| is_red(*k))
                    .map(|(_, units)| units);
                let patches = units.map_or(&[][..], |units| &strip.patches[units]);
                red += patches.iter().map(of_red).sum::<f64>();
            }
        }
        if all > 0.0 { red / all } else { 0.0 }
    }

    /// Compares all units with the walls of the sheet, those of each direction for themselves: lines lie otherwise between its
    /// pixels.
    fn compare(&mut self) {
        let none = Sum::default;
        let reads = |line: &Line| line.reads(&line.best(&self.stamps, &self.habits), &mut none());
        let reads: Vec<Vec<Read>> = self.lines.iter().map(reads).collect();
        let of = |strips: std::ops::Range<usize>| {
            let both = strips.flat_map(|k| reads[k].iter().zip(&self.strips[k].patches));
            let walls = both.filter(|(read, _)| read.role == Role::Wall);
            let walls: Vec<&Patch> = walls.map(|w| w.1).collect();
            Walls::of(&walls)
        };
        let all = self.strips.len();
        let walls = [of(0..self.rows), of(self.rows..all)].map(|own| own.or_else(|| of(0..all)));
        for (k, (strip, line)) in self.strips.iter().zip(&mut self.lines).enumerate() {
            if let Some(walls) = &walls[usize::from(k >= self.rows)] {
                line.compare(strip, walls);
            }
        }
        self.habits = habits(&self.lines, &self.stamps);
    }

    /// The second look, at how this sheet itself draws things, and what it finds.
    pub fn units(mut self, grid: &Grid) -> Units {
        self.compare();
        let mut learnt = Learnt::default();
        for (strip, line) in self.strips.iter().zip(&self.lines) {
            for run in line.best(&self.stamps, &self.habits) {
                learnt.take(&run, &strip.patches, &self.stamps);
            }
        }
        let first = self.stamps.len();
        self.stamps.extend(learnt.stamps(&self.stamps));
        for (strip, line) in self.strips.iter().zip(&mut self.lines) {
            line.extend(strip, &self.stamps[first..], self.nib);
        }
        self.habits.own(&self.stamps, first);
        let reads = |line: &Line| {
            let runs = line.best(&self.stamps, &self.habits);
            line.reads(&runs, &mut Sum::default())
        };
        let mut level: Vec<Vec<Read>> = self.lines.iter().map(reads).collect();
        let upright = level.split_off(self.rows);
        let mut lines = [level, upright];
        settle(&mut lines);
        let posts = self.strips[..self.rows].iter().map(|s| s.posts.clone());
        let posts: Vec<Vec<f64>> = posts.collect();
        loose::remove(&mut lines, &posts);
        loose::remove_chains(&mut lines, &posts);
        let [level, upright] = lines;
        Units {
            across: grid.across,
            down: grid.down,
            level,
            upright,
            likeness: self.likeness,
            inked: BTreeSet::new(),
            posts,
        }
    }
}

/// One hand draws one thing in one way: what a first look finds often is likelier at the second.
fn habits(lines: &[Line], stamps: &[Stamp]) -> Habits {
    let mut habits = Habits::none(stamps);
    for line in lines {
        let runs = line.best(stamps, &habits);
        runs.iter().for_each(|run| habits.note(run));
    }
    habits.settle(stamps);
    habits
}

/// A plan has more walls than ways without doors: where the two are drawn alike, what was read as ways are walls.
fn settle(lines: &mut [Vec<Vec<Read>>; 2]) {
    let count = |role: Role| {
        lines
            .iter()
            .flatten()
            .flatten()
            .filter(|r| r.role == role)
            .count()
    };
    if count(Role::Open) > count(Role::Wall) {
        for read in lines
            .iter_mut()
            .flatten()
            .flatten()
            .filter(|r| r.role == Role::Open)
        {
            read.role = Role::Wall;
        }
    }
}

/// Cells with more ink in their middle than specks.
fn inked(ink: &Ink, grid: &Grid) -> BTreeSet<(i32, i32)> {
    const SAMPLES: i32 = 24;
    let mut out = BTreeSet::new();
    for v in grid.down.0..grid.down.1 {
        for u in grid.across.0..grid.across.1 {
            let inside = |k: i32| 0.2 + 0.6 * (f64::from(k) + 0.5) / f64::from(SAMPLES);
            let places = (0..SAMPLES * SAMPLES).map(|k| {
                grid.at(
                    f64::from(u) + inside(k % SAMPLES),
                    f64::from(v) + inside(k / SAMPLES),
                )
            });
            if places.filter(|p| dark_at(ink, *p) > ink.threshold).count() >= 8 {
                out.insert((u, v));
            }
        }
    }
    out
}
