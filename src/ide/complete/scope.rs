//! Which names and pieces are known at a place, in this text and the files that it includes.

use crate::ide::Analysis;
use crate::parse::outline::{Element, Outline};
use crate::source::Source;
use std::ops::Range;

/// A name in expressions, or a piece, and where it is said.
#[derive(Clone, Copy)]
pub(in crate::ide) struct Known<'a> {
    pub(in crate::ide) source: &'a Source,
    pub(in crate::ide) outline: &'a Outline,
    /// The `let`, `Param` or `define`.
    pub(in crate::ide) element: usize,
    /// The attribute that names it: `name`, or of a `define` the parameter itself.
    pub(in crate::ide) attribute: usize,
}

impl<'a> Known<'a> {
    pub(in crate::ide) fn element(&self) -> &'a Element {
        &self.outline.elements[self.element]
    }

    /// What it is called.
    pub(in crate::ide) fn name(&self) -> &'a str {
        let attribute = &self.element().attributes[self.attribute];
        match attribute.word.as_str() {
            "name" => attribute.value.trim(),
            parameter => parameter,
        }
    }

    /// Where the name stands.
    pub(in crate::ide) fn place(&self) -> Range<usize> {
        let attribute = &self.element().attributes[self.attribute];
        match attribute.word.as_str() {
            "name" => attribute.inner.clone(),
            _ => attribute.name.clone(),
        }
    }

    /// Whether it is an attribute of a `define`.
    pub(in crate::ide) fn is_argument(&self) -> bool {
        self.element().attributes[self.attribute].word != "name"
    }
}

/// The element's name as the language knows it.
pub(in crate::ide) fn kind(element: &Element) -> &'static str {
    element.schema.map_or("", |s| s.name)
}

/// The names that expressions know at an offset, the nearest first; each once.
pub(in crate::ide) fn names(a: &Analysis, at: usize) -> Vec<Known<'_>> {
    let own = a.outline();
    let round: Vec<usize> = own
        .element_at(at)
        .map_or(vec![], |e| own.around(e).collect());
    let mut found = vec![];
    for (index, element) in own.elements.iter().enumerate().rev() {
        let is = kind(element);
        if matches!(is, "let" | "Param") && element.range.end <= at && seen(own, element, &round) {
            found.extend(named(&a.source, own, index));
        }
        if is == "define" && round.contains(&index) {
            found.extend(arguments(&a.source, own, index));
        }
    }
    for (source, outline) in others(a) {
        let all = outline.elements.iter().enumerate();
        let given =
            all.filter(|(_, e)| matches!(kind(e), "let" | "Param") && seen(outline, e, &[]));
        found.extend(given.filter_map(|(index, _)| named(source, outline, index)));
    }
    once(found)
}

/// The pieces that a `use` at an offset may name, the nearest first; each once.
pub(in crate::ide) fn pieces(a: &Analysis, at: usize) -> Vec<Known<'_>> {
    let own = a.outline();
    let round: Vec<usize> = own
        .element_at(at)
        .map_or(vec![], |e| own.around(e).collect());
    let mut found = vec![];
    for (index, element) in own.elements.iter().enumerate().rev() {
        // A piece cannot stand in itself.
        if kind(element) == "define" && !round.contains(&index) && seen(own, element, &round) {
            found.extend(named(&a.source, own, index));
        }
    }
    for (source, outline) in others(a) {
        let all = outline.elements.iter().enumerate();
        let given = all.filter(|(_, e)| kind(e) == "define" && seen(outline, e, &[]));
        found.extend(given.filter_map(|(index, _)| named(source, outline, index)));
    }
    once(found)
}

/// The parameters of a piece: the attributes of its `define`, and the `Param`s right in it.
pub(in crate::ide) fn parameters<'a>(piece: &Known<'a>) -> Vec<Known<'a>> {
    let Known {
        source,
        outline,
        element,
        ..
    } = *piece;
    let mut found: Vec<Known<'a>> = arguments(source, outline, element).collect();
    let inside = outline.elements.iter().enumerate();
    let inside = inside.filter(|(_, e)| e.parent == Some(element) && kind(e) == "Param");
    found.extend(inside.filter_map(|(index, _)| named(source, outline, index)));
    found
}

fn others(a: &Analysis) -> impl Iterator<Item = (&Source, &Outline)> {
    a.checked.included.iter().zip(a.outlines())
}

/// Whether what an element says is known in one of these: it stands right in it, or in an `if` there, or outermost.
fn seen(outline: &Outline, element: &Element, round: &[usize]) -> bool {
    let mut next = element.parent;
    loop {
        let Some(index) = next else { return true };
        let parent = &outline.elements[index];
        if round.contains(&index) || parent.parent.is_none() && round.is_empty() {
            return true;
        }
        if !matches!(kind(parent), "if" | "else" | "choice" | "random") {
            return false;
        }
        next = parent.parent;
    }
}

fn named<'a>(source: &'a Source, outline: &'a Outline, element: usize) -> Option<Known<'a>> {
    let attributes = &outline.elements[element].attributes;
    let attribute = attributes.iter().position(|a| a.word == "name")?;
    let known = Known {
        source,
        outline,
        element,
        attribute,
    };
    (!known.name().is_empty()).then_some(known)
}

fn arguments<'a>(
    source: &'a Source,
    outline: &'a Outline,
    element: usize,
) -> impl Iterator<Item = Known<'a>> {
    let attributes = outline.elements[element].attributes.iter().enumerate();
    let own = attributes.filter(|(_, a)| a.word != "name" && !a.word.contains(':'));
    own.map(move |(attribute, _)| Known {
        source,
        outline,
        element,
        attribute,
    })
}

fn once(found: Vec<Known<'_>>) -> Vec<Known<'_>> {
    let mut names: Vec<&str> = vec![];
    let mut kept = vec![];
    for known in found {
        if !names.contains(&known.name()) {
            names.push(known.name());
            kept.push(known);
        }
    }
    kept
}
