//! Shelves: bytes that come in any order of their shelves and are read back a shelf at a time. They wait in a spool, so that
//! the memory they take does not grow with what is on them.

use hsd_export::spool::{NewSpool, Spool};
use std::io::{self, SeekFrom};
use std::mem;

/// The bytes of all shelves together that are not in the spool yet.
const PENDING: usize = 4 << 20;

/// Bytes on numbered shelves, on each in the order in which they came.
pub(crate) struct Shelves {
    spool: Box<dyn Spool>,
    length: u64,
    shelves: Vec<Shelf>,
    pending: usize,
}

#[derive(Default)]
struct Shelf {
    /// Its blocks in the spool: start and length.
    blocks: Vec<(u64, usize)>,
    /// Its end, which is not in the spool yet.
    pending: Vec<u8>,
}

impl Shelves {
    pub(crate) fn new(new: NewSpool<'_>) -> io::Result<Shelves> {
        Ok(Shelves {
            spool: new()?,
            length: 0,
            shelves: vec![],
            pending: 0,
        })
    }

    /// Returns the number of shelves, empty ones before the last included.
    pub(crate) fn len(&self) -> usize {
        self.shelves.len()
    }

    /// Appends to a shelf.
    pub(crate) fn push(&mut self, shelf: usize, bytes: &[u8]) -> io::Result<()> {
        if self.shelves.len() <= shelf {
            self.shelves.resize_with(shelf + 1, Shelf::default);
        }
        self.shelves[shelf].pending.extend_from_slice(bytes);
        self.pending += bytes.len();
        match self.pending > PENDING {
            true => self.flush(),
            false => Ok(()),
        }
    }

    /// Returns all that is on a shelf.
    pub(crate) fn read(&mut self, shelf: usize) -> io::Result<Vec<u8>> {
        let Some(Shelf { blocks, pending }) = self.shelves.get(shelf) else {
            return Ok(vec![]);
        };
        let length: usize = blocks.iter().map(|(_, length)| length).sum();
        let mut all = vec![0; length];
        let mut from = 0;
        for (start, length) in blocks {
            self.spool.seek(SeekFrom::Start(*start))?;
            self.spool.read_exact(&mut all[from..from + length])?;
            from += length;
        }
        all.extend_from_slice(pending);
        Ok(all)
    }

    /// Puts all that is pending into the spool.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.spool.seek(SeekFrom::Start(self.length))?;
        for shelf in &mut self.shelves {
            let bytes = mem::take(&mut shelf.pending);
            if !bytes.is_empty() {
                self.spool.write_all(&bytes)?;
                shelf.blocks.push((self.length, bytes.len()));
                self.length += bytes.len() as u64;
            }
        }
        self.pending = 0;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_export::spool::in_memory;

    #[test]
    fn each_shelf_keeps_its_own_order() {
        let mut shelves = Shelves::new(&in_memory).expect("is made");
        let mut wanted = vec![vec![]; 7];
        for n in 0..3_000_u32 {
            let shelf = (n.wrapping_mul(2_654_435_761) >> 8) as usize % 7;
            let bytes = n.to_le_bytes().repeat(1 + n as usize % 1500);
            shelves.push(shelf, &bytes).expect("there is room");
            wanted[shelf].extend(bytes);
        }
        assert!(shelves.length > 0, "nothing went to the spool");
        for _ in 0..2 {
            for (shelf, wanted) in wanted.iter().enumerate() {
                assert!(shelves.read(shelf).expect("is read") == *wanted);
            }
        }
        assert!(shelves.read(99).expect("is read").is_empty());
    }
}
