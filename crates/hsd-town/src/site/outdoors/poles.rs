//! Poles and wires: at points and along lines, and networks along streets that reach every house beside them (000-73). The poles
//! of all networks are known before the first is made, so that each house is served from the nearest one, whatever street that
//! belongs to.

use super::solids::{Faces, beam, column, ribbon};
use super::{Laid, LotSite, Walls, lines, told};
use crate::layer::Shape;
use crate::plan::{LotId, SERVED};
use crate::shape::{distance, sides};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::grid::bounds;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::Sheet;
use hsd_ir::ast::street::{PoleMade, Poles, WireLine, Wires};
use std::f64::consts::TAU;

/// The most poles along the lines of a feature: the wires of each take 25 kB.
pub(super) const MOST: f64 = 5_000.0;
/// Half the width of a pole at its foot and top, metres.
const RADIUS: [f64; 2] = [0.16, 0.10];
/// How far the middle of a pole stands outside the side of a street, metres.
const BESIDE: f64 = 0.25;
/// How far it stands from walls, metres.
const CLEAR: f64 = 0.2;
/// How far a pole between houses is put aside to find a place, metres.
const ASIDE: u32 = 14;
/// How far a pole is moved along its street to find a place, as shares of the span.
const MOVED: [f64; 7] = [0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3];
/// The length of a cross-arm and its distance from the top, metres.
const ARM: [f64; 2] = [1.5, 0.3];
/// Where a wire ends at the wall of a house, over the ground, metres.
const EAVES: f64 = 3.6;
/// How far below the other wires one to a house begins, metres.
const BELOW: f64 = 0.8;
/// Wires are at least so thick that one sees them, metres: near, and from afar.
const THICK: [f64; 2] = [0.022, 0.05];
/// The pieces of a wire: near, and from afar.
const PIECES: [u32; 2] = [8, 4];
/// Poles of other streets no farther than this many spans are joined to the ends of a street's.
const JOINS: f64 = 1.5;

/// The poles and wires of a feature under construction.
struct Line<'w> {
    wish: &'w Poles,
    poles: Vec<DVec3>,
    /// Spans from the top of a pole to that of another.
    spans: Vec<[DVec3; 2]>,
    /// Wires to houses.
    services: Vec<[DVec3; 2]>,
}

impl LotSite<'_> {
    /// Sets up poles.
    pub(super) fn poles(&self, wish: &Poles, span: Span) -> Result<Laid, Text> {
        let mut line = Line {
            wish,
            poles: vec![],
            spans: vec![],
            services: vec![],
        };
        let mut parameters = vec![];
        match (&self.lot().shape, wish.reach) {
            (Shape::Point(at), None) => line.poles.push(self.stands(*at)),
            (Shape::Lines(_), None) => {
                for way in self.ways() {
                    let course = lines::Course::new(&way);
                    let (length, from) = (course.length(), line.poles.len());
                    let count = (length / wish.spacing).round().max(1.0);
                    let place = |n: usize| course.at(n as f64 * length / count).0;
                    let feet = (0..=count as usize).map(|n| self.stands(place(n)));
                    line.poles.extend(feet);
                    line.join_from(from);
                }
            }
            (Shape::Lines(_), Some(reach)) => {
                let (served, branches) = self.network(&mut line, reach);
                parameters.push(told("houses", f64::from(served)));
                if branches > 0 {
                    parameters.push(told("between", f64::from(branches)));
                }
            }
            (Shape::Area(..), _) | (Shape::Point(_), Some(_)) => {}
        }
        if line.poles.is_empty() {
            return Err(match wish.reach {
                Some(_) => text!(
                    "no pole of a network has a place here: it needs the line of a street with room beside it",
                    "電柱を立てる場所がありません。通りの線と、その脇の余地が要ります"
                ),
                None => text!("poles need a point or a line", "柱には点か線が要ります"),
            });
        }
        parameters.insert(0, told("poles", line.poles.len() as f64));
        let sheets = self.erect(&line);
        Ok(Laid::new(
            vec![self.open(
                span,
                if wish.reach.is_some() {
                    "network"
                } else {
                    "pole"
                },
                sheets,
                vec![],
            )],
            parameters,
        ))
    }

    /// Hangs wires along the lines of the feature.
    pub(super) fn wires(&self, wish: &WireLine, span: Span) -> Result<Laid, Text> {
        let ways = self.ways();
        let base = self.base();
        let top = |p: &DVec2| (*p - base).extend(self.height(*p) + wish.height);
        let mut spans = vec![];
        for way in &ways {
            let tops: Vec<DVec3> = way.iter().map(top).collect();
            spans.extend(tops.windows(2).map(|ends| [ends[0], ends[1]]));
        }
        if spans.is_empty() {
            return Err(text!("wires need a line", "電線には線が要ります"));
        }
        let sheets = self.hung(&spans, wish.wires);
        Ok(Laid::new(
            vec![self.open(span, "wire", sheets, vec![])],
            vec![told("spans", spans.len() as f64)],
        ))
    }

    /// Returns the places of the poles of a network along the lines of the feature, line by line.
    pub fn pole_places(&self, wish: &Poles) -> Vec<Vec<DVec2>> {
        let ways = self.ways();
        let half = self.usual_width(&ways) / 2.0;
        let others = self.other_streets(&ways, f64::MIN_POSITIVE);
        let walls = self.walls();
        let is_free = |at: DVec2| !others.reach(at, RADIUS[0]) && !walls.near(at, CLEAR);
        let place = |way: &Vec<DVec2>| {
            let course = lines::Course::new(way);
            let length = course.length();
            let count = (length / wish.spacing).round().max(1.0);
            let station = |n: usize| (n as f64 + 0.5) * length / count;
            let poles = (0..count as usize).filter_map(|n| {
                // On the left side where it has room, else on the right; where walls stand on both, inside the kerb.
                let sides = [half + BESIDE, -half - BESIDE, half - BESIDE, BESIDE - half];
                let tries = sides
                    .iter()
                    .flat_map(|off| MOVED.iter().map(move |moved| (*off, *moved)));
                let mut places = tries.map(|(off, moved)| {
                    let at = station(n) + moved * length / count;
                    let (middle, along) = course.at(at.clamp(0.0, length));
                    middle + along.perp() * off
                });
                places.find(|at| is_free(*at))
            });
            poles.collect()
        };
        ways.iter().map(place).collect()
    }

    /// Places the poles of the network, joins them, and leads wires to the houses to which they are nearest. Returns the number
    /// of houses, and that of the poles between them.
    fn network(&self, line: &mut Line<'_>, reach: f64) -> (u32, u32) {
        for places in self.pole_places(line.wish) {
            let from = line.poles.len();
            line.poles.extend(places.iter().map(|at| self.stands(*at)));
            line.join_from(from);
            let inner = |n: usize| places.get(n).copied();
            let last = places.len().saturating_sub(1);
            let ends = [
                (inner(0), inner(1)),
                (inner(last), inner(last.wrapping_sub(1))),
            ];
            for (end, next) in &ends[..places.len().min(2)] {
                let Some(end) = *end else { continue };
                let other = self.other_street((end, *next), JOINS * line.wish.spacing);
                line.spans
                    .extend(other.map(|other| [end, other].map(|at| line.top(self.stands(at)))));
            }
        }
        let own: Vec<DVec3> = line.poles.clone();
        let farthest = line.wish.spacing.max(reach);
        let (mut served, mut between) = (0, 0);
        let around = self.plan.served(self.id);
        let ring = |id: LotId| self.plan.lot(id).shape.ring();
        let walls = Walls::new(around.iter().filter_map(|id| ring(*id)));
        for id in around {
            let ring = ring(id).unwrap_or_default();
            let Some((pole, wall)) = self.served_from(ring) else {
                continue;
            };
            if !own.contains(&self.stands(pole)) {
                continue;
            }
            served += 1;
            let more = (wall.distance(pole) / reach).ceil() - 1.0;
            let mut last = pole;
            for n in 1..=more.max(0.0) as usize {
                let at = pole.lerp(wall, n as f64 / (more + 1.0));
                let is_last = n as f64 == more;
                let fits = |at: DVec2| {
                    let reaches = !is_last || distance(ring, at) <= reach;
                    reaches && at.distance(last) <= farthest && self.is_beside_streets(at)
                };
                let at = beside(&walls, at, fits);
                line.poles.push(self.stands(at));
                line.spans
                    .push([last, at].map(|at| line.top(self.stands(at))));
                last = at;
                between += 1;
            }
            let from = line.top(self.stands(last)) - DVec3::Z * BELOW;
            line.services
                .push([from, self.stands(wall) + DVec3::Z * EAVES]);
        }
        (served, between)
    }

    /// Returns true if a pole at a place stands in no street.
    fn is_beside_streets(&self, at: DVec2) -> bool {
        let mut streets = self.street_pieces().into_iter();
        !streets.any(|piece| piece.line.nearest(at).distance(at) < piece.half + RADIUS[0])
    }

    /// Returns the pole of another street to which wires go on from the end of one, away from its `next` pole; of two ends one
    /// leads to the other.
    fn other_street(&self, (end, next): (DVec2, Option<DVec2>), far: f64) -> Option<DVec2> {
        let known = &self.plan.laid.poles;
        let own = known.at(end)?;
        let other = known.next_line(own, far)?;
        if next.is_some_and(|next| (end - next).dot(other.at - end) < 0.0) {
            return None;
        }
        let comes_back = other.is_end && known.next_line(other, far) == Some(own);
        let first = (own.at.x, own.at.y) < (other.at.x, other.at.y);
        (first || !comes_back).then_some(other.at)
    }

    /// Returns the pole from which a house is served, the nearest one, and the place of its wall that the wire goes to.
    fn served_from(&self, ring: &[DVec2]) -> Option<(DVec2, DVec2)> {
        let house = bounds(ring.iter().copied())?;
        let off = |at: DVec2| distance(ring, at);
        let poles = self.plan.laid.poles.near(house, SERVED).map(|pole| pole.at);
        let pole = poles.min_by(|p, q| off(*p).total_cmp(&off(*q)))?;
        let wall = sides(ring).map(|side| side.nearest(pole));
        let wall = wall.min_by(|p, q| p.distance(pole).total_cmp(&q.distance(pole)))?;
        (wall.distance(pole) <= SERVED).then_some((pole, wall))
    }

    /// Returns the place of a pole's foot, from the place of the house.
    fn stands(&self, at: DVec2) -> DVec3 {
        (at - self.base()).extend(self.height(at))
    }

    /// Builds poles and wires.
    fn erect(&self, line: &Line<'_>) -> Vec<Sheet> {
        let wish = line.wish;
        let made = match wish.made {
            PoleMade::Concrete => "concrete",
            PoleMade::Wood => "cedar_dark",
        };
        let [mut far, mut near, mut arms]: [Faces; 3] = Default::default();
        for (foot, n) in line.poles.iter().zip(0..) {
            far.extend(column(*foot, wish.height, RADIUS, 4));
            near.extend(column(*foot, wish.height, RADIUS, 8));
            if wish.wires.count > 1 {
                let top = line.top(*foot);
                let across = line.across(n).extend(0.0) * (ARM[0] / 2.0);
                arms.extend(beam(top - across, top + across, [0.09, 0.09]));
            }
        }
        let mut sheets = vec![
            self.sheet(made, 0, far).until(1),
            self.sheet(made, 2, near),
            self.sheet("sheet", 2, arms),
        ];
        sheets.extend(self.hung(&line.spans, wish.wires));
        let single = Wires {
            count: 1,
            ..wish.wires
        };
        sheets.extend(self.hung(&line.services, single));
        sheets.retain(|sheet| !sheet.faces.is_empty());
        sheets
    }

    /// Hangs wires between places, side by side on arms.
    fn hung(&self, spans: &[[DVec3; 2]], wires: Wires) -> Vec<Sheet> {
        let hang = |pieces: u32, thick: f64, count: u32| -> Faces {
            let one = |[from, to]: &[DVec3; 2]| {
                let (from, to) = (*from, *to);
                let across = (to - from).truncate().perp().normalize_or(dvec2(1.0, 0.0));
                (0..count).flat_map(move |n| {
                    let share = (f64::from(n) + 0.5) / f64::from(count) - 0.5;
                    let off = across.extend(0.0) * (share * ARM[0]);
                    let sag = wires.sag * from.distance(to);
                    let places: Vec<DVec3> = (0..=pieces)
                        .map(|k| {
                            let t = f64::from(k) / f64::from(pieces);
                            from.lerp(to, t) + off - DVec3::Z * (4.0 * sag * t * (1.0 - t))
                        })
                        .collect();
                    ribbon(&places, thick)
                })
            };
            spans.iter().flat_map(one).collect()
        };
        vec![
            // From afar wires are one.
            self.sheet("iron", 1, hang(PIECES[1], THICK[1], wires.count.min(1)))
                .until(1),
            self.sheet("iron", 2, hang(PIECES[0], THICK[0], wires.count)),
        ]
    }
}

/// Returns the place nearest to another that fits and is clear of walls; that itself if there is none.
fn beside(walls: &Walls<'_>, at: DVec2, fits: impl Fn(DVec2) -> bool) -> DVec2 {
    let round = (0..=ASIDE).flat_map(|ring| {
        let count = (8 * ring).max(1);
        (0..count).map(move |n| {
            let angle = TAU * f64::from(n) / f64::from(count);
            at + dvec2(libm::cos(angle), libm::sin(angle)) * f64::from(ring)
        })
    });
    let mut free = round.filter(|at| !walls.near(*at, CLEAR) && fits(*at));
    free.next().unwrap_or(at)
}

impl Line<'_> {
    /// Joins the poles from this number on, each to the next.
    fn join_from(&mut self, from: usize) {
        let tops: Vec<DVec3> = self.poles[from..].iter().map(|p| self.top(*p)).collect();
        self.spans
            .extend(tops.windows(2).map(|ends| [ends[0], ends[1]]));
    }

    /// Returns where wires hang on a pole.
    fn top(&self, foot: DVec3) -> DVec3 {
        foot + DVec3::Z * (self.wish.height - ARM[1])
    }

    /// Returns the direction of the arm of a pole: across the wires that hang on it.
    fn across(&self, n: usize) -> DVec2 {
        let top = self.top(self.poles[n]);
        let ends = |[p, q]: &[DVec3; 2]| match (p.distance(top) < 0.01, q.distance(top) < 0.01) {
            (true, _) => Some((*q - *p).truncate()),
            (_, true) => Some((*q - *p).truncate()),
            _ => None,
        };
        let along = self.spans.iter().find_map(ends).unwrap_or(DVec2::Y);
        along.perp().normalize_or(DVec2::X)
    }
}
