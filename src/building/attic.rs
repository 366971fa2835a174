//! The space under a roof, with which its sheets can be made one massive solid.

use glam::DVec3;
use smallvec::SmallVec;

/// The room between a roof's sheets and the top of the walls that carry it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attic {
    /// Height of the wall plate, metres. Roofs of one storey and plate meet, and follow each other in their house.
    pub plate: f64,
    /// Whether there is one: a roof that hangs on a wall or lies under another's eaves has none.
    pub filled: bool,
    /// Where the roof stands out over its gable walls.
    pub verges: Vec<Verge>,
    /// Which slopes lie lower than their neighbours by a hair, and by how much, metres: those under upper gables.
    pub lowered: Vec<(Verge, f64)>,
}

/// A part of a roof's upper surface: convex, counter-clockwise seen from above; house frame, metres. The first
/// side of one beyond a gable wall lies on the line of that wall.
pub type Verge = SmallVec<[DVec3; 4]>;
