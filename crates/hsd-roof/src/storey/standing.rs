//! What stands on the roofs of a storey: gables on a slope, monitors on a ridge, and fire walls. They are roofs of the same
//! group as the one below, so that valleys, cuts and closed solids are made as everywhere.

pub(crate) mod dormer;
pub(crate) mod host;
pub(crate) mod monitor;
pub(crate) mod udatsu;

use crate::shape::form::RoofDraft;
use crate::storey::forms::Context;
use crate::storey::placed_line::PlacedLine;
use hsd_base::diagnostic::Diagnostics;
use hsd_ir::ast::RoofShape;

/// Returns the roofs of those lines that stand on the roofs planned so far, in order; what has no slope under it is reported and left out.
pub(crate) fn planned(
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
