//! Weathered variants of the surfaces of the table (docs/evidence.md 4.9).
//!
//! The number of looks is small: a material is at one of its stages, in one of a few shades. A street of old houses
//! therefore shares its materials, and parts whose surfaces weather to the same variant share their meshes.

use super::table::{SHELTERED, TABLE};
use super::{COUNT, Class, MATERIALS, Material, Surface, SurfaceId};
use std::sync::LazyLock;

/// Number of shades of a look; each is slightly darker than the one before.
const SHADES: usize = 5;

/// Share of brightness lost per shade.
const SHADE: f32 = 0.075;

/// The largest number of stages of a material.
const STAGES: usize = 4;

/// Years under a roof after which bare wood is a shade darker (it approaches its darkest by `1 - exp(-t / 20)`).
const DARKER: [f64; 3] = [6.0, 16.0, 36.0];

/// Years after which bare wood is brown regardless of exposure.
const BROWN: f64 = 3.0;

/// The random variation between objects of one age: 0, 1 or 2, drawn for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Luck(pub u8);

impl Luck {
    /// Number of variations.
    pub const COUNT: u8 = 3;

    fn share(self) -> f64 {
        (f64::from(self.0) + 0.5) / f64::from(Luck::COUNT)
    }
}

/// The weathering of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wear {
    /// Years since it was made.
    pub years: f64,
    /// Its share of rain and sun, 0 to 1.
    pub exposure: f64,
    /// Its random variation.
    pub luck: Luck,
}

/// How far a surface has weathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct State {
    /// The number of the material's look, from the youngest.
    pub stage: usize,
    /// The shade, from the brightest.
    pub shade: usize,
}

/// Returns the share of light that a shade leaves.
pub fn dimmed(shade: usize) -> f32 {
    1.0 - SHADE * shade.min(SHADES - 1) as f32
}

/// The weathered surfaces, and their index by surface of the table, stage and shade.
struct Worn {
    surfaces: Vec<Surface>,
    places: Vec<u16>,
}

static WORN: LazyLock<Worn> = LazyLock::new(make);

/// Returns the weathered surface of an index.
pub(super) fn surface(index: usize) -> &'static Surface {
    &WORN.surfaces[index]
}

/// Returns the number of weathered surfaces.
pub(super) fn count() -> usize {
    WORN.surfaces.len()
}

/// Returns the weathered variant of a surface of the table.
pub(super) fn after(id: SurfaceId, wear: Wear) -> SurfaceId {
    state(id, wear).map_or(id, |state| in_state(id, state))
}

/// Returns the state of a surface of the table after some weather; `None` if it does not weather.
pub(super) fn state(id: SurfaceId, wear: Wear) -> Option<State> {
    let surface = &TABLE[id.index()];
    let material = surface.material?;
    let years = match material.renewed.map(f64::from) {
        Some(cycle) if wear.years > cycle => cycle * wear.luck.share(),
        _ => wear.years,
    };
    let weathered = years * weight(material.class, wear.exposure);
    let reached = material.stages.iter().rposition(|s| s.years <= weathered);
    let brown = usize::from(browns(material) && years >= BROWN);
    let stage = reached.unwrap_or(0).max(brown).max(least(surface));
    let shade = shade(material.class, years, weathered, wear.luck);
    Some(State { stage, shade })
}

/// Returns a surface of the table in a state, or the nearest that it can be in.
pub(super) fn in_state(id: SurfaceId, state: State) -> SurfaceId {
    let surface = &TABLE[id.index()];
    let Some(material) = surface.material else {
        return id;
    };
    let stage = state.stage.max(least(surface));
    let stage = stage.min(material.stages.len() - 1);
    let place = (id.index() * STAGES + stage) * SHADES + state.shade.min(SHADES - 1);
    SurfaceId(WORN.places[place])
}

/// Returns true if it turns brown by itself before the rain turns it silver.
fn browns(material: &Material) -> bool {
    let second = material.stages.get(1);
    material.class == Class::Wood && second.is_some_and(|s| s.years < BROWN)
}

/// Returns the share of the years that count for a class at an exposure: dirt settles under roofs too.
fn weight(class: Class, exposure: f64) -> f64 {
    let indoors = match class {
        Class::Wood | Class::Charred | Class::Clay => 0.0,
        Class::Stained | Class::Ground => 0.1,
        Class::Plaster | Class::Steel | Class::Mortar => 0.2,
        Class::Tile | Class::Aluminium | Class::Glass => 0.4,
        Class::Paper | Class::Cloth => 1.0,
    };
    indoors + (1.0 - indoors) * exposure
}

/// Returns the earliest stage of a surface: one named after a later look is never younger; others are named after the
/// look of a maintained house.
fn least(surface: &Surface) -> usize {
    let stages = surface.material.map_or(&[][..], |m| m.stages);
    let named = stages.iter().position(|s| s.look == surface.name);
    named.unwrap_or(0)
}

/// Returns the shade: wood darkens under roofs, and parts vary slightly.
fn shade(class: Class, years: f64, weathered: f64, luck: Luck) -> usize {
    if years < 1.0 {
        return 0;
    }
    let sheltered = matches!(class, Class::Wood | Class::Stained) && weathered < 5.0;
    let dark = match sheltered {
        true => DARKER.iter().filter(|d| years >= **d).count(),
        false => 0,
    };
    (dark + usize::from(luck.0)).min(SHADES - 1)
}

/// Makes every surface at every stage and shade, each once.
fn make() -> Worn {
    let mut worn = Worn {
        surfaces: vec![],
        places: vec![0; COUNT * STAGES * SHADES],
    };
    for (number, base) in TABLE.iter().enumerate() {
        let Some(material) = base.material else {
            continue;
        };
        for (stage, look) in material.stages.iter().enumerate() {
            for shade in 0..SHADES {
                let dim = dimmed(shade);
                // The shades here account for the years under eaves.
                let own = match base.tint[..3] == SHELTERED {
                    true => [1.0; 3],
                    false => [base.tint[0], base.tint[1], base.tint[2]],
                };
                let [r, g, b] = own.map(|c| c * dim);
                let surface = Surface {
                    material: Some(owner(material, look.look)),
                    picture: Some(look.look),
                    tint: [r, g, b, base.tint[3]],
                    roughness: look.gloss,
                    ..base.clone()
                };
                let place = (number * STAGES + stage) * SHADES + shade;
                let alike = |s: &Surface| {
                    Surface {
                        name: "",
                        ..s.clone()
                    } == Surface {
                        name: "",
                        ..surface.clone()
                    }
                };
                let at = worn.surfaces.iter().position(alike).unwrap_or_else(|| {
                    let name = name(base, look.look, own != [1.0; 3], shade);
                    worn.surfaces.push(Surface {
                        name,
                        ..surface.clone()
                    });
                    worn.surfaces.len() - 1
                });
                worn.places[place] = (COUNT + at) as u16;
            }
        }
    }
    worn
}

/// Returns the first material that has a look, so that materials with a common look share it.
fn owner(own: &'static Material, look: &str) -> &'static Material {
    let has = |m: &&Material| m.grain == own.grain && m.stages.iter().any(|s| s.look == look);
    MATERIALS.iter().copied().find(has).unwrap_or(own)
}

/// Returns a name that identifies look, paint and shade. It is made once per run of the program and never freed.
fn name(base: &Surface, look: &str, painted: bool, shade: usize) -> &'static str {
    let mut name = look.to_owned();
    if painted {
        name = format!("{} over {name}", base.name);
    }
    format!("{name}, shade {}", shade + 1).leak()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worn(name: &str, years: f64, exposure: f64) -> &'static Surface {
        let luck = Luck(0);
        SurfaceId::named(name)
            .worn(Wear {
                years,
                exposure,
                luck,
            })
            .surface()
    }

    #[test]
    fn wood_turns_silver_in_the_weather_and_darker_under_a_roof() {
        assert_eq!(worn("cedar", 0.0, 1.0).picture, Some("cedar_fresh"));
        assert_eq!(worn("cedar", 2.0, 1.0).picture, Some("cedar_brown"));
        assert_eq!(worn("cedar", 10.0, 1.0).picture, Some("cedar_silver"));
        assert_eq!(worn("cedar", 80.0, 1.0).picture, Some("cedar_dark"));
        let (young, old) = (worn("cedar", 2.0, 0.0), worn("cedar", 80.0, 0.0));
        assert!(old.tint[0] < young.tint[0] - 0.2, "{old:?}");
        assert!(!["cedar_silver", "cedar_dark"].contains(&old.picture.expect("wood has one")));
    }

    #[test]
    fn what_is_renewed_never_looks_older_than_its_time() {
        for years in [30.0, 100.0, 700.0] {
            for luck in (0..Luck::COUNT).map(Luck) {
                let wear = Wear {
                    years,
                    exposure: 1.0,
                    luck,
                };
                let paper = SurfaceId::named("paper").worn(wear).surface();
                assert!(paper.picture.expect("paper has one").starts_with("paper"));
                let roof = SurfaceId::named("board_roof")
                    .worn(Wear { years, ..wear })
                    .surface();
                assert_ne!(roof.picture, Some("board_roof_mossy"));
            }
        }
    }

    #[test]
    fn paint_and_panes_stay_what_they_are() {
        let red = worn("vermilion", 40.0, 1.0);
        assert_eq!(
            red.tint[..3],
            SurfaceId::named("vermilion").surface().tint[..3]
        );
        assert!(worn("glass", 40.0, 1.0).glass && worn("paper", 40.0, 0.0).thin);
        assert_eq!(worn("iron", 40.0, 1.0).name, "iron");
    }

    #[test]
    fn looks_are_named_once_and_a_later_look_stays() {
        let mut names: Vec<_> = WORN.surfaces.iter().map(|s| s.name).collect();
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all);
        assert!(COUNT + all < usize::from(u16::MAX));
        assert_eq!(worn("plaster_old", 0.0, 0.0).picture, Some("plaster_old"));
    }
}
