//! Buildings as CityJSON 2.0 objects, with geometry at LoD 1 (a block up to the plate), 2 (walls and roofs) and 3 (with openings).
//!
//! Coordinates are whole millimetres from the town's origin; `transform` puts them into the plane of the town.

use super::flat::{self, Placement};
use glam::{DVec2, DVec3};
use hsd_base::geometry::area2;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::Built;
use hsd_ir::catalog::Opening;
use hsd_scene::{Kind, Scene};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::ops::Range;

/// Units in a metre.
const MM: f64 = 1000.0;
/// Surfaces of walls and roofs whose unit normal rises or falls by more belong to a roof.
const SLOPE: f64 = 0.1;
/// The version of the format.
const VERSION: &str = "2.0";
/// Surfaces, by their number in the semantics of a geometry.
const SURFACES: [&str; 5] = [
    "WallSurface",
    "RoofSurface",
    "GroundSurface",
    "Door",
    "Window",
];
const WALL: usize = 0;
const ROOF: usize = 1;
const GROUND: usize = 2;
const DOOR: usize = 3;
const WINDOW: usize = 4;

/// A house as an object of a city.
pub struct CityHouse {
    id: String,
    object: Value,
    vertices: Vertices,
}

/// The corners of an object, each once.
#[derive(Default)]
struct Vertices {
    all: Vec<[i64; 3]>,
    known: BTreeMap<[i64; 3], usize>,
}

impl Vertices {
    fn number(&mut self, p: DVec3) -> usize {
        self.number_of((p * MM).round().to_array().map(|x| x as i64))
    }

    fn number_of(&mut self, corner: [i64; 3]) -> usize {
        *self.known.entry(corner).or_insert_with(|| {
            self.all.push(corner);
            self.all.len() - 1
        })
    }
}

/// The frame of a city: its reference system and origin.
pub struct City {
    /// The code of the plane, if it has one.
    pub epsg: Option<String>,
    /// Metres east and north in the plane that are 0 0 of the houses.
    pub origin: DVec2,
}

impl City {
    fn head(&self) -> Map<String, Value> {
        let (east, north) = (self.origin.x, self.origin.y);
        let mut head = Map::new();
        head.insert("type".into(), "CityJSON".into());
        head.insert("version".into(), VERSION.into());
        let transform =
            json!({"scale": [1.0 / MM, 1.0 / MM, 1.0 / MM], "translate": [east, north, 0.0]});
        head.insert("transform".into(), transform);
        if let Some(epsg) = &self.epsg {
            let system = format!("https://www.opengis.net/def/crs/EPSG/0/{epsg}");
            head.insert("metadata".into(), json!({"referenceSystem": system}));
        }
        head
    }

    /// Returns the first line of a CityJSONSeq.
    pub fn first_line(&self) -> String {
        let mut head = self.head();
        head.insert("CityObjects".into(), json!({}));
        head.insert("vertices".into(), json!([]));
        Value::Object(head).to_string() + "\n"
    }

    /// Returns a file of all houses.
    pub fn file(&self, houses: Vec<CityHouse>) -> String {
        let (mut objects, mut vertices) = (Map::new(), Vertices::default());
        for mut house in houses {
            let corners = house.vertices.all.iter();
            let numbers: Vec<usize> = corners.map(|c| vertices.number_of(*c)).collect();
            renumber(&mut house.object, &numbers);
            objects.insert(house.id, house.object);
        }
        let mut head = self.head();
        head.insert("CityObjects".into(), Value::Object(objects));
        head.insert("vertices".into(), json!(vertices.all));
        Value::Object(head).to_string() + "\n"
    }
}

/// Gives the corners of an object the numbers they have in the city.
fn renumber(object: &mut Value, numbers: &[usize]) {
    fn each(value: &mut Value, numbers: &[usize]) {
        match value {
            Value::Array(all) => all.iter_mut().for_each(|value| each(value, numbers)),
            Value::Number(n) => {
                let corner = n.as_u64().and_then(|n| numbers.get(n as usize));
                *value = corner.copied().unwrap_or(0).into();
            }
            _ => {}
        }
    }
    let geometries = object["geometry"].as_array_mut();
    for geometry in geometries.into_iter().flatten() {
        each(&mut geometry["boundaries"], numbers);
    }
}

impl CityHouse {
    /// Begins a house: its name, which is unique, what is known of it, and its walls.
    pub fn new(id: String, mut attributes: Map<String, Value>, house: &Built) -> CityHouse {
        let rooms = house
            .house
            .storeys
            .iter()
            .filter(|s| s.kind == StoreyKind::Storey);
        let rooms = rooms.filter(|s| s.rings.iter().any(|r| r.closed && !r.inner));
        let top = rooms.clone().map(|s| s.z1).fold(0.0, f64::max);
        attributes.insert("storeysAboveGround".into(), rooms.count().into());
        let mut made = CityHouse {
            id,
            object: json!({"type": "Building", "attributes": attributes, "geometry": []}),
            vertices: Vertices::default(),
        };
        made.block(house, top);
        made
    }

    /// Begins what is no building: its name, which is unique, what is known of it, and its class.
    pub fn open(id: String, attributes: Map<String, Value>, class: &str) -> CityHouse {
        CityHouse {
            id,
            object: json!({"type": class, "attributes": attributes, "geometry": []}),
            vertices: Vertices::default(),
        }
    }

    /// Makes a piece of ground: its name, what is known of it, its corners and triangles.
    pub fn ground(
        id: String,
        attributes: Map<String, Value>,
        (corners, indices): (&[DVec3], &[u32]),
    ) -> CityHouse {
        let mut made = CityHouse {
            id,
            object: json!({"type": "TINRelief", "attributes": attributes, "geometry": []}),
            vertices: Vertices::default(),
        };
        let numbers: Vec<usize> = corners.iter().map(|p| made.vertices.number(*p)).collect();
        let triangles = indices.chunks_exact(3);
        let triangles =
            triangles.map(|t| [t[0], t[1], t[2]].map(|corner| numbers[corner as usize]));
        let faces: Vec<Value> = triangles.map(|corners| json!([corners])).collect();
        made.add(json!({"type": "CompositeSurface", "lod": "1", "boundaries": faces}));
        made
    }

    /// Adds the block between the outline and the plate: LoD 1.
    fn block(&mut self, house: &Built, top: f64) {
        let ground = house.house.origin[2];
        let storey = house.house.storeys.first();
        let rings = storey.iter().flat_map(|s| &s.rings);
        let mut rings: Vec<(bool, Vec<DVec2>)> = rings
            .filter(|r| r.closed && !r.inner)
            .map(|r| {
                let corners = r.walls.iter().map(|w| house.house.world(w.from));
                (r.hole, corners.collect())
            })
            .collect();
        rings.sort_by_key(|(hole, _)| *hole);
        if top <= 0.0 || rings.iter().filter(|(hole, _)| !hole).count() != 1 {
            return;
        }
        // Seen from above an outline runs counter-clockwise, a court clockwise.
        for (hole, ring) in &mut rings {
            if (area2(ring) > 0.0) == *hole {
                ring.reverse();
            }
        }
        let mut numbers = |z: f64| -> Vec<Vec<usize>> {
            let at = |p: &DVec2| p.extend(ground + z);
            let rings = rings.iter().map(|(_, ring)| ring);
            rings
                .map(|ring| ring.iter().map(|p| self.vertices.number(at(p))).collect())
                .collect()
        };
        let (low, high) = (numbers(0.0), numbers(top));
        let below = low.iter().map(|ring| ring.iter().rev().copied().collect());
        let below: Vec<Vec<usize>> = below.collect();
        let mut faces = vec![json!(below), json!(high)];
        for (low, high) in low.iter().zip(&high) {
            let n = low.len();
            faces.extend((0..n).map(|k| {
                let next = (k + 1) % n;
                json!([[low[k], low[next], high[next], high[k]]])
            }));
        }
        self.add(json!({"type": "Solid", "lod": "1", "boundaries": [faces]}));
    }

    fn add(&mut self, geometry: Value) {
        if let Some(all) = self.object["geometry"].as_array_mut() {
            all.push(geometry);
        }
    }

    /// Adds the triangles of some nodes of a scene as a level of detail.
    /// `opening` says what a code is.
    pub fn level(
        &mut self,
        lod: &str,
        (scene, places): (&Scene, &[Placement]),
        nodes: Range<usize>,
        opening: &dyn Fn(&str) -> Option<Opening>,
    ) {
        let (mut faces, mut kinds) = (vec![], vec![]);
        let ground = lowest(scene, nodes.clone(), places);
        for number in nodes {
            let (node, place) = (&scene.nodes[number], &places[number]);
            if !place.sound {
                continue;
            }
            let kind = surface(scene, number, opening);
            for primitive in flat::primitives(scene.whole(), node) {
                let at = |i: &u32| place.point(flat::point(primitive.positions[*i as usize]));
                for corners in primitive.indices.chunks_exact(3) {
                    let corners: Vec<DVec3> = corners.iter().map(at).collect();
                    let [a, b, c] = [0, 1, 2].map(|k| self.vertices.number(corners[k]));
                    if a == b || b == c || c == a {
                        continue;
                    }
                    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
                    let is_floor = normal.normalize_or_zero().z < -0.7
                        && corners.iter().all(|p| p.z < ground + 0.01);
                    faces.push(json!([[a, b, c]]));
                    kinds.push(match kind {
                        _ if is_floor => GROUND,
                        // Walls and roofs are one mesh where there are no parts.
                        WALL if lod == "2" && normal.normalize_or_zero().z.abs() > SLOPE => ROOF,
                        kind => kind,
                    });
                }
            }
        }
        if faces.is_empty() {
            return;
        }
        if !self.is_building() {
            // Its surfaces have no classes of their own.
            self.add(json!({"type": "MultiSurface", "lod": lod, "boundaries": faces}));
            return;
        }
        // Only surfaces that there are, numbered anew.
        let mut own: Vec<usize> = kinds.clone();
        own.sort_unstable();
        own.dedup();
        let number = |kind: &usize| own.iter().position(|k| k == kind);
        let values: Vec<Option<usize>> = kinds.iter().map(number).collect();
        let surfaces: Vec<Value> = own.iter().map(|k| json!({"type": SURFACES[*k]})).collect();
        self.add(
            json!({"type": "MultiSurface", "lod": lod, "boundaries": faces,
            "semantics": {"surfaces": surfaces, "values": values}}),
        );
    }

    /// Returns true if it is a building.
    pub fn is_building(&self) -> bool {
        self.object["type"] == "Building"
    }

    /// Returns its line of a CityJSONSeq.
    pub fn line(&self) -> String {
        let feature = json!({"type": "CityJSONFeature", "id": self.id,
            "CityObjects": {self.id.as_str(): self.object}, "vertices": self.vertices.all});
        feature.to_string() + "\n"
    }
}

fn lowest(scene: &Scene, nodes: Range<usize>, places: &[Placement]) -> f64 {
    let mut least = f64::INFINITY;
    for number in nodes.filter(|n| places[*n].sound) {
        for primitive in flat::primitives(scene.whole(), &scene.nodes[number]) {
            let heights = primitive.positions.iter();
            let heights = heights.map(|p| places[number].point(flat::point(*p)).z);
            least = heights.fold(least, f64::min);
        }
    }
    least
}

/// Returns what the surfaces of a node are, by the nearest node that says so.
fn surface(scene: &Scene, number: usize, opening: &dyn Fn(&str) -> Option<Opening>) -> usize {
    let mut at = Some(number);
    while let Some(node) = at.and_then(|n| scene.nodes.get(n)) {
        match (node.kind, &node.code) {
            (Kind::Roof | Kind::Finial, _) => return ROOF,
            (Kind::Part, Some(code)) => {
                return match opening(code) {
                    Some(Opening::Door) => DOOR,
                    Some(Opening::Window) => WINDOW,
                    None => WALL,
                };
            }
            _ => {}
        }
        at = node.parent.map(|parent| parent.0 as usize);
    }
    WALL
}
