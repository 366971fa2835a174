//! Messages about roof lines (HSD0140 and on).

use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Text, noun};
use hsd_base::source::Span;
use hsd_base::text;

/// The title of a fix that replaces a word.
fn written(word: &str) -> Text {
    let quoted = quote(word);
    text!([quoted] "Write {quoted}", "{quoted} と書く")
}

/// An unknown covering.
#[cold]
pub fn unknown_kind(span: Span, text: &str, near: Option<&str>) -> Diagnostic {
    let all = noun(
        "`K` (pantiles), `G` (hon-gawara tiles), `I` (boards), `S` (shingles), `H` (bark), `Y` (thatch), `T` (sheet metal) or `*`",
        "`K` (桟瓦葺)、`G` (本瓦葺)、`I` (板葺)、`S` (杮葺)、`H` (檜皮葺)、`Y` (茅葺)、`T` (金属板葺)、`*`",
    );
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a roof covering",
        "{quoted} という葺き材はありません"
    );
    let fix = near.unwrap_or("*");
    Diagnostic::error(140, span, message)
        .help(match near {
            Some(kind) => text!([kind, all]
                "write `{kind}`; the coverings are {all}",
                "`{kind}` と書いてください。葺き材は {all} です"
            ),
            None => text!([all] "write {all}", "{all} のどれかを書いてください"),
        })
        .fix(written(fix), span, fix)
}

/// An unknown direction.
#[cold]
pub fn unknown_direction(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a roof direction",
        "{quoted} という屋根の向きはありません"
    );
    Diagnostic::error(141, span, message).help(text!(
        "write X for a ridge along the front, Y for one at right angles to it, F, B, L or R for the side a shed roof slopes to, or `*`",
        "棟が正面に平行なら X、直交するなら Y、片流れなら流れる側を F、B、L、R で、または `*` と書いてください"
    ))
    .fix(written("*"), span, "*")
}

/// An unknown shape.
#[cold]
pub fn unknown_shape(span: Span, text: &str, near: Option<&str>) -> Diagnostic {
    let all = noun(
        "KIR, YOS, YOK, IRI, HAK, HOG, KAT, HIS, TER, KAR, RIK or `*`",
        "KIR、YOS、YOK、IRI、HAK、HOG、KAT、HIS、TER、KAR、RIK、`*`",
    );
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a roof shape",
        "{quoted} という屋根の形はありません"
    );
    let fix = near.unwrap_or("*");
    Diagnostic::error(142, span, message)
        .help(match near {
            Some(shape) => text!([shape, all]
                "did you mean `{shape}`? The shapes are {all}",
                "`{shape}` ではありませんか。屋根の形は {all} です"
            ),
            None => text!([all] "write one of {all}", "{all} のどれかを書いてください"),
        })
        .fix(written(fix), span, fix)
}

/// An unknown option.
#[cold]
pub fn unknown_option(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a roof option",
        "{quoted} という屋根の指定はありません"
    );
    Diagnostic::error(143, span, message).help(text!(
        "write P (pitch), E (eaves), G (verge), T (thickness), M (ridge courses), S (sori), C (gable) or R (ridge length) with a number right after it, or O alone",
        "P (勾配)、E (軒の出)、G (けらばの出)、T (厚さ)、M (熨斗瓦の段数)、S (反り)、C (妻の位置)、R (棟の長さ) のどれかに数値を続けて書くか、O だけを書いてください"
    ))
}

/// A ridge direction for a shed roof, or a slope direction for two slopes; `own`: the direction is a separate word.
#[cold]
pub fn direction_misfit(
    span: Span,
    shape_span: Span,
    shape: &str,
    ridge: bool,
    own: bool,
) -> Diagnostic {
    let (message, help) = if ridge {
        (
            text!([shape]
                "a {shape} roof looks to one side, which has to be named",
                "{shape} の屋根は片側を向くため、その側の指定が必要です"
            ),
            text!(
                "write F (front), B (back), L (left) or R (right)",
                "F (正面)、B (背面)、L (左)、R (右) のどれかを書いてください"
            ),
        )
    } else {
        (
            text!([shape]
                "a {shape} roof has a ridge, so it cannot slope to one side",
                "{shape} の屋根には棟があるため、片側へ流すことはできません"
            ),
            text!(
                "write X for a ridge along the front or Y for one at right angles to it; a shed roof is KAT",
                "棟が正面に平行なら X、直交するなら Y と書いてください。片流れは KAT です"
            ),
        )
    };
    let mut found = Diagnostic::error(144, span, message)
        .help(help)
        .label(shape_span, text!("the shape", "屋根の形"));
    let sides: &[&str] = if ridge {
        &["F", "B", "L", "R"]
    } else {
        &["X", "Y"]
    };
    for side in sides.iter().filter(|_| own) {
        found = found.fix(written(side), span, *side);
    }
    match ridge {
        true => found,
        false => found.fix(written("KAT"), shape_span, "KAT"),
    }
}

/// A missing field.
#[cold]
pub fn missing_field(span: Span, what: impl Into<Text>, star: &str) -> Diagnostic {
    let what = what.into();
    let message = text!([what] "the roof lacks {what}", "屋根の{what}がありません");
    Diagnostic::error(145, span, message).help(text!(
        "write covering, direction, height, shape, then a0 b0 a1 b1, with `*` for what the program should choose: `K X * KIR 0 0 6 8`",
        "葺き材、向き、高さ、形、a0 b0 a1 b1 の順に書いてください。自動で決めるところは `*` とします: `K X * KIR 0 0 6 8`"
    ))
    .fix(text!("Leave it to the program: `*`", "`*` として自動で決める"), span, star)
}

/// Fewer than four corner numbers.
#[cold]
pub fn missing_corners(span: Span, count: usize) -> Diagnostic {
    let missing = 4 - count.min(4);
    let message = match missing {
        1 => text!(
            "one of the four corner numbers is missing",
            "隅を示す四つの数値がひとつ足りません"
        ),
        4 => text!(
            "the corners of the roof are missing",
            "屋根の隅の数値がありません"
        ),
        _ => text!([missing]
            "{missing} of the four corner numbers are missing",
            "隅を示す四つの数値が{missing}つ足りません"
        ),
    };
    Diagnostic::error(146, span, message).help(text!(
        "write a0 b0 a1 b1 after the shape: two opposite corners in U, to the left and to the back of the start",
        "形の後に a0 b0 a1 b1 と書いてください。始点から左と奥へ U で測った、向かい合う二つの隅です"
    ))
}

/// A rectangle without width or depth.
#[cold]
pub fn no_extent(span: Span, other: Span, axis: char, text: &str) -> Diagnostic {
    let extent = if axis == 'a' {
        noun("width", "間口")
    } else {
        noun("depth", "奥行")
    };
    let message = text!([extent, axis, text]
        "the roof has no {extent}: {axis}0 and {axis}1 are both {text}",
        "屋根の{extent}がありません。{axis}0 も {axis}1 も {text} です"
    );
    Diagnostic::error(147, span, message)
        .help(text!(
            "give two opposite corners of the rectangle, in the order a0 b0 a1 b1",
            "矩形の向かい合う二つの隅を a0 b0 a1 b1 の順に書いてください"
        ))
        .label(other, format!("{axis}0"))
}

/// Covering and direction as one word.
#[cold]
pub fn glued(span: Span, text: &str) -> Diagnostic {
    let spread: Vec<String> = text.chars().map(String::from).collect();
    let (quoted, spread) = (quote(text), spread.join(" "));
    let message = text!([quoted]
        "{quoted} should be two fields, covering and direction",
        "{quoted} は葺き材と向きの二項目に分けて書きます"
    );
    Diagnostic::error(148, span, message)
        .help(text!([spread] "write `{spread}`", "`{spread}` と書いてください"))
        .fix(written(&spread), span, spread)
}

/// Lower case in a roof line.
#[cold]
pub fn lower_roof(span: Span, capitals: &str) -> Diagnostic {
    let message = text!(
        "the letters of a roof line must be capitals",
        "屋根の行の文字は大文字で書きます"
    );
    let found = Diagnostic::warning(149, span, message)
        .help(text!("write them as capitals", "大文字で書いてください"));
    match capitals.is_ascii() {
        true => found.fix(text!("Write capitals", "大文字で書く"), span, capitals),
        false => found,
    }
}

/// An option letter without a number, or apart from it; `place` is what has to go.
#[cold]
pub fn bare_option(
    span: Span,
    letter: char,
    what: impl Into<Text>,
    apart: Option<&str>,
    place: Span,
) -> Diagnostic {
    let what = what.into();
    let message = text!([letter, what]
        "the option `{letter}` has no number for {what}",
        "指定 `{letter}` に{what}の数値がありません"
    );
    let title = match apart {
        Some(number) => written(&format!("{letter}{number}")),
        None => text!([letter] "Delete the `{letter}`", "`{letter}` を削除する"),
    };
    Diagnostic::error(150, span, message)
        .help(match apart {
            Some(number) => text!([letter, number]
                "write the number right after the letter: `{letter}{number}`",
                "数値を文字のすぐ後に続けて `{letter}{number}` と書いてください"
            ),
            None => text!([what, letter]
                "write {what} right after the letter, or delete the `{letter}`",
                "{what}を文字のすぐ後に書くか、`{letter}` を削除してください"
            ),
        })
        .fix(title, place, "")
}

/// A fraction of a ridge course, and the nearest whole number with the place of this one.
#[cold]
pub fn no_whole_number(span: Span, text: &str, whole: Option<(Span, f64)>) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is not a whole number of ridge courses",
        "{quoted} は熨斗瓦の段数として整数ではありません"
    );
    let found = Diagnostic::error(151, span, message).help(text!(
        "write a whole number, for example `M3`",
        "`M3` のように整数を書いてください"
    ));
    match whole {
        Some((place, number)) => {
            found.fix(written(&format!("M{number}")), place, number.to_string())
        }
        None => found,
    }
}
