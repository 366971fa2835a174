//! The number of the storey, `k`. It is counted over the expanded storeys of a house, or of a facade, from 1 and
//! without parapets; so a repetition of storeys that use it is written out here, and each copy has its own. So is a
//! repetition with random choices, since each round makes its own.

use super::super::tree::Child;
use super::{ElementRef, Expander, Scope};
use crate::parse::xml::tree::text::Text;
use std::cell::Cell;

/// The count of storeys in a house or a facade.
#[derive(Default)]
pub(super) struct Storeys {
    /// The number of storeys so far.
    count: u64,
    /// The number of the current one.
    pub(super) number: Option<u64>,
    /// True once the number has been used.
    pub(super) asked: Cell<bool>,
}

impl<'a> Expander<'a, '_> {
    /// Copies a storey or a floor. A parapet has the number of the storey below it.
    pub(super) fn storey(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
    ) -> Option<usize> {
        let outside = self.storeys.number.replace(self.storeys.count + 1);
        let attributes = &element_ref.element().attributes;
        let kind = attributes.iter().find(|a| a.name == "kind");
        let kind = kind.and_then(|kind| self.filled(&kind.value, scope));
        let parapet = kind.is_some_and(|kind| kind.as_str().trim() == "parapet");
        if parapet && self.storeys.count > 0 {
            self.storeys.number = Some(self.storeys.count);
        } else {
            self.storeys.count += 1;
        }
        let made = self.element(element_ref, scope);
        self.storeys.number = outside;
        made
    }

    /// Copies a repetition; if storeys in it use their number, makes one repetition per round.
    pub(super) fn repeat(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let before = self.storeys.count;
        let asked = self.storeys.asked.replace(false);
        let drawn = self.open.forget();
        let Some(first) = self.element(element_ref, scope) else {
            return;
        };
        self.put(first, into);
        let rounds = self.rounds(first);
        let each = self.storeys.count - before;
        let numbered = self.storeys.asked.get() && each > 0;
        let differs = numbered || self.open.has_drawn();
        self.storeys.asked.set(asked || self.storeys.asked.get());
        self.open.remember(drawn);
        if !differs || rounds < 2 {
            let counted = each.saturating_mul(rounds);
            self.storeys.count = before.saturating_add(counted);
            return;
        }
        self.once(first);
        let copying = std::mem::replace(&mut self.copying, true);
        for _ in 1..rounds {
            let Some(next) = self.element(element_ref, scope) else {
                break;
            };
            self.once(next);
            self.put(next, into);
        }
        self.copying = copying;
    }

    fn put(&mut self, made: usize, into: usize) {
        let child = Child::Element(made);
        self.made.elements[into].children.push(child);
    }

    /// Returns the number of rounds of a repetition; 1 if it cannot be determined.
    fn rounds(&self, made: usize) -> u64 {
        let mut attributes = self.made.elements[made].attributes.iter();
        let num = attributes.find(|a| a.name == "num");
        num.and_then(|num| num.value.as_str().trim().parse().ok())
            .unwrap_or(1)
    }

    /// Sets a repetition to one round.
    fn once(&mut self, made: usize) {
        let mut attributes = self.made.elements[made].attributes.iter_mut();
        if let Some(num) = attributes.find(|a| a.name == "num") {
            num.value = Text::instead("1".into(), num.value.whole());
        }
    }
}
