//! Meshes: their accessors and arrays are appended as they come. Each kind of array has a view of its own, so
//! accessors differ by offset only.

use super::accessor::Accessor;
use super::arrays::{
    Array, MaterialRef, bounds, index_type, turned, write_floats, write_indices, write_packed,
};
use super::bare::Bare;
use super::buffer::view;
use super::materials::MaterialRefs;
use crate::spool::{List, NewSpool, Section};
use crate::{Images, sound};
use gltf::json::accessor::ComponentType;
use gltf::json::buffer::{Stride, Target};
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Index, Mesh, Root};
use hsd_scene::{Detail, Image, MeshId, ScenePart};
use serde::Serialize;
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::io;
use std::ops::Range;
use twox_hash::XxHash3_128;

/// The most primitives of which it is known where they lie, so that a large town needs no more memory.
const MOST_KNOWN: usize = 16_384;

/// The extension for directions written as bytes.
const QUANTIZED: &str = "KHR_mesh_quantization";

/// The meshes written so far.
pub(super) struct Shapes {
    pub(super) accessors: List,
    pub(super) meshes: List,
    /// By the number in the scene: that in the file, two higher; 1 if nothing of the mesh can be written, 0 if it is not
    /// written yet. A city has a million of them.
    numbers: Vec<u32>,
    /// The sections of the buffer, in the order of their views.
    views: Vec<ArrayView>,
    /// The texture coordinates on baked pages: the page, and where they lie in their section.
    on_pages: Vec<(u32, Range<u64>)>,
    /// The first accessors of primitives written lately, by their arrays: shades of a material share them. Never iterated.
    known: HashMap<u128, u32>,
    /// True if directions are written as bytes.
    pub(super) quantized: bool,
}

/// The arrays of one kind.
struct ArrayView {
    array: Array,
    section: Section,
}

/// A primitive to be written.
struct Piece<'s> {
    source: &'s hsd_scene::Primitive,
    material: MaterialRef,
    /// The baked page it shows.
    page: Option<u32>,
}

/// A mesh of detail 0. It is written like that of the `gltf` crate, which keeps the attributes of each primitive in a map.
#[derive(Serialize)]
struct BareMesh {
    primitives: Vec<BarePrimitive>,
}

/// A primitive of detail 0: the numbers of its accessors.
#[derive(Serialize)]
struct BarePrimitive {
    attributes: BareAttributes,
    indices: u32,
    material: Index<gltf::json::Material>,
}

#[derive(Clone, Copy, Serialize)]
struct BareAttributes {
    #[serde(rename = "POSITION")]
    positions: u32,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    uvs: Option<u32>,
}

impl Shapes {
    pub(super) fn new(new: NewSpool<'_>) -> io::Result<Shapes> {
        Ok(Shapes {
            accessors: List::new(new)?,
            meshes: List::new(new)?,
            numbers: vec![],
            views: vec![],
            on_pages: vec![],
            known: HashMap::new(),
            quantized: false,
        })
    }

    /// Writes a mesh of some houses unless it is written; returns its number, `None` if nothing of it can be written.
    pub(super) fn mesh(
        &mut self,
        id: MeshId,
        part: ScenePart<'_>,
        (materials, images): (&mut MaterialRefs, &dyn Images),
        new: NewSpool<'_>,
    ) -> io::Result<Option<u32>> {
        if let Some(number) = self.number(id) {
            return Ok(number);
        }
        let Some(mesh) = part.mesh(id) else {
            return Ok(None);
        };
        let sound = |p: &&hsd_scene::Primitive| part.sound || sound::primitive(p, part.materials);
        let list: Vec<Piece<'_>> = mesh
            .primitives
            .iter()
            .filter(sound)
            .map(|source| {
                let material = &part.materials[source.material.0 as usize];
                Piece {
                    source,
                    material: materials.of(source.material, material, images),
                    page: match &material.image {
                        Image::Baked(page) => Some(*page),
                        _ => None,
                    },
                }
            })
            .collect();
        let mirrors = || list.iter().any(|p| p.material.mirrors);
        // At detail 0 its node has a name of its own.
        let named = part.detail != Detail::Body && !mesh.name.is_empty();
        let name = named.then_some(&*mesh.name);
        let number = match part.detail {
            _ if list.is_empty() => None,
            Detail::Body if !mirrors() => Some(self.bare(&list, new)?),
            Detail::Flat if !mirrors() => {
                let primitives = self.joined(&list, new)?;
                Some(self.push(name, primitives)?)
            }
            _ => {
                let primitives = self.separate(&list, new)?;
                Some(self.push(name, primitives)?)
            }
        };
        let at = id.0 as usize;
        if self.numbers.len() <= at {
            self.numbers.resize(at + 1, 0);
        }
        self.numbers[at] = number.map_or(1, |n| n + 2);
        Ok(number)
    }

    fn push(&mut self, name: Option<&str>, primitives: Vec<Primitive>) -> io::Result<u32> {
        self.meshes.push(&Mesh {
            name: name.map(str::to_owned),
            primitives,
            weights: None,
            extensions: None,
            extras: None,
        })
    }

    /// Returns the number of a mesh that is written, or `None` in it if nothing of it can be.
    pub(super) fn number(&self, id: MeshId) -> Option<Option<u32>> {
        let known = self.numbers.get(id.0 as usize).copied().unwrap_or(0);
        Some(known.checked_sub(1)?.checked_sub(1))
    }

    /// Writes primitives with arrays of their own.
    fn separate(&mut self, list: &[Piece<'_>], new: NewSpool<'_>) -> io::Result<Vec<Primitive>> {
        let mut primitives = vec![];
        for piece in list {
            let (p, material) = (piece.source, piece.material);
            let first = self.accessors.count();
            if piece.page.is_none() {
                if self.known.len() == MOST_KNOWN {
                    self.known.clear();
                }
                match self.known.entry(content(p, material)) {
                    Entry::Occupied(same) => {
                        primitives.push(primitive(material, *same.get()));
                        continue;
                    }
                    Entry::Vacant(new) => new.insert(first),
                };
            }
            for array in arrays(material) {
                let bounds = (array == Array::Positions).then(|| bounds([&*p.positions]));
                let kind = Accessor::of(array, array.component(p), array.count(p), bounds);
                let place = self.append(array, kind, new, |out| array.write(p, material, out))?;
                if let (Array::Uvs, Some(page)) = (array, piece.page) {
                    self.on_pages.push((page, place));
                }
            }
            primitives.push(primitive(material, first));
        }
        Ok(primitives)
    }

    /// Writes primitives that share their arrays: in a town seen from afar, the description of an array is larger than
    /// the wall in it.
    fn joined(&mut self, list: &[Piece<'_>], new: NewSpool<'_>) -> io::Result<Vec<Primitive>> {
        let vertices = list.iter().map(|p| p.source.positions.len()).sum();
        let in_use = |array: &Array| list.iter().any(|p| array.is_in(p.material));
        let mut attributes = BTreeMap::new();
        for array in Array::ALL.into_iter().filter(in_use) {
            let Some(semantic) = array.semantic() else {
                continue;
            };
            let points = || list.iter().map(|p| &*p.source.positions);
            let bounds = (array == Array::Positions).then(|| bounds(points()));
            let kind = Accessor::of(array, ComponentType::F32, vertices, bounds);
            attributes.insert(Valid(semantic), Index::new(self.accessors.count()));
            let mut ends = vec![];
            let place = self.append(array, kind, new, |out| {
                let start = out.len();
                for piece in list {
                    array.write(piece.source, piece.material, out);
                    ends.push((out.len() - start) as u64);
                }
            })?;
            if array == Array::Uvs {
                let starts = [0].into_iter().chain(ends.iter().copied());
                for ((piece, start), end) in list.iter().zip(starts).zip(&ends) {
                    let own = place.start + start..place.start + end;
                    self.on_pages.extend(piece.page.map(|page| (page, own)));
                }
            }
        }
        let (mut first, mut primitives) = (0, vec![]);
        for Piece {
            source, material, ..
        } in list
        {
            let component = index_type(vertices);
            let kind = Accessor::of(Array::Indices, component, source.indices.len(), None);
            let indices = Index::new(self.accessors.count());
            self.append(Array::Indices, kind, new, |out| {
                write_indices(out, &source.indices, (first, vertices));
            })?;
            first += source.positions.len();
            primitives.push(Primitive {
                attributes: attributes.clone(),
                indices: Some(indices),
                ..triangles(*material)
            });
        }
        Ok(primitives)
    }

    /// Writes a mesh on common vertices without normals; returns its number.
    fn bare(&mut self, list: &[Piece<'_>], new: NewSpool<'_>) -> io::Result<u32> {
        let all: Vec<_> = list.iter().map(|p| (p.source, p.material)).collect();
        let Bare {
            positions,
            uvs,
            indices,
        } = Bare::of(&all);
        let count = positions.len();
        let mut attributes = BareAttributes {
            positions: self.accessors.count(),
            uvs: None,
        };
        let bounds = Some(bounds([&*positions]));
        let points = Accessor::of(Array::Positions, ComponentType::F32, count, bounds);
        self.append(Array::Positions, points, new, |out| {
            write_floats(out, &positions, turned);
        })?;
        if list.iter().any(|p| p.material.metres.is_some()) {
            attributes.uvs = Some(self.accessors.count());
            let kind = Accessor::of(Array::Uvs, ComponentType::F32, count, None);
            self.append(Array::Uvs, kind, new, |out| {
                write_floats(out, &uvs, |uv| uv)
            })?;
        }
        let mut primitives = Vec::with_capacity(list.len());
        for (piece, own) in list.iter().zip(&indices) {
            primitives.push(BarePrimitive {
                attributes,
                indices: self.accessors.count(),
                material: piece.material.number,
            });
            let kind = Accessor::of(Array::Indices, index_type(count), own.len(), None);
            self.append(Array::Indices, kind, new, |out| {
                write_indices(out, own, (0, count));
            })?;
        }
        self.meshes.push(&BareMesh { primitives })
    }

    /// Appends an array and its accessor; returns where it lies in its section.
    pub(super) fn append(
        &mut self,
        array: Array,
        accessor: Accessor,
        new: NewSpool<'_>,
        write: impl FnOnce(&mut Vec<u8>),
    ) -> io::Result<Range<u64>> {
        let known = self.views.iter().position(|view| view.array == array);
        let number = match known {
            Some(number) => number,
            None => {
                self.views.push(ArrayView {
                    array,
                    section: Section::new(array.name(), new)?,
                });
                self.views.len() - 1
            }
        };
        let packed = self.quantized && array.is_direction();
        let accessor = match packed {
            true => accessor.packed(),
            false => accessor,
        };
        let place = self.views[number].section.append(|out| {
            if packed {
                let mut floats = vec![];
                write(&mut floats);
                write_packed(out, &floats, array.elements().multiplicity());
            } else {
                write(out);
            }
            Ok(())
        })?;
        self.accessors.push(&accessor.at(number, place.start))?;
        Ok(place)
    }

    /// Stretches the texture coordinates on pages downwards by the factor of each page: its lower end was cut off.
    pub(super) fn stretch(&mut self, grown: &[f32]) -> io::Result<()> {
        let Some(view) = self.views.iter_mut().find(|v| v.array == Array::Uvs) else {
            return Ok(());
        };
        for (page, place) in std::mem::take(&mut self.on_pages) {
            let factor = grown.get(page as usize).copied().unwrap_or(1.0);
            if factor != 1.0 {
                view.section.change(place, |bytes| {
                    let (floats, _) = bytes.as_chunks_mut::<4>();
                    // As in a scene, where they are counted from below.
                    for v in floats.iter_mut().skip(1).step_by(2) {
                        let above = 1.0 - f32::from_le_bytes(*v) * factor;
                        *v = (1.0 - above).to_le_bytes();
                    }
                })?;
            }
        }
        Ok(())
    }

    /// Adds the views to the root; returns the sections in the order of the buffer, and their length.
    pub(super) fn into_views(self, root: &mut Root) -> (List, List, Vec<Section>, u64) {
        let directions = self.views.iter().any(|view| view.array.is_direction());
        if self.quantized && directions {
            root.extensions_used.push(QUANTIZED.to_owned());
            root.extensions_required.push(QUANTIZED.to_owned());
        }
        let mut length = 0;
        let mut sections = vec![];
        for ArrayView { array, section } in self.views {
            let vertices = array != Array::Indices;
            let target = match vertices {
                true => Target::ArrayBuffer,
                false => Target::ElementArrayBuffer,
            };
            root.push(gltf::json::buffer::View {
                target: Some(Valid(target)),
                // Many accessors share it.
                byte_stride: vertices.then_some(Stride(
                    match self.quantized && array.is_direction() {
                        true => 4,
                        false => 4 * array.elements().multiplicity(),
                    },
                )),
                ..view(length as usize, section.length() as usize)
            });
            length += section.length();
            sections.push(section);
        }
        (self.accessors, self.meshes, sections, length)
    }
}

/// Returns a number for the arrays of a primitive: the same if they are the same.
fn content(p: &hsd_scene::Primitive, material: MaterialRef) -> u128 {
    let mut hasher = XxHash3_128::new();
    let metres = material.metres.map_or(u32::MAX, f32::to_bits);
    let flags = u32::from(material.relief) + 2 * u32::from(material.mirrors);
    for number in [
        metres,
        flags,
        p.positions.len() as u32,
        p.indices.len() as u32,
    ] {
        hasher.write(&number.to_le_bytes());
    }
    hasher.write(bytemuck::cast_slice(&p.positions));
    hasher.write(bytemuck::cast_slice(&p.normals));
    hasher.write(bytemuck::cast_slice(&p.uvs));
    if material.mirrors {
        hasher.write(bytemuck::cast_slice(&p.mirror_uvs));
    }
    hasher.write(bytemuck::cast_slice(&p.indices));
    hasher.finish_128()
}

/// Returns the arrays of a primitive of this material, in the order of their accessors.
pub(super) fn arrays(material: MaterialRef) -> impl Iterator<Item = Array> {
    Array::ALL.into_iter().filter(move |a| a.is_in(material))
}

/// Returns a primitive whose first accessor has this number.
pub(super) fn primitive(material: MaterialRef, first: u32) -> Primitive {
    let numbers = (first..).map(Index::new);
    let mut indices = None;
    let mut attribute = |(array, number): (Array, _)| {
        let semantic = array.semantic();
        if semantic.is_none() {
            indices = Some(number);
        }
        semantic.map(|s| (Valid(s), number))
    };
    Primitive {
        attributes: arrays(material)
            .zip(numbers)
            .filter_map(&mut attribute)
            .collect(),
        indices,
        ..triangles(material)
    }
}

/// Returns triangles of a material, without arrays.
pub(super) fn triangles(material: MaterialRef) -> Primitive {
    Primitive {
        attributes: BTreeMap::new(),
        indices: None,
        material: Some(material.number),
        mode: Valid(Mode::Triangles),
        targets: None,
        extensions: None,
        extras: None,
    }
}
