//! Sliding and breaking of walls.

use super::draft::{Draft, DraftLine, End};
use super::refuse;
use crate::stroke::sheet::Reason;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::{SAME, area2};
use hsd_ir::building::Storey;

/// Returns the direction outward of a wall that runs in a direction.
pub(super) fn outward(direction: DVec2) -> DVec2 {
    dvec2(direction.y, -direction.x)
}

/// The maximum distance of one move, U.
pub(super) const FARTHEST: i32 = 1000;

impl Draft {
    /// Slides a wall outward.
    pub(super) fn slide(&mut self, wall: usize, by: i32) -> Result<(), Text> {
        let shift = outward(self.lines[wall].direction) * f64::from(by);
        if wall == 0 {
            self.start += shift;
        }
        let count = self.lines.len();
        let (before, after) = ((wall + count - 1) % count, (wall + 1) % count);
        if count < 4 {
            return Err(Reason::Slanted.text());
        }
        self.stretch(before, End::Finish, shift)?;
        self.stretch(after, End::Start, -shift)?;
        // The last wall ends at the start.
        if wall + 1 == count {
            self.start += shift;
        }
        self.join(before, after)
    }

    /// Moves one end of a wall along itself.
    fn stretch(&mut self, line: usize, end: End, shift: DVec2) -> Result<(), Text> {
        let own = &self.lines[line];
        let by = shift.dot(own.direction);
        if (by.abs() - shift.length()).abs() > SAME {
            return Err(Reason::Slanted.text());
        }
        let length = own.length() + by;
        match () {
            () if length < -SAME => Err(refuse::walls_cross()),
            () if length < SAME => {
                self.lines[line].pieces.clear();
                Ok(())
            }
            () if by > 0.0 => self.grow(line, end, by),
            () => self.shrink(line, end, -by),
        }
    }

    /// Removes those of two walls that have no length left, and merges their neighbours.
    fn join(&mut self, before: usize, after: usize) -> Result<(), Text> {
        let mut gone: Vec<usize> = [before, after].into_iter().collect();
        gone.retain(|l| self.lines[*l].length() < SAME);
        gone.sort_unstable_by(|a, b| b.cmp(a));
        gone.dedup();
        for line in gone {
            self.collapse(line)?;
        }
        if self.lines.len() < 4 {
            return Err(refuse::vanishes());
        }
        Ok(())
    }

    /// Removes a wall without a length; its neighbours become one.
    fn collapse(&mut self, line: usize) -> Result<(), Text> {
        let count = self.lines.len();
        let (one, other) = ((line + count - 1) % count, (line + 1) % count);
        let (d, e) = (self.lines[one].direction, self.lines[other].direction);
        if line == 0 {
            return Err(refuse::first_wall());
        }
        if count <= 4 || d.distance(e) > SAME {
            return Err(refuse::vanishes());
        }
        if other == 0 {
            // The walk begins where the previous wall did.
            let moved = std::mem::take(&mut self.lines[one].pieces);
            let length: f64 = moved.iter().map(|p| p.width).sum();
            self.start -= e * length;
            self.lines[0].pieces.splice(0..0, moved);
            self.lines.truncate(count - 2);
            return Ok(());
        }
        let moved = std::mem::take(&mut self.lines[other].pieces);
        self.lines[one].pieces.extend(moved);
        self.lines.drain(line..=other);
        Ok(())
    }

    /// Pushes the part of a wall between two distances from its start outward.
    pub(super) fn break_out(
        &mut self,
        wall: usize,
        from: f64,
        to: f64,
        by: i32,
    ) -> Result<(), Text> {
        let length = self.lines[wall].length();
        if from < -SAME || to > length + SAME || to - from < SAME {
            return Err(refuse::no_such_part(length));
        }
        let (whole_start, whole_end) = (from < SAME, to > length - SAME);
        if whole_start && whole_end {
            return self.slide(wall, by);
        }
        let direction = self.lines[wall].direction;
        let shift = outward(direction) * f64::from(by);
        let rest = if whole_end {
            vec![]
        } else {
            self.cut(wall, to)?
        };
        let middle = if whole_start {
            None
        } else {
            Some(self.cut(wall, from)?)
        };
        let side = |draft: &Draft, way: DVec2| -> Result<DraftLine, Text> {
            Ok(DraftLine {
                base: None,
                direction: way,
                pieces: draft.plain(wall, f64::from(by.abs()))?,
            })
        };
        let way = shift / f64::from(by.abs());
        let (up, down) = (side(self, way)?, side(self, -way)?);
        let bare = |pieces| DraftLine {
            base: None,
            direction,
            pieces,
        };
        let mut new = vec![];
        if let Some(middle) = middle {
            new.extend([up, bare(middle)]);
        }
        if !whole_end {
            new.extend([down, bare(rest)]);
        }
        let last = wall + new.len();
        self.lines.splice(wall + 1..wall + 1, new);
        match (whole_start, whole_end) {
            (true, _) => self.lengthen_before(wall, shift),
            (_, true) => self.lengthen_after(last, shift),
            _ => Ok(()),
        }
    }

    /// Extends the wall before a part that is pushed out from its very start.
    fn lengthen_before(&mut self, wall: usize, shift: DVec2) -> Result<(), Text> {
        let count = self.lines.len();
        let before = (wall + count - 1) % count;
        if wall == 0 {
            self.start += shift;
        }
        self.stretch(before, End::Finish, shift)?;
        self.join(before, before)
    }

    /// Moves the start of the wall after a part that is pushed out to its very end.
    fn lengthen_after(&mut self, wall: usize, shift: DVec2) -> Result<(), Text> {
        let after = (wall + 1) % self.lines.len();
        self.stretch(after, End::Start, -shift)?;
        if after == 0 {
            self.start += shift;
        }
        self.join(after, after)
    }

    /// Refuses walls that cross or touch others of the storey, or that move a court to the other side.
    pub(super) fn check(&self, ring: usize, storey: &Storey) -> Result<(), Text> {
        let corners = self.corners();
        let old = storey.rings[ring].corners();
        if area2(&corners) * area2(&old) <= 0.0 {
            return Err(refuse::walls_cross());
        }
        let count = corners.len();
        let edge = |i: usize| (corners[i], corners[(i + 1) % count]);
        let was: Vec<(DVec2, DVec2)> = storey.rings[ring]
            .walls
            .iter()
            .map(|w| (w.from, w.to))
            .collect();
        let same = |i: usize| {
            let base = self.lines[i].base.and_then(|b| was.get(b));
            base.is_some_and(|w| w.0.distance(edge(i).0) < SAME && w.1.distance(edge(i).1) < SAME)
        };
        for i in (0..count).filter(|i| !same(*i)) {
            for j in 0..count {
                let apart = (i + count - j) % count;
                if apart > 1 && apart < count - 1 && meet(edge(i), edge(j)) {
                    return Err(refuse::walls_cross());
                }
            }
            for other in others(storey, ring) {
                if other.walls.iter().any(|w| meet(edge(i), (w.from, w.to))) {
                    return Err(refuse::walls_cross());
                }
            }
        }
        for other in others(storey, ring) {
            let point = other.walls.first().map_or(DVec2::ZERO, |w| w.from);
            if inside(&corners, point) != inside(&old, point) {
                return Err(refuse::walls_cross());
            }
        }
        Ok(())
    }
}

/// Returns the other closed rings of a storey.
fn others(storey: &Storey, ring: usize) -> impl Iterator<Item = &hsd_ir::building::Ring> {
    let all = storey.rings.iter().enumerate();
    all.filter(move |(i, r)| *i != ring && r.closed)
        .map(|(_, r)| r)
}

/// Returns true if two segments have a point in common.
fn meet(one: (DVec2, DVec2), other: (DVec2, DVec2)) -> bool {
    let (p, q) = one;
    let (r, s) = other;
    let apart = p.max(q).cmplt(r.min(s) - SAME).any() || r.max(s).cmplt(p.min(q) - SAME).any();
    let side = |a: DVec2, b: DVec2, c: DVec2| {
        let area = (b - a).perp_dot(c - a);
        if area.abs() < SAME {
            0.0
        } else {
            area.signum()
        }
    };
    !apart && side(p, q, r) * side(p, q, s) <= 0.0 && side(r, s, p) * side(r, s, q) <= 0.0
}

/// Returns true if a point lies inside a polygon.
pub(super) fn inside(corners: &[DVec2], p: DVec2) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(next).filter(|(a, b)| {
        let spans = (a.y > p.y) != (b.y > p.y);
        spans && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}
