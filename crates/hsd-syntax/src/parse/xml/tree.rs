//! The elements of an XML file as a tree with places. It knows the elements of the language only through
//! [`SchemaHints`], and it exists for any file, however malformed.
//!
//! Invariants: ranges are of [`Source::text`](hsd_base::source::Source::text) and lie within it; elements nest at most as
//! deep as the limit says, so that later steps may recurse; children are in the order of the file; runs of white space
//! alone are left out. The tree itself is built and dropped without recursion.

pub(in crate::parse::xml) mod chars;
pub(in crate::parse::xml) mod quotes;
pub(in crate::parse::xml) mod token;
pub(in crate::parse::xml) mod text;
pub(in crate::parse::xml) mod tag;
pub(in crate::parse::xml) mod instruction;
pub(in crate::parse::xml) mod slash;
pub(in crate::parse::xml) mod scan;

use super::suggest::alike;
use crate::parse::reporter::Reporter;
use crate::parse::schema::SchemaHints;
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::scan::Scanner;
use crate::parse::xml::tree::slash::Slashes;
use crate::parse::xml::tree::text::{Run, Text};
use crate::parse::xml::tree::token::Attribute;
use crate::parse::xml::tree::token::{EndTag, StartTag, Token};
use hsd_base::diagnostic::Edit;
use hsd_base::source::Span;
use hsd_ir::messages::xml as say;
use std::collections::HashMap;
use std::ops::Range;

/// The attribute by which a `Place` on an outline hands on the width that its type was made for. No file can set it.
pub(in crate::parse::xml) const MEANT: &str = "hsd:frontage";

/// All elements of a file.
#[derive(Default)]
pub(super) struct Tree<'a> {
    pub(super) elements: Vec<Element<'a>>,
    /// The outermost elements; exactly one in a valid file.
    pub(super) roots: Vec<usize>,
}

impl Tree<'_> {
    /// Shifts all places in the file, since another one precedes it.
    pub(super) fn shift(&mut self, by: usize) {
        let shift = |range: &mut Range<usize>| *range = range.start + by..range.end + by;
        for element in &mut self.elements {
            shift(&mut element.name_range);
            shift(&mut element.tag);
            shift(&mut element.range);
            for attribute in &mut element.attributes {
                shift(&mut attribute.name_range);
                shift(&mut attribute.range);
                attribute.value.shift(by);
            }
            for child in &mut element.children {
                if let Child::Text(text) = child {
                    text.shift(by);
                }
            }
        }
    }
}

/// One element.
pub(super) struct Element<'a> {
    pub(super) name: &'a str,
    pub(super) name_range: Range<usize>,
    /// The start tag.
    pub(super) tag: Range<usize>,
    /// From the start tag to the end tag.
    pub(super) range: Range<usize>,
    pub(super) attributes: Vec<Attribute<'a>>,
    pub(super) children: Vec<Child<'a>>,
    /// True if children were dropped because they are nested too deeply.
    pub(super) cut: bool,
    /// True if it stands in several places of the tree.
    pub(super) shared: bool,
}

impl Element<'_> {
    /// Returns true if it has an attribute of this name.
    pub(super) fn has_attribute(&self, name: &str) -> bool {
        self.attributes.iter().any(|a| a.name == name)
    }
}

/// The content of an element.
#[derive(Clone)]
pub(super) enum Child<'a> {
    /// An element, by its index.
    Element(usize),
    /// A run of text.
    Text(Text<'a>),
}

/// Reads a file from an offset.
pub(super) fn read<'a>(
    reporter: &mut Reporter<'a>,
    at: usize,
    nesting: usize,
    habits: SchemaHints,
) -> Tree<'a> {
    let text = &reporter.source.text().as_bytes()[at..];
    let tags = text.iter().filter(|byte| **byte == b'<').count();
    let mut builder = Builder {
        tree: Tree {
            // Room for all of a usual file; what is nothing but tags does not get that much.
            elements: Vec::with_capacity(tags.min(text.len() / 16)),
            roots: vec![],
        },
        open: vec![],
        counts: None,
        run: Run::default(),
        nesting,
        habits,
        slashes: Slashes::new(),
    };
    let mut scanner = Scanner::new(reporter, at, habits);
    while let Some(token) = scanner.token() {
        let (at, text) = (scanner.at, scanner.text);
        let reporter = &mut *scanner.reporter;
        match token {
            Token::Text(range) => builder.text(range, true, reporter),
            Token::Verbatim(range) => builder.text(range, false, reporter),
            Token::Start(tag) => builder.start(tag, &text[at..], reporter),
            Token::End(tag) => builder.end(&tag, &text[at..], reporter),
        }
    }
    builder.finish(reporter);
    builder.tree
}

/// An element whose end tag has not been read yet.
struct Open<'a> {
    name: &'a str,
    name_range: Range<usize>,
    /// The end of its start tag.
    inside: usize,
    /// `None` = it is not in the tree, being nested too deep.
    element: Option<usize>,
}

struct Builder<'a> {
    tree: Tree<'a>,
    open: Vec<Open<'a>>,
    /// The number of open elements by name, from the first end tag of another than the innermost one on, so that stray ones
    /// cost no search.
    counts: Option<HashMap<&'a str, usize>>,
    run: Run<'a>,
    nesting: usize,
    habits: SchemaHints,
    slashes: Slashes,
}

impl<'a> Builder<'a> {
    fn text(&mut self, range: Range<usize>, raw: bool, reporter: &mut Reporter<'a>) {
        let inside = self.open.last().is_some_and(|o| o.element.is_some());
        let whole = reporter.source.text();
        if inside && range.is_empty() {
            return;
        }
        if inside && raw {
            self.run.raw(range, reporter);
        } else if inside {
            self.run.literal(whole, range);
        } else if self.open.is_empty() {
            let text = &whole[range.clone()];
            let start = range.start + text.len() - text.trim_start_matches(is_blank).len();
            let end = start + text.trim_matches(is_blank).len();
            if start < end {
                self.outside(start..end, reporter);
            } else if !raw {
                self.outside(range.start - 9..range.end + 3, reporter);
            }
        }
    }

    /// Reports text that is in no element.
    fn outside(&self, range: Range<usize>, reporter: &mut Reporter<'a>) {
        // A lone `<` was reported as a malformed tag.
        if &reporter.source.text()[range.clone()] == "<" {
            return;
        }
        let written = reporter.quote(&range);
        reporter.at(&range, |s| say::text_outside(s, written));
    }

    /// Ends the current run of text.
    fn flush(&mut self) {
        let text = self.run.take();
        let Some(text) = text.filter(|t| !t.as_str().trim_matches(is_blank).is_empty()) else {
            return;
        };
        if let Some(parent) = self.open.last().and_then(|o| o.element) {
            self.tree.elements[parent].children.push(Child::Text(text));
        }
    }

    fn start(&mut self, tag: StartTag<'a>, rest: &str, reporter: &mut Reporter<'a>) {
        self.flush();
        let twin = self.open.last().is_some_and(|o| o.name == tag.name);
        if twin && self.is_end_without_slash(&tag, rest) {
            if let Some(open) = self.pop(tag.range.end) {
                let start = reporter.span(&open.name_range);
                reporter.at(&tag.range, |s| say::slash_forgotten(s, tag.name, start));
            }
            return;
        }
        if twin && (self.habits.alone)(tag.name) {
            let next = reporter.span(&tag.name_range);
            self.unfinished(tag.range.start, Some((next, tag.name)), reporter);
        }
        let place = self.place(&tag, reporter);
        // A leaf whose `>` is missing would swallow what follows, unless its end tag does follow.
        let own_end = rest
            .strip_prefix("</")
            .is_some_and(|r| r.starts_with(tag.name));
        let empty = tag.empty || (!tag.closed && (self.habits.leaf)(tag.name) && !own_end);
        let (name, name_range, inside) = (tag.name, tag.name_range.clone(), tag.range.end);
        let element = place.then(|| self.add(tag));
        if !empty {
            if let Some(counts) = &mut self.counts {
                *counts.entry(name).or_default() += 1;
            }
            self.open.push(Open {
                name,
                name_range,
                inside,
                element,
            });
        }
    }

    /// Returns true if a start tag directly inside an element of the same name was meant to close that element.
    fn is_end_without_slash(&mut self, tag: &StartTag<'a>, rest: &str) -> bool {
        if tag.empty || !tag.closed || !tag.attributes.is_empty() {
            return false;
        }
        let open = self.open.iter().map(|o| o.name);
        self.slashes.forgotten(tag.name, rest, open, self.habits)
    }

    /// Returns true if an element is added to the tree; excessive nesting is reported.
    fn place(&mut self, tag: &StartTag<'a>, reporter: &mut Reporter<'a>) -> bool {
        let Some(parent) = self.open.last() else {
            return self.nesting > 0; // a second one is reported at the end
        };
        let fits = self.open.len() < self.nesting;
        if let (false, Some(parent)) = (fits, parent.element) {
            self.tree.elements[parent].cut = true;
            reporter.at(&tag.name_range, |s| say::nested_too_deep(s, self.nesting));
        }
        fits && parent.element.is_some()
    }

    fn add(&mut self, tag: StartTag<'a>) -> usize {
        let index = self.tree.elements.len();
        match self.open.last().and_then(|o| o.element) {
            Some(parent) => self.tree.elements[parent]
                .children
                .push(Child::Element(index)),
            None => self.tree.roots.push(index),
        }
        self.tree.elements.push(Element {
            name: tag.name,
            name_range: tag.name_range,
            range: tag.range.clone(),
            tag: tag.range,
            attributes: tag.attributes,
            children: vec![],
            cut: false,
            shared: false,
        });
        index
    }

    fn end(&mut self, tag: &EndTag<'a>, rest: &str, reporter: &mut Reporter<'a>) {
        self.flush();
        let innermost = self.open.last().is_some_and(|o| o.name == tag.name);
        if innermost || self.is_open(tag.name) {
            let here = reporter.span(&tag.range);
            while self.open.last().is_some_and(|o| o.name != tag.name) {
                self.unfinished(tag.range.start, Some((here, tag.name)), reporter);
            }
            self.pop(tag.range.end);
        } else if self.is_misspelt(tag, rest) {
            if let Some(open) = self.pop(tag.range.end) {
                // If the end tag is right and the start tag wrong, the next step reports that one; in a rule that is where a map is
                // read, which `fmt` does not do.
                let known = self.habits.known;
                let waits = self.open.iter().any(|o| o.name == "for");
                let told_later = !known(open.name) && known(tag.name) && alike(open.name, tag.name);
                if waits || !told_later {
                    let start = reporter.span(&open.name_range);
                    reporter.at(&tag.range, |s| {
                        say::end_differs(s, tag.name, open.name, start)
                    });
                }
            }
        } else {
            let inside = self.open.last();
            let inside = inside.map(|o| (o.name, reporter.span(&o.name_range)));
            reporter.at(&tag.range, |s| say::stray_end(s, tag.name, inside));
        }
    }

    /// Returns true if an element of this name is open.
    fn is_open(&mut self, name: &str) -> bool {
        let counts = self.counts.get_or_insert_with(|| {
            let mut counts = HashMap::new();
            let open = self.open.iter().map(|open| open.name);
            open.for_each(|name| *counts.entry(name).or_default() += 1);
            counts
        });
        counts.get(name).is_some_and(|count| *count > 0)
    }

    /// Returns true if an end tag that closes nothing was meant for the innermost element: it has no name, nearly that
    /// element's name, or is followed by the end of the enclosing element.
    fn is_misspelt(&self, tag: &EndTag<'_>, rest: &str) -> bool {
        let Some(innermost) = self.open.last() else {
            return false;
        };
        let rest = rest.trim_start();
        let outer = match self.open.len() {
            1 => rest.is_empty(),
            n => rest
                .strip_prefix("</")
                .and_then(|r| r.strip_prefix(self.open[n - 2].name))
                .is_some_and(|r| r.starts_with('>')),
        };
        tag.name.is_empty() || outer || alike(tag.name, innermost.name)
    }

    /// Closes the innermost element, whose end tag is missing; `before` = the tag that shows it.
    fn unfinished(
        &mut self,
        end: usize,
        before: Option<(Span, &str)>,
        reporter: &mut Reporter<'a>,
    ) {
        let Some(open) = self.pop(end) else { return };
        let leaf = (self.habits.leaf)(open.name);
        let (at, text) = match reporter.wanted() {
            true => closing(reporter.source.text(), &open, end, leaf),
            false => (end, String::new()),
        };
        let fix = Edit::new(reporter.span(&(at..at)), text);
        reporter.at(&open.name_range, |s| {
            say::not_closed(s, open.name, before, fix)
        });
    }

    fn pop(&mut self, end: usize) -> Option<Open<'a>> {
        let open = self.open.pop()?;
        if let Some(counts) = &mut self.counts {
            counts.entry(open.name).and_modify(|n| *n -= 1);
        }
        if let Some(element) = open.element {
            self.tree.elements[element].range.end = end;
        }
        Some(open)
    }

    fn finish(&mut self, reporter: &mut Reporter<'a>) {
        self.flush();
        let end = reporter.source.text().len();
        while !self.open.is_empty() {
            self.unfinished(end, None, reporter);
        }
        match self.tree.roots[..] {
            [] => reporter.at(&(end..end), say::no_element),
            [_] => {}
            [first, ..] => self.several(first, reporter),
        }
    }

    /// Reports all outermost elements except the first.
    fn several(&self, first: usize, reporter: &mut Reporter<'a>) {
        let roots = self
            .tree
            .roots
            .iter()
            .map(|root| &self.tree.elements[*root]);
        let names: Vec<&str> = roots.clone().map(|r| r.name).collect();
        let start = self.tree.elements[first].range.start;
        let end = roots.clone().map(|r| r.range.end).max().unwrap_or(start);
        let edits = (self.habits.around)(&names).map(|name| {
            let edit = |at: usize, text: String| Edit::new(reporter.span(&(at..at)), text);
            let tags = (format!("<{name}>\n"), format!("\n</{name}>"));
            vec![edit(start, tags.0), edit(end, tags.1)]
        });
        let first = reporter.span(&self.tree.elements[first].name_range);
        for root in roots.skip(1) {
            reporter.at(&root.name_range, |s| {
                say::second_root(s, root.name, first, edits.clone())
            });
        }
    }
}

/// Returns the fix that closes an element without an end tag, before `end`: on the line of the preceding content, or on
/// a line of its own if its content has lines of its own; for a leaf, in its start tag.
fn closing(text: &str, open: &Open<'_>, end: usize, leaf: bool) -> (usize, String) {
    /// The maximum length of an element on one line.
    const LINE: usize = 1 << 16;
    let tag = text[..open.inside].trim_end_matches(['>', '＞']);
    if leaf && tag.len() < open.inside {
        return (tag.len(), "/".to_owned());
    }
    let name = open.name;
    let before = text[..end].trim_end_matches(is_blank);
    let gap = &text[before.len()..end];
    let break_ = match gap.contains("\r\n") {
        true => "\r\n",
        false => "\n",
    };
    if !gap.contains('\n') && end < text.len() {
        return (end, format!("</{name}>"));
    }
    let start = open.name_range.start;
    let inside = text[..before.len()].get(start..).unwrap_or_default();
    if inside.len() < LINE && !inside.contains('\n') {
        return (before.len(), format!("</{name}>"));
    }
    // The white space before the tag on its line, if there is nothing else.
    let before_tag = text[..start].trim_end_matches('<');
    let line = before_tag.trim_end_matches([' ', '\t']);
    let indent = match line.ends_with('\n') {
        true => &before_tag[line.len()..],
        false => "",
    };
    (before.len(), format!("{break_}{indent}</{name}>"))
}
