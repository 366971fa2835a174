//! Enters what a rule makes beside houses: pieces of road, trees, fences.

use super::made::made;
use super::{CHUNK, name};
use crate::decision::{Outcome, Record};
use crate::plan::{KnownPoles, LaidFirst, LotId, RoadPiece, Roads, Waters, ZoneArea, Zones};
use crate::site::LotSite;
use crate::text;
use crate::{Plan, TownInput};
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Diagnostics, Origin};
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_driver::FeatureHouse;
use hsd_ir::ast::town::{Made, Site};
use hsd_ir::ast::{Outdoor, Value};
use hsd_syntax::messages::town as say;
use hsd_syntax::parse::xml::RuleMade;
use rayon::prelude::*;
use std::sync::Arc;

/// Finds the roads that rules make of lines, so that each knows those that it meets, the poles of networks, the zones that lots
/// lie in, and the water that streams flow into. What is wrong with a rule is told when its features are evaluated.
pub(super) fn laid_first(input: TownInput<'_>, plan: &Plan) -> LaidFirst {
    let makes = |layer: &usize| {
        let name = &plan.layers[*layer].layer.name.value;
        let town = &plan.town;
        [&town.roads, &town.networks, &town.zones, &town.waters]
            .iter()
            .any(|makers| makers.contains(name))
    };
    let layers = (0..plan.layers.len()).filter(makes);
    let lots = layers.flat_map(|layer| (0..plan.layers[layer].lots.len()).map(move |n| (layer, n)));
    let lots: Vec<LotId> = lots.collect();
    let pieces = lots.par_chunks(CHUNK).flat_map_iter(|lots| {
        made((plan, input), lots, |made, sites| {
            let wishes = made.into_iter().zip(sites).flat_map(|(made, site)| {
                let wishes = made.made.into_iter().filter_map(|made| match made.made {
                    Made::Outdoor { wish, .. } => Some(wish),
                    Made::Skip { .. } | Made::Houses { .. } => None,
                });
                wishes.filter_map(move |wish| first(site, wish))
            });
            wishes.collect::<Vec<First>>()
        })
    });
    let (mut roads, mut poles, mut zones) = (vec![], vec![], vec![]);
    let (mut streams, mut ponds) = (vec![], vec![]);
    for first in pieces.collect::<Vec<First>>() {
        match first {
            First::Road(pieces) => roads.extend(pieces),
            First::Poles(lines) => poles.extend(lines),
            First::Zone(zone) => zones.push(zone),
            First::Stream(pieces) => streams.extend(pieces),
            First::Pond(rings) => ponds.extend(rings),
        }
    }
    LaidFirst {
        roads: Roads::new(roads),
        poles: KnownPoles::new(poles),
        zones: Zones::new(zones),
        waters: Waters::new(Roads::new(streams), ponds),
    }
}

/// What others look at before they are made.
enum First {
    Road(Vec<RoadPiece>),
    Poles(Vec<Vec<DVec2>>),
    Zone(ZoneArea),
    Stream(Vec<RoadPiece>),
    Pond(Vec<Vec<DVec2>>),
}

fn first(site: &LotSite<'_>, wish: Outdoor) -> Option<First> {
    // What is too long is made by no rule, and is reported there.
    site.check_units(&wish).ok()?;
    match wish {
        Outdoor::Road(road) => Some(First::Road(site.road_pieces(&road))),
        Outdoor::Poles(poles) if poles.reach.is_some() => {
            Some(First::Poles(site.pole_places(&poles)))
        }
        Outdoor::Zone(terms) => site.zone_area(*terms).map(First::Zone),
        Outdoor::Water(water) => Some(match site.pond() {
            Some(rings) => First::Pond(rings),
            None => First::Stream(site.stream(&water)),
        }),
        _ => None,
    }
}

/// Returns what keys the draws of a feature.
fn place(input: TownInput<'_>, site: &LotSite<'_>) -> Place {
    let (x, y) = site.key();
    let seed = input.options.expand.seed.unwrap_or(site.seed());
    let root = Place::seed(seed).named("place");
    root.at(x.cast_unsigned()).at(y.cast_unsigned())
}

/// Tells what is wrong with a rule, unless that has been told at another feature.
fn told_once(remark: Diagnostic, found: &mut Diagnostics) {
    let mut own = Diagnostics::new();
    own.push(remark);
    found.push_new(own);
}

/// Lays what was made on the ground and records it; what is no matter of the ground comes back. A feature that bears a house
/// keeps the type of that in its record.
pub(super) fn enter(
    made: RuleMade,
    (site, record): (&LotSite<'_>, &mut Record),
    (layer, input): (&Arc<str>, TownInput<'_>),
    houses: &mut Vec<FeatureHouse>,
    found: &mut Diagnostics,
) -> Option<RuleMade> {
    let rule = made.rule + 1;
    #[rustfmt::skip]
    let Made::Outdoor { span, evidence, wish } = made.made else {
        return Some(made);
    };
    let origin = |record: &Record| Origin::Feature {
        layer: layer.clone(),
        key: (&*record.key).into(),
    };
    let draws = place(input, site).named(wish.word()).at(rule as u64);
    let laid = match site.lay(&wish, span, draws) {
        Ok(laid) => laid,
        Err(why) => {
            let not_laid = say::not_laid(origin(record), wish.word(), &why);
            if record.houses == 0 {
                record.rule = rule;
                record.outcome = Outcome::Refused(not_laid.code, why);
            }
            found.push(not_laid);
            return None;
        }
    };
    for house in laid.houses {
        record.houses += 1;
        let name = name(layer, &record.key, record.houses);
        let is_fence = house.fittings.outdoors.is_none();
        let text = (input.texts && is_fence).then(|| text::lone(&house, &name));
        houses.push(FeatureHouse {
            feature: record.id,
            house,
            origin: origin(record),
            name,
            plain: None,
            within: None,
            text,
        });
    }
    record.footing = site.footing.get();
    record.envelopes.extend(laid.envelope);
    if laid.no_guiding_height {
        told_once(say::no_guiding_height(span), found);
    }
    let told = (wish.word(), evidence, laid.parameters);
    note(record, (rule, span), told);
    None
}

/// Notes what was made in the record of its feature.
fn note(
    record: &mut Record,
    (rule, span): (usize, Span),
    (word, evidence, parameters): (&'static str, String, Vec<(String, Value)>),
) {
    if matches!(record.outcome, Outcome::Built) && !record.kind.is_empty() {
        // What stands there beside the first has its word before its parameters.
        let more = parameters.into_iter();
        let more = more.map(|(name, value)| (format!("{word}_{name}"), value));
        record.parameters.extend(more);
        return;
    }
    record.rule = rule;
    record.span = Some(span);
    record.outcome = Outcome::Built;
    record.kind = word.to_owned();
    record.evidence = evidence;
    record.parameters = parameters;
}
