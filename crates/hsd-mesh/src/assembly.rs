//! Puts drafts together as a scene: numbers meshes and materials in the order of first use, keeps one mesh of equal drafts
//! and places baked images on pages.
//!
//! Houses come in their order, however many threads made them, so the scene does not depend on threads.

mod terrain;

pub use terrain::{GroundMesh, ground};

use crate::bake::atlas::{Atlas, Spot};
use crate::mesh::Soup;
use crate::store::draft::{BakedImage, Digest, ImageQuad, MeshDraft};
use crate::store::look::{Look, of_page};
use hsd_base::source::Span;
use hsd_scene::{Baked, Detail, Image, Material, MaterialId, Mesh, MeshId, Node, NodeId};
use hsd_scene::{Primitive, Scene, ScenePart};
use std::collections::HashMap;
use std::sync::Arc;

/// Some houses, ready to be added to a scene.
#[derive(Debug)]
pub struct HouseDrafts {
    /// The nodes in preorder; their parents count from the first of them, their meshes in `drafts`.
    pub(crate) nodes: Vec<Node>,
    pub(crate) drafts: Vec<Arc<MeshDraft>>,
    /// The size of drafts that have become parts of these, bytes.
    pub(crate) joined: usize,
    /// The houses left out, since they would show too many triangles: their numbers among these, and their places.
    pub(crate) oversized: Vec<(usize, Span)>,
}

impl HouseDrafts {
    /// Returns the nodes of the houses.
    pub fn nodes_mut(&mut self) -> impl Iterator<Item = &mut Node> {
        self.nodes.iter_mut()
    }

    /// Takes the houses left out, since they would show too many triangles: their numbers among these, and their places.
    pub fn take_oversized(&mut self) -> Vec<(usize, Span)> {
        std::mem::take(&mut self.oversized)
    }

    /// Returns about how many bytes of memory it took to make them.
    pub fn bytes(&self) -> usize {
        let drafts = self.drafts.iter().map(|draft| draft.size());
        drafts.sum::<usize>() + self.joined + self.nodes.len() * size_of::<Node>()
    }
}

/// A scene in the making.
#[derive(Debug)]
pub struct SceneBuilder {
    scene: Scene,
    /// The numbers of the first mesh and the first node in `scene`.
    first_mesh: u32,
    first_node: u32,
    atlas: Atlas,
    materials: HashMap<Look, MaterialId>,
    /// The material of each page of the atlas in each shade.
    pages: HashMap<(u32, usize), MaterialId>,
    meshes: RecentMeshes,
    spots: HashMap<Digest, Spot>,
    /// True if meshes are not shared with houses that are forgotten.
    forgets_twins: bool,
}

impl SceneBuilder {
    /// Creates one for an empty scene.
    pub fn new(detail: Detail) -> SceneBuilder {
        SceneBuilder {
            scene: Scene {
                detail,
                ..Scene::default()
            },
            first_mesh: 0,
            first_node: 0,
            atlas: Atlas::default(),
            materials: HashMap::new(),
            pages: HashMap::new(),
            meshes: RecentMeshes::default(),
            spots: HashMap::new(),
            forgets_twins: false,
        }
    }

    /// Leaves the relief of baked pages out: they are seen from afar.
    #[must_use]
    pub fn without_relief(mut self) -> SceneBuilder {
        self.atlas.flat = true;
        self
    }

    /// From now on, houses share no mesh with those that are forgotten.
    pub fn forget_twins(&mut self) {
        self.forgets_twins = true;
    }

    /// Adds houses behind those that are there.
    pub fn add(&mut self, houses: HouseDrafts) {
        let HouseDrafts {
            nodes,
            drafts,
            oversized,
            joined: _,
        } = houses;
        let places = oversized.into_iter().map(|(_, place)| place);
        self.scene.oversized.extend(places);
        let first = self.first_node + self.scene.nodes.len() as u32;
        let mut drafts: Vec<Slot> = drafts.into_iter().map(Slot::Draft).collect();
        self.scene.nodes.reserve(nodes.len());
        for mut node in nodes {
            node.parent = node.parent.map(|parent| NodeId(first + parent.0));
            node.mesh = node.mesh.map(|id| {
                let slot = &mut drafts[id.0 as usize];
                let mesh = match std::mem::replace(slot, Slot::Taken) {
                    Slot::Draft(draft) => self.mesh(draft),
                    Slot::Mesh(mesh) => mesh,
                    Slot::Taken => unreachable!("each is put back as a mesh"),
                };
                *slot = Slot::Mesh(mesh);
                mesh
            });
            self.scene.nodes.push(node);
        }
    }

    /// Returns the houses added since the last [`forget`](SceneBuilder::forget). Their texture coordinates on baked
    /// pages are those of pages that are not cropped.
    pub fn part(&self) -> ScenePart<'_> {
        ScenePart {
            detail: self.scene.detail,
            materials: &self.scene.materials,
            meshes: &self.scene.meshes,
            first_mesh: self.first_mesh,
            nodes: &self.scene.nodes,
            first_node: self.first_node,
            sound: false,
        }
    }

    /// Drops the meshes and nodes that are there. Those that follow have the same numbers as if they were kept.
    pub fn forget(&mut self) {
        self.first_mesh += self.scene.meshes.len() as u32;
        self.first_node += self.scene.nodes.len() as u32;
        self.scene.meshes.clear();
        self.scene.nodes.clear();
        if self.forgets_twins {
            self.meshes = RecentMeshes::default();
        }
    }

    /// Returns the materials, the cropped pages of baked images and, for each page, the factor by which distances from
    /// its upper edge have grown.
    pub fn into_images(self) -> (Vec<Material>, Vec<Baked>, Vec<f32>) {
        let (baked, grown) = self.atlas.finish();
        (self.scene.materials, baked, grown)
    }

    /// Returns the scene. Pages are cropped to their used height. `pictures` are the paths of part textures.
    pub fn finish(self, pictures: Vec<String>) -> Scene {
        let (baked, grown) = self.atlas.finish();
        let mut scene = self.scene;
        for primitive in scene.meshes.iter_mut().flat_map(|m| &mut m.primitives) {
            if let Image::Baked(page) = scene.materials[primitive.material.0 as usize].image {
                let grown = grown[page as usize];
                for [_, v] in &mut primitive.uvs {
                    *v = 1.0 - (1.0 - *v) * grown;
                }
            }
        }
        Scene {
            pictures,
            baked,
            ..scene
        }
    }

    /// Returns the mesh of a draft.
    fn mesh(&mut self, draft: Arc<MeshDraft>) -> MeshId {
        let digest = draft.digest();
        if let Some(known) = self.meshes.find(digest) {
            return known;
        }
        let draft = Arc::unwrap_or_clone(draft);
        let mut primitives = Vec::with_capacity(draft.soups.len() + draft.images.len());
        for (look, soup) in draft.soups {
            primitives.push(primitive(self.material(look), soup));
        }
        let pages = self.on_pages(draft.images).into_iter();
        primitives.extend(pages.map(|(material, soup)| primitive(material, soup)));
        self.scene.meshes.push(Mesh {
            name: draft.name,
            primitives,
        });
        let id = MeshId(self.first_mesh + self.scene.meshes.len() as u32 - 1);
        self.meshes.keep(digest, id);
        id
    }

    /// Returns rectangles with images, one soup for each page.
    fn on_pages(&mut self, quads: Vec<ImageQuad>) -> Vec<(MaterialId, Soup)> {
        let mut pages: Vec<(MaterialId, Soup)> = vec![];
        for quad in quads {
            let Some(spot) = self.spot(&quad.image) else {
                continue;
            };
            let material = self.page(spot.page, quad.shade);
            let at = pages.iter().position(|(id, _)| *id == material);
            let at = at.unwrap_or_else(|| {
                pages.push((material, Soup::default()));
                pages.len() - 1
            });
            pages[at].1.front(quad.rect, quad.front, spot.uv);
        }
        pages
    }

    /// Returns the place of an image, and frees its pixels.
    fn spot(&mut self, image: &BakedImage) -> Option<Spot> {
        let pixels = image.take();
        if let Some(known) = self.spots.get(&image.digest) {
            return Some(*known);
        }
        let spot = self.atlas.place(pixels?.as_ref());
        self.spots.insert(image.digest, spot);
        Some(spot)
    }

    fn page(&mut self, page: u32, shade: usize) -> MaterialId {
        if let Some(known) = self.pages.get(&(page, shade)) {
            return *known;
        }
        let id = self.add_material(of_page(page, self.atlas.has_holes(page), shade));
        self.pages.insert((page, shade), id);
        id
    }

    fn material(&mut self, look: Look) -> MaterialId {
        if let Some(known) = self.materials.get(&look) {
            return *known;
        }
        let id = self.add_material(look.material(self.scene.detail));
        self.materials.insert(look, id);
        id
    }

    fn add_material(&mut self, material: Material) -> MaterialId {
        self.scene.materials.push(material);
        MaterialId(self.scene.materials.len() as u32 - 1)
    }
}

/// A draft, before and after it has a mesh.
enum Slot {
    Draft(Arc<MeshDraft>),
    Mesh(MeshId),
    Taken,
}

/// The meshes shown of late, by their content: an endless town does not fill the memory with meshes that never come back.
#[derive(Debug, Default)]
struct RecentMeshes {
    young: HashMap<Digest, MeshId>,
    old: HashMap<Digest, MeshId>,
}

impl RecentMeshes {
    /// The number of young meshes that makes the old ones forgotten.
    const MOST: usize = 1 << 16;

    fn find(&mut self, digest: Digest) -> Option<MeshId> {
        if let Some(id) = self.young.get(&digest) {
            return Some(*id);
        }
        let id = self.old.remove(&digest)?;
        self.keep(digest, id);
        Some(id)
    }

    fn keep(&mut self, digest: Digest, id: MeshId) {
        if self.young.len() >= RecentMeshes::MOST {
            self.old = std::mem::take(&mut self.young);
        }
        self.young.insert(digest, id);
    }
}

/// Converts a soup to a primitive of its material.
fn primitive(material: MaterialId, soup: Soup) -> Primitive {
    let Soup {
        positions,
        normals,
        uvs,
        indices,
        left_out: _,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_meshes_are_found_and_old_ones_forgotten() {
        let mut meshes = RecentMeshes::default();
        let often = 7;
        meshes.keep(often, MeshId(0));
        for digest in 1_000..1_000 + 3 * RecentMeshes::MOST as Digest {
            meshes.keep(digest, MeshId(1));
            assert_eq!(meshes.find(often), Some(MeshId(0)), "{digest}");
        }
        assert_eq!(meshes.find(1_000), None);
        assert!(meshes.young.len() + meshes.old.len() <= 2 * RecentMeshes::MOST);
    }
}
