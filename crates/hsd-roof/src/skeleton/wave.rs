//! The moving outline: rings of vertices, each on the path of two lines that move inwards at one speed.

use super::SkeletonNode;
use super::contour::{Contours, lines};
use super::line::EdgeLine;
use glam::DVec2;
use hsd_base::geometry::tolerance::PARALLEL;

/// Returns the velocity of the meeting point of two lines that move at speed 1; `None` if they are parallel and face
/// each other, so that they meet everywhere at once.
pub fn velocity(left: DVec2, right: DVec2) -> Option<DVec2> {
    let (sine, cosine) = (left.perp_dot(right), left.dot(right));
    if cosine > 0.0 {
        return Some((left + right) / (1.0 + cosine));
    }
    // By Cramer's rule: 1 + cosine would lose its digits here.
    (sine.abs() > PARALLEL).then(|| (left - right).perp() / sine)
}

/// A vertex of the moving outline, from the node where it began.
#[derive(Clone, Debug)]
pub(super) struct Vertex {
    /// The one before it in its ring.
    pub(super) prev: u32,
    /// The one after it.
    pub(super) next: u32,
    /// The edge that ends at it.
    pub(super) left: u32,
    /// The edge that starts at it.
    pub(super) right: u32,
    /// The node where it began.
    pub(super) node: u32,
    start: SkeletonNode,
    /// `None` if its edges coincide: it ends at once.
    pub(super) velocity: Option<DVec2>,
    pub(super) alive: bool,
}

impl Vertex {
    /// Returns its position at a time.
    pub(super) fn at(&self, time: f64) -> DVec2 {
        self.start.at + self.velocity.unwrap_or_default() * (time - self.start.time)
    }
}

/// A part of the path of a vertex or of a ridge: a border between two faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    /// Its first node.
    pub(super) from: u32,
    pub(super) to: u32,
    /// The face on its left.
    pub(super) left: u32,
    /// The face on its right.
    pub(super) right: u32,
}

/// The moving outline, and the borders it has left behind.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    pub(super) lines: Vec<EdgeLine>,
    pub(super) vertices: Vec<Vertex>,
    pub(super) nodes: Vec<SkeletonNode>,
    pub(super) arcs: Vec<Arc>,
    /// The vertices at which pieces of each edge start, including dead ones.
    pieces: Vec<Vec<u32>>,
    pub(super) alive: usize,
    /// Lengths and times below this count as zero, metres.
    pub(super) eps: f64,
}

impl Wave {
    /// Creates the outline at time 0.
    pub(super) fn of(contours: &Contours) -> Wave {
        let lines = lines(contours);
        let n = lines.len();
        let mut wave = Wave {
            lines,
            vertices: Vec::with_capacity(3 * n),
            nodes: Vec::with_capacity(2 * n),
            arcs: Vec::with_capacity(3 * n),
            pieces: vec![Vec::new(); n],
            alive: 0,
            eps: 1e-9 * contours.size.max(1.0),
        };
        for ([at, _], ..) in contours.each() {
            wave.nodes.push(SkeletonNode { at, time: 0.0 });
        }
        for (i, (_, _, before)) in contours.each().enumerate() {
            wave.begin(i as u32, before, i as u32);
        }
        for (i, (_, _, before)) in contours.each().enumerate() {
            wave.link(before, i as u32);
        }
        wave
    }

    /// Creates a vertex between two edges at a node, without neighbours yet.
    pub(super) fn begin(&mut self, node: u32, left: u32, right: u32) -> u32 {
        let id = self.vertices.len() as u32;
        let normal = |edge: u32| self.lines[edge as usize].normal;
        self.vertices.push(Vertex {
            prev: id,
            next: id,
            left,
            right,
            node,
            start: self.nodes[node as usize],
            velocity: velocity(normal(left), normal(right)),
            alive: true,
        });
        self.pieces[right as usize].push(id);
        self.alive += 1;
        id
    }

    pub(super) fn link(&mut self, before: u32, after: u32) {
        self.vertices[before as usize].next = after;
        self.vertices[after as usize].prev = before;
    }

    pub(super) fn vertex(&self, id: u32) -> &Vertex {
        &self.vertices[id as usize]
    }

    /// Ends a vertex at a node: its path becomes an arc.
    pub(super) fn end(&mut self, id: u32, node: u32) {
        let vertex = &mut self.vertices[id as usize];
        vertex.alive = false;
        self.alive -= 1;
        let (from, left, right) = (vertex.node, vertex.left, vertex.right);
        self.arc(Arc {
            from,
            to: node,
            left,
            right,
        });
    }

    pub(super) fn arc(&mut self, arc: Arc) {
        if arc.from != arc.to {
            self.arcs.push(arc);
        }
    }

    pub(super) fn node(&mut self, at: DVec2, time: f64) -> u32 {
        self.nodes.push(SkeletonNode { at, time });
        self.nodes.len() as u32 - 1
    }

    /// Returns the vertices at which pieces of an edge start.
    pub(super) fn pieces(&mut self, edge: u32) -> &[u32] {
        let vertices = &self.vertices;
        let pieces = &mut self.pieces[edge as usize];
        pieces.retain(|v| vertices[*v as usize].alive);
        pieces
    }

    pub(super) fn way(&self, edge: u32) -> DVec2 {
        self.lines[edge as usize].way()
    }

    /// Returns true if the outline turns right at a vertex, so that the vertex may split another edge.
    pub(super) fn is_reflex(&self, id: u32) -> bool {
        let v = self.vertex(id);
        v.velocity.is_some() && self.way(v.left).perp_dot(self.way(v.right)) < -1e-10
    }
}
