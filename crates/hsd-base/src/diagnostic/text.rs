//! Texts in both languages of the program.
//!
//! A [`Text`] keeps its values and two patterns, side by side in [`text!`](crate::text). It is formatted where it is
//! reported, in one language.

use crate::diagnostic::visible;
use std::borrow::Cow;
use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

/// The language of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// 日本語.
    Japanese,
}

impl Language {
    /// Returns the one of two values that belongs to the language.
    pub fn choose<T>(self, english: T, japanese: T) -> T {
        match self {
            Language::English => english,
            Language::Japanese => japanese,
        }
    }
}

/// A text in both languages. Two texts are equal if their words are equal in each language.
#[derive(Clone)]
pub struct Text(Words);

/// Writes words in a language.
type Write = dyn Fn(Language, &mut Formatter<'_>) -> fmt::Result + Send + Sync;

#[derive(Clone)]
enum Words {
    /// Known at compile time.
    Fixed(Noun),
    /// The same in both languages.
    Same(Arc<str>),
    /// Formatted on demand.
    Written(Arc<Write>),
}

impl Text {
    /// Creates a text that a function writes in a language.
    pub fn written(
        write: impl Fn(Language, &mut Formatter<'_>) -> fmt::Result + Send + Sync + 'static,
    ) -> Text {
        Text(Words::Written(Arc::new(write)))
    }

    /// Creates a text of two patterns without values.
    ///
    /// # Panics
    /// If a pattern has a value; [`text!`](crate::text) reports this at compile time.
    pub const fn fixed(en: fmt::Arguments<'static>, ja: fmt::Arguments<'static>) -> Text {
        match (en.as_str(), ja.as_str()) {
            (Some(en), Some(ja)) => Text(Words::Fixed(noun(en, ja))),
            _ => panic!("a text lists the values of its patterns in brackets"),
        }
    }

    /// Joins texts with a separator in each language.
    pub fn joined(texts: Vec<Text>, en: &'static str, ja: &'static str) -> Text {
        Text::written(move |language, f| {
            let words: Vec<_> = texts.iter().map(|t| t.in_language(language)).collect();
            f.write_str(&words.join(language.choose(en, ja)))
        })
    }

    /// Returns the words of one language.
    pub fn in_language(&self, language: Language) -> Cow<'_, str> {
        match &self.0 {
            Words::Fixed(noun) => noun.in_language(language).into(),
            Words::Same(words) => Cow::Borrowed(words),
            Words::Written(write) => fmt::from_fn(|f| write(language, f)).to_string().into(),
        }
    }

    /// Returns true if there are no words.
    pub fn is_empty(&self) -> bool {
        self.in_language(Language::English).is_empty()
    }
}

impl Default for Text {
    fn default() -> Text {
        noun("", "").into()
    }
}

impl PartialEq for Text {
    fn eq(&self, other: &Text) -> bool {
        [Language::English, Language::Japanese]
            .into_iter()
            .all(|language| self.in_language(language) == other.in_language(language))
    }
}

impl Eq for Text {}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [en, ja] = [Language::English, Language::Japanese].map(|l| self.in_language(l));
        f.debug_tuple("Text").field(&en).field(&ja).finish()
    }
}

/// Creates a text that is the same in both languages: a name, a code, a quotation.
impl From<String> for Text {
    fn from(words: String) -> Text {
        Text(Words::Same(words.into()))
    }
}

/// Creates a text that is the same in both languages: a name, a code, a quotation.
impl From<&str> for Text {
    fn from(words: &str) -> Text {
        Text(Words::Same(words.into()))
    }
}

/// A name in both languages, for tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Noun {
    /// English.
    pub en: &'static str,
    /// Japanese.
    pub ja: &'static str,
}

/// Creates a [`Noun`].
pub const fn noun(en: &'static str, ja: &'static str) -> Noun {
    Noun { en, ja }
}

impl Noun {
    /// Returns the word of one language.
    pub fn in_language(self, language: Language) -> &'static str {
        language.choose(self.en, self.ja)
    }
}

impl From<Noun> for Text {
    fn from(noun: Noun) -> Text {
        Text(Words::Fixed(noun))
    }
}

/// A value that [`text!`](crate::text) can format.
pub trait Value {
    /// The type that the text keeps.
    type Kept: Kept;

    /// Returns the value that the text keeps.
    fn kept(&self) -> Self::Kept;
}

/// A value that a text keeps until it is formatted.
pub trait Kept: Send + Sync + 'static {
    /// The type that a pattern formats.
    type Words<'a>: Display;

    /// Returns the value in one language.
    fn words(&self, language: Language) -> Self::Words<'_>;
}

impl<T: Value + ?Sized> Value for &T {
    type Kept = T::Kept;

    fn kept(&self) -> T::Kept {
        (**self).kept()
    }
}

/// Implements [`Value`] for types that are kept as they are and are the same in both languages.
macro_rules! plain {
    ($($of:ty)*) => {$(
        impl Value for $of {
            type Kept = $of;

            fn kept(&self) -> $of {
                *self
            }
        }

        impl Kept for $of {
            type Words<'a> = $of;

            fn words(&self, _: Language) -> $of {
                *self
            }
        }
    )*};
}

plain! { char f64 i32 i64 u8 u16 u32 u64 u128 usize super::Code }

/// Implements [`Value`] for types that are kept as strings of visible characters.
macro_rules! quoted {
    ($($of:ty)*) => {$(
        impl Value for $of {
            type Kept = Box<str>;

            fn kept(&self) -> Box<str> {
                visible::lines(&self.to_string()).into()
            }
        }
    )*};
}

quoted! { str std::sync::Arc<str> String Box<str> Cow<'_, str> std::path::Display<'_> std::io::Error }

impl Kept for Box<str> {
    type Words<'a> = &'a str;

    fn words(&self, _: Language) -> &str {
        self
    }
}

impl Value for Text {
    type Kept = Text;

    fn kept(&self) -> Text {
        self.clone()
    }
}

impl Kept for Text {
    type Words<'a> = Cow<'a, str>;

    fn words(&self, language: Language) -> Cow<'_, str> {
        self.in_language(language)
    }
}

impl Value for Noun {
    type Kept = Noun;

    fn kept(&self) -> Noun {
        *self
    }
}

impl Kept for Noun {
    type Words<'a> = &'static str;

    fn words(&self, language: Language) -> &'static str {
        self.in_language(language)
    }
}

/// Creates a [`Text`](crate::diagnostic::Text) from two patterns for `format!`, English first. The brackets before them
/// list the values in the patterns; texts and nouns among them appear in the language of the pattern.
///
/// ```
/// use hsd_base::{diagnostic::{Language, noun}, text};
/// let (count, thing) = (3, noun("walls", "壁"));
/// let text = text!([count, thing] "there are {count} {thing}", "{thing}が{count}枚あります");
/// assert_eq!(text.in_language(Language::English), "there are 3 walls");
/// assert_eq!(text.in_language(Language::Japanese), "壁が3枚あります");
/// ```
#[macro_export]
macro_rules! text {
    ($en:literal, $ja:literal $(,)?) => {
        const { $crate::diagnostic::Text::fixed(::std::format_args!($en), ::std::format_args!($ja)) }
    };
    ([$($value:ident),+ $(,)?] $en:literal, $ja:literal $(,)?) => {{
        $(let $value = $crate::diagnostic::Value::kept(&$value);)+
        $crate::diagnostic::Text::written(move |language, f| {
            $(let $value = $crate::diagnostic::Kept::words(&$value, language);)+
            match language {
                $crate::diagnostic::Language::English => ::std::write!(f, $en),
                $crate::diagnostic::Language::Japanese => ::std::write!(f, $ja),
            }
        })
    }};
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_within_a_text_is_read_in_one_language() {
        let (name, far) = ("庇".to_owned(), 2.5);
        let side = text!("to the left", "左");
        let words = text!([name, far, side] "{name:?} {far:.2} {side}", "{name}は{side}へ {far}");
        assert_eq!(
            words.in_language(Language::English),
            "\"庇\" 2.50 to the left"
        );
        assert_eq!(words.in_language(Language::Japanese), "庇は左へ 2.5");
        let again = words.clone();
        assert_eq!(words, text!([again] "{again}", "{again}"));
        assert_ne!(words, Text::from("\"庇\" 2.50 to the left"));
    }

    #[test]
    fn fixed_words_are_borrowed() {
        let braces = text!("`{{a}}`", "「{{a}}」");
        assert!(matches!(
            braces.in_language(Language::English),
            Cow::Borrowed("`{a}`")
        ));
        assert!(Text::default().is_empty() && !braces.is_empty());
    }
}
