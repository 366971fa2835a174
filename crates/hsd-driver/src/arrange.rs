//! Places variants in rows from left to right as seen from the front, in an area about as deep as wide. The houses of one
//! variant keep their places relative to each other.

use glam::{DVec2, dvec2};
use hsd_base::geometry::Heading;
use hsd_ir::building::{Building, Built, Roof};

/// Free room between neighbours, metres.
const APART: f64 = 1.5;

/// Free room between rows, as for a street, metres.
const STREET: f64 = 8.0;

/// Moves the houses of all variants to their places. Others stay.
pub(super) fn arrange(building: &mut Building) {
    let mut groups: Vec<Group> = vec![];
    for (k, built) in building.houses.iter().enumerate() {
        let Some(variant) = built.house.variant else {
            continue;
        };
        let found = bounds(built);
        match groups.last_mut().filter(|g| g.variant == variant.number) {
            Some(group) => group.add(k, found),
            None => groups.push(Group::new(variant.number, k, found)),
        }
    }
    let places = places(&groups);
    for (group, place) in groups.iter().zip(places) {
        let by = place - group.low;
        for k in &group.houses {
            let [x, y, _] = &mut building.houses[*k].house.origin;
            *x += by.x;
            *y += by.y;
        }
    }
}

/// The houses of a variant and the ground they cover, metres.
struct Group {
    variant: u32,
    houses: Vec<usize>,
    low: DVec2,
    high: DVec2,
}

impl Group {
    fn new(variant: u32, house: usize, (low, high): (DVec2, DVec2)) -> Group {
        Group {
            variant,
            houses: vec![house],
            low,
            high,
        }
    }

    fn add(&mut self, house: usize, (low, high): (DVec2, DVec2)) {
        self.houses.push(house);
        self.low = self.low.min(low);
        self.high = self.high.max(high);
    }

    fn size(&self) -> DVec2 {
        self.high - self.low
    }
}

/// Returns the lower left corner of each group, metres.
fn places(groups: &[Group]) -> Vec<DVec2> {
    let room = |g: &Group| (g.size().x + APART) * (g.size().y + STREET);
    let area: f64 = groups.iter().map(room).sum();
    let width = area.max(0.0).sqrt();
    let (mut at, mut deepest) = (DVec2::ZERO, 0.0_f64);
    let mut places = Vec::with_capacity(groups.len());
    for group in groups {
        let size = group.size();
        if at.x > 0.0 && at.x + size.x > width {
            at = dvec2(0.0, at.y + deepest + STREET);
            deepest = 0.0;
        }
        places.push(at);
        at.x += size.x + APART;
        deepest = deepest.max(size.y);
    }
    places
}

/// Returns the ground covered by a house and its eaves, metres in the world.
fn bounds(built: &Built) -> (DVec2, DVec2) {
    let house = &built.house;
    let walls = house
        .storeys
        .iter()
        .flat_map(|s| &s.rings)
        .flat_map(|r| &r.walls);
    let plan = |p: DVec2| dvec2(-p.x, p.y) * house.unit;
    let corners = walls.flat_map(|w| [w.from, w.to]).map(plan);
    let solids = built.roofs.roofs.iter().flat_map(Roof::bodies);
    let eaves = solids.flat_map(|s| &s.points).map(|p| p.truncate());
    let turn = Heading::new(180.0 - house.azimuth).vector();
    let [x, y, _] = house.origin;
    let fold = |(low, high): (DVec2, DVec2), p: DVec2| {
        let p = turn.rotate(p) + dvec2(x, y);
        (low.min(p), high.max(p))
    };
    let (low, high) = corners.chain(eaves).fold((DVec2::MAX, DVec2::MIN), fold);
    match low.x <= high.x {
        true => (low, high),
        false => (dvec2(x, y), dvec2(x, y)),
    }
}
