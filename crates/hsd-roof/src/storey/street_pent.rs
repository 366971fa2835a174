//! The pent roof that a two-storey street house gets by itself.

use crate::plan::level::{Level, Point, first_line};
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::Cell;
use hsd_ir::ast::{RoofMode, RoofShape};
use hsd_ir::building::House;

/// Returns the rectangle of the pent roof added automatically to a two-storey street house (docs/evidence.md 4.5).
pub(crate) fn street_pent(house: &House, levels: &[Level<'_>]) -> Option<Cell> {
    let hisashi =
        |l: &hsd_ir::ast::RoofLine| l.style.shape.is_some_and(|s| s.value == RoofShape::Pent);
    if !house.street
        || house.roofs.mode == RoofMode::Explicit
        || house.roofs.lines.iter().any(hisashi)
    {
        return None;
    }
    let [ground, upper, ..] = levels else {
        return None;
    };
    let (p, q) = first_line(ground.storey)?;
    let (r, s) = first_line(upper.storey)?;
    let depth = (3.0 * hsd_base::geometry::SHAKU / house.unit * STEPS as f64).round() as i64;
    before_line([p, q, r, s], depth)
}

/// Returns the rectangle before the line from p to q, if the one from r to s lies on it.
fn before_line([p, q, r, s]: [Point; 4], depth: i64) -> Option<Cell> {
    let (lines, turned) = match (p.1 == q.1, p.0 == q.0) {
        (true, false) => ([p, q, r, s], false),
        (false, true) => ([p, q, r, s].map(|(a, b)| (b, a)), true),
        _ => return None,
    };
    let [p, q, r, s] = lines;
    let overlap = r.0.min(s.0) < p.0.max(q.0) && p.0.min(q.0) < r.0.max(s.0);
    if r.1 != p.1 || s.1 != p.1 || !overlap {
        return None;
    }
    // Outward of a walk with the interior on its right; exchanging the axes mirrors it.
    let before = (q.0 > p.0) != turned;
    let (b0, b1) = if before {
        (p.1 - depth, p.1)
    } else {
        (p.1, p.1 + depth)
    };
    let cell = Cell {
        a0: p.0.min(q.0),
        b0,
        a1: p.0.max(q.0),
        b1,
    };
    Some(if turned {
        Cell {
            a0: cell.b0,
            b0: cell.a0,
            a1: cell.b1,
            b1: cell.a1,
        }
    } else {
        cell
    })
}
