//! The textures of the materials, which models embed: `cargo run --release -p xtask -- textures` draws them.
//!
//! Each look has a colour map, `NAME_color.jpg`; the looks of a surface share a normal map, `NAME_normal.jpg`, and a map
//! of occlusion, roughness and metalness, `NAME_orm.png`.

/// Lists the files of surfaces and their looks.
macro_rules! embed {
    ($($surface:literal: $($look:literal)*;)*) => {
        &[$(
            $(embed!(@file concat!($look, "_color.jpg")),)*
            embed!(@file concat!($surface, "_normal.jpg")),
            embed!(@file concat!($surface, "_orm.png")),
        )*]
    };
    (@file $file:expr) => {
        ($file, include_bytes!($file))
    };
}

/// Files by name, such as `cedar_color.jpg`, and their contents: those of a surface are adjacent.
pub static FILES: &[(&str, &[u8])] = embed! {
    "cedar": "cedar_fresh" "cedar_brown" "cedar_silver" "cedar_dark" "hinoki" "sooted" "bengara" "bengara_worn" "bengara_old";
    "plank": "plank_fresh" "plank_brown" "plank_silver" "plank_dark";
    "keyaki": "keyaki_fresh" "keyaki_old";
    "boarding": "boarding_fresh" "boarding_brown" "boarding_silver" "boarding_dark";
    "clapboard": "clapboard_fresh" "clapboard_brown" "clapboard_silver" "clapboard_dark";
    "charred": "charred" "charred_worn" "charred_old";
    "bamboo": "bamboo_green" "bamboo" "bamboo_old";
    "plaster": "plaster" "plaster_worn" "plaster_old";
    "black_plaster": "black_plaster" "black_plaster_old";
    "clay": "clay" "clay_washed";
    "juraku": "juraku" "juraku_old";
    "mortar": "mortar" "mortar_old";
    "concrete": "concrete" "concrete_old";
    "namako": "namako" "namako_old";
    "tile": "tile" "tile_dirty" "tile_white";
    "kawara": "kawara_new" "kawara_worn" "kawara_old";
    "hongawara": "hongawara_new" "hongawara_worn" "hongawara_old";
    "noshi": "noshi_new" "noshi_worn" "noshi_old";
    "ibushi": "ibushi_new" "ibushi_worn" "ibushi_old";
    "board_roof": "board_roof_new" "board_roof_silver" "board_roof_mossy";
    "kokera": "kokera_new" "kokera_silver" "kokera_mossy";
    "bark": "bark_new" "bark_worn" "bark_mossy";
    "thatch": "thatch_new" "thatch_worn" "thatch_mossy";
    "seam_roof": "seam_roof" "seam_roof_rusty";
    "paper": "paper" "paper_yellow";
    "cloth": "indigo" "indigo_faded" "persimmon" "persimmon_faded" "cotton" "cotton_old";
    "tatami": "tatami" "tatami_old";
    "aluminium": "aluminium" "bronze_aluminium" "aluminium_dirty";
    "glass": "glass" "glass_mirror" "glass_dusty";
    "steel": "steel" "steel_rusty";
    "sheet": "sheet" "sheet_rusty";
    "stone": "stone" "stone_mossy";
    "gravel": "gravel";
    "foliage": "foliage";
    "rows": "rows";
    "water": "water";
    "earth": "earth";
    "doma": "doma" "doma_old";
};
