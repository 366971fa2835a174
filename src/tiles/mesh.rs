//! Which feature belongs to which tile.

use crate::ast::town::Tiles;
use crate::town::Plan;
use crate::town::plan::LotId;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use twox_hash::XxHash3_128;

/// The name of a tile.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TileKey {
    /// The cell of a square mesh, counted eastwards and northwards from the town's origin.
    Cell(i64, i64),
    /// The value of a field; empty for features without one.
    Named(String),
}

impl TileKey {
    /// Returns the beginning of the names of its files.
    pub fn stem(&self) -> String {
        match self {
            TileKey::Cell(east, north) => format!("{east}_{north}"),
            TileKey::Named(name) => {
                let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
                let short: String = name.chars().take(24).map(plain).collect();
                // Names that differ in what is left out must not share a file.
                format!(
                    "{short}-{:08x}",
                    XxHash3_128::oneshot(name.as_bytes()) as u32
                )
            }
        }
    }
}

/// A tile: its features, in the order of their files.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Its name.
    pub key: TileKey,
    /// Its features.
    pub lots: Vec<LotId>,
    /// The place from which its vertices count, whole metres.
    pub centre: DVec3,
}

/// Divides the features of a town into tiles, in the order of their keys.
pub fn tiles(plan: &Plan, division: &Tiles) -> Vec<Tile> {
    let mut all: BTreeMap<TileKey, Vec<LotId>> = BTreeMap::new();
    for id in plan.lots() {
        all.entry(key(plan, id, division)).or_default().push(id);
    }
    let made = |(key, lots): (TileKey, Vec<LotId>)| {
        let centre = match &key {
            TileKey::Cell(east, north) => {
                (DVec2::new(*east as f64, *north as f64) + 0.5) * division.size
            }
            TileKey::Named(_) => {
                let sum: DVec2 = lots.iter().map(|id| plan.lot(*id).shape.centre()).sum();
                sum / lots.len() as f64
            }
        };
        let centre = centre.round().extend(0.0);
        Tile { key, lots, centre }
    };
    all.into_iter().map(made).collect()
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
            features += tile.lots.len();
            features >= wanted
        });
        tiles.truncate(enough.map_or(tiles.len(), |last| last + 1));
        tiles.sort_by(|a, b| a.key.cmp(&b.key));
        tiles
    }
}

fn key(plan: &Plan, id: LotId, division: &Tiles) -> TileKey {
    let lot = plan.lot(id);
    match &division.by {
        Some(field) => {
            let value = plan.layers[id.0].word(lot, &field.value);
            TileKey::Named(value.unwrap_or_default())
        }
        None => {
            let cell = (lot.shape.centre() / division.size).floor();
            TileKey::Cell(cell.x as i64, cell.y as i64)
        }
    }
}
