//! Source files: their bytes, the text they decode to, and spans into them.
//!
//! A [`Span`] always counts bytes of the ORIGINAL file, whatever its encoding, so that an editor and
//! a JSON report agree with the file on disk. The passes read [`Source::text`] (UTF-8, without a byte
//! order mark) and make spans with [`Source::span`]; only a report needs the way back,
//! [`Source::text_range`].

mod cache;
mod limits;
mod lines;
mod long;
mod reference;

pub use crate::source::cache::{CacheFull, SourceCache};
pub use limits::Limits;
pub use lines::Lines;
pub use long::{Layout, LongFile, PieceLines};
pub use reference::reference;

use crate::budget::Budget;
use std::ops::Range;
use std::sync::Arc;

/// The surroundings of a build: images and included files. The passes do no input or output of their own. Houses may
/// be made on several threads, so all of them can ask at once.
pub trait World: Send + Sync {
    /// Returns the part image of this name in the texture folders.
    fn picture(&self, name: &str) -> Option<PictureFile>;

    /// Returns the bytes of an image found before.
    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>>;

    /// Returns the image `href` that the source file `from` names.
    ///
    /// # Errors
    /// If there is none, or it may not be read.
    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        let _ = (from, href);
        Err(IncludeError::Missing)
    }

    /// Returns the path of the file that the source file `from` includes as `href`.
    ///
    /// # Errors
    /// If there is none, or it may not be read.
    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        let _ = (from, href);
        Err(IncludeError::Missing)
    }

    /// Returns the names of the files in a folder that the source file `from` names; the empty name is its own folder.
    ///
    /// # Errors
    /// If there is no such folder, or it may not be read.
    fn names(&self, from: &str, folder: &str) -> Result<Vec<String>, IncludeError> {
        let _ = (from, folder);
        Err(IncludeError::Missing)
    }

    /// Returns the bytes of a file found before, which is no longer than `limit`.
    ///
    /// # Errors
    /// If it cannot be read.
    fn text_bytes(&self, path: &str, limit: usize) -> std::io::Result<Vec<u8>> {
        let _ = limit;
        Err(std::io::Error::new(std::io::ErrorKind::NotFound, path))
    }

    /// Opens a file found by [`World::text`], or one beside it, to be read piece by piece: a map.
    ///
    /// # Errors
    /// If it cannot be read.
    fn open(&self, path: &str) -> std::io::Result<Box<dyn Stream>> {
        Err(std::io::Error::new(std::io::ErrorKind::NotFound, path))
    }

    /// Returns what changes when a file found by [`World::text`] changes, or one beside it that differs in its extension
    /// only, as the files of one map do; `None` if nobody can tell.
    fn stamp(&self, path: &str) -> Option<u64> {
        let _ = path;
        None
    }

    /// Returns the budget of the run. The default is a new budget for each file.
    fn budget(&self) -> Arc<Budget> {
        Arc::default()
    }

    /// Returns a file that may be opened as a path of the system, for libraries that open files themselves.
    fn on_disk(&self, path: &str) -> Option<std::path::PathBuf> {
        let _ = path;
        None
    }
}

/// A file that is read piece by piece.
pub trait Stream: std::io::Read + std::io::Seek + Send {}

impl<T: std::io::Read + std::io::Seek + Send> Stream for T {}

/// The reason why a file cannot be included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IncludeError {
    /// There is no such file.
    Missing,
    /// It would lie outside the root folder of the build.
    Outside,
}

/// A part image that exists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureFile {
    /// Its path for [`World::picture_bytes`].
    pub path: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

/// A world without files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl World for NoFiles {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        Err(std::io::Error::new(std::io::ErrorKind::NotFound, path))
    }
}

/// A file of one run, numbered in the order of reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A range of bytes of an original file; `start <= end <= length of the file`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// Returns the smallest span that holds both; the file of `self`.
    pub fn to(self, other: Span) -> Span {
        Span {
            file: self.file,
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Returns the empty span at the end of `self`.
    pub fn after(self) -> Span {
        Span {
            start: self.end,
            ..self
        }
    }
}

impl serde::Serialize for Span {
    /// Serializes as `[start, end]`, under a name by which a serializer can distinguish places from content.
    fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_newtype_struct("Span", &[self.start, self.end])
    }
}

/// A value and the place where it is written.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// Joins a value and its place.
    pub fn new(value: T, span: Span) -> Self {
        Spanned { value, span }
    }
}

/// A source file: its name, its text, and the conversion between offsets in both.
#[derive(Clone, Debug)]
pub struct Source {
    id: FileId,
    name: String,
    text: String,
    len: usize,
    encoding: &'static str,
    malformed: bool,
    offsets: Offsets,
}

#[derive(Clone, Debug)]
enum Offsets {
    /// UTF-8: a text offset lies this many bytes further in the file (3 with a byte order mark).
    Shifted(u32),
    /// Other encodings: (text offset, file offset) wherever the distance of both changes.
    Table(Vec<(u32, u32)>),
}

impl Source {
    /// Returns the same file with another number.
    #[must_use]
    pub fn numbered(self, id: FileId) -> Source {
        Source { id, ..self }
    }

    /// Decodes a file. A byte order mark decides; then an XML declaration's label; then whatever is
    /// valid UTF-8 is UTF-8; otherwise Shift_JIS or EUC-JP, whichever fits (docs/evidence.md 2.6, A13).
    pub fn new(id: FileId, name: impl Into<String>, bytes: &[u8]) -> Source {
        let (encoding, bom) = detect(bytes);
        let utf8 = (encoding == encoding_rs::UTF_8).then(|| std::str::from_utf8(&bytes[bom..]));
        let (text, offsets, malformed) = match utf8 {
            Some(Ok(text)) => (text.to_owned(), Offsets::Shifted(bom as u32), false),
            _ => decode(encoding, bytes, bom),
        };
        let (name, len) = (name.into(), bytes.len());
        Source {
            id,
            name,
            text,
            len,
            encoding: encoding.name(),
            malformed,
            offsets,
        }
    }

    /// Returns the number of this file.
    pub fn id(&self) -> FileId {
        self.id
    }

    /// Returns the name as given on the command line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the decoded text, without a byte order mark.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the number of bytes in the original file.
    pub fn size(&self) -> usize {
        self.len
    }

    /// Returns the encoding's name, "UTF-8" or for example "Shift_JIS".
    pub fn encoding(&self) -> &'static str {
        self.encoding
    }

    /// Returns true if some bytes were invalid in the encoding and became U+FFFD.
    pub fn malformed(&self) -> bool {
        self.malformed
    }

    /// Returns the span of a range of [`Source::text`].
    pub fn span(&self, range: Range<usize>) -> Span {
        let (start, end) = (self.original(range.start), self.original(range.end));
        Span {
            file: self.id,
            start,
            end: end.max(start),
        }
    }

    /// Returns the range of [`Source::text`] that a span covers.
    pub fn text_range(&self, span: Span) -> Range<usize> {
        let start = self.decoded(span.start);
        start..self.decoded(span.end).max(start)
    }

    /// Returns line and column of a span's start, both from 1, columns in characters.
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let before = &self.text[..self.text_range(span).start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = 1 + before.bytes().filter(|&b| b == b'\n').count();
        (line, 1 + before[line_start..].chars().count())
    }

    /// Returns the first line of a span.
    pub fn first_line(&self, span: Span) -> Span {
        let range = self.text_range(span);
        let first = self.text[range.clone()].lines().next();
        let length = first.map_or(0, |line| line.trim_end().len());
        self.span(range.start..range.start + length)
    }

    fn original(&self, at: usize) -> u32 {
        let at = at.min(self.text.len()) as u32;
        let file = match &self.offsets {
            Offsets::Shifted(by) => at + by,
            Offsets::Table(t) => across(t, at, |p| p.0, |p| p.1),
        };
        file.min(self.len as u32)
    }

    fn decoded(&self, at: u32) -> usize {
        let mut at = match &self.offsets {
            Offsets::Shifted(by) => at.saturating_sub(*by),
            Offsets::Table(t) => across(t, at, |p| p.1, |p| p.0),
        } as usize;
        at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

/// Converts an offset by the table, in either direction, clamped to the next entry.
fn across(
    table: &[(u32, u32)],
    at: u32,
    from: impl Fn(&(u32, u32)) -> u32,
    to: impl Fn(&(u32, u32)) -> u32,
) -> u32 {
    let next = table.partition_point(|p| from(p) <= at);
    let Some(entry) = next.checked_sub(1).map(|i| &table[i]) else {
        return at;
    };
    let offset = to(entry) + (at - from(entry));
    table.get(next).map_or(offset, |n| offset.min(to(n)))
}

fn detect(bytes: &[u8]) -> (&'static encoding_rs::Encoding, usize) {
    if let Some(found) = encoding_rs::Encoding::for_bom(bytes) {
        return found;
    }
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(256)]);
    let label = head.trim_start().strip_prefix("<?xml").and_then(|d| {
        let rest = d.split("?>").next()?.split_once("encoding")?.1;
        let rest = rest.trim_start().strip_prefix('=')?.trim_start();
        let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        rest[1..].split(quote).next().map(str::to_owned)
    });
    let declared = label.and_then(|l| encoding_rs::Encoding::for_label(l.as_bytes()));
    let encoding = match declared {
        Some(e) if e.is_ascii_compatible() => e,
        _ if std::str::from_utf8(bytes).is_ok() => encoding_rs::UTF_8,
        _ => japanese(bytes).unwrap_or(encoding_rs::UTF_8),
    };
    (encoding, 0)
}

/// Returns the Japanese encoding in which all bytes are valid. If both are, the one with fewer half-width kana: they
/// are rare in real files, and EUC-JP read as Shift_JIS is full of them.
pub fn japanese(bytes: &[u8]) -> Option<&'static encoding_rs::Encoding> {
    let candidates = [encoding_rs::SHIFT_JIS, encoding_rs::EUC_JP];
    let readable = candidates.into_iter().filter_map(|encoding| {
        let (text, malformed) = encoding.decode_without_bom_handling(bytes);
        let narrow = |c: &char| ('\u{ff61}'..='\u{ff9f}').contains(c);
        (!malformed).then(|| (text.chars().filter(narrow).count(), encoding))
    });
    readable.min_by_key(|(narrow, _)| *narrow).map(|(_, e)| e)
}

/// Decodes byte by byte and notes where text and file offsets diverge; slow, but old files are small.
fn decode(
    encoding: &'static encoding_rs::Encoding,
    bytes: &[u8],
    bom: usize,
) -> (String, Offsets, bool) {
    let mut decoder = encoding.new_decoder_without_bom_handling();
    let mut text = String::with_capacity(bytes.len() * 2);
    let (mut table, mut malformed) = (vec![(0, bom as u32)], false);
    let mut unit = bom; // where the character under way began
    for at in bom..=bytes.len() {
        let last = at == bytes.len();
        let byte = if last { &[][..] } else { &bytes[at..=at] };
        let before = text.len();
        let mut room = [0u8; 32];
        let (_, _, written, bad) = decoder.decode_to_utf8(byte, &mut room, last);
        malformed |= bad;
        if written > 0 {
            text.push_str(&String::from_utf8_lossy(&room[..written]));
            let (start, end) = (unit as u32, (at + usize::from(!last)) as u32);
            if table
                .last()
                .is_none_or(|l| start - l.1 != before as u32 - l.0)
            {
                table.push((before as u32, start));
            }
            table.push((text.len() as u32, end));
            unit = end as usize;
        }
    }
    table.dedup();
    (text, Offsets::Table(table), malformed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_count_bytes_of_a_shift_jis_file() {
        let (bytes, ..) = encoding_rs::SHIFT_JIS.encode("# 町家ｶﾞ\nGSI  ");
        let source = Source::new(FileId(0), "家.hsd", &bytes);
        assert_eq!(
            (source.encoding(), source.malformed()),
            ("Shift_JIS", false)
        );
        let at = source.text().find("GSI").expect("is there");
        let span = source.span(at..at + 5);
        assert_eq!(&bytes[span.start as usize..span.end as usize], b"GSI  ");
        assert_eq!(source.text_range(span), at..at + 5);
        assert_eq!(source.line_column(span), (2, 1));
        let kanji = source.text().find('家').expect("is there");
        assert_eq!(
            source.span(kanji..kanji + 3),
            Span {
                file: FileId(0),
                start: 4,
                end: 6
            }
        );
    }

    #[test]
    fn old_japanese_encodings_are_told_apart() {
        let texts = [
            "# 町家 大戸\nGSI  ",
            "# カタカナ",
            "# 表の間は格子",
            "# 京都市",
        ];
        for text in texts {
            for encoding in [encoding_rs::SHIFT_JIS, encoding_rs::EUC_JP] {
                let (bytes, ..) = encoding.encode(text);
                let source = Source::new(FileId(0), "家.hsd", &bytes);
                assert_eq!((source.encoding(), source.text()), (encoding.name(), text));
            }
        }
    }

    #[test]
    fn spans_count_the_byte_order_mark() {
        let source = Source::new(FileId(0), "a.hsd", "\u{feff}0 0".as_bytes());
        assert_eq!(source.text(), "0 0");
        assert_eq!(
            source.span(0..1),
            Span {
                file: FileId(0),
                start: 3,
                end: 4
            }
        );
    }
}
