//! The attributes of the elements of towns (docs/contract.md 10).

mod law;
mod outdoors;

pub(in crate::parse::schema) use law::{ENVELOPE, ZONE};
pub(in crate::parse::schema) use outdoors::{
    ARCADE, BLOCK, FARMLAND, LANTERN, NETWORK, POLE, RESIDENCE, SIGN, SIGNAL, TORII, WATER, WIRE,
};

use super::{FAR, LENGTH, TRUTH};
use crate::parse::schema::kinds::Kind::{Choice, Number, Point, Text, Whole};
use crate::parse::schema::kinds::{AttributeSchema, may, must, words};
use hsd_ir::ast::town::{FieldType, GapAt, PlaceOn};
use hsd_ir::ast::{Species, Surface};

const ON: &[&str] = &words(&PlaceOn::WORDS);
const GAP_AT: &[&str] = &words(&GapAt::WORDS);
const TYPE: &[&str] = &words(&FieldType::WORDS);

#[rustfmt::skip]
pub(in crate::parse::schema) const TOWN: &[AttributeSchema] = &[
    may("name", Text, "", "its name", "町の名"),
    may("crs", Text, "", "the plane in which it is built, such as `EPSG:6674`; without, the zone of Japan or of UTM that the first layer lies in", "町を作る平面座標系。`EPSG:6674` など。無ければ最初のレイヤーが入る平面直角座標系か UTM"),
    may("seed", Whole(0, u64::MAX), "0", "key of all draws: another seed, another town on the same maps", "抽選の種。変えると同じ地図の別の町になる"),
    may("origin", Point(-FAR, FAR), "", "metres east and north in `crs` that are 0 0 of the model; without, the centre of the first layer, rounded to 1 km", "モデルの原点。`crs` での東と北(m)。無ければ最初のレイヤーの中心を 1 km に丸めた点").metres(),
    may("font", Text, "", "the file of a font (TTF, OTF, TTC) for the letters of signs, from the folder of this one", "標識の文字に使うフォント(TTF、OTF、TTC)のファイル。このファイルのフォルダーから数える"),
    may("geoid", TRUTH, "no", "in tiles, heights count from the sea, which is raised over the ellipsoid by the geoid (EGM96)", "タイルで、高さを海面から数える。海面は楕円体からジオイド高(EGM96)だけ上がる"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const LAYER: &[AttributeSchema] = &[
    must("name", Text, "what `for` calls it", "`for` で使う名"),
    must("src", Text, "the file, from the folder of this one; several with commas between them, or a pattern such as `sheets/*.xml`", "地図のファイル。このファイルのフォルダーから数える。複数ならコンマで並べるか `sheets/*.xml` のような型で書く"),
    may("layer", Text, "", "which layer of the file, where it has several", "ファイルに複数のレイヤーがあるとき、そのどれか"),
    may("encoding", Text, "", "how the texts of its fields are encoded, such as `cp932`, where the file does not say", "属性の文字コード。`cp932` など。ファイルに書いていないとき"),
    may("crs", Text, "", "its coordinates, such as `EPSG:6668`, where the file does not say", "座標系。`EPSG:6668` など。ファイルに書いていないとき"),
    may("key", Text, "", "the field that names its features; without, their id or number", "地物を見分ける属性。無ければ id か番号"),
    may("outline", Text, "", "of records of vertices: the field that names the house whose outline they are", "頂点の記録で、どの建物の輪郭かを示す属性"),
    may("order", Text, "", "with `outline`: the field that numbers the vertices of each; without, their order in the file", "`outline` とともに: 輪郭の中で頂点の順を示す属性。無ければファイルの順"),
    may("where", Text, "", "a test on the fields, such as `building = 'house'`: other features are left out", "属性の条件。`building = 'house'` など。合わない地物は読まない"),
    may("evidence", Text, "", "where the map comes from, for tables and models", "地図の出典。表とモデルに残す"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const FIELD: &[AttributeSchema] = &[
    must("name", Text, "what expressions call it", "式の中での名"),
    may("from", Text, "", "the field of the file; without, that of the same name", "ファイルの属性名。無ければ同じ名"),
    may("type", Choice(TYPE), "", "what it is read as; without, what it looks like", "読み方。無ければ見た目による"),
    may("default", Text, "", "the value of features without one", "値の無い地物に使う値"),
    may("map", Text, "", "other words for its values: `a=b, c=d`", "値の言い換え。`a=b, c=d`"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const JOIN: &[AttributeSchema] = &[
    must("layer", Text, "the layer of points", "点のレイヤーの名"),
    may("by", Text, "", "the field of the points that holds the key of their outline; without, their place decides", "点の属性のうち、輪郭のキーを持つもの。無ければ位置による"),
    may("within", LENGTH, "0", "how far from an outline a point that lies in none may be, metres; the nearest one takes it", "どの輪郭にも入らない点を、いちばん近い輪郭に結ぶ距離の上限(m)").metres(),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const DIVIDE: &[AttributeSchema] = &[
    must("layer", Text, "the layer of areas", "面のレイヤーの名"),
    may("plots", Text, "plots", "the name of the layer of plots", "敷地のレイヤーの名"),
    may("blocks", Text, "blocks", "the name of the layer of blocks, which lie between streets", "通りに挟まれた街区のレイヤーの名"),
    may("streets", Text, "streets", "the name of the layer of the streets that cut deep areas", "深い面を切る通りのレイヤーの名"),
    may("yards", Text, "yards", "the name of the layer of what no plot takes, mostly in the middle of blocks", "どの敷地にもならない所(多くは街区の中の会所地)のレイヤーの名"),
    may("frontage", Number(2.0, 500.0), "9.85", "how wide a plot is at its street, as nearly as a whole number of them allows, metres; 5 ken of 6.5 shaku", "敷地の間口(m)。辺を整数個に割った、これに最も近い幅。6尺5寸の5間").metres(),
    may("depth", Number(2.0, 500.0), "39.39", "how deep a plot is at most, metres; no more than half the way to the opposite side; 20 ken", "敷地の奥行の上限(m)。向かいの辺までの半分を超えない。20間").metres(),
    may("street", Number(0.5, 19.0), "7.88", "how wide the streets are, metres; 4 ken", "通りの幅(m)。4間").metres(),
    may("every", Point(20.0, 5000.0), "86.67 126.06", "from the middle of a street to the next, metres: across the main direction of the area, and along it; 44 and 64 ken", "通りの中心から次の通りの中心まで(m)。面の主な方向に直角な向きと、沿う向き。44間と64間").metres(),
    may("deep", Number(5.0, 5000.0), "94.55", "how deep an area is that no street cuts, metres: twice the farthest a place in it may be from its border; 48 ken", "通りで切らない面の深さの上限(m)。縁から最も遠い点までの2倍。48間").metres(),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const TABLE: &[AttributeSchema] = &[
    must("name", Text, "what `look` calls it", "`look` で使う名"),
    must("src", Text, "a CSV file whose first line names the columns", "最初の行に列の名がある CSV ファイル"),
    must("key", Text, "the column by which `look` finds a row", "`look` が行を探す列"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const FOR: &[AttributeSchema] = &[
    must("each", Text, "the layer", "レイヤーの名"),
    may("test", Text, "", "a condition on the fields and measures of a feature, in braces", "地物の属性や寸法の条件。波括弧で囲む"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const SKIP: &[AttributeSchema] = &[
    may("because", Text, "", "why, for the table of decisions", "理由。決定の表に残す"),
];
#[rustfmt::skip]
pub(in crate::parse::schema) const REAR: &[AttributeSchema] = &[
    may("density", Number(0.0, 1.0), "0", "the share of the dwellings along an alley that are built; 0 leaves the rear to the owner: court, storehouse, dwelling, by the depth of the lot", "路地に沿う長屋のうち建てる戸数の割合。0 なら裏は家主のもので、奥行に応じて庭、蔵、離れになる"),
    may("evidence", Text, "", "where it comes from, for tables and models", "根拠。表とモデルに残す"),
];
const SURFACE: &[&str] = &words(&Surface::WORDS);
const SPECIES: &[&str] = &words(&Species::WORDS);
/// Where what stands outside houses comes from.
const EVIDENCE: AttributeSchema = may(
    "evidence",
    Text,
    "",
    "where it comes from, for tables and models",
    "根拠。表とモデルに残す",
);
#[rustfmt::skip]
pub(in crate::parse::schema) const ROAD: &[AttributeSchema] = &[
    may("width", Number(0.3, 200.0), "", "from side to side with pavements and drains, metres; without, the field `width` of the map or the width of its class", "歩道と溝を含む幅(m)。無ければ地図の属性 `width` か道の種別による").metres(),
    may("surface", Choice(SURFACE), "asphalt", "what it is laid with", "路面"),
    may("pavement", Number(0.0, 30.0), "0", "width of the pavement on either side, metres; roads that would have less than 3 m left have none", "両側の歩道の幅(m)。車道が 3 m 残らない道には付かない").metres(),
    may("drain", Number(0.0, 5.0), "0", "width of the drain of stone on either side, metres; roads that would have less than 2 m left have none", "両側の石の溝の幅(m)。路面が 2 m 残らない道には付かない").metres(),
    may("marks", TRUTH, "", "lines painted on it, from 5.5 m of carriageway; without, on asphalt", "区画線。車道が 5.5 m 以上のとき。無ければアスファルトの道に引く"),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const RAIL: &[AttributeSchema] = &[
    may("gauge", Number(0.3, 3.0), "1.067", "between its rails, metres", "軌間(m)").metres(),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const TREE: &[AttributeSchema] = &[
    may("species", Choice(SPECIES), "", "what it is; without, drawn by its place", "樹種。無ければ場所で抽選する"),
    may("height", Number(0.5, 80.0), "", "its height, metres; without, drawn by its place and species", "高さ(m)。無ければ樹種と場所で抽選する").metres(),
    may("width", Number(0.3, 60.0), "", "width of its crown, metres; without, drawn as a share of the height", "樹冠の幅(m)。無ければ高さに応じて抽選する").metres(),
    may("spacing", Number(1.0, 500.0), "6", "how far trees stand apart along a line or over an area, metres", "線や面に並べるときの間隔(m)").metres(),
    may("offset", Number(0.0, 100.0), "0", "how far from a line they stand, on either side, metres; 0 for on it", "線の両側に並べるときの線からの距離(m)。0 なら線の上").metres(),
    EVIDENCE,
];
/// The attributes of units along a line, of which the middle one is this part.
const fn units_of(code: &'static str) -> [AttributeSchema; 6] {
    [
        may(
            "code",
            Text,
            code,
            "the part that is repeated, in whole units",
            "繰り返す部材のコード",
        ),
        may(
            "first",
            Text,
            "",
            "the part at the beginning of the line; without, the same",
            "線の始めの部材。無ければ同じもの",
        ),
        may(
            "last",
            Text,
            "",
            "the part at its end; without, the same",
            "線の終わりの部材。無ければ同じもの",
        ),
        may(
            "height",
            Number(0.5, 40.0),
            "",
            "shaku; without, the height of the part",
            "高さ(尺)。無ければ部材の高さ",
        )
        .shaku(),
        may(
            "gate",
            Number(0.0, 100.0),
            "0",
            "round an area: how much of its front is left open in the middle, metres, for a gate",
            "面を囲むとき: 門のために正面の中央に空ける幅(m)",
        )
        .metres(),
        EVIDENCE,
    ]
}
pub(in crate::parse::schema) const FENCE: &[AttributeSchema] = &units_of("KIB");
pub(in crate::parse::schema) const HEDGE: &[AttributeSchema] = &units_of("KIK");
pub(in crate::parse::schema) const WALL: &[AttributeSchema] = &units_of("KDB");
#[rustfmt::skip]
pub(in crate::parse::schema) const TILES: &[AttributeSchema] = &[
    may("size", Number(10.0, 100_000.0), "250", "side of a tile, metres", "タイルの一辺(m)").metres(),
    may("by", Text, "", "the field that names the tile of a feature, in place of squares", "タイルを分ける属性。格子の代わりに使う"),
    may("detail", Text, "0, 1, 3", "levels of detail from far to near, of 0 to 3", "詳細度。遠くから近くへ 0 から 3 を並べる"),
];
/// The attributes of a `Place` that only mean something in a `for`; elsewhere they are parameters like any other.
#[rustfmt::skip]
pub(in crate::parse::schema) const PLACEMENT: [AttributeSchema; 8] = [
    may("on", Choice(ON), "", "in a town: on a rectangle behind the front (`plot`), on the walls of the outline, at its centre, along the line, or where the gate of its wall is (`gate`); without, a rectangle where one fits", "町で: 正面の後ろの矩形 `plot`、輪郭どおり `outline`、中心 `centre`、線の上 `line`、塀の門口 `gate`。無ければ矩形が合うかどうかによる"),
    may("front", Text, "", "in a town: the layer of streets that it fronts, or `published` for the rule of the machiya macro; any other word is for the type", "町で: 正面が向く通りのレイヤー。`published` なら町家マクロの規則。ほかの語は型の変数"),
    may("cap", LENGTH, "", "in a town: the greatest depth behind the front, metres; 12 for chu-nikai, 8 for the other town houses", "町で: 正面からの奥行の上限(m)。中二階は 12、ほかの町家は 8").metres(),
    may("gap", LENGTH, "", "in a town: how much narrower than its front it is, metres", "町で: 間口をどれだけ狭めるか(m)").metres(),
    may("gap_at", Choice(GAP_AT), "", "in a town: the side on which `gap` lies, as seen from the street: one side leaves an alley to the rear", "町で: `gap` を空ける側。通りから見て。片側に寄せると裏への路地になる"),
    may("gap_left", LENGTH, "", "in a town: how much of its front it leaves free on the left, as seen from the street, besides `gap`, metres", "町で: `gap` のほかに、通りから見て左に空ける幅(m)").metres(),
    may("gap_right", LENGTH, "", "in a town: the same on the right: two houses can share a front, each with its gap where the other one stands", "町で: 同じく右に空ける幅(m)。互いの所を空ければ、一つの間口に二軒並ぶ").metres(),
    may("evidence", Text, "", "in a town: where it comes from, for tables and models", "町で: 根拠。表とモデルに残す"),
];
