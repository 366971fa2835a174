//! The edges of bodies that a draughtsman draws: where a surface turns, ends, or changes its material, and where a round
//! one turns away.

use crate::look::Look;
use crate::subject::Body;
use glam::DVec3;
use std::collections::BTreeMap;

/// Faces that turn by less are one surface: the cosine of 28 degrees.
const SMOOTH: f64 = 0.88;

/// Normals this far from the plane of the paper's edge belong to faces that are seen.
const FACING: f64 = 1e-6;

/// Returns the edges of a body that are drawn if nothing hides them.
pub(super) fn edges(body: &Body, look: &Look) -> Vec<[DVec3; 2]> {
    let normals: Vec<DVec3> = (0..body.triangles.len()).map(|t| body.normal(t)).collect();
    // In order, so that the same edges come out in the same order everywhere.
    let mut sides: BTreeMap<(u32, u32), [Option<u32>; 3]> = BTreeMap::new();
    for (t, corners) in (0u32..).zip(&body.triangles) {
        if normals[t as usize] == DVec3::ZERO {
            continue;
        }
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let all = sides.entry((a.min(b), a.max(b))).or_default();
            if let Some(free) = all.iter_mut().find(|s| s.is_none()) {
                *free = Some(t);
            }
        }
    }
    let facing = |t: u32| normals[t as usize].dot(look.way) < -FACING;
    let drawn = |faces: &[Option<u32>; 3]| match *faces {
        [Some(p), Some(q), None] => {
            let turns = normals[p as usize].dot(normals[q as usize]) < SMOOTH;
            let other = body.materials[p as usize] != body.materials[q as usize];
            let seen = facing(p) || facing(q);
            seen && (turns || other || facing(p) != facing(q))
        }
        // The border of a sheet, or an edge at which several bodies meet.
        _ => true,
    };
    let kept = sides.iter().filter(|(_, faces)| drawn(faces));
    kept.map(|((a, b), _)| [*a, *b].map(|c| body.points[c as usize]))
        .collect()
}
