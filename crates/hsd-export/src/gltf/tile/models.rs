//! Models that a tile keeps once and puts up many times (`EXT_mesh_gpu_instancing`): trees. Each one takes its place, turn, size and
//! the number of its feature (`EXT_instance_features`): 36 bytes.

use super::{Pose, TANGENT, byte};
use crate::gltf::arrays::{MaterialRef, bounds, turned, write_floats};
use crate::gltf::json_file::{File, INSTANCES, accessor};
use crate::gltf::shading::{tangents, unit};
use crate::pieces::Pieces;
use glam::{DVec3, Vec3};
use hsd_scene::{MaterialId, Primitive, Stretched};
use serde_json::{Map, Value, json};

/// The models of a tile.
#[derive(Default)]
pub(super) struct Models(Vec<Model>);

/// A model with the size that its mesh has.
struct Model {
    of: Stretched,
    shapes: Vec<Shape>,
    instances: Vec<Instance>,
}

/// Triangles of one material.
struct Shape {
    material: MaterialRef,
    primitive: Primitive,
}

/// A model that stands somewhere: from the middle of the tile.
struct Instance {
    at: Vec3,
    /// The rotation about the vertical: (sin, cos) of half its angle.
    half: [f64; 2],
    /// Factors of width and height.
    scale: [f32; 2],
    feature: f32,
}

impl Models {
    /// Returns the number of triangles that are seen.
    pub(super) fn triangles(&self) -> usize {
        let of = |shape: &Shape| shape.primitive.indices.len() / 3;
        let seen = |m: &Model| m.instances.len() * m.shapes.iter().map(of).sum::<usize>();
        self.0.iter().map(seen).sum()
    }

    /// Puts up a model, whose mesh is made by `shapes` if it is the first; returns the box of it from the middle of the tile.
    pub(super) fn add(
        &mut self,
        of: Stretched,
        (pose, centre, feature): (Pose, DVec3, u32),
        shapes: impl FnOnce() -> Vec<(MaterialRef, Primitive)>,
    ) -> Option<[Vec3; 2]> {
        let known = self.0.iter().position(|model| model.of.model == of.model);
        let number = known.unwrap_or_else(|| {
            let shape = |(material, primitive)| Shape {
                material,
                primitive,
            };
            self.0.push(Model {
                of,
                shapes: shapes().into_iter().map(shape).collect(),
                instances: vec![],
            });
            self.0.len() - 1
        });
        let model = &mut self.0[number];
        let scale = [0, 1].map(|i| of.size[i] / model.of.size[i]);
        let cos = libm::sqrt(f64::max(0.0, (1.0 + pose.turn.x) / 2.0));
        let half = match cos > 1e-6 {
            true => [pose.turn.y / (2.0 * cos), cos],
            false => [1.0, 0.0],
        };
        let at = (pose.at - centre).as_vec3();
        model.instances.push(Instance {
            at,
            half,
            scale,
            feature: feature as f32,
        });
        let points = model.shapes.iter().flat_map(|s| &s.primitive.positions);
        points.fold(None, |found: Option<[Vec3; 2]>, [x, y, z]| {
            // However it is turned.
            let far = x.hypot(*y) * scale[0];
            let [low, high] = [-far, far].map(|r| at + Vec3::new(r, r, z * scale[1]));
            let [a, b] = found.unwrap_or([low, high]);
            Some([a.min(low), b.max(high)])
        })
    }

    /// Moves texture coordinates on pages of baked images to where the images are, by the factors of their materials.
    pub(super) fn stretch(&mut self, factor: impl Fn(MaterialId) -> Option<f32>) {
        for shape in self.0.iter_mut().flat_map(|model| &mut model.shapes) {
            let Some(factor) = factor(shape.primitive.material) else {
                continue;
            };
            for [_, v] in &mut shape.primitive.uvs {
                *v = 1.0 - (1.0 - *v) * factor;
            }
        }
    }

    /// Writes meshes and the arrays of their places; returns the meshes and the extensions of their nodes.
    pub(super) fn written(
        &self,
        flat: bool,
        features: usize,
        (file, bin): (&mut File, &mut Pieces),
    ) -> Vec<(Value, Value)> {
        let mut made = vec![];
        for model in &self.0 {
            let shapes = model.shapes.iter();
            let primitives: Vec<Value> = shapes
                .map(|shape| shape.written(flat, (file, bin)))
                .collect();
            let attributes = places(&model.instances, (file, bin));
            let [instancing, named] = INSTANCES;
            let mut extensions = Map::new();
            extensions.insert(instancing.to_owned(), json!({ "attributes": attributes }));
            extensions.insert(
                named.to_owned(),
                json!({ "featureIds": [
                { "featureCount": features, "attribute": 0, "propertyTable": 0 }
            ] }),
            );
            let mesh = json!({ "name": model.of.model, "primitives": primitives });
            made.push((mesh, Value::Object(extensions)));
        }
        made
    }
}

impl Shape {
    /// Writes its arrays; returns the primitive.
    fn written(&self, flat: bool, (file, bin): (&mut File, &mut Pieces)) -> Value {
        let p = &self.primitive;
        let count = p.positions.len();
        let view = file.view(bin, Some((12, 34962)), |out| {
            write_floats(out, &p.positions, turned);
        });
        let (low, high) = bounds([&*p.positions]);
        let mut points = accessor(view, 5126, count, "VEC3");
        points["min"] = json!(low.map(f64::from));
        points["max"] = json!(high.map(f64::from));
        let mut attributes = Map::new();
        attributes.insert("POSITION".to_owned(), file.accessor(points).into());
        let mut bytes = |name: &str, kind: &str, all: Vec<[u8; 4]>| {
            let view = file.view(bin, Some((4, 34962)), |out| out.extend(all.as_flattened()));
            let mut made = accessor(view, 5120, count, kind);
            made["normalized"] = json!(true);
            attributes.insert(name.to_owned(), file.accessor(made).into());
        };
        let normals = p.normals.iter().map(|normal| {
            let [x, y, z] = turned(unit(*normal)).map(byte);
            [x, y, z, 0]
        });
        bytes("NORMAL", "VEC3", normals.collect());
        if self.material.relief && !flat {
            let tangents = tangents(p).into_iter().map(|[x, y, z, w]| {
                let [x, y, z] = turned([x, y, z]).map(byte);
                [x, y, z, byte(w)]
            });
            bytes(TANGENT, "VEC4", tangents.collect());
        }
        let metres = self.material.metres.unwrap_or(1.0);
        let uvs: Vec<[f32; 2]> = p
            .uvs
            .iter()
            .map(|[u, v]| [u / metres, 1.0 - v / metres])
            .collect();
        let view = file.view(bin, Some((8, 34962)), |out| {
            write_floats(out, &uvs, |uv| uv)
        });
        let uvs = file.accessor(accessor(view, 5126, count, "VEC2"));
        attributes.insert("TEXCOORD_0".to_owned(), uvs.into());
        let view = file.view(bin, Some((0, 34963)), |out| {
            out.extend(p.indices.iter().flat_map(|i| (*i as u16).to_le_bytes()));
        });
        let indices = file.accessor(accessor(view, 5123, p.indices.len(), "SCALAR"));
        json!({
            "attributes": attributes,
            "indices": indices,
            "material": self.material.number.value(),
            "mode": 4,
        })
    }
}

/// Writes where instances stand; returns the attributes.
fn places(instances: &[Instance], (file, bin): (&mut File, &mut Pieces)) -> Value {
    let count = instances.len();
    let at: Vec<[f32; 3]> = instances.iter().map(|i| i.at.to_array()).collect();
    let view = file.view(bin, None, |out| write_floats(out, &at, turned));
    let translation = file.accessor(accessor(view, 5126, count, "VEC3"));
    let view = file.view(bin, None, |out| {
        for instance in instances {
            let [sin, cos] = instance.half.map(|x| (x * 32_767.0).round() as i16);
            out.extend([0, sin, 0, cos].iter().flat_map(|x| x.to_le_bytes()));
        }
    });
    let mut turns = accessor(view, 5122, count, "VEC4");
    turns["normalized"] = json!(true);
    let rotation = file.accessor(turns);
    let sizes: Vec<[f32; 3]> = instances
        .iter()
        .map(|i| [i.scale[0], i.scale[1], i.scale[0]])
        .collect();
    let view = file.view(bin, None, |out| write_floats(out, &sizes, |size| size));
    let scale = file.accessor(accessor(view, 5126, count, "VEC3"));
    let view = file.view(bin, None, |out| {
        out.extend(instances.iter().flat_map(|i| i.feature.to_le_bytes()));
    });
    let ids = file.accessor(accessor(view, 5126, count, "SCALAR"));
    json!({ "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale, "_FEATURE_ID_0": ids })
}
