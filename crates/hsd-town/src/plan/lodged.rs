//! The features of a large town wait in a spool, tile by tile, while houses are made of those of one tile. A part of the town
//! is a tile with all outlines round it that what is made there can depend on; so parts give what the whole town gives.

use super::key::TileKey;
use super::shelves::Shelves;
use super::{LotId, Plan};
use crate::layer::{Lot, Lots};
use crate::neighbour::TOUCHING;
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, meet, wider};
use hsd_export::spool::NewSpool;
use hsd_ir::ast::town::Tiles;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::{Mutex, PoisonError};
use twox_hash::XxHash3_128;

/// Makes spools for the features of a town, and the number of features from which they are used.
#[derive(Clone, Copy)]
pub struct Lodging<'n> {
    /// Makes spools.
    pub new: NewSpool<'n>,
    /// Towns of fewer features are kept in memory.
    pub from: usize,
}

/// The shelves on which the keys of a layer lie while equal ones are looked for.
const KEY_SHELVES: usize = 64;

/// Puts features into spools.
pub(crate) struct Lodger {
    division: Tiles,
    shelves: Shelves,
    keys: Shelves,
    parts: Vec<LodgedTile>,
    known: BTreeMap<TileKey, usize>,
    next: BTreeMap<usize, u32>,
    packed: Vec<u8>,
}

/// A tile of features that wait.
#[derive(Clone, Debug)]
pub struct LodgedTile {
    /// Its name.
    pub key: TileKey,
    /// The number of its features.
    pub features: usize,
    /// The box of their geometry.
    pub bounds: Bounds,
}

/// Features that wait in a spool.
pub struct Lodged {
    shelves: Mutex<Shelves>,
    /// Its tiles, by number.
    pub tiles: Vec<LodgedTile>,
    /// The boxes of its tiles.
    index: Grid,
    /// The number of features.
    pub features: usize,
    /// The features of layers that no rule names, which do not wait there.
    pub unused: Vec<UnusedLot>,
    /// The keys that several features of a layer have.
    pub twice: BTreeMap<usize, BTreeSet<String>>,
}

/// A feature of a layer that no rule names.
pub struct UnusedLot {
    /// The layer, and the number there.
    pub id: LotId,
    /// The key.
    pub key: Box<str>,
    /// The centre.
    pub at: DVec2,
}

impl Lodger {
    pub(crate) fn new(new: NewSpool<'_>, division: &Tiles) -> io::Result<Lodger> {
        Ok(Lodger {
            division: division.clone(),
            shelves: Shelves::new(new)?,
            keys: Shelves::new(new)?,
            parts: vec![],
            known: BTreeMap::new(),
            next: BTreeMap::new(),
            packed: vec![],
        })
    }

    /// Adds a feature of a layer; those of a layer come in their order.
    pub(crate) fn add(&mut self, number: usize, layer: &Lots, mut lot: Lot) -> io::Result<()> {
        let key = TileKey::of(layer, &lot, &self.division);
        let next = self.next.entry(number).or_default();
        lot.number = *next;
        *next += 1;
        let bounds = lot.shape.bounds();
        let part = *self.known.entry(key).or_insert_with_key(|key| {
            self.parts.push(LodgedTile {
                key: key.clone(),
                features: 0,
                bounds,
            });
            self.parts.len() - 1
        });
        let tile = &mut self.parts[part];
        tile.features += 1;
        tile.bounds = around(tile.bounds, bounds);
        self.packed.clear();
        lot.pack(number, &mut self.packed);
        self.shelves.push(part, &self.packed)?;
        let own = XxHash3_128::oneshot(lot.key.as_bytes()) as usize % KEY_SHELVES;
        let own = number * KEY_SHELVES + own;
        self.keys.push(own, &(lot.key.len() as u64).to_le_bytes())?;
        self.keys.push(own, lot.key.as_bytes())
    }

    pub(crate) fn finish(mut self) -> io::Result<Lodged> {
        let mut twice: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
        for shelf in 0..self.keys.len() {
            let equal = equal(&self.keys.read(shelf)?)?;
            if !equal.is_empty() {
                twice.entry(shelf / KEY_SHELVES).or_default().extend(equal);
            }
        }
        self.shelves.flush()?;
        Ok(Lodged {
            shelves: Mutex::new(self.shelves),
            features: self.parts.iter().map(|tile| tile.features).sum(),
            index: Grid::new(self.parts.iter().map(|tile| tile.bounds).collect()),
            tiles: self.parts,
            unused: vec![],
            twice,
        })
    }
}

/// Returns the texts that are more than once among these, each led by its length.
fn equal(mut bytes: &[u8]) -> io::Result<Vec<String>> {
    let mut all: Vec<&[u8]> = vec![];
    while let Some((length, rest)) = bytes.split_first_chunk::<8>() {
        let length = u64::from_le_bytes(*length) as usize;
        let short = || io::Error::from(io::ErrorKind::UnexpectedEof);
        let (text, rest) = rest.split_at_checked(length).ok_or_else(short)?;
        all.push(text);
        bytes = rest;
    }
    all.sort_unstable();
    let twice = all.windows(2).filter(|two| two[0] == two[1]);
    let mut twice: Vec<&[u8]> = twice.map(|two| two[0]).collect();
    twice.dedup();
    let text = |text: &[u8]| String::from_utf8_lossy(text).into_owned();
    Ok(twice.into_iter().map(text).collect())
}

impl std::fmt::Debug for Lodged {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} features in {} tiles",
            self.features,
            self.tiles.len()
        )
    }
}

impl Lodged {
    /// Calls `see` with the features of all tiles, in any order.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn each(&self, see: &mut dyn FnMut(&Lot)) -> io::Result<()> {
        for tile in 0..self.tiles.len() {
            self.read(tile)?.iter().for_each(|(_, lot)| see(lot));
        }
        Ok(())
    }

    /// Returns the part of a town that the houses of a tile depend on, with the features of the tile.
    pub(super) fn part(&self, plan: &Plan, number: usize) -> io::Result<(Plan, Vec<LotId>)> {
        let own = self.read(number)?;
        let mut bounds = self.tiles[number].bounds;
        let mut others: BTreeMap<usize, Vec<(usize, Lot)>> = BTreeMap::new();
        // What touches a house has a front, which depends on the houses before it.
        let wide = plan.beside();
        for far in [TOUCHING, wide] {
            let reach = wider(bounds, far);
            for n in self.index.near(reach).into_iter().map(|n| n as usize) {
                if n != number && !others.contains_key(&n) {
                    others.insert(n, self.read(n)?);
                }
            }
            let lots = others.values().flatten();
            let near = lots.map(|(_, lot)| lot.shape.bounds());
            let near = near.filter(|own| meet(*own, reach));
            bounds = match far < wide {
                true => near.fold(bounds, around),
                false => reach,
            };
        }
        let here = own.len();
        let lots = own.into_iter().map(|lot| (true, lot));
        let round = others.into_values().flatten();
        let round =
            round.filter(|(_, lot)| lot.shape.ring().is_some() && meet(lot.shape.bounds(), bounds));
        let mut all: Vec<(bool, (usize, Lot))> =
            lots.chain(round.map(|lot| (false, lot))).collect();
        all.sort_by_key(|(_, (layer, lot))| (*layer, lot.number));
        let mut layers: Vec<Lots> = plan.layers.iter().map(Lots::head).collect();
        let mut ids = Vec::with_capacity(here);
        for (is_own, (layer, lot)) in all {
            if is_own {
                ids.push((layer, layers[layer].lots.len()));
            }
            layers[layer].lots.push(lot);
        }
        Ok((plan.with_layers(layers), ids))
    }

    /// Reads the features of a tile, with the numbers of their layers.
    fn read(&self, tile: usize) -> io::Result<Vec<(usize, Lot)>> {
        let bytes = self
            .shelves
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .read(tile)?;
        let mut rest = &bytes[..];
        let mut lots = Vec::with_capacity(self.tiles[tile].features);
        while !rest.is_empty() {
            lots.push(Lot::unpack(&mut rest)?);
        }
        Ok(lots)
    }
}

fn around([a, b]: Bounds, [c, d]: Bounds) -> Bounds {
    [a.min(c), b.max(d)]
}

impl Plan {
    /// Lets its features wait in a spool, those left out that wait there already.
    pub(crate) fn lodge(&mut self, mut lodger: Lodger) -> io::Result<()> {
        let (mut twice, mut unused) = (BTreeMap::new(), vec![]);
        for number in 0..self.layers.len() {
            if !self.is_ruled(number) {
                twice.insert(number, self.keys_of_several(number));
                let lots = std::mem::take(&mut self.layers[number].lots).into_iter();
                let lots = lots.filter(|_| self.is_counted(number));
                unused.extend(lots.map(|lot| UnusedLot {
                    id: (number, lot.number as usize),
                    at: lot.shape.centre(),
                    key: lot.key,
                }));
                continue;
            }
            let lots = std::mem::take(&mut self.layers[number].lots);
            for lot in lots {
                lodger.add(number, &self.layers[number], lot)?;
            }
        }
        let mut lodged = lodger.finish()?;
        lodged.twice.extend(twice);
        lodged.unused = unused;
        self.lodged = Some(lodged);
        Ok(())
    }
}
