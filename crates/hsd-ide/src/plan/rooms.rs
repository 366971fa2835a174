//! The rooms of a plan and what is built into them.

use super::{PlanPlace, PlanWriter, place, point};
use crate::stroke::{extent, fixture_fixed, room_fixed};
use hsd_export::number::Number;
use hsd_ir::ast::{Flooring, MatOrder, RoomCeiling, Side};
use hsd_ir::building;
use serde::Serialize;

/// A room.
#[derive(Debug, Serialize)]
pub struct PlanRoom {
    /// Empty if it has none.
    pub name: String,
    /// The point at which it is written.
    pub at: [Number; 2],
    /// `boards`, `tatami` or `earth`.
    pub floor: &'static str,
    /// `festive` or `rows`.
    pub mats: &'static str,
    /// `battens`, `joists` or `none`.
    pub ceiling: &'static str,
    /// From its floor to its ceiling, shaku; null for that of the storey.
    pub height: Option<Number>,
    /// Corners of its outline, then of each opening in it; none where its point is in no area of its own.
    pub area: Vec<Vec<[Number; 2]>>,
    /// Its mats: a0, b0, a1, b1.
    pub laid: Vec<[Number; 4]>,
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// The reason why no stroke can change it.
    pub fixed: Option<&'static str>,
}

/// A fixture of a room, as the page draws it.
#[derive(Debug, Serialize)]
pub struct PlanFixture {
    /// `tokonoma`, `stairs`, ...
    pub kind: &'static str,
    /// Its least corner.
    pub at: [Number; 2],
    /// Its extent along a and b.
    pub size: [Number; 2],
    /// The side of its front: `F`, `B`, `L` or `R`.
    pub faces: char,
    /// False if it does not fit and is left out.
    pub built: bool,
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
    /// The reason why no stroke can change it.
    pub fixed: Option<&'static str>,
}

impl PlanWriter<'_> {
    /// Returns the fixtures of a storey, of which these are built.
    pub(super) fn fixtures(
        &mut self,
        storey: &building::Storey,
        built: &[building::Fixture],
    ) -> Vec<PlanFixture> {
        let fixture = |fixture: &hsd_ir::ast::Fixture| {
            let (a, b) = fixture.at.value;
            let (along_a, along_b) = extent(fixture);
            let mut sides = Side::ALL.into_iter();
            PlanFixture {
                kind: fixture.kind.word(),
                at: [Number(a), Number(b)],
                size: [Number(along_a), Number(along_b)],
                faces: sides.find(|s| s.1 == fixture.faces).map_or('F', |s| s.0),
                built: built.iter().any(|b| b.span == fixture.span),
                place: place(fixture.span),
                fixed: self.told(fixture_fixed(self.sheet, fixture)),
            }
        };
        storey.fixtures.iter().map(fixture).collect()
    }

    /// Returns the rooms of a storey, of which these have an area.
    pub(super) fn rooms(
        &mut self,
        storey: &building::Storey,
        built: &[&building::Room],
    ) -> Vec<PlanRoom> {
        let rooms = storey.rooms.iter();
        let room = |room: &hsd_ir::ast::Room| {
            let own = built.iter().find(|b| b.span == room.span);
            let mats = own.map_or(&[][..], |b| &b.mats);
            let (a, b) = room.at.value;
            PlanRoom {
                name: room.name.as_ref().map_or("", |n| &n.value).to_owned(),
                at: [Number(a), Number(b)],
                floor: word(&Flooring::ALL, room.floor),
                mats: word(&MatOrder::ALL, room.mats),
                ceiling: word(&RoomCeiling::ALL, room.ceiling),
                height: room.height.map(Number),
                area: own.map_or(vec![], |b| {
                    let ring = |ring: &Vec<_>| ring.iter().map(|p| point(*p)).collect();
                    b.area.iter().map(ring).collect()
                }),
                laid: mats
                    .iter()
                    .map(|m| [m.low.x, m.low.y, m.high.x, m.high.y].map(Number))
                    .collect(),
                place: place(room.span),
                fixed: self.told(room_fixed(self.sheet, room)),
            }
        };
        rooms.map(room).collect()
    }
}

fn word<T: PartialEq>(all: &[(&'static str, T)], own: T) -> &'static str {
    all.iter().find(|(_, it)| *it == own).map_or("", |(w, _)| w)
}
