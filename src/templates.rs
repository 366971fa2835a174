//! The types of houses that the program brings along: texts of `library/`, each written once for every plot and every
//! front. `hsd new` copies one to start from.
//!
//! In the folder the types of town houses share their fronts in a file that they include. A copy stands alone: what it
//! would include stands in it.

/// A type of house.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// What it is called on the command line; the name of its file.
    pub word: &'static str,
    /// Japanese.
    pub ja: &'static str,
    /// Its reading.
    pub romaji: &'static str,
    /// English.
    pub en: &'static str,
    text: &'static str,
}

/// What some types include, and how they do.
const FRONTS: &str = include_str!("../library/fronts.hsd");
const INCLUDES_FRONTS: &str = "  <include href=\"fronts.hsd\"/>\n";

macro_rules! types {
    ($($word:literal $ja:literal $romaji:literal $en:literal)*) => {
        &[$(Template {
            word: $word,
            ja: $ja,
            romaji: $romaji,
            en: $en,
            text: include_str!(concat!("../library/", $word, ".hsd")),
        }),*]
    };
}

/// All types: the seven of Kyoto's town houses (000-11) first.
pub static TYPES: &[Template] = types! {
    "so-nikai" "総二階" "sō-nikai" "town house of two full storeys"
    "chu-nikai" "中二階" "chū-nikai" "town house with a low upper floor"
    "sangai" "三階建" "sangai-date" "town house of three storeys"
    "hiraya" "平屋建" "hiraya-date" "town house of one storey"
    "shimotaya" "仕舞屋" "shimotaya" "town house without a shop"
    "hei-tsuki" "塀付" "hei-tsuki" "dwelling behind a high fence with a gate"
    "kanban" "看板建築" "kanban-kenchiku" "old machiya behind a front of mortar"
    "ura-nagaya" "裏長屋" "ura-nagaya" "row of dwellings along an alley"
    "kura" "土蔵" "dozō" "storehouse"
    "buke-nagaya" "武家長屋" "buke-nagaya" "outer row of a samurai residence"
    "buke-bei" "築地塀" "tsuiji-bei" "earth wall of a residence, with a gate"
    "taka-bei" "高塀" "taka-bei" "high fence with a gate"
    "hondo" "本堂" "hondō" "main hall of a temple"
    "modern-house" "現代住宅" "gendai-jūtaku" "dwelling of today"
    "office" "事務所ビル" "jimusho-biru" "office building"
};

impl Template {
    /// Its text, which needs no other file.
    pub fn text(&self) -> String {
        self.text.replacen(INCLUDES_FRONTS, &pieces(FRONTS), 1)
    }

    /// The type of this name in Japanese, in any spelling of its reading, or on the command line.
    pub fn named(name: &str) -> Option<&'static Template> {
        let sought = plain(name);
        let mut all = TYPES.iter();
        all.find(|t| t.ja == name.trim() || [t.word, t.romaji].iter().any(|n| plain(n) == sought))
    }

    /// The types that may have been meant, best first.
    pub fn nearest(name: &str) -> Vec<&'static Template> {
        const OFFERS: usize = 3;
        let sought = plain(name);
        let far = |t: &Template| {
            let whole = [plain(t.word), plain(t.romaji)];
            // A part of the name counts as well: somebody asks for a `nagaya`.
            let parts = t.word.split('-').filter(|p| p.len() > 3);
            let names: Vec<String> = parts.map(str::to_owned).chain(whole).collect();
            let within =
                |n: &String| sought.len() > 2 && (n.contains(&*sought) || sought.contains(&**n));
            let shared = t.ja.chars().filter(|c| name.contains(*c)).count();
            match names.iter().any(within) || shared > 0 {
                true => 0,
                false => {
                    let far = names.iter().map(|n| strsim::osa_distance(n, &sought));
                    far.min().unwrap_or(usize::MAX)
                }
            }
        };
        let mut all: Vec<(usize, &Template)> = TYPES.iter().map(|t| (far(t), t)).collect();
        all.sort_by_key(|(far, _)| *far);
        all.into_iter().take(OFFERS).map(|(_, t)| t).collect()
    }
}

/// A name without what spellings differ in.
fn plain(name: &str) -> String {
    let letters = name.trim().chars().flat_map(char::to_lowercase);
    let plain = letters.filter_map(|c| match c {
        'ō' | 'ô' => Some('o'),
        'ū' | 'û' => Some('u'),
        '-' | ' ' | '_' => None,
        c => Some(c),
    });
    plain.collect()
}

/// What stands in the outermost element of a file of pieces, and the comment above it.
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
    fn copies_include_nothing() {
        for t in TYPES {
            assert!(!t.text().contains("<include"), "{}", t.word);
        }
    }
}
