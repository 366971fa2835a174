//! Water and farmland that the rules of a town ask for (docs/contract.md 10.4); lengths in metres.

use serde::Serialize;

/// Water along a line, or over an area.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// Its width along a line, banks with it.
    pub width: f64,
    /// The material of its banks.
    pub bank: Bank,
    /// The width of a bank.
    pub bank_width: f64,
}

/// The material of a bank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Bank {
    /// Cut stone.
    #[default]
    Stone,
    /// Earth.
    Earth,
    /// None: the water ends at the ground.
    None,
}

impl Bank {
    /// The words for it.
    pub const WORDS: [(&'static str, Bank); 3] = [
        ("stone", Bank::Stone),
        ("earth", Bank::Earth),
        ("none", Bank::None),
    ];
}

/// Fields over an area, in a grid that is one for the whole town.
#[derive(Clone, Debug, PartialEq)]
pub struct Farmland {
    /// The crop.
    pub crop: Crop,
    /// How wide a field is across the grid, as nearly as a whole number of them in a square allows.
    pub width: f64,
    /// How deep it is along the grid.
    pub depth: f64,
    /// The direction of the grid, degrees clockwise from north.
    pub azimuth: f64,
    /// The width of the ridges between fields.
    pub ridge: f64,
    /// The width of the ways between the squares of the grid.
    pub way: f64,
}

/// A crop, as it stands on the field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Crop {
    /// Rice in summer: green rows in water.
    #[default]
    Rice,
    /// Rice before the harvest.
    Ripe,
    /// A paddy under water, before planting.
    Water,
    /// Vegetables on a dry field.
    Vegetables,
    /// A bare field.
    Bare,
}

impl Crop {
    /// The words for it.
    pub const WORDS: [(&'static str, Crop); 5] = [
        ("rice", Crop::Rice),
        ("ripe", Crop::Ripe),
        ("water", Crop::Water),
        ("vegetables", Crop::Vegetables),
        ("bare", Crop::Bare),
    ];

    /// Returns true if the field lies under water.
    pub fn is_wet(self) -> bool {
        matches!(self, Crop::Rice | Crop::Ripe | Crop::Water)
    }

    /// Returns the word for it.
    pub fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, own)| *own == self);
        found.map_or("", |(word, _)| word)
    }
}
