//! Storeys that overhang the one below (docs/evidence.md 3.8): the projection and the soffit that closes them.
//!
//! Boards lie under the rooms, a beam (dashigeta) runs under the overhanging walls, and brackets
//! (udegi) reach out to it from the walls below, a unit apart.

use crate::facet::Corner;
use crate::frame::{Frame, Plane, Rect, metres};
use crate::messages as say;
use crate::plan::level::Level;
use crate::plan::outline::{Outline, piece};
use crate::region::Side;
use crate::solid::SUNK;
use crate::solid::prism;
use crate::solid::sheet::{Coat, Piece, sheet};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::slabs;
use hsd_ir::building::{Finish, House, Soffit, Solid};

/// Thickness of the boards, metres.
const BOARDS: f64 = 0.03;
/// Gap between the floor and the boards, metres, so that no wall face is coplanar with theirs.
const BELOW: f64 = 0.004;
/// Half the width of the beam, and its depth, metres.
const BEAM: (f64, f64) = (0.06, 0.16);
/// Half the width of the brackets, and their depth, metres.
const ARM: (f64, f64) = (0.045, 0.12);
/// Distance from a wall to the foot of a bracket behind it, metres.
const INTO: f64 = 0.05;
/// The maximum overhang carried by brackets, in U.
const FARTHEST: i64 = 2;
/// The number of cells above which each gets plain boards only; such plans are not intended.
const MANY: usize = 500;
/// The maximum number of pairs of rectangles compared; beyond it the overhang counts as wide as its strips.
const MOST_PAIRS: usize = 4_000_000;

/// Returns the part of an upper storey with nothing below; `None` if the plans are too complex.
fn over_nothing(lower: &Level<'_>, upper: &Level<'_>) -> Option<Vec<Cell>> {
    let plain = !lower.is_open() && lower.orthogonal && upper.orthogonal;
    if !plain || lower.plan == upper.plan || !upper.plan.fits(Some(&lower.plan)) {
        return None;
    }
    let cells = slabs::strips(&upper.plan.difference(&lower.plan));
    (!cells.is_empty()).then_some(cells)
}

/// Reports the overhang of a storey, and closes it from below.
pub(crate) fn close(
    house: &House,
    lower: &Level<'_>,
    upper: &Level<'_>,
    soffits: &mut Vec<Soffit>,
    out: &mut Diagnostics,
) {
    let Some(over) = over_nothing(lower, upper) else {
        return;
    };
    let by = reach(&over, &slabs::strips(&lower.plan));
    let (number, units) = (lower.storey.number, by as f64 / STEPS as f64);
    if by > STEPS {
        let (above, below) = (upper.storey.span, lower.storey.span);
        out.push(say::overhang(above, below, number, units));
    } else {
        out.push(say::jutting(upper.storey.span, number, units));
    }
    let carpenter = Carpenter {
        unit: house.unit,
        floor: upper.storey.z0,
        below: Outline::of(&lower.plan.clean()),
        above: Outline::of(&upper.plan.clean()),
    };
    soffits.push(Soffit {
        storey: upper.storey.number,
        solids: carpenter.all(&over),
    });
}

/// Returns the greatest distance of a corner or middle of `over` from the cells `below`, in grid steps: the
/// projection beyond the walls below, in whatever direction the storey overhangs.
fn reach(over: &[Cell], below: &[Cell]) -> i64 {
    if over.len().saturating_mul(below.len()) > MOST_PAIRS {
        let thickness = over.iter().map(|c| c.width().min(c.depth()));
        return thickness.max().unwrap_or(0);
    }
    let distance = |(a, b): (i64, i64)| {
        let from = |c: &Cell| {
            let beside = (c.a0 - a).max(a - c.a1);
            let before = (c.b0 - b).max(b - c.b1);
            beside.max(before).max(0)
        };
        below.iter().map(from).min().unwrap_or(i64::MAX)
    };
    let points = over.iter().flat_map(|c| {
        let middle = ((c.a0 + c.a1) / 2, (c.b0 + c.b1) / 2);
        c.corners().into_iter().chain([middle])
    });
    points.map(distance).max().unwrap_or(0)
}

/// Shared data for laying the boards.
struct Carpenter {
    unit: f64,
    /// Height of the upper storey's floor, metres.
    floor: f64,
    below: Outline,
    above: Outline,
}

impl Carpenter {
    fn all(&self, over: &[Cell]) -> Vec<Solid> {
        let mut solids = self.boards(over);
        if over.len() <= MANY {
            for cell in over {
                for side in Side::ALL {
                    self.beams(cell, side, &mut solids);
                    self.brackets(cell, side, &mut solids);
                }
            }
        }
        solids
    }

    fn boards(&self, over: &[Cell]) -> Vec<Solid> {
        let coat = Coat {
            top: Finish::Soffit,
            rim: Finish::Soffit,
            joint: Finish::Soffit,
            soffit: Finish::Soffit,
        };
        let piece = |cell: &Cell| -> Piece {
            let corners = Rect::of(cell, self.unit).corners();
            let corners = corners.map(|at| Corner { at, rim: true });
            (
                corners.into_iter().collect(),
                Plane::level(self.floor - BELOW),
            )
        };
        let pieces: Vec<Piece> = over.iter().map(piece).collect();
        let together = if pieces.len() > MANY { 1 } else { MANY };
        let parts = pieces.chunks(together);
        parts
            .flat_map(|p| sheet(p, BOARDS, &coat, f64::MIN))
            .collect()
    }

    /// Returns the top of the brackets, sunk into the boards.
    fn top(&self) -> f64 {
        self.floor - BELOW - BOARDS + SUNK
    }

    /// Adds beams under the upper storey's walls over this side.
    fn beams(&self, cell: &Cell, side: Side, solids: &mut Vec<Solid>) {
        let (half, deep) = BEAM;
        // Those along the ridge are slightly lower, so that at corners no faces lie in one plane.
        let across = matches!(side, Side::Left | Side::Right);
        let lower = if across { 0.002 } else { 0.0 };
        let (line, _, _) = piece(cell, side);
        for (lo, hi) in self.above.along(cell, side) {
            let on = |line: i64, lo: i64, hi: i64| match across {
                true => Cell {
                    a0: line,
                    b0: lo,
                    a1: line,
                    b1: hi,
                },
                false => Cell {
                    a0: lo,
                    b0: line,
                    a1: hi,
                    b1: line,
                },
            };
            let rect = Rect::of(&on(line, lo, hi), self.unit).grown(half);
            // Up to the walls on it, so that no light falls in between.
            let (top, foot) = (self.floor + 0.004 - lower, self.floor - deep - lower);
            let profile = rect.corners().map(|p| p.extend(foot));
            let by = glam::DVec3::Z * (top - foot);
            solids.push(prism(&profile, by, Finish::Timber));
        }
    }

    /// Adds brackets from the lower storey's walls along this side to the other side of the cell.
    fn brackets(&self, cell: &Cell, side: Side, solids: &mut Vec<Solid>) {
        let (_, depth) = side.measure(cell);
        if depth > FARTHEST * STEPS {
            return;
        }
        let (half, deep) = ARM;
        let (top, foot) = (self.top() - 0.004, self.floor - deep);
        for (lo, hi) in self.below.along(cell, side) {
            let part = match side {
                Side::Front | Side::Back => Cell {
                    a0: lo,
                    a1: hi,
                    ..*cell
                },
                Side::Left | Side::Right => Cell {
                    b0: lo,
                    b1: hi,
                    ..*cell
                },
            };
            let frame = Frame::new(&Rect::of(&part, self.unit), side);
            let (length, reach) = (frame.length, metres(depth, self.unit));
            if length < 4.0 * half {
                continue;
            }
            // In the middle of each unit, away from corners and beams.
            let count = (length / self.unit).round().clamp(1.0, 500.0);
            for i in 0..count as u32 {
                let u = (f64::from(i) + 0.5) * length / count;
                let section = [
                    (u - half, foot),
                    (u + half, foot),
                    (u + half, top),
                    (u - half, top),
                ];
                let profile = section.map(|(u, z)| frame.point(u, -INTO, z));
                let by = (frame.inward() * (INTO + reach)).extend(0.0);
                solids.push(prism(&profile, by, Finish::Timber));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::storey::overhang::*;

    fn cell(a0: i64, b0: i64, a1: i64, b1: i64) -> Cell {
        Cell { a0, b0, a1, b1 }
    }

    #[test]
    fn a_storey_reaches_as_far_as_its_farthest_corner() {
        let below = [cell(0, 0, 8, 6)];
        assert_eq!(reach(&[cell(0, -1, 8, 0)], &below), 1);
        assert_eq!(reach(&[cell(-2, -1, 8, 0)], &below), 2);
        // A thin strip far away still overhangs.
        assert_eq!(reach(&[cell(0, 9, 8, 10)], &below), 4);
        // A bridge is carried on both sides.
        assert_eq!(
            reach(&[cell(8, 0, 12, 6)], &[below[0], cell(12, 0, 20, 6)]),
            2
        );
    }
}
