//! Any simple polygon with holes into triangles, by clipping ears; for flat roofs over round and
//! slanting plans.

use glam::DVec2;

/// The triangles of an outline (counter-clockwise) with holes (clockwise), as corners.
pub fn triangles(outline: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<[DVec2; 3]> {
    let mut ring = bridged(outline, holes);
    let mut found = Vec::with_capacity(ring.len());
    let mut at = 0;
    let mut missed = 0;
    while ring.len() > 3 && missed < ring.len() {
        let n = ring.len();
        let (i, j, k) = ((at + n - 1) % n, at % n, (at + 1) % n);
        if is_ear(&ring, i, j, k) {
            found.push([ring[i], ring[j], ring[k]]);
            ring.remove(j);
            // Going on one further keeps fans from getting thin.
            at = (j + 1) % ring.len();
            missed = 0;
        } else if turn(ring[i], ring[j], ring[k]).abs() < 1e-12
            && straight(ring[i], ring[j], ring[k])
        {
            ring.remove(j);
            at = j % ring.len();
            missed = 0;
        } else {
            at = (at + 1) % n;
            missed += 1;
        }
    }
    if let [p, q, r] = ring[..] {
        found.push([p, q, r]);
    }
    found.retain(|[p, q, r]| turn(*p, *q, *r) > 1e-9);
    found
}

/// Twice the area to the left of the way p, q, r.
fn turn(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    (q - p).perp_dot(r - p)
}

fn straight(p: DVec2, q: DVec2, r: DVec2) -> bool {
    (q - p).dot(r - q) >= 0.0
}

fn is_ear(ring: &[DVec2], i: usize, j: usize, k: usize) -> bool {
    let (p, q, r) = (ring[i], ring[j], ring[k]);
    if turn(p, q, r) <= 1e-12 {
        return false;
    }
    let within = |s: DVec2| {
        // Bridges put corners twice: the same place is no obstacle.
        s != p
            && s != q
            && s != r
            && turn(p, q, s) >= 0.0
            && turn(q, r, s) >= 0.0
            && turn(r, p, s) >= 0.0
    };
    !ring.iter().any(|s| within(*s))
}

/// One ring out of an outline and its holes, joined by the shortest bridges that cross nothing.
pub(crate) fn bridged(outline: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<DVec2> {
    let mut ring = outline.to_vec();
    let mut rest: Vec<&Vec<DVec2>> = holes.iter().filter(|h| h.len() > 2).collect();
    // From the hole that reaches farthest on, so that a bridge meets only what is joined already.
    let reach = |hole: &[DVec2]| hole.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    rest.sort_by(|g, h| reach(h).total_cmp(&reach(g)));
    for n in 0..rest.len() {
        let hole = rest[n];
        let start = (0..hole.len())
            .max_by(|i, j| hole[*i].x.total_cmp(&hole[*j].x))
            .unwrap_or(0);
        let from = hole[start];
        let free = |to: DVec2| {
            let clear = |ring: &[DVec2]| !crosses_any(ring, from, to);
            clear(&ring) && rest[n..].iter().all(|h| clear(h))
        };
        let mut order: Vec<usize> = (0..ring.len()).collect();
        order.sort_by(|i, j| {
            from.distance_squared(ring[*i])
                .total_cmp(&from.distance_squared(ring[*j]))
        });
        let Some(&to) = order
            .iter()
            .find(|i| free(ring[**i]) && opens_to(&ring, **i, from))
        else {
            continue;
        };
        let around = (0..=hole.len()).map(|i| hole[(start + i) % hole.len()]);
        let mut bridge: Vec<DVec2> = around.collect();
        bridge.push(ring[to]);
        ring.splice(to + 1..to + 1, bridge);
    }
    ring
}

/// Whether `from` lies within the angle of the ring's corner `i`, so that a bridge runs inside.
fn opens_to(ring: &[DVec2], i: usize, from: DVec2) -> bool {
    let n = ring.len();
    let (p, q, r) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
    let (left_in, left_out) = (turn(p, q, from) > 0.0, turn(q, r, from) > 0.0);
    if turn(p, q, r) >= 0.0 {
        left_in && left_out
    } else {
        left_in || left_out
    }
}

fn crosses_any(ring: &[DVec2], from: DVec2, to: DVec2) -> bool {
    (0..ring.len()).any(|i| {
        let (p, q) = (ring[i], ring[(i + 1) % ring.len()]);
        let touches = |s: DVec2| s == from || s == to;
        if touches(p) || touches(q) {
            return false;
        }
        let side = |a: DVec2, b: DVec2, c: DVec2| turn(a, b, c) >= 0.0;
        side(from, to, p) != side(from, to, q) && side(p, q, from) != side(p, q, to)
    })
}

#[cfg(test)]
mod tests {
    use crate::geometry::triangulate::*;
    use glam::dvec2;

    fn area(triangles: &[[DVec2; 3]]) -> f64 {
        triangles
            .iter()
            .map(|[p, q, r]| turn(*p, *q, *r) / 2.0)
            .sum()
    }

    fn circle(n: usize, radius: f64) -> Vec<DVec2> {
        let at = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n)
            .map(|i| radius * dvec2(libm::cos(at(i)), libm::sin(at(i))))
            .collect()
    }

    #[test]
    fn a_concave_polygon_keeps_its_area() {
        let l = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 14.0),
            (0.0, 14.0),
        ];
        let l: Vec<DVec2> = l.iter().map(|(x, y)| dvec2(*x, *y)).collect();
        assert!((area(&triangles(&l, &[])) - 64.0).abs() < 1e-9);
    }

    #[test]
    fn rings_keep_their_area() {
        let (outer, inner) = (circle(36, 10.0), circle(24, 4.0));
        let whole = area(&triangles(&outer, &[])) - area(&triangles(&inner, &[]));
        let hole: Vec<DVec2> = inner.into_iter().rev().collect();
        assert!((area(&triangles(&outer, &[hole])) - whole).abs() < 1e-9);
    }

    #[test]
    fn two_holes_keep_their_area() {
        let outer = circle(40, 10.0);
        let hole = |x: f64| {
            circle(8, 2.0)
                .into_iter()
                .rev()
                .map(|p| p + dvec2(x, 0.5))
                .collect::<Vec<_>>()
        };
        let hole_area = area(&triangles(&circle(8, 2.0), &[]));
        let got = area(&triangles(&outer, &[hole(-4.0), hole(4.0)]));
        assert!((got - (area(&triangles(&outer, &[])) - 2.0 * hole_area)).abs() < 1e-9);
    }
}
