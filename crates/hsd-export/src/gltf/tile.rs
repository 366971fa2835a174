//! The content of a tile (3D Tiles 1.1): the houses of some features as few primitives, one for each material, whose vertices
//! name their feature (`EXT_mesh_features`); a table tells what is known of each (`EXT_structural_metadata`).
//!
//! All primitives share their vertices. They count from the middle of the tile, so that f32 resolves a fraction of a
//! millimetre. Normals are bytes (`KHR_mesh_quantization`); at detail 0 there are none, and readers shade flat. Packed tiles have
//! the same arrays in `EXT_meshopt_compression`.

mod models;
#[cfg(feature = "compress")]
mod packed;
mod spare;
mod vertices;

use super::arrays::{MaterialRef, signed_byte, turned};
use super::bare::Bare;
use super::json_file::{File, accessor};
use super::materials::{MaterialRefs, Materials};
use super::shading::tangents;
use super::table::{FeatureRow, Table};
use super::writer::root;
use crate::pieces::Pieces;
use crate::{Images, OutFile, images, sound};
use glam::{DVec2, DVec3, Vec3};
use hsd_scene::{Detail, Image, Material, Primitive, ScenePart};
use models::Models;
use serde_json::{Value, json};
use spare::Spare;
pub use spare::SpareArrays;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::mem::take;
use std::ops::Range;
use vertices::{Vertices, add_indices, shortened};

/// A file of a tile.
pub struct TileContent<'a> {
    /// The `.glb`.
    pub glb: Pieces,
    /// The images that it names, below the folder given for them.
    pub textures: Vec<OutFile<'a>>,
    /// The box of all vertices: least and greatest metres east, north and up in the frame of the town.
    pub bounds: [DVec3; 2],
    /// The number of its triangles.
    pub triangles: usize,
    /// An estimate of the bytes that its arrays take on a graphics card.
    pub arrays: usize,
}

/// Takes the houses of a tile one after another.
pub struct TileWriter {
    centre: DVec3,
    detail: Detail,
    /// True if its arrays are packed.
    packed: bool,
    materials: MaterialRefs,
    vertices: Vertices,
    /// The vertices on pages of baked images, by the number of the page.
    on_pages: Vec<(u32, Range<usize>)>,
    /// The indices of each material, by its number in the file, as bytes of 32-bit numbers.
    batches: Vec<Vec<u8>>,
    /// For each material, true if it has relief.
    reliefs: Vec<bool>,
    /// The box of models that are put up many times.
    bounds: Option<[DVec3; 2]>,
    models: Models,
    /// Arrays of a tile before, whose memory is written over.
    spare: Spare,
}

/// The way from the frame of a node to that of the town.
#[derive(Clone, Copy)]
struct Pose {
    at: DVec3,
    turn: DVec2,
}

impl Pose {
    #[inline]
    fn point(self, [x, y, z]: [f32; 3]) -> DVec3 {
        let across = self.turn.rotate(DVec2::new(x.into(), y.into()));
        self.at + DVec3::new(across.x, across.y, z.into())
    }

    #[inline]
    fn normal(self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let across = self.turn.rotate(DVec2::new(x.into(), y.into()));
        [across.x as f32, across.y as f32, z]
    }
}

impl TileWriter {
    /// Creates a tile without houses round a place in the frame of the town.
    pub fn new(detail: Detail, centre: DVec3) -> TileWriter {
        TileWriter::packed(detail, centre, false)
    }

    /// The same with arrays that are packed, if this program can.
    pub fn packed(detail: Detail, centre: DVec3, packed: bool) -> TileWriter {
        TileWriter::over(&SpareArrays::default(), detail, centre, packed)
    }

    /// The same in the memory of arrays that are spare.
    pub fn over(arrays: &SpareArrays, detail: Detail, centre: DVec3, packed: bool) -> TileWriter {
        let mut spare = arrays.take(detail as u8);
        let mut materials = MaterialRefs::default();
        // Relief is nothing from afar.
        materials.flat = detail <= Detail::Flat;
        let packed = packed && cfg!(feature = "compress");
        TileWriter {
            centre,
            detail,
            packed,
            materials,
            vertices: Vertices::over(&mut spare, detail, packed),
            on_pages: vec![],
            batches: vec![],
            reliefs: vec![],
            bounds: None,
            models: Models::default(),
            spare,
        }
    }

    /// Adds houses that stand on a feature, given by its row in the table.
    pub fn add(&mut self, part: ScenePart<'_>, feature: u32, images: &dyn Images) {
        let mut poses: Vec<Option<Pose>> = Vec::with_capacity(part.nodes.len());
        for (i, node) in part.nodes.iter().enumerate() {
            let above = match part.parent(i) {
                Some(parent) => poses[parent],
                None => Some(Pose {
                    at: DVec3::ZERO,
                    turn: DVec2::X,
                }),
            };
            let own = above
                .filter(|_| part.sound || sound::node(node))
                .map(|above| {
                    let across = above.turn.rotate(node.at.truncate());
                    Pose {
                        at: above.at + across.extend(node.at.z),
                        turn: above.turn.rotate(node.turn).normalize_or(DVec2::X),
                    }
                });
            poses.push(own);
            let mesh = node.mesh.and_then(|id| part.mesh(id));
            let (Some(mesh), Some(pose)) = (mesh, own) else {
                continue;
            };
            let sound = |p: &&Primitive| part.sound || sound::primitive(p, part.materials);
            let list: Vec<&Primitive> = mesh.primitives.iter().filter(sound).collect();
            if let Some(of) = node.stretched.as_deref().copied() {
                let materials = &mut self.materials;
                let shapes = || {
                    let known = list.iter().map(|p| {
                        let material = &part.materials[p.material.0 as usize];
                        (materials.of(p.material, material, images), (*p).clone())
                    });
                    known.collect()
                };
                let around = self.models.add(of, (pose, self.centre, feature), shapes);
                if let Some(own) = around {
                    let [a, b] = own.map(|p| p.as_dvec3() + self.centre);
                    let [low, high] = self.bounds.get_or_insert([a, b]);
                    (*low, *high) = (low.min(a), high.max(b));
                }
                continue;
            }
            match self.detail {
                Detail::Body => self.bare(&list, part, (pose, feature), images),
                _ => self.whole(&list, part, (pose, feature), images),
            }
        }
    }

    /// Adds primitives that share vertices without normals.
    fn bare(
        &mut self,
        list: &[&Primitive],
        part: ScenePart<'_>,
        (pose, feature): (Pose, u32),
        images: &dyn Images,
    ) {
        let known: Vec<_> = list
            .iter()
            .map(|p| {
                let material = &part.materials[p.material.0 as usize];
                (*p, self.materials.of(p.material, material, images))
            })
            .collect();
        let bare = Bare::of(&known);
        let first = self.vertices(&bare.positions, (pose, feature));
        self.vertices.uvs(&bare.uvs, |uv| uv);
        for ((_, material), indices) in known.iter().zip(bare.indices) {
            self.indices(*material, first, &indices);
        }
    }

    /// Adds primitives with their normals.
    fn whole(
        &mut self,
        list: &[&Primitive],
        part: ScenePart<'_>,
        (pose, feature): (Pose, u32),
        images: &dyn Images,
    ) {
        for p in list {
            let material = &part.materials[p.material.0 as usize];
            let known = self.materials.of(p.material, material, images);
            let first = self.vertices(&p.positions, (pose, feature));
            self.vertices.normals(&p.normals, pose);
            if !self.materials.flat {
                self.vertices.tangents(&tangents(p), pose);
            }
            if let Image::Baked(page) = material.image {
                self.on_pages
                    .push((page, first as usize..self.vertices.count));
            }
            match known.metres {
                Some(metres) => self
                    .vertices
                    .uvs(&p.uvs, |[u, v]| [u / metres, 1.0 - v / metres]),
                None => self.vertices.uvs(&p.uvs, |_| [0.0; 2]),
            }
            self.indices(known, first, &p.indices);
        }
    }

    /// Adds vertices; returns the number of the first.
    fn vertices(&mut self, points: &[[f32; 3]], (pose, feature): (Pose, u32)) -> u32 {
        self.vertices.add(points, (pose, self.centre), feature)
    }

    /// Returns the box of all that is to be seen: that of the numbers in the file.
    fn bounds(&self) -> Option<[DVec3; 2]> {
        let own = (self.vertices.count > 0).then(|| {
            let at = |corner: Vec3| corner.as_dvec3() + self.centre;
            self.vertices.bounds.map(at)
        });
        let both = own.into_iter().chain(self.bounds);
        both.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    fn indices(&mut self, known: MaterialRef, first: u32, indices: &[u32]) {
        let material = known.number.value();
        if self.batches.len() <= material {
            let spare = &mut self.spare;
            self.batches.resize_with(material + 1, || spare.array());
            self.reliefs.resize(material + 1, false);
        }
        self.reliefs[material] = known.relief;
        add_indices(&mut self.batches[material], indices, first);
    }

    /// Returns the file; `None` if nothing is to be seen. Images are named below `folder`, a relative reference. `materials`
    /// are those of the scene, `grown` the factors by which distances from the upper edge of each baked page have grown.
    pub fn content<'a>(
        mut self,
        (materials, grown): (&'a [Material], &[f32]),
        images: &'a dyn Images,
        rows: &[FeatureRow],
        folder: &str,
    ) -> Option<TileContent<'a>> {
        let bounds = self.bounds()?;
        let mut root = root();
        let known = Materials::new(&self.materials, materials, images, &mut root);
        let textures = known.files_in(&mut root, folder);
        self.stretch(materials, grown);
        let mut bin = Pieces::default();
        let mut file = File::new(serde_json::to_value(&root).unwrap_or_default());
        let batches = self.batches.iter().map(|b| b.len() / 12);
        let triangles = batches.sum::<usize>() + self.models.triangles();
        let vertices = self.vertices.count;
        let mut meshes = vec![];
        if vertices > 0 {
            let attributes = match self.packed {
                #[cfg(feature = "compress")]
                true => packed::attributes(&self.vertices, &mut file, &mut bin),
                _ => self.attributes(&mut file, &mut bin),
            };
            let counts = (vertices, rows.len());
            let primitives = self.primitives(&mut file, &mut bin, &attributes, counts);
            meshes.push((json!({ "primitives": primitives }), Value::Null));
        }
        let flat = self.materials.flat;
        meshes.extend(self.models.written(flat, rows.len(), (&mut file, &mut bin)));
        let arrays = bin.len().max(file.unpacked);
        let table = Table::new(rows).written(&mut file, &mut bin);
        file.finish(&mut bin, meshes, table, self.centre);
        Some(TileContent {
            glb: file.packed(bin),
            textures,
            bounds,
            triangles,
            arrays,
        })
    }

    /// Moves texture coordinates on pages to where the images on them are, now that the heights of pages are known.
    fn stretch(&mut self, materials: &[Material], grown: &[f32]) {
        let factor = |page: u32| grown.get(page as usize).copied();
        for (page, vertices) in take(&mut self.on_pages) {
            let Some(factor) = factor(page) else {
                continue;
            };
            self.vertices.change_v(vertices, |v| {
                // As in a scene, where they are counted from below.
                let above = 1.0 - v * factor;
                1.0 - above
            });
        }
        self.models
            .stretch(|material| match materials[material.0 as usize].image {
                Image::Baked(page) => factor(page),
                _ => None,
            });
    }

    /// Puts the arrays of all vertices into the file; returns the attributes of every primitive.
    fn attributes(&mut self, file: &mut File, bin: &mut Pieces) -> Value {
        let Vertices {
            count,
            positions,
            normals,
            tangents,
            uvs,
            features,
            bounds,
            ..
        } = std::mem::replace(&mut self.vertices, Vertices::new(self.packed));
        let mut attributes = BTreeMap::new();
        let [low, high] = turned_bounds(bounds);
        let mut points = accessor(file.array(bin, (12, 34962), positions), 5126, count, "VEC3");
        points["min"] = json!(low.map(f64::from));
        points["max"] = json!(high.map(f64::from));
        attributes.insert("POSITION", file.accessor(points));
        for (name, kind, directions) in [("NORMAL", "VEC3", normals), (TANGENT, "VEC4", tangents)] {
            if !directions.is_empty() {
                let view = file.array(bin, (4, 34962), directions);
                let mut made = accessor(view, 5120, count, kind);
                made["normalized"] = json!(true);
                attributes.insert(name, file.accessor(made));
            }
        }
        let uvs = accessor(file.array(bin, (8, 34962), uvs), 5126, count, "VEC2");
        attributes.insert("TEXCOORD_0", file.accessor(uvs));
        let ids = file.array(bin, (4, 34962), features);
        let ids = accessor(ids, 5126, count, "SCALAR");
        attributes.insert("_FEATURE_ID_0", file.accessor(ids));
        json!(attributes)
    }

    /// Puts the indices of each material into the file; returns the primitives. `vertices` and `features` are their numbers.
    fn primitives(
        &mut self,
        file: &mut File,
        bin: &mut Pieces,
        attributes: &Value,
        (vertices, features): (usize, usize),
    ) -> Vec<Value> {
        let short = vertices <= 65_535;
        let mut plain = attributes.clone();
        if let Some(named) = plain.as_object_mut() {
            named.remove(TANGENT);
        }
        let shown = take(&mut self.batches).into_iter().enumerate();
        let mut primitives = vec![];
        for (material, batch) in shown.filter(|(_, batch)| !batch.is_empty()) {
            let count = batch.len() / 4;
            let view = match self.packed {
                #[cfg(feature = "compress")]
                true => packed::indices(&batch, short, file, bin),
                _ => {
                    let bytes = if short { shortened(&batch) } else { batch };
                    file.array(bin, (0, 34963), bytes)
                }
            };
            let kind = if short { 5123 } else { 5125 };
            let indices = file.accessor(accessor(view, kind, count, "SCALAR"));
            primitives.push(json!({
                "attributes": if self.reliefs[material] { attributes } else { &plain },
                "indices": indices,
                "material": material,
                "mode": 4,
                "extensions": { "EXT_mesh_features": { "featureIds": [
                    { "featureCount": features, "attribute": 0, "propertyTable": 0 }
                ] } },
            }));
        }
        primitives
    }
}

/// Returns least and greatest coordinates as the file has them, y up: north becomes -z, so its bounds change places.
fn turned_bounds([low, high]: [Vec3; 2]) -> [[f32; 3]; 2] {
    [
        turned([low.x, high.y, low.z]),
        turned([high.x, low.y, high.z]),
    ]
}

/// The attribute of tangents.
const TANGENT: &str = "TANGENT";

/// Encodes a number from -1 to 1 in a byte.
#[inline]
fn byte(x: f32) -> u8 {
    signed_byte(x) as u8
}

/// Returns an estimate of the bytes that an image takes on a graphics card: four a pixel, one if it stays packed there, and a
/// third more for its smaller copies.
pub fn graphics_bytes(image: &[u8]) -> u64 {
    let (size, bytes) = match images::mime(image) {
        Some(images::KTX2) => (images::ktx2_size(image), 1),
        _ => (images::size(Cursor::new(image)), 4),
    };
    size.map_or(0, |(w, h)| u64::from(w) * u64::from(h) * bytes * 4 / 3)
}
