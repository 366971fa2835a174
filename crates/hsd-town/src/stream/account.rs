//! The account of some features: all that the ledger of a town needs to know of them. It can be stored, so that one process
//! makes a tile and another closes the ledger.

use super::entries::{Entries, lose};
use crate::decision::{Entry, LostHouse, Outcome, SkippedFeature};
use crate::plan::Plan;
use crate::run::Chunk;
use crate::site::Footing;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::stored::{StoredDiagnostics, numbers, span};
use hsd_syntax::parse::xml::MissingFields;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// What became of some features.
#[derive(Clone, Debug, Default)]
pub struct Account {
    /// What is kept of each, in their order.
    pub entries: Vec<Entry>,
    /// What was found while they were evaluated.
    pub found: Diagnostics,
    pub(super) totals: Totals,
}

/// Totals over features.
#[derive(Clone, Debug, Default)]
pub(super) struct Totals {
    /// True if something is missing that the author wanted.
    pub(super) incomplete: bool,
    /// How many features lacked fields.
    pub(super) missing: MissingFields,
    /// How many features no rule takes, by layer.
    pub(super) unruled: BTreeMap<String, usize>,
    /// How many features have no height under them, and how many of them none round them, by layer.
    pub(super) off_ground: BTreeMap<String, (usize, usize)>,
}

/// An account as it is stored.
#[derive(Debug, Deserialize, Serialize)]
pub struct StoredAccount {
    entries: Vec<Entry>,
    found: StoredDiagnostics,
    incomplete: bool,
    missing: Vec<([u32; 3], String, usize)>,
    unruled: BTreeMap<String, usize>,
    off_ground: BTreeMap<String, (usize, usize)>,
}

impl Account {
    /// Takes the account of a chunk, of which the houses, the sources and the values stay.
    pub fn of(chunk: &mut Chunk) -> Account {
        let mut totals = Totals {
            missing: std::mem::take(&mut chunk.missing),
            ..Totals::default()
        };
        for record in &chunk.records {
            totals.incomplete |= !record.is_wanted();
            if record.footing != Footing::Known {
                let layer = record.layer.to_string();
                let (off, lost) = totals.off_ground.entry(layer).or_default();
                *off += 1;
                *lost += usize::from(record.footing == Footing::Lost);
            }
            if let Outcome::NoRule = record.outcome {
                *totals.unruled.entry(record.layer.to_string()).or_default() += 1;
            }
        }
        Account {
            entries: chunk.records.iter().map(Entry::of).collect(),
            found: std::mem::take(&mut chunk.found),
            totals,
        }
    }

    /// Takes houses from it that would exceed a limit.
    pub fn lose(&mut self, lost: &[LostHouse]) {
        self.totals.incomplete |= lose(&mut self.entries, lost);
    }

    /// Returns the account of features that the author wanted and that have nothing.
    pub fn incomplete(entries: Vec<Entry>) -> Account {
        Account {
            entries,
            totals: Totals {
                incomplete: true,
                ..Totals::default()
            },
            ..Account::default()
        }
    }

    /// Returns the account as it is stored.
    pub fn stored(self) -> StoredAccount {
        let missing = self.totals.missing.into_iter();
        StoredAccount {
            entries: self.entries,
            found: (&self.found).into(),
            incomplete: self.totals.incomplete,
            missing: missing
                .map(|((place, name), count)| (numbers(place), name, count))
                .collect(),
            unruled: self.totals.unruled,
            off_ground: self.totals.off_ground,
        }
    }
}

impl From<StoredAccount> for Account {
    fn from(stored: StoredAccount) -> Account {
        let missing = stored.missing.into_iter();
        Account {
            entries: stored.entries,
            found: stored.found.into(),
            totals: Totals {
                incomplete: stored.incomplete,
                missing: missing
                    .map(|(place, name, count)| ((span(place), name), count))
                    .collect(),
                unruled: stored.unruled,
                off_ground: stored.off_ground,
            },
        }
    }
}

impl Totals {
    /// Adds the totals of other features; their entries go into `entries`.
    pub(super) fn add(
        &mut self,
        other: Totals,
        (list, entries): (Vec<Entry>, &mut Entries),
    ) -> io::Result<()> {
        list.into_iter().try_for_each(|entry| entries.push(entry))?;
        self.incomplete |= other.incomplete;
        for (place, count) in other.missing {
            *self.missing.entry(place).or_default() += count;
        }
        for (layer, count) in other.unruled {
            *self.unruled.entry(layer).or_default() += count;
        }
        for (layer, (off, lost)) in other.off_ground {
            let own = self.off_ground.entry(layer).or_default();
            (own.0, own.1) = (own.0 + off, own.1 + lost);
        }
        Ok(())
    }
}

/// What is known of a whole town, beside its features, when its ledger is closed.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Closing {
    /// The features that no rule has looked at: they cannot be read, are left out, or belong to layers that no rule names.
    pub(super) undecided: Vec<Entry>,
    /// The numbers of the layers that nothing depends on, with the number of their features.
    pub(super) idle: Vec<(usize, usize)>,
    /// The points whose fields no outline takes.
    pub(super) unjoined: Vec<SkippedFeature>,
    /// The keys that several features of a layer have.
    pub(super) twice: BTreeMap<usize, BTreeSet<String>>,
    /// True if no layer counts as streets.
    pub(super) no_streets: bool,
}

impl Closing {
    /// Collects it from a town.
    pub fn of(plan: &Plan) -> Closing {
        let mut undecided = vec![];
        let layers = plan.layers.iter().enumerate();
        for (number, lots) in layers.filter(|(number, _)| plan.is_counted(*number)) {
            let layer = (number, &*lots.layer.name.value);
            let unread = (0..).zip(&lots.unread);
            undecided.extend(unread.map(|(n, fault)| Entry::unread(layer, fault, n)));
            let left = (lots.unread.len()..).zip(&lots.left);
            undecided.extend(left.map(|(n, lot)| Entry::left(layer, lot, n)));
        }
        let (name, mut counts) = (
            |number: usize| &*plan.layers[number].layer.name.value,
            BTreeMap::new(),
        );
        plan.each_unused(&mut |lot| {
            *counts.entry(lot.id.0).or_default() += 1;
            undecided.push(Entry::unused(lot.id, (name(lot.id.0), &lot.key), lot.at));
        });
        let idle = plan.idle_layers();
        let idle = idle.map(|number| (number, counts.get(&number).copied().unwrap_or(0)));
        let twice = (0..plan.layers.len()).map(|number| (number, plan.keys_of_several(number)));
        Closing {
            undecided,
            idle: idle.collect(),
            unjoined: plan.unjoined.iter().map(super::unjoined).collect(),
            twice: twice.filter(|(_, keys)| !keys.is_empty()).collect(),
            no_streets: plan.has_no_streets(),
        }
    }
}
