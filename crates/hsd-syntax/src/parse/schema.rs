//! The elements of the language: their attributes and content (docs/contract.md 3). All messages of the reader about
//! unknown words, wrong places and values come from these tables; the schemas in `grammar/schema` and the reference are
//! generated from them.

pub(in crate::parse) mod attributes;
mod contents;
mod kinds;
pub mod lengths;
pub(in crate::parse) mod vocabulary;

use attributes as bear;
use attributes::town;
pub(in crate::parse) use contents::*;
pub use contents::{Content, ROOT};
pub use kinds::{AttributeSchema, Kind};
use std::sync::LazyLock;

/// An element of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::parse) enum Tag {
    Town,
    Layer,
    Field,
    Join,
    Divide,
    Table,
    For,
    Skip,
    Rear,
    Road,
    Rail,
    Tree,
    Fence,
    Hedge,
    Wall,
    Pole,
    Network,
    Wire,
    Signal,
    Sign,
    Arcade,
    Torii,
    Lantern,
    Water,
    Farmland,
    Residence,
    Block,
    Zone,
    Envelope,
    Tiles,
    Houses,
    Group,
    Place,
    View,
    House,
    Outline,
    Hole,
    Storey,
    Walls,
    SideWall,
    Fill,
    Door,
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
    Room,
    Fixture,
    Brackets,
    Finial,
    Put,
    Ground,
    Pagoda,
    Gate,
    Hall,
    Shrine,
    PartDef,
}

/// Returns true if an element is evaluated before the document is read: conditions, definitions, inclusions.
pub(in crate::parse) fn is_language(tag: Tag) -> bool {
    use Tag::{Define, Else, If, Include, Let, Param, Use};
    matches!(tag, Define | Else | If | Include | Let | Param | Use)
}

/// The properties of a language's elements that error recovery needs.
#[derive(Clone, Copy)]
pub(in crate::parse) struct SchemaHints {
    /// True for an element that never has content.
    pub(in crate::parse) leaf: fn(&str) -> bool,
    /// True for an element that is never a direct child of another of its name.
    pub(in crate::parse) alone: fn(&str) -> bool,
    /// True for an element of the language.
    pub(in crate::parse) known: fn(&str) -> bool,
    /// True for an element and a required attribute of it.
    pub(in crate::parse) needs: fn(&str, &str) -> bool,
    /// True for an element and an attribute of it with the values yes and no.
    pub(in crate::parse) switch: fn(&str, &str) -> bool,
    /// Returns the element that contains several elements of these names, if there is one.
    pub(in crate::parse) around: fn(&[&str]) -> Option<&'static str>,
}

/// The schema of an element.
#[derive(Debug)]
pub struct Schema {
    pub(in crate::parse) tag: Tag,
    /// Its name.
    pub name: &'static str,
    /// Attributes it may have.
    pub attributes: &'static [AttributeSchema],
    /// The allowed content.
    pub holds: Holds,
    /// Its place, for the message about a misplaced one.
    pub home: &'static str,
    /// The English name.
    pub en: &'static str,
    /// The same in Japanese.
    pub ja: &'static str,
}

/// The allowed content of an element.
#[derive(Clone, Copy, Debug)]
pub enum Holds {
    /// This content.
    Only(&'static Content),
    /// The repeated content of the element around it.
    Repeated,
    /// The same content as in the parent element.
    Same,
    /// The content of a definition.
    Anything,
    /// Body elements, which only the catalogue defines.
    Shapes,
    /// `choice` elements with the same content as the parent element; or nothing.
    Choices,
}

impl Schema {
    /// Returns the attribute of a name.
    pub fn attribute(&self, name: &str) -> Option<&'static AttributeSchema> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// Returns the required attributes.
    pub(in crate::parse) fn required(&self) -> impl Iterator<Item = &'static str> + Clone + use<> {
        let all = self.attributes.iter();
        all.filter(|a| a.required).map(|a| a.name)
    }

    /// Returns its allowed content, excluding elements of the language; nothing if that depends on the parent element.
    pub(in crate::parse) fn content(&self) -> &'static Content {
        match self.holds {
            Only(content) => content,
            Repeated | Same | Anything | Choices | Shapes => &NOTHING,
        }
    }

    /// Returns true if it never contains elements or text, regardless of its parent.
    pub fn is_leaf(&self) -> bool {
        matches!(self.holds, Holds::Only(content) if content.is_nothing())
    }

    /// Returns true if `Param` may be a direct child.
    pub fn takes_parameters(&self) -> bool {
        use Tag::{Catalog, Define, House, Houses, Structure, Town};
        matches!(
            self.tag,
            Catalog | Define | House | Houses | Structure | Town
        )
    }

    /// Returns true if its other attributes are parameters of a definition.
    pub fn takes_any_attribute(&self) -> bool {
        matches!(self.tag, Tag::Define | Tag::Place | Tag::Use)
    }

    /// Returns true for `choice`, the element inside a `random`.
    pub fn is_choice(&self) -> bool {
        self.tag == Tag::Choice
    }

    /// Returns true for `else`, the element after an `if`.
    pub fn is_else(&self) -> bool {
        self.tag == Tag::Else
    }

    /// Returns true if it is evaluated before everything else, and so may appear anywhere.
    pub fn is_language(&self) -> bool {
        is_language(self.tag)
    }
}

const fn element(
    tag: Tag,
    name: &'static str,
    attributes: &'static [AttributeSchema],
    holds: Holds,
    home: &'static str,
    about: [&'static str; 2],
) -> Schema {
    let [en, ja] = about;
    Schema {
        tag,
        name,
        attributes,
        holds,
        home,
        en,
        ja,
    }
}

/// The place of elements of [`language`](crate::parse::xml::language).
const ANY: &str = "any element";

use Holds::{Anything, Choices, Only, Repeated, Same, Shapes};

/// All elements.
#[rustfmt::skip]
pub static ELEMENTS: &[Schema] = &[
    element(Tag::Town, "Town", town::TOWN, Only(&TOWN), "nothing: it is the outermost element",
        ["a town: layers of maps, and what is made of each thing on them", "町。地図のレイヤーと、その地物から作るもの"]),
    element(Tag::Layer, "Layer", town::LAYER, Only(&LAYER), "`Town`",
        ["the features of a map: areas, lines or points", "地図の地物。面、線、点"]),
    element(Tag::Field, "Field", town::FIELD, Only(&NOTHING), "`Layer`",
        ["a field of the features that is renamed, converted or filled", "名を変え、変換し、補う属性"]),
    element(Tag::Join, "Join", town::JOIN, Only(&NOTHING), "`Layer`",
        ["a layer of points whose fields become fields of the outlines that they lie in", "点のレイヤー。その属性が、点の入る輪郭の属性になる"]),
    element(Tag::Divide, "Divide", town::DIVIDE, Only(&NOTHING), "`Town`",
        ["the areas of a layer divided into blocks, streets, plots and yards, each a layer of its own", "レイヤーの面を町割りする。街区、通り、敷地、会所地がそれぞれレイヤーになる"]),
    element(Tag::Table, "Table", town::TABLE, Only(&NOTHING), "`Town`",
        ["a table of values, which `look` reads", "`look` で引く値の表"]),
    element(Tag::For, "for", town::FOR, Only(&FOR), "`Town`",
        ["its content once for each feature of a layer", "レイヤーの地物ごとに中身を一度ずつ作る"]),
    element(Tag::Skip, "Skip", town::SKIP, Only(&NOTHING), "`for`",
        ["nothing is wanted of this feature", "この地物からは何も作らない"]),
    element(Tag::Rear, "Rear", town::REAR, Only(&NOTHING), "`for`",
        ["what stands behind the house of a lot: storehouse and dwelling of its owner, or rows of dwellings along an alley", "敷地の家の裏に立つもの。蔵と離れ、または路地に沿う裏長屋"]),
    element(Tag::Road, "Road", town::ROAD, Only(&NOTHING), "`for`",
        ["a road along a line, or over an area: its surface, pavements, drains and lines", "線に沿う、または面を覆う道。路面、歩道、溝、区画線"]),
    element(Tag::Rail, "Rail", town::RAIL, Only(&NOTHING), "`for`",
        ["a railway along a line: ballast, sleepers and rails", "線に沿う線路。道床、枕木、レール"]),
    element(Tag::Tree, "Tree", town::TREE, Only(&NOTHING), "`for`",
        ["a tree at a point, or trees along a line or over an area", "点に立つ木。線や面なら並木や林"]),
    element(Tag::Fence, "Fence", town::FENCE, Only(&NOTHING), "`for`",
        ["a fence along a line, or round an area: whole units, left of the line is outside", "線に沿う、または面を囲む柵。単位を整数個並べ、線の左が外になる"]),
    element(Tag::Hedge, "Hedge", town::HEDGE, Only(&NOTHING), "`for`",
        ["the same of evergreens", "同じく生垣"]),
    element(Tag::Wall, "Wall", town::WALL, Only(&NOTHING), "`for`",
        ["the same of earth under tiles", "同じく築地塀"]),
    element(Tag::Pole, "Pole", town::POLE, Only(&NOTHING), "`for`",
        ["a pole at a point, or poles along a line with wires between them", "点に立つ柱、または線に沿う柱と電線"]),
    element(Tag::Network, "Network", town::NETWORK, Only(&NOTHING), "`for`",
        ["poles and wires along a street that reach every house beside it", "通りに沿い、すべての家に届く柱と電線"]),
    element(Tag::Wire, "Wire", town::WIRE, Only(&NOTHING), "`for`",
        ["wires along a line, from corner to corner", "線の点から点へ張る電線"]),
    element(Tag::Signal, "Signal", town::SIGNAL, Only(&NOTHING), "`for`",
        ["traffic signals at a point; those of roads that cross never show the same light", "点に立つ信号機。交わる道どうしは同じ灯火にならない"]),
    element(Tag::Sign, "Sign", town::SIGN, Only(&NOTHING), "`for`",
        ["a sign at a point: a board with a name on a post", "点に立つ標識。名を書いた板と柱"]),
    element(Tag::Arcade, "Arcade", town::ARCADE, Only(&NOTHING), "`for`",
        ["a roof over a pavement along a line, whose left side is the street", "線に沿うアーケード。線の左が通り"]),
    element(Tag::Torii, "Torii", town::TORII, Only(&NOTHING), "`for`",
        ["a torii on a line, which gives its width; it faces to the left of it", "線の上の鳥居。線の長さが幅になり、線の左を向く"]),
    element(Tag::Lantern, "Lantern", town::LANTERN, Only(&NOTHING), "`for`",
        ["a stone lantern on a line, which gives its width; it faces to the left of it", "線の上の石灯籠。線の長さが幅になり、線の左を向く"]),
    element(Tag::Water, "Water", town::WATER, Only(&NOTHING), "`for`",
        ["a river, a moat or a pond: water along a line or over an area, with its banks", "川、堀、池。線に沿う、または面を覆う水と岸"]),
    element(Tag::Farmland, "Farmland", town::FARMLAND, Only(&NOTHING), "`for`",
        ["paddies or dry fields over an area, in a grid that is one for the whole town", "面を覆う田畑。格子は町全体で一つ"]),
    element(Tag::Residence, "Residence", town::RESIDENCE, Only(&NOTHING), "`for`",
        ["a residence on its plot: a house at the centre, a wall along the outline with a gate to the street, and trees", "敷地に建つ屋敷。中央の家、輪郭に沿う塀と通りへの門、庭木"]),
    element(Tag::Block, "Block", town::BLOCK, Only(&NOTHING), "`for`",
        ["a block of Heian-kyo, or a half, a quarter or a plot of one, by its area: halls, wall, gate and garden", "平安京の町、またはその半分・四分の一・一戸分を、面積に応じて建てる。殿舎、塀、門、庭"]),
    element(Tag::Zone, "Zone", town::ZONE, Only(&NOTHING), "`for`",
        ["the terms of building law over an area, for the envelopes of the lots in it", "面にかかる建築の規制。中の敷地のエンベロープがこれに従う"]),
    element(Tag::Envelope, "Envelope", town::ENVELOPE, Only(&NOTHING), "`for`",
        ["the solid that building law lets stand on a lot: under the slant lines of its roads and of adjacent land and the greatest height; no legal opinion", "敷地に建てられる最大の立体。前面道路と隣地の斜線、高さの限度の下。法的な判断ではない"]),
    element(Tag::Tiles, "Tiles", town::TILES, Only(&NOTHING), "`Town`",
        ["how the model of the town is divided", "町のモデルの分け方"]),
    element(Tag::Houses, "Houses", bear::HOUSES, Only(&HOUSES), "nothing: it is the outermost element",
        ["several houses in one file", "一つのファイルに書いた複数の建物"]),
    element(Tag::Group, "Group", bear::GROUP, Only(&HOUSES), "`Houses` or `Group`",
        ["houses that are moved and turned together", "まとめて動かし、回す建物"]),
    element(Tag::Place, "Place", bear::PLACEMENT, Only(&PLACE), "`Houses`, `Group` or `for`",
        ["a house that is written elsewhere, at a place of its own", "別の場所に書いた建物を、この位置に置く"]),
    element(Tag::View, "View", bear::VIEW, Only(&NOTHING), "`Houses` or `Group`",
        ["a camera with a name: `hsd render --view NAME` takes its picture", "名の付いたカメラ。`hsd render --view NAME` で写す"]),
    element(Tag::House, "House", bear::HOUSE, Only(&HOUSE), "`Houses`, `Group` or `for`, or is the outermost element",
        ["a house: storeys or facades from the ground up, then roofs", "建物。下の階から順に書き、最後に屋根を書く"]),
    element(Tag::Outline, "Outline", bear::OUTLINE, Only(&OUTLINE), "`House` or `Place`",
        ["the outline of the house in metres: the walls of every storey without rows of its own", "メートルで測った建物の輪郭。行の無い階の壁になる"]),
    element(Tag::Hole, "Hole", bear::HOLE, Only(&NOTHING), "`Outline`",
        ["a courtyard in the outline", "輪郭の中の中庭"]),
    element(Tag::Storey, "Storey", bear::STOREY, Only(&STOREY), "`House`",
        ["a storey; the rows right in it are one closed walk", "階。直下の行がひと回りの壁になる"]),
    element(Tag::Walls, "Walls", bear::WALLS, Only(&WALLS), "`Storey`",
        ["what stands on the sides of the outline, in place of rows", "輪郭の各辺に立つもの。行の代わりに書く"]),
    element(Tag::SideWall, "Side", bear::SIDE_WALL, Only(&SIDE_WALL), "`Walls`",
        ["the wall of all sides of a kind: its first parts, `fill`, its last parts", "同じ種類の辺の壁。始めの部材、`fill`、終わりの部材"]),
    element(Tag::Fill, "fill", &[], Only(&PIECES), "`Side`",
        ["parts that are repeated, and stretched by up to 8 per cent, until the side is full", "辺が埋まるまで繰り返す部材。幅は8%まで伸び縮みする"]),
    element(Tag::Door, "door", &[], Only(&PIECES), "`Side`",
        ["parts that stand once in the house, on the front if it is such a side", "建物に一度だけ置く部材。正面がその種類の辺なら正面に置く"]),
    element(Tag::Loop, "Loop", bear::LOOP, Only(&ROWS), "`Storey`",
        ["a closed walk of its own: a courtyard, or a wall inside", "独立したひと回りの壁。中庭や内側の壁"]),
    element(Tag::Row, "Row", bear::ROW, Only(&PIECES), "`Storey` or `Loop`",
        ["a wall line: codes of five columns, parts, operations", "壁の一行。五桁のコード、部材、操作を並べる"]),
    element(Tag::Part, "Part", bear::PART, Only(&NOTHING), "`Row`, `Floor`, `upper` or `lower`",
        ["one part", "部材ひとつ"]),
    element(Tag::Structure, "Structure", bear::STRUCTURE, Only(&STRUCTURE), "`House`, or is the outermost element",
        ["walls given facade by facade", "壁面ごとに与える構造"]),
    element(Tag::Facades, "Facades", &[], Only(&FACADES), "`Structure`",
        ["the facades, clockwise seen from above", "壁面の列。上から見て時計回り"]),
    element(Tag::Facade, "Facade", bear::FACADE, Only(&FACADE), "`Facades`",
        ["one plane wall, floor by floor from the ground up", "壁面ひとつ。下の階から順に書く"]),
    element(Tag::Floor, "Floor", bear::FLOOR, Only(&FLOOR), "`Facade`",
        ["one storey of a facade", "壁面の一階分"]),
    element(Tag::Repeat, "repeat", bear::REPEAT, Repeated, "`Houses`, `Group`, `House`, `Storey`, `Loop`, `Row`, `Facades`, `Facade`, `Floor`, `upper` or `lower`",
        ["its content several times", "中身の繰り返し"]),
    element(Tag::Split, "split", bear::SPLIT, Only(&SPLIT), "`Row`, `Floor`, `upper` or `lower`",
        ["one place of a wall divided into an upper and a lower half of the same width", "壁の一か所を同じ幅の上下に分ける"]),
    element(Tag::Upper, "upper", &[], Only(&PIECES), "`split`",
        ["the upper half", "上の部分"]),
    element(Tag::Lower, "lower", &[], Only(&PIECES), "`split`",
        ["the lower half", "下の部分"]),
    element(Tag::Random, "random", bear::RANDOM, Choices, "`Houses`, `Group`, `for`, `Storey`, `Row`, `Facade` or `Floor`",
        ["draws one code of a list, or one `choice` of anything", "コードのひとつ、または `choice` のひとつを抽選する"]),
    element(Tag::Choice, "choice", bear::CHOICE, Same, "`random`",
        ["what stands in the place of its `random` if it is drawn", "抽選で選ばれたときに `random` の場所に置く中身"]),
    element(Tag::Replace, "replace", bear::REPLACE, Only(&NOTHING), "`Storey`, `Row`, `Facade` or `Floor`",
        ["puts other codes in the place of some", "コードを取り替える"]),
    element(Tag::Texture, "Texture", bear::TEXTURE, Only(&NOTHING), "`House` or `Structure`",
        ["the picture that a code means, and its gloss", "コードが表す画像と映り込み"]),
    element(Tag::Roofs, "Roofs", bear::ROOFS, Only(&ROOFS), "`House`",
        ["the roofs of a house, and how automatic ones look", "建物の屋根と、自動屋根の見え方"]),
    element(Tag::Roof, "Roof", bear::ROOF, Only(&NOTHING), "`Roofs`",
        ["a roof over a rectangle", "矩形の上の屋根"]),
    element(Tag::Platform, "Platform", bear::PLATFORM, Only(&NOTHING), "`House`",
        ["a stone platform (kidan) round the ground storey", "基壇"]),
    element(Tag::Posts, "Posts", bear::POSTS, Only(&NOTHING), "`House` or `Storey`",
        ["the posts at the borders of bays", "柱"]),
    element(Tag::Veranda, "Veranda", bear::VERANDA, Only(&NOTHING), "`Storey`",
        ["boards round a storey, with a railing or none", "縁"]),
    element(Tag::Room, "Room", bear::ROOM, Only(&NOTHING), "`Storey`",
        ["a room: the area that walls, outer and inner, enclose round a point", "部屋。ある点のまわりで外壁と内壁が囲む範囲"]),
    element(Tag::Fixture, "Fixture", bear::FIXTURE, Only(&NOTHING), "`Storey`",
        ["what is built into a room: tokonoma, closet, stairs, stove", "造り付け。床の間、押入、階段、竈など"]),
    element(Tag::Brackets, "Brackets", bear::BRACKETS, Only(&NOTHING), "`House` or `Storey`",
        ["bracket complexes (kumimono) on the posts", "組物"]),
    element(Tag::Finial, "Finial", bear::FINIAL, Only(&NOTHING), "`House`",
        ["what crowns a roof", "屋根の飾り"]),
    element(Tag::Put, "Put", bear::PUT, Only(&NOTHING), "`House`",
        ["a part that stands by itself on the ground: lantern, tree, well, bench", "地面に独りで立つ部材。石灯籠、木、井戸、縁台など"]),
    element(Tag::Ground, "Ground", bear::GROUND, Only(&NOTHING), "`House`",
        ["a rectangle of gravel, sand, moss, grass, paving or earth beside the house", "建物のそばの地面。砂利、白砂、苔、芝、敷石、土のどれか"]),
    element(Tag::Pagoda, "Pagoda", bear::PAGODA, Only(&NOTHING), "`House`",
        ["a pagoda in place of all storeys", "塔。階の代わりに書く"]),
    element(Tag::Gate, "Gate", bear::GATE, Only(&NOTHING), "`House`",
        ["a gate in place of all storeys", "門。階の代わりに書く"]),
    element(Tag::Hall, "Hall", bear::HALL, Only(&NOTHING), "`House`",
        ["a temple hall in place of all storeys", "仏堂。階の代わりに書く"]),
    element(Tag::Shrine, "Shrine", bear::SHRINE, Only(&NOTHING), "`House`",
        ["a shrine in place of all storeys", "社殿。階の代わりに書く"]),
    element(Tag::Catalog, "Catalog", &[], Only(&DEFINITIONS), "nothing: it is the outermost element",
        ["parameters, names, pieces and parts for other files", "ほかのファイルのための変数、名、部品、部材"]),
    element(Tag::Param, "Param", bear::PARAM, Only(&NOTHING), "`House`, `Houses`, `Town`, `Structure`, `Catalog` or `define`",
        ["a parameter, set by `--param` or by `use`", "変数。`--param` や `use` で指定する"]),
    element(Tag::Let, "let", bear::LET, Only(&NOTHING), ANY,
        ["a name for a value", "値に名を付ける"]),
    element(Tag::Define, "define", bear::DEFINE, Anything, ANY,
        ["a named piece of anything", "名の付いた部品"]),
    element(Tag::Use, "use", bear::USE, Only(&NOTHING), ANY,
        ["a piece in its place", "部品をそこに置く"]),
    element(Tag::If, "if", bear::IF, Same, ANY,
        ["counts as what it holds where its test is true", "条件が真なら中身を生かす"]),
    element(Tag::Else, "else", bear::ELSE, Same, ANY,
        ["the other case of the `if` or `else` right before it", "直前の `if` か `else` でないとき"]),
    element(Tag::Include, "include", bear::INCLUDE, Only(&NOTHING), ANY,
        ["what another file defines", "ほかのファイルの定義を読み込む"]),
    element(Tag::PartDef, "PartDef", bear::PART_DEF, Shapes, "`Catalog`, `House` or `Houses`",
        ["a part of one's own, from elements of shape and changes of its base", "自分の部材。形の要素と base の変更で作る"]),
];

/// Returns the element of a name.
pub fn named(name: &str) -> Option<&'static Schema> {
    const SLOTS: usize = 256;
    /// By first and last letter and length: every element of every house of a town is asked for several times, and a slot has
    /// hardly more than one name.
    static BY_SHAPE: LazyLock<Vec<Vec<&Schema>>> = LazyLock::new(|| {
        let mut slots = vec![vec![]; SLOTS];
        for element in ELEMENTS {
            slots[shape(element.name)].push(element);
        }
        slots
    });
    fn shape(name: &str) -> usize {
        let [first, last] = [name.bytes().next(), name.bytes().next_back()];
        let of = |letter: Option<u8>| usize::from(letter.unwrap_or(0));
        (7 * of(first) + 31 * of(last) + 3 * name.len()) % SLOTS
    }
    let slot = BY_SHAPE[shape(name)].iter();
    slot.copied().find(|element| element.name == name)
}

/// Returns true for an attribute of a `Place` that sets, or may set, a parameter of the type: `front` does unless it names a
/// layer of streets.
pub fn is_parameter_of_place(name: &str) -> bool {
    name == "front" || named("Place").is_some_and(|place| place.attribute(name).is_none())
}

/// Returns the canonical name of an attribute.
pub(in crate::parse) fn canonical(attribute: &str) -> &str {
    match attribute {
        "texturecode" => "code",
        other => other,
    }
}

/// Returns the schema of an element's attribute.
fn borne(element: &str, attribute: &str) -> Option<&'static AttributeSchema> {
    named(element)?.attribute(canonical(attribute))
}

/// Returns the attribute meant by a word that other programs use for it.
pub(in crate::parse) fn meant(tag: Tag, word: &str) -> Option<&'static str> {
    let is = |words: &[&str]| words.iter().any(|w| word.eq_ignore_ascii_case(w));
    match tag {
        Tag::Repeat => is(&["count", "times", "n", "number", "repeat"]).then_some("num"),
        Tag::Roofs | Tag::Roof => is(ROOFING).then_some("kind"),
        _ => None,
    }
}

/// Words for the covering of roofs, which is the `kind` of `Roofs`.
pub(in crate::parse) const ROOFING: &[&str] = &["roof", "roofs", "roofing", "covering"];

/// The hints for recovery from the tables of elements.
pub(in crate::parse) static SCHEMA_HINTS: SchemaHints = SchemaHints {
    leaf: |name| {
        let leaf = |e: &Schema| match e.holds {
            Only(content) => content.is_nothing(),
            Choices => true,
            Repeated | Same | Anything | Shapes => false,
        };
        named(name).is_some_and(leaf)
    },
    alone: |name| {
        let nests = [
            "Group", "repeat", "split", "upper", "lower", "if", "else", "define",
        ];
        !nests.contains(&name) && named(name).is_some()
    },
    known: |name| named(name).is_some(),
    needs: |element, name| borne(element, name).is_some_and(|a| a.required),
    switch: |element, name| borne(element, name).is_some_and(|a| a.kind == Kind::YesNo),
    around: |names| {
        let fits = |name: &&str| named(name).is_some_and(|s| HOUSES.tags.contains(&s.tag));
        names.iter().all(fits).then_some("Houses")
    },
};
