//! How much search for the best cuts one run may take (`docs/contract.md` 7).
//!
//! A plan of thirty coordinates on an axis takes some milliseconds, of which a text of 1 MiB can ask for
//! thousands. Work is counted in steps, never in time, so that the same input gives the same roofs anywhere.

use std::cell::Cell;

/// Steps that all regions of a run share: some twenty stairs of thirty steps, thousands of palaces.
const SHARED: u64 = 12_000_000;

/// Steps that a region has to itself for each of its corners, so that what houses take which anybody would
/// draw does not depend on those before them.
const A_CORNER: u64 = 128;

/// The steps that are left.
#[derive(Debug)]
pub struct SearchBudget {
    left: Cell<u64>,
    /// Whether a search was given up, and whether that was said.
    gave_up: Cell<bool>,
    told: Cell<bool>,
}

impl Default for SearchBudget {
    fn default() -> Self {
        Self::new(SHARED)
    }
}

impl SearchBudget {
    /// So many steps to share.
    pub fn new(shared: u64) -> Self {
        Self {
            left: Cell::new(shared),
            gave_up: Cell::new(false),
            told: Cell::new(false),
        }
    }

    /// Steps without end.
    pub(super) fn endless() -> Self {
        Self::new(u64::MAX)
    }

    /// How many steps the search of a region of so many corners may take.
    pub(super) fn most(&self, corners: usize) -> u64 {
        self.left.get().saturating_add(own(corners))
    }

    /// Takes off what a search took, and whether it came to an end.
    pub(super) fn pay(&self, corners: usize, steps: u64, done: bool) {
        let beyond = steps.saturating_sub(own(corners));
        self.left.set(self.left.get().saturating_sub(beyond));
        self.gave_up.set(self.gave_up.get() || !done);
    }

    /// Whether that was asked for and answered.
    pub(super) fn has_told(&self) -> bool {
        self.told.get()
    }

    /// Whether a search was given up and nobody asked since: it is said once a run.
    pub(super) fn is_news(&self) -> bool {
        self.gave_up.get() && !self.told.replace(true)
    }
}

fn own(corners: usize) -> u64 {
    (corners as u64).saturating_mul(A_CORNER)
}
