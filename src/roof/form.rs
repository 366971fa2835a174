//! What every roof shape returns: its upper surface in facets, its ridges, and what stands under it.

use super::facet::Facet;
use glam::DVec3;

use crate::building::Solid;

/// The form of one roof before it meets its neighbours.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// The upper surface.
    pub facets: Vec<Facet>,
    /// How far the lower surface lies below it, metres.
    pub drop: f64,
    /// Height of the upper surface over the wall plate: what reaches no higher is mere eaves.
    pub floor: f64,
    /// Where two slopes meet above.
    pub ridges: Vec<RidgeLine>,
    /// Walls and boards under the surface; no neighbour cuts them.
    pub solids: Vec<Solid>,
    /// The roof whose eaves it is tucked under, as an index among its group.
    pub under: Option<usize>,
    /// Whether it hangs on the outside of walls: the storey above takes nothing from it.
    pub hung: bool,
}

/// A ridge from end to end on the upper surface, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RidgeLine {
    /// One end.
    pub from: DVec3,
    /// The other.
    pub to: DVec3,
    /// Whether the ends stand in the open: there the ridge tiles get their end tile.
    pub free: [bool; 2],
}
