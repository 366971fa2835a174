//! Towns in the preview: their tiles are built into a temporary folder, behind the page, and again at every save. Tiles whose
//! houses are the same are kept. The first pass makes the farthest level only, and of a large town the middle before the rest,
//! so that there is something to see soon; the last makes the nearer levels.
//!
//! | file | purpose |
//! |---|---|
//! | `difference` | what differs between two editions of a town |
//! | `scratch` | the temporary folder of a town |
//! | `faces` | what binds the face of an envelope |
//! | `tables` | what the tables of decisions and the report of a town in tiles tell of a feature |

mod difference;
mod faces;
mod scratch;
mod tables;

pub(super) use difference::Difference;
pub(super) use faces::BoundFace;
pub(super) use tables::{SkippedList, TownTables};

use super::fingerprint::fingerprint;
use super::locked::lock;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{FileId, Limits, Source, World};
use hsd_driver::Options;
use hsd_ir::ast::town::Tiles;
use hsd_syntax::parse::outline;
use hsd_town::layer::TownFrame;
use hsd_town::tiles::run::{self, Reach, TileJob, TileParts, TiledTown};
use hsd_town::{KeptMaps, Plan, TownInput};
use scratch::Scratch;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fs;
use std::hash::Hash;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant, SystemTime};

/// The number of features up to which the preview makes all levels of detail; larger towns have the two farthest, since
/// full detail takes about a megabyte a house.
const FULL: usize = 400;

/// The number of features in the middle of a town that are shown before the rest.
const MIDDLE: usize = 300;

/// How often the page hears of progress.
const OFTEN: Duration = Duration::from_millis(120);

/// The name of the root of tiles.
pub(super) const TILESET: &str = "tileset.json";

/// A town in tiles, as it can be shown: `Town` in `view/src/server/api.ts`.
#[derive(Clone, Debug, Hash, Serialize)]
pub(super) struct ShownTown {
    /// The number under which its files are served.
    pub(super) id: u64,
    /// The root of its tiles; `None` before there are any.
    pub(super) tileset: Option<String>,
    /// The number of features of its maps.
    pub(super) features: usize,
    /// Those on which something stands.
    pub(super) built: usize,
    /// The number of those that are skipped.
    pub(super) skipped: usize,
    /// True if all levels that the preview makes are there.
    pub(super) whole: bool,
}

impl ShownTown {
    /// Returns a town of which nothing is built yet.
    pub(super) fn none(id: u64) -> ShownTown {
        ShownTown {
            id,
            tileset: None,
            features: 0,
            built: 0,
            skipped: 0,
            whole: false,
        }
    }
}

/// What was built of a town, and from what.
pub(super) struct BuiltTown {
    pub(super) shown: ShownTown,
    /// Where its files are.
    pub(super) tables: TownTables,
    /// The frame of its coordinates, where it is known.
    pub(super) frame: Option<TownFrame>,
    /// The fingerprint of the text.
    text: u64,
    found: Vec<Diagnostic>,
    included: Vec<Source>,
}

impl BuiltTown {
    /// Returns what was found, and the files in which it was, if it was built from this text.
    pub(super) fn found(&self, source: &Source) -> Option<(Vec<Source>, Vec<Diagnostic>)> {
        let same = self.text == text_of(source);
        same.then(|| (self.included.clone(), self.found.clone()))
    }

    /// Returns true if its files were built here, under names that tell what is in them.
    pub(super) fn is_ours(&self) -> bool {
        self.shown.tileset.as_deref() != Some(TILESET)
    }

    /// Returns the names of its root and of its table of decisions; `None` before there are any.
    fn files(&self) -> Option<[String; 2]> {
        let table = self.tables.decisions.file_name()?.to_str()?;
        Some([self.shown.tileset.clone()?, table.to_owned()])
    }

    /// Returns when the root of its tiles was written.
    pub(super) fn changed(&self) -> Option<SystemTime> {
        let root = self.tables.folder.join(self.shown.tileset.as_ref()?);
        fs::metadata(root).ok()?.modified().ok()
    }

    /// Returns a folder of tiles that exists already.
    pub(super) fn of_folder(id: u64, folder: &Path) -> BuiltTown {
        let tables = TownTables::of(folder.to_owned(), "decisions.csv", "report.json");
        let (features, built, skipped) = tables.counts();
        BuiltTown {
            shown: ShownTown {
                id,
                tileset: Some(TILESET.to_owned()),
                features,
                built,
                skipped,
                whole: true,
            },
            tables,
            frame: None,
            text: 0,
            found: vec![],
            included: vec![],
        }
    }
}

fn text_of(source: &Source) -> u64 {
    fingerprint(|p| source.text().hash(p))
}

/// How far a town is: `TownProgress` in `view/src/server/api.ts`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct TownProgress {
    /// `maps` while they are read, then `far` and `near`, at last `done`.
    pub(super) phase: &'static str,
    /// Features that are made.
    pub(super) done: usize,
    /// All features.
    pub(super) of: usize,
}

impl TownProgress {
    /// Files cannot be written, or read.
    pub(super) const FAILED: TownProgress = TownProgress::begun("failed");

    const fn begun(phase: &'static str) -> TownProgress {
        TownProgress {
            phase,
            done: 0,
            of: 0,
        }
    }
}

/// The town of a document: what was built of it, and the folder where its tiles are.
#[derive(Default)]
pub(super) struct TownSlot {
    pub(super) built: Mutex<Option<Arc<BuiltTown>>>,
    /// The edition that others are compared with.
    pub(super) kept: Mutex<Option<Arc<BuiltTown>>>,
    /// Stops the build that is under way.
    stops: Mutex<Arc<AtomicBool>>,
    /// Held while building.
    scratch: Mutex<Option<Scratch>>,
    /// How far the build is; `None` if there is none.
    pub(super) progress: Mutex<Option<TownProgress>>,
    maps: KeptMaps,
}

/// What a build tells while it goes on.
pub(super) trait TownEars: Sync {
    /// Hears how far it is.
    fn progress(&self, progress: TownProgress);
    /// Hears that there is something new to show.
    fn built(&self);
}

impl TownSlot {
    /// Stops the build that is under way and returns the flag that stops the next one.
    pub(super) fn restart(&self) -> Arc<AtomicBool> {
        let next = Arc::new(AtomicBool::new(false));
        let before = std::mem::replace(&mut *lock(&self.stops), next.clone());
        before.store(true, Ordering::Relaxed);
        next
    }

    /// Keeps what is built now, to compare what is built later with it, or forgets what was kept.
    pub(super) fn keep(&self, keep: bool) {
        let mut scratch = lock(&self.scratch);
        let built = lock(&self.built).clone().filter(|_| keep);
        if let Some(scratch) = &mut *scratch {
            match built.as_ref().and_then(|built| built.files()) {
                Some([tileset, decisions]) => scratch.keep(&[&tileset, &decisions]),
                None => scratch.forget(),
            }
        }
        *lock(&self.kept) = built;
    }

    /// Returns what differs between what was kept and what is built now; `None` if nothing was kept.
    ///
    /// # Errors
    /// If a table cannot be read.
    pub(super) fn difference(&self) -> io::Result<Option<Difference>> {
        let (kept, built) = (lock(&self.kept).clone(), lock(&self.built).clone());
        match (kept, built) {
            (Some(kept), Some(built)) => Difference::between(&kept.tables, &built.tables).map(Some),
            _ => Ok(None),
        }
    }

    /// Builds a town in two passes; `folder` returns a new folder for its tiles. Nothing is built from a text with errors,
    /// and what was built before stays.
    ///
    /// # Errors
    /// If files cannot be written.
    pub(super) fn build(
        &self,
        (id, stops): (u64, &AtomicBool),
        (source, world, options): (Source, &dyn World, &Options),
        folder: &dyn Fn() -> io::Result<PathBuf>,
        ears: &dyn TownEars,
    ) -> io::Result<()> {
        let mut scratch = lock(&self.scratch);
        if stops.load(Ordering::Relaxed) {
            return Ok(());
        }
        let scratch = match &mut *scratch {
            Some(scratch) => scratch,
            none => none.insert(Scratch::new(folder()?)?),
        };
        let pass = Build {
            slot: self,
            id,
            stops,
            file: source.id(),
            text: text_of(&source),
            ears,
        };
        pass.tell(TownProgress::begun("maps"));
        let made = pass.make((&source, world, options), scratch);
        *lock(&self.progress) = None;
        if !stops.load(Ordering::Relaxed) {
            ears.progress(TownProgress::begun("done"));
        }
        made
    }
}

/// A build that is under way.
struct Build<'b> {
    slot: &'b TownSlot,
    id: u64,
    stops: &'b AtomicBool,
    /// The number of the town file.
    file: FileId,
    text: u64,
    ears: &'b dyn TownEars,
}

impl Build<'_> {
    fn tell(&self, progress: TownProgress) {
        *lock(&self.slot.progress) = Some(progress);
        self.ears.progress(progress);
    }

    fn make(
        &self,
        (source, world, options): (&Source, &dyn World, &Options),
        scratch: &mut Scratch,
    ) -> io::Result<()> {
        let mut known = Diagnostics::new();
        let mut read = hsd_driver::documents(&[source], world, options, &mut known);
        let town = read.documents.iter_mut().find_map(|d| d.town.take());
        let Some(town) = town.filter(|_| !known.has_errors()) else {
            return Ok(());
        };
        let input = TownInput {
            source,
            world,
            options,
            kept: Some(&self.slot.maps),
            texts: false,
        };
        let mut out = Diagnostics::new();
        let Some(plan) = hsd_town::run::plan(input, &town, &mut out) else {
            self.failed(out, read.included);
            return Ok(());
        };
        let parts = TileParts::of(&read, options);
        let all = levels(&plan, options);
        let first: Vec<u8> = all.first().copied().into_iter().collect();
        // What is whole on the page already is not replaced by less.
        let was_whole = |built: &Arc<BuiltTown>| built.shown.whole && built.shown.tileset.is_some();
        let is_first = !lock(&self.slot.built).as_ref().is_some_and(was_whole);
        let large = plan.features() >= 2 * MIDDLE;
        let middle = (is_first && large).then(|| ("far", first.clone(), Reach::Middle(MIDDLE)));
        let far = (is_first && all.len() > 1).then_some(("far", first, Reach::All));
        let last = [("near", all, Reach::All)];
        for (phase, detail, reach) in middle.into_iter().chain(far).chain(last) {
            let division = Tiles {
                detail,
                ..plan.town.tiles.clone()
            };
            let job = TileJob {
                reach,
                ..parts.job(input, &plan, &read.catalog, &division)
            };
            let mut found = out.clone();
            let progress = Throttled::new(self, phase, plan.features());
            let store = scratch.store(self.stops);
            let made = run::run(job, &store, &|features| progress.add(features), &mut found);
            if self.stops.load(Ordering::Relaxed) {
                return Ok(());
            }
            let mut made = made?;
            if reach != Reach::All {
                // What concerns all features can only be told of all.
                found = out.clone();
                made.ledger.report.features = plan.features() + made.ledger.report.unused;
            }
            let told = (found, read.included.clone());
            self.publish((made, &plan.frame), told, phase == "near", scratch)?;
        }
        Ok(())
    }

    /// Keeps what was built before, with what is wrong now.
    fn failed(&self, out: Diagnostics, included: Vec<Source>) {
        let before = lock(&self.slot.built).clone();
        let none = ShownTown::none(self.id);
        let tables = TownTables::of(PathBuf::new(), "", "");
        let (shown, tables, frame) = match &before {
            Some(before) => (
                before.shown.clone(),
                before.tables.clone(),
                before.frame.clone(),
            ),
            None => (none, tables, None),
        };
        self.show(BuiltTown {
            shown,
            tables,
            frame,
            text: self.text,
            found: out.into_sorted(),
            included,
        });
    }

    fn publish(
        &self,
        (made, frame): (TiledTown, &TownFrame),
        (mut found, mut included): (Diagnostics, Vec<Source>),
        whole: bool,
        scratch: &mut Scratch,
    ) -> io::Result<()> {
        let [tileset, decisions, report] = scratch.publish(&made)?;
        hsd_town::adopt(made.included, self.file, &mut included, &mut found);
        let ledger = made.ledger.report;
        self.show(BuiltTown {
            shown: ShownTown {
                id: self.id,
                tileset: Some(tileset),
                features: ledger.features - ledger.unused,
                built: ledger.built,
                skipped: ledger.skipped.len(),
                whole,
            },
            tables: TownTables::of(scratch.folder().to_owned(), &decisions, &report),
            frame: Some(frame.clone()),
            text: self.text,
            found: found.into_sorted(),
            included,
        });
        Ok(())
    }

    fn show(&self, built: BuiltTown) {
        *lock(&self.slot.built) = Some(Arc::new(built));
        self.ears.built();
    }
}

/// Returns the folders of the maps and tables that a town file names, to be watched.
pub fn map_folders(path: &Path) -> BTreeSet<PathBuf> {
    let limits = Limits::default();
    let small = fs::metadata(path).is_ok_and(|about| about.len() <= limits.bytes as u64);
    let Some(bytes) = small.then(|| fs::read(path).ok()).flatten() else {
        return BTreeSet::new();
    };
    let source = Source::new(FileId(0), path.to_string_lossy(), &bytes);
    let outline = outline::of(&source, &limits);
    let named = outline.elements.iter().filter_map(|element| {
        let kind = element.schema?.name;
        element
            .value("src")
            .filter(|_| kind == "Layer" || kind == "Table")
    });
    let folder = path.parent().unwrap_or(Path::new(""));
    let folders = named.filter_map(|src| Some(folder.join(src).parent()?.to_owned()));
    folders.collect()
}

/// Returns the levels of detail that the preview makes, from far to near.
fn levels(plan: &Plan, options: &Options) -> Vec<u8> {
    let most = match plan.features() {
        0..=FULL => 3,
        _ => 1,
    };
    let most = most.min(options.detail as u8);
    let mut levels = plan.town.tiles.detail.clone();
    levels.sort_unstable();
    levels.dedup();
    let nearest = levels.first().copied().unwrap_or(0).max(most);
    levels.retain(|level| *level <= nearest);
    levels
}

/// Tells of progress, but not of every tile.
struct Throttled<'b> {
    build: &'b Build<'b>,
    phase: &'static str,
    done: AtomicUsize,
    of: usize,
    last: Mutex<Instant>,
}

impl<'b> Throttled<'b> {
    fn new(build: &'b Build<'b>, phase: &'static str, of: usize) -> Throttled<'b> {
        let begun = TownProgress::begun(phase);
        build.tell(TownProgress { of, ..begun });
        Throttled {
            build,
            phase,
            done: AtomicUsize::new(0),
            of,
            last: Mutex::new(Instant::now()),
        }
    }

    fn add(&self, features: usize) {
        let done = self.done.fetch_add(features, Ordering::Relaxed) + features;
        let mut last = lock(&self.last);
        if last.elapsed() >= OFTEN && !self.build.stops.load(Ordering::Relaxed) {
            *last = Instant::now();
            let (phase, of) = (self.phase, self.of);
            self.build.tell(TownProgress { phase, done, of });
        }
    }
}
