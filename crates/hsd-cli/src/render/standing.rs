//! Cameras that stand in a courtyard or before a side of a house, at eye height.

use glam::DVec2;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{Built, House, Ring};

/// Metres of the eyes above the ground.
const EYES: f64 = 1.6;
/// Vertical angles of view, degrees: courts are narrow.
const COURT_FOV: f64 = 75.0;
const SIDE_FOV: f64 = 60.0;
/// Share of a court's diagonal that is left behind the camera.
const BEHIND: f64 = 0.12;
/// Distance from a side, in its lengths and in metres.
const AWAY: f64 = 0.8;
const NEAREST: f64 = 3.5;
const FARTHEST: f64 = 12.0;
/// How far left of the middle the camera stands, in lengths of the side.
const ASIDE: f64 = 0.3;
/// The share of its distance that a camera keeps at each step towards its side, where another house is in its place.
const STEP: f64 = 0.85;
const CLOSE: f64 = 1.2;

/// A camera: metres east, north and up in the world; vertical angle of view, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
    pub(super) fov: f64,
}

/// Returns the number of courtyards of a house's ground storey.
pub(super) fn courts(house: &House) -> usize {
    holes(house).count()
}

fn holes(house: &House) -> impl Iterator<Item = &Ring> {
    let ground = house.storeys.first().into_iter();
    ground.flat_map(|s| s.rings.iter().filter(|r| r.hole && r.closed && !r.inner))
}

/// Returns the camera in a courtyard, counted from 0: in one corner, looking to the one farthest from it.
pub(super) fn in_court(house: &House, court: usize) -> Option<Camera> {
    let corners = world_corners(house, holes(house).nth(court)?);
    let pairs = (0..corners.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    // Courts that are no rectangles: the line of sight must stay in them.
    let sees = |(i, j): &(usize, usize)| {
        let at = |share: f64| corners[*i].lerp(corners[*j], share);
        [0.1, 0.3, 0.5, 0.7, 0.9]
            .iter()
            .all(|s| holds(&corners, at(*s)))
    };
    let length = |(i, j): &(usize, usize)| corners[*i].distance(corners[*j]);
    let (i, j) = pairs
        .filter(sees)
        .max_by(|p, q| length(p).total_cmp(&length(q)))?;
    let ground = house.origin[2];
    let from = corners[i].lerp(corners[j], BEHIND);
    Some(Camera {
        from: from.extend(ground + EYES).to_array(),
        to: corners[j].extend(ground + EYES + 0.4).to_array(),
        fov: COURT_FOV,
    })
}

/// Returns the number of sides of a house's ground storey.
pub(super) fn sides(house: &House) -> usize {
    outer(house).map_or(0, |ring| ring.walls.len())
}

fn outer(house: &House) -> Option<&Ring> {
    let ground = house.storeys.first()?;
    ground.rings.iter().find(|r| !r.hole && !r.inner)
}

/// Returns the camera before a side of a house, counted from 0 in the order of its walls, so that no other house is in its
/// place.
pub(super) fn before_side(houses: &[Built], house: usize, side: usize) -> Option<Camera> {
    let own = &houses.get(house)?.house;
    let wall = outer(own)?.walls.get(side)?;
    // Seen from outside a wall runs from its right end to its left end.
    let (right, left) = (own.world(wall.from), own.world(wall.to));
    let (length, middle) = (left.distance(right), left.midpoint(right));
    let out = (left - right).try_normalize()?.perp();
    let own_out = own.world(wall.from + DVec2::new(wall.direction.y, -wall.direction.x)) - right;
    let out = if out.dot(own_out) < 0.0 { -out } else { out };
    let others: Vec<Vec<DVec2>> = houses
        .iter()
        .filter_map(|b| Some(world_corners(&b.house, outer(&b.house)?)))
        .collect();
    let mut away = (AWAY * length).clamp(NEAREST, FARTHEST);
    let mut from = place(middle, left, out, away);
    while others.iter().any(|ring| holds(ring, from)) && away > CLOSE {
        away *= STEP;
        from = place(middle, left, out, away);
    }
    let ground = own.origin[2];
    let full = own.storeys.iter().filter(|s| s.kind == StoreyKind::Storey);
    let top = full.map(|s| s.z1).fold(0.0, f64::max);
    Some(Camera {
        from: from.extend(ground + EYES).to_array(),
        to: middle.extend(ground + EYES.max(0.5 * top)).to_array(),
        fov: SIDE_FOV,
    })
}

fn place(middle: DVec2, left: DVec2, out: DVec2, away: f64) -> DVec2 {
    middle + out * away + (left - middle) * (2.0 * ASIDE)
}

fn world_corners(house: &House, ring: &Ring) -> Vec<DVec2> {
    ring.corners().into_iter().map(|p| house.world(p)).collect()
}

/// Returns true if a polygon holds a point.
fn holds(ring: &[DVec2], p: DVec2) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |(a, b): &(&DVec2, &DVec2)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}
