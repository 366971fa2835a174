//! Flattened houses, for formats without a node tree: every mesh in world coordinates.

use super::sound;
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_scene::{Node, Primitive, ScenePart};

/// The placement of a node in the world, metres, z up.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Its origin.
    pub at: DVec3,
    /// (cos, sin) of its rotation about the vertical.
    pub turn: DVec2,
    /// True if it and all its ancestors can be written.
    pub sound: bool,
}

impl Placement {
    /// The world frame.
    pub const WORLD: Placement = Placement {
        at: DVec3::ZERO,
        turn: DVec2::X,
        sound: true,
    };

    /// Converts a point of the node's frame to the world.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.at + self.direction(p)
    }

    /// Converts a direction of the node's frame to the world.
    pub fn direction(&self, d: DVec3) -> DVec3 {
        let flat = self.turn.rotate(dvec2(d.x, d.y));
        dvec3(flat.x, flat.y, d.z)
    }

    /// Returns the placement of a child node in this frame.
    pub fn child(&self, node: &Node) -> Placement {
        let turn = self.turn.rotate(node.turn);
        Placement {
            at: self.point(node.at),
            turn: turn.try_normalize().unwrap_or(DVec2::X),
            sound: self.sound && sound::node(node),
        }
    }
}

/// Returns the placements of all nodes.
pub fn places(part: ScenePart<'_>) -> Vec<Placement> {
    let mut places: Vec<Placement> = Vec::with_capacity(part.nodes.len());
    for (i, node) in part.nodes.iter().enumerate() {
        let above = part.parent(i).map(|p| places[p]);
        places.push(above.unwrap_or(Placement::WORLD).child(node));
    }
    places
}

/// Returns the primitives of a node's mesh that can be written.
pub fn primitives<'s>(part: ScenePart<'s>, node: &Node) -> impl Iterator<Item = &'s Primitive> {
    let mesh = node.mesh.and_then(|m| part.mesh(m));
    mesh.into_iter()
        .flat_map(|m| &m.primitives)
        .filter(move |p| sound::primitive(p, part.materials))
}

/// Converts a vertex to a point.
pub fn point(p: [f32; 3]) -> DVec3 {
    dvec3(p[0].into(), p[1].into(), p[2].into())
}
