//! Towns are checked with their maps on a thread of their own: reading maps and evaluating rules at all features takes
//! milliseconds for a block and seconds for a city, and no keystroke waits for it. One town is checked at a time; a text
//! that changes meanwhile stops the check of what it was.

use super::settings::Settings;
use super::world::{Open, Overlay};
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::Source;
use hsd_driver::Options;
use hsd_town::{CheckDepth, KeptMaps, TownFacts, TownInput};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::thread;

/// The stack of the thread, as much as that of the main thread.
const STACK: usize = 8 << 20;

/// A town to be checked.
pub(super) struct TownJob {
    pub(super) uri: String,
    /// The number of the analysis.
    pub(super) reading: u64,
    pub(super) folder: Option<PathBuf>,
    pub(super) source: Source,
    /// The files that were read for it before.
    pub(super) included: Vec<Source>,
    pub(super) open: Open,
    pub(super) settings: Settings,
    pub(super) maps: KeptMaps,
}

/// A town that has been checked.
pub(super) struct TownDone {
    pub(super) uri: String,
    pub(super) reading: u64,
    pub(super) facts: TownFacts,
    /// The files that were read for it.
    pub(super) included: Vec<Source>,
    pub(super) found: Vec<Diagnostic>,
    /// The files that were requested, whether they exist or not.
    pub(super) asked: BTreeSet<PathBuf>,
}

/// The towns that are being checked, or wait for it.
#[derive(Default)]
pub(super) struct Towns {
    running: Option<Running>,
    /// The newest text of each that waits.
    waiting: BTreeMap<String, TownJob>,
    /// The order in which they came.
    order: VecDeque<String>,
}

struct Running {
    uri: String,
    stops: Arc<AtomicBool>,
    /// `None` from it if the check was stopped.
    done: Receiver<Option<TownDone>>,
}

impl Towns {
    /// Returns true if a town is being checked.
    pub(super) fn is_busy(&self) -> bool {
        self.running.is_some()
    }

    /// Checks a town as soon as no other one is; an older text of it no longer matters.
    pub(super) fn start(&mut self, job: TownJob) {
        if let Some(running) = self.running.as_ref().filter(|r| r.uri == job.uri) {
            running.stops.store(true, Ordering::Relaxed);
        }
        let uri = job.uri.clone();
        if self.waiting.insert(uri.clone(), job).is_none() {
            self.order.push_back(uri);
        }
        self.next();
    }

    /// Returns the next result: the URI and what was found, `None` if the check has failed by a fault of the program.
    pub(super) fn take(&mut self) -> Option<(String, Option<TownDone>)> {
        let running = self.running.as_ref()?;
        let done = match running.done.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Some((running.uri.clone(), None)),
            Ok(done) => done.map(|done| (running.uri.clone(), Some(done))),
        };
        self.running = None;
        self.next();
        done.or_else(|| self.take())
    }

    fn next(&mut self) {
        if self.running.is_some() {
            return;
        }
        let job = self.order.pop_front().map(|uri| self.waiting.remove(&uri));
        let Some(job) = job.flatten() else {
            return;
        };
        let (sender, done) = mpsc::channel();
        let stops = Arc::new(AtomicBool::new(false));
        let (uri, told) = (job.uri.clone(), stops.clone());
        let thread = thread::Builder::new().stack_size(STACK);
        // A thread that cannot be had is one that has failed.
        let _ = thread.spawn(move || {
            if let Ok(made) = catch_unwind(AssertUnwindSafe(|| check(job, &told))) {
                let _ = sender.send(made);
            }
        });
        self.running = Some(Running { uri, stops, done });
    }
}

impl Drop for Towns {
    fn drop(&mut self) {
        if let Some(running) = &self.running {
            running.stops.store(true, Ordering::Relaxed);
        }
    }
}

/// Checks a town; `None` if it was stopped.
fn check(job: TownJob, stops: &AtomicBool) -> Option<TownDone> {
    let world = Overlay::new(job.folder.as_deref(), &job.settings, &job.open);
    let options = Options {
        notes_values: true,
        ..world.options(&job.settings)
    };
    let input = TownInput {
        source: &job.source,
        world: &world,
        options: &options,
        kept: Some(&job.maps),
        texts: false,
    };
    let (mut included, mut out) = (job.included, Diagnostics::new());
    let goes_on = || !stops.load(Ordering::Relaxed);
    let facts = hsd_town::check(input, CheckDepth::Rules(&goes_on), &mut included, &mut out);
    let facts = match facts {
        Some(facts) => facts,
        None if !goes_on() => return None,
        // It was a town for the analysis, so it is one.
        None => TownFacts::default(),
    };
    Some(TownDone {
        uri: job.uri,
        reading: job.reading,
        facts,
        included,
        found: out.into_sorted(),
        asked: world.into_asked(),
    })
}
