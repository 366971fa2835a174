//! Convex polygons cut by convex polygons. Rings run counter-clockwise.

use super::area2;
use glam::DVec2;

/// Twice the area below which a piece is a sliver and left out, square metres.
const SLIVER: f64 = 2e-4;
/// Distances from a line that count as on it, metres.
const ON: f64 = 1e-7;

/// Divides a convex ring by the line through a point in a direction; returns what lies to its left and to its right.
fn divided(ring: &[DVec2], at: DVec2, way: DVec2) -> [Vec<DVec2>; 2] {
    let side: Vec<f64> = ring.iter().map(|p| way.perp_dot(*p - at)).collect();
    let [mut left, mut right] = [vec![], vec![]];
    for (i, (p, s)) in ring.iter().zip(&side).enumerate() {
        let next = (i + 1) % ring.len();
        let (q, t) = (ring[next], side[next]);
        if *s >= -ON {
            left.push(*p);
        }
        if *s <= ON {
            right.push(*p);
        }
        if (*s > ON && t < -ON) || (*s < -ON && t > ON) {
            let cut = p.lerp(q, s / (s - t));
            left.push(cut);
            right.push(cut);
        }
    }
    [left, right]
}

fn is_sliver(ring: &[DVec2]) -> bool {
    ring.len() < 3 || area2(ring) < SLIVER
}

/// Returns the box of a ring.
fn bounds(ring: &[DVec2]) -> [DVec2; 2] {
    let first = ring.first().copied().unwrap_or_default();
    let grow = |[low, high]: [DVec2; 2], p: &DVec2| [low.min(*p), high.max(*p)];
    ring.iter().fold([first; 2], grow)
}

/// Returns what a convex ring has outside another, as convex rings; slivers are left out.
pub fn outside(ring: &[DVec2], cutter: &[DVec2]) -> Vec<Vec<DVec2>> {
    let ([a, b], [c, d]) = (bounds(ring), bounds(cutter));
    if !(a.cmplt(d).all() && c.cmplt(b).all()) {
        return vec![ring.to_vec()];
    }
    let (mut rest, mut found) = (ring.to_vec(), vec![]);
    for (i, p) in cutter.iter().enumerate() {
        let q = cutter[(i + 1) % cutter.len()];
        let [inside, out] = divided(&rest, *p, (q - *p).normalize_or_zero());
        if is_sliver(&inside) {
            // They only touch: the ring stays whole.
            return vec![ring.to_vec()];
        }
        if !is_sliver(&out) {
            found.push(out);
        }
        rest = inside;
    }
    found
}

/// Returns what a convex ring shares with another; none if that is a sliver.
pub fn inside(ring: &[DVec2], other: &[DVec2]) -> Option<Vec<DVec2>> {
    let ([a, b], [c, d]) = (bounds(ring), bounds(other));
    if !(a.cmplt(d).all() && c.cmplt(b).all()) {
        return None;
    }
    let mut rest = ring.to_vec();
    for (i, p) in other.iter().enumerate() {
        let q = other[(i + 1) % other.len()];
        [rest, _] = divided(&rest, *p, (q - *p).normalize_or_zero());
        if is_sliver(&rest) {
            return None;
        }
    }
    Some(rest)
}

/// Returns convex rings without what several convex rings cover.
pub fn without(rings: Vec<Vec<DVec2>>, cutters: &[Vec<DVec2>]) -> Vec<Vec<DVec2>> {
    cutters.iter().fold(rings, |rings, cutter| {
        rings
            .iter()
            .flat_map(|ring| outside(ring, cutter))
            .collect()
    })
}

/// Divides a convex ring by the lines of a grid of this step through 0 0.
pub fn on_grid(ring: &[DVec2], step: f64) -> Vec<Vec<DVec2>> {
    let along = |rings: Vec<Vec<DVec2>>, axis: DVec2| {
        let mut done = vec![];
        for mut rest in rings {
            let [low, high] = bounds(&rest).map(|p| p.dot(axis));
            let lines = (low / step).floor() as i64 + 1..(high / step).ceil() as i64;
            for line in lines {
                let [beyond, before] = divided(&rest, axis * (line as f64 * step), axis.perp());
                // To the left of the perpendicular lies what comes before.
                done.extend(Some(beyond).filter(|ring| !is_sliver(ring)));
                rest = before;
            }
            done.extend(Some(rest).filter(|ring| !is_sliver(ring)));
        }
        done
    };
    along(along(vec![ring.to_vec()], DVec2::X), DVec2::Y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn square(x: f64, y: f64, side: f64) -> Vec<DVec2> {
        let at = dvec2(x, y);
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        corners.map(|(x, y)| at + dvec2(x, y)).to_vec()
    }

    fn total(rings: &[Vec<DVec2>]) -> f64 {
        rings.iter().map(|ring| area2(ring) / 2.0).sum()
    }

    #[test]
    fn areas_are_kept() {
        let whole = square(0.0, 0.0, 10.0);
        let left = outside(&whole, &square(4.0, 4.0, 2.0));
        assert!((total(&left) - 96.0).abs() < 1e-9);
        assert_eq!(
            outside(&whole, &square(10.0, 0.0, 3.0)),
            std::slice::from_ref(&whole)
        );
        assert!(outside(&whole, &square(-1.0, -1.0, 12.0)).is_empty());
        let pieces = on_grid(&square(0.5, 0.5, 9.0), 4.0);
        assert_eq!(pieces.len(), 9);
        assert!((total(&pieces) - 81.0).abs() < 1e-9);
    }
}
