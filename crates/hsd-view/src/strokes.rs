//! Edits drawn in the page.

use super::history::Step;
use super::locked::lock;
use super::workspace::{Document, Workspace};
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ide::Analysis;
use hsd_ide::stroke::{self, Stroke, apply};
use std::io;

impl Workspace {
    /// Applies a stroke drawn on the plan of a revision. Returns the new revision, or the reason why the stroke is refused.
    ///
    /// # Errors
    /// If the source file cannot be read or written.
    pub(super) fn stroke(
        &self,
        document: &Document,
        revision: u64,
        stroke: &Stroke,
    ) -> io::Result<Result<u64, Text>> {
        self.drawn(document, revision, stroke).or_else(in_words)
    }

    fn drawn(
        &self,
        document: &Document,
        revision: u64,
        stroke: &Stroke,
    ) -> io::Result<Result<u64, Text>> {
        if let Err(why) = self.may_write() {
            return Ok(Err(why));
        }
        let path = self.path(&document.file)?;
        let mut history = lock(&document.history);
        let before = self.host.bytes(&path)?;
        let snapshot = self.snapshot(document)?;
        let mut drawn = None;
        self.host.read(&path, &mut |source, world, options| {
            let shown = snapshot
                .sources
                .first()
                .is_some_and(|s| s.text() == source.text());
            if snapshot.revision == revision && shown {
                let read = Analysis::new(source, world, &document.options(options));
                let edits = stroke::edits(&read, stroke);
                drawn = Some(edits.map(|edits| apply(&read.source, &before, &edits)));
            }
        })?;
        let applied = match drawn {
            Some(Ok(applied)) => applied,
            Some(Err(why)) => return Ok(Err(why)),
            None => return Ok(Err(changed_meanwhile())),
        };
        self.host.write(&path, &before, &applied.bytes)?;
        history.note(Step::of(applied));
        drop(history);
        self.changed();
        Ok(Ok(self.snapshot(document)?.revision))
    }

    /// Undoes or redoes a stroke. Returns the new revision, or the reason why there is nothing to undo or redo.
    ///
    /// # Errors
    /// If the source file cannot be read or written.
    pub(super) fn step(&self, document: &Document, redo: bool) -> io::Result<Result<u64, Text>> {
        self.stepped(document, redo).or_else(in_words)
    }

    fn stepped(&self, document: &Document, redo: bool) -> io::Result<Result<u64, Text>> {
        if let Err(why) = self.may_write() {
            return Ok(Err(why));
        }
        let path = self.path(&document.file)?;
        let mut history = lock(&document.history);
        let now = self.host.bytes(&path)?;
        let Some(applied) = history.step(redo, &now) else {
            return Ok(Err(history.nothing(redo)));
        };
        self.host.write(&path, &now, &applied.bytes)?;
        history.stepped(redo, Step::of(applied));
        drop(history);
        self.changed();
        Ok(Ok(self.snapshot(document)?.revision))
    }

    fn may_write(&self) -> Result<(), Text> {
        match self.host.writes() {
            true => Ok(()),
            false => Err(text!(
                "editing is disabled; start `hsd view` without --read-only",
                "編集は無効です。--read-only なしで `hsd view` を起動してください"
            )),
        }
    }
}

/// Turns errors that the author can resolve into messages.
fn in_words(error: io::Error) -> io::Result<Result<u64, Text>> {
    match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Ok(Err(text!(
            "no permission to write to the file or its folder",
            "ファイルまたはフォルダーへの書き込みが許可されていません"
        ))),
        io::ErrorKind::NotFound => Ok(Err(text!(
            "the file no longer exists",
            "ファイルがなくなっています"
        ))),
        _ => Err(error),
    }
}

fn changed_meanwhile() -> Text {
    text!(
        "the source file has changed; check it and draw again",
        "テキストが変更されています。確かめて、もう一度描いてください"
    )
}
