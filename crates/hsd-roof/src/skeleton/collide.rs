//! Handling of all events at one point.
//!
//! All vertices at the point and all edges that pass through it are taken together: runs of vertices that follow each
//! other, each with the edge that comes in and the edge that goes out, and edges cut in two. Seen from the point the
//! outgoing and the incoming edges alternate, with the inside to the left of each outgoing one up to the next incoming
//! one; so each outgoing edge is joined to the incoming one next to the left. That is an edge that vanishes, a ring
//! that splits, rings that join, and any number of those at one point.

use super::contour::Contours;
use super::queue::{Event, Meeting, Queue};
use super::wave::{Arc, Wave};
use glam::DVec2;
use hsd_base::geometry::tolerance::PARALLEL;

/// The largest factor by which the search circle grows with a vertex's speed.
const LOOSE: f64 = 1e4;

/// Moves the outline inwards until nothing is left. `None` if the sweep fails.
pub(super) fn sweep(contours: &Contours) -> Option<Wave> {
    let mut wave = Wave::of(contours);
    let mut queue = Queue::of(&wave);
    let mut steps = 200 + 20 * wave.vertices.len();
    while wave.alive > 0 {
        let events = queue.next(wave.eps);
        if events.is_empty() {
            return None;
        }
        let mut done = vec![false; events.len()];
        for i in 0..events.len() {
            if done[i] {
                continue;
            }
            let at = events[i].at;
            let near = (i..events.len()).filter(|j| events[*j].at.distance(at) <= 4.0 * wave.eps);
            let near: Vec<usize> = near.collect();
            near.iter().for_each(|j| done[*j] = true);
            let here: Vec<Event> = near.iter().map(|j| events[*j]).collect();
            let gathered = Gathered::at(&mut wave, &here, LOOSE);
            if !gathered.is_event() {
                continue;
            }
            steps = steps.checked_sub(1)?;
            if gathered.resolve(&mut wave, &mut queue).is_some() {
                continue;
            }
            // Inconsistent events were not simultaneous: the first is handled alone, the rest later.
            near[1..].iter().for_each(|j| done[*j] = false);
            let mut first = Gathered::at(&mut wave, &here[..1], 1.0);
            first.close_triangle(&wave);
            first.resolve(&mut wave, &mut queue)?;
        }
    }
    Some(wave)
}

/// A run of vertices at the point, or an edge through it.
#[derive(Clone, Copy, Debug)]
struct Chain {
    /// The vertex before the point, and the edge from it.
    before: u32,
    inward: u32,
    /// The vertex after the point, and the edge to it.
    after: u32,
    outward: u32,
}

/// Everything at one point at one time.
struct Gathered {
    at: DVec2,
    time: f64,
    /// Vertices at the point.
    vertices: Vec<u32>,
    /// Vertices that start an edge through it.
    pieces: Vec<u32>,
    /// The factor by which the position of a fast vertex may be less accurate.
    loose: f64,
}

impl Gathered {
    /// Collects the vertices and edges of these events that are at the point.
    fn at(wave: &mut Wave, events: &[Event], loose: f64) -> Gathered {
        let (at, time) = (events[0].at, events[0].time);
        let (vertices, pieces) = (Vec::new(), Vec::new());
        let mut all = Gathered {
            at,
            time,
            vertices,
            pieces,
            loose,
        };
        for event in events {
            match event.what {
                Meeting::Vertices(u, v) => {
                    let both = wave.vertex(u).alive && wave.vertex(v).alive;
                    if both && wave.vertex(u).next == v {
                        all.take(u);
                        all.take(v);
                    }
                }
                Meeting::Edge(v, e) => {
                    if wave.vertex(v).alive && all.meets(wave, v, e) {
                        all.take(v);
                    }
                }
            }
        }
        all.spread(wave);
        all
    }

    fn take(&mut self, v: u32) {
        if !self.vertices.contains(&v) {
            self.vertices.push(v);
        }
    }

    fn is_here(&self, wave: &Wave, v: u32) -> bool {
        let vertex = wave.vertex(v);
        // Positions of fast vertices are less accurate.
        let fast = vertex
            .velocity
            .map_or(1.0, |v| v.length().max(1.0).min(self.loose));
        vertex.at(self.time).distance(self.at) <= 4.0 * wave.eps * fast
    }

    /// Adds the piece of an edge that passes through the point, or its end there; returns whether there is one.
    fn meets(&mut self, wave: &mut Wave, v: u32, edge: u32) -> bool {
        let way = wave.way(edge);
        let starts = wave.pieces(edge).to_vec();
        for x in starts {
            let y = wave.vertex(x).next;
            if x == v || y == v {
                continue;
            }
            // The paths of `v` and this edge's line meet in the corner between: the edge of `v` is at its end.
            let ends = (
                wave.vertex(x).velocity.is_some(),
                wave.vertex(y).velocity.is_some(),
            );
            if self.is_here(wave, x) || (x == wave.vertex(v).next && ends.0) {
                self.take(x);
                return true;
            }
            if self.is_here(wave, y) || (y == wave.vertex(v).prev && ends.1) {
                self.take(y);
                return true;
            }
            let from = way.dot(self.at - wave.vertex(x).at(self.time));
            let to = way.dot(wave.vertex(y).at(self.time) - self.at);
            if from > 0.0 && to > 0.0 {
                if !self.pieces.contains(&x) {
                    self.pieces.push(x);
                }
                return true;
            }
        }
        false
    }

    /// Adds the neighbours that are at the point too.
    fn spread(&mut self, wave: &Wave) {
        let mut n = 0;
        while n < self.vertices.len() {
            let vertex = wave.vertex(self.vertices[n]);
            for other in [vertex.prev, vertex.next] {
                if !self.vertices.contains(&other) && self.is_here(wave, other) {
                    self.vertices.push(other);
                }
            }
            n += 1;
        }
        // An edge with an end here does not pass through.
        let vertices = &self.vertices;
        self.pieces
            .retain(|x| !vertices.contains(x) && !vertices.contains(&wave.vertex(*x).next));
    }

    /// Closes a ring of three, all of which meet at one point, whatever their computed positions.
    fn close_triangle(&mut self, wave: &Wave) {
        let Some(&v) = self.vertices.first() else {
            return;
        };
        let after = wave.vertex(v).next;
        let ring = [v, after, wave.vertex(after).next];
        if wave.vertex(ring[2]).next == v {
            self.pieces.clear();
            self.vertices = ring.to_vec();
        }
    }

    fn is_event(&self) -> bool {
        self.vertices.len() + self.pieces.len() > 1
    }

    /// Returns the chains through the point, in no order.
    fn chains(&self, wave: &Wave) -> Vec<Chain> {
        let here = |v: u32| self.vertices.contains(&v);
        let mut chains = Vec::with_capacity(2);
        for &first in &self.vertices {
            let before = wave.vertex(first).prev;
            if here(before) {
                continue;
            }
            let mut last = first;
            while here(wave.vertex(last).next) {
                last = wave.vertex(last).next;
            }
            chains.push(Chain {
                before,
                inward: wave.vertex(first).left,
                after: wave.vertex(last).next,
                outward: wave.vertex(last).right,
            });
        }
        for &x in &self.pieces {
            let edge = wave.vertex(x).right;
            let after = wave.vertex(x).next;
            chains.push(Chain {
                before: x,
                inward: edge,
                after,
                outward: edge,
            });
        }
        chains
    }

    /// Ends the vertices at the point and joins the remaining edges.
    fn resolve(&self, wave: &mut Wave, queue: &mut Queue) -> Option<()> {
        let chains = self.chains(wave);
        let joined = join(wave, &chains)?;
        let node = wave.node(self.at, self.time);
        for v in &self.vertices {
            wave.end(*v, node);
        }
        let mut begun = Vec::with_capacity(joined.len());
        for &(outward, inward) in &joined {
            let (to, from) = (chains[outward], chains[inward]);
            begun.push(wave.begin(node, from.inward, to.outward));
        }
        // All links are set first, since chains may be each other's neighbours.
        for (v, &(outward, inward)) in begun.iter().zip(&joined) {
            wave.link(chains[inward].before, *v);
            wave.link(*v, chains[outward].after);
        }
        for v in begun {
            if !wave.vertex(v).alive {
                continue;
            }
            let other = wave.vertex(v).next;
            if wave.vertex(other).next == v {
                close(wave, v, other, self.time)?;
            } else {
                queue.add(wave, v, self.time);
            }
        }
        Some(())
    }
}

/// Returns for each outgoing edge the incoming one that continues it, as indices of chains.
fn join(wave: &Wave, chains: &[Chain]) -> Option<Vec<(usize, usize)>> {
    if chains.len() < 2 {
        return Some((0..chains.len()).map(|i| (i, i)).collect());
    }
    // (direction from the point, whether outgoing, chain)
    let mut rays: Vec<(DVec2, bool, usize)> = Vec::with_capacity(2 * chains.len());
    for (i, chain) in chains.iter().enumerate() {
        rays.push((wave.way(chain.outward), true, i));
        rays.push((-wave.way(chain.inward), false, i));
    }
    let lower = |d: DVec2| d.y < 0.0 || (d.y == 0.0 && d.x < 0.0);
    rays.sort_by(|(d, ..), (e, ..)| {
        let halves = lower(*d).cmp(&lower(*e));
        halves.then(0.0_f64.total_cmp(&(d.perp_dot(*e) + 0.0)))
    });
    // Edges that coincide enclose nothing: the outgoing one is first.
    let n = rays.len();
    let upon = |a: DVec2, b: DVec2| a.dot(b) > 0.0 && a.perp_dot(b).abs() <= PARALLEL;
    for i in 0..n {
        let j = (i + 1) % n;
        let swapped = !rays[i].1 && rays[j].1 && upon(rays[i].0, rays[j].0);
        if swapped {
            rays.swap(i, j);
        }
    }
    let start = rays.iter().position(|r| r.1)?;
    rays.rotate_left(start);
    let pair = |pair: &[(DVec2, bool, usize)]| {
        let fits = pair[0].1 && !pair[1].1;
        fits.then_some((pair[0].2, pair[1].2))
    };
    rays.chunks(2).map(pair).collect()
}

/// Ends a ring of two vertices: its edges coincide in a ridge.
fn close(wave: &mut Wave, u: u32, v: u32, time: f64) -> Option<()> {
    let ends = if passes(wave, u, v, time) {
        [end(wave, v, time); 2]
    } else if passes(wave, v, u, time) {
        [end(wave, u, time); 2]
    } else {
        [end(wave, u, time), end(wave, v, time)]
    };
    let (left, right) = (wave.vertex(v).right, wave.vertex(u).right);
    wave.end(u, ends[0]);
    wave.end(v, ends[1]);
    // Seen from u to v, the area that the edge between them has swept lies to the right.
    wave.arc(Arc {
        from: ends[0],
        to: ends[1],
        left,
        right,
    });
    Some(())
}

/// Returns true if a vertex is past another that it comes towards: between edges that are nearly parallel it is so fast
/// that the error of the time takes it there.
fn passes(wave: &Wave, id: u32, other: u32, time: f64) -> bool {
    let vertex = wave.vertex(id);
    let from = wave.nodes[vertex.node as usize].at;
    let way = vertex.at(time) - from;
    let there = wave.vertex(other).at(time) - from;
    way.dot(there) < way.length() * (way.length() - wave.eps)
}

/// Returns the node where a vertex is at a time.
fn end(wave: &mut Wave, id: u32, time: f64) -> u32 {
    let (at, node) = (wave.vertex(id).at(time), wave.vertex(id).node);
    match wave.nodes[node as usize].at.distance(at) <= wave.eps {
        true => node,
        false => wave.node(at, time),
    }
}
