//! Messages about parameters of the XML form and their values.

use super::fixes::{escaped, offer, writing};
use super::language::LISTED;
use crate::ast::{Parameter, Value};
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Values that are offered one by one.
const FEW: usize = 8;

/// The values that a parameter may have: "a number from 4 to 14 in steps of 1", "one of lattice, shop".
pub fn bounds(of: &Parameter) -> Text {
    if !of.choices.is_empty() {
        let words: Vec<String> = of.choices.iter().map(Value::to_string).collect();
        let words = words.join(", ");
        return text!([words] "one of {words}", "{words} のどれか");
    }
    let step = match of.step {
        Some(step) => text!([step] " in steps of {step}", "（{step} きざみ）"),
        None => Text::default(),
    };
    match (of.min, of.max, &of.default) {
        (Some(least), Some(most), _) => text!([least, most, step]
            "a number from {least} to {most}{step}",
            "{least} から {most} までの数値{step}"
        ),
        (Some(least), None, _) => text!([least, step]
            "a number from {least} on{step}",
            "{least} 以上の数値{step}"
        ),
        (None, Some(most), _) => text!([most] "a number up to {most}", "{most} 以下の数値"),
        (None, None, Some(Value::Truth(_))) => text!("`yes` or `no`", "`yes` か `no`"),
        (None, None, Some(Value::Number(_))) => text!("a number", "数値"),
        (None, None, Some(Value::Text(_))) => text!("a string", "文字列"),
        (None, None, None) => text!("any value", "任意の値"),
    }
}

/// A default that the parameter's own bounds exclude.
#[cold]
pub fn default_out_of_range(span: Span, value: &Value, of: &Parameter) -> Diagnostic {
    let given = value;
    let (value, name) = (quote(&value.to_string()), quote(&of.name));
    let message = text!([value, name]
        "the default {value} is not a value that {name} may have",
        "既定値 {value} は {name} の取りうる値ではありません"
    );
    let bounds = bounds(of);
    let found = Diagnostic::error(259, span, message)
        .help(text!([bounds] "write {bounds}", "{bounds}を書いてください"));
    let words = admitted(of, Some(given));
    offer(found, span, words.iter().map(String::as_str))
}

/// A value that the parameter's bounds exclude.
#[cold]
pub fn value_out_of_range(span: Span, value: &Value, of: &Parameter, place: Span) -> Diagnostic {
    let words = admitted(of, Some(value));
    let (value, name) = (quote(&value.to_string()), quote(&of.name));
    let message = text!([value, name]
        "{value} is not a value that the parameter {name} may have",
        "{value} はパラメーター {name} の取りうる値ではありません"
    );
    let bounds = bounds(of);
    let found = Diagnostic::error(259, span, message).help(text!([name, bounds]
        "give {name} {bounds}",
        "{name} には{bounds}を与えてください"
    ));
    if span == place {
        return found; // it comes from the command line
    }
    let found = offer(found, span, words.iter().map(String::as_str));
    found.label(
        place,
        text!(
            "the parameter is here",
            "パラメーターはここで宣言されています"
        ),
    )
}

/// A random parameter without values to choose from.
#[cold]
pub fn nothing_to_draw(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} is random, but its possible values are unknown",
        "{name} は抽選しますが、取りうる値がわかりません"
    );
    Diagnostic::error(275, span, message).help(text!(
        "list them in `choices`, or give `min` and `max`, preferably with a `step`",
        "`choices` に並べるか、`min` と `max`（できれば `step` も）を書いてください"
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
    let message = text!([name]
        "there is no parameter {name} to set",
        "{name} というパラメーターはありません"
    );
    let listed = all.iter().take(LISTED).map(|of| {
        let (name, bounds) = (quote(&of.name), bounds(of));
        text!([name, bounds] "{name} ({bounds})", "{name}（{bounds}）")
    });
    let listed: Vec<Text> = listed.collect();
    let list = match listed.len() {
        0 => text!(
            "none; write `<Param name=\"...\" default=\"...\"/>` in `House`",
            "なし。`House` の中に `<Param name=\"...\" default=\"...\"/>` と書きます"
        ),
        _ => Text::joined(listed, ", ", "、"),
    };
    let help = text!([list] "parameters here: {list}", "ここにあるパラメーター: {list}");
    Diagnostic::error(260, span, message).help(match near.map(quote) {
        Some(near) => {
            text!([near, help] "did you mean {near}? {help}", "{near} ではありませんか。{help}")
        }
        None => help,
    })
}

/// A parameter without a value; `place` = where it is declared, if that is elsewhere; `of` = its bounds, if they are
/// known, and the name of the element that can give the value.
#[cold]
pub fn parameter_missing(
    span: Span,
    name: &str,
    place: Option<Span>,
    of: Option<(&Parameter, Span)>,
) -> Diagnostic {
    let quoted = quote(name);
    let plain = quoted.replace('`', "");
    let message = text!([quoted]
        "the parameter {quoted} has no value",
        "パラメーター {quoted} に値がありません"
    );
    let mut found = Diagnostic::error(261, span, message);
    if let Some((of, at)) = of {
        let attribute = if place.is_some() { name } else { "default" };
        for word in admitted(of, None) {
            let fix = format!("{attribute}=\"{}\"", escaped(&word));
            found = found.fix(writing(&fix), at.after(), format!(" {fix}"));
        }
    }
    match place {
        Some(place) => found
            .help(text!([plain]
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
        None => found.help(text!([plain]
            "write `default=\"...\"`, or set it with `--param {plain}=...`",
            "`default=\"...\"` を書くか、`--param {plain}=...` で与えてください"
        )),
    }
}

/// Values that a parameter may have, nearest to this one first; not many.
fn admitted(of: &Parameter, value: Option<&Value>) -> Vec<String> {
    if !of.choices.is_empty() {
        let few = of.choices.iter().take(FEW);
        return few.map(Value::to_string).collect();
    }
    let near = match (value, &of.default) {
        (Some(Value::Number(number)), _) => *number,
        (_, Some(Value::Truth(_))) => return vec!["yes".into(), "no".into()],
        _ => 0.0,
    };
    if of.min.is_none() && of.max.is_none() && of.step.is_none() {
        return vec![];
    }
    let least = of.min.unwrap_or(f64::MIN);
    let most = of.max.unwrap_or(f64::MAX);
    if least > most {
        return vec![];
    }
    let clamped = near.clamp(least, most);
    let start = of.min.unwrap_or(0.0);
    let stepped = of.step.map_or(clamped, |step| {
        let steps = ((clamped - start) / step + 1e-9).floor();
        // Tenths leave a tail of digits.
        ((start + steps * step) * 1e9).round() / 1e9
    });
    let number = Value::Number(stepped);
    of.admits(&number)
        .then(|| number.to_string())
        .into_iter()
        .collect()
}
