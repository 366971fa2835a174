//! Walks along the walls of a house: round it, round its courtyards, along the walls inside.

use super::graph::Graph;
use glam::DVec2;
use std::collections::{BTreeMap, BTreeSet};

/// A wall that is walked along.
#[derive(Clone, Copy)]
pub(super) struct Step {
    pub(super) line: usize,
    /// True from its first end to its second.
    pub(super) forward: bool,
}

/// The walks of the largest house on a sheet.
pub(super) struct Walks {
    pub(super) outline: Vec<Step>,
    pub(super) holes: Vec<Vec<Step>>,
    /// The area of other houses, square pixels.
    pub(super) apart: f64,
}

impl Walks {
    /// Returns `None` if nothing is enclosed.
    pub(super) fn of(graph: &Graph) -> Option<Walks> {
        let mut loops = loops(graph);
        let area = |walk: &Vec<Step>| enclosed(&corners(graph, walk));
        loops.sort_by(|a, b| area(b).abs().total_cmp(&area(a).abs()));
        let others = loops.split_off(1.min(loops.len()));
        let outline = loops.pop().filter(|walk| area(walk).abs() > 0.0)?;
        let around = corners(graph, &outline);
        let (houses, courts): (Vec<_>, Vec<_>) = others
            .into_iter()
            .partition(|walk| area(walk) * area(&outline) > 0.0);
        let holes = courts.into_iter();
        Some(Walks {
            apart: houses.iter().map(|walk| area(walk).abs()).sum(),
            holes: holes
                .filter(|walk| inside(&around, corners(graph, walk)[0]))
                .collect(),
            outline,
        })
    }
}

pub(super) fn ends(graph: &Graph, step: Step) -> [DVec2; 2] {
    let [a, b] = graph.lines[step.line].ends.map(|k| graph.corners[k]);
    if step.forward { [a, b] } else { [b, a] }
}

pub(super) fn corners(graph: &Graph, walk: &[Step]) -> Vec<DVec2> {
    walk.iter().map(|step| ends(graph, *step)[0]).collect()
}

/// Twice-signed area of a polygon, halved: positive if its inside is to the right on a sheet whose places run down.
pub(super) fn enclosed(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let sum: f64 = corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
    sum / 2.0
}

pub(super) fn inside(around: &[DVec2], at: DVec2) -> bool {
    let next = around.iter().cycle().skip(1);
    let crossed = around.iter().zip(next).filter(|(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// The walks along outer walls, each with the house on its right.
fn loops(graph: &Graph) -> Vec<Vec<Step>> {
    let mut starting: BTreeMap<usize, Vec<Step>> = BTreeMap::new();
    for (n, line) in graph.lines.iter().enumerate() {
        let forward = match line.rooms {
            [0, r] if r != 0 => true,
            [l, 0] if l != 0 => false,
            _ => continue,
        };
        let from = line.ends[usize::from(!forward)];
        starting
            .entry(from)
            .or_default()
            .push(Step { line: n, forward });
    }
    let end = |step: &Step| graph.lines[step.line].ends[usize::from(step.forward)];
    let mut out = vec![];
    while let Some(first) = starting.values().flatten().next().copied() {
        let begin = graph.lines[first.line].ends[usize::from(!first.forward)];
        let mut walk: Vec<Step> = vec![];
        let mut at = begin;
        while let Some(all) = starting.get_mut(&at) {
            // Where two corners of the house touch, the sharper turn to the right stays on one side.
            let sharpest = (0..all.len()).max_by(|a, b| {
                let bend = |k: &usize| {
                    let [p, q] = ends(graph, all[*k]);
                    let before = walk.last().map_or(DVec2::X, |s| {
                        let [a, b] = ends(graph, *s);
                        b - a
                    });
                    libm::atan2(before.perp_dot(q - p), before.dot(q - p))
                };
                bend(a).total_cmp(&bend(b))
            });
            let Some(k) = sharpest else { break };
            let step = all.swap_remove(k);
            if all.is_empty() {
                starting.remove(&at);
            }
            walk.push(step);
            at = end(&step);
            if at == begin {
                break;
            }
        }
        if at == begin && walk.len() > 2 {
            out.push(walk);
        }
    }
    out
}

/// Returns the step with which the walk round a house begins.
///
/// It runs to the left, as near to the street as any, and begins at the right end.
pub(super) fn start(graph: &Graph, walk: &[Step]) -> usize {
    let front = |k: &usize| {
        let [a, b] = ends(graph, walk[*k]);
        let ahead = b - a;
        let level = -ahead.x > 0.98 * ahead.length();
        let before = walk[(*k + walk.len() - 1) % walk.len()];
        let [p, q] = ends(graph, before);
        let turns = (q - p)
            .normalize_or_zero()
            .perp_dot(ahead.normalize_or_zero())
            .abs()
            > 0.02;
        (level && turns).then_some(a)
    };
    let all = (0..walk.len()).filter_map(|k| Some((k, front(&k)?)));
    all.max_by(|(_, a), (_, b)| {
        (a.y, a.x)
            .partial_cmp(&(b.y, b.x))
            .unwrap_or(std::cmp::Ordering::Equal)
    })
    .map_or(0, |(k, _)| k)
}

/// The rooms within an outline.
pub(super) fn rooms_of(graph: &Graph, around: &[DVec2]) -> BTreeSet<u32> {
    let mut out = BTreeSet::new();
    for line in &graph.lines {
        let [a, b] = line.ends.map(|k| graph.corners[k]);
        let side = (b - a).perp().normalize_or_zero();
        let middle = graph.middle(line);
        // On a sheet whose places run down, what is to the right of a line lies towards its perpendicular.
        for (room, at) in [
            (line.rooms[0], middle - side),
            (line.rooms[1], middle + side),
        ] {
            if room != 0 && inside(around, at) {
                out.insert(room);
            }
        }
    }
    out
}

/// The walls between rooms of a house, those in one line together.
pub(super) fn inner(graph: &Graph, rooms: &BTreeSet<u32>) -> Vec<Vec<Step>> {
    let mut left: Vec<usize> = (0..graph.lines.len())
        .filter(|n| {
            graph.lines[*n]
                .rooms
                .iter()
                .all(|r| *r != 0 && rooms.contains(r))
        })
        .collect();
    let ahead = |step: Step| {
        let [a, b] = ends(graph, step);
        (b - a).normalize_or_zero()
    };
    // To the left or up on the sheet.
    let along = |n: usize| {
        let forward = ahead(Step {
            line: n,
            forward: true,
        });
        Step {
            line: n,
            forward: (forward.x + forward.y * 1.01) < 0.0,
        }
    };
    let mut out = vec![];
    while let Some(first) = left.pop() {
        let mut run = vec![along(first)];
        loop {
            let (head, tail) = (run[0], run[run.len() - 1]);
            let [from, _] = ends(graph, head);
            let [_, to] = ends(graph, tail);
            let fits = |n: &usize| {
                let step = along(*n);
                let [a, b] = ends(graph, step);
                let straight = ahead(step).dot(ahead(head)) > 0.9998;
                straight && (a.distance(to) < 1e-6 || b.distance(from) < 1e-6)
            };
            let Some(k) = left.iter().position(fits) else {
                break;
            };
            let step = along(left.swap_remove(k));
            match ends(graph, step)[0].distance(to) < 1e-6 {
                true => run.push(step),
                false => run.insert(0, step),
            }
        }
        out.push(run);
    }
    out.sort_by(|a, b| {
        let of = |run: &Vec<Step>| ends(graph, run[0])[0];
        let (a, b) = (of(a), of(b));
        b.y.total_cmp(&a.y).then(b.x.total_cmp(&a.x))
    });
    out
}
