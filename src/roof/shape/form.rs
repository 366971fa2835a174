//! The result of every roof shape: its upper surface in facets, and the walls and brackets under it.

use crate::building::{Roof, Solid};
use crate::roof::facet::Facet;
use crate::roof::frame::Rect;
use crate::roof::shape::look::Look;

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
    pub(in crate::roof) fn clearance(&self, n: usize, other: &Form) -> f64 {
        let passes = self.under.is_none() || self.under == Some(n) || other.under.is_some();
        if passes { 0.0 } else { other.drop }
    }
}

/// A roof with its form, before it meets its neighbours.
#[derive(Clone, Debug)]
pub(in crate::roof) struct RoofDraft {
    /// Its form.
    pub(in crate::roof) form: Form,
    /// Its look.
    pub(in crate::roof) look: Look,
    /// The roof, without solids yet.
    pub(in crate::roof) roof: Roof,
    /// Height of the plate it stands on: only roofs of one height meet.
    pub(in crate::roof) base: f64,
}
