//! Follows one loop: units advance the walk, turns change its heading.
//!
//! Voids and turns before the first part (posts count as parts) move the start point and the first
//! heading and leave no wall; after it a void is an open bay of its wall.

use glam::{DVec2, dvec2};
use hsd_base::geometry::Heading;
use hsd_base::source::Span;
use hsd_ir::building::Wall;
use hsd_ir::program::{Content, Loop, WallLine};

/// The turn at the end of a line without a turn letter, degrees.
const RIGHT: f64 = 90.0;

/// A loop with its walls placed, before the check that it closes.
pub(super) struct Walk {
    pub span: Span,
    pub hole: bool,
    /// Walls with a length, in walk order.
    pub walls: Vec<Wall>,
    /// The turn after each wall in degrees, zero-length lines added up; the last one is left out of all sums, since the
    /// last line end always closes the walk.
    pub turns: Vec<f64>,
    /// The end of the walk.
    pub end: DVec2,
    /// The voids before the first part, which move the start.
    pub led: Option<Led>,
}

/// Voids before the first part of a walk.
#[derive(Clone, Copy)]
pub(super) struct Led {
    /// The first of them.
    pub void: Span,
    /// By how much they move the start, units.
    pub by: DVec2,
    /// True if nothing else stands on the first line, and it turns right like any other.
    pub whole_line: bool,
}

/// Places the walls of a loop; `facade` counts them over the storey.
pub(super) fn walk(steps: Loop, facade: &mut u32) -> Walk {
    let mut at = dvec2(steps.start.0, steps.start.1);
    let mut heading = Heading::default();
    let mut out = Walk {
        span: steps.span,
        hole: steps.hole,
        walls: Vec::with_capacity(steps.lines.len()),
        turns: Vec::with_capacity(steps.lines.len()),
        end: at,
        led: None,
    };
    let mut started = false;
    let mut waiting = vec![]; // posts of lines without length stand at the start of the next wall
    for mut line in steps.lines {
        if !started {
            let leading = line
                .units
                .iter()
                .take_while(|u| u.content == Content::Void)
                .count();
            let void = line.units.first().filter(|_| leading > 0).map(|u| u.span);
            let by = heading.vector() * line.units.drain(..leading).map(|u| u.width).sum::<f64>();
            at += by;
            started = !line.units.is_empty();
            if let Some(void) = void {
                let first = Led {
                    void,
                    by: DVec2::ZERO,
                    whole_line: !started && line.turn == RIGHT && heading == Heading::default(),
                };
                let led = out.led.get_or_insert(first);
                led.by += by;
            }
        }
        let length: f64 = line.units.iter().map(|u| u.width).sum();
        let turn = line.turn;
        if length > 0.0 {
            line.units.splice(0..0, waiting.drain(..));
            *facade += 1;
            out.walls.push(wall(line, at, heading, length, *facade));
            out.turns.push(turn);
            at += heading.vector() * length;
        } else {
            waiting.append(&mut line.units);
            if let Some(last) = out.turns.last_mut() {
                *last += turn;
            }
        }
        heading = heading.turned(turn);
    }
    if let Some(last) = out.walls.last_mut() {
        last.units.append(&mut waiting);
    }
    out.end = at;
    out
}

fn wall(line: WallLine, from: DVec2, heading: Heading, length: f64, facade: u32) -> Wall {
    let direction = heading.vector();
    Wall {
        span: line.span,
        facade,
        from,
        to: from + direction * length,
        direction,
        units: line.units,
        reflection: line.reflection,
    }
}
