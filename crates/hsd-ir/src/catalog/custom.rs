//! Custom parts: their scopes, and their derivation from a base.
//!
//! A base is found as a code is: among the parts of the same scope, then outwards. A part that has the code of its base
//! refers to the outer one, and so changes a part of the catalogue for the houses in its scope.

use crate::ast::{CodeText, WrittenAttribute, WrittenBody, WrittenPart, attribute_value};
use crate::catalog::{Catalog, PartDef, PartId, ScopeId, read};
use crate::messages::catalog as say;
use crate::messages::xml as elements;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Span, Spanned};
use std::collections::BTreeMap;

/// The maximum depth of parts based on one another.
const DEEPEST: usize = 64;

/// The number of recent scopes that are searched for an identical one.
const RECENT: usize = 64;

/// The maximum number of parts; the last number means none.
const MOST: usize = u16::MAX as usize - 1;

/// The custom parts of one scope, and the enclosing scope.
#[derive(Clone, Debug)]
pub(super) struct Scope {
    pub(super) outer: ScopeId,
    pub(super) names: BTreeMap<Box<str>, PartId>,
    /// The definitions that it was made from.
    entries: Vec<WrittenPart>,
}

/// A scope whose parts are being added to the catalogue.
struct ScopeBuilder<'e> {
    entries: Vec<&'e WrittenPart>,
    /// The first part of each code.
    codes: BTreeMap<String, usize>,
    made: Vec<Option<PartId>>,
    scope: ScopeId,
}

/// The base of a part.
enum Base {
    None,
    /// A part of the same scope.
    Own(usize),
    /// A part of an enclosing scope.
    Outer(PartId),
}

impl Catalog {
    /// Creates parts and the scope in which they are known.
    pub(super) fn scope(
        &mut self,
        outer: ScopeId,
        entries: &[&WrittenPart],
        out: &mut Diagnostics,
    ) -> ScopeId {
        if entries.is_empty() {
            return outer;
        }
        // Variants of a file define the same parts again and again.
        let alike = |s: &Scope| s.outer == outer && s.entries.iter().eq(entries.iter().copied());
        let recent = self.scopes.len().saturating_sub(RECENT);
        if let Some(at) = self.scopes[recent..].iter().rposition(alike) {
            return ScopeId((recent + at + 1) as u32);
        }
        self.scopes.push(Scope {
            outer,
            names: BTreeMap::new(),
            entries: entries.iter().map(|e| (*e).clone()).collect(),
        });
        let scope = ScopeId(self.scopes.len() as u32);
        let mut builder = ScopeBuilder {
            entries: entries.to_vec(),
            codes: BTreeMap::new(),
            made: vec![None; entries.len()],
            scope,
        };
        for (index, entry) in entries.iter().enumerate() {
            builder.enter(index, entry, out);
        }
        for index in 0..entries.len() {
            self.make(&mut builder, index, outer, out);
        }
        scope
    }

    /// Creates a part, after those on which it is based.
    fn make(
        &mut self,
        builder: &mut ScopeBuilder<'_>,
        index: usize,
        outer: ScopeId,
        out: &mut Diagnostics,
    ) {
        let mut chain = vec![index];
        let mut base = loop {
            let last = chain[chain.len() - 1];
            if builder.made[last].is_some() || !builder.is_first(last) {
                chain.pop();
                break None;
            }
            let next = match self.base(builder, last, outer, out) {
                Base::Own(next) => next,
                Base::Outer(id) => break Some(id),
                Base::None => break None,
            };
            if let Some(first) = chain.iter().position(|i| *i == next) {
                let links = chain[first..]
                    .iter()
                    .chain([&next])
                    .map(|i| builder.link(*i));
                let span = builder.link(last).1;
                out.push(say::base_cycle(span, &links.collect::<Vec<_>>()));
                break None;
            }
            if chain.len() >= DEEPEST {
                out.push(say::bases_too_deep(builder.link(last).1, DEEPEST));
                break None;
            }
            if let Some(id) = builder.made[next] {
                break Some(id);
            }
            chain.push(next);
        };
        while let Some(last) = chain.pop() {
            if self.parts.len() >= MOST {
                out.push(say::too_many_parts(builder.entries[last].span, MOST));
                return;
            }
            let part = self.derived(builder.entries[last], base, out);
            let id = PartId(self.parts.len() as u16);
            let name: Box<str> = part.code().into();
            let scope = builder.scope.0 as usize - 1; // counted from 1
            self.scopes[scope].names.insert(name, id);
            self.parts.push(part);
            builder.made[last] = Some(id);
            base = Some(id);
        }
    }

    /// Finds the base of a part and reports errors in it.
    fn base(
        &self,
        builder: &ScopeBuilder<'_>,
        index: usize,
        outer: ScopeId,
        out: &mut Diagnostics,
    ) -> Base {
        let Some(base) = attribute_value(&builder.entries[index].attributes, "base") else {
            return Base::None;
        };
        let code = CodeText::new(base.value.trim());
        match builder.codes.get(code.as_str()) {
            Some(own) if *own != index => return Base::Own(*own),
            _ => {}
        }
        if let Some(id) = self.find_in(outer, &code) {
            return Base::Outer(id);
        }
        let near: Vec<String> = self
            .nearest(code.as_str())
            .iter()
            .map(|id| self.part(*id).code().to_owned())
            .collect();
        out.push(say::unknown_base(base.span, base.value.trim(), &near));
        Base::None
    }

    /// Returns a part derived from its base.
    fn derived(&self, entry: &WrittenPart, base: Option<PartId>, out: &mut Diagnostics) -> PartDef {
        let base = base.map(|id| self.part(id));
        let whole = merged(entry, base.map(|b| &b.written), out);
        let class = base.map(PartDef::class);
        read::part(&whole, class, out)
    }
}

impl ScopeBuilder<'_> {
    /// Registers the code of a part, unless another one has it.
    fn enter(&mut self, index: usize, entry: &WrittenPart, out: &mut Diagnostics) {
        let Some(code) = attribute_value(&entry.attributes, "code") else {
            return; // reported by the reader
        };
        let text = CodeText::new(code.value.trim());
        match self.codes.get(text.as_str()) {
            Some(first) => {
                let first = self.entries[*first].span;
                out.push(say::part_twice(
                    entry.span,
                    text.as_str(),
                    first,
                    entry.whole,
                ));
            }
            None => {
                self.codes.insert(text.as_str().to_owned(), index);
            }
        }
    }

    /// Returns true if the code of the part refers to this part.
    fn is_first(&self, index: usize) -> bool {
        let code = attribute_value(&self.entries[index].attributes, "code");
        let code = code.map(|c| CodeText::new(c.value.trim()));
        code.is_some_and(|c| self.codes.get(c.as_str()) == Some(&index))
    }

    /// Returns the code of a part, and the place that names its base.
    fn link(&self, index: usize) -> (String, Span) {
        let entry = self.entries[index];
        let code = attribute_value(&entry.attributes, "code").map_or("", |c| c.value.trim());
        let base = attribute_value(&entry.attributes, "base");
        (code.to_owned(), base.map_or(entry.span, |b| b.span))
    }
}

/// Merges a part with its base.
fn merged(entry: &WrittenPart, base: Option<&WrittenPart>, out: &mut Diagnostics) -> WrittenPart {
    let mut whole = WrittenPart {
        span: entry.span,
        ..base.cloned().unwrap_or_default()
    };
    // A code of five columns determines its own width.
    let columns = attribute_value(&entry.attributes, "code").map(|c| CodeText::new(c.value.trim()));
    if columns.is_some_and(|code| read::column(&code).is_some()) {
        whole.attributes.retain(|a| a.name.value != "width");
    }
    // Aliases of the base do not apply to parts derived from it.
    whole.attributes.retain(|a| a.name.value != "aliases");
    set(&mut whole.attributes, &entry.attributes);
    for code in whole
        .attributes
        .iter_mut()
        .filter(|a| a.name.value == "code")
    {
        code.value.value = code.value.value.trim().to_owned();
    }
    let mut bodies: Vec<WrittenBody> = vec![];
    for own in &entry.body {
        match own.word.value.as_str() {
            "change" | "remove" => change(&mut whole.body, own, out),
            _ => bodies.push(own.clone()),
        }
    }
    let textured = attribute_value(&entry.attributes, "texture").is_some();
    if textured && entry.body.is_empty() && !has(&whole.body, "picture") {
        whole.body = vec![WrittenBody {
            word: Spanned::new("picture".into(), entry.span),
            end: None,
            attributes: vec![],
            children: vec![],
        }];
    }
    whole.body.extend(bodies);
    extrude(&mut whole, entry, out);
    whole
}

/// Gives the elements that show the texture the depth that the part specifies.
fn extrude(whole: &mut WrittenPart, entry: &WrittenPart, out: &mut Diagnostics) {
    let Some(depth) = attribute_value(&entry.attributes, "depth") else {
        return;
    };
    if !has(&whole.body, "picture") {
        let words = words(&whole.body);
        out.push(say::nothing_to_change(depth.span, "picture", &words, false));
        return;
    }
    let given = |name: &str, value: String| WrittenAttribute {
        name: Spanned::new(name.into(), depth.span),
        value: Spanned::new(value, depth.span),
    };
    let back = depth.value.parse::<f64>().map_or(0.0, |front| front + 10.0);
    let planes = [
        given("front", depth.value.clone()),
        given("thick", back.to_string()),
    ];
    each(&mut whole.body, "picture", &mut |element| {
        set(&mut element.attributes, &planes);
    });
}

/// Runs a `change` or a `remove` on the body of the base.
fn change(body: &mut Vec<WrittenBody>, own: &WrittenBody, out: &mut Diagnostics) {
    let is_change = own.word.value == "change";
    if let Some(child) = own.children.first() {
        let Spanned { value, span } = &child.word;
        out.push(elements::wrong_place(
            *span,
            value,
            Some(&own.word.value),
            "`PartDef`",
        ));
    }
    let Some(word) = attribute_value(&own.attributes, "element") else {
        if is_change {
            out.push(elements::attribute_missing(
                own.word.span,
                "change",
                "element",
                &[],
            ));
        } else {
            body.clear();
        }
        return;
    };
    let at = attribute_value(&own.attributes, "at");
    let wanted: Option<usize> = at.and_then(|at| at.value.trim().parse().ok());
    let (mut seen, mut hit) = (0, false);
    let known = ["element", "at"];
    let news: Vec<WrittenAttribute> = own
        .attributes
        .iter()
        .filter(|a| !known.contains(&a.name.value.as_str()))
        .cloned()
        .collect();
    let mut takes = || {
        seen += 1;
        let takes = at.is_none() || wanted == Some(seen);
        hit |= takes;
        takes
    };
    match is_change {
        true => each(body, &word.value, &mut |element| {
            if takes() {
                set(&mut element.attributes, &news);
            }
        }),
        false => retain(body, &word.value, &mut || !takes()),
    }
    if !hit {
        let at = at.filter(|_| seen > 0);
        let (span, other) = (at.map_or(word.span, |at| at.span), at.is_none());
        let words = words(body);
        out.push(say::nothing_to_change(span, &word.value, &words, other));
    }
}

/// Visits every element of a word, including nested ones.
fn each(body: &mut [WrittenBody], word: &str, act: &mut dyn FnMut(&mut WrittenBody)) {
    for element in body {
        if element.word.value == word {
            act(element);
        }
        each(&mut element.children, word, act);
    }
}

/// Keeps the elements of a word for which `stays` holds, and all others.
fn retain(body: &mut Vec<WrittenBody>, word: &str, stays: &mut dyn FnMut() -> bool) {
    body.retain_mut(|element| {
        let stays_itself = element.word.value != word || stays();
        if stays_itself {
            retain(&mut element.children, word, stays);
        }
        stays_itself
    });
}

fn has(body: &[WrittenBody], word: &str) -> bool {
    body.iter()
        .any(|e| e.word.value == word || has(&e.children, word))
}

/// Returns the distinct words of a body.
fn words(body: &[WrittenBody]) -> Vec<String> {
    let mut found: Vec<String> = vec![];
    for element in body {
        let inside = words(&element.children);
        for word in std::iter::once(element.word.value.clone()).chain(inside) {
            if !found.contains(&word) {
                found.push(word);
            }
        }
    }
    found
}

/// Sets attributes; those that are not named stay.
fn set(attributes: &mut Vec<WrittenAttribute>, news: &[WrittenAttribute]) {
    for new in news {
        match attributes
            .iter_mut()
            .find(|a| a.name.value == new.name.value)
        {
            Some(old) => *old = new.clone(),
            None => attributes.push(new.clone()),
        }
    }
}
