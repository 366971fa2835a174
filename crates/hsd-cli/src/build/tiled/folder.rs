//! A folder that keeps the files of tiles, each whole or not at all.

use crate::files::output::Committer;
use crate::files::temporary::{is_temporary, sync_folder};
use hsd_export::pieces::Pieces;
use hsd_export::tileset::TreeFiles;
use hsd_scene::texture;
use hsd_scene::texture::palette::COLOURS;
use hsd_town::tiles::TileStore;
use hsd_town::tiles::work;
use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The folders of the files of a town. Those of earlier runs are removed from them.
const OF_TOWN: &[&str] = &["tiles", "textures"];

/// The number of digits of a hash in the names of files.
const HASH: usize = 16;

/// A folder that takes the files of tiles.
pub(in crate::build) struct Folder {
    path: PathBuf,
    own: &'static [&'static str],
    /// The committer, which knows the inputs: none of them is replaced or removed.
    pub(super) committer: Committer,
}

impl Folder {
    /// Makes the folder of a town.
    pub(in crate::build) fn of_town(path: &Path, committer: &Committer) -> io::Result<Folder> {
        Folder::made(path, OF_TOWN, committer)
    }

    /// Makes the folder of a town that is made in steps.
    pub(in crate::build) fn of_work(path: &Path, committer: &Committer) -> io::Result<Folder> {
        Folder::made(path, &work::FOLDERS, committer)
    }

    /// Returns the folder of planned work, which is there.
    pub(in crate::build) fn of_planned(path: &Path, committer: &Committer) -> Folder {
        Folder {
            path: path.to_owned(),
            own: &work::FOLDERS,
            committer: committer.clone(),
        }
    }

    fn made(
        path: &Path,
        own: &'static [&'static str],
        committer: &Committer,
    ) -> io::Result<Folder> {
        for folder in own {
            fs::create_dir_all(path.join(folder))?;
        }
        Ok(Folder {
            path: path.to_owned(),
            own,
            committer: committer.clone(),
        })
    }

    /// Puts the names of all its files on disk.
    pub(in crate::build) fn sync(&self) {
        for folder in self.own {
            sync_folder(&self.path.join(folder));
        }
        sync_folder(&self.path);
    }

    /// Removes a file, which another process may have removed. An input is kept.
    fn remove(&self, path: &Path) -> io::Result<()> {
        if self.committer.inputs.find(path).is_some() {
            return Ok(());
        }
        match fs::remove_file(path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Removes the files that are none of `own` or `branches`: of other inputs, or left by a run that was killed.
    pub(in crate::build) fn sweep(
        &self,
        own: &BTreeSet<String>,
        branches: &BTreeSet<String>,
    ) -> io::Result<()> {
        for entry in fs::read_dir(&self.path)? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if TreeFiles::is_branch(&name) && !branches.contains(&name) {
                self.remove(&entry.path())?;
            }
        }
        self.own
            .iter()
            .try_for_each(|folder| self.sweep_in(folder, own))
    }

    /// Removes the files in one of its folders that are none of `own`.
    pub(in crate::build) fn sweep_in(
        &self,
        folder: &str,
        own: &BTreeSet<String>,
    ) -> io::Result<()> {
        for entry in fs::read_dir(self.path.join(folder))? {
            let entry = entry?;
            let file = entry.file_name();
            let file = file.to_string_lossy();
            let is_stale = is_generated(&file) && !own.contains(&format!("{folder}/{file}"));
            if is_stale && entry.file_type()?.is_file() {
                self.remove(&entry.path())?;
            }
        }
        Ok(())
    }

    /// Takes over a file of another folder under the same name, without a copy where the system can.
    pub(in crate::build) fn adopt(&self, from: &Folder, name: &str) -> io::Result<()> {
        let (source, target) = (from.path.join(name), self.path.join(name));
        match fs::hard_link(&source, &target) {
            Ok(()) => Ok(()),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && one(&source, &target) => {
                Ok(())
            }
            // It is there already, which `commit` looks at, or lies on another disk.
            Err(_) => self.commit(name, &fs::read(&source)?.into()),
        }
    }
}

/// Returns whether a town may have written a file of this name. Others are of the user, who may keep images for parts in a
/// folder of the same name.
fn is_generated(name: &str) -> bool {
    let stem = |name: &str| name.split('.').next().unwrap_or_default().to_owned();
    let own = stem(name);
    let is_hash = |word: &str| word.len() == HASH && word.bytes().all(|b| b.is_ascii_hexdigit());
    let mut textures = texture::FILES.iter().map(|(file, _)| stem(file));
    is_temporary(name)
        || own.split('-').any(is_hash)
        || own == COLOURS
        || textures.any(|texture| texture == own)
}

/// Returns true if two paths are known to be of one file.
fn one(a: &Path, b: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let place = |path: &Path| fs::metadata(path).map(|m| (m.dev(), m.ino()));
        matches!((place(a), place(b)), (Ok(a), Ok(b)) if a == b)
    }
    #[cfg(not(unix))]
    {
        let _ = (a, b);
        false
    }
}

impl TileStore for Folder {
    fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.path.join(name)).ok()
    }

    fn has(&self, name: &str) -> bool {
        self.path.join(name).is_file()
    }

    fn commit(&self, name: &str, bytes: &Pieces) -> io::Result<()> {
        self.committer.write_shared(&self.path.join(name), bytes)
    }
}
