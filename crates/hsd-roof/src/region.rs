//! One rectangle of a storey's plan with its role among the roofs: ridge direction, fall, and what it joins.
//!
//! Frame: author frame, a to the left along the first line, b back into the plot; grid steps.

use hsd_base::geometry::plan::Cell;

/// Direction of a ridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ridge {
    /// Parallel to the first line, along a.
    A,
    /// At right angles to it, along b.
    B,
}

/// A side of a region, seen from the street.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Towards the street, -b.
    Front,
    /// Into the plot, +b.
    Back,
    /// +a.
    Left,
    /// -a.
    Right,
}

impl Side {
    /// All sides, in the order in which equal candidates are taken.
    pub const ALL: [Side; 4] = [Side::Back, Side::Front, Side::Left, Side::Right];

    /// Returns the opposite side.
    pub fn opposite(self) -> Side {
        match self {
            Side::Front => Side::Back,
            Side::Back => Side::Front,
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }

    /// Returns the direction of a ridge that runs into this side.
    pub fn ridge_into(self) -> Ridge {
        match self {
            Side::Front | Side::Back => Ridge::B,
            Side::Left | Side::Right => Ridge::A,
        }
    }

    /// Returns the length of this side of a cell and the cell's depth from it, in grid steps.
    pub fn measure(self, cell: &Cell) -> (i64, i64) {
        match self {
            Side::Front | Side::Back => (cell.width(), cell.depth()),
            Side::Left | Side::Right => (cell.depth(), cell.width()),
        }
    }
}

/// The relation of a region to its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// An independent roof.
    Main,
    /// A gable whose ridge runs into its trunk, [`Region::over`].
    Branch,
    /// A single slope falling away from its trunk or from an upper storey's wall.
    LeanTo,
}

/// A rectangle to be roofed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Its rectangle, in grid steps of the author frame.
    pub cell: Cell,
    /// Ridge direction; `None` for a lean-to.
    pub ridge: Option<Ridge>,
    /// The side a lean-to falls towards.
    pub fall: Option<Side>,
    /// Main, branch or lean-to.
    pub role: Role,
    /// Index of the trunk of a branch, or of a lean-to that leans on a region; written roofs are
    /// counted behind the regions.
    pub over: Option<usize>,
    /// True if it is the street region.
    pub street: bool,
    /// The side on which an upper storey's wall stands along it, wholly or for a lean-to round
    /// a corner by half at least.
    pub against_wall: Option<Side>,
    /// The side of this cell that lies wholly on the side of `over` or `through`.
    pub joins: Option<Side>,
    /// Index of a narrower region that this main roof is to run across (rule 3), so that no
    /// pocket is left between its gable and the other's slope.
    pub through: Option<usize>,
}

impl Region {
    pub(crate) fn main(cell: Cell) -> Self {
        let ridge = if cell.depth() > cell.width() {
            Ridge::B
        } else {
            Ridge::A
        };
        Self {
            cell,
            ridge: Some(ridge),
            fall: None,
            role: Role::Main,
            over: None,
            street: false,
            against_wall: None,
            joins: None,
            through: None,
        }
    }

    pub(crate) fn lean_to(cell: Cell, against: Side) -> Self {
        let fall = Some(against.opposite());
        Self {
            ridge: None,
            fall,
            role: Role::LeanTo,
            ..Self::main(cell)
        }
    }

    /// Returns the extent across the ridge in grid steps; for a lean-to twice its depth, as for a gable that reaches as
    /// high.
    pub fn span(&self) -> i64 {
        match (self.ridge, self.fall) {
            (Some(Ridge::A), _) => self.cell.depth(),
            (Some(Ridge::B), _) => self.cell.width(),
            (None, Some(side)) => side.measure(&self.cell).1.saturating_mul(2),
            (None, None) => self.cell.width().min(self.cell.depth()),
        }
    }
}

/// A written roof beside the regions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beside {
    /// Its cell, ridge and fall, as of a region.
    pub roof: Region,
    /// True if it stands on top of the walls; only then can other roofs run into it.
    pub level: bool,
}
