//! Messages about the walls of the legacy text.

use super::quote;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

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
