//! What the elements of a `for` do at a feature: `Place` and `House` ask its site where they stand.

use super::super::read::check;
use super::super::tree::token::Attribute;
use super::super::tree::{Child, Element};
use super::places::{Arguments, Filled, Origin, Placed, bare};
use super::scope::Frame;
use super::{ELEMENT, ElementRef, Expander, Scope};
use crate::parse::schema;
use crate::parse::schema::Kind;
use crate::parse::schema::lengths::{Measure, length};
use crate::parse::xml::tree::text::Text;
use crate::templates::GROUNDS;
use hsd_base::source::Spanned;
use hsd_ir::ast::town::{GapAt, PlaceOn, Stood, Wish};
use hsd_ir::ast::{Parameter, Value};
use hsd_ir::messages::xml as say;
use std::collections::BTreeMap;

/// The attribute that says where something comes from.
const EVIDENCE: &str = "evidence";

impl<'a> Expander<'a, '_> {
    /// Replaces a `Place` in a `for` by the houses that it means, at the place that the site of the feature finds.
    pub(super) fn place_at_feature(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        (own, arguments): (Vec<Attribute<'a>>, Arguments<'a>),
        kind: &Attribute<'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let Some(site) = self.feature.site else {
            return;
        };
        self.place_in_town(element_ref.element());
        let before = self.made.elements.len();
        let text = |name: &str| {
            let found = own.iter().find(|a| a.name == name)?;
            Some(found.value.as_str().trim().to_owned()).filter(|text| !text.is_empty())
        };
        let (word, front) = (kind.value.as_str().trim().to_owned(), text("front"));
        let mut wish = Wish {
            span: self.reporter.span(&kind.value.whole()),
            kind: &word,
            on: self.ground(&own, kind, scope),
            front: front.as_deref(),
            cap: self.metres(&own, "cap"),
            gaps: self.gaps(&own),
            widest: None,
        };
        // Twice, if the type turns out to be too narrow for the front.
        for _ in 0..2 {
            let Some(stood) = site.stand(&wish) else {
                return;
            };
            let Some(origin) = self.origin(kind, scope) else {
                return;
            };
            let placed = Placed {
                name: text("name"),
                seed: Some(self.seed_of_feature(&own, kind)),
                stood: Some(stood.clone()),
                uses: self.uses.len(),
                ..Placed::new(kind.clone(), arguments.clone())
            };
            let own = standing(&own, kind, &stood);
            let tried = self.fill_at_feature(element_ref, own, placed, origin);
            let Some((made, filled)) = tried else { return };
            if filled.widest.is_some() && wish.widest.is_none() && stood.walls.is_none() {
                wish.widest = filled.widest;
                self.made.elements.truncate(before);
                self.files.names.clear();
                continue;
            }
            self.feature.stood.insert(made, stood);
            self.feature.given.insert(made, filled.values);
            self.made.elements[into].children.push(Child::Element(made));
            return;
        }
    }

    /// Returns how much of its front a `Place` leaves free on the left and on the right, metres.
    fn gaps(&mut self, own: &[Attribute<'a>]) -> [f64; 2] {
        let gap_at = self.word_of(own, "gap_at", &GapAt::WORDS);
        let mut gap = |name| self.metres(own, name).unwrap_or(0.0);
        let [left, right] = gap_at.unwrap_or_default().divide(gap("gap"));
        [left + gap("gap_left"), right + gap("gap_right")]
    }

    /// Makes a `Place` with these attributes and puts the houses of a type into it.
    pub(super) fn fill_at_feature(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        attributes: Vec<Attribute<'a>>,
        placed: Placed<'a>,
        origin: Origin<'a>,
    ) -> Option<(usize, Filled)> {
        let element = element_ref.element();
        let made = self.made.elements.len();
        self.made.elements.push(Element {
            attributes,
            ..bare(element)
        });
        if !self.take(ELEMENT, &element.name_range) {
            return None;
        }
        self.enter(element_ref, made);
        let filled = self.fill(element, placed, origin, made);
        self.leave();
        Some((made, filled?))
    }

    /// Replaces a `Residence` or a `Block` by what the library says of it: walls, a gate, houses and trees.
    pub(super) fn grounds_at_feature(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        let Some(schema) = schema::named(element.name) else {
            return;
        };
        let named_only = Element {
            attributes: element.attributes.clone(),
            ..bare(element)
        };
        check(self.reporter, &mut self.suggest, schema, &named_only);
        let (mut arguments, mut evidence) = (BTreeMap::new(), None);
        for attribute in &element.attributes {
            let before = self.key_draws(element.name, attribute.name);
            if attribute.name == EVIDENCE {
                let mut filled = attribute.clone();
                self.fill_attribute(&mut filled, scope);
                evidence = Some(filled);
            } else if schema.attribute(attribute.name).is_some() {
                let value = self.value(&attribute.value, scope);
                arguments.insert(attribute.name.to_owned(), (attribute, value));
            }
            self.restore_draws(before);
        }
        let span = self.reporter.span(&element.name_range);
        let Some(path) = self.template(&GROUNDS) else {
            return;
        };
        let Some(source) = self.setting.cache.find(&path) else {
            return;
        };
        let Some(tree) = self.placed_tree(&path, source) else {
            return;
        };
        let first = self.made.elements[into].children.len();
        let place = self.reporter.span(&element.tag);
        let outside = self.reporter.instead(Some((source.id(), place)));
        self.files.open.push((path, span));
        // Types that the town defines are known there too.
        let home = Frame::within(scope);
        self.definitions(&tree, &home);
        let name = Spanned::new(element.name.to_owned(), span);
        if let Some((piece, home)) = home.piece(&name.value) {
            self.put_piece(element, (&name, piece, &home), arguments, into);
        }
        self.files.open.pop();
        self.reporter.instead(outside);
        if let Some(evidence) = evidence {
            self.give_evidence(&evidence, into, first);
        }
    }

    /// Gives the children of an element from this one on the attribute that says where they come from.
    fn give_evidence(&mut self, evidence: &Attribute<'a>, into: usize, first: usize) {
        for n in first..self.made.elements[into].children.len() {
            let Child::Element(index) = self.made.elements[into].children[n] else {
                continue;
            };
            let made = &mut self.made.elements[index];
            // A `Skip` has none.
            if schema::named(made.name).is_some_and(|s| s.attribute(EVIDENCE).is_some()) {
                made.attributes.push(evidence.clone());
            }
        }
    }

    /// Copies a house that is written in a `for`.
    pub(super) fn house_at_feature(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let Some(site) = self.feature.site else {
            return;
        };
        let wish = Wish {
            span: self.reporter.span(&element_ref.element().tag),
            kind: "",
            on: None,
            front: None,
            cap: None,
            gaps: [0.0; 2],
            widest: None,
        };
        let Some(stood) = site.stand(&wish) else {
            return;
        };
        if let Some(made) = self.copy(element_ref.tree, element_ref.index, scope) {
            self.feature.stood.insert(made, stood);
            self.made.elements[into].children.push(Child::Element(made));
        }
    }

    /// Gives a house that is written in a `for` a seed by the place of the feature, if it has none.
    pub(super) fn seed_house(&self, attributes: &mut Vec<Attribute<'a>>, element: &Element<'a>) {
        let there = attributes.iter().any(|a| a.name == "seed");
        if self.feature.site.is_none() || !self.placed.is_empty() || there {
            return;
        }
        let place = element.name_range.clone();
        attributes.push(Attribute {
            name: "seed",
            name_range: place.clone(),
            value: Text::instead(self.place_of_feature().key().to_string(), place.clone()),
            range: place,
            faulty: false,
        });
    }

    /// Returns true for an attribute of a `Place` that only means something in a town but sets a parameter here.
    pub(super) fn is_for_type(&mut self, attribute: &Attribute<'a>, scope: &Scope<'a>) -> bool {
        const OWN: [&str; 8] = [
            "on",
            "front",
            "cap",
            "gap",
            "gap_at",
            "gap_left",
            "gap_right",
            "evidence",
        ];
        if !OWN.contains(&attribute.name) {
            return false;
        }
        let Some(site) = self.feature.site.filter(|_| self.placed.is_empty()) else {
            return true;
        };
        if attribute.name != "front" {
            return false;
        }
        let word = self.filled(&attribute.value, scope);
        let word = word.map_or(String::new(), |word| word.as_str().trim().to_owned());
        word != "published" && !site.is_layer(&word)
    }

    /// Records the value of a parameter of the house that is being placed.
    pub(super) fn note_parameter(&mut self, parameter: &Parameter, value: Option<&Value>) {
        let uses = self.uses.len();
        if let Some(placed) = self.placed.last_mut().filter(|p| p.uses == uses)
            && let Some(value) = value
        {
            placed.values.push((parameter.name.clone(), value.clone()));
        }
    }

    /// Returns the attribute `seed` of a house at a feature, and its value.
    fn seed_of_feature(&self, own: &[Attribute<'a>], kind: &Attribute<'a>) -> (Attribute<'a>, u64) {
        let given = own.iter().find(|a| a.name == "seed");
        let number = given.and_then(|a| Some((a, a.value.as_str().trim().parse().ok()?)));
        if let Some((attribute, number)) = number {
            return (attribute.clone(), number);
        }
        let number = self.place_of_feature().key();
        (named("seed", number.to_string(), kind), number)
    }

    /// Returns the ground that a `Place` asks for; a type over outlines asks for that of the feature.
    fn ground(
        &mut self,
        own: &[Attribute<'a>],
        kind: &Attribute<'a>,
        scope: &Scope<'a>,
    ) -> Option<PlaceOn> {
        if own.iter().any(|a| a.name == "on") {
            return self.word_of(own, "on", &PlaceOn::WORDS);
        }
        let origin = self.origin(kind, scope)?;
        origin.is_over_outlines().then_some(PlaceOn::Outline)
    }

    /// Reads a word.
    fn word_of<T: Copy>(
        &mut self,
        own: &[Attribute<'a>],
        name: &str,
        words: &[(&'static str, T)],
    ) -> Option<T> {
        let attribute = own.iter().find(|a| a.name == name)?;
        let word = attribute.value.as_str().trim();
        let found = words.iter().find(|(known, _)| *known == word);
        if found.is_none() && !attribute.faulty {
            let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            let near = self.suggest.among(word, known.iter().copied());
            self.reporter.at(&attribute.value.whole(), |s| {
                say::not_a_choice(s, name, word, &known, near.map(|n| (n, None)))
            });
        }
        found.map(|(_, meant)| *meant)
    }

    /// Reads a length in metres.
    fn metres(&mut self, own: &[Attribute<'a>], name: &str) -> Option<f64> {
        let attribute = own.iter().find(|a| a.name == name)?;
        let schema = schema::named("Place")?.attribute(name)?;
        let Kind::Number(least, most) = schema.kind else {
            return None;
        };
        let text = attribute.value.as_str().trim();
        let read = length(text, Measure::Metres, super::super::UNIT);
        let number = read.or_else(|| text.parse().ok());
        match number.filter(|n: &f64| n.is_finite() && (least..=most).contains(n)) {
            Some(number) => Some(number),
            None => {
                if !attribute.faulty {
                    self.reporter.at(&attribute.value.whole(), |s| {
                        say::not_a_number(s, name, text, None)
                    });
                }
                None
            }
        }
    }
}

/// Returns an attribute that stands in the place of another.
pub(super) fn named<'a>(name: &'a str, value: String, like: &Attribute<'a>) -> Attribute<'a> {
    Attribute {
        name,
        value: Text::instead(value, like.value.whole()),
        ..like.clone()
    }
}

/// Returns the attributes of a `Place` with those of the place that its site found.
pub(super) fn standing<'a>(
    own: &[Attribute<'a>],
    kind: &Attribute<'a>,
    stood: &Stood,
) -> Vec<Attribute<'a>> {
    let azimuth = match stood.walls {
        Some(_) => 180.0,
        None => stood.azimuth,
    };
    let numbers = [
        ("x", stood.at.x),
        ("y", stood.at.y),
        ("z", stood.z),
        ("azimuth", azimuth),
    ];
    let kept = own.iter().filter(|a| {
        let place = numbers.iter().any(|(name, _)| *name == a.name);
        !place && a.name != "at" && a.name != "seed"
    });
    let mut attributes: Vec<Attribute<'a>> = kept.cloned().collect();
    attributes.extend(numbers.map(|(name, number)| named(name, (number + 0.0).to_string(), kind)));
    if stood.centred {
        attributes.push(named("at", "centre".to_owned(), kind));
    }
    attributes
}
