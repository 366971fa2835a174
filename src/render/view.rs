//! What is seen along parallel lines of sight: the nearest triangle on each.

use crate::render::raster::Grid;
use crate::scene::{MaterialId, Node, NodeId, Scene};
use glam::{DVec2, DVec3};

/// Axes of an eye: to the right, up, and the way it looks.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    right: DVec3,
    up: DVec3,
    way: DVec3,
}

impl Frame {
    /// An eye that looks this way and holds its head upright.
    pub fn new(way: DVec3) -> Frame {
        let way = way.normalize();
        let right = way.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Frame {
            right,
            up: right.cross(way),
            way,
        }
    }

    /// A point as the eye sees it.
    pub fn of(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.up.dot(p))
    }

    /// How far away a point is.
    pub fn depth(&self, p: DVec3) -> f64 {
        self.way.dot(p)
    }

    /// Where the eye looks.
    pub fn way(&self) -> DVec3 {
        self.way
    }
}

/// A triangle in the world.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Metres.
    pub corners: [DVec3; 3],
    /// At the corners, of unit length.
    pub normals: [DVec3; 3],
    /// Texture coordinates at the corners.
    pub uvs: [DVec2; 3],
    /// `None` = the ground.
    pub material: Option<MaterialId>,
}

impl Triangle {
    /// Texture coordinates at some weights of the corners.
    pub(super) fn uv(&self, [a, b, c]: [f64; 3]) -> DVec2 {
        self.uvs[0] * a + self.uvs[1] * b + self.uvs[2] * c
    }

    /// A piece of the ground.
    pub(super) fn ground(corners: [DVec3; 3]) -> Triangle {
        Triangle {
            corners,
            normals: [DVec3::Z; 3],
            uvs: [DVec2::ZERO; 3],
            material: None,
        }
    }
}

/// Where a node stands in the world: how it is turned about the vertical, and its origin.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// (cos, sin).
    pub turn: DVec2,
    /// Metres.
    pub at: DVec3,
}

impl Place {
    /// A way of the node's frame in the world.
    pub fn way(&self, v: DVec3) -> DVec3 {
        self.turn.rotate(v.truncate()).extend(v.z)
    }

    /// A point of the node's frame in the world.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.way(p) + self.at
    }
}

/// The places of all nodes. They stand behind their parents: one walk tells where each is.
pub fn places(scene: &Scene) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::with_capacity(scene.nodes.len());
    for node in &scene.nodes {
        let own = Place {
            turn: node.turn,
            at: node.at,
        };
        places.push(match node.parent {
            None => own,
            Some(parent) => {
                let above = places[parent.0 as usize];
                Place {
                    turn: above.turn.rotate(node.turn),
                    at: above.point(node.at),
                }
            }
        });
    }
    places
}

/// The root above each node.
pub fn roots(scene: &Scene) -> Vec<NodeId> {
    let mut roots: Vec<NodeId> = Vec::with_capacity(scene.nodes.len());
    for (n, node) in (0..).zip(&scene.nodes) {
        let above = node.parent.map(|parent| roots[parent.0 as usize]);
        roots.push(above.unwrap_or(NodeId(n)));
    }
    roots
}

/// A corner of an array of the scene.
pub(super) fn point(p: [f32; 3]) -> DVec3 {
    DVec3::from_array(p.map(f64::from))
}

/// Adds the triangles that a node in its place shows.
pub fn pour(scene: &Scene, node: &Node, place: Place, into: &mut Vec<Triangle>) {
    let Some(mesh) = node.mesh else {
        return;
    };
    for primitive in &scene.meshes[mesh.0 as usize].primitives {
        for t in primitive.indices.chunks_exact(3) {
            let corner = |k: usize| t[k] as usize;
            into.push(Triangle {
                corners: [0, 1, 2].map(|k| place.point(point(primitive.positions[corner(k)]))),
                normals: [0, 1, 2].map(|k| place.way(point(primitive.normals[corner(k)]))),
                uvs: [0, 1, 2].map(|k| {
                    let uv = primitive.uvs[corner(k)].map(f64::from);
                    DVec2::from_array(uv)
                }),
                material: Some(primitive.material),
            });
        }
    }
}

/// All triangles of some houses, each given by its node, in the world.
pub fn triangles(scene: &Scene, houses: &[NodeId]) -> Vec<Triangle> {
    let mut found = vec![];
    let nodes = scene.nodes.iter().zip(places(scene)).zip(roots(scene));
    for ((node, place), _) in nodes.filter(|(_, root)| houses.contains(root)) {
        pour(scene, node, place, &mut found);
    }
    found
}

/// What one line of sight meets first.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Metres along the line.
    pub depth: f64,
    /// Index of the triangle.
    pub triangle: u32,
    /// Shares of its corners there.
    pub weights: [f32; 3],
}

/// The nearest hit on every line.
pub struct View {
    /// How the eye stands.
    pub frame: Frame,
    /// Its lines of sight.
    pub grid: Grid,
    /// By their places in the grid.
    pub hits: Vec<Option<Hit>>,
}

impl View {
    /// Looks at triangles; one may be `open` at some weights of its corners.
    pub fn of(
        triangles: &[Triangle],
        frame: Frame,
        grid: Grid,
        open: impl Fn(&Triangle, [f64; 3]) -> bool,
    ) -> View {
        let mut hits: Vec<Option<Hit>> = vec![None; grid.width * grid.height];
        for (index, triangle) in triangles.iter().enumerate() {
            let corners = triangle.corners.map(|p| frame.of(p));
            let depths = triangle.corners.map(|p| frame.depth(p));
            grid.meet(corners, |place, weights| {
                let [a, b, c] = [0, 1, 2].map(|k| depths[k] * weights[k]);
                let depth = a + b + c;
                let hit = &mut hits[place];
                if hit.is_none_or(|h| depth < h.depth) && !open(triangle, weights) {
                    *hit = Some(Hit {
                        depth,
                        triangle: index as u32,
                        weights: weights.map(|w| w as f32),
                    });
                }
            });
        }
        View { frame, grid, hits }
    }
}
