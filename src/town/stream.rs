//! The houses of a town one after another, and the ledger of what became of its features.

mod entries;

pub use entries::{Entries, Table};

use super::decision::{Entry, HEAD, Outcome, SkippedFeature, TownReport};
use super::layer::Unjoined;
use super::plan::Plan;
use super::run::{Chunk, TownHouses, TownInput};
use super::site::Footing;
use crate::backend::spool::NewSpool;
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::town as say;
use crate::driver::FeatureHouse;
use crate::parse::Values;
use crate::parse::xml::MissingFields;
use crate::source::Source;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::io;

/// The number of chunks that are evaluated at a time. It is fixed, so that nothing depends on the number of threads.
const AHEAD: usize = 8;

/// What became of the features of a town so far.
#[derive(Debug, Default)]
pub struct Ledger {
    /// The table of decisions.
    pub decisions: Table,
    /// The report.
    pub report: TownReport,
    /// True if something is missing that the author wanted.
    pub incomplete: bool,
    entries: Entries,
    found: Diagnostics,
    missing: MissingFields,
    /// How many features no rule takes, by layer.
    unruled: BTreeMap<String, usize>,
    /// How many features have no height under them, and how many of them none round them, by layer.
    off_ground: BTreeMap<String, (usize, usize)>,
    /// Types and files that were read.
    included: Vec<Source>,
    /// The values of expressions in the town file, if the options ask for them.
    pub values: Values,
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
            ledger: Ledger::default(),
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
            // In memory nothing can fail.
            self.ready
                .extend(self.ledger.add(chunk).unwrap_or_default());
        }
        more
    }

    /// Evaluates what is left, and returns the ledger. Reports fields that are missing and features that no rule takes.
    pub fn finish(mut self, out: &mut Diagnostics) -> (Ledger, Vec<Source>) {
        while self.refill() {}
        let finished = self.ledger.finish(self.plan, out);
        finished.unwrap_or_default()
    }
}

impl Ledger {
    /// Begins a ledger, whose table waits in a spool if there is one.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn new(spool: Option<NewSpool<'_>>) -> io::Result<Ledger> {
        Ok(Ledger {
            entries: Entries::new(spool)?,
            decisions: Table::new(spool)?,
            ..Ledger::default()
        })
    }

    /// Enters some features; returns their houses.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn add(&mut self, chunk: Chunk) -> io::Result<Vec<FeatureHouse>> {
        for record in &chunk.records {
            self.entries.push(Entry::of(record))?;
            self.incomplete |= !record.is_wanted();
            if record.footing != Footing::Known {
                let layer = record.layer.to_string();
                let (off, lost) = self.off_ground.entry(layer).or_default();
                *off += 1;
                *lost += usize::from(record.footing == Footing::Lost);
            }
            if let Outcome::NoRule = record.outcome {
                *self.unruled.entry(record.layer.to_string()).or_default() += 1;
            }
        }
        self.found.push_new(chunk.found);
        for (place, count) in chunk.missing {
            *self.missing.entry(place).or_default() += count;
        }
        self.values.append(chunk.values);
        if self.included.is_empty() {
            self.included = chunk.included;
        }
        Ok(chunk.houses)
    }

    /// Closes it: features in the order of their files, whatever the order in which they came. Reports what concerns all.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn finish(
        mut self,
        plan: &Plan,
        out: &mut Diagnostics,
    ) -> io::Result<(Ledger, Vec<Source>)> {
        out.append(std::mem::take(&mut self.found));
        let (table, report) = (&mut self.decisions, &mut self.report);
        table.push(HEAD)?;
        std::mem::take(&mut self.entries).each(&mut |entry| {
            table.push(&entry.line)?;
            report.add(entry);
            Ok(())
        })?;
        let mut told = BTreeSet::new();
        for ((span, name), count) in &self.missing {
            if told.insert(name.clone()) {
                out.push(say::field_missing(*span, name, *count));
            }
        }
        for layer in &plan.layers {
            let name = &layer.layer.name.value;
            if plan.town.rules.iter().any(|rule| rule.each.value == *name) {
                self.incomplete |= !layer.unread.is_empty();
                layer
                    .unread
                    .iter()
                    .for_each(|f| self.report.unread(name, f));
            }
        }
        self.report
            .corrected
            .extend(plan.unjoined.iter().map(unjoined));
        self.report_layers(plan, out);
        let included = std::mem::take(&mut self.included);
        Ok((self, included))
    }

    /// Reports features that no rule takes, keys of several features and a town without streets.
    fn report_layers(&self, plan: &Plan, out: &mut Diagnostics) {
        for layer in &plan.town.layers {
            let name = &layer.name.value;
            if let Some(count) = self.unruled.get(name) {
                out.push(say::nothing_made(layer.name.span, name, *count));
            }
            if let Some((off, lost)) = self.off_ground.get(name) {
                out.push(say::off_the_ground(layer.name.span, name, *off, *lost));
            }
        }
        for (number, layer) in plan.layers.iter().enumerate() {
            let twice = plan.keys_of_several(number);
            if !twice.is_empty() {
                let twice: Vec<String> = twice.into_iter().collect();
                let name = &layer.layer.name;
                out.push(say::same_keys(name.span, &name.value, &twice));
            }
        }
        if plan.has_no_streets() {
            out.push(say::no_streets(plan.town.span));
        }
    }
}

/// Returns a point whose fields no outline takes, as the report has it.
fn unjoined(point: &Unjoined) -> SkippedFeature {
    SkippedFeature {
        layer: point.layer.clone(),
        key: point.key.to_string(),
        code: point.code.to_owned(),
        reason: point.reason.to_owned(),
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
