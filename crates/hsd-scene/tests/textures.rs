//! The textures of the materials: sizes, colours, gloss and names.

use hsd_ir::material::{self, MATERIALS, SurfaceId};
use hsd_scene::texture::{COLOR_SIZE, ORM_SIZE, SURFACES, Surface, embedded, look};
use image::RgbImage;

/// The files of a surface and their size in pixels.
fn files(surface: &Surface) -> Vec<(String, u32)> {
    let colors = surface
        .looks
        .iter()
        .map(|look| (look.color_file(), COLOR_SIZE));
    let shared = [
        (surface.normal_file(), COLOR_SIZE),
        (surface.orm_file(), ORM_SIZE),
    ];
    colors.chain(shared).collect()
}

/// A committed file as a picture.
fn committed(file: &str) -> RgbImage {
    let bytes = embedded(file).unwrap_or_else(|| panic!("{file} is not embedded"));
    let picture = image::load_from_memory(bytes).expect("an embedded file is a picture");
    picture.to_rgb8()
}

/// Mean of each channel, 0 to 255.
fn mean(picture: &RgbImage) -> [f64; 3] {
    let count = f64::from(picture.width() * picture.height());
    [0, 1, 2].map(|c| {
        let sum: u64 = picture.pixels().map(|p| u64::from(p.0[c])).sum();
        sum as f64 / count
    })
}

/// Whether every channel is as near as that to a web colour.
fn is_near(color: [f64; 3], number: u32, tolerance: f64) -> bool {
    let [_, want @ ..] = number.to_be_bytes();
    (0..3).all(|c| (color[c] - f64::from(want[c])).abs() <= tolerance)
}

#[test]
fn files_decode_to_their_size() {
    for (file, size) in SURFACES.iter().flat_map(files) {
        assert_eq!(committed(&file).dimensions(), (size, size), "{file}");
    }
}

#[test]
fn textures_stay_small() {
    let files = SURFACES.iter().flat_map(files);
    let total: usize = files
        .filter_map(|(file, _)| embedded(&file))
        .map(<[u8]>::len)
        .sum();
    assert!(total < 10_000_000, "textures/ holds {total} bytes");
}

#[test]
fn looks_have_the_colours_they_are_known_by() {
    for look in SURFACES.iter().flat_map(|surface| surface.looks) {
        let Some(number) = look.mean else { continue };
        let mean = mean(&committed(&look.color_file()));
        assert!(
            is_near(mean, number, 4.0),
            "{}: {mean:?}, not {number:06x}",
            look.name
        );
    }
}

#[test]
fn weathering_has_the_colours_of_the_evidence() {
    // docs/evidence.md 4.9; where joints and shadows darken a picture, its face is told by the brighter half.
    let known = [
        ("cedar_fresh", 0xD9_B48A),
        ("cedar_brown", 0x8A_6A4A),
        ("cedar_silver", 0x9C_9890),
        ("cedar_dark", 0x5F_5B55),
        ("bengara", 0x5A_2E22),
        ("charred", 0x1E_1C1A),
        ("plaster", 0xF2_EFE6),
        ("clay", 0xB5_9A6A),
        ("ibushi_worn", 0x56_5B60),
    ];
    for (name, number) in known {
        let mean = mean(&committed(&format!("{name}_color.jpg")));
        assert!(
            is_near(mean, number, 4.0),
            "{name}: {mean:?}, not {number:06x}"
        );
    }
    for (name, number) in [("kawara_worn", 0x56_5B60), ("namako", 0x56_5B60)] {
        let picture = committed(&format!("{name}_color.jpg"));
        let mut middle: Vec<[u8; 3]> = picture.pixels().map(|p| p.0).collect();
        middle.sort_unstable_by_key(|p| p.map(u32::from).iter().sum::<u32>());
        let face = middle[middle.len() / 2].map(f64::from);
        assert!(
            is_near(face, number, 16.0),
            "{name}: {face:?}, not {number:06x}"
        );
    }
}

#[test]
fn looks_of_one_surface_can_be_told_apart() {
    for surface in SURFACES {
        let means = surface
            .looks
            .iter()
            .map(|l| mean(&committed(&l.color_file())));
        let means: Vec<[f64; 3]> = means.collect();
        for (k, one) in means.iter().enumerate() {
            for (other, look) in means[..k].iter().zip(surface.looks) {
                let far = (0..3).map(|c| (one[c] - other[c]).abs()).sum::<f64>();
                assert!(far > 8.0, "{} and {}", surface.looks[k].name, look.name);
            }
        }
    }
}

#[test]
fn materials_without_a_gloss_map_have_its_mean() {
    for surface in SURFACES {
        let [_, roughness, metal] = mean(&committed(&surface.orm_file()));
        for (mean, said) in [roughness, metal].into_iter().zip(surface.gloss) {
            let far = (mean / 255.0 - f64::from(said)).abs();
            assert!(far < 0.006, "{}: {mean} of 255, {said}", surface.name);
        }
    }
}

#[test]
fn surfaces_are_neither_mirrors_nor_half_metal() {
    for surface in SURFACES {
        let orm = committed(&surface.orm_file());
        let metal = orm.get_pixel(0, 0).0[2];
        assert!(metal == 0 || metal == 255, "{}: {metal}", surface.name);
        for pixel in orm.pixels() {
            assert!(
                pixel.0[1] >= 12,
                "{}: roughness {}",
                surface.name,
                pixel.0[1]
            );
            assert_eq!(pixel.0[2], metal, "{}", surface.name);
        }
        let metres = surface.metres;
        assert!(
            (0.1..=3.7).contains(&metres),
            "{}: {metres} m",
            surface.name
        );
    }
}

#[test]
fn materials_age_from_look_to_look() {
    let mut shown: Vec<&str> = vec![];
    for material in MATERIALS {
        let first = &material.stages[0];
        assert_eq!((first.years, material.after(0.0)), (0.0, first));
        for pair in material.stages.windows(2) {
            assert!(pair[0].years < pair[1].years, "{}", pair[1].look);
            assert_eq!(material.after(pair[1].years), &pair[1]);
            assert_eq!(material.after(pair[1].years - 0.1), &pair[0]);
        }
        for stage in material.stages {
            assert!(look(stage.look).is_some(), "{}", stage.look);
            assert!(SurfaceId::find(stage.look).is_some(), "{}", stage.look);
            assert!((0.1..=1.0).contains(&stage.gloss), "{}", stage.look);
            shown.push(stage.look);
        }
    }
    for look in SURFACES.iter().flat_map(|surface| surface.looks) {
        assert!(
            shown.contains(&look.name),
            "{} belongs to no material",
            look.name
        );
    }
    for surface in material::all() {
        let worn = surface
            .material
            .map(|m| m.stages.iter().any(|s| Some(s.look) == surface.picture));
        assert_ne!(worn, Some(false), "{}", surface.name);
        assert!(
            surface.tint.iter().all(|c| (0.0..=1.0).contains(c)),
            "{}",
            surface.name
        );
    }
    let codes = "WD WB WY PL CL TI PA CT AL GL ST MO -";
    assert!(
        MATERIALS
            .iter()
            .all(|m| codes.split(' ').any(|code| code == m.class.code()))
    );
}

#[test]
fn names_are_unique_and_found() {
    for (k, one) in SURFACES.iter().enumerate() {
        assert!(
            SURFACES[..k].iter().all(|other| other.name != one.name),
            "{}",
            one.name
        );
        for mine in one.looks {
            let found = look(mine.name).map(|(surface, look)| (surface.name, look));
            assert_eq!(found, Some((one.name, mine)));
        }
    }
    assert!(look("marzipan").is_none());
    assert!(embedded("marzipan_color.jpg").is_none());
}

/// The blackest plaster reflects as much as soot does, 3 percent of the light: less, and walls look like holes.
#[test]
fn black_plaster_is_no_hole() {
    let linear = |channel: f64| ((channel / 255.0 + 0.055) / 1.055).powf(2.4);
    let mean = mean(&committed("black_plaster_color.jpg"));
    let light = mean.map(linear).iter().sum::<f64>() / 3.0;
    assert!((0.03..0.06).contains(&light), "{light}");
}
