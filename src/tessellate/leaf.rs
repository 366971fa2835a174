//! Sliding leaves: board doors, lattice doors, shoji, sashes.

use super::bars::middles;
use super::bay::{Bay, Layer, Rect};
use crate::catalog::body::{Leaf, Place};
use crate::material::SurfaceId;

/// Clearance between two tracks, metres.
const TRACK: f64 = 0.003;

/// Leaves side by side on two tracks, the left one of each pair in front; neighbours overlap by a stile.
pub(super) fn leaves(bay: &mut Bay<'_>, leaf: &Leaf, place: &Place, rect: Rect) {
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
        one(
            bay,
            leaf,
            place.finish,
            layer,
            stile,
            rect.across(x0, x0 + width),
        );
    }
}

/// One leaf: stiles, rails, what fills it, and the bars before it.
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
    bay.block(leaf.pane, field, pane);
    grid(bay, leaf, wood, layer, field);
}

/// Rails, bars and the bars between panes, in front of what fills the leaf.
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
