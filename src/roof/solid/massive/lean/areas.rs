//! Areas of a plan, each some convex ones less others, by their borders.
//!
//! No area is ever divided. A border runs along the edges of the convex parts, and an edge belongs to it wherever its
//! two sides differ: the places a hair to its left and to its right are looked at in all other parts. Each of these is
//! convex, so that the answer for the whole edge is one span of it, whose ends are exact crossings of lines.

use crate::geometry::tolerance::SLIVER;
use crate::roof::facet::{Convex, Corner, HalfPlane, Sides, area};
use crate::roof::solid::massive::lean::corners::WELD;
use glam::DVec2;
use smallvec::SmallVec;

/// How far beside an edge its sides are looked at, metres.
const BESIDE: f64 = WELD;

/// A convex part of a plan.
#[derive(Clone)]
pub(super) struct Area {
    /// The start of each side, in their order.
    corners: SmallVec<[DVec2; 6]>,
    sides: Sides,
    lo: DVec2,
    hi: DVec2,
}

/// An area: some convex ones less others.
pub(super) struct Region<'a> {
    pub(super) with: &'a [&'a Area],
    pub(super) without: &'a [Area],
}

/// From and to.
pub(super) type Line = (DVec2, DVec2);

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
        let mut area = Area {
            corners: SmallVec::new(),
            sides: Sides::new(),
            lo: DVec2::MAX,
            hi: DVec2::MIN,
        };
        for (n, corner) in outline.iter().enumerate() {
            let (at, next) = (corner.at, outline.get(n + 1).unwrap_or(&outline[0]).at);
            if let Some(side) = HalfPlane::left_of(at, next) {
                area.corners.push(at);
                area.sides.push(side);
                (area.lo, area.hi) = (area.lo.min(at), area.hi.max(at));
            }
        }
        Some(area)
    }

    /// Returns true if the bounds of two areas overlap or touch.
    pub(super) fn is_near(&self, other: &Area) -> bool {
        self.spans_to(other.lo, other.hi)
    }

    /// Returns what two areas have in common.
    pub(super) fn common(&self, other: &[Corner]) -> Convex {
        let whole = Convex::from_slice(other);
        self.sides.iter().fold(whole, |rest, side| {
            let [inside, _] = side.halves(&rest);
            inside
        })
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
            let (a, b) = (side.depth(from), side.depth(to));
            let beside = side.inward().dot(by);
            let (p, q) = (a + beside > 0.0, b + beside > 0.0);
            if !p && !q {
                return None;
            }
            if p != q {
                // Whether it crosses is seen beside the edge, where it does so on the edge itself.
                let at = (a / (a - b)).clamp(0.0, 1.0);
                match p {
                    true => span[1] = span[1].min(at),
                    false => span[0] = span[0].max(at),
                }
            }
        }
        (span[0] < span[1]).then_some(span)
    }

    /// Takes away the parts of an edge whose left side, or right side, lies in this area.
    fn take(&self, edge: &Edge, left: bool, spans: &mut Spans) {
        if spans.is_empty() {
            return;
        }
        if let Some(part) = self.beside(edge, left) {
            take(spans, part);
        }
    }

    fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let corners = &self.corners[..];
        let sides = self.sides.iter().enumerate();
        sides.map(move |(n, side)| Edge {
            from: corners[n],
            to: *corners.get(n + 1).unwrap_or(&corners[0]),
            left: side.inward() * BESIDE,
        })
    }
}

impl Edge {
    fn new(from: DVec2, to: DVec2) -> Edge {
        let left = (to - from).perp().normalize_or_zero() * BESIDE;
        Edge { from, to, left }
    }

    /// Adds some parts of the edge with length, backwards if asked.
    fn pass(&self, spans: &Spans, backwards: bool, lines: &mut Vec<Line>) {
        let at = |t: f64| match t {
            0.0 => self.from,
            1.0 => self.to,
            t => self.from.lerp(self.to, t),
        };
        for [p, q] in spans {
            let (p, q) = (at(*p), at(*q));
            match (p.distance(q) < BESIDE, backwards) {
                (true, _) => {}
                (false, false) => lines.push((p, q)),
                (false, true) => lines.push((q, p)),
            }
        }
    }
}

impl Region<'_> {
    /// Adds the border, from and to, with the area on the left.
    pub(super) fn border(&self, lines: &mut Vec<Line>) {
        for (n, part) in self.with.iter().enumerate() {
            for edge in part.edges() {
                let mut spans = whole();
                for (k, other) in self.with.iter().enumerate().filter(|(k, _)| *k != n) {
                    other.take(&edge, false, &mut spans);
                    // Of edges upon each other the first counts.
                    if k < n {
                        other.take(&edge, true, &mut spans);
                    }
                }
                for other in self.without {
                    other.take(&edge, true, &mut spans);
                }
                edge.pass(&spans, false, lines);
            }
        }
        self.inner(
            &self.without.iter().collect::<SmallVec<[&Area; 16]>>(),
            0,
            lines,
        );
    }

    /// Adds the border of what more areas leave of it, which has this border without them.
    pub(super) fn less(&self, border: &[Line], more: &[&Area], lines: &mut Vec<Line>) {
        for (from, to) in border {
            let edge = Edge::new(*from, *to);
            let mut spans = whole();
            for other in more {
                other.take(&edge, true, &mut spans);
            }
            edge.pass(&spans, false, lines);
        }
        let without = self.without.iter().chain(more.iter().copied());
        let without: SmallVec<[&Area; 16]> = without.collect();
        self.inner(&without, self.without.len(), lines);
    }

    /// Adds the border along the areas that are taken away, from one of them on.
    fn inner(&self, without: &[&Area], from: usize, lines: &mut Vec<Line>) {
        for (n, part) in without.iter().enumerate().skip(from) {
            for edge in part.edges() {
                // Its own part ends here where the others go on to both sides.
                let mut spans = self.beside(&edge, false);
                if !spans.is_empty() {
                    spans = both(&spans, &self.beside(&edge, true));
                }
                for (k, other) in without.iter().enumerate().filter(|(k, _)| *k != n) {
                    if spans.is_empty() {
                        break;
                    }
                    other.take(&edge, false, &mut spans);
                    if k < n {
                        other.take(&edge, true, &mut spans);
                    }
                }
                edge.pass(&spans, true, lines);
            }
        }
    }

    /// Returns the parts of an edge whose left side, or right side, lies in one of the parts that are added.
    fn beside(&self, edge: &Edge, left: bool) -> Spans {
        let mut spans = Spans::new();
        for span in self.with.iter().filter_map(|w| w.beside(edge, left)) {
            let at = spans.iter().position(|s| span[0] < s[0]);
            spans.insert(at.unwrap_or(spans.len()), span);
        }
        spans.dedup_by(|next, last| {
            let meet = next[0] <= last[1];
            if meet {
                last[1] = last[1].max(next[1]);
            }
            meet
        });
        spans
    }
}

fn whole() -> Spans {
    let mut spans = Spans::new();
    spans.push([0.0, 1.0]);
    spans
}

/// Takes a part away from some.
fn take(spans: &mut Spans, [from, to]: [f64; 2]) {
    let mut n = 0;
    while n < spans.len() {
        let [p, q] = spans[n];
        match (p < from, q > to) {
            _ if q <= from || p >= to => {}
            (true, true) => {
                spans[n] = [p, from];
                spans.insert(n + 1, [to, q]);
                return;
            }
            (true, false) => spans[n] = [p, from],
            (false, true) => spans[n] = [to, q],
            (false, false) => {
                spans.remove(n);
                continue;
            }
        }
        n += 1;
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
        let all: Vec<Area> = without.iter().map(|a| (*a).clone()).collect();
        let twice = |lines: &[Line]| lines.iter().map(|(p, q)| p.perp_dot(*q)).sum::<f64>();
        let length = |lines: &[Line]| lines.iter().map(|(p, q)| p.distance(*q)).sum::<f64>();
        let region = |without| Region { with, without };
        let (mut lines, mut base, mut less) = (vec![], vec![], vec![]);
        region(&all).border(&mut lines);
        // The same in two steps.
        region(&[]).border(&mut base);
        region(&[]).less(&base, without, &mut less);
        assert_eq!(
            (twice(&lines), length(&lines)),
            (twice(&less), length(&less))
        );
        (twice(&lines), length(&lines))
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
