//! Checks of solids: each check is a kind of [`Flaw`] with its reason.

use crate::building::{Face, Solid};
use glam::DVec3;
use std::collections::BTreeMap;

/// Corners closer to each other than this count as one point, metres.
pub const WELD: f64 = 1e-9;
/// The greatest distance of a face's corners from its plane, metres.
pub const PLANE: f64 = 1e-6;
/// The least area of a face, square metres.
pub const AREA: f64 = 1e-8;

/// A defect of a solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Flaw {
    /// A coordinate is not finite: no back end can write it.
    NotFinite {
        /// Index of the point.
        point: usize,
    },
    /// A face has fewer than three corners, a corner twice, or one that does not exist.
    BadFace {
        /// Index of the face.
        face: usize,
    },
    /// An edge does not belong to exactly two faces in opposite directions: the solid is not watertight, and so 3D
    /// printing and volume computations fail.
    OpenEdge {
        /// Its ends, by index.
        edge: (u32, u32),
    },
    /// As [`Flaw::OpenEdge`], by position: a crack or a double wall hidden by points that are equal but not shared.
    OpenSeam {
        /// Start of the edge.
        from: DVec3,
        /// End of the edge.
        to: DVec3,
    },
    /// A face has no area, so no normal for shading.
    Sliver {
        /// Index of the face.
        face: usize,
    },
    /// A face is not plane: its two triangulations differ.
    NotPlane {
        /// Index of the face.
        face: usize,
    },
    /// The faces of a connected part are inside out: it is invisible from outside.
    Inward {
        /// Its volume, cubic metres, negative.
        volume: f64,
    },
}

/// Returns the flaws of a solid, the most severe first; later checks are left out where they would be meaningless.
pub fn solid_flaws(solid: &Solid) -> impl Iterator<Item = Flaw> {
    let mut flaws: Vec<Flaw> = not_finite(solid).chain(bad_faces(solid)).collect();
    if flaws.is_empty() {
        flaws.extend(open_edges(solid));
        flaws.extend(open_seams(solid));
        flaws.extend(bent_faces(solid));
        flaws.extend(inward(solid));
    }
    flaws.into_iter()
}

fn not_finite(solid: &Solid) -> impl Iterator<Item = Flaw> {
    let points = solid.points.iter().enumerate();
    points
        .filter(|(_, p)| !p.is_finite())
        .map(|(point, _)| Flaw::NotFinite { point })
}

fn bad_faces(solid: &Solid) -> impl Iterator<Item = Flaw> {
    let bad = |f: &Face| {
        let mut sorted = f.corners.clone();
        sorted.sort_unstable();
        f.corners.len() < 3
            || sorted.windows(2).any(|w| w[0] == w[1])
            || sorted
                .last()
                .is_some_and(|c| *c as usize >= solid.points.len())
    };
    let faces = solid.faces.iter().enumerate();
    faces
        .filter(move |(_, f)| bad(f))
        .map(|(face, _)| Flaw::BadFace { face })
}

/// Counts how often each edge is traversed in its ascending and in its descending direction.
fn tally<K: Ord + Copy>(edges: impl Iterator<Item = (K, K)>) -> BTreeMap<(K, K), (u32, u32)> {
    let mut tally = BTreeMap::new();
    for (p, q) in edges {
        let entry: &mut (u32, u32) = tally.entry((p.min(q), p.max(q))).or_default();
        if p < q {
            entry.0 += 1;
        } else {
            entry.1 += 1;
        }
    }
    tally
}

fn edges(solid: &Solid) -> impl Iterator<Item = (u32, u32)> + '_ {
    solid.faces.iter().flat_map(|f| {
        let n = f.corners.len();
        (0..n).map(move |i| (f.corners[i], f.corners[(i + 1) % n]))
    })
}

fn open_edges(solid: &Solid) -> impl Iterator<Item = Flaw> {
    let open = tally(edges(solid))
        .into_iter()
        .filter(|(_, runs)| *runs != (1, 1));
    open.map(|(edge, _)| Flaw::OpenEdge { edge })
}

fn open_seams(solid: &Solid) -> impl Iterator<Item = Flaw> {
    let same = welded(solid);
    let runs = tally(edges(solid).map(|(p, q)| (same[p as usize], same[q as usize])));
    let open: Vec<(u32, u32)> = runs
        .into_iter()
        .filter(|(_, runs)| *runs != (1, 1))
        .map(|(edge, _)| edge)
        .collect();
    let point = |id: u32| solid.points[id as usize];
    let flaws: Vec<Flaw> = open
        .into_iter()
        .map(|(p, q)| Flaw::OpenSeam {
            from: point(p),
            to: point(q),
        })
        .collect();
    flaws.into_iter()
}

/// Returns for each point the first one at the same place.
fn welded(solid: &Solid) -> Vec<u32> {
    let mut order: Vec<u32> = (0..solid.points.len() as u32).collect();
    let point = |id: u32| solid.points[id as usize];
    order.sort_by(|i, j| point(*i).x.total_cmp(&point(*j).x));
    let mut same: Vec<u32> = (0..solid.points.len() as u32).collect();
    for (n, id) in order.iter().enumerate() {
        let near = order[..n]
            .iter()
            .rev()
            .take_while(|o| point(*id).x - point(**o).x <= WELD);
        for other in near {
            if (point(*id) - point(*other)).abs().max_element() <= WELD {
                same[*id as usize] = same[*other as usize];
            }
        }
    }
    same
}

fn bent_faces(solid: &Solid) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    for (face, f) in solid.faces.iter().enumerate() {
        if !has_area(solid, f) {
            flaws.push(Flaw::Sliver { face });
            continue;
        }
        if !is_plane(solid, f) {
            flaws.push(Flaw::NotPlane { face });
        }
    }
    flaws
}

/// Returns true if a face has a normal.
pub fn has_area(solid: &Solid, face: &Face) -> bool {
    double_area(solid, face).length() >= 2.0 * AREA
}

/// Returns true if the corners of a face lie in one plane.
pub fn is_plane(solid: &Solid, face: &Face) -> bool {
    lies_across(solid, face, double_area(solid, face))
}

/// Returns true if a face has an area and lies in one plane.
pub fn is_sound(solid: &Solid, face: &Face) -> bool {
    let normal = double_area(solid, face);
    normal.length() >= 2.0 * AREA && lies_across(solid, face, normal)
}

/// Returns true if the corners of a face lie in one plane across a normal.
fn lies_across(solid: &Solid, face: &Face, normal: DVec3) -> bool {
    let unit = normal.normalize_or_zero();
    let point = |c: &u32| solid.points[*c as usize];
    let first = point(&face.corners[0]);
    let off = |c: &u32| unit.dot(point(c) - first).abs();
    face.corners.iter().all(|c| off(c) <= PLANE)
}

/// Returns the normal of a face with twice its area as its length.
fn double_area(solid: &Solid, face: &Face) -> DVec3 {
    let point = |c: u32| solid.points[c as usize];
    let [first, rest @ ..] = &face.corners[..] else {
        return DVec3::ZERO;
    };
    let first = point(*first);
    let mut sum = DVec3::ZERO;
    for pair in rest.windows(2) {
        sum += (point(pair[0]) - first).cross(point(pair[1]) - first);
    }
    sum
}

fn inward(solid: &Solid) -> Vec<Flaw> {
    let mut root: Vec<usize> = (0..solid.points.len()).collect();
    let find = |root: &[usize], mut n: usize| {
        while root[n] != n {
            n = root[n];
        }
        n
    };
    for (p, q) in edges(solid) {
        let (a, b) = (find(&root, p as usize), find(&root, q as usize));
        root[a.max(b)] = a.min(b);
    }
    let mut volumes: BTreeMap<usize, f64> = BTreeMap::new();
    for f in &solid.faces {
        let part = find(&root, f.corners[0] as usize);
        // Measured from a corner of the part, so that distance from the origin costs no precision.
        let apex = solid.points[part];
        let first = solid.points[f.corners[0] as usize] - apex;
        *volumes.entry(part).or_default() += double_area(solid, f).dot(first) / 6.0;
    }
    let bad = volumes.into_values().filter(|v| *v <= 0.0);
    bad.map(|volume| Flaw::Inward { volume }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::building::{Corners, Finish};
    use glam::dvec3;

    fn tetrahedron() -> Solid {
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Solid {
            points: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            faces: faces
                .map(|c| Face {
                    corners: Corners::from_slice(&c),
                    finish: Finish::Plaster,
                })
                .to_vec(),
        }
    }

    fn flaws(solid: &Solid) -> Vec<Flaw> {
        solid_flaws(solid).collect()
    }

    #[test]
    fn a_tetrahedron_has_none() {
        assert_eq!(flaws(&tetrahedron()), vec![]);
    }

    #[test]
    fn a_missing_face_opens_three_edges() {
        let mut solid = tetrahedron();
        solid.faces.pop();
        let open = flaws(&solid)
            .iter()
            .filter(|f| matches!(f, Flaw::OpenEdge { .. }))
            .count();
        assert_eq!(open, 3);
    }

    #[test]
    fn faces_inside_out_are_found() {
        let mut solid = tetrahedron();
        solid.faces.iter_mut().for_each(|f| f.corners.reverse());
        assert!(matches!(flaws(&solid)[..], [Flaw::Inward { .. }]));
    }

    #[test]
    fn bad_numbers_and_faces_are_found() {
        let mut solid = tetrahedron();
        solid.points[1].x = f64::NAN;
        assert_eq!(flaws(&solid), vec![Flaw::NotFinite { point: 1 }]);
        let mut solid = tetrahedron();
        solid.faces[0].corners[0] = 9;
        assert_eq!(flaws(&solid), vec![Flaw::BadFace { face: 0 }]);
    }

    #[test]
    fn cracks_between_equal_points_are_found_by_index_only() {
        let mut solid = tetrahedron();
        solid.points.push(solid.points[3]);
        solid.faces[1].corners[2] = 4;
        assert!(
            flaws(&solid)
                .iter()
                .any(|f| matches!(f, Flaw::OpenEdge { .. }))
        );
        assert!(
            !flaws(&solid)
                .iter()
                .any(|f| matches!(f, Flaw::OpenSeam { .. }))
        );
    }

    #[test]
    fn slivers_and_bent_faces_are_found() {
        let mut solid = tetrahedron();
        solid.points[3] = dvec3(0.5, 0.0, 0.0);
        assert!(flaws(&solid).contains(&Flaw::Sliver { face: 1 }));
        let corners = Corners::from_slice(&[0, 1, 2, 3]);
        solid.points = vec![DVec3::ZERO, DVec3::X, dvec3(1.0, 1.0, 0.1), DVec3::Y];
        solid.faces = vec![Face {
            corners,
            finish: Finish::Plaster,
        }];
        assert!(flaws(&solid).contains(&Flaw::NotPlane { face: 0 }));
    }
}
