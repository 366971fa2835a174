//! glTF 2.0: `.glb`, or `.gltf` with files beside it.
//!
//! Frame: (x, y, z) = (east, up, -north); a south front looks along +Z. Vertices are written once a mesh and
//! shared by all nodes that show it. There are five buffer views whatever the size of the scene: positions,
//! normals, tangents, texture coordinates and indices; accessors differ by their offset only. The JSON is serialised
//! from the small types of `document`, which hold no default value and borrow every name; the `gltf` crate
//! reads it back in the tests.
//!
//! Texture coordinates of drawn surfaces are metres in the scene; they are divided here by the metres of one
//! repeat, since a primitive has one material.

mod document;
mod geometry;
mod materials;
mod nodes;
mod tangents;

use super::{Images, OutFile, picture_folder};
use crate::scene::Scene;
use document::{Asset, Buffer, BufferView, Document, Root};
use geometry::Geometry;
use materials::Looks;

/// A `.glb` with everything inside.
pub fn glb(scene: &Scene, images: &dyn Images) -> Vec<u8> {
    let made = Made::new(scene, images);
    let (views, length) = made.views(true);
    let json = made.json(&views, length, None, |k| {
        Some(views.len() - made.looks.images.len() + k)
    });
    made.container(&json, length, true)
}

/// A `.glb` named `stem.glb` and its pictures in the folder `stem_textures`.
pub fn glb_beside<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let made = Made::new(scene, images);
    let (views, length) = made.views(false);
    let json = made.json(&views, length, Some((stem, false)), |_| None);
    let mut files = made.picture_files(stem);
    files.push(OutFile {
        name: format!("{stem}.glb"),
        bytes: made.container(&json, length, false).into(),
    });
    files
}

/// A `.gltf` named `stem.gltf`, its `stem.bin`, and its pictures in the folder `stem_textures`. The file that
/// refers to the others comes last.
pub fn gltf<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let made = Made::new(scene, images);
    let (views, length) = made.views(false);
    let json = made.json(&views, length, Some((stem, true)), |_| None);
    let mut files = made.picture_files(stem);
    if length > 0 {
        let mut bytes = Vec::with_capacity(length);
        made.geometry.write(&mut bytes);
        files.push(OutFile {
            name: format!("{stem}.bin"),
            bytes: bytes.into(),
        });
    }
    files.push(OutFile {
        name: format!("{stem}.gltf"),
        bytes: json.into(),
    });
    files
}

/// What is in the scene, numbered as glTF numbers it.
struct Made<'a> {
    scene: &'a Scene,
    looks: Looks<'a>,
    geometry: Geometry<'a>,
}

impl<'a> Made<'a> {
    fn new(scene: &'a Scene, images: &'a dyn Images) -> Made<'a> {
        let shown = geometry::Shown::new(scene);
        let looks = Looks::new(scene, &shown, images);
        let geometry = Geometry::new(scene, &shown, &looks);
        Made {
            scene,
            looks,
            geometry,
        }
    }

    /// The buffer views, and the length of the buffer.
    fn views(&self, pictures: bool) -> (Vec<BufferView>, usize) {
        let (mut views, mut length) = self.geometry.views();
        let inside = if pictures {
            &self.looks.images[..]
        } else {
            &[]
        };
        for image in inside {
            views.push(BufferView::plain(length, image.bytes.len()));
            length += image.bytes.len().next_multiple_of(4);
        }
        (views, length)
    }

    /// The JSON; `beside` is the stem of files beside it, and whether the buffer is one of them.
    fn json(
        &self,
        views: &[BufferView],
        length: usize,
        beside: Option<(&str, bool)>,
        view_of_image: impl Fn(usize) -> Option<usize>,
    ) -> Vec<u8> {
        let folder = beside.map(|(stem, _)| picture_folder(stem));
        let bin = beside
            .filter(|b| b.1)
            .map(|(stem, _)| format!("{}.bin", escaped(stem)));
        let buffer = Buffer {
            byte_length: length,
            uri: bin,
        };
        let tree = nodes::Tree::new(self.scene, &self.geometry);
        let document = Document {
            asset: Asset::default(),
            extensions_used: &self.looks.extensions,
            scene: (!tree.roots.is_empty()).then_some(0),
            scenes: (!tree.roots.is_empty()).then_some([Root { nodes: &tree.roots }]),
            nodes: tree.nodes(),
            meshes: &self.geometry.meshes,
            materials: &self.looks.materials,
            textures: &self.looks.textures,
            images: self.looks.images(folder.as_deref(), view_of_image),
            samplers: &self.looks.samplers,
            accessors: &self.geometry.accessors,
            buffer_views: views,
            buffers: (length > 0).then_some([buffer]),
        };
        serde_json::to_vec(&document).expect("maps have string keys and memory takes every byte")
    }

    fn container(&self, json: &[u8], length: usize, pictures: bool) -> Vec<u8> {
        let (text, data) = (json.len().next_multiple_of(4), length.next_multiple_of(4));
        let total = 12 + 8 + text + if data > 0 { 8 + data } else { 0 };
        let mut out = Vec::with_capacity(total);
        out.extend_from_slice(b"glTF");
        out.extend_from_slice(&2u32.to_le_bytes());
        out.extend_from_slice(&(total as u32).to_le_bytes());
        out.extend_from_slice(&(text as u32).to_le_bytes());
        out.extend_from_slice(b"JSON");
        out.extend_from_slice(json);
        out.resize(20 + text, b' ');
        if data > 0 {
            out.extend_from_slice(&(data as u32).to_le_bytes());
            out.extend_from_slice(b"BIN\0");
            self.geometry.write(&mut out);
            let inside = if pictures {
                &self.looks.images[..]
            } else {
                &[]
            };
            for image in inside {
                out.extend_from_slice(image.bytes);
                out.resize(out.len().next_multiple_of(4), 0);
            }
        }
        out
    }

    fn picture_files(&self, stem: &str) -> Vec<OutFile<'a>> {
        let folder = picture_folder(stem);
        let file = |i: &materials::Picture<'a>| OutFile {
            name: format!("{folder}/{}", i.name),
            bytes: i.bytes.into(),
        };
        self.looks.images.iter().map(file).collect()
    }
}

/// A path as a relative reference: everything but unreserved characters and slashes is escaped (RFC 3986).
fn escaped(path: &str) -> String {
    let mut out = String::with_capacity(path.len());
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                out.push(byte.into());
            }
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}
