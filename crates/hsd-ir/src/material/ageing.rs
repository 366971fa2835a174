//! Ageing of materials: the weathering classes of docs/evidence.md 4.9, and for each material its looks, the youngest
//! first, with the years in full rain and sun after which each appears.

/// A weathering class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Bare wood, bark and grass: brown, silver, dark grey.
    Wood,
    /// Wood stained with iron red or soot, which fades to bare wood.
    Stained,
    /// Charred wood, which loses its char.
    Charred,
    /// Lime plaster: grey runs, lost patches.
    Plaster,
    /// Clay: washed grooves.
    Clay,
    /// Fired tile: loses its silver sheen, grows lichen.
    Tile,
    /// Paper: yellow within two years.
    Paper,
    /// Dyed cloth: fades within five.
    Cloth,
    /// Aluminium: dirt runs under joints.
    Aluminium,
    /// Glass: dust.
    Glass,
    /// Painted steel: rust.
    Steel,
    /// Mortar and concrete: dirt and hair cracks.
    Mortar,
    /// Stone and ground, which have no class in the catalogue.
    Ground,
}

impl Class {
    /// Returns its two letters in the catalogue.
    pub const fn code(self) -> &'static str {
        match self {
            Class::Wood => "WD",
            Class::Stained => "WB",
            Class::Charred => "WY",
            Class::Plaster => "PL",
            Class::Clay => "CL",
            Class::Tile => "TI",
            Class::Paper => "PA",
            Class::Cloth => "CT",
            Class::Aluminium => "AL",
            Class::Glass => "GL",
            Class::Steel => "ST",
            Class::Mortar => "MO",
            Class::Ground => "-",
        }
    }
}

/// A look and the age at which it appears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Years in full rain and sun.
    pub years: f64,
    /// Its name in the texture library.
    pub look: &'static str,
    /// Factor on the roughness that all stages share: less than 1 on a face that still shines.
    pub gloss: f32,
}

/// A material at all its ages.
#[derive(Debug, PartialEq)]
pub struct Material {
    /// Its weathering class.
    pub class: Class,
    /// True if its texture has a grain that runs along a member.
    pub grain: bool,
    /// Its looks by age; the first begins at 0.
    pub stages: &'static [Stage],
    /// Years after which it is replaced, if it is.
    pub renewed: Option<u32>,
}

impl Material {
    /// Returns the stage at an age in years.
    pub fn after(&self, years: f64) -> &'static Stage {
        let reached = self.stages.iter().rev().find(|stage| stage.years <= years);
        reached.unwrap_or(&self.stages[0])
    }
}

const fn at(years: u32, look: &'static str) -> Stage {
    Stage {
        years: years as f64,
        look,
        gloss: 1.0,
    }
}

/// Returns a first stage that still shines.
const fn shiny(look: &'static str, gloss: f32) -> Stage {
    Stage {
        gloss,
        ..at(0, look)
    }
}

const fn grained(class: Class, stages: &'static [Stage]) -> Material {
    Material {
        class,
        grain: true,
        stages,
        renewed: None,
    }
}

const fn even(class: Class, stages: &'static [Stage]) -> Material {
    Material {
        class,
        grain: false,
        stages,
        renewed: None,
    }
}

/// Returns the material with replacement after this many years.
const fn renewed(material: Material, years: u32) -> Material {
    Material {
        renewed: Some(years),
        ..material
    }
}

macro_rules! materials {
    ($($name:ident = $kind:ident $class:ident [$($stage:expr),*] $(every $years:literal)?;)*) => {
        $(pub(super) static $name: Material = materials!(@ $kind(Class::$class, &[$($stage),*]) $(, $years)?);)*
        /// Every material.
        pub static MATERIALS: &[&Material] = &[$(&$name),*];
    };
    (@ $material:expr) => { $material };
    (@ $material:expr, $years:literal) => { renewed($material, $years) };
}

materials! {
    // Timber.
    CEDAR = grained Wood [at(0, "cedar_fresh"), at(1, "cedar_brown"), at(6, "cedar_silver"), at(30, "cedar_dark")];
    HINOKI = grained Wood [at(0, "hinoki"), at(2, "cedar_brown"), at(6, "cedar_silver"), at(30, "cedar_dark")];
    KEYAKI = grained Wood [at(0, "keyaki_fresh"), at(10, "keyaki_old")];
    SOOTED = grained Stained [at(0, "sooted"), at(20, "cedar_dark")];
    BENGARA = grained Stained [at(0, "bengara"), at(5, "bengara_worn"), at(15, "bengara_old")];
    PLANK = grained Wood [at(0, "plank_fresh"), at(1, "plank_brown"), at(6, "plank_silver"), at(30, "plank_dark")];
    BOARDING = grained Wood [
        at(0, "boarding_fresh"), at(1, "boarding_brown"), at(6, "boarding_silver"), at(30, "boarding_dark")
    ];
    CLAPBOARD = even Wood [
        at(0, "clapboard_fresh"), at(1, "clapboard_brown"), at(6, "clapboard_silver"), at(30, "clapboard_dark")
    ];
    CHARRED = grained Charred [at(0, "charred"), at(12, "charred_worn"), at(40, "charred_old")];
    BAMBOO = grained Wood [at(0, "bamboo_green"), at(1, "bamboo"), at(6, "bamboo_old")] every 12;
    // Plaster, earth, cement.
    PLASTER = even Plaster [at(0, "plaster"), at(10, "plaster_worn"), at(50, "plaster_old")];
    BLACK_PLASTER = even Plaster [shiny("black_plaster", 0.8), at(25, "black_plaster_old")];
    CLAY = even Clay [at(0, "clay"), at(15, "clay_washed")];
    JURAKU = even Clay [at(0, "juraku"), at(20, "juraku_old")];
    MORTAR = even Mortar [at(0, "mortar"), at(15, "mortar_old")];
    CONCRETE = even Mortar [at(0, "concrete"), at(20, "concrete_old")];
    // Fired.
    NAMAKO = even Tile [at(0, "namako"), at(30, "namako_old")];
    TILE = even Tile [at(0, "tile"), at(15, "tile_dirty")];
    WHITE_TILE = even Tile [at(0, "tile_white")];
    KAWARA = even Tile [shiny("kawara_new", 0.55), at(10, "kawara_worn"), at(30, "kawara_old")];
    HONGAWARA = even Tile [shiny("hongawara_new", 0.55), at(10, "hongawara_worn"), at(30, "hongawara_old")];
    NOSHI = even Tile [shiny("noshi_new", 0.55), at(10, "noshi_worn"), at(30, "noshi_old")];
    IBUSHI = even Tile [shiny("ibushi_new", 0.55), at(10, "ibushi_worn"), at(30, "ibushi_old")];
    // Other roofs.
    BOARD_ROOF = even Wood [at(0, "board_roof_new"), at(4, "board_roof_silver"), at(15, "board_roof_mossy")] every 14;
    KOKERA = even Wood [at(0, "kokera_new"), at(5, "kokera_silver"), at(20, "kokera_mossy")] every 28;
    BARK = even Wood [at(0, "bark_new"), at(8, "bark_worn"), at(25, "bark_mossy")] every 36;
    THATCH = even Wood [at(0, "thatch_new"), at(3, "thatch_worn"), at(15, "thatch_mossy")] every 28;
    SEAM_ROOF = even Steel [at(0, "seam_roof"), at(15, "seam_roof_rusty")];
    // Paper, cloth, mats.
    PAPER = even Paper [at(0, "paper"), at(2, "paper_yellow")] every 3;
    INDIGO = even Cloth [at(0, "indigo"), at(5, "indigo_faded")] every 8;
    PERSIMMON = even Cloth [at(0, "persimmon"), at(5, "persimmon_faded")] every 8;
    COTTON = even Cloth [at(0, "cotton"), at(5, "cotton_old")] every 8;
    TATAMI = even Cloth [at(0, "tatami"), at(2, "tatami_old")] every 6;
    // Metal and glass.
    ALUMINIUM = even Aluminium [at(0, "aluminium"), at(10, "aluminium_dirty")];
    BRONZE_ALUMINIUM = even Aluminium [at(0, "bronze_aluminium")];
    GLASS = even Glass [at(0, "glass"), at(3, "glass_dusty")];
    MIRROR_GLASS = even Glass [at(0, "glass_mirror")];
    STEEL = even Steel [at(0, "steel"), at(15, "steel_rusty")];
    SHEET = even Steel [at(0, "sheet"), at(15, "sheet_rusty")];
    // Ground.
    STONE = even Ground [at(0, "stone"), at(40, "stone_mossy")];
    GRAVEL = even Ground [at(0, "gravel")];
    // Plants.
    FOLIAGE = even Ground [at(0, "foliage")];
    ROWS = even Ground [at(0, "rows")];
    WATER = even Ground [at(0, "water")];
    EARTH = even Ground [at(0, "earth")];
    DOMA = even Ground [at(0, "doma"), at(20, "doma_old")];
}
