//! Writes a changed ring of walls, in the form of the source file.

use super::change::Change;
use super::{legacy, refuse, xml};
use crate::format::Edit;
use crate::stroke::sheet::Home;
use hsd_base::diagnostic::Text;

/// Returns the edits that write a change: remaining lines are changed where they differ, others are added and removed.
pub(super) fn edits(change: &Change<'_>) -> Result<Vec<Edit>, Text> {
    let touched = |wall: usize| change.draft.lines.iter().any(|l| l.base == Some(wall));
    for (wall, row) in change.rows.iter().enumerate() {
        let changes = !touched(wall) || change.differs(wall);
        if let Some(reason) = row.fixed.filter(|_| changes) {
            return Err(reason.text());
        }
    }
    for (index, line) in change.draft.lines.iter().enumerate() {
        let fixed = line.base.and_then(|b| change.rows[b].fixed);
        if let Some(reason) = fixed.filter(|_| change.turn(index).is_some()) {
            return Err(reason.text());
        }
    }
    // A facade includes all its floors.
    let floors = change.rows.iter().any(|r| change.sheet.floor(r).is_some());
    let bases = change.draft.lines.iter().map(|l| l.base);
    if floors && !bases.eq((0..change.rows.len()).map(Some)) {
        return Err(refuse::other_facades());
    }
    match change.rows.first().map(|r| r.home) {
        Some(Home::Line(_)) => legacy::edits(change),
        Some(Home::Element(_)) => xml::edits(change),
        None => Err(refuse::no_such_place()),
    }
}
