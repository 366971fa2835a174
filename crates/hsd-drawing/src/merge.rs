//! Lines that lie on each other become one: the edges of neighbouring bodies are drawn once.

use glam::DVec2;

/// Lines whose distance from the origin and direction fall into one step are one: steps of each, millimetres and radians.
const OFF: f64 = 0.02;
const TURN: f64 = 2e-3;

/// Gaps shorter than this are closed, millimetres.
const GAP: f64 = 0.16;

/// Returns lines without doubles; the ends that remain are ends of lines given.
pub(super) fn merged(lines: Vec<[DVec2; 2]>) -> Vec<[DVec2; 2]> {
    let mut keyed: Vec<(i64, i64, f64, [DVec2; 2])> = lines
        .into_iter()
        .filter_map(|[p, q]| {
            // From the left to the right, or upwards.
            let [p, q] = if (p.x, p.y) <= (q.x, q.y) {
                [p, q]
            } else {
                [q, p]
            };
            let way = (q - p).try_normalize()?;
            let upright = way.x.abs() < TURN / 2.0;
            let [p, q] = if upright && p.y > q.y { [q, p] } else { [p, q] };
            let way = if upright { DVec2::Y } else { way };
            let turn = (libm::atan2(way.y, way.x) / TURN).round() as i64;
            let off = (way.perp_dot((p + q) / 2.0) / OFF).round() as i64;
            Some((turn, off, way.dot(p), [p, q]))
        })
        .collect();
    keyed.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    let mut found: Vec<[DVec2; 2]> = vec![];
    let mut last: Option<(i64, i64)> = None;
    for (turn, off, _, [p, q]) in keyed {
        if last == Some((turn, off))
            && let Some(line) = found.last_mut()
        {
            let way = (line[1] - line[0]).normalize_or_zero();
            let [start, end] = [p, q].map(|c| way.dot(c - line[0]));
            let length = line[0].distance(line[1]);
            if start <= length + GAP {
                if end > length {
                    line[1] = q;
                }
                continue;
            }
        }
        found.push([p, q]);
        last = Some((turn, off));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn lines_on_each_other_become_one() {
        let line = |x0: f64, x1: f64, y: f64| [dvec2(x0, y), dvec2(x1, y)];
        let all = vec![
            line(0.0, 3.0, 1.0),
            line(5.0, 2.0, 1.0),
            line(7.0, 8.0, 1.0),
            line(0.0, 8.0, 2.0),
            [dvec2(4.0, 9.0), dvec2(4.0, 1.0)],
            [dvec2(4.0, 2.0), dvec2(4.0, 12.0)],
        ];
        let mut found = merged(all);
        found.sort_by(|a, b| a[0].x.total_cmp(&b[0].x).then(a[0].y.total_cmp(&b[0].y)));
        assert_eq!(
            found,
            [
                line(0.0, 5.0, 1.0),
                line(0.0, 8.0, 2.0),
                [dvec2(4.0, 1.0), dvec2(4.0, 12.0)],
                line(7.0, 8.0, 1.0),
            ]
        );
    }
}
