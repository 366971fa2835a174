//! Finds the code that an unknown one was meant to be.

use super::{Catalog, PartId};
use hsd_base::diagnostic::suggest::{self, slips};

/// The number of spellings offered.
const OFFERS: usize = 3;

/// The maximum edit distance.
const FARTHEST: usize = 3;

/// Returns up to three parts whose code is near, best first. Case and lost blanks do not count; among equals, a code
/// that only lost its last columns wins, then the same class letter, then the catalogue's order.
pub(super) fn nearest(catalog: &Catalog, code: &str) -> Vec<PartId> {
    let folded = code.trim().to_ascii_uppercase();
    let squeezed: String = folded.split_whitespace().collect();
    if squeezed.is_empty() {
        return Vec::new();
    }
    let mut found: Vec<(usize, bool, bool, PartId)> = Vec::new();
    for (i, part) in catalog.parts().iter().enumerate() {
        let theirs = part.code().trim().to_ascii_uppercase();
        let tight: String = theirs.split_whitespace().collect();
        let far = slips(&folded, &theirs).min(slips(&squeezed, &tight));
        // Something must agree: three edits turn any three letters into any others.
        if far <= FARTHEST && far < squeezed.len().max(1) && !tight.is_empty() {
            let cut = !tight.starts_with(&squeezed);
            let other = !squeezed.starts_with(part.class());
            found.push((far, cut, other, PartId(i as u16)));
        }
    }
    found.sort();
    found.truncate(OFFERS);
    found.into_iter().map(|(_, _, _, id)| id).collect()
}

/// Returns the known word nearest to a misspelt one, if it is near enough.
pub(super) fn near<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let far = |k: &str| slips(&word.to_lowercase(), &k.to_lowercase());
    let allowed = 1 + word.chars().count() / 4;
    // Something of it must agree.
    suggest::nearest(
        known.iter().copied(),
        |k| (far(k), k),
        |k| allowed.min(k.len().saturating_sub(1)),
    )
}
