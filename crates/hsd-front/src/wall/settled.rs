//! The lens and the plane of a wall, settled by its long lines.

use super::lines;
use super::vanish::{self, Meeting, Straight};
use super::{APART, Stroke, sorted};
use crate::camera::Lens;
use glam::DMat3;

/// How often lens and plane are settled.
const SETTLED: usize = 2;

/// What is known of a photograph before its wall is looked for.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Whether the focal length is told, not guessed.
    pub focal: bool,
    /// Whether it is told how the lens bends lines.
    pub bend: bool,
}

/// The lens, the edges in the straight picture and the plane of the wall, settled by its long lines: those of the frame and of the
/// lattice of bays, each of all edges that lie on it. They say better than single edges how the lens bends and where parallels meet.
pub(super) fn settled(
    edges: &[lines::Edge],
    mut lens: Lens,
    known: Known,
) -> Option<(Lens, Vec<Straight>, DMat3)> {
    let of =
        |lens: &Lens| -> Vec<Straight> { edges.iter().map(|e| Straight::of(e, lens)).collect() };
    let mut straight = of(&lens);
    let mut meeting = vanish::meeting(&straight, &lens)?;
    let mut plane = plane(&meeting, &lens)?;
    for _ in 0..SETTLED {
        let groups = long_lines(&straight, plane);
        if !known.bend {
            let longest = 2.0 * lens.middle.max_element();
            let mut long: Vec<lines::Edge> = (groups.iter().flatten())
                .map(|group| lines::Edge::joined(group.iter().map(|k| &edges[*k])))
                .collect();
            long.sort_by(|a, b| b.length().total_cmp(&a.length()));
            lens.bend = vanish::bending(&long, &lens, longest).unwrap_or(lens.bend);
            straight = of(&lens);
        }
        let lines = groups.map(|groups| -> Vec<Straight> {
            let joined = |group: &Vec<usize>| Straight::joined(group.iter().map(|k| &straight[*k]));
            groups.iter().map(joined).collect()
        });
        let next = meeting.refined(&lines, &lens);
        let next = match known.focal {
            true => next.and_then(|m| m.squared(&lines, &lens)),
            false => next,
        };
        let Some((next, moved)) = next.and_then(|m| Some((m, self::plane(&m, &lens)?))) else {
            break;
        };
        (meeting, plane) = (next, moved);
    }
    Some((lens, straight, plane))
}

/// The edges on each long line of a wall: lines across, and lines down.
fn long_lines(edges: &[Straight], plane: DMat3) -> [Vec<Vec<usize>>; 2] {
    [0, 1].map(|way| {
        let stroke = |k: usize| sorted(&edges[k..=k], plane)[way].first().copied();
        let on = (0..edges.len()).filter_map(|k| Some((stroke(k)?, k)));
        let mut on: Vec<(Stroke, usize)> = on.collect();
        on.sort_by(|a, b| a.0.at.total_cmp(&b.0.at));
        let reach = on
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |r, (s, _)| {
                (r.0.min(s.from), r.1.max(s.to))
            });
        let apart = APART * (reach.1 - reach.0);
        let mut lines: Vec<Vec<usize>> = vec![];
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for (stroke, edge) in on {
            match lines.last_mut() {
                Some(line) if stroke.at - last <= apart / 2.0 && stroke.at - first <= apart => {
                    line.push(edge);
                }
                _ => {
                    first = stroke.at;
                    lines.push(vec![edge]);
                }
            }
            last = stroke.at;
        }
        lines
    })
}

/// The map from the straight picture to the plane of the wall, in which the two directions are axes.
fn plane(meeting: &Meeting, lens: &Lens) -> Option<DMat3> {
    let (mut a, mut b) = (
        lens.ray(meeting.across).normalize(),
        lens.ray(meeting.down).normalize(),
    );
    if a.x < 0.0 {
        a = -a;
    }
    if b.y < 0.0 {
        b = -b;
    }
    let axes = DMat3::from_cols(a, b, a.cross(b));
    if axes.determinant().abs() < 0.1 {
        return None;
    }
    let ray = DMat3::from_cols(
        lens.ray(glam::DVec3::X),
        lens.ray(glam::DVec3::Y),
        lens.ray(glam::DVec3::Z),
    );
    Some(axes.inverse() * ray)
}
