//! Which feature belongs to which tile.

use crate::Plan;
pub use crate::plan::TileKey;
use crate::plan::{Lodged, LotId};
use glam::{DVec2, DVec3};
use hsd_ir::ast::town::Tiles;
use std::collections::BTreeMap;
use std::io;

/// A tile.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Its name.
    pub key: TileKey,
    /// Its features.
    pub lots: TileLots,
    /// The place from which its vertices count, whole metres; of a named tile whose features wait in a spool only roughly.
    pub centre: DVec3,
}

/// The features of a tile.
#[derive(Clone, Debug)]
pub enum TileLots {
    /// In the order of their files.
    Here(Vec<LotId>),
    /// They wait in a spool: its number there, and how many.
    Lodged(usize, usize),
}

impl Tile {
    /// Returns the tile of this name whose features are in a town, or in a part of one.
    pub fn of(key: TileKey, lots: Vec<LotId>, plan: &Plan, size: f64) -> Tile {
        let centre = centre(&key, size, || middle(plan, &lots));
        let lots = TileLots::Here(lots);
        Tile { key, lots, centre }
    }

    /// Returns the number of its features.
    pub fn features(&self) -> usize {
        match &self.lots {
            TileLots::Here(lots) => lots.len(),
            TileLots::Lodged(_, features) => *features,
        }
    }

    /// Hands the tile to `make`, with its features and a town in which they have all that they depend on.
    ///
    /// # Errors
    /// Those of the spool in which they wait.
    pub fn with<T>(
        &self,
        plan: &Plan,
        make: impl FnOnce(&Plan, &[LotId], DVec3) -> T,
    ) -> io::Result<T> {
        match (&self.lots, &plan.lodged) {
            (TileLots::Lodged(number, _), Some(lodged)) => {
                let (part, lots) = plan.part(lodged, *number)?;
                let size = part.town.tiles.size;
                let centre = centre(&self.key, size, || middle(&part, &lots));
                Ok(make(&part, &lots, centre))
            }
            (TileLots::Here(lots), _) => Ok(make(plan, lots, self.centre)),
            (TileLots::Lodged(..), None) => Ok(make(plan, &[], self.centre)),
        }
    }
}

/// Divides the features of a town into tiles, in the order of their keys.
pub fn tiles(plan: &Plan, division: &Tiles) -> Vec<Tile> {
    if let Some(lodged) = &plan.lodged {
        return lodged_tiles(lodged, division);
    }
    let mut all: BTreeMap<TileKey, Vec<LotId>> = BTreeMap::new();
    for id in plan.lots() {
        let key = TileKey::of(&plan.layers[id.0], plan.lot(id), division);
        all.entry(key).or_default().push(id);
    }
    let made = |(key, lots)| Tile::of(key, lots, plan, division.size);
    all.into_iter().map(made).collect()
}

fn lodged_tiles(lodged: &Lodged, division: &Tiles) -> Vec<Tile> {
    let tiles = lodged.tiles.iter().enumerate().map(|(number, tile)| Tile {
        key: tile.key.clone(),
        lots: TileLots::Lodged(number, tile.features),
        centre: centre(&tile.key, division.size, || {
            tile.bounds[0].midpoint(tile.bounds[1])
        }),
    });
    let mut tiles: Vec<Tile> = tiles.collect();
    tiles.sort_by(|a, b| a.key.cmp(&b.key));
    tiles
}

/// Returns the place from which the vertices of a tile count; `middle` is that of its features.
fn centre(key: &TileKey, size: f64, middle: impl FnOnce() -> DVec2) -> DVec3 {
    let centre = match key {
        TileKey::Cell(east, north) => (DVec2::new(*east as f64, *north as f64) + 0.5) * size,
        TileKey::Named(_) => middle(),
    };
    centre.round().extend(0.0)
}

/// Returns the middle of some features.
fn middle(plan: &Plan, lots: &[LotId]) -> DVec2 {
    let sum: DVec2 = lots.iter().map(|id| plan.lot(*id).shape.centre()).sum();
    sum / lots.len() as f64
}

/// Which tiles of a town are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// All of them.
    All,
    /// Those in the middle, nearest first, until they have so many features.
    Middle(usize),
}

impl Reach {
    /// Keeps the tiles within reach, in their order.
    pub fn of(self, mut tiles: Vec<Tile>) -> Vec<Tile> {
        let Reach::Middle(wanted) = self else {
            return tiles;
        };
        let (low, high) = tiles.iter().fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(low, high), tile| (low.min(tile.centre), high.max(tile.centre)),
        );
        let away = |tile: &Tile| tile.centre.distance_squared((low + high) / 2.0);
        tiles.sort_by(|a, b| away(a).total_cmp(&away(b)).then_with(|| a.key.cmp(&b.key)));
        let mut features = 0;
        let enough = tiles.iter().position(|tile| {
            features += tile.features();
            features >= wanted
        });
        tiles.truncate(enough.map_or(tiles.len(), |last| last + 1));
        tiles.sort_by(|a, b| a.key.cmp(&b.key));
        tiles
    }
}
