//! Verandas (縁 en): boards on beams, short posts on the ground or arms from the wall, and a railing (高欄 kōran) of three
//! rails.

use super::{block, platform};
use crate::mesh::lathe;
use crate::mesh::{Axis, Bodies};
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::ast::Rail;
use hsd_ir::building::fittings::{Deck, Veranda};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Thickness of boards, metres.
const BOARDS: f64 = 0.045;
/// Distance of the boards' top below the floor, so that they are not coplanar with thresholds, metres.
const UNDER: f64 = 0.006;
/// Edge beam: depth and height, metres.
const EDGE: (f64, f64) = (0.13, 0.16);
/// Side of short posts, metres.
const SHORT: f64 = 0.15;
/// Height of a railing, metres.
const RAILING: f64 = 0.82;
/// Distance from the edge of the boards to the centre line of the railing, metres.
const SET_BACK: f64 = 0.13;
/// How far crossing rails extend past each other, metres.
const BEYOND: f64 = 0.26;

pub(super) fn bodies(it: &Veranda, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    let n = it.sides.len();
    for (i, side) in it.sides.iter().enumerate() {
        deck(&mut bodies, it, side);
        if detail > Detail::Body {
            below(&mut bodies, it, side, detail);
        }
        if it.rail != Rail::None {
            let bends = [&it.sides[(i + n - 1) % n], &it.sides[(i + 1) % n]];
            railing(&mut bodies, it, side, bends, detail);
        }
    }
    if it.grounded && it.top - it.foot > 0.1 {
        plinth(&mut bodies, it);
    }
    for stairs in &it.stairs {
        platform::flight(&mut bodies, stairs, it.paint, detail);
    }
    bodies
}

/// Adds the boards and the beam under their edge.
fn deck(bodies: &mut Bodies, it: &Veranda, side: &Deck) {
    let top = it.top - UNDER;
    let ring = [side.outer[0], side.outer[1], side.inner[1], side.inner[0]];
    bodies.prism(
        SurfaceId::named("boards"),
        &ring,
        Axis::Z,
        top - BOARDS,
        top,
    );
    // Mitred as the boards are.
    let width = (side.outer[0] - side.inner[0]).dot(ways(side).1).max(1e-6);
    let back = |by: f64| {
        let share = (by / width).min(1.0);
        [0, 1].map(|k| side.outer[k].lerp(side.inner[k], share))
    };
    let (near, far) = (back(0.03), back(0.03 + EDGE.0));
    let ring = [near[0], near[1], far[1], far[0]];
    bodies.prism(
        it.paint,
        &ring,
        Axis::Z,
        top - BOARDS - EDGE.1,
        top - BOARDS,
    );
}

/// Returns the directions along a side and out of the house.
fn ways(side: &Deck) -> (DVec2, DVec2) {
    let along = (side.outer[1] - side.outer[0]).normalize_or_zero();
    (along, dvec2(along.y, -along.x))
}

/// Adds the supports of the boards: posts on the ground, arms from the wall upstairs; at detail 1 only the posts.
fn below(bodies: &mut Bodies, it: &Veranda, side: &Deck, detail: Detail) {
    let (along, out) = ways(side);
    let width = (side.outer[0] - side.inner[0]).dot(out).abs();
    let top = it.top - UNDER - BOARDS;
    let shown = it.grounded || detail > Detail::Flat;
    for at in side.posts.iter().filter(|_| shown) {
        let wall = side.inner[0] + along * *at;
        if it.grounded {
            if it.top - it.foot > 0.15 {
                let span = (width - 0.2, width - 0.2 + SHORT);
                block(
                    bodies,
                    it.paint,
                    (wall, out),
                    span,
                    SHORT,
                    (it.foot, top - EDGE.1),
                );
            }
            if detail == Detail::Flat {
                continue;
            }
            block(
                bodies,
                it.paint,
                (wall, out),
                (0.0, width - 0.1),
                0.1,
                (top - 0.12, top),
            );
        } else {
            let arm = (top - EDGE.1 - 0.002, top - 0.004);
            block(
                bodies,
                it.paint,
                (wall, out),
                (0.0, width - 0.05),
                0.12,
                arm,
            );
            let lower = (arm.0 - 0.14, arm.0);
            block(
                bodies,
                it.paint,
                (wall, out),
                (0.0, width * 0.6),
                0.12,
                lower,
            );
        }
    }
}

/// Closes the space under a raised floor: dark boards set back, and posts in front of them.
fn plinth(bodies: &mut Bodies, it: &Veranda) {
    let n = it.walls.len();
    for side in &it.sides {
        let (along, out) = ways(side);
        for at in &side.posts {
            let wall = side.inner[0] + along * *at;
            block(
                bodies,
                it.paint,
                (wall, out),
                (-0.1, 0.1),
                0.2,
                (it.foot, it.top - 0.02),
            );
        }
    }
    // Every corner a little inwards.
    let middle = it.walls.iter().copied().sum::<DVec2>() / n.max(1) as f64;
    let convex = it.walls.len() == 4;
    let inner: Vec<DVec2> = match convex {
        true => it
            .walls
            .iter()
            .map(|p| *p + (middle - *p).normalize_or_zero() * 0.5)
            .collect(),
        false => it.walls.clone(),
    };
    bodies.prism(
        SurfaceId::named("boards_dark"),
        &inner,
        Axis::Z,
        it.foot - 0.1,
        it.top - 0.03,
    );
}

/// Adds the railing along one side.
fn railing(
    bodies: &mut Bodies,
    it: &Veranda,
    side: &Deck,
    [before, after]: [&Deck; 2],
    detail: Detail,
) {
    let (along, out) = ways(side);
    let turns = [(ways(before).0, along), (along, ways(after).0)];
    let sines = turns.map(|(p, q)| p.perp_dot(q));
    let convex = sines.map(|sin| sin > 0.05);
    // Half of each turn: lines at one distance before two sides meet there.
    let set = [0, 1].map(|k| SET_BACK * sines[k] / (1.0 + turns[k].0.dot(turns[k].1)).max(0.1));
    let start = side.outer[0] - out * SET_BACK + along * set[0];
    let end = side.outer[1] - out * SET_BACK - along * set[1];
    let length = (end - start).dot(along);
    if length < 0.3 {
        return;
    }
    let shift = (start - side.outer[0]).dot(along);
    let stretches = match side.gap {
        Some((a, b)) => vec![(0.0, a - shift), (b - shift, length)],
        None => vec![(0.0, length)],
    };
    for (from, to) in stretches.into_iter().filter(|(a, b)| b - a > 0.2) {
        let corner = [from < 1e-6 && convex[0], to > length - 1e-6 && convex[1]];
        let stretch = Stretch {
            start: start + along * from,
            along,
            length: to - from,
            beyond: [0, 1].map(|k| if corner[k] { sines[k] * sines[k] } else { 0.0 }),
            gate: [from > 1e-6, to < length - 1e-6],
        };
        stretch.draw(bodies, it, detail);
    }
}

/// A straight section of railing.
struct Stretch {
    start: DVec2,
    along: DVec2,
    length: f64,
    /// For each end, how far crossing rails extend past an outer corner, as a share of a right one's.
    beyond: [f64; 2],
    /// For each end, true if it is at stairs.
    gate: [bool; 2],
}

impl Stretch {
    fn draw(&self, bodies: &mut Bodies, it: &Veranda, detail: Detail) {
        let z = it.top - UNDER;
        let crossed = it.rail == Rail::Crossed;
        let beyond = self
            .beyond
            .map(|share| if crossed { BEYOND * share } else { 0.0 });
        // Rails of sides across each other lie a little apart.
        let lift = 0.004 * self.along.x.abs();
        let mut rail = |foot: f64, height: f64, width: f64, share: f64| {
            let foot = z + foot + lift;
            let from = -beyond[0] * share;
            let to = self.length + beyond[1] * share;
            block(
                bodies,
                it.paint,
                (self.start, self.along),
                (from, to),
                width,
                (foot, foot + height),
            );
        };
        rail(0.05, 0.10, 0.11, 0.7);
        rail(0.42, 0.065, 0.10, 0.85);
        if detail < Detail::Openings {
            rail(RAILING - 0.09, 0.09, 0.09, 1.0);
        } else {
            self.round_rail(bodies, it, beyond, z + RAILING - 0.045 + lift);
        }
        if detail > Detail::Body {
            self.struts(bodies, it, z, detail);
        }
        if it.rail == Rail::Knobbed {
            for (k, at) in [0.0, self.length].into_iter().enumerate() {
                // A corner post belongs to the stretch that ends there.
                if self.gate[k] || k == 1 {
                    self.knob(bodies, it, at, z, detail);
                }
            }
        }
    }

    /// Adds the top rail (架木 hokogi).
    fn round_rail(&self, bodies: &mut Bodies, it: &Veranda, beyond: [f64; 2], z: f64) {
        let side = dvec2(-self.along.y, self.along.x);
        let from = self.start - self.along * beyond[0];
        let ring: Vec<DVec3> = (0..10)
            .map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / 10.0;
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                (from + side * (0.047 * cos)).extend(z + 0.047 * sin)
            })
            .collect();
        let way = self.along * (self.length + beyond[0] + beyond[1]);
        bodies.slide(it.paint, &ring, way.extend(0.0), true);
    }

    /// Adds the struts between the rails; at detail 1 each is one block.
    fn struts(&self, bodies: &mut Bodies, it: &Veranda, z: f64, detail: Detail) {
        let count = (self.length / 0.95).round().clamp(1.0, 400.0);
        for k in 0..=count as u32 {
            let at = self.start + self.along * (self.length * f64::from(k) / count);
            let mut upright = |half: f64, foot: f64, top: f64| {
                block(
                    bodies,
                    it.paint,
                    (at, self.along),
                    (-half, half),
                    2.0 * half,
                    (z + foot, z + top),
                );
            };
            if detail == Detail::Flat {
                upright(0.035, -0.01, RAILING - 0.08);
                continue;
            }
            upright(0.05, -0.01, 0.06);
            upright(0.035, 0.14, 0.43);
            upright(0.03, 0.48, RAILING - 0.14);
            upright(0.05, RAILING - 0.14, RAILING - 0.08);
        }
    }

    /// Adds a post with a bulb (擬宝珠 gibōshi).
    fn knob(&self, bodies: &mut Bodies, it: &Veranda, at: f64, z: f64, detail: Detail) {
        let at = self.start + self.along * at;
        block(
            bodies,
            it.paint,
            (at, self.along),
            (-0.075, 0.075),
            0.15,
            (z, z + 0.92),
        );
        if detail < Detail::Openings {
            return;
        }
        let bulb = [
            (0.0, 0.92),
            (0.072, 0.92),
            (0.072, 1.02),
            (0.05, 1.05),
            (0.05, 1.08),
            (0.085, 1.12),
            (0.09, 1.17),
            (0.07, 1.22),
            (0.03, 1.26),
            (0.0, 1.31),
        ];
        lathe::turned(bodies, SurfaceId::named("bronze"), at.extend(z), &bulb, 12);
    }
}
