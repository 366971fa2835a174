//! Commits outputs: checks that none of them is an input of the run, writes all under temporary names, and renames them.

use super::{Content, Files, Pour, folder_of};
use crate::Failure;
use crate::files::input::STDIN;
use crate::files::reason;
use crate::files::temporary::{CompleteFile, Temporary, sync_folder};
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_driver::fs::{InputRecord, location};
use hsd_export::pieces::Pieces;
use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The path of standard input, which may be a file.
const STDIN_DEVICE: &str = "/dev/stdin";

/// Writes the outputs of one run. It knows every file that the run has read and every output that it has written, and
/// refuses to replace any of them. Clones share this knowledge.
#[derive(Clone, Debug)]
pub(crate) struct Committer {
    /// The files that the run has read.
    pub(crate) inputs: InputRecord,
    /// The locations of the outputs that were written.
    written: Arc<Mutex<BTreeSet<PathBuf>>>,
    /// The location of the input that may be replaced.
    edited: Option<PathBuf>,
    /// The option or argument that names the outputs.
    option: &'static str,
    /// The files that get their names together, if those of this committer do.
    held: Option<Arc<Mutex<Vec<ReadyFile>>>>,
}

/// A complete file that has yet to get its name.
#[derive(Debug)]
struct ReadyFile {
    file: CompleteFile,
    /// The path of the output, with links resolved.
    target: PathBuf,
    /// The path of the output as the run names it.
    named: PathBuf,
}

impl Default for Committer {
    fn default() -> Committer {
        Committer::knowing(InputRecord::default())
    }
}

impl Committer {
    /// Returns the committer of a run that has read the files of this record.
    pub(crate) fn knowing(inputs: InputRecord) -> Committer {
        Committer {
            inputs,
            written: Arc::default(),
            edited: None,
            option: "-o",
            held: None,
        }
    }

    /// Returns the committer of a run that reads these files.
    pub(crate) fn reading<P: AsRef<Path>>(paths: impl IntoIterator<Item = P>) -> Committer {
        let committer = Committer::default();
        committer.add_inputs(paths);
        committer
    }

    /// Adds files that the run reads.
    pub(crate) fn add_inputs<P: AsRef<Path>>(&self, paths: impl IntoIterator<Item = P>) {
        for path in paths {
            let path = path.as_ref();
            let is_stdin = path.as_os_str() == STDIN;
            let path = if is_stdin {
                STDIN_DEVICE.as_ref()
            } else {
                path
            };
            self.inputs.add(path);
        }
    }

    /// Returns a committer that may replace this input: it is edited in place.
    pub(crate) fn editing(&self, input: &Path) -> Committer {
        Committer {
            edited: Some(location(input)),
            // Several names may be links to one input.
            written: Arc::default(),
            ..self.clone()
        }
    }

    /// Returns a committer for outputs that another option than `-o` names.
    pub(crate) fn named_by(&self, option: &'static str) -> Committer {
        Committer {
            option,
            ..self.clone()
        }
    }

    /// Returns a committer whose files get their names together, by [`Committer::publish`].
    ///
    /// The run may read a file after it has made an output that would replace it.
    pub(crate) fn holding(&self) -> Committer {
        Committer {
            held: Some(Arc::default()),
            ..self.clone()
        }
    }

    /// Gives all files that are held their names. Fails if one of them would replace an input.
    pub(crate) fn publish(&self) -> Result<(), Failure> {
        let Some(held) = &self.held else {
            return Ok(());
        };
        let held = std::mem::take(&mut *locked(held));
        let mut refused = held.iter().filter_map(|ready| self.refusal(&ready.named));
        match refused.next() {
            Some(why) => Err(Failure::Usage(why)),
            None => give_names(held),
        }
    }

    /// Fails if an output is an input, was written before, or is named twice. Nothing is written.
    pub(crate) fn check<P: AsRef<Path>>(
        &self,
        targets: impl IntoIterator<Item = P>,
    ) -> Result<(), Failure> {
        self.locations(targets).map(drop)
    }

    /// Returns the reason why a file may not be replaced: it is an input.
    pub(crate) fn refusal(&self, target: &Path) -> Option<Text> {
        let input = self.inputs.find(target)?;
        if self.edited.as_ref() == Some(&location(target)) {
            return None;
        }
        let (target, input) = (plain(target), plain(&input));
        let (shown, named, option) = (target.display(), input.display(), self.option);
        if input == target {
            return Some(text!([shown, option]
                "{shown} is an input of this run and would be overwritten; choose another output with {option}",
                "{shown} は入力ファイルなので、上書きできません。{option} で別の出力先を指定してください"
            ));
        }
        Some(text!([shown, named, option]
            "{shown} is an input of this run, {named}, and would be overwritten; choose another output with {option}",
            "{shown} は入力ファイル {named} なので、上書きできません。{option} で別の出力先を指定してください"
        ))
    }

    /// Checks outputs and returns their locations.
    fn locations<P: AsRef<Path>>(
        &self,
        targets: impl IntoIterator<Item = P>,
    ) -> Result<BTreeSet<PathBuf>, Failure> {
        let mut own = BTreeSet::new();
        for target in targets {
            let target = target.as_ref();
            if is_stream(target) {
                continue;
            }
            if let Some(why) = self.refusal(target) {
                return Err(Failure::Usage(why));
            }
            let place = compared(location(target));
            if self.written().contains(&place) || !own.insert(place) {
                return Err(written_twice(target));
            }
        }
        Ok(own)
    }

    fn written(&self) -> MutexGuard<'_, BTreeSet<PathBuf>> {
        locked(&self.written)
    }

    /// Writes complete files, all or none of them.
    pub(crate) fn write_all(&self, files: Vec<(PathBuf, Vec<u8>)>) -> Result<(), Failure> {
        let files = files.into_iter();
        let files = files.map(|(path, bytes)| (path, Content::Bytes(bytes.into())));
        self.commit(files.collect()).map(drop)
    }

    /// Writes files that are produced from start to end, all or none of them.
    pub(crate) fn write_poured(&self, files: Vec<(PathBuf, Box<Pour<'_>>)>) -> Result<(), Failure> {
        let files = files.into_iter();
        let files = files.map(|(path, pour)| (path, Content::Poured(pour)));
        self.commit(files.collect()).map(drop)
    }

    /// Writes a file with its side files, or to standard output; returns their total size, bytes.
    pub(crate) fn write(&self, path: &Path, files: Files<'_>) -> Result<u64, Failure> {
        if path.as_os_str() == STDIN {
            let mut out = io::stdout().lock();
            let length = files.main.write_stream(&mut out)?;
            out.flush()?;
            return Ok(length);
        }
        let folder = folder_of(path);
        let beside = files.beside.into_iter();
        let beside = beside.map(|(name, content)| (folder.join(name), content));
        // Keeps the exact path of the main file, which may not be UTF-8.
        let main = (path.to_owned(), files.main);
        self.commit(beside.chain([main]).collect())
    }

    /// Writes all files under temporary names, then renames them in their order; returns their total size, bytes.
    fn commit(&self, files: Vec<(PathBuf, Content<'_>)>) -> Result<u64, Failure> {
        let places = self.locations(files.iter().map(|(path, _)| path))?;
        let (mut ready, mut length) = (vec![], 0);
        for (target, content) in files {
            let prepared = prepare(&target, content);
            let (bytes, file) = prepared.map_err(|e| Failure::at(target.display(), e))?;
            length += bytes;
            ready.extend(file);
        }
        match &self.held {
            Some(held) => locked(held).extend(ready),
            None => give_names(ready)?,
        }
        self.written().extend(places);
        Ok(length)
    }

    /// Writes a file that other processes may write too: one with the same bytes stays. Its folder is not synced.
    ///
    /// # Errors
    /// If it cannot be written, or would replace an input with other bytes.
    pub(crate) fn write_shared(&self, target: &Path, bytes: &Pieces) -> io::Result<()> {
        let complete = || {
            let mut file = Temporary::new_in(folder_of(target))?;
            bytes.write(file.as_file_mut())?;
            file.complete()
        };
        if complete()?.persist_new(target)? || bytes.are(&fs::read(target)?) {
            return Ok(());
        }
        if let Some(why) = self.refusal(target) {
            return Err(reason::error(io::ErrorKind::Other, why));
        }
        // An image that has changed since.
        complete()?.persist(target)
    }

    /// Starts a file that is written piece by piece.
    pub(crate) fn draft(&self, target: &Path) -> Result<Draft, Failure> {
        self.check([target])?;
        let file = temporary_in(folder_of(target));
        Ok(Draft {
            committer: self.clone(),
            file: file.map_err(|e| Failure::at(target.display(), e))?,
            target: target.to_owned(),
        })
    }
}

/// A file that is written piece by piece under a temporary name. It is removed unless it is finished.
pub(crate) struct Draft {
    committer: Committer,
    file: Temporary,
    target: PathBuf,
}

impl Draft {
    /// Returns the open file.
    pub(crate) fn as_file_mut(&mut self) -> &mut fs::File {
        self.file.as_file_mut()
    }

    /// Renames the file, which is complete. Checks again, since the run may have read more files.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let places = self.committer.locations([&self.target])?;
        let (file, target) = (self.file, self.target);
        let renamed = file.complete().and_then(|file| file.persist(&target));
        renamed.map_err(|e| Failure::at(target.display(), e))?;
        sync_folder(folder_of(&target));
        self.committer.written().extend(places);
        Ok(())
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Renames files in their order, then puts their names on disk.
fn give_names(files: Vec<ReadyFile>) -> Result<(), Failure> {
    let mut folders = BTreeSet::new();
    for ReadyFile { file, target, .. } in files {
        let renamed = file.persist(&target);
        renamed.map_err(|e| Failure::at(target.display(), e))?;
        folders.insert(folder_of(&target).to_owned());
    }
    folders.iter().for_each(|folder| sync_folder(folder));
    Ok(())
}

/// Returns the failure of a run that would write a file twice.
fn written_twice(target: &Path) -> Failure {
    let shown = plain(target).display();
    Failure::Usage(text!([shown]
        "{shown} would be written twice by this run; give its outputs different names",
        "{shown} が二度書かれることになります。出力ごとに別の名前を指定してください"
    ))
}

/// Returns a path as people write it.
fn plain(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}

/// Returns whether a path is standard output, a device or a pipe: nothing there is replaced.
fn is_stream(path: &Path) -> bool {
    let is_device = |about: fs::Metadata| !about.is_file() && !about.is_dir();
    path.as_os_str() == STDIN || fs::metadata(path).is_ok_and(is_device)
}

/// Returns the form of a location for comparisons: in lower case on systems that usually ignore case.
fn compared(place: PathBuf) -> PathBuf {
    match cfg!(any(windows, target_os = "macos")) {
        true => place.to_string_lossy().to_lowercase().into(),
        false => place,
    }
}

/// Fails if a folder is missing.
fn require_folder(folder: &Path) -> io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    let shown = folder.display();
    let why = text!([shown] "no such folder: {shown}", "フォルダー {shown} がありません");
    Err(reason::error(io::ErrorKind::NotFound, why))
}

/// Creates a temporary file in a folder, which must exist.
fn temporary_in(folder: &Path) -> io::Result<Temporary> {
    require_folder(folder)?;
    // Drops the temporary path from the error message.
    Temporary::new_in(folder).map_err(|e| io::Error::from(e.kind()))
}

/// Writes a temporary file in the folder of an output; returns the number of bytes and the file. Devices and pipes are
/// written directly.
fn prepare(named: &Path, content: Content<'_>) -> io::Result<(u64, Option<ReadyFile>)> {
    let mut rights = None;
    let target = match fs::metadata(named) {
        Ok(known) if known.is_dir() => {
            let why = text!("is a folder", "フォルダーです");
            return Err(reason::error(io::ErrorKind::Other, why));
        }
        Ok(known) if !known.is_file() => {
            let mut device = fs::OpenOptions::new().write(true).open(named)?;
            return Ok((content.write_stream(&mut device)?, None));
        }
        Ok(known) => {
            rights = Some(known.permissions());
            named.canonicalize()?
        }
        Err(_) => named.to_owned(),
    };
    let folder = folder_of(&target);
    let of_textures = folder.to_string_lossy().ends_with("_textures") && !folder.exists();
    let asked = if of_textures {
        folder_of(folder)
    } else {
        folder
    };
    require_folder(asked)?;
    // Other folders are not created, so that a misspelt path fails.
    if of_textures {
        fs::create_dir(folder)?;
        sync_folder(asked);
    }
    let mut file = temporary_in(folder)?;
    let length = content.write_file(file.as_file_mut())?;
    // Keeps the permissions of an existing file.
    if let Some(rights) = rights {
        file.as_file_mut().set_permissions(rights)?;
    }
    let ready = ReadyFile {
        file: file.complete()?,
        target,
        named: named.to_owned(),
    };
    Ok((length, Some(ready)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("can be made")
    }

    fn written(path: &Path, text: &str) -> PathBuf {
        fs::write(path, text).expect("can be written");
        path.to_owned()
    }

    #[test]
    fn an_input_that_was_read_meanwhile_stops_a_draft() {
        let folder = folder();
        let target = written(&folder.path().join("a"), "input");
        let committer = Committer::default();
        let mut draft = committer.draft(&target).expect("is no input yet");
        draft.as_file_mut().write_all(b"output").expect("is open");
        committer.add_inputs([&target]);
        assert!(draft.finish().is_err());
        assert_eq!(fs::read(&target).expect("is there"), b"input");
        let files = fs::read_dir(folder.path()).expect("is there").count();
        assert_eq!(files, 1, "the temporary file is removed");
    }

    #[test]
    fn a_missing_input_keeps_its_path_but_not_its_number() {
        let folder = folder();
        let (a, b) = (folder.path().join("a"), folder.path().join("b"));
        let committer = Committer::reading([&written(&a, "input")]);
        fs::remove_file(&a).expect("is there");
        // The system may give the number of the first file to the second.
        written(&b, "other");
        assert!(committer.refusal(&b).is_none());
        assert!(committer.refusal(&folder.path().join("./a")).is_some());
    }

    #[test]
    fn a_path_is_written_once_and_an_edited_input_again() {
        let folder = folder();
        let own = written(&folder.path().join("a"), "input");
        let committer = Committer::reading([&own]);
        let write = |committer: &Committer, name: &str| {
            committer.write_all(vec![(folder.path().join(name), b"output".to_vec())])
        };
        assert!(write(&committer, "a").is_err());
        assert!(write(&committer.editing(&own), "a").is_ok());
        assert!(write(&committer.editing(&own), "a").is_ok());
        assert!(write(&committer, "b").is_ok());
        assert!(write(&committer, "b").is_err());
    }
}
