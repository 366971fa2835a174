//! What the rules of a town say before they are evaluated: the layers that they front, and those of which they make houses.

use super::super::tree::Child;
use super::{ElementRef, Expander};
use crate::parse::schema::Tag;
use hsd_base::source::Spanned;

impl<'a> Expander<'a, '_> {
    /// Records the layers that `Place`s and `Envelope`s in an element front.
    pub(super) fn fronts_in(&mut self, element_ref: &ElementRef<'_, 'a>) {
        let element = element_ref.element();
        let name = match element_ref.tag() {
            Some(Tag::Place) => "front",
            Some(Tag::Envelope) => "roads",
            _ => "",
        };
        if !name.is_empty() {
            let front = element.attributes.iter().find(|a| a.name == name);
            self.feature.facts.fronts.extend(front.map(|front| {
                let span = self.reporter.span(&front.value.whole());
                Spanned::new(front.value.as_str().trim().to_owned(), span)
            }));
        }
        for child in &element.children {
            if let Child::Element(index) = child {
                self.fronts_in(&element_ref.child(*index));
            }
        }
    }
}

/// Returns true if a rule writes an element.
pub(super) fn has(of: &ElementRef<'_, '_>, tag: Tag) -> bool {
    of.tag() == Some(tag)
        || of.element().children.iter().any(|child| match child {
            Child::Element(index) => has(&of.child(*index), tag),
            Child::Text(_) => false,
        })
}

/// Returns true if a rule makes something, but can make no house.
pub(super) fn is_outdoors(rule: &ElementRef<'_, '_>) -> bool {
    fn look(of: &ElementRef<'_, '_>, something: &mut bool) -> bool {
        let inner = of
            .element()
            .children
            .iter()
            .filter_map(|child| match child {
                Child::Element(index) => Some(of.child(*index)),
                Child::Text(_) => None,
            });
        inner.into_iter().all(|child| match child.tag() {
            Some(
                Tag::Road
                | Tag::Rail
                | Tag::Tree
                | Tag::Fence
                | Tag::Hedge
                | Tag::Wall
                | Tag::Pole
                | Tag::Network
                | Tag::Wire
                | Tag::Signal
                | Tag::Sign
                | Tag::Arcade
                | Tag::Torii
                | Tag::Lantern
                | Tag::Water
                | Tag::Farmland
                | Tag::Zone,
            ) => {
                *something = true;
                true
            }
            Some(Tag::If | Tag::Else | Tag::Random | Tag::Choice) => look(&child, something),
            Some(Tag::Let | Tag::Param | Tag::Skip) => true,
            _ => false,
        })
    }
    let mut something = false;
    look(rule, &mut something) && something
}
