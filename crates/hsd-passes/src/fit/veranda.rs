//! Verandas: one deck along each wall of a storey, mitred at the corners.

use super::around::{moved, outline};
use super::platform::{flight, middle_bay};
use super::{paint, posts_of, rings};
use glam::{DVec2, dvec2};
use hsd_base::geometry::SHAKU;
use hsd_ir::ast;
use hsd_ir::building::fittings::{Deck, Stairs, Veranda};
use hsd_ir::building::{House, Ring, Storey};

/// Returns the veranda of a storey; `None` if none of its rings is closed.
pub(super) fn veranda(
    house: &House,
    storey: &Storey,
    written: &ast::Veranda,
    ground: bool,
) -> Option<Veranda> {
    let ring = rings(storey).next()?;
    let walls = outline(house, ring);
    let edge = moved(&walls, DVec2::splat(written.width * SHAKU));
    if edge.len() != walls.len() {
        return None;
    }
    let rise = written.height * SHAKU;
    let top = if ground { 0.0 } else { storey.z0 + rise };
    let stairs: Vec<Stairs> = written
        .stairs
        .iter()
        .filter(|_| ground)
        .filter_map(|side| {
            let way = side.outward();
            let width = middle_bay(house, storey, *side);
            flight(&edge, dvec2(-way.x, way.y), width, (top - rise, top))
        })
        .collect();
    let n = walls.len();
    let sides = (0..n).map(|i| {
        let j = (i + 1) % n;
        let outer = [edge[i], edge[j]];
        Deck {
            inner: [walls[i], walls[j]],
            outer,
            posts: posts_between(house, ring, walls[i], walls[j]),
            gap: stairs.iter().find_map(|s| gap(outer, s)),
        }
    });
    let own = storey.order.posts.as_ref().map(|p| p.paint);
    Some(Veranda {
        sides: sides.collect(),
        walls: walls.clone(),
        foot: top - rise,
        top,
        grounded: ground,
        rail: written.rail,
        paint: paint(written.paint.or(own)),
        stairs,
    })
}

/// Returns the posts of the walls between two corners, metres from the first.
fn posts_between(house: &House, ring: &Ring, from: DVec2, to: DVec2) -> Vec<f64> {
    let along = (to - from).normalize_or_zero();
    let length = from.distance(to);
    let mut found: Vec<f64> = vec![];
    for wall in &ring.walls {
        for at in posts_of(wall) {
            let p = super::metres(house, wall.from + wall.direction * at);
            let (on, off) = ((p - from).dot(along), (p - from).perp_dot(along).abs());
            if off < 0.001 && (-0.001..=length + 0.001).contains(&on) {
                found.push(on);
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| (*a - *b).abs() < 0.01);
    found
}

/// Returns the gap where stairs reach an edge, metres from its first corner.
fn gap([p, q]: [DVec2; 2], stairs: &Stairs) -> Option<(f64, f64)> {
    let along = (q - p).normalize_or_zero();
    let (on, off) = ((stairs.at - p).dot(along), (stairs.at - p).perp_dot(along));
    let here = off.abs() < 0.001 && dvec2(along.y, -along.x).dot(stairs.out) > 0.7;
    here.then_some((on - stairs.width / 2.0, on + stairs.width / 2.0))
}
