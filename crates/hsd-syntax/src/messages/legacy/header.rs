//! Messages about the header, the sections and the heights of the legacy form.

use hsd_base::diagnostic::messages::words::{any_of, quote};
use hsd_base::diagnostic::{Diagnostic, Edit, Noun, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Codes or roofs in place of the header.
#[cold]
pub fn no_header(span: Span, line_end: &str) -> Diagnostic {
    let message = text!(
        "the header is missing: the line `x y [azimuth]` with the place of the house",
        "ヘッダーがありません。家の位置を示す行 `x y [方位角]` が必要です"
    );
    let header = ["0 0 180", "9.0", "", ""].join(line_end);
    let title = text!(
        "Insert a header before the walls: `0 0 180` and `9.0`",
        "壁の前にヘッダー (`0 0 180` と `9.0`) を入れる"
    );
    Diagnostic::error(101, span, message).help(text!(
        "write `0 0 180`, a line of storey heights such as `9.0`, and a blank line before the walls",
        "壁の前に、`0 0 180`、階高の行 (`9.0` など)、空行の順に書いてください"
    ))
    .fix(title, span, header)
}

/// A required number is missing.
#[cold]
pub fn missing_number(span: Span, what: impl Into<Text>) -> Diagnostic {
    let what = what.into();
    let message = text!([what]
        "the number of {what} is missing",
        "{what} の数値がありません"
    );
    Diagnostic::error(102, span, message).help(text!(
        "write both local coordinates in metres, and the azimuth if the house does not face south: `0 0 180`",
        "平面座標をメートルで二つ書いてください。南向きでなければ方位角も書きます: `0 0 180`"
    ))
}

/// A word that should be a number, and perhaps the one that is meant.
#[cold]
pub fn not_a_number(
    span: Span,
    text: &str,
    what: impl Into<Text>,
    fix: Option<(Span, &str)>,
) -> Diagnostic {
    let (quoted, what) = (quote(text), what.into());
    let message = text!([quoted, what]
        "{quoted} is not a number for {what}",
        "{quoted} は{what}の数値として読めません"
    );
    let found = Diagnostic::error(103, span, message).help(text!(
        "write digits with a decimal point, without a unit, and separate numbers by blanks: `9.0 5.5`",
        "数字と小数点だけで単位を付けずに書き、数値どうしは空白で区切ってください: `9.0 5.5`"
    ));
    match fix {
        Some((place, meant)) => found.fix(written(meant), place, meant),
        None => found,
    }
}

/// A number by a name of its own, such as `south` for 180.
#[cold]
pub fn named_number(
    span: Span,
    text: &str,
    what: impl Into<Text>,
    meant: &str,
    noun: Noun,
    place: Option<Span>,
) -> Diagnostic {
    not_a_number(span, text, what, place.map(|place| (place, meant))).help(text!([meant, noun]
        "write `{meant}` for {noun}",
        "{noun}なら `{meant}` と書いてください"
    ))
}

/// A number out of range.
#[cold]
pub fn out_of_range(
    span: Span,
    text: &str,
    what: impl Into<Text>,
    least: f64,
    most: f64,
    unit: Noun,
) -> Diagnostic {
    let (quoted, what) = (quote(text), what.into());
    let message = text!([quoted, what]
        "{quoted} is out of range for {what}",
        "{quoted} は{what}の範囲を外れています"
    );
    Diagnostic::error(104, span, message).help(text!([least, most, unit]
        "write a number from {least} to {most} {unit}",
        "{least} から {most} まで ({unit}) の数値を書いてください"
    ))
}

/// A header line that does not begin with a known key; `glued` is the rest of its first word from `=` or `:` on.
#[cold]
pub fn unknown_key(
    span: Span,
    text: &str,
    near: Option<&str>,
    glued: &str,
    keys: &[&str],
) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a header key",
        "{quoted} というヘッダーの項目はありません"
    );
    let all = any_of(keys);
    let help = match near {
        Some(key) => text!([key]
            "write `{key}`, a blank, and its value",
            "`{key}`、空白、値の順に書いてください"
        ),
        None => text!([all]
            "write one of {all}; a comment begins with `#` in the first column",
            "{all} のどれかを書いてください。コメントは一桁目の `#` で始めます"
        ),
    };
    let found = Diagnostic::error(105, span, message).help(help);
    let Some(key) = near else { return found };
    let value = glued.trim_start_matches(['=', ':']);
    let meant = match value {
        "" => key.to_owned(),
        value => format!("{key} {value}"),
    };
    found.fix(written(&meant), span, meant)
}

/// Words of a choice that are offered one by one.
const FEW: usize = 4;

/// The title of a fix that replaces a word.
fn written(word: &str) -> Text {
    let quoted = quote(word);
    text!([quoted] "Write {quoted}", "{quoted} と書く")
}

/// A word that is none of those a key takes; `place` is where it stands alone.
#[cold]
pub fn bad_choice(
    span: Span,
    place: Option<Span>,
    key: &str,
    text: &str,
    near: Option<&str>,
    choices: &[&str],
) -> Diagnostic {
    let (quoted, all) = (quote(text), any_of(choices));
    let message = text!([key, quoted]
        "`{key}` cannot be {quoted}",
        "`{key}` に {quoted} は書けません"
    );
    let help = match near {
        Some(word) => text!([key, word] "write `{key} {word}`", "`{key} {word}` と書いてください"),
        None => {
            text!([all, key] "write {all} after `{key}`", "`{key}` の後に {all} と書いてください")
        }
    };
    let mut found = Diagnostic::error(106, span, message).help(help);
    let meant = match &near {
        Some(word) => std::slice::from_ref(word),
        None if choices.len() <= FEW => choices,
        None => &[],
    };
    for word in meant {
        if let Some(place) = place {
            found = found.fix(written(word), place, *word);
        }
    }
    found
}

/// More words than a line takes; `all` has the blanks before them.
#[cold]
pub fn surplus(span: Span, all: Span, what: impl Into<Text>) -> Diagnostic {
    let what = what.into();
    let message = text!([what]
        "there is something left after {what}",
        "{what} の後に余分なものがあります"
    );
    Diagnostic::error(107, span, message)
        .help(text!(
            "delete it; a comment goes on a separate line that begins with `#`",
            "削除してください。コメントは `#` で始まる独立した行に書きます"
        ))
        .fix(text!("Delete it", "削除する"), all, "")
}

/// A key or option that was given before; `places` are what to delete with the first and with this one.
#[cold]
pub fn twice(span: Span, key: &str, before: Span, places: [Option<Span>; 2]) -> Diagnostic {
    let message = text!([key]
        "`{key}` is given twice; this one is used",
        "`{key}` が二度書かれています。後の方を使います"
    );
    let mut found = Diagnostic::warning(108, span, message)
        .help(text!(
            "delete one of the two",
            "どちらか一方を削除してください"
        ))
        .label(before, text!("the first one", "一つ目"));
    let titles = [
        text!("Delete the first one", "一つ目を削除する"),
        text!("Delete this one", "こちらを削除する"),
    ];
    for (title, place) in titles.into_iter().zip(places) {
        if let Some(place) = place {
            found = found.fix(title, place, "");
        }
    }
    found
}

/// A line of the header after the walls have begun.
#[cold]
pub fn late_key(span: Span, key: &str, fix: Vec<Edit>) -> Diagnostic {
    let message = text!([key]
        "`{key}` belongs in the header",
        "`{key}` はヘッダーに書くものです"
    );
    let found = Diagnostic::error(109, span, message).help(text!(
        "move the line up, before the blank line that begins the walls",
        "この行を、壁の前の空行より上へ移してください"
    ));
    match fix.is_empty() {
        true => found,
        false => found.fix_all(
            text!("Move the line into the header", "ヘッダーへ移す"),
            fix,
        ),
    }
}

/// Two sections without the blank line between them.
#[cold]
pub fn no_blank_line(span: Span, before: Noun, after: Noun, line_end: &str) -> Diagnostic {
    let message = text!([before, after]
        "there is no blank line between the {before} and the {after}",
        "{before}と{after}のあいだに空行がありません"
    );
    Diagnostic::warning(110, span, message)
        .help(text!(
            "insert a blank line before this one",
            "この行の前に空行を入れてください"
        ))
        .fix(text!("Insert a blank line", "空行を入れる"), span, line_end)
}

/// A line of numbers after the heights.
#[cold]
pub fn third_numbers(span: Span, heights: Span, line: Span, more: String) -> Diagnostic {
    let message = text!(
        "the header has only two lines of numbers: the place, and the storey heights",
        "ヘッダーの数値の行は、位置と階高の二行だけです"
    );
    Diagnostic::error(111, span, message)
        .help(text!(
            "write all storey heights on one line, from the ground up",
            "階高は一階から順に、すべて一行に書いてください"
        ))
        .label(
            heights,
            text!("the storey heights are here", "階高はここにあります"),
        )
        .fix_all(
            text!("Write all heights on one line", "階高を一行にまとめる"),
            vec![Edit::new(heights.after(), more), Edit::new(line, "")],
        )
}

/// More heights than storeys.
#[cold]
pub fn surplus_heights(span: Span, all: Span, heights: usize, storeys: usize) -> Diagnostic {
    let message = text!([heights, storeys]
        "there are {heights} storey heights, but walls for only {storeys}",
        "階高は{heights}階分ありますが、壁は{storeys}階分しかありません"
    );
    Diagnostic::warning(112, span, message)
        .help(text!(
            "delete the surplus heights, or close each storey with `^` after its last wall",
            "余分な階高を削除するか、階ごとに最後の壁の後に `^` を書いて区切ってください"
        ))
        .fix(
            text!("Delete the surplus heights", "余分な階高を削除する"),
            all,
            "",
        )
}

/// Text next to `%`.
#[cold]
pub fn after_separator(span: Span, note: &str, line_end: &str) -> Diagnostic {
    let message = text!(
        "a `%` between two houses must be alone on its line",
        "家と家を区切る `%` の行には、ほかに何も書けません"
    );
    let note = format!("{line_end}# {}", note.trim_start_matches('#').trim_start());
    let title = text!(
        "Make it a comment on the next line",
        "次の行のコメントにする"
    );
    Diagnostic::error(114, span, message).help(text!(
        "delete the rest of the line; write a comment on a separate line, and the name of a house as `name ...` in its header",
        "行の残りを削除してください。コメントは独立した行に、家の名前はヘッダーに `name ...` と書きます"
    ))
    .fix(title, span, note)
    .fix(text!("Delete it", "削除する"), span, "")
}

/// A second header without `%`.
#[cold]
pub fn no_separator(span: Span, line_end: &str) -> Diagnostic {
    let message = text!(
        "a header begins here, but the house before it is not closed",
        "ここから次のヘッダーが始まりますが、前の家が終わっていません"
    );
    let before = Span {
        end: span.start,
        ..span
    };
    let title = text!("Write `%` before this house", "この家の前に `%` を書く");
    Diagnostic::error(115, span, message)
        .help(text!(
            "write `%` alone on a line between two houses",
            "家と家のあいだに `%` だけの行を書いてください"
        ))
        .fix(title, before, format!("%{line_end}"))
}

/// A header without walls.
#[cold]
pub fn no_walls(span: Span) -> Diagnostic {
    let message = text!("this house has no walls", "この家には壁がありません");
    Diagnostic::error(116, span, message).help(text!(
        "after the header and a blank line, write one line of part codes for each wall, clockwise from the front as seen from above",
        "ヘッダーと空行の後に、壁ごとに部材コードを一行ずつ、正面から時計回りに書いてください"
    ))
}

/// A header key without a value.
#[cold]
pub fn missing_value(span: Span, line: Span, key: &str) -> Diagnostic {
    let example = match key {
        "unit" => "3.0",
        "seed" => "7",
        "age" => "80",
        "era" => "E",
        "roofs" => "auto",
        "method" => "least-cut",
        "street" => "yes",
        _ => "corner house",
    };
    let message = text!([key] "`{key}` has no value", "`{key}` の値がありません");
    Diagnostic::error(117, span, message)
        .help(text!([key, example]
            "write for example `{key} {example}`, or delete the line",
            "`{key} {example}` のように書くか、行を削除してください"
        ))
        .fix(text!("Delete the line", "行を削除する"), line, "")
}

/// A seed that is negative, broken or too large.
#[cold]
pub fn bad_seed(span: Span, text: &str) -> Diagnostic {
    let (quoted, most) = (quote(text), u64::MAX);
    let message = text!([quoted] "{quoted} cannot be a seed", "{quoted} はシードにできません");
    Diagnostic::error(118, span, message).help(text!([most]
        "write a whole number from 0 to {most}",
        "0 から {most} までの整数を書いてください"
    ))
}

/// One line of numbers, which is read as the place; the heights are missing, or are this line.
#[cold]
pub fn no_heights(place: Span, line_end: &str) -> Diagnostic {
    let message = text!(
        "only one line of numbers: it is read as the place, and every storey is 9 shaku high",
        "数値の行がひとつしかないため、位置として読み、階高はすべて 9 尺とします"
    );
    let before = Span {
        end: place.start,
        ..place
    };
    let are_heights = text!(
        "These are the heights: insert `0 0 180` before them",
        "これは階高なので、前に `0 0 180` を書く"
    );
    let are_place = text!(
        "This is the place: write the height `9.0` on the next line",
        "これは位置なので、次の行に階高 `9.0` を書く"
    );
    Diagnostic::note(119, place, message).help(text!(
        "write the storey heights on the next line, such as `9.0`; if these numbers are the heights, insert the line `0 0 180` before them",
        "次の行に `9.0` のように階高を書いてください。この数値が階高なら、前に `0 0 180` の行を書きます"
    ))
    .fix(are_heights, before, format!("0 0 180{line_end}"))
    .fix(are_place, place.after(), format!("{line_end}9.0"))
}

/// A height that is probably in metres (below), in sun or in centimetres (above).
#[cold]
pub fn odd_height(span: Span, height: f64) -> Diagnostic {
    let tenths = |value: f64| (value * 10.0).round() / 10.0;
    let metres = (height * 1000.0 / 33.0).round() / 100.0;
    let (unit, shaku) = match height {
        h if h < 40.0 => (text!("metres", "メートル"), h * 3.3),
        h if h <= 150.0 => (text!("sun", "寸"), h / 10.0),
        h => (text!("centimetres", "センチメートル"), h * 0.033),
    };
    let shaku = tenths(shaku);
    let message = text!([height, metres]
        "a storey of {height} shaku is {metres} m high",
        "階高 {height} 尺は {metres} m になります"
    );
    let found = Diagnostic::warning(137, span, message).help(text!([shaku, unit]
        "heights are in shaku, and 1 m is 3.3 shaku: write `{shaku:?}` if you mean {unit}",
        "高さの単位は尺です (1 m は 3.3 尺)。{unit}のつもりなら `{shaku:?}` と書いてください"
    ));
    match (5.0..=40.0).contains(&shaku) {
        true => found.fix(written(&format!("{shaku:?}")), span, format!("{shaku:?}")),
        false => found,
    }
}

/// A tag after legacy lines.
#[cold]
pub fn xml_after_text(span: Span, before: Span, lines: &str, tag: &str) -> Diagnostic {
    let message = text!(
        "the XML form begins here, but there are lines of the legacy form before it",
        "ここから XML 形式が始まりますが、その前に旧形式の行があります"
    );
    let found = Diagnostic::error(139, span, message).help(text!(
        "delete the lines before the first tag, or write comments as `<!-- ... -->`; the XML form is read from here on",
        "最初のタグより前の行を削除するか、コメントなら `<!-- ... -->` と書いてください。ここから先を XML 形式として読みます"
    ));
    // A declaration of XML stands before all comments, and a comment holds no two hyphens.
    let notes = lines.lines().all(|l| l.is_empty() || l.starts_with('#'));
    let found = if notes && !lines.contains("--") && !tag.trim_start().starts_with("<?") {
        let notes = lines.lines().map(|l| l.trim_start_matches('#').trim());
        let notes: Vec<&str> = notes.filter(|l| !l.is_empty()).collect();
        let comment = format!("<!-- {} -->\n", notes.join("\n     "));
        let title = text!("Make the lines an XML comment", "XML のコメントにする");
        found.fix(title, before, comment)
    } else {
        found
    };
    let title = text!("Delete the lines before it", "その前の行を削除する");
    found.fix(title, before, "")
}
