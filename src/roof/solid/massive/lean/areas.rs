//! Areas of a plan, each some convex ones less others, by their borders.
//!
//! No area is ever divided. A border runs along the edges of the convex parts, and an edge belongs to it wherever its
//! two sides differ: the places a hair to its left and to its right are looked at in all other parts. Each of these is
//! convex, so that the answer for the whole edge is one span of it, whose ends are exact crossings of lines.

use crate::geometry::tolerance::SLIVER;
use crate::roof::facet::{Corner, Sides, area, sides_of};
use crate::roof::solid::massive::lean::plan::WELD;
use glam::DVec2;
use smallvec::SmallVec;

/// How far beside an edge its sides are looked at, metres.
const BESIDE: f64 = WELD;

/// A convex part of a plan.
pub(super) struct Area {
    corners: SmallVec<[DVec2; 6]>,
    sides: Sides,
    lo: DVec2,
    hi: DVec2,
}

/// An area: some convex ones less others.
#[derive(Default)]
pub(super) struct Region<'a> {
    pub(super) with: SmallVec<[&'a Area; 4]>,
    pub(super) without: SmallVec<[&'a Area; 8]>,
}

/// Parts of an edge, from 0 at its start to 1 at its end, in order.
type Spans = SmallVec<[[f64; 2]; 4]>;

/// An edge, and a hair to its left.
#[derive(Clone, Copy)]
struct Edge {
    from: DVec2,
    to: DVec2,
    left: DVec2,
}

impl Area {
    /// Returns the area of a convex outline; none of a sliver.
    pub(super) fn of(outline: &[Corner]) -> Option<Area> {
        if area(outline) < SLIVER {
            return None;
        }
        let corners: SmallVec<[DVec2; 6]> = outline.iter().map(|c| c.at).collect();
        let none = (DVec2::MAX, DVec2::MIN);
        let (lo, hi) = corners
            .iter()
            .fold(none, |(lo, hi), c| (lo.min(*c), hi.max(*c)));
        Some(Area {
            corners,
            sides: sides_of(outline),
            lo,
            hi,
        })
    }

    /// Returns true if the bounds of two areas touch.
    pub(super) fn is_near(&self, other: &Area) -> bool {
        self.spans_to(other.lo, other.hi)
    }

    fn spans_to(&self, lo: DVec2, hi: DVec2) -> bool {
        (self.lo - BESIDE).cmple(hi).all() && (lo - BESIDE).cmple(self.hi).all()
    }

    /// Returns the part of an edge whose left side, or right side, lies in this area.
    fn beside(&self, edge: &Edge, left: bool) -> Option<[f64; 2]> {
        let Edge { from, to, .. } = *edge;
        if !self.spans_to(from.min(to), from.max(to)) {
            return None;
        }
        let by = if left { edge.left } else { -edge.left };
        let mut span = [0.0_f64, 1.0];
        for side in &self.sides {
            let [p, q] = [from, to].map(|end| side.depth(end + by) > 0.0);
            if !p && !q {
                return None;
            }
            if p != q {
                // Whether it crosses is seen beside the edge, where it does so on the edge itself.
                let (a, b) = (side.depth(from), side.depth(to));
                let at = (a / (a - b)).clamp(0.0, 1.0);
                match p {
                    true => span[1] = span[1].min(at),
                    false => span[0] = span[0].max(at),
                }
            }
        }
        (span[0] < span[1]).then_some(span)
    }

    fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(from, to)| Edge {
            from: *from,
            to: *to,
            left: (to - from).perp().normalize_or_zero() * BESIDE,
        })
    }
}

impl Edge {
    /// Passes on some parts of the edge with length, backwards if asked.
    fn pass(&self, spans: &Spans, backwards: bool, out: &mut impl FnMut(DVec2, DVec2)) {
        let at = |t: f64| match t {
            0.0 => self.from,
            1.0 => self.to,
            t => self.from.lerp(self.to, t),
        };
        for [p, q] in spans {
            let (p, q) = (at(*p), at(*q));
            match (p.distance(q) < BESIDE, backwards) {
                (true, _) => {}
                (false, false) => out(p, q),
                (false, true) => out(q, p),
            }
        }
    }
}

impl Region<'_> {
    /// Passes on the border, from and to, with the area on the left.
    pub(super) fn border(&self, mut out: impl FnMut(DVec2, DVec2)) {
        for (n, part) in self.with.iter().enumerate() {
            for edge in part.edges() {
                let mut spans: Spans = SmallVec::from_slice(&[[0.0, 1.0]]);
                for (k, other) in self.with.iter().enumerate().filter(|(k, _)| *k != n) {
                    take(&mut spans, other.beside(&edge, false));
                    // Of edges upon each other the first counts.
                    if k < n {
                        take(&mut spans, other.beside(&edge, true));
                    }
                }
                for other in &self.without {
                    take(&mut spans, other.beside(&edge, true));
                }
                edge.pass(&spans, false, &mut out);
            }
        }
        for (n, part) in self.without.iter().enumerate() {
            for edge in part.edges() {
                // Its own part ends here where the others go on to both sides.
                let mut spans = both(&self.beside(&edge, false), &self.beside(&edge, true));
                for (k, other) in self.without.iter().enumerate().filter(|(k, _)| *k != n) {
                    take(&mut spans, other.beside(&edge, false));
                    if k < n {
                        take(&mut spans, other.beside(&edge, true));
                    }
                }
                edge.pass(&spans, true, &mut out);
            }
        }
    }

    /// Returns the parts of an edge whose left side, or right side, lies in one of the parts that are added.
    fn beside(&self, edge: &Edge, left: bool) -> Spans {
        let found = self.with.iter().filter_map(|w| w.beside(edge, left));
        let mut found: Spans = found.collect();
        found.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]));
        let mut spans = Spans::new();
        for span in found {
            match spans.last_mut().filter(|last| span[0] <= last[1]) {
                Some(last) => last[1] = last[1].max(span[1]),
                None => spans.push(span),
            }
        }
        spans
    }
}

/// Takes a part away from some.
fn take(spans: &mut Spans, part: Option<[f64; 2]>) {
    let Some([from, to]) = part else { return };
    let mut n = 0;
    while n < spans.len() {
        let [p, q] = spans[n];
        if q <= from || p >= to {
            n += 1;
            continue;
        }
        spans.remove(n);
        for rest in [[to, q], [p, from]] {
            if rest[0] < rest[1] {
                spans.insert(n, rest);
            }
        }
        n += usize::from(p < from);
    }
}

/// Returns what two lists of parts have in common.
fn both(one: &Spans, other: &Spans) -> Spans {
    let common = one.iter().flat_map(|[p, q]| {
        let parts = other.iter().map(|[r, s]| [p.max(*r), q.min(*s)]);
        parts.filter(|[from, to]| from < to)
    });
    common.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn rect(x0: f64, y0: f64, x1: f64, y1: f64) -> Area {
        let corners = [dvec2(x0, y0), dvec2(x1, y0), dvec2(x1, y1), dvec2(x0, y1)];
        let outline = corners.map(|at| Corner { at, rim: true });
        Area::of(&outline).expect("is no sliver")
    }

    /// Twice the area that a border goes round, and its length.
    fn round(with: &[&Area], without: &[&Area]) -> (f64, f64) {
        let region = Region {
            with: SmallVec::from_slice(with),
            without: SmallVec::from_slice(without),
        };
        let (mut twice, mut length) = (0.0, 0.0);
        region.border(|p, q| {
            twice += p.perp_dot(q);
            length += p.distance(q);
        });
        (twice, length)
    }

    #[test]
    fn a_border_goes_once_round_what_is_left() {
        let (a, b) = (rect(0.0, 0.0, 4.0, 4.0), rect(2.0, 0.0, 6.0, 2.0));
        assert_eq!(round(&[&a, &a], &[]), (32.0, 16.0), "one upon the other");
        assert_eq!(round(&[&a, &b], &[]), (40.0, 20.0), "flush along one line");
        assert_eq!(round(&[&a], &[&b]), (24.0, 16.0), "a corner less");
        assert_eq!(round(&[&a], &[&b, &b]), (24.0, 16.0), "twice the same");
        assert_eq!(round(&[&a], &[&a]), (0.0, 0.0), "nothing left");
        let hole = rect(1.0, 1.0, 2.0, 2.0);
        assert_eq!(round(&[&a], &[&hole]), (30.0, 20.0));
        let beside = rect(4.0, 0.0, 5.0, 4.0);
        assert_eq!(round(&[&a], &[&beside]), (32.0, 16.0));
        assert_eq!(round(&[&a, &beside], &[]), (40.0, 18.0));
    }
}
