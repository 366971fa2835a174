//! Reads the legacy form: header, walls, roofs (docs/contract.md 2; 001-05 to 001-11).
//!
//! A file is read line by line, once. A house is a state machine with three states: the header up to the first line of
//! codes, the walls up to a blank line, the roofs up to `%` or the end of the file. A misplaced line is recognised by
//! its form, reported, and read as what it is, so that one mistake hides none of the others.
//!
//! | file | reads |
//! |---|---|
//! | `line` | lines, and substitutes for invalid characters |
//! | `places` | the places that fixes change |
//! | `fixed` | messages about those substitutes |
//! | `words` | words and numbers |
//! | `header` | place, heights, keys |
//! | `walls`, `cells` | storeys and rows; the codes of a row |
//! | `roofs` | roof lines |

mod cells;
mod header;
pub mod line;
mod places;
mod roof_words;
mod roofs;
mod fixed;
mod walls;
mod words;

use super::ReadContext;
use crate::messages::legacy as say;
use crate::parse::reporter::Reporter;
use crate::parse::syntax::LineKind;
use header::Header;
use hsd_base::diagnostic::messages::file;
use hsd_base::diagnostic::{Diagnostics, Edit, Noun, noun};
use hsd_base::source::{Limits, Source, SourceCache, Span};
use hsd_ir::ast::{Document, House};
use line::SourceLine;
use std::ops::{Range, RangeInclusive};

use walls::Walls;

/// Returns the keys of header settings.
pub fn settings() -> &'static [&'static str] {
    &header::KEYS
}

/// Returns the roof line options that take a number: letter and range.
pub fn options() -> impl Iterator<Item = (char, RangeInclusive<f64>)> {
    let all = roof_words::OPTIONS.iter();
    all.map(|(letter, range)| (*letter, range.bounds.clone()))
}

/// Reads a file of the legacy form.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    parse_lines(source, limits, out, &mut |_, _| {})
}

/// Reads a file of the legacy form, or a piece of one.
pub(super) fn parse_in(
    source: &Source,
    setting: ReadContext<'_>,
    out: &mut Diagnostics,
) -> Document {
    let alone = setting.before.is_none();
    read_lines(source, (&setting.limits, alone), out, &mut |_, _| {})
}

/// Reads a file of the legacy form; also returns the kind of each line, with its range of the source's text.
pub fn parse_lines(
    source: &Source,
    limits: &Limits,
    out: &mut Diagnostics,
    each: &mut dyn FnMut(Range<usize>, LineKind),
) -> Document {
    read_lines(source, (limits, true), out, each)
}

/// As [`parse_lines`]; `alone` = the source is a whole file.
fn read_lines(
    source: &Source,
    (limits, alone): (&Limits, bool),
    out: &mut Diagnostics,
    each: &mut dyn FnMut(Range<usize>, LineKind),
) -> Document {
    let mut reader = Reader {
        reporter: Reporter::new(source),
        document: Document::default(),
        house: Draft::default(),
        old_line_ends: false,
    };
    let mut xml = None;
    let text = source.text();
    for (line, end) in line::lines(text) {
        reader.line_end(end.clone());
        if is_tag(&text[line.clone()]) {
            xml = Some(line.start);
            let span = source.span(line.clone());
            let before = source.span(0..line.start);
            let tag = &text[line.clone()];
            reader
                .reporter
                .say(say::xml_after_text(span, before, &text[..line.start], tag));
            break;
        }
        let kind = reader.line(&text[line.clone()], line.start, end);
        each(line, kind);
    }
    if xml.is_none() || reader.house.walls.begun() {
        reader.finish_house();
    }
    let Reader {
        mut reporter,
        mut document,
        ..
    } = reader;
    if document.houses.is_empty() && xml.is_none() && alone {
        reporter.say(file::no_house(source.span(0..0)));
    }
    out.append(reporter.finish());
    if let Some(tag) = xml {
        let cache = SourceCache::new(0, 0, 0);
        let rest = super::xml::parse_from(
            source,
            tag,
            ReadContext::alone(limits, &cache),
            &mut super::xml::Trees::default(),
            out,
        );
        document.houses.extend(rest.houses);
    }
    document
}

/// Returns true for a line that would begin a courtyard at a place: `@ 4 6`.
fn is_court(text: &str) -> bool {
    let place = text.trim_start().strip_prefix('@').map(str::trim_start);
    place.is_some_and(|p| p.starts_with(|c: char| c.is_ascii_digit() || c == '-'))
}

/// The names of the sections in messages.
const WALLS: Noun = noun("walls", "壁");
const ROOFS: Noun = noun("roofs", "屋根");

/// The section that a house is in.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Section {
    #[default]
    Header,
    Walls,
    Roofs,
}

/// A house being read.
#[derive(Default)]
struct Draft {
    section: Section,
    header: Header,
    walls: Walls,
    house: House,
    /// From its first line to its last.
    span: Option<Span>,
    /// The last blank line, with its line end, in the text of the source.
    blank: Option<Range<usize>>,
    /// True if blank lines were read before it, with comments between.
    apart: bool,
    /// The end of the header's lines, in the text of the source.
    header_end: Option<usize>,
    /// True in the lines of a courtyard, which this form has not; up to the next blank line.
    court: bool,
}

impl Draft {
    /// Records a blank line; consecutive ones count as one.
    fn blank_line(&mut self, range: Range<usize>) {
        let start = match self.blank.take() {
            Some(before) if before.end == range.start => before.start,
            before => {
                self.apart |= before.is_some();
                range.start
            }
        };
        self.blank = Some(start..range.end);
    }
}

struct Reader<'a> {
    reporter: Reporter<'a>,
    document: Document,
    house: Draft,
    old_line_ends: bool,
}

impl<'a> Reader<'a> {
    /// Records line ends that modern editors do not count.
    fn line_end(&mut self, end: Range<usize>) {
        if !self.old_line_ends && self.reporter.source.text()[end.clone()] == *"\r" {
            self.old_line_ends = true;
            let span = self.reporter.source.span(end);
            self.reporter.say(file::old_line_ends(span));
        }
    }

    fn line(&mut self, raw: &'a str, at: usize, end: Range<usize>) -> LineKind {
        // Some old programs end a file with Ctrl-Z.
        let last = end.end == self.reporter.source.text().len();
        let raw = if last {
            raw.trim_end_matches('\u{1a}')
        } else {
            raw
        };
        if raw.starts_with('#') {
            return LineKind::Comment;
        }
        if raw.trim_start().is_empty() {
            self.house.header.gap = self.house.header.begun();
            self.house.court = false;
            self.house.blank_line(at..end.end);
            return LineKind::Blank;
        }
        let line = SourceLine::new(raw, at);
        let text = line.text.trim();
        match text.as_bytes().first() {
            None => {
                self.reporter.fixed_fields(&line);
                LineKind::Blank
            }
            Some(b'%') => {
                self.separator(&line, text);
                LineKind::Separator
            }
            Some(b'#') => {
                self.reporter.fixed_before(&line, 0);
                let span = line.whole(self.reporter.source);
                let at = line.at;
                let blanks = at + raw.find('#').unwrap_or(0);
                let blanks = self.reporter.source.span(at..blanks);
                self.reporter.say(say::indented_comment(span, blanks));
                LineKind::Comment
            }
            Some(_) => match other_comment(text) {
                Some(sign) => {
                    let start = raw.len() - raw.trim_start().len();
                    let start = at + start;
                    let span = self.reporter.source.span(start..start + sign.len());
                    let head = self.reporter.source.span(at..start + sign.len());
                    self.reporter.say(say::comment_sign(span, head, sign));
                    LineKind::Comment
                }
                None => self.content(&line, end.end),
            },
        }
    }

    fn separator(&mut self, line: &SourceLine<'_>, text: &str) {
        self.reporter.fixed_fields(line);
        if text != "%" {
            let start = line.text.find('%').unwrap_or(0) + 1;
            let rest = start..line.text.trim_end().len();
            let span = line.span(self.reporter.source, rest);
            let note = self.reporter.written(span).trim().to_owned();
            let end = self.reporter.line_end_text();
            self.reporter.say(say::after_separator(span, &note, end));
        }
        self.finish_house();
    }

    fn content(&mut self, line: &SourceLine<'_>, end: usize) -> LineKind {
        if self.house.walls.begun() && is_court(&line.text) && !self.house.court {
            self.house.court = true;
            let span = line.whole(self.reporter.source);
            self.reporter.say(say::no_courts(span));
        }
        if self.house.court {
            (self.house.blank, self.house.apart) = (None, false);
            return LineKind::Wall;
        }
        let section = self.section_of(line, end);
        let house = &mut self.house;
        let span = line.whole(self.reporter.source);
        house.span = Some(house.span.map_or(span, |s| s.to(span)));
        (house.blank, house.apart) = (None, false);
        match section {
            Some(section) => house.section = section,
            // A key among walls or roofs is read immediately.
            None => {
                house
                    .header
                    .read(line, &mut house.house, &mut self.reporter);
                return LineKind::Header;
            }
        }
        match house.section {
            Section::Header => {
                house
                    .header
                    .read(line, &mut house.house, &mut self.reporter);
                house.header_end = Some(end);
                LineKind::Header
            }
            Section::Walls => {
                house.walls.read(line, &mut self.reporter);
                LineKind::Wall
            }
            Section::Roofs => {
                let roof = roofs::read(line, &mut self.reporter);
                house.house.roofs.lines.extend(roof);
                LineKind::Roof
            }
        }
    }

    /// Returns the section of a line by its form; `None` for a misplaced line of the header.
    fn section_of(&mut self, line: &SourceLine<'_>, end: usize) -> Option<Section> {
        match self.house.section {
            Section::Header => Some(self.after_header(line)),
            _ if header::is_key_line(&line.text) => {
                let key = words::plain_words(&line.text).next().unwrap_or_default();
                let start = line.text.find(key).unwrap_or(0);
                let span = line.span(self.reporter.source, start..start + key.len());
                let fix = self.moved_up(line, end);
                self.reporter.say(say::late_key(span, key, fix));
                None
            }
            Section::Walls => Some(self.after_walls(line)),
            Section::Roofs => Some(self.after_roofs(line)),
        }
    }

    /// Returns the edits that move a line to the end of the header. The blank line before it is removed too if it would
    /// separate the walls.
    fn moved_up(&self, line: &SourceLine<'_>, end: usize) -> Vec<Edit> {
        let (house, source) = (&self.house, self.reporter.source);
        let Some(to) = house.header_end else {
            return vec![];
        };
        let text = source.text();
        let next = text[end..].lines().next().unwrap_or_default();
        let parts = house.section == Section::Walls && looks_like_codes(next);
        let blank = house.blank.clone().filter(|b| parts && b.end == line.at);
        let from = blank.map_or(line.at, |b| b.start);
        let key = [line.raw.trim(), self.reporter.line_end_text()].concat();
        vec![
            Edit::new(source.span(to..to), key),
            Edit::new(source.span(from..end), ""),
        ]
    }

    fn after_header(&mut self, line: &SourceLine<'_>) -> Section {
        let (house, source) = (&self.house, self.reporter.source);
        let roof = roofs::looks_like_roof(&line.text);
        if !roof && house.header.owns(&line.text) {
            return Section::Header;
        }
        let start = line.whole(source);
        let start = Span {
            end: start.start,
            ..start
        };
        if !house.header.placed() {
            let end = self.reporter.line_end_text();
            self.reporter.say(say::no_header(start, end));
        } else if house.blank.is_none() {
            self.reporter.say(say::no_blank_line(
                start,
                noun("header", "ヘッダー"),
                if roof { ROOFS } else { WALLS },
                self.reporter.line_end_text(),
            ));
        }
        if roof { Section::Roofs } else { Section::Walls }
    }

    fn after_walls(&mut self, line: &SourceLine<'_>) -> Section {
        let text = &*line.text;
        let span = line.whole(self.reporter.source);
        let Some(blank) = self.house.blank.clone() else {
            // Part codes have no blank in their second column, so most lines end here.
            let roof = text.as_bytes().get(1) == Some(&b' ') && roofs::looks_like_roof(text);
            if roof {
                let start = Span {
                    end: span.start,
                    ..span
                };
                let end = self.reporter.line_end_text();
                self.reporter
                    .say(say::no_blank_line(start, WALLS, ROOFS, end));
            }
            return if roof { Section::Roofs } else { Section::Walls };
        };
        if words::plain_words(text).next().is_some_and(words::numeric) {
            self.new_house(span);
            Section::Header
        } else if looks_like_codes(text) && !roofs::looks_like_roof(text) {
            let blank = self.reporter.source.span(blank);
            let apart = self.house.apart;
            self.reporter.say(say::blank_in_walls(blank, span, apart));
            Section::Walls
        } else {
            Section::Roofs
        }
    }

    fn after_roofs(&mut self, line: &SourceLine<'_>) -> Section {
        let header = words::plain_words(&line.text)
            .next()
            .is_some_and(words::numeric);
        if header && self.house.blank.is_some() {
            self.new_house(line.whole(self.reporter.source));
            return Section::Header;
        }
        Section::Roofs
    }

    /// A header after walls or roofs: the line between two houses was forgotten.
    fn new_house(&mut self, header: Span) {
        let end = self.reporter.line_end_text();
        self.reporter.say(say::no_separator(header, end));
        self.finish_house();
    }

    /// Finishes the current house, unless nothing was written, and prepares for the next.
    fn finish_house(&mut self) {
        let draft = std::mem::take(&mut self.house);
        let (Some(span), mut walls, mut house) = (draft.span, draft.walls, draft.house) else {
            return;
        };
        if !walls.begun() {
            self.reporter.say(say::no_walls(span));
        }
        house.span = span;
        house.storeys = walls.finish(&mut self.reporter);
        house.heights.shrink_to_fit();
        let storeys = house.storeys.len();
        if let Some(surplus) = house
            .heights
            .get(storeys.max(1)..)
            .filter(|s| !s.is_empty())
        {
            let span = surplus
                .iter()
                .fold(surplus[0].span, |all, h| all.to(h.span));
            let all = self.reporter.with_blanks(span);
            let heights = house.heights.len();
            self.reporter
                .say(say::surplus_heights(span, all, heights, storeys));
        }
        draft.header.judge(&house, storeys, &mut self.reporter);
        self.document.houses.push(house);
    }
}

/// Returns true if a line begins with an XML tag; no line of a legacy file does.
fn is_tag(line: &str) -> bool {
    let mut chars = line.trim_start().chars();
    chars.next() == Some('<')
        && chars
            .next()
            .is_some_and(|c| c.is_ascii_alphabetic() || matches!(c, '?' | '!'))
}

/// Returns the comment mark of another language at the start of a line.
fn other_comment(text: &str) -> Option<&str> {
    let signs = ["//", "/*", ";"];
    signs.into_iter().find(|sign| text.starts_with(sign))
}

/// Returns true if a string looks like the beginning of a wall line: two capitals, points, a control letter, or whole
/// voids before them.
fn looks_like_codes(text: &str) -> bool {
    let words = text.trim_start();
    let bytes = words.as_bytes();
    let capitals = bytes.len() > 1 && bytes[..2].iter().all(u8::is_ascii_uppercase);
    let control = words
        .split_whitespace()
        .next()
        .is_some_and(|w| matches!(w, "L" | "R" | "^" | "l" | "r"));
    capitals || control || words.starts_with("..")
}
