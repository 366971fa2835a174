//! Houses as one mesh each, with one primitive for each material: what game engines draw in a dozen calls instead of
//! thousands.

use super::flat::{self, Placement};
use super::sound;
use glam::DVec3;
use hsd_scene::{MaterialId, Mesh, MeshId, Node, Primitive, ScenePart};
use std::collections::HashMap;

/// Houses, each with one node and one mesh.
#[derive(Debug)]
pub struct MergedHouses {
    meshes: Vec<Mesh>,
    nodes: Vec<Node>,
    first: u32,
}

impl MergedHouses {
    /// Merges whole houses. The first has this number among those that are merged.
    pub fn of(part: ScenePart<'_>, first: u32) -> MergedHouses {
        let mut made = MergedHouses {
            meshes: vec![],
            nodes: vec![],
            first,
        };
        // In the frame of the house, where f32 resolves a fraction of a millimetre.
        let mut places: Vec<Placement> = Vec::with_capacity(part.nodes.len());
        let mut known: HashMap<MaterialId, usize> = HashMap::new();
        for (i, node) in part.nodes.iter().enumerate() {
            let place = match part.parent(i) {
                Some(parent) => places[parent].child(node),
                None => {
                    made.begin(node);
                    known.clear();
                    Placement {
                        sound: sound::node(node),
                        ..Placement::WORLD
                    }
                }
            };
            places.push(place);
            let Some(mesh) = made.meshes.last_mut().filter(|_| place.sound) else {
                continue;
            };
            for primitive in flat::primitives(part, node) {
                let at = *known.entry(primitive.material).or_insert_with(|| {
                    mesh.primitives.push(empty(primitive.material));
                    mesh.primitives.len() - 1
                });
                pour(primitive, &place, &mut mesh.primitives[at]);
            }
        }
        made
    }

    fn begin(&mut self, house: &Node) {
        let number = self.first + self.meshes.len() as u32;
        self.meshes.push(Mesh {
            name: house.called().to_owned(),
            primitives: vec![],
        });
        self.nodes.push(Node {
            mesh: Some(MeshId(number)),
            ..house.clone()
        });
    }

    /// Returns the number of houses.
    pub fn count(&self) -> u32 {
        self.nodes.len() as u32
    }

    /// Returns them as houses of the scene that they come from.
    pub fn part<'s>(&'s self, of: ScenePart<'s>) -> ScenePart<'s> {
        ScenePart {
            meshes: &self.meshes,
            first_mesh: self.first,
            nodes: &self.nodes,
            first_node: self.first,
            // What is far off in a sound house may be too far off in the world.
            sound: false,
            ..of
        }
    }
}

fn empty(material: MaterialId) -> Primitive {
    Primitive {
        material,
        positions: vec![],
        normals: vec![],
        uvs: vec![],
        mirror_uvs: vec![],
        indices: vec![],
    }
}

/// Adds triangles at a place.
fn pour(from: &Primitive, place: &Placement, into: &mut Primitive) {
    let first = into.positions.len() as u32;
    let point = |p: &[f32; 3]| place.point(flat::point(*p)).as_vec3().to_array();
    into.positions.extend(from.positions.iter().map(point));
    let normal = |n: &[f32; 3]| {
        let turned: DVec3 = place.direction(flat::point(*n));
        turned.as_vec3().to_array()
    };
    into.normals.extend(from.normals.iter().map(normal));
    into.uvs.extend(&from.uvs);
    into.mirror_uvs.extend(&from.mirror_uvs);
    into.indices.extend(from.indices.iter().map(|i| first + i));
}
