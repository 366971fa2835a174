//! What was drawn in the page, so that it can be taken back: whole texts before and after each stroke. A stroke is taken
//! back only where the text still reads as it did after it; what somebody else has written since is never lost.

use super::hall::{Hall, Room, lock};
use crate::diagnostic::Text;
use crate::ide::Analysis;
use crate::ide::format::Edit;
use crate::ide::stroke::{self, Stroke};
use crate::print;
use crate::source::Source;
use crate::text;
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
                drawn = Some(edits.map(|edits| edited(&read.source, &edits)));
            }
        })?;
        let after = match drawn {
            Some(Ok(after)) => after,
            Some(Err(why)) => return Ok(Err(why)),
            None => return Ok(Err(changed_meanwhile())),
        };
        self.desk.write(&path, &before, &after)?;
        history.note(Change { before, after });
        drop(history);
        self.changed();
        Ok(Ok(self.made(room)?.revision))
    }

    /// Takes back the last stroke, or makes it again.
    ///
    /// # Errors
    /// Where the text cannot be read or written.
    pub(super) fn step(&self, room: &Room, redo: bool) -> io::Result<Result<u64, Text>> {
        if let Err(why) = self.may_write() {
            return Ok(Err(why));
        }
        let path = self.root.join(&*room.file);
        let mut history = lock(&room.history);
        let now = self.desk.bytes(&path)?;
        let Some(Change { before, after }) = history.step(redo, &now) else {
            return Ok(Err(history.nothing(redo)));
        };
        self.desk.write(&path, &before, &after)?;
        history.stepped(redo);
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

/// A text with edits made, in the encoding that it has.
fn edited(source: &Source, edits: &[Edit]) -> Vec<u8> {
    let mut text = source.text().to_owned();
    // They are sorted, and none touches another: from the last on, those before keep their places.
    for edit in edits.iter().rev() {
        text.replace_range(edit.range.clone(), &edit.text);
    }
    print::encode(&text, source)
}

fn changed_meanwhile() -> Text {
    text!(
        "the text was changed meanwhile; look at it and draw again",
        "その間にテキストが変わりました。確かめて、もう一度描いてください"
    )
}

/// A text before and after.
#[derive(Clone, Debug)]
struct Change {
    before: Vec<u8>,
    after: Vec<u8>,
}

impl Change {
    fn back(self) -> Change {
        Change {
            before: self.after,
            after: self.before,
        }
    }
}

/// Strokes that are kept.
const KEPT: usize = 500;

/// The strokes of one file.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<Change>,
    undone: Vec<Change>,
}

impl History {
    /// Notes a stroke; what was undone before is gone.
    fn note(&mut self, change: Change) {
        if self.done.len() == KEPT {
            self.done.remove(0);
        }
        self.done.push(change);
        self.undone.clear();
    }

    /// The change that takes back the last stroke, or does it again; `None` where there is none, or the text is not as
    /// it was left.
    fn step(&self, redo: bool, now: &[u8]) -> Option<Change> {
        match redo {
            true => self.undone.last().cloned(),
            false => self.done.last().cloned().map(Change::back),
        }
        .filter(|change| change.before == now)
    }

    /// Notes that a step was made.
    fn stepped(&mut self, redo: bool) {
        let (from, to) = match redo {
            true => (&mut self.undone, &mut self.done),
            false => (&mut self.done, &mut self.undone),
        };
        to.extend(from.pop());
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
