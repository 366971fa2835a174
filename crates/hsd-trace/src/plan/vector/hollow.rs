//! Fills the hollow walls of a drawing: two parallel lines with nothing between.
//!
//! Axes are removed first: lines along the middle of walls that run beyond them. Windows and sliding doors have frames about as wide
//! as a wall. The lines inside a frame stop at its ends, and the spaces between them are left empty.

use super::fit::sides;
use super::lines::{Lines, Stroke};
use super::roles::Means;
use crate::plan::thicknesses::Thicknesses;
use glam::DVec2;
use std::collections::BTreeSet;

/// The greatest angle between parallel lines, radians.
const PARALLEL: f64 = 8e-3;
/// The greatest distance of two places that count as the same, as a share of the diagonal of the drawing.
const SAME: f64 = 5e-5;
/// The least and greatest distance of the two lines of a wall, as shares of the diagonal.
const APART: [f64; 2] = [1e-3, 0.03];
/// The least length of a wall where its thickness is measured, in its thickness.
const LONG: f64 = 2.5;
/// The thinnest and thickest walls of a plan, in thicknesses of most walls.
const KINDS: [f64; 2] = [0.55, 2.2];
/// The thinnest and thickest walls where the walls are known.
const KNOWN: [f64; 2] = [0.3, 3.5];
/// The narrowest and widest frame, in thicknesses of most walls.
const FRAMES: [f64; 2] = [0.5, 1.2];
/// The least share of the length of all lines that belongs to hollow walls and frames, if a drawing has them.
const LEAST: f64 = 0.35;
/// The most lines. A drawing with more is not searched, so that time stays bounded.
const MOST_LINES: usize = 20_000;
/// The number of neighbours with which each line is tried as a wall.
const MOST_BETWEEN: usize = 100;

/// Fills the hollow walls of a drawing and removes their axes; leaves a drawing without such walls unchanged.
///
/// `means` has the meanings of all strokes if they are known. Then only those of walls are filled.
pub(in crate::plan) fn fill(lines: &mut Lines, means: Option<&[Means]>) {
    let is_wall = |k: usize| means.is_none_or(|means| means.get(k) == Some(&Means::Wall));
    let strokes = &lines.strokes;
    let Some(diagonal) = diagonal(strokes) else {
        return;
    };
    let same = SAME * diagonal;
    let apart = APART.map(|share| share * diagonal);
    let mut sides = directions(strokes, &is_wall);
    sides.iter_mut().for_each(|side| side.join(same));
    if sides.iter().map(|side| side.lines.len()).sum::<usize>() > MOST_LINES {
        return;
    }
    let axes: BTreeSet<usize> = sides
        .iter_mut()
        .flat_map(|side| side.take_axes(apart, same))
        .collect();
    let measured = sides.iter().flat_map(|side| side.walls(apart, same, LONG));
    let thicknesses = Thicknesses::of(measured.map(|wall| (wall.apart(), wall.length())));
    let Some((usual, length)) = thicknesses.commonest() else {
        return;
    };
    let frames = |side: &Side| side.frames(FRAMES.map(|ratio| ratio * usual), same);
    let framed: Vec<Vec<Pair>> = sides.iter().map(frames).collect();
    let found = length + framed.iter().flatten().map(Pair::length).sum::<f64>();
    let all = sides.iter().flat_map(|side| &side.lines);
    if means.is_none() && 2.0 * found < LEAST * all.map(Line::length).sum::<f64>() {
        return;
    }
    let mut walls = vec![];
    for (side, frames) in sides.iter().zip(&framed) {
        let kinds = if means.is_some() { KNOWN } else { KINDS };
        let found = side.walls(kinds.map(|ratio| ratio * usual), same, 0.0);
        let pieces = found.iter().flat_map(|wall| wall.without(frames, same));
        walls.extend(pieces.map(|piece| side.area(&piece)));
    }
    let mut number = 0;
    lines.strokes.retain(|_| {
        number += 1;
        !axes.contains(&(number - 1))
    });
    lines.strokes.extend(walls);
}

/// Returns the diagonal of all lines; `None` if there are none.
fn diagonal(strokes: &[Stroke]) -> Option<f64> {
    let mut points = strokes.iter().filter(is_line).flat_map(|s| &s.points);
    let first = *points.next()?;
    let (low, high) = points.fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
    Some(low.distance(high)).filter(|diagonal| *diagonal > 0.0)
}

fn is_line(stroke: &&Stroke) -> bool {
    !stroke.is_text && stroke.fill.is_none() && stroke.points.len() > 1
}

/// Sorts the straight lines of a drawing by their direction.
fn directions(strokes: &[Stroke], is_wall: &dyn Fn(usize) -> bool) -> Vec<Side> {
    let mut all = vec![];
    let lines = strokes.iter().enumerate();
    for (number, stroke) in lines.filter(|(k, s)| is_line(s) && is_wall(*k)) {
        for [p, q] in sides(stroke) {
            let way = q - p;
            if way.length() > 0.0 {
                let angle = libm::atan2(way.y, way.x).rem_euclid(std::f64::consts::PI);
                all.push((angle, number, [p, q]));
            }
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut out: Vec<Side> = vec![];
    let mut first = f64::NEG_INFINITY;
    let is_level = |angle: f64| angle > std::f64::consts::PI - PARALLEL;
    for (angle, stroke, ends) in all {
        // Level lines lie at both ends of the half turn.
        let k = if is_level(angle) && out.first().is_some_and(|side| side.way.y < PARALLEL) {
            0
        } else {
            if angle - first > PARALLEL {
                first = angle;
                let way = DVec2::new(libm::cos(angle), libm::sin(angle));
                out.push(Side { way, lines: vec![] });
            }
            out.len() - 1
        };
        let side = &mut out[k];
        let along = ends.map(|p| p.dot(side.way));
        side.lines.push(Line {
            at: f64::midpoint(ends[0].dot(side.way.perp()), ends[1].dot(side.way.perp())),
            along: [along[0].min(along[1]), along[0].max(along[1])],
            strokes: vec![stroke],
            is_whole: strokes[stroke].points.len() == 2,
        });
    }
    out
}

/// A straight line.
#[derive(Clone, Debug)]
struct Line {
    /// The place across its direction.
    at: f64,
    /// The ends along its direction.
    along: [f64; 2],
    /// The numbers of the strokes that it is part of.
    strokes: Vec<usize>,
    /// True if none of these strokes has other sides.
    is_whole: bool,
}

impl Line {
    fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }

    fn overlaps(&self, along: [f64; 2], same: f64) -> bool {
        self.along[1].min(along[1]) - self.along[0].max(along[0]) > same
    }
}

/// Two parallel lines, where both run.
#[derive(Clone, Copy, Debug)]
struct Pair {
    across: [f64; 2],
    along: [f64; 2],
}

impl Pair {
    fn apart(&self) -> f64 {
        self.across[1] - self.across[0]
    }

    fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }

    /// Returns the pieces outside all frames.
    fn without(&self, frames: &[Pair], same: f64) -> Vec<Pair> {
        let mut pieces = vec![*self];
        for frame in frames {
            let within =
                self.across[0] > frame.across[0] - same && self.across[1] < frame.across[1] + same;
            if !within {
                continue;
            }
            let cut = |piece: &Pair| {
                let [from, to] = piece.along;
                let before = [from, to.min(frame.along[0])];
                let after = [from.max(frame.along[1]), to];
                let parts = [before, after].map(|along| Pair { along, ..*piece });
                parts.into_iter().filter(|part| part.length() > same)
            };
            pieces = pieces.iter().flat_map(cut).collect();
        }
        pieces
    }
}

/// The lines of one direction.
#[derive(Debug)]
struct Side {
    way: DVec2,
    /// In their order across.
    lines: Vec<Line>,
}

impl Side {
    /// Joins collinear lines that touch.
    fn join(&mut self, same: f64) {
        let order = |a: &Line, b: &Line| {
            let (a, b) = ([a.at, a.along[0]], [b.at, b.along[0]]);
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        };
        self.lines.sort_by(order);
        let mut out: Vec<Line> = vec![];
        let mut rest = std::mem::take(&mut self.lines).into_iter().peekable();
        while let Some(first) = rest.next() {
            let at = first.at;
            let mut level = vec![first];
            while let Some(next) = rest.next_if(|next| next.at - at <= same) {
                level.push(next);
            }
            level.sort_by(|a, b| a.along[0].total_cmp(&b.along[0]));
            let from = out.len();
            for line in level {
                match out[from..].last_mut() {
                    Some(last) if line.along[0] <= last.along[1] + same => {
                        last.along[1] = last.along[1].max(line.along[1]);
                        last.strokes.extend(line.strokes);
                        last.is_whole &= line.is_whole;
                    }
                    _ => out.push(line),
                }
            }
        }
        self.lines = out;
    }

    /// Returns pairs of lines with some distance that run side by side.
    fn pairs(&self, [least, most]: [f64; 2], same: f64) -> Vec<Pair> {
        let mut out = vec![];
        for (k, a) in self.lines.iter().enumerate() {
            for b in self.lines[k + 1..].iter().take(MOST_BETWEEN) {
                let pair = Pair {
                    across: [a.at, b.at],
                    along: [a.along[0].max(b.along[0]), a.along[1].min(b.along[1])],
                };
                if pair.apart() > most + same {
                    break;
                }
                if pair.apart() >= least - same && pair.length() > same {
                    out.push(pair);
                }
            }
        }
        out
    }

    /// Returns the lines between those of a pair, where both run.
    fn between(&self, pair: &Pair, same: f64) -> impl Iterator<Item = (usize, &Line)> {
        let [from, to] = pair.across;
        let along = pair.along;
        let first = self.lines.partition_point(|line| line.at <= from + same);
        let all = self.lines.iter().enumerate().skip(first);
        let near = all.take_while(move |(_, line)| line.at < to - same);
        near.filter(move |(_, line)| line.overlaps(along, same))
    }

    /// Removes the axes of walls, and returns the numbers of their strokes.
    fn take_axes(&mut self, apart: [f64; 2], same: f64) -> Vec<usize> {
        let mut axes = BTreeSet::new();
        for pair in self.pairs(apart, same) {
            if pair.length() < LONG * pair.apart() {
                continue;
            }
            let mut between = self.between(&pair, same);
            let (Some((number, line)), None) = (between.next(), between.next()) else {
                continue;
            };
            let is_middle = (2.0 * line.at - pair.across[0] - pair.across[1]).abs() <= 2.0 * same;
            let covers =
                line.along[0] <= pair.along[0] + same && line.along[1] >= pair.along[1] - same;
            let runs_on = line.along[0] < pair.along[0] - pair.apart()
                || line.along[1] > pair.along[1] + pair.apart();
            // An outline is more than its side that may be an axis.
            if line.is_whole && is_middle && covers && runs_on {
                axes.insert(number);
            }
        }
        let strokes = axes.iter().flat_map(|k| self.lines[*k].strokes.clone());
        let strokes = strokes.collect();
        let mut number = 0;
        self.lines.retain(|_| {
            number += 1;
            !axes.contains(&(number - 1))
        });
        strokes
    }

    /// Returns the hollow walls with a thickness in a range that are at least `long` times as long as thick.
    fn walls(&self, apart: [f64; 2], same: f64, long: f64) -> Vec<Pair> {
        let is_wall = |pair: &Pair| {
            pair.length() >= long * pair.apart() && self.between(pair, same).next().is_none()
        };
        let pairs = self.pairs(apart, same).into_iter();
        pairs.filter(is_wall).collect()
    }

    /// Returns the frames with a width in a range, each as long as the lines inside it.
    fn frames(&self, apart: [f64; 2], same: f64) -> Vec<Pair> {
        let frame = |pair: Pair| {
            let slack = pair.apart() / 2.0;
            let mut along: Option<[f64; 2]> = None;
            for (_, line) in self.between(&pair, same) {
                let [from, to] = line.along;
                if from < pair.along[0] - slack || to > pair.along[1] + slack {
                    return None;
                }
                along = Some(along.map_or([from, to], |[a, b]| [a.min(from), b.max(to)]));
            }
            along.map(|along| Pair { along, ..pair })
        };
        let pairs = self.pairs(apart, same).into_iter();
        pairs.filter_map(frame).collect()
    }

    /// Returns a wall as an area.
    fn area(&self, wall: &Pair) -> Stroke {
        let ([a, b], [v, w]) = (wall.along, wall.across);
        let at = |(u, v): (f64, f64)| self.way * u + self.way.perp() * v;
        Stroke {
            points: [(a, v), (b, v), (b, w), (a, w)].map(at).to_vec(),
            is_closed: true,
            fill: Some([0; 3]),
            ..Stroke::default()
        }
    }
}
