//! Messages about what is computed in the XML form: expressions, names and parameters. Those about conditions,
//! pieces and files stand in [`pieces`](super::pieces).

use crate::ast::{Parameter, Value};
use crate::diagnostic::messages::words::quote;
use crate::diagnostic::{Diagnostic, Noun, Text};
use crate::source::Span;
use crate::text;

/// Names that a help text lists.
const LISTED: usize = 12;

/// Known names for a help text.
pub(super) fn known(words: &[impl AsRef<str>]) -> Text {
    if words.is_empty() {
        return text!("nothing", "なし");
    }
    let listed = words.iter().take(LISTED).map(|w| quote(w.as_ref()));
    let listed: Vec<String> = listed.collect();
    let more = if words.len() > LISTED { ", ..." } else { "" };
    format!("{}{more}", listed.join(", ")).into()
}

/// "write `depth`".
pub(super) fn write(word: &str) -> Text {
    let word = quote(word);
    text!("write {word}", "{word} と書いてください")
}

fn found(value: &Value) -> Text {
    let shown = quote(&value.to_string());
    match value {
        Value::Text(_) => text!("the text {shown}", "文字列 {shown}"),
        Value::Number(_) => text!("the number {shown}", "数値 {shown}"),
        Value::Truth(_) => text!("the truth {shown}", "真偽値 {shown}"),
    }
}

/// What a parameter may be: "a number from 4 to 14 in steps of 1", "one of lattice, shop".
pub fn bounds(of: &Parameter) -> Text {
    if !of.choices.is_empty() {
        let words: Vec<String> = of.choices.iter().map(Value::to_string).collect();
        let words = words.join(", ");
        return text!("one of {words}", "{words} のどれか");
    }
    let step = match of.step {
        Some(step) => text!(" in steps of {step}", "（{step} きざみ）"),
        None => Text::default(),
    };
    match (of.min, of.max, &of.default) {
        (Some(least), Some(most), _) => text!([step]
            "a number from {least} to {most}{step}",
            "{least} から {most} までの数値{step}"
        ),
        (Some(least), None, _) => text!([step]
            "a number from {least} on{step}",
            "{least} 以上の数値{step}"
        ),
        (None, Some(most), _) => text!("a number up to {most}", "{most} 以下の数値"),
        (None, None, Some(Value::Truth(_))) => text!("`yes` or `no`", "`yes` か `no`"),
        (None, None, Some(Value::Number(_))) => text!("a number", "数値"),
        (None, None, Some(Value::Text(_))) => text!("a text", "文字列"),
        (None, None, None) => text!("any value", "任意の値"),
    }
}

/// What stands between braces is no expression.
#[cold]
pub fn bad_expression(span: Span, wanted: Noun, text: &str) -> Diagnostic {
    let there = match text {
        "" => text!("the end of the expression", "式の終わり"),
        text => quote(text).into(),
    };
    let message = text!([wanted, there]
        "the expression cannot be read: {wanted} should stand in place of {there}",
        "式が読めません。{there} のところには {wanted} が必要です"
    );
    let help = match text.chars().next() {
        Some('\'' | '"') => text!(
            "close the text with the same quote that opens it",
            "始まりと同じ引用符で文字列を閉じてください"
        ),
        Some(c @ '\u{ff01}'..='\u{ff5e}') => {
            let narrow = char::from_u32(c as u32 - 0xfee0).unwrap_or(c);
            text!(
                "replace `{c}` by `{narrow}` (half width)",
                "`{c}` を半角の `{narrow}` に直してください"
            )
        }
        _ => text!(
            "write for example `{{depth - 2}}`, `{{max(1, w / 2)}}` or `{{name = 'shop'}}`",
            "例: `{{depth - 2}}`、`{{max(1, w / 2)}}`、`{{name = 'shop'}}`"
        ),
    };
    Diagnostic::error(229, span, message).help(help)
}

/// `{}`.
#[cold]
pub fn empty_braces(span: Span) -> Diagnostic {
    let message = text!(
        "there is no expression between the braces",
        "波括弧の中に式がありません"
    );
    Diagnostic::error(250, span, message).help(text!(
        "write a name or a value between them, or remove them",
        "名前か値を書くか、波括弧を取り除いてください"
    ))
}

/// A brace without its partner.
#[cold]
pub fn brace_alone(span: Span, opens: bool) -> Diagnostic {
    let message = if opens {
        text!(
            "`{{` is not closed on its line",
            "`{{` が同じ行で閉じていません"
        )
    } else {
        text!("`}}` closes nothing", "`}}` に対応する `{{` がありません")
    };
    let mend = if opens {
        text!(
            "write `}}` where the expression ends",
            "式の終わりに `}}` を書いてください"
        )
    } else {
        text!(
            "remove it, or write `{{` where an expression begins",
            "取り除くか、式の始まりに `{{` を書いてください"
        )
    };
    Diagnostic::error(251, span, message).help(text!([mend]
        "{mend}; a brace itself is written `{{'{{'}}` or `{{'}}'}}`",
        "{mend}。波括弧そのものは `{{'{{'}}` や `{{'}}'}}` と書きます"
    ))
}

/// A name that stands for nothing.
#[cold]
pub fn unknown_name(span: Span, name: &str, near: Option<&str>, names: &[String]) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "nothing is called {name} here",
        "ここに {name} という名前はありません"
    );
    let here = match near {
        Some(near) => write(near),
        None => {
            let all = known(names);
            text!([all] "known here: {all}", "ここで使える名前: {all}")
        }
    };
    Diagnostic::error(252, span, message).help(text!([here]
        "{here}; a text stands in quotes: `'...'`",
        "{here}。文字列は引用符で囲みます: `'...'`"
    ))
}

/// A function that there is none of.
#[cold]
pub fn unknown_function(span: Span, name: &str, near: Option<&str>, all: &[&str]) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "there is no function {name}",
        "{name} という関数はありません"
    );
    Diagnostic::error(252, span, message).help(match near {
        Some(near) => write(near),
        None => {
            let all = known(all);
            text!([all] "the functions are {all}", "関数は {all} です")
        }
    })
}

/// An operand of another type.
#[cold]
pub fn wrong_type(span: Span, text: &str, wanted: Noun, value: &Value) -> Diagnostic {
    let (text, is) = (quote(text), found(value));
    let message = text!([is, wanted]
        "{text} is {is}, and {wanted} is needed here",
        "{text} は{is}ですが、ここには{wanted}が必要です"
    );
    Diagnostic::error(253, span, message).help(match value {
        Value::Text(_) => text!(
            "texts can be compared with texts and joined by `+`, no more",
            "文字列にできるのは文字列どうしの比較と `+` による連結だけです"
        ),
        Value::Truth(_) => text!(
            "a truth goes with `and`, `or`, `not`, or into `if`",
            "真偽値は `and`、`or`、`not` か `if` に使います"
        ),
        Value::Number(_) => text!(
            "a number is no text: to join them write the braces beside the text, as in `GDE {{w}}`",
            "数値は文字列ではありません。つなぐには `GDE {{w}}` のように文字の隣に波括弧を書きます"
        ),
    })
}

/// A test that is neither true nor false.
#[cold]
pub fn test_no_truth(span: Span, text: &str, value: &Value) -> Diagnostic {
    let is = found(value);
    let message = text!([is]
        "the test is {is}, neither true nor false",
        "条件が{is}で、真でも偽でもありません"
    );
    let plain = text.trim();
    Diagnostic::error(253, span, message).help(if text.contains('{') {
        text!(
            "compare it with something, as in `{{depth > 8}}`",
            "`{{depth > 8}}` のように比較してください"
        )
    } else {
        text!(
            "an expression stands in braces: `{{{plain}}}`",
            "式は波括弧で囲みます: `{{{plain}}}`"
        )
    })
}

/// `1 / 0`.
#[cold]
pub fn division_by_zero(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!(
        "a division by {text}, which is 0 here",
        "{text} で割っていますが、ここでは 0 です"
    );
    Diagnostic::error(254, span, message).help(text!(
        "divide by `max(1, ...)`, or make it depend on an `if`",
        "`max(1, ...)` で割るか、`if` で場合を分けてください"
    ))
}

/// Beyond the range of numbers.
#[cold]
pub fn number_too_large(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!(
        "the value of {text} is larger than any number",
        "{text} の値が大きすぎます"
    );
    Diagnostic::error(254, span, message).help(text!(
        "no house needs such numbers; look for a slip",
        "家にそのような数値は要りません。書き間違いを探してください"
    ))
}

/// `clamp(x, 5, 1)`.
#[cold]
pub fn clamp_bounds(span: Span) -> Diagnostic {
    let message = text!(
        "the least value of this `clamp` is above its greatest",
        "この `clamp` の下限が上限より大きくなっています"
    );
    Diagnostic::error(254, span, message).help(text!(
        "write `clamp(value, least, greatest)`",
        "`clamp(値, 下限, 上限)` の順に書いてください"
    ))
}

/// A function with too many or too few arguments.
#[cold]
pub fn wrong_arguments(span: Span, function: &str, wanted: Noun, found: usize) -> Diagnostic {
    let message = text!([wanted]
        "`{function}` takes {wanted}, not {found}",
        "`{function}` に渡すのは{wanted}で、{found} 個ではありません"
    );
    Diagnostic::error(255, span, message).help(text!(
        "arguments are divided by commas",
        "引数はコンマで区切ります"
    ))
}

/// `k` where no storey is.
#[cold]
pub fn no_storey(span: Span) -> Diagnostic {
    let message = text!(
        "`k` is the number of a storey, and here is none",
        "`k` は階の番号ですが、ここは階の中ではありません"
    );
    Diagnostic::error(256, span, message).help(text!(
        "use it in a `Storey` or a `Floor`, or in what stands in one",
        "`Storey` か `Floor`、またはその中で使ってください"
    ))
}

/// A name that cannot be one.
#[cold]
pub fn no_name(span: Span, name: &str, plain: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!("{name} cannot be a name", "{name} は名前になりません");
    Diagnostic::error(257, span, message).help(match plain {
        "" => text!(
            "a name is a letter, then letters, digits and `_`",
            "名前は文字で始め、文字、数字、`_` を続けます"
        ),
        plain => {
            let mend = write(plain);
            text!([mend] "{mend}: letters, digits and `_`", "{mend}（文字、数字、`_`）")
        }
    })
}

/// The same name twice in one element.
#[cold]
pub fn named_twice(span: Span, name: &str, before: Span) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} is given a second time in the same element",
        "同じ要素の中で {name} が二度定められています"
    );
    Diagnostic::error(258, span, message)
        .help(text!(
            "take another name; the first one counts",
            "別の名前にしてください。最初のものが有効です"
        ))
        .label(before, text!("the first is here", "最初のものはここです"))
}

/// A default that the parameter's own bounds exclude.
#[cold]
pub fn default_out_of_range(span: Span, value: &Value, of: &Parameter) -> Diagnostic {
    let (value, name) = (quote(&value.to_string()), quote(&of.name));
    let message = text!(
        "the default {value} is not what {name} may be",
        "既定値 {value} は {name} の取りうる値ではありません"
    );
    let bounds = bounds(of);
    Diagnostic::error(259, span, message)
        .help(text!([bounds] "write {bounds}", "{bounds}を書いてください"))
}

/// A value that the parameter's bounds exclude.
#[cold]
pub fn value_out_of_range(span: Span, value: &Value, of: &Parameter, place: Span) -> Diagnostic {
    let (value, name) = (quote(&value.to_string()), quote(&of.name));
    let message = text!(
        "{value} is not what the parameter {name} may be",
        "{value} は変数 {name} の取りうる値ではありません"
    );
    let bounds = bounds(of);
    let found = Diagnostic::error(259, span, message).help(text!([bounds]
        "give {name} {bounds}",
        "{name} には{bounds}を与えてください"
    ));
    if span == place {
        return found;
    }
    found.label(
        place,
        text!("the parameter is here", "変数はここで宣言されています"),
    )
}

/// A parameter that is to be drawn, but from what?
#[cold]
pub fn nothing_to_draw(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "{name} is to be drawn, but its values cannot be told",
        "{name} は抽選しますが、取りうる値がわかりません"
    );
    Diagnostic::error(275, span, message).help(text!(
        "list them by `choices`, or give `min` and `max`, and best a `step`",
        "`choices` に並べるか、`min` と `max`（できれば `step` も）を書いてください"
    ))
}

/// Something beside the `choice`s of a `random`.
#[cold]
pub fn beside_choices(span: Span) -> Diagnostic {
    let message = text!(
        "a `random` with choices holds nothing else",
        "`choice` のある `random` には、ほかのものを書けません"
    );
    Diagnostic::error(276, span, message).help(text!(
        "write it into a `choice`, or outside of the `random`",
        "`choice` の中か、`random` の外に書いてください"
    ))
}

/// An attribute of a `random` that chooses among pieces.
#[cold]
pub fn attribute_beside_choices(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "a `random` with choices has no attribute {name}",
        "`choice` のある `random` に属性 {name} は書けません"
    );
    Diagnostic::error(276, span, message).help(text!(
        "give each `choice` its `weight`, and what it stands for as its content",
        "重みはそれぞれの `choice` の `weight` に、選ばれるものはその中に書いてください"
    ))
}

/// `--param` with a name that no file has.
#[cold]
pub fn no_such_parameter(
    span: Span,
    name: &str,
    near: Option<&str>,
    all: &[Parameter],
) -> Diagnostic {
    let name = quote(name);
    let message = text!(
        "there is no parameter {name} to be set",
        "値を与えるべき変数 {name} がありません"
    );
    let listed = all.iter().take(LISTED).map(|of| {
        let (name, bounds) = (quote(&of.name), bounds(of));
        text!([bounds] "{name} ({bounds})", "{name}（{bounds}）")
    });
    let listed: Vec<Text> = listed.collect();
    let english: Vec<&str> = listed.iter().map(|t| &*t.en).collect();
    let japanese: Vec<&str> = listed.iter().map(|t| &*t.ja).collect();
    let list = match listed.len() {
        0 => text!(
            "none; write `<Param name=\"...\" default=\"...\"/>` in `House`",
            "なし。`House` の中に `<Param name=\"...\" default=\"...\"/>` と書きます"
        ),
        _ => Text::both(english.join(", "), japanese.join("、")),
    };
    let help = text!([list] "parameters here: {list}", "ここにある変数: {list}");
    Diagnostic::error(260, span, message).help(match near.map(quote) {
        Some(near) => text!([help] "set {near}; {help}", "{near} ではありませんか。{help}"),
        None => help,
    })
}

/// A parameter without a value; `place` = where it is declared, if that is elsewhere.
#[cold]
pub fn parameter_missing(span: Span, name: &str, place: Option<Span>) -> Diagnostic {
    let quoted = quote(name);
    let plain = quoted.replace('`', "");
    let message = text!(
        "the parameter {quoted} has no value",
        "変数 {quoted} に値がありません"
    );
    let found = Diagnostic::error(261, span, message);
    match place {
        Some(place) => found
            .help(text!(
                "write `{plain}=\"...\"` in the `use`, or give it a default",
                "`use` に `{plain}=\"...\"` と書くか、既定値を与えてください"
            ))
            .label(
                place,
                text!(
                    "it is declared here, without a default",
                    "既定値なしでここに宣言されています"
                ),
            ),
        None => found.help(text!(
            "write `default=\"...\"`, or set it by `--param {plain}=...`",
            "`default=\"...\"` を書くか、`--param {plain}=...` で与えてください"
        )),
    }
}

/// A text that grew beyond all measure.
#[cold]
pub fn value_too_long(span: Span) -> Diagnostic {
    let message = text!(
        "the value is longer than 4,096 characters",
        "値が 4,096 文字を超えています"
    );
    Diagnostic::error(271, span, message).help(text!(
        "no code or name is so long; look for a `let` that is put into itself again and again",
        "これほど長いコードや名前はありません。`let` が自分を繰り返し含んでいないか確かめてください"
    ))
}
