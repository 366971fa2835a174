//! What may stand in each place: the elements, and whether text is read as codes.

use super::{ELEMENTS, Schema, Tag};

/// Content that is allowed in a place.
#[derive(Debug)]
pub struct Content {
    /// Its name.
    pub name: &'static str,
    pub(in crate::parse) tags: &'static [Tag],
    /// True if text is read as codes there.
    pub text: bool,
    /// The content of a `repeat` there, if it differs.
    again: Option<&'static Content>,
}

impl Content {
    /// Returns true if it allows neither elements nor text.
    pub fn is_nothing(&self) -> bool {
        self.name == NOTHING.name
    }
}

impl Content {
    /// Returns the elements allowed there, excluding those of the language.
    pub fn elements(&self) -> impl Iterator<Item = &'static Schema> + use<'_> {
        ELEMENTS.iter().filter(|e| self.tags.contains(&e.tag))
    }

    /// Returns the content of a `repeat` there.
    pub fn repeated(&'static self) -> &'static Content {
        self.again.unwrap_or(self)
    }
}

const fn content(name: &'static str, tags: &'static [Tag]) -> Content {
    Content {
        name,
        tags,
        text: false,
        again: None,
    }
}

/// Content in which a `repeat` contains something else.
const fn repeating(again: &'static Content, name: &'static str, tags: &'static [Tag]) -> Content {
    Content {
        again: Some(again),
        ..content(name, tags)
    }
}

/// The elements that may be outermost.
pub static ROOT: Content = content(
    "root",
    &[
        Tag::House,
        Tag::Houses,
        Tag::Town,
        Tag::Structure,
        Tag::Catalog,
    ],
);
pub(in crate::parse) static TOWN: Content = content(
    "town",
    &[
        Tag::Layer,
        Tag::Divide,
        Tag::Table,
        Tag::For,
        Tag::Tiles,
        Tag::PartDef,
    ],
);
pub(in crate::parse) static LAYER: Content = content("layer", &[Tag::Field, Tag::Join]);
/// What may be made of a feature.
pub(in crate::parse) static FOR: Content = content(
    "for",
    &[
        Tag::Skip,
        Tag::Place,
        Tag::Rear,
        Tag::House,
        Tag::Road,
        Tag::Rail,
        Tag::Tree,
        Tag::Fence,
        Tag::Hedge,
        Tag::Wall,
        Tag::Pole,
        Tag::Network,
        Tag::Wire,
        Tag::Signal,
        Tag::Sign,
        Tag::Arcade,
        Tag::Torii,
        Tag::Lantern,
        Tag::Water,
        Tag::Farmland,
        Tag::Residence,
        Tag::Block,
        Tag::Zone,
        Tag::Envelope,
        Tag::Random,
    ],
);
pub(in crate::parse) static HOUSES: Content = content(
    "houses",
    &[
        Tag::House,
        Tag::Group,
        Tag::Place,
        Tag::View,
        Tag::Put,
        Tag::Ground,
        Tag::Repeat,
        Tag::Random,
        Tag::PartDef,
    ],
);
/// What may be said of a house that is placed.
pub(in crate::parse) static PLACE: Content = content("place", &[Tag::Outline]);
/// What a `Place` has become when the document is read.
pub(in crate::parse) static PLACED: Content = content(
    "placed",
    &[
        Tag::House,
        Tag::Group,
        Tag::Place,
        Tag::View,
        Tag::Put,
        Tag::Ground,
        Tag::PartDef,
        Tag::Outline,
    ],
);
pub(in crate::parse) static HOUSE: Content = repeating(
    &REPEATED_IN_HOUSE,
    "house",
    &[
        Tag::Outline,
        Tag::Storey,
        Tag::Repeat,
        Tag::Random,
        Tag::Replace,
        Tag::Structure,
        Tag::Texture,
        Tag::Roofs,
        Tag::Platform,
        Tag::Posts,
        Tag::Brackets,
        Tag::Finial,
        Tag::Put,
        Tag::Ground,
        Tag::Pagoda,
        Tag::Gate,
        Tag::Hall,
        Tag::Shrine,
        Tag::PartDef,
    ],
);
static REPEATED_IN_HOUSE: Content = content(
    "house_repeated",
    &[
        Tag::Storey,
        Tag::Repeat,
        Tag::Random,
        Tag::Replace,
        Tag::Put,
        Tag::Ground,
    ],
);
pub(in crate::parse) static STOREYS: Content = content(
    "storeys",
    &[Tag::Storey, Tag::Repeat, Tag::Random, Tag::Replace],
);
pub(in crate::parse) static STOREY: Content = repeating(
    &REPEATED_IN_STOREY,
    "storey",
    &[
        Tag::Row,
        Tag::Walls,
        Tag::Loop,
        Tag::Repeat,
        Tag::Random,
        Tag::Replace,
        Tag::Posts,
        Tag::Veranda,
        Tag::Room,
        Tag::Fixture,
        Tag::Brackets,
    ],
);
static REPEATED_IN_STOREY: Content = content(
    "storey_repeated",
    &[
        Tag::Row,
        Tag::Loop,
        Tag::Repeat,
        Tag::Random,
        Tag::Replace,
        Tag::Room,
        Tag::Fixture,
    ],
);
pub(in crate::parse) static OUTLINE: Content = content("outline", &[Tag::Hole]);
pub(in crate::parse) static WALLS: Content = content("walls", &[Tag::SideWall]);
pub(in crate::parse) static SIDE_WALL: Content = Content {
    name: "side",
    tags: &[
        Tag::Fill,
        Tag::Door,
        Tag::Part,
        Tag::Repeat,
        Tag::Split,
        Tag::Random,
        Tag::Replace,
    ],
    text: true,
    again: Some(&PIECES),
};
pub(in crate::parse) static ROWS: Content =
    content("rows", &[Tag::Row, Tag::Repeat, Tag::Random, Tag::Replace]);
pub(in crate::parse) static PIECES: Content = Content {
    name: "pieces",
    tags: &[
        Tag::Part,
        Tag::Repeat,
        Tag::Split,
        Tag::Random,
        Tag::Replace,
    ],
    text: true,
    again: None,
};
/// A floor may hold its base row as a `Row` too (docs/evidence.md 8).
pub(in crate::parse) static FLOOR: Content = Content {
    name: "floor",
    tags: &[
        Tag::Part,
        Tag::Repeat,
        Tag::Split,
        Tag::Random,
        Tag::Replace,
        Tag::Row,
    ],
    text: true,
    again: Some(&PIECES),
};
pub(in crate::parse) static SPLIT: Content = content("split", &[Tag::Upper, Tag::Lower]);
pub(in crate::parse) static STRUCTURE: Content =
    content("structure", &[Tag::Facades, Tag::Texture]);
pub(in crate::parse) static FACADES: Content = content(
    "facades",
    &[Tag::Facade, Tag::Repeat, Tag::Random, Tag::Replace],
);
pub(in crate::parse) static FACADE: Content = content(
    "facade",
    &[Tag::Floor, Tag::Repeat, Tag::Random, Tag::Replace],
);
pub(in crate::parse) static ROOFS: Content = content("roofs", &[Tag::Roof]);
/// Definitions that only other files use.
pub(in crate::parse) static DEFINITIONS: Content = content("definitions", &[Tag::PartDef]);
pub(in crate::parse) static NOTHING: Content = content("nothing", &[]);
