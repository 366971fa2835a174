//! Unique names, for formats that tell objects apart by them.

use std::collections::HashMap;

/// The names that objects have had, and how many of each.
#[derive(Default)]
pub struct Names(HashMap<String, usize>);

impl Names {
    /// Forgets all names.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the name, with a number from the second of a name on.
    pub fn unique(&mut self, name: &str) -> String {
        let count = self.0.entry(name.to_owned()).or_insert(0);
        *count += 1;
        match *count {
            1 => name.to_owned(),
            n => self.unique(&format!("{name}_{n}")),
        }
    }
}
