//! A town as written (docs/contract.md 10): layers of maps, and rules for what is made of their features. What stands
//! in a `for` is evaluated for each feature, at its [`Site`].

use super::{House, Outdoor, Value};
use glam::DVec2;
use hsd_base::rng::Place;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// A town.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Town {
    /// The start tag.
    pub span: Span,
    /// Its name.
    pub name: Option<Spanned<String>>,
    /// The plane in which it is built, such as `EPSG:6674`.
    pub crs: Option<Spanned<String>>,
    /// Key of all draws.
    pub seed: u64,
    /// Metres east and north in the plane that are 0 0 of the model.
    pub origin: Option<Spanned<(f64, f64)>>,
    /// True if its heights count from the sea where it is put on the globe, rather than from the ellipsoid.
    pub geoid: bool,
    /// Its maps, in the order of the file.
    pub layers: Vec<Layer>,
    /// Its tables.
    pub tables: Vec<Table>,
    /// Its rules.
    pub rules: Vec<Rule>,
    /// The layers that a `front` names.
    pub fronts: Vec<Spanned<String>>,
    /// The layers of which a rule may make houses.
    pub housed: Vec<String>,
    /// The file of the font of its signs.
    pub font: Option<Spanned<String>>,
    /// The layers of which a rule may make roads.
    pub roads: Vec<String>,
    /// The layers of which a rule may make networks of poles.
    pub networks: Vec<String>,
    /// The layers of which a rule may make zones.
    pub zones: Vec<String>,
    /// The layers of which a rule may make water.
    pub waters: Vec<String>,
    /// How its model is divided.
    pub tiles: Tiles,
}

/// A map, or a layer of one.
#[derive(Clone, Debug, Serialize)]
pub struct Layer {
    /// The start tag.
    pub span: Span,
    /// Its name in the town.
    pub name: Spanned<String>,
    /// Its file.
    pub src: Spanned<String>,
    /// The layer of the file.
    pub layer: Option<Spanned<String>>,
    /// The encoding of texts.
    pub encoding: Option<Spanned<String>>,
    /// The coordinates.
    pub crs: Option<Spanned<String>>,
    /// The field that names features.
    pub key: Option<Spanned<String>>,
    /// The field of points that names the outline to which they belong.
    pub outline: Option<Spanned<String>>,
    /// The field that says in which order they do.
    pub order: Option<Spanned<String>>,
    /// The test that features must pass.
    pub filter: Option<Spanned<String>>,
    /// The source of the map.
    pub evidence: Option<Spanned<String>>,
    /// Fields that are renamed, converted or filled.
    pub fields: Vec<Field>,
    /// Layers of points whose fields its outlines take.
    pub joins: Vec<Join>,
    /// How the areas of its map are divided, and which of the resulting parts are its features.
    pub divided: Option<Divided>,
}

/// A layer whose features are parts of divided areas.
#[derive(Clone, Debug, Serialize)]
pub struct Divided {
    /// The part that is its features.
    pub part: DividedPart,
    /// How the areas are divided.
    pub division: Division,
}

/// A part of divided areas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum DividedPart {
    /// The plots along the sides of blocks.
    Plots,
    /// The blocks between the streets.
    Blocks,
    /// The streets by which deep areas are cut.
    Streets,
    /// The ground that belongs to no plot.
    Yards,
}

impl DividedPart {
    /// The attributes that name their layers, which are the names without one.
    pub const WORDS: [(&'static str, DividedPart); 4] = [
        ("plots", DividedPart::Plots),
        ("blocks", DividedPart::Blocks),
        ("streets", DividedPart::Streets),
        ("yards", DividedPart::Yards),
    ];
}

/// How areas are divided into blocks, streets and plots. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Division {
    /// The width of a plot at its street, as near as a whole number of plots allows.
    pub frontage: f64,
    /// Its greatest depth.
    pub depth: f64,
    /// The width of the streets.
    pub street: f64,
    /// From the middle of a street to that of the next: across the main direction of the area, and along it.
    pub every: [f64; 2],
    /// The greatest depth of an area that no street cuts.
    pub deep: f64,
}

/// The division of the merchant quarters of Edo (towns.md 5), in ken of 6.5 shaku: plots of 5 by 20 ken, streets of 4 ken
/// every 44 and 64 ken through what is deeper than 48 ken.
impl Default for Division {
    fn default() -> Division {
        const KEN: f64 = 6.5 * hsd_base::geometry::SHAKU;
        Division {
            frontage: 5.0 * KEN,
            depth: 20.0 * KEN,
            street: 4.0 * KEN,
            every: [44.0 * KEN, 64.0 * KEN],
            deep: 48.0 * KEN,
        }
    }
}

/// A layer of points whose fields become fields of the outlines that they belong to.
#[derive(Clone, Debug, Serialize)]
pub struct Join {
    /// The start tag.
    pub span: Span,
    /// The layer.
    pub layer: Spanned<String>,
    /// The field of the points that holds the key of their outline; without, a point belongs to the outline that it lies in.
    pub by: Option<Spanned<String>>,
    /// How far from an outline a point that lies in none may be, metres.
    pub within: f64,
}

/// A field that is renamed, converted or filled.
#[derive(Clone, Debug, Serialize)]
pub struct Field {
    /// The start tag.
    pub span: Span,
    /// Its name in expressions.
    pub name: Spanned<String>,
    /// Its name in the file.
    pub from: Spanned<String>,
    /// The type it is read as.
    pub kind: Option<FieldType>,
    /// The value where there is none.
    pub default: Option<Value>,
    /// Replacements of values.
    pub map: Vec<(String, String)>,
}

/// The type of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum FieldType {
    /// A number.
    Number,
    /// Any text.
    Text,
    /// A truth value.
    Truth,
}

impl FieldType {
    /// The words for it.
    pub const WORDS: [(&'static str, FieldType); 3] = [
        ("number", FieldType::Number),
        ("text", FieldType::Text),
        ("yesno", FieldType::Truth),
    ];
}

/// A table of values.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    /// The start tag.
    pub span: Span,
    /// Its name.
    pub name: Spanned<String>,
    /// Its file.
    pub src: Spanned<String>,
    /// The column by which rows are found.
    pub key: Spanned<String>,
}

/// What the rules of a town say before they are evaluated.
#[derive(Debug, Default)]
pub struct RuleFacts {
    /// The words of `front` in them.
    pub fronts: Vec<Spanned<String>>,
    /// The layers of which they may make houses.
    pub housed: Vec<String>,
    /// The layers of which they may make roads.
    pub roads: Vec<String>,
    /// The layers of which they may make networks of poles.
    pub networks: Vec<String>,
    /// The layers of which they may make zones.
    pub zones: Vec<String>,
    /// The layers of which they may make water.
    pub waters: Vec<String>,
}

/// A `for`.
#[derive(Clone, Debug, Serialize)]
pub struct Rule {
    /// The start tag.
    pub span: Span,
    /// Its layer.
    pub each: Spanned<String>,
}

/// How the model of a town is divided.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tiles {
    /// The side of a tile, metres.
    pub size: f64,
    /// The field that names the tile of a feature.
    pub by: Option<Spanned<String>>,
    /// Levels of detail, from far to near.
    pub detail: Vec<u8>,
}

impl Default for Tiles {
    fn default() -> Tiles {
        Tiles {
            size: 250.0,
            by: None,
            detail: vec![0, 1, 3],
        }
    }
}

/// The ground of a house.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum PlaceOn {
    /// The type's own rectangle behind the front.
    Plot,
    /// The walls of the outline.
    Outline,
    /// The centre of the feature, facing its street.
    Centre,
    /// The middle of a line, along it.
    Line,
    /// The middle of the front, where the wall of the feature is open for its gate.
    Gate,
}

impl PlaceOn {
    /// The words for it.
    pub const WORDS: [(&'static str, PlaceOn); 5] = [
        ("plot", PlaceOn::Plot),
        ("outline", PlaceOn::Outline),
        ("centre", PlaceOn::Centre),
        ("line", PlaceOn::Line),
        ("gate", PlaceOn::Gate),
    ];

    /// Returns the word for it.
    pub fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, on)| *on == self);
        found.map_or("", |(word, _)| word)
    }
}

/// The side of a house on which its gap lies, as seen from the street.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum GapAt {
    /// Half of it on either side.
    #[default]
    Both,
    /// All of it on the left.
    Left,
    /// All of it on the right.
    Right,
}

impl GapAt {
    /// The words for it.
    pub const WORDS: [(&'static str, GapAt); 3] = [
        ("both", GapAt::Both),
        ("left", GapAt::Left),
        ("right", GapAt::Right),
    ];

    /// Divides a gap into what lies on the left and what lies on the right.
    pub fn divide(self, gap: f64) -> [f64; 2] {
        match self {
            GapAt::Both => [gap / 2.0; 2],
            GapAt::Left => [gap, 0.0],
            GapAt::Right => [0.0, gap],
        }
    }
}

/// A name of a feature: a field or a measure.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// Its value.
    Value(Value),
    /// A field that other features of the layer have.
    Missing,
    /// No name of the layer.
    Unknown,
}

/// The demands of a `Place` on its site.
#[derive(Clone, Debug)]
pub struct Wish<'w> {
    /// The place of the type's name.
    pub span: Span,
    /// The type, as written.
    pub kind: &'w str,
    /// The ground that it asks for, if any.
    pub on: Option<PlaceOn>,
    /// The layer of streets that it fronts, or `published`.
    pub front: Option<&'w str>,
    /// The greatest depth, metres.
    pub cap: Option<f64>,
    /// How much of its front it leaves free on the left and on the right, as seen from the street, metres.
    pub gaps: [f64; 2],
    /// The greatest width that the type allows, metres, once that is known to be too small.
    pub widest: Option<f64>,
}

/// Where a house stands: lengths in metres, places in the frame of the town.
#[derive(Clone, Debug, PartialEq)]
pub struct Stood {
    /// The right end of the front, or the centre.
    pub at: DVec2,
    /// Height of the ground.
    pub z: f64,
    /// How far a plinth reaches below that, metres; 0 for none.
    pub plinth: f64,
    /// Compass direction of the front, degrees.
    pub azimuth: f64,
    /// Width along the front.
    pub frontage: f64,
    /// Depth behind it.
    pub depth: f64,
    /// True if its centre stands at `at`.
    pub centred: bool,
    /// The walls that it follows, where it is no rectangle; `at` is then the origin of their points.
    pub walls: Option<SiteWalls>,
}

/// The walls of a feature that a house follows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SiteWalls {
    /// The corners, metres from [`Stood::at`].
    pub ring: Vec<DVec2>,
    /// Courtyards.
    pub holes: Vec<Vec<DVec2>>,
    /// The number of the front side, from 1.
    pub front: u32,
    /// The numbers of sides on streets.
    pub street: Vec<u32>,
    /// The numbers of sides on which a neighbour stands.
    pub neighbour: Vec<u32>,
}

/// A house as a text: a `Place` of its type, or its own definition and a `Place` for that.
#[derive(Clone, Debug)]
pub struct HouseText {
    /// With its type, if that is the same house.
    pub placed: Option<String>,
    /// With a definition; empty if that cannot be.
    pub own: String,
}

impl HouseText {
    /// Returns the shorter one that is the house.
    pub fn text(&self) -> &str {
        self.placed.as_deref().unwrap_or(&self.own)
    }
}

/// A house behind the house of a lot.
#[derive(Clone, Debug, PartialEq)]
pub struct RearHouse {
    /// What it is: with the key of the feature, its own key.
    pub unit: String,
    /// Its type in the library.
    pub kind: &'static str,
    /// The parameters of the type that its place decides.
    pub parameters: Vec<(&'static str, Value)>,
    /// Where it stands.
    pub stood: Stood,
}

/// The answer of a site that is asked for the houses behind its house.
#[derive(Clone, Debug, PartialEq)]
pub enum Rear {
    /// The houses; none where the lot has no room, which the site records.
    Houses(Vec<RearHouse>),
    /// The feature is no area.
    NoArea,
}

/// A feature of a map and its surroundings.
pub trait Site {
    /// Returns the value of a field or measure.
    fn value(&self, name: &str) -> Known;
    /// Returns the names of all fields and measures, fields first.
    fn names(&self) -> Vec<String>;
    /// Returns the cell of a table; `Err` with the known words if the table, the row or the column is not there.
    ///
    /// # Errors
    /// Which of table, key and column is wrong.
    fn look(&self, table: &str, key: &Value, column: &str) -> Result<Value, Unfound>;
    /// Returns true if a layer of the town has this name.
    fn is_layer(&self, name: &str) -> bool;
    /// Returns the place that keys draws: its centroid on a grid of 0.5 m.
    fn key(&self) -> (i64, i64);
    /// Finds the place of a house; `None` if there is none, which the site records.
    fn stand(&self, wish: &Wish<'_>) -> Option<Stood>;
    /// Finds the places of houses behind the house that stands on the feature already. `density` is the share of the dwellings
    /// along an alley that are built, 0 to 1; `draws` keys what is drawn.
    fn rear(&self, density: f64, draws: Place) -> Rear;
}

/// The argument of `look` that is wrong, and what there is.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfound {
    /// The number of the argument.
    pub argument: usize,
    /// The words that it could be.
    pub known: Vec<String>,
}

/// The result of a rule at a feature.
#[derive(Clone, Debug)]
pub enum Made {
    /// Nothing, since the author says so.
    Skip {
        /// The place of the element.
        span: Span,
        /// The reason.
        because: String,
    },
    /// What stands or lies outside houses.
    Outdoor {
        /// The place of the element.
        span: Span,
        /// Where it comes from.
        evidence: String,
        /// What is wanted.
        wish: Outdoor,
    },
    /// Houses.
    Houses {
        /// The place of the element.
        span: Span,
        /// The type, or nothing for a house written in place.
        kind: String,
        /// What it is, for a house behind that of its lot.
        unit: Option<String>,
        /// Where it comes from.
        evidence: String,
        /// The houses, in the frame of the town.
        houses: Vec<House>,
        /// The element of each house with all expressions computed, if asked for.
        written: Vec<String>,
        /// The parameters of the type and their values.
        parameters: Vec<(String, Value)>,
        /// Where they stand.
        stood: Box<Stood>,
    },
}
