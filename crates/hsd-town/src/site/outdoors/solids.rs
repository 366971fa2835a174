//! Bodies of faces: columns, beams, ribbons. Faces run counter-clockwise seen from outside; places are metres from the place of the house.

use glam::{DVec2, DVec3, dvec2};
use std::f64::consts::TAU;

/// Faces of one surface.
pub(super) type Faces = Vec<Vec<DVec3>>;

/// Returns a round column that narrows from one radius to another, with its top; its foot is not seen.
pub(super) fn column(foot: DVec3, height: f64, [low, high]: [f64; 2], sides: u32) -> Faces {
    let ring = |radius: f64, z: f64| -> Vec<DVec3> {
        let way = |k: u32| {
            let angle = TAU * (f64::from(k) + 0.5) / f64::from(sides);
            dvec2(libm::cos(angle), libm::sin(angle))
        };
        (0..sides)
            .map(|k| foot + (way(k) * radius).extend(z))
            .collect()
    };
    let (low, high) = (ring(low, 0.0), ring(high, height));
    let mut faces = walls(&low, &high);
    faces.push(high);
    faces
}

/// Returns a beam of a rectangular section between two places, with its ends.
pub(super) fn beam(from: DVec3, to: DVec3, [width, height]: [f64; 2]) -> Faces {
    let along = (to - from).normalize_or_zero();
    let side = along.cross(DVec3::Z);
    let side = match side.length_squared() < 1e-9 {
        true => DVec3::X,
        false => side.normalize(),
    };
    let up = side.cross(along);
    let corner = |(x, y): (f64, f64)| side * (x * width / 2.0) + up * (y * height / 2.0);
    let section = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
    let (near, far): (Vec<DVec3>, Vec<DVec3>) =
        section.iter().map(|off| (from + *off, to + *off)).unzip();
    // Seen against its direction the section runs counter-clockwise.
    let mut faces = walls(&far, &near);
    faces.push(near);
    faces.push(far.into_iter().rev().collect());
    faces
}

/// Returns a box: its middle, half its length along a level direction and half its width across, its lowest and highest place.
pub(super) fn case(middle: DVec2, along: DVec2, half: [f64; 2], [low, high]: [f64; 2]) -> Faces {
    let corner = |(x, y): (f64, f64)| middle + along * (x * half[0]) + along.perp() * (y * half[1]);
    let ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
    let (foot, top): (Vec<DVec3>, Vec<DVec3>) =
        ring.iter().map(|p| (p.extend(low), p.extend(high))).unzip();
    let mut faces = walls(&foot, &top);
    faces.push(top);
    faces.push(foot.into_iter().rev().collect());
    faces
}

/// Returns an upright ribbon along places, seen from both sides.
pub(super) fn ribbon(places: &[DVec3], height: f64) -> Faces {
    let (down, up) = (DVec3::Z * (-height / 2.0), DVec3::Z * (height / 2.0));
    let both = |ends: &[DVec3]| {
        let (p, q) = (ends[0], ends[1]);
        let face = vec![p + down, q + down, q + up, p + up];
        let back = face.iter().rev().copied().collect();
        [face, back]
    };
    places.windows(2).flat_map(both).collect()
}

/// Returns the faces between a ring and another above it.
fn walls(low: &[DVec3], high: &[DVec3]) -> Faces {
    let n = low.len();
    let next = |i: usize| (i + 1) % n;
    let wall = |i: usize| vec![low[i], low[next(i)], high[next(i)], high[i]];
    (0..n).map(wall).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// Six times the volume that faces enclose, if they are closed; of open ones some number.
    fn volume(faces: &Faces) -> f64 {
        let fan = |face: &Vec<DVec3>| {
            let triangle = |i: usize| face[0].dot(face[i].cross(face[i + 1]));
            (1..face.len() - 1).map(triangle).sum::<f64>()
        };
        faces.iter().map(fan).sum::<f64>() / 6.0
    }

    #[test]
    fn bodies_look_outwards() {
        let found = case(dvec2(3.0, 4.0), dvec2(0.6, 0.8), [2.0, 1.0], [1.0, 4.0]);
        assert!((volume(&found) - 24.0).abs() < 1e-9);
        let (from, to) = (dvec3(1.0, 2.0, 3.0), dvec3(4.0, 6.0, 3.0));
        assert!((volume(&beam(from, to, [0.5, 0.2])) - 0.5).abs() < 1e-9);
        let upright = beam(from, from + DVec3::Z * 2.0, [0.5, 0.2]);
        assert!((volume(&upright) - 0.2).abs() < 1e-9);
        // Its foot lies in z = 0, so that nothing is missing there.
        let pole = volume(&column(DVec3::ZERO, 10.0, [1.0, 1.0], 64));
        assert!((pole / (std::f64::consts::PI * 10.0) - 1.0).abs() < 0.01);
        assert!(volume(&ribbon(&[from, to], 0.1)).abs() < 1e-9);
    }
}
