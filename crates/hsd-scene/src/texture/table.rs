//! All surfaces with their looks. An aged look follows the younger one.

use super::{Look, Surface};

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
        metres: 0.606,
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
    },
    Surface {
        name: "plank",
        metres: 0.606,
        gloss: [0.83, 0.0],
        looks: &[
            toned("plank_fresh", 0xD9_B48A),
            toned("plank_brown", 0x8A_6A4A),
            toned("plank_silver", 0x9C_9890),
            toned("plank_dark", 0x5F_5B55),
        ],
    },
    Surface {
        name: "keyaki",
        metres: 0.606,
        gloss: [0.55, 0.0],
        looks: &[mixed("keyaki_fresh"), mixed("keyaki_old")],
    },
    Surface {
        name: "boarding",
        metres: 0.9696,
        gloss: [0.83, 0.0],
        looks: &[
            toned("boarding_fresh", 0xCE_AA82),
            toned("boarding_brown", 0x86_6748),
            toned("boarding_silver", 0x98_948C),
            toned("boarding_dark", 0x5D_5953),
        ],
    },
    Surface {
        name: "clapboard",
        metres: 0.9696,
        gloss: [0.84, 0.0],
        looks: &[
            toned("clapboard_fresh", 0xC2_A07A),
            toned("clapboard_brown", 0x7E_6144),
            toned("clapboard_silver", 0x90_8C84),
            toned("clapboard_dark", 0x58_544E),
        ],
    },
    Surface {
        name: "charred",
        metres: 0.6667,
        gloss: [0.68, 0.0],
        looks: &[
            toned("charred", 0x1E_1C1A),
            toned("charred_worn", 0x35_2C26),
            toned("charred_old", 0x62_564A),
        ],
    },
    Surface {
        name: "bamboo",
        metres: 0.909,
        gloss: [0.46, 0.0],
        looks: &[mixed("bamboo_green"), mixed("bamboo"), mixed("bamboo_old")],
    },
    Surface {
        name: "plaster",
        metres: 1.818,
        gloss: [0.80, 0.0],
        looks: &[
            toned("plaster", 0xF2_EFE6),
            toned("plaster_worn", 0xDC_D8CE),
            toned("plaster_old", 0xC2_BAA8),
        ],
    },
    Surface {
        name: "black_plaster",
        metres: 1.818,
        gloss: [0.30, 0.0],
        looks: &[
            toned("black_plaster", 0x36_3538),
            toned("black_plaster_old", 0x4A_4947),
        ],
    },
    Surface {
        name: "clay",
        metres: 1.0,
        gloss: [0.95, 0.0],
        looks: &[toned("clay", 0xB5_9A6A), toned("clay_washed", 0xA6_9068)],
    },
    Surface {
        name: "juraku",
        metres: 0.606,
        gloss: [0.93, 0.0],
        looks: &[toned("juraku", 0xB2_9E78), toned("juraku_old", 0x98_8462)],
    },
    Surface {
        name: "mortar",
        metres: 1.0,
        gloss: [0.93, 0.0],
        looks: &[mixed("mortar"), mixed("mortar_old")],
    },
    Surface {
        name: "concrete",
        metres: 1.8,
        gloss: [0.82, 0.0],
        looks: &[mixed("concrete"), mixed("concrete_old")],
    },
    Surface {
        name: "namako",
        metres: 0.857,
        gloss: [0.63, 0.0],
        looks: &[mixed("namako"), mixed("namako_old")],
    },
    Surface {
        name: "tile",
        metres: 0.8,
        gloss: [0.38, 0.0],
        looks: &[mixed("tile"), mixed("tile_dirty"), mixed("tile_white")],
    },
    Surface {
        name: "kawara",
        metres: 2.12,
        gloss: [0.77, 0.0],
        looks: &[
            mixed("kawara_new"),
            mixed("kawara_worn"),
            mixed("kawara_old"),
        ],
    },
    Surface {
        name: "hongawara",
        metres: 1.904,
        gloss: [0.77, 0.0],
        looks: &[
            mixed("hongawara_new"),
            mixed("hongawara_worn"),
            mixed("hongawara_old"),
        ],
    },
    Surface {
        name: "noshi",
        metres: 0.84,
        gloss: [0.77, 0.0],
        looks: &[mixed("noshi_new"), mixed("noshi_worn"), mixed("noshi_old")],
    },
    Surface {
        name: "ibushi",
        metres: 0.606,
        gloss: [0.77, 0.0],
        looks: &[
            toned("ibushi_new", 0x65_6A70),
            toned("ibushi_worn", 0x56_5B60),
            toned("ibushi_old", 0x52_524A),
        ],
    },
    Surface {
        name: "board_roof",
        metres: 1.818,
        gloss: [0.90, 0.0],
        looks: &[
            mixed("board_roof_new"),
            mixed("board_roof_silver"),
            mixed("board_roof_mossy"),
        ],
    },
    Surface {
        name: "kokera",
        metres: 0.909,
        gloss: [0.90, 0.0],
        looks: &[
            mixed("kokera_new"),
            mixed("kokera_silver"),
            mixed("kokera_mossy"),
        ],
    },
    Surface {
        name: "bark",
        metres: 0.75,
        gloss: [0.94, 0.0],
        looks: &[mixed("bark_new"), mixed("bark_worn"), mixed("bark_mossy")],
    },
    Surface {
        name: "thatch",
        metres: 1.0,
        gloss: [0.95, 0.0],
        looks: &[
            mixed("thatch_new"),
            mixed("thatch_worn"),
            mixed("thatch_mossy"),
        ],
    },
    Surface {
        name: "seam_roof",
        metres: 0.909,
        gloss: [0.48, 0.0],
        looks: &[mixed("seam_roof"), mixed("seam_roof_rusty")],
    },
    Surface {
        name: "paper",
        metres: 0.606,
        gloss: [0.88, 0.0],
        looks: &[toned("paper", 0xF3_EDDD), toned("paper_yellow", 0xDC_C79C)],
    },
    Surface {
        name: "cloth",
        metres: 0.16,
        gloss: [0.92, 0.0],
        looks: &[
            toned("indigo", 0x26_3453),
            toned("indigo_faded", 0x62_7492),
            toned("persimmon", 0x8C_4B30),
            toned("persimmon_faded", 0xB0_8266),
            toned("cotton", 0xE6_DFCD),
            toned("cotton_old", 0xC4_B99F),
        ],
    },
    Surface {
        name: "tatami",
        metres: 0.909,
        gloss: [0.71, 0.0],
        looks: &[mixed("tatami"), mixed("tatami_old")],
    },
    Surface {
        name: "aluminium",
        metres: 1.0,
        gloss: [0.36, 1.0],
        looks: &[
            mixed("aluminium"),
            mixed("bronze_aluminium"),
            mixed("aluminium_dirty"),
        ],
    },
    Surface {
        name: "glass",
        metres: 2.0,
        gloss: [0.07, 0.0],
        looks: &[mixed("glass"), mixed("glass_mirror"), mixed("glass_dusty")],
    },
    Surface {
        name: "steel",
        metres: 0.9,
        gloss: [0.45, 0.0],
        looks: &[mixed("steel"), mixed("steel_rusty")],
    },
    Surface {
        name: "sheet",
        metres: 0.909,
        gloss: [0.42, 0.0],
        looks: &[mixed("sheet"), mixed("sheet_rusty")],
    },
    Surface {
        name: "stone",
        metres: 0.909,
        gloss: [0.73, 0.0],
        looks: &[mixed("stone"), mixed("stone_mossy")],
    },
    Surface {
        name: "gravel",
        metres: 0.909,
        gloss: [0.82, 0.0],
        looks: &[mixed("gravel")],
    },
    Surface {
        name: "earth",
        metres: 2.0,
        gloss: [0.95, 0.0],
        looks: &[mixed("earth")],
    },
    Surface {
        name: "doma",
        metres: 1.212,
        gloss: [0.75, 0.0],
        looks: &[mixed("doma"), mixed("doma_old")],
    },
    Surface {
        name: "foliage",
        metres: 0.909,
        gloss: [0.72, 0.0],
        looks: &[mixed("foliage")],
    },
    Surface {
        name: "rows",
        metres: 1.818,
        gloss: [0.70, 0.0],
        looks: &[mixed("rows")],
    },
    Surface {
        name: "water",
        metres: 3.636,
        gloss: [0.12, 0.0],
        looks: &[mixed("water")],
    },
];
