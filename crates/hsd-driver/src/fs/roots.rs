//! Included files on disk. Paths are relative to the including file and cannot leave the root folders, neither by `..` nor
//! by links.

use hsd_base::source::IncludeError;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Folders that contain all readable files.
#[derive(Debug, Default)]
pub(super) struct Roots {
    list: Vec<PathBuf>,
}

impl Roots {
    pub(super) fn new(list: Vec<PathBuf>) -> Roots {
        Roots { list }
    }

    /// Returns the path of the file that `from` includes as `href`.
    pub(super) fn find(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        let path = joined(from, href)?;
        // Nothing outside the roots is opened.
        let roots: Vec<PathBuf> = self.list.iter().filter_map(|r| real(r)).collect();
        let folder = real(path.parent().unwrap_or(Path::new("")));
        let inside = |p: &Path| roots.iter().any(|r| p.starts_with(r));
        match folder {
            Some(folder) if !inside(&folder) => return Err(IncludeError::Outside),
            Some(_) => {}
            None => return Err(IncludeError::Missing),
        }
        match real(&path) {
            Some(found) if !inside(&found) => Err(IncludeError::Outside),
            Some(found) if found.is_file() => {
                let name = path.to_str().map(str::to_owned);
                name.ok_or(IncludeError::Missing)
            }
            _ => Err(IncludeError::Missing),
        }
    }

    /// Returns the names of the files in a folder that `from` names as `href`.
    pub(super) fn names(&self, from: &str, href: &str) -> Result<Vec<String>, IncludeError> {
        let folder = real(&joined(from, href)?).ok_or(IncludeError::Missing)?;
        let mut roots = self.list.iter().filter_map(|r| real(r));
        if !roots.any(|root| folder.starts_with(root)) {
            return Err(IncludeError::Outside);
        }
        let entries = fs::read_dir(folder).map_err(|_| IncludeError::Missing)?;
        let files = entries.flatten().filter(|entry| entry.path().is_file());
        Ok(files
            .filter_map(|entry| entry.file_name().into_string().ok())
            .collect())
    }

    /// Returns whether a path resolves to a file below a root.
    pub(super) fn hold(&self, path: &Path) -> bool {
        real(path).is_some_and(|p| self.inside(&p))
    }

    fn inside(&self, real_path: &Path) -> bool {
        let mut roots = self.list.iter().filter_map(|r| real(r));
        roots.any(|r| real_path.starts_with(r)) && real_path.is_file()
    }

    /// Returns the canonical path of a file below a root.
    pub(super) fn resolved(&self, path: &str) -> io::Result<PathBuf> {
        let missing = |message: &str| io::Error::new(io::ErrorKind::NotFound, message);
        let Some(found) = real(Path::new(path)) else {
            return Err(missing("there is no such file"));
        };
        match self.inside(&found) {
            true => Ok(found),
            false => Err(missing("the file is outside the root folder")),
        }
    }
}

/// Returns the path that `from` names as `href`.
fn joined(from: &str, href: &str) -> Result<PathBuf, IncludeError> {
    let folder = Path::new(from).parent().unwrap_or(Path::new(""));
    let mut path = folder.to_owned();
    for part in Path::new(href).components() {
        match part {
            Component::Normal(name) => path.push(name),
            Component::CurDir => {}
            Component::ParentDir if ends_in_name(&path) => {
                path.pop();
            }
            Component::ParentDir => path.push(".."),
            Component::RootDir | Component::Prefix(_) => return Err(IncludeError::Outside),
        }
    }
    Ok(path)
}

fn ends_in_name(path: &Path) -> bool {
    matches!(path.components().next_back(), Some(Component::Normal(_)))
}

/// Returns the canonical path.
fn real(path: &Path) -> Option<PathBuf> {
    if path.as_os_str().is_empty() {
        return Path::new(".").canonicalize().ok();
    }
    path.canonicalize().ok()
}
