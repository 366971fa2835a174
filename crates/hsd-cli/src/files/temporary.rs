//! Temporary files that vanish whatever ends the program: an error, a signal, or, swept later, a crash.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::time::Duration;
use tempfile::{NamedTempFile, TempPath};

/// The beginning of the names of temporary files.
const PREFIX: &str = ".hsd-";

/// The number of random letters in their names.
const LETTERS: usize = 6;

/// A file of this age belongs to no program that still runs.
const OLD: Duration = Duration::from_secs(24 * 60 * 60);

/// The paths that are removed when a signal ends the program.
static OPEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The folders that were swept.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn lock(set: &Mutex<BTreeSet<PathBuf>>) -> MutexGuard<'_, BTreeSet<PathBuf>> {
    set.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file or folder that is removed when a signal ends the program, while this value lives.
#[derive(Debug)]
pub(crate) struct Guarded(PathBuf);

impl Guarded {
    /// Makes something and guards its path; no signal can come between the two.
    pub(crate) fn new<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> &Path,
    ) -> io::Result<(T, Guarded)> {
        catch_signals();
        let mut open = lock(&OPEN);
        let made = make()?;
        let path = path(&made).to_owned();
        open.insert(path.clone());
        Ok((made, Guarded(path)))
    }
}

impl Drop for Guarded {
    fn drop(&mut self) {
        lock(&OPEN).remove(&self.0);
    }
}

/// Done once signals are caught, or are left to others.
static CAUGHT: Once = Once::new();

/// Leaves signals to the program that this one is part of.
pub(crate) fn leave_signals() {
    CAUGHT.call_once(|| {});
}

/// Removes what is left where INT, TERM or HUP end the program.
fn catch_signals() {
    CAUGHT.call_once(|| {
        // Without a handler, files are left where they are until they are swept.
        let _ = ctrlc::set_handler(|| {
            for path in &*lock(&OPEN) {
                let _ = match path.is_dir() {
                    true => fs::remove_dir_all(path),
                    false => fs::remove_file(path),
                };
            }
            std::process::exit(130);
        });
    });
}

/// A new file beside its target, under a temporary name until it is complete.
pub(crate) struct Temporary {
    file: NamedTempFile,
    guarded: Guarded,
}

impl Temporary {
    /// Creates a file in a folder, with the default permissions of a new file.
    pub(crate) fn new_in(folder: &Path) -> io::Result<Temporary> {
        sweep(folder);
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).rand_bytes(LETTERS);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o666)); // reduced by the umask
        }
        let (file, guarded) = Guarded::new(|| builder.tempfile_in(folder), NamedTempFile::path)?;
        Ok(Temporary { file, guarded })
    }

    /// Returns the open file.
    pub(crate) fn as_file_mut(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Puts the contents on disk and closes the file. Only then can it get its name, so that no crash leaves half a file there.
    pub(crate) fn complete(self) -> io::Result<CompleteFile> {
        self.file.as_file().sync_all()?;
        Ok(CompleteFile {
            path: self.file.into_temp_path(),
            guarded: self.guarded,
        })
    }
}

/// A file whose contents are on disk, under a temporary name.
#[derive(Debug)]
pub(crate) struct CompleteFile {
    path: TempPath,
    guarded: Guarded,
}

impl CompleteFile {
    /// Gives the file its name unless there is one of that name; returns whether it got it.
    pub(crate) fn persist_new(self, target: &Path) -> io::Result<bool> {
        let named = match self.path.persist_noclobber(target) {
            Ok(_) => true,
            Err(failed) if failed.error.kind() == io::ErrorKind::AlreadyExists => false,
            Err(failed) => return Err(failed.error),
        };
        drop(self.guarded);
        Ok(named)
    }

    /// Gives the file its name; one that exists is replaced.
    pub(crate) fn persist(self, target: &Path) -> io::Result<()> {
        self.path.persist(target).map_err(|e| e.error)?;
        drop(self.guarded);
        Ok(())
    }
}

/// Puts the names of the files in a folder on disk. Where a system cannot, it does so later: the files are complete.
pub(crate) fn sync_folder(folder: &Path) {
    #[cfg(unix)]
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    #[cfg(not(unix))]
    let _ = folder;
}

/// Returns whether a file of this name is a temporary one.
pub(crate) fn is_temporary(name: &str) -> bool {
    name.strip_prefix(PREFIX).is_some_and(|rest| {
        rest.len() == LETTERS && rest.bytes().all(|b| b.is_ascii_alphanumeric())
    })
}

/// Removes the temporary files that crashed programs have left in a folder, once for each folder.
fn sweep(folder: &Path) {
    if !lock(&SWEPT).insert(folder.to_owned()) {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let ours = entry.file_name().to_str().is_some_and(is_temporary);
        let old = || {
            entry
                .metadata()
                .ok()
                .filter(fs::Metadata::is_file)?
                .modified()
                .ok()?
                .elapsed()
                .ok()
        };
        if ours && old().is_some_and(|age| age > OLD) {
            let _ = fs::remove_file(entry.path());
        }
    }
}
