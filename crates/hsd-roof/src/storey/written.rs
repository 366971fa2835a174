//! Written roofs as seen by the automatic regions beside them: roofs to lean on and to run into.

use crate::region::{Beside, Region, Role};
use crate::shape::look::Look;
use crate::storey::forms::Context;
use crate::storey::placed_line::{PlacedLine, falls_to, ridge};
use hsd_ir::ast::RoofShape;

/// Written roofs that are lower than the walls by more than this cannot be leaned on, metres.
const LOWER: f64 = 0.3;

/// A written roof beside automatic ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Written {
    /// Its region, as input to the rules.
    pub(crate) beside: Beside,
    /// Its look.
    pub(crate) look: Look,
    /// Height of its wall plate, metres.
    pub(crate) base: f64,
    /// The number of written roofs before it at the storey's own height.
    pub(crate) before: usize,
}

/// Returns the roofs among some lines of one storey that others may lean on.
pub(crate) fn trunks(lines: &[&PlacedLine<'_>], context: &Context<'_>) -> Vec<Written> {
    let top = context.level.storey.z1;
    let mut before = 0;
    let mut found = Vec::new();
    for one in lines {
        if let Some((roof, look)) = seen(one, context).filter(|_| one.base > top - LOWER) {
            let level = one.base == top;
            found.push(Written {
                beside: Beside { roof, level },
                look,
                base: one.base,
                before,
            });
        }
        before += usize::from(one.base == top);
    }
    found
}

/// Returns a roof line as a region, and its look; none for flat and hanging ones.
fn seen(one: &PlacedLine<'_>, context: &Context<'_>) -> Option<(Region, Look)> {
    let style = Some(&one.line.style);
    let main = Region::main(one.cell);
    match one.shape {
        RoofShape::Pent | RoofShape::Flat => None,
        shape if shape.stands_on_another() => None,
        RoofShape::LeanTo => {
            let near = falls_to(one);
            let depth = context.metres(near.measure(&one.cell).1);
            let roof = Region {
                ridge: None,
                fall: Some(near),
                role: Role::LeanTo,
                ..main
            };
            Some((roof, Look::lean_to(style, context.style, depth)))
        }
        _ => {
            let wish = one.line.direction.and_then(|d| ridge(d.value));
            let run = context.ridge(&one.cell, &one.line.style, wish);
            let look = context.gable_look(&one.cell, run, style);
            let roof = Region {
                ridge: Some(run),
                ..main
            };
            Some((roof, look))
        }
    }
}
