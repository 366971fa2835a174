//! Divides a long file into pieces of whole houses, each of which is read as if it were alone: [`LongFile`].
//!
//! A file is divided only where that changes neither a house nor a message. So houses must not depend on what stands
//! after them, nor on other files, and the markup around them must be sound; whatever is wrong inside a house is reported
//! by the reader, as always. What cannot be divided is held in memory as a whole.
//!
//! [`LongFile`]: hsd_base::source::LongFile

mod legacy;
mod xml;

use hsd_base::diagnostic::Text;
use hsd_base::source::{Layout, Stream};
use hsd_base::text;
use std::io::{self, BufRead, BufReader, SeekFrom};

/// The minimum length of a piece in bytes; only the last one may be shorter. It holds about a hundred plain houses: one
/// thread reads a piece while the others make the houses of the piece before, and should not keep them waiting.
const PIECE: u64 = 64 << 10;

/// The bytes beyond which a file is divided.
pub const LONG: u64 = 1 << 20;

/// The reason why a file cannot be divided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Undivided {
    /// It is not UTF-8, or not a text.
    Encoding,
    /// An element that other houses may depend on, or that needs them all.
    Element(String),
    /// Markup that is not sound, in this line.
    Markup(u64),
    /// Line ends of several kinds, or none.
    LineEnds,
    /// It has no place between houses.
    OneHouse,
}

impl Undivided {
    /// Returns the reason in words.
    pub fn text(&self) -> Text {
        match self {
            Undivided::Encoding => text!("it is not UTF-8", "UTF-8 ではない"),
            Undivided::Element(name) => text!([name]
                "all its houses are needed at once for `<{name}>`",
                "`<{name}>` のためにすべての家が同時に要る"
            ),
            Undivided::Markup(line) => text!([line]
                "its markup is not sound in line {line}",
                "{line} 行目のタグが正しくない"
            ),
            Undivided::LineEnds => text!(
                "it has line ends of several kinds",
                "改行の種類が混ざっている"
            ),
            Undivided::OneHouse => text!("it has no border between two houses", "家と家の境がない"),
        }
    }
}

/// Returns how a file of this size is divided.
///
/// # Errors
/// If the file cannot be read.
pub fn divide(file: &mut dyn Stream, size: u64) -> io::Result<Result<Layout, Undivided>> {
    file.seek(SeekFrom::Start(0))?;
    let mut reader = BufReader::with_capacity(1 << 16, file);
    let start = reader.fill_buf()?;
    let mark = if start.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    let begin = &start[mark..];
    if begin[..begin.len().min(1000)].contains(&0) {
        return Ok(Err(Undivided::Encoding));
    }
    let first = begin.trim_ascii_start().first().copied();
    reader.consume(mark);
    let mark = mark as u64;
    match first {
        Some(b'<') => xml::divide(reader, mark, size),
        Some(first) if first.is_ascii() => legacy::divide(reader, mark, size),
        _ => Ok(Err(Undivided::Encoding)),
    }
}
