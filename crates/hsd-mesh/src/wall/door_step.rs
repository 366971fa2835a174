//! Stones before doors (踏石 fumi-ishi): the floor of a house on foundation stones lies 28 cm above the ground, so a
//! slab half as high lies before every door and open bay that leads outdoors.

use crate::mesh::{Axis, Bodies};
use crate::store::{Key, tenths};
use crate::wall::{Line, PlacedUnit};
use crate::{Level, Walker};
use glam::{dvec2, dvec3};
use hsd_base::geometry::FOUNDATION;
use hsd_ir::catalog::Stance;
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_scene::{Detail, Kind, NodeId};

/// Distance of its front from the wall's centre line, metres: a foot deep before the thickest door sill.
const FRONT: f64 = 0.52;
/// Distance of its back from there: within the foundation stones, metres.
const BACK: f64 = 0.05;
/// Foot and top above the floor, metres: a hair above the ground, and halfway to the floor.
const HEIGHT: (f64, f64) = (-FOUNDATION + 0.0015, -FOUNDATION / 2.0);
/// What it leaves free at each end of the doors, metres.
const INSET: f64 = 0.12;
/// The bevel of its upper edge, metres.
const BEVEL: f64 = 0.015;
/// Doors narrower than this get none, metres.
const LEAST: f64 = 0.5;

impl Walker<'_> {
    /// Adds a stone before each run of doors of a wall that stands on the ground, if the wall bounds a house.
    pub(crate) fn door_steps(&mut self, level: Level<'_>, facade: NodeId, line: &Line<'_>) {
        if !line.bounds || !level.grounded() || self.detail == Detail::Body {
            return;
        }
        let catalog = self.catalog;
        let leads_out = |s: &PlacedUnit<'_>| match &s.unit.content {
            // What stands on no stones reaches the ground itself.
            Content::Part(id) => s.stance != Stance::Free && catalog.part(*id).leads_through(),
            _ => false,
        };
        let mut open: Option<f64> = None;
        let wide = line.units.iter().filter(|s| !s.is_post());
        for placed in wide.map(Some).chain([None]) {
            match (open, placed.filter(|s| leads_out(s))) {
                (None, Some(first)) => open = Some(first.offset),
                (Some(from), None) => {
                    let to = placed.map_or(line.length, |s| s.offset);
                    if to - from >= LEAST {
                        self.door_step(level, facade, (from + INSET, to - INSET));
                    }
                    open = None;
                }
                _ => {}
            }
        }
    }

    /// Adds one stone between two offsets along the wall.
    fn door_step(&mut self, level: Level<'_>, facade: NodeId, (from, to): (f64, f64)) {
        let length = tenths(to - from);
        self.store.weather = self.frame(HEIGHT);
        let mesh = self.store.bodies(Key::Step(length), "door step", || {
            let (foot, top) = HEIGHT;
            // Outdoors is towards negative y.
            let section = [
                dvec2(-BACK, foot),
                dvec2(-FRONT, foot),
                dvec2(-FRONT, top - BEVEL),
                dvec2(-FRONT + BEVEL, top),
                dvec2(-BACK, top),
            ];
            let mut bodies = Bodies::default();
            let length = f64::from(length) / 10_000.0;
            let stone = SurfaceId::named("stone");
            bodies.prism(stone, &section, Axis::X, -length, 0.0);
            bodies
        });
        let at = dvec3(-from, 0.0, 0.0);
        let node = self.node(Some(facade), Kind::Member, "door step".into(), at);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }
}
