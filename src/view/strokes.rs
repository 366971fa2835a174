//! What was drawn in the page, so that it can be taken back: whole texts before and after each stroke. A stroke is taken
//! back only where the text still reads as it did after it; what somebody else has written since is never lost.

/// A text before and after.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub(super) before: Vec<u8>,
    pub(super) after: Vec<u8>,
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
    pub(super) fn note(&mut self, change: Change) {
        if self.done.len() == KEPT {
            self.done.remove(0);
        }
        self.done.push(change);
        self.undone.clear();
    }

    /// The change that takes back the last stroke, or does it again; `None` where there is none, or the text is not as
    /// it was left.
    pub(super) fn step(&self, redo: bool, now: &[u8]) -> Option<Change> {
        match redo {
            true => self.undone.last().cloned(),
            false => self.done.last().cloned().map(Change::back),
        }
        .filter(|change| change.before == now)
    }

    /// Notes that a step was made.
    pub(super) fn stepped(&mut self, redo: bool) {
        let (from, to) = match redo {
            true => (&mut self.undone, &mut self.done),
            false => (&mut self.done, &mut self.undone),
        };
        to.extend(from.pop());
    }

    /// How many strokes can be taken back, and how many done again.
    pub(super) fn depth(&self) -> (usize, usize) {
        (self.done.len(), self.undone.len())
    }
}
