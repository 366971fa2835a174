//! Content hashes, to tell what has changed.

use std::hash::{DefaultHasher, Hasher};

/// Returns the hash of what `content` feeds to the hasher. It is stable within one run of the program.
pub(super) fn fingerprint(content: impl FnOnce(&mut DefaultHasher)) -> u64 {
    let mut hasher = DefaultHasher::new();
    content(&mut hasher);
    hasher.finish()
}
