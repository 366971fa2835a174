//! The values and definitions known at a place.

use crate::Analysis;
use hsd_base::source::Source;
use hsd_syntax::parse::names::Definition;
use hsd_syntax::parse::names::file::{self, named, word};
use hsd_syntax::parse::syntax::{Element, Outline};
use std::ops::Range;

/// A name in expressions, or a definition, and its place.
#[derive(Clone, Copy)]
pub(crate) struct KnownName<'a> {
    pub(crate) source: &'a Source,
    pub(crate) outline: &'a Outline,
    /// The `let`, `Param`, `define` or `repeat`.
    pub(crate) element: usize,
    /// The attribute that names it: `name`, of a `repeat` `index`, or of a `define` the parameter itself.
    pub(crate) attribute: usize,
}

impl<'a> KnownName<'a> {
    /// Returns the name that an element defines.
    pub(crate) fn of(a: &'a Analysis, element: usize) -> Option<KnownName<'a>> {
        let (source, outline) = (&a.source, a.outline());
        let (attribute, _) = named(source.text(), outline.elements.get(element)?)?;
        Some(KnownName {
            source,
            outline,
            element,
            attribute,
        })
    }

    fn given(a: &'a Analysis, given: Definition) -> Option<KnownName<'a>> {
        let (source, outline) = match given.file.checked_sub(1) {
            None => (&a.source, a.outline()),
            Some(n) => (a.checked.included.get(n)?, a.outlines().get(n)?),
        };
        Some(KnownName {
            source,
            outline,
            element: given.element,
            attribute: given.attribute,
        })
    }

    pub(crate) fn element(&self) -> &'a Element {
        &self.outline.elements[self.element]
    }

    /// Returns the name.
    pub(crate) fn name(&self) -> &'a str {
        self.source.text()[self.place()].trim()
    }

    /// Returns the place of the name.
    pub(crate) fn place(&self) -> Range<usize> {
        let attribute = &self.element().attributes[self.attribute];
        match self.is_argument() {
            false => attribute.inner.clone(),
            true => attribute.name.clone(),
        }
    }

    /// Returns true if it is a parameter of a `define`, which is the attribute itself.
    pub(crate) fn is_argument(&self) -> bool {
        let element = self.element();
        word(element) == "define" && element.attributes[self.attribute].word != "name"
    }
}

/// Returns the values known in expressions at an offset, the nearest first; each name once.
pub(crate) fn values(a: &Analysis, at: usize) -> Vec<KnownName<'_>> {
    let scopes = &a.names(&a.files()).index.scopes;
    let given = scopes.values(scopes.at(0, a.outline(), at), at);
    let known = given.into_iter().filter_map(|g| KnownName::given(a, g));
    known.collect()
}

/// Returns the definitions that a `use` at an offset may name, the nearest first; each name once.
pub(crate) fn pieces(a: &Analysis, at: usize) -> Vec<KnownName<'_>> {
    let outline = a.outline();
    let scopes = &a.names(&a.files()).index.scopes;
    let round: Vec<usize> = outline
        .element_at(at)
        .map_or(vec![], |e| outline.around(e).collect());
    // A definition cannot contain itself.
    let other = |g: &&Definition| g.file != 0 || !round.contains(&g.element);
    let pieces = scopes.pieces(scopes.at(0, outline, at)).into_iter();
    let given = pieces.filter_map(|(_, piece)| piece.given.iter().rfind(other));
    given.filter_map(|g| KnownName::given(a, *g)).collect()
}

/// Returns the parameters of a definition: the attributes of its `define`, and the `Param`s directly in it.
pub(crate) fn parameters<'a>(piece: &KnownName<'a>) -> Vec<KnownName<'a>> {
    let (text, elements) = (piece.source.text(), &piece.outline.elements);
    let known = |element: usize, attribute: usize| KnownName {
        element,
        attribute,
        ..*piece
    };
    let own = file::parameters(text, piece.element());
    let mut found: Vec<KnownName<'a>> = own.map(|(n, ..)| known(piece.element, n)).collect();
    let inside = elements.iter().enumerate();
    let inside = inside.filter(|(_, e)| e.parent == Some(piece.element) && word(e) == "Param");
    found.extend(inside.filter_map(|(n, e)| Some(known(n, named(text, e)?.0))));
    found
}
