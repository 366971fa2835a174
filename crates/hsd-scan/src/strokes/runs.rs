//! What runs of wall stand for: units of a line between posts are of one kind, drawn in one way.

use super::super::legend::Role;
use super::alike::Walls;
use super::patch::Patch;
use super::proof::{NOISE, Proof};
use super::stamp::{Stamp, emptiness};
use super::{Nib, Read, Strip};

/// What agrees less with every symbol is none: writing, hatching, things that stand in a room.
const CLUTTER: f64 = 0.5;
/// What the beginning of another run costs where no post stands, in shares of a unit.
const CHANGE: f64 = 0.12;
/// The same at a post.
const AT_POST: f64 = 0.02;
/// What an end of a wall without a post costs.
const NO_POST: f64 = 0.1;
/// The longest run of one kind that is tried, units.
const LONGEST: usize = 8;
/// What a way to draw costs that the sheet has nowhere else.
const STRANGE: f64 = 0.2;
/// The share of all runs of a role from which on a way to draw is a habit.
const USUAL: f64 = 0.3;

/// How well a run has to agree, and by how much better than with another role, so that the sheet's own way to draw is learnt
/// from it.
const LEARNT: f64 = 0.7;
const LEARNT_LEAD: f64 = 0.06;
/// How much the score of a reading as a wall is lowered where the unit differs from the other walls of the sheet.
const UNLIKE: f64 = 0.3;
/// From how many times the bound on that counts, and how much farther it counts whole; before that there is doubt alone.
const FARTHER: f64 = 1.2;
const SURELY: f64 = 0.4;
/// What it costs to be drawn otherwise than the sheet draws the same thing elsewhere.
const FOREIGN: f64 = 0.15;

/// What it counts that a symbol agrees better than itself in a mirror.
const CLEAR: f64 = 1.0;
/// How much better it has to.
const LEAST_CLEAR: f64 = 0.05;
/// What it counts that what tells a symbol from others is there.
const PROOF: f64 = 0.2;
/// How much of it has to be there.
const NEEDED: f64 = 0.4;

/// What it counts: against a symbol at once, for it only where it agrees with the ink at all.
fn proven(mean: f64, shown: f64) -> f64 {
    let over = shown.clamp(-NEEDED, 1.0 - NEEDED);
    let agrees = ((mean - CLUTTER) / 0.25).clamp(0.0, 1.0);
    PROOF * if over > 0.0 { over * agrees } else { over }
}

/// A run of units of one kind, and the next best kind beside it.
#[derive(Clone, Copy)]
pub(super) struct Run {
    from: usize,
    end: usize,
    role: Role,
    stamp: Option<usize>,
    value: f64,
    lead: f64,
}

impl Run {
    /// The stamp that it was read by, and its units.
    pub(super) fn stamp(&self) -> Option<(usize, std::ops::Range<usize>)> {
        self.stamp.map(|k| (k, self.from..self.end))
    }

    /// The same, if there is no doubt of it.
    pub(super) fn clear(&self) -> Option<(usize, std::ops::Range<usize>)> {
        let is_clear = self.value > LEARNT && self.lead > LEARNT_LEAD;
        self.stamp().filter(|_| is_clear)
    }

    /// How much better than clutter it agrees with the ink.
    pub(super) fn agreement(&self) -> f64 {
        match self.stamp {
            Some(_) => (self.end - self.from) as f64 * (self.value - CLUTTER).max(0.0),
            None => 0.0,
        }
    }
}

/// What each way to draw costs, by stamps.
pub(super) struct Habits {
    weights: Vec<f64>,
    costs: Vec<f64>,
}

impl Habits {
    /// Before anything is known of a sheet.
    pub(super) fn none(stamps: &[Stamp]) -> Habits {
        Habits {
            weights: vec![0.0; stamps.len()],
            costs: vec![0.0; stamps.len()],
        }
    }

    /// Draws the conclusion of what the sheet itself shows, from a place in the list of stamps on: where its own way to draw
    /// walls is known, other ways are less likely. Mats and doors are drawn in several ways on one sheet.
    pub(super) fn own(&mut self, stamps: &[Stamp], first: usize) {
        let is_wall = |s: &Stamp| s.role == Role::Wall;
        let is_known = stamps[first..].iter().any(is_wall);
        for (stamp, cost) in stamps[..first].iter().zip(&mut self.costs) {
            *cost += if is_known && is_wall(stamp) {
                FOREIGN
            } else {
                0.0
            };
        }
        self.costs.resize(stamps.len(), 0.0);
        self.weights.resize(stamps.len(), 0.0);
    }

    pub(super) fn note(&mut self, run: &Run) {
        if let Some(stamp) = run.stamp {
            self.weights[stamp] += run.agreement();
        }
    }

    /// Draws the conclusion: a symbol in a spread, or the ones beside it, by its share of all that stand for its role.
    pub(super) fn settle(&mut self, stamps: &[Stamp]) {
        for (k, stamp) in stamps.iter().enumerate() {
            let of_role = |s: &Stamp| s.role == stamp.role;
            let alike =
                |s: &Stamp| s.kind.0 == stamp.kind.0 && s.kind.1.abs_diff(stamp.kind.1) <= 1;
            let sum = |is: &dyn Fn(&Stamp) -> bool| {
                stamps
                    .iter()
                    .zip(&self.weights)
                    .filter(|(s, _)| is(s))
                    .map(|(_, w)| w)
                    .sum::<f64>()
            };
            let (mine, all) = (sum(&alike), sum(&of_role));
            let share = if all > 0.0 { mine / all } else { 1.0 };
            self.costs[k] = STRANGE * (1.0 - share / USUAL).max(0.0);
        }
    }
}

/// How well symbols explain the ink of a sheet.
#[derive(Default)]
pub(super) struct Sum {
    likeness: f64,
    units: f64,
}

impl Sum {
    pub(super) fn mean(&self) -> f64 {
        if self.units > 0.0 {
            self.likeness / self.units
        } else {
            0.0
        }
    }
}

/// A line of units and how well each of them agrees with each stamp.
pub(super) struct Line {
    /// How clearly posts stand between them.
    posts: Vec<f64>,
    /// How empty they are.
    empty: Vec<f64>,
    /// How thick the ink on them is, units.
    ink: Vec<f64>,
    /// How unlike the walls of the sheet they are: beyond 1 they are none (`alike`).
    unlike: Vec<f64>,
    /// For each unit that has ink, stamp after stamp and unit after unit of it; with what it shows of proof.
    likeness: Vec<Vec<(f32, [f32; 2])>>,
}

/// The likeness of each stamp to a run that grows unit by unit.
struct Means<'a> {
    stamps: &'a [Stamp],
    units: usize,
    /// True if each unit has ink.
    is_inked: bool,
    sums: Vec<Mean>,
}

/// The likeness of a stamp to a run.
#[derive(Clone, Copy)]
struct Mean {
    likeness: f64,
    /// The proof that each half shows where the stamp is drawn for the last time.
    shown: [f64; 2],
    /// The least share of proof of each half of each time that it is drawn.
    least: f64,
}

impl Mean {
    const NONE: Mean = Mean {
        likeness: 0.0,
        shown: [0.0; 2],
        least: f64::INFINITY,
    };
}

impl Means<'_> {
    fn of(stamps: &[Stamp]) -> Means<'_> {
        Means {
            stamps,
            units: 0,
            is_inked: true,
            sums: vec![Mean::NONE; stamps.len()],
        }
    }

    /// Begins another run.
    fn clear(&mut self) {
        (self.units, self.is_inked) = (0, true);
        self.sums.fill(Mean::NONE);
    }

    /// Adds a unit, given as in [`Line::likeness`].
    fn add(&mut self, likeness: &[(f32, [f32; 2])]) {
        self.is_inked &= !likeness.is_empty();
        if !self.is_inked {
            return;
        }
        let mut first = 0;
        for (stamp, sum) in self.stamps.iter().zip(&mut self.sums) {
            let (likeness, shown) = likeness[first + self.units % stamp.units];
            first += stamp.units;
            sum.likeness += f64::from(likeness);
            if let Some(Proof { whole, .. }) = &stamp.proof {
                let halves = sum.shown.iter_mut().zip(shown);
                halves.for_each(|(sum, shown)| *sum += f64::from(shown));
                if (self.units + 1).is_multiple_of(stamp.units) {
                    for (shown, whole) in sum.shown.iter().zip(whole) {
                        let share = (shown - NEEDED * whole) / (whole + NOISE);
                        sum.least = sum.least.min(share);
                    }
                    sum.shown = [0.0; 2];
                }
            }
        }
        self.units += 1;
    }

    /// Returns the mean likeness of a stamp and its least share of proof, if the stamp is drawn a whole number of times.
    fn get(&self, k: usize) -> Option<(f64, Option<f64>)> {
        let (stamp, sum) = (&self.stamps[k], &self.sums[k]);
        let is_whole = self.units.is_multiple_of(stamp.units);
        let least = stamp.proof.as_ref().map(|_| sum.least);
        is_whole.then(|| (sum.likeness / self.units as f64, least))
    }
}

impl Line {
    pub(super) fn of(strip: &Strip, stamps: &[Stamp], nib: Nib) -> Line {
        let patches = &strip.patches;
        let all = |patch: &Patch| {
            stamps
                .iter()
                .flat_map(|s| (0..s.units).map(|unit| s.likeness(unit, patch, nib)))
                .map(|(likeness, proof)| (likeness as f32, proof))
                .collect()
        };
        Line {
            posts: strip.posts.clone(),
            ink: patches.iter().map(Patch::thickness).collect(),
            unlike: vec![0.0; patches.len()],
            empty: patches
                .iter()
                .map(|p| emptiness(p, nib).max(CLUTTER))
                .collect(),
            // Most of a sheet is empty, and no symbol stands there.
            likeness: patches
                .iter()
                .map(|p| if p.is_inked { all(p) } else { Vec::new() })
                .collect(),
        }
    }

    /// Adds how well its units agree with more stamps.
    pub(super) fn extend(&mut self, strip: &Strip, stamps: &[Stamp], nib: Nib) {
        for (patch, all) in strip.patches.iter().zip(&mut self.likeness) {
            if patch.is_inked {
                let units = stamps
                    .iter()
                    .flat_map(|s| (0..s.units).map(|unit| s.likeness(unit, patch, nib)));
                all.extend(units.map(|(likeness, proof)| (likeness as f32, proof)));
            }
        }
    }

    /// Tells how unlike the walls of the sheet its units are.
    pub(super) fn compare(&mut self, strip: &Strip, walls: &Walls) {
        self.unlike = strip.patches.iter().map(|p| walls.unlike(p)).collect();
    }

    /// The runs that agree best with its ink and its posts (dynamic programming over their ends).
    pub(super) fn best(&self, stamps: &[Stamp], habits: &Habits) -> Vec<Run> {
        let n = self.empty.len();
        let mut table: Vec<Option<(f64, Run)>> = vec![None; n + 1];
        let mut means = Means::of(stamps);
        for from in 0..n {
            let before = match from {
                0 => 0.0,
                _ => table[from].map_or(f64::MIN, |t| t.0),
            };
            means.clear();
            for (unit, likeness) in self.likeness.iter().enumerate().skip(from).take(LONGEST) {
                let end = unit + 1;
                means.add(likeness);
                let run = self.run(from, end, &means, habits);
                let total = before + run.value * (end - from) as f64 - CHANGE
                    + (CHANGE - AT_POST) * self.posts[from];
                if table[end].is_none_or(|t| total > t.0) {
                    table[end] = Some((total, run));
                }
            }
        }
        let mut runs = Vec::new();
        let mut end = n;
        while let Some((_, run)) = table[end] {
            runs.push(run);
            end = run.from;
        }
        runs
    }

    /// The best way to read a run.
    fn run(&self, from: usize, end: usize, means: &Means<'_>, habits: &Habits) -> Run {
        let length = (end - from) as f64;
        let mut best: Vec<(Role, f64, Option<usize>)> = vec![(
            Role::Empty,
            self.empty[from..end].iter().sum::<f64>() / length,
            None,
        )];
        let bare_ends = NO_POST * (2.0 - self.posts[from] - self.posts[end]) / length;
        let beyond = |unlike: &f64| ((unlike - FARTHER) / SURELY).clamp(0.0, 1.0);
        let unlike = self.unlike[from..end].iter().map(beyond).sum::<f64>();
        let unlike = UNLIKE * unlike / length;
        if means.is_inked {
            for (k, stamp) in means.stamps.iter().enumerate() {
                let Some((mean, shown)) = means.get(k) else {
                    continue;
                };
                let proof = shown.map_or(0.0, |s| proven(mean, s));
                let against = stamp
                    .mirrored
                    .and_then(|m| means.get(k.wrapping_add_signed(m)));
                let proof = proof + against.map_or(0.0, |a| CLEAR * (mean - a.0 - LEAST_CLEAR));
                let bare = if stamp.role.parts() { bare_ends } else { 0.0 };
                let foreign = if stamp.role == Role::Wall {
                    unlike
                } else {
                    0.0
                };
                let value = mean + proof - habits.costs[k] - stamp.cost - bare - foreign;
                match best.iter_mut().find(|b| b.0 == stamp.role) {
                    Some(b) if b.1 >= value => {}
                    Some(b) => (b.1, b.2) = (value, Some(k)),
                    None => best.push((stamp.role, value, Some(k))),
                }
            }
        }
        best.sort_by(|a, b| b.1.total_cmp(&a.1));
        let lead = best[0].1 - best.get(1).map_or(0.0, |b| b.1);
        let (role, value, stamp) = best[0];
        Run {
            from,
            end,
            role,
            stamp,
            value,
            lead,
        }
    }

    /// The units of runs; `sum` gathers how well they agree.
    pub(super) fn reads(&self, runs: &[Run], sum: &mut Sum) -> Vec<Read> {
        let mut out = vec![Read::EMPTY; self.empty.len()];
        for run in runs {
            let units = out[run.from..run.end].iter_mut();
            let marks = self.ink[run.from..run.end]
                .iter()
                .zip(&self.unlike[run.from..run.end]);
            for (read, (ink, unlike)) in units.zip(marks) {
                *read = Read {
                    role: run.role,
                    likeness: run.value.clamp(0.0, 1.0),
                    lead: run.lead,
                    ink: *ink,
                    unlike: *unlike,
                };
            }
            // What is empty agrees with any legend.
            let inked = (run.from..run.end)
                .filter(|k| !self.likeness[*k].is_empty() && self.empty[*k] < 0.6);
            let count = inked.count() as f64;
            sum.likeness += count * run.value;
            sum.units += count;
        }
        out
    }
}
