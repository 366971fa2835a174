//! Small closed solids: prisms, and walls under a bent line.

use crate::building::{Corners, Face, Finish, Solid};
use glam::DVec3;

/// The solid that a convex plane profile sweeps along `by`; the profile may run either way round.
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

/// A wall from a level foot up to a chain of corners in one upright plane, swept along `by`. The chain stands
/// over the foot everywhere.
pub fn curtain(upper: &[DVec3], foot: f64, by: DVec3, finish: Finish) -> Solid {
    let n = upper.len() as u32;
    let mut points: Vec<DVec3> = Vec::with_capacity(upper.len() * 4);
    for p in upper {
        let low = p.truncate().extend(foot);
        points.extend([*p, low, *p + by, low + by]);
    }
    // Seen from before the wall, the chain must run to the right: turn everything if it does not.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::solid_flaws;
    use glam::dvec3;

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
}
