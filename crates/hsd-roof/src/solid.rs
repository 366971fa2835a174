//! Small closed solids: prisms, and walls under a polygonal line.

pub mod sheet;
pub mod massive;

use glam::DVec3;
use hsd_base::geometry::tolerance::HEIGHT;
use hsd_ir::building::{Corners, Face, Finish, Solid};
use smallvec::SmallVec;

/// Returns the solid that a convex plane profile sweeps along `by`; the profile may run either way round.
pub fn prism(profile: &[DVec3], by: DVec3, finish: Finish) -> Solid {
    let n = profile.len() as u32;
    let normal = profile
        .windows(2)
        .map(|w| (w[0] - profile[0]).cross(w[1] - profile[0]))
        .sum::<DVec3>();
    // The first cap must look away from the sweep.
    let flip = normal.dot(by) > 0.0;
    let mut points = Vec::with_capacity(profile.len() * 2);
    match flip {
        true => points.extend(profile.iter().rev()),
        false => points.extend_from_slice(profile),
    }
    points.extend_from_within(..);
    points[n as usize..].iter_mut().for_each(|p| *p += by);
    let mut faces = Vec::with_capacity(profile.len() + 2);
    let face = |corners: Corners| Face { corners, finish };
    faces.push(face((0..n).collect()));
    faces.push(face((n..2 * n).rev().collect()));
    faces.extend((0..n).map(|i| {
        let j = (i + 1) % n;
        face(Corners::from_slice(&[j, i, i + n, j + n]))
    }));
    Solid { points, faces }
}

/// Returns a wall from a level foot up to a chain of corners in one vertical plane, swept along `by`. The chain stands
/// over the foot everywhere.
pub fn curtain(upper: &[DVec3], foot: f64, by: DVec3, finish: Finish) -> Solid {
    band(upper, &vec![foot; upper.len()], by, finish)
}

/// Returns a wall between a chain of corners in one vertical plane and the heights below each of them, swept along `by`.
pub fn band(upper: &[DVec3], feet: &[f64], by: DVec3, finish: Finish) -> Solid {
    let n = upper.len() as u32;
    let mut points: Vec<DVec3> = Vec::with_capacity(upper.len() * 4);
    for (p, foot) in upper.iter().zip(feet) {
        let low = p.truncate().extend(*foot);
        points.extend([*p, low, *p + by, low + by]);
    }
    // Seen from in front of the wall, the chain must run to the right; if not, everything is reversed.
    let way = upper[upper.len() - 1] - upper[0];
    let flip = way.cross(DVec3::Z).dot(by) > 0.0;
    let mut faces = Vec::with_capacity(upper.len() * 4);
    let mut face = |mut corners: [u32; 4]| {
        if flip {
            corners.reverse();
        }
        let corners = Corners::from_slice(&corners);
        faces.push(Face { corners, finish });
    };
    for i in 0..n - 1 {
        let (p, q) = (4 * i, 4 * i + 4);
        face([p, p + 1, q + 1, q]);
        face([p + 2, q + 2, q + 3, p + 3]);
        face([p, q, q + 2, p + 2]);
        face([p + 1, p + 3, q + 3, q + 1]);
    }
    let last = 4 * (n - 1);
    face([0, 2, 3, 1]);
    face([last, last + 1, last + 3, last + 2]);
    Solid { points, faces }
}

/// Thickness of a gable infill, metres, centred on the wall line.
pub const INFILL_THICKNESS: f64 = 0.07;

/// Depth to which gable infills penetrate adjoining solids, metres; avoids cracks and coplanar faces.
pub const SUNK: f64 = 0.01;

/// Returns the convex parts of a prism or a [`curtain`]: of a curtain one for each segment of its chain.
pub(super) fn columns(wall: &Solid) -> Vec<Solid> {
    let pieces = (wall.points.len() / 4).saturating_sub(1);
    let finish = wall.faces[0].finish;
    if !wall.points.len().is_multiple_of(4)
        || wall.faces.len() != 4 * pieces + 2
        || pieces < 2
        || is_convex(wall)
    {
        return vec![wall.clone()];
    }
    let column = |of: &[DVec3]| {
        let profile = [of[0], of[1], of[5], of[4]];
        prism(&profile, of[2] - of[0], finish)
    };
    (0..pieces)
        .map(|i| column(&wall.points[4 * i..4 * i + 8]))
        .collect()
}

fn is_convex(solid: &Solid) -> bool {
    solid.faces.iter().all(|face| {
        let at = |i: usize| solid.points[face.corners[i] as usize];
        let normal = (at(1) - at(0)).cross(at(2) - at(0)).normalize_or_zero();
        solid.points.iter().all(|p| normal.dot(*p - at(0)) < HEIGHT)
    })
}

/// Returns the part of a convex solid where `normal . p <= at`; `None` if nothing is left.
pub(super) fn clip(solid: &Solid, normal: DVec3, at: f64) -> Option<Solid> {
    let beyond = |p: &DVec3| match normal.dot(*p) - at {
        d if d.abs() < HEIGHT => 0.0,
        d => d,
    };
    let depths: SmallVec<[f64; 24]> = solid.points.iter().map(beyond).collect();
    let depths = &depths[..];
    if depths.iter().all(|d| *d <= 0.0) {
        return depths.iter().any(|d| *d < 0.0).then(|| solid.clone());
    }
    if depths.iter().all(|d| *d >= 0.0) {
        return None;
    }
    let mut points = Vec::with_capacity(solid.points.len() + 8);
    points.extend_from_slice(&solid.points);
    let mut cuts: Vec<(u32, u32, u32)> = Vec::with_capacity(8);
    let mut faces = Vec::with_capacity(solid.faces.len() + 1);
    for face in &solid.faces {
        let own = &face.corners[..];
        let mut corners = Corners::new();
        let mut is_inside = false;
        for (i, &p) in own.iter().enumerate() {
            let q = own[if i + 1 == own.len() { 0 } else { i + 1 }];
            let (dp, dq) = (depths[p as usize], depths[q as usize]);
            if dp <= 0.0 {
                corners.push(p);
                is_inside |= dp < 0.0;
            }
            if dp * dq < 0.0 {
                let (lo, hi) = (p.min(q), p.max(q));
                let known = cuts.iter().find(|c| (c.0, c.1) == (lo, hi)).map(|c| c.2);
                corners.push(known.unwrap_or_else(|| {
                    let (d, e) = (depths[lo as usize], depths[hi as usize]);
                    let cut = points[lo as usize].lerp(points[hi as usize], d / (d - e));
                    points.push(cut);
                    let id = points.len() as u32 - 1;
                    cuts.push((lo, hi, id));
                    id
                }));
            }
        }
        if corners.len() > 2 && is_inside {
            faces.push(Face {
                corners,
                finish: face.finish,
            });
        }
    }
    let finish = solid.faces[0].finish;
    let lid = lid(&faces, &points, depths, normal)?;
    faces.push(Face {
        corners: lid,
        finish,
    });
    Some(packed(&points, faces))
}

/// Returns the face that closes a cut: the corners on it, ordered about its normal.
fn lid(faces: &[Face], points: &[DVec3], depths: &[f64], normal: DVec3) -> Option<Corners> {
    let on = |c: &u32| depths.get(*c as usize).is_none_or(|d| *d == 0.0);
    let mut all: SmallVec<[u32; 16]> = faces
        .iter()
        .flat_map(|f| f.corners.iter().copied())
        .filter(on)
        .collect();
    all.sort_unstable();
    all.dedup();
    let middle = all.iter().map(|c| points[*c as usize]).sum::<DVec3>() / all.len().max(1) as f64;
    let (x, y) = normal.any_orthonormal_pair();
    let angle = |c: u32| {
        let way = points[c as usize] - middle;
        (libm::atan2(y.dot(way), x.dot(way)), c)
    };
    if all.len() < 3 {
        return None;
    }
    let mut turned: SmallVec<[(f64, u32); 16]> = all.into_iter().map(angle).collect();
    turned.sort_by(|p, q| p.0.total_cmp(&q.0));
    Some(turned.into_iter().map(|t| t.1).collect())
}

/// Returns a solid of these faces with the points they use.
fn packed(points: &[DVec3], faces: Vec<Face>) -> Solid {
    let mut number: SmallVec<[u32; 32]> = SmallVec::from_elem(u32::MAX, points.len());
    let mut solid = Solid {
        points: Vec::with_capacity(points.len()),
        faces,
    };
    for corner in solid.faces.iter_mut().flat_map(|f| f.corners.iter_mut()) {
        let place = &mut number[*corner as usize];
        if *place == u32::MAX {
            *place = solid.points.len() as u32;
            solid.points.push(points[*corner as usize]);
        }
        *corner = *place;
    }
    solid
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use hsd_ir::check::solid_flaws;

    #[test]
    fn prisms_are_closed_whatever_their_sweep() {
        let profile = [
            dvec3(0.0, 0.0, 0.0),
            dvec3(2.0, 0.0, 0.0),
            dvec3(1.0, 0.0, 1.0),
        ];
        for by in [DVec3::Y, DVec3::NEG_Y] {
            assert_eq!(solid_flaws(&prism(&profile, by, Finish::Gable)).count(), 0);
        }
    }

    #[test]
    fn curtains_are_closed_whatever_their_sweep() {
        let heights = [1.0, 2.0, 1.3, 2.0].into_iter().enumerate();
        let mut chain: Vec<DVec3> = heights.map(|(n, z)| dvec3(n as f64, 0.0, z)).collect();
        for by in [DVec3::Y, DVec3::NEG_Y] {
            assert_eq!(
                solid_flaws(&curtain(&chain, 0.5, by, Finish::Gable)).count(),
                0
            );
            chain.reverse();
        }
    }

    #[test]
    fn a_clipped_prism_is_closed_on_both_sides_of_the_cut() {
        let profile = [
            dvec3(0.0, 0.0, 0.0),
            dvec3(2.0, 0.0, 0.0),
            dvec3(1.0, 0.0, 1.0),
        ];
        let gable = prism(&profile, DVec3::Y, Finish::Gable);
        // Through a corner, and free.
        for at in [1.0, 0.5] {
            let normal = DVec3::X;
            for sign in [1.0, -1.0] {
                let half = clip(&gable, normal * sign, at * sign).expect("is cut");
                assert_eq!(solid_flaws(&half).count(), 0);
            }
        }
        assert!(clip(&gable, DVec3::Z, 0.0).is_none());
        assert_eq!(
            clip(&gable, DVec3::Z, 1.0).expect("is whole").points,
            gable.points
        );
    }
}
