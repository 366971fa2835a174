//! The pages of `hsd explain`: cause, example and mend of every code, from `grammar/diagnostics/`.

use super::Code;

/// All codes with their pages, ascending. A test compares the list with the folder.
pub static PAGES: &[(Code, &str)] = &[];

/// The page of a code.
pub fn page(code: Code) -> Option<&'static str> {
    PAGES
        .iter()
        .find(|(c, _)| *c == code)
        .map(|(_, page)| *page)
}
