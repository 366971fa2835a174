//! Divides a part into geometry and images at each level of detail.
//!
//! Small elements in about the same plane become one panel: a quad with their baked image, in their foremost plane.
//! Elements that project far from the wall stay geometry at every level, since they define the silhouette of the
//! street.

use crate::mesh::panel::{Panel, Rect};
use crate::part;
use crate::part::bay::{Bay, HALF_POST, Layer};
use hsd_ir::catalog::Stance;
use hsd_ir::catalog::body::{Element, Shape};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Bars and rails below this size become images at detail 2, metres.
const FINE: f64 = 0.040;

/// Elements whose fronts are closer than this share a panel, metres.
const ONE_PLANE: f64 = 0.045;

/// Elements that project farther than this from the wall define its silhouette, metres.
const RELIEF: f64 = 0.080;

/// Builds the bodies of a part at the detail of its bay.
pub(crate) fn build(bay: &mut Bay<'_>) {
    let part = bay.part;
    // Fences are seen from behind too, and members without width have no front.
    let has_front = part.stance != Stance::Fence && bay.width > 0.0;
    if bay.detail > Detail::Flat || !has_front {
        if part.from.is_some() {
            part::surround(bay);
        }
        return elements(bay, &part.body, None);
    }
    let wall = part::face(part);
    let (relief, flat): (Vec<&Element>, Vec<&Element>) =
        part.body.iter().partition(|e| stands_out(e, wall));
    panel(bay, Some(wall), |bay| {
        if part.stance == Stance::Posts && bay.pictured {
            posts(bay);
        }
        if part.from.is_some() {
            part::surround(bay);
        }
        each(bay, flat.into_iter(), None);
    });
    grouped(bay, relief.into_iter(), None);
}

/// Builds the elements of a list, fine ones as panels where the detail calls for it.
pub(crate) fn elements(bay: &mut Bay<'_>, list: &[Element], inside: Option<Rect>) {
    match bay.detail {
        Detail::Everything => each(bay, list.iter(), inside),
        _ => grouped(bay, list.iter(), inside),
    }
}

/// Builds all elements as geometry.
fn each<'e>(bay: &mut Bay<'_>, list: impl Iterator<Item = &'e Element>, inside: Option<Rect>) {
    for element in list {
        if let Some(rect) = bay.rect(&element.place, inside) {
            part::one(bay, element, rect);
        }
    }
}

/// Builds runs of fine elements in about one plane as panels, all others as geometry.
fn grouped<'e>(bay: &mut Bay<'_>, list: impl Iterator<Item = &'e Element>, inside: Option<Rect>) {
    let mut run: Vec<&Element> = vec![];
    let flush = |bay: &mut Bay<'_>, run: &mut Vec<&'e Element>| {
        let run = std::mem::take(run);
        if !run.is_empty() {
            panel(bay, None, |bay| each(bay, run.into_iter(), inside));
        }
    };
    for element in list {
        let fine = is_fine(element);
        let front = |e: &Element| e.place.front.0;
        let apart = run
            .first()
            .is_some_and(|first| (front(first) - front(element)).abs() > ONE_PLANE);
        if !fine || apart {
            flush(bay, &mut run);
        }
        match fine {
            true => run.push(element),
            false => each(bay, std::iter::once(element), inside),
        }
    }
    flush(bay, &mut run);
}

/// Returns true if an element is an image at detail 2.
fn is_fine(element: &Element) -> bool {
    match &element.shape {
        Shape::Bars(bars) => bars.size.0 < FINE,
        Shape::Rails(rails) => rails.size.0 < FINE,
        Shape::Pole(_) => element.place.thick.0 < FINE,
        Shape::Leaf(_)
        | Shape::Boards(_)
        | Shape::Dado(_)
        | Shape::Panels(_)
        | Shape::Slats(_)
        | Shape::Studs(_)
        | Shape::Namako(_) => true,
        _ => false,
    }
}

/// Returns true if an element defines the silhouette of the wall.
fn stands_out(element: &Element, wall: f64) -> bool {
    let shelters = matches!(
        element.shape,
        Shape::Oriel(_)
            | Shape::Hood(_)
            | Shape::Coping(_)
            | Shape::Wing(_)
            | Shape::Apron(_)
            | Shape::Cloth(_)
            | Shape::Open(_)
            | Shape::Shown(_)
    );
    shelters || element.place.front.0 > wall + RELIEF
}

/// Adds the halves of the posts beside the bay, which have no geometry of their own in front of an image.
fn posts(bay: &mut Bay<'_>) {
    let whole = bay.whole();
    let layer = Layer {
        front: HALF_POST,
        thick: 2.0 * HALF_POST,
    };
    for (x0, x1) in [(0.0, bay.clear.x0), (bay.clear.x1, bay.width)] {
        bay.block(SurfaceId::named("cedar"), whole.across(x0, x1), layer);
    }
}

/// Builds a panel from what a closure builds, in a given plane or in its own foremost one.
fn panel(bay: &mut Bay<'_>, front: Option<f64>, build: impl FnOnce(&mut Bay<'_>)) {
    let before = std::mem::take(&mut bay.bodies);
    bay.bodies.shown = before.shown.clone();
    if bay.measured {
        bay.bodies.measure();
    }
    build(bay);
    let made = std::mem::replace(&mut bay.bodies, before);
    let Some((rect, foremost)) = made.extent() else {
        return;
    };
    bay.bodies.panels.extend(made.panels);
    bay.bodies.shown = made.shown;
    bay.bodies.panels.push(Panel {
        rect,
        front: front.unwrap_or(foremost),
        soups: match bay.measured {
            true => vec![],
            false => made.soups,
        },
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Bodies;
    use hsd_ir::catalog::PartDef;
    use hsd_syntax::parse;

    fn bodies(part: &PartDef, width: f64, detail: Detail, measured: bool) -> Bodies {
        let span = (part.from.unwrap_or(0.0) * 0.3, 1.8);
        let around = SurfaceId::named("plaster");
        let mut bay = Bay::new(part, (width, 2.7), span, around, detail, None);
        bay.measured = measured;
        part::build(bay)
    }

    #[test]
    fn measured_panels_are_where_drawn_ones_are() {
        let mut panels = 0;
        for part in parse::builtin().parts() {
            for (detail, width) in [Detail::Flat, Detail::Openings]
                .into_iter()
                .flat_map(|detail| [0.3, 0.7, 1.0, 1.37].map(|w| (detail, w * part.width())))
            {
                let drawn = bodies(part, width, detail, false);
                let measured = bodies(part, width, detail, true);
                let places = |bodies: &Bodies| -> Vec<(Rect, f64)> {
                    bodies.panels.iter().map(|p| (p.rect, p.front)).collect()
                };
                let (is, was) = (places(&measured), places(&drawn));
                assert_eq!(is, was, "{} of {width}", part.code());
                let rest = |bodies: &Bodies| format!("{:?}{:?}", bodies.soups, bodies.shown);
                assert!(
                    rest(&measured) == rest(&drawn),
                    "{} of {width}",
                    part.code()
                );
                panels += is.len();
            }
        }
        assert!(panels > 500, "{panels}");
    }
}
