//! Classes of characters in markup: blanks, names, full-width marks of input methods.

/// White space of XML.
pub(in crate::parse::xml) const BLANKS: [char; 4] = [' ', '\t', '\r', '\n'];

/// Returns true for white space of XML, and the full-width blank that Japanese input methods insert instead.
pub(in crate::parse::xml) fn is_blank(c: char) -> bool {
    BLANKS.contains(&c) || c == '\u{3000}'
}

/// Returns true if a name may begin with this character.
pub(in crate::parse::xml) fn is_name_start(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == ':'
}

/// Returns the ASCII character that a full-width mark of a tag stands for.
pub(in crate::parse::xml) fn narrow(c: char) -> Option<char> {
    Some(match c {
        '＜' => '<',
        '＞' => '>',
        '／' => '/',
        '＝' => '=',
        '“' | '”' | '„' | '＂' => '"',
        '‘' | '’' | '＇' => '\'',
        _ => return None,
    })
}

/// Returns true if a name ends before this character.
pub(in crate::parse::xml) fn ends_name(c: char) -> bool {
    is_blank(c) || narrow(c).is_some() || matches!(c, '<' | '>' | '/' | '=' | '"' | '\'')
}

/// Returns true if XML allows the text as a name.
pub(in crate::parse::xml) fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_alphanumeric() || !c.is_ascii() || "_:-.".contains(c);
    name.starts_with(is_name_start) && name.chars().all(fits)
}

/// Returns true for a name that XML allows, of ASCII characters alone; nearly all are.
fn is_plain_name(name: &[u8]) -> bool {
    let starts = |byte: &u8| byte.is_ascii_alphabetic() || matches!(byte, b'_' | b':');
    let fits =
        |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b':' | b'-' | b'.');
    name.first().is_some_and(starts) && name.iter().all(fits)
}

/// Returns true if the text is a whole name that XML allows.
pub(in crate::parse::xml) fn is_whole_name(name: &str) -> bool {
    is_plain_name(name.as_bytes()) || (is_name(name) && !name.contains(ends_name))
}

/// Returns true for a character that XML does not allow anywhere.
pub(in crate::parse::xml) fn is_forbidden(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}
