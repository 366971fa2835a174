//! The meanings of the words of the language, and the names that authors write instead: in English, in Japanese, or in
//! romaji. Readers of both forms suggest the word for a name, and editors show the meaning.

use hsd_base::diagnostic::{Noun, noun};
use hsd_ir::catalog::Query;
use std::ops::RangeInclusive;
use std::sync::LazyLock;

/// A word of the language.
pub struct Meaning {
    /// The word.
    pub word: &'static str,
    /// Its meaning.
    pub noun: Noun,
    /// Other names for it; a [`Query`] treats spellings of one name as equal.
    names: &'static [&'static str],
}

impl Meaning {
    /// Returns the meaning, unless the word explains itself.
    pub(super) fn shown(&self) -> Option<Noun> {
        (!self.noun.en.is_empty()).then_some(self.noun)
    }
}

const fn means(
    word: &'static str,
    en: &'static str,
    ja: &'static str,
    names: &'static [&'static str],
) -> Meaning {
    Meaning {
        word,
        noun: noun(en, ja),
        names,
    }
}

/// The covering of a roof.
#[rustfmt::skip]
pub const COVERINGS: [Meaning; 7] = [
    means("K", "pantiles (sangawara)", "桟瓦葺", &["瓦", "瓦葺", "桟瓦", "kawara", "kawarabuki", "sangawara", "tile", "tiles", "tiled", "pantile", "pantiles"]),
    means("G", "cover tiles (hon-gawara)", "本瓦葺", &["本瓦", "hongawara", "cover tiles"]),
    means("I", "boards (ita)", "板葺", &["板", "ita", "itabuki", "board", "boards", "planks"]),
    means("S", "shingles (kokera)", "杮葺", &["柿", "杮", "柿葺", "こけら", "kokera", "kokerabuki", "shingle", "shingles", "shingled"]),
    means("H", "bark (hiwada)", "檜皮葺", &["檜皮", "hiwada", "hiwadabuki", "bark", "cypress bark"]),
    means("Y", "thatch (kaya)", "茅葺", &["茅", "萱", "葦", "藁", "藁葺", "草葺", "kaya", "kayabuki", "wara", "thatch", "thatched", "straw", "reed"]),
    means("T", "metal (totan)", "トタン葺", &["トタン", "鉄板", "金属", "銅板", "totan", "metal", "tin", "steel", "copper"]),
];

/// The forms of roofs.
#[rustfmt::skip]
pub const SHAPES: [Meaning; 17] = [
    means("KIR", "gable (kirizuma)", "切妻", &["切妻造", "切妻屋根", "kirizuma", "gable", "gabled", "gables", "round", "barrel", "saltbox", "double_saltbox", "crosspitched"]),
    means("KAT", "lean-to (katanagare)", "片流れ", &["片流", "片流れ屋根", "katanagare", "lean-to", "lean_to", "skillion", "shed", "sawtooth"]),
    means("HIS", "pent roof (hisashi)", "庇", &["廂", "ひさし", "hisashi", "pent", "pent roof"]),
    means("YOS", "hip (yosemune)", "寄棟", &["寄棟造", "寄棟屋根", "yosemune", "hip", "hipped", "side_hipped"]),
    means("IRI", "hip and gable (irimoya)", "入母屋", &["入母屋造", "入母屋屋根", "irimoya", "hip and gable", "hipped-and-gabled"]),
    means("HOG", "pyramid (hogyo)", "宝形", &["宝形造", "方形", "方形造", "hogyo", "hōgyō", "pyramid", "pyramidal", "dome", "cone", "onion"]),
    means("YOK", "gable along the short side (yokonaga)", "横長切妻", &["妻入", "yokonaga-kirizuma", "yokonaga"]),
    means("HAK", "half-hip (hakama-goshi)", "袴腰", &["袴腰屋根", "半切妻", "hakama-goshi", "half-hip", "half-hipped", "side_half-hipped"]),
    means("TER", "temple: irimoya with sori (tera)", "寺院", &["寺", "tera", "temple"]),
    means("KAR", "undulating gable (karahafu)", "唐破風", &["karahafu"]),
    means("RIK", "flat (rikuyane)", "陸屋根", &["陸", "平屋根", "rikuyane", "flat"]),
    means("KOS", "gambrel (koshiore)", "腰折れ", &["腰折", "腰折屋根", "腰折れ屋根", "koshiore", "koshiore-yane", "gambrel", "barn"]),
    means("MAN", "mansard", "マンサード", &["マンサード屋根", "mansard", "mansādo"]),
    means("CHI", "triangular dormer gable (chidori-hafu)", "千鳥破風", &["千鳥", "chidori", "chidori-hafu", "chidorihafu", "dormer"]),
    means("NOK", "undulating gable in the eaves (noki-karahafu)", "軒唐破風", &["軒唐", "noki-karahafu", "nokikarahafu"]),
    means("KOY", "monitor on the ridge (koshi-yane)", "越屋根", &["煙出し", "煙出", "越し屋根", "koshi-yane", "koshiyane", "kemuridashi", "monitor", "clerestory"]),
    means("UDA", "fire wall over the roof (hon-udatsu)", "本卯建", &["卯建", "うだつ", "本うだつ", "hon-udatsu", "honudatsu", "udatsu", "fire wall"]),
];

/// Ridges and falls.
#[rustfmt::skip]
pub const DIRECTIONS: [Meaning; 6] = [
    means("X", "ridge along the first line", "棟が最初の行に平行", &["平", "平入", "hirairi"]),
    means("Y", "ridge across the first line", "棟が最初の行に直交", &["妻", "妻入", "tsumairi"]),
    means("F", "one slope, falls to the front", "前へ下る片流れ", FRONT),
    means("B", "one slope, falls to the back", "奥へ下る片流れ", BACK),
    means("L", "one slope, falls to the left", "左へ下る片流れ", LEFT),
    means("R", "one slope, falls to the right", "右へ下る片流れ", RIGHT),
];

const FRONT: &[&str] = &["front", "前", "正面", "表", "mae", "omote"];
const BACK: &[&str] = &[
    "back", "rear", "奥", "裏", "後", "背面", "oku", "ura", "ushiro",
];
const LEFT: &[&str] = &["left", "左", "hidari"];
const RIGHT: &[&str] = &["right", "右", "migi"];

/// The sides of a house.
pub const SIDES: [Meaning; 4] = [
    means("F", "front", "前", FRONT),
    means("B", "back", "奥", BACK),
    means("L", "left", "左", LEFT),
    means("R", "right", "右", RIGHT),
];

/// The turns between walls.
const TURNS: [Meaning; 2] = [
    means("R", "right", "右", RIGHT),
    means("L", "left", "左", LEFT),
];

/// The railings of platforms and verandas.
#[rustfmt::skip]
pub const RAILS: [Meaning; 3] = [
    means("none", "no railing", "高欄なし", NO),
    means("crossed", "railing whose beams cross", "組高欄", &["組勾欄", "跳高欄", "kumikoran"]),
    means("knobbed", "railing with knobbed posts", "擬宝珠高欄", &["擬宝珠", "擬宝珠勾欄", "giboshi"]),
];

/// The floors of rooms.
#[rustfmt::skip]
pub const FLOORS: [Meaning; 3] = [
    means("boards", "boards", "板の間", &["板", "板張り", "板敷", "itanoma", "ita", "wood", "planks"]),
    means("tatami", "mats", "畳敷", &["畳", "mat", "mats"]),
    means("earth", "pounded earth (doma)", "土間", &["土", "三和土", "doma", "tataki", "dirt"]),
];

/// How mats lie.
#[rustfmt::skip]
pub const MATS: [Meaning; 2] = [
    means("festive", "no four corners meet", "祝儀敷き", &["祝儀", "shugi", "shugijiki"]),
    means("rows", "all in rows", "不祝儀敷き", &["不祝儀", "平敷き", "fushugi", "fushugijiki", "grid"]),
];

/// The ceilings of rooms.
#[rustfmt::skip]
pub const CEILINGS: [Meaning; 3] = [
    means("battens", "boards on battens", "棹縁天井", &["棹縁", "竿縁", "竿縁天井", "saobuchi", "boards"]),
    means("joists", "the joists of the floor above", "大和天井", &["根太天井", "踏天井", "大和", "yamato", "beams"]),
    means("none", "none up to the roof", "吹き抜け", &["吹抜", "fukinuke", "open", "無し", "なし"]),
];

/// What is built into rooms.
#[rustfmt::skip]
pub const FIXTURES: [Meaning; 9] = [
    means("tokonoma", "an alcove with a scroll", "床の間", &["床", "toko", "alcove"]),
    means("chigaidana", "staggered shelves", "違い棚", &["違棚", "棚", "床脇", "tokowaki", "shelves"]),
    means("butsudan", "the household altar", "仏壇", &["仏間", "altar"]),
    means("oshi-ire", "a closet", "押入", &["押入れ", "押し入れ", "oshiire", "closet", "cupboard"]),
    means("stairs", "open stairs", "階段", &["梯子段", "段", "kaidan", "hashigo", "stair", "ladder"]),
    means("hako-kaidan", "stairs of chests", "箱階段", &["箪笥階段", "hakokaidan", "kaidan-dansu", "chest stairs"]),
    means("kamado", "a row of clay stoves", "竈", &["かまど", "おくどさん", "へっつい", "竃", "kudo", "hettsui", "stove", "hearth"]),
    means("well", "a well", "井戸", &["井筒", "ido"]),
    means("sink", "a sink with its water jar", "流し", &["走り", "走り元", "水屋", "nagashi", "hashiri"]),
];

/// The colours of timber.
#[rustfmt::skip]
pub const PAINTS: [Meaning; 6] = [
    means("cedar", "plain cedar", "杉の素木", &["杉", "sugi"]),
    means("hinoki", "plain cypress", "檜の素木", &["檜", "cypress"]),
    means("keyaki", "plain zelkova", "欅の素木", &["欅", "zelkova"]),
    means("vermilion", "vermilion paint", "丹塗", &["朱", "朱塗", "丹", "ninuri", "red"]),
    means("bengara", "iron red stain", "弁柄塗", &["弁柄", "紅殻", "ベンガラ"]),
    means("sooted", "stained with soot", "煤塗", &["煤", "煤竹", "susu", "black"]),
];

/// The gable walls of irimoya.
#[rustfmt::skip]
pub const GABLE_WALLS: [Meaning; 2] = [
    means("wall", "as the wall below", "下の壁と同じ", &["壁", "plain", "plaster"]),
    means("lattice", "boards behind a square lattice (kitsune-goshi)", "狐格子", &["格子", "木連格子", "kitsune-goshi", "kitsunegoshi", "kizuregoshi"]),
];

/// The finials of roofs.
#[rustfmt::skip]
pub const FINIALS: [Meaning; 4] = [
    means("sorin", "the spire of a pagoda", "相輪", &["spire"]),
    means("hoju", "a jewel", "宝珠", &["jewel"]),
    means("shibi", "fish tails at the ridge's ends", "鴟尾", &["fish tails"]),
    means("chigi", "crossed boards and logs of a shrine", "千木・鰹木", &["千木", "鰹木", "katsuogi"]),
];

/// The eras of houses.
#[rustfmt::skip]
pub const ERAS: [Meaning; 4] = [
    means("E", "Edo", "江戸", &["edo", "江戸時代"]),
    means("M", "Meiji to early Showa", "明治から昭和初期", &["meiji", "taisho", "明治", "大正", "明治時代", "大正時代"]),
    means("N", "contemporary", "現代", &["modern", "new"]),
    means("all", "any time", "いつでも", &["any"]),
];

/// What houses are for.
#[rustfmt::skip]
const PURPOSES: [Meaning; 8] = [
    means("dwelling", "", "住まい", &["住宅", "家", "民家", "house", "home", "residence", "residential", "detached", "terrace"]),
    means("store", "", "蔵", &["倉", "倉庫", "土蔵", "店", "kura", "shop", "retail", "storehouse", "warehouse"]),
    means("hall", "", "堂", &["仏堂", "お堂", "do", "dō", "pagoda"]),
    means("temple", "", "寺", &["寺院", "本堂", "tera"]),
    means("shrine", "", "社殿", &["神社", "社", "本殿", "jinja"]),
    means("gate", "", "門", &["mon", "gatehouse"]),
    means("shed", "", "小屋", &["物置", "差掛け", "koya", "hut", "garage", "roof"]),
    means("block", "", "ビル", &["マンション", "団地", "flats", "apartments", "office", "offices", "commercial", "hotel"]),
];

/// Compass directions that a front can look to, degrees.
#[rustfmt::skip]
const COMPASS: [Meaning; 8] = [
    means("0", "north", "北", &["north", "n", "kita"]),
    means("45", "north-east", "北東", &["northeast", "north-east", "ne", "hokuto", "東北"]),
    means("90", "east", "東", &["east", "e", "higashi"]),
    means("135", "south-east", "南東", &["southeast", "south-east", "se", "nanto", "東南"]),
    means("180", "south", "南", &["south", "s", "minami"]),
    means("225", "south-west", "南西", &["southwest", "south-west", "sw", "nansei", "西南"]),
    means("270", "west", "西", &["west", "w", "nishi"]),
    means("315", "north-west", "北西", &["northwest", "north-west", "nw", "hokusei", "西北"]),
];

/// Modules of plans: one U in shaku.
#[rustfmt::skip]
const MODULES: [Meaning; 3] = [
    means("3", "Edo-ma", "江戸間", &["edoma", "edo", "edo-ma", "関東間", "kantoma", "田舎間", "inakama"]),
    means("3.15", "the Kyo-ma mat", "京間の畳", &["京畳", "畳割", "kyoma mat", "kyo-ma mat", "tatamiwari"]),
    means("3.25", "Kyo-ma", "京間", &["kyoma", "kyo", "kyo-ma", "kyōma", "本間", "honma", "関西間", "kansaima"]),
];

/// Returns the number that is meant by its name, for an attribute or a key of this name: `kyoma` for a unit is 3.25.
pub(super) fn number_called(name: &str, attribute: &str) -> Option<&'static Meaning> {
    match attribute {
        "azimuth" => called(name, &COMPASS),
        "unit" => called(name, &MODULES),
        _ => None,
    }
}

/// `yes` and `no`, which need no explanation.
const TRUTHS: [Meaning; 2] = [means("yes", "", "", YES), means("no", "", "", NO)];

const YES: &[&str] = &[
    "yes", "true", "on", "はい", "有", "有り", "あり", "hai", "ari",
];
const NO: &[&str] = &[
    "no",
    "false",
    "off",
    "none",
    "いいえ",
    "無",
    "無し",
    "なし",
    "iie",
    "nashi",
];

const TABLES: &[&[Meaning]] = &[
    &COVERINGS,
    &SHAPES,
    &DIRECTIONS,
    &SIDES,
    &TURNS,
    &RAILS,
    &FLOORS,
    &MATS,
    &CEILINGS,
    &FIXTURES,
    &PAINTS,
    &GABLE_WALLS,
    &FINIALS,
    &ERAS,
    &PURPOSES,
    &COMPASS,
    &MODULES,
    &TRUTHS,
];

/// Returns the words of a table with their meanings.
pub const fn nouns<const N: usize>(table: &[Meaning; N]) -> [(&'static str, Noun); N] {
    let mut nouns = [("", noun("", "")); N];
    let mut at = 0;
    while at < N {
        nouns[at] = (table[at].word, table[at].noun);
        at += 1;
    }
    nouns
}

/// The search keys of all names, by table and word, computed once.
static KEYS: LazyLock<Vec<Vec<Vec<String>>>> = LazyLock::new(|| {
    let keys = |meaning: &Meaning| {
        let names = meaning.names.iter().chain([&meaning.noun.ja]);
        names.map(|name| Query::key(name)).collect()
    };
    let tables = TABLES.iter();
    tables.map(|t| t.iter().map(keys).collect()).collect()
});

/// Returns the word of a table with this name.
pub(super) fn called(name: &str, table: &[Meaning]) -> Option<&'static Meaning> {
    let same = |other: &&[Meaning]| words(other).eq(words(table));
    let number = TABLES.iter().position(same)?;
    let query = Query::new(name);
    let is = |keys: &Vec<String>| keys.iter().any(|key| query.is_key(key));
    let found = KEYS[number].iter().position(is)?;
    Some(&TABLES[number][found])
}

fn words(table: &[Meaning]) -> impl Iterator<Item = &'static str> {
    table.iter().map(|meaning| meaning.word)
}

/// Returns the one of some words with this name; a table must have no word but these.
pub(super) fn among(name: &str, words: &[&str]) -> Option<&'static Meaning> {
    let of = |table: &&&[Meaning]| table.iter().all(|m| words.contains(&m.word));
    let most = |table: &&&[Meaning]| table.len();
    called(name, TABLES.iter().filter(of).max_by_key(most)?)
}

/// Returns the digits of a number written as a word: `none` is 0, `四` is 4.
pub(super) fn digits(word: &str, bounds: &RangeInclusive<f64>) -> Option<String> {
    const KANJI: &str = "〇一二三四五六七八九十";
    let mut chars = word.chars();
    let kanji = chars
        .next()
        .and_then(|c| KANJI.chars().position(|k| k == c));
    let number = match is_truth(word) {
        Some(truth) => (!truth).then_some(0)?,
        None => kanji.filter(|_| chars.next().is_none())?,
    };
    bounds
        .contains(&(number as f64))
        .then(|| number.to_string())
}

/// Returns the truth value of a word.
pub(super) fn is_truth(word: &str) -> Option<bool> {
    called(word, &TRUTHS).map(|meaning| meaning.word == "yes")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_in_any_language_and_spelling() {
        for (name, word) in [
            ("kawara", "K"),
            ("瓦葺き", "K"),
            ("桧皮", "H"),
            ("ヒワダ", "H"),
            ("Thatch", "Y"),
            ("茅葺き", "Y"),
        ] {
            assert_eq!(
                called(name, &COVERINGS).map(|m| m.word),
                Some(word),
                "{name}"
            );
        }
        assert_eq!(called("hougyou", &SHAPES).map(|m| m.word), Some("HOG"));
        assert_eq!(among("右", &["R", "L"]).map(|m| m.noun.en), Some("right"));
        assert!(among("右", &["R", "S"]).is_none() && called("", &SHAPES).is_none());
        assert_eq!(digits("なし", &(-50.0..=50.0)).as_deref(), Some("0"));
        assert_eq!(digits("四", &(0.0..=100.0)).as_deref(), Some("4"));
        assert_eq!(digits("yes", &(0.0..=100.0)), None);
    }
}
