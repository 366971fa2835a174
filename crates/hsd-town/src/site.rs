//! A feature as the rules of its town see it: its fields and measures, and where a house stands on it.

mod footing;
pub mod law;
mod middle;
mod outdoors;
pub mod published;
mod word;

pub use footing::Footing;

use super::frontage::{Frontage, frontage};
use super::layer::{Lot, Shape};
use super::neighbour::Neighbours;
use super::plan::{LotId, Plan};
use super::plot::{self, LEAST_IOU, LEAVES, Rectangle};
use super::rear::{self, RearDecision, RearLot};
use super::shape::{Segment, angle, area, azimuth, is_orthogonal, sides};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::rng::Place;
use hsd_base::text;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{Known, PlaceOn, Rear, Site, SiteWalls, Stood, Unfound, Wish};
use std::cell::{Cell, OnceCell, RefCell};
use word::word;

/// The measures of every feature.
pub const MEASURES: [&str; 22] = [
    "key",
    "x",
    "y",
    "z",
    "area",
    "perimeter",
    "vertices",
    "orthogonal",
    "word",
    "frontage",
    "depth",
    "facing",
    "street",
    "corner",
    "through",
    "access",
    "left",
    "right",
    "block",
    "length",
    "bearing",
    "randloc",
];
/// How far neighbours are looked for, metres.
const BESIDE: f64 = 30.0;
/// The side of the grid of places that key draws, metres.
const PLACE: f64 = 0.5;

/// Where a house was put, or why it was not.
#[derive(Clone, Debug)]
pub struct Decision {
    /// What it stands on.
    pub on: PlaceOn,
    /// Its front.
    pub front: Segment,
    /// Its depth, metres.
    pub depth: f64,
    /// The overlap of its rectangle with the outline, and that of the rectangle of full depth.
    pub iou: Option<f64>,
    /// The same of the rectangle of full depth.
    pub iou_full: Option<f64>,
    /// Why it has no place.
    pub refused: Option<Text>,
}

/// A feature of a town.
pub struct LotSite<'p> {
    plan: &'p Plan,
    id: LotId,
    neighbours: OnceCell<Neighbours<'p>>,
    frontage: OnceCell<Option<Frontage>>,
    /// The decisions about the houses that were asked for.
    pub decisions: RefCell<Vec<Decision>>,
    /// The decisions about the houses behind them.
    pub rear_decisions: RefCell<Vec<RearDecision>>,
    /// What the ground knows of the places of its houses.
    pub footing: Cell<Footing>,
    /// The outlines of its houses as they are built, so that no tree stands in them.
    pub built: RefCell<Vec<Vec<DVec2>>>,
}

impl<'p> LotSite<'p> {
    /// Creates the site of a feature.
    pub fn new(plan: &'p Plan, id: LotId) -> LotSite<'p> {
        LotSite {
            plan,
            id,
            neighbours: OnceCell::new(),
            frontage: OnceCell::new(),
            decisions: RefCell::default(),
            rear_decisions: RefCell::default(),
            footing: Cell::default(),
            built: RefCell::default(),
        }
    }

    fn lot(&self) -> &'p Lot {
        self.plan.lot(self.id)
    }

    fn neighbours(&self) -> &Neighbours<'p> {
        self.neighbours
            .get_or_init(|| self.plan.neighbours(self.id))
    }

    /// Returns what is known of its front; `None` if it is no area.
    pub fn frontage(&self) -> Option<&Frontage> {
        self.frontage.get_or_init(|| self.frontage_to("")).as_ref()
    }

    fn frontage_to(&self, layer: &str) -> Option<Frontage> {
        let ring = self.lot().shape.ring()?;
        let known = self.plan.layers[self.id.0].front_side();
        let pieces = self.plan.pieces(self.lot(), layer);
        let row = || self.plan.row(self.id, layer);
        Some(frontage((ring, known), &pieces, self.neighbours(), row))
    }

    fn measure(&self, name: &str) -> Option<Value> {
        let lot = self.lot();
        let ring = lot.shape.ring();
        let front = || self.frontage().map(|f| f.front.chord);
        let behind = |(front, ring)| plot::depth_behind(ring, front);
        let number = |n: f64| Value::Number((n * 1e6).round() / 1e6);
        Some(match name {
            "key" => Value::read(&lot.key),
            "x" => number(lot.shape.centre().x),
            "y" => number(lot.shape.centre().y),
            "z" => number(self.plan.ground.at(lot.shape.centre()).unwrap_or(lot.z)),
            "area" => number(match &lot.shape {
                Shape::Area(ring, holes) => area(ring, holes),
                _ => 0.0,
            }),
            "perimeter" => number(ring.map_or(0.0, |r| sides(r).map(Segment::length).sum())),
            "vertices" => number(ring.map_or(0, <[DVec2]>::len) as f64),
            "orthogonal" => Value::Truth(ring.is_some_and(is_orthogonal)),
            "word" => Value::Text(ring.map_or(String::new(), |r| word(r, self.frontage()))),
            "frontage" => number(front().map_or(0.0, Segment::length)),
            "depth" => number(front().zip(ring).map_or(0.0, behind)),
            "facing" => number(front().map_or(0.0, |f| azimuth(f.normal()))),
            "street" => number(self.frontage()?.front.street.unwrap_or(f64::from(u16::MAX))),
            "corner" => Value::Truth(self.frontage().is_some_and(|f| f.corner)),
            "through" => Value::Truth(self.frontage().is_some_and(|f| f.through)),
            "access" => Value::Text(
                self.frontage()
                    .map_or("none", |f| f.access.word())
                    .to_owned(),
            ),
            "left" | "right" => number(self.beside(front()?, name == "left")),
            "block" => Value::read(self.plan.block(lot.shape.centre()).unwrap_or("")),
            "length" => number(self.lines().map(Segment::length).sum()),
            "bearing" => number(azimuth(self.longest()?.direction())),
            "randloc" => number(published::rand_loc(lot.shape.centre(), 2)),
            _ => return None,
        })
    }

    fn lines(&self) -> impl Iterator<Item = Segment> + 'p {
        let lines: &[Vec<DVec2>] = match &self.lot().shape {
            Shape::Lines(lines) => lines,
            Shape::Area(..) | Shape::Point(_) => &[],
        };
        let ends = lines.iter().flat_map(|line| line.windows(2));
        ends.map(|ends| Segment::new(ends[0], ends[1]))
    }

    fn longest(&self) -> Option<Segment> {
        let ring = self.lot().shape.ring().unwrap_or_default();
        let all = self.lines().chain(sides(ring));
        all.reduce(|best, next| {
            if next.length() > best.length() {
                next
            } else {
                best
            }
        })
    }

    /// Returns the distance to the neighbour on the left or right as seen from the street, metres.
    fn beside(&self, front: Segment, left: bool) -> f64 {
        let ring = self.lot().shape.ring().unwrap_or_default();
        let way = if left {
            -front.direction()
        } else {
            front.direction()
        };
        let walls = sides(ring).filter(|s| angle(s.normal(), way) < 45.0);
        let found = walls.map(|wall| self.neighbours().distance(wall, BESIDE));
        let least = found.fold(BESIDE, f64::min);
        match least <= super::neighbour::TOUCHING {
            true => 0.0,
            false => least,
        }
    }

    /// Returns the rectangles of the houses on it; none if one of them takes more than a rectangle.
    fn on_rectangles(&self) -> Vec<Rectangle> {
        let decisions = self.decisions.borrow();
        let standing = decisions.iter().filter(|d| d.refused.is_none());
        let rectangle = |d: &Decision| {
            let (front, depth) = (d.front, d.depth);
            (d.on == PlaceOn::Plot).then_some(Rectangle { front, depth })
        };
        standing
            .map(rectangle)
            .collect::<Option<_>>()
            .unwrap_or_default()
    }

    fn refuse(&self, on: PlaceOn, front: Segment, why: Text) -> Option<Stood> {
        self.decisions.borrow_mut().push(Decision {
            on,
            front,
            depth: 0.0,
            iou: None,
            iou_full: None,
            refused: Some(why),
        });
        None
    }

    /// Puts a house on an outline, as a rectangle or along its walls.
    fn on_area(&self, wish: &Wish<'_>, ring: &[DVec2]) -> Option<Stood> {
        let published = wish.front == Some("published");
        let layer = wish.front.filter(|_| !published).unwrap_or("");
        let found = match layer {
            "" => self.frontage().cloned()?,
            layer => self.frontage_to(layer)?,
        };
        let mut front = found.front.chord;
        let mut full = plot::depth_behind(ring, front);
        if published {
            let pieces = self.plan.pieces(self.lot(), "");
            let Some(by_rule) = published::front(ring, &pieces) else {
                let why = text!(
                    "no second vertex for a frontage lies 1.2 m from the first within 120 degrees",
                    "正面の二つ目の頂点（1.2 m 以上離れ、120 度以内）がありません"
                );
                return self.refuse(PlaceOn::Plot, front, why);
            };
            full = published::depth(ring, by_rule);
            front = by_rule;
        }
        let whole = Rectangle { front, depth: full };
        let iou_full = whole.iou(ring);
        let fits = iou_full >= LEAST_IOU && whole.leaves(ring) <= LEAVES;
        match wish.on {
            Some(PlaceOn::Plot) => self.on_plot(wish, ring, whole, iou_full),
            None if published || (fits && wish.widest.is_none()) => {
                self.on_plot(wish, ring, whole, iou_full)
            }
            _ => Some(self.on_walls(wish, &found, full, iou_full)),
        }
    }

    fn on_plot(
        &self,
        wish: &Wish<'_>,
        ring: &[DVec2],
        whole: Rectangle,
        full: f64,
    ) -> Option<Stood> {
        let front = plot::narrowed(whole.front, wish.gaps);
        if let Some(widest) = wish.widest {
            let (width, widest) = (plot::tenths(front.length()), plot::tenths(widest));
            let why = text!([width, widest]
                "its front of {width} m is wider than the type allows, {widest} m",
                "間口 {width} m が型の上限 {widest} m を超えます"
            );
            return self.refuse(PlaceOn::Plot, front, why);
        }
        let depth = whole.depth.min(cap(wish));
        let rings = &self.neighbours().rings;
        let fitted = plot::fitted(ring, front, depth, rings);
        let rectangle = match fitted {
            Ok(rectangle) => rectangle,
            Err(why) => return self.refuse(PlaceOn::Plot, front, why.reason()),
        };
        self.decisions.borrow_mut().push(Decision {
            on: PlaceOn::Plot,
            front: rectangle.front,
            depth: rectangle.depth,
            iou: Some(rectangle.iou(ring)),
            iou_full: Some(full),
            refused: None,
        });
        Some(Stood {
            at: rectangle.front.to,
            z: self.lot().z,
            plinth: 0.0,
            azimuth: azimuth(rectangle.front.normal()),
            frontage: rectangle.front.length(),
            depth: rectangle.depth,
            centred: false,
            walls: None,
        })
    }

    /// Puts a house along the walls of its outline.
    fn on_walls(&self, wish: &Wish<'_>, found: &Frontage, depth: f64, iou_full: f64) -> Stood {
        let Shape::Area(ring, holes) = &self.lot().shape else {
            unreachable!("only areas have fronts");
        };
        let at = self.lot().shape.centre();
        let all: Vec<Segment> = sides(ring).collect();
        let longest = |a: &usize, b: &usize| all[*a].length().total_cmp(&all[*b].length());
        let front = found
            .front
            .sides
            .iter()
            .copied()
            .max_by(longest)
            .unwrap_or(0);
        let number = |side: usize| side as u32 + 1;
        let party = |side: &usize| {
            !found.front.sides.contains(side) && self.neighbours().is_party(all[*side])
        };
        let walls = SiteWalls {
            ring: ring.iter().map(|p| *p - at).collect(),
            holes: holes
                .iter()
                .map(|h| h.iter().map(|p| *p - at).collect())
                .collect(),
            front: number(front),
            street: found
                .on_street
                .iter()
                .chain(&found.front.sides)
                .map(|s| number(*s))
                .collect(),
            neighbour: (0..all.len()).filter(party).map(number).collect(),
        };
        self.decisions.borrow_mut().push(Decision {
            on: PlaceOn::Outline,
            front: found.front.chord,
            depth,
            iou: None,
            iou_full: Some(iou_full),
            refused: None,
        });
        // A front wider than the type allows repeats it.
        let length = all[front].length();
        let times = wish
            .widest
            .map_or(1.0, |most| (length / most).ceil().max(1.0));
        Stood {
            at,
            z: self.lot().z,
            plinth: 0.0,
            azimuth: azimuth(all[front].normal()),
            frontage: length / times,
            depth,
            centred: false,
            walls: Some(walls),
        }
    }
}

impl Site for LotSite<'_> {
    fn value(&self, name: &str) -> Known {
        match self.plan.layers[self.id.0].field(self.lot(), name) {
            Known::Unknown => self.measure(name).map_or(Known::Unknown, Known::Value),
            known => known,
        }
    }

    fn names(&self) -> Vec<String> {
        let fields = self.plan.layers[self.id.0].names().into_iter();
        fields.chain(MEASURES.map(str::to_owned)).collect()
    }

    fn look(&self, table: &str, key: &Value, column: &str) -> Result<Value, Unfound> {
        let tables = &self.plan.tables;
        let found = tables
            .iter()
            .find(|t| t.name == table)
            .ok_or_else(|| Unfound {
                argument: 0,
                known: tables.iter().map(|t| t.name.clone()).collect(),
            })?;
        found.cell(key, column)
    }

    fn is_layer(&self, name: &str) -> bool {
        let layers = self.plan.layers.iter();
        layers
            .into_iter()
            .any(|layer| layer.layer.name.value == name)
    }

    fn key(&self) -> (i64, i64) {
        let at = (self.lot().shape.centre() + self.plan.frame.origin) / PLACE;
        (at.x.floor() as i64, at.y.floor() as i64)
    }

    fn rear(&self, density: f64, draws: Place) -> Rear {
        let lot = self.lot();
        let Shape::Area(ring, holes) = &lot.shape else {
            return Rear::NoArea;
        };
        let ground = RearLot {
            ring,
            holes,
            others: &self.neighbours().rings,
            z: lot.z,
        };
        let houses = self.on_rectangles();
        let mut record = self.rear_decisions.borrow_mut();
        let mut made = rear::rear(ground, &houses, (density, draws), &mut record);
        for house in &mut made {
            self.put_rear_on_ground(&house.unit, &mut house.stood, &record);
        }
        Rear::Houses(made)
    }

    fn stand(&self, wish: &Wish<'_>) -> Option<Stood> {
        let mut stood = self.place(wish)?;
        self.put_on_ground(&mut stood);
        Some(stood)
    }
}

impl LotSite<'_> {
    fn place(&self, wish: &Wish<'_>) -> Option<Stood> {
        let shape = &self.lot().shape;
        match (shape, wish.on) {
            (_, Some(on @ (PlaceOn::Centre | PlaceOn::Line))) => Some(self.on_centre(wish, on)),
            (Shape::Area(..), Some(PlaceOn::Gate)) => self.on_gate(),
            (_, Some(PlaceOn::Gate)) => {
                let at = shape.centre();
                let why = text!(
                    "a gate needs an area with a front",
                    "門には正面のある面が要ります"
                );
                self.refuse(PlaceOn::Gate, Segment::new(at, at), why)
            }
            (Shape::Area(ring, _), _) if ring.len() < 3 || area(ring, &[]) < 1.0 => {
                let why = text!("its outline has no area", "輪郭に面積がありません");
                self.refuse(PlaceOn::Outline, Segment::new(ring[0], ring[0]), why)
            }
            (Shape::Area(ring, _), _) => self.on_area(wish, ring),
            (Shape::Lines(_), _) => Some(self.on_centre(wish, PlaceOn::Line)),
            (Shape::Point(_), _) => Some(self.on_centre(wish, PlaceOn::Centre)),
        }
    }
}

/// Returns the greatest depth of a house, metres: as written, or as the machiya macro has it (000-58).
fn cap(wish: &Wish<'_>) -> f64 {
    const SHALLOW: [&str; 6] = [
        "so-nikai",
        "sangai",
        "hiraya",
        "shimotaya",
        "hei-tsuki",
        "kanban",
    ];
    wish.cap.unwrap_or(match wish.kind {
        "chu-nikai" => 12.0,
        kind if SHALLOW.contains(&kind) => 8.0,
        _ => f64::INFINITY,
    })
}
