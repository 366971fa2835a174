//! Messages about comments of the legacy form.

use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::Span;
use hsd_base::text;

/// A comment with blanks before it.
#[cold]
pub fn indented_comment(span: Span, blanks: Span) -> Diagnostic {
    let message = text!(
        "a comment must begin in the first column",
        "コメントは一桁目から始めなければなりません"
    );
    Diagnostic::error(113, span, message)
        .help(text!(
            "delete the blanks before the `#`",
            "`#` の前の空白を削除してください"
        ))
        .fix(text!("Delete the blanks", "空白を削除する"), blanks, "")
}

/// A comment after something else: `place` has the blanks before it, and `line` is where its line begins.
#[cold]
pub fn comment_column(span: Span, place: Span, line: Span, comment: String) -> Diagnostic {
    let message = text!(
        "a comment must begin in the first column",
        "コメントは一桁目から始めなければなりません"
    );
    let title = text!(
        "Move the comment to a separate line",
        "コメントを独立した行にする"
    );
    Diagnostic::error(113, span, message)
        .help(text!(
            "write the comment on a separate line, with `#` as its first character",
            "コメントは独立した行に、`#` を先頭にして書いてください"
        ))
        .fix_all(title, vec![Edit::new(line, comment), Edit::new(place, "")])
}

/// A comment as other languages write it; `head` reaches from the first column over the sign.
#[cold]
pub fn comment_sign(span: Span, head: Span, sign: &str) -> Diagnostic {
    let message = text!([sign]
        "`{sign}` does not begin a comment",
        "`{sign}` はコメントの始まりではありません"
    );
    Diagnostic::error(113, span, message)
        .help(text!(
            "a comment begins with `#` in the first column",
            "コメントは一桁目の `#` で始めてください"
        ))
        .fix(text!("Write `#`", "`#` と書く"), head, "#")
}
