//! The files that a run has read. An output must not replace one of them.

use std::collections::BTreeMap;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The files that a run has read. Clones share one record.
#[derive(Clone, Debug, Default)]
pub struct InputRecord(Arc<Mutex<RecordedFiles>>);

/// A device and the number of a file on it: equal for all hard links of the file.
type FileNumber = (u64, u64);

#[derive(Debug, Default)]
struct RecordedFiles {
    /// For each canonical path, the path by which the file was first named.
    named: BTreeMap<PathBuf, PathBuf>,
    /// For each file number, a canonical path.
    numbers: BTreeMap<FileNumber, PathBuf>,
}

impl InputRecord {
    /// Adds a file. Folders, devices and pipes are ignored, as are missing files.
    pub fn add(&self, path: &Path) {
        let Ok(real) = path.canonicalize() else {
            return;
        };
        let Some(about) = fs::metadata(&real).ok().filter(Metadata::is_file) else {
            return;
        };
        let mut files = self.files();
        if let Some(number) = number(&about) {
            files.numbers.insert(number, real.clone());
        }
        files.named.entry(real).or_insert_with(|| path.to_owned());
    }

    /// Returns the recorded file that a new file at this path would replace, as it was first named. Links, `..` and hard
    /// links are resolved.
    pub fn find(&self, path: &Path) -> Option<PathBuf> {
        let files = self.files();
        if let Some(named) = files.named.get(&location(path)) {
            return Some(named.clone());
        }
        let own = number_at(path)?;
        let real = files.numbers.get(&own)?;
        // The system reuses the number of a file that was removed.
        let is_same = number_at(real) == Some(own);
        is_same.then(|| files.named.get(real).cloned()).flatten()
    }

    fn files(&self) -> MutexGuard<'_, RecordedFiles> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the canonical path of a file; of a missing one, as far as its folders exist.
pub fn location(path: &Path) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else {
        return path.to_owned();
    };
    let is_here = folder.as_os_str().is_empty();
    location(if is_here { Path::new(".") } else { folder }).join(name)
}

fn number_at(path: &Path) -> Option<FileNumber> {
    number(&fs::metadata(path).ok()?)
}

#[cfg(unix)]
fn number(about: &Metadata) -> Option<FileNumber> {
    use std::os::unix::fs::MetadataExt;
    Some((about.dev(), about.ino()))
}

/// Hard links are not recognised on other systems: the standard library does not number files there.
#[cfg(not(unix))]
fn number(_: &Metadata) -> Option<FileNumber> {
    None
}
