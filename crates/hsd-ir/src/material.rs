//! The surfaces of a house by name: the material of each, its age, colour and gloss. The catalogue names them;
//! `tessellate` turns those in use into materials of the scene.
//!
//! A surface named after a look (`cedar_silver`) has exactly that look; one named after a material (`cedar`) has the
//! look of a maintained house of some years. Tints are linear RGB and at most 1.

mod ageing;
mod table;
mod worn;

pub use ageing::{Class, MATERIALS, Material, Stage};
pub use worn::{Luck, State, Wear, dimmed};

use std::collections::HashMap;
use std::sync::LazyLock;
use table::TABLE;

use serde::{Serialize, Serializer};

/// One surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The name that `grammar/parts.xml` uses.
    pub name: &'static str,
    /// Its material, including how that ages; `None` = a plain colour.
    pub material: Option<&'static Material>,
    /// The look of the texture library that it shows, in metres; `None` = plain colour.
    pub picture: Option<&'static str>,
    /// Multiplies the texture's colour, linear RGB and opacity.
    pub tint: [f32; 4],
    /// 0 mirror-smooth to 1 dull; multiplies the texture's roughness.
    pub roughness: f32,
    /// 0 or 1.
    pub metallic: f32,
    /// True if it is visible from both sides, as cloth and paper are.
    pub thin: bool,
    /// True if it is glass, which reflects the surroundings (003-13).
    pub glass: bool,
}

impl Surface {
    /// Returns true if the texture has a grain that runs along a member.
    pub fn grain(&self) -> bool {
        self.material.is_some_and(|material| material.grain)
    }
}

/// Index of a [`Surface`]: one of the table or, after those, a weathered one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SurfaceId(u16);

impl SurfaceId {
    /// Returns the surface of a name.
    pub fn find(name: &str) -> Option<SurfaceId> {
        // Every wall of a town asks for some.
        static BY_NAME: LazyLock<HashMap<&str, SurfaceId>> = LazyLock::new(|| {
            let numbered = TABLE.iter().zip(0..);
            numbered.map(|(s, at)| (s.name, SurfaceId(at))).collect()
        });
        BY_NAME.get(name).copied()
    }

    /// Returns the names of all surfaces.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|s| s.name)
    }

    /// Returns the surface of a name in the table; for unknown names, which a test excludes, plain wood.
    pub fn named(name: &str) -> SurfaceId {
        SurfaceId::find(name).unwrap_or(SurfaceId(0))
    }

    /// Returns the surface with this index.
    pub fn surface(self) -> &'static Surface {
        let index = usize::from(self.0);
        match index.checked_sub(COUNT) {
            None => &TABLE[index],
            Some(worn) => worn::surface(worn),
        }
    }

    /// Returns the surface as weathered by `wear`.
    pub fn worn(self, wear: Wear) -> SurfaceId {
        match usize::from(self.0) < COUNT {
            true => worn::after(self, wear),
            false => self,
        }
    }

    /// Returns the state of the surface as weathered by `wear`; `None` if it does not weather.
    pub fn state(self, wear: Wear) -> Option<State> {
        (usize::from(self.0) < COUNT)
            .then(|| worn::state(self, wear))
            .flatten()
    }

    /// Returns the surface in a state, or the nearest that it can be in.
    pub fn in_state(self, state: State) -> SurfaceId {
        match usize::from(self.0) < COUNT {
            true => worn::in_state(self, state),
            false => self,
        }
    }

    /// Returns its index in the table.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

impl Serialize for SurfaceId {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self.surface().name)
    }
}

/// Number of surfaces in the table.
pub const COUNT: usize = TABLE.len();

/// Returns the number of all surfaces, weathered ones included; indices are below it.
pub fn count() -> usize {
    COUNT + worn::count()
}

/// Returns every surface in the table.
pub fn all() -> &'static [Surface] {
    TABLE
}
