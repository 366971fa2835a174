//! Messages about the values of attributes.

use super::fixes::{offer, removing, writing};
use hsd_base::diagnostic::messages::words::{any_of, quote};
use hsd_base::diagnostic::{Diagnostic, Noun, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Words that are offered one by one; a longer list is no help.
const FEW: usize = 8;

/// A value that is not a number.
#[cold]
pub fn not_a_number(span: Span, name: &str, text: &str, fix: Option<&str>) -> Diagnostic {
    let digits = text!(
        "write digits with a decimal point, such as `9.5`, without a unit",
        "`9.5` のように、半角の数字と小数点だけで単位を付けずに書いてください"
    );
    no_number(span, name, text, fix, digits)
}

/// The height of a storey that is surely in metres.
#[cold]
pub fn height_in_metres(span: Span, height: f64) -> Diagnostic {
    let metres = (height * 1000.0 / 33.0).round() / 100.0;
    let meant = format!("{height} m");
    let message = text!([height, metres]
        "a storey of {height} shaku is {metres} m high",
        "階高 {height} 尺は {metres} m になります"
    );
    Diagnostic::warning(137, span, message)
        .help(text!([meant]
            "a number without a unit is in shaku: write `{meant}` if you mean metres",
            "単位のない数は尺です。メートルのつもりなら `{meant}` と書いてください"
        ))
        .fix(writing(&meant), span, meant.clone())
}

/// A value that is not a length.
#[cold]
pub fn not_a_length(span: Span, name: &str, text: &str, fix: Option<&str>) -> Diagnostic {
    let digits = text!(
        "write a number such as `9.5`; a unit may follow it: `m`, `cm`, `mm`, `shaku`, `sun`, `ken`",
        "`9.5` のような数を書いてください。後ろに単位 `m`、`cm`、`mm`、`尺`、`寸`、`間` を付けられます"
    );
    no_number(span, name, text, fix, digits)
}

/// A list of lengths, of which only some have a unit.
#[cold]
pub fn length_without_unit(span: Span, number: &str, unit: &str) -> Diagnostic {
    let whole = format!("{number} {unit}");
    let message = text!([number, unit]
        "{number} has no unit, another length of the list is in {unit}",
        "{number} に単位がありません。同じ並びの別の長さには {unit} が付いています"
    );
    Diagnostic::warning(152, span, message)
        .help(text!([whole]
            "a length without a unit is in that of the attribute; write `{whole}` if you mean it",
            "単位のない長さはその属性の単位で読みます。同じ単位のつもりなら `{whole}` と書いてください"
        ))
        .fix(writing(&whole), span, whole.clone())
}

fn no_number(span: Span, name: &str, text: &str, fix: Option<&str>, digits: Text) -> Diagnostic {
    let offered = fix;
    let (name, text) = (quote(name), quote(text));
    let message = text!([text, name]
        "{text} is not a number for {name}",
        "{text} は {name} の数値として読めません"
    );
    let found = Diagnostic::error(225, span, message).help(match fix.map(quote) {
        Some(fix) => text!([fix] "write {fix}", "{fix} と書いてください"),
        None => digits,
    });
    offer(found, span, offered)
}

/// A word such as `yes` where a number says how much; `no` is 0.
#[cold]
pub fn yes_for_a_number(
    span: Span,
    name: &str,
    text: &str,
    about: Noun,
    zero: Option<&str>,
) -> Diagnostic {
    let (named, quoted) = (quote(name), quote(text));
    let message = text!([quoted, named]
        "{quoted} is not a number for {named}",
        "{quoted} は {named} の数値として読めません"
    );
    let found = Diagnostic::error(225, span, message).help(match zero.map(quote) {
        Some(zero) => {
            text!([zero, about] "write {zero} ({about})", "{zero} と書いてください ({about})")
        }
        None => text!([about]
            "write a number that says how much: {about}",
            "どれほどかを数値で書いてください: {about}"
        ),
    });
    offer(found, span, zero)
}

/// A number out of range; `near` = the nearest in range.
#[cold]
pub fn out_of_range(
    span: Span,
    name: &str,
    text: &str,
    bounds: impl Into<Text>,
    near: Option<&str>,
) -> Diagnostic {
    let (name, text, bounds) = (quote(name), quote(text), bounds.into());
    let message = text!([text, name]
        "{text} is out of range for {name}",
        "{text} は {name} の範囲を外れています"
    );
    let found = Diagnostic::error(226, span, message)
        .help(text!([bounds] "write {bounds}", "{bounds}を書いてください"));
    offer(found, span, near)
}

/// A word that is not one of the choices.
#[cold]
pub fn not_a_choice(
    span: Span,
    name: &str,
    text: &str,
    all: &[&str],
    near: Option<(&str, Option<Noun>)>,
) -> Diagnostic {
    let (near, meaning) = near.unzip();
    let few = if all.len() <= FEW { all } else { &[] };
    let offered: Vec<&str> = near.map_or(few.to_vec(), |near| vec![near]);
    let (name, text, all) = (quote(name), quote(text), any_of(all));
    let message = text!([text, name]
        "{text} is not a value of {name}",
        "{text} は {name} の値になりません"
    );
    let found = Diagnostic::error(227, span, message).help(match (near, meaning.flatten()) {
        (Some(near), Some(meaning)) => text!([near, meaning]
            "write `{near}`: {meaning}",
            "`{near}` ({meaning}) と書いてください"
        ),
        (Some(near), None) => text!([near] "write `{near}`", "`{near}` と書いてください"),
        (None, _) => text!([all] "write {all}", "{all} と書いてください"),
    });
    offer(found, span, offered)
}

/// A share above 1.
#[cold]
pub fn per_cent(span: Span, given: f64, share: f64) -> Diagnostic {
    let message = text!([given]
        "the reflection {given} is read as {given} percent",
        "映り込み {given} を {given} パーセントとして読みました"
    );
    let found = Diagnostic::warning(234, span, message).help(text!([share]
        "write a share of 0 to 1: `{share}`",
        "0 から 1 までの割合で `{share}` と書いてください"
    ));
    offer(found, span, [share.to_string().as_str()])
}

/// A bad piece of `at`; `read` = what it is taken for.
#[cold]
pub fn not_a_position(span: Span, text: &str, read: Option<(u32, u32)>) -> Diagnostic {
    let text = quote(text);
    let message = text!([text] "{text} is not a position", "{text} は位置になりません");
    let fix = read.map(|(first, last)| match first < last {
        true => format!("{first}-{last}"),
        false => first.to_string(),
    });
    let found = Diagnostic::error(235, span, message).help(match read {
        Some((first, last)) if first < last => {
            text!([first, last]
                "write `{first}-{last}`",
                "`{first}-{last}` と書いてください"
            )
        }
        Some((first, _)) => text!([first] "write `{first}`", "`{first}` と書いてください"),
        None => text!(
            "positions count from 1; write for example `2,5-7`",
            "位置は 1 から数えます。`2,5-7` のように書いてください"
        ),
    });
    offer(found, span, fix.as_deref())
}

/// An empty value; `whole` = the attribute with the blanks before it, if it may be left out.
#[cold]
pub fn value_empty(span: Span, name: &str, whole: Option<Span>) -> Diagnostic {
    let title = removing(name);
    let name = quote(name);
    let message = text!([name] "the value of {name} is empty", "{name} の値が空です");
    let found = Diagnostic::error(237, span, message).help(text!(
        "write a value, or remove the attribute",
        "値を書くか、属性を削除してください"
    ));
    match whole {
        Some(whole) => found.fix(title, whole, ""),
        None => found,
    }
}

/// A point that is not two numbers.
#[cold]
pub fn not_a_point(span: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, count]
        "{name} takes two numbers, not {count}",
        "{name} の数値は二つですが、{count}個あります"
    );
    Diagnostic::error(238, span, message).help(text!(
        "write the distances to the left and to the back in U, such as `4 8`",
        "`4 8` のように、左へと奥への距離を U で書いてください"
    ))
}

/// Neither one number nor two.
#[cold]
pub fn not_a_pair(span: Span, name: &str, given: &[f64]) -> Diagnostic {
    let count = given.len();
    let name = quote(name);
    let message = text!([name, count]
        "{name} takes one number or two, not {count}",
        "{name} の数値は一つか二つですが、{count}個あります"
    );
    let found = Diagnostic::error(244, span, message).help(text!(
        "write two numbers, along the front and in depth, such as `5 2`; a single one is used for both",
        "`5 2` のように、間口と奥行の二つを書いてください。一つなら両方を表します"
    ));
    match given {
        [across, deep, ..] => offer(found, span, [format!("{across} {deep}").as_str()]),
        _ => found,
    }
}

/// Weights that are all zero; `count` = how many are written in the value at that place.
#[cold]
pub fn no_weight(span: Span, count: Option<usize>) -> Diagnostic {
    let message = text!(
        "all weights are 0, so nothing can be chosen",
        "重みがすべて 0 なので抽選できません"
    );
    let found = Diagnostic::error(239, span, message).help(text!(
        "give at least one code a weight above 0",
        "少なくともひとつの部材コードに 0 より大きい重みを付けてください"
    ));
    let title = text!("Give all codes the same weight", "すべて同じ重みにする");
    match count {
        Some(count) => found.fix(title, span, vec!["1"; count.min(4096)].join(" ")),
        None => found,
    }
}

/// A coordinate without the other.
#[cold]
pub fn odd_corner(last: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, count]
        "{name} has {count} numbers, so the last corner lacks one of its two",
        "{name} の数値は{count}個なので、最後の隅の数値がひとつ足りません"
    );
    Diagnostic::error(280, last, message).help(text!(
        "write two numbers a corner: metres east, then metres north, such as `0 0, 9.5 0, 9.5 6, 0 6`",
        "隅ひとつにつき、東へのメートル、北へのメートルの二つを `0 0, 9.5 0, 9.5 6, 0 6` のように書いてください"
    ))
}

/// More corners than an outline may have.
#[cold]
pub fn too_many_corners(points: Span, count: usize, most: u64) -> Diagnostic {
    let message = text!([count, most]
        "the outline has {count} corners; {most} are the most",
        "輪郭の隅が{count}個あります。{most}個までです"
    );
    Diagnostic::error(281, points, message).help(text!(
        "simplify the outline, or divide it into several houses",
        "輪郭を簡単にするか、いくつかの建物に分けてください"
    ))
}
