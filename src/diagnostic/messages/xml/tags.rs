//! Messages about the inside of tags: names, attributes, quotes.

use crate::diagnostic::Diagnostic;
use crate::diagnostic::messages::words::{quote, shortened};
use crate::source::Span;
use crate::text;

/// `<Row` without `>`.
#[cold]
pub fn tag_not_closed(span: Span, name: &str, slash: bool) -> Diagnostic {
    let tag = quote(name);
    let message = text!(
        "the tag of {tag} is not closed by `>`",
        "{tag} のタグが `>` で閉じていません"
    );
    Diagnostic::error(201, span, message).help(if slash {
        text!(
            "write `/>` or `>` behind the last attribute",
            "最後の属性の後に `/>` か `>` と書いてください"
        )
    } else {
        text!(
            "write `>` behind the last attribute",
            "最後の属性の後に `>` と書いてください"
        )
    })
}

/// A value without its second quote.
#[cold]
pub fn quote_not_closed(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "the value of {name} has no closing quote",
        "{name} の値に終わりの引用符がありません"
    );
    Diagnostic::error(202, span, message).help(text!(
        "close it with the same quote that opens it",
        "始まりと同じ引用符で閉じてください"
    ))
}

/// The same attribute twice.
#[cold]
pub fn attribute_twice(span: Span, name: &str, first: &str, before: Span) -> Diagnostic {
    let message = if name == first {
        let name = quote(name);
        text!("{name} is given twice", "{name} が二度書かれています")
    } else {
        text!(
            "`{name}` and `{first}` are the same attribute",
            "`{name}` と `{first}` は同じ属性です"
        )
    };
    Diagnostic::error(210, span, message)
        .help(text!(
            "remove one of them; the first one is read",
            "どちらか一方を削除してください。先の方を読みます"
        ))
        .label(before, text!("the first is here", "一つ目はここです"))
}

/// `turn=L`.
#[cold]
pub fn value_not_quoted(span: Span, name: &str, value: &str) -> Diagnostic {
    let (name, value) = (shortened(name), shortened(value));
    let message = text!(
        "the value of `{name}` has no quotes",
        "`{name}` の値が引用符で囲まれていません"
    );
    Diagnostic::error(211, span, message).help(text!(
        "write `{name}=\"{value}\"`",
        "`{name}=\"{value}\"` と書いてください"
    ))
}

/// `name=「裏長屋」`.
#[cold]
pub fn value_in_brackets(span: Span, name: &str, value: &str) -> Diagnostic {
    let (name, value) = (shortened(name), shortened(value));
    let message = text!(
        "the value of `{name}` stands in brackets, not in quotes",
        "`{name}` の値が引用符ではなく括弧で囲まれています"
    );
    Diagnostic::error(211, span, message).help(text!(
        "replace the brackets by quotes: `{name}=\"{value}\"`",
        "括弧を引用符に置き換えて `{name}=\"{value}\"` と書いてください"
    ))
}

/// `<Loop hole>`.
#[cold]
pub fn value_missing(span: Span, name: &str) -> Diagnostic {
    let name = shortened(name);
    let message = text!("`{name}` has no value", "`{name}` に値がありません");
    Diagnostic::error(212, span, message).help(text!(
        "write `{name}=\"...\"`, or remove it",
        "`{name}=\"...\"` と書くか、削除してください"
    ))
}

/// `<Row turn "L">`.
#[cold]
pub fn equals_missing(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "`=` is missing between {name} and its value",
        "{name} と値のあいだに `=` がありません"
    );
    Diagnostic::error(212, span, message).help(text!(
        "write `=` between the name and the quote",
        "名前と引用符のあいだに `=` を書いてください"
    ))
}

/// `<1st>`.
#[cold]
pub fn bad_name(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} is no name in XML",
        "{name} は XML の名前になりません"
    );
    Diagnostic::error(213, span, message).help(text!(
        "names begin with a letter or `_` and go on with letters, digits, `_`, `-` and `.`",
        "名前は文字か `_` で始まり、文字、数字、`_`、`-`、`.` が続きます"
    ))
}

/// `<>`.
#[cold]
pub fn nameless_tag(span: Span) -> Diagnostic {
    let message = text!("the tag has no name", "タグに名前がありません");
    Diagnostic::error(213, span, message).help(text!(
        "write the element's name between `<` and `>`",
        "`<` と `>` のあいだに要素の名前を書いてください"
    ))
}

/// `name="a<b"`.
#[cold]
pub fn less_than_in_value(span: Span) -> Diagnostic {
    let message = text!(
        "`<` stands in the value of an attribute",
        "属性の値の中に `<` があります"
    );
    Diagnostic::error(214, span, message).help(text!(
        "write `&lt;`; or is the closing quote missing before it?",
        "`&lt;` と書いてください。または、その前の終わりの引用符を忘れていませんか"
    ))
}

/// `＝` in a tag.
#[cold]
pub fn full_width_markup(span: Span, wide: char, narrow: char) -> Diagnostic {
    let message = text!(
        "`{wide}` stands in a tag in place of `{narrow}`",
        "タグの中で `{narrow}` の代わりに `{wide}` が使われています"
    );
    Diagnostic::error(218, span, message).help(text!(
        "replace it by `{narrow}` (half width, straight)",
        "半角の `{narrow}` に置き換えてください"
    ))
}

/// U+3000 in a tag.
#[cold]
pub fn full_width_blank(span: Span) -> Diagnostic {
    let message = text!(
        "a full-width blank stands in a tag",
        "タグの中に全角空白があります"
    );
    Diagnostic::error(218, span, message).help(text!(
        "replace it by a plain blank",
        "半角空白に置き換えてください"
    ))
}

/// A quote, `=` or `/` that belongs to no attribute.
#[cold]
pub fn stray_in_tag(span: Span, what: &str) -> Diagnostic {
    let what = quote(what);
    let message = text!(
        "{what} belongs to no attribute",
        "{what} はどの属性にも属していません"
    );
    Diagnostic::error(219, span, message).help(text!(
        "remove it, or write an attribute as `name=\"value\"`",
        "削除するか、`name=\"value\"` の形で属性を書いてください"
    ))
}

/// `</Row turn="L">`.
#[cold]
pub fn junk_in_end_tag(span: Span) -> Diagnostic {
    let message = text!(
        "an end tag holds nothing but the name",
        "終了タグには名前しか書けません"
    );
    Diagnostic::error(219, span, message).help(text!(
        "move it into the start tag",
        "開始タグの中へ移してください"
    ))
}

/// `< Row>`.
#[cold]
pub fn blank_before_name(span: Span) -> Diagnostic {
    let message = text!(
        "a blank stands before the name of the element",
        "要素の名前の前に空白があります"
    );
    Diagnostic::error(219, span, message).help(text!("remove the blank", "空白を削除してください"))
}

/// `/ >`.
#[cold]
pub fn blank_before_closing(span: Span) -> Diagnostic {
    let message = text!(
        "a blank stands between `/` and `>`",
        "`/` と `>` のあいだに空白があります"
    );
    Diagnostic::error(219, span, message).help(text!("write `/>`", "`/>` と書いてください"))
}

/// `a="1"b="2"`.
#[cold]
pub fn no_blank_between(span: Span) -> Diagnostic {
    let message = text!(
        "no blank stands between two attributes",
        "属性と属性のあいだに空白がありません"
    );
    Diagnostic::error(219, span, message)
        .help(text!("put a blank here", "ここに空白を入れてください"))
}
