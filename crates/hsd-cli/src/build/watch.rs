//! `hsd build --watch`: rebuilds when a source file or an image changes.

use crate::build::{Build, Job};
use crate::{Failure, Outcome};
use hsd_base::diagnostic::Language;
use hsd_base::text;
use notify_debouncer_full::notify::{EventKind, RecursiveMode};
use notify_debouncer_full::{DebouncedEvent, new_debouncer};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

/// The debounce delay: editors write a file in several steps.
const QUIET: Duration = Duration::from_millis(50);

/// Builds, waits for a change and builds again, until the process is interrupted.
pub(crate) fn run(build: &Build, jobs: &[Job], language: Language) -> Outcome {
    let (sender, events) = mpsc::channel();
    let failed = |e: notify_debouncer_full::notify::Error| unwatched(&e);
    let mut debouncer = new_debouncer(QUIET, None, sender).map_err(failed)?;
    let inputs: Vec<PathBuf> = jobs.iter().flat_map(|j| j.inputs()).cloned().collect();
    let mut texts = BTreeSet::new();
    let mut folders = BTreeSet::new();
    let read = inputs.iter().chain(&build.input_args.catalogs);
    for input in read {
        // The folder is watched rather than the file, because editors replace files when saving.
        let folder = input.parent().filter(|p| !p.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        let folder = folder.map_err(|e| Failure::at(input.display(), e))?;
        texts.extend(input.file_name().map(|name| folder.join(name)));
        folders.insert(folder);
    }
    let pictures = build.input_args.folders(&inputs).into_iter();
    folders.extend(pictures.filter_map(|f| f.canonicalize().ok()));
    for folder in &folders {
        debouncer
            .watch(folder, RecursiveMode::NonRecursive)
            .map_err(failed)?;
    }
    loop {
        let committer = build.committer(jobs);
        match committer.and_then(|committer| build.all((jobs, &committer), language)) {
            Ok(_) => {}
            Err(Failure::Io(message)) => {
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

fn unwatched(error: &dyn std::fmt::Display) -> Failure {
    let error = error.to_string();
    Failure::Io(text!([error]
        "cannot watch for changes: {error}",
        "変更を監視できません: {error}"
    ))
}

/// Returns whether an event changes a source file or an image; outputs in the same folder are ignored.
fn matters(event: &DebouncedEvent, texts: &BTreeSet<PathBuf>) -> bool {
    // Other .hsd files in the folder may be included.
    let read = |p: &Path| {
        let extension = p.extension().and_then(|e| e.to_str()).unwrap_or_default();
        ["png", "jpg", "jpeg", "hsd"]
            .iter()
            .any(|e| extension.eq_ignore_ascii_case(e))
    };
    !matches!(event.kind, EventKind::Access(_))
        && event.paths.iter().any(|p| texts.contains(p) || read(p))
}
