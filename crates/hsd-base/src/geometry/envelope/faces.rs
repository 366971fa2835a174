//! The faces of the solid over the cells of a plot: closed, outward, each on the plane of a limit or upright over a line.

use super::{Cell, Limit, ON};
use glam::{DVec2, DVec3};

/// Lines nearer to each other than this are one, metres.
const SAME_LINE: f64 = 1e-6;

/// What bounds the solid at a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The ground.
    Ground,
    /// The plane of a limit.
    Limit(usize),
    /// The line where a limit ceases to count.
    End(usize),
    /// The border of the plot, or of what its houses keep clear.
    Side,
}

/// A face of the solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// What bounds it.
    pub bound: Bound,
    /// Its corners, counter-clockwise seen from outside; plane and convex.
    pub ring: Vec<DVec3>,
}

/// A side of a cell.
#[derive(Clone, Copy)]
struct Edge {
    from: DVec2,
    to: DVec2,
    cell: usize,
}

impl Edge {
    /// Returns true if the boxes of both meet.
    fn is_near(self, other: Edge) -> bool {
        let of = |edge: Edge| [edge.from.min(edge.to), edge.from.max(edge.to)];
        let ([a, b], [c, d]) = (of(self), of(other));
        (a - SAME_LINE).cmple(d).all() && (c - SAME_LINE).cmple(b).all()
    }

    fn at(self, share: f64) -> DVec2 {
        match share {
            0.0 => self.from,
            1.0 => self.to,
            share => self.from.lerp(self.to, share),
        }
    }

    /// Returns the shares of this edge along which another one runs in the opposite way.
    fn shared(self, other: Edge) -> Option<[f64; 2]> {
        let way = self.to - self.from;
        let length = way.length();
        let (p, q) = (other.to - self.from, other.from - self.from);
        let (start, end) = (p.dot(way) / length, q.dot(way) / length);
        let off = |p: DVec2| (way.perp_dot(p) / length).abs();
        let runs = end - start > SAME_LINE && end > SAME_LINE && start < length - SAME_LINE;
        if !runs || off(p) > SAME_LINE || off(q) > SAME_LINE {
            return None;
        }
        let snap = |x: f64| match x {
            x if x < SAME_LINE => 0.0,
            x if x > length - SAME_LINE => 1.0,
            x => x / length,
        };
        Some([snap(start), snap(end)])
    }
}

/// Returns the faces of the solid over some cells.
pub fn faces(cells: &[Cell], limits: &[Limit]) -> Vec<Face> {
    let mut found = vec![];
    for cell in cells {
        let limit = &limits[cell.limit];
        let ground = cell.ring.iter().rev().map(|p| p.extend(0.0)).collect();
        let top = cell.ring.iter().map(|p| p.extend(limit.height(*p)));
        let top: Vec<DVec3> = top.collect();
        if top.iter().all(|p| p.z < ON) {
            continue;
        }
        found.push(Face {
            bound: Bound::Ground,
            ring: ground,
        });
        found.push(Face {
            bound: Bound::Limit(cell.limit),
            ring: top,
        });
    }
    let edges = cells.iter().enumerate().flat_map(|(number, cell)| {
        let n = cell.ring.len();
        (0..n).map(move |i| Edge {
            from: cell.ring[i],
            to: cell.ring[(i + 1) % n],
            cell: number,
        })
    });
    let edges: Vec<Edge> = edges.filter(|e| e.from.distance(e.to) > ON).collect();
    for edge in &edges {
        upright(*edge, &edges, (cells, limits), &mut found);
    }
    found
}

/// Adds the upright faces over a side of a cell: where nothing continues it, and where the next cell is lower.
fn upright(edge: Edge, edges: &[Edge], of: (&[Cell], &[Limit]), found: &mut Vec<Face>) {
    let others = edges.iter();
    let others = others.filter(|other| other.cell != edge.cell && edge.is_near(**other));
    let beside = others.filter_map(|other| Some((edge.shared(*other)?, other.cell)));
    let mut beside: Vec<([f64; 2], usize)> = beside.collect();
    beside.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut at = 0.0;
    for ([start, end], other) in beside {
        if start > at {
            wall(edge, [at, start], None, of, found);
        }
        wall(edge, [start.max(at), end], Some(other), of, found);
        at = end.max(at);
    }
    if at < 1.0 {
        wall(edge, [at, 1.0], None, of, found);
    }
}

/// Adds the face over a stretch of a side of a cell, down to the ground or to the top of another cell.
fn wall(
    edge: Edge,
    [start, end]: [f64; 2],
    other: Option<usize>,
    (cells, limits): (&[Cell], &[Limit]),
    found: &mut Vec<Face>,
) {
    if end <= start {
        return;
    }
    let (p, q) = (edge.at(start), edge.at(end));
    let height = |cell: usize, p: DVec2| limits[cells[cell].limit].height(p);
    let foot = |p: DVec2| other.map_or(0.0, |other| height(other, p));
    let rise = |p: DVec2| height(edge.cell, p) - foot(p);
    let (a, b) = (rise(p), rise(q));
    if a < SAME_LINE && b < SAME_LINE {
        return;
    }
    // Where the other cell becomes the higher one, the face is its.
    let (p, q) = match (a < -ON, b < -ON) {
        (true, _) => (p.lerp(q, a / (a - b)), q),
        (_, true) => (p, p.lerp(q, a / (a - b))),
        _ => (p, q),
    };
    let top = |p: DVec2| p.extend(height(edge.cell, p));
    let mut ring = vec![p.extend(foot(p)), q.extend(foot(q)), top(q), top(p)];
    ring.dedup_by(|a, b| a.distance(*b) < ON);
    if ring.len() > 2 && ring[0].distance(ring[ring.len() - 1]) < ON {
        ring.pop();
    }
    if ring.len() < 3 {
        return;
    }
    let bound = other.map_or(Bound::Side, |other| Bound::End(cells[other].limit));
    found.push(Face { bound, ring });
}
