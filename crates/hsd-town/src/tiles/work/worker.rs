//! Makes the tiles of planned work.

use super::{Manifest, Place, PlannedTile, base, head_file, inputs};
use crate::plan::{LotId, PartReader};
use crate::stream::{Account, StoredAccount};
use crate::tiles::TileStore;
use crate::tiles::home::Home;
use crate::tiles::maker::{Done, Maker, TileMeans};
use crate::tiles::mesh::{Tile, TileKey};
use crate::tiles::record::TileRecord;
use crate::{Plan, run};
use hsd_base::diagnostic::stored::StoredDiagnostics;
use hsd_base::source::Source;
use hsd_ir::ast::town::Town;
use hsd_syntax::templates::Template;
use serde::{Deserialize, Serialize};
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use twox_hash::XxHash3_128;

/// Makes tiles of planned work, each by itself.
pub struct Worker<'a> {
    pub(super) manifest: &'a Manifest,
    pub(super) reader: PartReader,
    maker: Maker<'a>,
    means: TileMeans<'a>,
    store: &'a dyn TileStore,
    home: Home,
}

/// Why planned work cannot be gone on with.
#[derive(Debug)]
pub enum NotOpened {
    /// The town file, its options or the program are others.
    Changed,
    /// What all tiles share is not there, or is not what was written.
    Damaged,
}

/// How a tile was finished.
#[derive(Debug)]
pub enum Finished {
    /// All of it was there.
    There,
    /// Its rules were evaluated, and its files were there.
    Kept,
    /// It was made.
    Made,
}

/// Why a tile was not made.
#[derive(Debug)]
pub enum Trouble {
    /// Its part is not there, or is not what was written.
    Damaged,
    /// It made the program fail, and would do so again.
    Poison,
    /// A file cannot be written, or read.
    Io(io::Error),
}

/// What is stored of a tile that has been made.
#[derive(Debug, Deserialize, Serialize)]
struct StoredTile {
    account: Option<StoredAccount>,
    record: Option<TileRecord>,
    found: StoredDiagnostics,
    /// The files that its rules read, as seen from the town file, with their hashes.
    files: Vec<(String, String)>,
}

impl<'a> Worker<'a> {
    /// Goes on with planned work; the town is that of the file which was planned.
    ///
    /// # Errors
    /// If it is another town, or the store does not have what all tiles share.
    pub fn open(
        manifest: &'a Manifest,
        town: Town,
        means: TileMeans<'a>,
        store: &'a dyn TileStore,
    ) -> Result<Worker<'a>, NotOpened> {
        let maker = Maker::new(means, store);
        if base(&means, &maker) != manifest.town {
            return Err(NotOpened::Changed);
        }
        let head = store.read(&manifest.head);
        let head = head.filter(|bytes| head_file(bytes) == manifest.head);
        let head = head.ok_or(NotOpened::Damaged)?;
        let reader = PartReader::new(town, &head).map_err(|_| NotOpened::Damaged)?;
        Ok(Worker {
            manifest,
            reader,
            maker,
            means,
            store,
            home: Home::of(means.input.source.name()),
        })
    }

    /// Returns the town without its features.
    pub fn town(&self) -> &Plan {
        &self.reader.head
    }

    /// Makes a tile, unless it is there.
    ///
    /// # Errors
    /// If it cannot be made. What is there stays.
    pub fn make(&self, tile: &PlannedTile) -> Result<Finished, Trouble> {
        if self.made(tile).is_some() {
            return Ok(Finished::There);
        }
        let part = self.part(tile).ok_or(Trouble::Damaged)?;
        let made = catch_unwind(AssertUnwindSafe(|| self.one(tile, &part)));
        let done = made.unwrap_or(Err(Trouble::Poison))?;
        let kept = done.kept;
        self.keep(tile, done).map_err(Trouble::Io)?;
        Ok(match kept {
            true => Finished::Kept,
            false => Finished::Made,
        })
    }

    fn one(&self, tile: &PlannedTile, part: &[u8]) -> Result<Done, Trouble> {
        if let Place::Ground(east, north) = tile.place {
            let plan = self.reader.ground(part).map_err(|_| Trouble::Damaged)?;
            return self.maker.piece(&plan, (east, north)).map_err(Trouble::Io);
        }
        let (plan, own) = self.reader.part(part).map_err(|_| Trouble::Damaged)?;
        let tile = Tile::of(tile_key(tile), own, &plan, self.means.division.size);
        self.maker.tile(&plan, &tile).map_err(Trouble::Io)
    }

    /// Stores what became of a tile, whose files are there already.
    fn keep(&self, tile: &PlannedTile, done: Done) -> io::Result<()> {
        let others = done.included.iter();
        let others = others.filter(|source| !Template::is_source(source.name()));
        let files = others.map(|s| (self.home.seen(s.name()), hash(s)));
        let stored = StoredTile {
            files: files.collect(),
            account: done.account.map(Account::stored),
            record: done.record,
            found: (&done.found).into(),
        };
        let mut json = serde_json::to_vec(&stored)?;
        json.push(b'\n');
        self.store.commit(&tile.made(), &json.into())
    }

    /// Returns what became of a tile, if it and all its files are there and what was read for it is the same.
    pub(super) fn made(&self, tile: &PlannedTile) -> Option<Done> {
        let bytes = self.store.read(&tile.made())?;
        let stored: StoredTile = serde_json::from_slice(&bytes).ok()?;
        let (input, limits) = (self.means.input, &self.means.input.options.expand.limits);
        let same = |(seen, known): &(String, String)| {
            let path = self.home.path(seen);
            let bytes = input.world.text_bytes(&path, limits.bytes);
            bytes.is_ok_and(|bytes| hash(&Source::new(input.source.id(), &path, &bytes)) == *known)
        };
        let whole = |record: &TileRecord| self.maker.is_whole(record);
        let is_there = stored.files.iter().all(same) && stored.record.as_ref().is_none_or(whole);
        is_there.then(|| Done {
            account: stored.account.map(Into::into),
            record: stored.record,
            found: stored.found.into(),
            ..Done::default()
        })
    }

    /// Reads the part of a tile; `None` if it is not what was written.
    fn part(&self, tile: &PlannedTile) -> Option<Vec<u8>> {
        let part = self.store.read(&tile.part())?;
        let of = (&*self.manifest.town, &*self.manifest.head);
        (inputs(of, &part) == tile.inputs).then_some(part)
    }

    /// Returns the result for a tile that was not made; `None` if its part is damaged.
    pub(super) fn unmade(&self, tile: &PlannedTile) -> Option<Done> {
        let part = self.part(tile)?;
        match tile.place {
            Place::Ground(..) => Some(Done::default()),
            _ => {
                let (plan, own) = self.reader.part(&part).ok()?;
                Some(Done::unmade(&plan, &own))
            }
        }
    }

    /// Returns types and files that the first tile reads, by which diagnostics name their places.
    pub(super) fn included(&self) -> Vec<Source> {
        let first = self.manifest.tiles.first();
        let part = first.and_then(|tile| self.reader.part(&self.part(tile)?).ok());
        let evaluated = part.map(|(plan, own): (Plan, Vec<LotId>)| {
            catch_unwind(AssertUnwindSafe(|| {
                run::evaluate(self.means.input, &plan, &own).included
            }))
        });
        evaluated.and_then(Result::ok).unwrap_or_default()
    }
}

fn tile_key(tile: &PlannedTile) -> TileKey {
    match &tile.place {
        Place::Cell(east, north) | Place::Ground(east, north) => TileKey::Cell(*east, *north),
        Place::Named(name) => TileKey::Named(name.clone()),
    }
}

fn hash(source: &Source) -> String {
    format!(
        "{:016x}",
        XxHash3_128::oneshot(source.text().as_bytes()) as u64
    )
}
