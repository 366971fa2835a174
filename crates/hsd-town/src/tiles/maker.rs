//! Makes tiles and pieces of ground, each by itself: one that is there already is kept.

use super::TileStore;
use super::home::Home;
use super::input::{TileSalt, evaluate};
use super::make::{MadeTile, make, picture_hash};
use super::mesh::Tile;
use super::piece;
use super::record::{TileRecord, record_file};
use super::terrain::{Cell, Patch};
use crate::decision::{Entry, LostHouse};
use crate::stream::Account;
use crate::{Plan, TownInput};
use hsd_base::diagnostic::{Diagnostics, Origin};
use hsd_base::source::Source;
use hsd_driver::{FeatureHouse, TileDriver};
use hsd_export::gltf::SpareArrays;
use hsd_ir::ast::WrittenPart;
use hsd_ir::ast::town::Tiles;
use hsd_ir::catalog::Catalog;
use hsd_scene::Detail;
use hsd_syntax::parse::Values;
use std::collections::BTreeSet;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What tiles are made with, whatever their features are.
#[derive(Clone, Copy)]
pub struct TileMeans<'a> {
    /// The town file, its maps and options.
    pub input: TownInput<'a>,
    /// The catalogue with its custom parts.
    pub catalog: &'a Catalog,
    /// The sources of custom parts.
    pub parts: &'a [&'a Source],
    /// The custom parts of the town file.
    pub written: &'a [WrittenPart],
    /// The year of the town, if it has one.
    pub year: Option<&'a str>,
    /// How it is divided, and the levels of detail.
    pub division: &'a Tiles,
    /// True if the arrays of tiles are packed (`EXT_meshopt_compression`), where this program can.
    pub packed: bool,
}

/// What became of one tile, or of one piece of ground.
#[derive(Debug, Default)]
pub struct Done {
    /// How many of its features were built, skipped or corrected.
    pub account: Option<Account>,
    /// What is known of it, if it has houses.
    pub record: Option<TileRecord>,
    /// What was found while it was made.
    pub found: Diagnostics,
    /// True if it was there already.
    pub kept: bool,
    /// Types and files that were read.
    pub included: Vec<Source>,
    /// The values of expressions, if the options ask for them.
    pub values: Values,
    /// Its files, if the store does not have them yet.
    pub(super) unkept: Option<MadeTile>,
}

impl Done {
    /// Takes the houses that exceed a limit from its account; `owners` are the features of all its houses.
    fn lose(&mut self, owners: Vec<LostHouse>, record: &TileRecord) {
        let lost = record.left_out.iter().filter_map(|(number, code, reason)| {
            Some(LostHouse {
                code: code.clone(),
                reason: reason.clone(),
                ..owners.get(*number)?.clone()
            })
        });
        let lost: Vec<LostHouse> = lost.collect();
        if let Some(account) = &mut self.account {
            account.lose(&lost);
        }
    }

    /// Returns the result for features whose tile cannot be made.
    pub fn unmade(part: &Plan, lots: &[(usize, usize)]) -> Done {
        let entry = |id: &(usize, usize)| {
            let layer = &part.layers[id.0].layer.name.value;
            Entry::unmade(id.0, layer, part.lot(*id))
        };
        Done {
            account: Some(Account::incomplete(lots.iter().map(entry).collect())),
            ..Done::default()
        }
    }
}

/// Returns what is known of a house that may turn out to exceed a limit.
fn owner(house: &FeatureHouse) -> LostHouse {
    let (layer, key) = match &house.origin {
        Origin::Feature { layer, key } => (layer.to_string(), key.to_string()),
        Origin::Source(_) => Default::default(),
    };
    LostHouse {
        id: house.feature,
        layer,
        key,
        code: String::new(),
        reason: String::new(),
    }
}

/// Makes tiles.
pub struct Maker<'a> {
    means: TileMeans<'a>,
    store: &'a dyn TileStore,
    driver: TileDriver<'a>,
    salt: TileSalt,
    levels: Vec<Detail>,
    home: Home,
    spare: SpareArrays,
}

/// Returns the levels of detail, from far to near.
fn levels(division: &Tiles) -> Vec<Detail> {
    let numbers: BTreeSet<u8> = division.detail.iter().copied().collect();
    let level = |number: u8| Detail::ALL[usize::from(number).min(3)];
    numbers.into_iter().map(level).collect()
}

impl<'a> Maker<'a> {
    /// Creates one that keeps its tiles in a store.
    pub fn new(means: TileMeans<'a>, store: &'a dyn TileStore) -> Maker<'a> {
        let levels = levels(means.division);
        let (input, parts) = (means.input, (means.parts, means.written));
        Maker {
            means,
            store,
            driver: TileDriver::new(
                input.source,
                means.catalog,
                (input.world, input.options),
                &levels,
            ),
            salt: TileSalt::new(input, (&levels, means.packed), parts),
            levels,
            home: Home::of(input.source.name()),
            spare: SpareArrays::default(),
        }
    }

    /// Returns what the hashes of all tiles begin with.
    pub fn salt(&self) -> &TileSalt {
        &self.salt
    }

    /// Makes a tile, unless it is there, and keeps nothing yet; one that makes the program fail is left out, and its features
    /// are reported.
    ///
    /// # Errors
    /// Those of the spool in which features wait.
    pub fn unkept_or_why_not(&self, plan: &Plan, tile: &Tile) -> io::Result<Done> {
        match catch_unwind(AssertUnwindSafe(|| self.unkept(plan, tile))) {
            Ok(done) => done,
            Err(_) => tile.with(plan, |part, lots, _| Done::unmade(part, lots)),
        }
    }

    /// Makes a tile of a town, unless it is there, and keeps it.
    ///
    /// # Errors
    /// Those of the store, and of the spool in which features wait.
    pub fn tile(&self, plan: &Plan, tile: &Tile) -> io::Result<Done> {
        self.kept(self.unkept(plan, tile)?)
    }

    fn unkept(&self, plan: &Plan, tile: &Tile) -> io::Result<Done> {
        let (input, year) = (self.means.input, self.means.year);
        let mut input = evaluate(tile, (plan, input), year, &self.salt)?;
        let owners: Vec<LostHouse> = input.houses.iter().map(owner).collect();
        let mut done = Done {
            included: std::mem::take(&mut input.chunk.included),
            values: std::mem::take(&mut input.chunk.values),
            account: Some(Account::of(&mut input.chunk)),
            ..Done::default()
        };
        if input.houses.is_empty() {
            return Ok(done);
        }
        if let Some(known) = self.known(&tile.key.stem(), &input.hash) {
            done.kept = true;
            done.lose(owners, &known);
            done.record = Some(known);
            return Ok(done);
        }
        let mut made = make(
            &self.driver,
            tile,
            input,
            (&self.levels, self.means.packed),
            (self.means.input.world, &self.spare),
        )?;
        for (path, _) in &mut made.record.pictures {
            *path = self.home.seen(path);
        }
        done.lose(owners, &made.record);
        done.found = std::mem::take(&mut made.found);
        done.unkept = Some(made);
        Ok(done)
    }

    /// Keeps the files of a tile.
    ///
    /// # Errors
    /// Those of the store.
    pub fn kept(&self, mut done: Done) -> io::Result<Done> {
        let Some(made) = done.unkept.take() else {
            return Ok(done);
        };
        self.keep(&made)?;
        for (name, bytes) in made.files {
            if let Some(level) = made.record.levels.iter().find(|level| level.file == name) {
                self.spare.keep(level.detail, bytes);
            }
        }
        done.record = Some(made.record);
        Ok(done)
    }

    /// Makes a piece of ground, unless it is there.
    ///
    /// # Errors
    /// Those of the store.
    pub fn piece(&self, plan: &Plan, cell: Cell) -> io::Result<Done> {
        let size = self.means.division.size;
        let Some(patch) = Patch::new(&plan.ground, cell, size) else {
            return Ok(Done::default());
        };
        let row = piece::row((plan, self.means.input.source), cell);
        let hash = self.salt.piece(&patch, &row);
        if let Some(known) = self.known(&patch.name(), &hash) {
            return Ok(Done {
                record: Some(known),
                kept: true,
                ..Done::default()
            });
        }
        let made = piece::make(&patch, row, &hash, (&self.levels, self.means.packed));
        self.keep(&made)?;
        Ok(Done {
            record: Some(made.record),
            ..Done::default()
        })
    }

    /// Keeps what was made; its record comes last, since whoever finds that finds the others too.
    fn keep(&self, made: &MadeTile) -> io::Result<()> {
        for (name, bytes) in &made.files {
            self.store.commit(name, bytes)?;
        }
        let mut json = serde_json::to_vec(&made.record)?;
        json.push(b'\n');
        self.store.commit(&made.record.file(), &json.into())
    }

    /// Returns the record of a tile whose files are all there.
    fn known(&self, tile: &str, hash: &str) -> Option<TileRecord> {
        let bytes = self.store.read(&record_file(tile, hash))?;
        let record: TileRecord = serde_json::from_slice(&bytes).ok()?;
        self.is_whole(&record).then_some(record)
    }

    /// Returns true if the files of a tile are all there, and its images are what they were.
    pub fn is_whole(&self, record: &TileRecord) -> bool {
        let world = self.means.input.world;
        let same = |(path, hash): &(String, String)| {
            let own = self.home.path(path);
            picture_hash(&own, world) == *hash || picture_hash(path, world) == *hash
        };
        record.files().all(|name| self.store.has(name)) && record.pictures.iter().all(same)
    }
}
