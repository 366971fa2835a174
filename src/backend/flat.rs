//! A scene without its tree, for formats that know none: every mesh where it stands.

use super::sound;
use crate::scene::{Node, Primitive, Scene};
use glam::{DVec2, DVec3, dvec2, dvec3};

/// Where a node stands in the world, metres, z up.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Its origin.
    pub at: DVec3,
    /// (cos, sin) of its turn about the vertical.
    pub turn: DVec2,
    /// Whether it and all nodes above it can be written.
    pub sound: bool,
}

impl Place {
    /// The world itself.
    pub const WORLD: Place = Place {
        at: DVec3::ZERO,
        turn: DVec2::X,
        sound: true,
    };

    /// A point of the node's frame in the world.
    pub fn point(&self, p: DVec3) -> DVec3 {
        let flat = self.turn.rotate(dvec2(p.x, p.y));
        self.at + dvec3(flat.x, flat.y, p.z)
    }

    /// The place of a node in a frame that stands here.
    pub fn child(&self, node: &Node) -> Place {
        let turn = self.turn.rotate(node.turn);
        Place {
            at: self.point(node.at),
            turn: turn.try_normalize().unwrap_or(DVec2::X),
            sound: self.sound && sound::node(node),
        }
    }
}

/// The places of all nodes.
pub fn places(scene: &Scene) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::with_capacity(scene.nodes.len());
    for node in &scene.nodes {
        let above = node.parent.and_then(|p| places.get(p.0 as usize).copied());
        places.push(above.unwrap_or(Place::WORLD).child(node));
    }
    places
}

/// The primitives of a node's mesh that can be written.
pub fn primitives<'a>(scene: &'a Scene, node: &Node) -> impl Iterator<Item = &'a Primitive> {
    let mesh = node.mesh.and_then(|m| scene.meshes.get(m.0 as usize));
    mesh.into_iter()
        .flat_map(|m| &m.primitives)
        .filter(|p| sound::primitive(p, scene))
}

/// A vertex as a point.
pub fn point(p: [f32; 3]) -> DVec3 {
    dvec3(p[0].into(), p[1].into(), p[2].into())
}
