//! All tiles of a town: those that are there are kept, the others are made, each by one thread from beginning to end.

use super::TileStore;
use super::input::{TileSalt, evaluate};
use super::make::{MadeTile, make, picture_hash};
pub use super::mesh::Reach;
use super::mesh::{Tile, TileKey, tiles};
use super::piece;
use super::record::{TileRecord, record_file};
use super::terrain::{self, Cell, Patch};
use crate::ast::WrittenPart;
use crate::ast::town::Tiles;
use crate::backend::spool::NewSpool;
use crate::backend::tileset::{self, TreeFiles};
use crate::catalog::Catalog;
use crate::diagnostic::Diagnostics;
use crate::driver::{Options, Read, TileDriver};
use crate::map::{on_globe, sea_level};
use crate::scene::Detail;
use crate::source::Source;
use crate::town::run::Chunk;
use crate::town::stream::Ledger;
use crate::town::{Plan, TownInput};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// A town to be built in tiles.
#[derive(Clone, Copy)]
pub struct TileJob<'a> {
    /// The town file, its maps and options.
    pub input: TownInput<'a>,
    /// The town.
    pub plan: &'a Plan,
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
    /// Which of its tiles are made.
    pub reach: Reach,
    /// The number of threads.
    pub threads: usize,
    /// True if the arrays of tiles are packed (`EXT_meshopt_compression`), where this program can.
    pub packed: bool,
    /// Makes the spool for the table of decisions; without it the table is kept in memory.
    pub spool: Option<NewSpool<'a>>,
}

/// What a town file says beside its layers and rules, as far as its tiles depend on it.
pub struct TileParts<'a> {
    parts: Vec<&'a Source>,
    written: Vec<WrittenPart>,
    year: Option<String>,
}

impl<'a> TileParts<'a> {
    /// Collects it from what was read.
    pub fn of(read: &'a Read, options: &'a Options) -> TileParts<'a> {
        let own = read.documents.iter().flat_map(|d| &d.parts);
        let mut parameters = read.documents.iter().flat_map(|d| &d.parameters);
        let year = parameters.find(|p| p.name == "year");
        TileParts {
            parts: options.catalogs.iter().chain(&read.included).collect(),
            written: own.cloned().collect(),
            year: year.and_then(|p| Some(p.value.as_ref()?.to_string())),
        }
    }

    /// Returns the job of making the tiles, by as many threads as there are.
    pub fn job(
        &'a self,
        input: TownInput<'a>,
        plan: &'a Plan,
        catalog: &'a Catalog,
        division: &'a Tiles,
    ) -> TileJob<'a> {
        TileJob {
            input,
            plan,
            catalog,
            parts: &self.parts,
            written: &self.written,
            year: self.year.as_deref(),
            division,
            reach: Reach::All,
            threads: rayon::current_num_threads(),
            packed: false,
            spool: None,
        }
    }
}

/// A town in tiles.
#[derive(Debug)]
pub struct TiledTown {
    /// What became of its features.
    pub ledger: Ledger,
    /// Its tiles with houses, in the order of their keys.
    pub tiles: Vec<TileRecord>,
    /// The number of those that were there already.
    pub kept: usize,
    /// Types and files that were read.
    pub included: Vec<Source>,
    /// How far its height 0 is above the ellipsoid, metres; `None` if it stands nowhere on the globe.
    pub zero: Option<f64>,
}

/// The result of a thread for one tile, or for one cell of the ground.
#[derive(Default)]
struct Done {
    /// The decisions on its features; their houses are written already.
    chunk: Option<Chunk>,
    record: Option<TileRecord>,
    found: Diagnostics,
    kept: bool,
}

/// Makes the tiles that are missing, and writes the tileset last. `progress` is called with the number of features and of
/// houses of a tile when it is done.
///
/// # Errors
/// Those of the store.
pub fn run(
    job: TileJob<'_>,
    store: &dyn TileStore,
    progress: &(dyn Fn(usize) + Sync),
    out: &mut Diagnostics,
) -> io::Result<TiledTown> {
    let tiles = tiles(job.plan, job.division);
    let levels: Vec<Detail> = levels(job.division);
    let tiles = job.reach.of(tiles);
    let mut pieces = terrain::cells(job.plan, job.division)?;
    if job.reach != Reach::All {
        let near = |cell: &Cell| tiles.iter().any(|t| t.key == TileKey::Cell(cell.0, cell.1));
        pieces.retain(near);
    }
    let maker = Maker {
        job,
        store,
        driver: TileDriver::new(
            job.input.source,
            job.catalog,
            (job.input.world, job.input.options),
            &levels,
        ),
        salt: TileSalt::new(job.input, (&levels, job.packed), (job.parts, job.written)),
        levels,
    };
    let mut town = TiledTown {
        ledger: Ledger::new(job.spool)?,
        tiles: vec![],
        kept: 0,
        included: vec![],
        zero: None,
    };
    maker.all((&tiles, &pieces), progress, &mut |done| {
        if let Some(chunk) = done.chunk {
            town.ledger.add(chunk)?;
        }
        town.kept += usize::from(done.kept);
        if let Some(record) = done.record {
            let corrected = record.corrected.iter().cloned();
            town.ledger.report.corrected.extend(corrected);
            town.tiles.push(record);
        }
        out.append(done.found);
        Ok(())
    })?;
    let (ledger, included) = town.ledger.finish(job.plan, out)?;
    Ok(TiledTown {
        ledger,
        included,
        zero: zero(job.plan),
        ..town
    })
}

impl TiledTown {
    /// Returns its tree.
    pub fn tileset(&self, plan: &Plan) -> TreeFiles {
        let frame = &plan.frame;
        let transform = |zero| on_globe(&frame.crs, frame.origin, zero);
        self.tree(self.zero.and_then(transform))
    }

    /// Returns the tree of tiles that stand nowhere on the globe, for a viewer in the frame of the town.
    pub fn local_tileset(&self) -> TreeFiles {
        self.tree(None)
    }

    fn tree(&self, transform: Option<[f64; 16]>) -> TreeFiles {
        let places: Vec<_> = self.tiles.iter().map(TileRecord::place).collect();
        tileset::tileset(&places, transform)
    }

    /// Returns the names of all files in the folders of tiles and textures.
    pub fn files(&self) -> BTreeSet<String> {
        let own = |tile: &TileRecord| {
            let files: Vec<String> = tile.files().map(str::to_owned).collect();
            files.into_iter().chain([tile.file()])
        };
        self.tiles.iter().flat_map(own).collect()
    }
}

/// Returns how far the height 0 of a town is above the ellipsoid, metres; `None` for one in local metres.
fn zero(plan: &Plan) -> Option<f64> {
    let frame = &plan.frame;
    let sea = sea_level(&frame.crs, frame.origin)?;
    Some(if plan.town.geoid { sea } else { 0.0 })
}

/// Returns the levels of detail, from far to near.
fn levels(division: &Tiles) -> Vec<Detail> {
    let numbers: BTreeSet<u8> = division.detail.iter().copied().collect();
    let level = |number: u8| Detail::ALL[usize::from(number).min(3)];
    numbers.into_iter().map(level).collect()
}

/// Results of tiles: threads finish in any order, and the results are passed on in the order of the tiles.
struct Ordered<'t> {
    waiting: BTreeMap<usize, Done>,
    next: usize,
    take: &'t mut (dyn FnMut(Done) -> io::Result<()> + Send),
}

impl Ordered<'_> {
    fn add(&mut self, number: usize, done: Done) -> io::Result<()> {
        self.waiting.insert(number, done);
        while let Some(done) = self.waiting.remove(&self.next) {
            self.next += 1;
            (self.take)(done)?;
        }
        Ok(())
    }
}

struct Maker<'a> {
    job: TileJob<'a>,
    store: &'a dyn TileStore,
    driver: TileDriver<'a>,
    salt: TileSalt,
    levels: Vec<Detail>,
}

impl Maker<'_> {
    /// Makes all tiles and hands over what was made, in their order. The first error stops all threads.
    fn all(
        &self,
        (tiles, pieces): (&[Tile], &[Cell]),
        progress: &(dyn Fn(usize) + Sync),
        take: &mut (dyn FnMut(Done) -> io::Result<()> + Send),
    ) -> io::Result<()> {
        let next = AtomicUsize::new(0);
        let count = tiles.len() + pieces.len();
        let made = Mutex::new(Ordered {
            waiting: BTreeMap::new(),
            next: 0,
            take,
        });
        let one = |number: usize| match tiles.get(number) {
            Some(tile) => (self.one(tile, number == 0), tile.features()),
            None => (self.piece(pieces[number - tiles.len()]), 0),
        };
        let failed: Mutex<Option<io::Error>> = Mutex::new(None);
        let work = || {
            // A tile is the work of one thread: no more tiles are in memory than there are threads.
            let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= count {
                    return;
                }
                let (done, features) = match &alone {
                    Ok(pool) => pool.install(|| one(number)),
                    Err(_) => one(number),
                };
                if let Err(error) = done.and_then(|done| locked(&made).add(number, done)) {
                    next.store(count, Ordering::Relaxed);
                    locked(&failed).get_or_insert(error);
                    return;
                }
                progress(features);
            }
        };
        thread::scope(|scope| {
            for _ in 0..self.job.threads.clamp(1, count.max(1)) {
                scope.spawn(work);
            }
        });
        match failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Makes a tile, unless it is there. Only the first tells which files were read.
    fn one(&self, tile: &Tile, first: bool) -> io::Result<Done> {
        let of = (self.job.plan, self.job.input);
        let mut input = evaluate(tile, of, self.job.year, &self.salt)?;
        if !first {
            input.chunk.included.clear();
        }
        let mut done = Done {
            chunk: Some(Chunk {
                houses: vec![],
                records: std::mem::take(&mut input.chunk.records),
                found: std::mem::take(&mut input.chunk.found),
                missing: std::mem::take(&mut input.chunk.missing),
                included: std::mem::take(&mut input.chunk.included),
                values: std::mem::take(&mut input.chunk.values),
            }),
            record: None,
            found: Diagnostics::new(),
            kept: false,
        };
        if input.houses.is_empty() {
            return Ok(done);
        }
        if let Some(known) = self.known(&tile.key.stem(), &input.hash) {
            done.kept = true;
            done.record = Some(known);
            return Ok(done);
        }
        let made = make(
            &self.driver,
            tile,
            input,
            (&self.levels, self.job.packed),
            self.job.input.world,
        )?;
        self.keep(&made)?;
        done.found = made.found;
        done.record = Some(made.record);
        Ok(done)
    }

    /// Makes a piece of ground, unless it is there.
    fn piece(&self, cell: Cell) -> io::Result<Done> {
        let size = self.job.division.size;
        let Some(patch) = Patch::new(&self.job.plan.ground, cell, size) else {
            return Ok(Done::default());
        };
        let row = piece::row((self.job.plan, self.job.input.source), cell);
        let hash = self.salt.piece(&patch, &row);
        if let Some(known) = self.known(&patch.name(), &hash) {
            return Ok(Done {
                record: Some(known),
                kept: true,
                ..Done::default()
            });
        }
        let made = piece::make(&patch, row, &hash, (&self.levels, self.job.packed));
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
        self.store.commit(&made.record.file(), &json)
    }

    /// Returns the record of a tile whose files are all there.
    fn known(&self, tile: &str, hash: &str) -> Option<TileRecord> {
        let bytes = self.store.read(&record_file(tile, hash))?;
        let record: TileRecord = serde_json::from_slice(&bytes).ok()?;
        let world = self.job.input.world;
        let same = |(path, hash): &(String, String)| picture_hash(path, world) == *hash;
        let there = record.files().all(|name| self.store.has(name));
        (there && record.pictures.iter().all(same)).then_some(record)
    }
}

fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
