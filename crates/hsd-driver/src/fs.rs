//! Part images and included files on disk.
//!
//! Image names are looked up in a listing of the folder, never joined to a path, and the resolved file must be inside the
//! folder. Whatever a source file contains, no file outside the given folders is read.

mod record;
mod roots;

pub use record::{InputRecord, location};

use hsd_base::budget::Budget;
use hsd_base::source::{IncludeError, PictureFile, Stream, World};
use hsd_export::images;
use std::collections::BTreeSet;
use std::fs;
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use roots::Roots;

const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "PNG", "JPG", "JPEG"];

/// File access limited to texture folders, searched in order, and include roots.
#[derive(Debug)]
pub struct FolderWorld {
    folders: Vec<Folder>,
    roots: Roots,
    /// The maximum size of an image file in bytes; larger files would exceed the pixel limit.
    bytes: u64,
    budget: Arc<Budget>,
    /// The files that were opened.
    record: InputRecord,
}

#[derive(Debug)]
struct Folder {
    path: PathBuf,
    /// The names of its files, listed on first use.
    names: OnceLock<BTreeSet<String>>,
}

impl FolderWorld {
    /// Creates a world of these texture folders, with a limit of pixels per image. Missing folders count as empty.
    pub fn new(folders: Vec<PathBuf>, pixels: u64) -> FolderWorld {
        let folder = |path| Folder {
            path,
            names: OnceLock::new(),
        };
        FolderWorld {
            folders: folders.into_iter().map(folder).collect(),
            roots: Roots::default(),
            bytes: pixels.saturating_mul(8).max(1 << 20),
            budget: Arc::default(),
            record: InputRecord::default(),
        }
    }

    /// Adds folders below which includes are allowed.
    #[must_use]
    pub fn with_roots(self, roots: Vec<PathBuf>) -> FolderWorld {
        let roots = Roots::new(roots);
        FolderWorld { roots, ..self }
    }

    /// Sets the memory for what maps expand to, bytes ([`Limits::memory`](hsd_base::source::Limits::memory)).
    #[must_use]
    pub fn with_memory(self, bytes: u64) -> FolderWorld {
        let budget = Arc::new(Budget::new(bytes));
        FolderWorld { budget, ..self }
    }

    /// Adds every file that is opened to this record.
    #[must_use]
    pub fn recorded_in(self, record: &InputRecord) -> FolderWorld {
        let record = record.clone();
        FolderWorld { record, ..self }
    }

    /// Returns an image by its path. Files that are not images are returned too, so that a diagnostic can report them.
    fn image_file(&self, path: &str) -> PictureFile {
        self.record.add(Path::new(path));
        let size = header(Path::new(path)).filter(|(w, h)| *w > 0 && *h > 0);
        PictureFile {
            path: path.to_owned(),
            size: size.unwrap_or((1, 1)),
        }
    }

    /// Returns the canonical path of a file below a root, which is about to be opened.
    fn opened(&self, path: &str) -> io::Result<PathBuf> {
        let real = self.roots.resolved(path)?;
        self.record.add(Path::new(path));
        Ok(real)
    }
}

impl Folder {
    /// Returns the file of an image name, with or without its extension.
    fn find(&self, name: &str) -> Option<PathBuf> {
        let names = self.names.get_or_init(|| list(&self.path));
        let known = name
            .rsplit_once('.')
            .is_some_and(|(_, e)| ENDINGS.contains(&e));
        let own = known.then(|| name.to_owned());
        let ended = ENDINGS.iter().map(|e| format!("{name}.{e}"));
        let file = own.into_iter().chain(ended).find(|n| names.contains(n))?;
        self.inside(&self.path.join(file))
    }

    /// Returns the path if it resolves to a file in this folder.
    fn inside(&self, path: &Path) -> Option<PathBuf> {
        let (root, real) = (self.path.canonicalize().ok()?, path.canonicalize().ok()?);
        (real.starts_with(root) && real.is_file()).then(|| path.to_owned())
    }
}

impl World for FolderWorld {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = self.folders.iter().find_map(|f| f.find(name))?;
        Some(self.image_file(path.to_str()?))
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        let path = self.roots.find(from, href)?;
        Ok(self.image_file(&path))
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        let path = Path::new(path);
        let inside = |f: &Folder| path.parent() == Some(&*f.path) && f.inside(path).is_some();
        if !self.folders.iter().any(inside) && !self.roots.hold(path) {
            let message = "the file is outside the texture folders";
            return Err(io::Error::new(io::ErrorKind::NotFound, message));
        }
        if fs::metadata(path)?.len() > self.bytes {
            return Err(io::Error::other(
                "the file exceeds the size limit of images",
            ));
        }
        self.record.add(path);
        fs::read(path)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        self.roots.find(from, href)
    }

    fn names(&self, from: &str, folder: &str) -> Result<Vec<String>, IncludeError> {
        self.roots.names(from, folder)
    }

    fn text_bytes(&self, path: &str, limit: usize) -> io::Result<Vec<u8>> {
        let mut bytes = vec![];
        let file = File::open(self.opened(path)?)?;
        // One byte more than the limit shows that the file is longer.
        file.take(limit as u64 + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn open(&self, path: &str) -> io::Result<Box<dyn Stream>> {
        Ok(Box::new(File::open(self.opened(path)?)?))
    }

    fn stamp(&self, path: &str) -> Option<u64> {
        stamp(&self.opened(path).ok()?)
    }

    fn budget(&self) -> Arc<Budget> {
        self.budget.clone()
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        self.opened(path).ok()
    }
}

/// Hashes names, sizes and times of the files that differ from one in their extension only.
fn stamp(path: &Path) -> Option<u64> {
    let stem = path.file_stem()?;
    let entries = fs::read_dir(path.parent()?).ok()?.flatten();
    let mut alike: Vec<_> = entries
        .filter(|entry| Path::new(&entry.file_name()).file_stem() == Some(stem))
        .filter_map(|entry| {
            let about = fs::metadata(entry.path()).ok()?;
            Some((entry.file_name(), about.len(), about.modified().ok()?))
        })
        .collect();
    alike.sort();
    let mut hasher = DefaultHasher::new();
    alike.hash(&mut hasher);
    Some(hasher.finish())
}

/// Reads the width and height from the header of an image.
fn header(path: &Path) -> Option<(u32, u32)> {
    images::size(BufReader::new(File::open(path).ok()?))
}

fn list(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
    names.collect()
}
