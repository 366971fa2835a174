//! The houses of a town one after another, and the ledger of what became of its features.

use super::decision::{HEAD, Outcome, TownReport};
use super::plan::Plan;
use super::run::{Chunk, TownHouses, TownInput};
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::town as say;
use crate::driver::FeatureHouse;
use crate::parse::xml::MissingFields;
use crate::source::Source;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// The number of chunks that are evaluated at a time. It is fixed, so that nothing depends on the number of threads.
const AHEAD: usize = 8;

/// What became of the features of a town so far.
#[derive(Debug)]
pub struct Ledger {
    /// The table of decisions.
    pub decisions: String,
    /// The report.
    pub report: TownReport,
    /// True if something is missing that the author wanted.
    pub incomplete: bool,
    found: Diagnostics,
    missing: MissingFields,
    /// How many features no rule takes, by layer.
    unruled: BTreeMap<String, usize>,
    /// Types and files that were read.
    included: Vec<Source>,
}

/// The houses of a town.
pub struct TownStream<'a> {
    plan: &'a Plan,
    houses: TownHouses<'a>,
    ready: VecDeque<FeatureHouse>,
    next: usize,
    ledger: Ledger,
}

impl<'a> TownStream<'a> {
    /// Begins a town.
    pub fn new(input: TownInput<'a>, plan: &'a Plan) -> TownStream<'a> {
        TownStream {
            plan,
            houses: TownHouses::new(input, plan),
            ready: VecDeque::new(),
            next: 0,
            ledger: Ledger {
                decisions: HEAD.to_owned(),
                report: TownReport::default(),
                incomplete: false,
                found: Diagnostics::new(),
                missing: MissingFields::new(),
                unruled: BTreeMap::new(),
                included: vec![],
            },
        }
    }

    /// Evaluates the next chunks; returns false if there are none.
    fn refill(&mut self) -> bool {
        let chunks: Vec<_> = self.houses.chunks().skip(self.next).take(AHEAD).collect();
        self.next += chunks.len();
        let houses = &self.houses;
        let made: Vec<Chunk> = chunks
            .into_par_iter()
            .map(|lots| houses.evaluate(lots))
            .collect();
        let more = !made.is_empty();
        for chunk in made {
            self.ready.extend(chunk.houses);
            for record in &chunk.records {
                record.line(&mut self.ledger.decisions);
                self.ledger.report.add(record, record.parts_left);
                self.ledger.incomplete |= !record.is_wanted();
                if let Outcome::NoRule = record.outcome {
                    *self
                        .ledger
                        .unruled
                        .entry(record.layer.to_string())
                        .or_default() += 1;
                }
            }
            self.ledger.found.push_new(chunk.found);
            for (place, count) in chunk.missing {
                *self.ledger.missing.entry(place).or_default() += count;
            }
            if self.ledger.included.is_empty() {
                self.ledger.included = chunk.included;
            }
        }
        more
    }

    /// Evaluates what is left, and returns the ledger. Reports fields that are missing and features that no rule takes.
    pub fn finish(mut self, out: &mut Diagnostics) -> (Ledger, Vec<Source>) {
        while self.refill() {}
        let mut ledger = self.ledger;
        out.append(std::mem::take(&mut ledger.found));
        let mut told = BTreeSet::new();
        for ((span, name), count) in &ledger.missing {
            if told.insert(name.clone()) {
                out.push(say::field_missing(*span, name, *count));
            }
        }
        let town = &self.plan.town;
        for layer in &self.plan.layers {
            let name = &layer.layer.name.value;
            if town.rules.iter().any(|rule| rule.each.value == *name) {
                ledger.incomplete |= !layer.unread.is_empty();
                layer
                    .unread
                    .iter()
                    .for_each(|f| ledger.report.unread(name, f));
            }
        }
        for layer in &town.layers {
            let name = &layer.name.value;
            if let Some(count) = ledger.unruled.get(name) {
                out.push(say::nothing_made(layer.name.span, name, *count));
            }
        }
        for layer in &self.plan.layers {
            let mut keys = BTreeSet::new();
            let twice = layer.lots.iter().filter(|lot| !keys.insert(&lot.key));
            let twice: BTreeSet<String> = twice.map(|lot| lot.key.to_string()).collect();
            if !twice.is_empty() {
                let twice: Vec<String> = twice.into_iter().collect();
                let name = &layer.layer.name;
                out.push(say::same_keys(name.span, &name.value, &twice));
            }
        }
        if self.plan.has_no_streets() {
            out.push(say::no_streets(town.span));
        }
        let included = std::mem::take(&mut ledger.included);
        (ledger, included)
    }
}

impl Iterator for TownStream<'_> {
    type Item = FeatureHouse;

    fn next(&mut self) -> Option<FeatureHouse> {
        while self.ready.is_empty() {
            if !self.refill() {
                return None;
            }
        }
        self.ready.pop_front()
    }
}
