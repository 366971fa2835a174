//! `Place`: a house that is written elsewhere - a type of the library, a `define`, a file - with parameters of its own.
//! The element stays, without those parameters, and holds the houses.

use super::super::read::check;
use super::super::tree::{Child, Element, Tree};
use super::names::Given;
use super::scope::{DefinedPiece, Frame};
use super::{ELEMENT, ElementRef, Expander, Scope};
use crate::parse::schema;
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::tree::text::Text;
use crate::parse::xml::tree::token::Attribute;
use crate::templates::{TYPES, Template};
use hsd_base::source::{Source, Spanned};
use hsd_ir::ast::Value;
use hsd_ir::ast::town::Stood;
use hsd_ir::messages::xml as say;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The parameters that a `Place` sets, with their values. `None` = an error was reported.
pub(super) type Arguments<'a> = BTreeMap<String, (Attribute<'a>, Option<Value>)>;

/// The house that a `Place` is being replaced by.
pub(super) struct Placed<'a> {
    /// The parameters that it sets and that have not been asked for yet.
    pub(super) arguments: Arguments<'a>,
    /// The names of the parameters that the house has.
    pub(super) known: Vec<String>,
    /// The attribute `type`, in whose place generated names stand.
    pub(super) kind: Attribute<'a>,
    pub(super) name: Option<String>,
    /// The attribute `seed` and its value.
    pub(super) seed: Option<(Attribute<'a>, u64)>,
    /// Where it stands, in a town.
    pub(super) stood: Option<Stood>,
    /// The number of uses around it.
    pub(super) uses: usize,
    /// The greatest width that the type allows, if its front is wider.
    pub(super) widest: Option<f64>,
    /// The parameters of the type and their values.
    pub(super) values: Vec<(String, Value)>,
}

/// A type whose houses have been put into their `Place`.
pub(super) struct Filled {
    /// Its parameters and their values.
    pub(super) values: Vec<(String, Value)>,
    /// The greatest width that it allows, metres, if its front is wider.
    pub(super) widest: Option<f64>,
}

/// Where a placed house is written.
pub(super) enum Origin<'a> {
    Piece(DefinedPiece<'a>, Scope<'a>),
    /// The tree of a file, and its path.
    File(Rc<Tree<'a>>, String),
}

impl Origin<'_> {
    /// Returns true if the house has an outline, which that of a feature can replace.
    pub(super) fn is_over_outlines(&self) -> bool {
        let (tree, roots) = match self {
            Origin::Piece(piece, _) => (&piece.tree, vec![piece.index]),
            Origin::File(tree, _) => (tree, tree.roots.clone()),
        };
        let children = |index: usize| {
            tree.elements[index]
                .children
                .iter()
                .filter_map(|c| match c {
                    Child::Element(index) => Some(*index),
                    Child::Text(_) => None,
                })
        };
        let tag = |index: usize| schema::named(tree.elements[index].name).map(|s| s.tag);
        let houses = |root: usize| {
            let own = std::iter::once(root).chain(children(root));
            own.filter(|index| tag(*index) == Some(Tag::House))
        };
        roots
            .into_iter()
            .flat_map(houses)
            .any(|house| children(house).any(|index| tag(index) == Some(Tag::Outline)))
    }
}

impl<'a> Placed<'a> {
    /// Creates the state of a house of this type whose parameters have not been asked for.
    pub(super) fn new(kind: Attribute<'a>, arguments: Arguments<'a>) -> Self {
        Placed {
            arguments,
            known: vec![],
            kind,
            name: None,
            seed: None,
            stood: None,
            uses: 0,
            widest: None,
            values: vec![],
        }
    }

    /// Returns the seed of its draws.
    pub(super) fn seed(&self) -> Option<u64> {
        self.seed.as_ref().map(|(_, seed)| *seed)
    }

    /// Returns the value of a parameter, if it sets one.
    pub(super) fn given(&mut self, name: &str) -> Option<(Attribute<'a>, Option<Value>)> {
        self.known.push(name.to_owned());
        self.arguments.remove(name)
    }
}

impl<'a> Expander<'a, '_> {
    /// Replaces a `Place` by the houses that it means.
    pub(super) fn place(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return;
        };
        let outline = self.outline_of_place(element_ref);
        let (own, arguments) = self.attributes_of_place(element, schema, scope);
        let of = |name: &str| own.iter().find(|a| a.name == name).cloned();
        let Some(kind) = of("type") else {
            // Only to say what is missing.
            let bare = Element {
                attributes: own,
                children: vec![],
                ..bare(element)
            };
            check(self.reporter, &mut self.suggest, schema, &bare);
            return;
        };
        if self.feature.site.is_some() && self.placed.is_empty() {
            return self.place_at_feature(element_ref, (own, arguments), &kind, scope, into);
        }
        let Some(origin) = self.origin(&kind, scope) else {
            return;
        };
        let text = |a: Attribute<'a>| a.value.as_str().trim().to_owned();
        let seed = of("seed").and_then(|a| Some((a.clone(), text(a).parse().ok()?)));
        let placed = Placed {
            name: of("name").map(text).filter(|name| !name.is_empty()),
            seed,
            uses: self.uses.len(),
            ..Placed::new(kind.clone(), arguments)
        };
        let cost = ELEMENT * (1 + own.len() as u64);
        if !self.take(cost, &element.name_range) {
            return;
        }
        let made = self.made.elements.len();
        self.made.elements.push(Element {
            attributes: own,
            ..bare(element)
        });
        self.enter(element_ref, made);
        let filled = self.fill(element, placed, origin, made);
        self.leave();
        if let Some(filled) = filled {
            let outline = outline.map(|index| element_ref.child(index));
            self.stand_on(outline.as_ref(), scope, made, (&kind, &filled));
            let children = &mut self.made.elements[into].children;
            children.push(Child::Element(made));
        }
    }

    /// Puts the houses of a place into its element; `None` if there are none.
    pub(super) fn fill(
        &mut self,
        element: &Element<'a>,
        placed: Placed<'a>,
        origin: Origin<'a>,
        made: usize,
    ) -> Option<Filled> {
        let kind = placed.kind.clone();
        let copying = std::mem::replace(&mut self.copying, true);
        let storeys = std::mem::take(&mut self.storeys);
        self.placed.push(placed);
        self.inside(&element.name_range, made, |expander| match origin {
            Origin::Piece(piece, home) => expander.fill_with_piece(&piece, &home, &kind, made),
            Origin::File(tree, path) => {
                let span = expander.reporter.span(&kind.value.whole());
                let source = expander.setting.cache.find(&path);
                let source = source.filter(|_| Template::is_source(&path));
                let place = expander.reporter.span(&element.tag);
                let before = source.map(|s| expander.reporter.instead(Some((s.id(), place))));
                expander.files.open.push((path, span));
                expander.fill_with_file(&tree, made);
                expander.files.open.pop();
                if let Some(before) = before {
                    expander.reporter.instead(before);
                }
            }
        });
        self.storeys = storeys;
        self.copying = copying;
        let mut placed = self.placed.pop()?;
        if self.over {
            return None;
        }
        if !self.has_house(made) {
            let word = kind.value.as_str().trim();
            self.reporter
                .at(&kind.value.whole(), |s| say::place_without_house(s, word));
            return None;
        }
        let filled = Filled {
            values: std::mem::take(&mut placed.values),
            widest: placed.widest,
        };
        self.unknown_arguments(placed);
        Some(filled)
    }

    /// Reports parameters that the house does not have.
    fn unknown_arguments(&mut self, placed: Placed<'a>) {
        let word = placed.kind.value.as_str().trim().to_owned();
        for (unknown, (attribute, _)) in placed.arguments {
            let known = &placed.known;
            let fixed = schema::named("Place").into_iter();
            let own = fixed.flat_map(|s| s.attributes).map(|a| a.name);
            let near = self
                .suggest
                .among(&unknown, known.iter().map(|n| &**n).chain(own));
            let whole = self.reporter.with_gap(&attribute.range);
            self.reporter.at(&attribute.name_range, |s| {
                say::unknown_parameter(s, &unknown, &word, near, known, whole)
            });
        }
    }

    fn fill_with_piece(
        &mut self,
        piece: &DefinedPiece<'a>,
        home: &Scope<'a>,
        kind: &Attribute<'a>,
        made: usize,
    ) {
        let tree = Rc::clone(&piece.tree);
        let body = ElementRef {
            tree: &tree,
            index: piece.index,
        };
        let frame = Frame::within(home);
        let arguments = self
            .placed
            .last_mut()
            .map(|p| std::mem::take(&mut p.arguments));
        let mut arguments = arguments.unwrap_or_default();
        self.offer_attributes(&body, &mut arguments, kind);
        let given = arguments
            .iter()
            .map(|(name, (attribute, value))| (name.clone(), (attribute, value.clone())));
        let span = self.reporter.span(&kind.value.whole());
        let name = Spanned::new(kind.value.as_str().trim().to_owned(), span);
        self.parameters_of(&body, &name, given.collect(), &frame);
        self.list(&body, &frame, made);
    }

    /// Sets the attributes of a definition that nobody sets and that are named like a field or measure of the feature.
    fn offer_attributes(
        &mut self,
        body: &ElementRef<'_, 'a>,
        arguments: &mut Arguments<'a>,
        kind: &Attribute<'a>,
    ) {
        let attributes = body.element().attributes.iter();
        for attribute in attributes.filter(|a| a.name != "name" && !a.is_foreign()) {
            let known = arguments.contains_key(attribute.name);
            if let Some(value) = self.measure(attribute.name).filter(|_| !known) {
                let value = (kind.clone(), Some(value));
                arguments.insert(attribute.name.to_owned(), value);
            }
        }
    }

    fn fill_with_file(&mut self, tree: &Rc<Tree<'a>>, made: usize) {
        let Some(root) = tree.roots.first() else {
            return;
        };
        let root = ElementRef { tree, index: *root };
        let scope = Frame::outermost();
        match root.tag() {
            Some(Tag::Houses) => self.list(&root, &scope, made),
            Some(Tag::House) => self.add(&root, &scope, made),
            _ => {}
        }
    }

    /// Returns the attributes of a `Place` itself with their values, and those that are parameters.
    fn attributes_of_place(
        &mut self,
        element: &Element<'a>,
        schema: &'static Schema,
        scope: &Scope<'a>,
    ) -> (Vec<Attribute<'a>>, Arguments<'a>) {
        let (mut own, mut arguments) = (vec![], BTreeMap::new());
        for attribute in element.attributes.iter().filter(|a| !a.is_foreign()) {
            let mut attribute = attribute.clone();
            let before = self.key_draws(element.name, attribute.name);
            if schema.attribute(attribute.name).is_none() || self.is_for_type(&attribute, scope) {
                let value = self.value(&attribute.value, scope);
                self.restore_draws(before);
                let entry = arguments.entry(attribute.name.to_owned());
                entry.or_insert((attribute, value));
                continue;
            }
            self.fill_attribute(&mut attribute, scope);
            self.restore_draws(before);
            own.push(attribute);
        }
        (own, arguments)
    }

    /// Finds what a `Place` means: a definition, a file or a type of the library.
    pub(super) fn origin(&mut self, kind: &Attribute<'a>, scope: &Scope<'a>) -> Option<Origin<'a>> {
        let place = kind.value.whole();
        let word = kind.value.as_str().trim();
        if word.is_empty() {
            if !kind.faulty {
                self.reporter
                    .at(&kind.range, |s| say::value_empty(s, kind.name, None));
            }
            return None;
        }
        if let Some((piece, home)) = scope.piece(word) {
            return Some(Origin::Piece(piece, home));
        }
        let extension = word.rsplit('.').next().unwrap_or_default();
        let path = if word.contains('/') || ["hsd", "xml"].contains(&extension) {
            let path = self.path(word, &place)?;
            self.source(&path, &place)?;
            path
        } else if let Some(template) = Template::named(word) {
            self.template(template)?
        } else {
            let known = TYPES.iter().map(|t| t.word.to_owned());
            let known: Vec<String> = scope.pieces().into_iter().chain(known).collect();
            let near = self.suggest.among(word, known.iter().map(|n| &**n));
            // 蔵 is a kura.
            let meant = || Template::found(word).first().map(|t| t.word);
            let near = near.or_else(meant);
            self.reporter
                .at(&place, |s| say::unknown_type(s, word, near, &known));
            return None;
        };
        let open = &self.files.open;
        let first = open.iter().position(|(p, _)| *p == path);
        let outermost = || (self.reporter.source_at(0).1.name() == path).then_some(0);
        if let Some(first) = first.or_else(outermost) {
            let span = self.reporter.span(&place);
            let mut chain = self.files.open[first..].to_vec();
            chain.push((path, span));
            self.reporter.push(|| say::place_in_itself(span, &chain));
            return None;
        }
        let source = self.setting.cache.find(&path)?;
        let tree = self.placed_tree(&path, source)?;
        Some(Origin::File(tree, path))
    }

    /// Adds a type of the library to the sources; returns its name among them.
    pub(super) fn template(&mut self, template: &Template) -> Option<String> {
        let (path, cache) = (template.source_name(), self.setting.cache);
        if cache.find(&path).is_none() {
            cache.add_own(&path, template.text().as_bytes()).ok()?;
        }
        Some(path)
    }

    /// Returns the tree of a file that is placed, which is read once.
    pub(super) fn placed_tree(&mut self, path: &str, source: &'a Source) -> Option<Rc<Tree<'a>>> {
        if let Some(tree) = self.files.placed.get(path) {
            return tree.clone();
        }
        let tree = self.opened(source);
        self.files.placed.insert(path.to_owned(), tree.clone());
        tree
    }

    fn has_house(&self, made: usize) -> bool {
        let elements = &self.made.elements;
        elements[made].children.iter().any(|child| match child {
            Child::Element(index) => match schema::named(elements[*index].name).map(|s| s.tag) {
                Some(Tag::House) => true,
                Some(Tag::Group | Tag::Place) => self.has_house(*index),
                _ => false,
            },
            Child::Text(_) => false,
        })
    }

    /// Gives a placed house the name and the seed of its `Place`. Names are told apart by numbers, since they key draws.
    pub(super) fn name_placed(&mut self, attributes: &mut Vec<Attribute<'a>>) {
        let Some(placed) = self.placed.last() else {
            return;
        };
        let kind = placed.kind.clone();
        let named = attributes.iter().position(|a| a.name == "name");
        let own = named.map(|i| attributes[i].value.as_str().trim().to_owned());
        let name = placed.name.clone().or(own.filter(|name| !name.is_empty()));
        let name = name.unwrap_or_else(|| kind.value.as_str().trim().to_owned());
        let count = self.files.names.entry(name.clone()).or_insert(0);
        *count += 1;
        let name = match *count {
            1 => name,
            n => format!("{name} {n}"),
        };
        let seed = placed.seed.as_ref().map(|(attribute, _)| attribute.clone());
        let place = kind.value.whole();
        let value = Text::instead(name, place);
        match named {
            Some(index) => attributes[index].value = value,
            None => attributes.push(Attribute {
                name: "name",
                value,
                ..kind
            }),
        }
        if let Some(seed) = seed {
            attributes.retain(|a| a.name != "seed");
            attributes.push(seed);
        }
    }

    /// Returns the value that the innermost `Place` gives to a parameter.
    pub(super) fn given_by_place(&mut self, name: &str) -> Option<Given> {
        let given = self.placed.last_mut()?.given(name);
        let given = given.map(|(attribute, value)| {
            Spanned::new(value, self.reporter.span(&attribute.value.whole()))
        });
        Some(Given::Use(given))
    }
}

/// Returns an element without attributes and content.
pub(super) fn bare<'a>(element: &Element<'a>) -> Element<'a> {
    Element {
        name: element.name,
        name_range: element.name_range.clone(),
        tag: element.tag.clone(),
        range: element.range.clone(),
        attributes: vec![],
        children: vec![],
        cut: element.cut,
        shared: false,
    }
}
