//! Materials with their textures, pictures and samplers.

use super::document::{
    Glass, Image, Ior, Material, Pbr, Reflection, Sampler, Specular, Texture, TextureRef,
};
use super::escaped;
use super::geometry::Shown;
use crate::backend::pictures::mime;
use crate::backend::{Images, PictureBytes};
use crate::scene::{self, MaterialId, Scene};
use std::borrow::Cow;

const LINEAR: u32 = 9729;
const LINEAR_MIPMAP_LINEAR: u32 = 9987;
const REPEAT: u32 = 10497;
const CLAMP_TO_EDGE: u32 = 33071;

/// Window glass; what the share of mirrored light adds is the specular factor.
const IOR: f32 = 1.5;

/// A picture in use.
pub(super) struct Picture<'a> {
    pub(super) name: Cow<'a, str>,
    pub(super) bytes: &'a [u8],
    mime: &'static str,
}

/// The textures of one [`scene::Image`].
struct Drawn<'a> {
    image: &'a scene::Image,
    metres: f32,
    color: TextureRef,
    normal: Option<TextureRef>,
    orm: Option<TextureRef>,
}

/// What the geometry needs to know of a material.
#[derive(Clone, Copy)]
pub(super) struct Look {
    /// Its glTF number.
    pub(super) number: u32,
    /// Metres of one repeat if it shows a picture.
    pub(super) metres: Option<f32>,
    /// Whether it has normals, which need tangents.
    pub(super) relief: bool,
}

/// How everything looks.
#[derive(Default)]
pub(super) struct Looks<'a> {
    pub(super) extensions: Vec<&'static str>,
    pub(super) materials: Vec<Material<'a>>,
    pub(super) textures: Vec<Texture>,
    pub(super) images: Vec<Picture<'a>>,
    pub(super) samplers: Vec<Sampler>,
    /// By the scene's number.
    looks: Vec<Look>,
    drawn: Vec<Drawn<'a>>,
}

impl<'a> Looks<'a> {
    pub(super) fn new(scene: &'a Scene, shown: &Shown<'_>, images: &'a dyn Images) -> Looks<'a> {
        let mut looks = Looks::default();
        for (material, &used) in scene.materials.iter().zip(&shown.materials) {
            let number = looks.materials.len() as u32;
            let drawn = used.then(|| looks.drawn(&material.image, images)).flatten();
            let shows = drawn.map(|d| &looks.drawn[d]);
            looks.looks.push(Look {
                number,
                metres: shows.map(|d| d.metres),
                relief: shows.is_some_and(|d| d.normal.is_some()),
            });
            if used {
                let made = looks.material(material, drawn);
                looks.materials.push(made);
            }
        }
        looks
    }

    /// How a material in use looks.
    pub(super) fn look(&self, id: MaterialId) -> Look {
        self.looks[id.0 as usize]
    }

    /// The JSON of the pictures, in a folder or in the views `view_of`.
    pub(super) fn images<'b>(
        &'b self,
        folder: Option<&str>,
        view_of: impl Fn(usize) -> Option<usize>,
    ) -> Vec<Image<'b>> {
        let image = |(k, picture): (usize, &'b Picture<'a>)| Image {
            name: picture
                .name
                .rsplit_once('.')
                .map_or(&*picture.name, |(stem, _)| stem),
            buffer_view: view_of(k),
            mime_type: view_of(k).map(|_| picture.mime),
            uri: folder.map(|f| escaped(&format!("{f}/{}", picture.name))),
        };
        self.images.iter().enumerate().map(image).collect()
    }

    fn material(&mut self, m: &'a scene::Material, drawn: Option<usize>) -> Material<'a> {
        let drawn = drawn.map(|d| &self.drawn[d]);
        let factor = |x: f32| {
            if x.is_finite() {
                x.clamp(0.0, 1.0)
            } else {
                1.0
            }
        };
        let reflection = m.reflection.map(factor);
        if reflection.is_some() && self.extensions.is_empty() {
            self.extensions = vec!["KHR_materials_ior", "KHR_materials_specular"];
        }
        Material {
            name: &m.name,
            pbr_metallic_roughness: Pbr {
                base_color_factor: m.tint.map(factor),
                base_color_texture: drawn.map(|d| d.color),
                metallic_factor: factor(m.metallic),
                roughness_factor: factor(m.roughness),
                metallic_roughness_texture: drawn.and_then(|d| d.orm),
            },
            normal_texture: drawn.and_then(|d| d.normal),
            alpha_mode: (factor(m.tint[3]) < 1.0).then_some("BLEND"),
            double_sided: m.double_sided,
            extensions: reflection.map(|specular_factor| Glass {
                ior: Ior { ior: IOR },
                specular: Specular { specular_factor },
            }),
            extras: reflection.map(|reflection| Reflection { reflection }),
        }
    }

    /// Index into `drawn`.
    fn drawn(&mut self, image: &'a scene::Image, images: &'a dyn Images) -> Option<usize> {
        if let Some(known) = self.drawn.iter().position(|d| d.image == image) {
            return Some(known);
        }
        let made = match image {
            scene::Image::None => return None,
            scene::Image::Surface(name) => {
                let files = images.files(name)?;
                Drawn {
                    image,
                    metres: files.metres as f32,
                    color: self.texture(files.color, REPEAT)?,
                    normal: files.normal.and_then(|f| self.texture(f, REPEAT)),
                    orm: files.orm.and_then(|f| self.texture(f, REPEAT)),
                }
            }
            scene::Image::Picture(index) => Drawn {
                image,
                metres: 1.0,
                color: self.texture(images.picture(*index)?, CLAMP_TO_EDGE)?,
                normal: None,
                orm: None,
            },
        };
        self.drawn.push(made);
        Some(self.drawn.len() - 1)
    }

    fn texture(&mut self, picture: PictureBytes<'a>, wrap: u32) -> Option<TextureRef> {
        let mime = mime(picture.bytes)?;
        let sampler = Sampler {
            mag_filter: LINEAR,
            min_filter: LINEAR_MIPMAP_LINEAR,
            wrap_s: wrap,
            wrap_t: wrap,
        };
        let known = self.samplers.iter().position(|s| *s == sampler);
        let number = known.unwrap_or(self.samplers.len()) as u32;
        if known.is_none() {
            self.samplers.push(sampler);
        }
        self.textures.push(Texture {
            sampler: number,
            source: self.images.len() as u32,
        });
        self.images.push(Picture {
            name: self.free_name(picture.name),
            bytes: picture.bytes,
            mime,
        });
        Some(TextureRef {
            index: self.textures.len() as u32 - 1,
        })
    }

    /// Two pictures of one name (from two folders) must not overwrite each other.
    fn free_name(&self, name: Cow<'a, str>) -> Cow<'a, str> {
        let taken = |n: &str| self.images.iter().any(|i| i.name.eq_ignore_ascii_case(n));
        let numbered = |k: usize| format!("{k}_{name}");
        if !taken(&name) {
            return name;
        }
        let free = (2..).map(numbered).find(|n| !taken(n));
        Cow::Owned(free.unwrap_or_default())
    }
}
