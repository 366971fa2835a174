//! The triangles that a house may show, and the nodes that it will have.

use hsd_ir::building::{Built, House};
use hsd_scene::Detail;

/// Returns about how many nodes there will be: a part and a post a unit, and some others; at detail 0 one a house.
pub(super) fn nodes(houses: &[Built], detail: Detail) -> usize {
    if detail == Detail::Body {
        return houses.len() + 40;
    }
    let parts: usize = houses.iter().map(|built| parts(&built.house)).sum();
    (2 * parts + 40 * houses.len()).min(MANY_NODES)
}

/// Returns the number of units in the walls of a house.
pub(super) fn parts(house: &House) -> usize {
    let rings = house.storeys.iter().flat_map(|storey| &storey.rings);
    let walls = rings.flat_map(|ring| &ring.walls);
    walls.map(|wall| wall.units.len()).sum()
}

/// Room is made beforehand for this many nodes at most: houses with more may exceed a limit.
const MANY_NODES: usize = 1 << 16;

/// The triangles that a house may still show.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Budget {
    pub(super) left: usize,
    /// The number of nodes whose triangles have been subtracted.
    pub(super) counted: usize,
    pub(super) exceeded: bool,
}

impl Budget {
    /// A node takes as much memory as this many triangles.
    pub(super) const NODE: usize = 16;

    /// Creates one for a house that begins with this node.
    pub(super) fn new(first: usize, left: usize) -> Budget {
        Budget {
            left,
            counted: first,
            exceeded: false,
        }
    }
}
