//! Floors: boards are lines side by side within the units of a room, pounded earth is hatched aslant; edges of mats lie on
//! the lines of the grid.

use super::canvas::{Canvas, FINE};
use crate::shape::Shape;

/// The floor of a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floor {
    /// Mats.
    Tatami,
    /// Boards.
    Boards,
    /// Pounded earth.
    Earth,
}

impl Floor {
    /// Its name in the language.
    pub fn name(self) -> &'static str {
        match self {
            Floor::Tatami => "tatami",
            Floor::Boards => "boards",
            Floor::Earth => "earth",
        }
    }
}

/// The share of a cell that a joint between boards runs along at least.
const JOINT: f64 = 0.7;
/// The fewest joints within a cell.
const JOINTS: usize = 2;
/// Joints nearer to the edge of a cell may be edges of mats, of its side.
const EDGE: f64 = 0.14;
/// The least share of the cells of a room that look like its floor.
const CELLS: f64 = 0.6;
/// The least share of a hatched cell that is ink that runs aslant.
const HATCHED: f64 = 0.025;
/// The least share of the ink of a hatched cell that runs aslant.
const ASLANT: f64 = 0.5;

/// Says of each room what it is floored with, where that can be told.
pub(super) fn mark(canvas: &Canvas, shape: &mut Shape) {
    for (k, room) in shape.rooms.iter().enumerate() {
        let covered = |c: &(i32, i32)| shape.things.iter().any(|t| t.covers(*c));
        let free: Vec<(i32, i32)> = room.iter().copied().filter(|c| !covered(c)).collect();
        let most = |is: &dyn Fn((i32, i32)) -> bool| {
            let some = free.iter().filter(|c| is(**c)).count();
            some > 0 && some as f64 >= CELLS * free.len() as f64
        };
        let boards = |upright| most(&|c| joints(canvas, c, upright) >= JOINTS);
        if boards(false) != boards(true) {
            shape.floors.insert(k, Floor::Boards);
        } else if most(&|c| is_hatched(canvas, c)) {
            shape.floors.insert(k, Floor::Earth);
        }
    }
}

/// How many lines run through a cell beside each other.
fn joints(canvas: &Canvas, cell: (i32, i32), upright: bool) -> usize {
    let (x0, y0) = canvas.corner(cell);
    let edge = (EDGE * f64::from(FINE)) as i32;
    let is_joint = |line: i32| {
        let (mut some, mut all) = (0, 0);
        for k in 0..FINE {
            // A line sways by a sample.
            let at = |off: i32| match upright {
                true => canvas.number(x0 + line + off, y0 + k),
                false => canvas.number(x0 + k, y0 + line + off),
            };
            if !canvas.hidden[at(0)] {
                all += 1;
                some += i32::from([-1, 0, 1].iter().any(|off| canvas.ink[at(*off)]));
            }
        }
        2 * all > FINE && f64::from(some) >= JOINT * f64::from(all)
    };
    let lines: Vec<bool> = (edge..FINE - edge).map(is_joint).collect();
    let begins = |pair: &&[bool]| !pair[0] && pair[1];
    // Ink all over is no joint.
    match lines.iter().filter(|l| **l).count() * 4 > lines.len() * 3 {
        true => 0,
        false => lines.windows(2).filter(begins).count(),
    }
}

fn is_hatched(canvas: &Canvas, cell: (i32, i32)) -> bool {
    let (x0, y0) = canvas.corner(cell);
    let (mut all, mut ink, mut aslant) = (0.0, 0.0, 0.0);
    for (x, y) in (0..FINE).flat_map(|y| (0..FINE).map(move |x| (x0 + x, y0 + y))) {
        let k = canvas.number(x, y);
        if !canvas.hidden[k] {
            all += 1.0;
            ink += f64::from(u8::from(canvas.ink[k]));
            aslant += f64::from(u8::from(canvas.slanting[k]));
        }
    }
    aslant >= HATCHED * all && aslant >= ASLANT * ink && all > 0.0
}
