//! The surfaces of a house by name: which picture of the texture library they wear, in which colour and
//! gloss. The catalogue names them; `tessellate` turns those in use into materials of the scene.
//!
//! Tints are linear RGB. Colours of weathering classes follow domain.md 4.9, fresh or lightly worn.

use serde::{Serialize, Serializer};

/// One surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The name that `grammar/parts.xml` uses.
    pub name: &'static str,
    /// The picture of the texture library, in metres; `None` = plain colour.
    pub picture: Option<&'static str>,
    /// Multiplies the picture's colour, linear RGB and opacity.
    pub tint: [f32; 4],
    /// 0 mirror-smooth to 1 dull; multiplies the picture's.
    pub roughness: f32,
    /// 0 or 1.
    pub metallic: f32,
    /// Whether it shows from both sides: cloth and paper.
    pub thin: bool,
    /// Whether it is glass, which mirrors the neighbourhood (003-13).
    pub glass: bool,
}

/// Index of a [`Surface`] in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SurfaceId(u8);

impl SurfaceId {
    /// The surface of a name.
    pub fn find(name: &str) -> Option<SurfaceId> {
        let at = TABLE.iter().position(|s| s.name == name)?;
        Some(SurfaceId(at as u8))
    }

    /// The surface of a name that the table is known to hold; plain wood where it does not, which a test
    /// excludes.
    pub fn named(name: &str) -> SurfaceId {
        SurfaceId::find(name).unwrap_or(SurfaceId(0))
    }

    /// What it looks like.
    pub fn surface(self) -> &'static Surface {
        &TABLE[usize::from(self.0)]
    }

    /// Its place in the table.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

impl Serialize for SurfaceId {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self.surface().name)
    }
}

/// How many surfaces there are.
pub const COUNT: usize = TABLE.len();

/// Every surface in the table.
pub fn all() -> &'static [Surface] {
    &TABLE
}

/// A dull surface with a picture.
const fn drawn(name: &'static str, picture: &'static str, rgb: [f32; 3]) -> Surface {
    Surface {
        name,
        picture: Some(picture),
        tint: [rgb[0], rgb[1], rgb[2], 1.0],
        roughness: 1.0,
        metallic: 0.0,
        thin: false,
        glass: false,
    }
}

/// A plain colour.
const fn plain(name: &'static str, rgb: [f32; 3], roughness: f32) -> Surface {
    Surface {
        picture: None,
        roughness,
        ..drawn(name, "", rgb)
    }
}

/// The same, another gloss.
const fn gloss(surface: Surface, roughness: f32) -> Surface {
    Surface {
        roughness,
        ..surface
    }
}

/// The same in metal.
const fn metal(surface: Surface) -> Surface {
    Surface {
        metallic: 1.0,
        ..surface
    }
}

/// The same, seen from both sides.
const fn thin(surface: Surface) -> Surface {
    Surface {
        thin: true,
        ..surface
    }
}

const WHITE: [f32; 3] = [1.0, 1.0, 1.0];

static TABLE: [Surface; 47] = [
    // Wood. Bengara is iron red with soot in oil over cedar; hinoki is left bare and pale.
    drawn("cedar", "cedar", WHITE),
    drawn("hinoki", "cedar", [1.3, 1.22, 1.08]),
    drawn("keyaki", "cedar", [0.62, 0.45, 0.33]),
    drawn("bengara", "cedar", [0.34, 0.12, 0.09]),
    drawn("sooted", "cedar", [0.24, 0.18, 0.15]),
    drawn("boards", "cedar_board", WHITE),
    drawn("boards_dark", "cedar_board", [0.5, 0.4, 0.33]),
    drawn("clapboard", "clapboard", WHITE),
    drawn("charred", "charred", WHITE),
    drawn("bamboo", "bamboo", WHITE),
    drawn("bamboo_old", "bamboo", [0.7, 0.55, 0.38]),
    // Plaster and earth.
    drawn("plaster", "plaster", WHITE),
    gloss(drawn("black_plaster", "plaster", [0.06, 0.06, 0.06]), 0.25),
    drawn("plaster_grey", "plaster", [0.6, 0.6, 0.58]),
    drawn("clay", "clay", WHITE),
    drawn("juraku", "clay", [0.92, 0.86, 0.72]),
    drawn("earth", "earth", WHITE),
    drawn("mortar", "mortar", WHITE),
    drawn("concrete", "concrete", WHITE),
    // Baked and hewn.
    drawn("namako", "namako", WHITE),
    plain("flat_tile", [0.075, 0.082, 0.088], 0.6),
    drawn("tile", "tile", WHITE),
    drawn("stone", "stone", WHITE),
    drawn("pebbles", "stone", [0.8, 0.78, 0.74]),
    // Paper, cloth, glass.
    thin(drawn("paper", "paper", WHITE)),
    thin(drawn("paper_shade", "paper", [0.45, 0.43, 0.38])),
    thin(drawn("indigo", "cloth", [0.06, 0.09, 0.22])),
    thin(drawn("persimmon", "cloth", [0.36, 0.13, 0.05])),
    thin(drawn("cotton", "cloth", WHITE)),
    Surface {
        tint: [0.62, 0.7, 0.7, 0.35],
        roughness: 0.05,
        glass: true,
        ..drawn("glass", "glass", WHITE)
    },
    Surface {
        tint: [0.62, 0.74, 0.78, 0.9],
        roughness: 0.08,
        glass: true,
        ..drawn("glass_dark", "glass", WHITE)
    },
    // Metal.
    metal(drawn("aluminium", "aluminium", WHITE)),
    metal(drawn("bronze_aluminium", "aluminium", [0.3, 0.24, 0.19])),
    drawn("steel", "steel", WHITE),
    drawn("painted_steel", "steel", [0.3, 0.42, 0.4]),
    gloss(plain("sign", [0.72, 0.69, 0.6], 0.5), 0.5),
    plain("iron", [0.03, 0.03, 0.032], 0.6),
    // What lies in the dark behind openings.
    plain("dark", [0.012, 0.011, 0.01], 1.0),
    plain("groove", [0.05, 0.05, 0.05], 1.0),
    // Roofs.
    drawn("kawara", "kawara", WHITE),
    plain("kawara_edge", [0.09, 0.098, 0.105], 0.55),
    drawn("board_roof", "board_roof", WHITE),
    drawn("shingle", "board_roof", [0.8, 0.74, 0.68]),
    drawn("bark", "bark", WHITE),
    drawn("thatch", "thatch", WHITE),
    drawn("sheet_roof", "steel", [0.34, 0.36, 0.38]),
    drawn("soffit", "cedar_board", [0.55, 0.47, 0.4]),
];
