//! The walls of a ring during a stroke: lists of pieces and directions. The edits of the file are determined at the
//! end.

use super::refuse;
use crate::stroke::sheet::{Cell, Form, Inner, SheetRow, What};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_ir::building::Ring;
use std::collections::BTreeMap;

/// A piece of a wall during a stroke.
#[derive(Clone, Debug)]
pub(super) struct DraftPiece {
    /// The cell and the wall it comes from; `None` = it is new.
    pub(super) old: Option<(usize, usize)>,
    /// Number of rounds of a `repeat`; 1 otherwise.
    pub(super) count: u32,
    /// Its code.
    pub(super) code: String,
    /// The kind of content it produces.
    pub(super) what: What,
    /// Its total width, U.
    pub(super) width: f64,
    /// True if it replaces the part of an existing cell.
    pub(super) instead: bool,
    /// The parts of one round of a `repeat`.
    pub(super) inner: Vec<DraftPiece>,
}

impl DraftPiece {
    /// Creates a part of this many units.
    pub(super) fn new(code: &str, what: What, width: f64) -> DraftPiece {
        DraftPiece {
            old: None,
            count: 1,
            code: code.to_owned(),
            what,
            width,
            instead: false,
            inner: vec![],
        }
    }

    fn of(wall: usize, index: usize, cell: &Cell) -> DraftPiece {
        DraftPiece {
            old: Some((wall, index)),
            count: if let Form::Run(_, count) = cell.form {
                count
            } else {
                1
            },
            code: cell.code.clone(),
            what: cell.what,
            width: cell.width,
            instead: false,
            inner: cell.inner.iter().map(inner).collect(),
        }
    }

    /// Returns the width of one of its parts.
    fn one(&self) -> f64 {
        self.width / f64::from(self.count.max(1))
    }

    /// Returns the piece with one of its rounds written out, and the index at which the parts of that round begin; a
    /// repeat of a single part keeps one of them as a piece of its own.
    pub(super) fn unrolled(&self, round: u32) -> (Vec<DraftPiece>, usize) {
        let round = round.min(self.count.saturating_sub(1));
        let middle = match self.inner.is_empty() {
            true => vec![self.times(1)],
            false => self.inner.clone(),
        };
        let ends = [
            self.times(round),
            self.times(self.count.saturating_sub(round + 1)),
        ];
        let [before, after] = ends.map(|p| Some(p).filter(|p| p.count > 0));
        let at = usize::from(before.is_some());
        (before.into_iter().chain(middle).chain(after).collect(), at)
    }

    /// Returns true for a `repeat` of several parts.
    pub(super) fn is_pattern(&self) -> bool {
        !self.inner.is_empty()
    }

    /// Returns the piece with this many of its parts.
    pub(super) fn times(&self, count: u32) -> DraftPiece {
        DraftPiece {
            count,
            width: self.one() * f64::from(count),
            ..self.clone()
        }
    }
}

fn inner(part: &Inner) -> DraftPiece {
    DraftPiece::new(&part.code, part.what, part.width)
}

/// A wall during a stroke.
#[derive(Clone, Debug)]
pub(super) struct DraftLine {
    /// The wall whose line of the file it keeps.
    pub(super) base: Option<usize>,
    /// Its direction.
    pub(super) direction: DVec2,
    /// In the order of the file: from its right end, or from its left one if that runs rightwards.
    pub(super) pieces: Vec<DraftPiece>,
}

impl DraftLine {
    /// Returns its length, U.
    pub(super) fn length(&self) -> f64 {
        self.pieces.iter().map(|p| p.width).sum()
    }
}

/// A ring during a stroke.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    /// The start of its walk.
    pub(super) start: DVec2,
    /// Its walls.
    pub(super) lines: Vec<DraftLine>,
    /// True if its walls are written against the walk.
    rightwards: bool,
    /// The plain wall of each existing wall.
    plain: Vec<String>,
}

/// The end of a wall.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// The end where the walk arrives.
    Start,
    /// The end where the walk leaves.
    Finish,
}

impl End {
    /// Returns the end of a wall's source that corresponds to this one.
    fn written(self, rightwards: bool) -> End {
        match (self, rightwards) {
            (End::Start, true) => End::Finish,
            (End::Finish, true) => End::Start,
            (end, false) => end,
        }
    }
}

/// The default wall.
pub(super) const PLAIN: &str = "KSK";

impl Draft {
    /// Creates the draft of a ring as it is.
    pub(super) fn of(ring: &Ring, rows: &[SheetRow]) -> Draft {
        let line =
            |(index, (wall, row)): (usize, (&hsd_ir::building::Wall, &SheetRow))| DraftLine {
                base: Some(index),
                direction: wall.direction,
                pieces: pieces(index, row),
            };
        let lines: Vec<DraftLine> = ring.walls.iter().zip(rows).enumerate().map(line).collect();
        let all = lines.iter().flat_map(|l| &l.pieces);
        let usual = most(all).unwrap_or_else(|| PLAIN.to_owned());
        let plain = |l: &DraftLine| most(l.pieces.iter()).unwrap_or_else(|| usual.clone());
        Draft {
            start: ring.walls.first().map_or(DVec2::ZERO, |w| w.from),
            plain: lines.iter().map(plain).collect(),
            rightwards: rows.iter().any(|r| r.rightwards),
            lines,
        }
    }

    /// Returns the corners, the first at the start.
    pub(super) fn corners(&self) -> Vec<DVec2> {
        let mut at = self.start;
        let step = |line: &DraftLine| {
            let from = at;
            at += line.direction * line.length();
            from
        };
        self.lines.iter().map(step).collect()
    }

    /// Returns this many units of the plain wall of a line.
    pub(super) fn plain(&self, line: usize, width: f64) -> Result<Vec<DraftPiece>, Text> {
        let own = self.lines[line].base.and_then(|b| self.plain.get(b));
        let code = own.map_or(PLAIN, |c| c.as_str());
        plain(code, width)
    }

    /// Extends a wall at one end.
    pub(super) fn grow(&mut self, line: usize, end: End, by: f64) -> Result<(), Text> {
        let end = end.written(self.rightwards);
        let own = &self.lines[line].pieces;
        // Posts stay at the corner.
        let posts = |p: &&DraftPiece| p.what == What::Post && p.old.is_some();
        let at = match end {
            End::Start => own.iter().take_while(posts).count(),
            End::Finish => own.len() - own.iter().rev().take_while(posts).count(),
        };
        let beside = match end {
            End::Start => own.get(at),
            End::Finish => at.checked_sub(1).and_then(|i| own.get(i)),
        };
        // The count of a repetition of plain wall is increased.
        let whole = (by - by.round()).abs() < SAME;
        if let Some(run) = beside.filter(|p| whole && is_run(p)) {
            let more = run.times(run.count + by.round() as u32);
            let index = if end == End::Start { at } else { at - 1 };
            self.lines[line].pieces[index] = more;
            return Ok(());
        }
        let new = self.plain(line, by)?;
        self.lines[line].pieces.splice(at..at, new);
        Ok(())
    }

    /// Shortens a wall at one end: plain wall is removed first, then the rest, nearest to the corner first.
    pub(super) fn shrink(&mut self, line: usize, end: End, by: f64) -> Result<(), Text> {
        let at = end.written(self.rightwards);
        let spare = [What::Plain, What::Void];
        let all = [What::Plain, What::Void, What::Other];
        let mut left = self.take(line, at, by, &spare);
        // The last round of a repetition is written out, so that its parts are removed rather than single ones.
        while left > SAME && self.unroll(line, at) {
            left = self.take(line, at, left, &all);
        }
        left = self.take(line, at, left, &all);
        if left > SAME {
            return Err(refuse::no_room());
        }
        // A wide part was removed: the surplus is filled with plain wall.
        if left < -SAME {
            self.grow(line, end, -left)?;
        }
        Ok(())
    }

    /// Writes out the round of a repetition that is nearest to one end, if there is any.
    fn unroll(&mut self, line: usize, end: End) -> bool {
        let pieces = &mut self.lines[line].pieces;
        let found = match end {
            End::Start => pieces.iter().position(DraftPiece::is_pattern),
            End::Finish => pieces.iter().rposition(DraftPiece::is_pattern),
        };
        let Some(index) = found else { return false };
        let round = if end == End::Start { 0 } else { u32::MAX };
        let (parts, _) = pieces[index].unrolled(round);
        pieces.splice(index..=index, parts);
        true
    }

    /// Removes this many units at one end, of the first kind as long as there are some; returns the number left to
    /// remove.
    fn take(&mut self, line: usize, end: End, by: f64, kinds: &[What]) -> f64 {
        let mut left = by;
        for &what in kinds {
            while left > SAME {
                let pieces = &mut self.lines[line].pieces;
                let fits = |p: &DraftPiece| p.what == what && p.width > 0.0 && is_free(p);
                let found = match end {
                    End::Start => pieces.iter().position(fits),
                    End::Finish => pieces.iter().rposition(fits),
                };
                let Some(index) = found else { break };
                let piece = pieces[index].clone();
                let gone = ((left + SAME) / piece.one()).floor().max(1.0);
                let gone = (gone as u32).min(piece.count);
                left -= piece.one() * f64::from(gone);
                match piece.count - gone {
                    0 => drop(pieces.remove(index)),
                    rest => pieces[index] = piece.times(rest),
                }
            }
        }
        left
    }

    /// Divides a wall at a distance from its start; the second half is returned.
    pub(super) fn cut(&mut self, line: usize, at: f64) -> Result<Vec<DraftPiece>, Text> {
        let pieces = std::mem::take(&mut self.lines[line].pieces);
        let (first, second) = parted(pieces, at)?;
        self.lines[line].pieces = first;
        Ok(second)
    }
}

/// Divides pieces at a position.
fn parted(pieces: Vec<DraftPiece>, at: f64) -> Result<(Vec<DraftPiece>, Vec<DraftPiece>), Text> {
    let (mut first, mut second, mut place) = (vec![], vec![], 0.0);
    for piece in pieces {
        let (from, to) = (place, place + piece.width);
        place = to;
        if to < at + SAME {
            first.push(piece);
        } else if from > at - SAME {
            second.push(piece);
        } else {
            let (before, after) = divide(&piece, at - from)?;
            first.extend(before);
            second.extend(after);
        }
    }
    Ok((first, second))
}

/// Returns plain wall of whole units, or of a half.
pub(super) fn plain(code: &str, width: f64) -> Result<Vec<DraftPiece>, Text> {
    let whole = width.round();
    if (width - whole).abs() > SAME {
        return Err(refuse::half_units());
    }
    if whole > 10_000.0 {
        return Err(refuse::too_far());
    }
    let one = DraftPiece::new(code, What::Plain, 1.0);
    Ok(vec![one; whole.max(0.0) as usize])
}

/// Divides a piece of plain wall, or a repetition, in two.
fn divide(piece: &DraftPiece, at: f64) -> Result<(Vec<DraftPiece>, Vec<DraftPiece>), Text> {
    let one = piece.one();
    let times = at / one;
    if piece.count > 1 && (times - times.round()).abs() < SAME {
        let times = times.round() as u32;
        let rest = piece.times(piece.count - times);
        return Ok((vec![piece.times(times)], vec![rest]));
    }
    if piece.is_pattern() {
        let (parts, _) = piece.unrolled(times.floor().max(0.0) as u32);
        return parted(parts, at);
    }
    let code = |width: f64| plain(if one == 1.0 { &piece.code } else { PLAIN }, width);
    if piece.what == What::Plain && piece.count == 1 {
        return Ok((code(at)?, code(piece.width - at)?));
    }
    Err(refuse::through_a_part(&piece.code))
}

/// Returns the pieces of a line, without the voids that lead to its start.
fn pieces(wall: usize, row: &SheetRow) -> Vec<DraftPiece> {
    let leads = row.leads();
    let cells = row.cells.iter().enumerate().skip(leads);
    cells
        .map(|(i, cell)| DraftPiece::of(wall, i, cell))
        .collect()
}

/// Returns true if a piece may be removed.
fn is_free(piece: &DraftPiece) -> bool {
    piece.old.is_none() || !piece.code.is_empty()
}

fn is_run(piece: &DraftPiece) -> bool {
    let one = (piece.one() - 1.0).abs() < SAME;
    piece.what == What::Plain && piece.count > 1 && one
}

/// Returns the most frequent plain wall of one unit among some pieces; of equals the first.
fn most<'a>(pieces: impl Iterator<Item = &'a DraftPiece>) -> Option<String> {
    let mut counts: BTreeMap<&str, (u32, usize)> = BTreeMap::new();
    let plain = |p: &&DraftPiece| p.what == What::Plain && (p.one() - 1.0).abs() < SAME;
    for (index, piece) in pieces.filter(plain).enumerate() {
        let entry = counts.entry(&piece.code).or_insert((0, index));
        entry.0 += piece.count;
    }
    let best = counts
        .iter()
        .max_by_key(|(_, (n, at))| (*n, std::cmp::Reverse(*at)));
    best.map(|(code, _)| (*code).to_owned())
}
