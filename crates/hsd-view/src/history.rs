//! Undo and redo of strokes. A stroke is undone only if the text is still as the stroke left it, so that other edits are
//! never lost.

use super::fingerprint::fingerprint;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ide::stroke::{Applied, Patch, take_back};
use std::hash::Hash;

/// An undo or redo step.
#[derive(Debug)]
pub(super) struct Step {
    /// The fingerprint of the text that the step applies to.
    fingerprint: u64,
    patch: Patch,
}

impl Step {
    /// The step that reverts an edit.
    pub(super) fn of(Applied { bytes, undo }: Applied) -> Step {
        Step {
            fingerprint: fingerprint(|p| bytes.hash(p)),
            patch: undo,
        }
    }
}

/// The maximum number of undo steps.
const KEPT: usize = 500;

/// The undo and redo steps of one file.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
}

impl History {
    /// Records a stroke and clears the redo steps.
    pub(super) fn note(&mut self, step: Step) {
        if self.done.len() == KEPT {
            self.done.remove(0);
        }
        self.done.push(step);
        self.undone.clear();
    }

    /// Returns the text after undoing or redoing a stroke; `None` if there is none, or the text has changed since.
    pub(super) fn step(&self, redo: bool, now: &[u8]) -> Option<Applied> {
        let last = match redo {
            true => self.undone.last(),
            false => self.done.last(),
        };
        let fingerprint = fingerprint(|p| now.hash(p));
        let step = last.filter(|step| step.fingerprint == fingerprint)?;
        take_back(now, &step.patch)
    }

    /// Records that a step was applied, with its inverse.
    pub(super) fn stepped(&mut self, redo: bool, back: Step) {
        let (from, to) = match redo {
            true => (&mut self.undone, &mut self.done),
            false => (&mut self.done, &mut self.undone),
        };
        from.pop();
        to.push(back);
    }

    /// Returns the reason why there is no step.
    pub(super) fn nothing(&self, redo: bool) -> Text {
        match (redo, self.done.len(), self.undone.len()) {
            (false, 0, _) => text!("nothing to undo", "元に戻す操作はありません"),
            (true, _, 0) => text!("nothing to redo", "やり直す操作はありません"),
            _ => text!(
                "the source file was changed elsewhere; undo that change there first",
                "テキストがほかで変更されています。先にそちらで元に戻してください"
            ),
        }
    }
}
