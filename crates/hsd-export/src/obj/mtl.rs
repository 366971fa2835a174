//! The material file of an OBJ (000-37 to 000-40).

use super::tinted::{self, Tint};
use crate::number::Number;
use crate::{Images, OutFile, PictureBytes, SurfaceFiles, one_word};
use hsd_scene::{Image, Material};
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write as _;

/// Ratio of ambient to diffuse colour, as in the sample of 000-39 (Ka 0.5, Kd 0.8).
const SHADE: f64 = 0.5 / 0.8;

/// Specular colour of everything, as in the same sample; readers of `Pr` take it for the 4 % that any surface reflects.
const GLOSS: f64 = 0.5;

/// Returns the text about some materials, and the images to which it refers in `folder`.
pub(super) fn mtl<'a, 'm>(
    materials: impl Iterator<Item = &'m Material>,
    images: &'a dyn Images,
    folder: &str,
) -> (String, Vec<OutFile<'a>>) {
    let mut writer = MtlWriter {
        out: format!("# hsd {}\n", env!("CARGO_PKG_VERSION")),
        files: vec![],
        folder,
        changed: HashMap::new(),
    };
    for material in materials {
        writer.material(material, images);
    }
    (writer.out, writer.files)
}

/// Returns the reflection of a material. There is one set of texture coordinates, so a material with a texture of its
/// own keeps it.
pub(super) fn mirrored<'a>(m: &Material, images: &'a dyn Images) -> Option<PictureBytes<'a>> {
    let own = matches!(m.image, Image::Picture(_));
    images.mirrored(m.mirrored.filter(|_| !own)?)
}

struct MtlWriter<'a, 'f> {
    out: String,
    files: Vec<OutFile<'a>>,
    folder: &'f str,
    /// Paths of changed images, by image and name; `None` = nothing to show.
    changed: HashMap<(Image, String), Option<String>>,
}

impl<'a> MtlWriter<'a, '_> {
    fn material(&mut self, m: &Material, images: &'a dyn Images) {
        if let Some(reflection) = mirrored(m, images) {
            let (tint, light) = m.under_mirror();
            self.plain(m, tint);
            self.color("Ke", [f64::from(light); 3]);
            return self.map("map_Ke", &reflection);
        }
        let surface = match &m.image {
            Image::None => None,
            Image::Surface(name) => images.files(name),
            Image::Picture(index) => images.picture(*index).map(|color| SurfaceFiles {
                metres: 1.0,
                color,
                normal: None,
                orm: None,
                gloss: [1.0; 2],
            }),
            Image::Baked(index) => images.baked(*index),
        };
        let Some(surface) = surface else {
            return self.plain(m, m.tint);
        };
        // The tint is in the image.
        self.plain(m, [1.0, 1.0, 1.0, m.tint[3]]);
        self.tinted(m, &surface.color);
        if let Some(orm) = &surface.orm {
            self.gloss(m, orm);
        }
        if let Some(normal) = &surface.normal {
            self.map("norm", normal);
        }
    }

    fn plain(&mut self, m: &Material, tint: [f32; 4]) {
        let [r, g, b, opacity] = tint.map(|x| f64::from(x).clamp(0.0, 1.0));
        let color = [r, g, b];
        let roughness = f64::from(m.roughness).clamp(0.0, 1.0);
        let _ = writeln!(self.out, "\nnewmtl {}", one_word(&m.name));
        self.color("Ka", color.map(|x| x * SHADE));
        self.color("Kd", color);
        self.color("Ks", [GLOSS; 3]);
        let exponent = 1000.0 * (1.0 - roughness) * (1.0 - roughness);
        let _ = writeln!(self.out, "Ns {}", Number::thousandths(exponent.max(1.0)));
        let _ = writeln!(self.out, "d {}", Number(opacity));
        let _ = writeln!(self.out, "Pr {}", Number::thousandths(roughness));
        let _ = writeln!(
            self.out,
            "Pm {}",
            Number::thousandths(f64::from(m.metallic))
        );
    }

    fn color(&mut self, key: &str, linear: [f64; 3]) {
        let [r, g, b] = linear.map(Number::thousandths);
        let _ = writeln!(self.out, "{key} {r} {g} {b}");
    }

    /// Writes the image of a material in its tint.
    fn tinted(&mut self, m: &Material, picture: &PictureBytes<'a>) {
        let tint = Tint::of(m.tint);
        let path = match tint.is_white() {
            true => self.file(&picture.name, picture.bytes.into()),
            false => self
                .changed(m, &tint.name(&picture.name), || tint.apply(picture))
                .unwrap_or_else(|| self.file(&picture.name, picture.bytes.into())),
        };
        let _ = writeln!(self.out, "map_Kd {path}");
        if m.cutout {
            let _ = writeln!(self.out, "map_d {path}");
        }
    }

    /// Writes roughness and metalness as grey images, with the factors of the material in them.
    fn gloss(&mut self, m: &Material, orm: &PictureBytes<'a>) {
        let stem = orm
            .name
            .rsplit_once('.')
            .map_or(&*orm.name, |(stem, _)| stem);
        for (key, kind, channel, factor) in [
            ("map_Pr", "roughness", 1, m.roughness),
            ("map_Pm", "metalness", 2, m.metallic),
        ] {
            let percent = (factor.clamp(0.0, 1.0) * 100.0).round() as u8;
            let name = format!("{stem}_{kind}_{percent}.png");
            let path = self.changed(m, &name, || {
                tinted::channel(orm, channel, f32::from(percent) / 100.0)
            });
            if let Some(path) = path {
                let _ = writeln!(self.out, "{key} {path}");
            }
        }
    }

    /// Returns the path of an image that is made from one of the material's images; materials of one image share it.
    fn changed(
        &mut self,
        m: &Material,
        name: &str,
        make: impl FnOnce() -> Option<Vec<u8>>,
    ) -> Option<String> {
        let key = (m.image.clone(), name.to_owned());
        if let Some(path) = self.changed.get(&key) {
            return path.clone();
        }
        let path = make().map(|bytes| self.file(name, bytes.into()));
        self.changed.insert(key, path.clone());
        path
    }

    fn map(&mut self, key: &str, picture: &PictureBytes<'a>) {
        let path = self.file(&picture.name, picture.bytes.into());
        let _ = writeln!(self.out, "{key} {path}");
    }

    /// Returns the path of an image and adds it to the files if it is new; another image of the same name gets a number.
    fn file(&mut self, name: &str, bytes: Cow<'a, [u8]>) -> String {
        let mut k = 1;
        loop {
            let number = if k == 1 {
                String::new()
            } else {
                format!("{k}_")
            };
            let name = format!("{}/{number}{}", self.folder, one_word(name));
            let same = |f: &&OutFile<'_>| f.name.eq_ignore_ascii_case(&name);
            match self.files.iter().find(same) {
                Some(same) if same.bytes == bytes => return same.name.clone(),
                Some(_) => k += 1,
                None => {
                    self.files.push(OutFile {
                        name: name.clone(),
                        bytes,
                    });
                    return name;
                }
            }
        }
    }
}
