//! Stores the meshes and materials of the scene, each made once.

mod part_images;

use super::hasher::NumberHasher;
use super::mesh::{Bodies, Soup};
use super::weather::{AgedSurfaces, Weather};
use crate::building::Solid;
use crate::catalog::{PartDef, PartId};
use crate::material::SurfaceId;
use crate::scene::{Detail, Image, Material, MaterialId, Mesh, MeshId, Node, Primitive, Scene};
use crate::tessellate::bake::atlas::Atlas;
use crate::tessellate::roof::Given;
use crate::tessellate::trim;
use crate::tessellate::trim::{Body, Row};
use glam::DVec2;
use part_images::PanelImage;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::rc::Rc;

/// The key of a mesh. Lengths in tenths of a millimetre.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Key {
    /// A part of the catalogue.
    Part(PartKey),
    /// A part texture: number, width, height, share of reflection.
    Picture([u32; 4]),
    /// A post: side, height, 1 if it has a base stone, 1 if it is round, and its surface.
    Post([u32; 5]),
    /// A horizontal member: kind, length, mitres of its ends.
    Member(u8, u32, [i32; 2]),
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
    /// The texture on the part, counted from 1; 0 = none.
    pub(super) picture: u32,
}

/// Share of reflected light in thousandths; zero for surfaces that do not reflect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Share(pub(super) u16);

impl Share {
    /// Converts a share between 0 and 1.
    pub(super) fn new(share: f64) -> Share {
        Share((share.clamp(0.0, 1.0) * 1000.0).round() as u16)
    }

    fn value(self) -> f32 {
        f32::from(self.0) / 1000.0
    }
}

/// Converts a length from metres to tenths of a millimetre.
pub(super) fn tenths(metres: f64) -> u32 {
    // The cast cuts off what is below zero; `round` would be a call of its own on most machines.
    (metres * 10_000.0 + 0.5) as u32
}

/// Distance of panes behind the image of their frame, metres.
const BEHIND: f64 = 0.010;

/// The image or surface of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    Surface(SurfaceId, Share),
    Picture(u32, Share),
    Baked(u32),
}

/// Meshes and materials.
#[derive(Debug, Default)]
pub(super) struct Store {
    materials: Vec<Material>,
    meshes: Vec<Mesh>,
    atlas: Atlas,
    detail: Detail,
    looks: Vec<Look>,
    /// The weather that applies to the meshes under construction.
    pub(super) weather: Weather,
    cache: HashMap<(Key, Weather), MeshId, BuildHasherDefault<NumberHasher>>,
    /// Weathered meshes by result: the same surfaces on the same triangles.
    worn: HashMap<(Key, AgedSurfaces), MeshId>,
    /// Images of the panels of parts, by the key of the images and the weather.
    images: HashMap<(PartKey, Weather), Rc<[PanelImage]>>,
    /// The same by result.
    worn_images: HashMap<(PartKey, AgedSurfaces), Rc<[PanelImage]>>,
    /// The most recently requested part.
    last: Option<(PartKey, Weather, MeshId)>,
}

impl Store {
    /// Creates an empty store for meshes of this detail.
    pub(super) fn new(detail: Detail) -> Store {
        Store {
            detail,
            ..Store::default()
        }
    }

    /// Returns the mesh of a key, made on first use.
    pub(super) fn mesh(&mut self, key: Key, make: impl FnOnce(&mut Store) -> Mesh) -> MeshId {
        let key = (key, self.weather);
        if let Some(id) = self.cache.get(&key) {
            return *id;
        }
        let mesh = make(self);
        let id = self.push(mesh);
        self.cache.insert(key, id);
        id
    }

    /// Adds an unshared mesh.
    pub(super) fn push(&mut self, mesh: Mesh) -> MeshId {
        self.meshes.push(mesh);
        MeshId(self.meshes.len() as u32 - 1)
    }

    /// Returns the mesh of bodies, made on first use of the key. Different weather with the same result shares one
    /// mesh.
    fn aged(
        &mut self,
        key: Key,
        make: impl FnOnce() -> Bodies,
        finish: impl FnOnce(&mut Store, Bodies) -> Mesh,
    ) -> MeshId {
        let known = (key, self.weather);
        if let Some(id) = self.cache.get(&known) {
            return *id;
        }
        let bodies = make();
        let aged = (known.0.clone(), self.weather.aged_surfaces(&bodies));
        let id = match self.worn.get(&aged) {
            Some(id) => *id,
            None => {
                let mesh = finish(self, bodies);
                let id = self.push(mesh);
                self.worn.insert(aged, id);
                id
            }
        };
        self.cache.insert(known, id);
        id
    }

    /// Returns the mesh of bodies that are no part, made on first use of the key.
    pub(super) fn bodies(&mut self, key: Key, name: &str, make: impl FnOnce() -> Bodies) -> MeshId {
        self.aged(key, make, |store, bodies| {
            store.finish(name.to_owned(), bodies, Share::default())
        })
    }

    /// Returns the mesh of a part.
    pub(super) fn part(&mut self, id: PartId, part: &PartDef, key: PartKey) -> MeshId {
        debug_assert_eq!(id.0, key.part);
        // A row mostly goes on with the part before.
        let same = |last: &(PartKey, Weather, MeshId)| last.0 == key && last.1 == self.weather;
        if let Some((.., mesh)) = self.last.filter(same) {
            return mesh;
        }
        let detail = self.detail;
        let make = || key.bodies(part, detail);
        let mesh = self.aged(Key::Part(key), make, |store, bodies| {
            let images = store.part_images(part, key, &bodies);
            let (name, picture) = (part.code().trim_end(), key.picture.checked_sub(1));
            store.finish_with(name.to_owned(), bodies, &images, (key.share, picture))
        });
        self.last = Some((key, self.weather, mesh));
        mesh
    }

    /// Converts bodies to a mesh of the scene; their glass reflects this share.
    pub(super) fn finish(&mut self, name: String, bodies: Bodies, share: Share) -> Mesh {
        let images = self.panel_images(&bodies.panels);
        self.finish_with(name, bodies, &images, (share, None))
    }

    /// As [`Store::finish`], with images of the panels and for bodies that show this part texture.
    fn finish_with(
        &mut self,
        name: String,
        bodies: Bodies,
        images: &[PanelImage],
        (share, picture): (Share, Option<u32>),
    ) -> Mesh {
        let Bodies {
            mut soups,
            panels,
            shown,
        } = bodies;
        soups = self.weather.wear(soups);
        let mut pictures: Vec<(MaterialId, Soup)> = vec![];
        for (panel, image) in panels.iter().zip(images) {
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
            if let Some(spot) = image.spot {
                let material = self.baked(spot.page);
                let at = pictures.iter().position(|(id, _)| *id == material);
                let at = at.unwrap_or_else(|| {
                    pictures.push((material, Soup::default()));
                    pictures.len() - 1
                });
                pictures[at].1.front(panel.rect, panel.front, spot.uv);
            }
        }
        let mut primitives: Vec<Primitive> = Vec::with_capacity(soups.len() + pictures.len());
        for (finish, soup) in soups {
            let material = self.surface(finish, share);
            primitives.push(primitive(material, soup));
        }
        if let Some(number) = picture.filter(|_| !shown.indices.is_empty()) {
            let material = self.picture(number, share);
            primitives.push(primitive(material, shown));
        }
        primitives.extend(
            pictures
                .into_iter()
                .map(|(material, soup)| primitive(material, soup)),
        );
        Mesh { name, primitives }
    }

    /// Adds one mesh of solids and their trim; `None` if there are none.
    pub(super) fn solids(
        &mut self,
        name: &str,
        solids: &[Solid],
        given: Given<'_>,
        worn: &[Body],
    ) -> Option<MeshId> {
        let mut soups = crate::tessellate::roof::soups(solids, given);
        trim::pour(worn, &mut soups);
        soups = self.weather.wear(soups);
        if soups.is_empty() {
            return None;
        }
        let primitives = soups.into_iter().map(|(finish, soup)| {
            let material = self.surface(finish, Share::default());
            primitive(material, soup)
        });
        let primitives = primitives.collect();
        let name = name.to_owned();
        Some(self.push(Mesh { name, primitives }))
    }

    /// Returns the mesh of a row of bodies in this direction.
    pub(super) fn row(&mut self, row: Row, right: DVec2) -> MeshId {
        let own = self.weather;
        self.weather = own.turned(right);
        let mesh = self.mesh(Key::Row(row.clone()), |store| {
            let (mut soups, bodies) = (vec![], row.bodies().collect::<Vec<_>>());
            trim::pour(&bodies, &mut soups);
            let soups = store.weather.wear(soups);
            let primitives = soups.into_iter().map(|(finish, soup)| {
                let material = store.surface(finish, Share::default());
                primitive(material, soup)
            });
            Mesh {
                name: row.name.to_owned(),
                primitives: primitives.collect(),
            }
        });
        self.weather = own;
        mesh
    }

    /// Returns the material of a surface weathered at a height.
    pub(super) fn surface_at(&mut self, id: SurfaceId, z: f64) -> MaterialId {
        self.surface(self.weather.at(id, z), Share::default())
    }

    /// Returns the material of a surface; surfaces other than glass share one for every share of reflection.
    pub(super) fn surface(&mut self, id: SurfaceId, share: Share) -> MaterialId {
        let surface = id.surface();
        let share = if surface.glass {
            share
        } else {
            Share::default()
        };
        let detail = self.detail;
        self.material(Look::Surface(id, share), || Material {
            name: match share.0 {
                0 => surface.name.to_owned(),
                per_mille => format!("{} {}.{}%", surface.name, per_mille / 10, per_mille % 10),
            },
            image: surface.picture.map_or(Image::None, Image::Surface),
            tint: match surface.glass && detail <= Detail::Flat {
                true => shut(surface.tint),
                false => surface.tint,
            },
            roughness: surface.roughness,
            metallic: surface.metallic,
            double_sided: surface.thin,
            cutout: false,
            reflection: surface.glass.then(|| share.value()),
            mirrored: None,
        })
    }

    /// Returns the material of a part texture.
    pub(super) fn picture(&mut self, number: u32, share: Share) -> MaterialId {
        self.material(Look::Picture(number, share), || Material {
            name: match share.0 {
                0 => format!("picture {}", number + 1),
                n => format!("picture {} {}.{}%", number + 1, n / 10, n % 10),
            },
            image: Image::Picture(number),
            tint: [1.0; 4],
            roughness: if share.0 == 0 { 0.8 } else { 0.3 },
            metallic: 0.0,
            double_sided: false,
            cutout: false,
            reflection: (share.0 > 0).then(|| share.value()),
            mirrored: None,
        })
    }

    /// Returns the finished scene, with the pages cropped to their used height.
    pub(super) fn into_scene(mut self, nodes: Vec<Node>, pictures: Vec<String>) -> Scene {
        let (baked, grown) = self.atlas.finish();
        for primitive in self.meshes.iter_mut().flat_map(|m| &mut m.primitives) {
            if let Look::Baked(page) = self.looks[primitive.material.0 as usize] {
                let grown = grown[page as usize];
                for [_, v] in &mut primitive.uvs {
                    *v = 1.0 - (1.0 - *v) * grown;
                }
            }
        }
        Scene {
            materials: self.materials,
            meshes: self.meshes,
            nodes,
            pictures,
            baked,
            mirrored: vec![],
        }
    }

    /// Returns the material of a page of baked images.
    fn baked(&mut self, page: u32) -> MaterialId {
        let cutout = self.atlas.has_holes(page);
        self.material(Look::Baked(page), || Material {
            name: format!("joinery {}", page + 1),
            image: Image::Baked(page),
            tint: [1.0; 4],
            roughness: 1.0,
            metallic: 1.0,
            double_sided: false,
            cutout,
            reflection: None,
            mirrored: None,
        })
    }

    fn material(&mut self, look: Look, make: impl FnOnce() -> Material) -> MaterialId {
        let at = self.looks.iter().position(|l| *l == look);
        let at = at.unwrap_or_else(|| {
            self.looks.push(look);
            self.materials.push(make());
            self.looks.len() - 1
        });
        MaterialId(at as u32)
    }
}

/// Returns the colour of glass in front of a dark room, for details without interiors: it is opaque.
fn shut([r, g, b, opacity]: [f32; 4]) -> [f32; 4] {
    const DUSK: f32 = 0.035;
    let [r, g, b] = [r, g, b].map(|c| c * opacity + DUSK * (1.0 - opacity));
    [r, g, b, 1.0]
}

/// Converts a soup to a primitive of its material.
pub(super) fn primitive(material: MaterialId, soup: Soup) -> Primitive {
    let Soup {
        positions,
        normals,
        uvs,
        indices,
    } = soup;
    Primitive {
        material,
        positions,
        normals,
        uvs,
        mirror_uvs: vec![],
        indices,
    }
}
