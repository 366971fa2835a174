//! The meshes of some houses, each made once, as drafts. Those of parts and rows are shared with other houses.

pub(super) mod bank;
pub(super) mod draft;
pub(super) mod from_afar;
pub(super) mod look;
mod part_images;

use super::hasher::NumberHasher;
use super::mesh::{Bodies, Soup};
use super::weather::Weather;
use super::weather::panel_look::PanelLook;
use crate::roof::bulk::Bulk;
use crate::roof::{self, is_minor};
use crate::store::from_afar::{FromAfar, Stripe};
use crate::trim;
use crate::trim::{Body, Row};
use bank::Bank;
use draft::{ImageQuad, MeshDraft};
use glam::DVec2;
use hsd_ir::catalog::{PartDef, PartId};
use hsd_ir::material::SurfaceId;
use hsd_scene::texture::palette;
use hsd_scene::{Detail, MeshId};
use look::{Look, Share, Shown, colour_of};
use part_images::ShadedImage;
use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::rc::Rc;
use std::sync::Arc;

/// The key of a mesh. Lengths in tenths of a millimetre.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Key {
    /// A part of the catalogue.
    Part(PartKey),
    /// A part texture: number, width, height, share of reflection.
    Picture([u32; 4]),
    /// A post: side, height, 1 if it has a base stone and 2 if that lies in a curb, 1 if it is round, and its surface.
    Post([u32; 5]),
    /// A horizontal member: kind, length, mitres of its ends.
    Member(u8, u32, [i32; 2]),
    /// A stone before doors: its length.
    Step(u32),
    /// A row of tiles or rafters.
    Row(Row),
}

/// The key of a part's mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct PartKey {
    pub(super) part: u16,
    pub(super) around: SurfaceId,
    pub(super) share: Share,
    /// Width, height, foot and top of the opening.
    pub(super) size: [u32; 4],
    /// Half the width of a post written in the source file; 0 = the default.
    pub(super) post: u32,
    /// The depth available for a passage, for parts that have one.
    pub(super) room: u32,
    /// True for wing walls that stand on the ground.
    pub(super) grounded: bool,
    /// The texture on the part, counted from 1; 0 = none.
    pub(super) picture: u32,
}

/// Converts a length from metres to tenths of a millimetre.
pub(super) fn tenths(metres: f64) -> u32 {
    // The cast cuts off what is below zero; `round` would be a call of its own on most machines.
    (metres * 10_000.0 + 0.5) as u32
}

/// Distance of panes behind the image of their frame, metres.
const BEHIND: f64 = 0.010;

/// How far the mean colour of a stripe may be from that of its texture to show it, as a share.
const NEARLY: f32 = 0.06;

/// The meshes of some houses. The [`MeshId`]s it gives are indices into its drafts.
#[derive(Debug)]
pub(super) struct Store<'b> {
    bank: &'b Bank,
    drafts: Vec<Arc<MeshDraft>>,
    detail: Detail,
    /// True if images are those of a town.
    town: bool,
    /// The weather that applies to the meshes under construction.
    pub(super) weather: Weather,
    cache: HashMap<(Key, Weather), MeshId, BuildHasherDefault<NumberHasher>>,
    /// The most recently requested part.
    last: Option<(PartKey, Weather, MeshId)>,
    /// The part last seen from afar: a plain house has one kind of wall, and the bank would be locked for each unit of it.
    last_afar: RefCell<Option<(PartId, Option<Rc<FromAfar>>)>>,
}

impl<'b> Store<'b> {
    /// Creates an empty store for meshes of this detail, with images for a town or for a house.
    pub(super) fn new((detail, town): (Detail, bool), bank: &'b Bank) -> Store<'b> {
        Store {
            bank,
            drafts: vec![],
            detail,
            town,
            weather: Weather::None,
            cache: HashMap::default(),
            last: None,
            last_afar: RefCell::default(),
        }
    }

    /// Returns the mesh of a key, made on first use.
    pub(super) fn mesh(&mut self, key: Key, make: impl FnOnce(&mut Self) -> MeshDraft) -> MeshId {
        let key = (key, self.weather);
        if let Some(id) = self.cache.get(&key) {
            return *id;
        }
        let draft = self.bank.draft(&key).unwrap_or_else(|| {
            let draft = Arc::new(make(self));
            self.bank.keep(key.clone(), &draft);
            draft
        });
        self.known(key, draft)
    }

    /// Adds an unshared mesh.
    pub(super) fn push(&mut self, draft: MeshDraft) -> MeshId {
        self.add(Arc::new(draft))
    }

    fn add(&mut self, draft: Arc<MeshDraft>) -> MeshId {
        self.drafts.push(draft);
        MeshId(self.drafts.len() as u32 - 1)
    }

    fn known(&mut self, key: (Key, Weather), draft: Arc<MeshDraft>) -> MeshId {
        let id = self.add(draft);
        self.cache.insert(key, id);
        id
    }

    /// Returns the mesh of bodies, made on first use of the key. Different weather with the same result shares one
    /// mesh.
    fn aged(
        &mut self,
        key: Key,
        make: impl FnOnce(&Self) -> Bodies,
        looks: impl FnOnce(&Self, &Bodies) -> Vec<PanelLook>,
        finish: impl FnOnce(&mut Self, Bodies, Vec<PanelLook>) -> MeshDraft,
    ) -> MeshId {
        let key = (key, self.weather);
        if let Some(id) = self.cache.get(&key) {
            return *id;
        }
        if let Some(draft) = self.bank.draft(&key) {
            return self.known(key, draft);
        }
        let bodies = make(self);
        let looks = looks(self, &bodies);
        let by_look = (self.weather != Weather::None).then(|| {
            let surfaces = self.weather.aged_surfaces(&bodies);
            (key.0.clone(), (surfaces, looks.clone()))
        });
        let worn = by_look.as_ref().and_then(|key| self.bank.worn(key));
        let draft = worn.unwrap_or_else(|| {
            let draft = Arc::new(finish(self, bodies, looks));
            if let Some(key) = by_look {
                self.bank.keep_worn(key, &draft);
            }
            draft
        });
        self.bank.keep(key.clone(), &draft);
        self.known(key, draft)
    }

    /// Returns the mesh of bodies that are no part, made on first use of the key.
    pub(super) fn bodies(&mut self, key: Key, name: &str, make: impl FnOnce() -> Bodies) -> MeshId {
        let looks = |store: &Self, bodies: &Bodies| store.own_looks(&bodies.panels);
        self.aged(
            key,
            |_| make(),
            looks,
            |store, bodies, looks| {
                let images = store.panel_images(&bodies.panels, &looks);
                store.finish_with(name.to_owned(), bodies, &images, (Share::default(), None))
            },
        )
    }

    /// Returns the mesh of a part.
    pub(super) fn part(&mut self, id: PartId, part: &PartDef, key: PartKey) -> MeshId {
        debug_assert_eq!(id.0, key.part);
        // A row mostly goes on with the part before.
        let same = |last: &(PartKey, Weather, MeshId)| last.0 == key && last.1 == self.weather;
        if let Some((.., mesh)) = self.last.filter(same) {
            return mesh;
        }
        let make = |store: &Self| store.part_bodies(part, key);
        let looks = |store: &Self, bodies: &Bodies| store.part_looks(part, key, bodies);
        let mesh = self.aged(Key::Part(key), make, looks, |store, bodies, looks| {
            let images = store.part_images(part, key, &bodies, looks);
            let (name, picture) = (part.code().trim_end(), key.picture.checked_sub(1));
            store.finish_with(name.to_owned(), bodies, &images, (key.share, picture))
        });
        self.last = Some((key, self.weather, mesh));
        mesh
    }

    /// Converts bodies to a mesh; their glass reflects this share.
    pub(super) fn finish(&self, name: String, bodies: Bodies, share: Share) -> MeshDraft {
        let looks = self.own_looks(&bodies.panels);
        let images = self.panel_images(&bodies.panels, &looks);
        self.finish_with(name, bodies, &images, (share, None))
    }

    /// As [`Store::finish`], with images of the panels and for bodies that show this part texture.
    fn finish_with(
        &self,
        name: String,
        bodies: Bodies,
        images: &[ShadedImage],
        (share, picture): (Share, Option<u32>),
    ) -> MeshDraft {
        let Bodies {
            mut soups,
            panels,
            shown,
            ..
        } = bodies;
        soups = self.weather.wear(soups);
        let mut quads = vec![];
        for (panel, (image, shade)) in panels.iter().zip(images) {
            for (glass, shares) in &image.panes {
                let rect = panel.rect.part(*shares);
                let at = soups.iter().position(|(id, _)| id == glass);
                let at = at.unwrap_or_else(|| {
                    soups.push((*glass, Soup::default()));
                    soups.len() - 1
                });
                let metres = [[rect.x0, rect.z0], [rect.x1, rect.z1]];
                let uv = metres.map(|corner| corner.map(|t| t as f32));
                soups[at].1.front(rect, panel.front - BEHIND, uv);
            }
            quads.extend(image.baked.clone().map(|image| ImageQuad {
                image,
                rect: panel.rect,
                front: panel.front,
                shade: *shade,
            }));
        }
        let of_surface = |(id, soup)| (Look::surface(id, share), soup);
        let mut looks: Vec<(Look, Soup)> = soups.into_iter().map(of_surface).collect();
        if let Some(number) = picture.filter(|_| !shown.indices.is_empty()) {
            looks.push((Look::Picture(number, share), shown));
        }
        MeshDraft::new(name, looks, quads)
    }

    /// Adds one mesh of solids and their trim; `None` if there are none.
    pub(super) fn solids(&mut self, name: &str, bulk: &Bulk<'_>, worn: &[Body]) -> Option<MeshId> {
        let flat = self.detail == Detail::Body;
        let [mut soups, minor] = roof::soups(bulk, |finish| flat && is_minor(finish));
        trim::pour(worn, &mut soups);
        let mut looks = looks(self.weather.wear(soups));
        if flat {
            looks.extend(coloured(self.weather.wear(minor)));
        }
        if looks.is_empty() {
            return None;
        }
        let name = name.to_owned();
        Some(self.push(match flat {
            true => MeshDraft::part(name, looks),
            false => MeshDraft::new(name, looks, vec![]),
        }))
    }

    /// Returns the mesh of a row of bodies in this direction.
    pub(super) fn row(&mut self, row: Row, right: DVec2) -> MeshId {
        let own = self.weather;
        self.weather = own.turned(right);
        let mesh = self.mesh(Key::Row(row.clone()), |store| {
            let (mut soups, bodies) = (vec![], row.bodies().collect::<Vec<_>>());
            trim::pour(&bodies, &mut soups);
            let looks = looks(store.weather.wear(soups));
            MeshDraft::new(row.name.to_owned(), looks, vec![])
        });
        self.weather = own;
        mesh
    }

    /// Returns a mesh.
    pub(super) fn draft(&self, id: MeshId) -> &MeshDraft {
        &self.drafts[id.0 as usize]
    }

    /// Returns what a part shows from afar; `None` if it has nothing of its own.
    pub(super) fn afar(&self, id: PartId, part: &PartDef) -> Option<Rc<FromAfar>> {
        let mut last = self.last_afar.borrow_mut();
        match &*last {
            Some((known, afar)) if *known == id => afar.clone(),
            _ => {
                let afar = self.bank.afar(id, part).map(Rc::new);
                *last = Some((id, afar.clone()));
                afar
            }
        }
    }

    /// Returns the look of a surface weathered at a height.
    pub(super) fn surface_at(&self, id: SurfaceId, z: f64) -> Look {
        Look::surface(self.weather.at(id, z), Share::default())
    }

    /// Returns the mean colour, linear RGB, of a surface weathered at a height.
    pub(super) fn colour_at(&self, id: SurfaceId, z: f64) -> [f32; 3] {
        colour_of(self.weather.at(id, z))
    }

    /// Returns how a stripe of a mean colour, linear RGB, looks from afar, weathered at a height.
    pub(super) fn seen_at(&self, stripe: &Stripe, mean: [f32; 3], z: f64) -> Shown {
        let aged = self.weather.at(stripe.surface, z);
        let now = colour_of(aged);
        let near = (0..3).all(|k| (mean[k] / now[k].max(1e-3) - 1.0).abs() < NEARLY);
        match (stripe.textured, aged.surface().glass) {
            (true, true) => Shown::of(Look::toned(aged, mean)),
            (true, false) if near => Shown::of(Look::surface(aged, Share::default())),
            _ => Shown {
                look: Look::Colours,
                place: Some(palette::place(mean)),
            },
        }
    }

    /// Returns the drafts by the ids given for them.
    pub(super) fn into_drafts(self) -> Vec<Arc<MeshDraft>> {
        self.drafts
    }
}

/// Returns surfaces in their mean colours, as one soup; nothing if there are none.
fn coloured(soups: Vec<(SurfaceId, Soup)>) -> Option<(Look, Soup)> {
    let of = |(id, mut soup): (SurfaceId, Soup)| {
        soup.uvs.fill(palette::place(colour_of(id)));
        soup
    };
    let mut soups = soups.into_iter().map(of);
    let first = soups.next()?;
    Some((Look::Colours, soups.fold(first, Soup::joined)))
}

/// Returns the looks of surfaces without reflection.
fn looks(soups: Vec<(SurfaceId, Soup)>) -> Vec<(Look, Soup)> {
    let look = |(id, soup)| (Look::surface(id, Share::default()), soup);
    soups.into_iter().map(look).collect()
}
