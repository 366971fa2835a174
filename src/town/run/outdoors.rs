//! Enters what a rule makes beside houses: pieces of road, trees, fences.

use super::name;
use crate::ast::town::{Made, Site};
use crate::diagnostic::messages::town as say;
use crate::diagnostic::{Diagnostics, Origin};
use crate::driver::FeatureHouse;
use crate::rng::Place;
use crate::town::TownInput;
use crate::town::decision::{Outcome, Record};
use crate::town::site::LotSite;
use crate::town::text;
use std::sync::Arc;

/// Lays what was made on the ground and records it. A feature that bears a house keeps the type of that in its record.
pub(super) fn enter(
    made: Made,
    rule: usize,
    (site, record): (&LotSite<'_>, &mut Record),
    (layer, input): (&Arc<str>, TownInput<'_>),
    houses: &mut Vec<FeatureHouse>,
    found: &mut Diagnostics,
) {
    let Made::Outdoor {
        span,
        evidence,
        wish,
    } = made
    else {
        return;
    };
    let origin = || Origin::Feature {
        layer: layer.clone(),
        key: (&*record.key).into(),
    };
    let (x, y) = site.key();
    let seed = input.options.expand.seed.unwrap_or(site.seed());
    let draws = Place::seed(seed).named("place");
    let draws = draws.at(x.cast_unsigned()).at(y.cast_unsigned());
    let draws = draws.named(wish.word()).at(rule as u64);
    let laid = match site.lay(&wish, span, draws) {
        Ok(laid) => laid,
        Err(why) => {
            found.push(say::not_laid(origin(), wish.word(), &why));
            if record.houses == 0 {
                record.rule = rule;
                record.outcome = Outcome::Refused(why);
            }
            return;
        }
    };
    for house in laid.houses {
        record.houses += 1;
        houses.push(FeatureHouse {
            house,
            origin: Origin::Feature {
                layer: layer.clone(),
                key: (&*record.key).into(),
            },
            name: name(layer, &record.key, record.houses),
            plain: None,
            text: None,
        });
        let last = houses.last_mut().filter(|_| input.texts);
        if let Some(made) = last.filter(|made| made.house.fittings.outdoors.is_none()) {
            made.text = Some(text::lone(&made.house, &made.name));
        }
    }
    record.footing = site.footing.get();
    if !matches!(record.outcome, Outcome::Built) || record.kind.is_empty() {
        record.rule = rule;
        record.span = Some(span);
        record.outcome = Outcome::Built;
        record.kind = wish.word().to_owned();
        record.evidence = evidence;
        record.parameters = laid.parameters;
        return;
    }
    // What stands there beside the first has its word before its parameters.
    let word = wish.word();
    let more = laid.parameters.into_iter();
    let more = more.map(|(name, value)| (format!("{word}_{name}"), value));
    record.parameters.extend(more);
}
