//! Areas of a plan, each some convex ones less others, by their borders.
//!
//! No area is ever divided. A border runs along the edges of the convex parts, and an edge belongs to it wherever its
//! two sides differ: the places a hair to its left and to its right are looked at in all other parts. Each of these is
//! convex, so that the answer for the whole edge is one span of it, whose ends are exact crossings of lines.

use crate::facet::{Convex, Corner, HalfPlane, area};
use crate::solid::massive::lean::corners::WELD;
use glam::DVec2;
use hsd_base::geometry::tolerance::SLIVER;
use smallvec::SmallVec;

/// How far beside an edge its sides are looked at, metres.
const BESIDE: f64 = WELD;

/// The convex parts of a plan. Roofs have dozens of them, so their sides lie one after another.
#[derive(Default)]
pub(super) struct Plan {
    /// Where each side of each area starts.
    corners: Vec<DVec2>,
    sides: Vec<HalfPlane>,
}

/// A convex part of a plan: its sides there, and its bounds.
#[derive(Clone, Copy)]
pub(super) struct Area {
    first: u32,
    end: u32,
    lo: DVec2,
    hi: DVec2,
}

/// An area: some convex ones less others.
#[derive(Clone, Copy)]
pub(super) struct Region<'a> {
    pub(super) plan: &'a Plan,
    pub(super) with: &'a [Area],
    pub(super) without: &'a [Area],
}

/// From and to.
pub(super) type Line = [DVec2; 2];

/// Lists of areas that are needed for one edge after another.
#[derive(Default)]
pub(super) struct Lists {
    with: Vec<Area>,
    before: Vec<Area>,
    after: Vec<Area>,
}

/// A part of an edge, from 0 at its start to 1 at its end; empty if it does not begin before its end.
type Span = [f64; 2];

/// Parts of an edge, in order.
type Spans = SmallVec<[Span; 4]>;

const WHOLE: Span = [0.0, 1.0];
const NOTHING: Span = [1.0, 0.0];

/// An edge, its bounds, and a hair to its left.
#[derive(Clone, Copy)]
struct Edge {
    from: DVec2,
    to: DVec2,
    lo: DVec2,
    hi: DVec2,
    left: DVec2,
}

impl Plan {
    pub(super) fn with_capacity(sides: usize) -> Plan {
        Plan {
            corners: Vec::with_capacity(sides),
            sides: Vec::with_capacity(sides),
        }
    }

    /// Adds the area of a convex outline; none of a sliver.
    pub(super) fn area(&mut self, outline: &[Corner]) -> Option<Area> {
        if area(outline) < SLIVER {
            return None;
        }
        let (mut lo, mut hi) = (DVec2::MAX, DVec2::MIN);
        let first = self.sides.len() as u32;
        for (n, corner) in outline.iter().enumerate() {
            let (at, next) = (corner.at, outline.get(n + 1).unwrap_or(&outline[0]).at);
            if let Some(side) = HalfPlane::left_of(at, next) {
                self.corners.push(at);
                self.sides.push(side);
                (lo, hi) = (lo.min(at), hi.max(at));
            }
        }
        let end = self.sides.len() as u32;
        Some(Area { first, end, lo, hi })
    }

    /// Returns what an area and a convex outline have in common.
    pub(super) fn common(&self, area: Area, outline: &[Corner]) -> Convex {
        let whole = Convex::from_slice(outline);
        let sides = self.sides(area).iter();
        sides.fold(whole, |rest, side| side.inside(&rest))
    }

    fn sides(&self, area: Area) -> &[HalfPlane] {
        &self.sides[area.first as usize..area.end as usize]
    }

    fn edges(&self, area: Area) -> impl Iterator<Item = Edge> + '_ {
        let corners = &self.corners[area.first as usize..area.end as usize];
        let sides = self.sides(area).iter().enumerate();
        sides.map(move |(n, side)| {
            let to = *corners.get(n + 1).unwrap_or(&corners[0]);
            Edge::new(corners[n], to, side.inward())
        })
    }

    /// Returns the part of an edge whose left side lies in an area, and the one whose right side does.
    fn beside(&self, edge: &Edge, area: &Area) -> [Span; 2] {
        let Edge { from, to, left, .. } = *edge;
        if !area.spans_to(edge.lo, edge.hi) {
            return [NOTHING; 2];
        }
        let mut spans = [WHOLE; 2];
        for side in self.sides(*area) {
            let (a, b) = (side.depth(from), side.depth(to));
            let beside = side.inward().dot(left);
            let hair = beside.abs();
            // Most edges lie wholly before or behind a line.
            match (a > hair, a < -hair) {
                (true, _) if b > hair => continue,
                (_, true) if b < -hair => return [NOTHING; 2],
                _ => {}
            }
            // Whether it crosses is seen beside the edge, where it does so on the edge itself.
            let at = (a / (a - b)).clamp(0.0, 1.0);
            narrow(&mut spans[0], [a + beside > 0.0, b + beside > 0.0], at);
            narrow(&mut spans[1], [a - beside > 0.0, b - beside > 0.0], at);
        }
        spans
    }

    /// Returns the parts of an edge whose sides both lie in some areas.
    fn within(&self, edge: &Edge, areas: &[Area]) -> Spans {
        if let [only] = areas {
            let [left, right] = self.beside(edge, only);
            let common = [left[0].max(right[0]), left[1].min(right[1])];
            let mut spans = Spans::new();
            add(&mut spans, common);
            return spans;
        }
        let mut spans = [Spans::new(), Spans::new()];
        for area in areas {
            let [left, right] = self.beside(edge, area);
            add(&mut spans[0], left);
            add(&mut spans[1], right);
        }
        both(spans)
    }

    /// Leaves of some parts of an edge what goes through none of some areas. Of edges upon each other the first counts.
    fn leave(&self, edge: &Edge, [before, after]: [&[Area]; 2], spans: &mut Spans) {
        for other in before {
            let [left, right] = self.beside(edge, other);
            take(spans, left);
            take(spans, right);
        }
        for other in after {
            take(spans, self.beside(edge, other)[1]);
        }
    }
}

impl Area {
    /// Returns true if the bounds of two areas overlap or touch.
    pub(super) fn is_near(&self, other: &Area) -> bool {
        self.spans_to(other.lo, other.hi)
    }

    fn spans_to(&self, lo: DVec2, hi: DVec2) -> bool {
        (self.lo - BESIDE).cmple(hi).all() && (lo - BESIDE).cmple(self.hi).all()
    }

    /// Adds those of some areas that are near to it to a list.
    fn near(&self, areas: &[Area], list: &mut Vec<Area>) {
        list.extend(areas.iter().filter(|other| self.is_near(other)));
    }
}

impl Edge {
    fn new(from: DVec2, to: DVec2, left: DVec2) -> Edge {
        Edge {
            from,
            to,
            lo: from.min(to),
            hi: from.max(to),
            left: left * BESIDE,
        }
    }

    /// Adds some parts of the edge with length, backwards if asked.
    fn pass(&self, spans: &[Span], backwards: bool, lines: &mut Vec<Line>) {
        let at = |t: f64| match t {
            0.0 => self.from,
            1.0 => self.to,
            t => self.from.lerp(self.to, t),
        };
        for [p, q] in spans {
            let (p, q) = (at(*p), at(*q));
            match (p.distance_squared(q) < BESIDE * BESIDE, backwards) {
                (true, _) => {}
                (false, false) => lines.push([p, q]),
                (false, true) => lines.push([q, p]),
            }
        }
    }
}

impl Region<'_> {
    /// Adds the border, with the area on the left.
    pub(super) fn border(self, lists: &mut Lists, lines: &mut Vec<Line>) {
        let Region {
            plan,
            with,
            without,
        } = self;
        for (n, part) in with.iter().enumerate() {
            let Lists {
                with: away,
                before,
                after,
            } = lists.cleared();
            part.near(&with[..n], before);
            part.near(&with[n + 1..], after);
            part.near(without, away);
            for edge in plan.edges(*part) {
                let mut spans = Spans::from_slice(&[WHOLE]);
                plan.leave(&edge, [before, after], &mut spans);
                for other in away.iter() {
                    take(&mut spans, plan.beside(&edge, other)[0]);
                }
                edge.pass(&spans, false, lines);
            }
        }
        self.inner(&[], without, lists, lines);
    }

    /// Adds the border of what more areas leave of it, which has this border without them.
    pub(super) fn less(
        self,
        border: &[Line],
        more: &[Area],
        lists: &mut Lists,
        lines: &mut Vec<Line>,
    ) {
        for [from, to] in border {
            let left = (*to - *from).perp().normalize_or_zero();
            let edge = Edge::new(*from, *to, left);
            let mut spans = Spans::from_slice(&[WHOLE]);
            for other in more {
                take(&mut spans, self.plan.beside(&edge, other)[0]);
            }
            edge.pass(&spans, false, lines);
        }
        self.inner(self.without, more, lists, lines);
    }

    /// Adds the border along areas that are taken away after some others.
    fn inner(self, first: &[Area], then: &[Area], lists: &mut Lists, lines: &mut Vec<Line>) {
        let plan = self.plan;
        for (n, part) in then.iter().enumerate() {
            let Lists {
                with,
                before,
                after,
            } = lists.cleared();
            part.near(self.with, with);
            if with.is_empty() {
                continue;
            }
            part.near(first, before);
            part.near(&then[..n], before);
            part.near(&then[n + 1..], after);
            for edge in plan.edges(*part) {
                let mut spans = plan.within(&edge, with);
                if spans.is_empty() {
                    continue;
                }
                plan.leave(&edge, [before, after], &mut spans);
                edge.pass(&spans, true, lines);
            }
        }
    }
}

impl Lists {
    fn cleared(&mut self) -> &mut Lists {
        self.with.clear();
        self.before.clear();
        self.after.clear();
        self
    }
}

/// Leaves of a span what lies before a line that its start, its end or both lie behind.
fn narrow(span: &mut Span, before: [bool; 2], crossing: f64) {
    let [from, to] = match before {
        [true, true] => WHOLE,
        [true, false] => [0.0, crossing],
        [false, true] => [crossing, 1.0],
        [false, false] => NOTHING,
    };
    span[0] = if from > span[0] { from } else { span[0] };
    span[1] = if to < span[1] { to } else { span[1] };
}

/// Adds a part to some, which are in the order of their starts.
fn add(spans: &mut Spans, part: Span) {
    if part[0] < part[1] {
        let at = spans.iter().position(|s| part[0] < s[0]);
        spans.insert(at.unwrap_or(spans.len()), part);
    }
}

/// Takes a part away from some.
fn take(spans: &mut Spans, [from, to]: Span) {
    let mut n = 0;
    while from < to && n < spans.len() {
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

/// Returns what two lists of parts, in the order of their starts, have in common.
fn both(mut lists: [Spans; 2]) -> Spans {
    for spans in &mut lists {
        spans.dedup_by(|next, last| {
            let meet = next[0] <= last[1];
            if meet {
                last[1] = last[1].max(next[1]);
            }
            meet
        });
    }
    let [one, other] = lists;
    let mut common = Spans::new();
    for [p, q] in &one {
        let parts = other.iter().map(|[r, s]| [p.max(*r), q.min(*s)]);
        common.extend(parts.filter(|[from, to]| from < to));
    }
    common
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn rect(x0: f64, y0: f64, x1: f64, y1: f64) -> [Corner; 4] {
        let corners = [dvec2(x0, y0), dvec2(x1, y0), dvec2(x1, y1), dvec2(x0, y1)];
        corners.map(|at| Corner { at, rim: true })
    }

    /// Twice the area that a border goes round, and its length.
    fn round(with: &[&[Corner; 4]], without: &[&[Corner; 4]]) -> (f64, f64) {
        let (mut plan, mut lists) = (Plan::default(), Lists::default());
        let mut areas = |all: &[&[Corner; 4]]| -> Vec<Area> {
            all.iter()
                .filter_map(|outline| plan.area(*outline))
                .collect()
        };
        let (with, without) = (areas(with), areas(without));
        let twice = |lines: &[Line]| lines.iter().map(|[p, q]| p.perp_dot(*q)).sum::<f64>();
        let length = |lines: &[Line]| lines.iter().map(|[p, q]| p.distance(*q)).sum::<f64>();
        let region = |without| Region {
            plan: &plan,
            with: &with,
            without,
        };
        let (mut lines, mut base, mut less) = (vec![], vec![], vec![]);
        region(&without).border(&mut lists, &mut lines);
        // The same in two steps.
        region(&[]).border(&mut lists, &mut base);
        region(&[]).less(&base, &without, &mut lists, &mut less);
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
