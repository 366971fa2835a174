//! Outdoor objects of a town (docs/contract.md 10.4): a rule turns a feature into shapes on the ground, or a fence as runs of parts.

mod arcades;
mod bands;
mod basins;
mod cutters;
mod envelopes;
mod fences;
mod lines;
mod lone;
mod poles;
mod rails;
mod roads;
mod signals;
mod signs;
mod solids;
mod trees;

use super::law::EnvelopeRow;
use super::{Footing, LotSite};
use crate::layer::Shape;
use crate::shape::{Segment, area, contains, distance, sides};
use crate::street::Piece;
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::clip::on_grid;
use hsd_base::geometry::grid::{Bounds, Grid, bounds, meet, wider};
use hsd_base::rng::Place;
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::ast::{House, Outdoor, Outdoors, Settings, Sheet, Tree, Value};
use lines::Segments;
use std::collections::BTreeSet;

/// The place of what lies on the ground is a multiple of this, so that textures go on from piece to piece, metres.
const TURN: f64 = 1024.0;
/// The most units along the lines of a feature. With more, the triangles would exceed any limit.
const UNITS: f64 = 200_000.0;
/// The most pieces of ground under a feature, for the same reason.
const GROUND_PIECES: f64 = 1_500_000.0;
/// Ground under roads is looked at in steps of this, metres.
const STEP: f64 = 4.0;
/// The name of the layer of all streets.
const NO_LAYER: &str = "";

/// What became of a wish.
pub struct Laid {
    /// Houses in the sense of the model: pieces of road, trees, fences.
    pub houses: Vec<House>,
    /// What the table of decisions tells.
    pub parameters: Vec<(String, Value)>,
    /// What the table of envelopes tells.
    pub envelope: Option<EnvelopeRow>,
    /// True if it is to line heights up but knows none.
    pub no_guiding_height: bool,
}

impl Laid {
    /// Returns shapes with what the table of decisions tells of them.
    fn new(houses: Vec<House>, parameters: Vec<(String, Value)>) -> Laid {
        Laid {
            houses,
            parameters,
            envelope: None,
            no_guiding_height: false,
        }
    }
}

impl LotSite<'_> {
    /// Makes what a rule wants of the feature; `draws` keys what is drawn.
    ///
    /// # Errors
    /// Why nothing can be made.
    pub fn lay(&self, wish: &Outdoor, span: Span, draws: Place) -> Result<Laid, Text> {
        self.check_units(wish)?;
        match wish {
            Outdoor::Road(road) => self.road(road, span),
            Outdoor::Rail(rail) => self.rail(rail, span),
            Outdoor::Tree(tree) => self.trees(tree, span, draws),
            Outdoor::Fence(fence) => self.fence(fence, span),
            Outdoor::Lone(lone) => self.lone(lone, span),
            Outdoor::Poles(poles) => self.poles(poles, span),
            Outdoor::Wire(wire) => self.wires(wire, span),
            Outdoor::Signal(signal) => self.signal(signal, span, draws),
            Outdoor::Sign(sign) => self.sign(sign, span),
            Outdoor::Arcade(arcade) => self.arcade(arcade, span),
            Outdoor::Water(water) => self.water(water, span),
            Outdoor::Farmland(farmland) => self.farmland(farmland, span),
            Outdoor::Zone(zone) => self.zone(zone),
            Outdoor::Envelope(wish) => self.envelope(wish, span),
        }
    }

    /// Fails if more units would be made along the feature, or more pieces of ground under it, than a house may have, or if its
    /// lines meet each other too often. They are counted before the first is made.
    pub fn check_units(&self, wish: &Outdoor) -> Result<(), Text> {
        let ring = self.lot().shape.ring().unwrap_or_default();
        let around: f64 = sides(ring).map(Segment::length).sum();
        let along: f64 = self.lines().map(Segment::length).sum();
        let (units, most) = match wish {
            Outdoor::Fence(fence) => ((along + around) / fences::unit(&fence.code), UNITS),
            Outdoor::Arcade(arcade) => (along / arcade.bay, UNITS),
            Outdoor::Poles(poles) => (along / poles.spacing, poles::MOST),
            Outdoor::Rail(_) => (along / rails::SLEEPERS, rails::MOST),
            Outdoor::Road(road) if road.marks => (along / STEP, UNITS),
            _ => (0.0, UNITS),
        };
        limited(units, most)?;
        let half = match wish {
            Outdoor::Road(road) => Some(self.width(road, &self.ways()) / 2.0),
            Outdoor::Rail(rail) => Some(rail.gauge / 2.0 + rails::BALLAST),
            Outdoor::Water(water) => Some(water.width / 2.0),
            _ => None,
        };
        if let Some(half) = half {
            bands::check_meetings(&self.lines().collect::<Vec<_>>(), half)?;
        }
        let on_ground = match wish {
            Outdoor::Road(_) | Outdoor::Rail(_) | Outdoor::Water(_) | Outdoor::Farmland(_) => {
                area(ring, &[]) / (STEP * STEP) + (around + along) / STEP
            }
            _ => 0.0,
        };
        match self.has_ground() {
            true => limited(on_ground, GROUND_PIECES),
            false => Ok(()),
        }
    }

    /// Returns the seed of the town.
    pub fn seed(&self) -> u64 {
        self.plan.town.seed
    }

    /// Returns the lines of the feature, without points that repeat the one before.
    fn ways(&self) -> Vec<Vec<DVec2>> {
        let lines = match &self.lot().shape {
            Shape::Lines(lines) => lines.clone(),
            Shape::Area(..) | Shape::Point(_) => vec![],
        };
        let distinct = |mut line: Vec<DVec2>| {
            line.dedup_by(|a, b| a.distance(*b) < 0.01);
            line
        };
        let lines = lines.into_iter().map(distinct);
        lines.filter(|line| line.len() > 1).collect()
    }

    /// Returns the streets round the feature whose sides are at least so far from their lines, without its own lines.
    fn other_streets(&self, ways: &[Vec<DVec2>], least: f64) -> OtherStreets {
        let own = Segments::new(ways.iter().flat_map(|way| segments(way)));
        let others = self.street_pieces().into_iter();
        let others = others.filter(|piece| piece.half >= least && !own.contain(&piece.line));
        OtherStreets::new(others.collect())
    }

    /// Returns the pieces of streets round the feature.
    fn street_pieces(&self) -> Vec<Piece> {
        self.plan.pieces(self.lot(), NO_LAYER)
    }

    /// Returns the walls of the houses round the feature.
    fn walls(&self) -> Walls<'_> {
        Walls::new(self.neighbours().rings.iter().copied())
    }

    /// Returns the place from which shapes of the feature count.
    fn base(&self) -> DVec2 {
        (self.lot().shape.centre() / TURN).floor() * TURN
    }

    /// Returns true if the town has a ground.
    fn has_ground(&self) -> bool {
        !self.plan.ground.is_empty()
    }

    /// Returns the height of the ground at a place.
    fn height(&self, at: DVec2) -> f64 {
        let ground = &self.plan.ground;
        if ground.is_empty() {
            return self.lot().z;
        }
        if let Some(height) = ground.at(at) {
            return height;
        }
        match ground.near(at) {
            Some(height) => {
                self.footing.set(Footing::Near);
                height
            }
            None => {
                self.footing.set(Footing::Lost);
                self.lot().z
            }
        }
    }

    /// Lays convex rings on the ground, raised by a height.
    fn lie(&self, rings: &[Vec<DVec2>], raised: f64) -> Vec<Vec<DVec3>> {
        let base = self.base();
        let lay = |ring: &Vec<DVec2>| -> Vec<DVec3> {
            ring.iter()
                .map(|p| (*p - base).extend(self.height(*p) + raised))
                .collect()
        };
        if !self.has_ground() {
            return rings.iter().map(lay).collect();
        }
        let mut faces = vec![];
        for ring in rings.iter().flat_map(|ring| on_grid(ring, STEP)) {
            let laid = lay(&ring);
            // The ground is not plane.
            faces.extend((1..laid.len() - 1).map(|i| vec![laid[0], laid[i], laid[i + 1]]));
        }
        faces
    }

    /// Returns faces of a surface, shown from a level of detail on.
    fn sheet(&self, finish: &'static str, least: u8, faces: Vec<Vec<DVec3>>) -> Sheet {
        Sheet {
            finish,
            least,
            most: Sheet::MOST,
            on_ground: self.has_ground(),
            faces,
        }
    }

    /// Returns a house of shapes on the ground.
    fn open(&self, span: Span, word: &'static str, sheets: Vec<Sheet>, trees: Vec<Tree>) -> House {
        let base = self.base();
        let at = |value: f64| Some(Spanned::new(value, span));
        let mut house = House {
            span,
            ..House::default()
        };
        house.settings = Settings {
            x: at(base.x),
            y: at(base.y),
            ..Settings::default()
        }
        .into();
        house.fittings.outdoors = Some(Box::new(Outdoors {
            span,
            word,
            sheets,
            trees,
        }));
        house
    }
}

/// Streets with the index of their boxes.
struct OtherStreets {
    pieces: Vec<Piece>,
    index: Grid,
}

impl OtherStreets {
    fn new(pieces: Vec<Piece>) -> OtherStreets {
        let around = |piece: &Piece| wider(piece.line.bounds(), piece.half);
        OtherStreets {
            index: Grid::new(pieces.iter().map(around).collect()),
            pieces,
        }
    }

    /// Returns true if a place lies in a street or nearer than `clear` to its side.
    fn reach(&self, at: DVec2, clear: f64) -> bool {
        let mut near = self.index.near(wider([at; 2], clear)).into_iter();
        near.any(|n| {
            let piece = &self.pieces[n as usize];
            piece.line.nearest(at).distance(at) < piece.half + clear
        })
    }
}

/// The outlines of houses, with their boxes.
struct Walls<'t>(Vec<(Bounds, &'t [DVec2])>);

impl<'t> Walls<'t> {
    fn new(rings: impl Iterator<Item = &'t [DVec2]>) -> Walls<'t> {
        let boxed = rings.filter_map(|ring| Some((bounds(ring.iter().copied())?, ring)));
        Walls(boxed.collect())
    }

    /// Returns true if a place lies in a house or no farther than `far` from its walls.
    fn near(&self, at: DVec2, far: f64) -> bool {
        self.0.iter().any(|(box_of, ring)| {
            meet(wider(*box_of, far), [at; 2]) && (contains(ring, at) || distance(ring, at) < far)
        })
    }
}

/// Fails if there are more pieces than a limit.
fn limited(count: f64, most: f64) -> Result<(), Text> {
    let count = count.round();
    match count <= most {
        true => Ok(()),
        false => Err(text!([count, most]
            "it would have {count} pieces, more than the limit of {most}",
            "部材が {count} 個になり、上限の {most} 個を超えます"
        )),
    }
}

/// Returns the sides of faces that no other face continues, each down by a depth.
fn edges(faces: &[Vec<DVec3>], depth: f64) -> Vec<Vec<DVec3>> {
    let key = |p: DVec3| (p * 1000.0).round().to_array().map(|x| x as i64);
    let sides = |face: &Vec<DVec3>| {
        let n = face.len();
        let face = face.clone();
        (0..n).map(move |i| [face[i], face[(i + 1) % n]])
    };
    let all = faces.iter().flat_map(sides);
    let known: BTreeSet<[[i64; 3]; 2]> = all.map(|[p, q]| [key(p), key(q)]).collect();
    let free = faces.iter().flat_map(sides);
    let free = free.filter(|[p, q]| p.distance(*q) > 0.01 && !known.contains(&[key(*q), key(*p)]));
    let down = DVec3::Z * depth;
    free.map(|[p, q]| vec![p - down, q - down, q, p]).collect()
}

/// Returns a value of the table of decisions.
fn told(name: &str, value: f64) -> (String, Value) {
    (
        name.to_owned(),
        Value::Number((value * 100.0).round() / 100.0),
    )
}

/// Returns the segments of a line.
fn segments(line: &[DVec2]) -> impl Iterator<Item = Segment> + '_ {
    line.windows(2).map(|ends| Segment::new(ends[0], ends[1]))
}
