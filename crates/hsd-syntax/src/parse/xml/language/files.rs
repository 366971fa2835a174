//! `include`: the definitions of another file. The parameters, names, definitions, custom parts and includes in its
//! outermost element count; its houses do not. Each file is read once, however often it is included. Its custom parts
//! are put into the element that includes it, as if they stood there.

use super::super::read::check;
use super::super::tree::{self, Child, Tree};
use super::conditions::Branch;
use super::draws::is_choice;
use super::scope::Frame;
use super::{ElementRef, Expander, Scope};
use crate::parse::is_readable;
use crate::parse::schema;
use crate::parse::schema::{SCHEMA_HINTS, Tag, is_language};
use hsd_base::source::{CacheFull, IncludeError, Source, Span};
use hsd_ir::messages::xml as say;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// The included files.
#[derive(Default)]
pub(super) struct Files<'a> {
    /// By path; `None` if the file could not be used, which was reported.
    done: BTreeMap<String, Option<Included<'a>>>,
    /// The open files, outermost first: path, and place of the `include`.
    pub(super) open: Vec<(String, Span)>,
    /// The trees of files that a `Place` names, by path; `None` if one cannot be read.
    pub(super) placed: BTreeMap<String, Option<Rc<Tree<'a>>>>,
    /// How many placed houses have a name.
    pub(super) names: BTreeMap<String, u64>,
}

/// The definitions of a file.
struct Included<'a> {
    scope: Scope<'a>,
    /// Its custom parts, and those of the files that it includes: elements of the output tree.
    parts: Vec<usize>,
}

/// Returns true for elements that count in an included file.
fn defines(tag: Tag) -> bool {
    is_language(tag) || tag == Tag::PartDef
}

impl<'a> Expander<'a, '_> {
    /// Includes the definitions of a file.
    pub(super) fn include(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return;
        };
        let of = check(self.reporter, &mut self.suggest, schema, element);
        let Some(href) = of.get("href") else {
            return;
        };
        let place = href.value.whole();
        let Some(path) = self
            .filled(&href.value, scope)
            .and_then(|href| self.path(href.as_str().trim(), &place))
        else {
            return;
        };
        if let Some(first) = self.files.open.iter().position(|(p, _)| *p == path) {
            let span = self.reporter.span(&place);
            let mut chain = self.files.open[first..].to_vec();
            chain.push((path, span));
            self.reporter.push(|| say::include_cycle(span, &chain));
            return;
        }
        if !self.files.done.contains_key(&path) {
            let file = self.file(&path, &place);
            self.files.done.insert(path.clone(), file);
        }
        if let Some(Some(file)) = self.files.done.get(&path) {
            scope.import(&file.scope);
            let children = &mut self.made.elements[into].children;
            for part in &file.parts {
                let there = |c: &Child<'_>| matches!(c, Child::Element(index) if index == part);
                if !children.iter().any(there) {
                    children.push(Child::Element(*part));
                }
            }
        }
    }

    /// Returns the path that a reference denotes.
    pub(super) fn path(&mut self, href: &str, place: &Range<usize>) -> Option<String> {
        let scheme = href.split_once(':').is_some_and(|(s, _)| !s.contains('/'));
        if scheme || href.starts_with('/') || href.contains(['\\', '\0']) {
            self.reporter.at(place, |s| say::include_outside(s, href));
            return None;
        }
        let (_, from) = self.reporter.source_at(place.start);
        match self.setting.world.text(from.name(), href) {
            Ok(path) => Some(path),
            Err(IncludeError::Outside) => {
                self.reporter.at(place, |s| say::include_outside(s, href));
                None
            }
            Err(IncludeError::Missing) => {
                self.reporter
                    .at(place, |s| say::include_missing(s, href, None));
                None
            }
        }
    }

    /// Returns the definitions of a file; `None` if it could not be read.
    fn file(&mut self, path: &str, place: &Range<usize>) -> Option<Included<'a>> {
        let source = self.source(path, place)?;
        let tree = self.opened(source)?;
        let span = self.reporter.span(place);
        self.files.open.push((path.to_owned(), span));
        let scope = Frame::outermost();
        let parts = self.definitions(&tree, &scope);
        self.files.open.pop();
        Some(Included { scope, parts })
    }

    /// Returns the tree of another file; `None` if it is not in the XML form.
    pub(super) fn opened(&mut self, source: &'a Source) -> Option<Rc<Tree<'a>>> {
        let base = self.reporter.enter(source);
        let mut readable = true;
        if self.files.open.len() >= self.nesting {
            let limit = self.nesting;
            self.reporter
                .at(&(0..0), |s| say::nested_too_deep(s, limit));
            readable = false;
        }
        let reporter = &mut *self.reporter;
        readable &= is_readable(source, &self.setting.limits, &mut |d| reporter.say(d));
        if readable && !source.text().trim_start().starts_with(['<', '＜']) {
            self.reporter.at(&(0..0), say::include_no_xml);
            readable = false;
        }
        if !readable {
            self.reporter.leave();
            return None;
        }
        let tree = match self.trees.find(source.id(), base) {
            Some(tree) => tree,
            None => {
                let mut tree = tree::read(self.reporter, 0, self.nesting, SCHEMA_HINTS);
                tree.shift(base);
                self.trees.keep(source.id(), base, tree)
            }
        };
        self.reporter.leave();
        Some(tree)
    }

    pub(super) fn source(&mut self, path: &str, place: &Range<usize>) -> Option<&'a Source> {
        let cache = self.setting.cache;
        if let Some(source) = cache.find(path) {
            return Some(source);
        }
        let limit = self.setting.limits.bytes;
        let bytes = match self.setting.world.text_bytes(path, limit) {
            Ok(bytes) => bytes,
            Err(error) => {
                let why = error.to_string();
                self.reporter
                    .at(place, |s| say::include_missing(s, path, Some(&why)));
                return None;
            }
        };
        let limits = &self.setting.limits;
        match cache.add(path, &bytes) {
            Ok(source) => return Some(source),
            Err(CacheFull::Files) => self
                .reporter
                .at(place, |s| say::too_many_includes(s, limits.includes)),
            Err(CacheFull::Bytes) => self
                .reporter
                .at(place, |s| say::too_much_included(s, limits.included_bytes)),
        }
        None
    }

    /// Evaluates the definitions in the outermost element of a file; returns its custom parts.
    pub(super) fn definitions(&mut self, tree: &Rc<Tree<'a>>, scope: &Scope<'a>) -> Vec<usize> {
        let Some(root) = tree.roots.first() else {
            return vec![];
        };
        let root = ElementRef { tree, index: *root };
        let storeys = std::mem::take(&mut self.storeys);
        let children = root.element().children.iter();
        let spots: Vec<ElementRef<'_, 'a>> = children
            .filter_map(|child| match child {
                Child::Element(index) => Some(root.child(*index)),
                Child::Text(_) => None,
            })
            .filter(|element_ref| element_ref.tag().is_some_and(defines) || is_choice(element_ref))
            .collect();
        let (pieces, others): (Vec<_>, Vec<_>) =
            spots.iter().partition(|s| s.tag() == Some(Tag::Define));
        for piece in &pieces {
            self.define(piece, scope);
        }
        if pieces.is_empty() && others.is_empty() {
            self.reporter
                .at(&root.element().name_range, say::include_nothing);
        }
        // Anything except a definition goes into an element that is never read.
        let aside = self.aside(&root);
        let mut branch = Branch::None;
        for element_ref in others {
            branch = self.child(element_ref, &root, scope, aside, branch);
        }
        self.storeys = storeys;
        let made = &self.made.elements;
        let inside = made[aside].children.iter();
        let elements = inside.filter_map(|child| match child {
            Child::Element(index) => Some(*index),
            Child::Text(_) => None,
        });
        let is_part = |index: &usize| made[*index].name == "PartDef";
        elements.filter(is_part).collect()
    }

    fn aside(&mut self, root: &ElementRef<'_, 'a>) -> usize {
        let element = root.element();
        self.made.elements.push(tree::Element {
            name: element.name,
            name_range: element.name_range.clone(),
            tag: element.tag.clone(),
            range: element.range.clone(),
            attributes: vec![],
            children: vec![],
            cut: false,
            shared: false,
        });
        self.made.elements.len() - 1
    }
}
