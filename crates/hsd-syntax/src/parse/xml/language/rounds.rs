//! Repetitions that are written out: those with a number of the round, and those of houses.

use super::super::read::check;
use super::super::tree::Child;
use super::scope::{Bound, Frame};
use super::{ElementRef, Expander, Scope};
use crate::parse::schema;
use crate::parse::schema::{Kind, Tag};
use crate::parse::xml::tree::token::Attribute;
use hsd_base::text;
use hsd_ir::ast::Value;
use hsd_ir::messages::xml as say;

/// Returns true for a repetition that is written out.
pub(super) fn is_written_out(
    element_ref: &ElementRef<'_, '_>,
    parent: &ElementRef<'_, '_>,
) -> bool {
    let numbered = element_ref.element().has_attribute("index");
    let of_houses = || matches!(parent.tag(), Some(Tag::Houses | Tag::Group)) || holds(element_ref);
    numbered || of_houses()
}

/// Returns true if an element, or a repetition in it, holds what cannot be repeated later.
fn holds(element_ref: &ElementRef<'_, '_>) -> bool {
    element_ref
        .element()
        .children
        .iter()
        .any(|child| match child {
            Child::Element(index) => {
                let inner = element_ref.child(*index);
                match inner.tag() {
                    Some(Tag::Repeat) => holds(&inner),
                    Some(
                        Tag::House
                        | Tag::Group
                        | Tag::Place
                        | Tag::Loop
                        | Tag::Room
                        | Tag::Fixture
                        | Tag::Put
                        | Tag::Ground,
                    ) => true,
                    _ => false,
                }
            }
            Child::Text(_) => false,
        })
}

impl<'a> Expander<'a, '_> {
    /// Replaces a repetition by its content, as often as it says.
    pub(super) fn write_out(
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
        let name = self.name_in(&of, "index");
        let Some(num) = of.get("num") else { return };
        let Some(rounds) = self.rounds_of(num, of.kind("num"), scope) else {
            return;
        };
        let copying = self.copying;
        for round in 0..rounds {
            if self.over || !self.take(1, &element.name_range) {
                break;
            }
            let frame = Frame::within(scope);
            if let Some(name) = &name {
                let value = Some(Value::Number(round as f64));
                let place = name.span;
                frame.bind(&name.value, Bound { value, place });
            }
            self.inside(&element.name_range, into, |expander| {
                expander.list(element_ref, &frame, into);
            });
            self.copying = true;
        }
        self.copying = copying;
    }

    /// Returns the number of rounds; `None` if an error was reported.
    fn rounds_of(&mut self, num: &Attribute<'_>, kind: Kind, scope: &Scope<'a>) -> Option<u64> {
        let place = num.value.whole();
        let most = match kind {
            Kind::Whole(_, most) => most,
            _ => u64::MAX,
        };
        match self.value(&num.value, scope)? {
            Value::Number(n) if n.fract() == 0.0 && (0.0..=most as f64).contains(&n) => {
                Some(n as u64)
            }
            Value::Number(n) => {
                let text = n.to_string();
                let near = n.round().clamp(0.0, most as f64).to_string();
                self.reporter.at(&place, |s| {
                    let bounds = text!([most]
                        "a whole number from 0 to {most}",
                        "0 から {most} までの整数"
                    );
                    say::out_of_range(s, "num", &text, bounds, Some(&near))
                });
                None
            }
            found => {
                let text = found.to_string();
                self.reporter
                    .at(&place, |s| say::not_a_number(s, "num", &text, None));
                None
            }
        }
    }
}
