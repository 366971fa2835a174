//! A camera for tests: what is seen of a scene along parallel lines of sight, as triangles with orientation.

use glam::{DVec2, DVec3, dvec2};
use hsd::render::raster::Grid;
use hsd::scene::Scene;

/// What one line of sight meets first, and what lies behind it.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Metres along the line.
    pub depth: f64,
    /// Whether the face looks at the eye.
    pub front: bool,
    /// Of unit length, in the frame of the view.
    pub normal: DVec3,
    pub material: u32,
    /// Index of the node.
    pub node: u32,
}

/// The two nearest hits of every line of sight; lines stand on a square grid.
pub struct View {
    pub hits: Vec<[Option<Hit>; 2]>,
    grid: Grid,
    right: DVec3,
    up: DVec3,
    way: DVec3,
}

impl View {
    /// Looks along `way` at a whole scene with about `size` lines across its longer side. Faces of double-sided
    /// materials, of cut-outs and of see-through ones are left out.
    pub fn of(scene: &Scene, way: DVec3, size: usize) -> View {
        let way = way.normalize();
        let right = way.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        let up = right.cross(way);
        let mut triangles = vec![];
        for (n, node) in scene.nodes.iter().enumerate() {
            let Some(mesh) = node.mesh else { continue };
            let mut place: Vec<(DVec2, DVec3)> = vec![(node.turn, node.at)];
            let mut above = node.parent;
            while let Some(parent) = above.map(|p| &scene.nodes[p.0 as usize]) {
                place.push((parent.turn, parent.at));
                above = parent.parent;
            }
            let world = |p: [f32; 3]| {
                let p = DVec3::from_array(p.map(f64::from));
                let into = |p: DVec3, (turn, at): &(DVec2, DVec3)| {
                    turn.rotate(p.truncate()).extend(p.z) + *at
                };
                let p = place.iter().fold(p, into);
                DVec3::new(right.dot(p), up.dot(p), way.dot(p))
            };
            for primitive in &scene.meshes[mesh.0 as usize].primitives {
                let material = &scene.materials[primitive.material.0 as usize];
                if material.double_sided
                    || material.cutout
                    || material.tint[3] < 1.0
                    || material.reflection.is_some()
                {
                    continue;
                }
                let points: Vec<DVec3> = primitive.positions.iter().map(|p| world(*p)).collect();
                for t in primitive.indices.chunks(3) {
                    let corners = [0, 1, 2].map(|k| points[t[k] as usize]);
                    triangles.push((corners, primitive.material.0, n as u32));
                }
            }
        }
        let flat = triangles.iter().flat_map(|t| t.0).map(DVec3::truncate);
        let (lo, hi) = flat.fold((DVec2::MAX, DVec2::MIN), |(lo, hi), p| {
            (lo.min(p), hi.max(p))
        });
        let step = (hi - lo).max_element() / size as f64;
        // Lines of sight through no round number: none runs along an edge.
        let origin = lo + dvec2(0.347_21, 0.411_87) * step;
        let width = ((hi.x - lo.x) / step) as usize + 1;
        let height = ((hi.y - lo.y) / step) as usize + 1;
        let mut view = View {
            hits: vec![[None; 2]; width * height],
            grid: Grid {
                origin,
                step,
                width,
                height,
            },
            right,
            up,
            way,
        };
        for (corners, material, node) in triangles {
            view.draw(corners, material, node);
        }
        view
    }

    fn draw(&mut self, t: [DVec3; 3], material: u32, node: u32) {
        let [p, q, r] = t;
        let area = (q - p).truncate().perp_dot((r - p).truncate());
        let grid = self.grid;
        grid.meet(t.map(DVec3::truncate), |place, [u, v, w]| {
            let hit = Hit {
                depth: p.z * u + q.z * v + r.z * w,
                // Seen along `way` with x to the right and y up, z runs away: fronts turn counter-clockwise.
                front: area > 0.0,
                normal: (q - p).cross(r - p).normalize_or_zero(),
                material,
                node,
            };
            self.put(place, hit);
        });
    }

    fn put(&mut self, place: usize, hit: Hit) {
        let [first, second] = &mut self.hits[place];
        if first.is_none_or(|f| hit.depth < f.depth) {
            *second = first.replace(hit);
        } else if second.is_none_or(|s| hit.depth < s.depth) {
            *second = Some(hit);
        }
    }

    /// Where a line of sight meets what it meets first, metres in the world.
    pub fn point(&self, place: usize) -> DVec3 {
        let at = self.grid.at(place);
        let depth = self.hits[place][0].map_or(0.0, |h| h.depth);
        self.right * at.x + self.up * at.y + self.way * depth
    }
}
