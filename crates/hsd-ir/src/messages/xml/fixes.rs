//! Titles and texts that many fixes of the XML form share.

use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// "Write `depth`".
pub(super) fn writing(word: &str) -> Text {
    let word = quote(word);
    text!([word] "Write {word}", "{word} と書く")
}

/// "Remove `depth`".
pub(super) fn removing(word: &str) -> Text {
    let word = quote(word);
    text!([word] "Remove {word}", "{word} を削除する")
}

/// "Insert `>`".
pub(super) fn putting_in(word: &str) -> Text {
    let word = quote(word);
    text!([word] "Insert {word}", "{word} を入れる")
}

/// Offers words to replace a value or a piece of it.
pub fn offer<'w>(
    found: Diagnostic,
    span: Span,
    words: impl IntoIterator<Item = &'w str>,
) -> Diagnostic {
    let offered = |found: Diagnostic, word| found.fix(writing(word), span, escaped(word));
    words.into_iter().fold(found, offered)
}

/// A word as it is written in a file: in text, or in a value with quotes of either kind.
pub(super) fn escaped(word: &str) -> String {
    let mut text = String::with_capacity(word.len());
    for c in word.chars() {
        match c {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '"' => text.push_str("&quot;"),
            '\'' => text.push_str("&apos;"),
            c => text.push(c),
        }
    }
    text
}

/// Offers to make a comment of a piece of a file, if it can be one.
pub(super) fn offer_comment(found: Diagnostic, span: Span, written: &str) -> Diagnostic {
    if written.contains("--") || written.contains("<!") || written.contains("]]>") {
        return found;
    }
    let title = text!("Make it a comment", "コメントにする");
    found.fix(title, span, format!("<!-- {written} -->"))
}
