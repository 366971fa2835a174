//! Messages about what stands outside the houses of a town (HSD1170, HSD1172).

use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Origin, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A wish for something outside houses that its feature cannot have.
#[cold]
pub fn not_laid(origin: Origin, word: &str, why: &Text) -> Diagnostic {
    let message =
        text!([word, why] "no {word} is made here: {why}", "ここには {word} を作れません: {why}");
    Diagnostic::warning(1170, origin, message).help(text!(
        "a `test` on the `for` can leave such features out",
        "`for` の `test` でこうした地物を除けます"
    ))
}

/// The file of a font that cannot be used.
#[cold]
pub fn no_font(span: Span, path: &str, why: &Text) -> Diagnostic {
    let path = quote(path);
    let message = text!([path, why]
        "the font {path} cannot be read: {why}",
        "フォント {path} を読めません: {why}"
    );
    Diagnostic::error(1172, span, message).help(text!(
        "put a copy of a font (TTF, OTF or TTC) that has the letters of the signs beside the town file, and name it",
        "看板の文字を持つフォント(TTF、OTF、TTC)を町のファイルの横に置き、その名を書いてください"
    ))
}
