//! What building law lets stand on a lot (docs/contract.md 10.5): the solid under the slant line of each road in front of it, those
//! of adjacent land, and a greatest height (002-28 to 002-32). It is a study of shapes and no legal opinion.

mod faces;
mod fronts;
mod row;
mod rules;

pub use faces::{Facet, Ground};
pub use fronts::{Front, fronts};
pub use row::{EnvelopeFace, EnvelopeRow};
pub use rules::{Plot, Rule, rules};

use crate::shape::{area, sides};
use glam::DVec2;
use hsd_base::geometry::envelope::{self, Cell, Limit};
use hsd_ir::ast::law::{DistrictPlan, Terms};

/// The width of a road from which it no longer limits the ratio of floor area, metres (Building Standards Act art. 52 (2)).
const WIDE: f64 = 12.0;

/// The solid that the law lets stand on a lot. Places are metres in the frame of the town, heights metres over the lot.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// The parts of the ground with the number of the rule that binds there; metres from [`Envelope::at`].
    pub cells: Vec<Cell>,
    /// The planes of the rules.
    pub limits: Vec<Limit>,
    /// The rules, each with the limit of the same number.
    pub rules: Vec<Rule>,
    /// The place from which its cells and limits count.
    pub at: DVec2,
    /// The area of the lot, square metres.
    pub lot_area: f64,
    /// The width of the widest road in front, metres; `None` if there is none.
    pub road_width: Option<f64>,
    /// The number of roads in front.
    pub roads: usize,
    /// The greatest ratio of floor area to the area of the lot; `None` if nothing limits it.
    pub ratio: Option<f64>,
    /// The terms.
    pub terms: Terms,
}

/// Finds the envelope of a lot with these roads in front under some terms.
pub fn envelope(ring: &[DVec2], holes: &[Vec<DVec2>], fronts: &[Front], terms: &Terms) -> Envelope {
    // Near 0 0 numbers have their full precision.
    let at = ring.first().copied().unwrap_or_default();
    let near = |ring: &[DVec2]| ring.iter().map(|p| *p - at).collect::<Vec<DVec2>>();
    let (ring, fronts) = (near(ring), fronts.iter().map(|front| front.moved(-at)));
    let (mut holes, fronts) = (
        holes.iter().map(|hole| near(hole)).collect::<Vec<_>>(),
        fronts.collect::<Vec<Front>>(),
    );
    for hole in &mut holes {
        if hsd_base::geometry::area2(hole) > 0.0 {
            hole.reverse();
        }
    }
    let widths = fronts.iter().map(|front| front.width);
    let road_width = widths.reduce(f64::max);
    let ratio = ratio(terms, road_width);
    let plot = Plot {
        ring: &ring,
        fronts: &fronts,
        ratio,
    };
    let (rules, limits): (Vec<Rule>, Vec<Limit>) = rules(&plot, terms).into_iter().unzip();
    let mut pieces = envelope::pieces(&ring, &holes);
    if terms.setback > 0.0 {
        for strip in rules::strips(&plot, terms.setback) {
            pieces = envelope::without(pieces, &strip);
        }
    }
    Envelope {
        cells: envelope::cells(pieces, &limits),
        limits,
        rules,
        at,
        lot_area: area(&ring, &holes),
        road_width,
        roads: fronts.len(),
        ratio,
        terms: *terms,
    }
}

/// Returns the greatest ratio of floor area: the designated one, or that of the road where it is narrow and no plan relaxes that.
fn ratio(terms: &Terms, road_width: Option<f64>) -> Option<f64> {
    let by_road = road_width
        .filter(|width| *width < WIDE && terms.plan == DistrictPlan::Present)
        .map(|width| width * terms.factor);
    match (terms.ratio, by_road) {
        (Some(own), Some(road)) => Some(own.min(road)),
        (own, road) => own.or(road),
    }
}

impl Envelope {
    /// Returns its volume, cubic metres.
    pub fn volume(&self) -> f64 {
        envelope::volume(&self.cells, &self.limits)
    }

    /// Returns its greatest height, metres.
    pub fn height(&self) -> f64 {
        envelope::highest(&self.cells, &self.limits)
    }

    /// Returns the height up to which something may stand over a place of the town, metres; `None` outside.
    pub fn height_at(&self, p: DVec2) -> Option<f64> {
        const ON: f64 = 1e-6;
        let p = p - self.at;
        let holds = |cell: &&Cell| {
            sides(&cell.ring).all(|side| side.direction().perp_dot(p - side.from) >= -ON)
        };
        let cell = self.cells.iter().find(holds)?;
        Some(self.limits[cell.limit].height(p))
    }

    /// Returns the areas of the storeys that have room under it, from below, square metres: each at its ceiling, no more than the
    /// coverage of the lot, until the ratio of floor area is used up.
    pub fn floors(&self) -> Vec<f64> {
        let most = self.terms.coverage * self.lot_area;
        let mut left = self.ratio.map_or(f64::INFINITY, |r| r * self.lot_area);
        let storey = self.terms.storey;
        let mut floors = vec![];
        let high = (self.height() / storey + 1e-9).floor() as usize;
        for number in 1..=high {
            let section = envelope::section(&self.cells, &self.limits, number as f64 * storey);
            let floor = section.min(most).min(left);
            if floor <= 0.0 {
                break;
            }
            left -= floor;
            floors.push(floor);
        }
        floors
    }

    /// Returns the area of ground under each rule, with its number: the rules that bind.
    pub fn binding(&self) -> Vec<(usize, f64)> {
        let mut areas = vec![0.0; self.rules.len()];
        for cell in &self.cells {
            areas[cell.limit] += cell.area();
        }
        let of = areas.into_iter().enumerate();
        of.filter(|(_, area)| *area > 0.0).collect()
    }

    /// Returns how far a body of a height over an outline stands above it, metres; 0 if it does not. Strips in which nothing may
    /// stand do not count.
    pub fn exceeded(&self, ring: &[DVec2], built: f64) -> f64 {
        let corners = self.cells.iter().flat_map(|cell| {
            let limit = &self.limits[cell.limit];
            cell.ring
                .iter()
                .map(move |p| (*p + self.at, limit.height(*p)))
        });
        let inside =
            |p: DVec2| crate::shape::contains(ring, p) || crate::shape::distance(ring, p) < 1e-6;
        let within = corners
            .filter(|(p, _)| inside(*p))
            .map(|(_, height)| height);
        let own = ring.iter().filter_map(|p| self.height_at(*p));
        let least = own.chain(within).fold(f64::INFINITY, f64::min);
        if least.is_finite() {
            (built - least).max(0.0)
        } else {
            0.0
        }
    }
}
