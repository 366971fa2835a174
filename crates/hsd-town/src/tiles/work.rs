//! A town in three steps, for engines that run on many machines: [`plan`] divides it into tiles and puts all that each needs
//! into a store; a [`Worker`] makes tiles, in any order, on any machine, again if need be; [`seal()`] puts the town together. Each
//! step is a function over files, whose names tell what is in them, so executions may be repeated and effects are not.
//!
//! | file | holds |
//! |---|---|
//! | `work.json` | the [`Manifest`], written last |
//! | `parts/*.part` | the features of a tile with what stands round them, or a piece of ground; what all share |
//! | `made/*.json` | what became of the features of a tile |
//! | `tiles/`, `textures/` | as those of the town |

mod seal;
mod worker;

pub use seal::seal;
pub use worker::{Finished, NotOpened, Trouble, Worker};

use super::TileStore;
use super::maker::{Maker, TileMeans};
use super::mesh::{TileKey, tiles};
use super::run::TileJob;
use super::terrain::{self, Patch};
use crate::stream::Closing;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::io;
use twox_hash::XxHash3_128;

/// The name of the manifest.
pub const MANIFEST: &str = "work.json";

/// The folders of a store of work.
pub const FOLDERS: [&str; 4] = ["made", "parts", "textures", "tiles"];

/// Counts up when the files of work change their form.
const FORM: u32 = 2;

/// The contents of a store of work.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Manifest {
    form: u32,
    /// The version of the program.
    pub program: String,
    /// The hash of the town file, its options and the program.
    town: String,
    /// The file of what all tiles share.
    head: String,
    /// The number of features.
    pub features: usize,
    /// What whoever planned the town asked for.
    pub asked: serde_json::Value,
    closing: Closing,
    /// Its tiles, then its pieces of ground, in their order.
    pub tiles: Vec<PlannedTile>,
}

/// A tile, or a piece of ground, to be made.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct PlannedTile {
    /// Its name.
    pub key: String,
    /// The number of its features: 0 for ground.
    pub features: usize,
    /// The bytes of its part: features and what stands round them.
    pub bytes: u64,
    /// The hash of all that it depends on.
    pub inputs: String,
    place: Place,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
enum Place {
    Cell(i64, i64),
    Named(String),
    Ground(i64, i64),
}

impl PlannedTile {
    /// Returns the name of its part.
    pub fn part(&self) -> String {
        format!("parts/{}-{}.part", self.key, self.inputs)
    }

    /// Returns the name of what became of its features.
    pub fn made(&self) -> String {
        format!("made/{}-{}.json", self.key, self.inputs)
    }
}

impl Manifest {
    /// Reads a manifest; `None` if it is none of this program.
    pub fn read(bytes: &[u8]) -> Option<Manifest> {
        let manifest: Manifest = serde_json::from_slice(bytes).ok()?;
        let own = manifest.form == FORM && manifest.program == env!("CARGO_PKG_VERSION");
        own.then_some(manifest)
    }

    /// Returns the names of all files that the work consists of, those of tiles left out.
    pub fn files(&self) -> impl Iterator<Item = String> {
        let tiles = self
            .tiles
            .iter()
            .flat_map(|tile| [tile.part(), tile.made()]);
        tiles.chain([self.head.clone()])
    }
}

fn named_by(hasher: &XxHash3_128) -> String {
    format!("{:016x}", hasher.finish_128() as u64)
}

/// Returns the hash of all that tiles depend on beside their parts.
fn base(means: &TileMeans<'_>, maker: &Maker<'_>) -> String {
    let mut hasher = XxHash3_128::new();
    hasher.write(maker.salt().bytes());
    let (parameters, year) = (&means.input.options.parameters, means.year);
    hasher.write(format!("{FORM} {parameters:?} {year:?}").as_bytes());
    hasher.write(means.input.source.text().as_bytes());
    named_by(&hasher)
}

/// Returns the hash of a part of a town.
fn inputs((town, head): (&str, &str), part: &[u8]) -> String {
    let mut hasher = XxHash3_128::new();
    for text in [town, head] {
        hasher.write(text.as_bytes());
    }
    hasher.write(part);
    named_by(&hasher)
}

/// Returns the name of what all parts share.
fn head_file(bytes: &[u8]) -> String {
    format!("parts/{:016x}.head", XxHash3_128::oneshot(bytes) as u64)
}

/// Plans a town whose features wait in a spool: puts the parts of its tiles into a store, its manifest last. `told` is called
/// with each tile when its part is there.
///
/// # Errors
/// Those of the store, of the spool and of `told`.
pub fn plan(
    job: &TileJob<'_>,
    asked: serde_json::Value,
    store: &dyn TileStore,
    told: &mut dyn FnMut(&PlannedTile) -> io::Result<()>,
) -> io::Result<Manifest> {
    let means = job.means();
    let town = base(&means, &Maker::new(means, store));
    let head = job.plan.pack_head();
    let head_file = head_file(&head);
    keep(store, &head_file, &head)?;
    let mut planned = vec![];
    let mut add = |key: String, features: usize, place: Place, part: Vec<u8>| {
        let tile = PlannedTile {
            key,
            features,
            bytes: part.len() as u64,
            inputs: inputs((&town, &head_file), &part),
            place,
        };
        keep(store, &tile.part(), &part)?;
        told(&tile)?;
        planned.push(tile);
        Ok::<(), io::Error>(())
    };
    for tile in tiles(job.plan, job.division) {
        let part = tile.with(job.plan, |part, lots, _| part.pack_part(lots))?;
        let place = match &tile.key {
            TileKey::Cell(east, north) => Place::Cell(*east, *north),
            TileKey::Named(name) => Place::Named(name.clone()),
        };
        add(tile.key.stem(), tile.features(), place, part)?;
    }
    let size = job.division.size;
    for cell in terrain::cells(job.plan, job.division)? {
        let Some(patch) = Patch::new(&job.plan.ground, cell, size) else {
            continue;
        };
        let (east, north) = cell;
        let low = DVec2::new(east as f64, north as f64) * size;
        let around = [low - size / 2.0, low + size * 1.5];
        let part = job.plan.pack_ground(around);
        add(patch.name(), 0, Place::Ground(east, north), part)?;
    }
    let manifest = Manifest {
        form: FORM,
        program: env!("CARGO_PKG_VERSION").to_owned(),
        town,
        head: head_file,
        features: job.plan.features(),
        asked,
        closing: Closing::of(job.plan),
        tiles: planned,
    };
    let mut json = serde_json::to_vec_pretty(&manifest)?;
    json.push(b'\n');
    store.commit(MANIFEST, &json.into())?;
    Ok(manifest)
}

/// Keeps a file whose name tells what is in it.
fn keep(store: &dyn TileStore, name: &str, bytes: &[u8]) -> io::Result<()> {
    match store.has(name) {
        true => Ok(()),
        false => store.commit(name, &bytes.to_vec().into()),
    }
}
