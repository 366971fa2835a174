//! Which names stand where, and which of them mean the same: the scopes of [`language`](crate::parse::xml) seen from
//! outside, on the outlines of a text and of the files that were read for it.
//!
//! Names of one frame are one symbol however often they are given there: the branches of an `if` give one each. The
//! parameters of pieces that one `use` may mean are one symbol too, since its attributes set them all.

use super::SymbolKind;
use super::links::Links;
use crate::parse::outline::{Attribute, Element, Outline};
use crate::source::FileId;
use std::collections::BTreeMap;
use std::ops::Range;

/// What a mark does with its symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    /// Names it.
    Declares,
    /// Means it.
    Uses,
    /// May mean it: the name is worked out.
    Computed,
}

/// A name in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mark {
    pub(super) file: FileId,
    pub(super) range: Range<usize>,
    pub(super) symbol: usize,
    pub(super) role: Role,
}

/// What a name means.
#[derive(Clone, Debug)]
pub(super) struct Named {
    pub(super) kind: SymbolKind,
    pub(super) name: String,
    /// From where on it is known in its frame.
    from: usize,
}

/// A file as the index needs it.
#[derive(Clone, Copy)]
pub(super) struct File<'a> {
    pub(super) id: FileId,
    pub(super) name: &'a str,
    pub(super) text: &'a str,
    pub(super) outline: &'a Outline,
}

/// All names of a text and of the files that were read for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    pub(super) symbols: Vec<Named>,
    /// By file and place.
    pub(super) marks: Vec<Mark>,
    /// Which symbol stands for one, where several turned out to be the same.
    same: Vec<usize>,
}

/// What is named in an element.
#[derive(Default)]
struct Frame {
    outer: Option<usize>,
    /// Whether it is that of a piece: what stands round it counts as it is where the piece is used.
    piece: bool,
    values: BTreeMap<String, usize>,
    pieces: BTreeMap<String, usize>,
    /// The frames of included files, and from where on.
    files: Vec<(usize, usize)>,
}

/// The frames of one file: round each element, and in it.
#[derive(Default)]
struct Frames {
    around: Vec<usize>,
    inside: Vec<usize>,
}

struct Maker<'a> {
    files: &'a [File<'a>],
    frames: Vec<Frame>,
    of: Vec<Frames>,
    index: Index,
    /// The parameters of each piece, by name.
    parameters: BTreeMap<usize, BTreeMap<String, usize>>,
}

impl Index {
    /// The names of some files.
    pub(super) fn of(files: &[File<'_>], links: &Links) -> Index {
        let mut maker = Maker {
            files,
            frames: vec![],
            of: vec![],
            index: Index::default(),
            parameters: BTreeMap::new(),
        };
        for number in 0..files.len() {
            maker.declare(number);
        }
        maker.include(links);
        for number in 0..files.len() {
            maker.resolve(number);
        }
        let mut index = maker.index;
        for number in 0..index.marks.len() {
            index.marks[number].symbol = index.root(index.marks[number].symbol);
        }
        let key = |m: &Mark| (m.file, m.range.start, m.range.end, m.symbol, m.role);
        index.marks.sort_by_key(key);
        index.marks.dedup();
        index
    }

    fn root(&self, mut symbol: usize) -> usize {
        while self.same[symbol] != symbol {
            symbol = self.same[symbol];
        }
        symbol
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.same[one.max(other)] = one.min(other);
    }

    pub(super) fn add(&mut self, kind: SymbolKind, name: &str, from: usize) -> usize {
        self.same.push(self.symbols.len());
        self.symbols.push(Named {
            kind,
            name: name.to_owned(),
            from,
        });
        self.symbols.len() - 1
    }

    /// The marks at an offset, those with the shortest range.
    pub(super) fn at(&self, file: FileId, at: usize) -> impl Iterator<Item = &Mark> {
        let touches = move |m: &&Mark| m.range.start <= at && at <= m.range.end;
        let marks = self.in_file(file).iter().filter(touches);
        // Between two names the one that begins here counts.
        let better = move |m: &&Mark| (m.range.end == at && m.range.start < at, m.range.len());
        let best = marks.clone().map(|m| better(&m)).min();
        marks.filter(move |m| Some(better(m)) == best)
    }

    /// The marks of a symbol.
    pub(super) fn of_symbol(&self, symbol: usize) -> impl Iterator<Item = &Mark> {
        self.marks.iter().filter(move |m| m.symbol == symbol)
    }

    fn in_file(&self, file: FileId) -> &[Mark] {
        let start = self.marks.partition_point(|m| m.file < file);
        let end = self.marks.partition_point(|m| m.file <= file);
        &self.marks[start..end]
    }
}

/// Whether it stands for what it holds.
fn is_open(word: &str) -> bool {
    matches!(word, "if" | "else" | "choice" | "random")
}

/// The word of the language that an element is, if it is one.
pub(super) fn word(element: &Element) -> &'static str {
    element.schema.map_or("", |s| s.name)
}

/// The part of a value that is no white space at its ends; `None` where references stand in it or it is empty.
pub(super) fn trimmed(text: &str, attribute: &Attribute) -> Option<Range<usize>> {
    let written = text.get(attribute.inner.clone())?;
    if written != attribute.value || written.trim().is_empty() {
        return None;
    }
    let start = attribute.inner.start + written.len() - written.trim_start().len();
    Some(start..start + written.trim().len())
}

/// The attributes of a `define` or a `use` that are parameters, with their names as written.
pub(super) fn parameters<'e>(
    text: &'e str,
    element: &'e Element,
) -> impl Iterator<Item = (&'e str, &'e Attribute)> {
    let named = |a: &'e Attribute| (&text[a.name.clone()], a);
    let all = element.attributes.iter().map(named);
    all.filter(|(name, _)| *name != "name" && *name != "xmlns" && !name.contains(':'))
}

impl<'a> Maker<'a> {
    fn frame(&mut self, outer: Option<usize>, piece: bool) -> usize {
        self.frames.push(Frame {
            outer,
            piece,
            ..Frame::default()
        });
        self.frames.len() - 1
    }

    /// The frames of a file, and what is named in them.
    fn declare(&mut self, number: usize) {
        let elements = &self.files[number].outline.elements;
        let mut names = vec![false; elements.len()];
        for element in elements {
            let gives = matches!(
                word(element),
                "let" | "Param" | "define" | "include" | "if" | "else" | "random"
            );
            if let Some(parent) = element.parent.filter(|_| gives) {
                names[parent] = true;
            }
        }
        let outermost = self.frame(None, false);
        self.of.push(Frames::default());
        for (own, element) in elements.iter().enumerate() {
            let around = element
                .parent
                .map_or(outermost, |p| self.of[number].inside[p]);
            let inside = match word(element) {
                "define" => self.frame(Some(around), true),
                word if is_open(word) || !names[own] => around,
                _ => self.frame(Some(around), false),
            };
            self.of[number].around.push(around);
            self.of[number].inside.push(inside);
            self.declared(number, element, around, inside);
        }
    }

    /// Takes what an element names.
    fn declared(&mut self, number: usize, element: &Element, around: usize, inside: usize) {
        let file = self.files[number];
        let name = element
            .attribute("name")
            .filter(|a| a.expressions.is_empty());
        let name = name.and_then(|a| trimmed(file.text, a));
        match (word(element), name) {
            ("let" | "Param", Some(range)) => {
                let parent = element.parent.map(|p| &file.outline.elements[p]);
                let of_piece = parent.is_some_and(|p| word(p) == "define");
                let kind = match of_piece && word(element) == "Param" {
                    true => SymbolKind::Parameter,
                    false => SymbolKind::Value,
                };
                let name = &file.text[range.clone()];
                self.value(file, kind, around, range, element.range.end);
                if let Some(parent) = parent.filter(|_| kind == SymbolKind::Parameter) {
                    let home = self.of[number].around[element.parent.unwrap_or(0)];
                    self.parameter_of(file, parent, home, name, around);
                }
            }
            ("define", name) => {
                for (_, attribute) in parameters(file.text, element) {
                    let (range, from) = (attribute.name.clone(), attribute.range.end);
                    self.value(file, SymbolKind::Parameter, inside, range, from);
                }
                let Some(range) = name else { return };
                let text = &file.text[range.clone()];
                let known = self.frames[around].pieces.get(text).copied();
                let symbol = known.unwrap_or_else(|| {
                    let symbol = self.index.add(SymbolKind::Piece, text, 0);
                    self.frames[around].pieces.insert(text.to_owned(), symbol);
                    symbol
                });
                self.mark(file.id, range, symbol, Role::Declares);
                for (name, _) in parameters(file.text, element) {
                    self.parameter_of(file, element, around, name, inside);
                }
            }
            _ => {}
        }
    }

    /// Notes that a piece, defined in the frame `home`, has a parameter that is known in the frame `inside`.
    fn parameter_of(
        &mut self,
        file: File<'_>,
        piece: &Element,
        home: usize,
        name: &str,
        inside: usize,
    ) {
        let called = piece.attribute("name").and_then(|a| trimmed(file.text, a));
        let called = called.and_then(|r| self.frames[home].pieces.get(&file.text[r]));
        let value = self.frames[inside].values.get(name);
        if let (Some(piece), Some(value)) = (called.copied(), value.copied()) {
            let list = self.parameters.entry(piece).or_default();
            let first = *list.entry(name.to_owned()).or_insert(value);
            self.index.join(first, value);
        }
    }

    /// Gives a name to a value in a frame.
    fn value(
        &mut self,
        file: File<'_>,
        kind: SymbolKind,
        frame: usize,
        range: Range<usize>,
        from: usize,
    ) {
        let name = &file.text[range.clone()];
        let known = self.frames[frame].values.get(name).copied();
        let symbol = known.unwrap_or_else(|| {
            let symbol = self.index.add(kind, name, from);
            self.frames[frame].values.insert(name.to_owned(), symbol);
            symbol
        });
        self.mark(file.id, range, symbol, Role::Declares);
    }

    fn mark(&mut self, file: FileId, range: Range<usize>, symbol: usize, role: Role) {
        self.index.marks.push(Mark {
            file,
            range,
            symbol,
            role,
        });
    }

    /// Lets frames know those of the files that they include, and all files their own marks as files.
    fn include(&mut self, links: &Links) {
        let mut files: BTreeMap<usize, usize> = BTreeMap::new();
        for link in &links.list {
            let (file, target) = (self.files[link.from], self.files[link.to]);
            let element = &file.outline.elements[link.element];
            let around = self.of[link.from].around[link.element];
            if let Some(export) = self.of[link.to].inside.first() {
                self.frames[around].files.push((*export, element.range.end));
            }
            let symbol = *files
                .entry(link.to)
                .or_insert_with(|| self.index.add(SymbolKind::File, target.name, 0));
            self.mark(file.id, link.range.clone(), symbol, Role::Uses);
        }
    }

    /// Finds what the names of a file mean.
    fn resolve(&mut self, number: usize) {
        let file = self.files[number];
        for (own, element) in file.outline.elements.iter().enumerate() {
            let (around, inside) = (self.of[number].around[own], self.of[number].inside[own]);
            let word = word(element);
            for attribute in &element.attributes {
                let of_piece = word == "define" && attribute.word != "name";
                let frame = if of_piece { inside } else { around };
                for name in attribute.expressions.iter().flat_map(|e| &e.names) {
                    self.name(file, frame, name);
                }
            }
            let words = element.words.iter().flat_map(|w| &w.expressions);
            for name in words.flat_map(|e| &e.names) {
                self.name(file, inside, name);
            }
            if word == "use" {
                self.used(file, element, around);
            }
        }
        super::floors::marks(file, &mut self.index);
    }

    /// A name in an expression.
    fn name(&mut self, file: File<'_>, frame: usize, range: &Range<usize>) {
        if let Some(symbol) = self.find(frame, &file.text[range.clone()], range.start) {
            self.mark(file.id, range.clone(), symbol, Role::Uses);
        }
    }

    /// What a name means in a frame at a place.
    fn find(&self, frame: usize, name: &str, at: usize) -> Option<usize> {
        let (mut next, mut at) = (Some(frame), Some(at));
        while let Some(index) = next {
            let frame = &self.frames[index];
            let behind = |from: usize| at.is_none_or(|at| from <= at);
            let own = frame.values.get(name).copied();
            let own = own.filter(|s| behind(self.index.symbols[*s].from));
            let found = own.or_else(|| {
                let files = frame.files.iter().filter(|(_, from)| behind(*from));
                let get = |f: &Frame| f.values.get(name).copied();
                files
                    .into_iter()
                    .find_map(|(f, _)| self.exported(*f, get, &mut vec![]))
            });
            if found.is_some() {
                return found;
            }
            // Round a piece counts what is known where it is used, and that is not seen from here.
            if frame.piece {
                at = None;
            }
            next = frame.outer;
        }
        None
    }

    /// What a file says, or those that it includes.
    fn exported(
        &self,
        frame: usize,
        get: impl Fn(&Frame) -> Option<usize> + Copy,
        seen: &mut Vec<usize>,
    ) -> Option<usize> {
        if seen.contains(&frame) {
            return None;
        }
        seen.push(frame);
        let frame = &self.frames[frame];
        let further = || frame.files.iter();
        get(frame).or_else(|| further().find_map(|(f, _)| self.exported(*f, get, seen)))
    }

    /// A `use`: the pieces that it may mean, and their parameters.
    fn used(&mut self, file: File<'_>, element: &Element, around: usize) {
        let Some(attribute) = element.attribute("name") else {
            return;
        };
        let Some(range) = trimmed(file.text, attribute) else {
            return;
        };
        let text = &file.text[range.clone()];
        let (pieces, role) = if attribute.expressions.is_empty() {
            (Vec::from_iter(self.piece(around, text)), Role::Uses)
        } else {
            let literals = literals(file.text, &range, attribute);
            (self.pieces_like(around, &literals), Role::Computed)
        };
        for piece in &pieces {
            self.mark(file.id, range.clone(), *piece, role);
        }
        for (name, attribute) in parameters(file.text, element) {
            let all = pieces
                .iter()
                .filter_map(|p| self.parameters.get(p)?.get(name));
            let all: Vec<usize> = all.copied().collect();
            let Some(first) = all.first() else { continue };
            all.iter().for_each(|other| self.index.join(*first, *other));
            self.mark(file.id, attribute.name.clone(), *first, Role::Uses);
        }
    }

    /// The piece of a name.
    fn piece(&self, frame: usize, name: &str) -> Option<usize> {
        let get = |f: &Frame| f.pieces.get(name).copied();
        let mut frames = std::iter::successors(Some(frame), |f| self.frames[*f].outer);
        frames.find_map(|f| self.exported(f, get, &mut vec![]))
    }

    /// The pieces whose names have these texts in them, in this order, with anything between.
    fn pieces_like(&self, frame: usize, literals: &[&str]) -> Vec<usize> {
        let mut names: BTreeMap<&str, usize> = BTreeMap::new();
        let (mut next, mut seen) = (Some(frame), vec![]);
        while let Some(frame) = next {
            let mut open = vec![frame];
            while let Some(f) = open.pop() {
                if !seen.contains(&f) {
                    seen.push(f);
                    for (name, symbol) in &self.frames[f].pieces {
                        names.entry(name).or_insert(*symbol);
                    }
                    open.extend(self.frames[f].files.iter().map(|(f, _)| *f));
                }
            }
            next = self.frames[frame].outer;
        }
        let fits = |(name, _): &(&str, usize)| is_like(name, literals);
        names.into_iter().filter(fits).map(|(_, s)| s).collect()
    }
}

/// The texts between the expressions of a value.
fn literals<'t>(text: &'t str, range: &Range<usize>, attribute: &Attribute) -> Vec<&'t str> {
    let (mut found, mut at) = (vec![], range.start);
    for expression in &attribute.expressions {
        found.push(text.get(at..expression.range.start).unwrap_or_default());
        at = expression.range.end;
    }
    found.push(text.get(at..range.end).unwrap_or_default());
    found
}

/// Whether a name has these texts in it, the first at its start and the last at its end.
fn is_like(name: &str, literals: &[&str]) -> bool {
    let [first, middle @ .., last] = literals else {
        return false;
    };
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    for literal in middle {
        let Some(at) = rest.find(literal) else {
            return false;
        };
        rest = &rest[at + literal.len()..];
    }
    rest.ends_with(last)
}
