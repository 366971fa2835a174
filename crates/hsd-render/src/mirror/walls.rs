//! Reflecting panes: outward-facing triangles of facades whose material has a reflectance. They are moved from the shared
//! meshes of parts to a mesh per facade, since each pane has its own texture coordinates. Positions do not change.

use crate::beam::Plane;
use crate::mirror::Sheet;
use crate::view;
use crate::view::Place;
use glam::{DVec2, DVec3};
use hsd_scene::{Kind, Material, MaterialId, Mesh, MeshId, Node, NodeId, Primitive, Scene};
use image::RgbImage;
use std::collections::BTreeMap;

/// The maximum deviation of pane normals, as a cosine.
const STRAIGHT: f64 = 0.999;

/// Walls whose planes differ by less than this, in metres, are coplanar.
const ONE_PLANE: f64 = 1e-3;

/// The coplanar facades of a house.
pub(super) struct Wall {
    /// The mean plane of their panes.
    pub(super) plane: Plane,
    /// The bounds of the panes on the plane.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    /// The height of the ground in front of it.
    pub(super) ground: f64,
    facades: Vec<Facade>,
    /// The nodes below the facades, sorted.
    own: Vec<usize>,
}

impl Wall {
    /// Returns whether a node belongs to the wall.
    pub(super) fn owns(&self, node: usize) -> bool {
        self.own.binary_search(&node).is_ok()
    }
}

/// A facade and its panes.
struct Facade {
    node: usize,
    root: usize,
    place: Place,
    /// The panes in the frame of the facade.
    panes: Vec<Primitive>,
    /// The nodes that panes are taken from.
    taken: Vec<usize>,
}

/// Returns all reflecting walls of a scene.
pub(super) fn walls(scene: &Scene) -> Vec<Wall> {
    let facades = facades(scene);
    let places = view::places(scene);
    let mut walls: Vec<(usize, DVec3, f64, Vec<Facade>)> = vec![];
    for facade in facades {
        let out = facade.place.way(DVec3::NEG_Y);
        let offset = out.dot(facade.place.at);
        let same = walls.iter_mut().find(|(root, way, at, _)| {
            *root == facade.root && way.dot(out) > 1.0 - 1e-9 && (*at - offset).abs() < ONE_PLANE
        });
        match same {
            Some((.., facades)) => facades.push(facade),
            None => walls.push((facade.root, out, offset, vec![facade])),
        }
    }
    let owners = owners(scene);
    let made = walls.into_iter().map(|(root, out, _, facades)| {
        let nodes = facades.iter().map(|f| f.node);
        let nodes: Vec<usize> = nodes.collect();
        let below = |n: &usize| owners[*n].is_some_and(|f| nodes.contains(&f));
        Wall {
            own: (0..scene.nodes.len()).filter(below).collect(),
            ..measured(out, places[root].at.z, facades)
        }
    });
    made.collect()
}

/// Returns a wall with the plane and the bounds of its panes.
fn measured(out: DVec3, ground: f64, facades: Vec<Facade>) -> Wall {
    let mut weighed = (0.0, 0.0);
    let mut points: Vec<DVec3> = vec![];
    for facade in &facades {
        for t in facade.panes.iter().flat_map(triangles) {
            let [a, b, c] = t.map(|p| facade.place.point(p));
            let area = (b - a).cross(c - a).length();
            weighed.0 += area * out.dot((a + b + c) / 3.0);
            weighed.1 += area;
            points.extend([a, b, c]);
        }
    }
    let plane = Plane {
        at: out * (weighed.0 / weighed.1),
        out,
    };
    let flat = points.iter().map(|p| plane.of(*p).truncate());
    let start = (DVec2::MAX, DVec2::MIN);
    let (low, high) = flat.fold(start, |(l, h), p| (l.min(p), h.max(p)));
    Wall {
        plane,
        low,
        high,
        ground,
        facades,
        own: vec![],
    }
}

/// Returns the facade that contains each node.
fn owners(scene: &Scene) -> Vec<Option<usize>> {
    let mut owners: Vec<Option<usize>> = Vec::with_capacity(scene.nodes.len());
    for (n, node) in scene.nodes.iter().enumerate() {
        owners.push(match node.kind {
            Kind::Facade => Some(n),
            _ => node.parent.and_then(|p| owners[p.0 as usize]),
        });
    }
    owners
}

/// Returns the facades with reflecting panes.
fn facades(scene: &Scene) -> Vec<Facade> {
    let (places, roots, owners) = (view::places(scene), view::roots(scene), owners(scene));
    let mut found: BTreeMap<usize, Facade> = BTreeMap::new();
    for (n, node) in scene.nodes.iter().enumerate() {
        let (Some(mesh), Some(owner)) = (node.mesh, owners[n]) else {
            continue;
        };
        let (place, above) = (places[n], places[owner]);
        let panes = scene.meshes[mesh.0 as usize].primitives.iter();
        let panes: Vec<Primitive> = panes
            .filter(|p| mirrors(&scene.materials[p.material.0 as usize]))
            .filter_map(|p| divided(p, place, above).0)
            .collect();
        if panes.is_empty() {
            continue;
        }
        let facade = found.entry(owner).or_insert_with(|| Facade {
            node: owner,
            root: roots[n].0 as usize,
            place: above,
            panes: vec![],
            taken: vec![],
        });
        panes
            .into_iter()
            .for_each(|pane| add(&mut facade.panes, pane));
        facade.taken.push(n);
    }
    found.into_values().collect()
}

fn mirrors(material: &Material) -> bool {
    material.reflection.is_some_and(|share| share > 0.0)
}

/// Merges panes with those of the same material.
fn add(all: &mut Vec<Primitive>, more: Primitive) {
    match all.iter_mut().find(|p| p.material == more.material) {
        None => all.push(more),
        Some(same) => {
            let first = same.positions.len() as u32;
            same.positions.extend(more.positions);
            same.normals.extend(more.normals);
            same.uvs.extend(more.uvs);
            same.indices.extend(more.indices.iter().map(|i| first + i));
        }
    }
}

/// Returns the corners of its triangles.
fn triangles(p: &Primitive) -> impl Iterator<Item = [DVec3; 3]> {
    let corners = |t: &[u32]| [0, 1, 2].map(|k| view::point(p.positions[t[k] as usize]));
    p.indices.chunks_exact(3).map(corners)
}

/// Divides a primitive into the triangles facing out of the facade, in the frame of the facade, and the others.
fn divided(p: &Primitive, place: Place, facade: Place) -> (Option<Primitive>, Option<Primitive>) {
    let out = facade.way(DVec3::NEG_Y);
    let looks_out = |t: &&[u32]| {
        let straight = |i: &u32| place.way(view::point(p.normals[*i as usize])).dot(out) > STRAIGHT;
        t.iter().all(straight)
    };
    let (panes, others): (Vec<&[u32]>, Vec<&[u32]>) =
        p.indices.chunks_exact(3).partition(looks_out);
    let back = DVec2::new(facade.turn.x, -facade.turn.y);
    let turned = |v: DVec3| back.rotate(v.truncate()).extend(v.z).as_vec3().to_array();
    let panes = picked(p, &panes).map(|mut panes| {
        for v in &mut panes.positions {
            *v = turned(place.point(view::point(*v)) - facade.at);
        }
        for n in &mut panes.normals {
            *n = turned(place.way(view::point(*n)));
        }
        panes
    });
    (panes, picked(p, &others))
}

/// Returns a primitive of some of the triangles, with the vertices they use.
fn picked(p: &Primitive, triangles: &[&[u32]]) -> Option<Primitive> {
    let mut numbers: Vec<Option<u32>> = vec![None; p.positions.len()];
    let mut made = Primitive {
        material: p.material,
        positions: vec![],
        normals: vec![],
        uvs: vec![],
        mirror_uvs: vec![],
        indices: vec![],
    };
    for i in triangles.iter().flat_map(|t| t.iter()) {
        let k = *i as usize;
        let number = *numbers[k].get_or_insert_with(|| {
            made.positions.push(p.positions[k]);
            made.normals.push(p.normals[k]);
            made.uvs.push(p.uvs[k]);
            made.positions.len() as u32 - 1
        });
        made.indices.push(number);
    }
    (!made.indices.is_empty()).then_some(made)
}

/// Assigns the textures of walls to their panes.
pub(super) fn show(scene: &mut Scene, walls: Vec<Wall>, drawn: Vec<(Sheet, RgbImage)>) {
    let places = view::places(scene);
    let mut left: BTreeMap<MeshId, Option<MeshId>> = BTreeMap::new();
    let mut shown: BTreeMap<usize, MeshId> = BTreeMap::new();
    for (number, (wall, (sheet, picture))) in (0..).zip(walls.into_iter().zip(drawn)) {
        let mut materials: BTreeMap<u32, MaterialId> = BTreeMap::new();
        for facade in wall.facades {
            for n in &facade.taken {
                let mesh = scene.nodes[*n].mesh;
                let without = mesh.and_then(|mesh| match left.get(&mesh) {
                    Some(known) => *known,
                    None => {
                        let made = without(scene, mesh, places[*n], facade.place);
                        left.insert(mesh, made);
                        made
                    }
                });
                scene.nodes[*n].mesh = without;
            }
            let mut panes = facade.panes;
            for pane in &mut panes {
                let own = pane.material;
                pane.material = *materials
                    .entry(own.0)
                    .or_insert_with(|| mirroring(scene, own, number));
                pane.mirror_uvs = pane
                    .positions
                    .iter()
                    .map(|p| {
                        let p = wall.plane.of(facade.place.point(view::point(*p)));
                        let uv = (p.truncate() - sheet.low) / sheet.size;
                        uv.as_vec2().to_array()
                    })
                    .collect();
            }
            scene.meshes.push(Mesh {
                name: "panes".into(),
                primitives: panes,
            });
            shown.insert(facade.node, MeshId(scene.meshes.len() as u32 - 1));
        }
        scene.mirrored.push(picture);
    }
    insert(scene, &shown);
}

/// Returns a mesh without its panes; `None` if it is empty then.
fn without(scene: &mut Scene, mesh: MeshId, place: Place, facade: Place) -> Option<MeshId> {
    let Mesh { name, primitives } = scene.meshes[mesh.0 as usize].clone();
    let others = primitives.into_iter().filter_map(|p| {
        match mirrors(&scene.materials[p.material.0 as usize]) {
            true => divided(&p, place, facade).1,
            false => Some(p),
        }
    });
    let primitives: Vec<Primitive> = others.collect();
    if primitives.is_empty() {
        return None;
    }
    scene.meshes.push(Mesh { name, primitives });
    Some(MeshId(scene.meshes.len() as u32 - 1))
}

/// Returns a copy of a material with a reflection texture.
fn mirroring(scene: &mut Scene, own: MaterialId, number: u32) -> MaterialId {
    let own = &scene.materials[own.0 as usize];
    let made = Material {
        name: format!("{} before wall {}", own.name, number + 1),
        mirrored: Some(number),
        ..own.clone()
    };
    scene.materials.push(made);
    MaterialId(scene.materials.len() as u32 - 1)
}

/// Inserts a node for the panes after each facade that has some.
fn insert(scene: &mut Scene, shown: &BTreeMap<usize, MeshId>) {
    let mut numbers: Vec<NodeId> = Vec::with_capacity(scene.nodes.len());
    let mut nodes: Vec<Node> = Vec::with_capacity(scene.nodes.len() + shown.len());
    for (n, mut node) in std::mem::take(&mut scene.nodes).into_iter().enumerate() {
        node.parent = node.parent.map(|parent| numbers[parent.0 as usize]);
        let number = NodeId(nodes.len() as u32);
        numbers.push(number);
        let storey = node.storey;
        nodes.push(node);
        if let Some(mesh) = shown.get(&n) {
            let mut panes = Node::new(Some(number), Kind::Member, "panes".into(), DVec3::ZERO);
            panes.mesh = Some(*mesh);
            panes.storey = storey;
            nodes.push(panes);
        }
    }
    scene.nodes = nodes;
}
