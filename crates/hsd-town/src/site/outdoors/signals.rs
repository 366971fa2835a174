//! Traffic signals (000-70). What a signal shows depends on the crossing alone: of the roads that meet there one has green, the
//! others red, and where a third crosses both, yellow (a fourth is dark), so that no two that cross show the same light.

use super::solids::{Faces, beam, case, column};
use super::{Laid, LotSite};
use crate::layer::Shape;
use crate::shape::{Segment, azimuth};
use crate::street::Piece;
use glam::{DVec2, DVec3, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::Value;
use hsd_ir::ast::street::Signal;

/// How far from its crossing a signal may stand, metres.
const FAR: f64 = 40.0;
/// Roads that pass a place nearer than this meet there, metres.
const MEETS: f64 = 1.0;
/// Roads whose directions differ by less are one, degrees.
const ONE: f64 = 30.0;
/// The length, height and depth of the case of a signal, and the width of a lamp, metres.
const CASE: [f64; 3] = [1.25, 0.45, 0.22];
const LAMP: f64 = 0.3;
/// The lamps as drivers see them, from left to right.
const LAMPS: [&str; 3] = ["lamp_green", "lamp_yellow", "lamp_red"];
/// The corners of a lamp.
const CORNERS: u32 = 10;

/// A place where roads meet.
struct Crossing {
    at: DVec2,
    /// The directions of the roads, up to their sign, each with half its width: the widest first.
    roads: Vec<(DVec2, f64)>,
}

/// A signal: its post, what it faces, how far over the road it reaches to its right as one sees it, the number of its lamp.
struct Head {
    post: DVec2,
    facing: DVec2,
    reach: f64,
    lit: usize,
}

impl Crossing {
    /// Returns the number of the road that has this direction.
    fn road(&self, way: DVec2) -> usize {
        let off = |n: &usize| between(self.roads[*n].0, way);
        let found = (0..self.roads.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
        found.unwrap_or(0)
    }

    /// Returns the lamp of a road; `turn` says which road has green.
    fn lamp(&self, road: usize, turn: usize) -> usize {
        let count = self.roads.len().max(1);
        match (road + turn) % count {
            0 => 0,
            1 => 2,
            2 => 1,
            _ => LAMPS.len(),
        }
    }
}

impl LotSite<'_> {
    /// Sets up the signals of a crossing, or one of them.
    pub(super) fn signal(&self, wish: &Signal, span: Span, draws: Place) -> Result<Laid, Text> {
        let Shape::Point(at) = self.lot().shape else {
            return Err(text!("a signal needs a point", "信号機には点が要ります"));
        };
        let streets = self.street_pieces();
        let crossing = crossing(&streets, at);
        let heads = self.heads_of(wish, (at, crossing.as_ref()), &streets, draws);
        let mut parameters: Vec<(String, Value)> = vec![];
        let told: Vec<String> = heads
            .iter()
            .map(|head| {
                let lamp = LAMPS
                    .get(head.lit)
                    .and_then(|lamp| lamp.strip_prefix("lamp_"));
                format!("{:.0} {}", azimuth(head.facing), lamp.unwrap_or("dark"))
            })
            .collect();
        parameters.push(("lamps".to_owned(), Value::Text(told.join(", "))));
        let sheets = self.heads(&heads, wish.height);
        Ok(Laid::new(
            vec![self.open(span, "signal", sheets, vec![])],
            parameters,
        ))
    }

    /// Returns the number of the road that has green.
    fn turn(&self, crossing: &Crossing) -> usize {
        let [x, y] = [crossing.at.x, crossing.at.y].map(|v| (v * 2.0).round() as i64);
        let root = Place::seed(self.seed()).named("signal");
        let share = root.at(x.cast_unsigned()).at(y.cast_unsigned()).share();
        (share * crossing.roads.len() as f64) as usize
    }

    /// Returns the signals at a place: one, or those of all roads that come into its crossing.
    fn heads_of(
        &self,
        wish: &Signal,
        (at, crossing): (DVec2, Option<&Crossing>),
        streets: &[Piece],
        draws: Place,
    ) -> Vec<Head> {
        match (wish.facing, crossing) {
            (Some(degrees), crossing) => {
                let angle = degrees.to_radians();
                let facing = dvec2(libm::sin(angle), libm::cos(angle));
                let lit = crossing
                    .as_ref()
                    .map_or(0, |c| c.lamp(c.road(facing), self.turn(c)));
                vec![Head {
                    post: at,
                    facing,
                    reach: 0.0,
                    lit,
                }]
            }
            (None, Some(crossing)) => arms(streets, crossing)
                .into_iter()
                .map(|(out, half)| {
                    // Beyond the crossing, on the left of those who come from there.
                    let beyond = crossing
                        .roads
                        .iter()
                        .map(|(_, half)| *half)
                        .fold(0.0, f64::max);
                    Head {
                        post: crossing.at - out * (beyond + 1.0) + out.perp() * -(half + 0.3),
                        facing: out,
                        reach: half.min(3.5),
                        lit: crossing.lamp(crossing.road(out), self.turn(crossing)),
                    }
                })
                .collect(),
            (None, None) => {
                let share = draws.named("turn").share() * std::f64::consts::TAU;
                let facing = dvec2(libm::cos(share), libm::sin(share));
                let facing = match nearest_way(streets, at) {
                    Some(way) => way,
                    None => facing,
                };
                vec![Head {
                    post: at,
                    facing,
                    reach: 0.0,
                    lit: 0,
                }]
            }
        }
    }

    /// Builds signals with lamps at this height.
    fn heads(&self, heads: &[Head], height: f64) -> Vec<hsd_ir::ast::Sheet> {
        let base = self.base();
        let [mut posts, mut cases]: [Faces; 2] = Default::default();
        let mut lamps: [Faces; 4] = Default::default();
        for head in heads {
            let foot = (head.post - base).extend(self.height(head.post));
            posts.extend(column(foot, height + 0.6, [0.09, 0.07], 8));
            // Seen from the front, right is this way.
            let right = head.facing.perp();
            let middle =
                head.post - base + right * (head.reach + CASE[0] / 2.0 + 0.1) + head.facing * 0.12;
            let z = foot.z + height;
            let arm = [head.post - base, middle].map(|p| p.extend(z + CASE[1] / 2.0 + 0.05));
            posts.extend(beam(arm[0], arm[1], [0.07, 0.07]));
            let half = [CASE[0] / 2.0, CASE[2] / 2.0];
            let level = [z - CASE[1] / 2.0, z + CASE[1] / 2.0];
            cases.extend(case(middle, right, half, level));
            for n in 0..3 {
                // Green is on the left of those who see it.
                let off = right * ((n as f64 - 1.0) * CASE[0] / 3.0);
                let at = (middle + off + head.facing * (CASE[2] / 2.0 + 0.012)).extend(z);
                let disc = disc(at, right);
                lamps[if n == head.lit { n } else { 3 }].push(disc);
            }
        }
        let mut sheets = vec![
            self.sheet("sheet", 1, posts),
            self.sheet("aluminium", 1, cases),
        ];
        let surfaces = LAMPS.into_iter().chain(["groove"]);
        for (surface, faces) in surfaces.zip(lamps).filter(|(_, faces)| !faces.is_empty()) {
            sheets.push(self.sheet(surface, 1, faces));
        }
        sheets
    }
}

/// Returns an upright disc whose right side, as one sees it, is this way.
fn disc(middle: DVec3, right: DVec2) -> Vec<DVec3> {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(CORNERS);
        let (x, z) = (libm::cos(angle) * LAMP / 2.0, libm::sin(angle) * LAMP / 2.0);
        middle + (right * x).extend(z)
    };
    (0..CORNERS).map(corner).collect()
}

/// Returns the angle between two directions up to their sign, degrees.
fn between(one: DVec2, two: DVec2) -> f64 {
    libm::atan2(one.perp_dot(two).abs(), one.dot(two).abs()).to_degrees()
}

/// Returns the direction of the nearest street.
pub(super) fn nearest_way(streets: &[Piece], at: DVec2) -> Option<DVec2> {
    let off = |piece: &&Piece| piece.line.nearest(at).distance(at);
    let nearest = streets.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map(|piece| piece.line.direction())
}

/// Returns the nearest place where streets meet whose directions differ.
fn crossing(streets: &[Piece], at: DVec2) -> Option<Crossing> {
    let ends = streets
        .iter()
        .filter(|piece| piece.half > 0.0)
        .flat_map(|piece| [piece.line.from, piece.line.to]);
    let mut ends: Vec<DVec2> = ends.filter(|end| end.distance(at) <= FAR).collect();
    let key = |p: &DVec2| (p.distance(at), p.x, p.y);
    ends.sort_by(|a, b| {
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    ends.dedup_by(|a, b| a.distance(*b) < 0.01);
    ends.into_iter().find_map(|place| {
        let roads = roads_at(streets, place);
        (roads.len() > 1).then_some(Crossing { at: place, roads })
    })
}

/// Returns the roads that meet at a place: their directions and half widths, the widest first.
fn roads_at(streets: &[Piece], place: DVec2) -> Vec<(DVec2, f64)> {
    let mut passing: Vec<&Piece> = streets
        .iter()
        .filter(|piece| piece.half > 0.0 && piece.line.nearest(place).distance(place) < MEETS)
        .collect();
    // Nothing depends on the order of the map.
    let key = |piece: &Piece| {
        let Segment { from, to } = piece.line;
        [-piece.half, from.x, from.y, to.x, to.y]
    };
    passing.sort_by(|a, b| {
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut roads: Vec<(DVec2, f64)> = vec![];
    for piece in passing {
        let way = piece.line.direction();
        if !roads.iter().any(|(known, _)| between(*known, way) < ONE) {
            roads.push((way, piece.half));
        }
    }
    roads
}

/// Returns the directions in which roads leave a crossing, with half their widths.
fn arms(streets: &[Piece], crossing: &Crossing) -> Vec<(DVec2, f64)> {
    let mut found: Vec<(DVec2, f64)> = vec![];
    let mut leave = |way: DVec2, half: f64| {
        let is_known = found
            .iter()
            .any(|(known, _)| known.dot(way) > libm::cos(ONE.to_radians()));
        if !is_known {
            found.push((way, half));
        }
    };
    for piece in streets.iter().filter(|piece| piece.half > 0.0) {
        let Segment { from, to } = piece.line;
        if piece.line.nearest(crossing.at).distance(crossing.at) >= MEETS {
            continue;
        }
        // One that begins there leads to its other end, one that passes leads both ways.
        let far = |end: DVec2| end.distance(crossing.at);
        let (near, other) = if far(from) < far(to) {
            (from, to)
        } else {
            (to, from)
        };
        for end in [Some(other), (far(near) > 2.0 * MEETS).then_some(near)]
            .into_iter()
            .flatten()
        {
            leave((end - crossing.at).normalize_or(DVec2::Y), piece.half);
        }
    }
    let key = |(way, _): &(DVec2, f64)| azimuth(*way);
    found.sort_by(|a, b| key(a).total_cmp(&key(b)));
    found
}
