//! Areas of rings that lie in each other: a ring within an odd number of others is a hole.

use super::feature::{Area, Chain};
use glam::DVec2;

/// Returns the areas that closed rings enclose, in the order of their outlines. A ring repeats its first point.
pub(super) fn areas(rings: Vec<Chain>) -> Vec<Area> {
    if rings.len() < 2 {
        let alone = rings.into_iter().map(|outline| Area {
            outline,
            holes: vec![],
        });
        return alone.collect();
    }
    let around: Vec<Vec<usize>> = containers(&rings);
    let mut rings: Vec<Option<Chain>> = rings.into_iter().map(Some).collect();
    let is_hole = |ring: usize| around[ring].len() % 2 == 1;
    let outlines: Vec<usize> = (0..rings.len()).filter(|ring| !is_hole(*ring)).collect();
    let mut areas: Vec<Area> = outlines
        .iter()
        .map(|ring| Area {
            outline: rings[*ring].take().unwrap_or_default(),
            holes: vec![],
        })
        .collect();
    for ring in 0..rings.len() {
        // The outline of a hole is the innermost one around it: the one that lies in all others around.
        let depth = around[ring].len();
        let owner = around[ring].iter().find(|o| around[**o].len() + 1 == depth);
        let owner = owner.and_then(|o| outlines.binary_search(o).ok());
        if let Some(hole) = rings[ring].take() {
            match owner {
                Some(owner) => areas[owner].holes.push(hole),
                None => areas.push(Area {
                    outline: hole,
                    holes: vec![],
                }),
            }
        }
    }
    areas
}

/// Returns, for each ring, those that contain it.
fn containers(rings: &[Chain]) -> Vec<Vec<usize>> {
    let bounds: Vec<(DVec2, DVec2)> = rings.iter().map(bounds).collect();
    let within = |inner: usize, outer: usize| {
        let (a, b) = (bounds[inner], bounds[outer]);
        let fits = a.0.cmpge(b.0).all() && a.1.cmple(b.1).all();
        inner != outer && fits && a != b && contains(&rings[outer].points, probe(&rings[inner]))
    };
    let all = 0..rings.len();
    all.clone()
        .map(|inner| all.clone().filter(|outer| within(inner, *outer)).collect())
        .collect()
}

fn bounds(ring: &Chain) -> (DVec2, DVec2) {
    let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let points = ring.points.iter();
    points.fold(none, |(low, high), p| (low.min(*p), high.max(*p)))
}

/// Returns a point of a ring that lies on no corner, which another ring may share.
fn probe(ring: &Chain) -> DVec2 {
    match ring.points[..] {
        [p, q, ..] => p.lerp(q, 0.4375),
        [p] => p,
        [] => DVec2::ZERO,
    }
}

/// Returns true if a point lies in a ring.
fn contains(ring: &[DVec2], p: DVec2) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x
    });
    crossed.count() % 2 == 1
}
