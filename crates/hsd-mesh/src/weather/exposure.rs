//! The exposure of a wall in an aged house: the eaves above it, the ground below it, the sun.

use crate::weather::{Exposure, Weather, Years, luck, sun, turn_of, years_at};
use crate::{Level, Walker};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::geometry::{Heading, SHAKU};
use hsd_base::rng::Place;
use hsd_ir::ast::Era;
use hsd_ir::building::{House, HouseRoofs, Roof, Storey, Wall};
use hsd_ir::catalog::PartDef;
use hsd_ir::program::{Age, Content};

/// Height to which rain splashes from the ground, metres: 1.5 shaku.
const SPLASH: f64 = 1.5 * SHAKU;

/// Depth below an overhang's edge, in overhangs, from which rain reaches the wall, and at which it reaches it in full.
const DRY: f64 = 1.5;
const WET: f64 = 4.0;

/// Distance out of the wall within which eaves are sought, and the step of the search, metres.
const REACH: f64 = 3.0;
const STEP: f64 = 0.15;

/// The delay of a part of a later era than its house, as a share of the house's years.
const LATER: f64 = 0.5;

/// The roofs of a house as shelters, in the house frame.
#[derive(Debug, Default)]
pub(crate) struct Shelters {
    /// Sorted from the lowest.
    faces: Vec<Cover>,
}

/// A face of a roof in plan.
#[derive(Debug)]
struct Cover {
    corners: Vec<DVec3>,
    lo: DVec2,
    hi: DVec2,
    /// Height of its lowest corner, metres: its edge hangs there, which is all that matters.
    low: f64,
}

impl Shelters {
    /// Collects the shelters of the roofs of a house.
    pub(crate) fn of(roofs: &HouseRoofs) -> Shelters {
        let solids = roofs.roofs.iter().flat_map(Roof::bodies);
        let faces = solids.flat_map(|s| {
            let corners = |f: &hsd_ir::building::Face| -> Vec<DVec3> {
                let points = f.corners.iter();
                points
                    .filter_map(|i| s.points.get(*i as usize))
                    .copied()
                    .collect()
            };
            s.faces.iter().map(corners)
        });
        let covers = faces.map(|corners| {
            let flat = || corners.iter().map(|p| p.truncate());
            let lo = flat().fold(DVec2::INFINITY, DVec2::min);
            let hi = flat().fold(DVec2::NEG_INFINITY, DVec2::max);
            let low = corners.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
            Cover {
                corners,
                lo,
                hi,
                low,
            }
        });
        // What stands upright covers nothing.
        let covers = covers.filter(|c| (c.hi - c.lo).min_element() > 1e-3);
        let mut faces: Vec<Cover> = covers.collect();
        faces.sort_by(|a, b| a.low.total_cmp(&b.low));
        Shelters { faces }
    }

    /// Returns the overhang of the eaves over a place in a direction, and the height of their edge; `None` if there are
    /// none, or if rain reaches the whole wall up to `top` below them.
    fn eaves(&self, foot: DVec3, top: f64, out: DVec2) -> Option<(f64, f64)> {
        let first = self.faces.partition_point(|f| f.low <= foot.z);
        let last = self.faces.partition_point(|f| f.low < top + WET * REACH);
        let above = self.faces.get(first..last)?;
        let steps = (REACH / STEP) as u32;
        let mut found = None;
        for step in 1..=steps {
            let reach = f64::from(step) * STEP;
            let p = foot.truncate() + out * reach;
            match above.iter().find(|f| f.covers(p)) {
                Some(face) => found = Some((reach, face.low)),
                None => break,
            }
        }
        found
    }
}

impl Cover {
    /// Returns true if it covers a point of the plan.
    fn covers(&self, p: DVec2) -> bool {
        if p.cmplt(self.lo).any() || p.cmpgt(self.hi).any() {
            return false;
        }
        let n = self.corners.len();
        let mut inside = false;
        for i in 0..n {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % n]);
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                inside = !inside;
            }
        }
        inside
    }
}

/// An aged house.
#[derive(Debug)]
pub(crate) struct Aged {
    age: Age,
    shelters: Shelters,
    /// The rotation of the house on the compass.
    turn: DVec2,
    raised: f64,
}

/// The exposure of a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallExposure {
    age: Age,
    /// The wall's place in the keys of random draws.
    place: Place,
    sun: f64,
    /// Overhang of the eaves, and the height of their edge above the storey's floor, metres.
    eaves: Option<(f64, f64)>,
    /// Height of the storey's floor above the ground, metres.
    floor: f64,
}

impl Aged {
    /// `None` if the house has no age.
    pub(crate) fn of(house: &House, roofs: &HouseRoofs) -> Option<Aged> {
        Some(Aged {
            age: house.age?,
            shelters: Shelters::of(roofs),
            turn: Heading::new(180.0 - house.azimuth).vector(),
            raised: house.raised,
        })
    }

    fn place(&self) -> Place {
        Place::of(self.age.key)
    }

    /// Returns the exposure of a wall of a storey.
    pub(crate) fn before(&self, house: &House, storey: &Storey, wall: &Wall) -> WallExposure {
        let inward = wall.direction.perp();
        let out = dvec2(inward.x, -inward.y);
        let middle = (wall.from + wall.to) / 2.0;
        // Eaves of the storey below do not shelter this one.
        let foot = house.place(middle, storey.z0 + 0.6 * (storey.z1 - storey.z0));
        let eaves = self.shelters.eaves(foot, storey.z1, out);
        WallExposure {
            age: self.age,
            place: self
                .place()
                .at(u64::from(storey.number))
                .at(u64::from(wall.facade)),
            sun: sun(self.turn.rotate(out)),
            eaves: eaves.map(|(reach, z)| (reach, z - storey.z0)),
            floor: storey.z0 + self.raised,
        }
    }

    /// Returns the weather of the roof with this number.
    pub(crate) fn roof(&self, number: usize) -> Weather {
        let place = self.place().named("roof").at(number as u64);
        Weather::Roof {
            years: Years::new(self.age.years),
            luck: luck(place),
            turn: turn_of(self.turn),
        }
    }

    /// Returns the weather of something with this share of rain and sun.
    pub(crate) fn even(&self, name: &str, exposure: f64) -> Weather {
        Weather::even(self.age.years, exposure, luck(self.place().named(name)))
    }
}

impl WallExposure {
    /// Returns the share of rain and sun at a height above the storey's floor.
    fn exposure(&self, z: f64) -> f64 {
        if z + self.floor < SPLASH {
            return 1.0;
        }
        let rain = match self.eaves {
            Some((reach, edge)) => {
                let below = (edge - z) / reach;
                ((below - DRY) / (WET - DRY)).clamp(0.0, 1.0)
            }
            None => 1.0,
        };
        rain * self.sun
    }

    /// Returns the weather at a place, of a mesh between two heights.
    fn weather(&self, place: Place, years: f64, (foot, top): (f64, f64)) -> Weather {
        let splash = (SPLASH - self.floor - foot).clamp(0.0, 300.0);
        let high = (top - foot) * 0.55;
        let centimetres = |m: f64| (m * 100.0 + 0.5) as i16;
        let at = |share: f64| Exposure::new(self.exposure(foot + (top - foot) * share));
        Weather::Wall {
            years: Years::new(years_at(years, place)),
            luck: luck(place),
            limits: [splash, high].map(centimetres),
            zones: [Exposure::new(1.0), at(0.3), at(0.75)],
        }
    }

    /// Returns the weather of a unit between two heights; parts of a later era are younger.
    pub(crate) fn unit(&self, number: usize, part: Option<&PartDef>, z: (f64, f64)) -> Weather {
        let place = self.place.at(number as u64).at((z.0 * 1000.0) as u64);
        let steps = match part.map_or(Era::All, |p| p.era) {
            era if self.age.era == Era::All || era <= self.age.era => 0,
            era => era as i32 - self.age.era as i32,
        };
        let years = self.age.years * LATER.powi(steps);
        self.weather(place, years, z)
    }

    /// Returns the weather of posts and beams of the wall.
    pub(crate) fn frame(&self, z: (f64, f64)) -> Weather {
        self.weather(self.place.named("frame"), self.age.years, z)
    }
}

impl Walker<'_> {
    /// Returns the exposure of a wall, if the house has an age.
    pub(crate) fn air_before(&self, level: Level<'_>, wall: &Wall) -> Option<WallExposure> {
        let aged = self.aged.as_ref()?;
        Some(aged.before(level.house, level.storey, wall))
    }

    /// Returns the weather of the current wall's frame between two heights above the floor.
    pub(crate) fn frame(&self, z: (f64, f64)) -> Weather {
        self.air.map_or(Weather::None, |air| air.frame(z))
    }

    /// Returns the weather of a unit of the current wall between two heights above the floor.
    pub(crate) fn unit_weather(&self, number: usize, content: &Content, z: (f64, f64)) -> Weather {
        let Some(air) = self.air else {
            return Weather::None;
        };
        match content {
            Content::Part(id) => air.unit(number, Some(self.catalog.part(*id)), z),
            // A photograph shows the years that it was taken in.
            Content::Picture(_) => Weather::None,
            Content::Void | Content::Split(_) => air.unit(number, None, z),
        }
    }
}
