//! The bytes of a file in pieces: large arrays are put into it as they are, so that they are never copied.

use std::io::{self, Write};

/// Bytes in pieces, in their order.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    whole: Vec<Vec<u8>>,
    /// The bytes of all whole pieces.
    before: usize,
    /// The last piece, which grows.
    open: Vec<u8>,
}

impl From<Vec<u8>> for Pieces {
    fn from(open: Vec<u8>) -> Pieces {
        Pieces {
            open,
            ..Pieces::default()
        }
    }
}

impl Pieces {
    /// Returns the number of bytes.
    pub fn len(&self) -> usize {
        self.before + self.open.len()
    }

    /// Returns true if there are no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends zeros until the number of bytes is a multiple.
    pub fn pad(&mut self, multiple: usize) {
        let missing = self.len().next_multiple_of(multiple) - self.len();
        self.open.resize(self.open.len() + missing, 0);
    }

    /// Returns the end, to append to.
    pub fn end(&mut self) -> &mut Vec<u8> {
        &mut self.open
    }

    /// Appends a piece.
    pub fn push(&mut self, piece: Vec<u8>) {
        let open = std::mem::take(&mut self.open);
        for piece in [open, piece] {
            self.before += piece.len();
            self.whole.push(piece);
        }
    }

    /// Returns the pieces behind another.
    pub fn behind(mut self, first: Vec<u8>) -> Pieces {
        self.before += first.len();
        self.whole.insert(0, first);
        self
    }

    /// Returns the pieces.
    pub fn iter(&self) -> impl Iterator<Item = &[u8]> {
        let all = self.whole.iter().chain([&self.open]);
        all.map(Vec::as_slice)
    }

    /// Writes all.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        self.iter().try_for_each(|piece| out.write_all(piece))
    }

    /// Returns the whole pieces.
    pub fn into_whole(self) -> Vec<Vec<u8>> {
        self.whole
    }

    /// Returns all as one.
    pub fn to_vec(&self) -> Vec<u8> {
        let mut all = Vec::with_capacity(self.len());
        self.iter().for_each(|piece| all.extend_from_slice(piece));
        all
    }

    /// Returns true if these are the bytes.
    pub fn are(&self, bytes: &[u8]) -> bool {
        let rest = self
            .iter()
            .try_fold(bytes, |rest, piece| rest.strip_prefix(piece));
        rest.is_some_and(<[u8]>::is_empty)
    }
}

#[cfg(test)]
mod tests {
    use super::Pieces;

    #[test]
    fn pieces_are_one_after_another() {
        let mut pieces = Pieces::from(b"ab".to_vec());
        pieces.pad(4);
        pieces.push(b"cd".to_vec());
        pieces.end().extend(b"e");
        let pieces = pieces.behind(b"head".to_vec());
        assert_eq!(pieces.to_vec(), b"headab\0\0cde");
        assert_eq!(pieces.len(), pieces.to_vec().len());
        assert!(pieces.are(b"headab\0\0cde"));
        assert!(!pieces.are(b"headab\0\0cd") && !pieces.are(b"headab\0\0cdef"));
    }
}
