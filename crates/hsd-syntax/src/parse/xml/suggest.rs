//! Finds the known word that the author may have meant.

use hsd_base::diagnostic::suggest::{self, slips};

/// The maximum number of searches: they cost time, and a file of 100,000 unknown words needs no 100,000 suggestions.
const SEARCHES: u32 = 500;
/// The maximum length of a word that is compared.
const LONGEST: usize = 24;

/// Finds known words that look like unknown ones.
pub(super) struct Suggest {
    left: u32,
}

impl Suggest {
    pub(super) fn new() -> Self {
        Suggest { left: SEARCHES }
    }

    /// Returns the one of `known` that is nearest to `word`: equal apart from case and full-width letters, or within a
    /// typing error or two.
    pub(super) fn among<'k>(
        &mut self,
        word: &str,
        known: impl Iterator<Item = &'k str> + Clone,
    ) -> Option<&'k str> {
        if word.is_empty() || word.len() > 3 * LONGEST {
            return None;
        }
        let same = known.clone().find(|k| folds(k).eq(folds(word)));
        if same.is_some() || self.left == 0 {
            return same;
        }
        self.left -= 1;
        let folded = fold(word);
        // A word that allows no more slips must not hide one that does.
        let score = |k| match slips(&folded, &fold(k)) {
            few if few <= allowance(k) => (few, ()),
            _ => (usize::MAX, ()),
        };
        suggest::nearest(known, score, allowance)
    }
}

/// Returns true if one word may be a misspelling of the other.
pub(super) fn alike(word: &str, other: &str) -> bool {
    let lengths = (word.chars().count(), other.chars().count());
    if lengths.0.max(lengths.1) > LONGEST || lengths.0.abs_diff(lengths.1) > allowance(other) {
        return false;
    }
    slips(&fold(word), &fold(other)) <= allowance(other)
}

/// Returns the number of typing errors allowed in a word of this length.
fn allowance(word: &str) -> usize {
    match word.chars().count() {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    }
}

/// Folds to lower case, half width, and `-` for `_`.
fn folds(word: &str) -> impl Iterator<Item = char> + '_ {
    let narrow = word.chars().map(|c| narrow_ascii(c).unwrap_or(c));
    let lower = narrow.map(|c| c.to_ascii_lowercase());
    lower.map(|c| if c == '_' { '-' } else { c })
}

fn fold(word: &str) -> String {
    folds(word).collect()
}

/// Returns the ASCII character that a full-width one looks like.
pub(super) fn narrow_ascii(c: char) -> Option<char> {
    match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0),
        '\u{3000}' => Some(' '),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised() {
        let mut suggest = Suggest::new();
        let known = ["Facade", "Facades", "Floor", "repeat", "Row"];
        let mut find = |word| suggest.among(word, known.iter().copied());
        assert_eq!(find("facade"), Some("Facade"));
        assert_eq!(find("Repeat"), Some("repeat"));
        assert_eq!(find("Ｒｏｗ"), Some("Row"));
        assert_eq!(find("Flor"), Some("Floor"));
        assert_eq!(find("repaet"), Some("repeat"));
        assert_eq!(find("Window"), None);
    }
}
