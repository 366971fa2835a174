//! All tiles of a town: those that are there are kept, the others are made, each by one thread from beginning to end.

use super::TileStore;
use super::maker::{Done, Maker, TileMeans};
pub use super::mesh::Reach;
use super::mesh::{Tile, TileKey, tiles};
use super::record::TileRecord;
use super::terrain::{self, Cell};
use crate::stream::Ledger;
use crate::{Plan, TownInput};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Source;
use hsd_driver::{Options, Read};
use hsd_export::spool::NewSpool;
use hsd_export::tileset::{self, TreeFiles};
use hsd_ir::ast::WrittenPart;
use hsd_ir::ast::town::Tiles;
use hsd_ir::catalog::Catalog;
use hsd_map::{on_globe, sea_level};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, SyncSender};
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

    /// Returns what tiles are made with.
    pub fn means(
        &'a self,
        input: TownInput<'a>,
        catalog: &'a Catalog,
        division: &'a Tiles,
    ) -> TileMeans<'a> {
        TileMeans {
            input,
            catalog,
            parts: &self.parts,
            written: &self.written,
            year: self.year.as_deref(),
            division,
            packed: false,
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

impl<'a> TileJob<'a> {
    /// Returns what its tiles are made with.
    pub fn means(&self) -> TileMeans<'a> {
        TileMeans {
            input: self.input,
            catalog: self.catalog,
            parts: self.parts,
            written: self.written,
            year: self.year,
            division: self.division,
            packed: self.packed,
        }
    }
}

/// A town in tiles.
#[derive(Debug)]
pub struct TiledTown {
    /// How many of its features were built, skipped or corrected.
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
    let tiles = job.reach.of(tiles);
    let mut pieces = terrain::cells(job.plan, job.division)?;
    if job.reach != Reach::All {
        let near = |cell: &Cell| tiles.iter().any(|t| t.key == TileKey::Cell(cell.0, cell.1));
        pieces.retain(near);
    }
    let maker = Maker::new(job.means(), store);
    let mut town = TiledTown::new(job.spool)?;
    let queue = Queue {
        job: &job,
        maker: &maker,
        tiles: &tiles,
        pieces: &pieces,
    };
    queue.all(progress, &mut |done| town.take(done, out))?;
    let (ledger, included) = town.ledger.finish(job.plan, out)?;
    Ok(TiledTown {
        ledger,
        included,
        zero: zero(job.plan),
        ..town
    })
}

impl TiledTown {
    /// Begins a town without tiles, whose table of decisions waits in a spool if there is one.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn new(spool: Option<NewSpool<'_>>) -> io::Result<TiledTown> {
        Ok(TiledTown {
            ledger: Ledger::new(spool)?,
            tiles: vec![],
            kept: 0,
            included: vec![],
            zero: None,
        })
    }

    /// Adds a tile or a piece of ground; they come in their order.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn take(&mut self, done: Done, out: &mut Diagnostics) -> io::Result<()> {
        if let Some(account) = done.account {
            self.ledger.enter(account)?;
        }
        self.ledger.values.append(done.values);
        self.ledger.read(done.included);
        self.kept += usize::from(done.kept);
        if let Some(record) = done.record {
            let corrected = record.corrected.iter().cloned();
            self.ledger.report.corrected.extend(corrected);
            self.tiles.push(record);
        }
        out.append(done.found);
        Ok(())
    }

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
pub(super) fn zero(plan: &Plan) -> Option<f64> {
    let frame = &plan.frame;
    let sea = sea_level(&frame.crs, frame.origin)?;
    Some(if plan.town.geoid { sea } else { 0.0 })
}

/// Results of tiles: threads finish in any order, and the results are passed on in the order of the tiles.
struct Ordered<'t> {
    waiting: BTreeMap<usize, Done>,
    next: usize,
    take: &'t mut dyn FnMut(Done) -> io::Result<()>,
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

/// A tile or a piece of ground that has been made, and the number of its features.
type Unkept = (io::Result<Done>, usize);

/// The tiles and pieces of ground that threads make.
struct Queue<'q> {
    job: &'q TileJob<'q>,
    maker: &'q Maker<'q>,
    tiles: &'q [Tile],
    pieces: &'q [Cell],
}

impl Queue<'_> {
    /// Makes all tiles and hands over what was made, in their order. The first error stops all threads.
    fn all(
        &self,
        progress: &(dyn Fn(usize) + Sync),
        take: &mut dyn FnMut(Done) -> io::Result<()>,
    ) -> io::Result<()> {
        let next = AtomicUsize::new(0);
        let count = self.tiles.len() + self.pieces.len();
        let mut made = Ordered {
            waiting: BTreeMap::new(),
            next: 0,
            take,
        };
        let (send, receive) = mpsc::sync_channel(1);
        thread::scope(|scope| {
            for _ in 0..self.job.threads.clamp(1, count.max(1)) {
                let (next, send) = (&next, send.clone());
                scope.spawn(move || self.work(next, send));
            }
            drop(send);
            // No thread that makes tiles waits for a disk. Without a receiver all of them end.
            for (number, (done, features)) in receive {
                let kept = done.and_then(|done| self.maker.kept(done))?;
                made.add(number, kept)?;
                progress(features);
            }
            Ok(())
        })
    }

    /// Makes one after another, and passes each on with its number.
    fn work(&self, next: &AtomicUsize, send: SyncSender<(usize, Unkept)>) {
        // A tile is the work of one thread: hardly more tiles are in memory than there are threads.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let count = self.tiles.len() + self.pieces.len();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                return;
            }
            let made = match &alone {
                Ok(pool) => pool.install(|| self.one(number)),
                Err(_) => self.one(number),
            };
            if send.send((number, made)).is_err() {
                return;
            }
        }
    }

    /// Makes one of them; returns the number of its features too. Only the first tile tells which files were read.
    fn one(&self, number: usize) -> Unkept {
        let plan = self.job.plan;
        let Some(tile) = self.tiles.get(number) else {
            let cell = self.pieces[number - self.tiles.len()];
            return (self.maker.piece(plan, cell), 0);
        };
        let mut done = self.maker.unkept_or_why_not(plan, tile);
        if let (Ok(done), true) = (&mut done, number > 0) {
            done.included.clear();
        }
        (done, tile.features())
    }
}
