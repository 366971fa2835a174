//! The words of roof lines: option letters with their bounds, and the names that authors write instead of letters.

use super::words::Range64;
use crate::diagnostic::noun;

/// Options with a number, by letter.
pub(super) const OPTIONS: [(char, Range64); 8] = [
    (
        'P',
        Range64 {
            what: noun("the pitch", "勾配"),
            bounds: 0.1..=30.0,
            unit: noun("sun per shaku", "寸勾配"),
        },
    ),
    (
        'E',
        Range64 {
            what: noun("the eaves", "軒の出"),
            bounds: 0.0..=20.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'G',
        Range64 {
            what: noun("the verge", "螻羽の出"),
            bounds: 0.0..=20.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'T',
        Range64 {
            what: noun("the thickness", "屋根の厚さ"),
            bounds: 0.05..=5.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'M',
        Range64 {
            what: noun("the number of ridge courses", "のし瓦の段数"),
            bounds: 0.0..=20.0,
            unit: noun("courses", "段"),
        },
    ),
    (
        'S',
        Range64 {
            what: noun("the sag of the slope", "反り"),
            bounds: -20.0..=20.0,
            unit: noun("per cent", "パーセント"),
        },
    ),
    (
        'C',
        Range64 {
            what: noun("the place of the gable", "妻の位置"),
            bounds: 0.0..=0.5,
            unit: noun("of the span", "梁間に対する比"),
        },
    ),
    (
        'R',
        Range64 {
            what: noun("the length of the ridge", "棟の長さ"),
            bounds: 0.0..=1.0,
            unit: noun("of the roof's length", "屋根の長さに対する比"),
        },
    ),
];

/// Long names of shapes.
pub(super) const SHAPE_NAMES: [(&str, &[&str]); 11] = [
    ("KIR", &["切妻", "切妻造", "切妻屋根", "kirizuma", "gable"]),
    ("YOS", &["寄棟", "寄棟造", "寄棟屋根", "yosemune", "hip"]),
    (
        "YOK",
        &["横長切妻", "妻入", "yokonaga-kirizuma", "yokonaga"],
    ),
    ("IRI", &["入母屋", "入母屋造", "入母屋屋根", "irimoya"]),
    (
        "HAK",
        &["袴腰", "袴腰屋根", "半切妻", "hakama-goshi", "half-hip"],
    ),
    (
        "HOG",
        &[
            "宝形",
            "宝形造",
            "方形",
            "方形造",
            "hogyo",
            "hōgyō",
            "pyramid",
        ],
    ),
    (
        "KAT",
        &["片流れ", "片流", "片流れ屋根", "katanagare", "lean-to"],
    ),
    ("HIS", &["庇", "廂", "ひさし", "hisashi", "pent"]),
    ("TER", &["寺", "寺院", "tera", "temple"]),
    ("KAR", &["唐破風", "karahafu"]),
    ("RIK", &["陸屋根", "陸", "平屋根", "rikuyane", "flat"]),
];

/// Long names of kinds.
pub(super) const KIND_NAMES: [(&str, &[&str]); 7] = [
    (
        "K",
        &["瓦", "瓦葺", "瓦葺き", "桟瓦", "kawara", "tile", "tiles"],
    ),
    (
        "G",
        &["本瓦", "本瓦葺", "本瓦葺き", "hongawara", "hon-gawara"],
    ),
    ("I", &["板", "板葺", "板葺き", "ita", "board", "boards"]),
    (
        "S",
        &[
            "柿",
            "杮",
            "柿葺",
            "杮葺",
            "こけら",
            "kokera",
            "shingle",
            "shingles",
        ],
    ),
    ("H", &["檜皮", "桧皮", "檜皮葺", "hiwada", "bark"]),
    ("Y", &["茅", "萱", "茅葺", "茅葺き", "藁", "kaya", "thatch"]),
    ("T", &["トタン", "鉄板", "totan", "metal"]),
];
/// Returns the letters of a shape or kind that is written out.
pub(super) fn named(word: &str, names: &[(&'static str, &[&str])]) -> Option<&'static str> {
    let same = |names: &[&str]| names.iter().any(|n| n.eq_ignore_ascii_case(word));
    let found = names.iter().find(|(_, names)| same(names));
    found.map(|(letters, _)| *letters)
}
