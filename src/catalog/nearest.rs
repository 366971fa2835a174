//! Which code an unknown one was meant to be.

use super::{Catalog, PartId};

/// How many spellings are offered.
const OFFERS: usize = 3;

/// Edits farther than this are another word.
const FARTHEST: usize = 3;

/// Up to three parts whose code is near, best first. Case does not count, nor do lost blanks; among
/// equals a code that only lost its last columns wins, then the same class letter, then the catalogue's
/// order.
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
        let far = distance(&folded, &theirs).min(distance(&squeezed, &tight));
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

/// Letters to insert, drop, replace or swap with their neighbour to come from one text to the other.
fn distance(from: &str, to: &str) -> usize {
    let (from, to): (Vec<char>, Vec<char>) = (from.chars().collect(), to.chars().collect());
    let mut table: Vec<Vec<usize>> = vec![(0..=to.len()).collect()];
    for i in 1..=from.len() {
        let mut row = vec![i];
        for j in 1..=to.len() {
            let same = usize::from(from[i - 1] != to[j - 1]);
            let mut best = (table[i - 1][j] + 1)
                .min(row[j - 1] + 1)
                .min(table[i - 1][j - 1] + same);
            if i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1] {
                best = best.min(table[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        table.push(row);
    }
    table[from.len()][to.len()]
}
