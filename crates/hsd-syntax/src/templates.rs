//! Templates, the source files that `hsd new` copies: the house types of `library/`, which fit any plot and any front,
//! and finished houses of `examples/`.
//!
//! In the library the town houses share their fronts in a file that they include. A copy is complete: the included
//! definitions are written into it.

use hsd_base::diagnostic::{Noun, noun};
use hsd_ir::catalog::Query;

/// A source file to start from.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The name on the command line and of the file.
    pub word: &'static str,
    /// The Japanese name.
    pub ja: &'static str,
    /// The Japanese name, romanised.
    pub romaji: &'static str,
    /// The English name.
    pub en: &'static str,
    /// Other names by which a search finds it, separated by commas.
    pub aliases: &'static str,
}

/// Files that some templates include, and the lines that include them.
const INCLUDED: [(&str, &str); 3] = [
    (
        "  <include href=\"fronts.hsd\"/>
",
        "fronts",
    ),
    (
        "  <include href=\"plans.hsd\"/>
",
        "plans",
    ),
    (
        "  <include href=\"outlines.hsd\"/>
",
        "outlines",
    ),
];

macro_rules! templates {
    ($($word:literal $ja:literal $romaji:literal $en:literal $aliases:literal)*) => {
        &[$(Template {
            word: $word,
            ja: $ja,
            romaji: $romaji,
            en: $en,
            aliases: $aliases,
        }),*]
    };
}

/// The definitions behind the elements `Residence` and `Block` of a town.
pub static GROUNDS: Template = Template {
    word: "grounds",
    ja: "屋敷と町",
    romaji: "yashiki to machi",
    en: "residences and blocks",
    aliases: "",
};

/// The house types of `library/`: the seven of Kyoto's town houses (000-11) first.
pub static TYPES: &[Template] = templates! {
    "so-nikai" "総二階" "sō-nikai" "town house of two full storeys"
    "町家, 京町家, 商家, 本二階, machiya, kyō-machiya, shōka, merchant house, shop"
    "chu-nikai" "中二階" "chū-nikai" "town house with a low upper floor"
    "町家, 京町家, 商家, 厨子二階, つし二階, machiya, kyō-machiya, shōka, tsushi-nikai, merchant house, shop"
    "sangai" "三階建" "sangai-date" "town house of three storeys"
    "町家, 京町家, 旅館, 宿, machiya, kyō-machiya, ryokan, yado, inn, hotel"
    "hiraya" "平屋建" "hiraya-date" "town house of one storey"
    "町家, 京町家, 平家, machiya, kyō-machiya, bungalow"
    "shimotaya" "仕舞屋" "shimotaya" "town house without a shop"
    "町家, 京町家, machiya, kyō-machiya, dwelling"
    "hei-tsuki" "塀付" "hei-tsuki" "dwelling behind a high wall with a gate"
    "町家, 京町家, 大塀造, 高塀造, 塀, hei, machiya, kyō-machiya, daibei-zukuri, taihei-zukuri, garden wall, fence"
    "kanban" "看板建築" "kanban-kenchiku" "old machiya behind a front of mortar"
    "町家, 商店, machiya, shōten, store, shop"
    "ura-nagaya" "裏長屋" "ura-nagaya" "row of dwellings along an alley"
    "長屋, 裏店, 長家, nagaya, uradana, row house, terrace, tenement"
    "roji" "路地" "roji" "well, privies or gate of an alley"
    "井戸, 井, 厠, 便所, 雪隠, 後架, 木戸, 路地木戸, ido, kawaya, setchin, kōka, kido, well, privy, toilet, alley"
    "kura" "土蔵" "dozō" "storehouse"
    "蔵, 倉, 倉庫, 店蔵, kura, misegura, warehouse, granary"
    "buke-nagaya" "武家長屋" "buke-nagaya" "outer row of a samurai residence"
    "武家屋敷, 大名屋敷, 長屋門, 表長屋, 門, buke-yashiki, daimyō-yashiki, nagaya-mon, omote-nagaya, mon, samurai house, row house, gatehouse"
    "buke-bei" "築地塀" "tsuiji-bei" "earth wall of a residence, with a gate"
    "武家屋敷, 築地, 土塀, 塀, 薬医門, 門, buke-yashiki, dobei, hei, yakui-mon, mon, mud wall, fence"
    "taka-bei" "高塀" "taka-bei" "high wall with a gate"
    "塀, 大塀, 板塀, 門, hei, ita-bei, mon, garden wall, board fence"
    "mon" "門" "mon" "gate by its rank"
    "冠木門, 木戸門, 棟門, 薬医門, 高麗門, 四脚門, 表門, 山門, kabuki-mon, kido-mon, munamon, yakui-mon, kōrai-mon, shikyaku-mon, omote-mon, sanmon, gateway"
    "hondo" "本堂" "hondō" "main hall of a temple"
    "寺, 寺院, お寺, 仏堂, 金堂, tera, jiin, butsudō, kondō, temple"
    "tahoto" "多宝塔" "tahōtō" "pagoda of a square and a round storey"
    "塔, 仏塔, 二重塔, 寺, 寺院, お寺, tō, tera, stupa, two-storey pagoda, temple"
    "modern-house" "現代住宅" "gendai-jūtaku" "dwelling of today"
    "住宅, 民家, 一戸建, 戸建, jūtaku, detached house, modern house, villa"
    "office" "事務所ビル" "jimusho-biru" "office building"
    "事務所, オフィス, ビル, jimusho, ofisu, biru, skyscraper, tower"
    "block" "ビル建築" "biru-kenchiku" "block of flats or offices on any outline"
    "ビル, 集合住宅, マンション, アパート, biru, manshon, apāto, apartments, flats"
    "hospital" "病院" "byōin" "hospital on any outline"
    "医院, 診療所, クリニック, iin, shinryōjo, clinic"
    "school" "学校" "gakkō" "school on any outline"
    "校舎, 小学校, 中学校, 高校, 大学, kōsha, shōgakkō, chūgakkō, kōkō, daigaku, university"
    "shop-row" "商店長屋" "shōten-nagaya" "row of shops on any outline"
    "商店, 店舗, 商店街, shōten, tenpo, shōtengai, shops, stores, retail"
    "temple" "寺院建築" "jiin-kenchiku" "temple building on any outline"
    "寺, 寺院, お寺, 庫裏, 方丈, tera, jiin, kuri, hōjō"
    "house" "住宅" "jūtaku" "dwelling on any outline"
    "民家, 一戸建, 戸建, 家, minka, ie, dwelling, detached house"
};

/// Finished houses of `examples/` that search finds as well; they have no parameters.
pub static EXAMPLES: &[Template] = templates! {
    "omotedana" "表店" "omotedana" "shop on the street of an Edo town block"
    "町家, 商家, 店, 店蔵, machiya, shōka, mise, misegura, merchant house, shop, store"
    "l-house" "鉤屋" "kagiya" "house with a wing"
    "農家, 民家, 曲り家, nōka, minka, magariya, farmhouse, L-shaped house"
    "pagoda" "五重塔" "gojū-no-tō" "pagodas of five storeys"
    "塔, 仏塔, 三重塔, 寺, 寺院, お寺, tō, tera, sanjū-no-tō, stupa, temple"
    "suzakumon" "朱雀門" "suzaku-mon" "gate of two storeys at a palace"
    "門, 楼門, 二重門, 山門, 城門, mon, rōmon, nijū-mon, sanmon"
    "shrine" "神社本殿" "jinja-honden" "sanctuary of a shrine"
    "神社, 本殿, お宮, 社, jinja, honden, yashiro, omiya"
    "ninomaru" "二の丸御殿" "ninomaru-goten" "palace of eight halls"
    "御殿, 書院造, 城, goten, shoin-zukuri, shiro, castle"
};

/// Common search terms for things that are parts or fences, not houses.
const ABSENT: &[(&str, Noun)] = &[
    (
        "鳥居, torii",
        noun(
            "a torii is a part, `<Put code=\"ORI 4\"/>` in a house; `shrine` is the building behind one",
            "鳥居は部材です(`House` の中に `<Put code=\"ORI 4\"/>`)。社殿は `shrine` にあります",
        ),
    ),
    (
        "灯籠, 石灯籠, 燈籠, とうろう, tōrō, ishi-dōrō, lantern, stone lantern",
        noun(
            "a stone lantern is a part: `<Put code=\"OTO\"/>` in a house",
            "石灯籠は部材です(`House` の中に `<Put code=\"OTO\"/>`)",
        ),
    ),
    (
        "生垣, 竹垣, 垣根, 垣, 玉垣, ikegaki, takegaki, kakine, tamagaki, hedge, bamboo fence",
        noun(
            "hedges and bamboo fences are parts of a wall (`KIK`, `KTK`), and `Hedge` and `Fence` in a town; `taka-bei` is a garden wall or a board fence",
            "生垣と竹垣は壁の部材(`KIK`、`KTK`)、町では `Hedge` と `Fence` です。板塀や高塀は `taka-bei` にあります",
        ),
    ),
];

/// How the names of templates among the sources of a file begin.
const SOURCES: &str = "hsd:";

impl Template {
    /// Returns the content of the source file, which includes no other file.
    pub fn text(&self) -> String {
        let copied = |text: String, (line, name): &(&str, &str)| match text.contains(line) {
            true => text.replacen(line, &pieces(file(name)), 1),
            false => text,
        };
        INCLUDED.iter().fold(file(self.word).to_owned(), copied)
    }

    /// Returns its name among the sources of a file that places it: no path, since it is part of the program.
    pub fn source_name(&self) -> String {
        format!("{SOURCES}{}.hsd", self.word)
    }

    /// Returns true for the name of such a source.
    pub fn is_source(name: &str) -> bool {
        name.starts_with(SOURCES)
    }

    /// Returns the template with this Japanese name, in any spelling of its reading, or with this name on the command
    /// line.
    pub fn named(name: &str) -> Option<&'static Template> {
        let all = || TYPES.iter().chain(EXAMPLES);
        // Every place in a town asks, nearly always in the spelling of the command line.
        all().find(|t| t.word == name).or_else(|| {
            let query = Query::new(name);
            all().find(|t| [t.word, t.ja, t.romaji].iter().any(|n| query.is(n)))
        })
    }

    /// Returns the templates that a search finds by a name or an alias, house types first. If some match exactly, only
    /// those are returned.
    pub fn found(word: &str) -> Vec<&'static Template> {
        let query = Query::new(word);
        let all = || TYPES.iter().chain(EXAMPLES);
        let exact: Vec<&Template> = all().filter(|t| t.names().any(|n| query.is(n))).collect();
        match exact.is_empty() {
            true => all()
                .filter(|t| t.names().any(|n| query.finds(n)))
                .collect(),
            false => exact,
        }
    }

    /// Returns templates whose names resemble a misspelt word or share a kanji with it; none if nothing is near.
    pub fn nearest(word: &str) -> Vec<&'static Template> {
        const OFFERS: usize = 3;
        let query = Query::new(word);
        let all = TYPES.iter().chain(EXAMPLES);
        all.filter(|t| t.names().any(|n| query.is_near(n)))
            .take(OFFERS)
            .collect()
    }

    /// Returns the note on a thing that is no house.
    pub fn absent(word: &str) -> Option<&'static Noun> {
        let query = Query::new(word);
        let found = ABSENT
            .iter()
            .find(|(names, _)| listed(names).any(|n| query.is(n)));
        found.map(|(_, note)| note)
    }

    fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        let own = [self.word, self.ja, self.romaji, self.en];
        own.into_iter().chain(listed(self.aliases))
    }
}

/// Returns the contents of a file of `library/` or `examples/` by its name without the ending; a test reads all.
fn file(name: &str) -> &'static str {
    let mut all = hsd_library::FILES.iter().chain(hsd_examples::FILES);
    all.find(|(own, _)| *own == name)
        .map_or("", |(_, text)| text)
}

fn listed(names: &'static str) -> impl Iterator<Item = &'static str> {
    names.split(',').map(str::trim)
}

/// Returns the content of a file's outermost element, without the comment above it.
fn pieces(file: &str) -> String {
    let (head, rest) = file.split_once("<Catalog>\n").unwrap_or(("", file));
    let inner = rest
        .rsplit_once("</Catalog>")
        .map_or(rest, |(inner, _)| inner);
    let mut out: String = head
        .lines()
        .map(|line| match line {
            "" => "\n".to_owned(),
            line => format!("  {line}\n"),
        })
        .collect();
    out.push_str(inner);
    out
}

#[cfg(test)]
mod tests {
    use crate::templates::*;

    #[test]
    fn types_are_found_by_all_their_names() {
        for t in TYPES {
            for name in [t.word, t.ja, t.romaji, &t.word.to_uppercase()] {
                assert_eq!(
                    Template::named(name).map(|t| t.word),
                    Some(t.word),
                    "{name}"
                );
            }
        }
        assert!(Template::named("machiya").is_none());
    }

    /// Words that people search for, and the templates that they mean.
    const SEARCHES: &[(&str, &str)] = &[
        (
            "町家 machiya Machiya まちや マチヤ 町屋",
            "so-nikai chu-nikai sangai hiraya shimotaya hei-tsuki kanban omotedana",
        ),
        (
            "京町家 kyō-machiya kyoumachiya",
            "so-nikai chu-nikai sangai hiraya shimotaya hei-tsuki",
        ),
        ("厨子二階 つし二階 tsushinikai", "chu-nikai"),
        ("大塀造 高塀造 daibeizukuri", "hei-tsuki"),
        ("長屋 nagaya ながや 長家", "ura-nagaya"),
        ("表長屋 長屋門 nagayamon", "buke-nagaya"),
        ("武家屋敷 bukeyashiki", "buke-nagaya buke-bei"),
        (
            "蔵 倉 土蔵 kura くら クラ dozou dozo dozō storehouse warehouse",
            "kura",
        ),
        ("店蔵 misegura", "kura omotedana"),
        ("土塀 築地 dobei どべい", "buke-bei"),
        ("塀 hei へい", "hei-tsuki buke-bei taka-bei"),
        ("板塀 itabei", "taka-bei"),
        ("寺 寺院 tera お寺", "hondo tahoto temple pagoda"),
        ("寺院建築 temple", "temple"),
        ("学校 gakko school", "school"),
        ("神社 jinja じんじゃ shrine", "shrine"),
        ("五重塔 gojunoto gojūnotō pagoda", "pagoda"),
        ("塔", "tahoto pagoda"),
        ("門 mon もん", "mon"),
        (
            "gate",
            "hei-tsuki buke-nagaya buke-bei taka-bei mon suzakumon roji",
        ),
        ("薬医門 yakuimon", "buke-bei mon"),
        ("事務所 オフィス jimusho office", "office"),
        ("表店 omotedana", "omotedana"),
        ("旅館 ryokan inn", "sangai"),
        ("農家 nouka farmhouse", "l-house"),
        ("shop", "so-nikai chu-nikai kanban omotedana"),
    ];

    /// Tests that common search terms find the right templates.
    #[test]
    fn what_people_search_for_is_found() {
        for (words, found) in SEARCHES.iter().copied() {
            for word in words.split(' ') {
                let hits = match Template::named(word) {
                    Some(own) => vec![own.word],
                    None => Template::found(word).iter().map(|t| t.word).collect(),
                };
                for wanted in found.split(' ') {
                    let own = Template::named(word).is_some() && hits == [found];
                    assert!(
                        own || hits.contains(&wanted),
                        "{word} finds {hits:?}, not {wanted}"
                    );
                }
                assert!(
                    Template::named(word).is_some() || hits.len() == found.split(' ').count(),
                    "{word} finds {hits:?}"
                );
            }
        }
        let town: Vec<&str> = Template::found("town house")
            .iter()
            .map(|t| t.word)
            .collect();
        assert_eq!(
            town,
            ["so-nikai", "chu-nikai", "sangai", "hiraya", "shimotaya"]
        );
    }

    #[test]
    fn what_is_no_house_is_said_and_nothing_far_is_offered() {
        for word in [
            "鳥居",
            "torii",
            "灯籠",
            "灯篭",
            "生垣",
            "生け垣",
            "竹垣",
            "takegaki",
        ] {
            assert!(Template::absent(word).is_some(), "{word}");
            assert!(
                Template::named(word).is_none() && Template::found(word).is_empty(),
                "{word}"
            );
        }
        for word in ["駅", "station", "橋", "igloo", "茅葺", "銭湯"] {
            assert!(Template::found(word).is_empty(), "{word}");
            assert!(Template::nearest(word).is_empty(), "{word}");
        }
    }

    #[test]
    fn slips_lead_to_the_type_that_was_meant() {
        for (slip, meant) in [
            ("chunikai", "chu-nikai"),
            ("nagya", "ura-nagaya"),
            ("蔵", "kura"),
            ("sangai-tate", "sangai"),
        ] {
            let near = Template::named(slip).or(Template::nearest(slip).first().copied());
            assert_eq!(near.map(|t| t.word), Some(meant), "{slip}");
        }
    }

    #[test]
    fn copies_have_contents_and_include_nothing() {
        for t in TYPES.iter().chain(EXAMPLES).chain([&GROUNDS]) {
            assert!(!t.text().is_empty(), "{}", t.word);
            assert!(!t.text().contains("<include"), "{}", t.word);
        }
    }
}
