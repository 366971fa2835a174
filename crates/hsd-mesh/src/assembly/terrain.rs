//! The ground of a town as a part of its scene.

use super::HouseDrafts;
use crate::mesh::Soup;
use crate::store::draft::MeshDraft;
use crate::store::look::{Look, Share};
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Kind, MeshId, Node};
use std::sync::Arc;

/// A piece of ground: a mesh over a part of the town.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundMesh {
    /// Corners in the frame of the town, metres.
    pub positions: Vec<DVec3>,
    /// Unit normals of the corners.
    pub normals: Vec<DVec3>,
    /// Triangles, counter-clockwise seen from above.
    pub indices: Vec<u32>,
}

/// The texture repeats in whole metres: coordinates count from a multiple of this, so that f32 resolves them.
const TURN: f64 = 1024.0;

/// Returns a piece of ground as a node of this name, whose mesh counts from `at`.
pub fn ground(name: &str, at: DVec3, mesh: &GroundMesh) -> HouseDrafts {
    let from = (at.truncate() / TURN).floor() * TURN;
    let uv = |p: &DVec3| (p.truncate() - from).as_vec2().to_array();
    let soup = Soup {
        positions: mesh
            .positions
            .iter()
            .map(|p| (*p - at).as_vec3().to_array())
            .collect(),
        normals: mesh
            .normals
            .iter()
            .map(|n| n.as_vec3().to_array())
            .collect(),
        uvs: mesh.positions.iter().map(uv).collect(),
        indices: mesh.indices.clone(),
        left_out: 0,
    };
    let look = Look::surface(SurfaceId::named("earth"), Share::default());
    let draft = MeshDraft::new(name.to_owned(), vec![(look, soup)], vec![]);
    let mut node = Node::new(None, Kind::Ground, name.into(), at);
    node.turn = DVec2::X;
    node.mesh = Some(MeshId(0));
    HouseDrafts {
        nodes: vec![node],
        drafts: vec![Arc::new(draft)],
        joined: 0,
        oversized: vec![],
    }
}
