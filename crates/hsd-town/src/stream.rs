//! The houses of a town one after another, and the ledger of what became of its features.

mod account;
mod entries;

pub use account::{Account, Closing, StoredAccount};
pub use entries::{Entries, Table};

use super::decision::{FeatureState, HEAD, LostHouse, SkippedFeature, TownReport};
use super::layer::Unjoined;
use super::plan::Plan;
use super::run::{Chunk, TownHouses, TownInput};
use super::site::law::EnvelopeRow;
use account::Totals;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Source;
use hsd_driver::{FeatureHouse, LeftOut, Read, stream_town};
use hsd_export::spool::{NewSpool, in_memory};
use hsd_syntax::messages::town as say;
use hsd_syntax::parse::Values;
use rayon::prelude::*;
use std::collections::{BTreeSet, VecDeque};
use std::io;

/// The number of chunks that are evaluated at a time. It is fixed, so that nothing depends on the number of threads.
const AHEAD: usize = 8;

/// The number of features that are told of at a time, at least.
const TOLD: usize = 16;

/// What became of the features of a town so far.
#[derive(Debug, Default)]
pub struct Ledger {
    /// The table of decisions.
    pub decisions: Table,
    /// The report.
    pub report: TownReport,
    /// The envelopes of lots.
    pub envelopes: Vec<EnvelopeRow>,
    entries: Entries,
    found: Diagnostics,
    totals: Totals,
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
    begun: VecDeque<Begun>,
    progress: &'a (dyn Fn(usize) + Sync),
}

/// Features of which some houses wait to be taken.
struct Begun {
    features: usize,
    /// Of these, the number of which it is told that they are done.
    told: usize,
    houses: usize,
    /// Of these, the number that is taken.
    taken: usize,
}

impl Begun {
    /// Returns how many features more are done, each as far as its share of the houses; few at a time are kept back.
    fn more(&mut self) -> usize {
        let done = match self.taken < self.houses {
            true => self.features * self.taken / self.houses,
            false => self.features,
        };
        let more = done - self.told;
        if more < TOLD && done < self.features {
            return 0;
        }
        self.told = done;
        more
    }
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
            begun: VecDeque::new(),
            progress: &|_| (),
        }
    }

    /// Calls `progress` with the number of features whose houses are taken, whenever there are some more.
    pub fn telling(self, progress: &'a (dyn Fn(usize) + Sync)) -> TownStream<'a> {
        TownStream { progress, ..self }
    }

    /// Tells of features that are done.
    fn tell(&mut self) {
        while let Some(first) = self.begun.front_mut() {
            let more = first.more();
            if more > 0 {
                (self.progress)(more);
            }
            if first.told < first.features {
                break;
            }
            self.begun.pop_front();
        }
    }

    /// Evaluates the next chunks; returns false if there are none.
    fn refill(&mut self) -> bool {
        let chunks: Vec<_> = self.houses.chunks().skip(self.next).take(AHEAD).collect();
        self.next += chunks.len();
        let houses = &self.houses;
        let made: Vec<(usize, Chunk)> = chunks
            .into_par_iter()
            .map(|lots| (lots.len(), houses.evaluate(lots)))
            .collect();
        let more = !made.is_empty();
        for (features, chunk) in made {
            // In memory nothing can fail.
            let houses = self.ledger.add(chunk).unwrap_or_default();
            self.begun.push_back(Begun {
                features,
                told: 0,
                houses: houses.len(),
                taken: 0,
            });
            self.ready.extend(houses);
        }
        self.tell();
        more
    }

    /// Takes houses that would exceed a limit from their features, of which all have been evaluated.
    pub fn lose(&mut self, left_out: &[LeftOut]) {
        let lost: Vec<LostHouse> = left_out.iter().map(LostHouse::from).collect();
        self.ledger.lose(&lost);
    }

    /// Makes the models of all houses and drops them; returns those that would exceed a limit, which are taken from their features.
    /// `each` receives every house before it is made.
    pub fn build(
        &mut self,
        input: TownInput<'_>,
        read: Read,
        out: &mut Diagnostics,
        each: &mut (dyn FnMut(&FeatureHouse) + Send),
    ) -> Vec<LeftOut> {
        let streamed = stream_town(
            (input.source, read),
            self.by_ref().inspect(each),
            &mut std::iter::empty(),
            input.world,
            input.options,
            out,
            (&mut |_, _| Ok(()), &in_memory),
        );
        let left_out = streamed.expect("everything is in memory").left_out;
        self.lose(&left_out);
        left_out
    }

    /// Evaluates what is left, and returns the ledger. Reports fields that are missing and features that no rule takes.
    pub fn finish(mut self, out: &mut Diagnostics) -> (Ledger, Vec<Source>) {
        while self.refill() {}
        self.begun
            .iter_mut()
            .for_each(|begun| begun.taken = begun.houses);
        self.tell();
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
    pub fn add(&mut self, mut chunk: Chunk) -> io::Result<Vec<FeatureHouse>> {
        self.enter(Account::of(&mut chunk))?;
        self.values.append(chunk.values);
        self.read(chunk.included);
        Ok(chunk.houses)
    }

    /// As [`add`](Ledger::add), of features of whose houses some would exceed a limit.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn add_without(&mut self, mut chunk: Chunk, lost: &[LostHouse]) -> io::Result<()> {
        let mut account = Account::of(&mut chunk);
        account.lose(lost);
        self.enter(account)?;
        self.values.append(chunk.values);
        self.read(chunk.included);
        Ok(())
    }

    /// Takes houses that would exceed a limit from features that are kept in memory.
    pub fn lose(&mut self, lost: &[LostHouse]) {
        self.totals.incomplete |= self.entries.lose(lost);
    }

    /// Enters the account of some features.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn enter(&mut self, account: Account) -> io::Result<()> {
        self.found.push_new(account.found);
        let entries = (account.entries, &mut self.entries);
        self.totals.add(account.totals, entries)
    }

    /// Keeps the types and files that were read, unless some are known already.
    pub fn read(&mut self, included: Vec<Source>) {
        if self.included.is_empty() {
            self.included = included;
        }
    }

    /// Returns true if something is missing that the author wanted.
    pub fn is_incomplete(&self) -> bool {
        self.totals.incomplete
    }

    /// Closes it: features in the order of their files, whatever the order in which they came. Reports what concerns all.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn finish(self, plan: &Plan, out: &mut Diagnostics) -> io::Result<(Ledger, Vec<Source>)> {
        self.close(plan, Closing::of(plan), out)
    }

    /// Closes it with what is known of the whole town; of `plan` only what it is without features counts.
    ///
    /// # Errors
    /// Those of the spool.
    pub fn close(
        mut self,
        plan: &Plan,
        mut closing: Closing,
        out: &mut Diagnostics,
    ) -> io::Result<(Ledger, Vec<Source>)> {
        out.append(std::mem::take(&mut self.found));
        for entry in std::mem::take(&mut closing.undecided) {
            self.totals.incomplete |= matches!(entry.state, FeatureState::Skipped(_));
            self.entries.push(entry)?;
        }
        let (table, report) = (&mut self.decisions, &mut self.report);
        let envelopes = &mut self.envelopes;
        table.push(HEAD)?;
        std::mem::take(&mut self.entries).each(&mut |entry| {
            table.push(&entry.line.text())?;
            envelopes.extend(report.add(entry));
            Ok(())
        })?;
        let mut told = BTreeSet::new();
        for ((span, name), count) in &self.totals.missing {
            if told.insert(name.clone()) {
                out.push(say::field_missing(*span, name, *count));
            }
        }
        let names = plan.layers.iter().enumerate();
        let names = names.map(|(number, lots)| {
            let is_counted = plan.is_counted(number);
            is_counted.then_some(&*lots.layer.name.value)
        });
        self.report.name_layers(names);
        self.report_layers(plan, &closing, out);
        self.report.corrected.extend(closing.unjoined);
        let included = std::mem::take(&mut self.included);
        Ok((self, included))
    }

    /// Reports features that no rule takes, keys of several features and a town without streets.
    fn report_layers(&self, plan: &Plan, closing: &Closing, out: &mut Diagnostics) {
        for layer in &plan.town.layers {
            let name = &layer.name.value;
            if let Some(count) = self.totals.unruled.get(name) {
                out.push(say::nothing_made(layer.name.span, name, *count));
            }
            if let Some((off, lost)) = self.totals.off_ground.get(name) {
                out.push(say::off_the_ground(layer.name.span, name, *off, *lost));
            }
        }
        for (number, count) in &closing.idle {
            let name = &plan.layers[*number].layer.name;
            out.push(say::layer_unused(name.span, &name.value, *count));
        }
        for (number, layer) in plan.layers.iter().enumerate() {
            if let Some(twice) = closing.twice.get(&number) {
                let twice: Vec<String> = twice.iter().cloned().collect();
                let name = &layer.layer.name;
                out.push(say::same_keys(name.span, &name.value, &twice));
            }
        }
        if closing.no_streets {
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
        if let Some(first) = self.begun.front_mut() {
            first.taken += 1;
        }
        self.tell();
        self.ready.pop_front()
    }
}
