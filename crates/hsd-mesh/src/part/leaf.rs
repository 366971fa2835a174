//! Sliding leaves: board doors, lattice doors, shoji, sashes.

use crate::mesh::panel::Rect;
use crate::part::bars::middles;
use crate::part::bay::{Bay, Layer};
use hsd_ir::catalog::body::{Leaf, Place};
use hsd_ir::material::SurfaceId;

/// Clearance between two tracks, metres.
const TRACK: f64 = 0.003;

/// Open joint between leaves one above another, metres.
const JOINT: f64 = 0.006;

/// Offset of every other board of a leaf, metres.
const PLANK: f64 = 0.0025;

/// Adds leaves side by side on two tracks, the left one of each pair in front; neighbours overlap by a stile.
pub(crate) fn leaves(bay: &mut Bay<'_>, leaf: &Leaf, place: &Place, rect: Rect) {
    let stack = leaf.stack.max(1);
    let step = rect.height() / f64::from(stack);
    for i in 0..stack {
        let foot = rect.z0 + step * f64::from(i);
        let gap = if i + 1 == stack { 0.0 } else { JOINT };
        row(bay, leaf, place, rect.between(foot, foot + step - gap));
    }
}

/// Adds leaves of one height.
fn row(bay: &mut Bay<'_>, leaf: &Leaf, place: &Place, rect: Rect) {
    let n = leaf.leaves.max(1);
    let stile = leaf.stile.0.min(rect.width() / f64::from(4 * n));
    let width = (rect.width() + f64::from(n - 1) * stile) / f64::from(n);
    for i in 0..n {
        let x0 = rect.x0 + f64::from(i) * (width - stile);
        let back = if i % 2 == 0 {
            0.0
        } else {
            place.thick.0 + TRACK
        };
        let layer = Layer {
            front: place.front.0 - back,
            thick: place.thick.0,
        };
        let own = rect.across(x0, x0 + width);
        one(bay, leaf, place.finish, layer, stile, own);
        if leaf.pull.0 > 0.0 {
            // Each leaf is pulled at the stile that no other covers.
            let left = n > 1 && i == 0;
            pull(bay, leaf.pull.0, layer, stile, own, left);
        }
    }
}

/// Adds a recessed iron pull on a stile, slightly below the middle of the leaf.
fn pull(bay: &mut Bay<'_>, size: f64, layer: Layer, stile: f64, rect: Rect, left: bool) {
    let half = (size / 2.0).min(rect.height() / 8.0);
    let z = rect.z0 + (rect.height() * 0.46).min(0.85);
    let x0 = if left { rect.x0 } else { rect.x1 - stile };
    let plate = Layer {
        front: layer.front + 0.0015,
        thick: 0.004,
    };
    let across = rect.across(x0 + stile * 0.22, x0 + stile * 0.78);
    bay.block(
        SurfaceId::named("iron"),
        across.between(z - half, z + half),
        plate,
    );
}

/// Adds one leaf: stiles, rails, infill, and the bars in front of it.
fn one(bay: &mut Bay<'_>, leaf: &Leaf, wood: SurfaceId, layer: Layer, stile: f64, rect: Rect) {
    let rail = leaf.rail.0.min(rect.height() / 4.0);
    bay.block(wood, rect.across(rect.x0, rect.x0 + stile), layer);
    bay.block(wood, rect.across(rect.x1 - stile, rect.x1), layer);
    let inner = rect.shrunk(stile, 0.0);
    bay.block(wood, inner.between(rect.z0, rect.z0 + rail), layer);
    bay.block(wood, inner.between(rect.z1 - rail, rect.z1), layer);
    let mut field = inner.shrunk(0.0, rail);
    let pane = Layer {
        front: layer.front - layer.thick * 0.6,
        thick: layer.thick * 0.2,
    };
    if leaf.dado.0 > 0.0 && field.height() > leaf.dado.0 + 0.2 {
        let top = field.z0 + leaf.dado.0;
        let board = Layer {
            front: layer.front - layer.thick * 0.3,
            thick: layer.thick * 0.4,
        };
        bay.block(
            SurfaceId::named("boards"),
            field.between(field.z0, top),
            board,
        );
        bay.block(wood, field.between(top, top + rail), layer);
        field.z0 = top + rail;
    }
    let planks = leaf.planks.max(1);
    let wide = field.width() / f64::from(planks);
    for i in 0..planks {
        let back = f64::from(i % 2) * PLANK.min(pane.thick / 2.0);
        let layer = Layer {
            front: pane.front - back,
            thick: pane.thick - back,
        };
        let x = field.x0 + wide * f64::from(i);
        bay.block(leaf.pane, field.across(x, x + wide), layer);
    }
    grid(bay, leaf, wood, layer, field);
}

/// Adds rails, bars and glazing bars in front of the infill of the leaf.
fn grid(bay: &mut Bay<'_>, leaf: &Leaf, wood: SurfaceId, layer: Layer, field: Rect) {
    // Level pieces lie a little behind upright ones: they are let into them.
    let upright = Layer {
        front: layer.front - 0.002,
        thick: layer.thick * 0.55,
    };
    let level = Layer {
        front: layer.front - 0.005,
        thick: layer.thick * 0.5,
    };
    let bar = |x: f64, half: f64, bay: &mut Bay<'_>| {
        bay.block(wood, field.across(x - half, x + half), upright);
    };
    for x in middles(leaf.bars, field.x0, field.x1, false) {
        bar(x, leaf.barsize.0 / 2.0, bay);
    }
    for x in middles(leaf.cols.max(1) - 1, field.x0, field.x1, false) {
        bar(x, leaf.muntin.0 / 2.0, bay);
    }
    for z in middles(leaf.rails, field.z0, field.z1, false) {
        let half = leaf.railsize.0 / 2.0;
        bay.block(wood, field.between(z - half, z + half), level);
    }
    for z in middles(leaf.rows.max(1) - 1, field.z0, field.z1, false) {
        let half = leaf.muntin.0 / 2.0;
        bay.block(wood, field.between(z - half, z + half), level);
    }
}
