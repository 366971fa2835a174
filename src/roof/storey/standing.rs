//! What stands on the roofs of a storey: gables on a slope, monitors on a ridge, and fire walls. They are roofs of the same
//! group as the one below, so that valleys, cuts and closed solids are made as everywhere.

pub(in crate::roof) mod dormer;
pub(in crate::roof) mod host;
pub(in crate::roof) mod monitor;
pub(in crate::roof) mod udatsu;

use crate::ast::RoofShape;
use crate::diagnostic::Diagnostics;
use crate::roof::shape::form::RoofDraft;
use crate::roof::storey::forms::Context;
use crate::roof::storey::placed_line::PlacedLine;

/// Returns the roofs of those lines that stand on the roofs planned so far, in order; what has no slope under it is reported and left out.
pub(in crate::roof) fn planned(
    lines: &[&PlacedLine<'_>],
    roofs: &[RoofDraft],
    context: &Context<'_>,
    out: &mut Diagnostics,
) -> Vec<RoofDraft> {
    let of = |line: &&PlacedLine<'_>| match line.shape {
        RoofShape::Monitor => monitor::planned(line, roofs, context, out),
        RoofShape::FireWall => udatsu::planned(line, roofs, context, out),
        _ => dormer::planned(line, roofs, context, out),
    };
    let above = lines.iter().filter(|line| line.shape.stands_on_another());
    above.filter_map(of).collect()
}
