//! The decisions on features, collected until all are known: they come tile by tile and are written to the table in the order
//! of the files. Those of a large town are kept in a spool.

use crate::decision::{Entry, LostHouse};
use crate::plan::{LotId, Shelves};
use hsd_export::spool::{NewSpool, Spool};
use std::collections::BTreeMap;
use std::io::{self, SeekFrom, Write};

/// The features of a layer whose entries lie on one shelf.
const RANGE: usize = 1 << 13;

/// The shelf of each range of features of a layer.
type ShelfOf = BTreeMap<(usize, usize), usize>;

/// The entries of a town.
#[derive(Default)]
pub struct Entries {
    kept: Vec<Entry>,
    /// The spool of a large town, by shelves, with the shelf of each range of features.
    spooled: Option<(Shelves, ShelfOf)>,
}

impl Entries {
    /// Begins a list, which waits in a spool if there is one.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn new(spool: Option<NewSpool<'_>>) -> io::Result<Entries> {
        let shelves = spool.map(Shelves::new).transpose()?;
        Ok(Entries {
            kept: vec![],
            spooled: shelves.map(|shelves| (shelves, BTreeMap::new())),
        })
    }

    pub(super) fn push(&mut self, entry: Entry) -> io::Result<()> {
        let Some((shelves, known)) = &mut self.spooled else {
            self.kept.push(entry);
            return Ok(());
        };
        let next = known.len();
        let (layer, number) = entry.id;
        let shelf = *known.entry((layer, number / RANGE)).or_insert(next);
        let mut line = serde_json::to_vec(&entry)?;
        line.push(b'\n');
        shelves.push(shelf, &line)
    }

    /// Takes houses that would exceed a limit from the features that are kept in memory; returns true if there are any.
    pub(super) fn lose(&mut self, lost: &[LostHouse]) -> bool {
        lose(&mut self.kept, lost)
    }

    /// Hands over all entries in the order of their features.
    pub(super) fn each(mut self, take: &mut dyn FnMut(Entry) -> io::Result<()>) -> io::Result<()> {
        if let Some((mut shelves, known)) = self.spooled {
            for shelf in known.into_values() {
                let bytes = shelves.read(shelf)?;
                let lines = serde_json::Deserializer::from_slice(&bytes).into_iter();
                let mut entries = lines.collect::<Result<Vec<Entry>, _>>()?;
                entries.sort_by_key(|entry| entry.id);
                entries.into_iter().try_for_each(&mut *take)?;
            }
        }
        self.kept.sort_by_key(|entry| entry.id);
        self.kept.into_iter().try_for_each(take)
    }
}

/// The table of decisions as it is written.
#[derive(Default)]
pub struct Table {
    text: String,
    spool: Option<Box<dyn Spool>>,
}

/// The bytes of a table that go to its spool at a time.
const BLOCK: usize = 1 << 16;

impl Table {
    /// Begins a table, which waits in a spool if there is one.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn new(spool: Option<NewSpool<'_>>) -> io::Result<Table> {
        Ok(Table {
            text: String::new(),
            spool: spool.map(|new| new()).transpose()?,
        })
    }

    pub(super) fn push(&mut self, line: &str) -> io::Result<()> {
        self.text.push_str(line);
        match &mut self.spool {
            Some(spool) if self.text.len() >= BLOCK => {
                spool.write_all(self.text.as_bytes())?;
                self.text.clear();
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Writes the table.
    ///
    /// # Errors
    /// Those of the spool and of `out`.
    pub fn write(&mut self, out: &mut dyn Write) -> io::Result<u64> {
        let mut length = 0;
        if let Some(spool) = &mut self.spool {
            spool.seek(SeekFrom::Start(0))?;
            length = io::copy(spool, out)?;
        }
        out.write_all(self.text.as_bytes())?;
        Ok(length + self.text.len() as u64)
    }

    /// Returns the text of a table that is kept in memory.
    pub fn text(&self) -> &str {
        &self.text
    }
}

impl std::fmt::Debug for Entries {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.kept.fmt(f)
    }
}

impl std::fmt::Debug for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// Takes houses that would exceed a limit from the entries of their features; returns true if there are any.
pub(super) fn lose(entries: &mut [Entry], lost: &[LostHouse]) -> bool {
    if lost.is_empty() {
        return false;
    }
    let places = entries.iter().enumerate();
    let places: BTreeMap<(LotId, Box<str>), usize> = places
        .map(|(n, entry)| ((entry.id, entry.key.clone()), n))
        .collect();
    for house in lost {
        if let Some(n) = places.get(&(house.id, house.key.as_str().into())) {
            entries[*n].lose_house(house);
        }
    }
    true
}
