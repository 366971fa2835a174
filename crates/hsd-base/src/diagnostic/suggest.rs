//! Suggestions for misspelt words: the only measure of the distance between two spellings.

/// Returns the number of errors between two spellings: letters that are missing, surplus, wrong, or swapped with the
/// next.
pub fn slips(word: &str, other: &str) -> usize {
    strsim::osa_distance(word, other)
}

/// Returns the known word with the lowest score, the first of equal ones, if it has at most the `allowed` number of
/// slips. A score begins with the number of slips.
pub fn nearest<K: Copy, S: Ord>(
    known: impl IntoIterator<Item = K>,
    score: impl Fn(K) -> (usize, S),
    allowed: impl Fn(K) -> usize,
) -> Option<K> {
    let scored = known.into_iter().map(|word| (score(word), word));
    let ((slips, _), best) = scored.min_by(|(a, _), (b, _)| a.cmp(b))?;
    (slips <= allowed(best)).then_some(best)
}
