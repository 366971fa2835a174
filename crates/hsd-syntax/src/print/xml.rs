//! Formats an XML file: two blanks per level, one element per line, attributes in the author's order.
//!
//! Nothing here depends on the schema of an element, except which ones contain codes ([`HOLDS_CODES`]): unknown elements
//! and attributes are formatted like any others. Conventions:
//! - an element without content is `<x/>`, one with a single child may stay on one line; quotes and references stay as they are written;
//! - tags that are longer than [`WIDTH`] columns go on in further lines, four blanks in;
//! - blank lines stand where the author put them, one for several, none at the ends of an element;
//! - a comment behind something stays on its line, others get lines of their own; further lines of a comment are
//!   moved with the first;
//! - in and below elements with codes the author's line breaks are kept, since every one divides codes (docs/contract.md 3),
//!   and blanks that are columns stay; only the indentation is made anew. Where such an element holds no text and is
//!   too long for a line, each child gets one.

mod raw;

use std::ops::Range;

use raw::{Element, RawNode};

/// Maximum number of columns of a line.
const WIDTH: usize = 100;

/// Elements whose text is codes of five columns.
const HOLDS_CODES: [&str; 8] = [
    "Row", "Floor", "Side", "fill", "door", "split", "upper", "lower",
];

/// Formats a source file with these line ends; `None` if it is not well-formed. Line breaks in values and in CDATA
/// sections stay as they are.
pub(super) fn format(text: &str, end: &'static str) -> Option<String> {
    let nodes = raw::read(text)?;
    if nodes.iter().any(is_content) {
        return None; // text outside of all elements
    }
    let mut printer = Printer {
        text: String::with_capacity(text.len() + text.len() / 8),
        line: 0,
        flat: false,
        end,
    };
    printer.structure(&nodes, 0);
    printer.push(end);
    Some(printer.text)
}

/// Returns true for verbatim text, and for text that is not only white space.
fn is_content(node: &RawNode<'_>) -> bool {
    match node {
        RawNode::Text(text) => !is_white(text),
        RawNode::Verbatim(_) => true,
        _ => false,
    }
}

fn is_white(text: &str) -> bool {
    text.chars().all(is_blank)
}

/// Returns true for white space that the reader removes around line breaks.
fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{3000}')
}

/// Returns the number of line breaks in white space.
fn breaks(text: &str) -> usize {
    lines(text).count() - 1
}

/// Returns the lines of a source file, whatever their line ends.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| {
        let line = line.strip_suffix('\r').unwrap_or(line);
        line.split('\r')
    })
}

/// Returns the comments of a well-formed file, the last one first: the offsets they belong to, and their lines. One at
/// the end of a line belongs to the line's start.
pub(super) fn comments(text: &str) -> Vec<(usize, Vec<String>)> {
    let mut found = raw::comments(text);
    found.reverse();
    let place = |range: &Range<usize>| {
        let line = text[..range.start].rfind(['\n', '\r']).map_or(0, |i| i + 1);
        let before = text[line..range.start].trim_start_matches(is_blank);
        let after = text[range.end..].split(['\n', '\r']).next();
        let last = after.is_none_or(is_white);
        range.start - if last { before.len() } else { 0 }
    };
    let content = |range: &Range<usize>| {
        let inside = text[range.clone()]
            .trim_start_matches("<!--")
            .trim_end_matches("-->");
        let mut all: Vec<String> = lines(inside).map(|l| l.trim().to_owned()).collect();
        while all.last().is_some_and(String::is_empty) {
            all.pop();
        }
        let first = all.iter().position(|l| !l.is_empty()).unwrap_or(0);
        all.split_off(first)
    };
    found
        .iter()
        .map(|range| (place(range), content(range)))
        .collect()
}

/// Returns the places of the elements of a name in a well-formed file, and the value of their first attribute.
pub(super) fn elements<'a>(text: &'a str, name: &str) -> Vec<(Range<usize>, &'a str)> {
    raw::elements(text, name)
}

struct Printer {
    text: String,
    /// The start of the last line in it.
    line: usize,
    /// True if tags are written without line breaks, for measuring.
    flat: bool,
    /// The line end.
    end: &'static str,
}

impl Printer {
    /// Returns the number of columns of the last line.
    fn column(&self) -> usize {
        columns(&self.text[self.line..])
    }

    fn push(&mut self, text: &str) {
        let before = self.text.len();
        self.text.push_str(text);
        if let Some(at) = text.rfind(['\n', '\r']) {
            self.line = before + at + 1;
        }
    }

    fn new_line(&mut self, depth: usize) {
        self.push(self.end);
        self.blanks(2 * depth);
    }

    fn blanks(&mut self, count: usize) {
        self.text.extend(std::iter::repeat_n(' ', count));
    }

    /// Writes nodes among which white space is insignificant, one per line; the last line is left open.
    fn structure(&mut self, nodes: &[RawNode<'_>], depth: usize) {
        let mut white = 0;
        let mut first = true;
        for node in nodes {
            if let RawNode::Text(text) = node {
                white += breaks(text);
                continue;
            }
            let begins = self.text.is_empty();
            let behind = white == 0 && matches!(node, RawNode::Comment { .. }) && !begins;
            if behind {
                self.push(" ");
            } else if !begins {
                if white > 1 && !first {
                    self.push(self.end);
                }
                self.new_line(depth);
            }
            self.node(node, depth, false);
            (white, first) = (0, false);
        }
    }

    fn node(&mut self, node: &RawNode<'_>, depth: usize, codes: bool) {
        // No letter has more bytes than twice its columns, so the limit is exceeded.
        if self.flat && self.text.len() > 2 * WIDTH {
            return;
        }
        match node {
            RawNode::Text(text) | RawNode::Verbatim(text) | RawNode::Instruction(text) => {
                self.push(text)
            }
            RawNode::Comment { text, column } => self.comment(text, *column),
            RawNode::Element(element) => self.element(element, depth, codes),
        }
    }

    /// Writes an element; `codes` = it is among codes.
    fn element(&mut self, element: &Element<'_>, depth: usize, codes: bool) {
        let children = &element.children;
        if children
            .iter()
            .all(|c| matches!(c, RawNode::Text(text) if is_white(text)))
        {
            return self.tag(element, depth, "/>");
        }
        let codes = codes || HOLDS_CODES.contains(&element.name) || children.iter().any(is_content);
        let broken = children
            .iter()
            .any(|c| matches!(c, RawNode::Text(text) if breaks(text) > 0));
        let may_stay = !broken && (codes || is_single(children));
        let stays = may_stay
            && (self.flat || children.iter().any(is_content) || self.fits(element, depth, codes));
        self.tag(element, depth, ">");
        if stays {
            self.inline(children, depth, codes);
        } else if !codes {
            self.structure(children, depth + 1);
            self.new_line(depth);
        } else if broken {
            self.broken(children, depth);
        } else {
            self.column_of(children, depth);
        }
        self.push("</");
        self.push(element.name);
        self.push(">");
    }

    /// Returns true if an element fits into the line, or breaks the line itself.
    fn fits(&self, element: &Element<'_>, depth: usize, codes: bool) -> bool {
        let mut trial = Printer {
            text: String::new(),
            line: 0,
            flat: true,
            end: "\n",
        };
        trial.element(element, depth, codes);
        let (line, more) = trial.text.split_once('\n').unwrap_or((&trial.text, ""));
        (codes || more.is_empty()) && self.column() + columns(line) <= WIDTH
    }

    /// Writes children in the line of their parent.
    fn inline(&mut self, children: &[RawNode<'_>], depth: usize, codes: bool) {
        for (i, child) in children.iter().enumerate() {
            if !vanishes(children, i) {
                self.node(child, depth, codes);
            }
        }
    }

    /// Writes children without text, one per line.
    fn column_of(&mut self, children: &[RawNode<'_>], depth: usize) {
        for (i, child) in children.iter().enumerate() {
            if !vanishes(children, i) {
                self.new_line(depth + 1);
                self.node(child, depth + 1, true);
            }
        }
        self.new_line(depth);
    }

    /// Writes children in the lines that the author gave them.
    fn broken(&mut self, children: &[RawNode<'_>], depth: usize) {
        // A line break where a run of codes begins or ends moves nothing, unless blanks are there.
        let stays: Vec<usize> = (0..children.len())
            .filter(|i| !vanishes(children, *i))
            .collect();
        let at = |index: Option<&usize>| index.map(|i| &children[*i]);
        let opens = match at(stays.first()) {
            Some(RawNode::Text(text)) => !text.starts_with(is_blank),
            first => matches!(first, Some(RawNode::Element(_))),
        };
        let closes = match at(stays.last()) {
            Some(RawNode::Text(text)) => !text.ends_with(is_blank),
            last => matches!(last, Some(RawNode::Element(_))),
        };
        let (mut pending, mut first) = (usize::from(opens), true);
        for child in stays.iter().map(|i| &children[*i]) {
            let RawNode::Text(text) = child else {
                self.flush(&mut pending, &mut first, depth + 1);
                self.node(child, depth + 1, true);
                continue;
            };
            let last = breaks(text);
            for (k, line) in lines(text).enumerate() {
                pending += usize::from(k > 0);
                let line = if k > 0 {
                    line.trim_start_matches(is_blank)
                } else {
                    line
                };
                let line = if k < last {
                    line.trim_end_matches(is_blank)
                } else {
                    line
                };
                if !line.is_empty() {
                    self.flush(&mut pending, &mut first, depth + 1);
                    self.push(line);
                }
            }
        }
        if pending > 0 || closes {
            self.new_line(depth);
        }
    }

    /// Writes the pending line breaks.
    fn flush(&mut self, pending: &mut usize, first: &mut bool, depth: usize) {
        if *pending > 1 && !*first {
            self.push(self.end);
        }
        if *pending > 0 {
            self.new_line(depth);
        }
        (*pending, *first) = (0, false);
    }

    fn tag(&mut self, element: &Element<'_>, depth: usize, end: &str) {
        self.push("<");
        self.push(element.name);
        let whole: usize = element
            .attributes
            .iter()
            .map(|a| 2 + columns(a.name) + columns(a.value))
            .sum();
        let long = !self.flat && self.column() + whole + end.len() > WIDTH;
        for (i, attribute) in element.attributes.iter().enumerate() {
            let last = i + 1 == element.attributes.len();
            let length = 2 + columns(attribute.name) + columns(attribute.value);
            let length = length + if last { end.len() } else { 0 };
            if long && i > 0 && self.column() + length > WIDTH {
                self.push(self.end);
                self.blanks(2 * depth + 4);
            } else {
                self.push(" ");
            }
            self.push(attribute.name);
            self.push("=");
            self.push(attribute.value);
        }
        self.push(end);
    }

    fn comment(&mut self, text: &str, column: usize) {
        let here = self.column();
        for (i, line) in lines(text).enumerate() {
            if i == 0 {
                self.push(line.trim_end());
                continue;
            }
            self.push(self.end);
            let words = line.trim_start_matches(' ');
            if words.starts_with('\t') {
                self.push(line.trim_end());
            } else if !words.is_empty() {
                let blanks = line.len() - words.len();
                self.blanks((blanks + here).saturating_sub(column));
                self.push(words.trim_end());
            }
        }
    }
}

/// Returns true if the only node besides text is one element that is empty or holds codes.
fn is_single(nodes: &[RawNode<'_>]) -> bool {
    let mut content = nodes.iter().filter(|n| !matches!(n, RawNode::Text(_)));
    match (content.next(), content.next()) {
        (Some(RawNode::Element(e)), None) => e.children.is_empty() || HOLDS_CODES.contains(&e.name),
        _ => false,
    }
}

/// Returns true for white space between elements that cannot be part of a code.
fn vanishes(nodes: &[RawNode<'_>], index: usize) -> bool {
    let joins = |i: Option<usize>| {
        let node = i.and_then(|i| nodes.get(i));
        node.is_some_and(|n| !matches!(n, RawNode::Element(_)))
    };
    matches!(&nodes[index], RawNode::Text(text) if is_white(text) && breaks(text) == 0)
        && !joins(index.checked_sub(1))
        && !joins(Some(index + 1))
}

/// Returns the display width of a string in columns: two for most letters beyond ASCII.
fn columns(text: &str) -> usize {
    if text.is_ascii() {
        return text.len();
    }
    text.chars().map(|c| if c.is_ascii() { 1 } else { 2 }).sum()
}
