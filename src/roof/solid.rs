//! Small closed solids: prisms and bent boards.

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

/// A bent board: between an upper and a lower chain of corners in one plane, swept along `by`.
/// Both chains have the same number of corners and run the same way.
pub fn bent_board(upper: &[DVec3], lower: &[DVec3], by: DVec3, finish: Finish) -> Solid {
    let n = upper.len().min(lower.len()) as u32;
    let normal = (lower[0] - upper[0]).cross(upper[1] - upper[0]);
    let mut points: Vec<DVec3> = Vec::with_capacity(n as usize * 4);
    for i in 0..n as usize {
        points.extend([upper[i], lower[i], upper[i] + by, lower[i] + by]);
    }
    // Seen from before the board, chains must run to the right: turn everything if they do not.
    let flip = normal.dot(by) > 0.0;
    let mut faces = Vec::with_capacity(n as usize * 4);
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
    fn bent_boards_are_closed_whatever_their_sweep() {
        let upper = [
            dvec3(-2.0, 0.0, 1.0),
            dvec3(0.0, 0.0, 2.0),
            dvec3(2.0, 0.0, 1.0),
        ];
        let lower = upper.map(|p| p - DVec3::Z * 0.2);
        for by in [DVec3::Y, DVec3::NEG_Y] {
            assert_eq!(
                solid_flaws(&bent_board(&upper, &lower, by, Finish::Timber)).count(),
                0
            );
        }
    }
}
