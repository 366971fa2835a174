//! Search by name: matches Japanese or English names against a query, whatever the spelling.
//!
//! A name matches where one of its words begins with the query. Kanji have no gaps between words, so there the query
//! may also end the name (`窓` finds `虫籠窓`), unless it would cut a word in two (`簾` is no part of `暖簾`).

use super::reading::{folded, narrow};
use hsd_base::diagnostic::suggest::slips;
use std::borrow::Cow;

/// Spellings of one word; the second is the one that is compared.
const VARIANTS: &[(&str, &str)] = &[
    ("ガラス", "硝子"),
    ("なまこ", "海鼠"),
    ("ナマコ", "海鼠"),
    ("むしこ", "虫籠"),
    ("ムシコ", "虫籠"),
    ("虫子", "虫籠"),
    ("簓子", "ささら子"),
    ("袖うだつ", "袖卯建"),
    ("うだつ", "卯建"),
    ("倉", "蔵"),
    ("町屋", "町家"),
    ("縦", "竪"),
    ("桧", "檜"),
    ("柿葺", "杮葺"),
    ("廂", "庇"),
    ("灯篭", "灯籠"),
    ("燈籠", "灯籠"),
    ("とう籠", "灯籠"),
    ("生け垣", "生垣"),
];

/// Words of several kanji that a match must not split.
const UNDIVIDED: &[&str] = &["暖簾", "床几", "格子", "障子", "連子", "犬矢来", "看板"];

/// Romanisations of one syllable, from Kunrei to Hepburn.
const KUNREI: &[(&str, &str)] = &[
    ("sy", "sh"),
    ("ty", "ch"),
    ("zy", "j"),
    ("jy", "j"),
    ("si", "shi"),
    ("ti", "chi"),
    ("tu", "tsu"),
    ("hu", "fu"),
    ("zi", "ji"),
];

/// Initial sounds and their voiced form inside a compound: `kōshi` becomes `de-gōshi`.
const VOICED: &[(&str, &str)] = &[
    ("sh", "j"),
    ("ch", "j"),
    ("ts", "z"),
    ("k", "g"),
    ("s", "z"),
    ("t", "d"),
    ("h", "b"),
    ("f", "b"),
];

/// Queries shorter than this must match a whole word: otherwise `tō` would find `town`.
const SHORT: usize = 3;

/// A user's search query.
#[derive(Clone, Debug)]
pub struct Query {
    written: String,
    /// The romanised query; empty if it has kanji.
    sound: String,
}

impl Query {
    /// Reads a query in kanji, kana or letters.
    pub fn new(text: &str) -> Query {
        let written = written(text);
        let sound = match text.contains(is_kanji) {
            true => String::new(),
            false => sound(text),
        };
        Query { written, sound }
    }

    /// Returns true if a word of the name begins with the query, or its kanji contain the query.
    pub fn finds(&self, name: &str) -> bool {
        match name.contains(is_japanese) {
            true => self.is_in_written(&written(name)),
            false => self.begins_word(name),
        }
    }

    /// Returns true if the name equals the query, apart from spelling variants.
    pub fn is(&self, name: &str) -> bool {
        self.is_key(&Query::key(name))
    }

    /// Returns what all spellings of a name have in common, for names that are compared often.
    pub fn key(name: &str) -> String {
        match name.contains(is_japanese) {
            true => written(name),
            false => sound(name),
        }
    }

    /// Returns true if the name of a key equals the query.
    pub fn is_key(&self, key: &str) -> bool {
        let own = match key.contains(is_japanese) {
            true => &self.written,
            false => &self.sound,
        };
        !own.is_empty() && own == key
    }

    /// Returns true if the name may be meant: one typo per four letters, or a distinctive kanji in common.
    pub fn is_near(&self, name: &str) -> bool {
        const COMMON: &str = "屋家建造物大小高中上下二三付前所";
        if name.contains(is_japanese) {
            let telling = |c: &char| is_kanji(*c) && !COMMON.contains(*c);
            return written(name)
                .chars()
                .filter(telling)
                .any(|c| self.written.contains(c));
        }
        if self.sound.len() < SHORT {
            return false;
        }
        let allowed = 1 + self.sound.len() / 6;
        let close = |n: &str| slips(n, &self.sound) <= allowed.min(n.len() / 3);
        close(&sound(name)) || name.split(is_gap).map(sound).any(|word| close(&word))
    }

    fn is_in_written(&self, name: &str) -> bool {
        let query = &*self.written;
        if query.is_empty() || !query.contains(is_japanese) {
            return false;
        }
        let hits = name.match_indices(query);
        hits.map(|(at, _)| (at, at + query.len()))
            .any(|(start, end)| {
                let first = name[..start].chars().next_back().is_none_or(is_gap);
                let last = name[end..].chars().next().is_none_or(is_gap);
                let long = query.chars().nth(1).is_some();
                (first || last || long) && !cuts_word(name, start, end)
            })
    }

    fn begins_word(&self, name: &str) -> bool {
        if self.sound.is_empty() {
            return false;
        }
        let words: Vec<&str> = name.split(is_gap).filter(|w| !w.is_empty()).collect();
        let fits = |rest: &str, wanted: &str| match wanted.len() < SHORT {
            true => rest == wanted,
            false => rest.starts_with(wanted),
        };
        (0..words.len()).any(|k| {
            let mut rest: Cow<'_, str> = sound(&words[k..].concat()).into();
            if self.sound.len() < SHORT {
                rest = sound(words[k]).into();
            }
            let inside = k > 0 && voiced(&self.sound).is_some_and(|soft| fits(&rest, &soft));
            fits(&rest, &self.sound) || inside
        })
    }
}

/// Returns true if a match begins or ends inside an undivided word.
fn cuts_word(name: &str, start: usize, end: usize) -> bool {
    UNDIVIDED.iter().any(|word| {
        name.match_indices(word).any(|(at, _)| {
            let stop = at + word.len();
            let apart = end <= at || stop <= start;
            !apart && (start > at || end < stop)
        })
    })
}

/// Normalizes a name in writing: one spelling of each word, without inflectional kana after kanji.
fn written(name: &str) -> String {
    let mut name = narrow(name.trim()).to_lowercase();
    for (variant, plain) in VARIANTS {
        name = name.replace(variant, plain);
    }
    let letters: Vec<char> = name.chars().filter(|c| *c != ' ').collect();
    let is_kana = |c: &char| ('ぁ'..='ゖ').contains(c);
    let inflects = |k: usize| {
        is_kana(&letters[k])
            && k > 0
            && is_kanji(letters[k - 1])
            && letters.get(k + 1).is_none_or(|next| !is_kana(next))
    };
    (0..letters.len())
        .filter(|k| !inflects(*k))
        .map(|k| letters[k])
        .collect()
}

/// Normalizes a romanised name: any romanisation, no long vowels.
fn sound(name: &str) -> String {
    let mut sound: String = folded(&narrow(name.trim()));
    for (kunrei, hepburn) in KUNREI {
        sound = sound.replace(kunrei, hepburn);
    }
    sound.retain(|c| !is_gap(c));
    sound
}

fn voiced(sound: &str) -> Option<String> {
    let (hard, soft) = VOICED.iter().find(|(hard, _)| sound.starts_with(hard))?;
    Some(format!("{soft}{}", &sound[hard.len()..]))
}

fn is_gap(c: char) -> bool {
    matches!(c, '・' | '、' | '(' | ')' | '（' | '）') || (!c.is_alphanumeric() && c != 'ー')
}

fn is_kanji(c: char) -> bool {
    ('\u{3400}'..='\u{9fff}').contains(&c) || c == '々'
}

fn is_japanese(c: char) -> bool {
    is_kanji(c) || ('\u{3040}'..='\u{30ff}').contains(&c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_in_any_spelling() {
        for (query, name) in [
            ("なまこ壁", "海鼠壁(四半)"),
            ("潜戸", "潜り戸"),
            ("引き戸", "引戸"),
            ("窓", "虫籠窓"),
            ("dozou", "dozō"),
            ("syouji", "shōji"),
            ("こうし", "de-gōshi"),
            ("wall", "low boarded wall above a pent roof"),
            ("lattices", "lattices of shops"),
        ] {
            assert!(Query::new(query).finds(name), "{query} in {name}");
        }
        for (query, name) in [
            ("簾", "長暖簾"),
            ("かまど", "taka-mado"),
            ("塔", "town house"),
            ("とう", "town house"),
            ("gate", "frigate"),
            ("", "wall"),
        ] {
            assert!(!Query::new(query).finds(name), "{query} in {name}");
        }
    }

    #[test]
    fn only_near_words_are_near() {
        for (slip, name, near) in [
            ("nagya", "ura-nagaya", true),
            ("storehuose", "storehouse", true),
            ("茅葺民家", "農家", false),
            ("井戸", "井戸端", true),
            ("castle", "office", false),
            ("well", "wall", true),
        ] {
            assert_eq!(Query::new(slip).is_near(name), near, "{slip} and {name}");
        }
    }
}
