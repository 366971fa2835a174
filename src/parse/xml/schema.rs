//! The elements of the language: what each may bear and hold (language.md 3). Everything that the reader says about
//! unknown words and wrong places comes from these tables.

use super::tree::Habits;

/// An element of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tag {
    Houses,
    House,
    Storey,
    Loop,
    Row,
    Part,
    Structure,
    Facades,
    Facade,
    Floor,
    Repeat,
    Split,
    Upper,
    Lower,
    Random,
    Replace,
    Texture,
    Roofs,
    Roof,
    Catalog,
    Param,
    Let,
    Define,
    Use,
    If,
    Else,
    Include,
    Choice,
    Platform,
    Posts,
    Veranda,
    Brackets,
    Finial,
    Pagoda,
    Gate,
    Hall,
    Shrine,
    /// Part of the language, but not read by this version.
    Later,
}

/// What an element looks like.
pub(super) struct Schema {
    pub(super) tag: Tag,
    pub(super) name: &'static str,
    /// Attributes it may bear, `code` standing for `texturecode` too.
    pub(super) attributes: &'static [&'static str],
    /// Those of them that it must bear.
    pub(super) required: &'static [&'static str],
    /// Where it belongs, for the message when it stands elsewhere.
    pub(super) home: &'static str,
}

/// What may stand somewhere.
pub(super) struct Content {
    pub(super) tags: &'static [Tag],
    /// Whether text is codes there.
    pub(super) text: bool,
}

const fn element(
    tag: Tag,
    name: &'static str,
    attributes: &'static [&'static str],
    required: &'static [&'static str],
    home: &'static str,
) -> Schema {
    Schema {
        tag,
        name,
        attributes,
        required,
        home,
    }
}

const fn later(name: &'static str) -> Schema {
    element(Tag::Later, name, &[], &[], "")
}

/// Where elements of [`language`](super::language) belong.
const ANY: &str = "any element";

/// What halls and shrines may bear.
#[rustfmt::skip]
const HALL: &[&str] = &["bays", "bay", "doors", "aisle", "upper", "veranda", "floor", "katsuogi", "columns",
    "post", "paint", "steps", "pitch", "eaves", "sori", "thickness", "kind", "shape", "platform", "margin"];

/// All elements.
#[rustfmt::skip]
pub(super) static ELEMENTS: &[Schema] = &[
    element(Tag::Houses, "Houses", &[], &[], "nothing: it is the outermost element"),
    element(Tag::House, "House", &["name", "unit", "seed", "azimuth", "x", "y", "z", "street"], &[],
        "`Houses`, or is the outermost element"),
    element(Tag::Storey, "Storey", &["height", "start", "kind"], &[], "`House`"),
    element(Tag::Loop, "Loop", &["hole", "inner", "start"], &[], "`Storey`"),
    element(Tag::Row, "Row", &["turn"], &[], "`Storey` or `Loop`"),
    element(Tag::Part, "Part", &["code", "width", "height"], &["code"], "`Row`, `Floor`, `upper` or `lower`"),
    element(Tag::Structure, "Structure", &["size", "scale", "order"], &[],
        "`House`, or is the outermost element"),
    element(Tag::Facades, "Facades", &[], &[], "`Structure`"),
    element(Tag::Facade, "Facade", &["id", "ratio", "angle", "reflection"], &[], "`Facades`"),
    element(Tag::Floor, "Floor", &["id", "height", "kind"], &[], "`Facade`"),
    element(Tag::Repeat, "repeat", &["num"], &["num"],
        "`House`, `Storey`, `Loop`, `Row`, `Facades`, `Facade`, `Floor`, `upper` or `lower`"),
    element(Tag::Split, "split", &["ratio"], &[], "`Row`, `Floor`, `upper` or `lower`"),
    element(Tag::Upper, "upper", &[], &[], "`split`"),
    element(Tag::Lower, "lower", &[], &[], "`split`"),
    element(Tag::Random, "random", &["code", "weights"], &["code"], "`Storey`, `Row`, `Facade` or `Floor`"),
    element(Tag::Choice, "choice", &["weight"], &[], "`random`"),
    element(Tag::Replace, "replace", &["code", "with", "at"], &["with"], "`Storey`, `Row`, `Facade` or `Floor`"),
    element(Tag::Texture, "Texture", &["code", "reflection", "src"], &["code"], "`House` or `Structure`"),
    element(Tag::Roofs, "Roofs", &["mode", "method", "kind", "shape", "pitch", "eaves", "verge", "thickness",
        "noshi", "sori", "gable", "ratio", "plain_ridge"], &[], "`House`"),
    element(Tag::Roof, "Roof", &["a0", "b0", "a1", "b1", "ridge", "height", "kind", "shape", "pitch", "eaves",
        "verge", "thickness", "noshi", "sori", "gable", "ratio", "plain_ridge"], &["a0", "b0", "a1", "b1"], "`Roofs`"),
    element(Tag::Platform, "Platform", &["height", "margin", "stairs", "width"], &[], "`House`"),
    element(Tag::Posts, "Posts", &["size", "round", "paint", "nageshi"], &[], "`House` or `Storey`"),
    element(Tag::Veranda, "Veranda", &["width", "height", "rail", "stairs", "paint"], &[], "`Storey`"),
    element(Tag::Brackets, "Brackets", &["steps", "height", "out", "paint"], &[], "`House` or `Storey`"),
    element(Tag::Finial, "Finial", &["kind", "height", "count", "at"], &["kind"], "`House`"),
    element(Tag::Pagoda, "Pagoda", &["storeys", "width", "bays", "taper", "rise", "sorin", "columns", "post", "paint",
        "steps", "pitch", "eaves", "sori", "thickness", "kind", "shape", "platform", "margin"], &[], "`House`"),
    element(Tag::Gate, "Gate", &["bays", "bay", "storeys", "doors", "inset", "upper", "columns", "post", "paint",
        "steps", "pitch", "eaves", "sori", "thickness", "kind", "shape", "platform", "margin"], &[], "`House`"),
    element(Tag::Hall, "Hall", HALL, &[], "`House`"),
    element(Tag::Shrine, "Shrine", HALL, &[], "`House`"),
    element(Tag::Catalog, "Catalog", &[], &[], "nothing: it is the outermost element"),
    element(Tag::Param, "Param", &["name", "default", "min", "max", "step", "choices", "random", "weights",
        "unit", "doc"], &["name"],
        "`House`, `Houses`, `Structure`, `Catalog` or `define`"),
    element(Tag::Let, "let", &["name", "value"], &["name", "value"], ANY),
    element(Tag::Define, "define", &["name"], &["name"], ANY),
    element(Tag::Use, "use", &["name"], &["name"], ANY),
    element(Tag::If, "if", &["test"], &["test"], ANY),
    element(Tag::Else, "else", &["test"], &[], ANY),
    element(Tag::Include, "include", &["href"], &["href"], ANY),
    later("PartDef"),
];

const fn content(tags: &'static [Tag]) -> Content {
    Content { tags, text: false }
}

pub(super) static ROOT: Content = content(&[Tag::House, Tag::Houses, Tag::Structure, Tag::Catalog]);
pub(super) static HOUSES: Content = content(&[Tag::House]);
pub(super) static HOUSE: Content = content(&[
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
    Tag::Pagoda,
    Tag::Gate,
    Tag::Hall,
    Tag::Shrine,
]);
pub(super) static STOREYS: Content =
    content(&[Tag::Storey, Tag::Repeat, Tag::Random, Tag::Replace]);
pub(super) static STOREY: Content = content(&[
    Tag::Row,
    Tag::Loop,
    Tag::Repeat,
    Tag::Random,
    Tag::Replace,
    Tag::Posts,
    Tag::Veranda,
    Tag::Brackets,
]);
pub(super) static ROWS: Content = content(&[Tag::Row, Tag::Repeat, Tag::Random, Tag::Replace]);
pub(super) static PIECES: Content = Content {
    tags: &[
        Tag::Part,
        Tag::Repeat,
        Tag::Split,
        Tag::Random,
        Tag::Replace,
    ],
    text: true,
};
/// A floor may hold its base row as a `Row` too (domain.md 8).
pub(super) static FLOOR: Content = Content {
    tags: &[
        Tag::Part,
        Tag::Repeat,
        Tag::Split,
        Tag::Random,
        Tag::Replace,
        Tag::Row,
    ],
    text: true,
};
pub(super) static SPLIT: Content = content(&[Tag::Upper, Tag::Lower]);
pub(super) static STRUCTURE: Content = content(&[Tag::Facades, Tag::Texture]);
pub(super) static FACADES: Content =
    content(&[Tag::Facade, Tag::Repeat, Tag::Random, Tag::Replace]);
pub(super) static FACADE: Content = content(&[Tag::Floor, Tag::Repeat, Tag::Random, Tag::Replace]);
pub(super) static ROOFS: Content = content(&[Tag::Roof]);
pub(super) static NOTHING: Content = content(&[]);

/// The element of a name.
pub(super) fn named(name: &str) -> Option<&'static Schema> {
    ELEMENTS.iter().find(|e| e.name == name)
}

/// The attribute that a name stands for.
pub(super) fn canonical(attribute: &str) -> &str {
    match attribute {
        "texturecode" => "code",
        other => other,
    }
}

/// The attribute meant by a word that other programs use for it.
pub(super) fn meant(tag: Tag, word: &str) -> Option<&'static str> {
    let counts = ["count", "times", "n", "number", "repeat"];
    (tag == Tag::Repeat && counts.iter().any(|c| word.eq_ignore_ascii_case(c))).then_some("num")
}

/// What the tree must know to recover well.
pub(super) static HABITS: Habits = Habits {
    leaf: |name| {
        let leaves = [
            "Part", "random", "replace", "Texture", "Roof", "Platform", "Posts", "Veranda",
            "Brackets", "Finial", "Pagoda", "Gate", "Hall", "Shrine", "Param", "let", "use",
            "include",
        ];
        leaves.contains(&name)
    },
    alone: |name| {
        let nests = ["repeat", "split", "upper", "lower", "if", "else", "define"];
        !nests.contains(&name) && named(name).is_some_and(|e| e.tag != Tag::Later)
    },
    known: |name| named(name).is_some(),
};
