//! OBJ with MTL, the exchange format for parts in the reconstruction of Edo (000-32 to 000-40).
//!
//! Frame: x east, y up, z south, metres: the same right-handed frame as glTF. `vt` runs u to the right and v upwards.
//! The commands are those of 000-32, `o`, and `vn`, without which rings and curved roofs would be faceted. Objects have
//! unique names. Instances are expanded. Numbers have at most six decimals, those of normals three.

mod mtl;
mod tinted;

use super::flat::{self, Placement, places};
use super::number::Number;
use super::{Images, OutFile, SurfaceFiles, one_word, picture_folder};
use crate::scene::{Image, Primitive, Scene};
use glam::DVec3;
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
    vertices: Numbers<3>,
    coordinates: Numbers<2>,
    normals: Numbers<3>,
    /// How many objects have had a name.
    names: HashMap<String, usize>,
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
            vertices: Numbers::new("v"),
            coordinates: Numbers::new("vt"),
            normals: Numbers::new("vn"),
            names: HashMap::new(),
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
                let _ = writeln!(self.out, "o {}", unique(&mut self.names, &path));
                self.object(place, shown);
            }
            paths.push(path);
        }
    }

    /// Writes the shapes of one node; coincident points are written once, so that edges are shared.
    fn object<'p>(&mut self, place: Placement, primitives: impl Iterator<Item = &'p Primitive>) {
        self.vertices.begin();
        self.coordinates.begin();
        for primitive in primitives {
            let material = primitive.material.0 as usize;
            self.used[material] = true;
            let out = &mut self.out;
            let up = |p: DVec3| [p.x, p.z, -p.y];
            let vertices: Vec<usize> = primitive
                .positions
                .iter()
                .map(|p| {
                    self.vertices
                        .of(up(place.point(flat::point(*p))).map(Number), out)
                })
                .collect();
            let (metres, uvs) = match self.mirrors[material] {
                true => (Some(1.0), &primitive.mirror_uvs),
                false => (self.metres[material], &primitive.uvs),
            };
            let coordinates: Vec<usize> = metres.map_or(vec![], |metres| {
                let number = |uv: &[f32; 2]| uv.map(|x| Number(f64::from(x) / metres));
                let all = uvs.iter().map(number);
                all.map(|uv| self.coordinates.of(uv, out)).collect()
            });
            let normals: Vec<usize> = primitive
                .normals
                .iter()
                .map(|n| {
                    let turned = place.direction(flat::point(*n));
                    self.normals.of(up(turned).map(Number::thousandths), out)
                })
                .collect();
            let name = one_word(&self.scene.materials[material].name);
            let _ = writeln!(out, "usemtl {name}");
            faces(out, &primitive.indices, &vertices, &coordinates, &normals);
        }
    }
}

fn faces(
    out: &mut String,
    indices: &[u32],
    vertices: &[usize],
    coordinates: &[usize],
    normals: &[usize],
) {
    for triangle in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| vertices[triangle[k] as usize]);
        if a == b || b == c || c == a {
            continue; // joined to a line by rounding
        }
        out.push('f');
        for &i in triangle {
            let i = i as usize;
            let vertex = vertices[i];
            let _ = match (coordinates.get(i), normals.get(i)) {
                (Some(at), Some(normal)) => write!(out, " {vertex}/{at}/{normal}"),
                (Some(at), None) => write!(out, " {vertex}/{at}"),
                (None, Some(normal)) => write!(out, " {vertex}//{normal}"),
                (None, None) => write!(out, " {vertex}"),
            };
        }
        out.push('\n');
    }
}

/// Numbered values of one command. OBJ numbers start at 1 and continue through the file.
struct Numbers<const N: usize> {
    command: &'static str,
    count: usize,
    known: HashMap<[i64; N], usize>,
}

impl<const N: usize> Numbers<N> {
    fn new(command: &'static str) -> Numbers<N> {
        Numbers {
            command,
            count: 0,
            known: HashMap::new(),
        }
    }

    /// Begins an object, which shares no values with others.
    fn begin(&mut self) {
        self.known.clear();
    }

    /// Returns the number of a value, and writes the value if it is new.
    fn of(&mut self, value: [Number; N], out: &mut String) -> usize {
        let next = self.count + 1;
        let number = *self
            .known
            .entry(value.map(Number::millionths))
            .or_insert(next);
        if number == next {
            self.count = next;
            out.push_str(self.command);
            for x in value {
                let _ = write!(out, " {x}");
            }
            out.push('\n');
        }
        number
    }
}

/// Returns the path of an object, with a number from the second of a path on.
fn unique(names: &mut HashMap<String, usize>, path: &str) -> String {
    let count = names.entry(path.to_owned()).or_insert(0);
    *count += 1;
    match *count {
        1 => path.to_owned(),
        n => unique(names, &format!("{path}_{n}")),
    }
}
