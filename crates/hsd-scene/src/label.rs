//! A short word stored inline: codes of parts and letters of roofs; a town has a million of them.

use serde::{Serialize, Serializer};
use std::num::NonZeroU8;
use std::ops::Deref;

/// Capacity of a label, bytes.
const MOST: usize = 6;

/// A word of at most six bytes.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Label {
    /// The length plus one, so that an absent label takes no extra space.
    length: NonZeroU8,
    bytes: [u8; MOST],
}

impl Label {
    /// Returns the word.
    pub fn as_str(&self) -> &str {
        let length = usize::from(self.length.get() - 1);
        std::str::from_utf8(&self.bytes[..length]).unwrap_or_default()
    }
}

impl From<&str> for Label {
    /// Truncates longer words at a character boundary.
    fn from(word: &str) -> Label {
        let mut length = word.len().min(MOST);
        while !word.is_char_boundary(length) {
            length -= 1;
        }
        let mut bytes = [0; MOST];
        bytes[..length].copy_from_slice(&word.as_bytes()[..length]);
        Label {
            length: NonZeroU8::MIN.saturating_add(length as u8),
            bytes,
        }
    }
}

impl Deref for Label {
    type Target = str;

    fn deref(&self) -> &str {
        self.as_str()
    }
}

impl std::fmt::Debug for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.as_str().fmt(f)
    }
}

impl Serialize for Label {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back_as_they_were() {
        for word in ["", "MKU  ", "KIR", "GDE 22"] {
            assert_eq!(Label::from(word).as_str(), word);
        }
        assert_eq!(Label::from("町家屋").as_str(), "町家");
        assert_eq!(Label::from("12345町").as_str(), "12345");
    }

    #[test]
    fn absent_labels_take_no_room() {
        assert_eq!(size_of::<Option<Label>>(), 7);
    }
}
