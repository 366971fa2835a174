//! Kitsune-goshi (狐格子): the square lattice before the boards of an irimoya's gable, with the board at its foot
//! (前包 maezutsumi). The bars end where the wall does, under the slopes and over the roof at its foot, however other
//! roofs cut it.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::seams::{Kind, Seam};
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::building::{Finish, Solid};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Distance between bars as a share of the height of the gable, and its bounds, metres.
const PITCH: f64 = 0.08;
const PITCHES: (f64, f64) = (0.12, 0.28);
/// Width of a bar as a share of the distance.
const BAR: f64 = 0.3;
/// How far upright and level bars stand before the wall, and how far all of them lie in it, metres.
const BEFORE: (f64, f64) = (0.030, 0.024);
const SUNK: f64 = 0.012;
/// How much earlier they end than the wall, so that no two ends share a plane, metres.
const SHORT: f64 = 0.004;
/// The board at the foot: its height as a share of the gable's, the bounds of that, and its thickness, metres.
const FOOT: f64 = 0.09;
const FOOTS: (f64, f64) = (0.12, 0.32);
const FOOT_THICK: f64 = 0.05;
/// The least gable with a lattice: its width in metres.
const LEAST: f64 = 0.6;
/// Seams and pieces of walls within this distance of a plane belong to it, metres.
const NEAR: f64 = 0.15;

/// The visible face of a gable wall in its plane.
struct Wall {
    /// Direction out of the house, and distance of the face along it, metres.
    out: DVec2,
    at: f64,
    /// Its pieces: distance along the wall, and height.
    pieces: Vec<Vec<DVec2>>,
}

/// Adds the lattices of all gable walls of a roof.
pub(in crate::trim) fn lattices(context: &TrimContext<'_>, seams: &[Seam], bodies: &mut Vec<Body>) {
    if !context.roof.trim.lattice || context.detail < Detail::Everything {
        return;
    }
    let verges = seams.iter().filter(|s| s.kind == Kind::Verge);
    let outs = verges.filter_map(|s| {
        let along = s.points[s.points.len() - 1] - s.points[0];
        (-along.truncate().perp()).try_normalize()
    });
    let mut walls: Vec<Wall> = vec![];
    for out in outs {
        for solid in &context.roof.solids {
            add(solid, out, &mut walls);
        }
    }
    for wall in &walls {
        wall.lattice(context.timber(), seams, bodies);
    }
}

/// Adds the outer faces of a gable's fill to the wall in whose plane they lie.
fn add(solid: &Solid, out: DVec2, walls: &mut Vec<Wall>) {
    for face in solid.faces.iter().filter(|f| f.finish == Finish::Gable) {
        let corners = face.corners.iter().map(|c| solid.points[*c as usize]);
        let corners: Vec<DVec3> = corners.collect();
        let at = out.dot(corners[0].truncate());
        let plane = corners
            .iter()
            .all(|p| (out.dot(p.truncate()) - at).abs() < 1e-6);
        let flat = |p: &DVec3| dvec2(out.perp().dot(p.truncate()), p.z);
        let piece: Vec<DVec2> = corners.iter().map(flat).collect();
        // Seen from outside, counter-clockwise: the other face of the fill is clockwise.
        if !plane || hsd_base::geometry::area2(&piece) <= 1e-6 {
            continue;
        }
        let same = |w: &&mut Wall| w.out.dot(out) > 1.0 - 1e-9 && (w.at - at).abs() < 1e-6;
        match walls.iter_mut().find(same) {
            Some(wall) if wall.pieces.contains(&piece) => {}
            Some(wall) => wall.pieces.push(piece),
            None => walls.push(Wall {
                out,
                at,
                pieces: vec![piece],
            }),
        }
    }
}

impl Wall {
    fn lattice(&self, timber: SurfaceId, seams: &[Seam], bodies: &mut Vec<Body>) {
        let corners = || self.pieces.iter().flatten();
        let bounds = |of: fn(&DVec2) -> f64| {
            corners().fold((f64::MAX, f64::MIN), |(lo, hi), p| {
                (lo.min(of(p)), hi.max(of(p)))
            })
        };
        let (left, right) = bounds(|p| p.x);
        let (low, high) = bounds(|p| p.y);
        let foot = self.foot(seams).unwrap_or(low).clamp(low, high);
        let height = high - foot;
        if right - left < LEAST || height < LEAST / 2.0 {
            return;
        }
        let pitch = (height * PITCH).clamp(PITCHES.0, PITCHES.1);
        let half = pitch * BAR / 2.0;
        let board = foot + (height * FOOT).clamp(FOOTS.0, FOOTS.1);
        // One bar stands under the apex.
        let apex = corners().fold(left, |at, p| match p.y > high - 1e-6 {
            true => at.max(p.x),
            false => at,
        });
        let first = ((left - apex) / pitch).ceil() as i64;
        let last = ((right - apex) / pitch).floor() as i64;
        for i in first..=last {
            let u = apex + i as f64 * pitch;
            for (from, to) in self.spans(|p| dvec2(p.y, p.x), u) {
                let bar = (dvec2(u - half, from), dvec2(u + half, to));
                bodies.extend(self.bar(timber, bar, BEFORE.0));
            }
        }
        let rows = ((high - board) / pitch).floor() as i64;
        for i in 1..=rows {
            let z = board + i as f64 * pitch;
            for (from, to) in self.spans(|p| p, z) {
                let bar = (dvec2(from, z - half), dvec2(to, z + half));
                bodies.extend(self.bar(timber, bar, BEFORE.1));
            }
        }
        for (from, to) in self.spans(|p| p, board) {
            let board = (dvec2(from, low + SHORT), dvec2(to, board));
            bodies.extend(self.bar(timber, board, FOOT_THICK));
        }
    }

    /// Returns the height of the covering at the foot of the wall.
    fn foot(&self, seams: &[Seam]) -> Option<f64> {
        let near = |p: &DVec3| (self.out.dot(p.truncate()) - self.at).abs() < NEAR;
        let crests = seams.iter().filter(|s| s.kind == Kind::Crest);
        let own = crests.filter(|s| s.points.iter().all(near));
        let heights = own.flat_map(|s| s.points.iter().map(|p| p.z));
        heights.reduce(f64::max)
    }

    /// Returns the stretches in which a level line at `at` lies in the wall; `turned` gives corners in the frame of the line.
    fn spans(&self, turned: impl Fn(DVec2) -> DVec2, at: f64) -> Vec<(f64, f64)> {
        let mut spans: Vec<(f64, f64)> = vec![];
        for piece in &self.pieces {
            let ring = piece.iter().map(|p| turned(*p));
            let ring: Vec<DVec2> = ring.collect();
            let mut hits: Vec<f64> = vec![];
            for (i, p) in ring.iter().enumerate() {
                let q = ring[(i + 1) % ring.len()];
                if (p.y > at) != (q.y > at) {
                    hits.push(p.x + (at - p.y) / (q.y - p.y) * (q.x - p.x));
                }
            }
            hits.sort_by(f64::total_cmp);
            spans.extend(hits.chunks_exact(2).map(|w| (w[0], w[1])));
        }
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut joined: Vec<(f64, f64)> = vec![];
        for (from, to) in spans {
            match joined.last_mut() {
                Some(last) if from < last.1 + 1e-6 => last.1 = last.1.max(to),
                _ => joined.push((from, to)),
            }
        }
        let shorter = joined
            .into_iter()
            .map(|(from, to)| (from + SHORT, to - SHORT));
        shorter.filter(|(from, to)| from < to).collect()
    }

    /// Returns a bar between two corners, `before` metres before the wall.
    fn bar(&self, timber: SurfaceId, (lo, hi): (DVec2, DVec2), before: f64) -> Option<Body> {
        let along = self.out.perp();
        let corner = |u: f64, z: f64| (along * u + self.out * (self.at - SUNK)).extend(z);
        let section = [(lo.x, lo.y), (hi.x, lo.y), (hi.x, hi.y), (lo.x, hi.y)];
        let section = section.iter().map(|(u, z)| corner(*u, *z)).collect();
        let way = (self.out * (before + SUNK)).extend(0.0);
        Body::sweep(timber, section, way)
    }
}
