//! A text as its author sees it: every line, element, attribute, code and expression with its place, before anything is
//! worked out. Editors ask it what stands where; the passes have no use for it.
//!
//! Invariants: ranges are of [`Source::text`] and lie within it, on borders of characters; elements stand in the order
//! of their start tags, each behind the one round it; codes stand in the order of the text. It is there whatever is
//! wrong with the text, and nothing is said of that: [`parse`](super::parse) does.

use super::expr;
use super::legacy::{self, LineKind};
use super::xml::{self, schema::Bears, schema::Schema};
use crate::ast::{Document, Item, Piece, Row};
use crate::diagnostic::Diagnostics;
use crate::source::{Limits, Source};
use std::ops::Range;

/// Whether a text may be the name of a value: letters, digits and `_`, and no word of the language.
pub fn is_name(text: &str) -> bool {
    expr::is_name(text) && !expr::RESERVED.contains(&text)
}

/// What stands in one text.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// The lines of the legacy form, without their line ends; none in an XML text.
    pub lines: Vec<Line>,
    /// The elements of the XML form.
    pub elements: Vec<Element>,
    /// The comments of both forms, with their marks.
    pub comments: Vec<Range<usize>>,
}

/// A line of the legacy form.
#[derive(Clone, Debug)]
pub struct Line {
    /// Without its line end.
    pub range: Range<usize>,
    /// What it is for.
    pub kind: LineKind,
    /// The codes of a wall line.
    pub codes: Vec<Range<usize>>,
    /// The letter at the end of a wall line, or its `^`.
    pub turn: Option<Range<usize>>,
}

/// An element of the XML form.
#[derive(Clone, Debug)]
pub struct Element {
    /// What the language knows of it; `None` = it is no word of the language, as those of shape.
    pub schema: Option<&'static Schema>,
    /// Its name in the start tag.
    pub name: Range<usize>,
    /// Its name in the end tag, if it has one.
    pub end_name: Option<Range<usize>>,
    /// The start tag.
    pub tag: Range<usize>,
    /// From the start tag to the end tag.
    pub range: Range<usize>,
    /// In the order of the text.
    pub attributes: Vec<Attribute>,
    /// What stands right in it besides elements.
    pub words: Vec<Words>,
    /// The element round it.
    pub parent: Option<usize>,
}

impl Element {
    /// The attribute of a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.word == name)
    }

    /// What an attribute says.
    pub fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|a| &*a.value)
    }
}

/// `name="value"`.
#[derive(Clone, Debug)]
pub struct Attribute {
    /// What the language knows of it.
    pub bears: Option<&'static Bears>,
    /// The name it stands for: `texturecode` is `code`.
    pub word: String,
    /// The name as written.
    pub name: Range<usize>,
    /// What stands between the quotes.
    pub inner: Range<usize>,
    /// Name, `=` and value with its quotes.
    pub range: Range<usize>,
    /// The value without references.
    pub value: String,
    /// What is computed in it.
    pub expressions: Vec<Expression>,
}

/// A run of text in an element.
#[derive(Clone, Debug)]
pub struct Words {
    /// From its first character that is no white space to its last.
    pub range: Range<usize>,
    /// Codes of five columns, or fewer at a line's end.
    pub codes: Vec<Range<usize>>,
    /// What is computed in it.
    pub expressions: Vec<Expression>,
}

/// What stands in braces.
#[derive(Clone, Debug)]
pub struct Expression {
    /// With its braces.
    pub range: Range<usize>,
    /// The names in it.
    pub names: Vec<Range<usize>>,
}

impl Expression {
    /// The expression between these braces; `at` = where the text of the place begins that holds it.
    pub(super) fn new(inner: &str, range: Range<usize>) -> Expression {
        let start = range.start + 1;
        let names = expr::names(inner).into_iter();
        Expression {
            names: names.map(|n| start + n.start..start + n.end).collect(),
            range,
        }
    }
}

impl Outline {
    /// The outline of a text of either form.
    pub fn of(source: &Source, limits: &Limits) -> Outline {
        let text = source.text();
        if source.size() > limits.bytes || super::looks_binary(text) {
            return Outline::default();
        }
        match text.trim_start().chars().next() {
            None => Outline::default(),
            Some('<' | '＜') => xml::outline(source, 0, limits.nesting),
            Some(_) => Outline::of_lines(source, limits),
        }
    }

    /// The outline of a legacy text, and of the XML text that may stand behind it.
    fn of_lines(source: &Source, limits: &Limits) -> Outline {
        let mut lines = vec![];
        let mut out = Diagnostics::new();
        let document = legacy::parse_lines(source, limits, &mut out, &mut |range, kind| {
            lines.push(Line {
                range,
                kind,
                codes: vec![],
                turn: None,
            });
        });
        let rest = lines.last().map_or(0, |l: &Line| l.range.end);
        let behind = source.text()[rest..].trim_start();
        let mut outline = match behind.is_empty() {
            true => Outline::default(),
            false => xml::outline(source, source.text().len() - behind.len(), limits.nesting),
        };
        let comments = lines.iter().filter(|l| l.kind == LineKind::Comment);
        let comments: Vec<Range<usize>> = comments.map(|l| l.range.clone()).collect();
        outline.comments.splice(0..0, comments);
        for row in rows(&document) {
            let place = source.text_range(row.span);
            let line = lines.partition_point(|l| l.range.end < place.start);
            if let Some(line) = lines.get_mut(line).filter(|l| l.kind == LineKind::Wall) {
                line.fill(source, row);
            }
        }
        lines.iter_mut().for_each(|line| line.end(source.text()));
        outline.lines = lines;
        outline
    }

    /// The innermost element whose range holds an offset; at a border the one that begins there.
    pub fn element_at(&self, at: usize) -> Option<usize> {
        let last = self.elements.partition_point(|e| e.range.start <= at);
        let mut next = last.checked_sub(1);
        while let Some(index) = next {
            let element = &self.elements[index];
            if at < element.range.end || (at == element.range.end && element.end_name.is_none()) {
                return Some(index);
            }
            next = element.parent;
        }
        None
    }

    /// The line of the legacy form at an offset.
    pub fn line_at(&self, at: usize) -> Option<usize> {
        let index = self.lines.partition_point(|l| l.range.end < at);
        self.lines
            .get(index)?
            .range
            .contains(&at)
            .then_some(index)
            .or_else(|| (self.lines[index].range.end == at).then_some(index))
    }

    /// An element and those round it, from the inside out.
    pub fn around(&self, element: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(element), |e| self.elements[*e].parent)
    }

    /// Whether an offset lies in a comment.
    pub fn in_comment(&self, at: usize) -> bool {
        let next = self.comments.partition_point(|c| c.end < at);
        let hit = self.comments.get(next);
        hit.is_some_and(|c| c.start < at && at <= c.end)
    }
}

impl Line {
    fn fill(&mut self, source: &Source, row: &Row) {
        for item in &row.pieces {
            if let Item::One(piece) = item
                && let Some(code) = piece.code()
            {
                self.codes.push(source.text_range(code.span));
            } else if let Item::One(Piece::Error(span)) = item {
                self.codes.push(source.text_range(*span));
            }
        }
        let turn = row.turn.as_ref().map(|t| source.text_range(t.span));
        self.turn = turn.filter(|t| !t.is_empty());
    }

    /// Takes the `^` that ends a storey, which is no turn of its row.
    fn end(&mut self, text: &str) {
        let written = text[self.range.clone()].trim_end();
        if self.kind == LineKind::Wall && self.turn.is_none() && written.ends_with('^') {
            let end = self.range.start + written.len();
            let free = self.codes.last().is_none_or(|c| c.end < end);
            self.turn = free.then_some(end - 1..end);
        }
    }
}

/// The rows that a legacy document has, in the order of the text.
fn rows(document: &Document) -> impl Iterator<Item = &Row> {
    let storeys = document.houses.iter().flat_map(|h| &h.storeys);
    let loops = storeys.filter_map(one).flat_map(|s| &s.loops);
    loops.flat_map(|l| &l.rows).filter_map(one)
}

fn one<T>(item: &Item<T>) -> Option<&T> {
    match item {
        Item::One(thing) => Some(thing),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::FileId;

    fn outline(text: &str) -> Outline {
        let source = Source::new(FileId(0), "家.hsd", text.as_bytes());
        Outline::of(&source, &Limits::default())
    }

    #[test]
    fn lines_have_codes_and_turns() {
        let text = "# 町家\n0 0 180\n9.0\n\nGSI  2TOD L\nKKS\n";
        let outline = outline(text);
        let kinds: Vec<LineKind> = outline.lines.iter().map(|l| l.kind).collect();
        use LineKind::{Blank, Comment, Header, Wall};
        assert_eq!(kinds, [Comment, Header, Header, Blank, Wall, Wall]);
        let wall = &outline.lines[4];
        let codes: Vec<&str> = wall.codes.iter().map(|c| &text[c.clone()]).collect();
        assert_eq!(codes, ["GSI  ", "2TOD "]);
        assert_eq!(wall.turn.clone().map(|t| &text[t]), Some("L"));
        assert_eq!(outline.comments.first(), Some(&(0..8)));
    }

    #[test]
    fn elements_have_places_even_in_broken_files() {
        let text = "<House name='家'><Storey><Row>KSK  {a + b}<!-- x --></Row><use name='&lt;{n}' w=\"{2 * d}\"";
        let outline = outline(text);
        let names: Vec<&str> = outline
            .elements
            .iter()
            .map(|e| &text[e.name.clone()])
            .collect();
        assert_eq!(names, ["House", "Storey", "Row", "use"]);
        let row = &outline.elements[2];
        assert_eq!(row.parent, Some(1));
        assert_eq!(row.end_name.clone().map(|n| &text[n]), Some("Row"));
        assert_eq!(&text[row.words[0].codes[0].clone()], "KSK  ");
        let names = &row.words[0].expressions[0].names;
        let names: Vec<&str> = names.iter().map(|n| &text[n.clone()]).collect();
        assert_eq!(names, ["a", "b"]);
        let used = &outline.elements[3];
        assert_eq!(used.value("name"), Some("<{n}"));
        let name = used.attribute("w").expect("is there").expressions[0].names[0].clone();
        assert_eq!(&text[name], "d");
        assert_eq!(outline.comments.len(), 1);
        assert_eq!(outline.element_at(row.words[0].range.start), Some(2));
    }
}
