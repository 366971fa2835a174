//! The attributes of what stands in streets, of water, of farmland and of residences (docs/contract.md 10.4).

use super::EVIDENCE;
use crate::parse::schema::kinds::Kind::{Choice, Number, Text, Whole};
use crate::parse::schema::kinds::{AttributeSchema, may, must, words};
use hsd_ir::ast::Species;
use hsd_ir::ast::land::{Bank, Crop};
use hsd_ir::ast::street::{Board, PoleMade};

const MADE: &[&str] = &words(&PoleMade::WORDS);
const BOARD: &[&str] = &words(&Board::WORDS);
const BANK: &[&str] = &words(&Bank::WORDS);
const CROP: &[&str] = &words(&Crop::WORDS);

const SPACING: AttributeSchema = may(
    "spacing",
    Number(5.0, 200.0),
    "30",
    "how far poles stand apart, as nearly as a whole number of spans allows, metres",
    "柱の間隔(m)。径間が整数個になる、これに最も近い間隔",
)
.metres();
const SAG: AttributeSchema = may(
    "sag",
    Number(0.0, 0.2),
    "0.02",
    "how far wires hang down in the middle, as a share of the span",
    "電線のたるみ。径間に対する割合",
);
const POLE_MADE: AttributeSchema = may(
    "made",
    Choice(MADE),
    "concrete",
    "what poles are made of",
    "柱の材料",
);

#[rustfmt::skip]
pub(in crate::parse::schema) const POLE: &[AttributeSchema] = &[
    may("height", Number(3.0, 80.0), "9", "of a pole, metres", "柱の高さ(m)").metres(),
    SPACING,
    may("wires", Whole(0, 12), "3", "the number of wires from pole to pole", "柱から柱への電線の数"),
    SAG,
    POLE_MADE,
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const NETWORK: &[AttributeSchema] = &[
    may("height", Number(3.0, 80.0), "9", "of a pole, metres", "柱の高さ(m)").metres(),
    SPACING,
    may("reach", Number(5.0, 200.0), "20", "how far the nearest pole of a house may be, metres; poles between the houses bring it nearer", "家から最寄りの柱までの距離の上限(m)。遠い家へは家の間に柱を足す").metres(),
    may("wires", Whole(0, 12), "3", "the number of wires from pole to pole; one goes from a pole to each house", "柱から柱への電線の数。家へは柱から一本引き込む"),
    SAG,
    POLE_MADE,
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const WIRE: &[AttributeSchema] = &[
    may("height", Number(1.0, 100.0), "8", "over the ground at the corners of the line, metres", "線の各点での地面からの高さ(m)").metres(),
    may("wires", Whole(1, 12), "1", "their number", "電線の数"),
    SAG,
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const SIGNAL: &[AttributeSchema] = &[
    may("azimuth", Number(-3600.0, 3600.0), "", "the direction that it faces, degrees clockwise from north; without, one for each road that comes in", "灯器の向き。北から時計回りの度。無ければ、入ってくる道ごとに一基"),
    may("height", Number(2.0, 10.0), "5", "of its lamps, metres", "灯器の高さ(m)").metres(),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const SIGN: &[AttributeSchema] = &[
    must("text", Text, "what is written on it, in the letters of the town's `font`, or in capitals and figures of our own", "書く文字。町の `font` の字形、無ければ自前のローマ字の大文字と数字で書く"),
    may("azimuth", Number(-3600.0, 3600.0), "", "the direction that it faces, degrees clockwise from north; without, along the nearest street", "向き。北から時計回りの度。無ければ最も近い通りに沿う向き"),
    may("size", Number(0.02, 5.0), "0.2", "of its letters, metres", "文字の大きさ(m)").metres(),
    may("height", Number(0.0, 30.0), "2.2", "of its lower edge, metres", "板の下端の高さ(m)").metres(),
    may("board", Choice(BOARD), "blue", "the board under the letters", "文字の下の板"),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const ARCADE: &[AttributeSchema] = &[
    may("depth", Number(0.5, 40.0), "3", "how far the roof reaches from the line to the right, metres", "線から右へ屋根が届く距離(m)").metres(),
    may("height", Number(2.0, 20.0), "3.2", "of its eaves at the street, metres", "通り側の軒の高さ(m)").metres(),
    may("bay", Number(1.0, 20.0), "4", "how far posts stand apart, as nearly as a whole number of bays allows, metres", "柱の間隔(m)。柱間が整数個になる、これに最も近い間隔").metres(),
    EVIDENCE,
];
/// The attributes of one part that is as long as its line.
const fn one(code: &'static str) -> [AttributeSchema; 3] {
    [
        may(
            "code",
            Text,
            code,
            "the part that stands on the line, as wide as it is long",
            "線の上に立つ部材。線の長さが幅になる",
        ),
        may(
            "height",
            Number(0.5, 100.0),
            "",
            "shaku; without, it grows with the length of the line",
            "高さ(尺)。無ければ線の長さに比例する",
        )
        .shaku(),
        EVIDENCE,
    ]
}
pub(in crate::parse::schema) const TORII: &[AttributeSchema] = &one("ORI 4");
pub(in crate::parse::schema) const LANTERN: &[AttributeSchema] = &one("OTO");
#[rustfmt::skip]
pub(in crate::parse::schema) const WATER: &[AttributeSchema] = &[
    may("width", Number(0.3, 2000.0), "4", "along a line: from bank to bank, metres", "線に沿うとき: 岸から岸までの幅(m)").metres(),
    may("bank", Choice(BANK), "stone", "what its banks are made of", "岸の材料"),
    may("bank_width", Number(0.1, 20.0), "0.5", "width of a bank, metres", "岸の幅(m)").metres(),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const FARMLAND: &[AttributeSchema] = &[
    may("crop", Choice(CROP), "rice", "what grows there", "作物"),
    may("width", Number(2.0, 500.0), "10.91", "how wide a field is across the grid, metres; a square of 109.09 m (one 町) holds a whole number of them", "格子に直角な向きの田畑の幅(m)。109.09 m(1 町)四方に整数枚が並ぶ").metres(),
    may("depth", Number(2.0, 500.0), "109.09", "how deep it is along the grid, metres", "格子に沿う奥行(m)").metres(),
    may("azimuth", Number(-3600.0, 3600.0), "0", "the direction of the grid, degrees clockwise from north: fields of one direction line up over the whole town", "格子の向き。北から時計回りの度。同じ向きの田畑は町全体で揃う"),
    may("ridge", Number(0.1, 10.0), "0.5", "width of the ridges between fields, metres", "畦の幅(m)").metres(),
    may("way", Number(0.0, 30.0), "1.8", "width of the ways between the squares of the grid, metres", "1 町ごとの道の幅(m)").metres(),
    EVIDENCE,
];
const GATES: &[&str] = &[
    "none",
    "kabuki-mon",
    "kido",
    "munamon",
    "yakui-mon",
    "korai-mon",
    "shikyaku-mon",
];
const GROWN: &[&str] = &words(&Species::WORDS);
#[rustfmt::skip]
pub(in crate::parse::schema) const RESIDENCE: &[AttributeSchema] = &[
    may("house", Text, "shoin", "the type of the house at its centre: one of the library or of the town, or `shoin`, two wings as large as the plot has room for", "中央の家の型。型紙か町で定義したもの、または敷地に応じた大きさの二翼の `shoin`"),
    may("code", Text, "KDB", "the units of the wall round it, or `none`", "まわりの塀の部材。`none` なら塀なし"),
    may("height", Number(0.5, 100.0), "7.5", "of the wall, shaku", "塀の高さ(尺)").shaku(),
    may("gate", Number(0.0, 30.0), "4.5", "how wide the opening for its gate is, in the middle of its front, metres; 0 for none", "正面の中央にあける門口の幅(m)。0 なら無し").metres(),
    may("gatehouse", Choice(GATES), "yakui-mon", "the gate that stands there", "そこに立つ門の格式"),
    may("species", Choice(GROWN), "pine", "the trees of its garden", "庭木の種類"),
    may("spacing", Number(0.0, 500.0), "9", "how far they stand apart, metres; 0 for none", "庭木の間隔(m)。0 なら無し").metres(),
    EVIDENCE,
];
#[rustfmt::skip]
pub(in crate::parse::schema) const BLOCK: &[AttributeSchema] = &[
    may("side", Number(20.0, 1000.0), "119.2", "the side of a whole block, metres: 40 jo of 2.98 m. By the share of it that the area is it bears a shinden with three halls (over 0.7), one with as many as its front has room for (over 0.35), a hall behind a board fence (over 0.12), or a row of dwellings", "町一つの一辺(m)。40 丈、1 丈は 2.98 m。面積がその 0.7 を超えれば三殿の寝殿造、0.35 を超えれば間口に応じた寝殿造、0.12 を超えれば板塀の中の一殿、それ以下は小家になる").metres(),
    EVIDENCE,
];
