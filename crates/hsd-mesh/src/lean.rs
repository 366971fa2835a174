//! Detail 0: a house as one node with one mesh, since a city has a million of them.

use crate::mesh::Soup;
use crate::store::Store;
use crate::store::draft::MeshDraft;
use crate::store::look::Look;
use glam::{DVec2, DVec3, Vec3};
use hsd_scene::{MeshId, Node, NodeId};
use std::sync::Arc;

/// The name of the mesh: houses that look the same share one.
const NAME: &str = "house";

/// Joins what the nodes from `root` on show in the mesh of the root, and drops the others.
pub(super) fn join(nodes: &mut Vec<Node>, root: NodeId, store: &mut Store<'_>) {
    let first = root.0 as usize;
    let mut places: Vec<(DVec3, DVec2)> = Vec::with_capacity(nodes.len() - first);
    let mut soups: Vec<(Look, Soup)> = vec![];
    for (i, node) in nodes[first..].iter().enumerate() {
        let place = match node.parent.filter(|_| i > 0) {
            None => (DVec3::ZERO, DVec2::X),
            Some(parent) => {
                let (at, turn) = places[(parent.0 - root.0) as usize];
                let own = turn.rotate(node.at.truncate()).extend(node.at.z);
                (at + own, turn.rotate(node.turn))
            }
        };
        places.push(place);
        if let Some(mesh) = node.mesh {
            pour(store.draft(mesh), place, &mut soups);
        }
    }
    nodes.truncate(first + 1);
    let shown = !soups.is_empty();
    nodes[first].mesh = shown.then(|| store.push(MeshDraft::new(NAME.into(), soups, vec![])));
}

/// Returns the drafts that nodes show, which are numbered anew, and the size of the others, bytes: they have become parts of
/// these. Dropped where they were made, they leave their memory to the houses that follow.
pub(super) fn shown(nodes: &mut [Node], all: &[Arc<MeshDraft>]) -> (Vec<Arc<MeshDraft>>, usize) {
    let mut drafts = Vec::with_capacity(nodes.len());
    let mut numbers = vec![None; all.len()];
    for id in nodes.iter_mut().filter_map(|node| node.mesh.as_mut()) {
        let old = id.0 as usize;
        *id = *numbers[old].get_or_insert_with(|| {
            drafts.push(Arc::clone(&all[old]));
            MeshId(drafts.len() as u32 - 1)
        });
    }
    let others = all.iter().zip(numbers).filter(|(_, n)| n.is_none());
    (drafts, others.map(|(draft, _)| draft.size()).sum())
}

/// Adds the triangles of a mesh at a place.
fn pour(draft: &MeshDraft, (at, turn): (DVec3, DVec2), soups: &mut Vec<(Look, Soup)>) {
    for (look, soup) in &draft.soups {
        let known = soups.iter().position(|(other, _)| other == look);
        let known = known.unwrap_or_else(|| {
            soups.push((*look, Soup::default()));
            soups.len() - 1
        });
        let into = &mut soups[known].1;
        let vertices = into.positions.len() as u32;
        let turned = |v: &[f32; 3]| {
            let [x, y, z] = v.map(f64::from);
            turn.rotate(DVec2::new(x, y)).extend(z)
        };
        // Storeys and roofs are not turned in their house.
        if turn == DVec2::X {
            let point = |p: &[f32; 3]| (at + Vec3::from(*p).as_dvec3()).as_vec3().to_array();
            into.positions.extend(soup.positions.iter().map(point));
            into.normals.extend_from_slice(&soup.normals);
        } else {
            let point = |p: &[f32; 3]| (at + turned(p)).as_vec3().to_array();
            into.positions.extend(soup.positions.iter().map(point));
            let normal = |n: &[f32; 3]| turned(n).as_vec3().to_array();
            into.normals.extend(soup.normals.iter().map(normal));
        }
        into.uvs.extend_from_slice(&soup.uvs);
        into.indices
            .extend(soup.indices.iter().map(|i| vertices + i));
    }
}
