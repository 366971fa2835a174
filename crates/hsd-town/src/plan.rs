//! A town with its maps: all features in one frame, with the streets and an index of outlines.

mod blocks;
mod covered;
mod key;
mod laid;
mod lodged;
mod packed;
mod poles;
mod roads;
mod shelves;
mod waters;
mod zones;

pub use covered::Covered;
pub use key::TileKey;
pub use laid::LaidFirst;
pub(crate) use lodged::Lodger;
pub use lodged::{Lodged, LodgedTile, Lodging, UnusedLot};
pub use packed::PartReader;
pub use poles::{KnownPole, KnownPoles};
pub use roads::{BORDERS, RoadPiece, Roads};
pub(crate) use shelves::Shelves;
pub use waters::Waters;
pub use zones::{ZoneArea, Zones};

use super::frontage::first_front;
use super::layer::{Ground, Lot, Lots, Shape, TownFrame, Unjoined};
use super::neighbour::{Neighbours, TOUCHING};
use super::shape::Segment;
use super::street::{FAR, Piece, Streets, StreetsBuilder, WIDE, class_width};
use super::table::Rows;
use blocks::Blocks;
use glam::DVec2;
use hsd_base::geometry::grid::Grid;
use hsd_ir::ast::town::{Layer, Town};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::{Arc, OnceLock};

/// The outlines round a feature that are looked at, at most. Of more the nearest count: so houses all at one place take no more
/// time than a large town.
const NEIGHBOURS: usize = 512;
/// The outlines within reach of a network that are looked at, at most. Of more the nearest count.
const SERVED_MOST: usize = 4096;
/// How far the houses are looked at that stand between a house and its street, metres.
const AROUND: f64 = 40.0;
/// How far from its pole a house may be that a network serves, metres.
pub const SERVED: f64 = 100.0;

/// A town with its maps.
#[derive(Debug)]
pub struct Plan {
    /// As written.
    pub town: Arc<Town>,
    /// Its frame.
    pub frame: TownFrame,
    /// Its layers.
    pub layers: Vec<Lots>,
    /// Its tables.
    pub tables: Arc<Vec<Rows>>,
    /// Its ground.
    pub ground: Arc<Ground>,
    /// The points of layers whose fields no outline takes, with the reason.
    pub unjoined: Vec<Unjoined>,
    /// The streets of each layer of streets, by name; the empty name stands for all that count by default.
    streets: Arc<BTreeMap<String, Streets>>,
    blocks: Arc<Blocks>,
    /// What is laid before anything else.
    pub laid: Arc<LaidFirst>,
    /// The bytes of the font of its signs.
    pub font: Option<Arc<[u8]>>,
    /// Its features, if they wait in a spool: then no layer has any.
    pub lodged: Option<Lodged>,
    /// Outlines on which houses may stand: layer and feature.
    outlines: Vec<(usize, usize)>,
    index: Grid,
    fronts: KnownFronts,
}

/// The fronts of the outlines by distance alone, for each layer of streets. Each is found when the first neighbour looks at it.
type KnownFronts = BTreeMap<String, Vec<OnceLock<Option<Segment>>>>;

/// The number of a feature: its layer, and its place in it.
pub type LotId = (usize, usize);

impl Plan {
    /// Prepares a town.
    pub fn new(town: Town, frame: TownFrame, mut layers: Vec<Lots>, tables: Vec<Rows>) -> Plan {
        for layer in &mut layers {
            for (lot, number) in layer.lots.iter_mut().zip(0..) {
                lot.number = number;
            }
        }
        let mut streets = BTreeMap::new();
        let mut all = StreetsBuilder::default();
        let fronts: Vec<&str> = town.fronts.iter().map(|f| &*f.value).collect();
        for layer in &layers {
            let name = &layer.layer.name.value;
            let named = fronts.contains(&&**name);
            let counts = match layers
                .iter()
                .any(|l| fronts.contains(&&*l.layer.name.value))
            {
                true => named,
                false => has_streets(layer),
            };
            if counts {
                add_streets(&mut all, layer);
            }
            if !has_no_streets(&town, name) {
                let mut own = StreetsBuilder::default();
                add_streets(&mut own, layer);
                streets.insert(name.clone(), own.finish());
            }
        }
        streets.insert(String::new(), all.finish());
        let blocks = layers.iter().filter(|layer| !is_ruled(&town, layer));
        Plan {
            blocks: Arc::new(Blocks::new(blocks)),
            town: Arc::new(town),
            frame,
            tables: Arc::new(tables),
            ground: Arc::default(),
            unjoined: vec![],
            streets: Arc::new(streets),
            laid: Arc::default(),
            font: None,
            lodged: None,
            outlines: vec![],
            index: Grid::default(),
            fronts: KnownFronts::new(),
            layers: vec![],
        }
        .with_layers(layers)
    }

    /// Returns the same town with other features.
    fn with_layers(&self, layers: Vec<Lots>) -> Plan {
        let mut outlines = vec![];
        for (number, layer) in layers.iter().enumerate() {
            if is_housed(&self.town, layer) {
                let rings = layer.lots.iter().enumerate();
                let rings = rings.filter(|(_, lot)| lot.shape.ring().is_some());
                outlines.extend(rings.map(|(lot, _)| (number, lot)));
            }
        }
        let boxes = outlines
            .iter()
            .map(|(l, n)| layers[*l].lots[*n].shape.bounds());
        let fronts = || outlines.iter().map(|_| OnceLock::new()).collect();
        let fronts = self.streets.keys().map(|name| (name.clone(), fronts()));
        Plan {
            index: Grid::new(boxes.collect()),
            fronts: fronts.collect(),
            town: self.town.clone(),
            frame: self.frame.clone(),
            tables: self.tables.clone(),
            ground: self.ground.clone(),
            unjoined: vec![],
            streets: self.streets.clone(),
            blocks: self.blocks.clone(),
            laid: self.laid.clone(),
            font: self.font.clone(),
            lodged: None,
            outlines,
            layers,
        }
    }

    /// Returns the features of a tile that wait in a spool, in a part of the town that gives them what the whole town does.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn part(&self, lodged: &Lodged, tile: usize) -> io::Result<(Plan, Vec<LotId>)> {
        lodged.part(self, tile)
    }

    /// Returns the keys that several features of a layer have.
    pub fn keys_of_several(&self, layer: usize) -> BTreeSet<String> {
        let mut known = BTreeSet::new();
        let lots = self.layers[layer].lots.iter();
        let twice = lots.filter(|lot| !known.insert(&lot.key));
        let twice = twice.map(|lot| lot.key.to_string());
        let lodged = self.lodged.as_ref().and_then(|l| l.twice.get(&layer));
        twice.chain(lodged.into_iter().flatten().cloned()).collect()
    }

    /// Returns the number of features of layers that rules name.
    pub fn features(&self) -> usize {
        match &self.lodged {
            Some(lodged) => lodged.features,
            None => self.lots().len(),
        }
    }

    /// Calls `see` with each of them, in any order.
    ///
    /// # Errors
    /// Those of the spool, if they wait in one.
    pub fn each(&self, see: &mut dyn FnMut(&Lot)) -> io::Result<()> {
        match &self.lodged {
            Some(lodged) => lodged.each(see),
            None => {
                self.lots().iter().for_each(|id| see(self.lot(*id)));
                Ok(())
            }
        }
    }

    /// Returns true if the features of a layer are counted: parts of divided areas are only where rules name them.
    pub(crate) fn is_counted(&self, layer: usize) -> bool {
        self.is_ruled(layer) || self.layers[layer].layer.divided.is_none()
    }

    /// Calls `see` with each feature of the layers that no rule names.
    pub fn each_unused(&self, see: &mut dyn FnMut(UnusedLot)) {
        let layers = self.layers.iter().enumerate();
        let unruled = layers.filter(|(n, _)| !self.is_ruled(*n) && self.is_counted(*n));
        for (number, layer) in unruled {
            for lot in &layer.lots {
                see(UnusedLot {
                    id: (number, lot.number as usize),
                    key: lot.key.clone(),
                    at: lot.shape.centre(),
                });
            }
        }
        let lodged = self.lodged.iter().flat_map(|lodged| &lodged.unused);
        lodged.for_each(|lot| {
            see(UnusedLot {
                key: lot.key.clone(),
                ..*lot
            });
        });
    }

    /// Returns the layers that nothing in the town depends on. They are not named by a rule, not used as streets and not joined
    /// to another layer.
    pub(crate) fn idle_layers(&self) -> impl Iterator<Item = usize> {
        let layers = self.layers.iter().enumerate();
        let idle = layers.filter(|(number, layer)| {
            let name = &layer.layer.name.value;
            let mut joins = self.town.layers.iter().flat_map(|layer| &layer.joins);
            let is_joined = joins.any(|join| join.layer.value == *name);
            let is_street = self.streets.contains_key(name);
            let is_divided = is_divided(&self.town, &layer.layer);
            let is_ruled = self.is_ruled(*number) || !self.is_counted(*number);
            !is_ruled && !is_street && !is_joined && !is_divided
        });
        idle.map(|(number, _)| number)
    }

    /// Returns true if rules name a layer.
    fn is_ruled(&self, layer: usize) -> bool {
        is_ruled(&self.town, &self.layers[layer])
    }

    /// Returns true if no layer counts as streets.
    pub fn has_no_streets(&self) -> bool {
        self.streets.get("").is_none_or(Streets::is_empty)
    }

    /// Returns a feature.
    pub fn lot(&self, (layer, lot): LotId) -> &Lot {
        &self.layers[layer].lots[lot]
    }

    /// Returns all features of layers that rules name, in the order of the file.
    pub fn lots(&self) -> Vec<LotId> {
        let layers = (0..self.layers.len()).filter(|n| self.is_ruled(*n));
        layers
            .flat_map(|n| (0..self.layers[n].lots.len()).map(move |lot| (n, lot)))
            .collect()
    }

    /// Returns the pieces of streets within reach of a feature; of one layer, if it is named.
    pub fn pieces(&self, lot: &Lot, layer: &str) -> Vec<Piece> {
        let streets = self.streets.get(layer).or(self.streets.get(""));
        streets.map_or(vec![], |s| s.near(lot.shape.bounds(), FAR))
    }

    /// Returns the pieces of streets that may be as far away as the far side of a wide road; of one layer, if it is named.
    pub fn road_pieces(&self, lot: &Lot, layer: &str) -> Vec<Piece> {
        let streets = self.streets.get(layer).or(self.streets.get(""));
        streets.map_or(vec![], |s| s.near(lot.shape.bounds(), WIDE))
    }

    /// Returns the street along a line, of those that count by default.
    pub fn street_along(&self, line: Segment) -> Option<&Piece> {
        self.streets.get("")?.along(line)
    }

    /// Returns the outlines within reach of a network along a feature, itself left out.
    pub fn served(&self, id: LotId) -> Vec<LotId> {
        self.around(id, SERVED, SERVED_MOST)
    }

    /// Returns the outlines within a distance of a feature, itself left out; of more than `most` the nearest.
    fn around(&self, id: LotId, far: f64, most: usize) -> Vec<LotId> {
        let bounds = self.lot(id).shape.bounds();
        let found = self.index.nearest(bounds, far, most).into_iter();
        let found = found.map(|n| self.outlines[n as usize]);
        found.filter(|other| *other != id).collect()
    }

    /// Returns how far others may be on which a feature depends, metres.
    fn beside(&self) -> f64 {
        match self.town.networks.is_empty() {
            true => AROUND,
            false => SERVED,
        }
    }

    /// Returns the neighbours of a feature, as far as they may stand before its street.
    pub fn neighbours(&self, id: LotId) -> Neighbours<'_> {
        let rings = self.around(id, AROUND, NEIGHBOURS).into_iter();
        Neighbours {
            rings: rings
                .filter_map(|other| self.lot(other).shape.ring())
                .collect(),
        }
    }

    /// Returns the fronts, by distance alone, of the outlines that touch a feature.
    pub fn row(&self, id: LotId, layer: &str) -> Vec<Segment> {
        let Some(own) = self.lot(id).shape.ring() else {
            return vec![];
        };
        let near = self.around(id, TOUCHING, NEIGHBOURS).into_iter();
        let touching = near.filter(|other| {
            let ring = self.lot(*other).shape.ring().unwrap_or_default();
            super::shape::sides(own)
                .any(|s| super::shape::sides(ring).any(|t| s.distance(t) <= TOUCHING))
        });
        touching
            .filter_map(|other| self.first_front(other, layer))
            .collect()
    }

    /// Returns the front of an outline by distance alone.
    fn first_front(&self, id: LotId, layer: &str) -> Option<Segment> {
        let find = || {
            let lot = self.lot(id);
            let pieces = self.pieces(lot, layer);
            first_front(lot.shape.ring()?, &pieces, &self.neighbours(id))
        };
        let known = self.fronts.get(layer).or(self.fronts.get(""));
        let number = self.outlines.binary_search(&id).ok();
        match known.zip(number).and_then(|(known, n)| known.get(n)) {
            Some(known) => *known.get_or_init(find),
            None => find(),
        }
    }

    /// Returns the key of the polygon, in a layer without houses, that a place lies in: its block.
    pub fn block(&self, p: DVec2) -> Option<&str> {
        self.blocks.at(p)
    }
}

/// Returns true if rules name a layer.
fn is_ruled(town: &Town, layer: &Lots) -> bool {
    let name = &layer.layer.name.value;
    town.rules.iter().any(|rule| rule.each.value == *name)
}

/// Returns true if rules may make houses of a layer.
fn is_housed(town: &Town, layer: &Lots) -> bool {
    is_ruled(town, layer) && town.housed.contains(&layer.layer.name.value)
}

/// Returns true if the streets of a town cannot depend on a layer without lines.
pub(crate) fn has_no_streets(town: &Town, layer: &str) -> bool {
    let named = |front: &str| front == layer || front.contains('{');
    !NAMES.contains(&layer) && !town.fronts.iter().any(|front| named(&front.value))
}

/// Names of layers that are streets.
const NAMES: &[&str] = &[
    "road", "roads", "street", "streets", "highway", "highways", "block", "blocks", "道", "道路",
    "通り", "街区",
];

/// Returns true for a layer that counts as streets where no `front` names one.
fn has_streets(layer: &Lots) -> bool {
    let lines = layer
        .lots
        .iter()
        .any(|lot| matches!(lot.shape, Shape::Lines(_)));
    let classed = || {
        layer
            .lots
            .iter()
            .any(|lot| layer.word(lot, "highway").is_some())
    };
    NAMES.contains(&&*layer.layer.name.value) || lines && classed()
}

/// Adds the streets of a layer.
fn add_streets(streets: &mut StreetsBuilder, layer: &Lots) {
    for lot in &layer.lots {
        match &lot.shape {
            Shape::Area(ring, _) => streets.ring(ring),
            Shape::Lines(lines) => {
                if let Some(width) = width(layer, lot) {
                    let known = layer.number(lot, "width").is_some_and(|w| w > 0.0);
                    lines
                        .iter()
                        .for_each(|line| streets.line(line, width, known));
                }
            }
            Shape::Point(_) => {}
        }
    }
}

/// Returns the width of a line, metres: its own, else that of its class; `None` if it is no street.
fn width(layer: &Lots, lot: &Lot) -> Option<f64> {
    let class = layer
        .word(lot, "highway")
        .or_else(|| layer.word(lot, "class"));
    let own = layer.number(lot, "width").filter(|w| *w > 0.0);
    let by_class = class.as_deref().map(class_width);
    match (own, by_class, &layer.layer.filter) {
        // A `where` that names footways means them.
        (own, Some(None), Some(_)) => Some(own.unwrap_or(2.0)),
        (_, Some(None), None) => None,
        (Some(own), ..) => Some(own),
        (None, Some(width), _) => width,
        (None, None, _) => Some(4.0),
    }
}

/// Returns true if the areas of a layer are divided into the features of others.
pub(crate) fn is_divided(town: &Town, layer: &Layer) -> bool {
    let is_part = |part: &Layer| part.divided.is_some() && part.src.span == layer.src.span;
    layer.divided.is_none() && town.layers.iter().any(is_part)
}
