//! How a house stands on the ground of its town: level, a step above the lowest point of the street before its lot, on a plinth
//! that reaches down to the ground under every wall.

use super::LotSite;
use crate::plot::Rectangle;
use crate::rear::{RearDecision, RearPlace};
use crate::shape::{Segment, sides};
use glam::DVec2;
use hsd_ir::ast::town::Stood;

/// The height of the floor above the street, metres.
const STEP: f64 = 0.3;
/// How far a plinth reaches below the lowest ground that was found: the mesh of the ground is coarser from afar.
const SUNK: f64 = 1.0;
/// Depths of plinths are whole multiples of this, so that like houses share them, metres.
const COURSE: f64 = 0.25;
/// How far a platform, a veranda or a roof post may stand out from the walls, metres.
const BESIDE: f64 = 2.0;
/// Half the side of a house of which only the centre is known, metres.
const AROUND: f64 = 12.0;

/// What the ground knows of the place of a house.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Footing {
    /// Its height, or the town has no ground.
    #[default]
    Known,
    /// Only heights round it.
    Near,
    /// Nothing.
    Lost,
}

impl LotSite<'_> {
    /// Puts a house that has found its place on the ground.
    pub(super) fn put_on_ground(&self, stood: &mut Stood) {
        let Some(front) = self.decisions.borrow().last().map(|d| d.front) else {
            return;
        };
        let ring: Vec<DVec2> = match (self.lot().shape.ring(), &stood.walls) {
            (_, None) if !stood.centred => {
                let depth = stood.depth;
                Rectangle { front, depth }.corners().to_vec()
            }
            (Some(ring), _) => ring.to_vec(),
            (None, _) => vec![],
        };
        self.foot(stood, front, &ring);
    }

    /// Puts a house behind the house on the ground: the way to its front is its street.
    pub(super) fn put_rear_on_ground(
        &self,
        unit: &str,
        stood: &mut Stood,
        record: &[RearDecision],
    ) {
        let found = record.iter().rev().find(|decision| decision.unit == unit);
        if let Some(RearPlace::Stands(rectangle)) = found.map(|decision| &decision.place) {
            self.foot(stood, rectangle.front, &rectangle.corners());
        }
    }

    fn foot(&self, stood: &mut Stood, front: Segment, ring: &[DVec2]) {
        let ground = &self.plan.ground;
        if ground.is_empty() {
            return;
        }
        let (street, middle) = match front.length() > 0.1 {
            true => (
                ground.lowest([front.from, front.to]),
                front.from.midpoint(front.to),
            ),
            false => (ground.at(stood.at), stood.at),
        };
        let Some(street) = street.or_else(|| {
            self.footing.set(Footing::Near);
            ground.near(middle)
        }) else {
            self.footing.set(Footing::Lost);
            return;
        };
        stood.z = street + STEP;
        let low = self.lowest_under(stood, ring).unwrap_or(street);
        let depth = stood.z - low + SUNK;
        stood.plinth = (depth / COURSE).ceil() * COURSE;
    }

    /// Returns the lowest ground under the walls of a house and a little beside them.
    fn lowest_under(&self, stood: &Stood, ring: &[DVec2]) -> Option<f64> {
        let half = DVec2::splat(AROUND.max(stood.frontage / 2.0).max(stood.depth / 2.0));
        let (low, high) = (stood.at - half, stood.at + half);
        let square = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let ring = if ring.len() < 3 { &square } else { ring };
        let walls = sides(ring).flat_map(|side| {
            let out = side.normal() * BESIDE;
            let along = side.direction() * BESIDE;
            let beside = [side.from + out - along, side.to + out + along];
            [[side.from, side.to], beside]
        });
        walls
            .filter_map(|wall| self.plan.ground.lowest(wall))
            .reduce(f64::min)
    }
}
