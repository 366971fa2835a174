//! Descriptions of the language's words: values, roof lines, the legacy header, and letters of classes.

pub(super) mod fields;
mod measures;
mod shapes;
mod stuffs;

pub(super) use measures::MEASURES;
pub(super) use shapes::SHAPES;
pub(super) use stuffs::STUFFS;

use hsd_base::diagnostic::{Noun, noun};
use hsd_base::source::Source;
use hsd_syntax::parse::meanings;

/// Words with their descriptions.
pub(super) type Table = [(&'static str, Noun)];

/// The covering of a roof.
pub(super) const COVERINGS: &Table = &meanings::nouns(&meanings::COVERINGS);

/// The forms of roofs.
pub(super) const ROOF_SHAPES: &Table = &meanings::nouns(&meanings::SHAPES);

/// Ridges and falls.
pub(super) const DIRECTIONS: &Table = &meanings::nouns(&meanings::DIRECTIONS);

/// The option letters of a roof line.
pub(super) const OPTIONS: &Table = &[
    ("P", noun("pitch in sun: 4 = 4 in 10", "勾配(寸)")),
    ("E", noun("overhang at the eaves, shaku", "軒の出(尺)")),
    ("G", noun("overhang at the verge, shaku", "けらばの出(尺)")),
    ("T", noun("thickness, shaku", "屋根の厚さ(尺)")),
    ("M", noun("courses of ridge tiles (noshi)", "熨斗瓦の段数")),
    (
        "S",
        noun(
            "sagitta of the slope in per cent of its length (sori); negative = convex (mukuri)",
            "反り。流れ長さに対する矢高(%)。負は起り",
        ),
    ),
    (
        "C",
        noun(
            "how far an irimoya's gable stands inside its walls, share of the span",
            "入母屋の妻の引っ込み。梁間に対する割合",
        ),
    ),
    (
        "R",
        noun(
            "length of a hip's ridge, share of the roof's length",
            "寄棟の棟の長さ。屋根の長さに対する割合",
        ),
    ),
    ("O", noun("no ridge-end tile (onigawara)", "鬼瓦を置かない")),
];

/// The keys of the legacy header.
pub(super) const KEYS: &Table = &[
    ("name", noun("any text: the house's name", "建物の名")),
    (
        "unit",
        noun(
            "one unit in shaku: 3.0 (Edo-ma), 3.15, 3.25 (Kyo-ma)",
            "1ユニットの長さ(尺)。3.0(江戸間)、3.15、3.25(京間)",
        ),
    ),
    ("seed", noun("key of the draws", "抽選の種")),
    (
        "roofs",
        noun(
            "which roofs stand: written ones and automatic ones, or only the written ones",
            "どの屋根を建てるか。書いた屋根と自動屋根、または書いた屋根だけ",
        ),
    ),
    (
        "method",
        noun("how plans are divided into roofs", "平面を屋根に分ける方法"),
    ),
    (
        "street",
        noun(
            "whether the first line stands on the street: its roof's ridge runs along it",
            "最初の行が通りに面するか(平入りになる)",
        ),
    ),
    (
        "age",
        noun(
            "years since it was built: it has weathered",
            "築年数。経年変化を表す",
        ),
    ),
    (
        "era",
        noun(
            "when it was built; with `age`",
            "建てた時代。`age` とともに書く",
        ),
    ),
];

/// Letters at the end of a wall line.
pub(super) const TURNS: &Table = &[
    (
        "L",
        noun("turn left: an inner corner (irisumi)", "左へ曲がる(入隅)"),
    ),
    (
        "R",
        noun("turn right: an outer corner (desumi)", "右へ曲がる(出隅)"),
    ),
    (
        "^",
        noun(
            "the storey ends; the next one begins above its start",
            "階が終わり、この上に次の階が始まる",
        ),
    ),
];

const MODES: &Table = &[
    (
        "auto",
        noun(
            "the written roofs, and automatic ones for the rest",
            "書いた屋根と残りの自動屋根",
        ),
    ),
    ("explicit", noun("only the written roofs", "書いた屋根だけ")),
];
const METHODS: &Table = &[
    (
        "least-cut",
        noun("least roof is cut", "屋根の切断を最小にする"),
    ),
    (
        "kd",
        noun("the published method of kD-roofing", "kD-roofing の方法"),
    ),
    (
        "kd-branches",
        noun(
            "the division of kD-roofing, with branches and lean-tos",
            "kD-roofing の分け方に、枝と下屋の規則を加える",
        ),
    ),
    (
        "branch-cut",
        noun("branches cut off one after the other", "枝を順に切り離す"),
    ),
    (
        "skeleton",
        noun(
            "one hipped roof over the whole outline, by its straight skeleton",
            "全体に一つの寄棟(ストレートスケルトン)",
        ),
    ),
];
const TRUTHS: &Table = &[
    ("yes", noun("it does", "はい")),
    ("no", noun("it does not", "いいえ")),
];
pub(super) const ERAS: &Table = &meanings::nouns(&meanings::ERAS);
const PAINTS: &Table = &meanings::nouns(&meanings::PAINTS);
const RAILS: &Table = &meanings::nouns(&meanings::RAILS);
const GABLE_WALLS: &Table = &meanings::nouns(&meanings::GABLE_WALLS);
const FINIALS: &Table = &meanings::nouns(&meanings::FINIALS);
const FIXTURES: &Table = &meanings::nouns(&meanings::FIXTURES);
const SIDES: &Table = &meanings::nouns(&meanings::SIDES);
const STOREYS: &Table = &[
    (
        "storey",
        noun("rooms, and a roof above them", "部屋のある階"),
    ),
    (
        "parapet",
        noun(
            "a wall round a flat roof; not counted",
            "陸屋根の周りの胸壁。階に数えない",
        ),
    ),
];
const ORDERS: &Table = &[
    ("left", noun("parts run to the left", "部材は左へ並ぶ")),
    ("right", noun("parts run to the right", "部材は右へ並ぶ")),
];
const REFLECTIONS: &Table = &[
    (
        "enable",
        noun("its glass mirrors the neighbours", "ガラスに周囲を映す"),
    ),
    ("disable", noun("its glass mirrors nothing", "映さない")),
];
const STANCES: &Table = &[
    ("posts", noun("between posts that show", "真壁(柱を見せる)")),
    (
        "bare",
        noun("thick plaster over the posts", "大壁(柱を塗り込める)"),
    ),
    (
        "modern",
        noun("a modern wall without posts", "柱のない現代の壁"),
    ),
    ("fence", noun("a fence, no posts of the house", "塀")),
    (
        "none",
        noun("nothing that joins the wall", "壁につながらないもの"),
    ),
];
const BELOWS: &Table = &[
    ("dado", noun("a boarded dado", "腰板")),
    ("wall", noun("the neighbour's wall", "隣の壁")),
    ("open", noun("nothing", "何もない")),
];
const UPPER: &Table = &[("*", noun("the top of the walls there", "そこの壁の上端"))];

/// Returns the words of an attribute, or of a key of the legacy header (`element` is empty then).
pub(super) fn table(element: &str, attribute: &str) -> &'static Table {
    match (element, attribute) {
        ("Storey" | "Floor", "kind") => STOREYS,
        ("Finial", "kind") => FINIALS,
        ("Fixture", "kind") => FIXTURES,
        (_, "kind") => COVERINGS,
        (_, "shape") => ROOF_SHAPES,
        (_, "ridge") => DIRECTIONS,
        (_, "gable_wall") => GABLE_WALLS,
        ("Roof", "height") => UPPER,
        (_, "mode" | "roofs") => MODES,
        (_, "method") => METHODS,
        (_, "era") => ERAS,
        (_, "paint") => PAINTS,
        (_, "rail") => RAILS,
        (_, "stairs" | "faces") => SIDES,
        (_, "turn") => TURNS,
        ("Structure", "order") => ORDERS,
        ("Facade", "reflection") => REFLECTIONS,
        ("PartDef", "stance") => STANCES,
        ("PartDef", "below") => BELOWS,
        ("PartDef", "above" | "fills") => TRUTHS,
        (_, "street" | "hole" | "inner" | "round" | "plain_ridge" | "random" | "test") => TRUTHS,
        _ => &[],
    }
}

/// Returns the description of a word in a table.
pub(super) fn meaning(table: &Table, word: &str) -> Option<Noun> {
    table.iter().find(|(w, _)| *w == word).map(|(_, n)| *n)
}

/// Returns a file name without its folders, which would take most of a line.
pub(super) fn file(source: &Source) -> &str {
    let name = source.name();
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Returns the name of a class of parts.
pub(super) fn class(letter: char) -> Noun {
    match letter {
        'K' => noun("wall", "壁"),
        'T' => noun("door", "戸"),
        'M' => noun("window", "窓"),
        'G' => noun("lattice", "格子"),
        'H' => noun("post", "柱"),
        'A' => noun("opening", "開口"),
        'N' => noun("contemporary", "現代"),
        'O' => noun("outdoors", "屋外"),
        _ => noun("void", "空き"),
    }
}

/// Returns the materials of a weathering class.
pub(super) fn weathering(class: &str) -> Option<Noun> {
    Some(match class {
        "WD" => noun(
            "bare wood: brown, silver, dark grey",
            "素木: 褐色から銀灰色へ",
        ),
        "WB" => noun("stained wood, which fades", "塗った木: 色が褪せる"),
        "WY" => noun("charred wood, which loses its char", "焼いた木: 炭が落ちる"),
        "PL" => noun(
            "lime plaster: grey runs, lost patches",
            "漆喰: 雨垂れと剥落",
        ),
        "CL" => noun("clay: washed grooves", "土: 雨に洗われた溝"),
        "TI" => noun(
            "fired tile: the silver goes, lichen comes",
            "瓦: 銀色が失せ苔がつく",
        ),
        "PA" => noun("paper: yellow within two years", "紙: 二年で黄ばむ"),
        "CT" => noun(
            "dyed cloth: fades within five years",
            "染めた布: 五年で褪せる",
        ),
        "AL" => noun("aluminium: dirt under joints", "アルミ: 継目の下の汚れ"),
        "GL" => noun("glass: dust", "ガラス: ほこり"),
        "ST" => noun("painted steel: rust", "塗った鋼: 錆"),
        "MO" => noun(
            "mortar and concrete: dirt and hair cracks",
            "モルタル: 汚れと細かなひび",
        ),
        _ => return None,
    })
}

/// Descriptions of the functions of expressions.
pub(super) const FUNCTIONS: &Table = &[
    (
        "min",
        noun("min(a, b, ...): the least", "min(a, b, ...): 最小値"),
    ),
    (
        "max",
        noun("max(a, b, ...): the greatest", "max(a, b, ...): 最大値"),
    ),
    (
        "floor",
        noun("floor(a): rounded down", "floor(a): 切り捨て"),
    ),
    ("ceil", noun("ceil(a): rounded up", "ceil(a): 切り上げ")),
    (
        "round",
        noun(
            "round(a): rounded, halves away from 0",
            "round(a): 四捨五入",
        ),
    ),
    ("abs", noun("abs(a): without its sign", "abs(a): 絶対値")),
    (
        "clamp",
        noun(
            "clamp(a, least, most): a, held between the two",
            "clamp(a, 下限, 上限): 範囲に収めた値",
        ),
    ),
    (
        "sin",
        noun("sin(a): the sine of degrees", "sin(a): 正弦（度）"),
    ),
    (
        "cos",
        noun("cos(a): the cosine of degrees", "cos(a): 余弦（度）"),
    ),
    (
        "tan",
        noun("tan(a): the tangent of degrees", "tan(a): 正接（度）"),
    ),
    (
        "atan2",
        noun(
            "atan2(y, x): the angle of a direction, degrees",
            "atan2(y, x): 方向の角度（度）",
        ),
    ),
    ("sqrt", noun("sqrt(a): the square root", "sqrt(a): 平方根")),
    (
        "if",
        noun(
            "if(test, a, b): a where the test holds, else b",
            "if(条件, a, b): 条件が成り立てば a、そうでなければ b",
        ),
    ),
    (
        "draw",
        noun(
            "draw(a, b): in a `for`, a random number from a to b that belongs to the place",
            "draw(a, b): `for` の中で、場所に固有の a から b の乱数",
        ),
    ),
    (
        "look",
        noun(
            "look(table, key, column): in a `for`, a cell of a table",
            "look(表, キー, 列): `for` の中で、表の値",
        ),
    ),
];

/// Returns the values of a parameter as a line shows them.
pub(crate) fn bounds(choices: &str, min: &str, max: &str) -> String {
    match (choices, min, max) {
        ("", "", "") => String::new(),
        ("", min, max) => format!(" [{min}..{max}]"),
        (choices, ..) => format!(" [{choices}]"),
    }
}
