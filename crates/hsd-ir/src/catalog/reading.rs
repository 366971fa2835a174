//! Romanisation of Japanese words, for comparing spellings.

/// The sounds of kana, in Hepburn romanisation; pairs with a small kana precede their first kana.
#[rustfmt::skip]
const KANA: &[(&str, &str)] = &[
    ("きゃ", "kya"), ("きゅ", "kyu"), ("きょ", "kyo"), ("しゃ", "sha"), ("しゅ", "shu"), ("しょ", "sho"), ("しぇ", "she"),
    ("ちゃ", "cha"), ("ちゅ", "chu"), ("ちょ", "cho"), ("ちぇ", "che"), ("にゃ", "nya"), ("にゅ", "nyu"), ("にょ", "nyo"),
    ("ひゃ", "hya"), ("ひゅ", "hyu"), ("ひょ", "hyo"), ("みゃ", "mya"), ("みゅ", "myu"), ("みょ", "myo"),
    ("りゃ", "rya"), ("りゅ", "ryu"), ("りょ", "ryo"), ("ぎゃ", "gya"), ("ぎゅ", "gyu"), ("ぎょ", "gyo"),
    ("じゃ", "ja"), ("じゅ", "ju"), ("じょ", "jo"), ("じぇ", "je"), ("びゃ", "bya"), ("びゅ", "byu"), ("びょ", "byo"),
    ("ぴゃ", "pya"), ("ぴゅ", "pyu"), ("ぴょ", "pyo"), ("てぃ", "ti"), ("でぃ", "di"), ("うぃ", "wi"), ("うぇ", "we"),
    ("ふぁ", "fa"), ("ふぃ", "fi"), ("ふぇ", "fe"), ("ふぉ", "fo"),
    ("あ", "a"), ("い", "i"), ("う", "u"), ("え", "e"), ("お", "o"), ("か", "ka"), ("き", "ki"), ("く", "ku"), ("け", "ke"),
    ("こ", "ko"), ("さ", "sa"), ("し", "shi"), ("す", "su"), ("せ", "se"), ("そ", "so"), ("た", "ta"), ("ち", "chi"),
    ("つ", "tsu"), ("て", "te"), ("と", "to"), ("な", "na"), ("に", "ni"), ("ぬ", "nu"), ("ね", "ne"), ("の", "no"),
    ("は", "ha"), ("ひ", "hi"), ("ふ", "fu"), ("へ", "he"), ("ほ", "ho"), ("ま", "ma"), ("み", "mi"), ("む", "mu"),
    ("め", "me"), ("も", "mo"), ("や", "ya"), ("ゆ", "yu"), ("よ", "yo"), ("ら", "ra"), ("り", "ri"), ("る", "ru"),
    ("れ", "re"), ("ろ", "ro"), ("わ", "wa"), ("ゐ", "i"), ("ゑ", "e"), ("を", "o"), ("ん", "n"), ("が", "ga"), ("ぎ", "gi"),
    ("ぐ", "gu"), ("げ", "ge"), ("ご", "go"), ("ざ", "za"), ("じ", "ji"), ("ず", "zu"), ("ぜ", "ze"), ("ぞ", "zo"),
    ("だ", "da"), ("ぢ", "ji"), ("づ", "zu"), ("で", "de"), ("ど", "do"), ("ば", "ba"), ("び", "bi"), ("ぶ", "bu"),
    ("べ", "be"), ("ぼ", "bo"), ("ぱ", "pa"), ("ぴ", "pi"), ("ぷ", "pu"), ("ぺ", "pe"), ("ぽ", "po"), ("ー", ""),
];

/// Folds a reading: removes the differences between romanisations (long vowels, hyphens, blanks). Kana are romanised.
pub fn folded(reading: &str) -> String {
    let mut out = String::new();
    for c in romanised(&reading.to_lowercase()).chars() {
        let plain = match c {
            'ā' | 'â' => 'a',
            'ī' | 'î' => 'i',
            'ū' | 'û' => 'u',
            'ē' | 'ê' => 'e',
            'ō' | 'ô' => 'o',
            '-' | ' ' | '\'' | '\u{304}' | '\u{302}' => continue,
            c => c,
        };
        let long = match plain {
            'u' => out.ends_with(['o', 'u']),
            'o' | 'a' => out.ends_with(plain),
            _ => false,
        };
        if !long {
            out.push(plain);
        }
    }
    out
}

/// Romanises the kana of a string; everything else stays as it is.
fn romanised(text: &str) -> String {
    // Katakana and hiragana differ by a constant, except for the sign of a long vowel, which only one has.
    let flat = |c: char| match c {
        'ァ'..='ヶ' => char::from_u32(c as u32 - 0x60).unwrap_or(c),
        c => c,
    };
    let text: String = text.chars().map(flat).collect();
    let (mut rest, mut out, mut doubled) = (text.as_str(), String::new(), false);
    while let Some(first) = rest.chars().next() {
        if first == 'っ' {
            (doubled, rest) = (true, &rest[first.len_utf8()..]);
            continue;
        }
        let hit = KANA.iter().find(|(kana, _)| rest.starts_with(kana));
        match hit {
            Some((_, sound)) => {
                if doubled {
                    out.extend(sound.chars().next());
                }
                out += sound;
            }
            None => out.push(first),
        }
        doubled = false;
        rest = &rest[hit.map_or(first.len_utf8(), |(kana, _)| kana.len())..];
    }
    out
}

/// Converts full-width letters and digits, as an input method leaves them, to plain ones.
pub fn narrow(text: &str) -> String {
    let plain = |c: char| match c {
        '！'..='～' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        '\u{3000}' => ' ',
        c => c,
    };
    text.chars().map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kana_read_as_the_letters_do() {
        for (kana, romaji) in [
            ("こうし", "kōshi"),
            ("おおど", "ō-do"),
            ("しょうじ", "shōji"),
            ("しっくい", "shikkui"),
            ("むしこまど", "mushiko-mado"),
            ("カーテン", "kāten"),
            ("じどうドア", "jidō doa"),
        ] {
            assert_eq!(folded(kana), folded(romaji), "{kana}");
        }
        assert_eq!(folded("格子do"), "格子do");
        assert_eq!(narrow("ＫＫＳ　２窓"), "KKS 2窓");
    }
}
