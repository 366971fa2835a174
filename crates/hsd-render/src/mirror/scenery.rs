//! The geometry in front of a wall. Nodes are culled by their bounding boxes, so that the cost depends on what is in the
//! beam.

use crate::GROUND;
use crate::beam::{Beam, NEAR};
use crate::mirror::walls::Wall;
use crate::raster::Grid;
use crate::view;
use crate::view::{Frame, Place, Triangle};
use glam::{DVec2, DVec3, dvec3};
use hsd_scene::{Mesh, Scene};

/// The extent of the ground to the sides and ahead in metres: up to the horizon.
const HORIZON: f64 = 20.0 * GROUND;

/// A scene with the transforms and bounding boxes of its nodes.
pub(super) struct PlacedScene<'a> {
    scene: &'a Scene,
    nodes: Vec<PlacedNode>,
}

/// A node with geometry.
struct PlacedNode {
    node: usize,
    place: Place,
    /// The corners of its bounding box in world space.
    corners: [DVec3; 8],
}

impl<'a> PlacedScene<'a> {
    pub(super) fn new(scene: &'a Scene) -> PlacedScene<'a> {
        let boxes: Vec<Option<[DVec3; 8]>> = scene.meshes.iter().map(corners).collect();
        let places = view::places(scene).into_iter();
        let shown = scene.nodes.iter().enumerate().zip(places);
        let nodes = shown.filter_map(|((node, shown), place)| {
            let corners = boxes.get(shown.mesh?.0 as usize).copied().flatten()?;
            Some(PlacedNode {
                node,
                place,
                corners: corners.map(|p| place.point(p)),
            })
        });
        PlacedScene {
            scene,
            nodes: nodes.collect(),
        }
    }

    /// Returns the triangles of the nodes that satisfy `wanted`.
    fn triangles(&self, wanted: impl Fn(&PlacedNode) -> bool) -> Vec<Triangle> {
        let mut found = vec![];
        for placed in self.nodes.iter().filter(|s| wanted(s)) {
            let node = &self.scene.nodes[placed.node];
            view::pour(self.scene, node, placed.place, &mut found);
        }
        found
    }

    /// Returns the triangles that a wall may reflect in a beam, including the ground.
    pub(super) fn in_beam(&self, wall: &Wall, beam: &Beam) -> Vec<Triangle> {
        let plane = wall.plane;
        let mut found = self.triangles(|placed| {
            !wall.owns(placed.node) && beam.holds(&placed.corners.map(|p| plane.of(p)))
        });
        let at = |x: f64, z: f64| {
            let middle = (wall.low.x + wall.high.x) / 2.0;
            plane.world(dvec3(middle + x, wall.ground - 0.01, z))
        };
        let [a, b, c, d] = [
            at(-HORIZON, 0.0),
            at(HORIZON, 0.0),
            at(HORIZON, HORIZON),
            at(-HORIZON, HORIZON),
        ];
        found.extend([[a, b, c], [a, c, d]].map(Triangle::ground));
        found
    }

    /// Returns the triangles that may cast shadows within a grid of sun rays.
    pub(super) fn under(&self, sun: &Frame, grid: &Grid) -> Vec<Triangle> {
        let (low, high) = (grid.at(0), grid.at(grid.width * grid.height - 1));
        self.triangles(|placed| {
            let points = placed.corners.map(|p| sun.of(p));
            let least = points.iter().fold(DVec2::MAX, |a, p| a.min(*p));
            let most = points.iter().fold(DVec2::MIN, |a, p| a.max(*p));
            least.cmple(high).all() && most.cmpge(low).all()
        })
    }

    /// Returns the free distance perpendicular to a point of a wall; obstacles nearer than `past` are ignored.
    pub(super) fn free(&self, wall: &Wall, from: DVec2, past: f64) -> Option<f64> {
        let plane = wall.plane;
        let before = self.triangles(|placed| {
            let points = placed.corners.map(|p| plane.of(p));
            let least = points.iter().fold(DVec3::MAX, |a, p| a.min(*p));
            let most = points.iter().fold(DVec3::MIN, |a, p| a.max(*p));
            let meets = least.truncate().cmple(from).all() && most.truncate().cmpge(from).all();
            meets && most.z > past.max(NEAR) && !wall.owns(placed.node)
        });
        let line = Grid {
            origin: from,
            step: 1.0,
            width: 1,
            height: 1,
        };
        let mut free: Option<f64> = None;
        for triangle in &before {
            let corners = triangle.corners.map(|p| plane.of(p));
            line.meet(corners.map(|p| p.truncate()), |_, weights| {
                let way: f64 = corners.iter().zip(weights).map(|(p, w)| p.z * w).sum();
                if way > past && free.is_none_or(|f| way < f) {
                    free = Some(way);
                }
            });
        }
        free
    }
}

/// Returns the corners of the bounding box of a mesh; `None` if it is empty.
fn corners(mesh: &Mesh) -> Option<[DVec3; 8]> {
    let points = mesh.primitives.iter().flat_map(|p| &p.positions);
    let mut points = points.map(|p| view::point(*p));
    let first = points.next()?;
    let (low, high) = points.fold((first, first), |(l, h), p| (l.min(p), h.max(p)));
    let side = |k: usize, bit: usize, axis: usize| match k >> bit & 1 {
        0 => low[axis],
        _ => high[axis],
    };
    Some(std::array::from_fn(|k| {
        dvec3(side(k, 0, 0), side(k, 1, 1), side(k, 2, 2))
    }))
}
