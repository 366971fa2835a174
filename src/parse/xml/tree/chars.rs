//! Which characters count as what in markup: blanks, names, full-width marks of input methods.

/// White space of XML, and the full-width blank that Japanese input methods put in its place.
pub(in crate::parse::xml) fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{3000}')
}

/// Whether a name may begin with it.
pub(in crate::parse::xml) fn is_name_start(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == ':'
}

/// The ASCII character that a full-width mark of a tag stands for.
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

/// Whether a name ends before it.
pub(in crate::parse::xml) fn ends_name(c: char) -> bool {
    is_blank(c) || narrow(c).is_some() || matches!(c, '<' | '>' | '/' | '=' | '"' | '\'')
}

/// Whether XML allows it as a name.
pub(in crate::parse::xml) fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_alphanumeric() || !c.is_ascii() || "_:-.".contains(c);
    name.starts_with(is_name_start) && name.chars().all(fits)
}

/// Whether XML allows a character nowhere.
pub(in crate::parse::xml) fn is_forbidden(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}
