//! The outline that a `Place` gives to its house.

use super::super::tree::{Child, MEANT};
use super::places::Filled;
use super::{ElementRef, Expander, Scope};
use crate::parse::schema::Tag;
use crate::parse::xml::tree::text::Text;
use crate::parse::xml::tree::token::Attribute;
use hsd_ir::messages::xml as say;

impl<'a> Expander<'a, '_> {
    /// Returns the outline that a `Place` gives to its house, if that is all that it holds; reports anything else.
    pub(super) fn outline_of_place(&mut self, element_ref: &ElementRef<'_, 'a>) -> Option<usize> {
        let in_town = self.feature.site.is_some() && self.placed.is_empty();
        let element = element_ref.element();
        if let [Child::Element(index)] = element.children[..]
            && !in_town
            && element_ref.child(index).tag() == Some(Tag::Outline)
        {
            return Some(index);
        }
        if !element.children.is_empty() {
            let fix = self.emptied(element);
            self.reporter
                .at(&element.name_range, |s| say::place_with_content(s, fix));
        }
        None
    }

    /// Puts the house of a place on an outline. Rows of a type know how wide their front is meant by its `frontage`.
    pub(super) fn stand_on(
        &mut self,
        outline: Option<&ElementRef<'_, 'a>>,
        scope: &Scope<'a>,
        made: usize,
        (kind, filled): (&Attribute<'a>, &Filled),
    ) {
        let Some(outline) = outline else {
            return;
        };
        if self.made.elements[made].children.len() != 1 {
            let place = &outline.element().name_range;
            self.reporter
                .at(place, |s| say::place_with_content(s, None));
            return;
        }
        let mut values = filled.values.iter();
        if let Some((_, frontage)) = values.find(|(name, _)| name == "frontage") {
            let meant = Attribute {
                name: MEANT,
                value: Text::instead(frontage.to_string(), kind.value.whole()),
                ..kind.clone()
            };
            self.made.elements[made].attributes.push(meant);
        }
        if let Some(copy) = self.copy(outline.tree, outline.index, scope) {
            let children = &mut self.made.elements[made].children;
            children.push(Child::Element(copy));
        }
    }
}
