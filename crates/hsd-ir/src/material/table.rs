//! The table of surfaces by name.

use super::ageing::*;
use super::{Material, Surface};

const WHITE: [f32; 3] = [1.0, 1.0, 1.0];
/// Under eaves, wood turns a darker brown instead of grey.
pub(super) const SHELTERED: [f32; 3] = [0.74, 0.72, 0.74];

/// Returns a material at one of its stages.
const fn worn(name: &'static str, material: &'static Material, stage: usize) -> Surface {
    let stage = &material.stages[stage];
    Surface {
        material: Some(material),
        picture: Some(stage.look),
        roughness: stage.gloss,
        ..plain(name, WHITE, 1.0)
    }
}

/// Returns a plain colour.
const fn plain(name: &'static str, rgb: [f32; 3], roughness: f32) -> Surface {
    Surface {
        name,
        material: None,
        picture: None,
        tint: [rgb[0], rgb[1], rgb[2], 1.0],
        roughness,
        metallic: 0.0,
        thin: false,
        glass: false,
    }
}

/// Returns a plain colour that one looks through.
const fn veil(name: &'static str, rgb: [f32; 3]) -> Surface {
    Surface {
        tint: [rgb[0], rgb[1], rgb[2], 0.3],
        thin: true,
        ..plain(name, rgb, 0.9)
    }
}

/// Returns the surface in another colour.
const fn tinted(surface: Surface, rgb: [f32; 3]) -> Surface {
    Surface {
        tint: [rgb[0], rgb[1], rgb[2], 1.0],
        ..surface
    }
}

/// Returns the surface as metal.
const fn metal(surface: Surface) -> Surface {
    Surface {
        metallic: 1.0,
        ..surface
    }
}

/// Returns the surface visible from both sides.
const fn thin(surface: Surface) -> Surface {
    Surface {
        thin: true,
        ..surface
    }
}

/// Returns the surface as a pane.
const fn pane(surface: Surface, rgb: [f32; 3], opacity: f32) -> Surface {
    Surface {
        tint: [rgb[0], rgb[1], rgb[2], opacity],
        glass: true,
        ..surface
    }
}

pub(super) static TABLE: &[Surface] = &[
    // Wood. A maintained house has brown posts; bengara is iron red with soot in oil over cedar. `boards` are
    // bodies of their own, `boarding` has its joints drawn.
    tinted(worn("cedar", &CEDAR, 1), SHELTERED),
    worn("cedar_fresh", &CEDAR, 0),
    worn("cedar_brown", &CEDAR, 1),
    worn("cedar_silver", &CEDAR, 2),
    worn("cedar_dark", &CEDAR, 3),
    worn("hinoki", &HINOKI, 0),
    worn("keyaki", &KEYAKI, 1),
    worn("keyaki_fresh", &KEYAKI, 0),
    worn("keyaki_old", &KEYAKI, 1),
    worn("bengara", &BENGARA, 0),
    worn("bengara_worn", &BENGARA, 1),
    worn("bengara_old", &BENGARA, 2),
    worn("sooted", &SOOTED, 0),
    // Red lead over cypress, its yellow ends, green window bars: gates, pagodas, shrines.
    tinted(worn("vermilion", &HINOKI, 0), [0.56, 0.085, 0.046]),
    plain("ochre", [0.72, 0.46, 0.09], 0.8),
    tinted(worn("verdigris_green", &HINOKI, 0), [0.05, 0.23, 0.16]),
    tinted(worn("boards", &PLANK, 1), SHELTERED),
    worn("boards_dark", &PLANK, 3),
    worn("plank_fresh", &PLANK, 0),
    worn("plank_brown", &PLANK, 1),
    worn("plank_silver", &PLANK, 2),
    worn("plank_dark", &PLANK, 3),
    tinted(worn("boarding", &BOARDING, 1), SHELTERED),
    worn("boarding_fresh", &BOARDING, 0),
    worn("boarding_brown", &BOARDING, 1),
    worn("boarding_silver", &BOARDING, 2),
    worn("boarding_dark", &BOARDING, 3),
    tinted(worn("clapboard", &CLAPBOARD, 1), SHELTERED),
    worn("clapboard_fresh", &CLAPBOARD, 0),
    worn("clapboard_brown", &CLAPBOARD, 1),
    worn("clapboard_silver", &CLAPBOARD, 2),
    worn("clapboard_dark", &CLAPBOARD, 3),
    worn("charred", &CHARRED, 0),
    worn("charred_worn", &CHARRED, 1),
    worn("charred_old", &CHARRED, 2),
    worn("bamboo", &BAMBOO, 1),
    worn("bamboo_green", &BAMBOO, 0),
    worn("bamboo_old", &BAMBOO, 2),
    tinted(worn("soffit", &BOARDING, 1), [0.62, 0.58, 0.54]),
    // Plaster, earth, cement.
    worn("plaster", &PLASTER, 0),
    worn("plaster_worn", &PLASTER, 1),
    worn("plaster_old", &PLASTER, 2),
    tinted(worn("plaster_grey", &PLASTER, 0), [0.6, 0.6, 0.58]),
    worn("black_plaster", &BLACK_PLASTER, 0),
    worn("black_plaster_old", &BLACK_PLASTER, 1),
    worn("clay", &CLAY, 0),
    worn("clay_washed", &CLAY, 1),
    // Greyer than raw earth: the middle coat has sand and much straw in it.
    tinted(worn("nakanuri", &CLAY, 0), [0.78, 0.86, 1.0]),
    worn("juraku", &JURAKU, 0),
    worn("juraku_old", &JURAKU, 1),
    worn("mortar", &MORTAR, 0),
    worn("mortar_old", &MORTAR, 1),
    worn("concrete", &CONCRETE, 0),
    worn("concrete_old", &CONCRETE, 1),
    // Ground.
    worn("earth", &EARTH, 0),
    worn("doma", &DOMA, 0),
    worn("doma_old", &DOMA, 1),
    worn("gravel", &GRAVEL, 0),
    worn("pebbles", &GRAVEL, 0),
    worn("sand", &MORTAR, 0),
    worn("foliage", &FOLIAGE, 0),
    tinted(worn("moss", &FOLIAGE, 0), [0.62, 0.72, 0.5]),
    tinted(worn("foliage_dark", &FOLIAGE, 0), [0.5, 0.6, 0.52]),
    tinted(worn("asphalt", &CONCRETE, 0), [0.2, 0.2, 0.21]),
    plain("road_paint", [0.75, 0.75, 0.72], 0.9),
    tinted(worn("leaves_willow", &FOLIAGE, 0), [1.0, 1.0, 0.62]),
    tinted(worn("leaves_pine", &FOLIAGE, 0), [0.42, 0.55, 0.42]),
    tinted(worn("leaves_cherry", &FOLIAGE, 0), [0.95, 0.86, 0.7]),
    tinted(worn("leaves_cedar", &FOLIAGE, 0), [0.45, 0.52, 0.38]),
    tinted(worn("leaves_plane", &FOLIAGE, 0), [0.82, 0.95, 0.6]),
    worn("rows", &ROWS, 0),
    worn("water", &WATER, 0),
    tinted(worn("paddy", &WATER, 0), [1.0, 0.93, 0.72]),
    tinted(worn("crop_rice", &ROWS, 0), [0.36, 0.56, 0.16]),
    tinted(worn("crop_ripe", &ROWS, 0), [0.83, 0.62, 0.22]),
    tinted(worn("crop_vegetables", &ROWS, 0), [0.42, 0.6, 0.26]),
    tinted(worn("grass", &FOLIAGE, 0), [0.85, 0.86, 0.55]),
    worn("stone", &STONE, 0),
    worn("stone_mossy", &STONE, 1),
    // Tiles.
    worn("namako", &NAMAKO, 0),
    worn("namako_old", &NAMAKO, 1),
    worn("flat_tile", &IBUSHI, 1),
    worn("tile", &TILE, 0),
    worn("tile_dirty", &TILE, 1),
    worn("tile_white", &WHITE_TILE, 0),
    worn("kawara", &KAWARA, 1),
    worn("kawara_new", &KAWARA, 0),
    worn("kawara_worn", &KAWARA, 1),
    worn("kawara_old", &KAWARA, 2),
    worn("kawara_edge", &IBUSHI, 1),
    worn("hongawara", &HONGAWARA, 1),
    worn("hongawara_new", &HONGAWARA, 0),
    worn("hongawara_worn", &HONGAWARA, 1),
    worn("hongawara_old", &HONGAWARA, 2),
    worn("noshi", &NOSHI, 1),
    worn("noshi_new", &NOSHI, 0),
    worn("noshi_worn", &NOSHI, 1),
    worn("noshi_old", &NOSHI, 2),
    worn("ibushi", &IBUSHI, 1),
    worn("ibushi_new", &IBUSHI, 0),
    worn("ibushi_worn", &IBUSHI, 1),
    worn("ibushi_old", &IBUSHI, 2),
    // Other roofs.
    worn("board_roof", &BOARD_ROOF, 1),
    worn("board_roof_new", &BOARD_ROOF, 0),
    worn("board_roof_silver", &BOARD_ROOF, 1),
    worn("board_roof_mossy", &BOARD_ROOF, 2),
    worn("shingle", &KOKERA, 1),
    worn("kokera", &KOKERA, 1),
    worn("kokera_new", &KOKERA, 0),
    worn("kokera_silver", &KOKERA, 1),
    worn("kokera_mossy", &KOKERA, 2),
    worn("bark", &BARK, 1),
    worn("bark_new", &BARK, 0),
    worn("bark_worn", &BARK, 1),
    worn("bark_mossy", &BARK, 2),
    worn("thatch", &THATCH, 1),
    worn("thatch_new", &THATCH, 0),
    worn("thatch_worn", &THATCH, 1),
    worn("thatch_mossy", &THATCH, 2),
    worn("sheet_roof", &SEAM_ROOF, 0),
    worn("seam_roof", &SEAM_ROOF, 0),
    worn("seam_roof_rusty", &SEAM_ROOF, 1),
    // Paper, cloth, mats.
    thin(worn("paper", &PAPER, 0)),
    thin(worn("paper_yellow", &PAPER, 1)),
    thin(tinted(worn("paper_shade", &PAPER, 0), [0.45, 0.43, 0.38])),
    thin(worn("indigo", &INDIGO, 0)),
    thin(worn("indigo_faded", &INDIGO, 1)),
    thin(worn("persimmon", &PERSIMMON, 0)),
    thin(worn("persimmon_faded", &PERSIMMON, 1)),
    thin(worn("cotton", &COTTON, 0)),
    thin(worn("cotton_old", &COTTON, 1)),
    worn("tatami", &TATAMI, 0),
    worn("tatami_old", &TATAMI, 1),
    // Glass: clear before a dark room, or with a mirror coat.
    pane(worn("glass", &GLASS, 0), [0.62, 0.7, 0.7], 0.35),
    pane(
        worn("glass_dark", &MIRROR_GLASS, 0),
        [0.42, 0.40, 0.41],
        0.92,
    ),
    pane(
        worn("glass_mirror", &MIRROR_GLASS, 0),
        [1.0, 1.0, 1.0],
        0.92,
    ),
    pane(worn("glass_dusty", &GLASS, 1), [0.8, 0.85, 0.85], 0.5),
    // Metal.
    metal(worn("aluminium", &ALUMINIUM, 0)),
    metal(worn("bronze_aluminium", &BRONZE_ALUMINIUM, 0)),
    metal(worn("aluminium_dirty", &ALUMINIUM, 1)),
    worn("steel", &STEEL, 0),
    worn("steel_rusty", &STEEL, 1),
    tinted(worn("painted_steel", &STEEL, 0), [0.36, 0.5, 0.48]),
    tinted(worn("painted_steel_rusty", &STEEL, 1), [0.45, 0.56, 0.54]),
    worn("sheet", &SHEET, 0),
    worn("sheet_rusty", &SHEET, 1),
    tinted(worn("sign", &SHEET, 0), [0.95, 0.91, 0.78]),
    tinted(worn("sign_rusty", &SHEET, 1), [0.95, 0.91, 0.78]),
    plain("iron", [0.03, 0.03, 0.032], 0.6),
    plain("sign_blue", [0.012, 0.07, 0.32], 0.5),
    plain("lamp_green", [0.02, 0.62, 0.42], 0.35),
    plain("lamp_yellow", [0.9, 0.55, 0.02], 0.35),
    plain("lamp_red", [0.8, 0.015, 0.01], 0.35),
    plain("bronze", [0.11, 0.14, 0.115], 0.55),
    // Envelopes of building law: what a road, adjacent land, a level or a border binds.
    veil("envelope_road", [0.8, 0.22, 0.1]),
    veil("envelope_side", [0.1, 0.4, 0.75]),
    veil("envelope_level", [0.75, 0.7, 0.5]),
    // Dark surfaces behind openings.
    plain("dark", [0.012, 0.011, 0.01], 1.0),
    plain("groove", [0.05, 0.05, 0.05], 1.0),
];
