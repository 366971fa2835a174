//! What is known of a tile that has been made: a small file beside it, by which another run recognizes it.

use crate::decision::SkippedFeature;
use glam::DVec3;
use hsd_export::tileset::{TileLevel, TilePlace};
use hsd_scene::Detail;
use serde::{Deserialize, Serialize};

/// Millimetres in a metre.
pub const MM: f64 = 1000.0;

/// A tile that has been made.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct TileRecord {
    /// Its name.
    pub tile: String,
    /// The hash of all that it depends on.
    pub inputs: String,
    /// The number of its houses.
    pub houses: usize,
    /// Its levels, from far to near.
    pub levels: Vec<LevelRecord>,
    /// The images that its levels show.
    pub textures: Vec<TextureRecord>,
    /// The images of parts, by path, with the hash of the bytes that were read.
    pub pictures: Vec<(String, String)>,
    /// The houses that would exceed a limit, by number, with the code and the reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<(usize, String, String)>,
    /// Problems of its houses, found while they were made.
    pub corrected: Vec<SkippedFeature>,
}

/// A level of a tile.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct LevelRecord {
    /// The level of detail.
    pub detail: u8,
    /// Its file.
    pub file: String,
    /// The length of the file.
    pub bytes: u64,
    /// The number of its triangles.
    pub triangles: usize,
    /// The bytes of its arrays.
    pub arrays: u64,
    /// The box of its vertices, whole millimetres in the frame of the town: numbers that every reader reads alike.
    pub low: [i64; 3],
    /// Its other corner.
    pub high: [i64; 3],
    /// The numbers of its images in the list of the tile.
    pub textures: Vec<usize>,
}

/// An image that tiles show.
#[derive(Clone, Debug, Default, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
pub struct TextureRecord {
    /// Its file.
    pub file: String,
    /// An estimate of the bytes that it takes on a graphics card.
    pub graphics: u64,
}

impl TileRecord {
    /// Returns its file's name.
    pub fn file(&self) -> String {
        record_file(&self.tile, &self.inputs)
    }

    /// Returns the names of all files that it needs, itself left out.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        let levels = self.levels.iter().map(|level| &*level.file);
        levels.chain(self.textures.iter().map(|t| &*t.file))
    }

    /// Returns its place in the tileset.
    pub fn place(&self) -> TilePlace {
        let level = |level: &LevelRecord| TileLevel {
            detail: Detail::ALL[usize::from(level.detail).min(3)],
            file: level.file.clone(),
            bounds: [level.low, level.high].map(|p| DVec3::from(p.map(|x| x as f64)) / MM),
        };
        TilePlace {
            levels: self.levels.iter().map(level).collect(),
        }
    }
}

/// Returns the name of the record of a tile with these inputs.
pub fn record_file(tile: &str, inputs: &str) -> String {
    format!("tiles/{tile}-{inputs}.json")
}
