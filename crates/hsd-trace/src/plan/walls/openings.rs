//! The pieces of each wall: plain walls, doors, windows, open ways.

use super::gaps::Gap;
use super::graph::{Graph, Line};
use super::swing;
use super::{Divided, Stuff};
use crate::plan::legend::Role;
use glam::{DVec2, dvec2};

/// The least length of a piece of a wall, in thicknesses of walls.
const LEAST: f64 = 1.0;
/// The distances from a line within which its wall is looked for, and a colour over it, in thicknesses of walls.
const REACHES: [f64; 2] = [0.75, 1.5];
/// The least width of an opening, metres. Narrower pieces join those beside them.
const NARROWEST: f64 = 0.25;

/// A piece of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The end along the wall, pixels from the first end of the wall.
    pub to: f64,
    /// The role.
    pub role: Role,
    /// True if nothing that is drawn shows it.
    pub is_doubtful: bool,
}

/// Returns the openings with a swinging door: their widths, pixels.
pub fn swinging(divided: &Divided) -> Vec<f64> {
    let mut doors: Vec<&Gap> = divided
        .gaps
        .iter()
        .filter(|gap| swings(divided, gap))
        .collect();
    // Both walls beside an opening have found it.
    doors.sort_by_key(|gap| (gap.bar.upright, gap.bar.along, gap.bar.across));
    doors.dedup_by_key(|gap| (gap.bar.upright, gap.bar.along));
    doors.into_iter().map(Gap::length).collect()
}

/// Returns the pieces of a wall, from its first end on. `metres` is the length of a pixel.
pub fn pieces((divided, graph): (&Divided, &Graph), line: &Line, metres: f64) -> Vec<Piece> {
    let [a, b] = line.ends.map(|k| graph.corners[k]);
    let length = a.distance(b);
    let steps = length.ceil().max(1.0) as usize;
    let ahead = (b - a) / steps as f64;
    let side = ahead.normalize_or_zero().perp();
    let [reach, aside] = REACHES.map(|share| (divided.strokes.usual * share).max(2.0) as i32);
    let kinds = (0..steps).map(|k| {
        let at = a + ahead * (k as f64 + 0.5);
        let within = |stuff: Stuff, reach: i32| {
            let near = (-reach..=reach).map(|d| at + side * f64::from(d));
            let mut near = near.filter_map(|p| divided.stuff.get(p.x as isize, p.y as isize));
            near.any(|s| s == stuff)
        };
        if within(Stuff::Tinted, aside) {
            return Stuff::Tinted;
        }
        let first = [Stuff::Wall, Stuff::Gap, Stuff::Chord, Stuff::Thin];
        let kind = first.into_iter().find(|s| within(*s, reach));
        kind.unwrap_or(Stuff::Chord)
    });
    let scale = length / steps as f64;
    let least = (LEAST * divided.strokes.usual).max(3.0);
    let narrowest = NARROWEST / metres;
    let runs = runs(kinds, |kind| match kind {
        Stuff::Wall => least / scale,
        _ => least.max(narrowest) / scale,
    });
    let is_outer = line.rooms.contains(&0);
    let mut from = 0.0;
    let mut out = vec![];
    for (end, kind) in runs {
        let to = end as f64 * scale;
        let middle = a + (b - a) * ((from + to) / 2.0 / length);
        let (role, is_doubtful) = match kind {
            Stuff::Wall => (Role::Wall, false),
            // An opening is shorter than its wall: a colour along the whole wall says nothing.
            Stuff::Tinted if from == 0.0 && end == steps => (Role::Wall, false),
            Stuff::Tinted => (if is_outer { Role::Window } else { Role::Slide }, !is_outer),
            Stuff::Thin => (if is_outer { Role::Window } else { Role::Slide }, false),
            Stuff::Gap => opening(divided, middle, is_outer),
            Stuff::Chord | Stuff::Free => (Role::Open, true),
        };
        out.push(Piece {
            to,
            role,
            is_doubtful,
        });
        from = to;
    }
    out
}

/// Returns the ends of runs of one kind; those that are too short belong to what is beside them.
fn runs(kinds: impl Iterator<Item = Stuff>, least: impl Fn(Stuff) -> f64) -> Vec<(usize, Stuff)> {
    let mut runs: Vec<(usize, Stuff)> = vec![];
    let put = |runs: &mut Vec<(usize, Stuff)>, end: usize, kind: Stuff| match runs.last_mut() {
        Some(last) if last.1 == kind => last.0 = end,
        _ => runs.push((end, kind)),
    };
    for (k, kind) in kinds.enumerate() {
        put(&mut runs, k + 1, kind);
    }
    loop {
        let length = |k: usize| runs[k].0 - if k == 0 { 0 } else { runs[k - 1].0 };
        let short = (0..runs.len()).filter(|k| (length(*k) as f64) < least(runs[*k].1));
        let Some(k) = short.min_by_key(|k| length(*k)).filter(|_| runs.len() > 1) else {
            return runs;
        };
        if k > 0 {
            runs[k - 1].0 = runs[k].0;
        }
        runs.remove(k);
        let before = std::mem::take(&mut runs);
        before
            .into_iter()
            .for_each(|(end, kind)| put(&mut runs, end, kind));
    }
}

/// Returns what an opening is.
fn opening(divided: &Divided, at: DVec2, is_outer: bool) -> (Role, bool) {
    let distance = |gap: &&Gap| {
        let [x, y] = [gap.bar.along, gap.bar.across].map(|[a, b]| (a + b) as f64 / 2.0);
        let middle = if gap.bar.upright {
            dvec2(y, x)
        } else {
            dvec2(x, y)
        };
        middle.distance(at)
    };
    let nearest = divided
        .gaps
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let Some(gap) = nearest else {
        return (Role::Open, true);
    };
    if swings(divided, gap) {
        return (Role::Hinged, false);
    }
    match (gap.drawn > 0.6, is_outer) {
        (true, true) => (Role::Window, false),
        (true, false) => (Role::Slide, false),
        (false, true) => (Role::Open, true),
        (false, false) => (Role::Open, false),
    }
}

fn swings(divided: &Divided, gap: &Gap) -> bool {
    swing::swings(&divided.strokes, &gap.bar, divided.diagonal)
}
