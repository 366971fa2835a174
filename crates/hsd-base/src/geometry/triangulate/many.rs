//! Cuts the ears off a ring of many corners, in rounds. Each round looks at the convex corners; the neighbours of a corner that
//! was cut off wait for the next round, so that triangles do not all meet in one corner. A grid finds the corners inside of a
//! triangle: with a search through all of them the time would grow with the square of their number.

use crate::geometry::triangulate::{holds, shape, worth_blocked};
use glam::DVec2;
use std::collections::VecDeque;

/// A ring of which corners are cut off.
pub(super) struct Cutting<'a> {
    ring: &'a [DVec2],
    /// The corners that are left, in order: the one before and the one after each.
    before: Vec<u32>,
    after: Vec<u32>,
    /// How many are left, and one of them.
    left: usize,
    any: u32,
    /// The queue of convex corners, each with the number of its neighbours that had been cut off when it joined. If that
    /// number has grown since, the entry is out of date, and the corner has joined again.
    turns: VecDeque<(u32, u32)>,
    cuts_beside: Vec<u32>,
    places: Places,
}

impl<'a> Cutting<'a> {
    pub(super) fn new(ring: &'a [DVec2]) -> Cutting<'a> {
        let n = ring.len() as u32;
        let mut cutting = Cutting {
            ring,
            before: (0..n).map(|i| (i + n - 1) % n).collect(),
            after: (0..n).map(|i| (i + 1) % n).collect(),
            left: ring.len(),
            any: 0,
            turns: VecDeque::new(),
            cuts_beside: vec![0; ring.len()],
            places: Places::new(ring),
        };
        (0..n).for_each(|corner| cutting.wait(corner));
        cutting
    }

    /// Cuts off the next ear, or where there is none the corner that comes nearest to one, and returns it between its
    /// neighbours.
    pub(super) fn cut(&mut self) -> [u32; 3] {
        let corner = self.next_ear().unwrap_or_else(|| self.least_wrong());
        let triangle = self.triangle(corner);
        let [before, _, after] = triangle;
        self.after[before as usize] = after;
        self.before[after as usize] = before;
        self.left -= 1;
        self.any = after;
        self.places.remove(corner, self.ring[corner as usize]);
        for changed in triangle {
            self.cuts_beside[changed as usize] += 1;
        }
        self.wait(before);
        self.wait(after);
        triangle
    }

    /// Returns the corners that are left, in order.
    pub(super) fn rest(&self) -> impl Iterator<Item = u32> + '_ {
        let step = |corner: &u32| Some(self.after[*corner as usize]);
        std::iter::successors(Some(self.any), step).take(self.left)
    }

    fn triangle(&self, corner: u32) -> [u32; 3] {
        let i = corner as usize;
        [self.before[i], corner, self.after[i]]
    }

    fn corners(&self, corner: u32) -> [DVec2; 3] {
        self.triangle(corner).map(|i| self.ring[i as usize])
    }

    /// Puts a corner at the end of the queue if it is convex.
    fn wait(&mut self, corner: u32) {
        if shape(self.corners(corner)).1 {
            let cuts = self.cuts_beside[corner as usize];
            self.turns.push_back((corner, cuts));
        }
    }

    fn next_ear(&mut self) -> Option<u32> {
        for _ in 0..self.turns.len() {
            let (corner, cuts) = self.turns.pop_front()?;
            if cuts != self.cuts_beside[corner as usize] {
                continue;
            }
            if !self.places.has_any_in(self.corners(corner), self.ring) {
                return Some(corner);
            }
            self.turns.push_back((corner, cuts));
        }
        None
    }

    fn least_wrong(&self) -> u32 {
        let mut best = (f64::NEG_INFINITY, self.any);
        for corner in self.rest() {
            let worth = worth_blocked(shape(self.corners(corner)).0);
            if worth > best.0 {
                best = (worth, corner);
            }
        }
        best.1
    }
}

/// Corners by the cell of a grid in which they lie, about one in each. It has as many columns as rows, whatever the shape of
/// the ring, so that thin triangles along it meet few cells.
struct Places {
    least: DVec2,
    cell: DVec2,
    /// Columns, and rows.
    count: usize,
    cells: Vec<Vec<u32>>,
}

/// How far around a triangle corners are looked for, cells: what counts as on the border may lie a rounding outside.
const ROUNDING: f64 = 1e-3;

impl Places {
    fn new(ring: &[DVec2]) -> Places {
        let least = ring.iter().copied().fold(DVec2::MAX, DVec2::min);
        let size = ring.iter().copied().fold(DVec2::MIN, DVec2::max) - least;
        let count = (ring.len() as f64).sqrt().ceil() as usize;
        let mut places = Places {
            least,
            cell: (size / count as f64).max(DVec2::splat(f64::MIN_POSITIVE)),
            count,
            cells: vec![vec![]; count * count],
        };
        for (i, place) in ring.iter().enumerate() {
            let cell = places.index(*place);
            places.cells[cell].push(i as u32);
        }
        places
    }

    /// Returns a place in the units of the grid: columns from the left, rows from below.
    fn steps(&self, place: DVec2) -> DVec2 {
        (place - self.least) / self.cell
    }

    /// Returns the number of the column or row that holds a coordinate of the grid; the nearest one if it lies outside.
    fn line(&self, steps: f64) -> usize {
        (steps.max(0.0) as usize).min(self.count - 1)
    }

    fn index(&self, place: DVec2) -> usize {
        let steps = self.steps(place);
        self.line(steps.y) * self.count + self.line(steps.x)
    }

    fn remove(&mut self, corner: u32, place: DVec2) {
        let cell = self.index(place);
        self.cells[cell].retain(|c| *c != corner);
    }

    /// Returns true if a triangle of corners has others in it.
    fn has_any_in(&self, triangle: [DVec2; 3], ring: &[DVec2]) -> bool {
        let steps = triangle.map(|place| self.steps(place));
        let low = steps.iter().map(|s| s.y).fold(f64::MAX, f64::min) - ROUNDING;
        let high = steps.iter().map(|s| s.y).fold(f64::MIN, f64::max) + ROUNDING;
        (self.line(low)..=self.line(high)).any(|row| {
            let (left, right) = span(steps, row as f64 - ROUNDING, row as f64 + 1.0 + ROUNDING);
            if left > right {
                return false;
            }
            let (left, right) = (self.line(left - ROUNDING), self.line(right + ROUNDING));
            let cells = &self.cells[row * self.count..][left..=right];
            cells.iter().flatten().any(|corner| {
                let place = ring[*corner as usize];
                !triangle.contains(&place) && holds(triangle, place)
            })
        })
    }
}

/// Returns how far a triangle extends to the left and to the right between two heights.
fn span(triangle: [DVec2; 3], low: f64, high: f64) -> (f64, f64) {
    let mut span = (f64::MAX, f64::MIN);
    for i in 0..3 {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        let (a, b) = if a.y < b.y { (a, b) } else { (b, a) };
        if a.y > high || b.y < low {
            continue;
        }
        let level = b.y == a.y;
        let at = |y: f64| a.x + (b.x - a.x) * ((y.clamp(a.y, b.y) - a.y) / (b.y - a.y));
        let ends = if level {
            [a.x, b.x]
        } else {
            [at(low), at(high)]
        };
        span = ends
            .iter()
            .fold(span, |(left, right), x| (left.min(*x), right.max(*x)));
    }
    span
}
