//! Messages about the markup between the tags: elements that do not close, text, comments, references.

use crate::diagnostic::messages::words::{quote, shortened};
use crate::diagnostic::{Diagnostic, Noun};
use crate::source::Span;
use crate::text;

/// Elements nest deeper than the limit.
#[cold]
pub fn nested_too_deep(span: Span, limit: usize) -> Diagnostic {
    let message = text!(
        "elements nest deeper than {limit}; this one is left out",
        "要素の入れ子が上限の{limit}段を超えるため、この要素は読みません"
    );
    Diagnostic::error(902, span, message).help(text!(
        "use fewer elements inside one another, or raise the limit for nesting",
        "入れ子を浅くするか、入れ子の上限を上げてください"
    ))
}

/// A comment, text section or processing instruction without its end.
#[cold]
pub fn not_ended(span: Span, what: Noun, end: &str) -> Diagnostic {
    let message = text!([what] "the {what} has no end", "{what}が終わっていません");
    Diagnostic::error(203, span, message).help(text!(
        "write `{end}` where it ends; reading goes on at the next line that begins with `<`",
        "終わりに `{end}` と書いてください。`<` で始まる次の行から読み続けます"
    ))
}

/// An element without its end tag; `before` = the tag before which it should stand, and that tag's name.
#[cold]
pub fn not_closed(span: Span, name: &str, before: Option<(Span, &str)>) -> Diagnostic {
    let name = shortened(name);
    let message = text!("`{name}` has no end tag", "`{name}` の終了タグがありません");
    let found = Diagnostic::error(204, span, message);
    match before {
        Some((place, tag)) => {
            let tag = quote(tag);
            found
                .help(text!(
                    "write `</{name}>` before this tag",
                    "このタグの前に `</{name}>` と書いてください"
                ))
                .label(
                    place,
                    text!(
                        "this tag of {tag} comes first",
                        "先に {tag} のタグがあります"
                    ),
                )
        }
        None => found.help(text!(
            "write `</{name}>`, at the end of the file at the latest",
            "遅くともファイルの終わりまでに `</{name}>` と書いてください"
        )),
    }
}

/// `</Rwo>` for `</Row>`.
#[cold]
pub fn end_differs(span: Span, name: &str, open: &str, start: Span) -> Diagnostic {
    let (name, open) = (shortened(name), shortened(open));
    let message = text!(
        "the end tag `</{name}>` does not match `<{open}>`",
        "終了タグ `</{name}>` が `<{open}>` と対応していません"
    );
    Diagnostic::error(205, span, message)
        .help(text!("write `</{open}>`", "`</{open}>` と書いてください"))
        .label(
            start,
            text!("`{open}` begins here", "`{open}` はここから始まります"),
        )
}

/// `<Row>` for `</Row>`.
#[cold]
pub fn slash_forgotten(span: Span, name: &str, start: Span) -> Diagnostic {
    let name = shortened(name);
    let message = text!(
        "`<{name}>` should be `</{name}>`",
        "`<{name}>` は `</{name}>` の誤りのようです"
    );
    Diagnostic::error(241, span, message)
        .help(text!(
            "write the slash: `</{name}>`",
            "斜線を入れて `</{name}>` と書いてください"
        ))
        .label(
            start,
            text!(
                "this `{name}` is still open",
                "この `{name}` がまだ閉じていません"
            ),
        )
}

/// An end tag that closes nothing; `inside` = the element it stands in.
#[cold]
pub fn stray_end(span: Span, name: &str, inside: Option<(&str, Span)>) -> Diagnostic {
    let name = shortened(name);
    let message = text!(
        "`</{name}>` closes nothing",
        "`</{name}>` に対応する開始タグがありません"
    );
    let found = Diagnostic::error(206, span, message).help(text!(
        "remove it, or write `<{name}>` where it should begin",
        "削除するか、始まる位置に `<{name}>` と書いてください"
    ));
    match inside {
        Some((open, place)) => {
            let open = quote(open);
            let label = text!(
                "the open element here is {open}",
                "ここで開いている要素は {open} です"
            );
            found.label(place, label)
        }
        None => found,
    }
}

/// A second outermost element.
#[cold]
pub fn second_root(span: Span, name: &str, first: Span) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} stands behind the end of the outermost element",
        "{name} が最も外側の要素の終わりより後にあります"
    );
    Diagnostic::error(207, span, message)
        .help(text!(
            "put several houses into one `<Houses>`",
            "何軒かの家はひとつの `<Houses>` の中に書いてください"
        ))
        .label(
            first,
            text!(
                "the outermost element is this one",
                "最も外側の要素はこれです"
            ),
        )
}

/// Text before or behind the outermost element.
#[cold]
pub fn text_outside(span: Span) -> Diagnostic {
    let message = text!(
        "text stands outside the outermost element",
        "最も外側の要素の外に文字があります"
    );
    Diagnostic::error(208, span, message).help(text!(
        "remove it, or make it a comment: `<!-- ... -->`",
        "削除するか、`<!-- ... -->` と注釈にしてください"
    ))
}

/// `a < b` in text.
#[cold]
pub fn bare_less_than(span: Span) -> Diagnostic {
    let message = text!("`<` begins no tag", "`<` がタグの始まりになっていません");
    Diagnostic::error(214, span, message).help(text!(
        "write `&lt;` for the character `<`",
        "文字としての `<` は `&lt;` と書いてください"
    ))
}

/// `]]>` in text.
#[cold]
pub fn stray_cdata_end(span: Span) -> Diagnostic {
    let message = text!(
        "`]]>` ends no text section",
        "`]]>` に対応する CDATA 区間がありません"
    );
    Diagnostic::error(214, span, message).help(text!("remove it", "削除してください"))
}

/// `&` that begins no reference.
#[cold]
pub fn bare_ampersand(span: Span) -> Diagnostic {
    let message = text!("`&` stands alone", "`&` が単独で使われています");
    Diagnostic::error(215, span, message).help(text!(
        "write `&amp;` for the character `&`",
        "文字としての `&` は `&amp;` と書いてください"
    ))
}

/// `&nbsp;` or `&#0;`.
#[cold]
pub fn unknown_entity(span: Span, reference: &str) -> Diagnostic {
    let reference = quote(reference);
    let message = text!(
        "{reference} stands for no character",
        "{reference} が表す文字はありません"
    );
    Diagnostic::error(216, span, message).help(text!(
        "write the character itself; only `&lt;` `&gt;` `&amp;` `&quot;` `&apos;` and numbers such as `&#23478;` are read",
        "文字そのものを書いてください。読めるのは `&lt;` `&gt;` `&amp;` `&quot;` `&apos;` と、`&#23478;` のような番号だけです"
    ))
}

/// A document type or another declaration.
#[cold]
pub fn document_type(span: Span) -> Diagnostic {
    let message = text!(
        "declarations such as a document type are refused",
        "文書型などの宣言は受け付けません"
    );
    Diagnostic::error(217, span, message).help(text!(
        "remove it: a house needs no document type and no entities",
        "削除してください。家に文書型や実体は要りません"
    ))
}

/// `--` in a comment.
#[cold]
pub fn dashes_in_comment(span: Span) -> Diagnostic {
    let message = text!("`--` stands in a comment", "注釈の中に `--` があります");
    Diagnostic::warning(236, span, message).help(text!(
        "use another character: other XML programs refuse the whole file for it",
        "別の文字にしてください。ほかの XML プログラムはファイル全体を拒みます"
    ))
}

/// `<!--` in a comment.
#[cold]
pub fn comment_in_comment(span: Span, open: Span) -> Diagnostic {
    let message = text!(
        "a comment begins inside a comment",
        "注釈の中で注釈が始まっています"
    );
    Diagnostic::warning(236, span, message)
        .help(text!(
            "write `-->` where the first comment ends: everything between the two is not read",
            "最初の注釈の終わりに `-->` と書いてください。二つのあいだはすべて読まれません"
        ))
        .label(
            open,
            text!(
                "the first comment begins here",
                "最初の注釈はここから始まります"
            ),
        )
}

/// A file of comments only.
#[cold]
pub fn no_element(span: Span) -> Diagnostic {
    let message = text!("the file holds no element", "ファイルに要素がありません");
    Diagnostic::error(220, span, message).help(text!(
        "write `<House>...</House>`",
        "`<House>...</House>` と書いてください"
    ))
}

/// `<?xml ...?>` that is not at the start, or says something else than its version, encoding and `standalone`.
#[cold]
pub fn bad_declaration(span: Span, sound: bool) -> Diagnostic {
    let message = match sound {
        true => text!(
            "the XML declaration is not at the start of the file",
            "XML 宣言がファイルの先頭にありません"
        ),
        false => text!(
            "this is no XML declaration",
            "XML 宣言として正しくありません"
        ),
    };
    Diagnostic::error(245, span, message).help(text!(
        "write `<?xml version=\"1.0\" encoding=\"UTF-8\"?>` as the very first characters of the file, or remove it",
        "ファイルのいちばん先頭に `<?xml version=\"1.0\" encoding=\"UTF-8\"?>` と書くか、取り除いてください"
    ))
}
