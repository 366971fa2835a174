//! Rooms that the author has written: floors, mats and ceilings between the walls of a storey, and what is built in.

mod fixtures;

use crate::mesh::Bodies;
use crate::store::look::Share;
use crate::wall::room::{BOARDS, CEILING, DOMA, GROUND, UNDER};
use crate::weather::Weather;
use crate::{Level, Walker};
use compact_str::format_compact;
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_base::geometry::SAME;
use hsd_base::geometry::triangulate::triangles;
use hsd_ir::ast::{Flooring, RoomCeiling};
use hsd_ir::building::{Mat, Room};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, MeshId, NodeId};
use std::collections::HashMap;

pub(super) use fixtures::FixtureMeshes;

/// Tops of mats above the boards that they lie on, metres.
const MAT: f64 = 0.010;

/// From the centre line of a wall to the mats beside it: half a post, which the bar along the wall (畳寄せ) fills; metres.
const WALL: f64 = 0.060;

/// How far battens reach into the walls, metres.
const LAP: f64 = 0.004;

/// Width of the cloth along the long sides of a mat (縁), metres.
const CLOTH: f64 = 0.030;

/// Battens under a ceiling (棹縁): width and height, metres, and distance, U.
const BATTENS: [f64; 3] = [0.030, 0.036, 0.5];

/// Joists under the boards of the floor above: width and height, metres, and distance, U.
const JOISTS: [f64; 3] = [0.105, 0.150, 1.0];

/// Meshes of mats made so far, by length and width in tenths of a millimetre. Never iterated.
#[derive(Debug, Default)]
pub(super) struct MatMeshes(HashMap<(i64, i64, Weather), MeshId>);

impl Walker<'_> {
    /// Writes the rooms of a storey.
    pub(super) fn rooms(&mut self, level: Level<'_>, rooms: &[&Room]) {
        if self.detail <= Detail::Flat {
            return;
        }
        self.weather(|aged| aged.even("room", 0.0));
        for room in rooms {
            self.chamber(level, room);
        }
    }

    fn chamber(&mut self, level: Level<'_>, room: &Room) {
        let mut bodies = Bodies::default();
        let floor = SurfaceId::named(match room.floor {
            Flooring::Earth => "earth",
            Flooring::Boards | Flooring::Tatami => "boards",
        });
        let foot = if level.grounded() { GROUND } else { BOARDS };
        for piece in pieces(level, room, room.floors.as_ref()) {
            slab(
                &mut bodies,
                floor,
                &piece,
                foot,
                floor_top(level, room.floor),
            );
        }
        // None that would stick out of a lean-to.
        let seen = self.shown.has_ceiling(level.storey.number, self.storeys);
        if seen && (!level.is_under_a_slope() || room.height.is_some()) {
            let top = ceiling_height(level, room.height);
            for piece in pieces(level, room, room.ceilings.as_ref()) {
                ceiling(&mut bodies, room.ceiling, (&piece, level.house.unit), top);
            }
        }
        let name = match room.name.as_str() {
            "" => "room".into(),
            name => format_compact!("room {name}"),
        };
        let mesh = self
            .store
            .finish(name.to_string(), bodies, Share::default());
        let mesh = self.store.push(mesh);
        let node = self.node(Some(level.node), Kind::Room, name, DVec3::ZERO);
        node.mesh = Some(mesh);
        node.storey = Some(room.storey);
        node.span = Some(room.span);
        let own = self.last();
        for (number, mat) in room.mats.iter().enumerate() {
            self.mat(level, own, mat, number + 1);
        }
    }

    fn mat(&mut self, level: Level<'_>, room: NodeId, mat: &Mat, number: usize) {
        let unit = level.house.unit;
        let inset = mat.walls.map(|wall| if wall { WALL } else { 0.0 });
        let low = mat.low * unit + dvec2(inset[0], inset[2]);
        let high = mat.high * unit - dvec2(inset[1], inset[3]);
        let (size, middle) = (high - low, (low + high) / 2.0);
        let along_a = mat.runs_along_a();
        let (length, width) = match along_a {
            true => (size.x, size.y),
            false => (size.y, size.x),
        };
        let step = |metres: f64| (metres * 10_000.0).round() as i64;
        let key = (step(length), step(width), self.store.weather);
        let mesh = match self.mats.0.get(&key) {
            Some(mesh) => *mesh,
            None => {
                let mesh =
                    self.store
                        .finish("mat".into(), mat_body(length, width), Share::default());
                let mesh = self.store.push(mesh);
                self.mats.0.insert(key, mesh);
                mesh
            }
        };
        let at = dvec3(-middle.x, middle.y, floor_top(level, Flooring::Tatami));
        let node = self.node(Some(room), Kind::Room, format_compact!("mat {number}"), at);
        node.mesh = Some(mesh);
        if !along_a {
            node.turn = DVec2::Y;
        }
    }
}

/// A mat round its centre, its long sides along x: rush between two strips of cloth. Corners meet, so that it is closed.
fn mat_body(length: f64, width: f64) -> Bodies {
    let mut bodies = Bodies::default();
    let (x, y) = (length / 2.0, width / 2.0);
    let (rush, cloth) = (SurfaceId::named("tatami"), SurfaceId::named("indigo"));
    for (finish, low, high) in [
        (cloth, -y, -y + CLOTH),
        (rush, -y + CLOTH, y - CLOTH),
        (cloth, y - CLOTH, y),
    ] {
        let top = [(-x, low), (x, low), (x, high), (-x, high)];
        let at = |i: usize, z: f64| dvec3(top[i % 4].0, top[i % 4].1, z);
        bodies.face(finish, &[0, 1, 2, 3].map(|i| at(i, MAT)));
        bodies.face(finish, &[3, 2, 1, 0].map(|i| at(i, 0.0)));
        for i in 0..4 {
            let inner = match i {
                0 => low > -y,
                2 => high < y,
                _ => false,
            };
            if !inner {
                bodies.face(
                    finish,
                    &[at(i, 0.0), at(i + 1, 0.0), at(i + 1, MAT), at(i, MAT)],
                );
            }
        }
    }
    bodies
}

/// Returns the top of a floor: boards lie a hair below the thresholds on the ground, above the tops of the walls below
/// upstairs; earth lies on the ground, a long step lower.
fn floor_top(level: Level<'_>, floor: Flooring) -> f64 {
    if floor == Flooring::Earth && level.grounded() {
        DOMA
    } else if level.storey.number == 1 {
        UNDER
    } else {
        -UNDER
    }
}

/// Returns how far a ceiling hangs above the floor: that of a room, or below the next storey; metres.
fn ceiling_height(level: Level<'_>, room: Option<f64>) -> f64 {
    let whole = level.height.min(level.storey.wall_height()) + CEILING.0;
    room.map_or(whole, |height| height.min(whole))
}

/// Returns the pieces of a floor or a ceiling, or the room's whole area where there are none, in the house's frame: each
/// counter-clockwise, then what stands free in it, clockwise.
fn pieces(
    level: Level<'_>,
    room: &Room,
    pieces: Option<&Vec<Vec<Vec<DVec2>>>>,
) -> Vec<Vec<Vec<DVec2>>> {
    let place = |p: &DVec2| level.house.place(*p, 0.0).truncate();
    // The house frame is the author's as in a mirror.
    let turned = |ring: &Vec<DVec2>| ring.iter().rev().map(place).collect();
    let outline = |area: &Vec<Vec<DVec2>>| area.iter().map(turned).collect();
    match pieces {
        None => vec![outline(&room.area)],
        Some(pieces) => pieces.iter().map(outline).collect(),
    }
}

/// Adds a floor or a ceiling between two heights.
fn slab(bodies: &mut Bodies, finish: SurfaceId, area: &[Vec<DVec2>], lo: f64, hi: f64) {
    let Some((outer, holes)) = area.split_first() else {
        return;
    };
    for [p, q, r] in triangles(outer, holes) {
        bodies.face(finish, &[p, q, r].map(|p| p.extend(hi)));
        bodies.face(finish, &[r, q, p].map(|p| p.extend(lo)));
    }
    for ring in area {
        for (p, q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            bodies.face(
                finish,
                &[p.extend(lo), q.extend(lo), q.extend(hi), p.extend(hi)],
            );
        }
    }
}

/// Adds a ceiling whose lower face lies at a height above the floor.
fn ceiling(bodies: &mut Bodies, kind: RoomCeiling, (area, unit): (&[Vec<DVec2>], f64), top: f64) {
    let [width, height, apart] = match kind {
        RoomCeiling::None => return,
        RoomCeiling::Battens => BATTENS,
        RoomCeiling::Joists => JOISTS,
    };
    let thick = CEILING.1 - CEILING.0;
    slab(bodies, SurfaceId::named("soffit"), area, top, top + thick);
    let corners = || area.iter().flatten().copied();
    let low = corners().reduce(DVec2::min).unwrap_or_default();
    let high = corners().reduce(DVec2::max).unwrap_or_default();
    let size = high - low;
    // Battens run along the room, joists across it.
    let along_x = (size.x >= size.y) == (kind == RoomCeiling::Battens);
    let (axis, across) = match along_x {
        true => (DVec2::X, DVec2::Y),
        false => (DVec2::Y, DVec2::X),
    };
    let span = size.dot(across);
    let count = (span / (apart * unit)).round().max(1.0);
    for i in 1..count as u32 {
        let middle = low.dot(across) + span * f64::from(i) / count;
        for (from, to) in stretches(area, axis, across, middle) {
            let (s, e) = (from * axis, to * axis);
            let side = across * (width / 2.0);
            let (p, q) = (s + across * middle - side, e + across * middle + side);
            bodies.block(
                SurfaceId::named("cedar"),
                p.min(q).extend(top - height),
                p.max(q).extend(top),
            );
        }
    }
}

/// Returns where a line across a polygon lies inside it, as places along an axis.
fn stretches(area: &[Vec<DVec2>], axis: DVec2, across: DVec2, at: f64) -> Vec<(f64, f64)> {
    let sides = area.iter().flat_map(|ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next)
    });
    let cuts = sides.filter_map(|(p, q)| {
        let (s, t) = (p.dot(across) - at, q.dot(across) - at);
        ((s > 0.0) != (t > 0.0)).then(|| p.lerp(*q, s / (s - t)).dot(axis))
    });
    let mut cuts: Vec<f64> = cuts.collect();
    cuts.sort_by(f64::total_cmp);
    let pairs = cuts
        .chunks_exact(2)
        .map(|pair| (pair[0] + WALL - LAP, pair[1] - WALL + LAP));
    pairs.filter(|(from, to)| to - from > SAME).collect()
}
