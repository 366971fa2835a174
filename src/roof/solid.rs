//! Small closed solids: prisms.

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
}
