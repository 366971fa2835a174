//! Placements: the nodes of one mesh become one node with a list of placements.

use super::super::nodes::rotation;
use super::geometry::Geometry;
use crate::number::Number;
use crate::sound;
use glam::{DVec2, DVec3};
use gltf::json::{Index, Mesh};
use hsd_scene::Scene;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Placements farther apart are in separate lists, metres: relative to the first of a list, f32 then resolves a tenth
/// of a millimetre, and viewers can cull lists outside the view.
const CELL: f64 = 1024.0;

/// A node of the flat tree.
#[derive(Serialize)]
pub(in crate::gltf) struct Node<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    extensions: Option<Map<String, Value>>,
    mesh: Index<Mesh>,
    #[serde(skip_serializing_if = "str::is_empty")]
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    rotation: Option<[f32; 4]>,
    translation: [Number; 3],
}

/// A placement in the world, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    at: DVec3,
    turn: DVec2,
}

/// A mesh and its placements in one cell, in the order of the scene.
pub(super) struct Group {
    /// The mesh's number in the scene.
    shape: usize,
    mesh: Index<Mesh>,
    pub(super) places: Vec<Place>,
}

impl Place {
    /// Returns the placement of a node in the frame of this one.
    fn of(self, node: &hsd_scene::Node) -> Place {
        let at = self.turn.rotate(node.at.truncate()).extend(node.at.z);
        let turn = node.turn.try_normalize().unwrap_or(DVec2::X);
        let turn = self.turn.rotate(turn);
        Place {
            at: self.at + at,
            turn: turn.try_normalize().unwrap_or(DVec2::X),
        }
    }

    fn cell(self) -> [i64; 3] {
        (self.at / CELL).round().to_array().map(|x| x as i64)
    }
}

/// Groups all visible nodes by mesh and cell.
pub(super) fn groups(scene: &Scene, geometry: &Geometry<'_>) -> Vec<Group> {
    let mut found: BTreeMap<(u32, [i64; 3]), Group> = BTreeMap::new();
    let mut known: Vec<Option<Place>> = Vec::with_capacity(scene.nodes.len());
    let origin = Place {
        at: DVec3::ZERO,
        turn: DVec2::X,
    };
    for node in &scene.nodes {
        let above = match node.parent {
            Some(parent) => known.get(parent.0 as usize).copied().flatten(),
            None => Some(origin),
        };
        let place = above.filter(|_| sound::node(node)).map(|a| a.of(node));
        known.push(place);
        let (Some(place), Some(id), Some(mesh)) = (place, node.mesh, geometry.mesh(node)) else {
            continue;
        };
        let group = found.entry((id.0, place.cell())).or_insert_with(|| Group {
            shape: id.0 as usize,
            mesh,
            places: vec![],
        });
        group.places.push(place);
    }
    found.into_values().collect()
}

impl Group {
    /// Returns the offsets from the first placement, y up.
    pub(super) fn offsets(&self) -> Vec<f32> {
        let first = self.places[0].at;
        let offset = |p: &Place| up(p.at - first).map(|x| x as f32);
        self.places.iter().flat_map(offset).collect()
    }

    /// Returns the rotations, if there are any.
    pub(super) fn quaternions(&self) -> Option<Vec<f32>> {
        let turns = self.places.iter().map(|p| rotation(p.turn));
        let turned = turns.clone().any(|t| t.is_some());
        turned.then(|| {
            turns
                .flat_map(|t| t.unwrap_or([0.0, 0.0, 0.0, 1.0]))
                .collect()
        })
    }

    /// Returns the node, at the first placement; `extensions` list all of them if there are several.
    pub(super) fn node<'a>(
        &self,
        scene: &'a Scene,
        extensions: Option<Map<String, Value>>,
    ) -> Node<'a> {
        let first = self.places[0];
        Node {
            mesh: self.mesh,
            name: &scene.meshes[self.shape].name,
            rotation: match extensions {
                Some(_) => None,
                None => rotation(first.turn),
            },
            translation: up(first.at).map(Number),
            extensions,
        }
    }
}

/// Converts from z up to y up.
fn up(at: DVec3) -> [f64; 3] {
    [at.x, at.z, 0.0 - at.y]
}
