//! Printed dimensions: numbers between walls say how large a plan is.

use super::digits::Number;
use super::graph::Graph;
use super::measures;
use crate::plan::sheet::Ink;
use std::collections::BTreeSet;
use std::ops::RangeInclusive;

/// The greatest distance of a number from the middle of the two walls that it measures, in its height.
const MIDDLE: f64 = 2.0;
/// The greatest difference of lengths and numbers of one scale.
const ALIKE: f64 = 0.012;
/// The fewest dimensions that agree, and the fewest unlike ones; then for numbers in parts.
const FEWEST: [usize; 2] = [3, 2];
const FEWEST_IN_PARTS: [usize; 2] = [4, 3];
/// The scale by printed numbers, as a share of that by openings.
pub(super) const NEAR: RangeInclusive<f64> = 0.65..=1.55;
/// The least and most extent of a house, metres.
const EXTENT: [f64; 2] = [2.5, 80.0];
/// Metres of the units of numbers: millimetres and centimetres, and inches.
pub(super) const METRIC: [f64; 2] = [0.001, 0.01];
pub(super) const INCH: f64 = 0.0254;

/// A number with the scale at which it would be the distance of two walls.
#[derive(Clone, Copy)]
struct Vote {
    ratio: f64,
    number: usize,
    /// The axis along which the walls are the outermost ones.
    whole: Option<usize>,
}

/// The scale that dimensions agree on.
#[derive(Clone, Copy, Debug)]
pub struct Dimensions {
    /// Metres of a pixel.
    pub metres: f64,
    /// The number of dimensions that agree.
    pub count: usize,
    /// True if width and depth of the whole are among them.
    pub is_whole: bool,
}

/// Returns the scale by printed dimensions: numbers between two walls or on a dimension line, or width and depth of the whole.
///
/// All numbers are in one of `units`, metres. With `about`, the scale by openings, only scales near to it count: numbers in parts also
/// agree by chance.
pub fn metres(
    numbers: &[Number],
    (units, about): (&[f64], Option<f64>),
    (ink, graph): (&Ink, &Graph),
) -> Option<Dimensions> {
    let places = [0, 1].map(|axis| places(graph, axis));
    let extents = places.iter().filter_map(|p| Some(p.last()? - p.first()?));
    let extent = extents.fold(0.0, f64::max);
    let mut votes = votes(numbers, &places);
    for (number, printed) in numbers.iter().enumerate().filter(|(_, n)| n.value > 0.0) {
        votes.extend(measures::length(ink, &printed.label).map(|length| Vote {
            ratio: printed.value / length,
            number,
            whole: None,
        }));
    }
    if let Some(about) = about {
        let near = |unit: &f64, ratio: f64| NEAR.contains(&(ratio * unit / about));
        votes.retain(|vote| units.iter().any(|unit| near(unit, vote.ratio)));
    }
    let [fewest, fewest_values] = about.map_or(FEWEST, |_| FEWEST_IN_PARTS);
    let best = votes.iter().map(|vote| agreeing(&votes, vote.ratio));
    let values = |all: &[Vote]| {
        let values = all.iter().map(|v| numbers[v.number].value.to_bits());
        values.collect::<BTreeSet<u64>>().len()
    };
    let is_whole = |all: &[Vote]| {
        [0, 1]
            .iter()
            .all(|axis| all.iter().any(|v| v.whole == Some(*axis)))
    };
    let best = best.max_by_key(|all| (is_whole(all), values(all), all.len()))?;
    if !is_whole(&best) && (best.len() < fewest || values(&best) < fewest_values) {
        return None;
    }
    let mut ratios: Vec<f64> = best.iter().map(|v| v.ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = ratios[ratios.len() / 2];
    let fits = |unit: &&f64| {
        let metres = extent * ratio * **unit;
        let is_near = about.is_none_or(|about| NEAR.contains(&(ratio * **unit / about)));
        is_near && (EXTENT[0]..=EXTENT[1]).contains(&metres)
    };
    let unit = units.iter().find(fits)?;
    Some(Dimensions {
        metres: ratio * unit,
        count: best.len(),
        is_whole: is_whole(&best),
    })
}

/// Returns the places of the walls across an axis.
fn places(graph: &Graph, axis: usize) -> Vec<f64> {
    let ends = graph
        .lines
        .iter()
        .map(|line| line.ends.map(|k| graph.corners[k][axis]));
    let across = ends.filter(|[a, b]| (a - b).abs() < 1e-6);
    let mut all: Vec<f64> = across.map(|[a, _]| a).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1.0);
    all
}

fn votes(numbers: &[Number], places: &[Vec<f64>; 2]) -> Vec<Vote> {
    let mut votes = vec![];
    for (number, printed) in numbers.iter().enumerate().filter(|(_, n)| n.value > 0.0) {
        for (axis, places) in places.iter().enumerate() {
            for (k, from) in places.iter().enumerate() {
                for (j, to) in places.iter().enumerate().skip(k + 1) {
                    let middle = (from + to) / 2.0;
                    if (middle - printed.label.middle[axis]).abs() <= MIDDLE * printed.label.height
                    {
                        let is_whole = k == 0 && j + 1 == places.len();
                        votes.push(Vote {
                            ratio: printed.value / (to - from),
                            number,
                            whole: is_whole.then_some(axis),
                        });
                    }
                }
            }
        }
    }
    votes
}

/// Returns the votes for a ratio, one of each number.
fn agreeing(votes: &[Vote], ratio: f64) -> Vec<Vote> {
    let near = votes
        .iter()
        .filter(|v| (v.ratio / ratio - 1.0).abs() <= ALIKE);
    let mut all: Vec<Vote> = near.copied().collect();
    all.sort_by_key(|v| (v.number, v.whole.is_none()));
    all.dedup_by_key(|v| v.number);
    all
}
