//! The lines of a drawing, whatever file they come from.

use crate::plan::flatten::Region;
use glam::{DMat3, DVec2, dvec2};
use std::collections::BTreeMap;

/// The most corners of a drawing.
pub(super) const MOST: usize = 4_000_000;
/// Places farther out are no places of a house.
pub(super) const FARTHEST: f64 = 1e9;
/// The chords of a full circle.
pub(super) const CHORDS: f64 = 72.0;

/// A line through places: x to the right, y down, in units of the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stroke {
    /// Its corners.
    pub points: Vec<DVec2>,
    /// Whether it ends where it starts.
    pub is_closed: bool,
    /// The colour of its area, if it is one.
    pub fill: Option<[u8; 3]>,
    /// Whether it stands for a text.
    pub is_text: bool,
    /// The width of its pen; 0 = as thin as can be.
    pub width: f64,
    /// The colour of its pen, or of its area if it has no pen.
    pub colour: [u8; 3],
    /// Names of what it lies in, the nearest first: layers, groups, classes.
    pub layers: Vec<u32>,
    /// Names of the blocks that it is part of, the nearest first.
    pub blocks: Vec<u32>,
    /// The name of its line type, if it has one.
    pub line_type: Option<u32>,
    /// The number of the symbol that it is part of; 0 = none.
    pub symbol: u32,
}

/// All lines of a drawing.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    /// In the order in which they are drawn.
    pub strokes: Vec<Stroke>,
    /// Whether it is as large as the house: plans of CAD programs are, those on paper are not.
    pub is_model: bool,
    /// Millimetres of the house in a unit of the drawing, if the file says so.
    pub unit_mm: Option<f64>,
    /// What was left out: how often, by kind.
    pub left_out: BTreeMap<String, usize>,
    names: Vec<String>,
    known: BTreeMap<String, u32>,
    corners: usize,
}

impl Lines {
    /// Drops the strokes that are not wholly inside a box.
    pub fn keep_within(&mut self, [low, high]: Region) {
        let is_within = |p: &DVec2| p.cmpge(low).all() && p.cmple(high).all();
        self.strokes
            .retain(|stroke| stroke.points.iter().all(is_within));
    }

    /// The number of a name.
    pub(super) fn name(&mut self, name: &str) -> u32 {
        if let Some(known) = self.known.get(name) {
            return *known;
        }
        let number = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.known.insert(name.to_owned(), number);
        number
    }

    /// The name of a number.
    pub fn named(&self, number: u32) -> &str {
        self.names.get(number as usize).map_or("", String::as_str)
    }

    /// All names, in the order in which they were met.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Adds a stroke; what is no place or no line is left out. False if there is no room for more.
    pub(super) fn put(&mut self, mut stroke: Stroke) -> bool {
        let is_place = |p: &DVec2| p.is_finite() && p.abs().max_element() < FARTHEST;
        if stroke.points.is_empty() || !stroke.points.iter().all(is_place) {
            self.leave_out("places beyond all bounds");
            return true;
        }
        stroke.points.dedup();
        self.corners += stroke.points.len() + 4;
        self.strokes.push(stroke);
        self.corners < MOST
    }

    pub(super) fn leave_out(&mut self, what: &str) {
        *self.left_out.entry(what.to_owned()).or_default() += 1;
    }
}

/// Places along an arc of an ellipse: its middle, its two half axes, angles from the first axis towards the second.
pub(super) fn arc(middle: DVec2, axes: [DVec2; 2], from: f64, to: f64) -> Vec<DVec2> {
    let turn = (to - from).clamp(-std::f64::consts::TAU, std::f64::consts::TAU);
    let count = (turn.abs() / std::f64::consts::TAU * CHORDS)
        .ceil()
        .max(2.0) as usize;
    let at = |k: usize| {
        let angle = from + turn * k as f64 / count as f64;
        middle + axes[0] * libm::cos(angle) + axes[1] * libm::sin(angle)
    };
    (0..=count).map(at).collect()
}

/// Places along a segment with a bulge (the tangent of a quarter of its turn), without the first.
pub(super) fn bulged(from: DVec2, to: DVec2, bulge: f64) -> Vec<DVec2> {
    if !bulge.is_finite() || bulge.abs() < 1e-6 || bulge.abs() > 1e4 || from == to {
        return vec![to];
    }
    let (half, way) = ((to - from) / 2.0, to - from);
    let middle = from + half + way.perp() * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let start = from - middle;
    let turn = 4.0 * libm::atan(bulge);
    let mut points = arc(middle, [start, start.perp()], 0.0, turn);
    points.remove(0);
    if let Some(last) = points.last_mut() {
        *last = to;
    }
    points
}

/// Places along a cubic curve, without the first.
pub(super) fn cubic([a, b, c, d]: [DVec2; 4]) -> Vec<DVec2> {
    const STEPS: usize = 12;
    let at = |k: usize| {
        let t = k as f64 / STEPS as f64;
        let (p, q, r) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        p.lerp(q, t).lerp(q.lerp(r, t), t)
    };
    (1..=STEPS).map(at).collect()
}

/// A place moved by a matrix.
pub(super) fn moved(matrix: &DMat3, p: DVec2) -> DVec2 {
    let p = *matrix * p.extend(1.0);
    dvec2(p.x, p.y)
}
