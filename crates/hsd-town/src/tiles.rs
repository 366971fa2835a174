//! A town in tiles (docs/contract.md 10): each is a pure function of the town, its features and what stands round them, made in
//! any order, by any number of threads, to the same bytes.
//!
//! | step | file |
//! |---|---|
//! | features belong to the tile of their centroid, or of a field | `mesh` |
//! | the rules make the houses of a tile; a hash of them names its files | `input` |
//! | the houses are made once and written at each level of detail | `make` |
//! | or written as CityJSON, or as a scene each | `city`, `scenes` |
//! | the ground is cut into pieces and thinned, each by itself | `terrain`, `piece` |
//! | what the law lets stand is a table and a scene of its own | `envelopes` |
//! | a tile that is there already is kept, another is made | `maker` |
//! | all become a tileset | `run` |
//! | or each step is taken by itself, on many machines | `work` |
//!
//! Files go to a [`TileStore`], which a shell provides; nothing here touches a file system.

pub mod city;
pub mod envelopes;
mod home;
pub mod input;
pub mod make;
pub mod maker;
pub mod mesh;
mod piece;
pub mod record;
pub mod run;
pub mod scenes;
pub mod terrain;
pub mod work;

use hsd_export::pieces::Pieces;
use std::io;

/// Where the files of a town are kept. Names are relative paths with `/`.
pub trait TileStore: Sync {
    /// Returns the bytes of a file; `None` if there is none.
    fn read(&self, name: &str) -> Option<Vec<u8>>;

    /// Returns true if there is a file.
    fn has(&self, name: &str) -> bool;

    /// Keeps a file, whole or not at all. One that is there already has the same bytes, and stays.
    ///
    /// # Errors
    /// If it cannot be written, or if the one that is there differs.
    fn commit(&self, name: &str, bytes: &Pieces) -> io::Result<()>;
}
