//! The words of roof lines: option letters with their bounds, and the names that authors write out for letters.

use super::words::Range64;

/// Options with a number, by letter.
pub(super) const OPTIONS: [(char, Range64); 8] = [
    (
        'P',
        Range64 {
            what: "the pitch",
            bounds: 0.1..=30.0,
            unit: "sun per shaku",
        },
    ),
    (
        'E',
        Range64 {
            what: "the eaves",
            bounds: 0.0..=20.0,
            unit: "shaku",
        },
    ),
    (
        'G',
        Range64 {
            what: "the verge",
            bounds: 0.0..=20.0,
            unit: "shaku",
        },
    ),
    (
        'T',
        Range64 {
            what: "the thickness",
            bounds: 0.05..=5.0,
            unit: "shaku",
        },
    ),
    (
        'M',
        Range64 {
            what: "the number of ridge courses",
            bounds: 0.0..=20.0,
            unit: "courses",
        },
    ),
    (
        'S',
        Range64 {
            what: "the sag of the slope",
            bounds: -20.0..=20.0,
            unit: "per cent",
        },
    ),
    (
        'C',
        Range64 {
            what: "the place of the gable",
            bounds: 0.0..=0.5,
            unit: "of the span",
        },
    ),
    (
        'R',
        Range64 {
            what: "the length of the ridge",
            bounds: 0.0..=1.0,
            unit: "of the roof's length",
        },
    ),
];

/// What authors call the shapes who write them out.
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

/// The same for the kinds.
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
/// The letters of a shape or kind that is written out.
pub(super) fn named(word: &str, names: &[(&'static str, &[&str])]) -> Option<&'static str> {
    let same = |names: &[&str]| names.iter().any(|n| n.eq_ignore_ascii_case(word));
    let found = names.iter().find(|(_, names)| same(names));
    found.map(|(letters, _)| *letters)
}
