//! The content of a tile (3D Tiles 1.1): the houses of some features as few primitives, one for each material, whose vertices
//! name their feature (`EXT_mesh_features`); a table tells what is known of each (`EXT_structural_metadata`).
//!
//! All primitives share their vertices. They count from the middle of the tile, so that f32 resolves a fraction of a
//! millimetre. Normals are bytes (`KHR_mesh_quantization`); at detail 0 there are none, and readers shade flat. Packed tiles have
//! the same arrays in `EXT_meshopt_compression`.

mod models;
#[cfg(feature = "compress")]
mod packed;

use super::arrays::{MaterialRef, signed_byte, turned, write_each, write_floats};
use super::bare::Bare;
use super::json_file::{File, accessor};
use super::materials::{MaterialRefs, Materials};
use super::shading::{tangents, unit};
use super::table::{FeatureRow, Table};
use super::writer::root;
use crate::backend::{Images, OutFile, images, sound};
use crate::scene::{Detail, Image, Material, Primitive, ScenePart};
use glam::{DVec2, DVec3, Vec3};
use models::Models;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::mem::take;
use std::ops::Range;

/// A file of a tile.
pub struct TileContent<'a> {
    /// The `.glb`.
    pub glb: Vec<u8>,
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
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    /// Where materials have relief, one for each vertex.
    tangents: Vec<[f32; 4]>,
    uvs: Vec<[f32; 2]>,
    /// The vertices on pages of baked images, by the number of the page.
    on_pages: Vec<(u32, Range<usize>)>,
    features: Vec<f32>,
    /// The indices of each material, by its number in the file.
    batches: Vec<Vec<u32>>,
    /// For each material, true if it has relief.
    reliefs: Vec<bool>,
    bounds: Option<[DVec3; 2]>,
    models: Models,
}

/// The way from the frame of a node to that of the town.
#[derive(Clone, Copy)]
struct Pose {
    at: DVec3,
    turn: DVec2,
}

impl Pose {
    fn point(self, [x, y, z]: [f32; 3]) -> DVec3 {
        let across = self.turn.rotate(DVec2::new(x.into(), y.into()));
        self.at + DVec3::new(across.x, across.y, z.into())
    }

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
        let mut materials = MaterialRefs::default();
        // Relief is nothing from afar.
        materials.flat = detail <= Detail::Flat;
        TileWriter {
            centre,
            detail,
            packed: packed && cfg!(feature = "compress"),
            materials,
            positions: vec![],
            normals: vec![],
            tangents: vec![],
            uvs: vec![],
            on_pages: vec![],
            features: vec![],
            batches: vec![],
            reliefs: vec![],
            bounds: None,
            models: Models::default(),
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
            let own = above.filter(|_| sound::node(node)).map(|above| {
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
            let sound = |p: &&Primitive| sound::primitive(p, part.materials);
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
        self.uvs.extend(&bare.uvs);
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
            room(&mut self.normals, p.normals.len());
            self.normals
                .extend(p.normals.iter().map(|n| pose.normal(*n)));
            if !self.materials.flat {
                let turned = |[x, y, z, w]: [f32; 4]| {
                    let [x, y, z] = pose.normal([x, y, z]);
                    [x, y, z, w]
                };
                self.tangents.extend(tangents(p).into_iter().map(turned));
            }
            if let Image::Baked(page) = material.image {
                self.on_pages
                    .push((page, self.uvs.len()..self.positions.len()));
            }
            let metres = known.metres.unwrap_or(1.0);
            let uvs = p.uvs.iter().map(|[u, v]| match known.metres {
                Some(_) => [u / metres, 1.0 - v / metres],
                None => [0.0; 2],
            });
            room(&mut self.uvs, p.uvs.len());
            self.uvs.extend(uvs);
            self.indices(known, first, &p.indices);
        }
    }

    /// Adds vertices; returns the number of the first.
    fn vertices(&mut self, points: &[[f32; 3]], (pose, feature): (Pose, u32)) -> u32 {
        let first = self.positions.len() as u32;
        room(&mut self.positions, points.len());
        for point in points {
            let local = self.rounded((pose.point(*point) - self.centre).as_vec3());
            // The box is that of the numbers in the file.
            let at = local.as_dvec3() + self.centre;
            let [low, high] = self.bounds.get_or_insert([at; 2]);
            (*low, *high) = (low.min(at), high.max(at));
            self.positions.push(local.to_array());
        }
        self.features.resize(self.positions.len(), feature as f32);
        first
    }

    /// Rounds a vertex as it will be in the file.
    fn rounded(&self, local: Vec3) -> Vec3 {
        match self.packed {
            true => (local * STEPS).round() / STEPS,
            false => local,
        }
    }

    fn indices(&mut self, known: MaterialRef, first: u32, indices: &[u32]) {
        let material = known.number.value();
        if self.batches.len() <= material {
            self.batches.resize(material + 1, vec![]);
            self.reliefs.resize(material + 1, false);
        }
        self.reliefs[material] = known.relief;
        self.batches[material].extend(indices.iter().map(|i| first + i));
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
        let bounds = self.bounds?;
        let mut root = root();
        let known = Materials::new(&self.materials, materials, images, &mut root);
        let textures = known.files_in(&mut root, folder);
        self.stretch(materials, grown);
        // Room that is not written to takes no memory, to move a grown buffer does.
        let mut bin = Vec::with_capacity(self.length() + (rows.len() << 11) + (1 << 20));
        let mut file = File::new(serde_json::to_value(&root).unwrap_or_default());
        let batches = self.batches.iter().map(|b| b.len() / 3);
        let triangles = batches.sum::<usize>() + self.models.triangles();
        let vertices = self.positions.len();
        let mut meshes = vec![];
        if vertices > 0 {
            let attributes = match self.packed {
                #[cfg(feature = "compress")]
                true => packed::attributes(&self, &mut file, &mut bin),
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
            for [_, v] in &mut self.uvs[vertices] {
                // As in a scene, where they are counted from below.
                let above = 1.0 - *v * factor;
                *v = 1.0 - above;
            }
        }
        self.models
            .stretch(|material| match materials[material.0 as usize].image {
                Image::Baked(page) => factor(page),
                _ => None,
            });
    }

    /// Returns about the bytes of all arrays as they will be in the file.
    fn length(&self) -> usize {
        let vertex = 12
            + 8
            + 4
            + 4 * (usize::from(!self.normals.is_empty()) + usize::from(!self.tangents.is_empty()));
        let indices: usize = self.batches.iter().map(Vec::len).sum();
        self.positions.len() * vertex + indices * 4
    }

    /// Writes the arrays of all vertices, and frees each; returns the attributes of every primitive.
    fn attributes(&mut self, file: &mut File, bin: &mut Vec<u8>) -> Value {
        let count = self.positions.len();
        let mut attributes = BTreeMap::new();
        let positions = take(&mut self.positions);
        let view = file.view(bin, Some((12, 34962)), |out| {
            write_floats(out, &positions, turned);
        });
        let (low, high) = super::arrays::bounds([&*positions]);
        drop(positions);
        let mut points = accessor(view, 5126, count, "VEC3");
        points["min"] = json!(low.map(f64::from));
        points["max"] = json!(high.map(f64::from));
        attributes.insert("POSITION", file.accessor(points));
        if !self.normals.is_empty() {
            let view = file.view(bin, Some((4, 34962)), |out| {
                write_each(out, &take(&mut self.normals), |normal| {
                    let [x, y, z] = turned(unit(normal)).map(byte);
                    [x, y, z, 0]
                });
            });
            let mut normals = accessor(view, 5120, count, "VEC3");
            normals["normalized"] = json!(true);
            attributes.insert("NORMAL", file.accessor(normals));
        }
        if !self.tangents.is_empty() {
            let view = file.view(bin, Some((4, 34962)), |out| {
                write_each(out, &take(&mut self.tangents), |[x, y, z, w]| {
                    let [x, y, z] = turned([x, y, z]);
                    [x, y, z, w].map(byte)
                });
            });
            let mut tangents = accessor(view, 5120, count, "VEC4");
            tangents["normalized"] = json!(true);
            attributes.insert(TANGENT, file.accessor(tangents));
        }
        let view = file.view(bin, Some((8, 34962)), |out| {
            write_floats(out, &take(&mut self.uvs), |uv| uv);
        });
        attributes.insert(
            "TEXCOORD_0",
            file.accessor(accessor(view, 5126, count, "VEC2")),
        );
        let view = file.view(bin, Some((4, 34962)), |out| {
            write_each(out, &take(&mut self.features), f32::to_le_bytes);
        });
        let ids = accessor(view, 5126, count, "SCALAR");
        attributes.insert("_FEATURE_ID_0", file.accessor(ids));
        json!(attributes)
    }

    /// Writes the indices of each material and frees them; returns the primitives. `vertices` and `features` are their numbers.
    fn primitives(
        &mut self,
        file: &mut File,
        bin: &mut Vec<u8>,
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
            let view = match self.packed {
                #[cfg(feature = "compress")]
                true => packed::indices(&batch, short, file, bin),
                _ => file.view(bin, Some((0, 34963)), |out| match short {
                    true => write_each(out, &batch, |i| (i as u16).to_le_bytes()),
                    false => write_each(out, &batch, u32::to_le_bytes),
                }),
            };
            let kind = if short { 5123 } else { 5125 };
            let indices = file.accessor(accessor(view, kind, batch.len(), "SCALAR"));
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

/// Makes room for more elements in a list that grows with the houses of a tile: for four times as many as it has, since room
/// that is not written to takes no memory, and to move a list does.
fn room<T>(list: &mut Vec<T>, more: usize) {
    if list.capacity() - list.len() < more {
        list.reserve(more.max(3 * list.len()));
    }
}

/// Steps of coordinates in a packed metre.
const STEPS: f32 = 4096.0;

/// The attribute of tangents.
const TANGENT: &str = "TANGENT";

/// Encodes a number from -1 to 1 in a byte.
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
