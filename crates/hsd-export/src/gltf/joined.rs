//! Houses of a city in common meshes: some hundred houses are one node, one mesh and one primitive for each material, and
//! each vertex carries the number of its house (`EXT_mesh_features`), whose name and span are in the extras of the node.
//! A reader has a thousandth of the nodes to handle, and the lists of the JSON, a third of a plain house, are gone.

use super::Writer;
use super::accessor::Accessor;
use super::arrays::{Array, MaterialRef, bounds, index_type, turned, write_floats, write_indices};
use super::bare::Bare;
use super::nodes::kept;
use super::shapes::{Shapes, triangles};
use crate::number::Number;
use crate::spool::NewSpool;
use crate::{Images, sound};
use glam::{DVec2, DVec3};
use gltf::json::accessor::ComponentType;
use gltf::json::extensions::mesh::Primitive as Extensions;
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked::Valid;
use gltf::json::{Index, Mesh};
use hsd_base::source::Span;
use hsd_scene::{Primitive, ScenePart};
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeMap;
use std::io;

/// The extension that the numbers of houses belong to.
pub(super) const FEATURES: &str = "EXT_mesh_features";

/// The houses of a mesh, at most.
const HOUSES: usize = 256;

/// The vertices of a mesh beyond which no house is added: 16-bit indices are enough.
const VERTICES: usize = 60_000;

/// The distance of a house from the first one of its mesh, at most, metres: f32 still resolves half a millimetre.
const FAR: f64 = 4096.0;

/// Houses that have no mesh yet.
#[derive(Default)]
pub(super) struct Group {
    /// The frame of the vertices: the place of the first house in whole metres.
    origin: DVec3,
    names: Vec<String>,
    spans: Vec<Span>,
    /// As in [`Bare`]; metres from the origin, z up.
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    /// The number of the house of each vertex.
    ids: Vec<u16>,
    /// The indices of each material, in the order of first use.
    indices: Vec<(MaterialRef, Vec<u32>)>,
    /// The number of houses in the groups before.
    before: usize,
}

/// The node of a group.
#[derive(Serialize)]
struct GroupNode<'a> {
    extras: GroupExtras<'a>,
    mesh: u32,
    name: String,
    translation: [Number; 3],
}

/// The extras of a node that joins houses: their names and source spans, in the order of their numbers.
#[derive(Serialize)]
struct GroupExtras<'a> {
    kind: &'static str,
    names: &'a [String],
    spans: &'a [Span],
    /// The files of the spans; omitted if all are in the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    files: Option<Vec<u32>>,
}

/// The place of a node in the world.
#[derive(Clone, Copy)]
struct Frame {
    at: DVec3,
    turn: DVec2,
}

impl Frame {
    fn point(self, p: DVec3) -> DVec3 {
        self.turn.rotate(p.truncate()).extend(p.z) + self.at
    }
}

impl Writer<'_> {
    /// Adds houses to the groups.
    pub(super) fn join(&mut self, part: ScenePart<'_>, images: &dyn Images) -> io::Result<()> {
        let shown = |p: &&Primitive| sound::primitive(p, part.materials);
        let has_shape = |id| {
            let mesh = part.mesh(id);
            mesh.is_some_and(|mesh| mesh.primitives.iter().any(|p| shown(&p)))
        };
        let kept = kept(part, has_shape);
        let mut frames: Vec<Frame> = Vec::with_capacity(part.nodes.len());
        for (i, node) in part.nodes.iter().enumerate() {
            let parent = part.parent(i).map_or(
                Frame {
                    at: DVec3::ZERO,
                    turn: DVec2::X,
                },
                |p| frames[p],
            );
            frames.push(Frame {
                at: parent.point(node.at),
                turn: parent
                    .turn
                    .rotate(node.turn.try_normalize().unwrap_or(DVec2::X)),
            });
            if !kept[i] {
                continue;
            }
            if part.parent(i).is_none() {
                self.begin_house(node.called(), node.span.unwrap_or_default(), frames[i].at)?;
            }
            let Some(mesh) = node.mesh.and_then(|id| part.mesh(id)) else {
                continue;
            };
            let list: Vec<(&Primitive, MaterialRef)> = mesh
                .primitives
                .iter()
                .filter(shown)
                .map(|p| {
                    let material = &part.materials[p.material.0 as usize];
                    (p, self.materials.of(p.material, material, images))
                })
                .collect();
            self.group.add(&list, frames[i]);
        }
        Ok(())
    }

    /// Begins a house in the current group, or in the next if that is full or far away.
    fn begin_house(&mut self, name: &str, span: Span, at: DVec3) -> io::Result<()> {
        let group = &self.group;
        let full = group.names.len() >= HOUSES || group.positions.len() > VERTICES;
        let far = !group.names.is_empty() && group.origin.distance(at) > FAR;
        if full || far {
            self.write_group()?;
        }
        if self.group.names.is_empty() {
            self.group.origin = at.round();
        }
        self.group.names.push(name.to_owned());
        self.group.spans.push(span);
        Ok(())
    }

    /// Writes the current group, if there is one.
    pub(super) fn write_group(&mut self) -> io::Result<()> {
        let before = self.group.before + self.group.names.len();
        let group = std::mem::replace(
            &mut self.group,
            Group {
                before,
                ..Group::default()
            },
        );
        if group.indices.is_empty() {
            return Ok(());
        }
        let mesh = group.write(&mut self.shapes, self.new)?;
        let at = group.origin;
        let all_first = group.spans.iter().all(|span| span.file.0 == 0);
        let number = self.tree.nodes.push(&GroupNode {
            extras: GroupExtras {
                kind: "houses",
                names: &group.names,
                spans: &group.spans,
                files: (!all_first).then(|| group.spans.iter().map(|s| s.file.0).collect()),
            },
            mesh,
            name: format!("houses {} to {}", group.before + 1, before),
            translation: [at.x, at.z, -at.y].map(Number),
        })?;
        self.tree.root(number);
        Ok(())
    }
}

impl Group {
    /// Returns true if there are groups before this one.
    pub(super) fn is_used(&self) -> bool {
        self.before > 0
    }

    /// Adds a mesh of the current house.
    fn add(&mut self, list: &[(&Primitive, MaterialRef)], frame: Frame) {
        let bare = Bare::of(list);
        let first = self.positions.len() as u32;
        let house = self.names.len().saturating_sub(1) as u16;
        self.positions.extend(bare.positions.iter().map(|p| {
            let p = frame.point(DVec3::from(p.map(f64::from))) - self.origin;
            p.to_array().map(|x| x as f32)
        }));
        self.uvs.extend(bare.uvs);
        self.ids.resize(self.positions.len(), house);
        for ((_, material), indices) in list.iter().zip(bare.indices) {
            let known = self
                .indices
                .iter_mut()
                .find(|(m, _)| m.number == material.number);
            let own = indices.iter().map(|i| first + i);
            match known {
                Some((_, list)) => list.extend(own),
                None => self.indices.push((*material, own.collect())),
            }
        }
    }

    /// Writes its mesh; returns the number of the mesh.
    fn write(&self, shapes: &mut Shapes, new: NewSpool<'_>) -> io::Result<u32> {
        let count = self.positions.len();
        let mut attributes = BTreeMap::new();
        let float = ComponentType::F32;
        let points = Some(bounds([&*self.positions]));
        let number = |shapes: &Shapes| Index::new(shapes.accessors.count());
        attributes.insert(Valid(Semantic::Positions), number(shapes));
        let kind = Accessor::of(Array::Positions, float, count, points);
        shapes.append(Array::Positions, kind, new, |out| {
            write_floats(out, &self.positions, turned);
        })?;
        if self
            .indices
            .iter()
            .any(|(material, _)| material.metres.is_some())
        {
            attributes.insert(Valid(Semantic::TexCoords(0)), number(shapes));
            let kind = Accessor::of(Array::Uvs, float, count, None);
            shapes.append(Array::Uvs, kind, new, |out| {
                write_floats(out, &self.uvs, |uv| uv)
            })?;
        }
        let semantic = Array::Houses.semantic().map(Valid);
        attributes.extend(semantic.map(|s| (s, number(shapes))));
        let kind = Accessor::of(Array::Houses, ComponentType::U16, count, None);
        shapes.append(Array::Houses, kind, new, |out| {
            // Elements of vertex arrays begin at multiples of four.
            out.extend(self.ids.iter().flat_map(|id| u32::from(*id).to_le_bytes()));
        })?;
        let features = json!({
            "featureIds": [{ "featureCount": self.names.len(), "attribute": 0, "label": "house" }]
        });
        let mut primitives = vec![];
        for (material, own) in &self.indices {
            let indices = number(shapes);
            let kind = Accessor::of(Array::Indices, index_type(count), own.len(), None);
            shapes.append(Array::Indices, kind, new, |out| {
                write_indices(out, own, (0, count));
            })?;
            let mut extensions = Extensions::default();
            extensions
                .others
                .insert(FEATURES.to_owned(), features.clone());
            primitives.push(gltf::json::mesh::Primitive {
                attributes: attributes.clone(),
                indices: Some(indices),
                extensions: Some(extensions),
                ..triangles(*material)
            });
        }
        shapes.meshes.push(&Mesh {
            name: None,
            primitives,
            weights: None,
            extensions: None,
            extras: None,
        })
    }
}
