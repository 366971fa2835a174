//! OBJ with MTL, the exchange format for parts in the reconstruction of Edo (000-32 to 000-40).
//!
//! Frame: x east, y up, z south, metres: the same right-handed frame as glTF. `vt` runs u to the right and v upwards.
//! Only the commands of 000-32 and `o` are used; there is no `vn`, since faces share no vertex across a sharp edge.
//! Instances are expanded. Numbers have at most six decimals.

mod mtl;

use super::flat::{self, Placement, places};
use super::number::Number;
use super::{Images, OutFile, SurfaceFiles, one_word, picture_folder};
use crate::scene::{Image, Primitive, Scene};
use std::collections::HashMap;
use std::fmt::Write as _;

/// Returns `stem.obj`, `stem.mtl` and the images in the folder `stem_textures`; the file that refers to the others
/// comes last. Blanks in file names become `_`.
pub fn obj<'a>(scene: &Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let stem = &one_word(stem);
    let mut writer = ObjWriter::new(scene, images);
    let _ = writeln!(
        writer.out,
        "# hsd {}: x east, y up, z south, metres",
        env!("CARGO_PKG_VERSION")
    );
    let _ = writeln!(writer.out, "mtllib {stem}.mtl");
    writer.nodes();
    let folder = picture_folder(stem);
    let (mtl, mut files) = mtl::mtl(scene, &writer.used, images, &folder);
    files.push(OutFile {
        name: format!("{stem}.mtl"),
        bytes: mtl.into_bytes().into(),
    });
    files.push(OutFile {
        name: format!("{stem}.obj"),
        bytes: writer.out.into_bytes().into(),
    });
    files
}

struct ObjWriter<'a> {
    scene: &'a Scene,
    out: String,
    /// By material number in the scene: the divisor of texture coordinates, if the material has a texture.
    metres: Vec<Option<f64>>,
    /// For each material, true if it shows a reflection, by its own texture coordinates.
    mirrors: Vec<bool>,
    /// Materials on written faces.
    used: Vec<bool>,
    /// Number of vertices and texture vertices so far; OBJ numbers start at 1 and continue through the file.
    counts: (usize, usize),
}

impl<'a> ObjWriter<'a> {
    fn new(scene: &'a Scene, images: &dyn Images) -> ObjWriter<'a> {
        let metres = |image: &Image| match image {
            Image::None => None,
            Image::Surface(name) => images.files(name).map(|f: SurfaceFiles<'_>| f.metres),
            Image::Picture(index) => images.picture(*index).map(|_| 1.0),
            Image::Baked(index) => images.baked(*index).map(|f| f.metres),
        };
        ObjWriter {
            scene,
            out: String::new(),
            metres: scene.materials.iter().map(|m| metres(&m.image)).collect(),
            mirrors: scene
                .materials
                .iter()
                .map(|m| mtl::mirrored(m, images).is_some())
                .collect(),
            used: vec![false; scene.materials.len()],
            counts: (0, 0),
        }
    }

    fn nodes(&mut self) {
        let mut paths: Vec<String> = vec![];
        for (node, place) in self.scene.nodes.iter().zip(places(self.scene)) {
            let name = if node.name.is_empty() {
                node.kind.word()
            } else {
                &node.name
            };
            let above = node.parent.and_then(|p| paths.get(p.0 as usize));
            let path = above.map_or(one_word(name), |a| format!("{a}/{}", one_word(name)));
            let mut shown = flat::primitives(self.scene, node).peekable();
            if place.sound && shown.peek().is_some() {
                let _ = writeln!(self.out, "o {path}");
                self.object(place, shown);
            }
            paths.push(path);
        }
    }

    /// Writes the shapes of one node; coincident points are written once, so that edges are shared.
    fn object<'p>(&mut self, place: Placement, primitives: impl Iterator<Item = &'p Primitive>) {
        let mut points: HashMap<[i64; 3], usize> = HashMap::new();
        let mut coordinates: HashMap<[i64; 2], usize> = HashMap::new();
        for primitive in primitives {
            let material = primitive.material.0 as usize;
            self.used[material] = true;
            let vertices: Vec<usize> = primitive
                .positions
                .iter()
                .map(|p| {
                    let p = place.point(flat::point(*p));
                    let xyz = [p.x, p.z, -p.y].map(Number);
                    let next = self.counts.0 + 1;
                    let number = *points.entry(xyz.map(Number::millionths)).or_insert(next);
                    if number == next {
                        self.counts.0 += 1;
                        let _ = writeln!(self.out, "v {} {} {}", xyz[0], xyz[1], xyz[2]);
                    }
                    number
                })
                .collect();
            let (metres, uvs) = match self.mirrors[material] {
                true => (Some(1.0), &primitive.mirror_uvs),
                false => (self.metres[material], &primitive.uvs),
            };
            let corners: Vec<usize> = metres.map_or(vec![], |metres| {
                let mut corner = |uv: &[f32; 2]| {
                    let uv = uv.map(|x| Number(f64::from(x) / metres));
                    let next = self.counts.1 + 1;
                    let number = *coordinates
                        .entry(uv.map(Number::millionths))
                        .or_insert(next);
                    if number == next {
                        self.counts.1 += 1;
                        let _ = writeln!(self.out, "vt {} {}", uv[0], uv[1]);
                    }
                    number
                };
                uvs.iter().map(&mut corner).collect()
            });
            let _ = writeln!(
                self.out,
                "usemtl {}",
                one_word(&self.scene.materials[material].name)
            );
            self.faces(&primitive.indices, &vertices, &corners);
        }
    }

    fn faces(&mut self, indices: &[u32], vertices: &[usize], corners: &[usize]) {
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| vertices[triangle[k] as usize]);
            if a == b || b == c || c == a {
                continue; // joined to a line by rounding
            }
            self.out.push('f');
            for &i in triangle {
                let vertex = vertices[i as usize];
                let _ = match corners.get(i as usize) {
                    Some(corner) => write!(self.out, " {vertex}/{corner}"),
                    None => write!(self.out, " {vertex}"),
                };
            }
            self.out.push('\n');
        }
    }
}
