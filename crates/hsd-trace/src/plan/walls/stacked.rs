//! The place of an upper storey over the one on the ground: where walls stand on walls.

use super::graph::Graph;
use super::walks::{Walks, corners, inside};
use glam::{DVec2, dvec2};

/// The tolerance within which an upper wall stands on a lower one, metres.
const NEAR: f64 = 0.2;
/// The weight of a wall to the outside on another, if that of any other is 1.
const OUTER: f64 = 2.0;
/// The penalty for a square metre of overhang, in metres of supported wall: upper storeys seldom project.
const OVERHANG: f64 = 2.0;
/// The longest walls of a storey, and the moves along each axis that are tried together.
const WALLS: usize = 150;
const MOVES: usize = 30;
/// The steps across a storey at which its floor is compared with the one below.
const STEPS: usize = 24;

/// A storey in metres of its sheet, to the right and down.
struct Laid {
    walls: Vec<Wall>,
    outline: Vec<DVec2>,
}

/// A wall along an axis.
#[derive(Clone, Copy)]
struct Wall {
    /// The axis across it: 0 for upright walls.
    axis: usize,
    at: f64,
    along: [f64; 2],
    is_outer: bool,
}

impl Laid {
    fn of(graph: &Graph, metres: f64) -> Option<Laid> {
        let outline = corners(graph, &Walks::of(graph)?.outline);
        let mut walls: Vec<Wall> = graph
            .lines
            .iter()
            .filter_map(|line| {
                let [a, b] = line.ends.map(|k| graph.corners[k] * metres);
                let size = (b - a).abs();
                let axis = usize::from(size.x > size.y);
                (size[axis] < NEAR / 2.0).then(|| Wall {
                    axis,
                    at: a[axis].midpoint(b[axis]),
                    along: [a[1 - axis].min(b[1 - axis]), a[1 - axis].max(b[1 - axis])],
                    is_outer: line.rooms.contains(&0),
                })
            })
            .collect();
        walls.sort_by(|a, b| b.length().total_cmp(&a.length()));
        walls.truncate(WALLS);
        let outline = outline.into_iter().map(|p| p * metres).collect();
        Some(Laid { walls, outline })
    }

    fn bounds(&self) -> [DVec2; 2] {
        let fold = |of: fn(DVec2, DVec2) -> DVec2| self.outline.iter().copied().reduce(of);
        [fold(DVec2::min), fold(DVec2::max)].map(Option::unwrap_or_default)
    }
}

impl Wall {
    fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }

    /// Returns the score of a wall that another supports over a length, metres.
    fn score(&self, other: &Wall, length: f64) -> f64 {
        match self.is_outer && other.is_outer {
            true => OUTER * length,
            false => length,
        }
    }
}

/// Finds the move that lays an upper storey on the ground: to the right and down, metres. Each is a graph with the metres of its
/// pixels. Of moves that agree equally it takes the one that moves the middle least.
pub fn register(ground: (&Graph, f64), upper: (&Graph, f64)) -> DVec2 {
    let laid = |(graph, metres)| Laid::of(graph, metres);
    let Some((ground, upper)) = laid(ground).zip(laid(upper)) else {
        return DVec2::ZERO;
    };
    let middle = |storey: &Laid| {
        let [a, b] = storey.bounds();
        a.midpoint(b)
    };
    let centred = middle(&ground) - middle(&upper);
    let [across, down] = [0, 1].map(|axis| moves(&ground, &upper, axis, centred[axis]));
    let all = across
        .iter()
        .flat_map(|x| down.iter().map(|y| dvec2(*x, *y)));
    let scored = all.map(|by| (agreement(&ground, &upper, by), by));
    let best = scored.max_by(|(a, p), (b, q)| {
        let far = |by: &DVec2| by.distance(centred);
        a.total_cmp(b).then(far(q).total_cmp(&far(p)))
    });
    best.map_or(centred, |(_, by)| by)
}

/// Returns the moves along an axis that bring most walls over others, each the mean of those near to it.
fn moves(ground: &Laid, upper: &Laid, axis: usize, centred: f64) -> Vec<f64> {
    let across = |storey: &Laid| -> Vec<Wall> {
        let walls = storey.walls.iter();
        walls.filter(|wall| wall.axis == axis).copied().collect()
    };
    let mut pairs: Vec<(f64, f64)> = vec![];
    for below in across(ground) {
        for above in across(upper) {
            let length = below.length().min(above.length());
            pairs.push((below.at - above.at, below.score(&above, length)));
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<(f64, f64)> = vec![];
    let mut from = 0;
    while from < pairs.len() {
        let near = |pair: &&(f64, f64)| pair.0 <= pairs[from].0 + NEAR;
        let group: Vec<&(f64, f64)> = pairs[from..].iter().take_while(near).collect();
        let weight: f64 = group.iter().map(|pair| pair.1).sum();
        let mean = group.iter().map(|pair| pair.0 * pair.1).sum::<f64>() / weight.max(1e-9);
        found.push((weight, mean));
        // Groups overlap by half, so that none is cut in two.
        let next = pairs[from].0 + NEAR / 2.0;
        from += pairs[from..]
            .iter()
            .take_while(|p| p.0 < next)
            .count()
            .max(1);
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
    found.truncate(MOVES);
    let found = found.into_iter().map(|(_, mean)| mean);
    found.chain([centred]).collect()
}

/// Returns the score of a move of an upper storey: metres of supported wall, less the penalty for overhang.
fn agreement(ground: &Laid, upper: &Laid, by: DVec2) -> f64 {
    let mut walls = 0.0;
    for above in &upper.walls {
        let (at, along) = (above.at + by[above.axis], by[1 - above.axis]);
        for below in &ground.walls {
            if below.axis != above.axis || (below.at - at).abs() > NEAR {
                continue;
            }
            let from = below.along[0].max(above.along[0] + along);
            let to = below.along[1].min(above.along[1] + along);
            walls += below.score(above, (to - from).max(0.0));
        }
    }
    walls - OVERHANG * overhang(ground, upper, by)
}

/// Returns the area of an upper storey over nothing, square metres.
fn overhang(ground: &Laid, upper: &Laid, by: DVec2) -> f64 {
    let [low, high] = upper.bounds();
    let step = (high - low) / STEPS as f64;
    let places = (0..STEPS).flat_map(|x| (0..STEPS).map(move |y| dvec2(x as f64, y as f64)));
    let over = places
        .map(|k| low + (k + 0.5) * step)
        .filter(|p| inside(&upper.outline, *p) && !inside(&ground.outline, *p + by));
    over.count() as f64 * step.element_product()
}
