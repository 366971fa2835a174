//! What the houses of a run share: drafts of parts and rows, and baked images. Any thread may take from it and add to it.
//!
//! Everything in it depends on its key alone, so it makes no difference who made it, or whether it was forgotten and
//! made again. It is bounded: at a limit it forgets all.

use crate::hasher::NumberHasher;
use crate::store::draft::MeshDraft;
use crate::store::from_afar::{self, FromAfar};
use crate::store::part_images::PanelImage;
use crate::store::{Key, PartKey};
use crate::weather::panel_look::{PanelAreas, PanelLook};
use crate::weather::{AgedSurfaces, Weather};
use hsd_ir::catalog::{PartDef, PartId};
use hsd_ir::material::SurfaceId;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// The most that drafts may take, bytes.
const MOST: usize = 48 << 20;

/// What an entry takes besides its arrays, bytes.
const ENTRY: usize = 512;

/// The most images, and the most parts, that the bank knows.
const MOST_ENTRIES: usize = 1 << 14;

/// Drafts and images that several houses use.
#[derive(Debug, Default)]
pub(crate) struct Bank {
    drafts: Mutex<Drafts>,
    images: Shelf<ImageKey, Arc<PanelImage>>,
    areas: Shelf<PartKey, Arc<[PanelAreas]>>,
    from_afar: Shelf<PartId, Option<FromAfar>>,
}

/// The key of an image: the part, the number of its panel, and what stands for its weathered surfaces.
pub(super) type ImageKey = (PartKey, usize, Vec<(SurfaceId, SurfaceId)>);

/// The visible result of weather: aged surfaces of triangles, and looks of panels.
pub(super) type AgedLook = (AgedSurfaces, Vec<PanelLook>);

/// Values by key, each made on first use; others who need it meanwhile wait for it.
#[derive(Debug)]
struct Shelf<K, V>(Mutex<HashMap<K, Arc<OnceLock<V>>>>);

impl<K, V> Default for Shelf<K, V> {
    fn default() -> Shelf<K, V> {
        Shelf(Mutex::default())
    }
}

impl<K: Eq + Hash, V: Clone> Shelf<K, V> {
    fn get(&self, key: K, make: impl FnOnce() -> V) -> V {
        let cell = {
            let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            if all.len() >= MOST_ENTRIES {
                all.clear();
            }
            all.entry(key).or_default().clone()
        };
        cell.get_or_init(make).clone()
    }
}

#[derive(Debug, Default)]
struct Drafts {
    by_weather: HashMap<(Key, Weather), Arc<MeshDraft>, BuildHasherDefault<NumberHasher>>,
    /// Weathered drafts by result: the same surfaces on the same triangles, the same looks of panels.
    by_look: HashMap<(Key, AgedLook), Arc<MeshDraft>>,
    size: usize,
}

impl Bank {
    /// Returns the draft of a key as weathered.
    pub(super) fn draft(&self, key: &(Key, Weather)) -> Option<Arc<MeshDraft>> {
        self.drafts().by_weather.get(key).cloned()
    }

    /// Returns the draft of a key with this look.
    pub(super) fn worn(&self, key: &(Key, AgedLook)) -> Option<Arc<MeshDraft>> {
        self.drafts().by_look.get(key).cloned()
    }

    /// Keeps a draft.
    pub(super) fn keep(&self, key: (Key, Weather), draft: &Arc<MeshDraft>) {
        let mut drafts = self.drafts();
        drafts.count(draft);
        drafts.by_weather.insert(key, draft.clone());
    }

    /// Keeps a draft by its look.
    pub(super) fn keep_worn(&self, key: (Key, AgedLook), draft: &Arc<MeshDraft>) {
        let mut drafts = self.drafts();
        drafts.count(draft);
        drafts.by_look.insert(key, draft.clone());
    }

    /// Returns the image of a key.
    pub(super) fn image(
        &self,
        key: ImageKey,
        make: impl FnOnce() -> Arc<PanelImage>,
    ) -> Arc<PanelImage> {
        self.images.get(key, make)
    }

    /// Returns the areas of a part's panels.
    pub(super) fn areas(
        &self,
        key: PartKey,
        make: impl FnOnce() -> Arc<[PanelAreas]>,
    ) -> Arc<[PanelAreas]> {
        self.areas.get(key, make)
    }

    /// Returns what a part shows from afar.
    pub(super) fn afar(&self, id: PartId, part: &PartDef) -> Option<FromAfar> {
        self.from_afar.get(id, || from_afar::of(part))
    }

    fn drafts(&self) -> MutexGuard<'_, Drafts> {
        self.drafts.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drafts {
    /// Makes room for a draft.
    fn count(&mut self, draft: &MeshDraft) {
        self.size += ENTRY + draft.size();
        if self.size > MOST {
            *self = Drafts {
                size: ENTRY + draft.size(),
                ..Drafts::default()
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;
    use crate::store::look::{Look, Share};

    /// A draft of about a megabyte.
    fn draft() -> Arc<MeshDraft> {
        let soup = Soup {
            positions: vec![[0.0; 3]; 1 << 15],
            ..Soup::default()
        };
        let look = Look::surface(SurfaceId::named("cedar"), Share::default());
        Arc::new(MeshDraft::new(String::new(), vec![(look, soup)], vec![]))
    }

    #[test]
    fn the_bank_is_bounded() {
        let (bank, draft) = (Bank::default(), draft());
        let key = |n: u32| (Key::Post([n; 5]), Weather::None);
        for n in 0..200 {
            bank.keep(key(n), &draft);
            assert!(bank.drafts().size <= MOST);
            assert!(bank.draft(&key(n)).is_some());
        }
        assert!(bank.draft(&key(0)).is_none());
    }
}
