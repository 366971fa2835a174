//! Messages about the inside of tags: names, attributes, quotes.

use super::fixes::{putting_in, removing, writing};
use hsd_base::diagnostic::messages::words::{quote, shortened};
use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::Span;
use hsd_base::text;

/// `<Row` without `>`; `end` = what belongs where.
#[cold]
pub fn tag_not_closed(span: Span, name: &str, slash: bool, end: Edit) -> Diagnostic {
    let tag = quote(name);
    let message = text!([tag]
        "the tag of {tag} is not closed by `>`",
        "{tag} のタグが `>` で閉じていません"
    );
    let found = Diagnostic::error(201, span, message).help(if slash {
        text!(
            "write `/>` or `>` after the last attribute",
            "最後の属性の後に `/>` か `>` と書いてください"
        )
    } else {
        text!(
            "write `>` after the last attribute",
            "最後の属性の後に `>` と書いてください"
        )
    });
    found.fix_all(putting_in(&end.text), vec![end])
}

/// A value without its second quote, which belongs at `end`.
#[cold]
pub fn quote_not_closed(span: Span, name: &str, end: Edit) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "the value of {name} has no closing quote",
        "{name} の値に終わりの引用符がありません"
    );
    Diagnostic::error(202, span, message)
        .help(text!(
            "close it with the same quote that opens it",
            "始まりと同じ引用符で閉じてください"
        ))
        .fix_all(text!("Close the value", "値を閉じる"), vec![end])
}

/// The same attribute twice; `whole` = both with the blanks before them, the first one first.
#[cold]
pub fn attribute_twice(
    span: Span,
    name: &str,
    first: &str,
    before: Span,
    whole: [Span; 2],
) -> Diagnostic {
    let message = if name == first {
        let name = quote(name);
        text!([name] "{name} is given twice", "{name} が二度書かれています")
    } else {
        text!([name, first]
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
        .fix(text!("Remove this one", "こちらを削除する"), whole[1], "")
        .fix(text!("Remove the first", "一つ目を削除する"), whole[0], "")
}

/// `turn=L`.
#[cold]
pub fn value_not_quoted(span: Span, name: &str, value: &str) -> Diagnostic {
    let fix = in_quotes(value);
    let (name, value) = (shortened(name), shortened(value));
    let message = text!([name]
        "the value of `{name}` has no quotes",
        "`{name}` の値が引用符で囲まれていません"
    );
    Diagnostic::error(211, span, message)
        .help(text!([name, value]
            "write `{name}=\"{value}\"`",
            "`{name}=\"{value}\"` と書いてください"
        ))
        .fix(text!("Put it in quotes", "引用符で囲む"), span, fix)
}

/// The written part of a value, in quotes.
fn in_quotes(value: &str) -> String {
    format!("\"{}\"", value.replace('"', "&quot;"))
}

/// `name=「裏長屋」`.
#[cold]
pub fn value_in_brackets(span: Span, name: &str, value: &str) -> Diagnostic {
    let fix = in_quotes(value);
    let (name, value) = (shortened(name), shortened(value));
    let message = text!([name]
        "the value of `{name}` is in brackets, not in quotes",
        "`{name}` の値が引用符ではなく括弧で囲まれています"
    );
    Diagnostic::error(211, span, message)
        .help(text!([name, value]
            "replace the brackets by quotes: `{name}=\"{value}\"`",
            "括弧を引用符に置き換えて `{name}=\"{value}\"` と書いてください"
        ))
        .fix(
            text!("Replace the brackets by quotes", "括弧を引用符に置き換える"),
            span,
            fix,
        )
}

/// `<Loop hole>`; `whole` = all that is written of it, `switch` = it is yes or no, `spared` = it may be left out, and
/// this is what goes with it.
#[cold]
pub fn value_missing(
    span: Span,
    name: &str,
    whole: Span,
    switch: bool,
    spared: Option<Span>,
) -> Diagnostic {
    let yes = format!("{name}=\"yes\"");
    let name = shortened(name);
    let message = text!([name] "`{name}` has no value", "`{name}` に値がありません");
    let mut found = Diagnostic::error(212, span, message).help(text!([name]
        "write `{name}=\"...\"`, or remove it",
        "`{name}=\"...\"` と書くか、削除してください"
    ));
    if switch {
        found = found.fix(writing(&yes), whole, yes);
    }
    match spared {
        Some(spared) => found.fix(removing(&name), spared, ""),
        None => found,
    }
}

/// `<Row turn "L">`; `gap` = from the name to the quote.
#[cold]
pub fn equals_missing(span: Span, name: &str, gap: Span) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "`=` is missing between {name} and its value",
        "{name} と値のあいだに `=` がありません"
    );
    Diagnostic::error(212, span, message)
        .help(text!(
            "write `=` between the name and the quote",
            "名前と引用符のあいだに `=` を書いてください"
        ))
        .fix(putting_in("="), gap, "=")
}

/// `<1st>`.
#[cold]
pub fn bad_name(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} is not a valid XML name",
        "{name} は XML の名前になりません"
    );
    Diagnostic::error(213, span, message).help(text!(
        "names begin with a letter or `_` and continue with letters, digits, `_`, `-` and `.`",
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

/// `name="a<b"`; `all` = the places of all in the value.
#[cold]
pub fn less_than_in_value(span: Span, all: &[Span]) -> Diagnostic {
    let message = text!(
        "there is a `<` in the value of an attribute",
        "属性の値の中に `<` があります"
    );
    let fixes = all.iter().map(|place| Edit::new(*place, "&lt;"));
    Diagnostic::error(214, span, message)
        .help(text!(
            "write `&lt;`; or is the closing quote missing before it?",
            "`&lt;` と書いてください。または、その前の終わりの引用符を忘れていませんか"
        ))
        .fix_all(writing("&lt;"), fixes.collect())
}

/// `＝` in a tag; `all` = what must be replaced with it, for quotes both.
#[cold]
pub fn full_width_markup(span: Span, wide: char, narrow: char, all: &[Span]) -> Diagnostic {
    let message = text!([wide, narrow]
        "there is `{wide}` in a tag in place of `{narrow}`",
        "タグの中で `{narrow}` の代わりに `{wide}` が使われています"
    );
    let fixes = all.iter().map(|place| Edit::new(*place, narrow));
    Diagnostic::error(218, span, message)
        .help(text!([narrow]
            "replace it by `{narrow}` (half width, straight)",
            "半角の `{narrow}` に置き換えてください"
        ))
        .fix_all(writing(narrow.encode_utf8(&mut [0; 4])), fixes.collect())
}

/// U+3000 in a tag.
#[cold]
pub fn full_width_blank(span: Span) -> Diagnostic {
    let message = text!(
        "there is a full-width blank in a tag",
        "タグの中に全角空白があります"
    );
    Diagnostic::error(218, span, message)
        .help(text!(
            "replace it by a half-width blank",
            "半角空白に置き換えてください"
        ))
        .fix(
            text!("Write a half-width blank", "半角空白にする"),
            span,
            " ",
        )
}

/// A quote, `=` or `/` that belongs to no attribute.
#[cold]
pub fn stray_in_tag(span: Span, what: &str) -> Diagnostic {
    let fix = removing(what);
    let what = quote(what);
    let message = text!([what]
        "{what} is not part of an attribute",
        "{what} はどの属性にも属していません"
    );
    Diagnostic::error(219, span, message)
        .help(text!(
            "remove it, or write an attribute as `name=\"value\"`",
            "削除するか、`name=\"value\"` の形で属性を書いてください"
        ))
        .fix(fix, span, "")
}

/// `</Row turn="L">`.
#[cold]
pub fn junk_in_end_tag(span: Span, what: &str) -> Diagnostic {
    let message = text!(
        "an end tag contains only the name",
        "終了タグには名前しか書けません"
    );
    Diagnostic::error(219, span, message)
        .help(text!(
            "remove it; attributes belong in the start tag",
            "削除してください。属性は開始タグに書きます"
        ))
        .fix(removing(what), span, "")
}

/// `< Row>`.
#[cold]
pub fn blank_before_name(span: Span) -> Diagnostic {
    let message = text!(
        "there is a blank before the name of the element",
        "要素の名前の前に空白があります"
    );
    Diagnostic::error(219, span, message)
        .help(text!("remove the blank", "空白を削除してください"))
        .fix(text!("Remove the blank", "空白を削除する"), span, "")
}

/// `/ >`.
#[cold]
pub fn blank_before_closing(span: Span) -> Diagnostic {
    let message = text!(
        "there is a blank between `/` and `>`",
        "`/` と `>` のあいだに空白があります"
    );
    Diagnostic::error(219, span, message)
        .help(text!("write `/>`", "`/>` と書いてください"))
        .fix(writing("/>"), span, "")
}

/// `a="1"b="2"`.
#[cold]
pub fn no_blank_between(span: Span) -> Diagnostic {
    let message = text!(
        "there is no blank between two attributes",
        "属性と属性のあいだに空白がありません"
    );
    Diagnostic::error(219, span, message)
        .help(text!("insert a blank here", "ここに空白を入れてください"))
        .fix(text!("Insert a blank", "空白を入れる"), span, " ")
}
