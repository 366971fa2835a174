//! Towns of the workspace: each is built on a thread of its own while a page shows it.

use super::{Document, Update, Workspace};
use crate::locked::lock;
use crate::town::{BuiltTown, TownEars, TownProgress};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

/// The stack of a thread that builds a town, as much as that of the main thread.
const STACK: usize = 8 << 20;

impl Workspace {
    /// Returns the document of a number.
    pub(crate) fn numbered(&self, id: u64) -> Option<Arc<Document>> {
        let documents = lock(&self.documents);
        documents.values().find(|d| d.id == id).cloned()
    }

    /// Returns what is built under a number.
    pub(crate) fn town(&self, id: u64) -> Option<Arc<BuiltTown>> {
        let own = self.numbered(id)?;
        lock(&own.town.built).clone()
    }

    /// Builds the town of a document behind the page, if a page shows it and its inputs have changed.
    pub(super) fn start_town(&self, document: &Document) {
        let is_town = document.last().is_some_and(|snapshot| snapshot.is_town);
        let is_seen = document.viewers.load(Ordering::Acquire) > 0;
        if !is_town || !is_seen || !document.town_stale.swap(false, Ordering::AcqRel) {
            return;
        }
        let file = document.file.to_string();
        let (me, stops) = (self.me.clone(), document.town.restart());
        // A thread that cannot be had is a town that is not built; the next save tries again.
        let _ = thread::Builder::new()
            .name("hsd town".to_owned())
            .stack_size(STACK)
            .spawn(move || {
                let Some(workspace) = me.upgrade() else {
                    return;
                };
                if let Ok(document) = workspace.document(&file) {
                    workspace.build_town(&document, &stops);
                }
            });
    }

    fn build_town(&self, document: &Document, stops: &AtomicBool) {
        let ears = Ears(self, document);
        let Ok(path) = self.path(&document.file) else {
            return;
        };
        let scratch = || self.host.scratch();
        let mut made = Ok(());
        let read = self.host.read(&path, &mut |source, world, options| {
            let town = (document.id, stops);
            let options = document.options(options);
            made = document
                .town
                .build(town, (source, world, &options), &scratch, &ears);
        });
        let failed = read.and(made).is_err();
        if failed && !stops.load(Ordering::Relaxed) {
            *lock(&document.town.progress) = None;
            ears.progress(TownProgress::FAILED);
        }
    }
}

/// What the build of a town tells goes to the pages that show it.
struct Ears<'w>(&'w Workspace, &'w Document);

impl TownEars for Ears<'_> {
    fn progress(&self, progress: TownProgress) {
        let file = self.1.file.clone();
        self.0.send(Update::Town { file, progress });
    }

    fn built(&self) {
        // The text may have gone meanwhile.
        let _ = self.0.renew_and_tell(self.1);
    }
}
