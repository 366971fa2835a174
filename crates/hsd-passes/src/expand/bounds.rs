//! The bounds on the parts of a house and on the work on them, so that a mistyped number does not exhaust memory.
//!
//! A house has a bound of its own. What it has beyond one part for each byte that it is written in comes from repetitions,
//! and all houses of a run share a second bound for that: a hundred bytes can ask for two million parts, and a file has
//! room for thousands of such houses. There, what holds the parts counts by the memory that it takes.

use hsd_base::source::{Limits, Span};

/// Steps of operations that one part of a limit allows for.
const STEPS_A_PART: u64 = 10;

/// The weights of a storey, of a row or floor, and of a facade in the limit of a run, in addition to their parts.
pub(super) const STOREY: u64 = 10;
pub(super) const ROW: u64 = 3;
pub(super) const FACADE: u64 = 5;

/// The consumption of a house so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    /// Parts, and one for whatever is empty.
    pub(super) parts: u64,
    /// Storeys, rows and facades, counted as parts.
    pub(super) frames: u64,
    /// Steps of operations.
    pub(super) steps: u64,
}

/// What repetitions have used in all houses of a run so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Repeated {
    parts: u64,
    steps: u64,
}

impl Repeated {
    /// Adds what a house has used beyond the share of the bytes that it is written in.
    pub(super) fn add(&mut self, house: Spent, written: u64) {
        let parts = house.parts.saturating_add(house.frames);
        self.parts += parts.saturating_sub(written);
        self.steps += house.steps.saturating_sub(written * STEPS_A_PART);
    }
}

/// The bounds of one house.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Bytes that it is written in.
    pub(super) written: u64,
    /// The limit of a house.
    pub(super) own: u64,
    /// The limit of repetitions in a run.
    run: u64,
    /// The parts, frames among them, that are left of it to this house.
    parts: u64,
    /// The steps that are left of it to this house.
    steps: u64,
}

/// A limit that a house exceeds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Exceeded {
    /// That of parts of a house.
    House(u64),
    /// That of repetitions in a run.
    Run(u64),
}

impl Bounds {
    /// Returns the bounds of a house with this place, after the houses before it.
    pub(super) fn new(limits: &Limits, house: Span, before: Repeated) -> Bounds {
        let (own, run) = (limits.parts as u64, limits.repeated_parts as u64);
        let written = u64::from(house.end - house.start);
        let left = |run: u64, used: u64, share: u64| run.saturating_sub(used).saturating_add(share);
        let steps = run.saturating_mul(STEPS_A_PART);
        Bounds {
            written,
            own,
            run,
            parts: left(run, before.parts, written),
            steps: left(steps, before.steps, written * STEPS_A_PART),
        }
    }

    /// Returns the limit that a house exceeds, if any.
    #[inline]
    pub(super) fn exceeded(&self, spent: Spent) -> Option<Exceeded> {
        if spent.parts > self.own || spent.steps > self.own.saturating_mul(STEPS_A_PART) {
            return Some(Exceeded::House(self.own));
        }
        let many = spent.parts.saturating_add(spent.frames) > self.parts;
        (many || spent.steps > self.steps).then_some(Exceeded::Run(self.run))
    }

    /// Returns the limit that a house would exceed with so many parts more.
    pub(super) fn exceeded_by(&self, spent: Spent, more: u64) -> Option<Exceeded> {
        self.exceeded(Spent {
            parts: spent.parts.saturating_add(more),
            ..spent
        })
    }

    /// Returns the number of parts that a house may still have.
    pub(super) fn room(&self, spent: Spent) -> u64 {
        let own = self.own.saturating_sub(spent.parts);
        own.min(
            self.parts
                .saturating_sub(spent.parts.saturating_add(spent.frames)),
        )
    }
}
