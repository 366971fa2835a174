//! The memory of arrays that have been written: the tiles of a town take tens of megabytes each, one after another, and a
//! system gives new memory page by page, which takes longer than to fill it.

use crate::pieces::Pieces;
use std::sync::{Mutex, PoisonError};

/// Smaller arrays are not worth keeping, bytes.
const LEAST: usize = 1 << 14;

/// Arrays of tiles that have been written, a set for each tile, by the level of detail. There are at most as many as tiles
/// have been in work at once.
#[derive(Debug, Default)]
pub struct SpareArrays(Mutex<Vec<(u8, Vec<Vec<u8>>)>>);

impl SpareArrays {
    /// Keeps the arrays of a file of a level that has been written.
    pub fn keep(&self, level: u8, file: Pieces) {
        // The first piece is the JSON.
        let arrays = file.into_whole().into_iter().skip(1);
        let arrays = arrays.filter(|array| array.capacity() >= LEAST).collect();
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.push((level, arrays));
    }

    /// Takes those of a file of a level.
    pub(super) fn take(&self, level: u8) -> Spare {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all.iter().position(|(own, _)| *own == level);
        let arrays = known.map_or(vec![], |at| all.swap_remove(at).1);
        Spare(arrays.into_iter())
    }
}

/// The spare arrays of one file, in their order.
pub(super) struct Spare(std::vec::IntoIter<Vec<u8>>);

impl Spare {
    /// Returns an array without elements, with the memory of the next one if there is one.
    pub(super) fn array(&mut self) -> Vec<u8> {
        let mut array = self.0.next().unwrap_or_default();
        array.clear();
        array
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_come_back_without_elements_and_in_their_order() {
        let spare = SpareArrays::default();
        let mut file = Pieces::from(vec![1; LEAST]);
        file.push(vec![2; 2 * LEAST]);
        file.push(vec![3; 4]);
        file.push(vec![4; 3 * LEAST]);
        spare.keep(1, file);
        assert_eq!(spare.take(0).array().capacity(), 0, "of another level");
        let mut own = spare.take(1);
        let arrays = [own.array(), own.array(), own.array()];
        assert!(arrays.iter().all(Vec::is_empty));
        assert_eq!(
            arrays.map(|array| array.capacity()),
            [2 * LEAST, 3 * LEAST, 0]
        );
    }
}
