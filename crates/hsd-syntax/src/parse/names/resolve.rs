//! Fills the table: finds the names in the outlines of source files, and those that mean the same, by the scoping rules
//! of [`xml`](crate::parse::xml).
//!
//! Names of one frame are one symbol however often they are defined there: the branches of an `if` define one each. The
//! parameters of definitions that one `use` may mean are one symbol too, since its attributes set them all.

use super::SymbolKind;
use super::file::{File, named, parameters, trimmed, word};
use super::ids;
use super::links::Links;
use super::scopes::{Binding, Definition, Frames};
use super::table::{NameTable, Occurrence, Role};
use crate::parse::syntax::{Attribute, Element};
use hsd_base::source::FileId;
use std::collections::BTreeMap;
use std::ops::Range;

/// Resolves the names of source files, the first of which includes the others.
pub fn resolve(files: &[File<'_>], links: &Links) -> NameTable {
    let mut resolver = Resolver {
        files,
        index: NameTable::default(),
        parameters: BTreeMap::new(),
    };
    for number in 0..files.len() {
        resolver.declare(number);
    }
    resolver.include(links);
    for number in 0..files.len() {
        resolver.resolve(number);
    }
    let mut index = resolver.index;
    for number in 0..index.marks.len() {
        index.marks[number].symbol = index.root(index.marks[number].symbol);
    }
    let key = |m: &Occurrence| (m.file, m.range.start, m.range.end, m.symbol, m.role);
    index.marks.sort_by_key(key);
    index.marks.dedup();
    index
}

struct Resolver<'a> {
    files: &'a [File<'a>],
    index: NameTable,
    /// The parameters of each definition, by name.
    parameters: BTreeMap<usize, BTreeMap<String, usize>>,
}

/// Returns the attribute of a repetition that names its rounds, and the name.
fn round(text: &str, element: &Element) -> Option<(usize, Range<usize>)> {
    let mut all = element.attributes.iter().enumerate();
    let (number, index) = all.find(|(_, a)| a.word == "index" && word(element) == "repeat")?;
    Some((number, trimmed(text, index)?))
}

/// Returns true for elements that are transparent: they stand for their content.
fn is_open(word: &str) -> bool {
    matches!(word, "if" | "else" | "choice" | "random")
}

impl<'a> Resolver<'a> {
    /// Collects the frames of a file, and the names in them.
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
        for (own, element) in elements.iter().enumerate() {
            names[own] |= round(self.files[number].text, element).is_some();
        }
        let scopes = &mut self.index.scopes;
        let outermost = scopes.frame(None, false);
        scopes.of.push(Frames {
            outermost,
            ..Frames::default()
        });
        for (own, element) in elements.iter().enumerate() {
            let scopes = &mut self.index.scopes;
            let around = element
                .parent
                .map_or(outermost, |p| scopes.of[number].inside[p]);
            let inside = match word(element) {
                "define" => scopes.frame(Some(around), true),
                word if is_open(word) || !names[own] => around,
                _ => scopes.frame(Some(around), false),
            };
            scopes.of[number].around.push(around);
            scopes.of[number].inside.push(inside);
            self.declared(number, own);
        }
    }

    /// Records the name that an element defines.
    fn declared(&mut self, number: usize, own: usize) {
        let file = self.files[number];
        let element = &file.outline.elements[own];
        let frames = &self.index.scopes.of[number];
        let (around, inside) = (frames.around[own], frames.inside[own]);
        let given = |attribute: usize, from: usize| Definition {
            file: number,
            element: own,
            attribute,
            from,
        };
        let name = named(file.text, element);
        match (word(element), name) {
            ("let" | "Param", Some((attribute, range))) => {
                let parent = element.parent.map(|p| &file.outline.elements[p]);
                let of_piece = parent.is_some_and(|p| word(p) == "define");
                let kind = match of_piece && word(element) == "Param" {
                    true => SymbolKind::Parameter,
                    false => SymbolKind::Value,
                };
                let name = &file.text[range.clone()];
                self.give(kind, around, range, given(attribute, element.range.end));
                if let Some(parent) = parent.filter(|_| kind == SymbolKind::Parameter) {
                    let home = self.index.scopes.of[number].around[element.parent.unwrap_or(0)];
                    self.parameter_of(file, parent, home, name, around);
                }
            }
            ("repeat", _) => {
                if let Some((attribute, range)) = round(file.text, element) {
                    let from = element.attributes[attribute].range.end;
                    self.give(SymbolKind::Value, inside, range, given(attribute, from));
                }
            }
            ("define", name) => {
                for (number, _, attribute) in parameters(file.text, element) {
                    let given = given(number, attribute.range.end);
                    let range = attribute.name.clone();
                    self.give(SymbolKind::Parameter, inside, range, given);
                }
                let Some((attribute, range)) = name else {
                    return;
                };
                self.give(SymbolKind::Piece, around, range, given(attribute, 0));
                for (_, name, _) in parameters(file.text, element) {
                    self.parameter_of(file, element, around, name, inside);
                }
            }
            _ => {}
        }
    }

    /// Records that a definition in the frame `home` has a parameter known in the frame `inside`.
    fn parameter_of(
        &mut self,
        file: File<'_>,
        piece: &Element,
        home: usize,
        name: &str,
        inside: usize,
    ) {
        let called = piece.attribute("name").and_then(|a| trimmed(file.text, a));
        let frames = &self.index.scopes.frames;
        let called = called.and_then(|r| frames[home].pieces.get(&file.text[r]));
        let value = frames[inside].values.get(name);
        if let (Some(piece), Some(value)) = (called, value) {
            let (piece, value) = (piece.symbol, value.symbol);
            let list = self.parameters.entry(piece).or_default();
            let first = *list.entry(name.to_owned()).or_insert(value);
            self.index.join(first, value);
        }
    }

    /// Records the name of a value or a definition in a frame.
    fn give(&mut self, kind: SymbolKind, frame: usize, range: Range<usize>, given: Definition) {
        let file = self.files[given.file];
        let name = &file.text[range.clone()];
        let known = &mut self.index.scopes.frames[frame];
        let list = match kind {
            SymbolKind::Piece => &mut known.pieces,
            _ => &mut known.values,
        };
        let symbol = match list.get_mut(name) {
            Some(known) => {
                known.given.push(given);
                known.symbol
            }
            None => {
                let symbol = self.index.symbols.len();
                let given = vec![given];
                list.insert(name.to_owned(), Binding { symbol, given });
                self.index.add(kind, name)
            }
        };
        self.mark(file.id, range, symbol, Role::Declares);
    }

    fn mark(&mut self, file: FileId, range: Range<usize>, symbol: usize, role: Role) {
        self.index.marks.push(Occurrence {
            file,
            range,
            symbol,
            role,
        });
    }

    /// Connects frames to those of the files that they include, and records the files as symbols.
    fn include(&mut self, links: &Links) {
        let mut files: BTreeMap<usize, usize> = BTreeMap::new();
        for link in &links.list {
            let (file, target) = (self.files[link.from], self.files[link.to]);
            let element = &file.outline.elements[link.element];
            let scopes = &mut self.index.scopes;
            let around = scopes.of[link.from].around[link.element];
            if let Some(export) = scopes.of[link.to].inside.first() {
                let export = (*export, element.range.end);
                scopes.frames[around].files.push(export);
            }
            let symbol = *files
                .entry(link.to)
                .or_insert_with(|| self.index.add(SymbolKind::File, target.name));
            self.mark(file.id, link.range.clone(), symbol, Role::Uses);
        }
    }

    /// Resolves the names of a file.
    fn resolve(&mut self, number: usize) {
        let file = self.files[number];
        for (own, element) in file.outline.elements.iter().enumerate() {
            let frames = &self.index.scopes.of[number];
            let (around, inside) = (frames.around[own], frames.inside[own]);
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
        ids::marks(file, &mut self.index);
    }

    /// Resolves a name in an expression.
    fn name(&mut self, file: File<'_>, frame: usize, range: &Range<usize>) {
        let scopes = &self.index.scopes;
        let value = scopes.value(frame, &file.text[range.clone()], range.start);
        if let Some(symbol) = value {
            self.mark(file.id, range.clone(), symbol, Role::Uses);
        }
    }

    /// Resolves a `use`: the definitions that it may mean, and their parameters.
    fn used(&mut self, file: File<'_>, element: &Element, around: usize) {
        let Some(attribute) = element.attribute("name") else {
            return;
        };
        let Some(range) = trimmed(file.text, attribute) else {
            return;
        };
        let (text, scopes) = (&file.text[range.clone()], &self.index.scopes);
        let (pieces, role) = if attribute.expressions.is_empty() {
            (Vec::from_iter(scopes.piece(around, text)), Role::Uses)
        } else {
            let literals = literals(file.text, &range, attribute);
            let all = scopes.pieces(around).into_iter();
            let like = all.filter(|(name, _)| is_like(name, &literals));
            (like.map(|(_, p)| p.symbol).collect(), Role::Computed)
        };
        for piece in &pieces {
            self.mark(file.id, range.clone(), *piece, role);
        }
        for (_, name, attribute) in parameters(file.text, element) {
            let all = pieces
                .iter()
                .filter_map(|p| self.parameters.get(p)?.get(name));
            let all: Vec<usize> = all.copied().collect();
            let Some(first) = all.first() else { continue };
            all.iter().for_each(|other| self.index.join(*first, *other));
            self.mark(file.id, attribute.name.clone(), *first, Role::Uses);
        }
    }
}

/// Returns the strings between the expressions of a value.
fn literals<'t>(text: &'t str, range: &Range<usize>, attribute: &Attribute) -> Vec<&'t str> {
    let (mut found, mut at) = (vec![], range.start);
    for expression in &attribute.expressions {
        found.push(text.get(at..expression.range.start).unwrap_or_default());
        at = expression.range.end;
    }
    found.push(text.get(at..range.end).unwrap_or_default());
    found
}

/// Returns true if a name contains these strings in order, the first at its start and the last at its end.
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
