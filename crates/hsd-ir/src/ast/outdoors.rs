//! What a town has outside its houses (docs/contract.md 10): the wishes that its rules write, and the shapes that become of them.

pub mod land;
pub mod law;
pub mod street;

use glam::{DVec2, DVec3};
use hsd_base::source::Span;
use land::{Farmland, Water};
use law::{EnvelopeWish, Zone};
use serde::Serialize;
use street::{Arcade, Lone, Poles, Sign, Signal, WireLine};

/// The outdoor object that a rule asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Outdoor {
    /// A road along a line, or over an area.
    Road(Road),
    /// A railway along a line.
    Rail(Railway),
    /// A tree at a point, or trees along a line or over an area.
    Tree(TreeWish),
    /// A fence, a hedge or a wall along a line or round an area.
    Fence(Fence),
    /// A torii or a lantern on a line.
    Lone(Lone),
    /// A pole at a point, poles along a line, or a network along streets.
    Poles(Poles),
    /// Wires along a line.
    Wire(WireLine),
    /// Signals of a crossing.
    Signal(Signal),
    /// A board with a name.
    Sign(Box<Sign>),
    /// A roof over a pavement along a line.
    Arcade(Arcade),
    /// A river, a moat or a pond.
    Water(Water),
    /// Fields over an area.
    Farmland(Farmland),
    /// The terms of building law over an area.
    Zone(Box<Zone>),
    /// The largest solid that building law allows on an area.
    Envelope(Box<EnvelopeWish>),
}

impl Outdoor {
    /// Returns the word for it in tables and models.
    pub fn word(&self) -> &'static str {
        match self {
            Outdoor::Road(_) => "road",
            Outdoor::Rail(_) => "rail",
            Outdoor::Tree(_) => "tree",
            Outdoor::Fence(fence) => fence.word,
            Outdoor::Lone(lone) => lone.word,
            Outdoor::Poles(poles) if poles.reach.is_some() => "network",
            Outdoor::Poles(_) => "pole",
            Outdoor::Wire(_) => "wire",
            Outdoor::Signal(_) => "signal",
            Outdoor::Sign(_) => "sign",
            Outdoor::Arcade(_) => "arcade",
            Outdoor::Water(_) => "water",
            Outdoor::Farmland(_) => "farmland",
            Outdoor::Zone(_) => "zone",
            Outdoor::Envelope(_) => "envelope",
        }
    }
}

/// A road; lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Road {
    /// Its width, pavements and drains with it; without, that of the map or of its class.
    pub width: Option<f64>,
    /// Its surface.
    pub surface: Surface,
    /// The width of the pavement on either side; 0 for none.
    pub pavement: f64,
    /// The width of the drain on either side; 0 for none.
    pub drain: f64,
    /// True if lines are painted on it.
    pub marks: bool,
}

/// A railway; lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Railway {
    /// The gauge between its rails.
    pub gauge: f64,
}

/// A tree; lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeWish {
    /// Its species; without, one that is drawn by its place.
    pub species: Option<Species>,
    /// Its height; without, drawn.
    pub height: Option<f64>,
    /// The width of its crown; without, drawn as a share of the height.
    pub width: Option<f64>,
    /// How far trees stand apart along a line or over an area.
    pub spacing: f64,
    /// How far they stand from a line, on either side; 0 for on it.
    pub offset: f64,
}

/// A fence, a hedge or a wall: units along a line, whose left side is outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Fence {
    /// The element: `fence`, `hedge` or `wall`.
    pub word: &'static str,
    /// The part that is repeated.
    pub code: crate::ast::CodeText,
    /// The part at the beginning of the line, if it is another.
    pub first: Option<crate::ast::CodeText>,
    /// The part at its end.
    pub last: Option<crate::ast::CodeText>,
    /// The place of the codes.
    pub span: Span,
    /// The height, shaku; without, that of the part.
    pub height: Option<f64>,
    /// The width of the opening for a gate in the middle of an area's front, metres; 0 for none.
    pub gate: f64,
}

/// The surface of a road.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Surface {
    /// Trodden earth.
    Earth,
    /// Gravel.
    Gravel,
    /// Asphalt.
    #[default]
    Asphalt,
    /// Slabs of stone.
    Stone,
    /// Concrete.
    Concrete,
}

impl Surface {
    /// The words for it.
    pub const WORDS: [(&'static str, Surface); 5] = [
        ("earth", Surface::Earth),
        ("gravel", Surface::Gravel),
        ("asphalt", Surface::Asphalt),
        ("stone", Surface::Stone),
        ("concrete", Surface::Concrete),
    ];

    /// Returns the word for it.
    pub fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, own)| *own == self);
        found.map_or("", |(word, _)| word)
    }
}

/// The species of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Species {
    /// Hanging branches, at rivers and in streets.
    Willow,
    /// Flat layers on a bent trunk.
    Pine,
    /// A wide dome.
    Cherry,
    /// A narrow cone.
    Cedar,
    /// A tall dome, along avenues.
    Plane,
}

impl Species {
    /// The words for it.
    pub const WORDS: [(&'static str, Species); 5] = [
        ("willow", Species::Willow),
        ("pine", Species::Pine),
        ("cherry", Species::Cherry),
        ("cedar", Species::Cedar),
        ("plane", Species::Plane),
    ];

    /// Returns the word for it.
    pub fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, own)| *own == self);
        found.map_or("", |(word, _)| word)
    }

    /// Returns the heights of grown trees, metres, and the widths of their crowns as shares of the height.
    pub fn usual(self) -> ([f64; 2], [f64; 2]) {
        match self {
            Species::Willow => ([6.0, 10.0], [0.7, 0.95]),
            Species::Pine => ([5.0, 11.0], [0.55, 0.8]),
            Species::Cherry => ([5.0, 8.0], [0.9, 1.2]),
            Species::Cedar => ([10.0, 20.0], [0.25, 0.4]),
            Species::Plane => ([8.0, 14.0], [0.55, 0.75]),
        }
    }
}

/// The shapes of an outdoor object.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Outdoors {
    /// The element.
    pub span: Span,
    /// Its kind; nodes are named after it.
    pub word: &'static str,
    /// What lies on the ground.
    pub sheets: Vec<Sheet>,
    /// Trees.
    pub trees: Vec<Tree>,
}

/// Plane faces of one surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sheet {
    /// The name of the surface.
    pub finish: &'static str,
    /// The least level of detail that shows it.
    pub least: u8,
    /// The greatest that does.
    pub most: u8,
    /// True if it lies on a ground that is coarser from afar.
    pub on_ground: bool,
    /// Convex faces, counter-clockwise seen from outside: metres from the place of the house, not turned.
    pub faces: Vec<Vec<DVec3>>,
}

impl Sheet {
    /// The highest level of detail.
    pub const MOST: u8 = 3;

    /// Returns the sheet, shown up to a level of detail.
    #[must_use]
    pub fn until(self, most: u8) -> Sheet {
        Sheet { most, ..self }
    }
}

/// A tree.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tree {
    /// Its species.
    pub species: Species,
    /// Its foot, metres from the place of the house.
    pub at: DVec3,
    /// Height, metres.
    pub height: f64,
    /// Width of its crown, metres.
    pub width: f64,
    /// The direction that its model looks to, unit length.
    pub turn: DVec2,
}
