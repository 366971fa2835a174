//! Boxes in front of the wall: de-goshi, oriels, handrails, balcony railings.

use crate::mesh::panel::Rect;
use crate::part::bars::middles;
use crate::part::bay::{Bay, Layer};
use crate::part::canopy::canopy;
use crate::part::detail::elements;
use hsd_ir::catalog::body::{Element, Oriel};

/// Adds corner posts, sides, floor, ceiling, roof and the arms that carry the box; the children form its front.
pub(crate) fn oriel(bay: &mut Bay<'_>, oriel: &Oriel, element: &Element, rect: Rect) {
    let place = &element.place;
    let layer = Layer::from(place);
    let post = oriel.post.0;
    // Posts lie a little inside the planes of the front's rails, which run through; the sides' rails lie inside
    // the posts.
    let front = Layer {
        front: layer.front - 0.001,
        thick: post - 0.003,
    };
    let ends = [
        (rect.x0 + 0.001, rect.x0 + post, false),
        (rect.x1 - post, rect.x1 - 0.001, true),
    ];
    for (x0, x1, right) in ends {
        let upright = rect.across(x0, x1).shrunk(0.0, 0.002);
        bay.block(place.finish, upright, front);
        side(
            bay,
            oriel,
            element,
            rect.across(x0, x1).shrunk(0.003, 0.0),
            right,
        );
    }
    let inner = Layer {
        front: layer.front - post,
        thick: layer.thick - post,
    };
    let within = rect.shrunk(0.003, 0.0);
    if oriel.floor {
        let board = within.between(rect.z0 + 0.008, rect.z0 + 0.032);
        bay.block(place.finish, board, inner);
    }
    if oriel.eaves.0 > 0.0 {
        let board = within.between(rect.z1 - 0.032, rect.z1 - 0.008);
        bay.block(place.finish, board, inner);
        let run = (layer.front - layer.thick, layer.front);
        canopy(bay, oriel, place.finish, rect, run);
    }
    arms(bay, oriel, element, rect);
    elements(bay, &element.children, Some(rect));
}

/// Adds one side: two rails from the wall to the corner post, bars between them, and thin rails through the bars. Bars
/// are near the outer face, as on the front.
fn side(bay: &mut Bay<'_>, oriel: &Oriel, element: &Element, rect: Rect, right: bool) {
    let place = &element.place;
    let (front, back) = (place.front.0 - oriel.post.0, place.front.0 - place.thick.0);
    let run = Layer {
        front,
        thick: front - back,
    };
    let rail = 0.040_f64.min(rect.height() / 5.0);
    let (z0, z1) = (rect.z0 + 0.004, rect.z1 - 0.004);
    bay.block(place.finish, rect.between(z0, rect.z0 + rail), run);
    bay.block(place.finish, rect.between(rect.z1 - rail, z1), run);
    let size = oriel
        .sidesize
        .0
        .min(run.thick / f64::from(2 * oriel.side + 1));
    // Places counted inwards from the outer face.
    let deep = |from: f64, to: f64| match right {
        false => rect.across(rect.x0 + from, rect.x0 + to),
        true => rect.across(rect.x1 - to, rect.x1 - from),
    };
    let inside = 0.006_f64.min(rect.width() / 4.0);
    let bar = deep(inside, (inside + size).min(rect.width() - 0.002)).shrunk(0.0, rail);
    for out in middles(oriel.side, back, front, false) {
        let layer = Layer {
            front: out + size / 2.0,
            thick: size,
        };
        bay.block(place.finish, bar, layer);
    }
    if oriel.side > 0 {
        // A stile against the wall, so that the rails do not end in the air.
        let stile = Layer {
            front: (back + 0.055).min(front - size),
            thick: 0.054,
        };
        bay.block(place.finish, rect.shrunk(0.001, 0.006), stile);
    }
    let thin = deep(inside + size * 0.25, inside + size * 0.7);
    for z in middles(oriel.siderails, rect.z0, rect.z1, false) {
        bay.block(place.finish, thin.between(z - 0.012, z + 0.012), run);
    }
}

/// Adds brackets under the foot with a slanting cut.
fn arms(bay: &mut Bay<'_>, oriel: &Oriel, element: &Element, rect: Rect) {
    let place = &element.place;
    let (front, back) = (place.front.0 - 0.040, place.front.0 - place.thick.0);
    let deep = 0.105_f64.min(rect.z0 - 0.005);
    if deep < 0.03 {
        return;
    }
    // Let into the box a little.
    let top = rect.z0 + 0.005;
    let outline = [
        (back, rect.z0 - deep),
        (back + 0.06_f64.min((front - back) / 2.0), rect.z0 - deep),
        (front, rect.z0 - deep * 0.4),
        (front, top),
        (back, top),
    ];
    let half = 0.0225;
    let ends = rect.shrunk(half + 0.03, 0.0);
    // As many as have room.
    let count = oriel.arms.min(1 + (ends.width().max(0.0) / 0.12) as u32);
    for x in middles(count, ends.x0, ends.x1, true) {
        bay.profile(place.finish, &outline, x - half, x + half);
    }
}
