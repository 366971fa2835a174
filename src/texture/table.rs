//! All surfaces with their looks. An aged look follows the younger one.

use super::{Look, Surface};
use crate::texture::surface::{
    bamboo, boards, cement, clay, ground, plants, plaster, roof_tiles, sheet, shingles, thatch,
    timber, wall_tiles, weave,
};

/// Returns a look with a known mean colour.
const fn toned(name: &'static str, mean: u32) -> Look {
    Look {
        name,
        mean: Some(mean),
    }
}

/// Returns a look of several colours, or of one without a documented value.
const fn mixed(name: &'static str) -> Look {
    Look { name, mean: None }
}

/// All surfaces, in a fixed order: timber, walls, tiles, other roofs, infill, later materials, ground.
pub static SURFACES: &[Surface] = &[
    Surface {
        name: "cedar",
        metres: timber::CEDAR,
        gloss: [0.75, 0.0],
        looks: &[
            toned("cedar_fresh", 0xD9_B48A),
            toned("cedar_brown", 0x8A_6A4A),
            toned("cedar_silver", 0x9C_9890),
            toned("cedar_dark", 0x5F_5B55),
            toned("hinoki", 0xE0_C89E),
            toned("sooted", 0x3E_3129),
            toned("bengara", 0x5A_2E22),
            toned("bengara_worn", 0x6E_4A38),
            toned("bengara_old", 0x80_6A5A),
        ],
        paint: timber::cedar,
    },
    Surface {
        name: "plank",
        metres: timber::PLANK,
        gloss: [0.83, 0.0],
        looks: &[
            toned("plank_fresh", 0xD9_B48A),
            toned("plank_brown", 0x8A_6A4A),
            toned("plank_silver", 0x9C_9890),
            toned("plank_dark", 0x5F_5B55),
        ],
        paint: timber::plank,
    },
    Surface {
        name: "keyaki",
        metres: timber::KEYAKI,
        gloss: [0.55, 0.0],
        looks: &[mixed("keyaki_fresh"), mixed("keyaki_old")],
        paint: timber::keyaki,
    },
    Surface {
        name: "boarding",
        metres: boards::BOARDING,
        gloss: [0.83, 0.0],
        looks: &[
            toned("boarding_fresh", 0xCE_AA82),
            toned("boarding_brown", 0x86_6748),
            toned("boarding_silver", 0x98_948C),
            toned("boarding_dark", 0x5D_5953),
        ],
        paint: boards::boarding,
    },
    Surface {
        name: "clapboard",
        metres: boards::CLAPBOARD,
        gloss: [0.84, 0.0],
        looks: &[
            toned("clapboard_fresh", 0xC2_A07A),
            toned("clapboard_brown", 0x7E_6144),
            toned("clapboard_silver", 0x90_8C84),
            toned("clapboard_dark", 0x58_544E),
        ],
        paint: boards::clapboard,
    },
    Surface {
        name: "charred",
        metres: boards::CHARRED,
        gloss: [0.68, 0.0],
        looks: &[
            toned("charred", 0x1E_1C1A),
            toned("charred_worn", 0x35_2C26),
            toned("charred_old", 0x62_564A),
        ],
        paint: boards::charred,
    },
    Surface {
        name: "bamboo",
        metres: bamboo::BAMBOO,
        gloss: [0.46, 0.0],
        looks: &[mixed("bamboo_green"), mixed("bamboo"), mixed("bamboo_old")],
        paint: bamboo::bamboo,
    },
    Surface {
        name: "plaster",
        metres: plaster::PLASTER,
        gloss: [0.80, 0.0],
        looks: &[
            toned("plaster", 0xF2_EFE6),
            toned("plaster_worn", 0xDC_D8CE),
            toned("plaster_old", 0xC2_BAA8),
        ],
        paint: plaster::plaster,
    },
    Surface {
        name: "black_plaster",
        metres: plaster::BLACK_PLASTER,
        gloss: [0.30, 0.0],
        looks: &[
            toned("black_plaster", 0x36_3538),
            toned("black_plaster_old", 0x4A_4947),
        ],
        paint: plaster::black_plaster,
    },
    Surface {
        name: "clay",
        metres: clay::CLAY,
        gloss: [0.95, 0.0],
        looks: &[toned("clay", 0xB5_9A6A), toned("clay_washed", 0xA6_9068)],
        paint: clay::clay,
    },
    Surface {
        name: "juraku",
        metres: clay::JURAKU,
        gloss: [0.93, 0.0],
        looks: &[toned("juraku", 0xB2_9E78), toned("juraku_old", 0x98_8462)],
        paint: clay::juraku,
    },
    Surface {
        name: "mortar",
        metres: cement::MORTAR,
        gloss: [0.93, 0.0],
        looks: &[mixed("mortar"), mixed("mortar_old")],
        paint: cement::mortar,
    },
    Surface {
        name: "concrete",
        metres: cement::CONCRETE,
        gloss: [0.82, 0.0],
        looks: &[mixed("concrete"), mixed("concrete_old")],
        paint: cement::concrete,
    },
    Surface {
        name: "namako",
        metres: wall_tiles::NAMAKO,
        gloss: [0.63, 0.0],
        looks: &[mixed("namako"), mixed("namako_old")],
        paint: wall_tiles::namako,
    },
    Surface {
        name: "tile",
        metres: wall_tiles::TILE,
        gloss: [0.38, 0.0],
        looks: &[mixed("tile"), mixed("tile_dirty"), mixed("tile_white")],
        paint: wall_tiles::tile,
    },
    Surface {
        name: "kawara",
        metres: roof_tiles::KAWARA,
        gloss: [0.77, 0.0],
        looks: &[
            mixed("kawara_new"),
            mixed("kawara_worn"),
            mixed("kawara_old"),
        ],
        paint: roof_tiles::kawara,
    },
    Surface {
        name: "hongawara",
        metres: roof_tiles::HONGAWARA,
        gloss: [0.77, 0.0],
        looks: &[
            mixed("hongawara_new"),
            mixed("hongawara_worn"),
            mixed("hongawara_old"),
        ],
        paint: roof_tiles::hongawara,
    },
    Surface {
        name: "noshi",
        metres: roof_tiles::NOSHI,
        gloss: [0.77, 0.0],
        looks: &[mixed("noshi_new"), mixed("noshi_worn"), mixed("noshi_old")],
        paint: roof_tiles::noshi,
    },
    Surface {
        name: "ibushi",
        metres: roof_tiles::IBUSHI,
        gloss: [0.77, 0.0],
        looks: &[
            toned("ibushi_new", 0x65_6A70),
            toned("ibushi_worn", 0x56_5B60),
            toned("ibushi_old", 0x52_524A),
        ],
        paint: roof_tiles::ibushi,
    },
    Surface {
        name: "board_roof",
        metres: shingles::BOARD_ROOF,
        gloss: [0.90, 0.0],
        looks: &[
            mixed("board_roof_new"),
            mixed("board_roof_silver"),
            mixed("board_roof_mossy"),
        ],
        paint: shingles::board_roof,
    },
    Surface {
        name: "kokera",
        metres: shingles::KOKERA,
        gloss: [0.90, 0.0],
        looks: &[
            mixed("kokera_new"),
            mixed("kokera_silver"),
            mixed("kokera_mossy"),
        ],
        paint: shingles::kokera,
    },
    Surface {
        name: "bark",
        metres: shingles::BARK,
        gloss: [0.94, 0.0],
        looks: &[mixed("bark_new"), mixed("bark_worn"), mixed("bark_mossy")],
        paint: shingles::bark,
    },
    Surface {
        name: "thatch",
        metres: thatch::THATCH,
        gloss: [0.95, 0.0],
        looks: &[
            mixed("thatch_new"),
            mixed("thatch_worn"),
            mixed("thatch_mossy"),
        ],
        paint: thatch::thatch,
    },
    Surface {
        name: "seam_roof",
        metres: sheet::SEAM_ROOF,
        gloss: [0.48, 0.0],
        looks: &[mixed("seam_roof"), mixed("seam_roof_rusty")],
        paint: sheet::seam_roof,
    },
    Surface {
        name: "paper",
        metres: weave::PAPER,
        gloss: [0.88, 0.0],
        looks: &[toned("paper", 0xF3_EDDD), toned("paper_yellow", 0xDC_C79C)],
        paint: weave::paper,
    },
    Surface {
        name: "cloth",
        metres: weave::CLOTH,
        gloss: [0.92, 0.0],
        looks: &[
            toned("indigo", 0x26_3453),
            toned("indigo_faded", 0x62_7492),
            toned("persimmon", 0x8C_4B30),
            toned("persimmon_faded", 0xB0_8266),
            toned("cotton", 0xE6_DFCD),
            toned("cotton_old", 0xC4_B99F),
        ],
        paint: weave::cloth,
    },
    Surface {
        name: "tatami",
        metres: weave::TATAMI,
        gloss: [0.71, 0.0],
        looks: &[mixed("tatami"), mixed("tatami_old")],
        paint: weave::tatami,
    },
    Surface {
        name: "aluminium",
        metres: sheet::ALUMINIUM,
        gloss: [0.36, 1.0],
        looks: &[
            mixed("aluminium"),
            mixed("bronze_aluminium"),
            mixed("aluminium_dirty"),
        ],
        paint: sheet::aluminium,
    },
    Surface {
        name: "glass",
        metres: sheet::GLASS,
        gloss: [0.07, 0.0],
        looks: &[mixed("glass"), mixed("glass_mirror"), mixed("glass_dusty")],
        paint: sheet::glass,
    },
    Surface {
        name: "steel",
        metres: sheet::STEEL,
        gloss: [0.45, 0.0],
        looks: &[mixed("steel"), mixed("steel_rusty")],
        paint: sheet::steel,
    },
    Surface {
        name: "sheet",
        metres: sheet::SHEET,
        gloss: [0.42, 0.0],
        looks: &[mixed("sheet"), mixed("sheet_rusty")],
        paint: sheet::sheet,
    },
    Surface {
        name: "stone",
        metres: ground::STONE,
        gloss: [0.73, 0.0],
        looks: &[mixed("stone"), mixed("stone_mossy")],
        paint: ground::stone,
    },
    Surface {
        name: "gravel",
        metres: ground::GRAVEL,
        gloss: [0.82, 0.0],
        looks: &[mixed("gravel")],
        paint: ground::gravel,
    },
    Surface {
        name: "earth",
        metres: ground::EARTH,
        gloss: [0.95, 0.0],
        looks: &[mixed("earth")],
        paint: ground::earth,
    },
    Surface {
        name: "doma",
        metres: ground::DOMA,
        gloss: [0.75, 0.0],
        looks: &[mixed("doma"), mixed("doma_old")],
        paint: ground::doma,
    },
    Surface {
        name: "foliage",
        metres: plants::FOLIAGE,
        gloss: [0.72, 0.0],
        looks: &[mixed("foliage")],
        paint: plants::foliage,
    },
    Surface {
        name: "rows",
        metres: plants::ROWS,
        gloss: [0.70, 0.0],
        looks: &[mixed("rows")],
        paint: plants::rows,
    },
    Surface {
        name: "water",
        metres: ground::WATER,
        gloss: [0.12, 0.0],
        looks: &[mixed("water")],
        paint: ground::water,
    },
];
