//! Hidden lines are removed: a fine grid of depths tells which parts of an edge something else covers.
//!
//! Ends of visible edges are exact where they are corners of the model, and exact to the grid, a tenth of a millimetre on
//! paper, where something covers the rest.

use crate::look::Look;
use crate::paper::{Bounds, Role};
use crate::subject::{Body, Subject};
use crate::{edges, merge};
use glam::{DVec2, DVec3, dvec2};

/// The distance of rays, millimetres on paper.
const STEP: f64 = 0.1;

/// The maximum number of rays; the grid becomes coarser above it.
const MOST_RAYS: f64 = 24e6;

/// What is nearer than this to an edge does not hide it, metres.
const NEAR: f64 = 3e-3;

/// The nearest surface along each ray.
pub(super) struct Depths<'s> {
    look: Look,
    origin: DVec2,
    step: f64,
    width: usize,
    height: usize,
    /// Depth and number of the nearest triangle.
    nearest: Vec<(f32, u32)>,
    triangles: Vec<[DVec3; 3]>,
    subject: &'s Subject<'s>,
}

/// No triangle.
const NOTHING: u32 = u32::MAX;

impl<'s> Depths<'s> {
    /// Casts rays at everything behind the cut of a look.
    pub(super) fn new(subject: &'s Subject<'s>, look: Look) -> Depths<'s> {
        let mut bounds = Bounds::default();
        let points = subject.bodies.iter().flat_map(|b| &b.points);
        points.for_each(|p| bounds.add(look.paper(*p)));
        let size = bounds.size();
        let step = STEP.max((size.x * size.y / MOST_RAYS).sqrt());
        let count = |length: f64| (length / step).ceil() as usize + 3;
        let mut depths = Depths {
            look,
            origin: bounds.low.min(bounds.high) - step,
            step,
            width: count(size.x),
            height: count(size.y),
            nearest: vec![],
            triangles: vec![],
            subject,
        };
        depths.nearest = vec![(f32::INFINITY, NOTHING); depths.width * depths.height];
        for body in &subject.bodies {
            for t in &body.triangles {
                depths.cast(t.map(|c| body.points[c as usize]));
            }
        }
        depths
    }

    /// Takes note of a triangle.
    fn cast(&mut self, corners: [DVec3; 3]) {
        let far = corners.map(|p| self.look.depth(p));
        if far.iter().all(|d| *d < self.look.cut) {
            return;
        }
        let [p, q, r] = corners.map(|p| (self.look.paper(p) - self.origin) / self.step);
        let area = (q - p).perp_dot(r - p);
        if area.abs() < 1e-9 {
            return;
        }
        let number = self.triangles.len() as u32;
        self.triangles.push(corners);
        let low = p.min(q).min(r).ceil().max(DVec2::ZERO);
        let high = p.max(q).max(r).floor();
        for j in low.y as usize..=(high.y.max(0.0) as usize).min(self.height - 1) {
            for i in low.x as usize..=(high.x.max(0.0) as usize).min(self.width - 1) {
                let at = dvec2(i as f64, j as f64);
                let side = |a: DVec2, b: DVec2| (b - a).perp_dot(at - a) / area;
                let (u, v, w) = (side(q, r), side(r, p), side(p, q));
                if u < 0.0 || v < 0.0 || w < 0.0 {
                    continue;
                }
                let depth = far[0] * u + far[1] * v + far[2] * w;
                let nearest = &mut self.nearest[j * self.width + i];
                if depth >= self.look.cut && (depth as f32) < nearest.0 {
                    *nearest = (depth as f32, number);
                }
            }
        }
    }

    /// Returns true if nothing lies before a point.
    pub(super) fn is_seen(&self, p: DVec3) -> bool {
        let at = ((self.look.paper(p) - self.origin) / self.step).round();
        if at.cmplt(DVec2::ZERO).any() || at.x >= self.width as f64 || at.y >= self.height as f64 {
            return true;
        }
        let (_, number) = self.nearest[at.y as usize * self.width + at.x as usize];
        number == NOTHING || self.depth_of(number, p) > self.look.depth(p) - NEAR
    }

    /// Returns how far the plane of a triangle is before or behind a point, no farther than its corners are.
    fn depth_of(&self, number: u32, p: DVec3) -> f64 {
        let corners = self.triangles[number as usize];
        let [a, b, c] = corners;
        let depths = corners.map(|c| self.look.depth(c));
        let (low, high) = depths
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), d| (l.min(*d), h.max(*d)));
        let normal = (b - a).cross(c - a);
        let along = normal.dot(self.look.way);
        if along.abs() < 1e-12 {
            return low;
        }
        let depth = self.look.depth(p) + normal.dot(a - p) / along;
        depth.clamp(low, high)
    }

    /// Returns the parts of a line that nothing hides, on paper.
    pub(super) fn visible(&self, [from, to]: [DVec3; 2], into: &mut Vec<[DVec2; 2]>) {
        let Some([from, to]) = self.behind_cut([from, to]) else {
            return;
        };
        let [p, q] = [from, to].map(|p| self.look.paper(p));
        let length = p.distance(q);
        if length < self.step / 2.0 {
            return;
        }
        let count = (length / self.step).ceil().max(2.0) as usize;
        let at = |k: f64| k / count as f64;
        let seen = |k: usize| self.is_seen(from.lerp(to, at(k as f64 + 0.5)));
        let mut begun: Option<usize> = None;
        for k in 0..=count {
            match (begun, k < count && seen(k)) {
                (None, true) => begun = Some(k),
                (Some(first), false) => {
                    begun = None;
                    // What shows for less than two rays is a gap between them.
                    if k - first > 1 || count <= 2 {
                        into.push([p.lerp(q, at(first as f64)), p.lerp(q, at(k as f64))]);
                    }
                }
                _ => (),
            }
        }
    }

    /// Returns the part of a line behind the cut.
    fn behind_cut(&self, line: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [a, b] = line.map(|p| self.look.depth(p) - self.look.cut);
        if self.look.cut == f64::NEG_INFINITY || (a >= 0.0 && b >= 0.0) {
            return Some(line);
        }
        if a < 0.0 && b < 0.0 {
            return None;
        }
        let at = line[0].lerp(line[1], a / (a - b));
        Some(if a < 0.0 {
            [at, line[1]]
        } else {
            [line[0], at]
        })
    }

    /// Returns all visible edges, each stretch once.
    pub(super) fn lines(&self) -> Vec<[DVec2; 2]> {
        let mut found = vec![];
        // A plan draws mats as their edges alone.
        let drawn = |body: &&Body| body.role != Role::Mat || !self.look.is_down();
        for body in self.subject.bodies.iter().filter(drawn) {
            for edge in edges::edges(body, &self.look) {
                self.visible(edge, &mut found);
            }
        }
        merge::merged(found)
    }
}
