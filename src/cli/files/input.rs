//! Reads the input files.

use crate::cli::Failure;
use crate::cli::files::reason;
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::{file as say, limits};
use crate::source::{FileId, Source};
use crate::text;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// The file name that denotes standard input or standard output.
pub(in crate::cli) const STDIN: &str = "-";

/// The input files.
#[derive(Debug)]
pub(in crate::cli) struct Inputs {
    /// One source per file, numbered in order.
    pub(in crate::cli) sources: Vec<Source>,
    /// For each source, whether the file is over the limit or unreadable. Such a source is empty and has a diagnostic.
    refused: Vec<bool>,
    /// The error of the first unreadable file.
    failure: Option<Failure>,
}

impl Inputs {
    /// Reads files. Fails if one is unreadable.
    pub(in crate::cli) fn read(
        paths: &[PathBuf],
        limit: usize,
        out: &mut Diagnostics,
    ) -> Result<Inputs, Failure> {
        Inputs::from(0, paths, limit, out)
    }

    /// Like [`Inputs::read`], with sources numbered from `first`.
    pub(in crate::cli) fn from(
        first: u32,
        paths: &[PathBuf],
        limit: usize,
        out: &mut Diagnostics,
    ) -> Result<Inputs, Failure> {
        let mut inputs = Inputs::numbered(first, paths, limit, out);
        inputs.failure.take().map_or(Ok(inputs), Err)
    }

    /// Returns whether a file could not be read.
    pub(in crate::cli) fn failed(&self) -> bool {
        self.failure.is_some()
    }

    /// Reads files, with a diagnostic for each unreadable one.
    pub(in crate::cli) fn readable(
        paths: &[PathBuf],
        limit: usize,
        out: &mut Diagnostics,
    ) -> Inputs {
        Inputs::numbered(0, paths, limit, out)
    }

    fn numbered(first: u32, paths: &[PathBuf], limit: usize, out: &mut Diagnostics) -> Inputs {
        let mut inputs = Inputs {
            sources: vec![],
            refused: vec![],
            failure: None,
        };
        for (path, id) in paths.iter().zip(first..) {
            let shown = if path.as_os_str() == STDIN {
                "<stdin>".to_owned()
            } else {
                path.display().to_string()
            };
            let (bytes, size, failure) = match read(path, limit) {
                Ok((bytes, size)) => (bytes, size, None),
                Err(error) => (vec![], 0, Some(error)),
            };
            let source = Source::new(FileId(id), shown.as_str(), &bytes);
            let start = source.span(0..0);
            inputs.refused.push(size > limit || failure.is_some());
            if size > limit {
                out.push(limits::too_large(start, size, limit));
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
    pub(in crate::cli) fn taken(&self) -> impl Iterator<Item = bool> {
        self.refused.iter().map(|refused| !refused)
    }

    /// Returns the sources followed by the included ones, for a report.
    pub(in crate::cli) fn and(self, included: Vec<Source>) -> Vec<Source> {
        let mut sources = self.sources;
        sources.extend(included);
        sources
    }

    /// Returns the accepted sources.
    pub(in crate::cli) fn accepted(&self) -> Vec<&Source> {
        let both = self.sources.iter().zip(&self.refused);
        both.filter(|(_, refused)| !**refused)
            .map(|(s, _)| s)
            .collect()
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
