//! Bands along lines: pavements, drains, carriageways. Where lines cross, each place is covered once: by the innermost band
//! there, and among equals by the wider street.

use super::cutters::Meetings;
use crate::plan::BORDERS;
use crate::shape::Segment;
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::clip::without;
use hsd_base::geometry::grid::{Grid, bounds, wider};
use std::f64::consts::PI;

/// Ends of lines nearer than this meet, metres.
const MEETS: f64 = 0.05;
/// The corners of a rounded end.
const CORNERS: usize = 4;
/// A straight piece of a way with bands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its middle.
    pub(super) line: Segment,
    /// The distance of its borders from the middle, from the outside inwards, metres.
    pub(super) half: [f64; BORDERS],
    /// True if it belongs to the feature.
    pub(super) own: bool,
}

impl Way {
    /// Returns true if this one lies on top where both cross.
    fn over(&self, other: &Way) -> bool {
        let place = |way: &Way| {
            let (p, q) = (way.line.from, way.line.to);
            [way.half[0], p.x, p.y, q.x, q.y]
        };
        place(self) > place(other)
    }
}

/// Ways near each other, with the rings of their borders.
pub(super) struct Ways {
    ways: Vec<Way>,
    rings: Vec<[Option<Vec<DVec2>>; BORDERS]>,
    /// The boxes of the widest ring of each.
    index: Grid,
}

impl Ways {
    /// Prepares ways: their ends are rounded where others go on from there.
    pub(super) fn new(ways: Vec<Way>) -> Ways {
        let joints = Joints::new(&ways);
        let rings = |way: &Way| {
            let ends = [way.line.from, way.line.to].map(|end| joints.goes_on(way, end));
            way.half
                .map(|half| (half > 0.01).then(|| rounded(way.line, half, ends)))
        };
        let rings: Vec<_> = ways.iter().map(rings).collect();
        let around = |rings: &[Option<Vec<DVec2>>; BORDERS]| {
            bounds(rings.iter().flatten().flatten().copied()).unwrap_or_default()
        };
        Ways {
            index: Grid::new(rings.iter().map(around).collect()),
            ways,
            rings,
        }
    }

    /// Returns the ring of a border of all ways that do not belong to the feature.
    pub(super) fn others(&self, border: usize) -> impl Iterator<Item = &Vec<DVec2>> {
        let all = self.ways.iter().zip(&self.rings);
        all.filter(|(way, _)| !way.own)
            .filter_map(move |(_, rings)| rings[border].as_ref())
    }

    /// Returns the band of the feature inside a border, as convex rings.
    pub(super) fn band(&self, border: usize) -> Vec<Vec<DVec2>> {
        let mut found = vec![];
        for (number, way) in self.ways.iter().enumerate().filter(|(_, way)| way.own) {
            let inner = way.half.get(border + 1);
            let (Some(ring), true) = (
                &self.rings[number][border],
                inner.is_none_or(|inner| *inner < way.half[border] - 0.01),
            ) else {
                continue;
            };
            let mut cutters: Vec<Vec<DVec2>> = vec![];
            // What is elsewhere covers nothing.
            let near = bounds(ring.iter().copied()).map(|around| self.index.near(around));
            for other in near.into_iter().flatten().map(|other| other as usize) {
                let (by, rings) = (&self.ways[other], &self.rings[other]);
                let before = if by.own { other < number } else { by.over(way) };
                let covers = if before && other != number {
                    border
                } else {
                    border + 1
                };
                // Of bands without width the next one covers more.
                cutters.extend(rings.get(covers).cloned().flatten());
            }
            found.extend(without(vec![ring.clone()], &cutters));
        }
        found
    }
}

/// Fails if the lines of a feature, which have this half width, meet each other too often.
pub(super) fn check_meetings(lines: &[Segment], half: f64) -> Result<(), Text> {
    let boxes = || lines.iter().map(|line| line.bounds());
    let index = Grid::new(boxes().collect());
    let wide = boxes().map(|around| wider(around, 2.0 * half));
    Meetings::among(lines.len()).take_boxes(&index, wide)
}

/// The ends of ways, by place.
struct Joints<'w> {
    ways: &'w [Way],
    /// Each way has two boxes, one for each end.
    index: Grid,
}

impl Joints<'_> {
    fn new(ways: &[Way]) -> Joints<'_> {
        let ends = ways.iter().flat_map(|way| [way.line.from, way.line.to]);
        Joints {
            ways,
            index: Grid::new(ends.map(|end| [end; 2]).collect()),
        }
    }

    /// Returns half the width of the widest way that continues another from an end; 0 for none.
    fn goes_on(&self, way: &Way, end: DVec2) -> f64 {
        let near = self.index.near(wider([end; 2], MEETS)).into_iter();
        let others = near.filter_map(|n| {
            let other = &self.ways[n as usize / 2];
            let at = if n % 2 == 0 {
                other.line.from
            } else {
                other.line.to
            };
            (other.line != way.line && at.distance(end) < MEETS).then_some(other.half[0])
        });
        others.fold(0.0, f64::max)
    }
}

/// Returns the ring round a line: its ends are rounded as far as the ways that go on from there are wide.
fn rounded(line: Segment, half: f64, ends: [f64; 2]) -> Vec<DVec2> {
    let along = line.direction();
    let left = along.perp();
    let mut ring = vec![];
    for (end, way, reach) in [(line.to, 1.0, ends[1]), (line.from, -1.0, ends[0])] {
        let reach = reach.min(half);
        let steps = if reach > 0.01 { CORNERS } else { 1 };
        for step in 0..=steps {
            let angle = PI * (step as f64 / steps as f64 - 0.5);
            let out = along * (libm::cos(angle) * reach) + left * (libm::sin(angle) * half);
            ring.push(end + out * way);
        }
    }
    ring
}
