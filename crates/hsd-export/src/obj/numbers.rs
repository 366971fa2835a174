//! The numbers that OBJ gives to values: they start at 1 and continue through the file.

use std::collections::HashMap;

/// Numbered values of one command, by what tells them apart.
pub(super) struct Numbers<const N: usize> {
    count: usize,
    known: HashMap<[i64; N], usize>,
}

impl<const N: usize> Numbers<N> {
    /// Creates a command without values.
    pub(super) fn new() -> Numbers<N> {
        Numbers {
            count: 0,
            known: HashMap::new(),
        }
    }

    /// Begins an object, which shares no values with others.
    pub(super) fn begin(&mut self) {
        self.known.clear();
    }

    /// Returns the number of a value, and writes the value if it is new.
    pub(super) fn of(&mut self, value: [i64; N], write: impl FnOnce()) -> usize {
        let next = self.count + 1;
        let number = *self.known.entry(value).or_insert(next);
        if number == next {
            self.count = next;
            write();
        }
        number
    }
}
