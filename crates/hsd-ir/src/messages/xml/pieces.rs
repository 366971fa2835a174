//! Messages about conditions, definitions and included files of the XML form.

use super::fixes::{offer, removing};
use super::language::{known, write};
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Edit, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Links of a chain that a message names.
const NAMED: usize = 12;

/// Places that a chain is marked at.
const MARKED: usize = 6;

/// The names of a chain with words between them.
pub(super) fn names(chain: &[(String, Span)], between: &str) -> String {
    let mut names: Vec<String> = chain.iter().map(|(name, _)| quote(name)).collect();
    if names.len() > NAMED {
        names.splice(NAMED / 2..names.len() - NAMED / 2, ["...".to_owned()]);
    }
    names.join(between)
}

/// A path, of a long one the end, which tells files apart.
pub(super) fn path_end(path: &str) -> String {
    let skipped = path.chars().count().saturating_sub(36);
    let cut = path.char_indices().nth(skipped);
    let cut = cut.map(|(at, _)| at).unwrap_or_default();
    match path[cut..].find(['/', '\\']) {
        Some(slash) if cut > 0 => format!("…{}", &path[cut + slash..]),
        _ if cut > 0 => path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned(),
        _ => path.to_owned(),
    }
}

/// Marks the links of a chain.
pub(super) fn marked(found: Diagnostic, chain: &[(String, Span)]) -> Diagnostic {
    chain
        .iter()
        .take(MARKED)
        .fold(found, |found, (name, span)| {
            if found.span() == Some(*span) {
                return found;
            }
            let name = quote(name);
            found.label(
                *span,
                text!([name] "{name} is used here", "{name} はここで使われています"),
            )
        })
}

/// `else` that does not follow an `if`; `fix` moves it behind the one before it.
#[cold]
pub fn else_without_if(span: Span, fix: Option<Vec<Edit>>) -> Diagnostic {
    let message = text!(
        "`else` does not follow an `if`",
        "`else` の直前に `if` がありません"
    );
    let found = Diagnostic::error(262, span, message).help(text!(
        "move it directly behind the `</if>` that it belongs to",
        "対応する `</if>` のすぐ後に置いてください"
    ));
    let title = text!("Move it behind the `</if>`", "`</if>` の後に移す");
    match fix {
        Some(edits) => found.fix_all(title, edits),
        None => found,
    }
}

/// An unknown definition.
#[cold]
pub fn unknown_piece(span: Span, name: &str, near: Option<&str>, names: &[String]) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "there is no `define` named {name}",
        "{name} という名前の `define` はありません"
    );
    let found = Diagnostic::error(263, span, message).help(match near {
        Some(near) => write(near),
        None => {
            let all = known(names);
            text!([all] "defined here: {all}", "ここで定義されているもの: {all}")
        }
    });
    offer(found, span, near)
}

/// A definition that uses itself.
#[cold]
pub fn piece_in_itself(span: Span, chain: &[(String, Span)], place: Span) -> Diagnostic {
    let (en, ja) = (names(chain, " in which "), names(chain, " → "));
    let message = text!([en, ja]
        "a definition contains itself: {en}",
        "定義が自分自身を含んでいます: {ja}"
    );
    let found = Diagnostic::error(264, span, message)
        .help(text!(
            "definitions cannot repeat themselves; use `repeat`",
            "定義で自分を繰り返すことはできません。`repeat` を使ってください"
        ))
        .label(
            place,
            text!("its definition is here", "定義はここにあります"),
        );
    marked(found, chain)
}

/// A parameter that the definition does not have; `whole` = what sets it, with the blanks before it.
#[cold]
pub fn unknown_parameter(
    span: Span,
    name: &str,
    piece: &str,
    near: Option<&str>,
    names: &[String],
    whole: Span,
) -> Diagnostic {
    let title = removing(name);
    let (name, piece) = (quote(name), quote(piece));
    let message = text!([piece, name]
        "{piece} has no parameter {name}",
        "{piece} に {name} というパラメーターはありません"
    );
    let found = Diagnostic::error(265, span, message).help(match near {
        Some(near) => write(near),
        None => {
            let all = known(names);
            text!([all] "its parameters: {all}", "パラメーター: {all}")
        }
    });
    match near {
        Some(near) => offer(found, span, [near]),
        None => found.fix(title, whole, ""),
    }
}

/// A `use` with content; `fix` moves that behind it.
#[cold]
pub fn use_with_content(span: Span, fix: Option<Vec<Edit>>) -> Diagnostic {
    let message = text!(
        "`use` cannot have content: it is replaced by the content of its `define`",
        "`use` の中には何も書けません。`define` の中身がその場所に入ります"
    );
    replaced_with_content(span, message, fix)
}

/// Content of an element that is replaced.
pub(super) fn replaced_with_content(
    span: Span,
    message: Text,
    fix: Option<Vec<Edit>>,
) -> Diagnostic {
    let found = Diagnostic::error(266, span, message).help(text!(
        "end it with `/>`, and move its content before or behind it",
        "`/>` で閉じ、中身は前か後ろに移してください"
    ));
    let title = text!("Move its content behind it", "中身を後ろに移す");
    match fix {
        Some(edits) => found.fix_all(title, edits),
        None => found,
    }
}

/// A file that cannot be included; `why` in the words of the system.
#[cold]
pub fn include_missing(span: Span, href: &str, why: Option<&str>) -> Diagnostic {
    let href = quote(href);
    let message = match why {
        Some(why) => text!([href, why]
            "{href} cannot be included: {why}",
            "{href} を取り込めません: {why}"
        ),
        None => text!([href]
            "{href} cannot be included: there is no such file",
            "{href} を取り込めません。ファイルがありません"
        ),
    };
    Diagnostic::error(267, span, message).help(text!(
        "the path is relative to the folder of the file that includes it",
        "パスは、取り込む側のファイルのフォルダーから見たものです"
    ))
}

/// A file that may not be included.
#[cold]
pub fn include_outside(span: Span, href: &str) -> Diagnostic {
    let href = quote(href);
    let message = text!([href]
        "{href} is outside the root folder",
        "{href} は基準フォルダーの外にあります"
    );
    Diagnostic::error(268, span, message).help(text!(
        "name a file in the folder of this file or below it, with `/` between folders; `--root DIR` sets a higher folder as the root",
        "このファイルのフォルダーかその下のファイルを、フォルダーを `/` で区切って書いてください。`--root DIR` でもっと上のフォルダーを基準にできます"
    ))
}

/// Files that include each other.
#[cold]
pub fn include_cycle(span: Span, chain: &[(String, Span)]) -> Diagnostic {
    let paths: Vec<_> = chain.iter().map(|(n, s)| (path_end(n), *s)).collect();
    let (en, ja) = (names(&paths, ", which includes "), names(&paths, " → "));
    let message = text!([en, ja]
        "files include each other: {en}",
        "ファイルが互いを取り込んでいます: {ja}"
    );
    let found = Diagnostic::error(269, span, message).help(text!(
        "move what both need to a third file, and include that in both",
        "両方で使うものを三つ目のファイルに移し、両方からそれを取り込んでください"
    ));
    marked(found, &chain[..chain.len().saturating_sub(1)])
}

/// A file of another form.
#[cold]
pub fn include_no_xml(span: Span) -> Diagnostic {
    let message = text!(
        "only files in the XML form can be included",
        "取り込めるのは XML 形式のファイルだけです"
    );
    Diagnostic::error(270, span, message).help(text!(
        "write the definitions in `<Catalog>...</Catalog>`",
        "定義を `<Catalog>...</Catalog>` の中に書いてください"
    ))
}

/// A file without definitions.
#[cold]
pub fn include_nothing(span: Span) -> Diagnostic {
    let message = text!(
        "this file is included, but defines nothing",
        "このファイルは取り込まれていますが、何も定義していません"
    );
    Diagnostic::warning(270, span, message).help(text!(
        "write `define`, `let` or `Param` directly in its outermost element",
        "`define`、`let`、`Param` を最も外側の要素の直下に書いてください"
    ))
}

/// More files than the limit.
#[cold]
pub fn too_many_includes(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "more than {limit} files are included; this one is ignored",
        "取り込むファイルが {limit} 個を超えました。これは読みません"
    );
    Diagnostic::error(903, span, message).help(text!(
        "join some of them, or raise the limit with `--max-includes`",
        "いくつかをまとめるか、`--max-includes` で上限を上げてください"
    ))
}

/// More bytes in included files than the limit.
#[cold]
pub fn too_much_included(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "the included files have more than {limit} bytes in total; this one is ignored",
        "取り込むファイルが合わせて {limit} バイトを超えました。これは読みません"
    );
    Diagnostic::error(910, span, message).help(text!(
        "include less, or raise the limit with `--max-included-bytes`",
        "取り込むものを減らすか、`--max-included-bytes` で上限を上げてください"
    ))
}

/// Uses and repetitions that grow beyond the limit.
#[cold]
pub fn copies_too_large(span: Span, limit: u64, chain: &[(String, Span)]) -> Diagnostic {
    let (en, ja) = (names(chain, " in which "), names(chain, " → "));
    let message = match chain {
        [] => text!([limit]
            "repetitions make more than {limit} parts",
            "繰り返しが部材 {limit} 個を超えます"
        ),
        _ => text!([limit, en, ja]
            "pieces and repetitions make more than {limit} parts: {en}",
            "定義と繰り返しが部材 {limit} 個を超えます: {ja}"
        ),
    };
    let found = Diagnostic::error(904, span, message).help(text!(
        "repeat less, or raise the limit with `--max-parts`; the houses of this file are not built",
        "繰り返しを減らすか、`--max-parts` で上限を上げてください。このファイルの家は作りません"
    ));
    marked(found, chain)
}
