//! Selection of the language of diagnostics, messages and help.

pub(crate) mod japanese;

use clap::ValueEnum;
use hsd_base::diagnostic::Language;
use std::ffi::OsString;

/// The languages of `--lang`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Lang {
    /// English.
    En,
    /// 日本語.
    Ja,
}

impl From<Lang> for Language {
    fn from(lang: Lang) -> Language {
        match lang {
            Lang::En => Language::English,
            Lang::Ja => Language::Japanese,
        }
    }
}

/// Returns the language of `--lang`, or that of the locale. Works on unparsed arguments, because help and usage
/// errors depend on it.
pub(super) fn of(arguments: &[OsString]) -> Language {
    asked(arguments).unwrap_or_else(|| of_locale(|name| std::env::var(name).ok()))
}

fn asked(arguments: &[OsString]) -> Option<Language> {
    let mut words = arguments.iter().map(|a| a.to_string_lossy());
    let mut found = None;
    while let Some(word) = words.next() {
        let value = match word.split_once('=') {
            _ if word == "--" => break,
            _ if word == "--lang" => words.next(),
            Some(("--lang", value)) => Some(value.to_owned().into()),
            _ => None,
        };
        let lang = value.and_then(|v| Lang::from_str(&v, false).ok());
        found = lang.map(Language::from).or(found);
    }
    found
}

/// Returns the language of the locale as POSIX defines it: the first non-empty variable decides.
fn of_locale(variable: impl Fn(&str) -> Option<String>) -> Language {
    let mut names = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter();
    let locale = names.find_map(|name| variable(name).filter(|v| !v.is_empty()));
    match locale {
        Some(locale) if locale.starts_with("ja") => Language::Japanese,
        _ => Language::English,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_comes_before_the_locale() {
        let asked = |line: &str| asked(&line.split(' ').map(OsString::from).collect::<Vec<_>>());
        assert_eq!(asked("hsd --lang ja parts"), Some(Language::Japanese));
        assert_eq!(asked("hsd check --lang=en a"), Some(Language::English));
        assert_eq!(asked("hsd check --lang klingon a"), None);
        assert_eq!(asked("hsd check -- --lang ja"), None);
    }

    #[test]
    fn the_first_variable_that_says_something_decides() {
        let locale = |all: &str, messages: &str, lang: &str| {
            let values = [("LC_ALL", all), ("LC_MESSAGES", messages), ("LANG", lang)];
            let found = |name: &str| values.iter().find(|(n, _)| *n == name);
            of_locale(|name| found(name).map(|(_, value)| (*value).to_owned()))
        };
        assert_eq!(locale("", "", "ja_JP.UTF-8"), Language::Japanese);
        assert_eq!(locale("", "ja", "C"), Language::Japanese);
        assert_eq!(locale("C", "ja", "ja"), Language::English);
        assert_eq!(locale("", "", ""), Language::English);
    }
}
