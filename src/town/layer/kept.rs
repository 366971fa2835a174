//! Maps that were read before, for programs that look at a town again and again while it is written.

use super::Raw;
use crate::ast::town::Layer;
use crate::source::World;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The number of features kept in all; larger maps are read again.
const ROOM: usize = 300_000;

/// Maps that were read before, each as long as its files stay as they were. A copy shares them.
#[derive(Clone, Debug, Default)]
pub struct KeptMaps {
    maps: Arc<Mutex<BTreeMap<MapKey, KeptMap>>>,
}

/// What a map is read from: its path, and what its `Layer` says of how it is to be read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::town) struct MapKey {
    path: String,
    said: [Option<String>; 3],
}

#[derive(Debug)]
struct KeptMap {
    stamp: u64,
    raw: Arc<Raw>,
}

impl KeptMaps {
    pub(in crate::town) fn key(path: &str, layer: &Layer) -> MapKey {
        let said = [&layer.layer, &layer.encoding, &layer.crs];
        MapKey {
            path: path.to_owned(),
            said: said.map(|said| said.as_ref().map(|s| s.value.clone())),
        }
    }

    /// Returns a map whose files have not changed since it was read.
    pub(in crate::town) fn find(&self, key: &MapKey, world: &dyn World) -> Option<Arc<Raw>> {
        let stamp = world.stamp(&key.path)?;
        let maps = self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = maps.get(key).filter(|kept| kept.stamp == stamp)?;
        Some(kept.raw.clone())
    }

    /// Keeps a map that was read when its files had this stamp, if there is room for it.
    pub(in crate::town) fn keep(&self, key: MapKey, stamp: Option<u64>, raw: &Arc<Raw>) {
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
}
