//! The rooms of a plan.

use super::{PlanPlace, PlanWriter, place, point};
use crate::ast::{Flooring, MatOrder, RoomCeiling};
use crate::backend::number::Number;
use crate::building;
use crate::ide::stroke::room_fixed;
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

impl PlanWriter<'_> {
    /// Returns the rooms of a storey, of which these have an area.
    pub(super) fn rooms(
        &mut self,
        storey: &building::Storey,
        built: &[&building::Room],
    ) -> Vec<PlanRoom> {
        let rooms = storey.rooms.iter();
        let room = |room: &crate::ast::Room| {
            let own = built.iter().find(|b| b.span == room.span);
            let mats = own.map_or(&[][..], |b| &b.mats);
            let (a, b) = room.at.value;
            PlanRoom {
                name: room.name.as_ref().map_or("", |n| &n.value).to_owned(),
                at: [Number(a), Number(b)],
                floor: word(&Flooring::ALL, room.floor),
                mats: word(&MatOrder::ALL, room.mats),
                ceiling: word(&RoomCeiling::ALL, room.ceiling),
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
