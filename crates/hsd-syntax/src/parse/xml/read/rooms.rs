//! `Room`: the name, the floor and the ceiling of an area between walls. `Fixture`: what is built into it.

use crate::parse::schema::Schema;
use crate::parse::schema::vocabulary::SIDES;
use crate::parse::xml::read::Reader;
use crate::parse::xml::tree::Element;
use hsd_base::source::Spanned;
use hsd_ir::ast::{Fixture, FixtureKind, Flooring, MatOrder, Room, RoomCeiling, Side};

impl<'t> Reader<'t, '_> {
    /// Reads a room; one without a place is reported as an element without an attribute that it needs.
    pub(in crate::parse::xml) fn room(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Room> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let floor = self.choice(&of, "floor", &Flooring::ALL);
        let mats = self.choice(&of, "mats", &MatOrder::ALL);
        let ceiling = self.choice(&of, "ceiling", &RoomCeiling::ALL);
        Some(Room {
            span: self.whole(element),
            name: self.text(&of, "name"),
            at: self.point(&of, "at")?,
            floor: floor.map_or(Flooring::default(), |f| f.value),
            mats: mats.map_or(MatOrder::default(), |m| m.value),
            ceiling: ceiling.map_or(RoomCeiling::default(), |c| c.value),
            height: self.number(&of, "height").map(|h| h.value),
        })
    }

    /// Reads a fixture; one without a kind or a place is reported as an element without an attribute that it needs.
    pub(in crate::parse::xml) fn fixture(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Fixture> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let kind = self.choice(&of, "kind", &FixtureKind::ALL);
        let at = self.point(&of, "at");
        let size = self.pair(&of, "size");
        let faces = self.choice(&of, "faces", &SIDES);
        Some(Fixture {
            span: self.whole(element),
            kind: kind?.value,
            at: at?,
            size: size.map(|s| Spanned::new(s.value.into(), s.span)),
            faces: faces.map_or(Side::Front, |f| f.value),
        })
    }
}
