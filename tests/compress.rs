//! Models for the web show what plain ones show: they are unpacked here and compared.

#![allow(clippy::unwrap_used, missing_docs)]

#[path = "compress/tiles.rs"]
mod tiles;

use glam::{DMat4, DQuat, DVec3};
use hsd::Options;
use hsd::backend::gltf::{self, Glb, Ktx2};
use hsd::backend::images::Library;
use hsd::backend::{Images, NoImages, PictureBytes, SurfaceFiles};
use hsd::diagnostic::Diagnostics;
use hsd::scene::{Image, Scene};
use hsd::source::{FileId, NoFiles, Source};
use ktx::texture::KtxTexture;
use serde_json::Value;

const MACHIYA: &str = include_str!("../examples/machiya.hsd");

fn scene(text: &str) -> Scene {
    let source = Source::new(FileId(0), "houses.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    hsd::compile(&[&source], &NoFiles, &Options::default(), &mut out).scene
}

/// Machiya at these places: x, y, degrees.
fn houses(places: impl IntoIterator<Item = (f64, f64, f64)>) -> Scene {
    let one = |(x, y, angle)| {
        let place = format!("\n{x} {y} {angle}\n");
        assert!(MACHIYA.contains("\n0 0 180\n"));
        MACHIYA.replacen("\n0 0 180\n", &place, 1)
    };
    let list: Vec<String> = places.into_iter().map(one).collect();
    scene(&list.join("\n%\n"))
}

struct Model {
    root: Value,
    bin: Vec<u8>,
}

/// The bytes that an accessor begins with, and the step from element to element.
struct Array {
    bytes: Vec<u8>,
    stride: usize,
    count: usize,
    component: u64,
}

impl Model {
    fn new(glb: &[u8]) -> Model {
        let parts = ::gltf::binary::Glb::from_slice(glb).unwrap();
        Model {
            root: serde_json::from_slice(&parts.json).unwrap(),
            bin: parts.bin.unwrap_or_default().into_owned(),
        }
    }

    fn number(value: &Value) -> usize {
        value.as_u64().unwrap_or_default() as usize
    }

    /// The bytes of a view, unpacked.
    fn view(&self, view: &Value) -> Vec<u8> {
        let packed = &view["extensions"]["EXT_meshopt_compression"];
        let place = if packed.is_null() { view } else { packed };
        assert_eq!(Model::number(&place["buffer"]), 0);
        let start = Model::number(&place["byteOffset"]);
        let bytes = &self.bin[start..start + Model::number(&place["byteLength"])];
        if packed.is_null() {
            return bytes.to_vec();
        }
        let (count, stride) = (
            Model::number(&packed["count"]),
            Model::number(&packed["byteStride"]),
        );
        assert_eq!(Model::number(&view["byteLength"]), count * stride);
        assert_eq!(Model::number(&view["buffer"]), 1);
        if packed["mode"] == "TRIANGLES" {
            let all = meshopt::decode_index_buffer::<u32>(bytes, count).unwrap();
            return all
                .iter()
                .flat_map(|i| i.to_le_bytes()[..stride].to_vec())
                .collect();
        }
        assert_eq!(meshopt::decode_vertex_version(bytes), Some(0));
        match (packed["filter"].as_str(), stride) {
            (Some("EXPONENTIAL"), 4) => floats::<1>(bytes, count),
            (Some("EXPONENTIAL"), 8) => floats::<2>(bytes, count),
            (Some("EXPONENTIAL"), 12) => floats::<3>(bytes, count),
            (Some("EXPONENTIAL"), 16) => floats::<4>(bytes, count),
            (Some("OCTAHEDRAL"), 8) => {
                let mut all: Vec<[i16; 4]> = meshopt::decode_vertex_buffer(bytes, count).unwrap();
                meshopt::decode_filter_oct(&mut all);
                all.as_flattened()
                    .iter()
                    .flat_map(|x| x.to_le_bytes())
                    .collect()
            }
            other => panic!("{other:?}"),
        }
    }

    fn array(&self, accessor: &Value) -> Array {
        let accessor = &self.root["accessors"][Model::number(accessor)];
        let view = &self.root["bufferViews"][Model::number(&accessor["bufferView"])];
        let component = accessor["componentType"].as_u64().unwrap();
        let numbers = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let size = match component {
            5122 | 5123 => 2,
            _ => 4,
        };
        Array {
            bytes: self.view(view)[Model::number(&accessor["byteOffset"])..].to_vec(),
            stride: view["byteStride"]
                .as_u64()
                .map_or(size * numbers, |s| s as usize),
            count: Model::number(&accessor["count"]),
            component,
        }
    }

    /// Everything that is drawn, by mesh: where each of its nodes or instances stands.
    fn places(&self) -> Vec<Vec<DMat4>> {
        let meshes = self.root["meshes"].as_array().unwrap().len();
        let mut places = vec![vec![]; meshes];
        for node in self.root["scenes"][0]["nodes"].as_array().unwrap() {
            self.walk(Model::number(node), DMat4::IDENTITY, &mut places);
        }
        places
    }

    fn walk(&self, node: usize, above: DMat4, places: &mut [Vec<DMat4>]) {
        let node = &self.root["nodes"][node];
        let here = above * matrix(&numbers(&node["translation"]), &numbers(&node["rotation"]));
        if let Some(mesh) = node["mesh"].as_u64() {
            let listed = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
            let places = &mut places[mesh as usize];
            if listed.is_null() {
                places.push(here);
            } else {
                let at = self.array(&listed["TRANSLATION"]).vectors::<3>();
                let turns = match &listed["ROTATION"] {
                    Value::Null => vec![[0.0, 0.0, 0.0, 1.0]; at.len()],
                    turns => self.array(turns).vectors::<4>(),
                };
                let both = at.iter().zip(&turns);
                places.extend(both.map(|(at, turn)| here * matrix(at, turn)));
            }
        }
        for child in node["children"].as_array().into_iter().flatten() {
            self.walk(Model::number(child), here, places);
        }
    }

    fn primitives(&self, mesh: usize) -> &Vec<Value> {
        self.root["meshes"][mesh]["primitives"].as_array().unwrap()
    }
}

fn floats<const N: usize>(bytes: &[u8], count: usize) -> Vec<u8>
where
    [u32; N]: Default,
{
    let mut all: Vec<[u32; N]> = meshopt::decode_vertex_buffer(bytes, count).unwrap();
    meshopt::decode_filter_exp(&mut all);
    all.as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect()
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().into_iter().flatten();
    list.map(|x| x.as_f64().unwrap()).collect()
}

fn matrix(at: &[f64], turn: &[f64]) -> DMat4 {
    let at = if at.is_empty() {
        DVec3::ZERO
    } else {
        DVec3::from_slice(at)
    };
    let turn = if turn.is_empty() {
        DQuat::IDENTITY
    } else {
        DQuat::from_slice(turn)
    };
    DMat4::from_rotation_translation(turn.normalize(), at)
}

impl Array {
    fn vectors<const N: usize>(&self) -> Vec<[f64; N]> {
        let element = |i: usize| {
            std::array::from_fn(|k| {
                let bytes = &self.bytes[i * self.stride..];
                match self.component {
                    5122 => {
                        let two = bytes[2 * k..2 * k + 2].try_into().unwrap();
                        f64::from(i16::from_le_bytes(two)) / 32767.0
                    }
                    _ => f64::from(f32::from_le_bytes(
                        bytes[4 * k..4 * k + 4].try_into().unwrap(),
                    )),
                }
            })
        };
        (0..self.count).map(element).collect()
    }

    /// Triangles, each from its least corner on.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let corner = |i: usize| match self.component {
            5123 => u32::from(u16::from_le_bytes([
                self.bytes[2 * i],
                self.bytes[2 * i + 1],
            ])),
            _ => u32::from_le_bytes(self.bytes[4 * i..4 * i + 4].try_into().unwrap()),
        };
        let corners: Vec<u32> = (0..self.count).map(corner).collect();
        let turned = |t: &[u32]| {
            let least = (0..3).min_by_key(|k| t[*k]).unwrap();
            [0, 1, 2].map(|k| t[(least + k) % 3])
        };
        let mut list: Vec<_> = corners.chunks_exact(3).map(turned).collect();
        list.sort_unstable();
        list
    }
}

/// The largest difference between the vectors of two arrays.
fn difference<const N: usize>(a: &[[f64; N]], b: &[[f64; N]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let each = a.as_flattened().iter().zip(b.as_flattened());
    each.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Fails unless both show the same triangles, each corner within a millimetre.
fn assert_same(scene: &Scene, images: &dyn Images) {
    let plain = Model::new(&gltf::glb(scene, images));
    let mut bytes = std::io::Cursor::new(vec![]);
    Glb::compressed(scene, images).write(&mut bytes).unwrap();
    let packed = Model::new(bytes.get_ref());
    let (ours, theirs) = (plain.places(), packed.places());
    assert_eq!(ours.len(), theirs.len());
    for (mesh, (ours, theirs)) in ours.iter().zip(theirs).enumerate() {
        let both = plain.primitives(mesh).iter().zip(packed.primitives(mesh));
        let mut corners = vec![];
        for (a, b) in both {
            let kinds: Vec<_> = a["attributes"].as_object().unwrap().keys().collect();
            assert_eq!(
                kinds,
                b["attributes"]
                    .as_object()
                    .unwrap()
                    .keys()
                    .collect::<Vec<_>>()
            );
            let (indices, packed_indices) =
                (plain.array(&a["indices"]), packed.array(&b["indices"]));
            assert_eq!(indices.triangles(), packed_indices.triangles());
            let arrays = |kind: &str| {
                let (a, b) = (&a["attributes"][kind], &b["attributes"][kind]);
                (!a.is_null()).then(|| (plain.array(a), packed.array(b)))
            };
            let (a, b) = arrays("POSITION").unwrap();
            corners.extend(a.vectors::<3>().into_iter().zip(b.vectors::<3>()));
            let (a, b) = arrays("NORMAL").unwrap();
            assert!(difference(&a.vectors::<3>(), &b.vectors::<3>()) < 2e-3);
            if let Some((a, b)) = arrays("TANGENT") {
                assert!(difference(&a.vectors::<4>(), &b.vectors::<4>()) < 2e-3);
            }
            if let Some((a, b)) = arrays("TEXCOORD_0") {
                assert!(difference(&a.vectors::<2>(), &b.vectors::<2>()) < 1e-4);
            }
        }
        let far = |a: &DMat4, b: &DMat4| {
            let away = |(p, q): &([f64; 3], [f64; 3])| {
                let (p, q) = (DVec3::from(*p), DVec3::from(*q));
                a.transform_point3(p).distance(b.transform_point3(q))
            };
            corners.iter().map(away).fold(0.0, f64::max)
        };
        let mut rest = theirs;
        for place in ours {
            let found = rest.iter().position(|other| far(place, other) < 1e-3);
            rest.swap_remove(found.expect("it stands in its place"));
        }
        assert!(rest.is_empty(), "mesh {mesh} stands in places of its own");
    }
}

fn compressed(scene: &Scene, images: &dyn Images) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(vec![]);
    Glb::compressed(scene, images).write(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn packed_models_show_the_same() {
    assert_same(
        &houses([(0.0, 0.0, 180.0), (7.3, -20.1, 31.0), (30.0, 12.0, 271.5)]),
        &Library::default(),
    );
}

#[test]
fn millimetres_hold_on_a_map() {
    assert_same(
        &houses([
            (0.0, 0.0, 180.0),
            (100_000.0, 70_000.333, 77.0),
            (100_020.0, 70_000.1, 78.0),
        ]),
        &NoImages,
    );
}

#[test]
fn what_is_required_is_said() {
    let model = Model::new(&compressed(&houses([(0.0, 0.0, 180.0)]), &NoImages));
    let required = [
        "EXT_meshopt_compression",
        "KHR_mesh_quantization",
        "EXT_mesh_gpu_instancing",
    ];
    assert_eq!(
        model.root["extensionsRequired"],
        serde_json::json!(required)
    );
    let fallback = &model.root["buffers"][1];
    assert_eq!(
        fallback["extensions"]["EXT_meshopt_compression"]["fallback"],
        true
    );
    assert!(fallback["uri"].is_null());
    // Nothing needs nothing.
    let empty = Model::new(&compressed(&Scene::default(), &NoImages));
    assert!(empty.root["extensionsRequired"].is_null() && empty.root["buffers"].is_null());
}

/// Bytes that a house adds to others, once the first is there.
fn bytes_a_house(places: impl Iterator<Item = (f64, f64, f64)>) -> usize {
    let one = compressed(&houses([(0.0, 0.0, 180.0)]), &NoImages);
    let many = compressed(&houses(places.take(1000)), &NoImages);
    (many.len() - one.len()) / 999
}

#[test]
fn a_thousand_houses_are_small() {
    let copies = bytes_a_house(std::iter::repeat((0.0, 0.0, 180.0)));
    assert!(copies < 1000, "{copies} bytes a house");
    let spread = |i: u32| {
        let (row, column) = (f64::from(i / 40), f64::from(i % 40));
        (
            column * 11.37,
            row * 23.91,
            360.0 * libm::fmod(f64::from(i) * 0.618_034, 1.0),
        )
    };
    let town = bytes_a_house((0..).map(spread));
    assert!(town < 3000, "{town} bytes a house");
}

/// A house that shows the pictures of its first materials only, since they take long.
fn few_pictures() -> Scene {
    let mut scene = houses([(0.0, 0.0, 180.0)]);
    for material in &mut scene.materials[2..] {
        material.image = Image::None;
    }
    scene
}

/// Fails unless `KHR_texture_basisu` takes a picture.
fn assert_valid(ktx2: &[u8]) {
    let mut issues = vec![];
    let mut hear = |issue: &ktx::cli::validate::ValidationReport| {
        issues.push(issue.message.clone());
    };
    let done = ktx::cli::validate::validate_memory(ktx2, true, true, &mut hear);
    assert_eq!((done, issues), (Ok(0), vec![]));
}

/// Part pictures with holes, of these sides.
struct Holes(Vec<Vec<u8>>);

impl Holes {
    fn new(sides: &[u32]) -> Holes {
        let picture = |side: &u32| {
            let picture = image::RgbaImage::from_fn(*side, *side, |x, y| {
                image::Rgba([200, 100, 50, if x < y { 255 } else { 0 }])
            });
            let mut png = std::io::Cursor::new(vec![]);
            picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
            png.into_inner()
        };
        Holes(sides.iter().map(picture).collect())
    }
}

impl Images for Holes {
    fn files(&self, _: &str) -> Option<SurfaceFiles<'_>> {
        None
    }

    fn picture(&self, index: u32) -> Option<PictureBytes<'_>> {
        let bytes = self.0.get(index as usize)?;
        let name = format!("戸.{index}.png").into();
        Some(PictureBytes { name, bytes })
    }

    fn baked(&self, _: u32) -> Option<SurfaceFiles<'_>> {
        None
    }
}

#[test]
fn holes_stay_and_odd_pictures_are_left_alone() {
    let mut scene = houses([(0.0, 0.0, 180.0)]);
    for (index, material) in (0..).zip(&mut scene.materials) {
        material.image = Image::Picture(index);
    }
    let plain = Holes::new(&[64, 30, 4]);
    let pictures = Ktx2::new(&scene, &plain);
    let [whole, odd, small] = [0, 1, 2].map(|i| pictures.picture(i).unwrap());
    assert_eq!((&*whole.name, &*small.name), ("戸.0.ktx2", "戸.2.ktx2"));
    assert_eq!(Some(odd), plain.picture(1));
    assert_valid(whole.bytes);
    assert_valid(small.bytes);
    let pixels = pixels(whole.bytes);
    let opaque = |x: usize, y: usize| pixels[4 * (64 * y + x) + 3];
    assert!(opaque(10, 50) > 250 && opaque(50, 10) < 5);
}

/// The largest size of a picture, four bytes a pixel.
fn pixels(ktx2: &[u8]) -> Vec<u8> {
    let load = ktx::KTX_TEXTURE_CREATE_LOAD_IMAGE_DATA_BIT;
    let mut texture = ktx::Texture2::create_from_memory(ktx2, load).unwrap();
    texture
        .transcode_basis(ktx::TranscodeFmt::RGBA32, 0)
        .unwrap();
    let start = texture.get_image_offset(0, 0, 0).unwrap();
    texture.get_data().unwrap()[start..].to_vec()
}

#[test]
fn pictures_look_the_same() {
    let (scene, library) = (few_pictures(), Library::default());
    let pictures = Ktx2::new(&scene, &library);
    let Image::Surface(name) = scene.materials[0].image else {
        panic!("the first material is drawn");
    };
    let (plain, packed) = (library.files(name).unwrap(), pictures.files(name).unwrap());
    assert_eq!(plain.normal, packed.normal);
    for (plain, packed) in [
        (plain.color, packed.color),
        (plain.orm.unwrap(), packed.orm.unwrap()),
    ] {
        assert!(packed.name.ends_with(".ktx2"), "{}", packed.name);
        assert_valid(packed.bytes);
        let before = image::load_from_memory(plain.bytes).unwrap().into_rgba8();
        let after = pixels(packed.bytes);
        let each = before.iter().zip(&after[..before.len()]);
        let sum: u64 = each.map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        let mean = sum as f64 / before.len() as f64;
        assert!(mean < 6.0, "{}: {mean}", plain.name);
    }
}

#[test]
fn bytes_are_the_same_again() {
    let (scene, library) = (few_pictures(), Library::default());
    let once = || compressed(&scene, &Ktx2::new(&scene, &library));
    let first = once();
    assert!(first == once());
    let model = Model::new(&first);
    let required = model.root["extensionsRequired"].as_array().unwrap();
    assert!(required.contains(&"KHR_texture_basisu".into()));
}
