//! The budget of the search for the best cuts of one house (`docs/contract.md` 4 and 7).
//!
//! Work is counted in steps, never in time, so that a source gives the same roofs on any machine; and every house has a
//! budget of its own, so that its roofs do not depend on other houses.
//!
//! A region with n coordinates along each side takes about n^4 / 2 steps: L, T and U plans take tens, usual plans a few
//! hundred, a stair of 16 steps some 40,000, a stair of 30 some 600,000. The budget is fifty times what people draw.
//! Part of it goes with the corners, so that large plans get more; since a corner takes at least six bytes of source,
//! and more steps need more corners, a file of any length takes time in proportion to its length.

use std::cell::Cell;

/// Steps of every house.
const A_HOUSE: u64 = 20_000;

/// Further steps for each corner of a region.
const A_CORNER: u64 = 500;

/// The remaining steps of a house.
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
    /// Creates a budget of this many steps, beside those for corners.
    pub fn new(steps: u64) -> Self {
        Self {
            left: Cell::new(steps),
            gave_up: Cell::new(false),
            reported: Cell::new(false),
        }
    }

    /// Creates an unlimited budget.
    pub(super) fn endless() -> Self {
        Self::new(u64::MAX)
    }

    /// Returns the maximum number of steps for the search of a region with this many corners.
    pub(super) fn most(&self, corners: usize) -> u64 {
        self.left.get().saturating_add(for_corners(corners))
    }

    /// Subtracts the steps of a search; `done` is false if it was given up.
    pub(super) fn pay(&self, corners: usize, steps: u64, done: bool) {
        let beyond = steps.saturating_sub(for_corners(corners));
        self.left.set(self.left.get().saturating_sub(beyond));
        self.gave_up.set(self.gave_up.get() || !done);
    }

    /// Returns true once per house, if a search was given up.
    pub fn is_news(&self) -> bool {
        self.gave_up.get() && !self.reported.replace(true)
    }
}

fn for_corners(corners: usize) -> u64 {
    (corners as u64).saturating_mul(A_CORNER)
}
