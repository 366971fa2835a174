//! Roof lines that follow the walls: those that covered a whole storey still cover it, edges over a sliding wall and
//! pent roofs stay with it, and roofs at the top of a storey stay there. All others are left unchanged.

use super::WallAt;
use super::xml::plain;
use crate::format::Edit;
use crate::stroke::sheet::{Reason, Sheet};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_base::source::FileId;
use hsd_ir::ast::{RoofLine, RoofShape, StoreyKind};
use hsd_ir::building::{House, Storey};
use std::ops::Range;

/// Bounds in a plan.
#[derive(Clone, Copy)]
struct Bounds {
    low: DVec2,
    high: DVec2,
}

/// Returns the edits of roof lines for rings of storeys with new corners.
pub(super) fn follow(
    sheet: &Sheet<'_>,
    house: &House,
    moved: &[(WallAt, Vec<DVec2>)],
) -> Vec<Edit> {
    let mut edits = vec![];
    for line in &house.roofs.lines {
        let Some(owner) = owner(house, line) else {
            continue;
        };
        let rings: Vec<_> = moved.iter().filter(|m| m.0.storey == owner).collect();
        if rings.is_empty() || line.corners.span.file != FileId(0) {
            continue;
        }
        let storey = &house.storeys[owner];
        let (old, new) = (bounds(storey, &[]), bounds(storey, &rings));
        let pent = line
            .style
            .shape
            .as_ref()
            .is_some_and(|s| s.value == RoofShape::Pent);
        let corners = line.corners.value;
        let moved = moved_corners(corners, old, new, pent);
        if let Some(corners) = moved.or_else(|| along_walls(corners, storey, &rings, pent)) {
            edits.extend(rewritten(sheet, line, corners));
        }
    }
    edits
}

/// Returns the edits of roof lines whose height was the top of a storey; `top` returns the new one in shaku. A computed
/// height cannot follow, and the roof would hang in the air.
pub(super) fn raise(
    sheet: &Sheet<'_>,
    house: &House,
    top: &dyn Fn(usize) -> Option<f64>,
) -> Result<Vec<Edit>, Text> {
    let mut edits = vec![];
    for line in &house.roofs.lines {
        let Some(height) = line.height.as_ref().filter(|h| h.span.file == FileId(0)) else {
            continue;
        };
        let same = |s: &Storey| (s.z1 / SHAKU - height.value).abs() < 1e-3;
        let is_storey = |s: &Storey| s.kind == StoreyKind::Storey;
        let owner = house.storeys.iter().position(|s| is_storey(s) && same(s));
        let Some(new) = owner.and_then(top) else {
            continue;
        };
        let range = sheet.a.source.text_range(height.span);
        let old = sheet.text.get(range.clone()).unwrap_or_default();
        if old.contains('{') {
            return Err(Reason::Computed.text());
        }
        edits.push(aligned(sheet.text, range.clone(), &like(old, new)));
    }
    Ok(edits)
}

/// Formats a number with a decimal if the old one had one.
pub(super) fn like(old: &str, new: f64) -> String {
    let text = plain(new);
    if old.contains('.') && !text.contains('.') {
        text + ".0"
    } else {
        text
    }
}

/// Returns the storey to which a roof line belongs: the one whose top is nearest to its height, or the highest.
fn owner(house: &House, line: &RoofLine) -> Option<usize> {
    let storeys = house.storeys.iter().enumerate();
    let mut storeys = storeys.filter(|(_, s)| s.kind == StoreyKind::Storey);
    let off = |s: &Storey| line.height.as_ref().map(|h| (s.z1 / SHAKU - h.value).abs());
    let nearest = match line.height {
        Some(_) => storeys.min_by(|(_, s), (_, t)| {
            off(s)
                .partial_cmp(&off(t))
                .unwrap_or(std::cmp::Ordering::Equal)
        }),
        None => storeys.next_back(),
    };
    nearest.map(|(index, _)| index)
}

/// Returns the bounds of the outer walls of a storey, some of whose rings have new corners.
fn bounds(storey: &Storey, moved: &[&(WallAt, Vec<DVec2>)]) -> Bounds {
    let mut bounds = Bounds {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
    };
    for (index, ring) in storey
        .rings
        .iter()
        .enumerate()
        .filter(|(_, r)| !r.hole && !r.inner)
    {
        let new = moved.iter().find(|m| m.0.ring == index).map(|m| &m.1);
        let corners = match new {
            Some(corners) => corners.clone(),
            None => ring.walls.iter().map(|w| w.from).collect(),
        };
        for corner in corners {
            (bounds.low, bounds.high) = (bounds.low.min(corner), bounds.high.max(corner));
        }
    }
    bounds
}

/// Returns the new corners of a roof.
fn moved_corners(old: [f64; 4], was: Bounds, now: Bounds, pent: bool) -> Option<[f64; 4]> {
    let same = |a: f64, b: f64| (a - b).abs() < SAME;
    let [a0, b0, a1, b1] = old;
    // The two coordinates of an axis, and its bounds.
    let axis = |p: f64, q: f64, low: (f64, f64), high: (f64, f64)| -> Option<(f64, f64)> {
        let (least, most) = (p.min(q), p.max(q));
        let at = |x: f64| if same(x, least) { low.1 } else { high.1 };
        (same(least, low.0) && same(most, high.0)).then(|| (at(p), at(q)))
    };
    let beside = |p: f64, q: f64, low: (f64, f64), high: (f64, f64)| -> Option<(f64, f64)> {
        let shift = match (p.min(q), p.max(q)) {
            (_, most) if same(most, low.0) => low.1 - low.0,
            (least, _) if same(least, high.0) => high.1 - high.0,
            _ => return None,
        };
        Some((p + shift, q + shift))
    };
    let (x, y) = ((was.low.x, now.low.x), (was.high.x, now.high.x));
    let (v, w) = ((was.low.y, now.low.y), (was.high.y, now.high.y));
    let (a, b) = (axis(a0, a1, x, y), axis(b0, b1, v, w));
    let (a, b) = match pent {
        true => (a.or(beside(a0, a1, x, y)), b.or(beside(b0, b1, v, w))),
        false => (a, b),
    };
    let ((a0, a1), (b0, b1)) = (a?, b?);
    Some([a0, b0, a1, b1])
}

/// Returns the new corners of a roof some of whose edges lie over sliding walls.
fn along_walls(
    old: [f64; 4],
    storey: &Storey,
    moved: &[&(WallAt, Vec<DVec2>)],
    pent: bool,
) -> Option<[f64; 4]> {
    let mut new = old;
    for (at, corners) in moved {
        let walls = &storey.rings[at.ring].walls;
        if walls.len() != corners.len() {
            continue; // walls became one
        }
        let wall = &walls[at.wall];
        let shift = corners[at.wall] - wall.from;
        // The axis across the wall, and the one along it; the edges across are at `across` and `across + 2`.
        let across = usize::from(wall.direction.y.abs() < SAME);
        let along = 1 - across;
        let by = shift.to_array()[across];
        let (from, to) = (wall.from.to_array(), wall.to.to_array());
        let ends = |p: f64, q: f64| (p.min(q), p.max(q));
        let (own, edge) = (
            ends(from[along], to[along]),
            ends(old[along], old[along + 2]),
        );
        let overlap = own.1.min(edge.1) - own.0.max(edge.0);
        if overlap < (own.1 - own.0).min(edge.1 - edge.0) / 2.0 {
            continue;
        }
        let edges = [across, across + 2];
        let lies_on = |k: &usize| (old[*k] - from[across]).abs() < SAME;
        let on = edges.into_iter().filter(lies_on).count();
        for k in edges.into_iter().filter(|k| on > 0 && (pent || lies_on(k))) {
            new[k] += by;
        }
    }
    let turned = |k: usize| (old[k + 2] - old[k]) * (new[k + 2] - new[k]) <= 0.0;
    (new != old && !turned(0) && !turned(1)).then_some(new)
}

/// Returns the edits that replace the corners of a roof line.
fn rewritten(sheet: &Sheet<'_>, line: &RoofLine, corners: [f64; 4]) -> Vec<Edit> {
    let range = sheet.a.source.text_range(line.corners.span);
    let places = match super::find::element(sheet, line.span) {
        Some(element) => {
            let element = &sheet.outline.elements[element];
            let names = ["a0", "b0", "a1", "b1"].iter();
            let plain = |n: &&str| element.attribute(n).filter(|a| a.expressions.is_empty());
            names.filter_map(plain).map(|a| a.inner.clone()).collect()
        }
        None => words(sheet.text, range),
    };
    if places.len() != 4 {
        return vec![];
    }
    let old = line.corners.value;
    let changed = (0..4).filter(|i| (old[*i] - corners[*i]).abs() > SAME);
    let edit = |i: usize| {
        let written = &sheet.text[places[i].clone()];
        aligned(sheet.text, places[i].clone(), &like(written, corners[i]))
    };
    changed.map(edit).collect()
}

/// Returns the words of a range.
pub(super) fn words(text: &str, range: Range<usize>) -> Vec<Range<usize>> {
    let written = text.get(range.clone()).unwrap_or_default();
    let start = |word: &str| range.start + (word.as_ptr() as usize - written.as_ptr() as usize);
    let words = written.split_whitespace();
    words.map(|w| start(w)..start(w) + w.len()).collect()
}

/// Returns the edit of a number that keeps the end column, as far as blanks allow it.
fn aligned(text: &str, range: Range<usize>, new: &str) -> Edit {
    let blanks = text[..range.start].len() - text[..range.start].trim_end_matches(' ').len();
    let columns = text[range.clone()].chars().count();
    let wider = new.len().saturating_sub(columns);
    if blanks > wider && wider > 0 {
        return Edit {
            range: range.start - wider..range.end,
            text: new.to_owned(),
        };
    }
    let missing = if blanks > 1 {
        columns.saturating_sub(new.len())
    } else {
        0
    };
    Edit {
        range,
        text: format!("{:missing$}{new}", ""),
    }
}
