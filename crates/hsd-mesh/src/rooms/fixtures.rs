//! Fixtures: what is built into rooms. Each is made in a frame of its own: x to the right and y to the back as seen from its
//! front, round the middle of its rectangle, z up from the boards of the floor; metres.

mod alcove;
mod kitchen;
mod stairs;

use super::{ceiling_height, floor_top};
use crate::mesh::Bodies;
use crate::store::look::Share;
use crate::weather::Weather;
use crate::{Level, Walker};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_base::geometry::in_rings;
use hsd_ir::ast::{FixtureKind, Flooring, Side};
use hsd_ir::building::{Fixture, Room};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, MeshId};
use std::collections::HashMap;

/// Half the side of the posts of walls, metres: what stands against a wall begins beside them.
const POST: f64 = 0.060;

/// Thickness of the partitions at sides without a wall, metres.
const PARTITION: f64 = 0.050;

/// The clear height of what stands under a sloping roof, metres.
const UNDER_A_SLOPE: f64 = 1.80;

/// Meshes of fixtures made so far, by kind, sizes and neighbours. Never iterated.
#[derive(Debug, Default)]
pub(crate) struct FixtureMeshes(HashMap<(FixtureKind, [i64; 4], Vec<bool>, Weather), MeshId>);

/// What a fixture is made from.
struct Place {
    /// Half its width and half its depth.
    half: DVec2,
    /// The height of the ceiling over it.
    top: f64,
    /// The height of the floor above.
    rise: f64,
    walls: Sides,
    /// Of stairs, true for sides of the opening above without a wall; none where the storey above is not shown.
    open_above: Option<Sides>,
    /// True for the finest detail.
    fine: bool,
}

/// Something about the sides of a fixture, seen from its front.
#[derive(Clone, Copy, Default)]
struct Sides {
    front: bool,
    back: bool,
    left: bool,
    right: bool,
}

impl Sides {
    /// Turns what is known of -a, +a, -b, +b to the front. The house's frame is the author's as in a mirror.
    fn of([low_a, high_a, low_b, high_b]: [bool; 4], faces: Side) -> Sides {
        let [front, back, left, right] = match faces {
            Side::Front => [low_b, high_b, high_a, low_a],
            Side::Back => [high_b, low_b, low_a, high_a],
            Side::Left => [high_a, low_a, high_b, low_b],
            Side::Right => [low_a, high_a, low_b, high_b],
        };
        Sides {
            front,
            back,
            left,
            right,
        }
    }

    fn all(self) -> [bool; 4] {
        [self.front, self.back, self.left, self.right]
    }
}

impl Place {
    /// Returns the least x and the greatest between walls or, where there are none, up to the edges.
    fn across(&self) -> (f64, f64) {
        let beside = |wall: bool| if wall { POST } else { 0.0 };
        let (left, right) = (beside(self.walls.left), beside(self.walls.right));
        (left - self.half.x, self.half.x - right)
    }

    /// Returns the y of its back.
    fn back(&self) -> f64 {
        self.half.y - if self.walls.back { POST } else { 0.0 }
    }

    /// Returns the y of its front.
    fn front(&self) -> f64 {
        -self.half.y
    }
}

impl Walker<'_> {
    /// Writes the fixtures of a storey.
    pub(crate) fn fixtures(&mut self, level: Level<'_>, fixtures: &[&Fixture], rooms: &[&Room]) {
        if self.detail <= Detail::Flat {
            return;
        }
        self.weather(|aged| aged.even("room", 0.0));
        for fixture in fixtures {
            let below = rooms.iter().find(|r| in_rings(&r.area, fixture.middle()));
            let floor = below.map_or(Flooring::Boards, |room| room.floor);
            self.fixture(level, fixture, floor);
        }
    }

    fn fixture(&mut self, level: Level<'_>, fixture: &Fixture, floor: Flooring) {
        let unit = level.house.unit;
        let (width, depth) = fixture.front_and_depth();
        let top = match level.is_under_a_slope() {
            true => level.height.min(UNDER_A_SLOPE),
            false => ceiling_height(level, fixture.height),
        };
        let seen = self.shown.has_ceiling(level.storey.number, self.storeys);
        let foot = floor_top(level, floor);
        let place = Place {
            half: dvec2(width, depth) * unit / 2.0,
            top: top - foot,
            rise: level.height - foot,
            walls: Sides::of(fixture.walls, fixture.faces),
            open_above: seen.then(|| Sides::of(fixture.open_above, fixture.faces)),
            fine: self.detail == Detail::Everything,
        };
        let step = |metres: f64| (metres * 10_000.0).round() as i64;
        let sizes = [place.half.x, place.half.y, place.top, place.rise].map(step);
        let mut sides = [place.walls.all(), [false; 4]].concat();
        if let Some(open) = place.open_above {
            sides[4..].copy_from_slice(&open.all());
        }
        sides.push(place.open_above.is_some());
        let key = (fixture.kind, sizes, sides, self.store.weather);
        let word = fixture.kind.word();
        let mesh = match self.fixtures.0.get(&key) {
            Some(mesh) => *mesh,
            None => {
                let body = body(fixture.kind, &place);
                let mesh = self.store.finish(word.into(), body, Share::default());
                let mesh = self.store.push(mesh);
                self.fixtures.0.insert(key, mesh);
                mesh
            }
        };
        let middle = level.house.place(fixture.middle(), 0.0);
        let at = dvec3(middle.x, middle.y, foot);
        let node = self.node(Some(level.node), Kind::Fixture, word.into(), at);
        node.mesh = Some(mesh);
        node.storey = Some(fixture.storey);
        node.span = Some(fixture.span);
        node.turn = match fixture.faces {
            Side::Front => DVec2::X,
            Side::Back => DVec2::NEG_X,
            Side::Left => DVec2::NEG_Y,
            Side::Right => DVec2::Y,
        };
    }
}

fn body(kind: FixtureKind, place: &Place) -> Bodies {
    let mut bodies = Bodies::default();
    let add = match kind {
        FixtureKind::Tokonoma => alcove::tokonoma,
        FixtureKind::Chigaidana => alcove::chigaidana,
        FixtureKind::Butsudan => alcove::butsudan,
        FixtureKind::OshiIre => alcove::oshi_ire,
        FixtureKind::Stairs => stairs::open,
        FixtureKind::HakoKaidan => stairs::chests,
        FixtureKind::Kamado => kitchen::kamado,
        FixtureKind::Well => kitchen::well,
        FixtureKind::Sink => kitchen::sink,
    };
    add(&mut bodies, place);
    bodies
}

/// Adds a box of a named surface.
fn block(bodies: &mut Bodies, finish: &str, low: [f64; 3], high: [f64; 3]) {
    let (low, high) = (DVec3::from(low), DVec3::from(high));
    bodies.block(SurfaceId::named(finish), low, high);
}
