//! Decks: a hip roof over a hall too wide for it ends level at a height, under sheet metal, as builders end it over large
//! halls at odd angles.

use crate::facet::{Corner, HalfPlane, Higher, area};
use crate::frame::Plane;
use crate::shape::flat;
use crate::shape::form::Form;
use crate::solid::sheet::{Piece, sheet};
use hsd_base::geometry::tolerance::SLIVER;
use hsd_ir::ast::RoofKind;

/// Thickness of a deck, metres.
const THICK: f64 = 0.15;

/// Ends the slopes of a form at a height, metres, and lays a deck over the rest.
pub(crate) fn end_at(form: &mut Form, top: f64) {
    let deck = Plane::level(top);
    let mut level: Vec<Piece> = vec![];
    for facet in &mut form.facets {
        let over = match HalfPlane::where_higher(facet.plane, deck) {
            Higher::Nowhere => continue,
            Higher::Everywhere => std::mem::take(&mut facet.outline),
            Higher::Inside(side) => {
                let [over, left] = side.halves(&facet.outline);
                facet.outline = left;
                over
            }
        };
        facet.body = facet.outline.iter().map(|c| c.at).collect();
        if area(&over) > SLIVER {
            let inner = over.into_iter().map(|c| Corner { rim: false, ..c });
            level.push((inner.collect(), deck));
        }
    }
    form.facets.retain(|f| area(&f.outline) > SLIVER);
    let coat = flat::coat(RoofKind::Metal);
    form.solids.extend(sheet(&level, THICK, &coat, f64::MIN));
}
