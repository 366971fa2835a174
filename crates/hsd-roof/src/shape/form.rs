//! The result of every roof shape: its upper surface in facets, and the walls and brackets under it.

use crate::facet::Facet;
use crate::frame::Rect;
use crate::shape::look::Look;
use hsd_ir::building::{Roof, Solid};

/// The form of one roof before it meets its neighbours.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// The upper surface.
    pub facets: Vec<Facet>,
    /// Vertical thickness, metres.
    pub drop: f64,
    /// Height of the upper surface over the wall plate, metres; lower solids are eaves alone.
    pub floor: f64,
    /// Walls and brackets under the surface; neighbours cut only gable walls.
    pub solids: Vec<Solid>,
    /// The index of the roof in its group under whose eaves it is tucked.
    pub under: Option<usize>,
    /// True if it hangs on the outside of walls, so that the storey above does not cut it.
    pub hung: bool,
    /// The walls below, if a slope projects over them as a part of its body.
    pub walls: Option<Rect>,
}

impl Form {
    /// Returns the height over its upper surface, metres, that it keeps free of the upper surface of roof `n`, `other`:
    /// a roof tucked under its trunk's eaves is not cut, so the eaves of the others end where their lower surface would
    /// enter it.
    pub(crate) fn clearance(&self, n: usize, other: &Form) -> f64 {
        let passes = self.under.is_none() || self.under == Some(n) || other.under.is_some();
        if passes { 0.0 } else { other.drop }
    }
}

/// A roof with its form, before it meets its neighbours.
#[derive(Clone, Debug)]
pub(crate) struct RoofDraft {
    /// Its form.
    pub(crate) form: Form,
    /// Its look.
    pub(crate) look: Look,
    /// The roof, without solids yet.
    pub(crate) roof: Roof,
    /// Height of the plate it stands on: only roofs of one height meet.
    pub(crate) base: f64,
}
