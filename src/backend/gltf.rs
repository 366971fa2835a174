//! glTF 2.0: `.glb`, or `.gltf` with separate files.
//!
//! Frame: (x, y, z) = (east, up, -north); a south front faces +Z. Vertices are written once per mesh and shared by all
//! nodes that show it. There are at most five buffer views regardless of the size of the scene: positions, normals,
//! tangents, texture coordinates and indices; accessors differ by offset only. Everything except the nodes uses the
//! types of the `gltf` crate, which the tests use to read it back.
//!
//! Texture coordinates of textured surfaces are metres in the scene; they are divided here by the length of one repeat
//! in metres, since a primitive has one material.

mod arrays;
mod buffer;
#[cfg(feature = "compress")]
mod compress;
mod container;
mod document;
mod geometry;
mod materials;
mod nodes;
mod shading;
mod shown;

#[cfg(feature = "compress")]
pub use compress::Ktx2;
pub use container::Glb;

use super::{Images, OutFile};
use crate::scene::Scene;
use crate::source::reference;
use geometry::Geometry;
use gltf::json::{Asset, Buffer, Root};
use materials::Materials;
use nodes::Tree;
use shown::Shown;
use std::io::{self, Write};
use std::ops::Range;

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
    let mut model = Model::new(scene, images, None);
    let mut files = model.files(stem);
    let name = format!("{stem}.bin");
    model.add_buffer(Some(reference(&name)));
    let (mut json, mut bin) = (vec![], Vec::with_capacity(model.length));
    let written = model.json(&mut json).and_then(|()| model.buffer(&mut bin));
    written.expect("memory takes every byte");
    if !bin.is_empty() {
        files.push(OutFile {
            name,
            bytes: bin.into(),
        });
    }
    files.push(OutFile {
        name: format!("{stem}.gltf"),
        bytes: json.into(),
    });
    files
}

/// The content of the scene, laid out but not yet written.
struct Model<'a> {
    /// The root, except the long lists of geometry and nodes.
    root: Root,
    materials: Materials<'a>,
    geometry: Geometry<'a>,
    places: Places<'a>,
    /// True if the images are in the buffer.
    embedded: bool,
    /// Length of the buffer, bytes.
    length: usize,
}

/// The nodes and placements of the shapes.
enum Places<'a> {
    Tree(Tree<'a>),
    /// Flat, with the arrays of the shapes.
    #[cfg(feature = "compress")]
    Packed(compress::Packed<'a>),
}

impl<'a> Model<'a> {
    /// Lays out a whole scene, or some of its houses, given by their nodes, with the materials of all.
    fn new(scene: &'a Scene, images: &'a dyn Images, houses: Option<&[Range<usize>]>) -> Model<'a> {
        let (mut root, materials, mut geometry) = Model::shapes(scene, images, houses);
        geometry.add_views(&mut root);
        let tree = Tree::new(scene, houses, &geometry, &mut root);
        Model {
            length: geometry.length(),
            root,
            materials,
            geometry,
            places: Places::Tree(tree),
            embedded: false,
        }
    }

    #[cfg(feature = "compress")]
    fn packed(scene: &'a Scene, images: &'a dyn Images) -> Model<'a> {
        let (mut root, materials, geometry) = Model::shapes(scene, images, None);
        let packed = compress::Packed::new(scene, &geometry, &mut root);
        Model {
            length: packed.bytes.len(),
            root,
            materials,
            geometry,
            places: Places::Packed(packed),
            embedded: false,
        }
    }

    fn shapes(
        scene: &'a Scene,
        images: &'a dyn Images,
        houses: Option<&[Range<usize>]>,
    ) -> (Root, Materials<'a>, Geometry<'a>) {
        let mut root = Root {
            asset: Asset {
                generator: Some(concat!("hsd ", env!("CARGO_PKG_VERSION")).into()),
                ..Asset::default()
            },
            ..Root::default()
        };
        let all = Shown::new(scene, &scene.nodes);
        let materials = Materials::new(scene, &all, images, &mut root);
        let shown = match houses {
            None => all,
            Some(some) => Shown::new(scene, some.iter().flat_map(|h| &scene.nodes[h.clone()])),
        };
        let geometry = Geometry::new(scene, shown, &materials);
        (root, materials, geometry)
    }

    /// Returns the approximate number of nodes.
    fn nodes(&self) -> usize {
        match &self.places {
            Places::Tree(tree) => tree.len(),
            #[cfg(feature = "compress")]
            Places::Packed(packed) => packed.nodes.len(),
        }
    }

    /// Adds the images to the buffer.
    fn embed(&mut self) {
        self.embedded = true;
        self.length = self.materials.embed(&mut self.root, self.length);
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
        if let Places::Packed(packed) = &self.places {
            packed.add_fallback(&mut self.root);
        }
    }

    /// Writes the JSON.
    fn json(&self, out: &mut impl Write) -> io::Result<()> {
        match &self.places {
            Places::Tree(tree) => document::write(&self.root, &self.geometry, tree, out),
            #[cfg(feature = "compress")]
            Places::Packed(packed) => {
                document::write_packed(&self.root, &self.geometry, packed, out)
            }
        }
    }

    /// Writes the buffer.
    fn buffer(&self, out: &mut impl Write) -> io::Result<()> {
        match &self.places {
            Places::Tree(_) => self.geometry.write(out)?,
            #[cfg(feature = "compress")]
            Places::Packed(packed) => out.write_all(&packed.bytes)?,
        }
        if self.embedded {
            self.materials.write(out)?;
        }
        Ok(())
    }
}
