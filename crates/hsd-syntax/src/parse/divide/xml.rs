//! Divides a file of the XML form between the houses of its `Houses`. What stands before the first house (parameters,
//! names, definitions) is the head of every piece.

use super::{PIECE, Undivided};
use hsd_base::source::Layout;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::io::{self, BufRead};

/// The largest head that is read again with every piece, bytes.
const HEAD: u64 = 16 << 10;

/// The minimum length of a piece, as a multiple of the length of the head: every piece is read with the head before it.
const HEADS: u64 = 16;

/// Elements that stand before the houses and hold in all of them.
const BEFORE: [&str; 3] = ["Param", "let", "define"];

/// Elements that lead to other files, or to parts that all houses of a file know.
const OUTWARD: [&str; 3] = ["include", "Place", "PartDef"];

/// The names of the open elements, end to end in one string, so that none needs its own allocation.
#[derive(Default)]
struct Open {
    names: String,
    starts: Vec<usize>,
}

impl Open {
    fn len(&self) -> usize {
        self.starts.len()
    }

    fn last(&self) -> Option<&str> {
        Some(&self.names[*self.starts.last()?..])
    }

    fn push(&mut self, name: &str) {
        self.starts.push(self.names.len());
        self.names.push_str(name);
    }

    fn pop(&mut self) {
        self.names.truncate(self.starts.pop().unwrap_or(0));
    }
}

/// The state of the division.
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

/// Returns how a file is divided that begins at this byte.
pub(super) fn divide(
    reader: impl BufRead,
    mark: u64,
    size: u64,
) -> io::Result<Result<Layout, Undivided>> {
    let mut reader = Reader::from_reader(reader);
    let mut division = Division {
        open: Open::default(),
        first: None,
        cuts: vec![],
        end: 0,
        closed: false,
    };
    let (mut buffer, mut line) = (vec![], 1);
    loop {
        buffer.clear();
        let start = mark + reader.buffer_position();
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
        let end = mark + reader.buffer_position();
        if let Err(reason) = division.event(&event, start..end, line) {
            return Ok(Err(reason));
        }
        line += event.matches('\n').count() as u64;
    }
    Ok(division.finish(mark, size, line))
}

impl Division {
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
                if text.contains('<') || tag.attributes().with_checks(false).any(|a| a.is_err()) {
                    return unsound;
                }
                self.start(tag, empty, range, line)?;
            }
            Event::End(_) => {
                let house = self.open.last() == Some("House");
                self.open.pop();
                self.closed |= self.open.len() == 0;
                if self.open.len() == 1 && house {
                    self.house_ends(range.end);
                }
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

    fn start(
        &mut self,
        tag: &BytesStart<'_>,
        empty: bool,
        range: std::ops::Range<u64>,
        line: u64,
    ) -> Result<(), Undivided> {
        let name = tag.name().into_inner();
        let needs_all = || Undivided::Element(name.to_owned());
        let before = self.first.is_none() && BEFORE.contains(&name);
        // An end tag without its slash looks like an element in one of its kind.
        if self.closed || self.open.last() == Some(name) {
            return Err(Undivided::Markup(line));
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
