//! Pieces that share no space: where two do, the higher one takes it all, down to the lower end of both.

use crate::facet::{
    Convex, Corner, HalfPlane, Higher, Sides, area, is_outside, sides_of, split_off,
};
use crate::frame::Plane;
use crate::solid::massive::lean::pieces::{HARDLY, Piece, SLIVER, inside};
use glam::DVec2;
use hsd_base::geometry::tolerance::HEIGHT;

/// A piece with its bounds and its sides in plan.
struct Placed {
    piece: Piece,
    around: [DVec2; 2],
    sides: Sides,
}

/// Returns pieces that share no space and fill the same volume together; none if that takes too long.
pub(super) fn settle(mut todo: Vec<Piece>) -> Option<Vec<Piece>> {
    let mut patience = 8 * todo.len() + 64;
    let mut done: Vec<Placed> = Vec::with_capacity(todo.len() + 4);
    // In the order given, so that the first of two level ones counts as the higher one.
    todo.reverse();
    while let Some(piece) = todo.pop() {
        if area(&piece.outline) < SLIVER {
            continue;
        }
        let placed = Placed::of(piece);
        let met = |(n, other): (usize, &Placed)| Some((n, other.together(&placed)?));
        match done.iter().enumerate().find_map(met) {
            None => done.push(placed),
            Some((n, parts)) => {
                done.swap_remove(n);
                todo.extend(parts);
                patience = patience.checked_sub(1)?;
            }
        }
    }
    Some(done.into_iter().map(|p| p.piece).collect())
}

impl Placed {
    fn of(piece: Piece) -> Placed {
        let corners = piece.outline.iter().map(|c| c.at);
        let around = corners.fold([DVec2::MAX, DVec2::MIN], |[lo, hi], p| {
            [lo.min(p), hi.max(p)]
        });
        let sides = sides_of(&piece.outline);
        Placed {
            piece,
            around,
            sides,
        }
    }

    /// Returns the union of two pieces that share space as pieces that do not; none if they share none.
    fn together(&self, other: &Placed) -> Option<Vec<Piece>> {
        let (a, b) = (&self.around, &other.around);
        if !(a[0].cmplt(b[1]).all() && b[0].cmplt(a[1]).all())
            || is_outside(&self.piece.outline, other.sides.iter())
            || is_outside(&other.piece.outline, self.sides.iter())
        {
            return None;
        }
        let common = inside(&self.piece.outline, &other.sides);
        let (one, two) = (&self.piece, &other.piece);
        let halves = match HalfPlane::where_higher(two.top, one.top) {
            Higher::Everywhere => [Convex::new(), common],
            Higher::Nowhere => [common, Convex::new()],
            Higher::Inside(side) => {
                let [under, over] = side.halves(&common);
                [over, under]
            }
        };
        let [first, second] = halves;
        over(one, two, &first).or_else(|| over(two, one, &second))
    }
}

/// Returns the union of two pieces where they share space over a common outline, and what is left of both; none if
/// they share none there. They may share more elsewhere.
fn over(high: &Piece, low: &Piece, common: &[Corner]) -> Option<Vec<Piece>> {
    if area(common) <= HARDLY {
        return None;
    }
    let (shared, bottom) = shared(high, low, common)?;
    let mut parts = without(low, &shared);
    let lower = |plane: Plane| {
        let off = |c: &Corner| plane.at(c.at) - bottom.at(c.at);
        shared.iter().any(|c| off(c) < -HEIGHT)
    };
    if !lower(low.low()) && (low.filled.is_empty() || !lower(low.bottom)) {
        parts.push(high.clone());
        return Some(parts);
    }
    parts.extend(without(high, &shared));
    let mut open = vec![];
    let filled = match low.filled.is_empty() {
        true => None,
        false => split(&shared, &sides_of(&low.filled), &mut open),
    };
    if filled.is_none() {
        open = vec![shared];
    }
    let open = open.into_iter().map(|o| (o, low.low()));
    for (part, own) in filled.map(|f| (f, low.bottom)).into_iter().chain(open) {
        let [under, above] = match HalfPlane::where_higher(bottom, own) {
            Higher::Everywhere => [part, Convex::new()],
            Higher::Nowhere => [Convex::new(), part],
            Higher::Inside(side) => side.halves(&part),
        };
        for (outline, bottom) in [(under, own), (above, bottom)] {
            if area(&outline) > SLIVER {
                parts.push(Piece {
                    filled: Convex::from_slice(&outline),
                    outline,
                    bottom,
                    ..*high
                });
            }
        }
    }
    Some(parts)
}

/// Returns a part of a common outline over which two pieces share space, and the lower end of the higher one there.
fn shared(high: &Piece, low: &Piece, common: &[Corner]) -> Option<(Convex, Plane)> {
    let met = |outline: Convex, bottom: Plane| {
        let met = match HalfPlane::where_higher(low.top, bottom) {
            Higher::Everywhere => outline,
            Higher::Nowhere => return None,
            Higher::Inside(side) => {
                let [met, _] = side.halves(&outline);
                met
            }
        };
        let shares = area(&met) > HARDLY && !is_beneath(low.top, bottom, &met);
        shares.then_some((met, bottom))
    };
    let mut open = vec![];
    let wall = match high.filled.is_empty() {
        true => None,
        false => split(common, &sides_of(&high.filled), &mut open),
    };
    let Some(wall) = wall else {
        return met(Convex::from_slice(common), high.low());
    };
    let free = || open.into_iter().find_map(|o| met(o, high.low()));
    met(wall, high.bottom).or_else(free)
}

/// Returns a piece without a convex part of its outline.
fn without(piece: &Piece, part: &[Corner]) -> Vec<Piece> {
    let mut off = vec![];
    split(&piece.outline, &sides_of(part), &mut off);
    off.into_iter().map(|o| piece.part(o)).collect()
}

/// Returns the part of a convex outline inside some sides; the rest goes to `off`, nothing if that part is a sliver.
fn split(outline: &[Corner], sides: &[HalfPlane], off: &mut Vec<Convex>) -> Option<Convex> {
    if is_outside(outline, sides.iter()) {
        return None;
    }
    let inside = split_off(Convex::from_slice(outline), sides.iter(), off);
    let inside = inside.filter(|i| area(i) > HARDLY);
    if inside.is_none() {
        off.clear();
    }
    inside
}

/// Returns true if a plane is nowhere above another over an outline.
fn is_beneath(plane: Plane, other: Plane, outline: &[Corner]) -> bool {
    let off = |c: &Corner| plane.at(c.at) - other.at(c.at);
    outline.iter().all(|c| off(c) < HEIGHT)
}
