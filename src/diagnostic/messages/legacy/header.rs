//! Messages about the header, the sections and the heights of the legacy text.

use super::{list, quote};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Codes or roofs stand where the place of the house should.
#[cold]
pub fn no_header(span: Span) -> Diagnostic {
    Diagnostic::error(101, span, "the header is missing: the line `x y [azimuth]` with the place of the house")
        .help("write `0 0 180`, a line of storey heights such as `9.0`, and a blank line before the walls")
}

/// A number that must be there is not.
#[cold]
pub fn missing_number(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(102, span, format!("the number of {what} is missing"))
        .help("write both local coordinates in metres, and the azimuth if the house does not face south: `0 0 180`")
}

/// A word that should be a number.
#[cold]
pub fn not_a_number(span: Span, text: &str, what: &str) -> Diagnostic {
    Diagnostic::error(103, span, format!("{} is no number for {what}", quote(text)))
        .help("write digits with a point for the fraction, without a unit, and part numbers by blanks: `9.0 5.5`")
}

/// A number that no house has.
#[cold]
pub fn out_of_range(
    span: Span,
    text: &str,
    what: &str,
    least: f64,
    most: f64,
    unit: &str,
) -> Diagnostic {
    Diagnostic::error(
        104,
        span,
        format!("{} is out of range for {what}", quote(text)),
    )
    .help(format!("give a number from {least} to {most} {unit}"))
}

/// A line of the header that begins with no known key.
#[cold]
pub fn unknown_key(span: Span, text: &str, near: Option<&str>, keys: &[&str]) -> Diagnostic {
    let help = match near {
        Some(key) => format!("write `{key}`, a blank, and its value"),
        None => format!(
            "write one of {}; a comment begins with `#` in the first column",
            list(keys)
        ),
    };
    Diagnostic::error(
        105,
        span,
        format!("{} is no key of the header", quote(text)),
    )
    .help(help)
}

/// A word that is none of those a key takes.
#[cold]
pub fn bad_choice(
    span: Span,
    key: &str,
    text: &str,
    near: Option<&str>,
    choices: &[&str],
) -> Diagnostic {
    let help = match near {
        Some(word) => format!("write `{key} {word}`"),
        None => format!("write {} after `{key}`", list(choices)),
    };
    Diagnostic::error(106, span, format!("`{key}` cannot be {}", quote(text))).help(help)
}

/// More words than a line takes.
#[cold]
pub fn surplus(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(
        107,
        span,
        format!("there is more after {what} than the line can hold"),
    )
    .help("delete it; a comment needs a line of its own that begins with `#`")
}

/// A key or option that was given before.
#[cold]
pub fn twice(span: Span, key: &str, before: Span) -> Diagnostic {
    Diagnostic::warning(
        108,
        span,
        format!("`{key}` is given twice; this one counts"),
    )
    .help("delete one of the two")
    .label(before, "the first one")
}

/// A line of the header after the walls have begun.
#[cold]
pub fn late_key(span: Span, key: &str) -> Diagnostic {
    Diagnostic::error(109, span, format!("`{key}` belongs in the header"))
        .help("move the line up, before the blank line that begins the walls")
}

/// Two sections without the blank line between them.
#[cold]
pub fn no_blank_line(span: Span, before: &str, after: &str) -> Diagnostic {
    Diagnostic::warning(
        110,
        span,
        format!("there is no blank line between the {before} and the {after}"),
    )
    .help("put a blank line before this one")
}

/// A line of numbers after the heights.
#[cold]
pub fn third_numbers(span: Span, heights: Span) -> Diagnostic {
    Diagnostic::error(
        111,
        span,
        "the header has two lines of numbers: the place, and the storey heights",
    )
    .help("write all storey heights on one line, from the ground up")
    .label(heights, "the storey heights are here")
}

/// More heights than storeys.
#[cold]
pub fn surplus_heights(span: Span, heights: usize, storeys: usize) -> Diagnostic {
    Diagnostic::warning(
        112,
        span,
        format!("there are {heights} storey heights, but the walls of {storeys}"),
    )
    .help("delete the surplus heights, or close each storey with `^` after its last wall")
}

/// A comment that does not begin its line.
#[cold]
pub fn comment_column(span: Span) -> Diagnostic {
    Diagnostic::error(113, span, "a comment must begin in the first column")
        .help("put the comment on a line of its own, with `#` as its first character")
}

/// A comment as other languages write it.
#[cold]
pub fn comment_sign(span: Span, sign: &str) -> Diagnostic {
    Diagnostic::error(113, span, format!("`{sign}` begins no comment"))
        .help("a comment begins with `#` in the first column")
}

/// Text beside `%`.
#[cold]
pub fn after_separator(span: Span) -> Diagnostic {
    Diagnostic::error(114, span, "a `%` between two houses stands alone on its line")
        .help("delete the rest of the line; write a comment on its own line, the name of a house as `name ...` in its header")
}

/// A second header without `%`.
#[cold]
pub fn no_separator(span: Span) -> Diagnostic {
    Diagnostic::error(
        115,
        span,
        "a header begins here, but the house before it is not closed",
    )
    .help("write `%` alone on a line between two houses")
}

/// A header without walls.
#[cold]
pub fn no_walls(span: Span) -> Diagnostic {
    Diagnostic::error(116, span, "this house has no walls")
        .help("after the header and a blank line, write one line of part codes for each wall, clockwise from the front")
}

/// A key or header value without anything after it.
#[cold]
pub fn missing_value(span: Span, key: &str) -> Diagnostic {
    let example = match key {
        "unit" => "3.0",
        "seed" => "7",
        "roofs" => "auto",
        "method" => "least-cut",
        "street" => "yes",
        _ => "corner house",
    };
    Diagnostic::error(117, span, format!("`{key}` has no value")).help(format!(
        "write for example `{key} {example}`, or delete the line"
    ))
}

/// A seed that is negative, broken or too large.
#[cold]
pub fn bad_seed(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(118, span, format!("{} cannot be a seed", quote(text)))
        .help(format!("write a whole number from 0 to {}", u64::MAX))
}

/// One line of numbers, which is the place; the heights were left out or taken for it.
#[cold]
pub fn no_heights(place: Span) -> Diagnostic {
    Diagnostic::note(
        119,
        place,
        "only one line of numbers: it is read as the place, and every storey is 9 shaku high",
    )
    .help("write the storey heights on the next line, such as `9.0`; if these numbers are the heights, put the line `0 0 180` before them")
}

/// A height that is likely given in metres (below), in sun or in centimetres (above).
#[cold]
pub fn odd_height(span: Span, height: f64) -> Diagnostic {
    let tenths = |value: f64| (value * 10.0).round() / 10.0;
    let metres = (height * 1000.0 / 33.0).round() / 100.0;
    let (unit, shaku) = match height {
        h if h < 40.0 => ("metres", h * 3.3),
        h if h <= 150.0 => ("sun", h / 10.0),
        h => ("centimetres", h * 0.033),
    };
    let message = format!("a storey of {height} shaku is {metres} m high");
    Diagnostic::warning(137, span, message).help(format!(
        "heights are in shaku, and 1 m is 3.3 shaku: write `{:?}` if {unit} are meant",
        tenths(shaku)
    ))
}

/// A tag after legacy lines.
#[cold]
pub fn xml_after_text(span: Span) -> Diagnostic {
    let message = "the XML form begins here, but lines of the legacy form stand before it";
    Diagnostic::error(139, span, message).help(
        "delete the lines before the first tag, or write comments as `<!-- ... -->`; the XML form is read from here on",
    )
}
