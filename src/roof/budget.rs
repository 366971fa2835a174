//! The search for the best cuts that one house may take (`docs/contract.md` 4 and 7).
//!
//! Work is counted in steps, never in time, so that a source gives the same roofs on any machine; and every house has a
//! budget of its own, so that it gets the same roofs alone, in a town, and in a tile of one.
//!
//! A region with n coordinates along each side takes about n^4 / 2 steps: L, T and U plans tens, plans that people draw
//! a few hundred, a stair of 16 steps some 40,000, a stair of 30 some 600,000. The budget is fifty times what people
//! draw. Part of it goes with the corners, so that large plans get more; since a corner takes at least six bytes of
//! source, and more steps need more corners, a file of any length takes time in proportion to its length.

use std::cell::Cell;

/// Steps that every house has.
const A_HOUSE: u64 = 20_000;

/// Further steps for each corner of a region.
const A_CORNER: u64 = 500;

/// The steps that a house has left.
#[derive(Debug)]
pub struct SearchBudget {
    left: Cell<u64>,
    /// True if a search was given up and not reported yet; `reported` is true once one has been reported.
    gave_up: Cell<bool>,
    reported: Cell<bool>,
}

impl Default for SearchBudget {
    fn default() -> Self {
        Self::new(A_HOUSE)
    }
}

impl SearchBudget {
    /// A budget of this many steps beside those for corners.
    pub fn new(steps: u64) -> Self {
        Self {
            left: Cell::new(steps),
            gave_up: Cell::new(false),
            reported: Cell::new(false),
        }
    }

    /// A budget without end.
    pub(super) fn endless() -> Self {
        Self::new(u64::MAX)
    }

    /// Returns the most steps that the search of a region with this many corners may take.
    pub(super) fn most(&self, corners: usize) -> u64 {
        self.left.get().saturating_add(for_corners(corners))
    }

    /// Takes off the steps of a search; `done` is false where it was given up.
    pub(super) fn pay(&self, corners: usize, steps: u64, done: bool) {
        let beyond = steps.saturating_sub(for_corners(corners));
        self.left.set(self.left.get().saturating_sub(beyond));
        self.gave_up.set(self.gave_up.get() || !done);
    }

    /// Returns whether to report that a search was given up: true once for a house.
    pub(super) fn is_news(&self) -> bool {
        self.gave_up.get() && !self.reported.replace(true)
    }
}

fn for_corners(corners: usize) -> u64 {
    (corners as u64).saturating_mul(A_CORNER)
}
