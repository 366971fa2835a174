//! Any simple polygon as a few convex ones: ears are clipped, the fattest first, and joined again while they stay
//! convex.

use glam::DVec2;

/// Corners that stand out less from the line past them are none, metres.
const STRAIGHT: f64 = 1e-6;
/// Polygons with more corners take the first ear instead of the best.
const MANY: usize = 100;

/// Strictly convex parts of a counter-clockwise polygon, as indices of its corners.
pub(crate) fn parts(ring: &[DVec2]) -> Vec<Vec<usize>> {
    let whole: Vec<usize> = (0..ring.len()).collect();
    if is_convex(ring, &whole) {
        return vec![whole];
    }
    let mut pieces = Vec::with_capacity(ring.len());
    let mut cuts = Vec::with_capacity(ring.len());
    let mut rest = whole;
    while rest.len() > 3 {
        let ear = best_ear(ring, &rest);
        let n = rest.len();
        let (i, j, k) = (rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]);
        pieces.push(vec![i, j, k]);
        cuts.push((i, k));
        rest.remove(ear);
    }
    pieces.push(rest);
    for (i, k) in cuts.into_iter().rev() {
        join(ring, &mut pieces, i, k);
    }
    pieces
}

/// The triangles of a counter-clockwise polygon, as indices of its corners.
pub(crate) fn triangles(ring: &[DVec2]) -> Vec<[usize; 3]> {
    let mut rest: Vec<usize> = (0..ring.len()).collect();
    let mut found = Vec::with_capacity(ring.len());
    while rest.len() > 2 {
        let ear = best_ear(ring, &rest);
        let n = rest.len();
        found.push([rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]]);
        rest.remove(ear);
    }
    found
}

/// Twice the area to the left of the way p, q, r.
fn turn(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    (q - p).perp_dot(r - p)
}

fn is_convex(ring: &[DVec2], piece: &[usize]) -> bool {
    let n = piece.len();
    (0..n).all(|i| {
        let [p, q, r] = [i, i + 1, i + 2].map(|k| ring[piece[k % n]]);
        turn(p, q, r) > STRAIGHT * p.distance(r)
    })
}

/// The place of the ear to cut off next: the fattest one, or where there is none the corner that comes nearest.
fn best_ear(ring: &[DVec2], rest: &[usize]) -> usize {
    let n = rest.len();
    let mut best = (f64::MIN, 0);
    for j in 0..n {
        let [p, q, r] = [j + n - 1, j, j + 1].map(|k| ring[rest[k % n]]);
        let longest = p
            .distance_squared(q)
            .max(q.distance_squared(r))
            .max(r.distance_squared(p));
        let fat = turn(p, q, r) / longest.max(f64::MIN_POSITIVE);
        if fat <= best.0 || fat.is_nan() {
            continue;
        }
        let free = |s: DVec2| {
            let corner = s == p || s == q || s == r;
            corner || turn(p, q, s) < 0.0 || turn(q, r, s) < 0.0 || turn(r, p, s) < 0.0
        };
        let clear = fat > 0.0 && rest.iter().all(|s| free(ring[*s]));
        // Nothing that is no ear is better than any ear.
        let worth = if clear { fat } else { fat.min(0.0) - 2.0 };
        if worth > best.0 {
            best = (worth, j);
        }
        if clear && n > MANY {
            break;
        }
    }
    best.1
}

/// Joins the two pieces along the cut between `i` and `k`, if what comes out is convex.
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
        let l = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 14.0),
            (0.0, 14.0),
        ];
        let l: Vec<DVec2> = l.iter().map(|(x, y)| dvec2(*x, *y)).collect();
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
