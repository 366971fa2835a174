//! What looks like a wall but holds on to nothing: leaves that stand open, strokes of writing on the edges of mats.

use super::Read;
use crate::plan::legend::Role;

/// How clearly a post has to stand so that it holds the end of a wall.
const LEAST_POST: f64 = 0.7;
/// The longest stroke of writing, units.
const LONGEST: usize = 2;

/// Level lines from above, upright lines from the left.
type Sides = [Vec<Vec<Read>>; 2];

/// Removes leaves and short walls that have an end where no post stands and no other wall.
///
/// A leaf that stands open across its wall looks like the door itself; it is held by its hinge alone.
pub(super) fn remove(sides: &mut Sides, posts: &[Vec<f64>]) {
    for leaves in [true, false] {
        let is_meant = |role: Role| match leaves {
            true => role == Role::Hinged,
            false => role.parts(),
        };
        let mut loose = Vec::new();
        for side in 0..2 {
            for (line, reads) in sides[side].iter().enumerate() {
                let longest = if leaves { 1 } else { LONGEST };
                for run in runs(reads, &is_meant, longest) {
                    let is_held = |at: usize| holds(sides, posts, (side, line, at), leaves);
                    if !is_held(run.start) || !is_held(run.end) {
                        loose.push((side, line, run));
                    }
                }
            }
        }
        for (side, line, run) in loose {
            sides[side][line][run].fill(Read::EMPTY);
        }
    }
}

/// Stretches of a line that are meant, no longer than that; leaves stand each for itself.
fn runs(
    reads: &[Read],
    is_meant: &dyn Fn(Role) -> bool,
    longest: usize,
) -> Vec<std::ops::Range<usize>> {
    let mut out = Vec::new();
    let mut from = 0;
    while from < reads.len() {
        let end = match longest {
            1 => from + usize::from(is_meant(reads[from].role)),
            _ => {
                from + reads[from..]
                    .iter()
                    .take_while(|r| is_meant(r.role))
                    .count()
            }
        };
        if end > from && end - from <= longest {
            out.push(from..end);
        }
        from = end.max(from + 1);
    }
    out
}

/// Whether something holds the end of a wall at a crossing: a post, a wall that goes on or one across it.
fn holds(
    [level, upright]: &Sides,
    posts: &[Vec<f64>],
    (side, line, at): (usize, usize, usize),
    is_leaf: bool,
) -> bool {
    let (u, v) = if side == 0 { (at, line) } else { (line, at) };
    let stands = |reads: &[Vec<Read>], line: usize, at: Option<usize>| {
        let read = at.and_then(|at| reads.get(line)?.get(at));
        read.is_some_and(|r| r.role.parts() && !(is_leaf && r.role == Role::Hinged))
    };
    let across = match side {
        0 => stands(upright, u, Some(v)) || stands(upright, u, v.checked_sub(1)),
        _ => stands(level, v, Some(u)) || stands(level, v, u.checked_sub(1)),
    };
    // The wall in question is one of the two of its own line.
    let along = match side {
        0 => stands(level, v, Some(u)) && stands(level, v, u.checked_sub(1)),
        _ => stands(upright, u, Some(v)) && stands(upright, u, v.checked_sub(1)),
    };
    let beside = match (is_leaf, side) {
        (false, _) => along,
        (true, 0) => stands(level, v, Some(u)) || stands(level, v, u.checked_sub(1)),
        (true, _) => stands(upright, u, Some(v)) || stands(upright, u, v.checked_sub(1)),
    };
    across || beside || posts[v][u] > LEAST_POST
}
