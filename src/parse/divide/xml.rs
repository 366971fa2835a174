//! Divides a file of the XML form between the houses of its `Houses`. What stands before the first house (parameters,
//! names, definitions) is the head of every piece.

use super::{PIECE, Undivided};
use crate::parse::plain_tag::{PlainTag, TagKind};
use crate::source::Layout;
use quick_xml::Reader;
use quick_xml::events::Event;
use std::io::{self, BufRead};

/// The largest head that is read again with every piece, bytes.
const HEAD: u64 = 16 << 10;

/// A piece is at least so many times as long as the head, which is read with it.
const HEADS: u64 = 16;

/// Elements that stand before the houses and hold in all of them.
const BEFORE: [&str; 3] = ["Param", "let", "define"];

/// Elements that lead to other files, or to parts that all houses of a file know.
const OUTWARD: [&str; 3] = ["include", "Place", "PartDef"];

/// The state of the division.
#[derive(Default)]
struct Division {
    open: Open,
    /// The start of the first house.
    first: Option<u64>,
    cuts: Vec<u64>,
    /// The end of the last house.
    end: u64,
    /// True after the outermost element.
    closed: bool,
}

/// The names of the open elements, one after another, and where each begins.
#[derive(Default)]
struct Open {
    names: String,
    starts: Vec<usize>,
}

impl Open {
    fn len(&self) -> usize {
        self.starts.len()
    }

    fn push(&mut self, name: &str) {
        self.starts.push(self.names.len());
        self.names.push_str(name);
    }

    fn last(&self) -> Option<&str> {
        let start = self.starts.last()?;
        Some(&self.names[*start..])
    }

    fn pop(&mut self) {
        if let Some(start) = self.starts.pop() {
            self.names.truncate(start);
        }
    }
}

/// Returns how a file is divided that begins at this byte.
pub(super) fn divide(
    mut input: impl BufRead,
    mark: u64,
    size: u64,
) -> io::Result<Result<Layout, Undivided>> {
    let mut division = Division::default();
    let (mut buffer, mut at, mut line) = (vec![], mark, 1);
    loop {
        let block = input.fill_buf()?;
        let plain = match division.plain(block, at, line) {
            Ok(plain) => plain,
            Err(reason) => return Ok(Err(reason)),
        };
        if plain > 0 {
            line += lines(&block[..plain]);
            input.consume(plain);
            at += plain as u64;
            continue;
        }
        // A reader of one event would skip it as the mark at the start of a file.
        if block.starts_with("\u{feff}".as_bytes()) {
            return Ok(Err(Undivided::Markup(line)));
        }
        buffer.clear();
        let mut reader = Reader::from_reader(&mut input);
        reader.config_mut().check_end_names = false;
        reader.config_mut().allow_unmatched_ends = true;
        let event = match reader.read_event_into(&mut buffer) {
            Ok(event) => event,
            Err(quick_xml::Error::Io(error)) => {
                return Err(io::Error::new(error.kind(), error.to_string()));
            }
            Err(_) => return Ok(Err(Undivided::Markup(line))),
        };
        if matches!(event, Event::Eof) {
            break;
        }
        let end = at + reader.buffer_position();
        if let Err(reason) = division.event(&event, at..end, line) {
            return Ok(Err(reason));
        }
        line += lines(event.as_bytes());
        at = end;
    }
    Ok(division.finish(mark, size, line))
}

/// Returns the number of line ends in a text.
fn lines(text: &[u8]) -> u64 {
    text.iter().filter(|byte| **byte == b'\n').count() as u64
}

impl Division {
    /// Takes plain tags and plain text at the start of a block, which begins at byte `at` in line `line` of the file;
    /// returns the number of their bytes.
    fn plain(&mut self, block: &[u8], at: u64, line: u64) -> Result<usize, Undivided> {
        let mut done = 0;
        loop {
            let inside = self.open.len() > 0;
            let text = block[done..].iter().take_while(|byte| match byte {
                b' ' | b'\t' | b'\r' | b'\n' => true,
                b'<' | b'&' => false,
                other => inside && other.is_ascii(),
            });
            done += text.count();
            let Some(tag) = PlainTag::at(block, done) else {
                return Ok(done);
            };
            let Ok(text) = str::from_utf8(&block[..tag.end][done..]) else {
                return Ok(done);
            };
            let range = at + done as u64..at + tag.end as u64;
            let name = &text[tag.name.start - done..tag.name.end - done];
            let taken = match tag.kind {
                TagKind::End => self.ends(name, range.end),
                kind => self.start(name, kind == TagKind::Empty, range),
            };
            let line = || line + lines(&block[..done]);
            taken.map_err(|wrong| wrong.in_line(line()))?;
            done = tag.end;
        }
    }

    fn event(
        &mut self,
        event: &Event<'_>,
        range: std::ops::Range<u64>,
        line: u64,
    ) -> Result<(), Undivided> {
        let text: &str = event;
        let unsound = Err(Undivided::Markup(line));
        match event {
            Event::Start(tag) | Event::Empty(tag) => {
                let empty = matches!(event, Event::Empty(_));
                if text.contains('<') || tag.attributes().any(|a| a.is_err()) {
                    return unsound;
                }
                let taken = self.start(tag.name().into_inner(), empty, range);
                taken.map_err(|wrong| wrong.in_line(line))?;
            }
            Event::End(tag) => {
                let taken = self.ends(tag.name().into_inner().trim_end(), range.end);
                taken.map_err(|wrong| wrong.in_line(line))?;
            }
            Event::Text(_) if text.contains(['＜', '＞']) => return unsound,
            Event::Text(_) | Event::CData(_) | Event::GeneralRef(_) => {
                if self.open.len() == 0 && !text.trim().is_empty() {
                    return unsound;
                }
            }
            Event::Decl(declaration) => {
                let label = declaration.encoding().and_then(Result::ok);
                if label.is_some_and(|l| !l.eq_ignore_ascii_case("utf-8")) {
                    return Err(Undivided::Encoding);
                }
            }
            Event::Comment(_) | Event::Eof => {}
            Event::PI(_) | Event::DocType(_) => return unsound,
        }
        Ok(())
    }

    fn start(&mut self, name: &str, empty: bool, range: std::ops::Range<u64>) -> Result<(), Wrong> {
        let needs_all = || Wrong::Element(name.to_owned());
        let before = self.first.is_none() && BEFORE.contains(&name);
        // An end tag without its slash looks like an element in one of its kind.
        if self.closed || self.open.last().is_some_and(|outer| outer == name) {
            return Err(Wrong::Markup);
        }
        match self.open.len() {
            0 if name != "Houses" || empty => return Err(needs_all()),
            1 if name == "House" => {
                self.first.get_or_insert(range.start);
            }
            1 if !before => return Err(needs_all()),
            2.. if name == "House" || OUTWARD.contains(&name) => return Err(needs_all()),
            _ => {}
        }
        match empty {
            false => self.open.push(name),
            true if self.open.len() == 1 && name == "House" => self.house_ends(range.end),
            true => {}
        }
        Ok(())
    }

    fn ends(&mut self, name: &str, end: u64) -> Result<(), Wrong> {
        if self.open.last() != Some(name) {
            return Err(Wrong::Markup);
        }
        self.open.pop();
        self.closed |= self.open.len() == 0;
        if self.open.len() == 1 && name == "House" {
            self.house_ends(end);
        }
        Ok(())
    }

    fn house_ends(&mut self, at: u64) {
        self.end = at;
        let first = self.first.unwrap_or(0);
        let last = self.cuts.last().copied().unwrap_or(first);
        if at - last >= PIECE.max(HEADS * first) {
            self.cuts.push(at);
        }
    }

    fn finish(mut self, mark: u64, size: u64, line: u64) -> Result<Layout, Undivided> {
        let Some(first) = self.first.filter(|_| self.open.len() == 0) else {
            return Err(Undivided::Markup(line));
        };
        if first - mark > HEAD {
            return Err(Undivided::Element("define".to_owned()));
        }
        // The last piece keeps what follows the last house; it has a house of its own.
        while self.cuts.last().is_some_and(|cut| *cut >= self.end) {
            self.cuts.pop();
        }
        if self.cuts.is_empty() {
            return Err(Undivided::OneHouse);
        }
        self.cuts.insert(0, first);
        self.cuts.push(size);
        Ok(Layout {
            head: mark..first,
            cuts: self.cuts,
            tail: "</Houses>",
        })
    }
}

/// Why an element forbids a division.
enum Wrong {
    Markup,
    Element(String),
}

impl Wrong {
    fn in_line(self, line: u64) -> Undivided {
        match self {
            Wrong::Markup => Undivided::Markup(line),
            Wrong::Element(name) => Undivided::Element(name),
        }
    }
}
