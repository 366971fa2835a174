//! Line differences between two files.

use std::ops::Range;

/// The maximum distance of a line's positions in both files.
const NEAR: usize = 60;

/// Returns the lines that differ, as ranges of both files in their order; all lines between them are equal.
pub fn changes<L: PartialEq>(old: &[L], new: &[L]) -> Vec<(Range<usize>, Range<usize>)> {
    let (mut i, mut j, mut found) = (0, 0, vec![]);
    while i < old.len() || j < new.len() {
        if i < old.len() && j < new.len() && old[i] == new[j] {
            (i, j) = (i + 1, j + 1);
            continue;
        }
        let (gone, come) = apart(&old[i..], &new[j..]);
        found.push((i..i + gone, j..j + come));
        (i, j) = (i + gone, j + come);
    }
    found
}

/// Returns the number of lines of both before the next one they share; at least one of both is positive. Equal numbers
/// come first, since most changes are within lines.
fn apart<L: PartialEq>(old: &[L], new: &[L]) -> (usize, usize) {
    for distance in 1..=NEAR.min(old.len() + new.len()) {
        let middle = distance.div_ceil(2);
        let out = |by: usize| [middle.checked_add(by), middle.checked_sub(by)];
        for gone in (0..=middle).flat_map(out).flatten() {
            if gone > distance.min(old.len()) {
                continue;
            }
            let come = distance - gone;
            let both = old.get(gone).zip(new.get(come));
            let ends = gone == old.len() && come == new.len();
            if ends || both.is_some_and(|(o, n)| o == n) {
                return (gone, come);
            }
        }
    }
    (1.min(old.len()), 1.min(new.len()))
}

#[cfg(test)]
mod tests {
    use super::changes;

    #[test]
    fn what_differs_lies_between_what_is_the_same() {
        assert_eq!(changes::<u8>(&[], &[]), []);
        assert_eq!(changes(b"abc", b"abc"), []);
        assert_eq!(changes(b"abc", b"axc"), [(1..2, 1..2)]);
        assert_eq!(changes(b"abbc", b"abc"), [(2..3, 2..2)]);
        assert_eq!(changes(b"xca", b"aca"), [(0..1, 0..1)]);
        assert_eq!(changes(b"", b"ab"), [(0..0, 0..2)]);
        assert_eq!(changes(b"abc", b"xabcy"), [(0..0, 0..1), (3..3, 4..5)]);
    }
}
