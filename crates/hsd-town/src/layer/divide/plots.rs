//! Blocks laid out in plots.

use super::split::{Line, Piece, Split};
use crate::shape::{Segment, angle, sides};
use glam::DVec2;
use hsd_ir::ast::town::Division;

/// How far a side may swerve from a straight line, metres: plots front the straight one.
const SWERVE: f64 = 1.0;
/// The distance from a side at which a border counts as along it, metres.
const BESIDE: f64 = SWERVE + 0.05;
/// The least width of a plot and of what is left of a side, as a share of the frontage wanted.
const NARROW: f64 = 0.55;
/// The least depth, as a share of the frontage wanted, or of the depth if that is less.
const SHALLOW: f64 = 0.9;
/// The least area of a plot, as a share of its width times its depth.
const FULL: f64 = 0.4;
/// The greatest angle of a gore that one side takes, degrees.
const GORE: f64 = 40.0;
/// The number of places at which the way to the opposite side is measured.
const RAYS: usize = 9;

/// A side of a block, and where its ends are cut.
struct Front {
    side: Segment,
    /// Into the block.
    inward: DVec2,
    /// The directions into the block along which plots end at its start and at its end.
    ends: [DVec2; 2],
}

/// Returns the plots of a block, and what is left of it.
pub(super) fn plots(block: &Piece, division: &Division) -> (Vec<Piece>, Vec<Piece>) {
    let mut fronts = fronts(&block.ring);
    fronts.sort_by(|a, b| b.side.length().total_cmp(&a.side.length()));
    let (mut plots, mut left) = (vec![], vec![block.clone()]);
    for front in &fronts {
        let depth = front.depth(block, division);
        if depth < shallow(division) {
            continue;
        }
        left = left
            .into_iter()
            .flat_map(|piece| front.lay_out(piece, depth, division, &mut plots))
            .collect();
    }
    (plots, left)
}

fn shallow(division: &Division) -> f64 {
    SHALLOW * division.frontage.min(division.depth)
}

/// Returns the sides of a ring as fronts.
fn fronts(ring: &[DVec2]) -> Vec<Front> {
    let corners = straightened(ring);
    let all: Vec<Segment> = sides(&corners).collect();
    let n = all.len();
    let made = (0..n).map(|i| {
        let side = all[i];
        let inward = -side.normal();
        let (before, after) = (all[(i + n - 1) % n], all[(i + 1) % n]);
        Front {
            side,
            inward,
            ends: [
                // Seen from the side, the one before it runs backwards.
                end_at(side, inward, -before.direction(), -1.0),
                end_at(side, inward, after.direction(), 1.0),
            ],
        }
    });
    made.filter(|front| front.side.length() > 0.0).collect()
}

/// Returns the direction in which the plots of a side end at its corner with the next one, which goes away from the block in
/// the direction `next`: square to the side at sharp corners and reflex ones. Past the square a gore is left, which belongs
/// to the side that comes first as long as it is narrow; a wide one is halved.
fn end_at(side: Segment, inward: DVec2, next: DVec2, ahead: f64) -> DVec2 {
    if next.dot(side.direction()) * ahead <= 0.0 {
        return inward;
    }
    match angle(inward, next) {
        ..=GORE => next,
        // A reflex corner.
        90.0.. => inward,
        _ => (inward + next).normalize_or(inward),
    }
}

/// Returns a ring without the corners that lie near the line of the others (Douglas-Peucker).
fn straightened(ring: &[DVec2]) -> Vec<DVec2> {
    let n = ring.len();
    let from = ring[0];
    let far = (1..n).max_by(|a, b| ring[*a].distance(from).total_cmp(&ring[*b].distance(from)));
    let Some(far) = far else { return ring.to_vec() };
    let closed: Vec<DVec2> = ring.iter().copied().chain([from]).collect();
    let mut kept = vec![];
    for part in [&closed[..=far], &closed[far..]] {
        kept.push(part[0]);
        thin(part, &mut kept);
    }
    kept
}

/// Adds the corners between the ends of a line that it needs.
fn thin(line: &[DVec2], kept: &mut Vec<DVec2>) {
    let mut open = vec![(0, line.len() - 1)];
    let mut needed = vec![];
    while let Some((first, last)) = open.pop() {
        let chord = Segment::new(line[first], line[last]);
        let off = |i: &usize| chord.nearest(line[*i]).distance(line[*i]);
        let most = (first + 1..last).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(most) = most.filter(|i| off(i) > SWERVE) {
            needed.push(most);
            open.extend([(first, most), (most, last)]);
        }
    }
    needed.sort_unstable();
    kept.extend(needed.into_iter().map(|i| line[i]));
}

impl Front {
    /// Returns how deep its plots are: half the way to the opposite side at most, or all of a short one.
    fn depth(&self, block: &Piece, division: &Division) -> f64 {
        let start = |k: usize| {
            self.side
                .from
                .lerp(self.side.to, (k as f64 + 0.5) / RAYS as f64)
        };
        let mut ways: Vec<f64> = (0..RAYS)
            .map(|k| way(block, start(k), self.inward))
            .collect();
        ways.sort_by(f64::total_cmp);
        let way = ways[RAYS / 2];
        // A strip too thin for two rows has one.
        let half = match way / 2.0 < shallow(division) {
            true => way,
            false => way / 2.0,
        };
        half.min(division.depth)
    }

    /// Lays out what this side has of a piece; returns what is left of it.
    fn lay_out(
        &self,
        piece: Piece,
        depth: f64,
        division: &Division,
        plots: &mut Vec<Piece>,
    ) -> Vec<Piece> {
        if self.free(&piece).is_none() {
            return vec![piece];
        }
        let along = self.side.direction();
        let Split {
            left: mut rest,
            right: near,
        } = piece.split(Line {
            at: self.side.from + self.inward * depth,
            way: along,
        });
        let wide = |[from, to]: &[f64; 2]| to - from >= NARROW * division.frontage;
        for piece in near {
            match self.free(&piece).filter(wide) {
                Some(free) => rest.extend(self.row(piece, free, [depth, division.frontage], plots)),
                None => rest.push(piece),
            }
        }
        rest
    }

    /// Lays out a row of plots in a piece from one place on this side to another; returns what is left of it.
    fn row(
        &self,
        piece: Piece,
        [from, to]: [f64; 2],
        [depth, frontage]: [f64; 2],
        plots: &mut Vec<Piece>,
    ) -> Vec<Piece> {
        let count = ((to - from) / frontage).round().max(1.0) as usize;
        let width = (to - from) / count as f64;
        let place = |k: usize| self.side.from + self.side.direction() * (from + width * k as f64);
        let line = |k: usize| Line {
            at: place(k),
            way: match k {
                0 if from < BESIDE => self.ends[0],
                k if k == count && to > self.side.length() - BESIDE => self.ends[1],
                _ => self.inward,
            },
        };
        // What lies before the first plot.
        let first = piece.split(line(0));
        let (mut rest, mut ahead) = (first.left, first.right);
        for k in 1..=count {
            let (mut own, mut next) = (vec![], vec![]);
            for piece in ahead {
                let Split { left, right } = piece.split(line(k));
                own.extend(left);
                next.extend(right);
            }
            ahead = next;
            own.sort_by(|a, b| b.area().total_cmp(&a.area()));
            let fills = |plot: &Piece| plot.area() >= FULL * width * depth && plot.holes.is_empty();
            let is_plot = own.first().is_some_and(fills);
            rest.extend(own.drain(usize::from(is_plot).min(own.len())..));
            plots.extend(own.into_iter().map(|plot| begun_at(plot, place(k - 1))));
        }
        rest.extend(ahead);
        rest
    }

    /// Returns from where to where the border of a piece runs along this side, metres from its start.
    fn free(&self, piece: &Piece) -> Option<[f64; 2]> {
        let along = self.side.direction();
        let place = |p: DVec2| {
            (p - self.side.from)
                .dot(along)
                .clamp(0.0, self.side.length())
        };
        let off = |p: DVec2| (p - self.side.from).dot(self.inward).abs();
        let its = sides(&piece.ring).filter(|s| off(s.from) <= BESIDE && off(s.to) <= BESIDE);
        let its = its
            .map(|s| [place(s.from), place(s.to)])
            .filter(|[from, to]| to > from);
        its.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }
}

/// Returns a plot whose ring begins at the corner nearest to a place.
fn begun_at(mut plot: Piece, at: DVec2) -> Piece {
    let corners = 0..plot.ring.len();
    let way = |i: &usize| plot.ring[*i].distance(at);
    let first = corners.min_by(|a, b| way(a).total_cmp(&way(b)));
    plot.ring.rotate_left(first.unwrap_or(0));
    plot
}

/// Returns how far it is from a place on the border of a block to its border on the other side.
fn way(block: &Piece, from: DVec2, inward: DVec2) -> f64 {
    let rings = std::iter::once(&block.ring).chain(&block.holes);
    let hits = rings.flat_map(|ring| sides(ring)).filter_map(|side| {
        let to = side.to - side.from;
        let across = inward.perp_dot(to);
        let t = (side.from - from).perp_dot(to) / across;
        let s = (side.from - from).perp_dot(inward) / across;
        (across != 0.0 && (0.0..=1.0).contains(&s) && t > 2.0 * BESIDE).then_some(t)
    });
    hits.fold(f64::INFINITY, f64::min)
}
