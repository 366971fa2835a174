//! Text for people: what a file or its name contains must not move the cursor of its reader, nor reverse what is
//! written beside it. All that is quoted passes here.

/// Returns the substitute for a character that has no visible form of its own; `None` = itself.
pub fn character(c: char) -> Option<char> {
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
pub fn line(text: &str) -> String {
    text.chars().map(|c| character(c).unwrap_or(c)).collect()
}

/// Returns a string of several lines.
pub fn lines(text: &str) -> String {
    let shown = |c| match c {
        '\n' => c,
        c => character(c).unwrap_or(c),
    };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::{line, lines};

    #[test]
    fn nothing_moves_the_cursor_or_turns_the_line_round() {
        assert_eq!(line("\u{1b}[31m家\r\n\u{7f}"), "␛[31m家␍␊␡");
        let marks = "a\u{202e}b\u{2066}c\u{200f}d\u{9b}e\u{feff}";
        assert_eq!(line(marks).matches('\u{fffd}').count(), 5);
        assert_eq!(lines("a\nb\r\u{1b}"), "a\nb␍␛");
        assert_eq!(line("格子\tﾞ é"), "格子\tﾞ é");
    }
}
