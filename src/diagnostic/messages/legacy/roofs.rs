//! Messages about roof lines (HSD0140 and on).

use super::quote;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A kind letter that does not exist.
#[cold]
pub fn unknown_kind(span: Span, text: &str, near: Option<&str>) -> Diagnostic {
    let all = "K tiles, G cover tiles, I boards, S shingles, H bark, Y thatch, T metal, or `*`";
    let help = match near {
        Some(kind) => format!("write `{kind}`; the kinds are {all}"),
        None => format!("write {all}"),
    };
    Diagnostic::error(140, span, format!("{} is no kind of roof", quote(text))).help(help)
}

/// A direction letter that does not exist.
#[cold]
pub fn unknown_direction(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(141, span, format!("{} is no direction of a roof", quote(text))).help(
        "write X for a ridge along the front, Y for one at right angles to it, F, B, L or R for the side a single slope falls to, or `*`",
    )
}

/// Three letters that are no shape.
#[cold]
pub fn unknown_shape(span: Span, text: &str, near: Option<&str>) -> Diagnostic {
    let all = "KIR, YOS, YOK, IRI, HAK, HOG, KAT, HIS, TER, KAR, RIK or `*`";
    let help = match near {
        Some(shape) => format!("did you mean `{shape}`? The shapes are {all}"),
        None => format!("write one of {all}"),
    };
    Diagnostic::error(142, span, format!("{} is no shape of a roof", quote(text))).help(help)
}

/// A word after the corners that is no option.
#[cold]
pub fn unknown_option(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(143, span, format!("{} is no option of a roof", quote(text))).help(
        "write P pitch, E eaves, G verge, T thickness, M ridge courses, S sag, C gable or R ridge length with a number glued to it, or O alone",
    )
}

/// A ridge for one slope, or a fall for two.
#[cold]
pub fn direction_misfit(span: Span, shape_span: Span, shape: &str, ridge: bool) -> Diagnostic {
    let (message, help) = if ridge {
        (
            format!("a {shape} roof has no ridge, so it needs the side to which it falls"),
            "write F front, B back, L left or R right",
        )
    } else {
        (
            format!("a {shape} roof has a ridge, so it cannot fall to one side"),
            "write X for a ridge along the front or Y for one at right angles to it; a lean-to is KAT",
        )
    };
    Diagnostic::error(144, span, message)
        .help(help)
        .label(shape_span, "the shape")
}

/// A field left out before a later one.
#[cold]
pub fn missing_field(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(145, span, format!("the roof lacks {what}")).help(
        "write kind, direction, height, shape, then a0 b0 a1 b1, with `*` for what is to be found out: `K X * KIR 0 0 6 8`",
    )
}

/// Fewer than four corner numbers.
#[cold]
pub fn missing_corners(span: Span, count: usize) -> Diagnostic {
    let what = match 4 - count.min(4) {
        1 => "one of the four corner numbers is missing".to_owned(),
        4 => "the corners of the roof are missing".to_owned(),
        n => format!("{n} of the four corner numbers are missing"),
    };
    Diagnostic::error(146, span, what)
        .help("write a0 b0 a1 b1 after the shape: two opposite corners in units, to the left and to the back of the start")
}

/// A rectangle without width or depth.
#[cold]
pub fn no_extent(span: Span, other: Span, axis: char, text: &str) -> Diagnostic {
    let extent = if axis == 'a' { "width" } else { "depth" };
    Diagnostic::error(
        147,
        span,
        format!("the roof has no {extent}: {axis}0 and {axis}1 are both {text}"),
    )
    .help("give two opposite corners of the rectangle, in the order a0 b0 a1 b1")
    .label(other, format!("{axis}0"))
}

/// Kind and direction as one word.
#[cold]
pub fn glued(span: Span, text: &str) -> Diagnostic {
    let spread: Vec<String> = text.chars().map(String::from).collect();
    Diagnostic::error(
        148,
        span,
        format!("kind and direction are two fields, not {}", quote(text)),
    )
    .help(format!("write `{}`", spread.join(" ")))
}

/// Lower case in a roof line.
#[cold]
pub fn lower_roof(span: Span) -> Diagnostic {
    Diagnostic::warning(149, span, "the letters of a roof line are capitals")
        .help("write them as capitals")
}

/// An option letter without a number, or apart from it.
#[cold]
pub fn bare_option(span: Span, letter: char, what: &str, apart: Option<&str>) -> Diagnostic {
    let help = match apart {
        Some(number) => format!("write the number right after the letter: `{letter}{number}`"),
        None => format!("write {what} right after the letter, or delete the `{letter}`"),
    };
    Diagnostic::error(
        150,
        span,
        format!("the option `{letter}` has no number for {what}"),
    )
    .help(help)
}

/// Half a course of ridge tiles.
#[cold]
pub fn no_whole_number(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(
        151,
        span,
        format!("{} is no whole number of ridge courses", quote(text)),
    )
    .help("write a whole number, for example `M3`")
}
