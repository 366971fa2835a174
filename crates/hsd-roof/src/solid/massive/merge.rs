//! Faces of one plane and finish that lie side by side are merged, as long as the result is convex, to save triangles
//! in towns.

use glam::DVec3;
use hsd_base::geometry::tolerance::PARALLEL;
use hsd_ir::building::{Corners, Finish};

/// Maximum distance of a face's corners from its plane, metres.
pub(super) const BENT: f64 = 4e-7;

/// The maximum number of merging rounds. A face takes at most one neighbour per round, so long rows of faces would need
/// as many rounds as they have faces.
const ROUNDS: usize = 16;

/// A face by the numbers of its points.
pub(super) type Polygon = (Corners, Finish);

/// Merges faces with their neighbours, within the maximum number of rounds.
pub(super) fn merge(points: &[DVec3], faces: &mut Vec<Polygon>) {
    // Faces that changed in the last round, and the corners of them: only along edges between such corners can faces merge
    // now that could not before.
    let mut fresh = vec![true; faces.len()];
    let mut touched = vec![true; points.len()];
    let mut normals: Vec<Option<DVec3>> = vec![None; faces.len()];
    for _ in 0..ROUNDS {
        let edges = edges(faces, &touched);
        let mut grown = vec![false; faces.len()];
        let mut taken = vec![false; faces.len()];
        for &(p, q, f) in edges.iter().filter(|(p, q, _)| p < q) {
            let at = edges.partition_point(|e| (e.0, e.1) < (q, p));
            let [back, rest @ ..] = &edges[at..] else {
                continue;
            };
            let lonely =
                (back.0, back.1) == (q, p) && rest.first().is_none_or(|e| (e.0, e.1) != (q, p));
            let (f, g) = (f as usize, back.2 as usize);
            let met = lonely && f != g && !taken[f] && !taken[g] && faces[f].1 == faces[g].1;
            if !met || !(fresh[f] || fresh[g]) {
                continue;
            }
            let own = *normals[f].get_or_insert_with(|| normal(points, &faces[f].0));
            if let Some(both) = joined(points, (&faces[f].0, own), &faces[g].0, [p, q]) {
                faces[f].0 = both;
                normals[f] = None;
                faces[g].0.clear();
                (taken[f], taken[g], grown[f]) = (true, true, true);
            }
        }
        if !grown.contains(&true) {
            break;
        }
        touched.fill(false);
        for (corners, _) in faces.iter().zip(&grown).filter(|(_, g)| **g).map(|f| f.0) {
            corners.iter().for_each(|c| touched[*c as usize] = true);
        }
        fresh = grown;
    }
    faces.retain(|f| !f.0.is_empty());
}

/// Returns every edge between two of the corners `touched` with the face that runs along it, sorted.
fn edges(faces: &[Polygon], touched: &[bool]) -> Vec<(u32, u32, u32)> {
    let mut edges = Vec::with_capacity(4 * faces.len());
    for ((corners, _), f) in faces.iter().zip(0..) {
        let Some(mut p) = corners.last().copied() else {
            continue;
        };
        for &q in corners {
            if touched[p as usize] && touched[q as usize] {
                edges.push((p, q, f));
            }
            p = q;
        }
    }
    edges.sort_unstable();
    edges
}

/// Merges two faces that share an edge, which the first traverses from one end to the other, into one convex face. The first
/// is given with its normal.
fn joined(
    points: &[DVec3],
    (one, normal): (&[u32], DVec3),
    other: &[u32],
    [from, to]: [u32; 2],
) -> Option<Corners> {
    let at = |id: u32| points[id as usize];
    let origin = at(one[0]);
    if other
        .iter()
        .any(|id| normal.dot(at(*id) - origin).abs() > BENT)
    {
        return None;
    }
    let place = |ring: &[u32], of: u32| ring.iter().position(|id| *id == of);
    let (first, second) = (place(one, to)?, place(other, from)?);
    let mut ring = Corners::from_slice(&one[first..]);
    ring.extend_from_slice(&one[..first]);
    ring.extend_from_slice(&other[second + 1..]);
    ring.extend_from_slice(&other[..second]);
    ring.pop();
    let whole = ring.len();
    without_spikes(&mut ring);
    let n = ring.len();
    let bends = |i: usize| {
        let [p, q, r] = [
            at(ring[(i + n - 1) % n]),
            at(ring[i]),
            at(ring[(i + 1) % n]),
        ];
        let turn = (q - p)
            .normalize_or_zero()
            .cross((r - q).normalize_or_zero());
        normal.dot(turn) > -PARALLEL
    };
    // Most that do not fit bend inwards where they meet.
    let ends = [0, one.len() - 1];
    if n == whole && ends.into_iter().any(|end| !bends(end)) {
        return None;
    }
    (n > 2 && (0..n).all(bends) && is_simple(&ring)).then_some(ring)
}

/// Returns true if a ring passes no corner twice.
fn is_simple(ring: &[u32]) -> bool {
    let mut sorted = ring.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).all(|w| w[0] != w[1])
}

fn normal(points: &[DVec3], ring: &[u32]) -> DVec3 {
    let at = |k: usize| points[ring[k] as usize] - points[ring[0] as usize];
    let fan = 1..ring.len().max(1) - 1;
    let sum: DVec3 = fan.map(|k| at(k).cross(at(k + 1))).sum();
    sum.normalize_or_zero()
}

/// Removes paths that go to a corner and straight back.
fn without_spikes(ring: &mut Corners) {
    let mut i = 0;
    let mut kept = 0;
    while ring.len() > 2 && kept < ring.len() {
        let n = ring.len();
        let (before, at, after) = ((i + n - 1) % n, i % n, (i + 1) % n);
        if ring[before] == ring[after] {
            // The corner and one of its two equal neighbours.
            ring.remove(at.max(after));
            ring.remove(at.min(after));
            i = 0;
            kept = 0;
        } else {
            i = (i + 1) % n;
            kept += 1;
        }
    }
}
