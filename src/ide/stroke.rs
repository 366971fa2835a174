//! Strokes of the drawing tool: what an author draws on the plan, as the least change of the text. The text stays the
//! truth: a stroke is worked out from it, changes it, and is forgotten.
//!
//! This is the contract with the page. A stroke is a JSON object; `do` says what it does. Houses, storeys, rings, walls
//! and units are counted from 0 as they stand in the [`Plan`](super::plan::Plan) of the same revision. Places are
//! `[a, b]` in U in the author frame of the house; heights are in shaku; `by` counts whole units, outward where it is
//! positive (away from the interior, which lies on the right of the walk; into the court where the ring is a hole).
//!
//! ```json
//! {"do":"set-part","house":0,"storey":0,"ring":0,"wall":2,"unit":3,"part":"TKD 2"}
//! {"do":"set-part","span":[120,125],"part":"signboard"}
//! {"do":"move-wall","house":0,"storey":0,"ring":0,"wall":2,"by":-1,"storeys":"one"}
//! {"do":"break-wall","house":0,"storey":0,"ring":0,"wall":2,"from":2,"to":5,"by":2}
//! {"do":"draw-house","outline":[[0,0],[6,0],[6,8],[0,8]],"height":9.5,"house":0}
//! {"do":"add-storey","house":0,"height":8.5}
//! {"do":"add-storey","house":0,"height":8.5,"outline":[[0,0],[6,0],[6,4],[0,4]]}
//! {"do":"remove-storey","house":0,"storey":1}
//! {"do":"set-height","house":0,"storey":0,"height":9.5}
//! {"do":"remove-house","house":1}
//! ```
//!
//! | stroke | does |
//! |---|---|
//! | `set-part` | Another part in the place of a unit, which is named by its place in the plan, or by its span (bytes of the text itself). The wall keeps its length: a wider part takes the place of neighbours to its left (behind it in the walk), a narrower one is filled up with plain wall. |
//! | `move-wall` | A wall slides along its normal; the walls beside it grow or shrink. `storeys` is `"one"` (where it is left out) or `"all"`: walls of other storeys that stand right above or below move along. Walls that come to lie in one line become one. |
//! | `break-wall` | The part of a wall between `from` and `to`, units from its `from` end, is pushed out or in. |
//! | `draw-house` | A house with this outline, walked either way round. `house` names the house in whose frame the outline lies; without it, or where there is none, that of the world: a to the west and b to the north from its origin, 1 U = 10/11 m. `height` may be left out. |
//! | `add-storey` | A storey on the highest one, with its outline or the given one. `height` may be left out. |
//! | `remove-storey`, `remove-house` | What they say. |
//! | `set-height` | The height of a storey. |
//!
//! What a stroke comes to are [`Edit`]s of [`Source::text`](crate::source::Source::text), sorted, none of which touches
//! another. A stroke that cannot be made is refused in a sentence that says why and what to do instead, and changes
//! nothing.

mod refuse;

use super::Analysis;
use super::format::Edit;
use crate::diagnostic::Text;
use serde::Deserialize;

/// What an author draws. See the [module](self) for what each is in JSON.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
pub enum Stroke {
    /// Another part in the place of a unit.
    SetPart {
        /// Which unit.
        #[serde(flatten)]
        unit: UnitAt,
        /// A code, the name of an own part or of a picture.
        part: String,
    },
    /// A wall slides along its normal.
    MoveWall {
        /// Which wall.
        #[serde(flatten)]
        wall: WallAt,
        /// Units outward.
        by: i32,
        /// Which storeys move along.
        #[serde(default)]
        storeys: Storeys,
    },
    /// A part of a wall is pushed out or in.
    BreakWall {
        /// Which wall.
        #[serde(flatten)]
        wall: WallAt,
        /// Where the part begins, U from the wall's `from` end.
        from: u32,
        /// Where it ends.
        to: u32,
        /// Units outward.
        by: i32,
    },
    /// A new house.
    DrawHouse {
        /// Its corners in walk order, either way round, the first not repeated.
        outline: Vec<[f64; 2]>,
        /// The height of its storey in shaku.
        #[serde(default)]
        height: Option<f64>,
        /// In whose frame the outline lies.
        #[serde(default)]
        house: Option<usize>,
    },
    /// A storey on the highest one.
    AddStorey {
        /// Of which house.
        house: usize,
        /// Its height in shaku.
        #[serde(default)]
        height: Option<f64>,
        /// Its corners, if not those of the storey below.
        #[serde(default)]
        outline: Option<Vec<[f64; 2]>>,
    },
    /// A storey goes.
    RemoveStorey {
        /// Of which house.
        house: usize,
        /// Which one.
        storey: usize,
    },
    /// A storey becomes higher or lower.
    SetHeight {
        /// Of which house.
        house: usize,
        /// Which one.
        storey: usize,
        /// In shaku.
        height: f64,
    },
    /// A house goes.
    RemoveHouse {
        /// Which one.
        house: usize,
    },
}

/// A wall by its place in the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub struct WallAt {
    /// The house.
    pub house: usize,
    /// The storey in its list, not its number.
    pub storey: usize,
    /// The walk.
    pub ring: usize,
    /// The wall.
    pub wall: usize,
}

/// A unit by its place in the plan, or in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum UnitAt {
    /// By its place in the plan.
    Place {
        /// The wall.
        #[serde(flatten)]
        wall: WallAt,
        /// The unit.
        unit: usize,
    },
    /// By its bytes of the text.
    Span {
        /// First byte, one past the last byte.
        span: [u32; 2],
    },
}

/// Which storeys move with a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Storeys {
    /// Its own only.
    #[default]
    One,
    /// All whose wall stands right above or below it.
    All,
}

/// What a stroke comes to.
///
/// # Errors
/// Why it cannot be made, and what to do instead; the text is left alone then.
pub fn edits(_: &Analysis, stroke: &Stroke) -> Result<Vec<Edit>, Text> {
    let _ = stroke;
    Err(refuse::not_yet())
}
