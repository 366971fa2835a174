//! Which known word the author may have meant: the one measure of how far two spellings are apart.

/// Returns how many letters lie between two spellings: one each for a letter that is missing, surplus, wrong, or
/// swapped with the next.
pub(crate) fn slips(word: &str, other: &str) -> usize {
    strsim::osa_distance(word, other)
}

/// Returns the known word with the lowest score, among equal ones the first, if it may be meant. A score begins with
/// the number of slips; `allowed` tells how many of them a word may have.
pub(crate) fn nearest<K: Copy, S: Ord>(
    known: impl IntoIterator<Item = K>,
    score: impl Fn(K) -> (usize, S),
    allowed: impl Fn(K) -> usize,
) -> Option<K> {
    let scored = known.into_iter().map(|word| (score(word), word));
    let ((slips, _), best) = scored.min_by(|(a, _), (b, _)| a.cmp(b))?;
    (slips <= allowed(best)).then_some(best)
}
