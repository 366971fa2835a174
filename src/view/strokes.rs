//! What was drawn in the page, so that it can be taken back. A stroke is taken back only where the text still reads as it
//! did after it; what somebody else has written since is never lost.

use super::hall::{Hall, Room, lock};
use super::made::print;
use crate::diagnostic::Text;
use crate::ide::Analysis;
use crate::ide::stroke::{self, Applied, Patch, Stroke, apply, take_back};
use crate::text;
use std::hash::Hash;
use std::io;

impl Hall {
    /// Makes a stroke that was drawn on the plan of a revision; returns what the text makes then, by its revision, or why
    /// it cannot be made.
    ///
    /// # Errors
    /// Where the text cannot be read or written.
    pub(super) fn stroke(
        &self,
        room: &Room,
        revision: u64,
        stroke: &Stroke,
    ) -> io::Result<Result<u64, Text>> {
        self.drawn(room, revision, stroke).or_else(in_words)
    }

    fn drawn(&self, room: &Room, revision: u64, stroke: &Stroke) -> io::Result<Result<u64, Text>> {
        if let Err(why) = self.may_write() {
            return Ok(Err(why));
        }
        let path = self.root.join(&*room.file);
        let mut history = lock(&room.history);
        let before = self.desk.bytes(&path)?;
        let made = self.made(room)?;
        let mut drawn = None;
        self.desk.read(&path, &mut |source, world, options| {
            let shown = made
                .sources
                .first()
                .is_some_and(|s| s.text() == source.text());
            if made.revision == revision && shown {
                let read = Analysis::new(source, world, options);
                let edits = stroke::edits(&read, stroke);
                drawn = Some(edits.map(|edits| apply(&read.source, &before, &edits)));
            }
        })?;
        let applied = match drawn {
            Some(Ok(applied)) => applied,
            Some(Err(why)) => return Ok(Err(why)),
            None => return Ok(Err(changed_meanwhile())),
        };
        self.desk.write(&path, &before, &applied.bytes)?;
        history.note(Step::of(applied));
        drop(history);
        self.changed();
        Ok(Ok(self.made(room)?.revision))
    }

    /// Takes back the last stroke, or makes it again.
    ///
    /// # Errors
    /// Where the text cannot be read or written.
    pub(super) fn step(&self, room: &Room, redo: bool) -> io::Result<Result<u64, Text>> {
        self.stepped(room, redo).or_else(in_words)
    }

    fn stepped(&self, room: &Room, redo: bool) -> io::Result<Result<u64, Text>> {
        if let Err(why) = self.may_write() {
            return Ok(Err(why));
        }
        let path = self.root.join(&*room.file);
        let mut history = lock(&room.history);
        let now = self.desk.bytes(&path)?;
        let Some(applied) = history.step(redo, &now) else {
            return Ok(Err(history.nothing(redo)));
        };
        self.desk.write(&path, &now, &applied.bytes)?;
        history.stepped(redo, Step::of(applied));
        drop(history);
        self.changed();
        Ok(Ok(self.made(room)?.revision))
    }

    fn may_write(&self) -> Result<(), Text> {
        match self.desk.writes() {
            true => Ok(()),
            false => Err(text!(
                "texts are not to be changed from here; start `hsd view` without --read-only",
                "ここからテキストを変えることはできません。--read-only なしで `hsd view` を起動してください"
            )),
        }
    }
}

/// What keeps a file from being changed, where an author can do something about it.
fn in_words(error: io::Error) -> io::Result<Result<u64, Text>> {
    match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Ok(Err(text!(
            "the file, or its folder, may not be written to",
            "ファイルかそのフォルダーに書き込めません"
        ))),
        io::ErrorKind::NotFound => Ok(Err(text!(
            "the file is no longer there",
            "ファイルがなくなっています"
        ))),
        _ => Err(error),
    }
}

fn changed_meanwhile() -> Text {
    text!(
        "the text was changed meanwhile; look at it and draw again",
        "その間にテキストが変わりました。確かめて、もう一度描いてください"
    )
}

/// A way back from a text, or forth again.
#[derive(Debug)]
struct Step {
    /// What is the same for the same text.
    print: u64,
    patch: Patch,
}

impl Step {
    /// The way back from a text that was just changed.
    fn of(Applied { bytes, undo }: Applied) -> Step {
        Step {
            print: print(|p| bytes.hash(p)),
            patch: undo,
        }
    }
}

/// Strokes that are kept.
const KEPT: usize = 500;

/// The strokes of one file.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
}

impl History {
    /// Notes a stroke; what was undone before is gone.
    fn note(&mut self, step: Step) {
        if self.done.len() == KEPT {
            self.done.remove(0);
        }
        self.done.push(step);
        self.undone.clear();
    }

    /// The text before the last stroke, or behind the one that was taken back last; `None` where there is none, or the text
    /// is not as it was left.
    fn step(&self, redo: bool, now: &[u8]) -> Option<Applied> {
        let last = match redo {
            true => self.undone.last(),
            false => self.done.last(),
        };
        let print = print(|p| now.hash(p));
        let step = last.filter(|step| step.print == print)?;
        take_back(now, &step.patch)
    }

    /// Notes that a step was made, and the way back from it.
    fn stepped(&mut self, redo: bool, back: Step) {
        let (from, to) = match redo {
            true => (&mut self.undone, &mut self.done),
            false => (&mut self.done, &mut self.undone),
        };
        from.pop();
        to.push(back);
    }

    /// Why there is no step.
    fn nothing(&self, redo: bool) -> Text {
        match (redo, self.done.len(), self.undone.len()) {
            (false, 0, _) => text!("there is nothing to take back", "元に戻すものがありません"),
            (true, _, 0) => text!("there is nothing to do again", "やり直すものがありません"),
            _ => text!(
                "the text was changed elsewhere since; take it back there",
                "その後テキストがほかで変更されています。そちらで元に戻してください"
            ),
        }
    }
}
