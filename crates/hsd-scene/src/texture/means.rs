//! The mean colours of the pictures in `textures/`, as they look from afar: of their light, not of their numbers, so that dark joints
//! count for what they take away.

use super::linear;

/// Looks by name, with the mean of their light as a hexadecimal sRGB number.
static MEANS: &[(&str, u32)] = &[
    ("aluminium", 0xBF_C0C2),
    ("aluminium_dirty", 0xA5_A6A4),
    ("bamboo", 0xA9_9562),
    ("bamboo_green", 0x75_834A),
    ("bamboo_old", 0x79_6F5C),
    ("bark_mossy", 0x58_554C),
    ("bark_new", 0x6D_4F3A),
    ("bark_worn", 0x5D_5044),
    ("bengara", 0x5A_2E22),
    ("bengara_old", 0x81_6B5B),
    ("bengara_worn", 0x6F_4B39),
    ("black_plaster", 0x36_3638),
    ("black_plaster_old", 0x4B_4A47),
    ("board_roof_mossy", 0x56_534C),
    ("board_roof_new", 0xBD_9B75),
    ("board_roof_silver", 0x94_8E86),
    ("boarding_brown", 0x88_6949),
    ("boarding_dark", 0x5F_5B55),
    ("boarding_fresh", 0xD1_AD84),
    ("boarding_silver", 0x9A_968F),
    ("bronze_aluminium", 0x6B_5B4B),
    ("cedar_brown", 0x8B_6B4B),
    ("cedar_dark", 0x60_5C56),
    ("cedar_fresh", 0xDA_B58B),
    ("cedar_silver", 0x9D_9991),
    ("charred", 0x21_201D),
    ("charred_old", 0x68_5B4E),
    ("charred_worn", 0x40_332B),
    ("clapboard_brown", 0x82_6447),
    ("clapboard_dark", 0x5B_5751),
    ("clapboard_fresh", 0xC7_A57E),
    ("clapboard_silver", 0x95_9089),
    ("clay", 0xB5_9A6A),
    ("clay_washed", 0xA6_9169),
    ("concrete", 0xA3_A29E),
    ("concrete_old", 0x91_908C),
    ("cotton", 0xE6_DFCD),
    ("cotton_old", 0xC4_B89F),
    ("doma", 0xA2_9279),
    ("doma_old", 0x6E_6352),
    ("earth", 0x9A_8566),
    ("foliage", 0x53_642F),
    ("glass", 0x34_424B),
    ("glass_dusty", 0x4C_5659),
    ("glass_mirror", 0x83_9CA8),
    ("gravel", 0x8C_8981),
    ("hinoki", 0xE0_C89E),
    ("hongawara_new", 0x67_6B6F),
    ("hongawara_old", 0x52_534C),
    ("hongawara_worn", 0x52_565A),
    ("ibushi_new", 0x66_6A70),
    ("ibushi_old", 0x52_524A),
    ("ibushi_worn", 0x56_5B60),
    ("indigo", 0x27_3553),
    ("indigo_faded", 0x64_7593),
    ("juraku", 0xB3_9E79),
    ("juraku_old", 0x99_8563),
    ("kawara_new", 0x69_6D72),
    ("kawara_old", 0x54_544D),
    ("kawara_worn", 0x53_575C),
    ("keyaki_fresh", 0xB6_824F),
    ("keyaki_old", 0x6E_4326),
    ("kokera_mossy", 0x51_4E48),
    ("kokera_new", 0xC4_A47E),
    ("kokera_silver", 0x8C_877F),
    ("mortar", 0xBF_B8A8),
    ("mortar_old", 0xA2_9C8E),
    ("namako", 0x8B_8C8B),
    ("namako_old", 0x7F_7E7B),
    ("noshi_new", 0x6E_7276),
    ("noshi_old", 0x59_5951),
    ("noshi_worn", 0x58_5C5F),
    ("paper", 0xF3_EDDD),
    ("paper_yellow", 0xDB_C79C),
    ("persimmon", 0x8D_4C31),
    ("persimmon_faded", 0xB0_8367),
    ("plank_brown", 0x8B_6B4B),
    ("plank_dark", 0x60_5B56),
    ("plank_fresh", 0xDA_B58B),
    ("plank_silver", 0x9D_9991),
    ("plaster", 0xF2_EFE5),
    ("plaster_old", 0xC2_BBA9),
    ("plaster_worn", 0xDC_D8CE),
    ("rows", 0x8D_8A7B),
    ("seam_roof", 0x6E_7377),
    ("seam_roof_rusty", 0x69_6866),
    ("sheet", 0xDC_D9D2),
    ("sheet_rusty", 0xCB_C8BE),
    ("sooted", 0x3F_3129),
    ("steel", 0xA3_A9A5),
    ("steel_rusty", 0xA0_A29C),
    ("stone", 0x95_8F88),
    ("stone_mossy", 0x6C_6960),
    ("tatami", 0x91_9363),
    ("tatami_old", 0xAF_9B6A),
    ("thatch_mossy", 0x6F_6B5D),
    ("thatch_new", 0xBD_A36B),
    ("thatch_worn", 0x92_846B),
    ("tile", 0x95_6E54),
    ("tile_dirty", 0x8A_6449),
    ("tile_white", 0xD2_CEC7),
    ("water", 0x38_4840),
];

/// Returns the mean colour of a look, linear RGB; white if there is none of that name.
pub fn mean(look: &str) -> [f32; 3] {
    let found = MEANS.binary_search_by_key(&look, |(name, _)| name);
    linear(found.map_or(0xFF_FFFF, |n| MEANS[n].1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{SURFACES, embedded, samples};

    #[test]
    fn means_are_those_of_the_pictures() {
        assert!(MEANS.is_sorted());
        let looks = SURFACES.iter().flat_map(|surface| surface.looks);
        assert_eq!(looks.clone().count(), MEANS.len());
        for look in looks {
            let file = embedded(&look.color_file()).expect("a texture");
            let picture = image::load_from_memory(file)
                .expect("a picture")
                .into_rgb8();
            let count = picture.pixels().len() as f32;
            let known = mean(look.name);
            for (k, own) in known.into_iter().enumerate() {
                let light = picture.pixels().map(|p| samples::linear(p.0[k]));
                let light = light.map(f64::from).sum::<f64>() as f32 / count;
                let [more, less] = [1, -1].map(|by| {
                    let number = i32::from(samples::encoded(own)) + by;
                    samples::linear(number.clamp(0, 255) as u8)
                });
                assert!(
                    (less..=more).contains(&light),
                    "{}, channel {k}: {light}",
                    look.name
                );
            }
        }
    }
}
