//! `define` and `use`: definitions and their uses. The attributes of a `define` are its parameters and their defaults
//! (an empty one must be given), and so are the `Param`s in it; those of a `use` set them.

mod again;

pub(super) use again::UsesSoFar;

use super::super::read::check;
use super::super::tree::{Child, Element};
use super::names::Given;
use super::scope::{DefinedPiece, Frame};
use super::{ELEMENT, ElementRef, Expander, Scope, fixes};
use crate::parse::schema;
use crate::parse::schema::Tag;
use crate::parse::xml::tree::token::Attribute;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::Value;
use hsd_ir::messages::xml as say;
use std::collections::BTreeMap;
use std::rc::Rc;

/// An active use.
pub(super) struct Used<'a> {
    name: String,
    piece: DefinedPiece<'a>,
    pub(super) span: Span,
    /// The name of its element.
    pub(super) tag: Span,
}

/// The arguments of a `use`, by name. `None` = an error was reported.
pub(super) type Arguments<'s, 'a> = BTreeMap<String, (&'s Attribute<'a>, Option<Value>)>;

impl<'a> Expander<'a, '_> {
    /// Returns the names of the active uses and their places.
    pub(super) fn chain(&self) -> Vec<(String, Span)> {
        let uses = self.uses.iter();
        uses.map(|used| (used.name.clone(), used.span)).collect()
    }

    /// Evaluates a `define`.
    pub(super) fn define(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>) {
        let element = element_ref.element();
        let Some(name) = self.piece_name(element, scope) else {
            return;
        };
        let place = name.span;
        let piece = DefinedPiece {
            tree: Rc::clone(element_ref.tree),
            index: element_ref.index,
            place,
        };
        if let Some(before) = scope.define(&name.value, piece) {
            self.reporter.push(|| {
                let free = fixes::free(&name.value, |n| scope.piece(n).is_some());
                say::named_twice(place, &name.value, before, &free)
            });
        }
    }

    /// Replaces a `use` by its definition.
    pub(super) fn use_piece(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        if let Some(Child::Element(_) | Child::Text(_)) = element.children.first() {
            let fix = self.emptied(element);
            self.reporter
                .at(&element.name_range, |s| say::use_with_content(s, fix));
        }
        let Some(name) = self.piece_name(element, scope) else {
            return;
        };
        let Some((piece, home)) = scope.piece(&name.value) else {
            let known = self.known(|| scope.pieces());
            let near = self.suggest.among(&name.value, known.iter().map(|n| &**n));
            self.reporter
                .push(|| say::unknown_piece(name.span, &name.value, near, &known));
            return;
        };
        if let Some(first) = self.uses.iter().position(|u| u.piece.is(&piece)) {
            let mut chain = self.chain().split_off(first);
            chain.push((name.value.clone(), name.span));
            self.reporter
                .push(|| say::piece_in_itself(name.span, &chain, piece.place));
            return;
        }
        let arguments = self.arguments(element, scope);
        self.put_piece(element, (&name, piece, &home), arguments, into);
    }

    /// Puts the content of a definition in the place of an element, with these arguments.
    pub(super) fn put_piece(
        &mut self,
        element: &Element<'a>,
        (name, piece, home): (&Spanned<String>, DefinedPiece<'a>, &Scope<'a>),
        arguments: Arguments<'_, 'a>,
        into: usize,
    ) {
        let key = self.use_key(&piece, home, &arguments);
        if key.as_ref().is_some_and(|key| self.put_again(key, into)) {
            return;
        }
        let before = self.before_use(into);
        let tree = Rc::clone(&piece.tree);
        let body = ElementRef {
            tree: &tree,
            index: piece.index,
        };
        self.uses.push(Used {
            name: name.value.clone(),
            piece,
            span: name.span,
            tag: self.reporter.span(&element.name_range),
        });
        if self.take(ELEMENT, &element.name_range) {
            let frame = Frame::within(home);
            self.parameters_of(&body, name, arguments, &frame);
            self.inside(&element.name_range, into, |expander| {
                expander.list(&body, &frame, into);
            });
        }
        self.uses.pop();
        if let Some(key) = key {
            self.remember_use(key, &before, into);
        }
    }

    /// Returns the arguments of a `use`, evaluated at its place.
    fn arguments<'s>(&mut self, element: &'s Element<'a>, scope: &Scope<'a>) -> Arguments<'s, 'a> {
        let mut arguments = BTreeMap::new();
        for attribute in parameters(element) {
            let value = self.value(&attribute.value, scope);
            let entry = arguments.entry(attribute.name.to_owned());
            entry.or_insert((attribute, value));
        }
        arguments
    }

    /// Binds a definition's parameters to their values.
    pub(super) fn parameters_of(
        &mut self,
        body: &ElementRef<'_, 'a>,
        name: &Spanned<String>,
        mut arguments: Arguments<'_, 'a>,
        frame: &Scope<'a>,
    ) {
        let mut known = vec![];
        for parameter in parameters(body.element()) {
            known.push(parameter.name.to_owned());
            let place = self.reporter.span(&parameter.name_range);
            let given = arguments.remove(parameter.name);
            let default = &parameter.value;
            let value = match given {
                Some((_, value)) => value,
                None if default.as_str().trim().is_empty() => {
                    self.reporter.push(|| {
                        say::parameter_missing(name.span, parameter.name, Some(place), None)
                    });
                    None
                }
                None => self.value(default, frame),
            };
            let name = Spanned::new(parameter.name.to_owned(), place);
            self.bind(&name, value, frame);
        }
        for child in &body.element().children {
            let Child::Element(index) = child else {
                continue;
            };
            let element_ref = body.child(*index);
            if element_ref.tag() != Some(Tag::Param) {
                continue;
            }
            let mut attributes = element_ref.element().attributes.iter();
            let name = attributes.find(|a| a.name == "name");
            let name = name.map_or("", |n| n.value.as_str().trim());
            known.push(name.to_owned());
            let given = arguments.remove(name).map(|(attribute, value)| {
                let place = attribute.value.whole();
                Spanned::new(value, self.reporter.span(&place))
            });
            self.parameter(&element_ref, frame, Given::Use(given));
        }
        for (unknown, (attribute, _)) in arguments {
            let near = self.suggest.among(&unknown, known.iter().map(|n| &**n));
            let whole = self.reporter.with_gap(&attribute.range);
            self.reporter.at(&attribute.name_range, |s| {
                say::unknown_parameter(s, &unknown, &name.value, near, &known, whole)
            });
        }
    }

    /// Returns the name of a definition. At a `use` it may be computed, so that a parameter can choose among
    /// definitions.
    fn piece_name(&mut self, element: &Element<'a>, scope: &Scope<'a>) -> Option<Spanned<String>> {
        let mut attributes = element.attributes.iter();
        let Some(name) = attributes.find(|a| a.name == "name") else {
            let schema = schema::named(element.name)?;
            check(self.reporter, &mut self.suggest, schema, element);
            return None;
        };
        let filled = self.filled(&name.value, scope)?;
        let text = filled.as_str().trim();
        if text.is_empty() {
            if !name.faulty {
                self.reporter
                    .at(&name.range, |s| say::value_empty(s, name.name, None));
            }
            return None;
        }
        let span = self.reporter.span(&name.value.whole());
        Some(Spanned::new(text.to_owned(), span))
    }
}

/// Returns the attributes of a `define` or a `use` that are parameters.
fn parameters<'s, 'a>(element: &'s Element<'a>) -> impl Iterator<Item = &'s Attribute<'a>> {
    let all = element.attributes.iter();
    all.filter(|a| a.name != "name" && !a.is_foreign())
}
