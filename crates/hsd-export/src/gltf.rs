//! glTF 2.0: `.glb`, or `.gltf` with separate files.
//!
//! Frame: (x, y, z) = (east, up, -north); a south front faces +Z. Vertices are written once per mesh and shared by all
//! nodes that show it. There is one buffer view per kind of array regardless of the size of the scene: positions,
//! normals, tangents, texture coordinates and indices; accessors differ by offset only. Everything except the nodes uses
//! the types of the `gltf` crate, which the tests use to read it back.
//!
//! A [`Writer`] takes houses one after another and keeps their JSON and arrays in [`Spool`](super::spool::Spool)s until the model is
//! complete: the lists at the start of the file are known last. A whole scene is written the same way.
//!
//! Texture coordinates of textured surfaces are metres in the scene; they are divided here by the length of one repeat
//! in metres, since a primitive has one material.

mod accessor;
mod apart;
mod arrays;
mod bare;
mod buffer;
#[cfg(feature = "compress")]
mod compress;
mod container;
mod json_file;
mod joined;
mod materials;
mod nodes;
mod shading;
mod shapes;
mod table;
mod tile;
mod writer;

pub use apart::Gltf;
#[cfg(feature = "compress")]
pub use compress::Ktx2;
pub use container::Glb;
pub use table::FeatureRow;
pub use tile::{SpareArrays, TileContent, TileWriter, graphics_bytes};
pub use writer::{Writer, glb_of_houses, written_nodes};

use super::spool::{List, Section, in_memory};
use super::{Images, OutFile};
use gltf::json::{Buffer, Root};
use hsd_scene::Scene;
use materials::Materials;
use std::io::{self, Write};

/// Returns a `.glb` with all images embedded.
pub fn glb(scene: &Scene, images: &dyn Images) -> Vec<u8> {
    Glb::inside(scene, images).bytes()
}

/// Returns a `.glb` named `stem.glb`, with its images in the folder `stem_textures`.
pub fn glb_beside<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let (glb, mut files) = Glb::beside(scene, images, stem);
    files.push(OutFile {
        name: format!("{stem}.glb"),
        bytes: glb.bytes().into(),
    });
    files
}

/// Returns a `.gltf` named `stem.gltf`, its `stem.bin`, and its images in the folder `stem_textures`. The file that
/// refers to the others comes last.
pub fn gltf<'a>(scene: &'a Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    Gltf::of(Model::of(scene, images), stem).into_files(stem)
}

/// A complete model, not yet in a file.
struct Model<'a> {
    /// The root, except the long lists.
    root: Root,
    accessors: List,
    meshes: List,
    nodes: List,
    /// The buffer up to the images.
    sections: Vec<Section>,
    materials: Materials<'a>,
    /// True if the images are in the buffer.
    embedded: bool,
    /// Length of the buffer, bytes.
    length: u64,
    /// Length of a second buffer without bytes, for readers that do not unpack the first; 0 if there is none.
    #[cfg(feature = "compress")]
    unpacked: usize,
}

impl<'a> Model<'a> {
    /// Lays out a whole scene.
    fn of(scene: &'a Scene, images: &'a dyn Images) -> Model<'a> {
        let mut writer = Writer::new(&in_memory).expect("memory takes every byte");
        writer.made_from(&scene.provenance);
        let added = writer.add(scene.whole(), images);
        let model = added.and_then(|()| writer.model(&scene.materials, images, &[]));
        model.expect("memory takes every byte")
    }

    /// Adds the images to the buffer.
    fn embed(&mut self) {
        self.embedded = true;
        self.length = self.materials.embed(&mut self.root, self.length as usize) as u64;
    }

    /// Returns the images as files in the folder of the model.
    fn files(&mut self, stem: &str) -> Vec<OutFile<'a>> {
        self.materials.files(&mut self.root, stem)
    }

    /// Adds the buffer, as the file `uri` or in the container.
    fn add_buffer(&mut self, uri: Option<String>) {
        if self.length > 0 {
            self.root.push(Buffer {
                byte_length: self.length.into(),
                uri,
                name: None,
                extensions: None,
                extras: None,
            });
        }
        #[cfg(feature = "compress")]
        compress::add_fallback(self.unpacked, &mut self.root);
    }

    /// Returns the bytes of its lists, of its arrays by kind and of its images.
    fn sizes(&self) -> Vec<(&'static str, u64)> {
        let lists = [
            ("accessors", self.accessors.length()),
            ("meshes", self.meshes.length()),
            ("nodes", self.nodes.length()),
        ];
        let arrays = self.sections.iter().map(|s| (s.name(), s.length()));
        let images = ("images", self.materials.length());
        lists.into_iter().chain(arrays).chain([images]).collect()
    }

    /// Writes the JSON: the root, and the lists that are empty in it.
    fn json(&mut self, out: &mut impl Write) -> io::Result<()> {
        let root = serde_json::to_vec(&self.root)?;
        // An asset is always in it, so something stands between the braces.
        out.write_all(&root[..root.len() - 1])?;
        let lists = [
            ("accessors", &mut self.accessors),
            ("meshes", &mut self.meshes),
            ("nodes", &mut self.nodes),
        ];
        for (name, list) in lists {
            if list.count() > 0 {
                write!(out, ",\"{name}\":")?;
                list.write(out)?;
            }
        }
        out.write_all(b"}")
    }

    /// Writes the buffer.
    fn buffer(&mut self, out: &mut impl Write) -> io::Result<()> {
        for section in &mut self.sections {
            section.write(out)?;
        }
        match self.embedded {
            true => self.materials.write(out),
            false => Ok(()),
        }
    }
}
