//! Messages about the file as a whole (HSD00xx) and limits (HSD09xx).

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// Nothing but blanks, comments and separators.
#[cold]
pub fn no_house(span: Span) -> Diagnostic {
    Diagnostic::error(1, span, "there is no house in this file").help(
        "begin with a header line such as `0 0 180`, a line of storey heights, a blank line, and then the walls",
    )
}

/// The bytes are no UTF-8 but make sense as Shift_JIS.
#[cold]
pub fn shift_jis(span: Span) -> Diagnostic {
    Diagnostic::note(2, span, "the file is read as Shift_JIS")
        .help("nothing has to be done; save it as UTF-8 if you like (positions count the bytes of the file as it is)")
}

/// A byte order mark or a declaration names another encoding, or the bytes make sense in no other.
#[cold]
pub fn other_encoding(span: Span, encoding: &str) -> Diagnostic {
    Diagnostic::note(3, span, format!("the file is read as {encoding}"))
        .help("nothing has to be done; save it as UTF-8 if you like (positions count the bytes of the file as it is)")
}

/// Some bytes mean nothing in the encoding.
#[cold]
pub fn malformed(span: Span, encoding: &str, count: usize) -> Diagnostic {
    let message = match count {
        0 | 1 => format!("the bytes here are no {encoding} text"),
        n => format!(
            "the bytes here and in {} more places are no {encoding} text",
            n - 1
        ),
    };
    Diagnostic::error(4, span, message)
        .help("open the file in the encoding it was written in and save it as UTF-8")
}

/// Full of NUL characters.
#[cold]
pub fn not_a_text(span: Span) -> Diagnostic {
    Diagnostic::error(5, span, "this is not a text file: it holds NUL characters").help(
        "name the text of a house, not a picture or a model; a text in UTF-16 without a byte order mark must be saved as UTF-8",
    )
}

/// A character that steers a terminal, in the middle of a text.
#[cold]
pub fn control_character(span: Span, character: char) -> Diagnostic {
    let number = u32::from(character);
    Diagnostic::error(
        6,
        span,
        format!("there is a control character, U+{number:04X}"),
    )
    .help("delete it, or put a blank in its place")
}

/// Lines that end with a carriage return alone.
#[cold]
pub fn old_line_ends(span: Span) -> Diagnostic {
    Diagnostic::note(7, span, "lines end with a carriage return alone, as on very old Macintoshes")
        .help("nothing has to be done; save the file with line feeds so that line numbers agree with your editor")
}

/// A file that was named is not there, or not for us.
#[cold]
pub fn unreadable(span: Span, why: &str) -> Diagnostic {
    Diagnostic::error(8, span, format!("the file cannot be read: {why}")).help(
        "see that its name is spelled right, that it is a text file, and that you may read it",
    )
}

/// More bytes than the limit.
#[cold]
pub fn too_large(span: Span, size: usize, limit: usize) -> Diagnostic {
    let message = format!("the file has {size} bytes, more than the limit of {limit}");
    Diagnostic::error(901, span, message)
        .help("divide it into several files, or raise the limit on the command line")
}

/// A reader has said enough about one file.
#[cold]
pub fn more_messages(span: Span, count: usize, worst: Severity) -> Diagnostic {
    let mut told = Diagnostic::error(909, span, format!("{count} more messages on this file are not shown"))
        .help("mend the ones above and check again; if there are very many, the file may not be the text of a house");
    told.severity = worst;
    told
}
