//! Parapets of one-piece fronts: they rise above the eaves and hide the roof behind them from the street.

use crate::mesh::Bodies;
use crate::store::{Key, tenths};
use crate::wall::Line;
use crate::{Level, Walker};
use glam::dvec3;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_ir::catalog::{Catalog, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_scene::{Kind, NodeId};

/// Half its thickness, metres: that of a modern wall.
const HALF: f64 = 0.075;

/// How far it covers the post at a corner, metres.
const CORNER: f64 = 0.068;

/// Overhang and thickness of its metal cap, metres.
const CAP: (f64, f64) = (0.020, 0.030);

/// Its number in [`Key::Member`].
const NUMBER: u8 = 100;

impl Walker<'_> {
    /// Adds parapets over the runs of modern units in a wall of the highest storey, if one of them has a parapet.
    pub(crate) fn parapet(&mut self, level: Level<'_>, facade: NodeId, line: &Line<'_>) {
        let highest = level.house.storeys.last();
        if !level.framed() || highest.is_none_or(|s| s.number != level.storey.number) {
            return;
        }
        let mut run: Option<(f64, f64, f64)> = None;
        let wide = line.units.iter().filter(|s| !s.is_post());
        for placed in wide.map(Some).chain([None]) {
            let own = placed.filter(|s| s.stance == Stance::Modern && s.top() == level.height);
            if let Some(placed) = own {
                let rise = rise(self.catalog, &placed.unit.content);
                let (from, _, highest) = run.unwrap_or((placed.offset, 0.0, 0.0));
                run = Some((from, placed.offset + placed.width, rise.max(highest)));
            } else if let Some((from, to, rise)) = run.take().filter(|r| r.2 > 0.0) {
                self.head(level, facade, line, (from, to), rise);
            }
        }
    }

    /// Adds one parapet between two offsets along the wall.
    fn head(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        (from, to): (f64, f64),
        rise: f64,
    ) {
        let from = if from < SAME { from - CORNER } else { from };
        let to = if to > line.length - SAME {
            to + CORNER
        } else {
            to
        };
        let length = tenths(to - from);
        let key = Key::Member(NUMBER, length, [tenths(rise) as i32, 0]);
        self.store.weather = self.frame((level.height, level.height + rise));
        let mesh = self.store.bodies(key, "parapet", || {
            let mut bodies = Bodies::default();
            let (left, (over, thick)) = (-f64::from(length) / 10_000.0, CAP);
            let wall = (dvec3(left, -HALF, 0.0), dvec3(0.0, HALF, rise));
            bodies.block(SurfaceId::named("mortar"), wall.0, wall.1);
            let lo = dvec3(left - over, -HALF - over, rise);
            let hi = dvec3(over, HALF + over, rise + thick);
            bodies.block(SurfaceId::named("sheet_roof"), lo, hi);
            bodies
        });
        let at = dvec3(-from, 0.0, level.height);
        let node = self.node(Some(facade), Kind::Member, "parapet".into(), at);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }
}

/// Returns the height of a unit's parapet, metres; 0 = none.
fn rise(catalog: &Catalog, content: &Content) -> f64 {
    match content {
        Content::Part(id) => catalog.part(*id).parapet.map_or(0.0, |h| h * SHAKU),
        Content::Split(split) => {
            let units = split.upper.iter().chain(&split.lower);
            units.map(|u| rise(catalog, &u.content)).fold(0.0, f64::max)
        }
        Content::Void | Content::Picture(_) => 0.0,
    }
}
