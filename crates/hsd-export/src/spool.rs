//! Spools: where the parts of a file wait that cannot be written yet. A model begins with lists of all its houses, so
//! they are collected while the houses pass; a shell keeps them in files, so that a town does not fill the memory.

use serde::Serialize;
use std::io::{self, Cursor, Read, Seek, SeekFrom, Write};
use std::ops::Range;

/// Bytes that are written once and read back at the end.
pub trait Spool: Read + Write + Seek + Send {}

impl<T: Read + Write + Seek + Send> Spool for T {}

/// Makes empty spools.
pub type NewSpool<'n> = &'n (dyn Fn() -> io::Result<Box<dyn Spool>> + Send + Sync);

/// Makes a spool in memory.
///
/// # Errors None; the type is that of [`NewSpool`].
pub fn in_memory() -> io::Result<Box<dyn Spool>> {
    Ok(Box::new(Cursor::new(vec![])))
}

/// The bytes that go to the spool at a time.
const BLOCK: usize = 1 << 16;

/// A section of a file.
pub(crate) struct Section {
    name: &'static str,
    spool: Box<dyn Spool>,
    /// The end, which is not in the spool yet.
    pending: Vec<u8>,
    length: u64,
}

impl Section {
    pub(crate) fn new(name: &'static str, new: NewSpool<'_>) -> io::Result<Section> {
        Ok(Section {
            name,
            spool: new()?,
            pending: vec![],
            length: 0,
        })
    }

    /// Returns what is in it.
    pub(crate) fn name(&self) -> &'static str {
        self.name
    }

    /// Returns its length, bytes.
    pub(crate) fn length(&self) -> u64 {
        self.length
    }

    /// Appends what is written to a buffer; returns where it lies.
    pub(crate) fn append(
        &mut self,
        write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>,
    ) -> io::Result<Range<u64>> {
        let (start, before) = (self.length, self.pending.len());
        write(&mut self.pending)?;
        self.length += (self.pending.len() - before) as u64;
        if self.pending.len() >= BLOCK {
            self.flush()?;
        }
        Ok(start..self.length)
    }

    /// Changes bytes that were appended before.
    pub(crate) fn change(
        &mut self,
        range: Range<u64>,
        change: impl FnOnce(&mut [u8]),
    ) -> io::Result<()> {
        self.flush()?;
        let mut bytes = vec![0; (range.end - range.start) as usize];
        self.spool.seek(SeekFrom::Start(range.start))?;
        self.spool.read_exact(&mut bytes)?;
        change(&mut bytes);
        self.spool.seek(SeekFrom::Start(range.start))?;
        self.spool.write_all(&bytes)?;
        self.spool.seek(SeekFrom::End(0)).map(drop)
    }

    /// Writes all of it.
    pub(crate) fn write(&mut self, out: &mut impl Write) -> io::Result<()> {
        let all = self.read()?;
        let mut block = vec![0; BLOCK];
        loop {
            match all.read(&mut block)? {
                0 => return Ok(()),
                count => out.write_all(&block[..count])?,
            }
        }
    }

    /// Returns all of it, from the start.
    pub(crate) fn read(&mut self) -> io::Result<&mut dyn Spool> {
        self.flush()?;
        self.spool.seek(SeekFrom::Start(0))?;
        Ok(&mut *self.spool)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.spool.write_all(&self.pending)?;
        self.pending.clear();
        Ok(())
    }
}

/// A list of the JSON.
pub(crate) struct List {
    section: Section,
    count: u32,
}

impl List {
    pub(crate) fn new(new: NewSpool<'_>) -> io::Result<List> {
        Ok(List {
            section: Section::new("list", new)?,
            count: 0,
        })
    }

    /// Returns its length, bytes.
    pub(crate) fn length(&self) -> u64 {
        self.section.length()
    }

    /// Returns the number of its items.
    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// Appends an item; returns its number.
    pub(crate) fn push(&mut self, item: &impl Serialize) -> io::Result<u32> {
        let number = self.count;
        self.section.append(|out| {
            if number > 0 {
                out.push(b',');
            }
            Ok(serde_json::to_writer(out, item)?)
        })?;
        self.count += 1;
        Ok(number)
    }

    /// Writes it as a JSON array.
    pub(crate) fn write(&mut self, out: &mut impl Write) -> io::Result<()> {
        out.write_all(b"[")?;
        self.section.write(out)?;
        out.write_all(b"]")
    }
}
