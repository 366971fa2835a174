//! Lines along a way: strips between two stations at an offset, whole dashes in what is free between crossings (000-71).

use super::segments;
use crate::shape::Segment;
use glam::DVec2;
use hsd_base::geometry::grid::{Grid, bounds};
use std::collections::HashSet;

/// Stations of a line: from, to, metres.
pub(super) type Stretch = (f64, f64);

/// Returns the length of a line, metres.
pub(super) fn length(line: &[DVec2]) -> f64 {
    segments(line).map(Segment::length).sum()
}

/// Returns the stretches of a line that lie in no ring, each shortened at its ends.
pub(super) fn free<'r>(
    line: &[DVec2],
    rings: impl Iterator<Item = &'r Vec<DVec2>>,
    margin: f64,
) -> Vec<Stretch> {
    let rings: Vec<&Vec<DVec2>> = rings.collect();
    let boxes = rings.iter().map(|ring| bounds(ring.iter().copied()));
    let index = Grid::new(boxes.map(Option::unwrap_or_default).collect());
    let mut taken: Vec<Stretch> = vec![];
    let mut start = 0.0;
    for segment in segments(line) {
        let length = segment.length();
        let near = index.near(segment.bounds()).into_iter();
        let inside = near.filter_map(|n| inside(segment, rings[n as usize]));
        taken.extend(inside.map(|(from, to)| (start + from * length, start + to * length)));
        start += length;
    }
    taken.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut found, mut from) = (vec![], 0.0);
    for (begin, end) in taken.into_iter().chain([(start, start)]) {
        if begin - from > 2.0 * margin {
            found.push((from + margin, begin - margin));
        }
        from = f64::max(from, end);
    }
    found
}

/// Returns the shares of a segment between which it lies in a convex ring.
fn inside(segment: Segment, ring: &[DVec2]) -> Option<(f64, f64)> {
    let way = segment.to - segment.from;
    let (mut from, mut to) = (0.0, 1.0);
    for (i, p) in ring.iter().enumerate() {
        let side = ring[(i + 1) % ring.len()] - *p;
        let (at, slope) = (side.perp_dot(segment.from - *p), side.perp_dot(way));
        if slope.abs() < 1e-12 {
            if at < 0.0 {
                return None;
            }
            continue;
        }
        let share = -at / slope;
        match slope > 0.0 {
            true => from = f64::max(from, share),
            false => to = f64::min(to, share),
        }
    }
    (to - from > 1e-9).then_some((from, to))
}

/// Returns the whole dashes that fit in a stretch, in its middle.
pub(super) fn dashes((from, to): Stretch, dash: f64, gap: f64) -> Vec<Stretch> {
    let count = ((to - from + gap) / (dash + gap)).floor().max(0.0);
    let first = (from + to - count * (dash + gap) + gap) / 2.0;
    let begin = |n: usize| first + n as f64 * (dash + gap);
    (0..count as usize)
        .map(|n| (begin(n), begin(n) + dash))
        .collect()
}

/// Segments of a feature, found by their ends.
pub(super) struct Segments(HashSet<[u64; 4]>);

impl Segments {
    /// Collects segments.
    pub(super) fn new(segments: impl IntoIterator<Item = Segment>) -> Segments {
        Segments(segments.into_iter().map(Segments::key).collect())
    }

    /// Returns true if a segment is one of them.
    pub(super) fn contain(&self, segment: &Segment) -> bool {
        self.0.contains(&Segments::key(*segment))
    }

    fn key(Segment { from, to }: Segment) -> [u64; 4] {
        // Zero may have a sign.
        [from.x, from.y, to.x, to.y].map(|x| (x + 0.0).to_bits())
    }
}

/// A line with the stations of its points.
pub(super) struct Course<'l> {
    line: &'l [DVec2],
    stations: Vec<f64>,
}

impl<'l> Course<'l> {
    /// Measures a line.
    pub(super) fn new(line: &'l [DVec2]) -> Course<'l> {
        let mut stations = vec![0.0];
        let mut start = 0.0;
        for segment in segments(line) {
            start += segment.length();
            stations.push(start);
        }
        Course { line, stations }
    }

    /// Returns the length of the line, metres.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Returns the place at a station, and the direction there. A station behind the end is at the end.
    pub(super) fn at(&self, station: f64) -> (DVec2, DVec2) {
        let ends = &self.stations[1..];
        let number = ends.partition_point(|end| *end < station);
        let number = number.min(ends.len().saturating_sub(1));
        let Some(ends) = self.line.get(number..number + 2) else {
            return (self.line[0], DVec2::X);
        };
        let segment = Segment::new(ends[0], ends[1]);
        let share = (station - self.stations[number]) / segment.length();
        let place = segment.from.lerp(segment.to, share.min(1.0));
        (place, segment.direction())
    }

    /// Returns a strip along a stretch: to the left of the line by `off`, of this width, in pieces of at most `step`.
    pub(super) fn strip(
        &self,
        (from, to): Stretch,
        (off, width): (f64, f64),
        step: f64,
    ) -> Vec<Vec<DVec2>> {
        let mut found = vec![];
        let first = self.stations[1..].partition_point(|end| *end <= from);
        let stretch = self.stations.iter().zip(self.line.windows(2));
        for (start, ends) in stretch.skip(first) {
            if *start >= to {
                break;
            }
            let segment = Segment::new(ends[0], ends[1]);
            let length = segment.length();
            let (a, b) = (
                f64::max(from, *start) - start,
                f64::min(to, start + length) - start,
            );
            if b - a < 1e-3 {
                continue;
            }
            let along = segment.direction();
            let [inner, outer] = [-0.5, 0.5].map(|side| along.perp() * (off + side * width));
            let count = ((b - a) / step).ceil().max(1.0);
            for n in 0..count as usize {
                let at = |n: f64| segment.from + along * (a + (b - a) * n / count);
                let (p, q) = (at(n as f64), at(n as f64 + 1.0));
                found.push(vec![p + inner, q + inner, q + outer, p + outer]);
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn dashes_are_whole_and_true() {
        let marks = dashes((3.0, 60.0), 5.0, 5.0);
        assert_eq!(marks.len(), 6);
        assert!(
            marks
                .iter()
                .all(|(from, to)| (to - from - 5.0).abs() < 1e-9)
        );
        assert!((marks[0].0 - 3.0 - (60.0 - marks[5].1)).abs() < 1e-9);
        assert!(dashes((0.0, 4.9), 5.0, 5.0).is_empty());
    }

    #[test]
    fn crossings_are_left_out() {
        let line = [dvec2(0.0, 0.0), dvec2(50.0, 0.0), dvec2(100.0, 0.0)];
        let crossing = vec![
            dvec2(40.0, -5.0),
            dvec2(60.0, -5.0),
            dvec2(60.0, 5.0),
            dvec2(40.0, 5.0),
        ];
        let found = free(&line, [&crossing].into_iter(), 1.0);
        assert_eq!(found, [(1.0, 39.0), (61.0, 99.0)]);
    }
}
