//! Strokes of the plan editor: what an author draws on the plan, as the smallest change of the file. The file remains
//! the only source: a stroke is computed from it, changes it, and leaves no other state.
//!
//! This is the contract with the page. A stroke is a JSON object; `do` names its kind. Houses, storeys, rings, walls
//! and units are counted from 0 as they are in the [`Plan`](super::plan::Plan) of the same revision. Places are
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
//! {"do":"move-place","place":0,"to":[6.5,3.5]}
//! {"do":"turn-place","place":0,"to":5}
//! {"do":"draw-outline","points":[[0,0],[6.2,-0.4],[6.8,8],[0.6,8.4]],"height":9.5}
//! {"do":"move-corner","outline":0,"corner":2,"to":[6.9,8.1]}
//! {"do":"draw-wall","house":0,"storey":0,"points":[[2,3],[6,3]],"part":"TFU 2"}
//! {"do":"remove-wall","house":0,"storey":0,"ring":2}
//! {"do":"add-room","house":0,"storey":0,"at":[4.5,9.5],"name":"座敷","floor":"tatami"}
//! {"do":"set-room","house":0,"storey":0,"room":1,"floor":"boards","ceiling":"none"}
//! {"do":"remove-room","house":0,"storey":0,"room":1}
//! {"do":"add-fixture","house":0,"storey":0,"kind":"tokonoma","at":[2,7],"faces":"F"}
//! {"do":"set-fixture","house":0,"storey":0,"fixture":0,"at":[4,7],"size":[1.5,1]}
//! {"do":"remove-fixture","house":0,"storey":0,"fixture":0}
//! {"do":"accept-doubt","doubt":0}
//! {"do":"change-doubt","doubt":0,"kind":"window"}
//! {"do":"delete-doubt","doubt":0}
//! ```
//!
//! | stroke | does |
//! |---|---|
//! | `set-part` | Replaces the part of a unit, which is given by its place in the plan, or by its span (bytes of the file itself). The wall keeps its length: a wider part takes the place of neighbours to its left (behind it in the walk) that are plain or can be removed as a whole, and to its right if there are none; a narrower one is padded with plain wall. An empty part is a void. |
//! | `move-wall` | Slides a wall along its normal; the walls beside it grow or shrink. `storeys` is `"one"` (the default) or `"all"`: walls of other storeys directly above or below move along. Walls that come to lie in one line become one. |
//! | `break-wall` | Pushes the part of a wall between `from` and `to`, units from its `from` end, out or in. |
//! | `draw-house` | Adds a house with this outline, walked either way round. `house` names the house in whose frame the outline lies; without it, or if there is none, that of the world: a to the west and b to the north from its origin, 1 U = 10/11 m. `height` is optional. |
//! | `add-storey` | Adds a storey on the highest one, with its outline or the given one. `height` is optional. |
//! | `remove-storey`, `remove-house` | Removes a storey or a house. |
//! | `set-height` | Changes the height of a storey. |
//! | `move-place` | Writes `x` and `y` of a group, a placed house or a house, counted as in `places` of the plan: metres east and north in the frame of the groups around it. |
//! | `turn-place` | Writes `turn` of a group or `azimuth` of a house, degrees in the same frame. |
//! | `draw-outline` | Adds a house on an `Outline`, corners in metres east and north in the world. |
//! | `move-corner` | Writes a corner of an outline, counted as in `outlines` of the plan, metres in its frame. |
//! | `draw-wall` | Adds a wall inside the storey through these points, of one part that is repeated as often as it fits; clay wall fills the rest, and is all of it without `part`. |
//! | `remove-wall` | Removes a walk inside the storey. |
//! | `add-room` | Adds a room to the area round a point that has none. |
//! | `set-room` | Writes `name`, `at`, `floor`, `mats`, `ceiling` and `height` (shaku) of a room, those that are given; an empty name and a height of 0 remove them. |
//! | `remove-room` | Removes a room; its area stays, with boards. |
//! | `add-fixture` | Adds what is built into a room: its `kind`, its least corner `at`, `size` along a and b if it is not the usual one, and the side `faces` of its front (`F`, `B`, `L`, `R`; `F` without). |
//! | `set-fixture` | Writes those that are given. What turns keeps its width and depth, and without `at` a corner of its place or its middle, whichever fits first. |
//! | `remove-fixture` | Removes a fixture. |
//! | `accept-doubt` | Takes a wall in doubt, counted as in `doubts` of the plan, as it is: its entry goes out of its comment. |
//! | `change-doubt` | Makes it a `wall`, `slide`, `window`, `lattice` or `open` way of the same width, of parts that the house has already where it has such, and takes out the entry. `set-part` takes it out too. |
//! | `delete-doubt` | Takes it away. Inside, its walk ends before it and another one goes on behind it; outside an open way is left. |
//!
//! Roof lines stay as they are, save those that lay over the whole storey whose wall moves, edges over such a wall and pent
//! roofs along it, and those whose height was the top of a storey that rises or falls: they follow; where such a height is
//! computed, the stroke is refused. Over a bay that is broken out roofs stay as they are. Where the first corner of a
//! storey moves, `start` says so in the XML form, and lines of voids that lead there in the legacy form; the origin of
//! the house stays where it is. Walls of facades move one floor at a time, but for the first and the last one and those with
//! a width of their own (`size`, `ratio`); they do not break, since every floor of a facade stands in one plane.
//!
//! A stroke results in [`Edit`]s of [`Source::text`](hsd_base::source::Source::text), sorted, none of which touches
//! another. A stroke that is not possible is refused with a message that gives the reason and an alternative, and
//! changes nothing. `apply` makes the edits in the bytes of the file, in its encoding, and returns the edits for undo.

mod apply;
mod draft;
mod find;
mod houses;
mod legacy;
mod outline;
mod part;
mod refuse;
mod roofs;
mod slide;
mod storeys;
mod walls;
mod change;
mod write;
mod xml;
pub(crate) mod sheet;

pub(super) use storeys::fixtures::{extent, fixture_fixed};
pub(super) use storeys::rooms::room_fixed;
pub(super) use storeys::{house_fixed, storey_fixed};

pub use apply::{Applied, Patch, apply, take_back};
pub use storeys::doubts::Kind;
pub use storeys::fixtures::FixtureWords;
pub use storeys::rooms::RoomWords;

use super::Analysis;
use super::format::Edit;
use crate::stroke::sheet::Sheet;
use crate::stroke::storeys::{doubts, fixtures, inner, rooms};
use hsd_base::diagnostic::Text;
use serde::Deserialize;

/// A stroke of the author. See the [module](self) for the JSON form of each.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
pub enum Stroke {
    /// Replaces the part of a unit.
    SetPart {
        /// The unit.
        #[serde(flatten)]
        unit: UnitAt,
        /// A code, or the name of a custom part or an image.
        part: String,
    },
    /// Slides a wall along its normal.
    MoveWall {
        /// The wall.
        #[serde(flatten)]
        wall: WallAt,
        /// Distance outward in units.
        by: i32,
        /// The storeys that move along.
        #[serde(default)]
        storeys: Storeys,
    },
    /// Pushes a part of a wall out or in.
    BreakWall {
        /// The wall.
        #[serde(flatten)]
        wall: WallAt,
        /// Start of the part, U from the wall's `from` end.
        from: u32,
        /// End of the part.
        to: u32,
        /// Distance outward in units.
        by: i32,
    },
    /// Adds a house.
    DrawHouse {
        /// Its corners in walk order, either way round, the first not repeated.
        outline: Vec<[f64; 2]>,
        /// The height of its storey in shaku.
        #[serde(default)]
        height: Option<f64>,
        /// The house in whose frame the outline lies.
        #[serde(default)]
        house: Option<usize>,
    },
    /// Adds a storey on the highest one.
    AddStorey {
        /// The house.
        house: usize,
        /// Its height in shaku.
        #[serde(default)]
        height: Option<f64>,
        /// Its corners, if not those of the storey below.
        #[serde(default)]
        outline: Option<Vec<[f64; 2]>>,
    },
    /// Removes a storey.
    RemoveStorey {
        /// The house.
        house: usize,
        /// The storey.
        storey: usize,
    },
    /// Changes the height of a storey.
    SetHeight {
        /// The house.
        house: usize,
        /// The storey.
        storey: usize,
        /// The new height, shaku.
        height: f64,
    },
    /// Removes a house.
    RemoveHouse {
        /// The house.
        house: usize,
    },
    /// Moves a group or a house.
    MovePlace {
        /// What to move, among the places of the plan.
        place: usize,
        /// Metres east and north in its frame.
        to: [f64; 2],
    },
    /// Turns a group or a house.
    TurnPlace {
        /// What to turn, among the places of the plan.
        place: usize,
        /// Degrees in its frame.
        to: f64,
    },
    /// Adds a house on an outline.
    DrawOutline {
        /// Its corners, metres east and north in the world.
        points: Vec<[f64; 2]>,
        /// The height of its storey in shaku.
        #[serde(default)]
        height: Option<f64>,
    },
    /// Moves a corner of an outline.
    MoveCorner {
        /// The outline, among those of the plan.
        outline: usize,
        /// The corner, in the order of the file.
        corner: usize,
        /// Metres in the frame of the outline.
        to: [f64; 2],
    },
    /// Draws a wall inside a storey.
    DrawWall {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// Its ends, and the corners between them.
        points: Vec<[f64; 2]>,
        /// A code, or the name of a custom part.
        #[serde(default)]
        part: Option<String>,
    },
    /// Removes a walk inside a storey.
    RemoveWall {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The walk.
        ring: usize,
    },
    /// Adds a room.
    AddRoom {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The attributes to write.
        #[serde(flatten)]
        words: RoomWords,
    },
    /// Changes a room.
    SetRoom {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The room, in the order of the file.
        room: usize,
        /// The attributes to write.
        #[serde(flatten)]
        words: RoomWords,
    },
    /// Removes a room.
    RemoveRoom {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The room, in the order of the file.
        room: usize,
    },
    /// Adds a fixture.
    AddFixture {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The attributes to write.
        #[serde(flatten)]
        words: FixtureWords,
    },
    /// Changes a fixture.
    SetFixture {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The fixture, in the order of the file.
        fixture: usize,
        /// The attributes to write.
        #[serde(flatten)]
        words: FixtureWords,
    },
    /// Removes a fixture.
    RemoveFixture {
        /// The storey.
        #[serde(flatten)]
        storey: StoreyAt,
        /// The fixture, in the order of the file.
        fixture: usize,
    },
    /// Takes a wall in doubt as it is.
    AcceptDoubt {
        /// The doubt, in the order of the file.
        doubt: usize,
    },
    /// Makes a wall in doubt one of a kind.
    ChangeDoubt {
        /// The doubt, in the order of the file.
        doubt: usize,
        /// The kind.
        kind: Kind,
    },
    /// Takes a wall in doubt away.
    DeleteDoubt {
        /// The doubt, in the order of the file.
        doubt: usize,
    },
}

/// A storey by its place in the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub struct StoreyAt {
    /// The house.
    pub house: usize,
    /// The storey in its list, not its number.
    pub storey: usize,
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

/// A unit by its place in the plan, or in the file.
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
    /// By its bytes of the file.
    Span {
        /// First byte, one past the last byte.
        span: [u32; 2],
    },
}

/// The storeys that move with a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Storeys {
    /// Its own only.
    #[default]
    One,
    /// All storeys whose wall stands directly above or below it.
    All,
}

/// Returns the edits of a stroke.
///
/// # Errors The reason why it cannot be made, and an alternative; the file is unchanged then.
pub fn edits(a: &Analysis, stroke: &Stroke) -> Result<Vec<Edit>, Text> {
    let sheet = &Sheet::of(a);
    let mut edits = worked_out(sheet, stroke)?;
    // A source file without a final line end gets none.
    if let Some(last) = edits.last_mut()
        && last.text.is_empty()
        && last.range.end == sheet.text.len()
        && !sheet.text.ends_with(['\n', '\r'])
    {
        let before = &sheet.text[..last.range.start];
        let line = before.strip_suffix('\n').unwrap_or(before);
        last.range.start = line.strip_suffix('\r').unwrap_or(line).len();
        edits = change::tidy(edits);
    }
    Ok(edits)
}

fn worked_out(sheet: &Sheet<'_>, stroke: &Stroke) -> Result<Vec<Edit>, Text> {
    match stroke {
        Stroke::SetPart { unit, part } => set_part(sheet, *unit, part),
        Stroke::MoveWall { wall, by, storeys } => slide::slide(sheet, *wall, *by, *storeys),
        Stroke::BreakWall { wall, from, to, by } => {
            slide::break_out(sheet, *wall, (*from, *to), *by)
        }
        Stroke::DrawHouse {
            outline,
            height,
            house,
        } => houses::draw(sheet, outline, *height, *house),
        Stroke::AddStorey {
            house,
            height,
            outline,
        } => storeys::add(sheet, *house, *height, outline.as_deref()),
        Stroke::RemoveStorey { house, storey } => storeys::remove(sheet, *house, *storey),
        Stroke::SetHeight {
            house,
            storey,
            height,
        } => storeys::set_height(sheet, *house, *storey, *height),
        Stroke::RemoveHouse { house } => houses::remove(sheet, *house),
        Stroke::MovePlace { place, to } => houses::ground::move_to(sheet, *place, *to),
        Stroke::TurnPlace { place, to } => houses::ground::turn_to(sheet, *place, *to),
        Stroke::DrawOutline { points, height } => houses::ground::draw(sheet, points, *height),
        Stroke::MoveCorner {
            outline,
            corner,
            to,
        } => houses::ground::move_corner(sheet, *outline, *corner, *to),
        Stroke::DrawWall {
            storey,
            points,
            part,
        } => inner::draw(sheet, *storey, points, part.as_deref()),
        Stroke::RemoveWall { storey, ring } => inner::remove(sheet, *storey, *ring),
        Stroke::AddRoom { storey, words } => rooms::add(sheet, *storey, words),
        Stroke::SetRoom {
            storey,
            room,
            words,
        } => rooms::change(sheet, *storey, *room, words),
        Stroke::RemoveRoom { storey, room } => rooms::remove(sheet, *storey, *room),
        Stroke::AddFixture { storey, words } => fixtures::add(sheet, *storey, words),
        Stroke::SetFixture {
            storey,
            fixture,
            words,
        } => fixtures::change(sheet, *storey, *fixture, words),
        Stroke::RemoveFixture { storey, fixture } => fixtures::remove(sheet, *storey, *fixture),
        Stroke::AcceptDoubt { doubt } => doubts::accept(sheet, *doubt),
        Stroke::ChangeDoubt { doubt, kind } => doubts::change(sheet, *doubt, *kind),
        Stroke::DeleteDoubt { doubt } => doubts::delete(sheet, *doubt),
    }
}

/// Replaces the part of a unit, about which nothing is in doubt any more.
fn set_part(sheet: &Sheet<'_>, unit: UnitAt, part: &str) -> Result<Vec<Edit>, Text> {
    let (wall, unit) = part::place(sheet, unit)?;
    let mut edits = part::set(sheet, (wall, unit), &[part])?;
    edits.extend(doubts::settles(sheet, wall, unit));
    Ok(change::tidy(edits))
}
