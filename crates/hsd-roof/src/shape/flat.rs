//! Flat roof (rikuyane, RIK): a slab just above the wall plates, and an upstand on free edges.

use crate::facet::Corner;
use crate::frame::{Plane, metres};
use crate::plan::outline::Outline;
use crate::solid::sheet::{Coat, Piece, sheet};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::Plan;
use hsd_base::geometry::triangulate::triangles;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{Corners, Face, Finish, Solid};

/// The slab's upper face above the wall plate, metres: wall tops must not show through.
const LIFT: f64 = 0.03;
/// Height of the upstand above the wall plate, metres.
const UPSTAND: f64 = 0.40;
/// Distance from the wall line to the outer face of the upstand, metres; flush with ordinary walls.
const OUT: f64 = 0.09;
/// Distance from the wall line to its inner face, metres.
const IN: f64 = 0.07;
/// The number of cells above which each becomes a solid of its own: matching their edges would cost more than the faces
/// between them.
const MANY: usize = 2000;

/// A border of the roof in the house frame with the roof on its left: corners, and for each
/// whether the upstand follows the edge that starts there.
pub type Border = Vec<(DVec2, bool)>;

/// Returns the slab over cells that do not overlap.
pub fn slab_of_cells(
    cells: &[Cell],
    unit: f64,
    base: f64,
    kind: RoofKind,
    thickness: f64,
) -> Vec<Solid> {
    let piece = |c: &Cell| -> Piece {
        let at = |a: i64, b: i64| dvec2(-metres(a, unit), metres(b, unit));
        let corners = [
            at(c.a1, c.b0),
            at(c.a0, c.b0),
            at(c.a0, c.b1),
            at(c.a1, c.b1),
        ];
        (
            corners
                .map(|at| Corner { at, rim: true })
                .into_iter()
                .collect(),
            Plane::level(base + LIFT),
        )
    };
    let pieces: Vec<Piece> = cells.iter().map(piece).collect();
    let part = if pieces.len() > MANY {
        1
    } else {
        pieces.len().max(1)
    };
    let coat = coat(kind);
    pieces
        .chunks(part)
        .flat_map(|p| sheet(p, thickness, &coat, f64::MIN))
        .collect()
}

/// Returns the slab over any simple outline (counter-clockwise in the house frame) with holes (clockwise).
pub fn slab(
    outline: &[DVec2],
    holes: &[Vec<DVec2>],
    base: f64,
    kind: RoofKind,
    thickness: f64,
) -> Vec<Solid> {
    let corner = |at: DVec2| Corner { at, rim: true };
    let piece = |t: &[DVec2; 3]| {
        (
            t.map(corner).into_iter().collect(),
            Plane::level(base + LIFT),
        )
    };
    let pieces: Vec<Piece> = triangles(outline, holes).iter().map(piece).collect();
    sheet(&pieces, thickness, &coat(kind), f64::MIN)
}

/// Returns the finishes of a flat roof.
pub(super) fn coat(kind: RoofKind) -> Coat {
    // Tiles, boards and thatch cannot lie flat: such a roof is plastered whatever its covering.
    let top = match kind {
        RoofKind::Metal => Finish::Covering(RoofKind::Metal),
        _ => Finish::Plaster,
    };
    Coat {
        top,
        rim: Finish::Plaster,
        joint: Finish::Plaster,
        soffit: Finish::Soffit,
    }
}

/// Returns the borders of an orthogonal plan, free along its storey's walls.
pub fn borders(plan: &Plan, storey: &Outline, unit: f64) -> Vec<Border> {
    plan.loops
        .iter()
        .map(|corners| border(corners, storey, unit))
        .collect()
}

fn border(corners: &[(i64, i64)], storey: &Outline, unit: f64) -> Border {
    let at = |p: (i64, i64)| dvec2(-metres(p.0, unit), metres(p.1, unit));
    let mut border = Border::new();
    // The author's walk has the roof on its right; run backwards it is on the left.
    for i in (0..corners.len()).rev() {
        let (p, q) = (corners[(i + 1) % corners.len()], corners[i]);
        let along_a = p.1 == q.1;
        let (from, to) = if along_a { (p.0, q.0) } else { (p.1, q.1) };
        let line = if along_a { p.1 } else { p.0 };
        let walls = storey.on(along_a, (line, from.min(to), from.max(to)));
        let mut cuts: Vec<i64> = walls.iter().flat_map(|w| [w.0, w.1]).collect();
        cuts.extend([from, to]);
        cuts.sort_unstable();
        cuts.dedup();
        if from > to {
            cuts.reverse();
        }
        for pair in cuts.windows(2) {
            let (lo, hi) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let free = walls.iter().any(|w| w.0 <= lo && hi <= w.1);
            border.push((
                at(if along_a {
                    (pair[0], line)
                } else {
                    (line, pair[0])
                }),
                free,
            ));
        }
    }
    border
}

/// Returns the upstands along the free edges of a border.
pub fn upstands(border: &Border, base: f64) -> Vec<Solid> {
    let border = straightened(border);
    let n = border.len();
    if n < 3 || border.iter().all(|(_, free)| !free) {
        return vec![];
    }
    let at = |i: usize| border[i % n].0;
    if border.iter().all(|(_, free)| *free) {
        let chain: Vec<DVec2> = (0..n).map(at).collect();
        return upstand(&chain, true, base).into_iter().collect();
    }
    let starts = (0..n).filter(|i| border[*i].1 && !border[(i + n - 1) % n].1);
    let chains = starts.map(|start| {
        let edges = (start..start + n).take_while(|i| border[i % n].1).count();
        (start..=start + edges).map(at).collect::<Vec<_>>()
    });
    chains
        .filter_map(|chain| upstand(&chain, false, base))
        .collect()
}

/// Returns the border without corners in mid-edge and edges too short for an upstand's corner.
fn straightened(border: &Border) -> Border {
    let mut kept: Border = Vec::with_capacity(border.len());
    for (i, &(at, free)) in border.iter().enumerate() {
        let next = border[(i + 1) % border.len()].0;
        if (next - at).length() < 1e-3 {
            continue;
        }
        if let Some(&(last, was)) = kept.last()
            && was == free
            && kept.len() > 1
            && (at - last).perp_dot(next - at).abs() < 1e-9 * (next - at).length()
        {
            continue;
        }
        kept.push((at, free));
    }
    kept
}

/// Returns one run of upstand along a chain of corners with the roof on the left.
fn upstand(chain: &[DVec2], closed: bool, base: f64) -> Option<Solid> {
    let n = chain.len();
    let edges = if closed { n } else { n - 1 };
    let way = |i: usize| (chain[(i + 1) % n] - chain[i % n]).normalize_or_zero();
    let mitre = |i: usize| -> DVec2 {
        let (before, after) = match closed {
            true => (way((i + n - 1) % n), way(i)),
            false if i == 0 => (way(0), way(0)),
            false if i + 1 == n => (way(n - 2), way(n - 2)),
            false => (way(i - 1), way(i)),
        };
        let left = before.perp() + after.perp();
        // Very sharp corners would project far: their mitre is cut at three widths.
        left / (left.length_squared() / 2.0).max(0.2)
    };
    let mut points = Vec::with_capacity(4 * n);
    for (i, corner) in chain.iter().enumerate() {
        let left = mitre(i);
        let (out, inn) = (*corner - left * OUT, *corner + left * IN);
        let (foot, top) = (base - LIFT, base + UPSTAND);
        points.extend([
            out.extend(foot),
            out.extend(top),
            inn.extend(top),
            inn.extend(foot),
        ]);
    }
    let turned = (0..edges).any(|i| {
        let j = (i + 1) % n;
        (0..3).step_by(2).any(|s| {
            let edge: DVec3 = points[4 * j + s] - points[4 * i + s];
            edge.truncate().dot(way(i)) < 1e-3
        })
    });
    (!turned).then(|| profile_run(points, n, closed))
}

/// Sweeps a quadrilateral profile (four points per corner, counter-clockwise seen along the run) along a chain.
fn profile_run(points: Vec<DVec3>, n: usize, closed: bool) -> Solid {
    let finish = Finish::Plaster;
    let mut faces = Vec::with_capacity(4 * n + 2);
    let edges = if closed { n } else { n - 1 };
    for i in 0..edges {
        let (p, q) = (4 * i as u32, 4 * ((i + 1) % n) as u32);
        for s in 0..4 {
            let t = (s + 1) % 4;
            faces.push(Face {
                corners: Corners::from_slice(&[p + s, q + s, q + t, p + t]),
                finish,
            });
        }
    }
    if !closed {
        let last = 4 * (n as u32 - 1);
        faces.push(Face {
            corners: Corners::from_slice(&[0, 1, 2, 3]),
            finish,
        });
        faces.push(Face {
            corners: Corners::from_slice(&[last + 3, last + 2, last + 1, last]),
            finish,
        });
    }
    Solid { points, faces }
}

#[cfg(test)]
mod tests {
    use crate::shape::flat::*;
    use hsd_ir::check::solid_flaws;

    fn sound(solids: &[Solid]) {
        assert!(!solids.is_empty());
        for solid in solids {
            assert_eq!(solid_flaws(solid).collect::<Vec<_>>(), vec![]);
        }
    }

    #[test]
    fn an_l_has_one_slab_and_one_closed_upstand() {
        let l = Plan::from_loops(vec![vec![
            (0, 0),
            (6_000_000, 0),
            (6_000_000, 4_000_000),
            (4_000_000, 4_000_000),
            (4_000_000, 9_000_000),
            (0, 9_000_000),
        ]]);
        let cell = |a1, b0, b1| Cell { a0: 0, b0, a1, b1 };
        let cells = [
            cell(6_000_000, 0, 4_000_000),
            cell(4_000_000, 4_000_000, 9_000_000),
        ];
        let slab = slab_of_cells(&cells, 0.9, 3.0, RoofKind::Metal, 0.15);
        assert_eq!(slab.len(), 1);
        sound(&slab);
        let borders = borders(&l, &Outline::of(&l), 0.9);
        sound(&upstands(&borders[0], 3.0));
    }

    #[test]
    fn an_upstand_ends_at_an_upper_wall() {
        let border = vec![
            (dvec2(0.0, 0.0), true),
            (dvec2(4.0, 0.0), true),
            (dvec2(4.0, 3.0), false),
            (dvec2(0.0, 3.0), true),
        ];
        let solids = upstands(&border, 3.0);
        assert_eq!(solids.len(), 1);
        sound(&solids);
        assert!(solids[0].points.iter().all(|p| p.y <= 3.0 + 1e-9));
    }
}
