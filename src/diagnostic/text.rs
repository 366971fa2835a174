//! Words in both languages of the program.
//!
//! Whoever says something says it in English and Japanese at once, side by side, by [`text!`](crate::text); which of
//! the two is read is chosen where a report is written, never where a text comes into being.

use std::borrow::Cow;
use std::fmt;
use std::ops::Deref;

/// The language that a reader understands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// 日本語.
    Japanese,
}

impl Language {
    /// The one of two things that belongs to the language.
    pub fn choose<T>(self, english: T, japanese: T) -> T {
        match self {
            Language::English => english,
            Language::Japanese => japanese,
        }
    }
}

/// A text in both languages. It defaults to English where no language is requested.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    /// English.
    pub en: Cow<'static, str>,
    /// Japanese; the English text where there is no other.
    pub ja: Cow<'static, str>,
}

impl Text {
    /// A text that is said in both languages.
    pub fn both(en: impl Into<Cow<'static, str>>, ja: impl Into<Cow<'static, str>>) -> Text {
        Text {
            en: en.into(),
            ja: ja.into(),
        }
    }

    /// Returns the text in the given language.
    pub fn in_language(&self, language: Language) -> &str {
        language.choose(&self.en, &self.ja)
    }

    /// The English text.
    pub fn as_str(&self) -> &str {
        &self.en
    }
}

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        &self.en
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.en)
    }
}

/// The same words in both languages: names, codes, quotations.
impl From<String> for Text {
    fn from(words: String) -> Text {
        Text::both(words.clone(), words)
    }
}

/// The same words in both languages: names, codes, quotations.
impl From<&str> for Text {
    fn from(words: &str) -> Text {
        words.to_owned().into()
    }
}

/// A name of a thing for tables, in both languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Noun {
    /// English.
    pub en: &'static str,
    /// Japanese.
    pub ja: &'static str,
}

/// A [`Noun`].
pub const fn noun(en: &'static str, ja: &'static str) -> Noun {
    Noun { en, ja }
}

impl From<Noun> for Text {
    fn from(Noun { en, ja }: Noun) -> Text {
        Text::both(en, ja)
    }
}

/// A [`Text`](crate::diagnostic::Text) of two patterns for `format!`, English first. Names in brackets before them
/// are texts or nouns, of which each pattern takes its own language.
///
/// ```
/// use hsd::{diagnostic::Text, text};
/// let (count, thing) = (3, Text::both("walls", "壁"));
/// let text = text!([thing] "there are {count} {thing}", "{thing}が{count}枚あります");
/// assert_eq!((&*text.en, &*text.ja), ("there are 3 walls", "壁が3枚あります"));
/// ```
#[macro_export]
macro_rules! text {
    ($([$($word:ident),+ $(,)?])? $en:literal, $ja:literal $(,)?) => {
        $crate::diagnostic::Text::both(
            { $($(let $word = &$word.en;)+)? ::std::format!($en) },
            { $($(let $word = &$word.ja;)+)? ::std::format!($ja) },
        )
    };
}
