//! Divides any simple polygon into a few convex ones: its triangles, joined again while they stay convex.

use crate::geometry::tolerance::POINT;
use crate::geometry::triangulate::{ears, turn};
use glam::DVec2;

/// Returns strictly convex parts of a counter-clockwise polygon, as indices of its corners.
pub fn parts(ring: &[DVec2]) -> Vec<Vec<usize>> {
    let whole: Vec<usize> = (0..ring.len()).collect();
    if is_convex(ring, &whole) {
        return vec![whole];
    }
    let mut pieces = Vec::with_capacity(ring.len());
    let mut cuts = Vec::with_capacity(ring.len());
    ears(ring, |[i, j, k]| {
        let [i, j, k] = [i, j, k].map(|corner| corner as usize);
        pieces.push(vec![i, j, k]);
        cuts.push((i, k));
    });
    // The last triangle cuts nothing off, and begins at its first corner.
    cuts.pop();
    if let Some(last) = pieces.last_mut() {
        last.sort_unstable();
    }
    for (i, k) in cuts.into_iter().rev() {
        join(ring, &mut pieces, i, k);
    }
    pieces
}

/// Returns true if a piece turns left at every corner.
fn is_convex(ring: &[DVec2], piece: &[usize]) -> bool {
    let n = piece.len();
    (0..n).all(|i| {
        let [p, q, r] = [i, i + 1, i + 2].map(|k| ring[piece[k % n]]);
        turn(p, q, r) > POINT * p.distance(r)
    })
}

/// Joins the two pieces along the cut between `i` and `k`, if the result is convex.
fn join(ring: &[DVec2], pieces: &mut Vec<Vec<usize>>, i: usize, k: usize) {
    let along = |piece: &Vec<usize>, from: usize, to: usize| {
        let n = piece.len();
        (0..n).find(|s| piece[*s] == from && piece[(s + 1) % n] == to)
    };
    let side = |from: usize, to: usize| {
        let mut all = pieces.iter().enumerate();
        all.find_map(|(p, piece)| Some((p, along(piece, from, to)?)))
    };
    let (Some((p, at)), Some((q, there))) = (side(i, k), side(k, i)) else {
        return;
    };
    // From k round the first piece to i, then round the second from i to before k.
    let mut joined = pieces[p].clone();
    joined.rotate_left((at + 1) % pieces[p].len());
    let mut other = pieces[q].clone();
    other.rotate_left((there + 1) % pieces[q].len());
    joined.extend(&other[1..other.len() - 1]);
    if is_convex(ring, &joined) {
        pieces[p] = joined;
        pieces.remove(q);
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::convex::*;
    use crate::geometry::triangulate::tests::l_shape;
    use glam::dvec2;

    fn area(ring: &[DVec2], piece: &[usize]) -> f64 {
        let first = ring[piece[0]];
        let fan = piece
            .windows(2)
            .map(|w| turn(first, ring[w[0]], ring[w[1]]));
        fan.sum::<f64>() / 2.0
    }

    #[test]
    fn parts_are_convex_and_make_up_the_whole() {
        let l = l_shape();
        let found = parts(&l);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|p| is_convex(&l, p)));
        assert_eq!(found.iter().map(|p| area(&l, p)).sum::<f64>(), 64.0);
        let comb: Vec<DVec2> = (0..300)
            .map(|k| dvec2(f64::from(k / 2), f64::from((k / 2 + k) % 2) * 3.0))
            .chain([dvec2(149.0, 9.0), dvec2(0.0, 9.0)])
            .collect();
        let whole: Vec<usize> = (0..comb.len()).collect();
        let sum: f64 = parts(&comb).iter().map(|p| area(&comb, p)).sum();
        assert!((sum - area(&comb, &whole)).abs() < 1e-9);
    }
}
