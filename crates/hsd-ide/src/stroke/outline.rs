//! Drawn outlines: checked, rotated to their front, and written as walks.

use super::change::padded;
use super::legacy;
use super::refuse;
use super::walls::inside;
use super::xml::plain;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::{SAME, area2};

/// The longest side of an outline, U.
const LONGEST: f64 = 1000.0;

/// Returns the corners of a drawn outline, walked as houses are, from the right end of its front.
pub(super) fn checked(drawn: &[[f64; 2]]) -> Result<Vec<DVec2>, Text> {
    let mut corners: Vec<DVec2> = drawn.iter().map(|[a, b]| dvec2(*a, *b)).collect();
    let sound = |p: &DVec2| p.is_finite() && p.abs().max_element() < 1e6;
    if corners.len() > 10_000 || !corners.iter().all(sound) {
        return Err(refuse::bad_outline());
    }
    if area2(&corners) < 0.0 {
        corners.reverse();
    }
    let count = corners.len();
    let at = |i: usize| corners[i % count.max(1)];
    let turns = |i: usize| {
        (at(i + count - 1) - at(i))
            .perp_dot(at(i + 1) - at(i))
            .abs()
            > SAME
    };
    let corners: Vec<DVec2> = (0..count).filter(|i| turns(*i)).map(at).collect();
    let count = corners.len();
    if count < 4 || !(0..count).all(|i| straight(corners[(i + 1) % count] - corners[i])) {
        return Err(refuse::bad_outline());
    }
    if touches_itself(&corners) {
        return Err(refuse::bad_outline());
    }
    let front = (0..count).filter(|i| corners[(i + 1) % count].x > corners[*i].x + SAME);
    let least = |i: &usize, j: &usize| {
        let key = |k: usize| (corners[k].y, corners[k].x);
        key(*i)
            .partial_cmp(&key(*j))
            .unwrap_or(std::cmp::Ordering::Equal)
    };
    let first = front.min_by(least).ok_or_else(refuse::bad_outline)?;
    Ok((0..count).map(|i| corners[(first + i) % count]).collect())
}

/// Returns true if a side is parallel to an axis and a whole number of units long.
fn straight(side: DVec2) -> bool {
    let along = side.x.abs() < SAME || side.y.abs() < SAME;
    let length = side.length();
    along && (length - length.round()).abs() < SAME && (1.0 - SAME..LONGEST).contains(&length)
}

/// Returns true if non-adjacent sides of an orthogonal outline touch.
fn touches_itself(corners: &[DVec2]) -> bool {
    let count = corners.len();
    let edge = |i: usize| {
        let (p, q) = (corners[i], corners[(i + 1) % count]);
        (p.min(q), p.max(q))
    };
    (0..count).any(|i| {
        let (low, high) = edge(i);
        (i + 2..count).any(|j| {
            let (other_low, other_high) = edge(j);
            let near = low.cmple(other_high + SAME).all() && other_low.cmple(high + SAME).all();
            near && (i + count - j) % count != 1
        })
    })
}

/// Returns true if an outline lies within others, some of which are holes.
pub(super) fn lies_in(corners: &[DVec2], below: &[(Vec<DVec2>, bool)]) -> bool {
    let bounds = |f: fn(DVec2, DVec2) -> DVec2| corners.iter().copied().reduce(f);
    let (Some(low), Some(high)) = (bounds(DVec2::min), bounds(DVec2::max)) else {
        return false;
    };
    let size = (high - low).round();
    if size.x * size.y > 1e6 {
        return false;
    }
    // Walls stand on the grid of the outline or between its lines: quarters of cells are tested.
    let covered = |p: DVec2| {
        let holes = below.iter().filter(|b| b.1);
        let in_hole = holes.clone().any(|b| inside(&b.0, p));
        !in_hole && below.iter().any(|b| !b.1 && inside(&b.0, p))
    };
    (0..size.x as i64 * 2).all(|i| {
        (0..size.y as i64 * 2).all(|j| {
            let p = low + dvec2(i as f64 + 0.5, j as f64 + 0.5) / 2.0;
            !inside(corners, p) || covered(p)
        })
    })
}

/// A walk of new walls.
pub(super) struct Walk {
    start: DVec2,
    hole: bool,
    walls: Vec<Side>,
}

/// A new wall of a walk.
struct Side {
    direction: DVec2,
    /// Codes of whole units, or wider.
    codes: Vec<String>,
    /// The turn at its end.
    turn: &'static str,
}

impl Walk {
    /// Creates a walk round some corners, each wall of one code.
    pub(super) fn new(corners: &[DVec2], codes: &[String], hole: bool) -> Result<Walk, Text> {
        let count = corners.len();
        let mut walls = vec![];
        for (i, code) in codes.iter().enumerate().take(count) {
            let side = corners[(i + 1) % count] - corners[i];
            let after = corners[(i + 2) % count] - corners[(i + 1) % count];
            if !straight(side) {
                return Err(refuse::bad_outline());
            }
            walls.push(Side {
                direction: (side / side.length()).round(),
                codes: vec![code.clone(); side.length().round() as usize],
                turn: if side.perp_dot(after) > 0.0 { "R" } else { "L" },
            });
        }
        let start = corners.first().copied().unwrap_or_default();
        Ok(Walk { start, hole, walls })
    }

    /// Returns the same walk from the origin.
    pub(super) fn at_origin(mut self) -> Walk {
        self.start = DVec2::ZERO;
        self
    }

    /// Inserts a door into its first wall.
    pub(super) fn with_door(mut self) -> Walk {
        if let Some(front) = self.walls.first_mut() {
            let length = front.codes.len();
            let (at, wide) = ((length - 1) / 2, length > 1);
            let door = if wide { "TKD 2" } else { "TIT" };
            let end = at + if wide { 2 } else { 1 };
            front.codes.splice(at..end.min(length), [door.to_owned()]);
        }
        self
    }

    /// Returns the lines of the legacy form.
    pub(super) fn lines(&self) -> Result<Vec<String>, Text> {
        let heading = self.walls.first().map_or(DVec2::X, |w| w.direction);
        let (mut lines, voids) = legacy::lead(self.start, heading)?;
        let count = self.walls.len();
        for (number, side) in self.walls.iter().enumerate() {
            let lead = if number == 0 {
                ".....".repeat(voids)
            } else {
                String::new()
            };
            let codes: String = side.codes.iter().map(|c| padded(c)).collect();
            let left = side.turn == "L" && number + 1 < count;
            let codes = lead + &codes;
            lines.push(if left {
                codes + "L"
            } else {
                codes.trim_end().to_owned()
            });
        }
        Ok(lines)
    }

    /// Returns the rows of the XML form.
    pub(super) fn rows(&self) -> Vec<String> {
        let usual = if self.hole { "L" } else { "R" };
        let count = self.walls.len();
        let walls = self.walls.iter().enumerate();
        let row = |(number, side): (usize, &Side)| {
            let bends = side.turn != usual && number + 1 < count;
            let turn = if bends {
                format!(" turn=\"{}\"", side.turn)
            } else {
                String::new()
            };
            let codes: String = side.codes.iter().map(|c| padded(c)).collect();
            format!("<Row{turn}>{}</Row>", codes.trim_end())
        };
        walls.map(row).collect()
    }

    /// Returns its `start` attribute, unless it begins at the origin.
    pub(super) fn start_attribute(&self) -> String {
        let (a, b) = (self.start.x, self.start.y);
        let origin = a.abs() < SAME && b.abs() < SAME && !self.hole;
        match origin {
            true => String::new(),
            false => format!(" start=\"{} {}\"", plain(a), plain(b)),
        }
    }

    /// Returns the `hole` attribute if it encloses a courtyard, else nothing.
    pub(super) fn hole_attribute(&self) -> &'static str {
        if self.hole { " hole=\"yes\"" } else { "" }
    }
}
