//! Values of expressions and names, recorded while a file is computed, for display in editors.
//!
//! A place may be computed many times, in a repetition or a definition that is used often; the first few values are
//! kept.

use crate::ast::Value;
use crate::source::Span;
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
}

impl Values {
    /// Returns the values of a place, if there are any.
    pub fn at(&self, place: Span) -> Option<Seen> {
        self.seen.borrow().get(&place).cloned()
    }

    /// Records a value of a place.
    pub(super) fn note(&self, place: Span, value: &Value, storey: Option<u64>) {
        let mut seen = self.seen.borrow_mut();
        let seen = seen.entry(place).or_default();
        if !seen.values.contains(value) {
            match seen.values.len() < KEPT {
                true => seen.values.push(value.clone()),
                false => seen.more = true,
            }
        }
        if let Some(storey) = storey.filter(|s| !seen.storeys.contains(s))
            && seen.storeys.len() < KEPT
        {
            seen.storeys.push(storey);
        }
    }
}
