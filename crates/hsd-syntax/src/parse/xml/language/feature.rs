//! `for`: its content, evaluated for each feature of a map. In it expressions know the fields and measures of the
//! feature and the functions `draw` and `look`; a `Place` asks the feature's site where a house can stand.
//!
//! Draws are keyed by the seed of the town, the place of the feature, and the path of the element in its `for`: never by
//! the order of features.

use super::super::tree::{Element, Tree};
use super::draws::Open;
use super::facts::{has, is_outdoors};
use super::scope::Frame;
use super::{ElementRef, Expander, Scope};
use crate::messages::town;
use crate::parse::expr::{self, Meanings, Problem};
use crate::parse::schema::Tag;
use hsd_base::diagnostic::{Noun, noun};
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{Known, RuleFacts, Site, Stood, Unfound};
use hsd_ir::messages::xml as say;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// The evaluation at a feature.
#[derive(Default)]
pub(super) struct AtFeature<'a, 'f> {
    pub(super) site: Option<&'f dyn Site>,
    /// The rules of the town, in the order of the file.
    rules: Vec<Rule<'a>>,
    /// What their texts say.
    pub(super) facts: RuleFacts,
    /// The seed of the town, where the run gives none.
    seed: u64,
    /// True once a field was asked for that the feature lacks.
    lacks: bool,
    /// How many features lacked a field, by the first place that asked.
    missing: BTreeMap<(Span, String), usize>,
    /// Where the houses of elements stand, by the index of the element.
    pub(super) stood: BTreeMap<usize, Stood>,
    /// The parameters of placed houses and their values, by the index of the element.
    pub(super) given: BTreeMap<usize, Vec<(String, Value)>>,
    /// The attribute that is being evaluated, which keys its draws.
    drawing: Option<Place>,
}

/// A `for` and the names known where it stands.
struct Rule<'a> {
    tree: Rc<Tree<'a>>,
    index: usize,
    scope: Scope<'a>,
    layer: String,
}

/// The names and functions of an expression.
pub(super) struct Names<'e, 'a, 'f> {
    pub(super) expander: &'e Expander<'a, 'f>,
    pub(super) scope: &'e Scope<'a>,
    /// The number of unnamed draws so far.
    pub(super) drawn: Cell<u64>,
}

impl Meanings for Names<'_, '_, '_> {
    fn value(&self, name: &str) -> Result<Value, Problem> {
        let (expander, scope) = (self.expander, self.scope);
        if name == "k" {
            expander.storeys.asked.set(true);
            expander.note_local();
            let number = expander.storeys.number.ok_or(Problem::NoStorey)?;
            return Ok(Value::Number(number as f64));
        }
        if let Some(site) = expander.feature.site
            && scope.knows_feature()
        {
            if let Some(bound) = scope.nearer_value(name) {
                return bound.value.ok_or(Problem::Reported);
            }
            match site.value(name) {
                Known::Value(value) => return Ok(value),
                Known::Missing => return Err(Problem::Missing(name.to_owned())),
                Known::Unknown => {}
            }
        }
        match scope.value(name) {
            Some(bound) => bound.value.ok_or(Problem::Reported),
            None if name == expr::PI => Ok(Value::Number(std::f64::consts::PI)),
            None => Err(Problem::Unknown(name.to_owned())),
        }
    }

    fn call(&self, function: &str, arguments: &[Value]) -> Option<Result<Value, Problem>> {
        let site = self.expander.feature.site?;
        if !self.scope.knows_feature() {
            return None;
        }
        Some(match function {
            "draw" => self.draw(arguments),
            "look" => look(site, arguments),
            _ => randloc(site, arguments),
        })
    }
}

impl Names<'_, '_, '_> {
    /// `draw(a)`, `draw(a, b)`, `draw('name', ...)`: a uniform number from 0 to a, or from a to b.
    fn draw(&self, arguments: &[Value]) -> Result<Value, Problem> {
        const WANTED: Noun = noun(
            "one or two numbers, after a name in quotes or not",
            "1 個か 2 個の数値（前に引用符付きの名を書ける）",
        );
        let (name, numbers) = match arguments {
            [Value::Text(name), numbers @ ..] => (Some(name), numbers),
            numbers => (None, numbers),
        };
        let (from, to) = match numbers {
            [Value::Number(to)] => (0.0, *to),
            [Value::Number(from), Value::Number(to)] => (*from, *to),
            _ => {
                return Err(Problem::Arguments {
                    function: "draw".to_owned(),
                    wanted: WANTED,
                    found: arguments.len(),
                });
            }
        };
        let place = match name {
            Some(name) => self.expander.place_of_feature().named("draw").named(name),
            None => {
                self.expander.note_local();
                let number = self.drawn.replace(self.drawn.get() + 1);
                let drawing = self.expander.feature.drawing;
                let place = drawing.unwrap_or_else(|| self.expander.place_of_feature());
                place.named("draw").at(number)
            }
        };
        Ok(Value::Number(from + place.share() * (to - from)))
    }
}

/// `look(table, key, column)`: the cell of a table.
fn look(site: &dyn Site, arguments: &[Value]) -> Result<Value, Problem> {
    let [Value::Text(table), key, Value::Text(column)] = arguments else {
        return Err(Problem::Arguments {
            function: "look".to_owned(),
            wanted: noun(
                "a table in quotes, a key, and a column in quotes",
                "引用符で囲んだ表の名、キー、引用符で囲んだ列の名",
            ),
            found: arguments.len(),
        });
    };
    site.look(table, key, column)
        .map_err(|Unfound { argument, known }| {
            let word = [table.clone(), key.to_string(), column.clone()];
            Problem::Unfound(argument, word[argument.min(2)].clone(), known)
        })
}

/// `randloc(decimals)`: the published draw from 0 to 99, by the last digits of both coordinates (000-60).
fn randloc(site: &dyn Site, arguments: &[Value]) -> Result<Value, Problem> {
    let decimals = match arguments {
        [] => 2.0,
        [Value::Number(decimals)] if (0.0..=6.0).contains(decimals) => *decimals,
        _ => {
            return Err(Problem::Arguments {
                function: "randloc".to_owned(),
                wanted: noun("the number of decimals, 0 to 6", "小数の桁数 0 から 6"),
                found: arguments.len(),
            });
        }
    };
    let scale = libm::pow(10.0, decimals.floor());
    let digit = |name: &str| match site.value(name) {
        Known::Value(Value::Number(at)) => (at.abs() * scale + 1e-6).floor() % 10.0,
        _ => 0.0,
    };
    Ok(Value::Number(10.0 * digit("x") + digit("y")))
}

impl<'a, 'f> Expander<'a, 'f> {
    /// Records a `for`, whose content waits for features; its bare element stays.
    pub(super) fn rule(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        let mut each = element.attributes.iter().filter(|a| a.name == "each");
        let layer = each.next().and_then(|each| self.filled(&each.value, scope));
        let made = self.made.elements.len();
        let mut attributes = element.attributes.clone();
        for attribute in attributes.iter_mut().filter(|a| a.name == "each") {
            self.fill_attribute(attribute, scope);
        }
        self.made.elements.push(Element {
            attributes,
            ..super::places::bare(element)
        });
        self.made.elements[into]
            .children
            .push(super::Child::Element(made));
        self.fronts_in(element_ref);
        if let Some(layer) = layer {
            let (name, facts) = (layer.as_str().trim().to_owned(), &mut self.feature.facts);
            if !is_outdoors(element_ref) {
                facts.housed.push(name.clone());
            }
            if has(element_ref, Tag::Road) {
                facts.roads.push(name.clone());
            }
            if has(element_ref, Tag::Network) {
                facts.networks.push(name.clone());
            }
            if has(element_ref, Tag::Water) {
                facts.waters.push(name.clone());
            }
            if has(element_ref, Tag::Zone) {
                facts.zones.push(name);
            }
            self.feature.rules.push(Rule {
                tree: Rc::clone(element_ref.tree),
                index: element_ref.index,
                scope: Rc::clone(scope),
                layer: layer.as_str().trim().to_owned(),
            });
        }
    }

    /// Returns the place that keys the draws of the feature.
    pub(super) fn place_of_feature(&self) -> Place {
        let seed = self.setting.seed.unwrap_or(self.feature.seed);
        let (x, y) = self.feature.site.map_or((0, 0), Site::key);
        Place::seed(seed)
            .named("place")
            .at(x.cast_unsigned())
            .at(y.cast_unsigned())
    }

    /// Evaluates a rule at a feature of a layer; returns the index of the element that holds what it makes. `None` if it
    /// does not apply.
    fn apply(&mut self, rule: usize, layer: &str, site: &'f dyn Site) -> Option<usize> {
        if self.feature.rules[rule].layer != layer {
            return None;
        }
        let rule = &self.feature.rules[rule];
        let (tree, index) = (Rc::clone(&rule.tree), rule.index);
        let frame = Frame::of_feature(&rule.scope);
        let element_ref = ElementRef { tree: &tree, index };
        let element = element_ref.element();
        self.feature.site = Some(site);
        self.feature.stood.clear();
        self.feature.given.clear();
        self.files.names.clear();
        self.limit = self.setting.limits.parts as u64;
        self.room = self.limit;
        self.over = false;
        self.open = Open::at_place(self.setting.seed, self.place_of_feature());
        let test = element.attributes.iter().find(|a| a.name == "test");
        let applies = test.is_none_or(|test| self.holds(&test.value, &frame));
        let made = applies.then(|| {
            let made = self.made.elements.len();
            self.made.elements.push(super::places::bare(element));
            self.inside(&element.name_range, made, |expander| {
                expander.list(&element_ref, &frame, made);
            });
            made
        });
        self.feature.site = None;
        made
    }

    /// Evaluates a test; one that asks for a field that the feature lacks does not hold.
    fn holds(&mut self, test: &super::Text<'a>, scope: &Scope<'a>) -> bool {
        self.feature.drawing = Some(self.place_of_feature().named("test"));
        let value = self.value(test, scope);
        self.feature.drawing = None;
        match value {
            Some(Value::Truth(truth)) => truth,
            Some(found) => {
                let quoted = test.as_str();
                self.reporter.at(&test.whole(), |s| {
                    say::test_no_truth(s, quoted, &found, false)
                });
                false
            }
            None => false,
        }
    }

    /// Records that the feature lacks a field.
    pub(super) fn lacks(&mut self, name: &str, place: &Range<usize>) {
        self.feature.lacks = true;
        self.note_local();
        let span = self.reporter.span(place);
        let key = (span, name.to_owned());
        *self.feature.missing.entry(key).or_default() += 1;
    }

    /// Returns true if a field was missing since this was last asked.
    pub(super) fn take_lacks(&mut self) -> bool {
        std::mem::take(&mut self.feature.lacks)
    }

    /// Returns all names known here.
    pub(super) fn names_in(&self, scope: &Scope<'a>) -> Vec<String> {
        let mut names = match self.feature.site {
            Some(site) if scope.knows_feature() => site.names(),
            _ => vec![],
        };
        names.extend(scope.names());
        names
    }

    /// Returns the functions known here.
    pub(super) fn functions(&self, scope: &Scope<'a>) -> Vec<&'static str> {
        let town = self.feature.site.is_some() && scope.knows_feature();
        let more = town.then_some(expr::TOWN_FUNCTIONS).into_iter().flatten();
        expr::FUNCTIONS.into_iter().chain(more).collect()
    }

    /// Keys the draws of an attribute; returns the key before.
    pub(super) fn key_draws(&mut self, element: &'a str, attribute: &str) -> Option<Place> {
        let before = self.feature.drawing;
        if self.feature.site.is_some() {
            let place = self.open.ahead(element).named(attribute);
            self.feature.drawing = Some(place);
        }
        before
    }

    /// Restores the key of draws.
    pub(super) fn restore_draws(&mut self, before: Option<Place>) {
        self.feature.drawing = before;
    }

    /// Returns the value that the feature offers for a parameter that nobody sets: that of a field or measure of its
    /// name, held within the bounds of the parameter.
    pub(super) fn offered(&mut self, to: &hsd_ir::ast::Parameter) -> Option<Value> {
        let value = self.measure(&to.name)?;
        if !to.choices.is_empty() {
            return to.choices.contains(&value).then_some(value);
        }
        if to.default.as_ref().is_some_and(|d| !d.is_like(&value)) {
            return None;
        }
        let Value::Number(number) = value else {
            return to.admits(&value).then_some(value);
        };
        let least = to.min.unwrap_or(f64::MIN);
        let most = to.max.unwrap_or(f64::MAX).max(least);
        // Lengths of maps are metres; a type that counts in other units takes whole steps of its own.
        let metres = to.unit.as_deref().is_none_or(|unit| unit == "m");
        let scaled = match to.unit.as_deref() {
            Some(unit) if !metres => in_units(number, unit).unwrap_or(number),
            _ => number,
        };
        let stepped = match to.step {
            Some(step) if !metres => (scaled / step + 1e-9).floor() * step,
            None if !metres => scaled.floor(),
            _ => scaled,
        };
        let number = stepped;
        let kept = number.clamp(least, most);
        if to.name == "frontage" && kept < number - 0.05 {
            self.placed.last_mut()?.widest = Some(kept);
        }
        Some(Value::Number(kept))
    }

    /// Returns the value of a field or measure for the house that is being placed.
    pub(super) fn measure(&self, name: &str) -> Option<Value> {
        let placed = self.placed.last()?;
        let stood = placed.stood.as_ref()?;
        match name {
            _ if placed.uses != self.uses.len() => None,
            "frontage" => Some(Value::Number(stood.frontage)),
            "depth" => Some(Value::Number(stood.depth)),
            name => match self.feature.site?.value(name) {
                Known::Value(value) => Some(value),
                Known::Missing | Known::Unknown => None,
            },
        }
    }

    /// Reports attributes of a `Place` that a town takes from the map.
    pub(super) fn place_in_town(&mut self, element: &Element<'a>) {
        let taken = ["x", "y", "z", "azimuth", "at"];
        for attribute in element
            .attributes
            .iter()
            .filter(|a| taken.contains(&a.name))
        {
            let whole = self.reporter.with_gap(&attribute.range);
            self.reporter.at(&attribute.name_range, |s| {
                town::place_is_given(s, attribute.name, whole)
            });
        }
    }
}

/// Returns a length in metres in the unit of a parameter; `None` if it is no unit of length.
fn in_units(metres: f64, unit: &str) -> Option<f64> {
    let shaku = metres / hsd_base::geometry::SHAKU;
    Some(match unit {
        "shaku" => shaku,
        "ken" => shaku / 6.0,
        "U" | "u" | "units" => shaku / super::super::UNIT,
        _ => return None,
    })
}

/// The rules of a town, ready to be evaluated at features.
pub(in crate::parse::xml) struct Rules<'a, 'f> {
    expander: Expander<'a, 'f>,
    /// The number of elements that belong to no feature.
    base: usize,
}

/// Where the houses of elements stand, and the parameters of placed ones.
pub(in crate::parse::xml) type FeatureState<'s> = (
    &'s mut BTreeMap<usize, Stood>,
    &'s mut BTreeMap<usize, Vec<(String, Value)>>,
);

impl<'a, 'f> Rules<'a, 'f> {
    /// Evaluates the town itself.
    pub(in crate::parse::xml) fn new(
        tree: &Rc<Tree<'a>>,
        setting: crate::parse::ReadContext<'a>,
        nesting: usize,
        trees: &'f mut super::Trees<'a>,
        reporter: &'f mut super::Reporter<'a>,
    ) -> Self {
        let mut expander = Expander::new(setting, nesting, trees, reporter);
        let scope = Frame::outermost();
        for root in &tree.roots {
            expander.copy(tree, *root, &scope);
        }
        let seed = expander.made.elements.first().and_then(|town| {
            let mut attributes = town.attributes.iter();
            let seed = attributes.find(|a| a.name == "seed")?;
            seed.value.as_str().trim().parse().ok()
        });
        expander.feature.seed = seed.unwrap_or(0);
        let base = expander.made.elements.len();
        Rules { expander, base }
    }

    /// Returns the number of rules.
    pub(in crate::parse::xml) fn len(&self) -> usize {
        self.expander.feature.rules.len()
    }

    /// Evaluates a rule at a feature of a layer, and reads what it makes from an element of the tree; `None` if the rule
    /// does not apply.
    pub(in crate::parse::xml) fn apply<T>(
        &mut self,
        rule: usize,
        layer: &str,
        site: &'f dyn Site,
        read: impl FnOnce(&Tree<'a>, usize, FeatureState<'_>, &mut super::Reporter<'a>) -> T,
    ) -> Option<T> {
        let expander = &mut self.expander;
        let index = expander.apply(rule, layer, site);
        let made = index.map(|index| {
            let state = (&mut expander.feature.stood, &mut expander.feature.given);
            read(&expander.made, index, state, expander.reporter)
        });
        expander.made.elements.truncate(self.base);
        made
    }

    /// Returns the gravest problem since this was last asked.
    pub(in crate::parse::xml) fn take_problem(
        &mut self,
    ) -> Option<(hsd_base::diagnostic::Severity, hsd_base::diagnostic::Code)> {
        self.expander.reporter.take_problem()
    }

    /// Returns how often fields were missing, by place and name.
    pub(in crate::parse::xml) fn finish(self) -> BTreeMap<(Span, String), usize> {
        self.expander.feature.missing
    }
}
