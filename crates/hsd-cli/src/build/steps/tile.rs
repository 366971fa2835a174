//! `hsd town tile`: makes tiles of planned work.

use super::open::opened;
use crate::files::output::Committer;
use crate::{Exit, Failure, Outcome};
use clap::Args;
use hsd_base::diagnostic::{Language, Text};
use hsd_base::text;
use hsd_town::tiles::work::{Finished, Manifest, PlannedTile, Trouble, Worker};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Make tiles of a town that `hsd town plan` has planned.
///
/// Any number of processes may make tiles at a time, and a tile more than once: it is put into WORK whole or not at all, and the
/// first one stays. Prints a line a tile: key and `made`, `kept` (nothing of it has changed) or `there`, with a tab
/// between. Houses with errors have their plain bodies, as in `hsd town`, and are reported by `hsd town seal`.
#[derive(Debug, Args)]
#[command(after_help = "\
Exit status: 0 all these tiles are there; 1 a tile cannot be made (it is damaged, or makes hsd fail: to try again is no use), the
others are there; 2 there is no such tile, or the town has changed since; 3 a file could not be read or written (try again).

Examples:
  hsd town tile work/ 0_0 0_1
  hsd town tile work/ --all --threads 2")]
pub(crate) struct TownTile {
    /// The folder of the planned work.
    #[arg(value_name = "WORK")]
    work: PathBuf,

    /// The tiles to make, as `hsd town plan` prints them. Options stand before them, since keys may begin with `-`.
    #[arg(
        value_name = "KEY",
        required_unless_present = "all",
        allow_hyphen_values = true
    )]
    keys: Vec<String>,

    /// Make all tiles that are missing.
    #[arg(long, conflicts_with = "keys")]
    all: bool,

    /// Use N threads, each for a tile at a time; one per processor by default.
    #[arg(long, value_name = "N")]
    threads: Option<std::num::NonZeroUsize>,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

/// The tiles that threads make.
struct Queue<'q> {
    worker: &'q Worker<'q>,
    tiles: Vec<&'q PlannedTile>,
    next: AtomicUsize,
    /// True once a tile could not be made.
    poisoned: Mutex<bool>,
    failed: Mutex<Option<io::Error>>,
    quiet: bool,
    language: Language,
}

impl TownTile {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let committer = Committer::default();
        opened((&self.work, &committer), language, |worker, manifest, _| {
            let threads = match self.threads {
                Some(threads) => threads.get(),
                None => rayon::current_num_threads(),
            };
            let queue = Queue {
                worker,
                tiles: self.tiles(manifest)?,
                next: AtomicUsize::new(0),
                poisoned: Mutex::new(false),
                failed: Mutex::new(None),
                quiet: self.quiet,
                language,
            };
            thread::scope(|scope| {
                for _ in 0..threads.clamp(1, queue.tiles.len().max(1)) {
                    scope.spawn(|| queue.work());
                }
            });
            let taken = |error| Failure::at(self.work.display(), error);
            let failed = queue.failed.into_inner();
            if let Some(error) = failed.unwrap_or_else(PoisonError::into_inner) {
                return Err(taken(error));
            }
            let poisoned = queue.poisoned.into_inner();
            Ok(match poisoned.unwrap_or_else(PoisonError::into_inner) {
                true => Exit::Errors,
                false => Exit::Done,
            })
        })
    }

    /// Returns the tiles that are meant.
    fn tiles<'m>(&self, manifest: &'m Manifest) -> Result<Vec<&'m PlannedTile>, Failure> {
        if self.all {
            return Ok(manifest.tiles.iter().collect());
        }
        let find = |key: &String| {
            let mut all = manifest.tiles.iter();
            all.find(|tile| tile.key == *key).ok_or_else(|| {
                let name = self.work.display();
                Failure::Usage(text!([name, key]
                    "{name} has no tile `{key}`: `hsd town plan` prints those it has",
                    "{name} にタイル `{key}` はありません。あるタイルは `hsd town plan` が表示します"
                ))
            })
        };
        self.keys.iter().map(find).collect()
    }
}

impl Queue<'_> {
    fn work(&self) {
        // A tile is the work of one thread: no more tiles are in memory than there are threads.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        loop {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(tile) = self.tiles.get(number) else {
                return;
            };
            let made = match &alone {
                Ok(pool) => pool.install(|| self.worker.make(tile)),
                Err(_) => self.worker.make(tile),
            };
            let failed = match made {
                Ok(finished) => self.tell(tile, &finished).err(),
                Err(Trouble::Io(error)) => Some(error),
                Err(trouble) => {
                    *self.poisoned.lock().unwrap_or_else(PoisonError::into_inner) = true;
                    let line = why(&tile.key, &trouble);
                    let line = line.in_language(self.language);
                    writeln!(io::stderr(), "hsd: {line}").err()
                }
            };
            if let Some(error) = failed {
                self.next.store(self.tiles.len(), Ordering::Relaxed);
                let mut failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner);
                failed.get_or_insert(error);
                return;
            }
        }
    }

    fn tell(&self, tile: &PlannedTile, finished: &Finished) -> io::Result<()> {
        let word = match finished {
            Finished::There => "there",
            Finished::Kept => "kept",
            Finished::Made => "made",
        };
        match self.quiet {
            true => Ok(()),
            false => writeln!(io::stdout(), "{}\t{word}", tile.key),
        }
    }
}

/// Says why a tile was not made.
fn why(key: &str, trouble: &Trouble) -> Text {
    match trouble {
        Trouble::Damaged | Trouble::Io(_) => text!([key]
            "tile {key}: its part is missing or damaged; plan the town again",
            "タイル {key}: 入力がないか、壊れています。計画し直してください"
        ),
        Trouble::Poison => text!([key]
            "tile {key}: it makes hsd fail and is left out; `hsd town seal --lacking` reports its features",
            "タイル {key}: hsd が失敗するため省きます。`hsd town seal --lacking` が地物を報告します"
        ),
    }
}
