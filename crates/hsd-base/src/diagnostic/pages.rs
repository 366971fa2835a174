//! The pages of `hsd explain`: cause, example and fix of every code, in English and Japanese.

use super::{Code, Language};
use hsd_grammar::{PAGES, Page};

/// Returns the codes that have a page, ascending.
pub fn codes() -> impl Iterator<Item = Code> {
    PAGES.iter().map(|page| Code(page.number))
}

/// Returns the page of a code in a language.
pub fn page(code: Code, language: Language) -> Option<&'static str> {
    let is_own = |page: &&Page| page.number == code.0;
    let page = PAGES.iter().find(is_own)?;
    Some(language.choose(page.en, page.ja))
}
