//! Boxes in front of the wall: de-goshi, oriels, handrails, railings of balconies.

use super::bars::middles;
use super::bay::{Bay, Layer, Rect};
use super::detail::elements;
use super::shelter;
use crate::catalog::body::{Element, Oriel};

/// Corner posts, sides, floor, ceiling and roof; the children make its front.
pub(super) fn oriel(bay: &mut Bay<'_>, oriel: &Oriel, element: &Element, rect: Rect) {
    let place = &element.place;
    let layer = Layer::from(place);
    let post = oriel.post.0;
    // Posts lie a millimetre inside the planes of the front's rails, which run through; the sides' rails
    // lie inside the posts.
    let front = Layer {
        front: layer.front - 0.001,
        thick: post - 0.001,
    };
    let ends = [
        (rect.x0 + 0.001, rect.x0 + post),
        (rect.x1 - post, rect.x1 - 0.001),
    ];
    for (x0, x1) in ends {
        bay.block(place.finish, rect.across(x0, x1), front);
        side(bay, oriel, element, rect.across(x0, x1).shrunk(0.003, 0.0));
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
        let run = (layer.front - layer.thick, layer.front + oriel.eaves.0);
        shelter::lean_to(bay, oriel.roof, rect, run, 0.3);
    }
    elements(bay, &element.children, Some(rect));
}

/// One side: two rails from the wall to the corner post, and bars between.
fn side(bay: &mut Bay<'_>, oriel: &Oriel, element: &Element, rect: Rect) {
    let place = &element.place;
    let (front, back) = (place.front.0 - oriel.post.0, place.front.0 - place.thick.0);
    let run = Layer {
        front,
        thick: front - back,
    };
    let rail = 0.040_f64.min(rect.height() / 5.0);
    bay.block(place.finish, rect.between(rect.z0, rect.z0 + rail), run);
    bay.block(place.finish, rect.between(rect.z1 - rail, rect.z1), run);
    let size = 0.020_f64.min(run.thick / f64::from(2 * oriel.side + 1));
    for out in middles(oriel.side, back, front, false) {
        let bar = rect.shrunk(rect.width() * 0.2, rail);
        bay.block(
            place.finish,
            bar,
            Layer {
                front: out + size / 2.0,
                thick: size,
            },
        );
    }
}
