//! Looks: what a material shows, before the scene numbers its materials.

use hsd_ir::material::{self, SurfaceId, dimmed};
use hsd_scene::texture::{self, palette};
use hsd_scene::{Detail, Image, Material};
use std::sync::{LazyLock, OnceLock};

/// Share of reflected light in thousandths; zero for surfaces that do not reflect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Share(pub(crate) u16);

impl Share {
    /// Converts a share between 0 and 1.
    pub(crate) fn new(share: f64) -> Share {
        Share((share.clamp(0.0, 1.0) * 1000.0).round() as u16)
    }

    fn value(self) -> f32 {
        f32::from(self.0) / 1000.0
    }
}

/// The surface or image of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Look {
    /// A surface, and the light that it reflects.
    Surface(SurfaceId, Share),
    /// A part texture by its number in the run, and the light that it reflects.
    Picture(u32, Share),
    /// Glass in another mean colour: its own colour times these factors, which are [`TONES`] for 1.
    Toned(SurfaceId, [u8; 3]),
    /// Plain colours, each at its place in the picture of all.
    Colours,
}

/// A look, and for one of [`Look::Colours`] the place of its colour: that of all corners in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown {
    pub(crate) look: Look,
    pub(crate) place: Option<[f32; 2]>,
}

impl Shown {
    /// Returns that of a look with places of its own.
    pub(crate) fn of(look: Look) -> Shown {
        Shown { look, place: None }
    }
}

/// The number that stands for a factor of 1. It is small, so that panes of nearly the same colour share a material.
const TONES: f32 = 32.0;

impl Look {
    /// Returns the look of a surface; surfaces other than glass have one for every share of reflection.
    pub(crate) fn surface(id: SurfaceId, share: Share) -> Look {
        match id.surface().glass {
            true => Look::Surface(id, share),
            false => Look::Surface(id, Share::default()),
        }
    }

    /// Returns the look of a surface in a mean colour, linear RGB, as far as its own can be darkened or lightened to that.
    pub(crate) fn toned(id: SurfaceId, mean: [f32; 3]) -> Look {
        let own = colour_of(id);
        let tint = shown_tint(id, Detail::Body);
        let tones = std::array::from_fn(|k| {
            // No factor of a material exceeds 1.
            let most = 1.0 / tint[k].max(0.01);
            (TONES * (mean[k] / own[k].max(1e-3)).min(most)).round() as u8
        });
        match tones == [TONES as u8; 3] {
            true => Look::surface(id, Share::default()),
            false => Look::Toned(id, tones),
        }
    }

    /// Returns three numbers that no other look has.
    pub(super) fn numbers(self) -> [u32; 3] {
        match self {
            Look::Surface(id, share) => [0, id.index() as u32, share.0.into()],
            Look::Picture(number, share) => [1, number, share.0.into()],
            Look::Toned(id, [r, g, b]) => [2, id.index() as u32, u32::from_be_bytes([0, r, g, b])],
            Look::Colours => [3, 0, 0],
        }
    }

    /// Returns its material.
    pub(crate) fn material(self, detail: Detail) -> Material {
        match self {
            Look::Surface(id, share) => of_surface(id, share, detail),
            Look::Picture(number, share) => of_picture(number, share),
            Look::Toned(id, tones) => of_toned(id, tones, detail),
            Look::Colours => of_colours(),
        }
    }
}

/// Returns the mean colour that a surface shows from afar, linear RGB.
pub(crate) fn colour_of(id: SurfaceId) -> [f32; 3] {
    type Known = OnceLock<[f32; 3]>;
    static ALL: LazyLock<Vec<Known>> =
        LazyLock::new(|| (0..material::count()).map(|_| Known::new()).collect());
    *ALL[id.index()].get_or_init(|| {
        let tint = shown_tint(id, Detail::Body);
        let texture = id.surface().picture.map_or([1.0; 3], texture::mean);
        std::array::from_fn(|k| tint[k] * texture[k])
    })
}

/// Returns the tint of a surface at a detail.
fn shown_tint(id: SurfaceId, detail: Detail) -> [f32; 4] {
    let surface = id.surface();
    match surface.glass && detail <= Detail::Flat {
        true => shut(surface.tint),
        false => surface.tint,
    }
}

fn of_toned(id: SurfaceId, tones: [u8; 3], detail: Detail) -> Material {
    let own = of_surface(id, Share::default(), detail);
    let [r, g, b] = tones.map(|tone| f32::from(tone) / TONES);
    let [red, green, blue, opacity] = own.tint;
    let [x, y, z] = tones;
    Material {
        name: format!("{}, tone {x} {y} {z}", own.name),
        tint: [
            (red * r).min(1.0),
            (green * g).min(1.0),
            (blue * b).min(1.0),
            opacity,
        ],
        ..own
    }
}

fn of_colours() -> Material {
    let [roughness, metallic] = palette::GLOSS;
    Material {
        name: palette::COLOURS.to_owned(),
        image: Image::Surface(palette::COLOURS),
        tint: [1.0; 4],
        roughness,
        metallic,
        double_sided: false,
        cutout: false,
        reflection: None,
        mirrored: None,
    }
}

fn of_surface(id: SurfaceId, share: Share, detail: Detail) -> Material {
    let surface = id.surface();
    Material {
        name: match share.0 {
            0 => surface.name.to_owned(),
            per_mille => format!("{} {}.{}%", surface.name, per_mille / 10, per_mille % 10),
        },
        image: surface.picture.map_or(Image::None, Image::Surface),
        tint: shown_tint(id, detail),
        roughness: surface.roughness,
        metallic: surface.metallic,
        double_sided: surface.thin,
        cutout: false,
        reflection: surface.glass.then(|| share.value()),
        mirrored: None,
    }
}

fn of_picture(number: u32, share: Share) -> Material {
    Material {
        name: match share.0 {
            0 => format!("picture {}", number + 1),
            n => format!("picture {} {}.{}%", number + 1, n / 10, n % 10),
        },
        image: Image::Picture(number),
        tint: [1.0; 4],
        roughness: if share.0 == 0 { 0.8 } else { 0.3 },
        metallic: 0.0,
        double_sided: false,
        cutout: false,
        reflection: (share.0 > 0).then(|| share.value()),
        mirrored: None,
    }
}

/// Returns the material of a page of baked images in a shade.
pub(crate) fn of_page(page: u32, holes: bool, shade: usize) -> Material {
    let light = dimmed(shade);
    Material {
        name: match shade {
            0 => format!("joinery {}", page + 1),
            shade => format!("joinery {}, shade {}", page + 1, shade + 1),
        },
        image: Image::Baked(page),
        tint: [light, light, light, 1.0],
        roughness: 1.0,
        metallic: 1.0,
        double_sided: false,
        cutout: holes,
        reflection: None,
        mirrored: None,
    }
}

/// Returns the colour of glass in front of a dark room, for details without interiors: it is opaque.
fn shut([r, g, b, opacity]: [f32; 4]) -> [f32; 4] {
    const DUSK: f32 = 0.035;
    let [r, g, b] = [r, g, b].map(|c| c * opacity + DUSK * (1.0 - opacity));
    [r, g, b, 1.0]
}
