//! The parts that all element readers share: children and attributes, checked against the tables.

mod again;
pub(in crate::parse::xml) mod parts;
pub(in crate::parse::xml) mod facades;
pub(in crate::parse::xml) mod pieces;
pub(in crate::parse::xml) mod values;
pub(in crate::parse::xml) mod fittings;
pub(in crate::parse::xml) mod roofs;
pub(in crate::parse::xml) mod rooms;
pub(in crate::parse::xml) mod house;
pub(in crate::parse::xml) mod outdoors;
pub(in crate::parse::xml) mod outline;
pub(in crate::parse::xml) mod houses;
pub(in crate::parse::xml) mod codes;
pub(in crate::parse::xml) mod monuments;
pub(in crate::parse::xml) mod views;
pub(in crate::parse::xml) mod town;

pub(in crate::parse::xml) use again::ReadSoFar;

use super::edits;
use super::suggest::Suggest;
use super::tree::{Child, Element, Tree};
use crate::parse::meanings;
use crate::parse::reporter::Reporter;
use crate::parse::schema;
use crate::parse::schema::lengths::Measure;
use crate::parse::schema::{Content, Kind, Schema, Tag};
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::text::Text;
use crate::parse::xml::tree::token::Attribute;
use hsd_base::diagnostic::{Noun, noun};
use hsd_base::source::Span;
use hsd_ir::ast::NamedView;
use hsd_ir::messages::xml as say;
use std::ops::{Range, RangeInclusive};

/// The state of the second step, from the tree to the document.
pub(super) struct Reader<'t, 'a> {
    pub(super) tree: &'t Tree<'t>,
    pub(super) reporter: &'t mut Reporter<'a>,
    pub(super) suggest: Suggest,
    /// The place for a `turn` of the current row, if it has none.
    pub(super) turn: Option<usize>,
    /// One unit of the current house, shaku.
    pub(super) unit: f64,
    /// The views read so far.
    pub(super) views: Vec<NamedView>,
    /// The parts of the house that have been read once and stand in several places.
    pub(super) again: ReadSoFar,
}

/// A child that is allowed at its place.
pub(super) enum AllowedChild<'t> {
    /// An element.
    Element(&'static Schema, &'t Element<'t>),
    /// Codes.
    Text(&'t Text<'t>),
}

/// The attributes of an element that are valid or at least given, by their canonical names.
pub(super) struct Attributes<'t> {
    pub(super) element: &'t Element<'t>,
    schema: &'static Schema,
    list: Vec<(&'static str, &'t Attribute<'t>, bool)>,
}

impl<'t> Attributes<'t> {
    /// Returns a valid attribute.
    pub(super) fn get(&self, name: &str) -> Option<&'t Attribute<'t>> {
        debug_assert!(self.schema.attribute(name).is_some(), "{name}");
        let found = self
            .list
            .iter()
            .find(|(n, _, usable)| *n == name && *usable);
        found.map(|(_, attribute, _)| *attribute)
    }

    /// Returns the kind of value of an attribute.
    pub(super) fn kind(&self, name: &str) -> Kind {
        self.schema.attribute(name).map_or(Kind::Text, |a| a.kind)
    }

    /// Returns what a number without a unit means for an attribute that is a length.
    pub(super) fn measure(&self, name: &str) -> Option<Measure> {
        self.schema.attribute(name)?.measure
    }

    /// Returns the meaning of an attribute.
    pub(super) fn about(&self, name: &str) -> Option<Noun> {
        self.schema.attribute(name).map(|a| noun(a.en, a.ja))
    }

    /// Returns the bounds of an attribute's numbers.
    pub(super) fn bounds(&self, name: &str) -> RangeInclusive<f64> {
        use Kind::{Either, Number, Numbers, Pair, Point, Points, Spot, WholePair};
        match self.kind(name) {
            Number(least, most) | Numbers(least, most) | Pair(least, most) => least..=most,
            WholePair(least, most) | Point(least, most) | Points(least, most) => least..=most,
            Either(_, least, most) | Spot(least, most) => least..=most,
            kind => {
                debug_assert!(false, "{name} is no number but {kind:?}");
                f64::MIN..=f64::MAX
            }
        }
    }

    /// Returns the bounds of an attribute that is a whole number.
    pub(super) fn whole_bounds(&self, name: &str) -> RangeInclusive<u64> {
        let kind = self.kind(name);
        debug_assert!(matches!(kind, Kind::Whole(..)), "{name} is {kind:?}");
        match kind {
            Kind::Whole(least, most) => least..=most,
            _ => 0..=u64::MAX,
        }
    }

    /// Returns the default of an attribute that is a number.
    pub(super) fn usual(&self, name: &str) -> f64 {
        let attribute = self.schema.attribute(name);
        let usual = attribute.and_then(|a| a.default.parse().ok());
        debug_assert!(usual.is_some(), "{name} has no number for a default");
        usual.unwrap_or(0.0)
    }
}

impl<'t> Reader<'t, '_> {
    /// Returns the span of a whole element.
    pub(super) fn whole(&self, element: &Element<'_>) -> Span {
        self.reporter.span(&element.range)
    }

    /// Returns the span of an element's start tag.
    pub(super) fn start(&self, element: &Element<'_>) -> Span {
        self.reporter.span(&element.tag)
    }

    /// Returns the outermost elements.
    pub(super) fn roots(&mut self) -> Vec<AllowedChild<'t>> {
        let mut nodes = vec![];
        for root in &self.tree.roots {
            self.element(&self.tree.elements[*root], None, &schema::ROOT, &mut nodes);
        }
        nodes
    }

    /// Returns the allowed children of an element. Others are reported; the children of unknown elements count as those
    /// of their parent.
    pub(super) fn children(
        &mut self,
        element: &'t Element<'t>,
        content: &'static Content,
    ) -> Vec<AllowedChild<'t>> {
        let mut nodes = Vec::with_capacity(element.children.len());
        self.collect(element, element.name, content, &mut nodes);
        nodes
    }

    /// Reports all the content of an element that must be empty.
    pub(super) fn no_children(&mut self, element: &'t Element<'t>) {
        self.children(element, &schema::NOTHING);
    }

    fn collect(
        &mut self,
        from: &'t Element<'t>,
        parent: &'t str,
        content: &'static Content,
        nodes: &mut Vec<AllowedChild<'t>>,
    ) {
        for child in &from.children {
            match child {
                Child::Text(text) if content.text => nodes.push(AllowedChild::Text(text)),
                Child::Text(text) => {
                    let s = text.as_str();
                    let start = s.len() - s.trim_start_matches(is_blank).len();
                    let end = s.trim_end_matches(is_blank).len();
                    let range = text.range(start..end);
                    self.misplaced(&range, &s[start..end], parent);
                }
                Child::Element(index) => {
                    let child = &self.tree.elements[*index];
                    self.element(child, Some(parent), content, nodes);
                }
            }
        }
    }

    /// Reports text in an element that allows only elements.
    pub(super) fn misplaced(&mut self, range: &Range<usize>, text: &str, parent: &str) {
        // A lone `<` was reported as a malformed tag.
        let (written, verbatim) = (self.reporter.quote(range), "[CDATA[");
        let before = range.start.saturating_sub(verbatim.len())..range.start;
        if written == "<" && self.reporter.quote(&before) != verbatim {
            return;
        }
        self.reporter
            .at(range, |s| say::text_not_allowed(s, text, parent, written));
    }

    /// Adds an element to the nodes if it is allowed there.
    fn element(
        &mut self,
        element: &'t Element<'t>,
        parent: Option<&'t str>,
        content: &'static Content,
        nodes: &mut Vec<AllowedChild<'t>>,
    ) {
        let (name, range) = (element.name, &element.name_range);
        match schema::named(name) {
            Some(schema) if content.tags.contains(&schema.tag) => {
                nodes.push(AllowedChild::Element(schema, element));
            }
            // A roof without a rectangle gives the style of all roofs.
            Some(schema)
                if schema.tag == Tag::Roof
                    && content.tags.contains(&Tag::Roofs)
                    && !schema.required().any(|name| element.has_attribute(name)) =>
            {
                let tags = edits::tags(self.reporter, element);
                self.reporter.at(range, |s| say::roof_for_roofs(s, &tags));
                nodes.extend(schema::named("Roofs").map(|s| AllowedChild::Element(s, element)));
            }
            Some(schema) => {
                self.reporter
                    .at(range, |s| say::wrong_place(s, name, parent, schema.home));
            }
            None => self.unknown(element, parent, content, nodes),
        }
    }

    fn unknown(
        &mut self,
        element: &'t Element<'t>,
        parent: Option<&'t str>,
        content: &'static Content,
        nodes: &mut Vec<AllowedChild<'t>>,
    ) {
        let all = schema::ELEMENTS.iter();
        let here = all.clone().filter(|e| content.tags.contains(&e.tag));
        let near = self.suggest.among(element.name, here.map(|e| e.name));
        let near = near.or_else(|| self.suggest.among(element.name, all.map(|e| e.name)));
        if is_name(element.name) {
            let tags = edits::tags(self.reporter, element);
            self.reporter.at(&element.name_range, |s| {
                say::unknown_element(s, element.name, near, parent, &tags)
            });
        }
        match near.and_then(schema::named) {
            Some(schema) if content.tags.contains(&schema.tag) => {
                nodes.push(AllowedChild::Element(schema, element));
            }
            Some(_) => {}
            None => self.collect(element, parent.unwrap_or(element.name), content, nodes),
        }
    }

    /// Returns the attributes of an element, checked by name; their values are checked when they are read.
    pub(super) fn attributes(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Attributes<'t> {
        check(self.reporter, &mut self.suggest, schema, element)
    }
}

/// Returns the attributes of an element, checked by name.
pub(super) fn check<'t>(
    reporter: &mut Reporter<'_>,
    suggest: &mut Suggest,
    schema: &'static Schema,
    element: &'t Element<'t>,
) -> Attributes<'t> {
    let mut found = Attributes {
        element,
        schema,
        list: Vec::with_capacity(element.attributes.len()),
    };
    for attribute in &element.attributes {
        if attribute.is_foreign() {
            continue;
        }
        if let Some(name) = attribute_name(reporter, suggest, schema, element, attribute) {
            found.add(reporter, name, attribute);
        }
    }
    for required in schema.required() {
        if !found.list.iter().any(|(n, ..)| *n == required) {
            reporter.at(&element.name_range, |s| {
                let words = schema.attribute(required).map_or(&[][..], edits::few_words);
                say::attribute_missing(s, schema.name, required, words)
            });
        }
    }
    found
}

fn attribute_name(
    reporter: &mut Reporter<'_>,
    suggest: &mut Suggest,
    schema: &'static Schema,
    element: &Element<'_>,
    attribute: &Attribute<'_>,
) -> Option<&'static str> {
    let canonical = schema::canonical(attribute.name);
    if let Some(known) = schema.attribute(canonical) {
        return Some(known.name);
    }
    let attribute_schema = schema.attributes.iter().map(|a| a.name);
    let code = attribute_schema
        .clone()
        .find(|a| *a == "code")
        .map(|_| "texturecode");
    let near = schema::meant(schema.tag, attribute.name).or_else(|| {
        let words = attribute_schema.clone().chain(code);
        suggest.among(attribute.name, words)
    });
    if !attribute.faulty {
        let whole = reporter.with_gap(&attribute.range);
        reporter.at(&attribute.name_range, |s| {
            let known: Vec<&str> = attribute_schema.clone().collect();
            let is = |near, a: &Attribute<'_>| schema::canonical(a.name) == schema::canonical(near);
            let near = near.map(|near| (near, element.attributes.iter().any(|a| is(near, a))));
            let (name, of) = (attribute.name, schema.name);
            if near.is_none() && schema::ROOFING.contains(&name) {
                let kind = meanings::called(attribute.value.as_str(), &meanings::COVERINGS);
                return say::roofing(s, name, of, kind.map_or("K", |k| k.word), whole);
            }
            say::unknown_attribute(s, name, of, near, &known, Some(whole))
        });
    }
    let near = schema::canonical(near?);
    attribute_schema.into_iter().find(|a| *a == near)
}

impl<'t> Attributes<'t> {
    fn add(
        &mut self,
        reporter: &mut Reporter<'_>,
        name: &'static str,
        attribute: &'t Attribute<'t>,
    ) {
        let first = self.list.iter().find(|(n, ..)| *n == name);
        if let Some((_, first, _)) = first {
            // Duplicates of the same spelling were reported by the tree.
            if first.name != attribute.name && !attribute.faulty {
                let before = reporter.span(&first.name_range);
                let both = [&first.range, &attribute.range].map(|range| reporter.with_gap(range));
                reporter.at(&attribute.name_range, |s| {
                    say::attribute_twice(s, attribute.name, first.name, before, both)
                });
            }
            return;
        }
        let text = attribute.value.as_str();
        let empty = text.trim_matches(is_blank).is_empty() && !void(text);
        if empty && !attribute.faulty {
            let needed = self.schema.required().any(|required| required == name);
            let spared = (!needed).then(|| reporter.with_gap(&attribute.range));
            reporter.at(&attribute.range, |s| {
                say::value_empty(s, attribute.name, spared)
            });
        }
        self.list.push((name, attribute, !empty));
    }
}

/// Returns true for the code of a void, five blanks.
fn void(text: &str) -> bool {
    text == "     "
}

fn is_name(name: &str) -> bool {
    name.starts_with(crate::parse::xml::tree::chars::is_name_start)
}
