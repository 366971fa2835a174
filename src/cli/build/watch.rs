//! `hsd build --watch`: builds again when a text or a picture changes.

use crate::cli::build::{Build, Job};
use crate::cli::{Outcome, Stop};
use crate::diagnostic::Language;
use crate::text;
use notify_debouncer_full::notify::{EventKind, RecursiveMode};
use notify_debouncer_full::{DebouncedEvent, new_debouncer};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

/// Editors write a file in several steps.
const QUIET: Duration = Duration::from_millis(50);

/// Builds, waits, builds again; ends when the process is interrupted.
pub(in crate::cli) fn run(build: &Build, jobs: &[Job], language: Language) -> Outcome {
    let (sender, events) = mpsc::channel();
    let failed = |e: notify_debouncer_full::notify::Error| unwatched(&e);
    let mut debouncer = new_debouncer(QUIET, None, sender).map_err(failed)?;
    let inputs: Vec<PathBuf> = jobs.iter().flat_map(|j| j.inputs()).cloned().collect();
    let mut texts = BTreeSet::new();
    let mut folders = BTreeSet::new();
    let read = inputs.iter().chain(&build.reading.catalogs);
    for input in read {
        // The folder is watched, since editors put a new file in the place of the old one.
        let folder = input.parent().filter(|p| !p.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        let folder = folder.map_err(|e| Stop::at(input.display(), e))?;
        texts.extend(input.file_name().map(|name| folder.join(name)));
        folders.insert(folder);
    }
    let pictures = build.reading.folders(&inputs).into_iter();
    folders.extend(pictures.filter_map(|f| f.canonicalize().ok()));
    for folder in &folders {
        debouncer
            .watch(folder, RecursiveMode::NonRecursive)
            .map_err(failed)?;
    }
    loop {
        match build.all(jobs, language) {
            Ok(_) => {}
            Err(Stop::Io(message)) => {
                writeln!(io::stderr(), "hsd: {}", message.in_language(language))?;
            }
            Err(stop) => return Err(stop),
        }
        loop {
            let batch = events.recv().map_err(|e| unwatched(&e))?;
            let mut list = batch.into_iter().flatten();
            if list.any(|e| matters(&e, &texts)) {
                break;
            }
        }
    }
}

fn unwatched(error: &dyn std::fmt::Display) -> Stop {
    Stop::Io(text!(
        "cannot watch: {error}",
        "変更を監視できません: {error}"
    ))
}

/// Whether an event changes a text or a picture; outputs in the same folder do not count.
fn matters(event: &DebouncedEvent, texts: &BTreeSet<PathBuf>) -> bool {
    // A text beside the others may be included by them.
    let read = |p: &Path| {
        let ending = p.extension().and_then(|e| e.to_str()).unwrap_or_default();
        ["png", "jpg", "jpeg", "hsd"]
            .iter()
            .any(|e| ending.eq_ignore_ascii_case(e))
    };
    !matches!(event.kind, EventKind::Access(_))
        && event.paths.iter().any(|p| texts.contains(p) || read(p))
}
