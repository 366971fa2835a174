//! Pairs of segments that are near each other, found without testing all pairs.

use glam::DVec2;

/// The two ends of a segment.
pub(crate) type Segment = [DVec2; 2];

/// Calls `found` with every pair of segments whose boxes, grown by `gap`, touch; the lower index first. Stops as soon
/// as `found` returns true.
pub(crate) fn near_pairs(
    segments: &[Segment],
    gap: f64,
    mut found: impl FnMut(usize, usize) -> bool,
) {
    let boxes: Vec<(DVec2, DVec2)> = segments
        .iter()
        .map(|[p, q]| (p.min(*q) - gap / 2.0, p.max(*q) + gap / 2.0))
        .collect();
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|i, j| boxes[*i].0.x.total_cmp(&boxes[*j].0.x).then(i.cmp(j)));
    for (n, &i) in order.iter().enumerate() {
        for &j in &order[n + 1..] {
            if boxes[j].0.x > boxes[i].1.x {
                break;
            }
            let apart = boxes[j].0.y > boxes[i].1.y || boxes[i].0.y > boxes[j].1.y;
            if !apart && found(i.min(j), i.max(j)) {
                return;
            }
        }
    }
}

/// Returns the least distance of two segments, 0 if they cross.
pub(crate) fn distance(s: Segment, t: Segment) -> f64 {
    if cross(s, t) {
        return 0.0;
    }
    let ends = [to(s, t[0]), to(s, t[1]), to(t, s[0]), to(t, s[1])];
    ends.into_iter().fold(f64::MAX, f64::min)
}

fn cross([p, q]: Segment, [r, s]: Segment) -> bool {
    let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 0.0;
    side(p, q, r) != side(p, q, s) && side(r, s, p) != side(r, s, q)
}

/// Returns the distance of a point from a segment.
pub(crate) fn to([p, q]: Segment, r: DVec2) -> f64 {
    let way = q - p;
    let share = (way.dot(r - p) / way.length_squared()).clamp(0.0, 1.0);
    let share = if share.is_finite() { share } else { 0.0 };
    (p + way * share).distance(r)
}
