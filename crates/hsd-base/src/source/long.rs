//! Long source files, which are read in pieces of whole houses: a town of a million houses is larger than the memory it
//! should take.
//!
//! A piece is a [`Source`] like any other. Its text is what its houses need, from several places of the file; its spans
//! count bytes of the file. How a file is divided is up to its reader; see [`Layout`].

use super::{FileId, Lines, Offsets, Source, Span, Stream};
use std::io::{self, ErrorKind, Read, SeekFrom};
use std::ops::Range;
use std::sync::{Mutex, OnceLock, PoisonError};

/// The lines of context around a message.
const AROUND: usize = 3;

/// The longest run of bytes that is shown from one place on.
const LONGEST: u64 = 4096;

/// The bytes that are read at a time.
const BLOCK: usize = 1 << 16;

/// How a file is divided: each piece consists of the head, the bytes from one cut to the next, and the tail.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// The bytes that every piece begins with; a byte order mark before them is left out.
    pub head: Range<u64>,
    /// The borders of the pieces: the first is where the first piece begins, the last is the end of the file.
    pub cuts: Vec<u64>,
    /// The end of every piece but the last, which has that of the file.
    pub tail: &'static str,
}

/// A file that is read in pieces. It is UTF-8.
pub struct LongFile {
    id: FileId,
    name: String,
    size: u64,
    layout: Layout,
    file: Mutex<Box<dyn Stream>>,
    /// Line and column of each cut; empty if the file cannot be read any more.
    cut_places: OnceLock<Vec<(u32, u32)>>,
}

/// The lines of a part of a file that is read in pieces.
#[derive(Debug)]
pub struct PieceLines {
    range: Range<u64>,
    lines: Lines<String>,
}

impl PieceLines {
    /// Returns line and column of the start of a span, both from 1; `None` if it is not in this part.
    pub fn line_column(&self, span: Span) -> Option<(u32, u32)> {
        let start = u64::from(span.start);
        let at = start.checked_sub(self.range.start)?;
        (start < self.range.end).then(|| self.lines.line_column(at as usize))
    }
}

impl std::fmt::Debug for LongFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let LongFile { id, name, size, .. } = self;
        write!(f, "LongFile({id:?}, {name}, {size} bytes)")
    }
}

impl LongFile {
    /// Joins a file and its layout.
    pub fn new(
        id: FileId,
        name: impl Into<String>,
        (file, size): (Box<dyn Stream>, u64),
        layout: Layout,
    ) -> LongFile {
        LongFile {
            id,
            name: name.into(),
            size,
            layout,
            file: Mutex::new(file),
            cut_places: OnceLock::new(),
        }
    }

    /// Returns the number of this file.
    pub fn id(&self) -> FileId {
        self.id
    }

    /// Returns the number of its pieces.
    pub fn pieces(&self) -> usize {
        self.layout.cuts.len().saturating_sub(1)
    }

    /// Returns true if a span is in what all pieces begin with.
    pub fn is_in_head(&self, span: Span) -> bool {
        self.layout.head.contains(&span.start.into())
    }

    /// Returns the file without any house.
    ///
    /// # Errors
    /// If it cannot be read any more.
    pub fn stub(&self) -> io::Result<Source> {
        self.assembled(0..0, self.layout.tail)
    }

    /// Returns a piece by its number, from 0.
    ///
    /// # Errors
    /// If it cannot be read any more.
    pub fn piece(&self, number: usize) -> io::Result<Source> {
        let range = self.layout.cuts[number]..self.layout.cuts[number + 1];
        let last = number + 1 == self.pieces();
        self.assembled(range, if last { "" } else { self.layout.tail })
    }

    fn assembled(&self, range: Range<u64>, tail: &str) -> io::Result<Source> {
        let head = &self.layout.head;
        let mut text = self.text(head.clone())?;
        let joint = text.len() as u32;
        text.push_str(&self.text(range.clone())?);
        let end = text.len() as u32;
        text.push_str(tail);
        let table = vec![
            (0, head.start as u32),
            (joint, range.start as u32),
            (end, range.end as u32),
        ];
        Ok(self.source(text, table))
    }

    /// Returns the file as an author sees it around some places: the other lines are there, but empty.
    ///
    /// # Errors
    /// If it cannot be read any more.
    pub fn excerpt(&self, places: impl Iterator<Item = Span>) -> io::Result<Source> {
        let mut wanted: Vec<Range<u64>> = vec![];
        for span in places.filter(|span| span.file == self.id) {
            let (start, end) = (u64::from(span.start), u64::from(span.end));
            wanted.push(start..end.clamp(start + 1, start + LONGEST));
            wanted.push(end.saturating_sub(1)..end);
        }
        wanted.sort_unstable_by_key(|range| (range.start, range.end));
        let mut excerpt = Excerpt::new(wanted);
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(0))?;
        let mut reader = io::BufReader::with_capacity(BLOCK, &mut *file);
        let mut line = vec![];
        let mut at = 0;
        while io::BufRead::read_until(&mut reader, b'\n', &mut line)? > 0 {
            let start = if at == 0 && line.starts_with(b"\xef\xbb\xbf") {
                3
            } else {
                0
            };
            excerpt.line(&String::from_utf8_lossy(&line[start..]), at + start as u64);
            at += line.len() as u64;
            line.clear();
        }
        drop(reader);
        Ok(self.source(excerpt.text, excerpt.table))
    }

    /// Returns the bytes of a span with the one before it, as text.
    pub fn written(&self, span: Span) -> (Option<u8>, String) {
        let start = u64::from(span.start);
        let bytes = self.bytes(start.saturating_sub(1)..u64::from(span.end));
        let bytes = bytes.unwrap_or_default();
        let before = bytes.first().copied().filter(|_| start > 0);
        let own = bytes.get(usize::from(start > 0)..).unwrap_or_default();
        (before, String::from_utf8_lossy(own).into_owned())
    }

    /// Returns the first line of a span.
    pub fn first_line(&self, span: Span) -> Span {
        let seen = Span {
            end: span.end.min(span.start.saturating_add(LONGEST as u32)),
            ..span
        };
        let (_, text) = self.written(seen);
        let first = text.lines().next().map_or(0, |line| line.trim_end().len());
        Span {
            end: (span.start + first as u32).min(span.end),
            ..span
        }
    }

    /// Returns the lines of the piece, or of the head, that a span begins in; `None` if the file cannot be read any more.
    pub fn lines_around(&self, span: Span) -> Option<PieceLines> {
        let (start, layout) = (u64::from(span.start), &self.layout);
        let (range, first) = match self.is_in_head(span) {
            true => (layout.head.clone(), (1, 1)),
            false => {
                let next = layout.cuts.partition_point(|cut| *cut <= start);
                let next = next.min(self.pieces());
                let number = next.checked_sub(1)?;
                let places = self
                    .cut_places
                    .get_or_init(|| self.places().unwrap_or_default());
                (layout.cuts[number]..layout.cuts[next], *places.get(number)?)
            }
        };
        let text = self.text(range.clone()).ok()?;
        Some(PieceLines {
            range,
            lines: Lines::new(text, first),
        })
    }

    /// Reads the file once; returns line and column of each cut.
    fn places(&self) -> io::Result<Vec<(u32, u32)>> {
        let mut place = (1, 1);
        let mut places = vec![];
        // The head begins behind a byte order mark.
        let mut from = self.layout.head.start;
        for cut in &self.layout.cuts {
            let text = self.text(from..*cut)?;
            place = Lines::new(&*text, place).line_column(text.len());
            places.push(place);
            from = *cut;
        }
        Ok(places)
    }

    fn text(&self, range: Range<u64>) -> io::Result<String> {
        String::from_utf8(self.bytes(range)?).map_err(|_| self.changed())
    }

    fn bytes(&self, range: Range<u64>) -> io::Result<Vec<u8>> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(range.start))?;
        let mut bytes = vec![0; (range.end - range.start) as usize];
        match file.read_exact(&mut bytes) {
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Err(self.changed()),
            read => read.map(|()| bytes),
        }
    }

    fn changed(&self) -> io::Error {
        let name = &self.name;
        let message = format!("{name} was changed while it was read; build it again");
        io::Error::new(ErrorKind::InvalidData, message)
    }

    /// Returns a source with this text; the table leads from it into the file.
    fn source(&self, text: String, mut table: Vec<(u32, u32)>) -> Source {
        table.dedup();
        Source {
            id: self.id,
            name: self.name.clone(),
            text,
            len: self.size as usize,
            encoding: encoding_rs::UTF_8.name(),
            malformed: false,
            offsets: Offsets::Table(table),
        }
    }
}

/// The lines of a file that a report shows.
struct Excerpt {
    /// The ranges to be shown, by their starts; those before `next` are past.
    wanted: Vec<Range<u64>>,
    next: usize,
    /// The end of the ranges that have begun.
    until: u64,
    text: String,
    table: Vec<(u32, u32)>,
    /// The lines before the current one, which are context if it is shown; and the lines still to be shown after it.
    before: Vec<(String, u64)>,
    after: usize,
}

impl Excerpt {
    fn new(wanted: Vec<Range<u64>>) -> Excerpt {
        Excerpt {
            wanted,
            next: 0,
            until: 0,
            text: String::new(),
            table: vec![],
            before: vec![],
            after: 0,
        }
    }

    /// Adds a line that begins at this byte of the file.
    fn line(&mut self, line: &str, at: u64) {
        let end = at + line.len() as u64;
        while let Some(range) = self.wanted.get(self.next).filter(|r| r.start < end) {
            self.until = self.until.max(range.end);
            self.next += 1;
        }
        self.before.push((line.to_owned(), at));
        if self.until > at {
            self.after = AROUND + 1;
        }
        if self.after > 0 {
            self.after -= 1;
            for (line, at) in std::mem::take(&mut self.before) {
                let entry = (self.text.len() as u32, at as u32);
                // Lines that follow each other in the file need no entry of their own.
                let goes_on = |last: &(u32, u32)| entry.1 - last.1 == entry.0 - last.0;
                if !self.table.last().is_some_and(goes_on) {
                    self.table.push(entry);
                }
                self.text.push_str(&line);
            }
        } else if self.before.len() > AROUND {
            self.before.remove(0);
            // So that the lines after it keep their numbers.
            self.text.push('\n');
        }
    }
}
