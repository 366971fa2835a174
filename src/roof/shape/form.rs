//! What every roof shape returns: its upper surface in facets, and what stands under it.

use crate::building::Solid;
use crate::roof::shape::facet::Facet;
use crate::roof::shape::frame::Rect;

/// The form of one roof before it meets its neighbours.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// The upper surface.
    pub facets: Vec<Facet>,
    /// How far the lower surface lies below it, metres.
    pub drop: f64,
    /// Height of the upper surface over the wall plate: what reaches no higher is mere eaves.
    pub floor: f64,
    /// Walls and brackets under the surface; neighbours cut only gable walls.
    pub solids: Vec<Solid>,
    /// The roof whose eaves it is tucked under, as an index among its group.
    pub under: Option<usize>,
    /// Whether it hangs on the outside of walls: the storey above takes nothing from it.
    pub hung: bool,
    /// The walls below where a slope stands out over them as a part of its body.
    pub walls: Option<Rect>,
}
