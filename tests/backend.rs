//! Back ends on a scene made by hand: what they write is read back.

mod plain;

use glam::{dvec2, dvec3};
use hsd::backend::{Images, NoImages, PictureBytes, SurfaceFiles, gltf, obj, sound, stl};
use hsd::scene::{
    Detail, Image, Kind, Material, MaterialId, Mesh, MeshId, Node, NodeId, PartNames, Place,
    Primitive, Scene,
};
use hsd::source::{FileId, Span};
use std::borrow::Cow;
use std::num::NonZeroU32;
use std::sync::Arc;

struct Pictures {
    png: Vec<u8>,
    jpeg: Vec<u8>,
}

impl Pictures {
    fn new() -> Pictures {
        let encode = |format| {
            let mut out = std::io::Cursor::new(vec![]);
            let picture = image::RgbImage::from_pixel(4, 4, image::Rgb([128, 128, 255]));
            picture.write_to(&mut out, format).unwrap();
            out.into_inner()
        };
        Pictures {
            png: encode(image::ImageFormat::Png),
            jpeg: encode(image::ImageFormat::Jpeg),
        }
    }

    fn bytes<'a>(&self, name: &str, bytes: &'a [u8]) -> PictureBytes<'a> {
        PictureBytes {
            name: Cow::Owned(name.to_owned()),
            bytes,
        }
    }
}

impl Images for Pictures {
    fn files(&self, surface: &str) -> Option<SurfaceFiles<'_>> {
        (surface == "cedar").then(|| SurfaceFiles {
            metres: 2.0,
            color: self.bytes("cedar_color.jpg", &self.jpeg),
            normal: Some(self.bytes("cedar_normal.jpg", &self.jpeg)),
            orm: Some(self.bytes("cedar_orm.png", &self.png)),
            gloss: [0.75, 0.0],
        })
    }

    fn picture(&self, index: u32) -> Option<PictureBytes<'_>> {
        (index == 0).then(|| self.bytes("看板 1.png", &self.png))
    }

    fn baked(&self, _: u32) -> Option<SurfaceFiles<'_>> {
        None
    }
}

fn material(name: &str, image: Image) -> Material {
    Material {
        name: name.into(),
        image,
        tint: [1.0; 4],
        roughness: 1.0,
        metallic: 0.0,
        cutout: false,
        double_sided: false,
        reflection: None,
        mirrored: None,
    }
}

/// An upright rectangle `w` wide and `h` high that faces south.
fn pane(material: u32, w: f32, h: f32) -> Primitive {
    Primitive {
        material: MaterialId(material),
        positions: vec![[0.0, 0.0, 0.0], [w, 0.0, 0.0], [w, 0.0, h], [0.0, 0.0, h]],
        normals: vec![[0.0, -1.0, 0.0]; 4],
        uvs: vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]],
        mirror_uvs: vec![],
        indices: vec![0, 1, 2, 0, 2, 3],
    }
}

fn node(parent: Option<u32>, kind: Kind, name: &str, mesh: Option<u32>) -> Node {
    Node {
        parent: parent.map(NodeId),
        kind,
        name: name.into(),
        at: dvec3(0.0, 0.0, 0.0),
        turn: dvec2(1.0, 0.0),
        mesh: mesh.map(MeshId),
        code: None,
        storey: None,
        facade: None,
        names: None,
        span: None,
        file: None,
        place: None,
        shape: None,
        stretched: None,
    }
}

/// A house turned by a quarter, with two doors of one mesh, a sign, a roof and an empty facade.
fn scene() -> Scene {
    let mesh = |name: &str, primitives| Mesh {
        name: name.into(),
        primitives,
    };
    let mut glass = material("glass", Image::None);
    glass.tint[3] = 0.25;
    glass.reflection = Some(0.5);
    let part = |x: f64, start| Node {
        at: dvec3(x, 0.0, 0.5),
        code: Some("GDE 2".into()),
        storey: Some(1),
        span: Some(Span {
            file: FileId(0),
            start,
            end: start + 5,
        }),
        names: Some(Arc::new(PartNames {
            ja: "格子戸".into(),
            en: "lattice door".into(),
        })),
        place: Some(Place {
            line: NonZeroU32::new(3).unwrap(),
            column: start + 1,
        }),
        ..node(Some(2), Kind::Part, "GDE 2", Some(0))
    };
    let sign = Primitive {
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        ..pane(2, 1.0, 1.0)
    };
    Scene {
        detail: Detail::Everything,
        materials: vec![
            material("cedar", Image::Surface("cedar")),
            glass,
            material("sign", Image::Picture(0)),
            material("unused", Image::Surface("cedar")),
        ],
        meshes: vec![
            mesh("door", vec![pane(0, 2.0, 4.0), pane(1, 1.0, 1.0)]),
            mesh("sign", vec![sign]),
            mesh("not shown", vec![pane(3, 1.0, 1.0)]),
        ],
        nodes: vec![
            Node {
                at: dvec3(100.0, 200.0, 3.0),
                turn: dvec2(0.0, 1.0),
                ..node(None, Kind::House, "町家", None)
            },
            Node {
                storey: Some(1),
                ..node(Some(0), Kind::Storey, "storey 1", None)
            },
            Node {
                facade: NonZeroU32::new(1),
                ..node(Some(1), Kind::Facade, "facade 1", None)
            },
            part(1.0, 0),
            part(4.0, 5),
            node(Some(2), Kind::Part, "sign", Some(1)),
            node(Some(1), Kind::Facade, "facade 2", None),
            Node {
                shape: Some("KIR".into()),
                ..node(Some(0), Kind::Roof, "roof", Some(1))
            },
        ],
        pictures: vec!["textures/看板 1.png".into()],
        baked: vec![],
        mirrored: vec![],
        oversized: vec![],
        provenance: Default::default(),
    }
}

fn parsed(json: &[u8]) -> ::gltf::json::Root {
    use ::gltf::json::validation::Validate;
    let root: ::gltf::json::Root = ::gltf::json::deserialize::from_slice(json).unwrap();
    let mut errors = vec![];
    root.validate(&root, ::gltf::json::Path::new, &mut |path, error| {
        errors.push(format!("{} {error}", path()));
    });
    assert!(errors.is_empty(), "{errors:?}");
    root
}

fn read(glb: &[u8]) -> (::gltf::json::Root, Vec<u8>) {
    let parts = ::gltf::binary::Glb::from_slice(glb).unwrap();
    (
        parsed(&parts.json),
        parts.bin.map(|b| b.into_owned()).unwrap_or_default(),
    )
}

fn floats(root: &::gltf::json::Root, bin: &[u8], accessor: usize, n: usize) -> Vec<f32> {
    let a = &root.accessors[accessor];
    let view = &root.buffer_views[a.buffer_view.unwrap().value()];
    let at = view.byte_offset.map_or(0, |o| o.0) + a.byte_offset.map_or(0, |o| o.0);
    let bytes = &bin[at as usize..][..n * 4 * a.count.0 as usize];
    let floats = bytes.chunks_exact(4);
    floats
        .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect()
}

#[test]
fn glb_reads_back() {
    let glb = gltf::glb(&scene(), &Pictures::new());
    let (root, bin) = read(&glb);
    let names: Vec<_> = root
        .nodes
        .iter()
        .map(|n| n.name.as_deref().unwrap())
        .collect();
    let expected = [
        "町家", "storey 1", "facade 1", "GDE 2", "GDE 2", "sign", "roof",
    ];
    assert_eq!(names, expected, "the empty facade is left out");
    let children = |i: usize| -> Vec<usize> {
        let list = root.nodes[i].children.iter().flatten();
        list.map(|c| c.value()).collect()
    };
    assert_eq!(
        (children(0), children(1), children(2)),
        (vec![1, 6], vec![2], vec![3, 4, 5])
    );
    assert_eq!(root.nodes[0].translation, Some([100.0, 3.0, -200.0]));
    let half = 0.5f32.sqrt();
    assert_eq!(root.nodes[0].rotation.unwrap().0, [0.0, half, 0.0, half]);
    assert_eq!(root.nodes[1].translation, None);
    assert_eq!(
        root.nodes[3].mesh, root.nodes[4].mesh,
        "one mesh for both doors"
    );
    assert_eq!(
        (root.meshes.len(), root.materials.len(), root.images.len()),
        (2, 3, 4)
    );
    let extras = |i: usize| root.nodes[i].extras.as_ref().unwrap().get().to_owned();
    assert_eq!(extras(0), r#"{"kind":"house","id":"町家"}"#);
    assert_eq!(
        extras(4),
        r#"{"kind":"part","code":"GDE 2","storey":1,"facade":1,"ja":"格子戸","en":"lattice door","span":[5,10],"line":3,"column":6,"id":"町家/s1/f1/-400.50"}"#
    );
    assert_eq!(
        extras(6),
        r#"{"kind":"roof","shape":"KIR","id":"町家/roof"}"#
    );
    let door = &root.meshes[0].primitives[0];
    let index = |s| door.attributes[&::gltf::json::validation::Checked::Valid(s)].value();
    use ::gltf::json::mesh::Semantic;
    let positions = floats(&root, &bin, index(Semantic::Positions), 3);
    assert_eq!(
        positions[6..12],
        [2.0, 4.0, 0.0, 0.0, 4.0, 0.0],
        "z up to y up"
    );
    let normals = floats(&root, &bin, index(Semantic::Normals), 3);
    assert_eq!(normals[..3], [0.0, 0.0, 1.0], "south is +z");
    let uvs = floats(&root, &bin, index(Semantic::TexCoords(0)), 2);
    assert_eq!(
        uvs,
        [0.0, 1.0, 1.0, 1.0, 1.0, -1.0, 0.0, -1.0],
        "repeats of 2 m, v downwards"
    );
    let tangents = floats(&root, &bin, index(Semantic::Tangents), 4);
    assert_eq!(tangents[..4], [1.0, 0.0, 0.0, 1.0], "along u");
    let pane = &root.meshes[0].primitives[1];
    assert_eq!(pane.attributes.len(), 2, "no coordinates without a picture");
    assert!(root.buffer_views.len() == 5 + 4, "few views");
}

#[test]
fn materials_are_physical() {
    let glb = gltf::glb(&scene(), &Pictures::new());
    let parts = ::gltf::binary::Glb::from_slice(&glb).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&parts.json).unwrap();
    let [cedar, glass, sign] = &json["materials"].as_array().unwrap()[..] else {
        panic!("three materials")
    };
    let pbr = &cedar["pbrMetallicRoughness"];
    assert_eq!(pbr["baseColorTexture"]["index"], 0);
    assert_eq!(cedar["normalTexture"]["index"], 1);
    assert_eq!(pbr["metallicRoughnessTexture"]["index"], 2);
    assert_eq!(pbr["metallicFactor"], 0.0);
    assert_eq!(
        (&cedar["alphaMode"], &glass["alphaMode"]),
        (&"OPAQUE".into(), &"BLEND".into())
    );
    assert_eq!(glass["extras"]["reflection"], 0.5);
    assert_eq!(glass["extensions"]["KHR_materials_ior"]["ior"], 1.5);
    let specular = &glass["extensions"]["KHR_materials_specular"];
    // Half of the light: 12.5 times what glass reflects straight on.
    assert_eq!(
        specular["specularColorFactor"],
        serde_json::json!([12.5, 12.5, 12.5])
    );
    let used = ["KHR_materials_ior", "KHR_materials_specular"];
    assert_eq!(json["extensionsUsed"], serde_json::json!(used));
    let texture = |m: &serde_json::Value| {
        let index = m["pbrMetallicRoughness"]["baseColorTexture"]["index"]
            .as_u64()
            .unwrap();
        json["textures"][index as usize].clone()
    };
    let sampler = |m| json["samplers"][texture(m)["sampler"].as_u64().unwrap() as usize].clone();
    assert_eq!(
        (&sampler(cedar)["wrapS"], &sampler(sign)["wrapS"]),
        (&10497.into(), &33071.into())
    );
    assert_eq!(
        json["asset"]["generator"],
        concat!("hsd ", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn outputs_are_the_same_twice() {
    let (scene, images) = (scene(), Pictures::new());
    assert_eq!(gltf::glb(&scene, &images), gltf::glb(&scene, &images));
    assert_eq!(
        gltf::gltf(&scene, &images, "a"),
        gltf::gltf(&scene, &images, "a")
    );
    assert_eq!(
        obj::obj(&scene, &images, "a"),
        obj::obj(&scene, &images, "a")
    );
    let print = stl::Print::default();
    assert_eq!(stl::stl(&scene, print), stl::stl(&scene, print));
}

#[test]
fn a_container_is_written_where_the_file_stands() {
    use std::io::{Cursor, Seek, SeekFrom};
    let (scene, images) = (scene(), Pictures::new());
    let whole = gltf::glb(&scene, &images);
    let mut file = Cursor::new(b"before".to_vec());
    file.seek(SeekFrom::End(0)).unwrap();
    let length = gltf::Glb::inside(&scene, &images).write(&mut file);
    assert_eq!(length.unwrap(), whole.len() as u64);
    assert_eq!(file.position(), file.get_ref().len() as u64);
    assert_eq!(file.get_ref()[..6], *b"before");
    assert!(file.get_ref()[6..] == whole);
}

#[test]
fn far_houses_keep_their_micrometres() {
    let mut scene = scene();
    scene.nodes[0].at = dvec3(123_456.789_012, -98_765.432_109, 0.000_001);
    let glb = gltf::glb(&scene, &NoImages);
    let parts = ::gltf::binary::Glb::from_slice(&glb).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&parts.json).unwrap();
    let expected = serde_json::json!([123_456.789_012, 0.000_001, 98_765.432_109]);
    assert_eq!(json["nodes"][0]["translation"], expected);
}

#[test]
fn a_node_is_small() {
    // A town has half a million.
    assert!(size_of::<Node>() <= 160, "{}", size_of::<Node>());
}

#[test]
fn files_beside_have_escaped_names() {
    let (scene, images) = (scene(), Pictures::new());
    let files = gltf::gltf(&scene, &images, "my 家");
    let names: Vec<_> = files.iter().map(|f| &*f.name).collect();
    let expected = [
        "my 家_textures/cedar_color.jpg",
        "my 家_textures/cedar_normal.jpg",
        "my 家_textures/cedar_orm.png",
        "my 家_textures/看板 1.png",
        "my 家.bin",
        "my 家.gltf",
    ];
    assert_eq!(names, expected);
    let root = parsed(&files[5].bytes);
    assert_eq!(root.buffers[0].uri.as_deref(), Some("my%20%E5%AE%B6.bin"));
    assert_eq!(root.buffers[0].byte_length.0, files[4].bytes.len() as u64);
    let uri = root.images[3].uri.as_deref();
    assert_eq!(
        uri,
        Some("my%20%E5%AE%B6_textures/%E7%9C%8B%E6%9D%BF%201.png")
    );
    let beside = gltf::glb_beside(&scene, &images, "a");
    let (root, bin) = read(&beside.last().unwrap().bytes);
    assert_eq!(
        root.images[0].uri.as_deref(),
        Some("a_textures/cedar_color.jpg")
    );
    assert_eq!(bin.len(), files[4].bytes.len());
}

#[test]
fn plain_colours_need_no_coordinates() {
    let (root, _) = read(&gltf::glb(&scene(), &NoImages));
    assert_eq!(
        (root.images.len(), root.textures.len(), root.samplers.len()),
        (0, 0, 0)
    );
    assert_eq!(root.buffer_views.len(), 3);
    let indices = root.meshes[0].primitives[0].indices.unwrap();
    assert_eq!(
        root.accessors[indices.value()].buffer_view.unwrap().value(),
        2
    );
}

#[test]
fn an_empty_scene_is_a_file() {
    let (root, bin) = read(&gltf::glb(&Scene::default(), &NoImages));
    assert_eq!((root.nodes.len(), root.buffers.len(), bin.len()), (0, 0, 0));
    assert_eq!(stl::stl(&Scene::default(), stl::Print::default()).len(), 84);
}

#[test]
fn numbers_that_are_none_are_left_out() {
    let mut scene = scene();
    scene.meshes[0].primitives[0].positions[1][0] = f32::NAN;
    scene.nodes[5].at.x = f64::INFINITY;
    let (root, bin) = read(&gltf::glb(&scene, &Pictures::new()));
    assert_eq!(root.meshes[0].primitives.len(), 1, "the glass stays");
    assert!(!root.nodes.iter().any(|n| n.name.as_deref() == Some("sign")));
    let view = &root.buffer_views[0];
    let positions = &bin[..view.byte_length.0 as usize];
    assert!(
        positions
            .chunks_exact(4)
            .all(|b| f32::from_le_bytes(b.try_into().unwrap()).is_finite())
    );
    let names: Vec<_> = sound::flaws(scene.whole()).map(|f| f.name).collect();
    assert_eq!(names, ["GDE 2", "GDE 2", "sign"]);
    let text = String::from_utf8(
        obj::obj(&scene, &NoImages, "a")
            .pop()
            .unwrap()
            .bytes
            .to_vec(),
    )
    .unwrap();
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn many_vertices_have_long_indices() {
    let mut scene = scene();
    let count = 65_536;
    scene.meshes[1].primitives[0] = Primitive {
        material: MaterialId(2),
        positions: (0..count)
            .map(|i| [i as f32, 0.0, (i % 2) as f32])
            .collect(),
        normals: vec![[0.0, -2.0, 0.0]; count],
        uvs: vec![[0.0; 2]; count],
        mirror_uvs: vec![],
        indices: vec![0, 1, count as u32 - 1],
    };
    let (root, bin) = read(&gltf::glb(&scene, &Pictures::new()));
    let view = root.buffer_views[4].byte_offset.unwrap().0 as usize;
    let length = root.buffer_views[4].byte_length.0 as usize;
    let last = &bin[view + length - 4..view + length];
    assert_eq!(u32::from_le_bytes(last.try_into().unwrap()), 65_535);
}
