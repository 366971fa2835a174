//! The attributes of every element: values, default and description of each.

pub(super) mod town;

use crate::parse::schema::kinds::Kind::{
    Choice, Choices, Either, Number, Numbers, Pair, Point, Points, Positions, Spot, Text, Whole,
    WholePair, YesNo,
};
use crate::parse::schema::kinds::{AttributeSchema, Kind, join, may, must, words};
use crate::parse::schema::vocabulary;
use hsd_ir::ast::{
    Era, FinialKind, FixtureKind, Flooring, GableWall, GroundSurface, MatOrder, Paint, Purpose,
    RoofMethod, RoomCeiling,
};

/// The bound on distances from the origin, metres, U or shaku; larger than the earth.
const FAR: f64 = 1e8;
/// The bound on lengths of walls, U or shaku.
const LONG: f64 = 1e5;
const ANYWHERE: Kind = Number(-FAR, FAR);
const PLACE: Kind = Point(-FAR, FAR);
/// Sizes in U or shaku: positive, and no larger than a mountain.
const SIZE: Kind = Number(1e-3, LONG);
/// Overhangs and other lengths that may be 0.
const LENGTH: Kind = Number(0.0, LONG);
/// Degrees.
const TURN: Kind = Number(-360.0, 360.0);
/// Sizes and scales of facades.
const SCALE: Kind = Number(1e-6, 1e6);
/// Any number of an expression.
const ANY: Kind = Number(f64::MIN, f64::MAX);
/// The words that are read as a truth value.
const TRUTH: Kind = Choice(&["yes", "no", "true", "false"]);
/// Heights and depths of fittings, shaku: no platform is higher than a hill.
const NEAR: Kind = Number(0.0, 300.0);
/// Thickness of posts and similar members, shaku.
const THICK: Kind = Number(0.1, 20.0);
/// Bays along a side.
const BAYS: Kind = WholePair(1.0, 60.0);
/// Steps of brackets; more were never built.
const STEPS: Kind = Whole(0, 4);
/// Lengths of monuments that must be positive, shaku.
const SPAN: Kind = Number(0.1, 1000.0);
/// The bound on repetitions.
const MANY: u64 = 10_000_000;

/// The bound on corners of an outline; each is compared with all others.
pub(in crate::parse) const CORNERS_MOST: u64 = 10_000;
/// Corners of an outline, metres.
const CORNERS: Kind = Points(-FAR, FAR);

const STOREYS: Kind = Choice(&words(&vocabulary::STOREY_KINDS));
const PAINT: Kind = Choice(&words(&Paint::ALL));
const SIDES: Kind = Choices(&words(&vocabulary::SIDES));
const COVERING: Kind = Choice(&words(&vocabulary::COVERINGS));
const SHAPE: Kind = Choice(&words(&vocabulary::ROOF_SHAPES));
const SHAPE_OF_HOUSE: Kind = Choice(&words(&vocabulary::SHAPES_OF_HOUSES));
const ANCHOR: Kind = Choice(&words(&vocabulary::ANCHORS));

#[rustfmt::skip]
const HOUSE_OWN: [AttributeSchema; 10] = [
    may("name", Text, "", "its name, which also keys its draws", "建物の名。抽選の鍵にもなる"),
    may("unit", Number(0.1, 100.0), "3", "one unit in shaku: 3 (Edo-ma), 3.15, 3.25 (Kyo-ma)", "1ユニットの長さ(尺)。3(江戸間)、3.15、3.25(京間)").shaku(),
    may("seed", Whole(0, u64::MAX), "0", "key of the draws: another seed, another house of the same kind", "抽選の種。変えると同じ型の別の建物になる"),
    may("azimuth", TURN, "180", "compass direction that the front looks to, degrees; 180 is south", "正面の向く方位(度)。180 は南"),
    may("x", ANYWHERE, "0", "place of the house's origin, metres east", "原点の位置。東へ(m)").metres(),
    may("y", ANYWHERE, "0", "place of the house's origin, metres north", "原点の位置。北へ(m)").metres(),
    may("z", ANYWHERE, "0", "height of the ground, metres", "地盤の高さ(m)").metres(),
    may("plinth", Number(0.0, 100.0), "0", "how far a plinth of stone under its walls reaches below the ground, metres: on a slope, where the ground falls away", "壁の下の石積みが地盤より下へ伸びる深さ(m)。斜面で地面が下がる所に使う").metres(),
    may("street", YesNo, "no", "the first line stands on the street: its roof's ridge runs along it", "最初の行が通りに面する(平入りになる)"),
    may("use", Choice(&words(&Purpose::ALL)), "", "what it is for, where `Roofs` says nothing: nearly square halls have pyramids, temples hip-and-gable roofs, sheds one slope, blocks flat roofs, others gables", "用途。`Roofs` に書かないとき、正方形に近い堂は宝形、寺は入母屋、小屋は片流れ、ビルは陸屋根、ほかは切妻になる"),
];
/// The age of a house.
#[rustfmt::skip]
const AGED: [AttributeSchema; 2] = [
    may("age", Number(0.0, 2000.0), "", "years since it was built: it has weathered; without, nothing has", "築年数。経年変化を表す。無ければ変化しない"),
    may("era", Choice(&words(&Era::WORDS)), "", "when it was built: E Edo, M Meiji to early Showa, N contemporary; parts of a later era are younger", "建てた時代。E 江戸、M 明治から昭和初期、N 現代。後の時代の部材は新しくなる"),
];
pub(super) const HOUSES: &[AttributeSchema] = &AGED;
#[rustfmt::skip]
pub(super) const GROUP: &[AttributeSchema] = &join::<5, 2, 7>([
    may("name", Text, "", "its name", "名"),
    may("x", ANYWHERE, "0", "where the origin of its houses lies, metres east", "中の建物の原点の位置。東へ(m)").metres(),
    may("y", ANYWHERE, "0", "the same, metres north", "同じく北へ(m)").metres(),
    may("z", ANYWHERE, "0", "height of the ground, metres", "地盤の高さ(m)").metres(),
    may("turn", TURN, "0", "how far its houses are turned about that origin, degrees clockwise from above", "その原点の周りに回す角度。上から見て時計回り(度)"),
], AGED);
#[rustfmt::skip]
pub(super) const PLACEMENT: &[AttributeSchema] = &join::<11, 8, 19>(join::<9, 2, 11>(PLACEMENT_OWN, AGED), town::PLACEMENT);
#[rustfmt::skip]
const PLACEMENT_OWN: [AttributeSchema; 9] = [
    must("type", Text, "a house type of the library, a `define` or a file; all other attributes set its parameters", "建物の型、`define` の名、またはファイル。ほかの属性はすべて変数"),
    may("name", Text, "", "its name; without, that of the type", "建物の名。無ければ型の名"),
    may("x", ANYWHERE, "0", "place of the house, metres east", "建物の位置。東へ(m)").metres(),
    may("y", ANYWHERE, "0", "place of the house, metres north", "建物の位置。北へ(m)").metres(),
    may("z", ANYWHERE, "0", "height of the ground, metres", "地盤の高さ(m)").metres(),
    may("plinth", Number(0.0, 100.0), "0", "how far a plinth of stone under its walls reaches below the ground, metres", "壁の下の石積みが地盤より下へ伸びる深さ(m)").metres(),
    may("azimuth", TURN, "180", "compass direction that the front looks to, degrees; 180 is south", "正面の向く方位(度)。180 は南"),
    may("at", ANCHOR, "corner", "what stands there: the right end of the front, or the centre of the ground storey", "その位置に来る点。正面の右端 `corner` か、一階の中心 `centre`"),
    may("seed", Whole(0, u64::MAX), "", "key of the draws, parameters that are not set among them", "抽選の種。指定しない変数も抽選する"),
];
#[rustfmt::skip]
pub(super) const VIEW: &[AttributeSchema] = &[
    must("name", Text, "its name, for `hsd render --view`", "視点の名。`hsd render --view` で使う"),
    must("from", Spot(-FAR, FAR), "where the camera stands: metres east, north and up", "カメラの位置。東へ、北へ、高さ(m)").metres(),
    must("to", Spot(-FAR, FAR), "the middle of the picture: metres east, north and up", "写真の中心に来る場所。東へ、北へ、高さ(m)").metres(),
    may("fov", Number(1.0, 150.0), "45", "vertical angle of view, degrees", "縦の画角(度)"),
    may("date", Text, "", "day of the sun over Kyoto, such as `2026-12-21`; an afternoon without", "太陽の日付。`2026-12-21` のように書く。無ければ午後の日差し"),
    may("hour", Text, "", "hour of that day, such as `9` or `16:30`; noon without", "その日の時刻。`9`、`16:30` のように書く。無ければ正午"),
];
pub(super) const HOUSE: &[AttributeSchema] = &join::<10, 2, 12>(HOUSE_OWN, AGED);
#[rustfmt::skip]
pub(super) const STOREY: &[AttributeSchema] = &[
    may("height", SIZE, "9", "from its floor to the next, shaku", "階高(尺)").shaku(),
    may("start", PLACE, "0 0", "where its walk starts, units to the left and back from the house's origin", "歩き始めの位置。原点から左へ、奥へ(ユニット)").units(),
    may("kind", STOREYS, "storey", "a `parapet` stands on the storey below and bears no roof of its own", "`parapet` は下の階に載る胸壁で、屋根を持たない"),
];
#[rustfmt::skip]
pub(super) const OUTLINE: &[AttributeSchema] = &[
    must("points", CORNERS, "its corners `e n, e n, ...`: metres east and north of the house's place, in either direction", "隅の列 `e n, e n, ...`。建物の位置から東へ、北へ(m)。向きは問わない").metres(),
    may("square", Either(&["no"], 0.0, 100.0), "0.3", "how far corners may move to make the walls square, metres; `no` leaves them where they are", "壁を直角に直すために隅が動いてよい距離(m)。`no` なら動かさない").metres(),
    may("join", Number(0.0, 100.0), "0.3", "how far walls may move onto the line of another, so that no roof is a narrow strip, metres", "細長い屋根ができないよう、壁がほかの壁の線に寄ってよい距離(m)").metres(),
    may("front", Whole(1, CORNERS_MOST), "", "number of the side that is the first line: side 1 runs from the first corner to the second; without, the longest side on a street, or the southernmost", "正面になる辺の番号。辺 1 は最初の隅から次の隅まで。無ければ通りに面したいちばん長い辺か、いちばん南の辺"),
    may("street", Positions, "", "numbers of the sides on streets, such as `1,3-4`; the front without", "通りに面した辺の番号。`1,3-4` のように書く。無ければ正面"),
    may("neighbour", Positions, "", "numbers of the sides on which a neighbour stands", "隣の建物に接する辺の番号"),
];
#[rustfmt::skip]
pub(super) const HOLE: &[AttributeSchema] = &[
    must("points", CORNERS, "its corners, as those of the outline", "隅の列。輪郭と同じ書き方").metres(),
];
#[rustfmt::skip]
pub(super) const WALLS: &[AttributeSchema] = &[
    may("of", Choice(&["outline"]), "outline", "whose sides", "どの輪郭の辺か"),
    may("long", Number(0.05, 1.0), "1", "share of the outline's extent along its longest side", "最も長い辺の方向の広がりに対する割合"),
    may("short", Number(0.05, 1.0), "1", "the same across the longest side", "最も長い辺に直交する方向の割合"),
    may("rest", Text, "KSK", "code of the wall that fills what parts leave, and sides without a `Side`", "部材の残りと、`Side` の無い辺を埋める壁のコード"),
    may("at", Point(0.0, 1.0), "0.5 0.5", "where the part lies, along and across: 0 at the front or right end, 1 at the other", "その部分の位置。長い方向と直交する方向に、0 = 正面側か右端、1 = 反対側"),
];
#[rustfmt::skip]
pub(super) const SIDE_WALL: &[AttributeSchema] = &[
    may("on", Either(&words(&vocabulary::ON), 1.0, CORNERS_MOST as f64), "any", "which sides: a kind, or the number of one; a number goes before `front`, that before `street`, `neighbour` and `court`, then `back`, then `long` and `short`, then `any`",
        "どの辺か。種類または番号。番号、`front`、`street` `neighbour` `court`、`back`、`long` `short`、`any` の順に優先する"),
];
#[rustfmt::skip]
pub(super) const LOOP: &[AttributeSchema] = &[
    may("hole", YesNo, "no", "the walls of a courtyard, walked counter-clockwise round it", "中庭の壁。中庭の周りを反時計回りに歩く"),
    may("inner", YesNo, "no", "a wall inside a storey, which need not close and bears no roof", "階の内側の壁。閉じなくてもよく、屋根を受けない"),
    may("start", PLACE, "", "where its walk starts, units to the left and back", "歩き始めの位置。左へ、奥へ(ユニット)").units(),
];
#[rustfmt::skip]
pub(super) const ROW: &[AttributeSchema] = &[
    may("turn", Either(&words(&vocabulary::TURNS), -360.0, 360.0), "R",
        "the turn at its end: `R` right, `L` left, or degrees to the right", "行末の曲がり。`R` 右、`L` 左、または右への角度(度)"),
];
#[rustfmt::skip]
pub(super) const PART: &[AttributeSchema] = &[
    must("code", Text, "its code in the catalogue, or the name of an own part or a picture", "部材コード。自作部材や画像の名でもよい"),
    may("width", LENGTH, "", "units, in place of the code's own width", "幅(ユニット)。コードの幅に代わる").units(),
    may("height", SIZE, "", "shaku, in place of the storey's height", "高さ(尺)。階高に代わる").shaku(),
];
#[rustfmt::skip]
pub(super) const STRUCTURE: &[AttributeSchema] = &[
    may("size", SIZE, "", "width of a facade of ratio 1, in size units; 1 where only `scale` or a `ratio` is given", "比 1 の壁面の幅(寸法単位)。`scale` か `ratio` だけのときは 1"),
    may("scale", SCALE, "", "one size unit in metres; 0.1 where only `size` or a `ratio` is given", "寸法単位の長さ(m)。`size` か `ratio` だけのときは 0.1").metres(),
    may("order", Choice(&words(&vocabulary::PART_ORDERS)), "left", "to which side the parts of a floor run, seen from outside", "外から見て部材がどちらへ並ぶか"),
];
#[rustfmt::skip]
pub(super) const FACADE: &[AttributeSchema] = &[
    may("id", Text, "", "its name, in the names of part pictures", "壁面の名。部材画像の名に使う"),
    may("ratio", SCALE, "", "its width in those of the structure's `size`", "幅。`size` に対する比"),
    may("angle", TURN, "90", "the turn from the facade before, degrees to the right; the first one has 0", "前の壁面からの曲がり。右へ(度)。最初の壁面は 0"),
    may("reflection", Choice(&words(&vocabulary::REFLECTIONS)), "disable", "its glass mirrors the neighbours", "ガラスに周囲を映す"),
];
#[rustfmt::skip]
pub(super) const FLOOR: &[AttributeSchema] = &[
    may("id", Text, "", "floors of one name share a row: one says it, the others take it", "同じ名の階は並びを共有する"),
    may("height", SIZE, "11.55", "from its floor to the next, shaku; 11.55 is 3.5 m", "階高(尺)。11.55 は 3.5 m").shaku(),
    may("kind", STOREYS, "storey", "a `parapet` stands on the floor below", "`parapet` は下の階に載る胸壁"),
];
#[rustfmt::skip]
pub(super) const REPEAT: &[AttributeSchema] = &[
    must("num", Whole(0, MANY), "how often its content stands there", "中身を繰り返す回数"),
    may("index", Text, "", "a name for the number of the round, from 0", "何回目かの番号に付ける名。0 から"),
];
#[rustfmt::skip]
pub(super) const SPLIT: &[AttributeSchema] = &[
    may("ratio", Number(0.001, 0.999), "0.5", "the share of the upper half", "上の部分の割合"),
];
#[rustfmt::skip]
pub(super) const RANDOM: &[AttributeSchema] = &[
    must("code", Text, "codes divided by commas, of which one is drawn; not beside `choice`", "コンマで区切ったコード。どれかひとつを抽選する。`choice` とは併用しない"),
    may("weights", Numbers(0.0, 1e9), "", "how often each of them comes, one number a code; all alike without", "それぞれの出やすさ。無ければ等しい"),
];
#[rustfmt::skip]
pub(super) const CHOICE: &[AttributeSchema] = &[
    may("weight", Number(0.0, 1e9), "1", "how often it comes, beside the others", "ほかに対する出やすさ"),
];
#[rustfmt::skip]
pub(super) const REPLACE: &[AttributeSchema] = &[
    may("code", Text, "", "which codes are changed; without, all at `at`", "取り替えるコード。無ければ `at` の全部"),
    must("with", Text, "the codes that come in their place, drawn where several", "代わりに置くコード。複数なら抽選する"),
    may("at", Positions, "", "which places, from 1, such as `2,5-7`", "取り替える位置。1 から数え、`2,5-7` のように書く"),
];
#[rustfmt::skip]
pub(super) const TEXTURE: &[AttributeSchema] = &[
    must("code", Text, "which part or picture it is said of", "対象の部材または画像"),
    may("reflection", Number(0.0, 100.0), "", "share of light that it mirrors, 0 to 1", "映り込みの割合。0 から 1"),
    may("src", Text, "", "the file of its picture, from the folder of this file and below the root", "画像のファイル。このファイルのフォルダーから数え、ルートの下に限る"),
];

/// The style of roofs.
#[rustfmt::skip]
const STYLE: [AttributeSchema; 13] = [
    may("kind", COVERING, "", "covering: K pantiles, G cover tiles, I boards, S shingles, H bark, Y thatch, T metal",
        "葺き材。K 桟瓦、G 本瓦、I 板、S 杮、H 檜皮、Y 茅、T 金属"),
    may("pitch", Number(0.0, 100.0), "", "rise in 10, sun", "勾配(寸)"),
    may("eaves", LENGTH, "", "overhang at the eaves, shaku", "軒の出(尺)").shaku(),
    may("verge", LENGTH, "", "overhang at the gables, shaku", "けらばの出(尺)").shaku(),
    may("thickness", SIZE, "", "thickness of the slab, shaku", "屋根の厚さ(尺)").shaku(),
    may("noshi", Whole(0, 100), "", "courses of ridge tiles", "熨斗瓦の段数"),
    may("sori", Number(-50.0, 50.0), "", "sagitta of the slope in per cent of its length; negative is convex (mukuri)", "反り。流れ長さに対する矢高(%)。負は起り"),
    may("gable", Number(0.0, 0.5), "", "how far an irimoya's gable stands inside its walls, share of the span", "入母屋の妻の引っ込み。梁間に対する割合"),
    may("ratio", Number(0.0, 1.0), "", "length of a hipped roof's ridge, share of the roof's length", "寄棟の棟の長さ。屋根の長さに対する割合"),
    may("plain_ridge", YesNo, "no", "no ridge-end tiles", "鬼瓦を置かない"),
    may("gable_wall", Choice(&words(&GableWall::ALL)), "", "gable walls of an irimoya: as the `wall` below, or boards behind a `lattice`; by shape and covering if it is not given",
        "入母屋の妻壁。`wall` は下の壁と同じ、`lattice` は狐格子。無ければ形と葺き材による"),
    may("offset", SIZE, "", "from the slope over the walls to the upper face, shaku (rf_offs of paper 004); boards fill what lies below the slab; less than `thickness` counts as that",
        "壁の上の斜面から屋根の上面まで(尺)。論文 004 の rf_offs。屋根板の下は面戸板がふさぐ。`thickness` より小さければ同じとみなす").shaku(),
    may("paint", PAINT, "", "wood or colour of rafters, soffits and boards", "垂木、軒裏、破風板の材または色"),
];
const ROOFS_OWN: [AttributeSchema; 3] = [
    may(
        "mode",
        Choice(&words(&vocabulary::ROOF_MODES)),
        "auto",
        "`auto`: written roofs, and automatic ones for the rest; `explicit`: only the written ones",
        "`auto` は書いた屋根と残りの自動屋根、`explicit` は書いた屋根だけ",
    ),
    may(
        "method",
        Choice(&words(&RoofMethod::ALL)),
        "least-cut",
        "how plans are divided into roofs",
        "平面を屋根に分ける方法",
    ),
    may(
        "shape",
        SHAPE_OF_HOUSE,
        "",
        "form, by its letters or as maps call it; `use`: by what the house is for",
        "形。記号または地図の語。`use` は建物の用途による",
    ),
];
#[rustfmt::skip]
const ROOF_OWN: [AttributeSchema; 7] = [
    may("shape", SHAPE, "", "KIR gable, YOS hip, YOK gable along the short side, IRI hip and gable, HAK half-hip, HOG pyramid, KAT lean-to, HIS pent roof, TER temple, KAR karahafu, RIK flat, KOS gambrel, MAN mansard; on another roof CHI triangular gable, NOK undulating gable, KOY monitor, UDA fire wall; or as maps call it",
        "KIR 切妻、YOS 寄棟、YOK 横長切妻、IRI 入母屋、HAK 袴腰、HOG 宝形、KAT 片流れ、HIS 庇、TER 寺院、KAR 唐破風、RIK 陸屋根、KOS 腰折れ、MAN マンサード。地図の語でもよい"),
    must("a0", ANYWHERE, "a corner of the walls below, units to the left", "下の壁の角。左へ(ユニット)").units(),
    must("b0", ANYWHERE, "the same, units back", "同じく奥へ(ユニット)").units(),
    must("a1", ANYWHERE, "the opposite corner, units to the left", "対角の角。左へ(ユニット)").units(),
    must("b1", ANYWHERE, "the same, units back", "同じく奥へ(ユニット)").units(),
    may("ridge", Choice(&words(&vocabulary::RIDGE_DIRECTIONS)), "", "X along the first line, Y across it; one slope falls to F front, B back, L left, R right",
        "X は最初の行に平行、Y は直交。片流れは F 前、B 奥、L 左、R 右へ下る"),
    may("height", Either(&["*"], -FAR, FAR), "*", "of the eaves above the ground sill, shaku; `*` is the top of the walls there", "軒の高さ(尺)。`*` はそこの壁の上端").shaku(),
];
pub(super) const ROOFS: &[AttributeSchema] = &join::<3, 13, 16>(ROOFS_OWN, STYLE);
pub(super) const ROOF: &[AttributeSchema] = &join::<7, 13, 20>(ROOF_OWN, STYLE);

#[rustfmt::skip]
pub(super) const PLATFORM: &[AttributeSchema] = &[
    may("height", NEAR, "3", "shaku", "高さ(尺)").shaku(),
    may("margin", Pair(0.0, 300.0), "6", "from the walls to its edge, shaku; two numbers: left and right, front and back", "壁から縁まで(尺)。ふたつ書けば左右と前後").shaku(),
    may("stairs", SIDES, "", "sides with stairs: F, B, L, R", "階段のある側。F 前、B 奥、L 左、R 右"),
    may("width", SIZE, "", "of the stairs, shaku; the middle bay without", "階段の幅(尺)。無ければ中央間").shaku(),
];
#[rustfmt::skip]
pub(super) const POSTS: &[AttributeSchema] = &[
    may("size", THICK, "0.4", "thickness, shaku", "太さ(尺)").shaku(),
    may("round", YesNo, "no", "round posts", "丸柱にする"),
    may("paint", PAINT, "cedar", "wood or colour", "材または色"),
    may("nageshi", Whole(0, 5), "0", "rows of tie beams", "長押の段数"),
];
#[rustfmt::skip]
pub(super) const VERANDA: &[AttributeSchema] = &[
    may("width", LENGTH, "3", "shaku", "幅(尺)").shaku(),
    may("height", NEAR, "0", "of its boards: on the ground storey it raises the house, upstairs it counts from the storey's foot, shaku", "床の高さ(尺)。1階では建物を上げ、上階では階の足元から測る").shaku(),
    may("rail", Choice(&words(&vocabulary::RAILS)), "none", "railing: crossed or knobbed posts", "高欄。組高欄または擬宝珠"),
    may("stairs", SIDES, "", "sides with stairs: F, B, L, R", "階段のある側。F 前、B 奥、L 左、R 右"),
    may("paint", PAINT, "", "wood or colour; that of the posts without", "材または色。無ければ柱と同じ"),
];
#[rustfmt::skip]
pub(super) const ROOM: &[AttributeSchema] = &[
    may("name", Text, "", "its name, such as 座敷; one such as 八畳 says how many mats lie in it", "部屋の名。座敷など。八畳のような名なら、畳の数と比べる"),
    must("at", PLACE, "a point in it, units to the left and back from the house's origin", "部屋の中の一点。原点から左へ、奥へ(ユニット)").units(),
    may("floor", Choice(&words(&Flooring::ALL)), "boards", "what one walks on", "床"),
    may("mats", Choice(&words(&MatOrder::ALL)), "festive", "how mats lie: no four corners meeting, or in rows", "畳の敷き方。四隅が一点に集まらない祝儀敷きか、そろえて並べる不祝儀敷き"),
    may("ceiling", Choice(&words(&RoomCeiling::ALL)), "battens", "boards on battens, the joists of the floor above, or none up to the roof", "天井。棹縁天井、上の床の根太が見える天井、無し(吹き抜け)"),
    may("height", SIZE, "", "from the floor to the ceiling, shaku; up to the next storey without", "床から天井まで(尺)。無ければ上の階まで").shaku(),
];
#[rustfmt::skip]
pub(super) const FIXTURE: &[AttributeSchema] = &[
    must("kind", Choice(&words(&FixtureKind::ALL)), "tokonoma, chigaidana (shelves), butsudan (altar), oshi-ire (closet), stairs, hako-kaidan (stairs of chests), kamado (stove), well, sink", "tokonoma 床の間、chigaidana 違い棚、butsudan 仏壇、oshi-ire 押入、stairs 階段、hako-kaidan 箱階段、kamado 竈、well 井戸、sink 流し"),
    must("at", PLACE, "its least corner, units to the left and back from the house's origin", "角のうち原点に近い方。原点から左へ、奥へ(ユニット)").units(),
    may("size", Pair(0.25, 60.0), "", "along the front of the house, then back, units; usual for its kind without", "間口の向き、奥行の向きの大きさ(ユニット)。無ければ種類ごとの標準").units(),
    may("faces", Choice(&words(&vocabulary::SIDES)), "F", "the side its front is on, that of stairs' first step", "正面の側。階段は一段目の側"),
];
#[rustfmt::skip]
pub(super) const BRACKETS: &[AttributeSchema] = &[
    may("steps", STEPS, "0", "steps outwards", "手先の数"),
    may("height", NEAR, "", "what they take of the storey's top, shaku", "階の上端から占める高さ(尺)").shaku(),
    may("out", NEAR, "", "from the wall to the purlin they bear, shaku", "壁から丸桁まで(尺)").shaku(),
    may("paint", PAINT, "", "wood or colour; that of the posts without", "材または色。無ければ柱と同じ"),
];
#[rustfmt::skip]
pub(super) const FINIAL: &[AttributeSchema] = &[
    must("kind", Choice(&words(&FinialKind::ALL)), "sorin 相輪, hoju 宝珠, shibi 鴟尾, chigi 千木・鰹木", "sorin 相輪、hoju 宝珠、shibi 鴟尾、chigi 千木・鰹木"),
    may("height", SIZE, "", "shaku", "高さ(尺)").shaku(),
    may("count", Whole(0, 99), "", "of logs (katsuogi)", "鰹木の数"),
    may("at", PLACE, "", "over which place, units; the highest roof without", "どこの上か(ユニット)。無ければいちばん高い屋根").units(),
];

#[rustfmt::skip]
pub(super) const PUT: &[AttributeSchema] = &[
    must("code", Text, "its code in the catalogue, or the name of an own part", "部材コード。自作部材の名でもよい"),
    must("at", PLACE, "its middle: to the left of and back from the house's origin, units", "中心。原点から左へ、奥へ(ユニット)").units(),
    may("turn", Number(-360.0, 360.0), "0", "clockwise from facing the front, degrees", "正面を向いた向きから時計回りの角度(度)"),
    may("width", SIZE, "", "units, in place of the code's own width", "幅(ユニット)。コードの幅に代わる").units(),
    may("height", SIZE, "", "shaku, in place of the part's own height", "高さ(尺)。部材の高さに代わる").shaku(),
];

#[rustfmt::skip]
pub(super) const GROUND: &[AttributeSchema] = &[
    must("surface", Choice(&words(&GroundSurface::ALL)), "gravel, sand (white), moss, grass, paving (slabs), earth", "gravel 砂利、sand 白砂、moss 苔、grass 芝、paving 敷石、earth 土"),
    must("at", PLACE, "its middle: to the left of and back from the house's origin, units", "中心。原点から左へ、奥へ(ユニット)").units(),
    must("size", Pair(0.1, LONG), "along the front of the house, then back, units", "間口の向き、奥行の向きの大きさ(ユニット)").units(),
    may("turn", TURN, "0", "clockwise, degrees", "時計回りの角度(度)"),
];

/// Attributes of all monuments.
#[rustfmt::skip]
const MEASURES: [AttributeSchema; 12] = [
    may("columns", SPAN, "", "height of the columns, shaku", "柱の高さ(尺)").shaku(),
    may("post", THICK, "", "diameter of the columns, shaku", "柱の径(尺)").shaku(),
    may("paint", PAINT, "", "wood or colour", "材または色"),
    may("steps", STEPS, "", "steps of the brackets", "組物の手先の数"),
    may("pitch", Number(0.5, 30.0), "", "of the main roof, sun", "主屋根の勾配(寸)"),
    may("eaves", Number(0.0, 33.0), "", "overhang, shaku", "軒の出(尺)").shaku(),
    may("sori", Number(-50.0, 50.0), "", "curve of the slopes, per cent", "反り(%)"),
    may("thickness", Number(0.05, 6.0), "", "of the roofs, shaku", "屋根の厚さ(尺)").shaku(),
    may("kind", COVERING, "", "covering", "葺き材"),
    may("shape", SHAPE, "", "shape of the main roof", "主屋根の形"),
    may("platform", NEAR, "", "height of the platform, shaku; 0 = none", "基壇の高さ(尺)。0 なら無し").shaku(),
    may("margin", Pair(0.0, 300.0), "", "from the walls to the platform's edge, shaku", "壁から基壇の縁まで(尺)").shaku(),
];
#[rustfmt::skip]
const PAGODA_OWN: [AttributeSchema; 8] = [
    may("storeys", Whole(1, 15), "5", "number of storeys", "重数"),
    may("width", SPAN, "18", "of the first storey, shaku", "初重の幅(尺)").shaku(),
    may("bays", Whole(1, 9), "3", "bays a side", "一辺の間数"),
    may("top_bays", Whole(1, 9), "", "bays a side of the last storey; as the others without", "最上重の一辺の間数。無ければほかの重と同じ"),
    may("taper", Number(0.2, 0.99), "0.7", "the last storey's width in the first", "逓減。最上重の幅の初重に対する比"),
    may("eaves_taper", Number(0.2, 1.5), "", "the last roof's overhang in the first; 1 - 0.6 (1 - taper) without", "軒の出の逓減。最上重の初重に対する比。無ければ 1 - 0.6 (1 - taper)"),
    may("rise", Number(0.1, 3.0), "0.855", "from wall plate to wall plate, in widths of the upper storey", "重ごとの高さ。上の重の幅に対する比"),
    may("sorin", NEAR, "", "height of the spire, shaku; 0.3 of the whole without", "相輪の高さ(尺)。無ければ総高の 0.3").shaku(),
];
#[rustfmt::skip]
const GATE_OWN: [AttributeSchema; 6] = [
    may("bays", BAYS, "5 2", "along and across", "間口と奥行の間数"),
    may("bay", Pair(0.1, 1000.0), "17", "width of a bay, shaku; two numbers: along, across", "柱間(尺)。ふたつ書けば間口と奥行").shaku(),
    may("storeys", Whole(1, 2), "2", "storeys", "重数"),
    may("doors", Whole(0, 60), "", "bays with doors", "扉のある間の数"),
    may("inset", NEAR, "", "how far the upper storey stands back, shaku", "上重の引っ込み(尺)").shaku(),
    may("upper", SPAN, "", "height of the upper columns, shaku", "上重の柱の高さ(尺)").shaku(),
];
pub(super) const PAGODA: &[AttributeSchema] = &join::<8, 12, 20>(PAGODA_OWN, MEASURES);
pub(super) const GATE: &[AttributeSchema] = &join::<6, 12, 18>(GATE_OWN, MEASURES);

/// Attributes of halls and shrines.
#[rustfmt::skip]
const HALL_OWN: [AttributeSchema; 6] = [
    may("doors", Whole(0, 60), "", "bays with doors in the front", "正面の扉の間数"),
    may("aisle", NEAR, "0", "depth of the aisle round the core, shaku", "庇の深さ(尺)").shaku(),
    may("upper", SPAN, "", "height of the core above the aisle's roof, shaku", "庇の屋根から上の身舎の高さ(尺)").shaku(),
    may("veranda", NEAR, "", "width of the veranda, shaku", "縁の幅(尺)").shaku(),
    may("floor", NEAR, "", "height of the floor, shaku", "床の高さ(尺)").shaku(),
    may("katsuogi", Whole(0, 99), "", "logs on the ridge; 0 = no chigi either", "鰹木の数。0 なら千木も無し"),
];
/// The bays of a hall or a shrine: their number, and their width.
#[rustfmt::skip]
const fn bays(number: &'static str, width: &'static str) -> [AttributeSchema; 2] {
    [
        may("bays", BAYS, number, "along and across", "間口と奥行の間数"),
        may("bay", Pair(0.1, 1000.0), width, "width of a bay, shaku; two numbers: along, across", "柱間(尺)。ふたつ書けば間口と奥行").shaku(),
    ]
}
const HALLS: [AttributeSchema; 18] = join::<6, 12, 18>(HALL_OWN, MEASURES);
pub(super) const HALL: &[AttributeSchema] = &join::<2, 18, 20>(bays("5 5", "10"), HALLS);
pub(super) const SHRINE: &[AttributeSchema] = &join::<2, 18, 20>(bays("3 2", "7"), HALLS);

#[rustfmt::skip]
pub(super) const PARAM: &[AttributeSchema] = &[
    must("name", Text, "what expressions call it", "式の中での名"),
    may("default", Text, "", "its value where nobody sets it", "指定が無いときの値"),
    may("min", ANY, "", "its least value", "最小値"),
    may("max", ANY, "", "its greatest value", "最大値"),
    may("step", ANY, "", "values lie so far apart, counted from `min`", "値の刻み。`min` から数える"),
    may("choices", Text, "", "its only values, divided by commas", "選べる値。コンマで区切る"),
    may("random", TRUTH, "no", "a run with `--seed` or `--variants` draws it where nobody sets it", "`--seed` や `--variants` を指定した実行では、指定の無い値を抽選する"),
    may("weights", Text, "", "how often each of its choices comes, one number a choice; makes it random", "選べる値それぞれの出やすさ。書けば抽選になる"),
    may("unit", Text, "", "what it is counted in, for `hsd params`", "単位。`hsd params` に出る"),
    may("doc", Text, "", "what it means, for `hsd params`", "意味。`hsd params` に出る"),
    may("doc_ja", Text, "", "the same in Japanese, for `--lang ja`", "日本語での意味。`--lang ja` のときに出る"),
];
#[rustfmt::skip]
pub(super) const LET: &[AttributeSchema] = &[
    must("name", Text, "what expressions call it", "式の中での名"),
    must("value", Text, "its value", "値"),
];
#[rustfmt::skip]
pub(super) const DEFINE: &[AttributeSchema] = &[
    must("name", Text, "what `use` calls it; all other attributes are parameters with their defaults", "`use` での名。ほかの属性はすべて変数とその既定値"),
];
#[rustfmt::skip]
pub(super) const USE: &[AttributeSchema] = &[
    must("name", Text, "which piece; all other attributes set its parameters", "使う部品の名。ほかの属性はすべて変数"),
];
#[rustfmt::skip]
pub(super) const IF: &[AttributeSchema] = &[must("test", TRUTH, "whether its content counts", "中身を生かすかどうか")];
#[rustfmt::skip]
pub(super) const ELSE: &[AttributeSchema] = &[may("test", TRUTH, "", "a further condition", "さらに付ける条件")];
#[rustfmt::skip]
pub(super) const INCLUDE: &[AttributeSchema] = &[
    must("href", Text, "a file, from the folder of this one and below the root", "ファイル名。このファイルのフォルダーから数え、ルートの下に限る"),
];
#[rustfmt::skip]
pub(super) const PART_DEF: &[AttributeSchema] = &[
    must("code", Text, "five columns, or a longer name", "五桁のコード、またはそれより長い名"),
    may("base", Text, "", "the part that it takes over what it does not say from", "書かない値を引き継ぐ部材"),
    may("ja", Text, "", "its name in Japanese", "和名"),
    may("romaji", Text, "", "the name in letters", "和名のローマ字"),
    may("en", Text, "", "what it is, in English", "英語の説明"),
    may("aliases", Text, "", "other names that `hsd parts` finds it by, with commas", "`hsd parts` で探せる別名。コンマで区切る"),
    may("width", Text, "", "units, 0 to 100; what the fifth column says without", "幅(ユニット)。0 から 100。無ければ五桁目による"),
    may("from", Text, "", "foot of its opening above the floor, shaku, or metres with `m`", "開口の下端。床から(尺、`m` を付ければメートル)"),
    may("to", Text, "", "top of its opening", "開口の上端"),
    may("made", Text, "", "what it is made of, in words", "材料の説明"),
    may("era", Text, "", "when it was built: E, M, N or all", "時代。E、M、N、all"),
    may("weathering", Text, "", "weathering classes joined by `+`", "経年変化の分類。`+` でつなぐ"),
    may("finish", Text, "", "the surface of small walls beside it; with it the part is a wall", "隣の小壁の表面。書けば壁の部材になる"),
    may("stance", Text, "", "how it stands in the frame: posts, bare, modern, fence or none", "軸組との関係。posts、bare、modern、fence、none"),
    may("below", Text, "", "what fills the wall under its opening: dado, wall or open", "開口の下を埋めるもの。dado、wall、open"),
    may("above", Text, "", "whether a small wall fills what is left above its opening", "開口の上に小壁があるか"),
    may("clear", Text, "", "width of an opening narrower than the bay, mm", "柱間より狭い開口の幅(mm)"),
    may("reflection", Text, "", "share of light that its glass mirrors, 0 to 1", "ガラスの映り込みの割合。0 から 1"),
    may("fills", Text, "", "whether it fills the half of a split whatever its heights say", "分割した半分を高さによらず満たすか"),
    may("floor", Text, "", "the floor that one sees through it", "中に見える床"),
    may("parapet", Text, "", "how far the front with it rises above the highest storey, shaku", "最上階の上に立ち上がる高さ(尺)"),
    may("texture", Text, "", "the name of the picture that it shows", "見せる画像の名"),
    may("depth", Text, "", "how far what shows the texture stands out of the wall's centre line, mm", "画像の面が壁心から出る寸法(mm)"),
];
