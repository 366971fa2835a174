//! Messages about the elements, attributes and codes of the XML form.

use super::fixes::{escaped, offer_comment, removing, writing};
use hsd_base::diagnostic::messages::words::{all_of, any_of, quote};
use hsd_base::diagnostic::{Diagnostic, Edit, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Text in an element that holds elements only; `written` = how it stands in the file.
#[cold]
pub fn text_not_allowed(span: Span, text: &str, parent: &str, written: &str) -> Diagnostic {
    let (text, parent) = (quote(text), quote(parent));
    let message = text!([parent, text]
        "text is not allowed in {parent}: {text}",
        "{parent} の中に文字 {text} は書けません"
    );
    let found = Diagnostic::error(209, span, message).help(text!(
        "codes belong in `Row`, `Floor`, `upper` or `lower`; remarks are comments",
        "部材コードは `Row`、`Floor`、`upper`、`lower` の中に書きます。覚え書きはコメントにしてください"
    ));
    offer_comment(found, span, written)
}

/// The tags of an element, for fixes.
pub struct Tags {
    /// The names in its start tag and its end tag.
    pub names: Vec<Span>,
    /// Both tags, or the only one.
    pub whole: Vec<Span>,
}

/// Another name for an element.
fn renamed(found: Diagnostic, tags: &Tags, name: &str) -> Diagnostic {
    let edits = tags.names.iter().map(|span| Edit::new(*span, name));
    found.fix_all(writing(name), edits.collect())
}

/// An unknown element.
#[cold]
pub fn unknown_element(
    span: Span,
    name: &str,
    near: Option<&str>,
    parent: Option<&str>,
    tags: &Tags,
) -> Diagnostic {
    let title = removing(name);
    let name = quote(name);
    let message = text!([name]
        "there is no element {name}",
        "{name} という要素はありません"
    );
    let found = Diagnostic::error(221, span, message).help(match (near, parent) {
        (Some(near), _) => text!([near]
            "write `{near}`; names are case-sensitive",
            "`{near}` と書いてください。大文字と小文字は区別されます"
        ),
        (None, Some(_)) => text!(
            "remove it; its content is read as content of the enclosing element",
            "削除してください。中身は外側の要素のものとして読みます"
        ),
        (None, None) => text!(
            "the outermost element is `House`, `Houses` or `Structure`",
            "最も外側の要素は `House`、`Houses`、`Structure` のどれかです"
        ),
    });
    match (near, parent) {
        (Some(near), _) => renamed(found, tags, near),
        (None, Some(_)) => {
            let edits = tags.whole.iter().map(|span| Edit::new(*span, ""));
            found.fix_all(title, edits.collect())
        }
        (None, None) => found,
    }
}

/// An attribute that the element does not have; `whole` = it with the blanks before it; `near` may be given already.
#[cold]
pub fn unknown_attribute(
    span: Span,
    name: &str,
    element: &str,
    near: Option<(&str, bool)>,
    known: &[&str],
    whole: Option<Span>,
) -> Diagnostic {
    let title = removing(name);
    let name = quote(name);
    let message = text!([element, name]
        "`{element}` has no attribute {name}",
        "`{element}` に {name} という属性はありません"
    );
    let all = all_of(known);
    let found = Diagnostic::error(222, span, message).help(match near {
        Some((near, _)) => text!([near] "write `{near}`", "`{near}` と書いてください"),
        None if known.is_empty() => text!([element]
            "`{element}` has no attributes",
            "`{element}` に属性はありません"
        ),
        None => text!([all, element]
            "its attributes are {all}",
            "`{element}` の属性は {all} です"
        ),
    });
    match (near, whole) {
        (Some((near, false)), _) => found.fix(writing(near), span, near),
        (_, Some(whole)) => found.fix(title, whole, ""),
        (_, None) => found,
    }
}

/// The covering of roofs as an attribute of another element; `kind` = the letter of what was written.
#[cold]
pub fn roofing(span: Span, name: &str, element: &str, kind: &str, whole: Span) -> Diagnostic {
    let title = removing(name);
    let name = quote(name);
    let message = text!([element, name]
        "`{element}` has no attribute {name}",
        "`{element}` に {name} という属性はありません"
    );
    Diagnostic::error(222, span, message)
        .help(text!([kind]
            "the covering is the `kind` of all roofs: write `<Roofs kind=\"{kind}\"/>` in `House`",
            "葺き材は屋根全体の `kind` です。`House` の中に `<Roofs kind=\"{kind}\"/>` と書いてください"
        ))
        .fix(title, whole, "")
}

/// A known element in the wrong place; `home` says where it belongs: names in backquotes and "outermost".
#[cold]
pub fn wrong_place(span: Span, name: &str, parent: Option<&str>, home: &str) -> Diagnostic {
    let message = match parent.map(quote) {
        Some(parent) => text!([name, parent]
            "`{name}` is not allowed in {parent}",
            "{parent} の中に `{name}` は書けません"
        ),
        None => text!([name]
            "`{name}` cannot be the outermost element",
            "`{name}` は最も外側の要素になりません"
        ),
    };
    let names: Vec<&str> = home.split('`').skip(1).step_by(2).collect();
    let inside = any_of(&names);
    let home = match (names.is_empty(), home.contains("outermost")) {
        (true, _) => text!([home] "{home}", "最も外側に書くものです"),
        (false, true) => text!([home, inside] "{home}", " {inside} の中か、最も外側に書くものです"),
        (false, false) => text!([home, inside] "{home}", " {inside} の中に書くものです"),
    };
    Diagnostic::error(223, span, message).help(text!([name, home]
        "`{name}` belongs in {home}; it is ignored here",
        "`{name}` は{home}。ここでは読みません"
    ))
}

/// `Roof` without a rectangle next to the storeys.
#[cold]
pub fn roof_for_roofs(span: Span, tags: &Tags) -> Diagnostic {
    let message = text!(
        "`Roof` is not allowed in `House`; the element for all roofs of a house is `Roofs`",
        "`House` の中に `Roof` は書けません。家の屋根全体を表す要素は `Roofs` です"
    );
    let found = Diagnostic::error(223, span, message)
        .help(text!("write `Roofs`", "`Roofs` と書いてください"));
    renamed(found, tags, "Roofs")
}

/// A required attribute that is missing, with `words` if it takes only those. `span` = the element's name.
#[cold]
pub fn attribute_missing(span: Span, element: &str, name: &str, words: &[&str]) -> Diagnostic {
    let message = text!([element, name]
        "`{element}` needs the attribute `{name}`",
        "`{element}` には属性 `{name}` が必要です"
    );
    let found = Diagnostic::error(224, span, message).help(text!([element, name]
        "write `<{element} {name}=\"...\">`",
        "`<{element} {name}=\"...\">` と書いてください"
    ));
    words.iter().fold(found, |found, word| {
        let fix = format!("{name}=\"{word}\"");
        found.fix(writing(&fix), span.after(), format!(" {fix}"))
    })
}

/// A split without one of its halves.
#[cold]
pub fn child_missing(span: Span, parent: &str, name: &str) -> Diagnostic {
    let parent = quote(parent);
    let message = text!([parent, name]
        "{parent} has no `{name}`",
        "{parent} に `{name}` がありません"
    );
    Diagnostic::error(230, span, message).help(text!([name]
        "write `<{name}>...</{name}>` in it",
        "その中に `<{name}>...</{name}>` と書いてください"
    ))
}

/// A second element where one is allowed; `fixes` = how to join them, and how to remove the second.
#[cold]
pub fn second_of(
    span: Span,
    name: &str,
    parent: &str,
    before: Span,
    fixes: [Option<Vec<Edit>>; 2],
) -> Diagnostic {
    let parent = quote(parent);
    let message = text!([parent, name]
        "{parent} has a second `{name}`",
        "{parent} に `{name}` が二つあります"
    );
    let found = Diagnostic::error(231, span, message)
        .help(text!("join the two", "ひとつにまとめてください"))
        .label(before, text!("the first is here", "一つ目はここです"));
    let titles = [
        text!("Join the two", "ひとつにまとめる"),
        text!("Remove this one", "こちらを削除する"),
    ];
    let fixes = titles.into_iter().zip(fixes);
    fixes.fold(found, |found, (title, edits)| match edits {
        Some(edits) => found.fix_all(title, edits),
        None => found,
    })
}

/// `L` at the end of a row's codes; `turns` = the row may have a `turn`, `turn` = where, if it has none.
#[cold]
pub fn control_letter(span: Span, letter: char, turns: bool, turn: Option<Span>) -> Diagnostic {
    let message = text!([letter]
        "the turn letter `{letter}` has no meaning in XML; a row turns with `turn`",
        "XML では曲がりの文字 `{letter}` を使いません。行は `turn` で曲げます"
    );
    let found = Diagnostic::error(232, span, message).help(match (letter, turns) {
        ('^', _) => text!(
            "remove it and write the next storey as another `Storey` or `Floor`",
            "削除して、次の階を別の `Storey` か `Floor` として書いてください"
        ),
        (_, true) => text!([letter]
            "remove it and write `<Row turn=\"{letter}\">`",
            "削除して `<Row turn=\"{letter}\">` と書いてください"
        ),
        (_, false) => angle_turns(),
    });
    let removed = Edit::new(span, "");
    let fix = format!("turn=\"{letter}\"");
    match turn.filter(|_| letter != '^') {
        Some(turn) => {
            let edits = vec![Edit::new(turn, format!(" {fix}")), removed];
            found.fix_all(writing(&fix), edits)
        }
        None => found.fix_all(removing(&letter.to_string()), vec![removed]),
    }
}

/// Advice on turns of facades.
fn angle_turns() -> Text {
    text!(
        "remove it: the `angle` of the next `Facade` turns the wall",
        "削除してください。壁は次の `Facade` の `angle` で曲がります"
    )
}

/// `turn` on the base row of a floor; `whole` = the attribute with the blanks before it.
#[cold]
pub fn turn_in_floor(span: Span, whole: Span) -> Diagnostic {
    let message = text!(
        "`turn` has no meaning in a `Floor`",
        "`Floor` の中では `turn` に意味がありません"
    );
    Diagnostic::error(232, span, message)
        .help(angle_turns())
        .fix(removing("turn"), whole, "")
}

/// Characters that cannot be in a code, and those meant instead.
#[cold]
pub fn not_a_column(span: Span, text: &str, plain: &str) -> Diagnostic {
    let fix = escaped(plain);
    if text.starts_with('\u{3000}') {
        let message = text!(
            "there is a full-width blank among the codes",
            "部材コードの並びに全角空白があります"
        );
        return Diagnostic::error(233, span, message)
            .help(text!(
                "replace each full-width blank by two blanks",
                "全角空白ひとつを半角空白二つに置き換えてください"
            ))
            .fix(
                text!("Replace by half-width blanks", "半角空白に置き換える"),
                span,
                fix,
            );
    }
    let text = quote(text);
    let message = text!([text]
        "{text} cannot be used in a code of five columns",
        "{text} は五桁の部材コードに使えません"
    );
    let found = Diagnostic::error(233, span, message);
    if plain.is_empty() {
        found.help(text!(
            "codes are ASCII; write a custom part as `<Part code=\"...\"/>`",
            "部材コードは ASCII です。自作部材は `<Part code=\"...\"/>` で書いてください"
        ))
    } else {
        let (title, braces) = (writing(plain), plain.contains(['{', '}']));
        let plain = quote(plain);
        let found = found.help(text!([plain]
            "replace it by {plain}",
            "{plain} に置き換えてください"
        ));
        match braces {
            true => found, // those would begin an expression
            false => found.fix(title, span, fix),
        }
    }
}

/// A tab among codes: in which column, from the first code of the line, and how many blanks reach the next code.
#[cold]
pub fn tab_in_codes(span: Span, column: usize, blanks: usize) -> Diagnostic {
    let message = text!([column]
        "there is a tab among the codes, in column {column} of this line",
        "この行の{column}桁目、部材コードの並びにタブがあります"
    );
    let fix = " ".repeat(blanks.min(4096));
    let (plural, next) = (if blanks == 1 { "" } else { "s" }, column + blanks);
    Diagnostic::error(233, span, message)
        .help(text!([blanks, plural, next]
            "replace it by {blanks} blank{plural}, so that the next code begins in column {next}",
            "次の部材コードが{next}桁目から始まるよう、空白{blanks}個に置き換えてください"
        ))
        .fix(
            text!([blanks, plural]
                "Replace by {blanks} blank{plural}",
                "空白{blanks}個に置き換える"
            ),
            span,
            fix,
        )
}

/// A `replace` without `code` and `at`.
#[cold]
pub fn replaces_nothing(span: Span) -> Diagnostic {
    let message = text!(
        "`replace` has neither a code nor a position",
        "`replace` に置き換える部材コードも位置もありません"
    );
    Diagnostic::error(240, span, message).help(text!(
        "write `code=\"...\"`, `at=\"...\"` or both",
        "`code=\"...\"` か `at=\"...\"`、または両方を書いてください"
    ))
}

/// A `repeat` without content.
#[cold]
pub fn repeats_nothing(span: Span) -> Diagnostic {
    let message = text!(
        "`repeat` contains nothing to repeat",
        "`repeat` の中に繰り返すものがありません"
    );
    Diagnostic::warning(242, span, message).help(text!(
        "write the parts between `<repeat num=\"...\">` and `</repeat>`; a void is `<Part code=\"     \"/>`",
        "部材を `<repeat num=\"...\">` と `</repeat>` のあいだに書いてください。空きは `<Part code=\"     \"/>` です"
    ))
}

/// An image named by `src` that does not exist.
#[cold]
pub fn src_missing(span: Span, file: &str) -> Diagnostic {
    let file = quote(file);
    let message = text!([file] "there is no image {file}", "{file} という画像はありません");
    Diagnostic::error(243, span, message).help(text!(
        "write the path of a PNG or JPEG relative to the folder of this file; an image next to this file is also found without `src`, by its name",
        "このファイルのフォルダーから見た PNG か JPEG のパスを書いてください。このファイルと同じフォルダーの画像は `src` がなくても名前で見つかります"
    ))
}

/// An image named by `src` outside the root folder.
#[cold]
pub fn src_outside(span: Span, file: &str) -> Diagnostic {
    let file = quote(file);
    let message = text!([file]
        "{file} is outside the root folder",
        "{file} は基準フォルダーの外にあります"
    );
    Diagnostic::error(272, span, message).help(text!(
        "put the image below the folder of this file, or name a folder above both with --root",
        "画像をこのファイルのフォルダーの中に置くか、両方を含むフォルダーを --root で指定してください"
    ))
}
