//! Materials with their textures, images and samplers.

use super::arrays::MaterialRef;
use super::buffer::view;
use crate::images::{KTX2, mime};
use crate::{Images, OutFile, PictureBytes, SurfaceFiles, picture_folder};
use gltf::json::extensions::material::{
    IndexOfRefraction, Ior, Material as Extensions, Specular, SpecularColorFactor, SpecularFactor,
};
use gltf::json::extensions::texture::Texture as TextureExtensions;
use gltf::json::image::MimeType;
use gltf::json::material::{
    AlphaMode, EmissiveFactor, NormalTexture, PbrBaseColorFactor, PbrMetallicRoughness,
    StrengthFactor,
};
use gltf::json::texture::{Info, MagFilter, MinFilter, Sampler, WrappingMode};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Image, Index, Material, Root, Texture};
use hsd_base::source::reference;
use hsd_scene::MaterialId;
use serde_json::value::to_raw_value;
use std::borrow::Cow;
use std::io::{self, Write};

/// The extensions of a pane.
const GLASS: [&str; 2] = ["KHR_materials_ior", "KHR_materials_specular"];

/// The extension for KTX2 images.
const BASISU: &str = "KHR_texture_basisu";

/// Refractive index of window glass, and the share of light that it reflects straight on. The share that a pane reflects
/// by its source is that times the specular colour, which standard viewers understand too.
const IOR: f32 = 1.5;
const IOR_SHARE: f32 = 0.04;

/// An image in use.
struct Picture<'a> {
    name: Cow<'a, str>,
    bytes: &'a [u8],
    mime: &'static str,
}

/// The textures of one [`hsd_scene::Image`].
struct ImageTextures<'a> {
    image: &'a hsd_scene::Image,
    color: Index<Texture>,
    normal: Option<Index<Texture>>,
    orm: Option<Index<Texture>>,
    /// Roughness and metalness in place of `orm`.
    gloss: Option<[f32; 2]>,
}

/// The materials of written triangles, numbered in the order of first use.
#[derive(Default)]
pub(super) struct MaterialRefs {
    /// True if surfaces have no relief: seen from afar it shows nothing, and tangents are a third of a vertex.
    pub(super) flat: bool,
    /// True if vertices have no tangents, though surfaces have relief.
    pub(super) no_tangents: bool,
    /// By the scene's number.
    known: Vec<Option<MaterialRef>>,
    /// The scene's numbers in the order of the file.
    order: Vec<MaterialId>,
}

impl MaterialRefs {
    /// Returns what geometry needs of a material, which is numbered on first use.
    pub(super) fn of(
        &mut self,
        id: MaterialId,
        material: &hsd_scene::Material,
        images: &dyn Images,
    ) -> MaterialRef {
        let at = id.0 as usize;
        if self.known.len() <= at {
            self.known.resize(at + 1, None);
        }
        if let Some(known) = self.known[at] {
            return known;
        }
        let shown = |picture: &PictureBytes<'_>| mime(picture.bytes).is_some();
        let (metres, relief) = match &material.image {
            hsd_scene::Image::None => (None, false),
            hsd_scene::Image::Surface(name) => {
                let files = images.files(name).filter(|f| shown(&f.color));
                let relief = |f: &SurfaceFiles<'_>| f.normal.as_ref().is_some_and(shown);
                let metres = files.as_ref().map(|f| f.metres as f32);
                (metres, files.as_ref().is_some_and(relief))
            }
            // Pages come at the end, when all images on them are known.
            hsd_scene::Image::Baked(_) => (Some(1.0), true),
            hsd_scene::Image::Picture(index) => {
                let picture = images.picture(*index).filter(shown);
                (picture.map(|_| 1.0), false)
            }
        };
        let mirrored = material.mirrored.and_then(|index| images.mirrored(index));
        let made = MaterialRef {
            number: Index::new(self.order.len() as u32),
            metres,
            relief: relief && !self.flat && !self.no_tangents,
            mirrors: mirrored.as_ref().is_some_and(shown),
        };
        self.order.push(id);
        self.known[at] = Some(made);
        made
    }
}

/// All materials of a model.
#[derive(Default)]
pub(super) struct Materials<'a> {
    /// As in [`MaterialRefs`].
    flat: bool,
    pictures: Vec<Picture<'a>>,
    textures: Vec<ImageTextures<'a>>,
}

impl<'a> Materials<'a> {
    /// Adds the materials in use and their textures to the root.
    pub(super) fn new(
        refs: &MaterialRefs,
        all: &'a [hsd_scene::Material],
        images: &'a dyn Images,
        root: &mut Root,
    ) -> Materials<'a> {
        let mut materials = Materials {
            flat: refs.flat,
            ..Materials::default()
        };
        for material in refs.order.iter().map(|id| &all[id.0 as usize]) {
            let textures = materials.image(&material.image, images, root);
            let mirrored = material.mirrored.and_then(|index| {
                let picture = images.mirrored(index)?;
                materials.texture(picture, WrappingMode::ClampToEdge, root)
            });
            let textures = textures.map(|d| &materials.textures[d]);
            root.push(made(material, textures, mirrored));
        }
        if root.materials.iter().any(|m| m.extensions.is_some()) {
            root.extensions_used.extend(GLASS.map(str::to_owned));
        }
        materials
    }

    /// Returns the size of all images, bytes.
    pub(super) fn length(&self) -> u64 {
        let lengths = self.pictures.iter().map(|p| p.bytes.len());
        lengths.sum::<usize>() as u64
    }

    /// Places the images in the buffer, from this byte on; returns their end.
    pub(super) fn embed(&self, root: &mut Root, start: usize) -> usize {
        let mut end = start;
        for picture in &self.pictures {
            let length = picture.bytes.len();
            let inside = root.push(view(end, length));
            root.images.push(Image {
                buffer_view: Some(inside),
                mime_type: Some(MimeType(picture.mime.into())),
                ..picture.image()
            });
            end += length.next_multiple_of(4);
        }
        end
    }

    /// Writes the images as [`embed`](Materials::embed) places them.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for Picture { bytes, .. } in &self.pictures {
            let gap = bytes.len().next_multiple_of(4) - bytes.len();
            out.write_all(bytes)?;
            out.write_all(&[0; 3][..gap])?;
        }
        Ok(())
    }

    /// Returns the images as files in the folder of the model.
    pub(super) fn files(&self, root: &mut Root, stem: &str) -> Vec<OutFile<'a>> {
        self.files_in(root, &picture_folder(stem))
    }

    /// Returns the images as files in a folder, a path relative to the model.
    pub(super) fn files_in(&self, root: &mut Root, folder: &str) -> Vec<OutFile<'a>> {
        let file = |picture: &Picture<'a>| {
            let name = format!("{folder}/{}", picture.name);
            root.images.push(Image {
                uri: Some(reference(&name)),
                ..picture.image()
            });
            let bytes = picture.bytes.into();
            OutFile { name, bytes }
        };
        self.pictures.iter().map(file).collect()
    }

    /// Index into `textures`.
    fn image(
        &mut self,
        image: &'a hsd_scene::Image,
        images: &'a dyn Images,
        root: &mut Root,
    ) -> Option<usize> {
        if let Some(known) = self.textures.iter().position(|t| t.image == image) {
            return Some(known);
        }
        let flat = self.flat;
        let mut texture = |picture, wrap| self.texture(picture, wrap, root);
        let made = match image {
            hsd_scene::Image::None => return None,
            hsd_scene::Image::Surface(name) => {
                let files = images.files(name)?;
                ImageTextures {
                    image,
                    color: texture(files.color, WrappingMode::Repeat)?,
                    normal: files
                        .normal
                        .filter(|_| !flat)
                        .and_then(|f| texture(f, WrappingMode::Repeat)),
                    orm: files
                        .orm
                        .filter(|_| !flat)
                        .and_then(|f| texture(f, WrappingMode::Repeat)),
                    gloss: flat.then_some(files.gloss),
                }
            }
            hsd_scene::Image::Baked(index) => {
                let files = images.baked(*index)?;
                ImageTextures {
                    image,
                    color: texture(files.color, WrappingMode::ClampToEdge)?,
                    normal: files
                        .normal
                        .and_then(|f| texture(f, WrappingMode::ClampToEdge)),
                    orm: files
                        .orm
                        .and_then(|f| texture(f, WrappingMode::ClampToEdge)),
                    gloss: None,
                }
            }
            hsd_scene::Image::Picture(index) => ImageTextures {
                image,
                color: texture(images.picture(*index)?, WrappingMode::ClampToEdge)?,
                normal: None,
                orm: None,
                gloss: None,
            },
        };
        self.textures.push(made);
        Some(self.textures.len() - 1)
    }

    fn texture(
        &mut self,
        picture: PictureBytes<'a>,
        wrap: WrappingMode,
        root: &mut Root,
    ) -> Option<Index<Texture>> {
        // Materials of one surface share its relief. Each picture has one texture, so that they count alike.
        let same = |p: &Picture<'_>| p.name == picture.name && std::ptr::eq(p.bytes, picture.bytes);
        if let Some(known) = self.pictures.iter().position(same) {
            return Some(Index::new(known as u32));
        }
        let mime = mime(picture.bytes)?;
        let known = root.samplers.iter().position(|s| s.wrap_s == Valid(wrap));
        let sampler = known.map_or_else(
            || {
                root.push(Sampler {
                    mag_filter: Some(Valid(MagFilter::Linear)),
                    min_filter: Some(Valid(MinFilter::LinearMipmapLinear)),
                    wrap_s: Valid(wrap),
                    wrap_t: Valid(wrap),
                    ..Sampler::default()
                })
            },
            |k| Index::new(k as u32),
        );
        let source = Index::new(self.pictures.len() as u32);
        self.pictures.push(Picture {
            name: self.free_name(picture.name),
            bytes: picture.bytes,
            mime,
        });
        let mut texture = Texture {
            sampler: Some(sampler),
            source,
            name: None,
            extensions: None,
            extras: None,
        };
        if mime == KTX2 {
            basisu(&mut texture);
            if !root.extensions_used.iter().any(|e| e == BASISU) {
                root.extensions_used.push(BASISU.into());
                root.extensions_required.push(BASISU.into());
            }
        }
        Some(root.push(texture))
    }

    /// Returns a name that is not in use: two images of one name (from two folders) must not overwrite each other.
    fn free_name(&self, name: Cow<'a, str>) -> Cow<'a, str> {
        let taken = |n: &str| self.pictures.iter().any(|p| p.name.eq_ignore_ascii_case(n));
        let numbered = |k: usize| format!("{k}_{name}");
        if !taken(&name) {
            return name;
        }
        let free = (2..).map(numbered).find(|n| !taken(n));
        Cow::Owned(free.unwrap_or_default())
    }
}

impl Picture<'_> {
    /// Returns its JSON, except for its location.
    fn image(&self) -> Image {
        let stem = self.name.rsplit_once('.').map(|(stem, _)| stem);
        Image {
            name: Some(stem.unwrap_or(&self.name).to_owned()),
            buffer_view: None,
            mime_type: None,
            uri: None,
            extensions: None,
            extras: None,
        }
    }
}

fn made(
    m: &hsd_scene::Material,
    textures: Option<&ImageTextures<'_>>,
    mirrored: Option<Index<Texture>>,
) -> Material {
    let factor = |x: f32| {
        if x.is_finite() {
            x.clamp(0.0, 1.0)
        } else {
            1.0
        }
    };
    let reflection = m.reflection.map(factor);
    let [rough, metal] = textures.and_then(|t| t.gloss).unwrap_or([1.0; 2]);
    let (tint, light) = match mirrored {
        Some(_) => m.under_mirror(),
        None => (m.tint, 0.0),
    };
    Material {
        name: Some(m.name.clone()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor(tint.map(factor)),
            base_color_texture: textures.map(|d| info(d.color)),
            metallic_factor: StrengthFactor(factor(m.metallic * metal)),
            roughness_factor: StrengthFactor(factor(m.roughness * rough)),
            metallic_roughness_texture: textures.and_then(|t| t.orm).map(info),
            ..PbrMetallicRoughness::default()
        },
        normal_texture: textures.and_then(|t| t.normal).map(|index| NormalTexture {
            index,
            scale: 1.0,
            tex_coord: 0,
            extensions: None,
            extras: None,
        }),
        emissive_texture: mirrored.map(|index| Info {
            tex_coord: 1,
            ..info(index)
        }),
        emissive_factor: EmissiveFactor([factor(light); 3]),
        alpha_mode: Valid(if m.cutout {
            AlphaMode::Mask
        } else if factor(tint[3]) < 1.0 {
            AlphaMode::Blend
        } else {
            AlphaMode::Opaque
        }),
        double_sided: m.double_sided,
        extensions: reflection.map(glass),
        extras: reflection.and_then(|r| to_raw_value(&serde_json::json!({ "reflection": r })).ok()),
        ..Material::default()
    }
}

fn glass(reflection: f32) -> Extensions {
    Extensions {
        ior: Some(Ior {
            ior: IndexOfRefraction(IOR),
            extras: None,
        }),
        specular: Some(Specular {
            specular_factor: SpecularFactor(1.0),
            specular_color_factor: SpecularColorFactor([reflection / IOR_SHARE; 3]),
            ..Specular::default()
        }),
        ..Extensions::default()
    }
}

/// Makes an image in a format outside core glTF the source of a texture by the extension alone.
fn basisu(texture: &mut Texture) {
    let source = std::mem::replace(&mut texture.source, Index::new(u32::MAX));
    let others = [(BASISU.to_owned(), serde_json::json!({ "source": source }))];
    texture.extensions = Some(TextureExtensions {
        others: others.into_iter().collect(),
    });
}

fn info(index: Index<Texture>) -> Info {
    Info {
        index,
        tex_coord: 0,
        extensions: None,
        extras: None,
    }
}
