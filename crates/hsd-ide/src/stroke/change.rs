//! A change of a ring of walls: its current form in the file, and the new one.

use super::draft::{Draft, DraftPiece};
use crate::format::Edit;
use crate::stroke::sheet::{Sheet, SheetRow};
use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_ir::building::Ring;

/// Number of columns of a code.
pub(super) const CELL: usize = 5;

/// A ring, its form in the file, and its new walls.
pub(super) struct Change<'a> {
    pub(super) sheet: &'a Sheet<'a>,
    pub(super) ring: &'a Ring,
    pub(super) rows: &'a [SheetRow],
    pub(super) draft: &'a Draft,
}

impl Change<'_> {
    /// Returns true if the pieces of a wall have changed, or its line is gone.
    pub(super) fn differs(&self, wall: usize) -> bool {
        let line = self.draft.lines.iter().find(|l| l.base == Some(wall));
        let Some(line) = line else { return true };
        let row = &self.rows[wall];
        let cells = row.cells.len() - row.leads();
        let same = |(index, piece): (usize, &DraftPiece)| {
            let cell = &row.cells[row.leads() + index];
            let width = (cell.width - piece.width).abs() < SAME;
            piece.old == Some((wall, row.leads() + index)) && width
        };
        cells != line.pieces.len() || !line.pieces.iter().enumerate().all(same)
    }

    /// Returns true if the start of the walk has moved.
    pub(super) fn starts_anew(&self) -> bool {
        let old = self.ring.walls.first().map_or(DVec2::ZERO, |w| w.from);
        old.distance(self.draft.start) > SAME
    }

    /// Returns the turn that a line needs at its end: `R` or `L`; none if it ends the walk, or keeps its turn and its
    /// neighbour.
    pub(super) fn turn(&self, line: usize) -> Option<&'static str> {
        let lines = &self.draft.lines;
        let next = lines.get(line + 1)?;
        let walls = &self.ring.walls;
        let as_before = lines[line].base.is_some_and(|b| {
            let was = walls.get(b + 1).map(|w| w.direction);
            let own = walls[b].direction == lines[line].direction;
            own && was == Some(next.direction)
        });
        let cross = lines[line].direction.perp_dot(next.direction);
        (!as_before).then_some(if cross > 0.0 { "R" } else { "L" })
    }

    /// Returns the source of a cell.
    pub(super) fn slice(&self, cell: (usize, usize)) -> &str {
        let range = &self.rows[cell.0].cells[cell.1].range;
        self.sheet.text.get(range.clone()).unwrap_or_default()
    }
}

/// Pads a code to its columns.
pub(super) fn padded(code: &str) -> String {
    let columns = |c: char| if c == '\u{3000}' { 2 } else { 1 };
    let width: usize = code.chars().map(columns).sum();
    let missing = width.next_multiple_of(CELL).max(CELL) - width;
    format!("{code}{:missing$}", "")
}

/// Sorts edits and merges adjacent ones.
pub(super) fn tidy(mut edits: Vec<Edit>) -> Vec<Edit> {
    edits.retain(|e| !e.range.is_empty() || !e.text.is_empty());
    edits.sort_by_key(|e| (e.range.start, e.range.end));
    let mut tidy: Vec<Edit> = Vec::with_capacity(edits.len());
    for edit in edits {
        match tidy.last_mut() {
            Some(last) if edit.range.start <= last.range.end => {
                last.range.end = last.range.end.max(edit.range.end);
                last.text += &edit.text;
            }
            _ => tidy.push(edit),
        }
    }
    tidy
}
