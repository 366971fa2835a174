//! The zones that the rules of a town make, by place: the smallest one that a place lies in counts.

use crate::shape::{area, contains};
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, bounds};
use hsd_ir::ast::law::{DistrictPlan, Zone};
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// A zone.
#[derive(Clone, Debug)]
pub struct ZoneArea {
    /// Its outline.
    pub ring: Vec<DVec2>,
    /// What lies outside in it.
    pub holes: Vec<Vec<DVec2>>,
    /// Its terms.
    pub terms: Zone,
}

/// All zones of a town.
#[derive(Debug, Default)]
pub struct Zones {
    all: Vec<ZoneArea>,
    index: Grid,
}

impl Zones {
    /// Collects zones.
    pub fn new(all: Vec<ZoneArea>) -> Zones {
        let boxes = all.iter().map(|zone| bounds(zone.ring.iter().copied()));
        Zones {
            index: Grid::new(boxes.map(Option::unwrap_or_default).collect()),
            all,
        }
    }

    /// Returns the terms of the smallest zone that a place lies in; of equal ones, of the first.
    pub fn at(&self, p: DVec2) -> Option<&Zone> {
        let near = self.index.near([p, p]).into_iter();
        let near = near.map(|n| &self.all[n as usize]);
        let holds = |zone: &&ZoneArea| {
            contains(&zone.ring, p) && !zone.holes.iter().any(|hole| contains(hole, p))
        };
        let size = |zone: &ZoneArea| area(&zone.ring, &zone.holes);
        let least = near
            .filter(holds)
            .reduce(|best, next| match size(next) < size(best) {
                true => next,
                false => best,
            });
        least.map(|zone| &zone.terms)
    }

    /// Appends the zones that meet a box to bytes.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let near = self.index.near(bounds);
        out.count(near.len());
        for zone in near.iter().map(|n| &self.all[*n as usize]) {
            out.points(&zone.ring);
            out.count(zone.holes.len());
            zone.holes.iter().for_each(|hole| out.points(hole));
            let terms = &zone.terms;
            for number in numbers(&mut terms.clone()) {
                out.float(number.unwrap_or(f64::NAN));
            }
            let plan = terms
                .plan
                .map_or(0, |plan| 1 + u8::from(plan == DistrictPlan::Guided));
            let by_ratio = terms.by_ratio.map_or(0, |by| 1 + u8::from(by));
            out.bytes(&[plan, by_ratio]);
        }
    }

    /// Takes zones from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Zones> {
        let all = (0..from.count()?).map(|_| {
            let ring = from.points()?;
            let holes = (0..from.count()?).map(|_| from.points());
            let holes = holes.collect::<io::Result<Vec<Vec<DVec2>>>>()?;
            let mut terms = Zone::default();
            for number in numbers(&mut terms) {
                *number = Some(from.float()?).filter(|n| !n.is_nan());
            }
            let [plan, by_ratio] = from.array()?;
            terms.plan = match plan {
                0 => None,
                1 => Some(DistrictPlan::Present),
                _ => Some(DistrictPlan::Guided),
            };
            terms.by_ratio = (by_ratio > 0).then_some(by_ratio > 1);
            Ok(ZoneArea { ring, holes, terms })
        });
        Ok(Zones::new(all.collect::<io::Result<Vec<ZoneArea>>>()?))
    }
}

/// Returns the numbers of terms in a fixed order.
fn numbers(terms: &mut Zone) -> [&mut Option<f64>; 10] {
    [
        &mut terms.gradient,
        &mut terms.distance,
        &mut terms.ratio,
        &mut terms.factor,
        &mut terms.limit,
        &mut terms.setback,
        &mut terms.side_height,
        &mut terms.side_gradient,
        &mut terms.storey,
        &mut terms.coverage,
    ]
}
