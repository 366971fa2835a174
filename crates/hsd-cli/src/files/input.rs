//! Reads the input files.

use crate::Failure;
use crate::files::reason;
use hsd_base::diagnostic::messages::{file as say, limits};
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{FileId, Limits, LongFile, Source};
use hsd_base::text;
use hsd_syntax::parse::divide::{self, Undivided};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The file name that denotes standard input or standard output.
pub(crate) const STDIN: &str = "-";

/// The input files.
#[derive(Debug)]
pub(crate) struct Inputs {
    /// One source per file, numbered in order.
    pub(crate) sources: Vec<Source>,
    /// The files that are read in pieces; their sources are without houses.
    pub(crate) long: Vec<Arc<LongFile>>,
    /// For each source, whether the file is over the limit or unreadable. Such a source is empty and has a diagnostic.
    refused: Vec<bool>,
    /// The error of the first unreadable file.
    failure: Option<Failure>,
}

impl Inputs {
    /// Reads files. Fails if one is unreadable.
    pub(crate) fn read(
        paths: &[PathBuf],
        limit: usize,
        out: &mut Diagnostics,
    ) -> Result<Inputs, Failure> {
        Inputs::from(0, paths, limit, out)
    }

    /// Like [`Inputs::read`], with sources numbered from `first`.
    pub(crate) fn from(
        first: u32,
        paths: &[PathBuf],
        limit: usize,
        out: &mut Diagnostics,
    ) -> Result<Inputs, Failure> {
        Inputs::numbered(first, (paths, false), limit, out).sound()
    }

    /// Like [`Inputs::read`]; long files are read in pieces, as far as they can be divided.
    pub(crate) fn in_pieces(
        paths: &[PathBuf],
        limits: &Limits,
        out: &mut Diagnostics,
    ) -> Result<Inputs, Failure> {
        let mut inputs = Inputs::numbered(0, (paths, true), limits.bytes, out).sound()?;
        if paths.len() > 1 {
            inputs.hold_unplaced(paths, limits)?;
        }
        Ok(inputs)
    }

    fn sound(mut self) -> Result<Inputs, Failure> {
        self.failure.take().map_or(Ok(self), Err)
    }

    /// Reads as a whole what is put beside the houses of other files.
    fn hold_unplaced(&mut self, paths: &[PathBuf], limits: &Limits) -> Result<(), Failure> {
        for file in std::mem::take(&mut self.long) {
            let number = file.id().0 as usize;
            let failed = |error| Failure::at(paths[number].display(), error);
            let piece = file.piece(0).map_err(failed)?;
            if hsd_driver::is_put_aside(&piece, limits) {
                let bytes = std::fs::read(&paths[number]).map_err(failed)?;
                self.sources[number] = Source::new(file.id(), piece.name(), &bytes);
            } else {
                self.long.push(file);
            }
        }
        Ok(())
    }

    /// Returns whether a file could not be read.
    pub(crate) fn failed(&self) -> bool {
        self.failure.is_some()
    }

    /// Reads files, with a diagnostic for each unreadable one.
    pub(crate) fn readable(paths: &[PathBuf], limit: usize, out: &mut Diagnostics) -> Inputs {
        Inputs::numbered(0, (paths, false), limit, out)
    }

    /// Like [`Inputs::readable`]; long files are read in pieces, as far as they can be divided.
    pub(crate) fn readable_in_pieces(
        paths: &[PathBuf],
        limits: &Limits,
        out: &mut Diagnostics,
    ) -> Inputs {
        Inputs::numbered(0, (paths, true), limits.bytes, out)
    }

    fn numbered(
        first: u32,
        (paths, in_pieces): (&[PathBuf], bool),
        limit: usize,
        out: &mut Diagnostics,
    ) -> Inputs {
        let mut inputs = Inputs {
            sources: vec![],
            long: vec![],
            refused: vec![],
            failure: None,
        };
        for (path, id) in paths.iter().zip(first..) {
            let shown = if path.as_os_str() == STDIN {
                "<stdin>".to_owned()
            } else {
                path.display().to_string()
            };
            let divided = match in_pieces {
                true => divided(path, (FileId(id), &shown)),
                false => Ok(None),
            };
            let whole = match divided {
                Ok(Some(Ok((file, stub)))) => {
                    inputs.long.push(Arc::new(file));
                    inputs.sources.push(stub);
                    inputs.refused.push(false);
                    continue;
                }
                Ok(Some(Err(reason))) => Some(reason),
                // Its failure is that of reading it.
                Ok(None) | Err(_) => None,
            };
            let (bytes, size, failure) = match read(path, limit) {
                Ok((bytes, size)) => (bytes, size, None),
                Err(error) => (vec![], 0, Some(error)),
            };
            let source = Source::new(FileId(id), shown.as_str(), &bytes);
            let start = source.span(0..0);
            inputs.refused.push(size > limit || failure.is_some());
            if size > limit {
                out.push(match whole {
                    None => limits::too_large(start, size, limit),
                    Some(why) => limits::too_large_whole(start, size, limit, &why.text()),
                });
            }
            if let Some(error) = failure {
                out.push(say::unreadable(start, reason::of(&error)));
                inputs.failure.get_or_insert(Failure::at(&shown, error));
            }
            inputs.sources.push(source);
        }
        inputs
    }

    /// For each source in order, whether it was accepted.
    pub(crate) fn taken(&self) -> impl Iterator<Item = bool> {
        self.refused.iter().map(|refused| !refused)
    }

    /// Returns the sources followed by the included ones, for a report.
    pub(crate) fn and(self, included: Vec<Source>) -> Vec<Source> {
        let mut sources = self.sources;
        sources.extend(included);
        sources
    }

    /// As [`Inputs::and`], with files that are read in pieces as far as these messages show them.
    pub(crate) fn shown(
        mut self,
        included: Vec<Source>,
        list: &[Diagnostic],
    ) -> Result<Vec<Source>, Failure> {
        let first = self.sources.first().map_or(0, |source| source.id().0);
        for file in &self.long {
            let labels = list.iter().flat_map(|d| &d.labels).map(|l| l.span);
            let fixes = list.iter().flat_map(|d| &d.fixes).flat_map(|f| &f.edits);
            let places = list.iter().filter_map(Diagnostic::span);
            let places = places.chain(labels).chain(fixes.map(|edit| edit.span));
            let source = &mut self.sources[(file.id().0 - first) as usize];
            let excerpt = file.excerpt(places);
            *source = excerpt.map_err(|error| Failure::at(source.name(), error))?;
        }
        Ok(self.and(included))
    }

    /// Returns the accepted sources.
    pub(crate) fn accepted(&self) -> Vec<&Source> {
        let both = self.sources.iter().zip(&self.refused);
        both.filter(|(_, refused)| !**refused)
            .map(|(s, _)| s)
            .collect()
    }
}

/// Returns a file that is read in pieces, and its source without houses, or the reason why it is not; `None` for a file
/// that is short or no file.
fn divided(
    path: &Path,
    (id, shown): (FileId, &str),
) -> io::Result<Option<Result<(LongFile, Source), Undivided>>> {
    if path.as_os_str() == STDIN {
        return Ok(None);
    }
    let mut file = File::open(path)?;
    let kind = file.metadata()?;
    let size = kind.len();
    if !kind.is_file() || size <= divide::LONG || size > u64::from(u32::MAX) {
        return Ok(None);
    }
    match divide::divide(&mut file, size)? {
        Ok(layout) => {
            let file = LongFile::new(id, shown, (Box::new(file), size), layout);
            let stub = file.stub()?;
            Ok(Some(Ok((file, stub))))
        }
        Err(reason) => Ok(Some(Err(reason))),
    }
}

/// Returns the contents and the size of a file; the contents are empty if it is over the limit.
fn read(path: &Path, limit: usize) -> io::Result<(Vec<u8>, usize)> {
    let mut bytes = vec![];
    if path.as_os_str() == STDIN {
        let stdin = io::stdin().lock();
        stdin.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    } else {
        let file = File::open(path)?;
        let kind = file.metadata()?;
        if kind.is_dir() {
            let why = text!(
                "is a folder; name the source files in it",
                "フォルダーです。中のテキストを指定してください"
            );
            return Err(reason::error(ErrorKind::Other, why));
        }
        if kind.len() > limit as u64 {
            return Ok((vec![], usize::try_from(kind.len()).unwrap_or(usize::MAX)));
        }
        // The size of a pipe or of a growing file is unknown.
        file.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    }
    let size = bytes.len();
    if size > limit {
        bytes.clear();
    }
    Ok((bytes, size))
}
