//! The space under a roof, with which its slabs can be merged into one solid.

use glam::DVec3;
use smallvec::SmallVec;

/// The space between a roof's slabs and the top of the walls that carry it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attic {
    /// Height of the wall plate, metres. Only roofs of one storey and plate meet, and they are consecutive in their
    /// house.
    pub plate: f64,
    /// True if there is an attic; a roof that hangs on a wall or lies under another's eaves has none.
    pub filled: bool,
    /// The parts of the roof beyond its gable walls.
    pub verges: Vec<Verge>,
    /// Slopes that are slightly lower than their neighbours, and by how much, metres: those under upper gables.
    pub lowered: Vec<(Verge, f64)>,
}

/// A part of a roof's upper surface: convex, counter-clockwise seen from above; house frame, metres. The first side of
/// one beyond a gable wall is on the line of that wall.
pub type Verge = SmallVec<[DVec3; 4]>;
