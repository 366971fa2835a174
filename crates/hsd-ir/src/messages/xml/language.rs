//! Messages about expressions and names of the XML form. Those about parameters are in [`parameters`](super::parameters),
//! those about conditions, definitions and files in [`pieces`](super::pieces).

use super::fixes::{offer, putting_in, removing};
use crate::ast::Value;
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Edit, Noun, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Names that a help text lists.
pub(super) const LISTED: usize = 12;

/// Known names for a help text.
pub fn known(words: &[impl AsRef<str>]) -> Text {
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
    text!([word] "write {word}", "{word} と書いてください")
}

fn found(value: &Value) -> Text {
    let shown = quote(&value.to_string());
    match value {
        Value::Text(_) => text!([shown] "the string {shown}", "文字列 {shown}"),
        Value::Number(_) => text!([shown] "the number {shown}", "数値 {shown}"),
        Value::Truth(_) => text!([shown] "the truth value {shown}", "真偽値 {shown}"),
    }
}

/// Braces without an expression in them; `fix` = what makes it one, if known.
#[cold]
pub fn bad_expression(
    span: Span,
    wanted: Noun,
    text: &str,
    fix: Option<(Text, Vec<Edit>)>,
) -> Diagnostic {
    let there = match text {
        "" => text!("the end of the expression", "式の終わり"),
        text => quote(text).into(),
    };
    let message = text!([wanted, there]
        "the expression cannot be read: expected {wanted}, found {there}",
        "式が読めません。{there} のところには{wanted}が必要です"
    );
    let help = match text.chars().next() {
        Some('\'' | '"') => text!(
            "close the string with the same quote that opens it",
            "始まりと同じ引用符で文字列を閉じてください"
        ),
        Some(c @ '\u{ff01}'..='\u{ff5e}') => {
            let narrow = char::from_u32(c as u32 - 0xfee0).unwrap_or(c);
            text!([c, narrow]
                "replace `{c}` by `{narrow}` (half width)",
                "`{c}` を半角の `{narrow}` に直してください"
            )
        }
        _ => text!(
            "write for example `{{depth - 2}}`, `{{max(1, w / 2)}}` or `{{name = 'shop'}}`",
            "例: `{{depth - 2}}`、`{{max(1, w / 2)}}`、`{{name = 'shop'}}`"
        ),
    };
    let found = Diagnostic::error(229, span, message).help(help);
    match fix {
        Some((title, edits)) => found.fix_all(title, edits),
        None => found,
    }
}

/// The title of a fix of an expression: it inserts a quote or a parenthesis, or replaces full-width characters.
pub fn expression_fix(put: Option<char>) -> Text {
    match put {
        Some(c) => text!([c] "Insert `{c}`", "`{c}` を入れる"),
        None => text!("Write half-width characters", "半角に直す"),
    }
}

/// `{}`, alone in a value or next to something.
#[cold]
pub fn empty_braces(span: Span, alone: bool) -> Diagnostic {
    let message = text!(
        "there is no expression between the braces",
        "波括弧の中に式がありません"
    );
    let found = Diagnostic::error(250, span, message).help(text!(
        "write a name or a value between them, or remove them",
        "名前か値を書くか、波括弧を削除してください"
    ));
    match alone {
        true => found, // nothing would be left
        false => found.fix(text!("Remove the braces", "波括弧を削除する"), span, ""),
    }
}

/// A brace without its partner, which may belong at `partner`; `plain` = it may be meant as a character.
#[cold]
pub fn brace_alone(span: Span, opens: bool, partner: Option<Span>, plain: bool) -> Diagnostic {
    let message = if opens {
        text!(
            "`{{` is not closed on its line",
            "`{{` が同じ行で閉じていません"
        )
    } else {
        text!("`}}` closes no `{{`", "`}}` に対応する `{{` がありません")
    };
    let fix = if opens {
        text!(
            "write `}}` where the expression ends",
            "式の終わりに `}}` を書いてください"
        )
    } else {
        text!(
            "remove it, or write `{{` where an expression begins",
            "削除するか、式の始まりに `{{` を書いてください"
        )
    };
    let mut found = Diagnostic::error(251, span, message).help(text!([fix]
        "{fix}; a brace itself is written `{{'{{'}}` or `{{'}}'}}`",
        "{fix}。波括弧そのものは `{{'{{'}}` や `{{'}}'}}` と書きます"
    ));
    let (brace, other, itself) = match opens {
        true => ("{", "}", "{'{'}"),
        false => ("}", "{", "{'}'}"),
    };
    if let Some(partner) = partner {
        found = found.fix(putting_in(other), partner, other);
    }
    if !opens {
        found = found.fix(removing(brace), span, "");
    }
    if plain {
        let title = text!([itself]
            "Write the brace itself: `{itself}`",
            "波括弧そのものを書く: `{itself}`"
        );
        found = found.fix(title, span, itself);
    }
    found
}

/// An undefined name; `compared` = it may be meant as a string.
#[cold]
pub fn unknown_name(
    span: Span,
    name: &str,
    near: Option<&str>,
    names: &[String],
    compared: bool,
) -> Diagnostic {
    let quoted = format!("'{name}'");
    let name = quote(name);
    let message = text!([name]
        "the name {name} is not defined here",
        "{name} という名前はここでは定義されていません"
    );
    let here = match near {
        Some(near) => write(near),
        None => {
            let all = known(names);
            text!([all] "names defined here: {all}", "ここで使える名前: {all}")
        }
    };
    let found = Diagnostic::error(252, span, message).help(text!([here]
        "{here}; strings are written in quotes: `'...'`",
        "{here}。文字列は引用符で囲みます: `'...'`"
    ));
    offer(
        found,
        span,
        near.into_iter().chain(compared.then_some(&*quoted)),
    )
}

/// An unknown function.
#[cold]
pub fn unknown_function(span: Span, name: &str, near: Option<&str>, all: &[&str]) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "there is no function {name}",
        "{name} という関数はありません"
    );
    let found = Diagnostic::error(252, span, message).help(match near {
        Some(near) => write(near),
        None => {
            let all = known(all);
            text!([all] "the functions are {all}", "関数は {all} です")
        }
    });
    offer(found, span, near)
}

/// An operand of another type.
#[cold]
pub fn wrong_type(span: Span, text: &str, wanted: Noun, value: &Value) -> Diagnostic {
    let (text, is) = (quote(text), found(value));
    let message = text!([text, is, wanted]
        "{text} is {is}, but {wanted} is needed here",
        "{text} は{is}ですが、ここには{wanted}が必要です"
    );
    Diagnostic::error(253, span, message).help(match value {
        Value::Text(_) => text!(
            "strings can only be compared with strings and joined by `+`",
            "文字列にできるのは文字列どうしの比較と `+` による連結だけです"
        ),
        Value::Truth(_) => text!(
            "a truth value can be used with `and`, `or`, `not`, and in `if`",
            "真偽値は `and`、`or`、`not` か `if` に使います"
        ),
        Value::Number(_) => text!(
            "a number is not a string: to join them, write the braces next to the text, as in `GDE {{w}}`",
            "数値は文字列ではありません。つなぐには `GDE {{w}}` のように文字の隣に波括弧を書きます"
        ),
    })
}

/// A condition that is neither true nor false; `sound` = it is an expression if put in braces.
#[cold]
pub fn test_no_truth(span: Span, text: &str, value: &Value, sound: bool) -> Diagnostic {
    let is = found(value);
    let message = text!([is]
        "the condition is {is}, neither true nor false",
        "条件が{is}で、真でも偽でもありません"
    );
    let plain = text.trim();
    let found = Diagnostic::error(253, span, message).help(if text.contains('{') {
        text!(
            "compare it with something, as in `{{depth > 8}}`",
            "`{{depth > 8}}` のように比較してください"
        )
    } else {
        text!([plain]
            "expressions are written in braces: `{{{plain}}}`",
            "式は波括弧で囲みます: `{{{plain}}}`"
        )
    });
    let start = Span {
        end: span.start,
        ..span
    };
    match sound {
        true => found.fix_all(
            text!("Put it in braces", "波括弧で囲む"),
            vec![Edit::new(start, "{"), Edit::new(span.after(), "}")],
        ),
        false => found,
    }
}

/// `sqrt(-1)`, `tan(90)`.
#[cold]
pub fn without_value(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!([text] "{text} has no value", "{text} には値がありません");
    Diagnostic::error(254, span, message).help(text!(
        "`sqrt` takes no negative number, and `tan` no right angle",
        "`sqrt` に負の数は使えません。`tan` に直角は使えません"
    ))
}

/// `1 / 0`.
#[cold]
pub fn division_by_zero(span: Span, text: &str) -> Diagnostic {
    let start = Span {
        end: span.start,
        ..span
    };
    let text = quote(text);
    let message = text!([text]
        "division by {text}, which is 0 here",
        "{text} で割っていますが、ここでは 0 です"
    );
    Diagnostic::error(254, span, message)
        .help(text!(
            "divide by `max(1, ...)`, or use an `if`",
            "`max(1, ...)` で割るか、`if` で場合を分けてください"
        ))
        .fix_all(
            text!("Divide by at least 1", "1 以上で割る"),
            vec![Edit::new(start, "max(1,"), Edit::new(span.after(), ")")],
        )
}

/// Beyond the range of numbers.
#[cold]
pub fn number_too_large(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!([text]
        "the value of {text} is too large",
        "{text} の値が大きすぎます"
    );
    Diagnostic::error(254, span, message).help(text!(
        "no house needs such numbers; look for a typing mistake",
        "家にそのような数値は要りません。書き間違いを探してください"
    ))
}

/// `clamp(x, 5, 1)`.
#[cold]
pub fn clamp_bounds(span: Span, swapped: Option<Vec<Edit>>) -> Diagnostic {
    let message = text!(
        "the lower bound of this `clamp` is above its upper bound",
        "この `clamp` の下限が上限より大きくなっています"
    );
    let found = Diagnostic::error(254, span, message).help(text!(
        "write `clamp(value, lower, upper)`",
        "`clamp(値, 下限, 上限)` の順に書いてください"
    ));
    let title = text!("Swap the two", "二つを入れ替える");
    match swapped {
        Some(edits) => found.fix_all(title, edits),
        None => found,
    }
}

/// A function with too many or too few arguments.
#[cold]
pub fn wrong_arguments(span: Span, function: &str, wanted: Noun, found: usize) -> Diagnostic {
    let message = text!([function, wanted, found]
        "`{function}` takes {wanted}, not {found}",
        "`{function}` に渡すのは{wanted}で、{found} 個ではありません"
    );
    Diagnostic::error(255, span, message).help(text!(
        "arguments are separated by commas",
        "引数はコンマで区切ります"
    ))
}

/// `k` outside a storey.
#[cold]
pub fn no_storey(span: Span) -> Diagnostic {
    let message = text!(
        "`k` is the number of the storey, but this is not in a storey",
        "`k` は階の番号ですが、ここは階の中ではありません"
    );
    Diagnostic::error(256, span, message).help(text!(
        "use it in a `Storey` or a `Floor`",
        "`Storey` か `Floor` の中で使ってください"
    ))
}

/// An invalid name.
#[cold]
pub fn no_name(span: Span, name: &str, plain: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name] "{name} cannot be a name", "{name} は名前になりません");
    let offered = Some(plain).filter(|plain| !plain.is_empty());
    let found = Diagnostic::error(257, span, message).help(match plain {
        "" => text!(
            "a name is a letter, then letters, digits and `_`",
            "名前は文字で始め、文字、数字、`_` を続けます"
        ),
        plain => {
            let fix = write(plain);
            text!([fix] "{fix}: letters, digits and `_`", "{fix}（文字、数字、`_`）")
        }
    });
    offer(found, span, offered)
}

/// The same name twice in one element; `free` = a name that is not taken.
#[cold]
pub fn named_twice(span: Span, name: &str, before: Span, free: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} is defined twice in the same element",
        "同じ要素の中で {name} が二度定義されています"
    );
    let found = Diagnostic::error(258, span, message)
        .help(text!(
            "use another name; the first definition is used",
            "別の名前にしてください。最初の定義を使います"
        ))
        .label(before, text!("the first is here", "最初のものはここです"));
    offer(found, span, [free])
}

/// Something next to the `choice`s of a `random`; `fix` makes it one of them.
#[cold]
pub fn beside_choices(span: Span, fix: Vec<Edit>) -> Diagnostic {
    let message = text!(
        "a `random` with `choice`s cannot contain anything else",
        "`choice` のある `random` には、ほかのものを書けません"
    );
    Diagnostic::error(276, span, message)
        .help(text!(
            "move it into a `choice`, or out of the `random`",
            "`choice` の中か、`random` の外に書いてください"
        ))
        .fix_all(
            text!("Move it into a `choice`", "`choice` の中に入れる"),
            fix,
        )
}

/// An attribute of a `random` with `choice`s; `whole` = with its value and the blanks before it.
#[cold]
pub fn attribute_beside_choices(span: Span, name: &str, whole: Span) -> Diagnostic {
    let title = removing(name);
    let name = quote(name);
    let message = text!([name]
        "a `random` with `choice`s has no attribute {name}",
        "`choice` のある `random` に属性 {name} は書けません"
    );
    Diagnostic::error(276, span, message)
        .help(text!(
            "give each `choice` a `weight`, and write what it chooses as its content",
            "重みはそれぞれの `choice` の `weight` に、選ばれるものはその中に書いてください"
        ))
        .fix(title, whole, "")
}

/// A string that is too long.
#[cold]
pub fn value_too_long(span: Span) -> Diagnostic {
    let message = text!(
        "the value is longer than 4,096 characters",
        "値が 4,096 文字を超えています"
    );
    Diagnostic::error(271, span, message).help(text!(
        "no code or name is that long; look for a `let` that contains itself again and again",
        "これほど長いコードや名前はありません。`let` が自分を繰り返し含んでいないか確かめてください"
    ))
}
