//! Rooms: the names of the areas between the walls of a storey, and what their floors and ceilings are.

use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// `<Room name="奥" at="1 5" floor="tatami"/>`: the area that walls enclose round a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Room {
    /// The element.
    pub span: Span,
    /// Its name, if it has one.
    pub name: Option<Spanned<String>>,
    /// A point in it (a, b) in U, author frame.
    pub at: Spanned<(f64, f64)>,
    /// Its floor.
    pub floor: Flooring,
    /// How its mats lie, if it has any.
    pub mats: MatOrder,
    /// Its ceiling.
    pub ceiling: RoomCeiling,
    /// From the floor to the ceiling, shaku; `None` = up to the next storey.
    pub height: Option<f64>,
}

/// The floor of a room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Flooring {
    /// Mats (畳).
    Tatami,
    /// Boards (板の間).
    #[default]
    Boards,
    /// Pounded earth (土間).
    Earth,
}

impl Flooring {
    /// Every floor with its word.
    pub const ALL: [(&'static str, Flooring); 3] = [
        ("boards", Flooring::Boards),
        ("tatami", Flooring::Tatami),
        ("earth", Flooring::Earth),
    ];
}

/// How mats lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum MatOrder {
    /// No four corners meet in a point (祝儀敷き).
    #[default]
    Festive,
    /// All in rows, as in mourning and in large halls (不祝儀敷き).
    Rows,
}

impl MatOrder {
    /// Every order with its word.
    pub const ALL: [(&'static str, MatOrder); 2] =
        [("festive", MatOrder::Festive), ("rows", MatOrder::Rows)];
}

/// The ceiling of a room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RoomCeiling {
    /// Boards on battens (棹縁天井).
    #[default]
    Battens,
    /// The joists and boards of the floor above (大和天井).
    Joists,
    /// Nothing up to the roof, as over a tori-niwa (吹き抜け).
    None,
}

impl RoomCeiling {
    /// Every ceiling with its word.
    pub const ALL: [(&'static str, RoomCeiling); 3] = [
        ("battens", RoomCeiling::Battens),
        ("joists", RoomCeiling::Joists),
        ("none", RoomCeiling::None),
    ];
}
