//! Random choices made while a file is read: the `choice` that replaces a `random`, and the values of parameters that
//! are not set.
//!
//! The key of a choice is its path in the output: the seed, the name or the number of the house, then for each element
//! on the path its kind and its number among those of its kind; last the number of the `random` in its element, or the
//! name of the parameter. So only edits beside it, or beside its ancestors, change a choice. These keys are part of the
//! language, as those of [`hsd_base::rng`] are.

use super::super::read::check;
use super::super::tree::Child;
use super::{ElementRef, Expander, Scope};
use crate::parse::schema;
use crate::parse::schema::Tag;
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::{Parameter, Value};
use hsd_ir::messages::parts;
use hsd_ir::messages::xml as say;

/// The number of values of a parameter without a step.
const FINE: f64 = 1000.0;

/// The open output elements.
pub(super) struct Open<'a> {
    /// The seed of the run.
    seed: Option<u64>,
    /// The open elements, outermost first; the first one is the file.
    levels: Vec<OpenElement<'a>>,
    /// The number of houses so far.
    houses: u64,
    /// True if a `random` has chosen since this was last reset.
    drawn: bool,
}

/// An open element.
struct OpenElement<'a> {
    place: Place,
    /// The number of elements so far by kind; an element contains few kinds.
    kinds: Vec<(&'a str, u64)>,
    /// The number of random choices made directly in it.
    draws: u64,
}

impl OpenElement<'_> {
    fn new(place: Place) -> Self {
        OpenElement {
            place,
            kinds: vec![],
            draws: 0,
        }
    }
}

impl<'a> Open<'a> {
    /// Creates the state at the start of a file, or after so many houses of it.
    pub(super) fn outermost(seed: Option<u64>, houses: u64) -> Self {
        Open {
            seed,
            levels: vec![OpenElement::new(Place::seed(seed.unwrap_or(0)))],
            houses,
            drawn: false,
        }
    }

    /// Creates the state at a feature of a map, whose place keys its choices.
    pub(super) fn at_place(seed: Option<u64>, place: Place) -> Self {
        Open {
            seed,
            levels: vec![OpenElement::new(place)],
            houses: 0,
            drawn: false,
        }
    }

    /// Returns the place that the next element of this kind in the current one will have.
    pub(super) fn ahead(&self, kind: &str) -> Place {
        let Some(level) = self.levels.last() else {
            return Place::seed(0);
        };
        let known = level.kinds.iter().find(|(k, _)| *k == kind);
        let number = known.map_or(0, |(_, count)| count + 1);
        level.place.named(kind).at(number)
    }

    /// Counts an element of this kind in the current one.
    pub(super) fn pass(&mut self, kind: &'a str) {
        self.place_of(kind);
    }

    /// Resets the record of choices, and returns whether there were any.
    pub(super) fn forget(&mut self) -> bool {
        std::mem::take(&mut self.drawn)
    }

    /// Returns true if a random choice was made since the last reset.
    pub(super) fn has_drawn(&self) -> bool {
        self.drawn
    }

    /// Restores the record of earlier choices.
    pub(super) fn remember(&mut self, drawn: bool) {
        self.drawn |= drawn;
    }

    /// Returns the place of an element of this kind in the current one.
    fn place_of(&mut self, kind: &'a str) -> Option<Place> {
        let level = self.levels.last_mut()?;
        let number = match level.kinds.iter_mut().find(|(k, _)| *k == kind) {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                level.kinds.push((kind, 0));
                0
            }
        };
        Some(level.place.named(kind).at(number))
    }

    /// Returns the place of the next random choice in the current element.
    fn next(&mut self) -> Place {
        self.drawn = true;
        let Some(level) = self.levels.last_mut() else {
            return Place::seed(0);
        };
        level.draws += 1;
        level.place.named("random").at(level.draws - 1)
    }
}

/// Returns true if a `random` chooses among `choice` elements, not among codes.
pub(super) fn is_choice(element_ref: &ElementRef<'_, '_>) -> bool {
    let holds = |child: &Child<'_>| match child {
        Child::Element(index) => element_ref.child(*index).tag() == Some(Tag::Choice),
        Child::Text(_) => false,
    };
    element_ref.tag() == Some(Tag::Random) && element_ref.element().children.iter().any(holds)
}

impl<'a> Expander<'a, '_> {
    /// Enters an output element.
    pub(super) fn enter(&mut self, element_ref: &ElementRef<'_, 'a>, made: usize) {
        let place = match element_ref.tag() {
            Some(Tag::House) => Some(self.place_of_house(made)),
            _ => self.open.place_of(element_ref.element().name),
        };
        let place = place.unwrap_or(Place::seed(0));
        self.open.levels.push(OpenElement::new(place));
    }

    /// Leaves it.
    pub(super) fn leave(&mut self) {
        self.open.levels.pop();
    }

    /// Returns the place of a house, as for random choices among codes.
    fn place_of_house(&mut self, made: usize) -> Place {
        let number = self.open.houses;
        self.open.houses += 1;
        let written = |name: &str| {
            let mut attributes = self.made.elements[made].attributes.iter();
            let found = attributes.find(|a| a.name == name)?;
            Some(found.value.as_str().trim())
        };
        let seed = self
            .open
            .seed
            .or_else(|| written("seed").and_then(|s| s.parse().ok()));
        let root = Place::seed(seed.unwrap_or(0));
        match written("name") {
            Some(name) => root.named(name),
            None => root.at(number),
        }
    }

    /// Replaces a `random` by one of its choices.
    pub(super) fn choose(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        for attribute in element.attributes.iter().filter(|a| !a.is_foreign()) {
            let whole = self.reporter.with_gap(&attribute.range);
            self.reporter.at(&attribute.name_range, |s| {
                say::attribute_beside_choices(s, attribute.name, whole)
            });
        }
        let (mut choices, mut sums, mut sum) = (vec![], vec![], 0.0);
        for child in &element.children {
            let child = match child {
                Child::Element(index) => element_ref.child(*index),
                Child::Text(text) => {
                    let fix = self.chosen(&text.whole());
                    self.reporter
                        .at(&text.whole(), |s| say::beside_choices(s, fix));
                    continue;
                }
            };
            if child.tag() != Some(Tag::Choice) {
                let place = child.element().name_range.clone();
                let fix = self.chosen(&child.element().range);
                self.reporter.at(&place, |s| say::beside_choices(s, fix));
                continue;
            }
            sum += self.weight(&child, scope);
            sums.push(sum);
            choices.push(child);
        }
        let place = self.open.next();
        self.note_local();
        if sum <= 0.0 {
            let span = self.reporter.span(&element.name_range);
            self.reporter.push(|| say::no_weight(span, None));
            return;
        }
        let chosen = &choices[place.pick(&sums)];
        self.inside(&chosen.element().name_range, into, |expander| {
            expander.list(chosen, scope, into);
        });
    }

    /// Returns the weight of a choice: 1 if it is missing or invalid.
    fn weight(&mut self, element_ref: &ElementRef<'_, 'a>, scope: &Scope<'a>) -> f64 {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return 1.0;
        };
        let of = check(self.reporter, &mut self.suggest, schema, element);
        let Some(attribute) = of.get("weight") else {
            return 1.0;
        };
        let given = match self.value(&attribute.value, scope) {
            Some(Value::Number(number)) => number,
            Some(found) => {
                let text = found.to_string();
                self.reporter.at(&attribute.value.whole(), |s| {
                    say::not_a_number(s, "weight", &text, None)
                });
                return 1.0;
            }
            None => return 1.0,
        };
        if (0.0..=1e9).contains(&given) {
            return given;
        }
        let text = given.to_string();
        self.reporter.at(&attribute.value.whole(), |s| {
            let bounds = text!(
                "a number from 0 to 1000000000",
                "0 から 1000000000 までの数"
            );
            let near = given.abs().min(1e9).to_string();
            say::out_of_range(s, "weight", &text, bounds, Some(&near))
        });
        1.0
    }

    /// Chooses the value of a parameter that is not set, in a run with a seed. `weights` are those as written.
    pub(super) fn drawn(
        &mut self,
        of: &Parameter,
        weights: Option<&(Vec<f64>, Span)>,
        span: Span,
    ) -> Option<Value> {
        let seed = self.placed.last().and_then(|placed| placed.seed());
        let place = match (of.random, seed) {
            (false, _) => return None,
            (true, None) => {
                self.note_local();
                self.open.levels.last()?.place
            }
            // The same house for the same seed, wherever it stands.
            (true, Some(seed)) => Place::seed(self.open.seed.unwrap_or(0)).at(seed),
        };
        let place = place.named("param").named(&of.name);
        let values = values(of);
        let Some(values) = values else {
            self.reporter.push(|| say::nothing_to_draw(span, &of.name));
            return None;
        };
        let weights = match weights {
            Some((weights, at)) => self.fitting(weights, *at, values.count()),
            None => None,
        };
        seed.or(self.open.seed)?;
        let index = match weights {
            Some(weights) => {
                let add = |sum: &mut f64, weight: &f64| {
                    *sum += weight;
                    Some(*sum)
                };
                let sums: Vec<f64> = weights.iter().scan(0.0, add).collect();
                place.pick(&sums)
            }
            None => (place.share() * values.count() as f64) as usize,
        };
        Some(values.at(index))
    }

    /// Returns the weights, if there are as many as values and one of them is positive.
    fn fitting<'w>(&mut self, weights: &'w [f64], span: Span, values: usize) -> Option<&'w [f64]> {
        if weights.len() != values {
            let given = weights.len();
            self.reporter
                .push(|| parts::weight_count(span, given, values, None));
            return None;
        }
        if weights.iter().sum::<f64>() <= 0.0 {
            self.reporter.push(|| say::no_weight(span, Some(values)));
            return None;
        }
        Some(weights)
    }
}

/// The values that a parameter accepts.
enum Values<'p> {
    Listed(&'p [Value]),
    Truths,
    /// The minimum, the step, and the number of values.
    Numbers(f64, f64, usize),
}

impl Values<'_> {
    fn count(&self) -> usize {
        match self {
            Values::Listed(values) => values.len(),
            Values::Truths => 2,
            Values::Numbers(_, _, count) => *count,
        }
    }

    fn at(&self, index: usize) -> Value {
        let index = index.min(self.count().saturating_sub(1));
        match self {
            Values::Listed(values) => values[index].clone(),
            Values::Truths => Value::Truth(index == 0),
            // Steps of a tenth accumulate digits that nobody would have written.
            Values::Numbers(least, step, _) => {
                Value::Number(((least + step * index as f64) * 1e9).round() / 1e9)
            }
        }
    }
}

/// Returns the values of a parameter, if they can be enumerated.
fn values(of: &Parameter) -> Option<Values<'_>> {
    if !of.choices.is_empty() {
        return Some(Values::Listed(&of.choices));
    }
    if let Some(Value::Truth(_)) = of.default {
        return Some(Values::Truths);
    }
    let (least, most) = (of.min?, of.max?);
    let step = of.step.unwrap_or((most - least) / FINE);
    let steps = if step > 0.0 {
        (most - least) / step
    } else {
        0.0
    };
    Some(Values::Numbers(
        least,
        step,
        (steps + 1e-9).clamp(0.0, 1e9) as usize + 1,
    ))
}
