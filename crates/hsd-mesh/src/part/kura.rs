//! Deep openings: stepped jambs and open leaves of storehouses, dark passages.

use crate::mesh::panel::Rect;
use crate::part::bars::frame;
use crate::part::bay::{Bay, Layer};
use hsd_ir::catalog::Below;
use hsd_ir::catalog::body::{Depth, Jambs, Open, Place};
use hsd_ir::catalog::value::Sides;
use hsd_ir::material::SurfaceId;

/// Thickness of the walls of a passage, metres.
const LINING: f64 = 0.020;

/// Adds two walls, a ceiling, a floor and an end behind the opening.
pub(crate) fn depth(bay: &mut Bay<'_>, passage: &Depth, finish: SurfaceId, rect: Rect) {
    let start = -0.050;
    // A shallow house has no room for the whole of it.
    let depth = match bay.part.below {
        Below::Open => passage.depth.0.min(bay.room),
        _ => passage.depth.0,
    };
    let run = Layer {
        front: start,
        thick: depth,
    };
    bay.block(finish, rect.across(rect.x0, rect.x0 + LINING), run);
    bay.block(finish, rect.across(rect.x1 - LINING, rect.x1), run);
    let between = rect.shrunk(LINING, 0.0);
    bay.block(finish, between.between(rect.z1 - LINING, rect.z1), run);
    let earth = SurfaceId::named("earth");
    bay.block(earth, between.between(rect.z0, rect.z0 + LINING), run);
    let end = Layer {
        front: start - depth + LINING,
        thick: LINING,
    };
    bay.block(passage.end, between.shrunk(0.0, LINING), end);
}

/// Adds nested frames, each one step farther back.
pub(crate) fn jambs(bay: &mut Bay<'_>, jambs: &Jambs, place: &Place, rect: Rect) {
    let size = jambs.size.0;
    // A door has no jamb at its foot.
    let sides = Sides {
        bottom: rect.z0 > 0.01,
        ..Sides::ALL
    };
    let mut inner = rect;
    for i in 0..jambs.count {
        if inner.width() < 3.0 * size || inner.height() < 3.0 * size {
            return;
        }
        let back = size * f64::from(i);
        let step = Place {
            front: hsd_ir::catalog::value::Mm(place.front.0 - back),
            thick: hsd_ir::catalog::value::Mm((place.thick.0 - back).max(size)),
            ..place.clone()
        };
        frame(bay, size, sides, &step, inner);
        let low = if sides.bottom { size } else { 0.0 };
        inner = inner
            .shrunk(size, 0.0)
            .between(inner.z0 + low, inner.z1 - size);
    }
}

/// Adds leaves open at right angles to the wall: slabs that get smaller in steps towards the opening.
pub(crate) fn open(bay: &mut Bay<'_>, open: &Open, place: &Place, rect: Rect) {
    let n = open.count.max(1);
    let step = place.thick.0 / f64::from(n);
    let reach = open.out.0;
    for i in 0..n {
        let inset = open.size.0 * f64::from(i);
        let height = rect.between(rect.z0 + inset, rect.z1 - inset);
        let slab = Layer {
            front: place.front.0 + reach - inset,
            thick: reach - 2.0 * inset,
        };
        let (a, b) = (step * f64::from(i), step * f64::from(i + 1));
        // The thick side of each leaf is turned away from the opening.
        let outer = 0.110_f64.min(rect.x0);
        if open.sides.left {
            let x = rect.x0 - outer;
            bay.block(place.finish, height.across(x + a, x + b), slab);
        }
        if open.sides.right {
            let x = rect.x1 + outer;
            bay.block(place.finish, height.across(x - b, x - a), slab);
        }
    }
}
