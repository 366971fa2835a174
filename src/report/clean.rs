//! Text for terminals: a file must not move the cursor of its reader.

/// Returns the substitute for a character that has no visible form of its own; `None` = itself.
pub(super) fn visible(c: char) -> Option<char> {
    match c {
        '\t' => None,
        '\0'..='\x1f' => char::from_u32(0x2400 + c as u32),
        '\x7f' => Some('␡'),
        '\u{80}'..='\u{9f}' => Some(char::REPLACEMENT_CHARACTER),
        // Marks without width, and those that reverse the direction of a line.
        '\u{200b}' | '\u{200c}' | '\u{200e}' | '\u{200f}' => Some(char::REPLACEMENT_CHARACTER),
        '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' => {
            Some(char::REPLACEMENT_CHARACTER)
        }
        _ => None,
    }
}

/// Returns a string on one line.
pub(super) fn line(text: &str) -> String {
    text.chars().map(|c| visible(c).unwrap_or(c)).collect()
}
