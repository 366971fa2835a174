//! Messages about the markup between the tags: elements that do not close, text, comments, references.

use super::fixes::{offer_comment, putting_in, removing, writing};
use hsd_base::diagnostic::messages::words::{quote, shortened};
use hsd_base::diagnostic::{Diagnostic, Edit, Noun};
use hsd_base::source::Span;
use hsd_base::text;

/// Elements nest deeper than the limit.
#[cold]
pub fn nested_too_deep(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "elements nest deeper than the limit of {limit}; this one is ignored",
        "要素の入れ子が上限の{limit}段を超えるため、この要素は読みません"
    );
    Diagnostic::error(902, span, message).help(text!(
        "nest fewer elements, or raise the limit with `--max-nesting`",
        "入れ子を浅くするか、`--max-nesting` で上限を上げてください"
    ))
}

/// A comment, CDATA section or processing instruction without its end; `fix` inserts it.
#[cold]
pub fn not_ended(span: Span, what: Noun, end: &str, fix: Edit) -> Diagnostic {
    let message = text!([what] "the {what} has no end", "{what}が終わっていません");
    Diagnostic::error(203, span, message)
        .help(text!([end]
            "write `{end}` where it ends; reading goes on at the next line that begins with `<`",
            "終わりに `{end}` と書いてください。`<` で始まる次の行から読み続けます"
        ))
        .fix_all(putting_in(end), vec![fix])
}

/// An element without its end tag; `fix` inserts it, `before` = the tag that should follow it, and that tag's name.
#[cold]
pub fn not_closed(span: Span, name: &str, before: Option<(Span, &str)>, fix: Edit) -> Diagnostic {
    let name = shortened(name);
    let message = text!([name] "`{name}` has no end tag", "`{name}` の終了タグがありません");
    let title = putting_in(fix.text.trim());
    let found = Diagnostic::error(204, span, message).fix_all(title, vec![fix]);
    match before {
        Some((place, tag)) => {
            let tag = quote(tag);
            found
                .help(text!([name]
                    "write `</{name}>` before this tag",
                    "このタグの前に `</{name}>` と書いてください"
                ))
                .label(
                    place,
                    text!([tag]
                        "this tag of {tag} comes first",
                        "先に {tag} のタグがあります"
                    ),
                )
        }
        None => found.help(text!([name]
            "write `</{name}>`, at the end of the file at the latest",
            "遅くともファイルの終わりまでに `</{name}>` と書いてください"
        )),
    }
}

/// `</Rwo>` for `</Row>`.
#[cold]
pub fn end_differs(span: Span, name: &str, open: &str, start: Span) -> Diagnostic {
    let fix = format!("</{open}>");
    let (name, open) = (shortened(name), shortened(open));
    let message = text!([name, open]
        "the end tag `</{name}>` does not match `<{open}>`",
        "終了タグ `</{name}>` が `<{open}>` と対応していません"
    );
    Diagnostic::error(205, span, message)
        .help(text!([open] "write `</{open}>`", "`</{open}>` と書いてください"))
        .fix(writing(&fix), span, fix)
        .label(
            start,
            text!([open] "`{open}` begins here", "`{open}` はここから始まります"),
        )
}

/// `<Row>` for `</Row>`.
#[cold]
pub fn slash_forgotten(span: Span, name: &str, start: Span) -> Diagnostic {
    let fix = format!("</{name}>");
    let name = shortened(name);
    let message = text!([name]
        "`<{name}>` should be `</{name}>`",
        "`<{name}>` は `</{name}>` の誤りのようです"
    );
    Diagnostic::error(241, span, message)
        .help(text!([name]
            "write the slash: `</{name}>`",
            "斜線を入れて `</{name}>` と書いてください"
        ))
        .fix(writing(&fix), span, fix)
        .label(
            start,
            text!([name]
                "this `{name}` is still open",
                "この `{name}` がまだ閉じていません"
            ),
        )
}

/// An end tag without a start tag; `inside` = the element it is in.
#[cold]
pub fn stray_end(span: Span, name: &str, inside: Option<(&str, Span)>) -> Diagnostic {
    let name = shortened(name);
    let message = text!([name]
        "`</{name}>` has no start tag",
        "`</{name}>` に対応する開始タグがありません"
    );
    let found = Diagnostic::error(206, span, message)
        .help(text!([name]
            "remove it, or write `<{name}>` where it should begin",
            "削除するか、始まる位置に `<{name}>` と書いてください"
        ))
        .fix(removing(&format!("</{name}>")), span, "");
    match inside {
        Some((open, place)) => {
            let open = quote(open);
            let label = text!([open]
                "the open element here is {open}",
                "ここで開いている要素は {open} です"
            );
            found.label(place, label)
        }
        None => found,
    }
}

/// A second outermost element; `around` encloses all of them in one element, if that is allowed.
#[cold]
pub fn second_root(span: Span, name: &str, first: Span, around: Option<Vec<Edit>>) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} is after the end of the outermost element",
        "{name} が最も外側の要素の終わりより後にあります"
    );
    let found = Diagnostic::error(207, span, message)
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
        );
    let title = text!(
        "Put all of them into `<Houses>`",
        "全体を `<Houses>` で囲む"
    );
    match around {
        Some(edits) => found.fix_all(title, edits),
        None => found,
    }
}

/// Text before or after the outermost element; `written` = it.
#[cold]
pub fn text_outside(span: Span, written: &str) -> Diagnostic {
    let message = text!(
        "there is text outside the outermost element",
        "最も外側の要素の外に文字があります"
    );
    let found = Diagnostic::error(208, span, message).help(text!(
        "remove it, or make it a comment: `<!-- ... -->`",
        "削除するか、`<!-- ... -->` とコメントにしてください"
    ));
    offer_comment(found, span, written).fix(removing(written), span, "")
}

/// `a < b` in text.
#[cold]
pub fn bare_less_than(span: Span) -> Diagnostic {
    let message = text!(
        "`<` does not begin a tag",
        "`<` がタグの始まりになっていません"
    );
    Diagnostic::error(214, span, message)
        .help(text!(
            "remove it; for the character `<` write `&lt;`",
            "削除してください。文字としての `<` は `&lt;` と書きます"
        ))
        .fix(removing("<"), span, "")
}

/// `]]>` in text.
#[cold]
pub fn stray_cdata_end(span: Span) -> Diagnostic {
    let message = text!(
        "`]]>` does not end a CDATA section",
        "`]]>` に対応する CDATA 区間がありません"
    );
    Diagnostic::error(214, span, message)
        .help(text!("remove it", "削除してください"))
        .fix(removing("]]>"), span, "")
}

/// `&` that does not begin a reference.
#[cold]
pub fn bare_ampersand(span: Span) -> Diagnostic {
    let message = text!("`&` is on its own", "`&` が単独で使われています");
    Diagnostic::error(215, span, message)
        .help(text!(
            "write `&amp;` for the character `&`",
            "文字としての `&` は `&amp;` と書いてください"
        ))
        .fix(writing("&amp;"), span, "&amp;")
}

/// Characters that other languages give a name to, such as HTML.
const NAMED: [(&str, &str); 40] = [
    ("nbsp", " "),
    ("quot", "&quot;"),
    ("amp", "&amp;"),
    ("lt", "&lt;"),
    ("gt", "&gt;"),
    ("apos", "&apos;"),
    ("times", "×"),
    ("divide", "÷"),
    ("minus", "−"),
    ("plusmn", "±"),
    ("deg", "°"),
    ("prime", "′"),
    ("middot", "·"),
    ("bull", "•"),
    ("hellip", "…"),
    ("ndash", "–"),
    ("mdash", "—"),
    ("lsquo", "‘"),
    ("rsquo", "’"),
    ("ldquo", "“"),
    ("rdquo", "”"),
    ("copy", "©"),
    ("frac12", "½"),
    ("frac14", "¼"),
    ("frac34", "¾"),
    ("sup2", "²"),
    ("yen", "¥"),
    ("para", "¶"),
    ("sect", "§"),
    ("agrave", "à"),
    ("aacute", "á"),
    ("acirc", "â"),
    ("auml", "ä"),
    ("ccedil", "ç"),
    ("egrave", "è"),
    ("eacute", "é"),
    ("iuml", "ï"),
    ("ouml", "ö"),
    ("uuml", "ü"),
    ("szlig", "ß"),
];

/// `&nbsp;` or `&#0;`.
#[cold]
pub fn unknown_entity(span: Span, reference: &str) -> Diagnostic {
    let name = reference.trim_matches(['&', ';']).to_ascii_lowercase();
    let known = NAMED.iter().find(|(known, _)| *known == name);
    let reference = quote(reference);
    let message = text!([reference]
        "{reference} is not a character reference that hsd reads",
        "{reference} は読める文字参照ではありません"
    );
    let found = Diagnostic::error(216, span, message).help(text!(
        "write the character itself; only `&lt;` `&gt;` `&amp;` `&quot;` `&apos;` and numbers such as `&#23478;` are read",
        "文字そのものを書いてください。読めるのは `&lt;` `&gt;` `&amp;` `&quot;` `&apos;` と、`&#23478;` のような番号だけです"
    ));
    match known {
        Some((_, " ")) => found.fix(text!("Write a blank", "空白にする"), span, " "),
        Some((_, character)) => found.fix(writing(character), span, *character),
        None => found,
    }
}

/// A document type or another declaration; `whole` = all of it, if it has an end.
#[cold]
pub fn document_type(span: Span, whole: Option<Span>) -> Diagnostic {
    let message = text!(
        "declarations such as a document type are not accepted",
        "文書型などの宣言は受け付けません"
    );
    let found = Diagnostic::error(217, span, message).help(text!(
        "remove it: a house file needs no document type and no entities",
        "削除してください。家のファイルに文書型や実体は要りません"
    ));
    let title = text!("Remove the declaration", "宣言を削除する");
    match whole {
        Some(whole) => found.fix(title, whole, ""),
        None => found,
    }
}

/// `--` in a comment; `fix` replaces all in it.
#[cold]
pub fn dashes_in_comment(span: Span, fix: Vec<Edit>) -> Diagnostic {
    let message = text!(
        "`--` is not allowed in a comment",
        "コメントの中に `--` があります"
    );
    let found = Diagnostic::warning(236, span, message).help(text!(
        "use another character: other XML programs reject the whole file because of it",
        "別の文字にしてください。ほかの XML プログラムではファイル全体がエラーになります"
    ));
    match fix.is_empty() {
        true => found, // too many of them
        false => found.fix_all(text!("Write other characters", "別の文字にする"), fix),
    }
}

/// `<!--` in a comment, which began at `open`; `fix` ends that one before.
#[cold]
pub fn comment_in_comment(span: Span, open: Span, fix: Edit) -> Diagnostic {
    let message = text!(
        "a comment begins inside a comment",
        "コメントの中でコメントが始まっています"
    );
    Diagnostic::warning(236, span, message)
        .help(text!(
            "write `-->` where the first comment ends: everything between the two is ignored",
            "最初のコメントの終わりに `-->` と書いてください。二つのあいだはすべて読まれません"
        ))
        .label(
            open,
            text!(
                "the first comment begins here",
                "最初のコメントはここから始まります"
            ),
        )
        .fix_all(putting_in("-->"), vec![fix])
}

/// A file of comments only.
#[cold]
pub fn no_element(span: Span) -> Diagnostic {
    let message = text!("the file contains no element", "ファイルに要素がありません");
    Diagnostic::error(220, span, message).help(text!(
        "write `<House>...</House>`",
        "`<House>...</House>` と書いてください"
    ))
}

/// `<?xml ...?>` that is not at the start, or says something else than its version, encoding and `standalone`;
/// `start` = the start of the file, if it may be written there.
#[cold]
pub fn bad_declaration(span: Span, sound: bool, start: Option<Edit>) -> Diagnostic {
    let message = match sound {
        true => text!(
            "the XML declaration is not at the start of the file",
            "XML 宣言がファイルの先頭にありません"
        ),
        false => text!(
            "this is not an XML declaration",
            "XML 宣言として正しくありません"
        ),
    };
    let found = Diagnostic::error(245, span, message).help(text!(
        "write `<?xml version=\"1.0\" encoding=\"UTF-8\"?>` as the very first characters of the file, or remove it",
        "ファイルのいちばん先頭に `<?xml version=\"1.0\" encoding=\"UTF-8\"?>` と書くか、削除してください"
    ));
    let removed = Edit::new(span, "");
    let found = match start {
        Some(start) if start.span == span => found.fix_all(
            text!("Write a proper declaration", "正しい宣言にする"),
            vec![start],
        ),
        Some(start) => found.fix_all(
            text!("Move it to the start", "先頭に移す"),
            vec![start, removed.clone()],
        ),
        None => found,
    };
    found.fix_all(
        text!("Remove the declaration", "宣言を削除する"),
        vec![removed],
    )
}
