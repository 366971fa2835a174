//! Maps that were read before, for programs that look at a town again and again while it is written.

use super::{Raw, TownFrame};
use hsd_base::geometry::grid::Bounds;
use hsd_base::source::World;
use hsd_ir::ast::town::Layer;
use hsd_map::Fault;
use hsd_map::heights::Heights;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The number of features kept in all; larger maps are read again.
const ROOM: usize = 300_000;

/// The bytes of grids of heights kept in all.
const GROUND_ROOM: usize = 64 << 20;

/// Maps that were read before, each as long as its files stay as they were. A copy shares them.
#[derive(Clone, Debug, Default)]
pub struct KeptMaps {
    maps: Arc<Mutex<BTreeMap<MapKey, KeptMap>>>,
    grounds: Arc<Mutex<Vec<KeptGround>>>,
}

/// A grid of heights that was read before.
#[derive(Debug)]
struct KeptGround {
    key: MapKey,
    /// The plane, the origin and the part that was read.
    frame: String,
    stamp: u64,
    heights: Arc<Heights>,
}

/// What a map is read from: its path, and what its `Layer` says of how it is to be read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct MapKey {
    path: String,
    said: [Option<String>; 3],
}

#[derive(Debug)]
struct KeptMap {
    stamp: u64,
    raw: Arc<Raw>,
}

impl KeptMaps {
    pub(crate) fn key(path: &str, layer: &Layer) -> MapKey {
        let said = [&layer.layer, &layer.encoding, &layer.crs];
        MapKey {
            path: path.to_owned(),
            said: said.map(|said| said.as_ref().map(|s| s.value.clone())),
        }
    }

    /// Returns a map whose files have not changed since it was read.
    pub(crate) fn find(&self, key: &MapKey, world: &dyn World) -> Option<Arc<Raw>> {
        let stamp = world.stamp(&key.path)?;
        let maps = self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = maps.get(key).filter(|kept| kept.stamp == stamp)?;
        Some(kept.raw.clone())
    }

    /// Keeps a map that was read when its files had this stamp, if there is room for it.
    pub(crate) fn keep(&self, key: MapKey, stamp: Option<u64>, raw: &Arc<Raw>) {
        let (Some(stamp), size) = (stamp, raw.len()) else {
            return;
        };
        let mut maps = self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        maps.remove(&key);
        let others: usize = maps.values().map(|kept| kept.raw.len()).sum();
        if others + size > ROOM {
            maps.clear();
        }
        if size <= ROOM {
            let raw = raw.clone();
            maps.insert(key, KeptMap { stamp, raw });
        }
    }
    /// Returns a grid of heights that is kept, or reads and keeps it. `wide` is the part of the town's frame that is read.
    pub(crate) fn heights(
        &self,
        (world, path): (&dyn World, &str),
        layer: &Layer,
        (frame, wide): (&TownFrame, Bounds),
        read: impl FnOnce() -> Result<Arc<Heights>, Fault>,
    ) -> Result<Arc<Heights>, Fault> {
        let key = KeptMaps::key(path, layer);
        let part = format!("{} {:?} {wide:?}", frame.crs.name, frame.origin);
        let stamp = world.stamp(path);
        let lock = || self.grounds.lock().unwrap_or_else(PoisonError::into_inner);
        let own = key.clone();
        let is_this = |kept: &KeptGround| kept.key == own && kept.frame == part;
        let same = lock()
            .iter()
            .find(|kept| is_this(kept) && Some(kept.stamp) == stamp)
            .map(|kept| kept.heights.clone());
        if let Some(heights) = same {
            return Ok(heights);
        }
        let heights = read()?;
        let (Some(stamp), frame) = (stamp, part.clone()) else {
            return Ok(heights);
        };
        let mut kept = lock();
        kept.retain(|kept| !is_this(kept));
        let size = |all: &[KeptGround]| all.iter().map(|k| k.heights.bytes()).sum::<usize>();
        while !kept.is_empty() && size(&kept) + heights.bytes() > GROUND_ROOM {
            kept.remove(0);
        }
        if heights.bytes() <= GROUND_ROOM {
            let heights = heights.clone();
            kept.push(KeptGround {
                key,
                frame,
                stamp,
                heights,
            });
        }
        Ok(heights)
    }
}
