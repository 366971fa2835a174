//! What is drawn: the bodies of houses in the frame of the first of them, each with its role.
//!
//! Frame: metres, x to the right along the first house's first line as seen from outside, y back into the plot, z up from
//! the ground.

use crate::paper::Role;
use glam::{DVec2, DVec3, dvec2};
use hsd_base::geometry::Heading;
use hsd_ir::building::{Building, Built, House};
use hsd_ir::catalog::{Catalog, Opening, PartDef};
use hsd_ir::program::{Content, Picture, Unit};
use hsd_scene::{Kind, Mesh, Node, Scene};
use std::collections::HashMap;

/// Corners nearer than this are one, metres.
const WELD: f64 = 2e-5;

/// Houses to be drawn.
pub struct Subject<'b> {
    catalog: &'b Catalog,
    images: &'b [Picture],
    /// The houses.
    pub houses: Vec<&'b Built>,
    /// All bodies of them.
    pub bodies: Vec<Body>,
}

/// Triangles of one node.
#[derive(Clone, Debug)]
pub struct Body {
    /// What it is where it is cut.
    pub role: Role,
    /// The code of the part.
    pub code: Option<String>,
    /// True for a part that stands outdoors by itself.
    pub outdoors: bool,
    /// Its corners, each once.
    pub points: Vec<DVec3>,
    /// Corners of triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The material of each triangle: where it changes, an edge is seen.
    pub materials: Vec<u32>,
}

/// A turn about the vertical, then a shift.
#[derive(Clone, Copy)]
struct Place {
    turn: DVec2,
    at: DVec3,
}

impl Place {
    fn point(&self, p: DVec3) -> DVec3 {
        self.turn.rotate(p.truncate()).extend(p.z) + self.at
    }

    fn within(&self, inner: Place) -> Place {
        Place {
            turn: self.turn.rotate(inner.turn),
            at: self.point(inner.at),
        }
    }

    /// Returns the place of the world in the frame of this one.
    fn inverse(&self) -> Place {
        let turn = dvec2(self.turn.x, -self.turn.y);
        let at = turn.rotate(self.at.truncate());
        Place {
            turn,
            at: -at.extend(self.at.z),
        }
    }
}

/// The place of a house in the world, on the ground.
fn place_of(house: &House) -> Place {
    let [east, north, up] = house.origin;
    Place {
        turn: Heading::new(180.0 - house.azimuth).vector(),
        at: DVec3::new(east, north, up - house.raised),
    }
}

impl<'b> Subject<'b> {
    /// Collects the bodies of houses. `chosen` are their places in `building`; `scene` shows nothing else.
    pub fn new(
        building: &'b Building,
        chosen: impl Fn(&House) -> bool,
        scene: &Scene,
        catalog: &'b Catalog,
    ) -> Subject<'b> {
        let houses: Vec<&Built> = building
            .houses
            .iter()
            .filter(|b| chosen(&b.house))
            .collect();
        let Some(first) = houses.first() else {
            return Subject {
                catalog,
                images: &building.images,
                houses,
                bodies: vec![],
            };
        };
        let world = place_of(&first.house).inverse();
        // Roots are those of the houses in their order, without houses of too many triangles.
        let whole = building.houses.iter().map(|b| &b.house);
        let mut roots = whole.filter(|h| !scene.oversized.contains(&h.span));
        let mut welded: HashMap<u32, Body> = HashMap::new();
        let mut places: Vec<Option<Place>> = Vec::with_capacity(scene.nodes.len());
        let mut bodies = vec![];
        for node in &scene.nodes {
            let own = Place {
                turn: node.turn,
                at: node.at,
            };
            let place = match node.parent {
                Some(above) => places[above.0 as usize].map(|p| p.within(own)),
                None => roots.next().is_some_and(&chosen).then(|| world.within(own)),
            };
            places.push(place);
            let (Some(place), Some(mesh)) = (place, node.mesh) else {
                continue;
            };
            let shape = welded
                .entry(mesh.0)
                .or_insert_with(|| Body::welded(&scene.meshes[mesh.0 as usize]));
            bodies.push(Body {
                role: role(node, scene, catalog),
                code: node.code.map(|c| c.as_str().to_owned()),
                outdoors: stands_alone(node, scene),
                points: shape.points.iter().map(|p| place.point(*p)).collect(),
                triangles: shape.triangles.clone(),
                materials: shape.materials.clone(),
            });
        }
        Subject {
            catalog,
            images: &building.images,
            houses,
            bodies,
        }
    }

    /// Returns where a point in a house's own plan, in its units, lies in the frame of the subject.
    pub fn plan_point(&self, house: &House, p: DVec2) -> DVec2 {
        self.point(house, house.place(p, 0.0)).truncate()
    }

    /// Returns where a point in a house's own frame, metres above its first floor, lies in the frame of the subject.
    pub fn point(&self, house: &House, p: DVec3) -> DVec3 {
        let world = place_of(&self.houses[0].house).inverse();
        let own = world.within(place_of(house));
        own.point(p + DVec3::Z * house.raised)
    }

    /// Returns the code of the part in a bay; of a divided one that of its lower half. None for a void.
    pub fn code_of(&self, unit: &Unit) -> Option<String> {
        match &unit.content {
            Content::Part(id) => Some(self.catalog.part(*id).code().to_owned()),
            Content::Split(split) => split.lower.first().and_then(|u| self.code_of(u)),
            Content::Picture(id) => {
                let picture = self.images.get(id.0 as usize);
                picture.map(|p| p.name.clone())
            }
            Content::Void => None,
        }
    }

    /// Returns the bounds of everything.
    pub fn bounds(&self) -> [DVec3; 2] {
        let points = self.bodies.iter().flat_map(|b| &b.points);
        points.fold([DVec3::MAX, DVec3::MIN], |[lo, hi], p| {
            [lo.min(*p), hi.max(*p)]
        })
    }
}

impl Body {
    /// Creates one from a mesh, in its own frame.
    fn welded(mesh: &Mesh) -> Body {
        let mut known: HashMap<[i64; 3], u32> = HashMap::new();
        let mut body = Body {
            role: Role::Wall,
            code: None,
            outdoors: false,
            points: vec![],
            triangles: vec![],
            materials: vec![],
        };
        for primitive in &mesh.primitives {
            let numbers: Vec<u32> = primitive
                .positions
                .iter()
                .map(|p| {
                    let p = DVec3::from_array(p.map(f64::from));
                    *known
                        .entry((p / WELD).round().to_array().map(|n| n as i64))
                        .or_insert_with(|| {
                            body.points.push(p);
                            body.points.len() as u32 - 1
                        })
                })
                .collect();
            for t in primitive.indices.chunks_exact(3) {
                let corners = [t[0], t[1], t[2]].map(|c| numbers[c as usize]);
                let [a, b, c] = corners;
                if a != b && b != c && c != a {
                    body.triangles.push(corners);
                    body.materials.push(primitive.material.0);
                }
            }
        }
        body
    }

    /// Returns the unit normal of a triangle; zero if it has no area.
    pub fn normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.triangles[triangle].map(|p| self.points[p as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

/// True for a part in a house itself, not in one of its walls.
fn stands_alone(node: &Node, scene: &Scene) -> bool {
    let above = node.parent.map(|p| scene.nodes[p.0 as usize].kind);
    node.kind == Kind::Part && above == Some(Kind::House)
}

/// The role of a node's body where it is cut.
fn role(node: &Node, scene: &Scene, catalog: &Catalog) -> Role {
    let above = node.parent.map(|p| scene.nodes[p.0 as usize].kind);
    match node.kind {
        // Mats lie in rooms.
        Kind::Room if above == Some(Kind::Room) => Role::Mat,
        Kind::Part => {
            let code = node.code.as_deref().unwrap_or_default();
            let part = catalog.parts().iter().find(|p| p.code() == code);
            part.map_or(Role::Wall, part_role)
        }
        Kind::House | Kind::Storey | Kind::Facade => Role::Wall,
        Kind::Post => Role::Post,
        Kind::Roof => Role::Roof,
        Kind::Platform | Kind::Veranda | Kind::Room | Kind::Ground | Kind::Outdoors => Role::Floor,
        Kind::Member | Kind::Fixture | Kind::Bracket | Kind::Finial | Kind::Tree => Role::Timber,
    }
}

/// The role of a bay of a part.
pub fn part_role(part: &PartDef) -> Role {
    match part.opening() {
        Some(Opening::Door) => Role::Door,
        Some(Opening::Window) => Role::Window,
        None if part.is_open() => Role::Open,
        None => Role::Wall,
    }
}
