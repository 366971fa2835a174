//! `Rear`: the houses behind the house of a lot, each as a `Place` of its own, at the places that the site of the feature finds.

use super::super::read::check;
use super::super::tree::Child;
use super::super::tree::Element;
use super::super::tree::token::Attribute;
use super::features::{named, standing};
use super::places::{Placed, bare};
use super::{ElementRef, Expander, Scope};
use crate::messages::town;
use crate::parse::schema;
use crate::parse::xml::tree::text::Text;
use hsd_base::rng::Place;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{Rear, RearHouse};
use std::collections::BTreeMap;

impl<'a> Expander<'a, '_> {
    /// Replaces a `Rear` by the houses that stand behind the house of the feature.
    pub(super) fn rear_at_feature(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        scope: &Scope<'a>,
        into: usize,
    ) {
        let element = element_ref.element();
        let (Some(site), Some(schema)) = (self.feature.site, schema::named("Rear")) else {
            return;
        };
        let own: Vec<Attribute<'a>> = element.attributes.to_vec();
        let named_only = Element {
            attributes: own.clone(),
            ..bare(element)
        };
        check(self.reporter, &mut self.suggest, schema, &named_only);
        let density = own.iter().find(|a| a.name == "density");
        let density = density.map_or(Some(0.0), |density| self.density(density, scope));
        let draws = self.place_of_feature().named("rear");
        let houses = match site.rear(density.unwrap_or(0.0), draws) {
            Rear::Houses(houses) => houses,
            Rear::NoArea => {
                self.reporter.at(&element.name_range, town::rear_of_no_lot);
                return;
            }
        };
        let mut evidence = own.into_iter().find(|a| a.name == "evidence");
        if let Some(evidence) = &mut evidence {
            self.fill_attribute(evidence, scope);
        }
        for house in houses {
            self.rear_house(element_ref, evidence.as_ref(), house, draws, into);
        }
    }

    /// Returns the share that `density` gives; `None` if it is none, which is reported, or the feature lacks a field.
    fn density(&mut self, attribute: &Attribute<'a>, scope: &Scope<'a>) -> Option<f64> {
        let before = self.key_draws("Rear", "density");
        let value = self.value(&attribute.value, scope);
        self.restore_draws(before);
        let value = value?;
        if let Value::Number(share) = value
            && (0.0..=1.0).contains(&share)
        {
            return Some(share);
        }
        self.reporter.at(&attribute.value.whole(), |s| {
            town::no_density(s, &value.to_string())
        });
        None
    }

    /// Makes one of the houses.
    fn rear_house(
        &mut self,
        element_ref: &ElementRef<'_, 'a>,
        evidence: Option<&Attribute<'a>>,
        house: RearHouse,
        draws: Place,
        into: usize,
    ) {
        let place = element_ref.element().name_range.clone();
        let kind = Attribute {
            name: "type",
            name_range: place.clone(),
            value: Text::instead(house.kind.to_owned(), place.clone()),
            range: place,
            faulty: false,
        };
        let Some(origin) = self.origin(&kind, &super::scope::Frame::outermost()) else {
            return;
        };
        let seed = draws.named(&house.unit).key();
        let given = house.parameters.into_iter();
        let given = given.map(|(name, value)| (name.to_owned(), (kind.clone(), Some(value))));
        let placed = Placed {
            name: Some(house.unit.clone()),
            seed: Some((named("seed", seed.to_string(), &kind), seed)),
            uses: self.uses.len(),
            ..Placed::new(kind.clone(), given.collect::<BTreeMap<_, _>>())
        };
        let mut attributes = vec![kind.clone(), named("name", house.unit, &kind)];
        attributes.extend(evidence.cloned());
        let attributes = standing(&attributes, &kind, &house.stood);
        let Some((made, filled)) = self.fill_at_feature(element_ref, attributes, placed, origin)
        else {
            return;
        };
        self.feature.stood.insert(made, house.stood);
        self.feature.given.insert(made, filled.values);
        self.made.elements[into].children.push(Child::Element(made));
    }
}
