//! The event queue: edges that shrink to nothing, and reflex vertices that run into another edge.

use super::wave::Wave;
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// An event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    /// The edge between two vertices shrinks to no length.
    Vertices(u32, u32),
    /// A vertex reaches an edge.
    Edge(u32, u32),
}

/// A meeting with its place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Event {
    pub(super) time: f64,
    pub(super) at: DVec2,
    pub(super) what: Meeting,
    /// A serial number: events of one time come in the order in which they were found.
    number: u32,
}

impl Eq for Event {}

impl Ord for Event {
    /// Orders the soonest as the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        let sooner = other.time.total_cmp(&self.time);
        sooner.then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// All future meetings, including stale ones.
#[derive(Debug, Default)]
pub(super) struct Queue {
    heap: BinaryHeap<Event>,
    count: u32,
    /// The bounding box of the outline: nothing happens outside, nor later than half its shorter side.
    lo: DVec2,
    hi: DVec2,
}

impl Queue {
    /// Creates the queue of the first meetings of all vertices.
    pub(super) fn of(wave: &Wave) -> Queue {
        let n = wave.vertices.len();
        let places = wave.nodes.iter().map(|n| n.at);
        let mut queue = Queue {
            heap: BinaryHeap::with_capacity(4 * n),
            count: 0,
            lo: places.clone().fold(DVec2::MAX, DVec2::min) - wave.eps,
            hi: places.fold(DVec2::MIN, DVec2::max) + wave.eps,
        };
        for v in 0..n as u32 {
            queue.shrinking(wave, v, 0.0);
            queue.running(wave, v, 0.0);
        }
        queue
    }

    fn push(&mut self, time: f64, at: DVec2, what: Meeting) {
        self.count += 1;
        let number = self.count;
        self.heap.push(Event {
            time,
            at,
            what,
            number,
        });
    }

    /// Returns the next event and all others within a span of time after it, soonest first.
    pub(super) fn next(&mut self, span: f64) -> Vec<Event> {
        let Some(first) = self.heap.pop() else {
            return vec![];
        };
        let mut events = vec![first];
        while let Some(event) = self.heap.peek() {
            if event.time > first.time + span {
                break;
            }
            events.extend(self.heap.pop());
        }
        events
    }

    /// Adds the events of a new vertex.
    pub(super) fn add(&mut self, wave: &Wave, v: u32, now: f64) {
        if wave.vertex(v).velocity.is_none() {
            return self.closing(wave, v, now);
        }
        self.shrinking(wave, v, now);
        self.shrinking(wave, wave.vertex(v).prev, now);
        self.running(wave, v, now);
        for beside in [wave.vertex(v).prev, wave.vertex(v).next] {
            if wave.vertex(beside).velocity.is_none() {
                self.closing(wave, beside, now);
            }
        }
    }

    /// Adds the time at which the edge from `u` to the next vertex has no length.
    fn shrinking(&mut self, wave: &Wave, u: u32, now: f64) {
        let v = wave.vertex(u).next;
        let ends = (wave.vertex(u), wave.vertex(v));
        let (Some(from), Some(to)) = (ends.0.velocity, ends.1.velocity) else {
            return;
        };
        let way = wave.way(ends.0.right);
        let length = way.dot(ends.1.at(now) - ends.0.at(now));
        let rate = way.dot(from - to);
        if rate <= 1e-12 && length > wave.eps {
            return;
        }
        let left = if rate > 1e-12 {
            (length / rate).max(0.0)
        } else {
            0.0
        };
        // The slower one's position is more accurate.
        let slow = if from.length_squared() < to.length_squared() {
            ends.0
        } else {
            ends.1
        };
        self.push(now + left, slow.at(now + left), Meeting::Vertices(u, v));
    }

    /// Adds the times at which a reflex vertex reaches other edges.
    fn running(&mut self, wave: &Wave, v: u32, now: f64) {
        let vertex = wave.vertex(v);
        let Some(velocity) = vertex.velocity.filter(|_| wave.is_reflex(v)) else {
            return;
        };
        let at = vertex.at(now);
        let latest = (self.hi - self.lo).min_element() / 2.0;
        for (e, line) in wave.lines.iter().enumerate() {
            let e = e as u32;
            if e == vertex.left || e == vertex.right {
                continue;
            }
            let (gap, rate) = (line.depth(at) - now, 1.0 - line.normal.dot(velocity));
            if gap < -wave.eps || rate < 1e-12 {
                continue;
            }
            let left = (gap / rate).max(0.0);
            let (time, place) = (now + left, at + velocity * left);
            let inside = place.cmpge(self.lo).all() && place.cmple(self.hi).all();
            if inside && time <= latest {
                self.push(time, place, Meeting::Edge(v, e));
            }
        }
    }

    /// Adds the event of a vertex whose edges coincide: the nearer of its neighbours meets the opposite edge at once.
    fn closing(&mut self, wave: &Wave, v: u32, now: f64) {
        let vertex = wave.vertex(v);
        let here = vertex.at(now);
        let (before, after) = (vertex.prev, vertex.next);
        let place = |id: u32| wave.vertex(id).at(now);
        let (back, on) = (place(before).distance(here), place(after).distance(here));
        if on <= back {
            self.push(now, place(after), Meeting::Edge(after, vertex.left));
        } else {
            self.push(now, place(before), Meeting::Edge(before, vertex.right));
        }
    }
}
