//! Where the nodes of a scene are written, as line and column. Houses are made on several threads, and long files are not in
//! memory: each thread reads the piece around its houses.

use super::Options;
use super::pieces::Feed;
use hsd_base::source::{FileId, Lines, LongFile, PieceLines, Source, Span};
use hsd_scene::{Detail, Node, Place, Provenance};
use std::collections::HashMap;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The lines of all sources of a run.
pub(super) struct Places<'a> {
    whole: HashMap<FileId, (&'a Source, Lines<&'a str>)>,
    long: &'a [Arc<LongFile>],
    /// The names of the files by their numbers.
    names: Vec<Arc<String>>,
    /// True if all nodes are told their place, not houses alone.
    fine: bool,
    /// The last piece of a long file that was read.
    recent: Mutex<Option<Arc<Piece>>>,
}

/// The lines of a piece of a long file.
type Piece = (FileId, PieceLines);

impl<'a> Places<'a> {
    /// Finds the lines of the sources, and of files that they include.
    pub(super) fn new(feed: Feed<'a>, included: &'a [Source], options: &Options) -> Places<'a> {
        let all = feed.sources.iter().copied().chain(included);
        let whole = all.clone().filter(|source| feed.long(source).is_none());
        let names = Provenance::default().with_files(all.clone());
        let lines = |source: &'a Source| (source.id(), (source, Lines::of(source)));
        Places {
            whole: whole.map(lines).collect(),
            long: feed.long,
            names: names.files.into_iter().map(Arc::new).collect(),
            fine: options.detail >= Detail::Openings,
            recent: Mutex::new(None),
        }
    }

    /// Tells nodes where they are written.
    pub(super) fn tell<'n>(&self, nodes: impl Iterator<Item = &'n mut Node>) {
        let mut near = self.recent().clone();
        let mut home = None;
        for node in nodes.filter(|node| self.fine || node.parent.is_none()) {
            let place = node.span.and_then(|span| self.place(span, &mut near));
            node.place = place.and_then(|(line, column)| {
                let line = NonZeroU32::new(line)?;
                Some(Place { line, column })
            });
            let file = node.span.map(|span| span.file);
            if node.parent.is_none() || (file.is_some() && file != home) {
                let name = file.and_then(|file| self.names.get(file.0 as usize));
                node.file = name.cloned();
            }
            if node.parent.is_none() {
                home = file;
            }
        }
    }

    /// Returns line and column of a span; `near` is the last piece of a long file.
    fn place(&self, span: Span, near: &mut Option<Arc<Piece>>) -> Option<(u32, u32)> {
        if let Some((source, lines)) = self.whole.get(&span.file) {
            return Some(lines.line_column(source.text_range(span).start));
        }
        let known = |(file, lines): &Piece| (*file == span.file).then(|| lines.line_column(span));
        if let Some(known) = near.as_deref().and_then(known).flatten() {
            return Some(known);
        }
        let file = self.long.iter().find(|file| file.id() == span.file)?;
        // Other threads have houses of the same piece.
        if let Some(other) = self.recent().clone()
            && let Some(known) = known(&other).flatten()
        {
            *near = Some(other);
            return Some(known);
        }
        let lines = file.lines_around(span)?;
        let place = lines.line_column(span);
        let piece = Arc::new((span.file, lines));
        *self.recent() = Some(piece.clone());
        *near = Some(piece);
        place
    }

    fn recent(&self) -> MutexGuard<'_, Option<Arc<Piece>>> {
        self.recent.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns what a run makes its model from.
pub(super) fn provenance(
    sources: &[&Source],
    included: &[Source],
    options: &Options,
) -> Provenance {
    let given = Provenance {
        seed: options.expand.seed,
        parameters: options.parameters.clone(),
        ..Provenance::default()
    };
    given.with_files(sources.iter().copied().chain(included))
}
