//! Checks that a walk closes (C1, C2 of docs/evidence.md 2.3), and finds the line or turn that would close it if not.

use super::text;
use super::walk::Walk;
use crate::messages::plan::{self, ClosingFix};
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::Edit;
use hsd_base::geometry::{Heading, SAME, area2};
use hsd_ir::building::Wall;
use hsd_ir::program::Drawn;
use std::ops::Range;

/// A closing error up to this share of the length is spread over a ring of facades, and over a walk with odd angles, whose
/// corners are measured or cannot be written exactly (docs/contract.md 3).
const MEASURED_ERROR: f64 = 0.01;
/// The sine of the angle by which a measured wall may miss its axis: one degree.
pub(super) const MEASURED_ANGLE: f64 = 0.017_452_406_437_283_51;
/// Walks with up to this many degrees of written turns may stay open: a facade, not a house.
const OPEN_TURNS: f64 = 180.0;
/// Plans beyond this many U are taken for a mistake, and exceed the precision of later passes.
const LARGEST: f64 = 100_000.0;

/// Checks a walk, spreads a small closing error, and returns whether the walk bounds an area.
pub(super) fn close(walk: &mut Walk, drawn: Drawn, out: &mut Diagnostics) -> bool {
    let ring = drawn != Drawn::Rows;
    if let Some(far) = walk
        .walls
        .iter()
        .find(|w| w.to.abs().max_element() > LARGEST)
    {
        out.push(plan::too_large(far.span, LARGEST));
        return false;
    }
    if let Some(i) = (0..walk.turns.len() - 1).find(|&i| walk.turns[i].rem_euclid(360.0) == 180.0) {
        out.push(plan::turns_back(walk.walls[i].span, walk.walls[i + 1].span));
        return false;
    }
    let start = walk.walls[0].from;
    let gap = walk.end - start;
    let length: f64 = walk.walls.iter().map(|w| w.from.distance(w.to)).sum();
    let odd = walk.turns.iter().any(|t| t.rem_euclid(90.0) != 0.0);
    let allowed = match ring || odd {
        true => (length * MEASURED_ERROR).max(SAME),
        false => SAME,
    };
    let closes = gap.length() <= allowed && closes_with(walk, written(walk));
    if ring && !closes && is_interior(walk, length) {
        out.push(plan::interior_angles(walk.span, walk.turns[0]));
        return false;
    }
    if gap.length() > allowed {
        report_gap(walk, ring, gap, length, out);
        return false;
    }
    // An outline that is more than one circle crosses itself, which says more.
    if drawn != Drawn::Outline && !turns_close(walk, out) {
        return false;
    }
    if gap.length() > 0.0 {
        spread(&mut walk.walls, gap, length);
    }
    true
}

/// Returns true if a ring closes once its angles are taken for those between the walls.
fn is_interior(walk: &Walk, length: f64) -> bool {
    let between = |turn: f64| 180.0 - turn;
    let inner = &walk.turns[..walk.turns.len() - 1];
    let sum = inner.iter().map(|t| between(*t)).sum();
    if !closes_with(walk, sum) {
        return false;
    }
    let turns = walk.turns.iter().map(|t| between(*t));
    let (mut at, mut heading) = (DVec2::ZERO, Heading::default());
    for (wall, turn) in walk.walls.iter().zip(turns) {
        at += heading.vector() * wall.from.distance(wall.to);
        heading = heading.turned(turn);
    }
    at.length() <= (length * MEASURED_ERROR).max(SAME)
}

/// Returns the sum of the turns between walls, degrees, without the closing one.
fn written(walk: &Walk) -> f64 {
    walk.turns[..walk.turns.len() - 1].iter().sum()
}

/// Returns the required sum of turns including the closing one, degrees: a full turn, negative for holes.
fn once_round(walk: &Walk) -> f64 {
    if walk.hole { -360.0 } else { 360.0 }
}

/// Returns true if a closing turn of less than half a circle completes the sum.
fn closes_with(walk: &Walk, written: f64) -> bool {
    (once_round(walk) - written).abs() < 180.0 - 1e-6
}

fn turns_close(walk: &Walk, out: &mut Diagnostics) -> bool {
    let written = written(walk);
    let corners: Vec<DVec2> = walk.walls.iter().map(|w| w.from).collect();
    let backwards = area2(&corners) * once_round(walk) < 0.0;
    if closes_with(walk, written) {
        return true;
    }
    if closes_with(walk, -written) && backwards {
        out.push(plan::wrong_way_round(walk.span, walk.hole, mirrored(walk)));
    } else {
        out.push(plan::wrong_turns(
            walk.span,
            (once_round(walk) - written) / 90.0,
        ));
    }
    false
}

fn report_gap(walk: &Walk, ring: bool, gap: DVec2, length: f64, out: &mut Diagnostics) {
    let last = walk.walls[walk.walls.len() - 1].span;
    let written = written(walk);
    if ring {
        if written.abs() > OPEN_TURNS + 1e-6 {
            out.push(plan::ring_open(
                walk.span,
                last,
                gap.length() / length * 100.0,
                gap.length(),
            ));
        }
        return;
    }
    if let Some(led) = walk.led.filter(|led| (gap + led.by).length() < SAME) {
        out.push(plan::void_moves_start(led.void, led.by.length()));
        return;
    }
    let open = written <= OPEN_TURNS && !walk.hole;
    if let Some(i) = wrong_turn(walk, written, gap) {
        let (wall, turn) = (&walk.walls[i], walk.turns[i]);
        let fix = text::turn_back(wall, turn);
        out.push(plan::turn_to_flip(wall.span, turn < 0.0, open, fix));
    } else if let Some(i) = moved_turn(walk, written) {
        let fix = flipped(walk, i..i + 2);
        let (line, other) = (walk.walls[i].span, walk.walls[i + 1].span);
        let is_left = walk.turns[i] < 0.0;
        out.push(plan::turn_to_move(line, other, is_left, open, fix));
    } else if open {
        out.push(plan::open_facade(walk.span, gap));
    } else {
        out.push(plan::open_perimeter(last, gap, &fixes(walk, gap)));
    }
}

/// Returns the line end whose turn, reversed, closes the walk: the rest of it is then rotated by half a circle about
/// that corner.
fn wrong_turn(walk: &Walk, written: f64, gap: DVec2) -> Option<usize> {
    let start = walk.walls[0].from;
    (0..walk.turns.len() - 1).find(|&i| {
        let turn = walk.turns[i];
        let corner = walk.walls[i].to;
        let flipped = corner * 2.0 - (start + gap);
        let fits = turn.abs() == 90.0 && closes_with(walk, written - 2.0 * turn);
        fits && flipped.distance(start) < SAME
    })
}

/// Returns the first of two neighbouring line ends whose turns, exchanged, close the walk: the line between them then
/// runs in the opposite direction.
fn moved_turn(walk: &Walk, written: f64) -> Option<usize> {
    let start = walk.walls[0].from;
    let mut between = 0..walk.turns.len().saturating_sub(2);
    between.find(|&i| {
        let (turn, next, line) = (walk.turns[i], walk.turns[i + 1], &walk.walls[i + 1]);
        let fits = turn.abs() == 90.0 && next == -turn && closes_with(walk, written);
        let end = walk.end - (line.to - line.from) * 2.0;
        fits && end.distance(start) < SAME
    })
}

/// Returns the edits that reverse the turns of some line ends; none if one of them cannot be changed.
fn flipped(walk: &Walk, range: Range<usize>) -> Vec<Edit> {
    let edits = range.map(|i| text::turn_back(&walk.walls[i], walk.turns[i]));
    edits.collect::<Option<_>>().unwrap_or_default()
}

/// Returns the same edits for all line ends except the last, which closes the walk.
fn mirrored(walk: &Walk) -> Vec<Edit> {
    flipped(walk, 0..walk.turns.len() - 1)
}

/// Returns for each axis of the gap the lines that could close it, the last first: an author has just written those.
fn fixes(walk: &Walk, gap: DVec2) -> Vec<Vec<ClosingFix>> {
    let mut found = vec![];
    for axis in [DVec2::X, DVec2::Y] {
        let missing = -gap.dot(axis);
        if missing.abs() < SAME {
            continue;
        }
        let along = walk
            .walls
            .iter()
            .rev()
            .filter(|w| w.direction.perp_dot(axis).abs() < MEASURED_ANGLE);
        let fitting = along.filter_map(|w| {
            let (length, by) = (w.from.distance(w.to), missing * w.direction.dot(axis));
            (length + by > SAME).then_some(ClosingFix {
                line: w.span,
                length,
                by,
                edit: text::resize(w, by),
            })
        });
        found.push(fitting.take(2).collect());
    }
    found
}

/// Stretches and shortens the walls of a nearly closed ring until it closes: by least squares, long walls
/// taking more than short ones, so that every wall keeps its direction and right angles stay right. Where
/// that would change a wall too much (a gap as long as the walls along it), corners move instead.
fn spread(walls: &mut [Wall], gap: DVec2, length: f64) {
    if !stretch(walls, gap) {
        shear(walls, gap, length);
    }
}

/// The largest share by which a wall may be stretched or shortened.
const MOST_STRETCH: f64 = 0.25;

/// Stretches the walls: a wall of length l and direction d changes by l (d . k); the sum of all changes cancels the
/// gap.
fn stretch(walls: &mut [Wall], gap: DVec2) -> bool {
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for wall in &*walls {
        let (l, d) = (wall.from.distance(wall.to), wall.direction);
        aa += l * d.x * d.x;
        ab += l * d.x * d.y;
        bb += l * d.y * d.y;
    }
    let determinant = aa * bb - ab * ab;
    if determinant < 1e-9 {
        return false;
    }
    let k = dvec2(ab * gap.y - bb * gap.x, ab * gap.x - aa * gap.y) / determinant;
    if walls
        .iter()
        .any(|w| w.direction.dot(k).abs() > MOST_STRETCH)
    {
        return false;
    }
    let first = walls[0].from;
    let mut at = first;
    for wall in &mut *walls {
        let share = 1.0 + wall.direction.dot(k);
        let to = at + wall.direction * (wall.from.distance(wall.to) * share);
        (wall.from, wall.to) = (at, to);
        wall.units.iter_mut().for_each(|u| u.width *= share);
        at = to;
    }
    end_at(walls, first);
    true
}

/// Moves the last corners by the rounding error that is left, along walls parallel to an axis, so that
/// these stay exactly parallel to it.
fn end_at(walls: &mut [Wall], first: DVec2) {
    let mut to = first;
    for i in (0..walls.len()).rev() {
        let wall = &mut walls[i];
        wall.to = to;
        match (wall.direction.x == 0.0, wall.direction.y == 0.0) {
            (true, false) => wall.from.x = to.x,
            (false, true) => wall.from.y = to.y,
            _ => return,
        }
        if i == 0 {
            wall.from = first;
        }
        to = wall.from;
    }
}

/// Moves every corner by its share of the gap.
fn shear(walls: &mut [Wall], gap: DVec2, length: f64) {
    let mut walked = 0.0;
    for wall in &mut *walls {
        let before = wall.from.distance(wall.to);
        wall.from -= gap * (walked / length);
        walked += before;
        wall.to -= gap * (walked / length);
        let after = wall.from.distance(wall.to);
        if after > 0.0 && before > 0.0 {
            wall.direction = (wall.to - wall.from) / after;
            for unit in &mut wall.units {
                unit.width *= after / before;
            }
        }
    }
    let first = walls[0].from;
    if let Some(last) = walls.last_mut() {
        last.to = first;
    }
}
