//! The material file of an OBJ (000-37 to 000-40).

use crate::backend::number::Number;
use crate::backend::{Images, OutFile, PictureBytes, one_word};
use crate::scene::{Image, Material, Scene};
use std::fmt::Write as _;

/// Ratio of ambient to diffuse colour, as in the sample of 000-39 (Ka 0.5, Kd 0.8).
const SHADE: f64 = 0.5 / 0.8;

/// Returns the text, and the images to which it refers in `folder`.
pub(super) fn mtl<'a>(
    scene: &Scene,
    used: &[bool],
    images: &'a dyn Images,
    folder: &str,
) -> (String, Vec<OutFile<'a>>) {
    let mut out = format!("# hsd {}\n", env!("CARGO_PKG_VERSION"));
    let mut files = vec![];
    for (material, _) in scene.materials.iter().zip(used).filter(|(_, used)| **used) {
        let mirrored = mirrored(material, images);
        plain(&mut out, material, mirrored.is_some());
        if let Some(picture) = &mirrored {
            let name = file(&mut files, picture, folder);
            let _ = writeln!(out, "map_Ke {name}");
        }
        let picture = match &material.image {
            _ if mirrored.is_some() => None,
            Image::None => None,
            Image::Surface(name) => images.files(name).map(|f| f.color),
            Image::Picture(index) => images.picture(*index),
            Image::Baked(index) => images.baked(*index).map(|f| f.color),
        };
        if let Some(picture) = picture {
            let name = file(&mut files, &picture, folder);
            let _ = writeln!(out, "map_Kd {name}");
            if material.cutout {
                let _ = writeln!(out, "map_d {name}");
            }
        }
    }
    (out, files)
}

/// Returns the reflection of a material. There is one set of texture coordinates, so a material with a texture of its
/// own keeps it.
pub(super) fn mirrored<'a>(m: &Material, images: &'a dyn Images) -> Option<PictureBytes<'a>> {
    let own = matches!(m.image, Image::Picture(_));
    images.mirrored(m.mirrored.filter(|_| !own)?)
}

fn plain(out: &mut String, m: &Material, mirrors: bool) {
    let (tint, light) = match mirrors {
        true => m.under_mirror(),
        false => (m.tint, 0.0),
    };
    let [r, g, b, opacity] = tint.map(|x| f64::from(x).clamp(0.0, 1.0));
    let color = [r, g, b].map(display);
    let shine = 0.5 * (1.0 - f64::from(m.roughness).clamp(0.0, 1.0));
    let _ = writeln!(out, "\nnewmtl {}", one_word(&m.name));
    for (key, values) in [
        ("Ka", color.map(|x| x * SHADE)),
        ("Kd", color),
        ("Ks", [shine; 3]),
    ] {
        // Three decimals tell more shades than a screen shows.
        let [r, g, b] = values.map(|x| Number((x * 1000.0).round() / 1000.0));
        let _ = writeln!(out, "{key} {r} {g} {b}");
    }
    let _ = writeln!(out, "d {}", Number(opacity));
    if mirrors {
        let light = Number((f64::from(light) * 1000.0).round() / 1000.0);
        let _ = writeln!(out, "Ke {light} {light} {light}");
    }
}

/// Encodes a linear value as sRGB: MTL predates linear workflows.
fn display(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}

/// Returns the path of an image and adds it to the files if it is new; another image of the same name gets a number.
fn file<'a>(files: &mut Vec<OutFile<'a>>, picture: &PictureBytes<'a>, folder: &str) -> String {
    let mut k = 1;
    loop {
        let number = if k == 1 {
            String::new()
        } else {
            format!("{k}_")
        };
        let name = format!("{folder}/{number}{}", one_word(&picture.name));
        match files.iter().find(|f| f.name.eq_ignore_ascii_case(&name)) {
            Some(same) if *same.bytes == *picture.bytes => return same.name.clone(),
            Some(_) => k += 1,
            None => {
                files.push(OutFile {
                    name: name.clone(),
                    bytes: picture.bytes.into(),
                });
                return name;
            }
        }
    }
}
