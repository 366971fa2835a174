//! Bent rafters (輪垂木 wa-daruki) under an undulating gable: bars side by side that follow its curve from foot to foot, behind its
//! boards and back to the wall.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::Line;
use crate::trim::seams::Seam;
use glam::{DVec2, DVec3};
use hsd_scene::Detail;

/// Height and half width of a bar, metres.
const BAR: (f64, f64) = (0.06, 0.0275);
/// Distance of the first one behind the edge, metres: behind the boards.
const FIRST: f64 = 0.16;
/// Distance from one to the next, metres.
const APART: f64 = 0.27;
/// How far they reach into the roof above them, and into the slope at their ends, metres.
const SUNK: f64 = 0.006;
const INTO: f64 = 0.03;

/// Adds the bent rafters behind a verge, if its roof has any.
pub(in crate::trim) fn rafters(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let Some(arch) = context.roof.trim.arch else {
        return;
    };
    if context.detail < Detail::Everything || arch.depth < FIRST {
        return;
    }
    let last = seam.points.len() - 1;
    let along: DVec2 = (seam.points[last] - seam.points[0]).truncate();
    let inward = along.perp().normalize_or_zero();
    let under = |(i, p): (usize, &DVec3)| {
        let deep = match i {
            0 => seam.spans[0].deep[0],
            _ => seam.spans[i - 1].deep[1],
        };
        *p - DVec3::Z * deep
    };
    let edge: Vec<DVec3> = seam.points.iter().enumerate().map(under).collect();
    let foot = edge[0].z.max(edge[last].z);
    let more = ((arch.depth - FIRST) / APART).floor().clamp(0.0, 40.0) as u32;
    for k in 0..=more {
        let back = FIRST + APART * f64::from(k);
        let points = above(&edge, foot + arch.fall * back - INTO);
        if points.len() < 3 {
            continue;
        }
        let line = Line {
            points: points
                .into_iter()
                .map(|p| p + (inward * back).extend(0.0))
                .collect(),
        };
        let (high, half) = BAR;
        let profile = [(-half, -high), (half, -high), (half, SUNK), (-half, SUNK)];
        let bar = Body::loft(context.timber(), &line.sections(&profile));
        bodies.extend(bar.map(Body::smooth));
    }
}

/// Returns the part of a line, up and down again, that lies above a height.
fn above(line: &[DVec3], low: f64) -> Vec<DVec3> {
    let mut made = vec![];
    for (i, p) in line.iter().enumerate() {
        if i > 0 {
            let before = line[i - 1];
            if (before.z < low) != (p.z < low) {
                made.push(before.lerp(*p, (low - before.z) / (p.z - before.z)));
            }
        }
        if p.z >= low {
            made.push(*p);
        }
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn an_arch_is_cut_at_its_feet() {
        let arch = [0.0, 0.1, 0.5, 0.1, 0.0];
        let points: Vec<DVec3> = (0..5u32)
            .map(|i| dvec3(f64::from(i), 0.0, arch[i as usize]))
            .collect();
        let cut = above(&points, 0.3);
        assert_eq!(cut.len(), 3);
        assert!((cut[0].z - 0.3).abs() < 1e-12 && (cut[2].z - 0.3).abs() < 1e-12);
        assert!((cut[0].x - 1.5).abs() < 1e-12 && (cut[2].x - 2.5).abs() < 1e-12);
        assert_eq!(above(&points, -1.0).len(), 5);
        assert!(above(&points, 1.0).is_empty());
    }
}
