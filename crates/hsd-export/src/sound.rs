//! Finds content that back ends must not write: non-finite numbers, and indices out of range. Earlier passes do not
//! produce them; if one does, the shape is left out and reported.

use hsd_base::source::Span;
use hsd_scene::{Material, Mesh, Node, Primitive, ScenePart};

/// Limit of coordinates, metres: f32 still resolves a decimetre there, and it exceeds map coordinates.
const LARGEST: f64 = 1e7;

/// A shape that is left out of every output.
#[derive(Clone, Debug, PartialEq)]
pub struct Flaw {
    /// The node's name.
    pub name: String,
    /// Its span in the source.
    pub span: Option<Span>,
}

/// Returns everything that the back ends leave out of some houses.
pub fn flaws<'s>(part: ScenePart<'s>) -> impl Iterator<Item = Flaw> + 's {
    let whole = |m: &Mesh| m.primitives.iter().all(|p| primitive(p, part.materials));
    let bad: Vec<bool> = part.meshes.iter().map(|m| !whole(m)).collect();
    let flawed = move |n: &&Node| {
        // Meshes that are not there were judged with the houses for which they were made.
        let at = n.mesh.map(|m| m.0.checked_sub(part.first_mesh));
        let mesh = at.flatten().map(|at| bad.get(at as usize).copied());
        !node(n) || mesh.is_some_and(|b| b.unwrap_or(true))
    };
    part.nodes.iter().filter(flawed).map(|n| Flaw {
        name: n.name.to_string(),
        span: n.span,
    })
}

/// Returns true if a node has a valid place.
pub fn node(node: &Node) -> bool {
    let turned = node.turn.length_squared();
    node.at.to_array().iter().all(|x| x.abs() < LARGEST) && (0.5..2.0).contains(&turned)
}

/// Returns true if triangles can be written.
pub fn primitive(p: &Primitive, materials: &[Material]) -> bool {
    let count = p.positions.len();
    // Of the width of the indices, so that several are compared at once.
    let most = u32::try_from(count).unwrap_or(u32::MAX);
    count > 0
        && p.normals.len() == count
        && p.uvs.len() == count
        && (p.mirror_uvs.len() == count || p.mirror_uvs.is_empty())
        && !p.indices.is_empty()
        && p.indices.len().is_multiple_of(3)
        && every(p.indices.iter().map(|&i| i < most))
        && materials
            .get(p.material.0 as usize)
            .is_some_and(|m| m.mirrored.is_none() || !p.mirror_uvs.is_empty())
        && every(
            p.positions
                .as_flattened()
                .iter()
                .map(|x| x.abs() < LARGEST as f32),
        )
        && every(p.normals.as_flattened().iter().map(|x| x.is_finite()))
        && every(p.uvs.as_flattened().iter().map(|x| x.is_finite()))
        && every(p.mirror_uvs.as_flattened().iter().map(|x| x.is_finite()))
}

/// Returns true if all hold. Nearly always they do, and without a way out many are looked at together.
fn every(all: impl Iterator<Item = bool>) -> bool {
    all.fold(true, |before, next| before & next)
}
