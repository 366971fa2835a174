//! glTF 2.0: `.glb`, or `.gltf` with files beside it.
//!
//! Frame: (x, y, z) = (east, up, -north); a south front looks along +Z. Vertices are written once a mesh and
//! shared by all nodes that show it. There are at most five buffer views whatever the size of the scene: positions,
//! normals, tangents, texture coordinates and indices; accessors differ by their offset only. Everything is of
//! the types of the `gltf` crate, which writes what it also reads back in the tests.
//!
//! Texture coordinates of drawn surfaces are metres in the scene; they are divided here by the metres of one
//! repeat, since a primitive has one material.

mod geometry;
mod materials;
mod nodes;
mod tangents;

use super::{Images, OutFile};
use crate::scene::Scene;
use geometry::{Geometry, Shown};
use gltf::binary::{Glb, Header};
use gltf::json::{Asset, Buffer, Root};
use materials::Looks;

/// A `.glb` with everything inside.
pub fn glb(scene: &Scene, images: &dyn Images) -> Vec<u8> {
    let mut made = Made::new(scene, images);
    made.looks.write(&mut made.root, &mut made.bin);
    made.container()
}

/// A `.glb` named `stem.glb` and its pictures in the folder `stem_textures`.
pub fn glb_beside<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let mut made = Made::new(scene, images);
    let mut files = made.looks.files(&mut made.root, stem);
    files.push(OutFile {
        name: format!("{stem}.glb"),
        bytes: made.container().into(),
    });
    files
}

/// A `.gltf` named `stem.gltf`, its `stem.bin`, and its pictures in the folder `stem_textures`. The file that
/// refers to the others comes last.
pub fn gltf<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let mut made = Made::new(scene, images);
    let mut files = made.looks.files(&mut made.root, stem);
    let name = format!("{stem}.bin");
    let json = made.json(Some(escaped(&name)));
    if !made.bin.is_empty() {
        files.push(OutFile {
            name,
            bytes: made.bin.into(),
        });
    }
    files.push(OutFile {
        name: format!("{stem}.gltf"),
        bytes: json.into(),
    });
    files
}

/// What is in the scene, but for pictures.
struct Made<'a> {
    root: Root,
    bin: Vec<u8>,
    looks: Looks<'a>,
}

impl<'a> Made<'a> {
    fn new(scene: &'a Scene, images: &'a dyn Images) -> Made<'a> {
        let (mut root, mut bin) = (Root::default(), vec![]);
        root.asset = Asset {
            generator: Some(concat!("hsd ", env!("CARGO_PKG_VERSION")).into()),
            ..Asset::default()
        };
        let shown = Shown::new(scene);
        let looks = Looks::new(scene, &shown, images, &mut root);
        let geometry = Geometry::new(scene, &shown, &looks, &mut root);
        geometry.write(&mut root, &mut bin);
        nodes::add(scene, &geometry, &mut root);
        Made { root, bin, looks }
    }

    /// The JSON, with the buffer in the file `uri` or in the container.
    fn json(&mut self, uri: Option<String>) -> Vec<u8> {
        if !self.bin.is_empty() {
            self.root.push(Buffer {
                byte_length: self.bin.len().into(),
                uri,
                name: None,
                extensions: None,
                extras: None,
            });
        }
        gltf::json::serialize::to_vec(&self.root)
            .expect("maps have string keys and memory takes every byte")
    }

    fn container(mut self) -> Vec<u8> {
        let glb = Glb {
            // The writer knows the length.
            header: Header {
                magic: *b"glTF",
                version: 2,
                length: 0,
            },
            json: self.json(None).into(),
            bin: (!self.bin.is_empty()).then_some(self.bin.into()),
        };
        glb.to_vec().expect("memory takes every byte")
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
