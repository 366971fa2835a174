//! Messages about the elements, attributes and codes of the XML form.

use crate::diagnostic::messages::words::{all_of, any_of, quote};
use crate::diagnostic::{Diagnostic, Text};
use crate::source::Span;
use crate::text;

/// Text in an element that holds elements only.
#[cold]
pub fn text_not_allowed(span: Span, text: &str, parent: &str) -> Diagnostic {
    let (text, parent) = (quote(text), quote(parent));
    let message = text!(
        "the text {text} has no place in {parent}",
        "{parent} の中に文字 {text} は書けません"
    );
    Diagnostic::error(209, span, message).help(text!(
        "codes belong in `Row`, `Floor`, `upper` or `lower`; make it a comment if it is a remark",
        "部材コードは `Row`、`Floor`、`upper`、`lower` の中に書きます。覚え書きなら注釈にしてください"
    ))
}

/// A name that the language does not know.
#[cold]
pub fn unknown_element(
    span: Span,
    name: &str,
    near: Option<&str>,
    parent: Option<&str>,
) -> Diagnostic {
    let name = quote(name);
    let message = text!("{name} is no element", "{name} という要素はありません");
    Diagnostic::error(221, span, message).help(match (near, parent) {
        (Some(near), _) => text!(
            "write `{near}`; capitals matter",
            "`{near}` と書いてください。大文字と小文字は区別されます"
        ),
        (None, Some(_)) => text!(
            "remove it; what stands in it is read as if it stood in the element round it",
            "取り除いてください。中身は外側の要素にあるものとして読みます"
        ),
        (None, None) => text!(
            "the outermost element is `House`, `Houses` or `Structure`",
            "最も外側の要素は `House`、`Houses`、`Structure` のどれかです"
        ),
    })
}

/// A name that the element does not bear.
#[cold]
pub fn unknown_attribute(
    span: Span,
    name: &str,
    element: &str,
    near: Option<&str>,
    known: &[&str],
) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} is no attribute of `{element}`",
        "`{element}` に {name} という属性はありません"
    );
    let all = all_of(known);
    Diagnostic::error(222, span, message).help(match near {
        Some(near) => text!("write `{near}`", "`{near}` と書いてください"),
        None if known.is_empty() => text!(
            "`{element}` bears nothing",
            "`{element}` に属性はありません"
        ),
        None => text!([all]
            "`{element}` bears {all}",
            "`{element}` の属性は {all} です"
        ),
    })
}

/// A known element where it has no meaning; `home` says where it has: names in backquotes and "outermost".
#[cold]
pub fn wrong_place(span: Span, name: &str, parent: Option<&str>, home: &str) -> Diagnostic {
    let message = match parent.map(quote) {
        Some(parent) => text!(
            "`{name}` has no place in {parent}",
            "{parent} の中に `{name}` は書けません"
        ),
        None => text!(
            "`{name}` cannot be the outermost element",
            "`{name}` は最も外側の要素になりません"
        ),
    };
    let names: Vec<&str> = home.split('`').skip(1).step_by(2).collect();
    let inside = any_of(&names).ja;
    let home_ja = match (names.is_empty(), home.contains("outermost")) {
        (true, _) => "最も外側に書くものです".to_owned(),
        (false, true) => format!(" {inside} の中か、最も外側に書くものです"),
        (false, false) => format!(" {inside} の中に書くものです"),
    };
    Diagnostic::error(223, span, message).help(text!(
        "`{name}` belongs in {home}; it is not read here",
        "`{name}` は{home_ja}。ここでは読みません"
    ))
}

/// `Roof` without a rectangle beside the storeys.
#[cold]
pub fn roof_for_roofs(span: Span) -> Diagnostic {
    let message = text!(
        "`Roof` has no place in `House`; the element for all roofs of a house is `Roofs`",
        "`House` の中に `Roof` は書けません。家の屋根全体を表す要素は `Roofs` です"
    );
    Diagnostic::error(223, span, message).help(text!("write `Roofs`", "`Roofs` と書いてください"))
}

/// An attribute that must be there.
#[cold]
pub fn attribute_missing(span: Span, element: &str, name: &str) -> Diagnostic {
    let message = text!(
        "`{element}` needs the attribute `{name}`",
        "`{element}` には属性 `{name}` が必要です"
    );
    Diagnostic::error(224, span, message).help(text!(
        "write `<{element} {name}=\"...\">`",
        "`<{element} {name}=\"...\">` と書いてください"
    ))
}

/// A value that is no number.
#[cold]
pub fn not_a_number(span: Span, name: &str, text: &str, mend: Option<&str>) -> Diagnostic {
    let (name, text) = (quote(name), quote(text));
    let message = text!(
        "{text} is no number for {name}",
        "{text} は {name} の数値として読めません"
    );
    Diagnostic::error(225, span, message).help(match mend.map(quote) {
        Some(mend) => text!("write {mend}", "{mend} と書いてください"),
        None => text!(
            "write plain digits with a point, such as `9.5`, without a unit",
            "`9.5` のように、半角の数字と小数点だけで単位を付けずに書いてください"
        ),
    })
}

/// A number that makes no sense.
#[cold]
pub fn out_of_range(span: Span, name: &str, text: &str, bounds: impl Into<Text>) -> Diagnostic {
    let (name, text, bounds) = (quote(name), quote(text), bounds.into());
    let message = text!(
        "{text} is out of range for {name}",
        "{text} は {name} の範囲を外れています"
    );
    Diagnostic::error(226, span, message)
        .help(text!([bounds] "write {bounds}", "{bounds}を書いてください"))
}

/// A word that is none of those asked for.
#[cold]
pub fn not_a_choice(
    span: Span,
    name: &str,
    text: &str,
    all: &[&str],
    near: Option<&str>,
) -> Diagnostic {
    let (name, text, all) = (quote(name), quote(text), any_of(all));
    let message = text!(
        "{text} is no value of {name}",
        "{text} は {name} の値になりません"
    );
    Diagnostic::error(227, span, message).help(match near {
        Some(near) => text!("write `{near}`", "`{near}` と書いてください"),
        None => text!([all] "write {all}", "{all} と書いてください"),
    })
}

/// A split without one of its halves.
#[cold]
pub fn child_missing(span: Span, parent: &str, name: &str) -> Diagnostic {
    let parent = quote(parent);
    let message = text!(
        "{parent} has no `{name}`",
        "{parent} に `{name}` がありません"
    );
    Diagnostic::error(230, span, message).help(text!(
        "write `<{name}>...</{name}>` in it",
        "その中に `<{name}>...</{name}>` と書いてください"
    ))
}

/// Two of something of which there is one.
#[cold]
pub fn second_of(span: Span, name: &str, parent: &str, before: Span) -> Diagnostic {
    let parent = quote(parent);
    let message = text!(
        "{parent} has a second `{name}`",
        "{parent} に `{name}` が二つあります"
    );
    Diagnostic::error(231, span, message)
        .help(text!("join the two", "ひとつにまとめてください"))
        .label(before, text!("the first is here", "一つ目はここです"))
}

/// `L` at the end of a row's text.
#[cold]
pub fn control_letter(span: Span, letter: char, turns: bool) -> Diagnostic {
    let message = text!(
        "the control letter `{letter}` has no meaning in XML; a row turns by `turn`",
        "XML では制御文字 `{letter}` に意味がありません。行は `turn` で曲げます"
    );
    Diagnostic::error(232, span, message).help(match (letter, turns) {
        ('^', _) => text!(
            "remove it and write the next storey as a `Storey` or `Floor` of its own",
            "削除して、次の階を別の `Storey` か `Floor` として書いてください"
        ),
        (_, true) => text!(
            "remove it and write `<Row turn=\"{letter}\">`",
            "削除して `<Row turn=\"{letter}\">` と書いてください"
        ),
        (_, false) => angle_turns(),
    })
}

/// What turns the walls of facades.
fn angle_turns() -> Text {
    text!(
        "remove it: the `angle` of the next `Facade` turns the wall",
        "削除してください。壁は次の `Facade` の `angle` で曲がります"
    )
}

/// `turn` on the base row of a floor.
#[cold]
pub fn turn_in_floor(span: Span) -> Diagnostic {
    let message = text!(
        "`turn` has no meaning in a `Floor`",
        "`Floor` の中では `turn` に意味がありません"
    );
    Diagnostic::error(232, span, message).help(angle_turns())
}

/// Characters that no code holds.
#[cold]
pub fn not_a_column(span: Span, text: &str, plain: &str) -> Diagnostic {
    if text.starts_with('\u{3000}') {
        let message = text!(
            "a full-width blank stands among the codes",
            "部材コードの並びに全角空白があります"
        );
        return Diagnostic::error(233, span, message).help(text!(
            "replace each full-width blank by two blanks",
            "全角空白ひとつを半角空白二つに置き換えてください"
        ));
    }
    let text = quote(text);
    let message = text!(
        "{text} cannot stand in a code of five columns",
        "{text} は五桁の部材コードに使えません"
    );
    let found = Diagnostic::error(233, span, message);
    if plain.is_empty() {
        found.help(text!(
            "codes are plain ASCII; name an own part by `<Part code=\"...\"/>`",
            "部材コードは ASCII です。独自の部材は `<Part code=\"...\"/>` で書いてください"
        ))
    } else {
        let plain = quote(plain);
        found.help(text!(
            "replace it by {plain}",
            "{plain} に置き換えてください"
        ))
    }
}

/// A tab among codes: in which column, from the first code of the line, and how many blanks reach the next code.
#[cold]
pub fn tab_in_codes(span: Span, column: usize, blanks: usize) -> Diagnostic {
    let message = text!(
        "a tab stands among the codes, in column {column} of this line of codes",
        "この行の{column}桁目、部材コードの並びにタブがあります"
    );
    let (plural, next) = (if blanks == 1 { "" } else { "s" }, column + blanks);
    Diagnostic::error(233, span, message).help(text!(
        "replace it by {blanks} blank{plural}, so that the next code begins in column {next}",
        "次の部材コードが{next}桁目から始まるよう、空白{blanks}個に置き換えてください"
    ))
}

/// A share above 1.
#[cold]
pub fn per_cent(span: Span, given: f64, share: f64) -> Diagnostic {
    let message = text!(
        "the reflection {given} is read as {given} per cent",
        "反射率 {given} を {given} パーセントとして読みました"
    );
    Diagnostic::warning(234, span, message).help(text!(
        "write the share of light from 0 to 1: `{share}`",
        "光の割合を 0 から 1 で `{share}` と書いてください"
    ))
}

/// A bad piece of `at`; `read` = what it is taken for.
#[cold]
pub fn not_a_position(span: Span, text: &str, read: Option<(u32, u32)>) -> Diagnostic {
    let text = quote(text);
    let message = text!("{text} is no position", "{text} は位置になりません");
    Diagnostic::error(235, span, message).help(match read {
        Some((first, last)) if first < last => {
            text!(
                "write `{first}-{last}`",
                "`{first}-{last}` と書いてください"
            )
        }
        Some((first, _)) => text!("write `{first}`", "`{first}` と書いてください"),
        None => text!(
            "positions count from 1; write for example `2,5-7`",
            "位置は 1 から数えます。`2,5-7` のように書いてください"
        ),
    })
}

/// An empty value.
#[cold]
pub fn value_empty(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!("the value of {name} is empty", "{name} の値が空です");
    Diagnostic::error(237, span, message).help(text!(
        "write a value, or remove the attribute",
        "値を書くか、属性を削除してください"
    ))
}

/// A point that is not two numbers.
#[cold]
pub fn not_a_point(span: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} takes two numbers, not {count}",
        "{name} の数値は二つですが、{count}個あります"
    );
    Diagnostic::error(238, span, message).help(text!(
        "write units to the left and units back, such as `4 8`",
        "`4 8` のように、左へと奥への距離を U で書いてください"
    ))
}

/// Neither one number nor two.
#[cold]
pub fn not_a_pair(span: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} takes one number or two, not {count}",
        "{name} の数値は一つか二つですが、{count}個あります"
    );
    Diagnostic::error(244, span, message).help(text!(
        "write two numbers, across and in depth, such as `5 2`; one alone stands for both",
        "`5 2` のように、間口と奥行きの二つを書いてください。一つなら両方を表します"
    ))
}

/// Weights that are all nought.
#[cold]
pub fn no_weight(span: Span) -> Diagnostic {
    let message = text!(
        "all weights are 0, so nothing can be drawn",
        "重みがすべて 0 なので抽選できません"
    );
    Diagnostic::error(239, span, message).help(text!(
        "give at least one code a weight above 0",
        "少なくともひとつの部材コードに 0 より大きい重みを付けてください"
    ))
}

/// A `replace` that says neither what nor where.
#[cold]
pub fn replaces_nothing(span: Span) -> Diagnostic {
    let message = text!(
        "`replace` says neither which code nor which position",
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
        "`repeat` holds nothing to repeat",
        "`repeat` の中に繰り返すものがありません"
    );
    Diagnostic::warning(242, span, message).help(text!(
        "put the parts between `<repeat num=\"...\">` and `</repeat>`; a void is `<Part code=\"     \"/>`",
        "部材を `<repeat num=\"...\">` と `</repeat>` のあいだに書いてください。空きは `<Part code=\"     \"/>` です"
    ))
}

/// A picture named by `src` that is not there.
#[cold]
pub fn src_missing(span: Span, file: &str) -> Diagnostic {
    let file = quote(file);
    let message = text!(
        "there is no picture {file}",
        "{file} という画像はありません"
    );
    Diagnostic::error(243, span, message).help(text!(
        "name a PNG or JPEG by its path from the folder of this file; a picture beside the text is also found without `src`, by its name",
        "このファイルのフォルダーから見た PNG か JPEG のパスを書いてください。テキストのそばの画像は `src` がなくても名前で見つかります"
    ))
}

/// A picture named by `src` outside the root folder.
#[cold]
pub fn src_outside(span: Span, file: &str) -> Diagnostic {
    let file = quote(file);
    let message = text!(
        "{file} lies outside the folder of the build",
        "{file} はビルドのフォルダーの外にあります"
    );
    Diagnostic::error(272, span, message).help(text!(
        "put the picture below the folder of the text, or name a folder above both by --root",
        "画像をテキストのフォルダーの中に置くか、両方を含むフォルダーを --root で指定してください"
    ))
}
