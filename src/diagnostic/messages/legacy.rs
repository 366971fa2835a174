//! Messages about the legacy text (HSD01xx): 0101 to 0119 the header and the sections, 0120 to 0139 the
//! walls (and 0137 heights), 0140 and on the roof lines.

use crate::diagnostic::Diagnostic;
use crate::source::Span;

mod roofs;

pub use roofs::*;

/// Words in a sentence, each in backquotes.
fn list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// What an author wrote, in backquotes, not longer than a line of a report.
fn quote(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("`{short}`")
}

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

/// U+3000 in a wall line.
#[cold]
pub fn wide_blank(span: Span, count: usize) -> Diagnostic {
    let (message, help) = match count {
        1 => (
            "there is a full-width blank among the codes".to_owned(),
            "replace the full-width blank by two blanks".to_owned(),
        ),
        n => (
            format!("there are {n} full-width blanks among the codes"),
            format!("replace the {n} full-width blanks by {} blanks", 2 * n),
        ),
    };
    Diagnostic::error(120, span, message).help(help)
}

/// A tab in a wall line.
#[cold]
pub fn tab(span: Span) -> Diagnostic {
    Diagnostic::error(121, span, "there is a tab among the codes")
        .help("replace the tab by the blanks that fill the code up to five columns")
}

/// Full-width letters anywhere but in comments and names.
#[cold]
pub fn wide_letters(span: Span, text: &str) -> Diagnostic {
    let narrow: String = text
        .chars()
        .filter_map(|c| char::from_u32(u32::from(c).wrapping_sub(0xfee0)))
        .collect();
    Diagnostic::error(
        122,
        span,
        format!("{} is written in full-width letters", quote(text)),
    )
    .help(format!(
        "switch the input method off and write {}",
        quote(&narrow)
    ))
}

/// White space of another width, or none.
#[cold]
pub fn other_blank(span: Span, character: char) -> Diagnostic {
    let number = u32::from(character);
    Diagnostic::error(
        123,
        span,
        format!("there is an unusual blank, U+{number:04X}"),
    )
    .help("replace it by a plain blank if one can be seen, else delete it")
}

/// A character that no code has.
#[cold]
pub fn foreign(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(124, span, format!("{} cannot stand in a code", quote(text))).help(
        "a code is five characters of plain ASCII; names of parts in other letters belong in comments or in the XML form",
    )
}

/// Codes after the blank line that ends the walls.
#[cold]
pub fn blank_in_walls(blank: Span, next: Span) -> Diagnostic {
    Diagnostic::error(125, blank, "a blank line ends the walls, but more codes follow it")
        .help("delete the blank line; a storey ends with `^`, a turn without parts is a line with `R` or `L` alone")
        .label(next, "read as the next wall")
}

/// One column more than the codes take.
#[cold]
pub fn one_over(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(126, span, format!("{} is one column over", quote(text))).help(
        "delete it or complete its five columns; only the letters `L`, `R` and `^` may follow the last code",
    )
}

/// A turn letter that does not stand right after the last column of a code: `before` columns stand before
/// it, and `codes` without the blanks at their end.
#[cold]
pub fn misplaced_control(span: Span, letter: &str, before: usize, codes: usize) -> Diagnostic {
    let (missing, surplus) = (before.next_multiple_of(5) - before, before % 5);
    let blanks = |n: usize| if n == 1 { "blank" } else { "blanks" };
    let message = format!(
        "the `{letter}` stands in column {} and so inside a code",
        before + 1
    );
    // Blanks can be deleted only as far as there are any after the codes.
    let help = if surplus < missing && before - surplus >= codes {
        let blanks = blanks(surplus);
        format!(
            "delete {surplus} {blanks} before the `{letter}`: it stands right after the five columns of the last code"
        )
    } else {
        let blanks = blanks(missing);
        format!(
            "write {missing} more {blanks} before the `{letter}`, so that the last code has five columns"
        )
    };
    Diagnostic::error(127, span, message).help(help)
}

/// A turn letter with codes after it; `leads` tells that it begins its line.
#[cold]
pub fn inner_turn(span: Span, letter: &str, leads: bool) -> Diagnostic {
    let help = if leads {
        format!(
            "put the `{letter}` at the end of the line before, right after the five columns of its last code"
        )
    } else {
        format!("begin a new line after the `{letter}`")
    };
    let message = format!("the turn `{letter}` stands before codes, but a turn ends its line");
    Diagnostic::error(138, span, message).help(help)
}

/// A tag after legacy lines.
#[cold]
pub fn xml_after_text(span: Span) -> Diagnostic {
    let message = "the XML form begins here, but lines of the legacy form stand before it";
    Diagnostic::error(139, span, message).help(
        "delete the lines before the first tag, or write comments as `<!-- ... -->`; the XML form is read from here on",
    )
}

/// `l` or `r` for `L` or `R`.
#[cold]
pub fn lower_control(span: Span, letter: &str) -> Diagnostic {
    let capital = letter.to_ascii_uppercase();
    Diagnostic::error(
        128,
        span,
        format!("the turn letter `{letter}` must be a capital"),
    )
    .help(format!("write `{capital}`"))
}

/// Blanks that hide the end of the line.
#[cold]
pub fn blanks_after(span: Span, letter: &str) -> Diagnostic {
    Diagnostic::warning(
        129,
        span,
        format!("there are blanks after the final `{letter}`"),
    )
    .help("delete them; the letter must be the last character of the line")
}

/// Codes after `^` on the same line.
#[cold]
pub fn after_reset(span: Span) -> Diagnostic {
    Diagnostic::error(130, span, "nothing may follow `^` on its line")
        .help("begin the next storey on a new line")
}

/// Blanks before the first code.
#[cold]
pub fn shifted(span: Span, blanks: usize, voids: usize) -> Diagnostic {
    let help = match voids {
        0 => "delete the blanks: the first code begins in the first column".to_owned(),
        n => format!("write {n} blanks, five for each void, or `.....` for each"),
    };
    Diagnostic::error(
        131,
        span,
        format!("the line begins with {blanks} blanks, which shift every code after them"),
    )
    .help(help)
}

/// Words that look like codes but do not stand in their columns.
#[cold]
pub fn out_of_step(span: Span, column: usize, meant: &str) -> Diagnostic {
    let mut line: String = meant.chars().take(80).collect();
    if line.len() < meant.len() {
        line.push('…');
    }
    let message = format!(
        "from column {column} on the codes are out of step: each takes exactly five columns"
    );
    Diagnostic::error(132, span, message).help(format!("write `{line}`"))
}

/// Five blanks at a line end.
#[cold]
pub fn trailing_void(span: Span, count: usize) -> Diagnostic {
    let (message, points) = match count {
        1 => (
            "the line ends with a void of five blanks".to_owned(),
            ".....".to_owned(),
        ),
        n => (
            format!("the line ends with {n} voids of blanks"),
            format!("{n} times `.....`"),
        ),
    };
    Diagnostic::warning(133, span, message).help(format!(
        "write {}: an editor that trims lines would change the house",
        if count == 1 {
            format!("`{points}`")
        } else {
            points
        }
    ))
}

/// Points that are not five.
#[cold]
pub fn few_points(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error(134, span, format!("{} is no void", quote(text)))
        .help("write exactly five points, `.....`")
}

/// `^` after the last storey.
#[cold]
pub fn last_reset(span: Span) -> Diagnostic {
    Diagnostic::warning(135, span, "no storey follows this `^`")
        .help("delete it; the last storey ends with the walls")
}

/// `^` after `^`.
#[cold]
pub fn empty_storey(span: Span, storey: usize) -> Diagnostic {
    Diagnostic::error(
        136,
        span,
        format!("storey {storey} has no walls before its `^`"),
    )
    .help("delete the `^`, or write the walls of the storey before it")
}
