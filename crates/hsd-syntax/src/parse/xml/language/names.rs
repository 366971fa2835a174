//! `let` and `Param`: names for values.

use super::super::read::{Attributes, check};
use super::super::tree::Element;
use super::scope::Bound;
use super::{ElementRef, Expander, Scope, fixes, is_computed};
use crate::parse::expr;
use crate::parse::schema;
use crate::parse::schema::Tag;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{Parameter, Value};
use hsd_ir::messages::xml as say;
use std::rc::Rc;

/// The source of a parameter's value.
pub(super) enum Given {
    /// The command line, for a house or a file.
    Run,
    /// A `use`, if it sets the parameter. `None` inside = an error was reported.
    Use(Option<Spanned<Option<Value>>>),
}

/// The definition of a parameter, as its element gives it.
pub(super) struct WrittenParameter {
    name: Spanned<String>,
    /// Without its value.
    parameter: Parameter,
    /// The weights of its values, and their place.
    weights: Option<(Vec<f64>, Span)>,
    has_default: bool,
}

impl<'a> Expander<'a, '_> {
    /// Evaluates a `let`.
    pub(super) fn assign(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>) {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return;
        };
        let of = check(self.reporter, &mut self.suggest, schema, element);
        let written = of.get("name").map_or("", |n| n.value.as_str());
        let before = self.key_draws(element.name, written);
        let value = of.get("value").map(|v| self.value(&v.value, scope));
        self.restore_draws(before);
        if let Some(name) = self.name(&of) {
            self.bind(&name, value.flatten(), scope);
        }
    }

    /// Evaluates the parameter of a house or a file.
    pub(super) fn param(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        parent: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
    ) {
        match schema::named(parent.element().name) {
            Some(s) if s.tag == Tag::Define => {} // taken by its use
            Some(s) if s.takes_parameters() => {
                let mut attributes = element_ref.element().attributes.iter();
                let name = attributes.find(|a| a.name == "name");
                let name = name.map_or("", |n| n.value.as_str().trim());
                let given = self.given_by_place(name).unwrap_or(Given::Run);
                self.parameter(element_ref, scope, given);
            }
            _ => {
                let element = element_ref.element();
                let home = schema::named(element.name).map_or("", |s| s.home);
                let outer = parent.element().name;
                self.reporter.at(&element.name_range, |s| {
                    say::wrong_place(s, element.name, Some(outer), home)
                });
            }
        }
    }

    /// Evaluates a parameter and binds its name.
    pub(super) fn parameter(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        given: Given,
    ) {
        let Some(written) = self.written_parameter(element_ref, scope) else {
            return;
        };
        let (name, parameter) = (&written.name, &written.parameter);
        let at_run = matches!(given, Given::Run);
        let drawn = self.drawn(parameter, written.weights.as_ref(), parameter.span);
        // In a placed house the default takes the place of a faulty value: its author wrote no wall that could miss a length.
        let value = self.given(parameter, given, name.span);
        let value = value.filter(|value| value.is_some() || self.placed.is_empty());
        let value = value.or_else(|| self.offered(parameter).map(Some));
        let value = value.unwrap_or_else(|| drawn.or_else(|| parameter.default.clone()));
        self.note_parameter(parameter, value.as_ref());
        if value.is_none() && !written.has_default && !at_run {
            let span = self.uses.last().map_or(name.span, |u| u.span);
            let at = self.uses.last().map(|u| (parameter, u.tag));
            self.reporter
                .push(|| say::parameter_missing(span, &name.value, Some(name.span), at));
        } else if value.is_none() && !written.has_default {
            let tag = self.reporter.span(&element_ref.element().name_range);
            let at = Some((parameter, tag));
            self.reporter
                .push(|| say::parameter_missing(name.span, &name.value, None, at));
        }
        if at_run {
            self.parameters.push(Parameter {
                value: value.clone(),
                ..parameter.clone()
            });
        }
        self.bind(name, value, scope);
    }

    /// Returns what is written of a parameter. What has no expressions and no faults says the same in every house, so it is
    /// read once.
    fn written_parameter(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
    ) -> Option<Rc<WrittenParameter>> {
        let element = element_ref.element();
        if let Some(known) = self.written.get(&element.tag.start) {
            return Some(Rc::clone(known));
        }
        let told = self.reporter.told();
        let made = Rc::new(self.read_parameter(element, scope)?);
        let computes = element.attributes.iter().any(is_computed);
        if !computes && self.reporter.told() == told {
            self.written.insert(element.tag.start, Rc::clone(&made));
        }
        Some(made)
    }

    /// Reads what is written of a parameter.
    fn read_parameter(
        &mut self,
        element: &Element<'a>,
        scope: &Scope<'a>,
    ) -> Option<WrittenParameter> {
        let schema = schema::named(element.name)?;
        let of = check(self.reporter, &mut self.suggest, schema, element);
        let name = self.name(&of)?;
        let parameter = Parameter {
            span: self.reporter.span(&element.tag),
            default: of.get("default").and_then(|d| self.value(&d.value, scope)),
            value: None,
            min: self.bound(&of, "min", scope),
            max: self.bound(&of, "max", scope),
            step: self.bound(&of, "step", scope).filter(|step| *step > 0.0),
            choices: self.choices(&of, scope),
            random: self.truth(&of, "random", scope) || of.get("weights").is_some(),
            unit: self.words(&of, "unit", scope),
            doc: self.words(&of, "doc", scope),
            doc_ja: self.words(&of, "doc_ja", scope),
            name: name.value.clone(),
        };
        self.check_default(&of, &parameter);
        Some(WrittenParameter {
            weights: self.weights(&of, scope),
            has_default: of.get("default").is_some(),
            parameter,
            name,
        })
    }

    /// Reports a default that the parameter does not allow.
    fn check_default(&mut self, of: &Attributes<'_>, parameter: &Parameter) {
        if let (Some(default), Some(place)) = (&parameter.default, of.get("default"))
            && !parameter.admits(default)
        {
            let place = place.value.whole();
            self.reporter
                .at(&place, |s| say::default_out_of_range(s, default, parameter));
        }
    }

    /// Returns the value given to a parameter, if any; `None` inside = it is invalid, which was reported.
    fn given(&mut self, to: &Parameter, given: Given, name: Span) -> Option<Option<Value>> {
        let placed = matches!(given, Given::Use(_)) && !self.placed.is_empty();
        let (value, span) = match given {
            Given::Use(given) => {
                let given = given?;
                match given.value {
                    Some(value) => (value, given.span),
                    None => return Some(None),
                }
            }
            Given::Run => {
                let mut set = self.setting.parameters.iter().rev();
                let (_, text) = set.find(|(name, _)| *name == to.name)?;
                let value = match to.choices.iter().find(|c| c.to_string() == text.trim()) {
                    Some(choice) => choice.clone(),
                    None => Value::read(text),
                };
                (value, name)
            }
        };
        // A parameter that is a string may have any form.
        let value = match (&to.default, to.admits(&value)) {
            (Some(Value::Text(_)), false) if to.choices.is_empty() => {
                Value::Text(value.to_string())
            }
            _ => value,
        };
        if to.admits(&value) || placed && to.admits_in_place(&value) {
            return Some(Some(value));
        }
        self.reporter
            .push(|| say::value_out_of_range(span, &value, to, name));
        None
    }

    /// Returns the name that an element defines.
    fn name(&mut self, of: &Attributes<'_>) -> Option<Spanned<String>> {
        self.name_in(of, "name")
    }

    /// Returns the name that an attribute defines.
    pub(super) fn name_in(
        &mut self,
        of: &Attributes<'_>,
        attribute: &str,
    ) -> Option<Spanned<String>> {
        let attribute = of.get(attribute)?;
        let place = attribute.value.whole();
        let name = attribute.value.as_str().trim();
        if !expr::is_name(name) || expr::RESERVED.contains(&name) {
            let plain = plain_name(name);
            self.reporter.at(&place, |s| say::no_name(s, name, &plain));
            return None;
        }
        Some(Spanned::new(name.to_owned(), self.reporter.span(&place)))
    }

    /// Binds a name to a value; a name is bound once in an element.
    pub(super) fn bind(&mut self, name: &Spanned<String>, value: Option<Value>, scope: &Scope<'a>) {
        let place = name.span;
        if let Some(value) = &value {
            self.note(place, value);
        }
        if let Some(before) = scope.bind(&name.value, Bound { value, place }) {
            self.reporter.push(|| {
                let free = fixes::free(&name.value, |n| scope.value(n).is_some());
                say::named_twice(place, &name.value, before, &free)
            });
        }
    }

    /// Records the value of a place, if requested.
    pub(super) fn note(&self, place: Span, value: &Value) {
        if let Some(values) = self.setting.values {
            values.note(place, value, self.storeys.number);
        }
    }

    fn bound(&mut self, of: &Attributes<'_>, name: &str, scope: &Scope<'a>) -> Option<f64> {
        let attribute = of.get(name)?;
        match self.value(&attribute.value, scope)? {
            Value::Number(number) => Some(number),
            found => {
                let text = found.to_string();
                self.reporter.at(&attribute.value.whole(), |s| {
                    say::not_a_number(s, name, &text, None)
                });
                None
            }
        }
    }

    /// Evaluates an attribute as a truth value; false if it is missing or invalid, which is reported.
    fn truth(&mut self, of: &Attributes<'_>, name: &str, scope: &Scope<'a>) -> bool {
        let Some(attribute) = of.get(name) else {
            return false;
        };
        match self.value(&attribute.value, scope) {
            Some(Value::Truth(truth)) => truth,
            Some(found) => {
                let text = found.to_string();
                self.reporter.at(&attribute.value.whole(), |s| {
                    say::not_a_choice(s, name, &text, &["yes", "no"], None)
                });
                false
            }
            None => false,
        }
    }

    /// Returns the weights of the values of a parameter, and their place.
    fn weights(&mut self, of: &Attributes<'_>, scope: &Scope<'a>) -> Option<(Vec<f64>, Span)> {
        let place = of.get("weights")?.value.whole();
        let words = self.words(of, "weights", scope)?;
        let pieces = words.split(|c: char| c == ',' || c.is_whitespace());
        let mut weights = vec![];
        for piece in pieces.filter(|p| !p.is_empty()) {
            match Value::read(piece) {
                Value::Number(weight) if (0.0..=1e9).contains(&weight) => weights.push(weight),
                _ => {
                    self.reporter
                        .at(&place, |s| say::not_a_number(s, "weights", piece, None));
                    return None;
                }
            }
        }
        Some((weights, self.reporter.span(&place)))
    }

    fn choices(&mut self, of: &Attributes<'_>, scope: &Scope<'a>) -> Vec<Value> {
        let words = self.words(of, "choices", scope).unwrap_or_default();
        let comma = words.contains(',');
        let pieces = words.split(|c: char| if comma { c == ',' } else { c.is_whitespace() });
        let pieces = pieces.map(str::trim).filter(|p| !p.is_empty());
        pieces.map(Value::read).collect()
    }

    fn words(&mut self, of: &Attributes<'_>, name: &str, scope: &Scope<'a>) -> Option<String> {
        let filled = self.filled(&of.get(name)?.value, scope)?;
        Some(filled.as_str().trim().to_owned())
    }
}

/// Returns the name with only letters, digits and `_`; empty if nothing is left.
fn plain_name(name: &str) -> String {
    let plain: String = name
        .chars()
        .map(|c| if c.is_alphanumeric() { c } else { '_' })
        .collect();
    let plain = if expr::RESERVED.contains(&name) {
        format!("{plain}_")
    } else {
        plain
    };
    if expr::is_name(&plain) {
        plain
    } else {
        String::new()
    }
}
