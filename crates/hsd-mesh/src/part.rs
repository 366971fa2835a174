//! Builds the geometry of a part: the infill walls around its opening, then its bodies one by one.

pub(crate) mod apron;
pub(crate) mod bars;
pub(crate) mod round;
pub(crate) mod canopy;
pub(crate) mod namako;
pub(crate) mod track;
pub(crate) mod bay;
pub(crate) mod kura;
pub(crate) mod boards;
pub(crate) mod shelter;
pub(crate) mod oriel;
pub(crate) mod detail;
pub(crate) mod cloth;
pub(crate) mod leaf;

use super::mesh::Bodies;
use crate::mesh::panel::Rect;
use crate::part::bay::{Bay, Layer};
use hsd_base::geometry::SHAKU;
use hsd_ir::catalog::body::{Element, Grid, Place, Shape};
use hsd_ir::catalog::value::Level;
use hsd_ir::catalog::{Below, Catalog, PartDef, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_scene::PartNames;

/// Height of a dado under an opening, metres: three shaku.
pub(super) const DADO: f64 = 3.0 * SHAKU;

/// Distance of a panel behind the texture on it, metres.
const BEHIND: f64 = 0.002;

/// The greatest depth of a passage into a house, metres.
pub(super) const DEEPEST: f64 = 30.0;

/// Returns the depth of the dark passage behind a part, metres, if it may have one.
pub(super) fn passage(part: &PartDef) -> Option<f64> {
    // Only what stands open to the ground can lead through a house.
    if part.below != Below::Open {
        return None;
    }
    let depths = part.body.iter().filter_map(|e| match &e.shape {
        Shape::Depth(d) => Some(d.depth.0),
        _ => None,
    });
    depths.reduce(f64::max)
}

/// As [`passage`], for a unit or any of its parts.
pub(super) fn has_passage(catalog: &Catalog, content: &Content) -> bool {
    match content {
        Content::Part(id) => passage(catalog.part(*id)).is_some(),
        Content::Split(split) => {
            let mut both = split.lower.iter().chain(&split.upper);
            both.any(|u| has_passage(catalog, &u.content))
        }
        Content::Void | Content::Picture(_) => false,
    }
}

/// Returns the names of a part.
pub(super) fn names_of(part: &PartDef) -> PartNames {
    PartNames {
        ja: part.ja.clone(),
        en: part.en.clone(),
    }
}

/// Returns true if a part is a wall at right angles to its facade.
pub(super) fn is_wing(part: &PartDef) -> bool {
    part.body.iter().any(|e| matches!(e.shape, Shape::Wing(_)))
}

/// Returns the layer of a plain wall of a stance.
pub(super) fn wall_layer(stance: Stance) -> Layer {
    match stance {
        Stance::Bare => Layer {
            front: 0.090,
            thick: 0.180,
        },
        Stance::Modern => Layer {
            front: 0.075,
            thick: 0.150,
        },
        _ => Layer {
            front: 0.045,
            thick: 0.070,
        },
    }
}

/// Returns the distance of a part's outermost wall plane from the centre line, metres; corner fillers meet there.
pub(super) fn face(part: &PartDef) -> f64 {
    let walls = part.body.iter().filter(|e| {
        let panels = matches!(e.shape, Shape::Wall(_) | Shape::Panels(_) | Shape::Frame(_));
        // Belts and plinths stand out farther, but not over the whole height.
        let whole = e.place.from == Level::Start(0.0) && e.place.to == Level::End(0.0);
        panels && (whole && part.from.is_none() || part.stance == Stance::Fence)
    });
    let front = walls.map(|e| e.place.front.0).reduce(f64::max);
    front.unwrap_or(wall_layer(part.stance).front)
}

/// Builds all bodies of a part in its bay.
pub(super) fn build(mut bay: Bay<'_>) -> Bodies {
    detail::build(&mut bay);
    bay.bodies
}

/// Builds one element.
pub(super) fn one(bay: &mut Bay<'_>, element: &Element, rect: Rect) {
    let place = &element.place;
    let layer = Layer::from(place);
    match &element.shape {
        Shape::Slab(_) => bay.block(place.finish, rect, layer),
        Shape::Wall(wall) => boards::wall(bay, wall, place, rect),
        Shape::Boards(b) => boards::boards(bay, b, place, rect),
        Shape::Dado(d) => boards::dado(bay, d.size.0, place.finish, layer, rect),
        Shape::Panels(p) => boards::panels(bay, p, place, rect),
        Shape::Bars(b) => bars::bars(bay, b, place, rect),
        Shape::Rails(r) => bars::rails(bay, r, place, rect),
        Shape::Frame(f) => bars::frame(bay, f.size.0, f.sides, place, rect),
        Shape::Studs(s) => bars::studs(bay, s, place, rect),
        Shape::Leaf(l) => leaf::leaves(bay, l, place, rect),
        Shape::Track(t) => track::track(bay, t, place, rect),
        Shape::Oriel(o) => oriel::oriel(bay, o, element, rect),
        Shape::Hood(h) => shelter::hood(bay, h.pitch, place, rect),
        Shape::Coping(c) => shelter::coping(bay, c, place, rect),
        Shape::Wing(w) => shelter::wing(bay, w, place, rect),
        Shape::Cloth(c) => cloth::cloth(bay, c, place, rect),
        Shape::Apron(a) => apron::apron(bay, a, place, rect),
        Shape::Namako(n) => namako::namako(bay, n, place, rect),
        Shape::Depth(d) => kura::depth(bay, d, place.finish, rect),
        Shape::Jambs(j) => kura::jambs(bay, j, place, rect),
        Shape::Open(o) => kura::open(bay, o, place, rect),
        Shape::Corners(c) => round::corners(bay, c, place, rect),
        Shape::Bell(b) => round::bell(bay, b, place, rect),
        Shape::Pole(p) => round::pole(bay, p.run, place, rect),
        Shape::Slats(s) => round::slats(bay, s, place, rect),
        Shape::Grid(g) => grid(bay, g, element, rect),
        Shape::Post(p) => post(bay, p.size.0, place),
        Shape::Turned(t) => round::turned(bay, t, place, rect),
        Shape::Shown(_) => shown(bay, place, rect),
    }
}

/// Builds the children once per cell, from the left and from the bottom.
fn grid(bay: &mut Bay<'_>, grid: &Grid, element: &Element, rect: Rect) {
    let (cols, rows) = (grid.cols.max(1), grid.rows.max(1));
    let gap = grid.gap.0;
    let wide = (rect.width() - gap * f64::from(cols - 1)) / f64::from(cols);
    let high = (rect.height() - gap * f64::from(rows - 1)) / f64::from(rows);
    for row in 0..rows {
        for col in 0..cols {
            let (x, z) = (
                rect.x0 + (wide + gap) * f64::from(col),
                rect.z0 + (high + gap) * f64::from(row),
            );
            let cell = rect.across(x, x + wide).between(z, z + high);
            detail::elements(bay, &element.children, Some(cell));
        }
    }
}

/// Adds the walls above, below and beside an opening.
pub(super) fn surround(bay: &mut Bay<'_>) {
    let part = bay.part;
    let (whole, opening, finish) = (bay.whole(), bay.opening, bay.around);
    let layer = wall_layer(part.stance);
    if part.above {
        bay.block(finish, whole.between(opening.z1, whole.z1), layer);
    }
    if part.clear.is_some() {
        let beside = whole.between(opening.z0, opening.z1);
        bay.block(finish, beside.across(0.0, opening.x0), layer);
        bay.block(finish, beside.across(opening.x1, whole.x1), layer);
    }
    if part.below == Below::Open {
        return;
    }
    bay.block(finish, whole.between(0.0, opening.z0), layer);
    if part.below == Below::Dado {
        let dado = bay.clear.between(0.0, opening.z0.min(DADO));
        let layer = Layer {
            front: 0.070,
            thick: 0.025,
        };
        boards::dado(bay, 0.240, SurfaceId::named("boards"), layer, dado);
    }
}

/// Adds a panel that shows the part's texture.
fn shown(bay: &mut Bay<'_>, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    let back = Layer {
        front: layer.front - BEHIND,
        thick: (layer.thick - BEHIND).max(BEHIND),
    };
    bay.block(place.finish, rect, back);
    let whole = [[0.0, 0.0], [1.0, 1.0]];
    bay.bodies.shown.front(rect, layer.front, whole);
}

/// Adds a post on the centre line, from the floor to the top.
fn post(bay: &mut Bay<'_>, size: f64, place: &Place) {
    let rect = bay.whole().across(-size / 2.0, size / 2.0);
    bay.block(
        place.finish,
        rect,
        Layer {
            front: size / 2.0,
            thick: size,
        },
    );
}
