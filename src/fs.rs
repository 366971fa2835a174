//! Part pictures on disk, and texts that others include.
//!
//! A picture's name is looked up in a listing of the folder, never joined to a path, and what is found must lie in the
//! folder after all links are followed: whatever a text says, no file outside is read.

mod roots;

use crate::source::{IncludeError, PictureFile, World};
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use roots::Roots;

const ENDINGS: [&str; 6] = ["png", "jpg", "jpeg", "PNG", "JPG", "JPEG"];

/// Texture folders, searched in order.
#[derive(Debug)]
pub struct FolderWorld {
    folders: Vec<Folder>,
    roots: Roots,
    /// Bytes of a file worth reading: more cannot be a picture within the limit of pixels.
    bytes: u64,
}

#[derive(Debug)]
struct Folder {
    path: PathBuf,
    /// Names of its files; read when a picture is first asked for.
    names: OnceLock<BTreeSet<String>>,
}

impl FolderWorld {
    /// A world of these folders. Missing ones count as empty.
    pub fn new(folders: Vec<PathBuf>, pixels: u64) -> FolderWorld {
        let folder = |path| Folder {
            path,
            names: OnceLock::new(),
        };
        FolderWorld {
            folders: folders.into_iter().map(folder).collect(),
            roots: Roots::default(),
            bytes: pixels.saturating_mul(8).max(1 << 20),
        }
    }

    /// The same with texts below these folders.
    #[must_use]
    pub fn with_roots(self, roots: Vec<PathBuf>) -> FolderWorld {
        let roots = Roots::new(roots);
        FolderWorld { roots, ..self }
    }
}

impl Folder {
    /// The file of a picture's name.
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

    /// A path, if it leads to a file in this folder.
    fn inside(&self, path: &Path) -> Option<PathBuf> {
        let (root, real) = (self.path.canonicalize().ok()?, path.canonicalize().ok()?);
        (real.starts_with(root) && real.is_file()).then(|| path.to_owned())
    }
}

impl World for FolderWorld {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = self.folders.iter().find_map(|f| f.find(name))?;
        Some(file(path.to_str()?))
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        let path = self.roots.find(from, href)?;
        Ok(file(&path))
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        let path = Path::new(path);
        let inside = |f: &Folder| path.parent() == Some(&*f.path) && f.inside(path).is_some();
        if !self.folders.iter().any(inside) && !self.roots.hold(path) {
            let message = "it lies outside the texture folders";
            return Err(io::Error::new(io::ErrorKind::NotFound, message));
        }
        if fs::metadata(path)?.len() > self.bytes {
            return Err(io::Error::other(
                "the file is larger than any picture allowed here",
            ));
        }
        fs::read(path)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        self.roots.find(from, href)
    }

    fn text_bytes(&self, path: &str, limit: usize) -> io::Result<Vec<u8>> {
        self.roots.bytes(path, limit)
    }
}

/// A picture by its path. A file that is none is found all the same, so that a message can say what is wrong with it.
fn file(path: &str) -> PictureFile {
    let size = header(Path::new(path)).filter(|(w, h)| *w > 0 && *h > 0);
    PictureFile {
        path: path.to_owned(),
        size: size.unwrap_or((1, 1)),
    }
}

/// Width and height, from the first bytes of a file.
fn header(path: &Path) -> Option<(u32, u32)> {
    let reader = image::ImageReader::open(path).ok()?;
    reader.with_guessed_format().ok()?.into_dimensions().ok()
}

fn list(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
    names.collect()
}
