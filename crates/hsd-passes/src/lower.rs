//! Follows the steps of a program and places the walls: [`program::House`] to [`House`]. After it there are no turns
//! and no rows; a ring that is `closed` returns to its start and crosses and touches nothing (C1 to C5 of
//! docs/evidence.md 2.3).
//!
//! - [`walk`]: one loop to walls, one after another;
//! - [`close`]: closed walks, and the line that would close an open one;
//! - [`square`]: rings that are nearly at right angles;
//! - [`purpose`]: roofs by what a house is for;
//! - [`text`]: edits that make a line of the legacy form longer, shorter, or turn the other way;
//! - [`crossing`]: walls that cross or touch, within a ring and between rings.

mod close;
mod crossing;
mod purpose;
mod square;
mod text;
mod walk;

use crate::messages::plan;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::{Heading, SHAKU};
use hsd_ir::ast::{Anchor, StoreyKind};
use hsd_ir::building::{House, Ring, Shell, Storey};
use hsd_ir::program::{self, Drawn, Program};

/// Places the walls of all houses, one after another.
pub fn lower(program: Program, out: &mut Diagnostics) -> Shell {
    let houses = program.houses.into_iter().map(|h| house(h, out));
    Shell {
        houses: houses.collect(),
        images: program.pictures,
    }
}

/// Places the walls of one house. Every defect of an outline is reported; its walls are still built, as an open facade.
pub fn house(house: program::House, out: &mut Diagnostics) -> House {
    let (mut z, mut number) = (0.0, 0);
    let raised = raised(&house);
    let mut storeys = Vec::with_capacity(house.storeys.len());
    for storey in house.storeys {
        let top = z + storey.height * SHAKU;
        let parapet = storey.kind == StoreyKind::Parapet;
        number += u32::from(!parapet);
        let is_ground = storeys.is_empty();
        let rings = lower_storey(storey.loops, house.unit_shaku * SHAKU, is_ground, out);
        storeys.push(Storey {
            span: storey.span,
            number,
            kind: storey.kind,
            z0: z,
            z1: top,
            order: storey.order,
            rings,
            rooms: storey.rooms,
            fixtures: storey.fixtures,
        });
        if !parapet {
            z = top;
        }
    }
    let mut roofs = house.roofs;
    let unit = house.unit_shaku * SHAKU;
    purpose::fill(&mut roofs, house.purpose, &storeys, unit, out);
    let [x, y, ground] = house.origin;
    let off = match house.anchor {
        Anchor::Corner => DVec2::ZERO,
        Anchor::Centre => Heading::new(180.0 - house.azimuth)
            .vector()
            .rotate(centre(&storeys, &house.puts) * unit),
    };
    House {
        span: house.span,
        name: house.name,
        variant: house.variant,
        origin: [x - off.x, y - off.y, ground + raised],
        placed: house.placed,
        azimuth: house.azimuth,
        unit: house.unit_shaku * SHAKU,
        street: house.street,
        age: house.age,
        storeys,
        raised,
        plinth: house.plinth,
        platform: house.platform,
        finials: house.finials,
        puts: house.puts,
        grounds: house.grounds,
        outdoors: house.outdoors,
        roofs,
    }
}

/// Returns the centre of the ground storey's bounds in the house frame, units east and north; of a house without walls that of
/// the parts on the ground.
fn centre(storeys: &[Storey], puts: &[program::Put]) -> DVec2 {
    let rings = storeys.first().map_or(&[][..], |ground| &ground.rings);
    let walls = rings.iter().flat_map(|ring| &ring.walls);
    let corners = walls.flat_map(|w| [w.from, w.to]);
    let alone = puts.iter().filter(|_| rings.is_empty()).map(|put| put.at);
    let around = corners
        .chain(alone)
        .fold(None, |around: Option<[DVec2; 2]>, p| {
            let [low, high] = around.unwrap_or([p, p]);
            Some([low.min(p), high.max(p)])
        });
    let middle = around.map_or(DVec2::ZERO, |[low, high]| (low + high) / 2.0);
    dvec2(-middle.x, middle.y)
}

/// The height by which a platform and the veranda of the ground storey raise the house, metres.
fn raised(house: &program::House) -> f64 {
    let ground = house.storeys.first();
    let veranda = ground.and_then(|s| s.order.veranda.as_ref());
    let platform = house.platform.as_ref().map_or(0.0, |p| p.height);
    (platform + veranda.map_or(0.0, |v| v.height)) * SHAKU
}

fn lower_storey(
    loops: Vec<program::Loop>,
    unit: f64,
    is_ground: bool,
    out: &mut Diagnostics,
) -> Vec<Ring> {
    let mut rings = Vec::with_capacity(loops.len());
    let mut facade = 0;
    for walk in loops {
        let (drawn, inner) = (walk.drawn, walk.inner);
        let mut walked = walk::walk(walk, &mut facade);
        if walked.walls.is_empty() {
            out.push(plan::no_wall(walked.span));
            continue;
        }
        let closed = !inner && close::close(&mut walked, drawn, out);
        // Upper storeys stand back that way; a ground floor begins where the house does.
        if closed
            && is_ground
            && !walked.hole
            && let Some(led) = walked.led.filter(|led| led.whole_line)
        {
            out.push(plan::voids_before_front(led.void, led.by.length()));
        }
        if closed && drawn != Drawn::Outline {
            square::square(&mut walked, unit, out);
        }
        rings.push(Ring {
            span: walked.span,
            hole: walked.hole,
            closed,
            inner,
            walls: walked.walls,
        });
    }
    crossing::check(&mut rings, out);
    rings
}
