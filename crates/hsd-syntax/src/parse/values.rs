//! Values of expressions and names, recorded while a file is computed, for display in editors.
//!
//! A place may be computed many times, in a repetition or a definition that is used often; the first few values are
//! kept.

use hsd_base::source::{FileId, Span};
use hsd_ir::ast::Value;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The maximum number of different values kept for a place.
const KEPT: usize = 8;

/// Values by place: of expressions with their braces, and of names where they are defined.
#[derive(Debug, Default)]
pub struct Values {
    seen: RefCell<BTreeMap<Span, Seen>>,
}

/// The values of one place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// The first few different values, in the order of computation.
    pub values: Vec<Value>,
    /// True if there were more of them.
    pub more: bool,
    /// The first few different numbers of the storeys in which it was evaluated, if any.
    pub storeys: Vec<u64>,
    /// How often it was computed.
    pub times: usize,
    /// How often it was true.
    pub held: usize,
}

impl Seen {
    fn append(&mut self, later: Seen) {
        for value in later.values {
            self.add(value);
        }
        self.more |= later.more;
        for storey in later.storeys {
            self.in_storey(storey);
        }
        self.times += later.times;
        self.held += later.held;
    }

    fn add(&mut self, value: Value) {
        if !self.values.contains(&value) {
            match self.values.len() < KEPT {
                true => self.values.push(value),
                false => self.more = true,
            }
        }
    }

    fn in_storey(&mut self, storey: u64) {
        if self.storeys.len() < KEPT && !self.storeys.contains(&storey) {
            self.storeys.push(storey);
        }
    }
}

impl Values {
    /// Returns the values of a place, if there are any.
    pub fn at(&self, place: Span) -> Option<Seen> {
        self.seen.borrow().get(&place).cloned()
    }

    /// Adds values that were recorded after these.
    pub fn append(&self, other: Values) {
        let mut seen = self.seen.borrow_mut();
        for (place, more) in other.seen.into_inner() {
            seen.entry(place).or_default().append(more);
        }
    }

    /// Returns the values of the places of one file.
    #[must_use]
    pub fn of_file(self, file: FileId) -> Values {
        let mut seen = self.seen.into_inner();
        seen.retain(|place, _| place.file == file);
        Values { seen: seen.into() }
    }

    /// Returns all values by their places.
    pub fn into_places(self) -> BTreeMap<Span, Seen> {
        self.seen.into_inner()
    }

    /// Records a value of a place.
    pub(super) fn note(&self, place: Span, value: &Value, storey: Option<u64>) {
        let mut seen = self.seen.borrow_mut();
        let seen = seen.entry(place).or_default();
        seen.times += 1;
        seen.held += usize::from(*value == Value::Truth(true));
        if !seen.values.contains(value) {
            seen.add(value.clone());
        }
        if let Some(storey) = storey {
            seen.in_storey(storey);
        }
    }
}
