//! The names of tiles: which feature belongs to which.

use crate::layer::{Lot, Lots};
use hsd_ir::ast::town::Tiles;
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
    /// Returns the name of the tile to which a feature of a layer belongs: that of its centroid, or of a field.
    pub fn of(layer: &Lots, lot: &Lot, division: &Tiles) -> TileKey {
        match &division.by {
            Some(field) => {
                let value = layer.word(lot, &field.value);
                TileKey::Named(value.unwrap_or_default())
            }
            None => {
                let cell = (lot.shape.centre() / division.size).floor();
                TileKey::Cell(cell.x as i64, cell.y as i64)
            }
        }
    }

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
