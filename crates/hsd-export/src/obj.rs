//! OBJ with MTL, the exchange format for parts in the reconstruction of Edo (000-32 to 000-40).
//!
//! Frame: x east, y up, z south, metres: the same right-handed frame as glTF. `vt` runs u to the right and v upwards.
//! The commands are those of 000-32, `o`, and `vn`, without which rings and curved roofs would be faceted. Objects have
//! unique names. Instances are expanded. Numbers have at most six decimals, those of normals three.

mod mtl;
mod numbers;
mod text;
mod tinted;

use super::flat::{self, Placement, places};
use super::names::Names;
use super::number::Number;
use super::spool::{NewSpool, Section, in_memory};
use super::{Images, OutFile, one_word, picture_folder};
use glam::DVec3;
use hsd_scene::{Image, Material, Node, Primitive, Scene, ScenePart};
use numbers::Numbers;
use std::fmt::Write as _;
use std::io;
pub use text::Text;

/// Returns `stem.obj`, `stem.mtl` and the images in the folder `stem_textures`; the file that refers to the others
/// comes last. Blanks in file names become `_`.
pub fn obj<'a>(scene: &Scene, images: &'a dyn Images, stem: &str) -> Vec<OutFile<'a>> {
    let write = || {
        let mut writer = Writer::new(&in_memory)?;
        writer.add(scene.whole(), images)?;
        let (text, mut files) = writer.finish(&scene.materials, images, &[], stem);
        let mut bytes = vec![];
        text.write(&mut bytes)?;
        files.push(OutFile {
            name: format!("{}.obj", one_word(stem)),
            bytes: bytes.into(),
        });
        Ok::<_, io::Error>(files)
    };
    write().expect("memory takes every byte")
}

/// A model that takes houses one after another. Meshes of all houses must be in the parts that show them: see
/// `SceneBuilder::forget_twins`.
pub struct Writer {
    lines: Section,
    /// The lines of the houses in work.
    out: String,
    /// The materials so far, by their numbers in the scene.
    looks: Vec<Look>,
    vertices: Numbers<3>,
    coordinates: Numbers<3>,
    normals: Numbers<3>,
    houses: Names,
    /// The names in a house.
    objects: Names,
    on_pages: bool,
}

/// A material as OBJ needs it.
#[derive(Clone, Copy)]
struct Look {
    coordinates: Coordinates,
    /// True if it is on a face.
    used: bool,
}

/// Which texture coordinates a material needs.
#[derive(Clone, Copy)]
enum Coordinates {
    None,
    /// Repeats of this width, metres.
    Repeats(f64),
    /// The place on a page of baked images.
    OnPage(u32),
    /// The place in the reflection.
    Mirror,
}

impl Look {
    fn of(material: &Material, images: &dyn Images) -> Look {
        let coordinates = match material.image {
            _ if mtl::mirrored(material, images).is_some() => Coordinates::Mirror,
            Image::None => Coordinates::None,
            Image::Surface(name) => match images.files(name) {
                Some(files) => Coordinates::Repeats(files.metres),
                None => Coordinates::None,
            },
            Image::Picture(index) => match images.picture(index) {
                Some(_) => Coordinates::Repeats(1.0),
                None => Coordinates::None,
            },
            // The page is there when it is full.
            Image::Baked(page) => Coordinates::OnPage(page),
        };
        Look {
            coordinates,
            used: false,
        }
    }
}

impl Writer {
    /// Creates a model without houses that keeps its content in a spool.
    ///
    /// # Errors Those of the spool.
    pub fn new(new: NewSpool<'_>) -> io::Result<Writer> {
        Ok(Writer {
            lines: Section::new("lines", new)?,
            out: String::new(),
            looks: vec![],
            vertices: Numbers::new(),
            coordinates: Numbers::new(),
            normals: Numbers::new(),
            houses: Names::default(),
            objects: Names::default(),
            on_pages: false,
        })
    }

    /// Adds houses. Images must be there, except baked pages, which are needed at the end only.
    ///
    /// # Errors Those of the spool.
    pub fn add(&mut self, part: ScenePart<'_>, images: &dyn Images) -> io::Result<()> {
        let more = part.materials.iter().skip(self.looks.len());
        self.looks.extend(more.map(|m| Look::of(m, images)));
        let mut paths: Vec<String> = Vec::with_capacity(part.nodes.len());
        for (i, (node, place)) in part.nodes.iter().zip(places(part)).enumerate() {
            let name = one_word(name_of(node));
            let path = match part.parent(i) {
                Some(parent) => format!("{}/{name}", paths[parent]),
                None => {
                    self.objects.clear();
                    self.houses.unique(&name)
                }
            };
            let mut shown = flat::primitives(part, node).peekable();
            if place.sound && shown.peek().is_some() {
                let _ = writeln!(self.out, "o {}", self.objects.unique(&path));
                self.object(place, shown, part.materials);
            }
            paths.push(path);
            if self.out.len() > BLOCK {
                self.flush()?;
            }
        }
        self.flush()
    }

    fn flush(&mut self) -> io::Result<()> {
        let lines = std::mem::take(&mut self.out);
        let written = |out: &mut Vec<u8>| {
            out.extend_from_slice(lines.as_bytes());
            Ok(())
        };
        self.lines.append(written).map(drop)
    }

    /// Returns `stem.obj`, and the files to which it refers. `materials` are those of the scene, `grown` the factors by
    /// which distances from the upper edge of each baked page have grown.
    pub fn finish<'a>(
        self,
        materials: &[Material],
        images: &'a dyn Images,
        grown: &[f32],
        stem: &str,
    ) -> (Text, Vec<OutFile<'a>>) {
        let stem = &one_word(stem);
        let used = materials.iter().zip(&self.looks);
        let used = used.filter(|(_, look)| look.used).map(|(m, _)| m);
        let (mtl, mut files) = mtl::mtl(used, images, &picture_folder(stem));
        files.push(OutFile {
            name: format!("{stem}.mtl"),
            bytes: mtl.into_bytes().into(),
        });
        let version = env!("CARGO_PKG_VERSION");
        let text = Text {
            head: format!("# hsd {version}: x east, y up, z south, metres\nmtllib {stem}.mtl\n"),
            lines: self.lines,
            on_pages: self.on_pages,
            grown: grown.to_vec(),
        };
        (text, files)
    }

    /// Writes the shapes of one node; coincident points are written once, so that edges are shared.
    fn object<'p>(
        &mut self,
        place: Placement,
        primitives: impl Iterator<Item = &'p Primitive>,
        materials: &[Material],
    ) {
        self.vertices.begin();
        self.coordinates.begin();
        for primitive in primitives {
            let material = primitive.material.0 as usize;
            self.looks[material].used = true;
            let vertices: Vec<usize> = primitive
                .positions
                .iter()
                .map(|p| {
                    let at = up(place.point(flat::point(*p))).map(Number);
                    let out = &mut self.out;
                    self.vertices
                        .of(at.map(Number::millionths), || line("v", &at, out))
                })
                .collect();
            let coordinates = self.coordinates(primitive, self.looks[material].coordinates);
            let normals: Vec<usize> = primitive
                .normals
                .iter()
                .map(|n| {
                    let turned = up(place.direction(flat::point(*n))).map(Number::thousandths);
                    let out = &mut self.out;
                    self.normals
                        .of(turned.map(Number::millionths), || line("vn", &turned, out))
                })
                .collect();
            let name = one_word(&materials[material].name);
            let _ = writeln!(self.out, "usemtl {name}");
            let numbers = (&vertices[..], &coordinates[..], &normals[..]);
            faces(&mut self.out, &primitive.indices, numbers);
        }
    }

    /// Returns the numbers of the texture coordinates of a shape; none if its material needs none.
    fn coordinates(&mut self, primitive: &Primitive, kind: Coordinates) -> Vec<usize> {
        let uvs = match kind {
            Coordinates::None => return vec![],
            Coordinates::Mirror => &primitive.mirror_uvs,
            Coordinates::Repeats(_) | Coordinates::OnPage(_) => &primitive.uvs,
        };
        let divisor = match kind {
            Coordinates::Repeats(metres) => metres,
            _ => 1.0,
        };
        self.on_pages |= matches!(kind, Coordinates::OnPage(_));
        let number = |uv: &[f32; 2]| {
            let at = uv.map(|x| Number(f64::from(x) / divisor));
            let [u, v] = at.map(Number::millionths);
            let out = &mut self.out;
            match kind {
                Coordinates::OnPage(page) => {
                    let key = [u, v, 1 + i64::from(page)];
                    self.coordinates.of(key, || text::on_page(page, *uv, out))
                }
                _ => self.coordinates.of([u, v, 0], || line("vt", &at, out)),
            }
        };
        uvs.iter().map(number).collect()
    }
}

/// The characters of lines that wait for the spool.
const BLOCK: usize = 1 << 16;

fn name_of(node: &Node) -> &str {
    match node.name.is_empty() {
        true => node.kind.word(),
        false => &node.name,
    }
}

/// Converts from z up to y up.
fn up(p: DVec3) -> [f64; 3] {
    [p.x, p.z, -p.y]
}

/// Adds a command with its numbers.
fn line(command: &str, numbers: &[Number], out: &mut String) {
    out.push_str(command);
    for x in numbers {
        let _ = write!(out, " {x}");
    }
    out.push('\n');
}

fn faces(
    out: &mut String,
    indices: &[u32],
    (vertices, coordinates, normals): (&[usize], &[usize], &[usize]),
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
