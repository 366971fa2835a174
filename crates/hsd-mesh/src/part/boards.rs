//! Solid infill of a bay: walls, boards, dados and panels.

use crate::mesh::panel::Rect;
use crate::part::bay::{Bay, Layer};
use glam::dvec2;
use hsd_ir::catalog::body::{Boards, Panels, Place, Wall};
use hsd_ir::catalog::value::Run;
use hsd_ir::material::SurfaceId;

/// Adds the panel of a wall; with a batter, it gets thinner upwards on both sides.
pub(crate) fn wall(bay: &mut Bay<'_>, wall: &Wall, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    if wall.batter == 0.0 {
        bay.block(place.finish, rect, layer);
        return;
    }
    let lean = (wall.batter * rect.height())
        .min(layer.thick / 2.0 - 0.01)
        .max(0.0);
    let back = layer.front - layer.thick;
    let outline = [
        (layer.front, rect.z0),
        (layer.front - lean, rect.z1),
        (back + lean, rect.z1),
        (back, rect.z0),
    ];
    bay.profile(place.finish, &outline, rect.x0, rect.x1);
}

/// Returns the number of pieces of about `size` in a length.
pub(crate) fn pieces(length: f64, size: f64) -> usize {
    ((length / size.max(0.01)).round() as usize).max(1)
}

/// Adds boards side by side over a rectangle; lapped ones lean outwards at their foot.
pub(crate) fn boards(bay: &mut Bay<'_>, boards: &Boards, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    let along = match boards.run {
        Run::Level => rect.height(),
        Run::Upright => rect.width(),
    };
    let n = match boards.count {
        0 => pieces(along, boards.size.0),
        count => count as usize,
    };
    let (size, gap) = (along / n as f64, boards.gap.0 / 2.0);
    if boards.strip.0 > 0.0 {
        strips(bay, boards, place, rect, n);
    }
    for i in 0..n {
        let back = boards.step.0 * (i % 2) as f64;
        let layer = Layer {
            front: layer.front - back,
            thick: layer.thick - back,
        };
        let (lo, hi) = (size * i as f64, size * (i + 1) as f64);
        // The outermost boards end flush.
        let lo = if i == 0 { lo } else { lo + gap };
        let hi = if i + 1 == n { hi } else { hi - gap };
        match boards.run {
            Run::Upright => {
                let board = rect.across(rect.x0 + lo, rect.x0 + hi);
                bay.block(place.finish, board, layer);
            }
            Run::Level if boards.lap.0 == 0.0 => {
                let board = rect.between(rect.z0 + lo, rect.z0 + hi);
                bay.block(place.finish, board, layer);
            }
            Run::Level => {
                let board = rect.between(rect.z0 + lo, rect.z0 + hi);
                clapboard(bay, boards.lap.0, place.finish, layer, board);
            }
        }
    }
}

/// Adds strips over the joints of `n` boards, as thick as the boards.
fn strips(bay: &mut Bay<'_>, boards: &Boards, place: &Place, rect: Rect, n: usize) {
    let half = boards.strip.0 / 2.0;
    let layer = Layer {
        front: place.front.0 + place.thick.0,
        thick: place.thick.0,
    };
    for i in 0..=n {
        let share = i as f64 / n as f64;
        let strip = match boards.run {
            Run::Upright => {
                let x = rect.x0 + rect.width() * share;
                rect.across((x - half).max(rect.x0), (x + half).min(rect.x1))
            }
            Run::Level => {
                let z = rect.z0 + rect.height() * share;
                rect.between((z - half).max(rect.z0), (z + half).min(rect.z1))
            }
        };
        bay.block(place.finish, strip, layer);
    }
}

/// Adds one clapboard: its top is `lap` behind the foot of the next, its back is plumb.
fn clapboard(bay: &mut Bay<'_>, lap: f64, finish: SurfaceId, layer: Layer, board: Rect) {
    let back = layer.front - layer.thick - lap;
    let outline = [
        (layer.front, board.z0),
        (layer.front - lap, board.z1),
        (back, board.z1),
        (back, board.z0),
    ];
    bay.profile(finish, &outline, board.x0, board.x1);
}

/// Adds boards at the foot of a wall under a drip board of 30 x 90 mm.
pub(crate) fn dado(bay: &mut Bay<'_>, size: f64, finish: SurfaceId, layer: Layer, rect: Rect) {
    let drip = 0.030;
    if rect.height() <= 3.0 * drip {
        return;
    }
    let field = rect.between(rect.z0, rect.z1 - drip);
    let n = pieces(field.width(), size);
    let step = field.width() / n as f64;
    for i in 0..n {
        let x = field.x0 + step * i as f64;
        // Every other board stands back by 3 mm, which shows the joints.
        let back = if i % 2 == 0 { 0.0 } else { 0.003 };
        let layer = Layer {
            front: layer.front - back,
            thick: layer.thick - back,
        };
        bay.block(finish, field.across(x, x + step), layer);
    }
    // Its top falls outwards, so that rain runs off.
    let (front, top) = (layer.front + 0.030, rect.z1);
    let outline = [
        (front, top - drip),
        (front, top - 0.012),
        (front - 0.090, top),
        (front - 0.090, top - drip),
    ];
    bay.profile(SurfaceId::named("cedar"), &outline, rect.x0, rect.x1);
}

/// Adds a grid of panels with open joints; joints at the ends of the bay are shared with the neighbours.
pub(crate) fn panels(bay: &mut Bay<'_>, panels: &Panels, place: &Place, rect: Rect) {
    let (cols, rows) = (
        pieces(rect.width(), panels.width.0),
        pieces(rect.height(), panels.height.0),
    );
    let cell = dvec2(rect.width() / cols as f64, rect.height() / rows as f64);
    let gap = panels.gap.0 / 2.0;
    for col in 0..cols {
        for row in 0..rows {
            let (x, z) = (rect.x0 + cell.x * col as f64, rect.z0 + cell.y * row as f64);
            let whole = Rect {
                x0: x,
                x1: x + cell.x,
                z0: z,
                z1: z + cell.y,
            };
            bay.block(place.finish, whole.shrunk(gap, gap), Layer::from(place));
        }
    }
}
