//! `Rear`: what stands behind the house of a lot (000-62, 000-63). The rear belongs to the owner, with court, storehouse and
//! dwelling by the depth of the lot (`court`), or is let, with rows of dwellings along an alley (`alley`). Both ask the ground
//! that is left (`ground`) for places: nothing leaves the lot, meets a house, or stands in an alley.

mod alley;
mod court;
mod ground;

use super::plot::{Rectangle, tenths};
use super::shape::azimuth;
use glam::DVec2;
use ground::Ground;
use hsd_base::diagnostic::Text;
use hsd_base::rng::Place;
use hsd_base::text;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{RearHouse, Stood};

/// The length of a ken of Edo, metres.
const KEN: f64 = 6.0 * hsd_base::geometry::SHAKU;
/// The least court between houses of a lot: 1.5 ken (docs/evidence.md 4.7).
const COURT: f64 = 1.5 * KEN;

/// A house that has found its place.
struct Planned {
    unit: String,
    kind: &'static str,
    parameters: Vec<(&'static str, Value)>,
    rectangle: Rectangle,
}

/// What became of a house behind a house.
#[derive(Clone, Debug)]
pub enum RearPlace {
    /// It stands on a rectangle.
    Stands(Rectangle),
    /// It has no room: the reason.
    NoRoom(Text),
    /// No house on the front of the lot leaves a rear.
    NoHouse,
}

/// What was decided about a house behind a house.
#[derive(Clone, Debug)]
pub struct RearDecision {
    /// What it is.
    pub unit: String,
    /// What became of it.
    pub place: RearPlace,
}

/// The houses behind a house, and the reasons of those that have no place.
#[derive(Default)]
struct Found {
    planned: Vec<Planned>,
    refused: Vec<(&'static str, Text)>,
}

impl Found {
    fn refuse(&mut self, unit: &'static str, why: Text) {
        self.refused.push((unit, why));
    }
}

/// A lot and what stands round it.
pub struct RearLot<'l> {
    /// Its ring.
    pub ring: &'l [DVec2],
    /// Its holes.
    pub holes: &'l [Vec<DVec2>],
    /// The outlines round it.
    pub others: &'l [&'l [DVec2]],
    /// The height of its ground, metres.
    pub z: f64,
}

/// Finds the houses behind the houses on the front of a lot, and records them. `density` and its draws are those of a `Rear`;
/// what is recorded already stands on the lot.
pub fn rear(
    lot: RearLot<'_>,
    houses: &[Rectangle],
    (density, draws): (f64, Place),
    record: &mut Vec<RearDecision>,
) -> Vec<RearHouse> {
    let note = |unit: &str, place| RearDecision {
        unit: unit.to_owned(),
        place,
    };
    if houses.is_empty() || lot.ring.len() < 3 {
        record.push(note("rear", RearPlace::NoHouse));
        return vec![];
    }
    let before = record.iter().filter_map(|d| match &d.place {
        RearPlace::Stands(rectangle) => Some(*rectangle),
        RearPlace::NoRoom(_) | RearPlace::NoHouse => None,
    });
    let before: Vec<Rectangle> = before.collect();
    let mut ground = Ground::new((lot.ring, lot.holes), lot.others, houses, &before);
    let mut found = Found::default();
    if density > 0.0 {
        alley::rows(&mut ground, density, draws, &mut found);
    }
    if found.planned.is_empty() {
        court::court(&mut ground, draws, &mut found);
    }
    for (unit, why) in found.refused {
        record.push(note(unit, RearPlace::NoRoom(why)));
    }
    let mut made = vec![];
    for mut planned in found.planned {
        planned.unit = unused(&planned.unit, record);
        record.push(note(&planned.unit, RearPlace::Stands(planned.rectangle)));
        made.push(planned.house(lot.z));
    }
    made
}

/// Returns a name that no house of the lot has yet.
fn unused(unit: &str, record: &[RearDecision]) -> String {
    let is_free = |name: &String| record.iter().all(|d| d.unit != *name);
    let numbered = (2..).map(|n| format!("{unit}-{n}"));
    let mut names = std::iter::once(unit.to_owned()).chain(numbered);
    names.find(is_free).unwrap_or_default()
}

impl Planned {
    fn house(self, z: f64) -> RearHouse {
        let front = self.rectangle.front;
        RearHouse {
            unit: self.unit,
            kind: self.kind,
            parameters: self.parameters,
            stood: Stood {
                at: front.to,
                z,
                plinth: 0.0,
                azimuth: azimuth(front.normal()),
                frontage: front.length(),
                depth: self.rectangle.depth,
                centred: false,
                walls: None,
            },
        }
    }
}

/// Returns the reason of a lot that is too shallow for anything but a court.
fn shallow(depth: f64) -> Text {
    let depth = tenths(depth);
    text!([depth]
        "the lot is {depth} m deep: under 12 m a court stays open",
        "敷地の奥行は {depth} m です。12 m 未満は庭だけになります"
    )
}
