//! An entry of the ledger of a town: a feature or a house behind one, with its state and its line of the table.

use super::{DecisionLine, Outcome, Record};
use crate::layer::{LeftLot, Lot};
use crate::plan::LotId;
use crate::site::Footing;
use crate::site::law::EnvelopeRow;
use glam::DVec2;
use hsd_base::diagnostic::{Language, Origin};
use hsd_base::source::Span;
use hsd_driver::LeftOut;
use hsd_map::Fault;
use serde::{Deserialize, Serialize};

/// The state of a feature. Each feature has exactly one.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub enum FeatureState {
    /// Something of it exists.
    Built,
    /// Nothing does, with the code and the reason.
    Skipped(SkippedFeature),
    /// No rule names its layer.
    Unused,
}

/// An entry of a feature in the ledger of a town.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Entry {
    /// The feature.
    pub id: LotId,
    /// The key; that of a house behind the house of a feature has the name of this house after it.
    pub key: Box<str>,
    /// The line in the table.
    pub line: DecisionLine,
    /// The state.
    pub state: FeatureState,
    /// The number of its houses.
    houses: usize,
    /// True for a house behind the house of a feature.
    pub is_part: bool,
    /// Corrections of its geometry or position.
    pub corrected: Vec<SkippedFeature>,
    /// The envelopes of building law.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub envelopes: Vec<EnvelopeRow>,
}

/// Features that cannot be read have numbers from here on, so that they come after those of their layer that can.
const UNREAD: usize = usize::MAX / 2;

impl Entry {
    /// Returns the entry of a record.
    pub fn of(record: &Record) -> Entry {
        let of = |code: &str, reason: String| SkippedFeature {
            layer: record.layer.to_string(),
            key: record.key.to_string(),
            code: code.to_owned(),
            reason,
        };
        let off = match record.footing {
            Footing::Known => None,
            Footing::Near => Some("the ground has no height here: the next one counts"),
            Footing::Lost => Some("the ground has no height within 200 m"),
        };
        let off = off.map(|why| of("HSD1163", why.to_owned()));
        Entry {
            id: record.id,
            key: record.key.clone(),
            line: record.line(),
            state: match record.outcome {
                Outcome::Built => FeatureState::Built,
                _ => {
                    let (code, reason) = record.why_skipped();
                    FeatureState::Skipped(of(&code, reason))
                }
            },
            houses: record.houses,
            is_part: record.is_part,
            corrected: off.into_iter().collect(),
            envelopes: record.envelopes.clone(),
        }
    }

    /// Returns the entry of a feature that no rule has evaluated.
    fn undecided(
        id: LotId,
        (layer, key): (&str, &str),
        at: Option<DVec2>,
        why: Undecided,
    ) -> Entry {
        let (what, reason) = match &why {
            Undecided::Unused => ("unused", "no rule names its layer"),
            Undecided::Skipped { what, reason, .. } => (*what, &**reason),
        };
        Entry {
            id,
            key: key.into(),
            line: DecisionLine::undecided(layer, key, at, (what, reason)),
            state: match why {
                Undecided::Unused => FeatureState::Unused,
                Undecided::Skipped { code, reason, .. } => FeatureState::Skipped(SkippedFeature {
                    layer: layer.to_owned(),
                    key: key.to_owned(),
                    code,
                    reason,
                }),
            },
            houses: 0,
            is_part: false,
            corrected: vec![],
            envelopes: vec![],
        }
    }

    /// Returns the entry of a feature whose tile could not be made.
    pub fn unmade(layer: usize, name: &str, lot: &Lot) -> Entry {
        let why = Undecided::Skipped {
            what: "not made",
            code: "not made".to_owned(),
            reason: "its tile was not made".to_owned(),
        };
        let id = (layer, lot.number as usize);
        Entry::undecided(id, (name, &lot.key), Some(lot.shape.centre()), why)
    }

    /// Returns the entry of a feature of a layer that no rule names.
    pub fn unused(id: LotId, (layer, key): (&str, &str), at: DVec2) -> Entry {
        Entry::undecided(id, (layer, key), Some(at), Undecided::Unused)
    }

    /// Returns the entry of a feature that cannot be read. `before` counts such features before it in its layer.
    pub fn unread((layer, name): (usize, &str), fault: &Fault, before: usize) -> Entry {
        let found = hsd_map::diagnostic(fault, 1, Span::default().into());
        let key = fault.feature.as_ref().map(|which| which.key().to_string());
        let why = Undecided::Skipped {
            what: "not read",
            code: found.code.to_string(),
            reason: found.message.in_language(Language::English).to_string(),
        };
        let id = (layer, UNREAD + before);
        Entry::undecided(id, (name, &key.unwrap_or_default()), None, why)
    }

    /// Returns the entry of a feature that was omitted before any rule. `before` counts such features before it in its layer.
    pub fn left((layer, name): (usize, &str), lot: &LeftLot, before: usize) -> Entry {
        let why = Undecided::Skipped {
            what: "left out",
            code: lot.why.code().to_string(),
            reason: lot.why.reason().to_owned(),
        };
        let id = (layer, UNREAD + before);
        Entry::undecided(id, (name, &lot.key), Some(lot.at), why)
    }

    /// Takes a house from it that would exceed a limit; a feature without any house is skipped.
    pub(crate) fn lose_house(&mut self, lost: &LostHouse) {
        self.houses = self.houses.saturating_sub(1);
        if self.houses > 0 {
            return;
        }
        (self.line.what, self.line.why) = ("left out".to_owned(), lost.code.clone());
        self.state = FeatureState::Skipped(SkippedFeature {
            layer: lost.layer.clone(),
            key: self.key.to_string(),
            code: lost.code.clone(),
            reason: lost.reason.clone(),
        });
    }
}

/// The reason why no rule has evaluated a feature.
enum Undecided {
    /// None names its layer.
    Unused,
    /// It is left out.
    Skipped {
        what: &'static str,
        code: String,
        reason: String,
    },
}

/// A house that is left out, since it would exceed a limit.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct LostHouse {
    /// The feature.
    pub id: LotId,
    /// The layer.
    pub layer: String,
    /// The key.
    pub key: String,
    /// The code of the diagnostic.
    pub code: String,
    /// The reason.
    pub reason: String,
}

impl From<&LeftOut> for LostHouse {
    fn from(left: &LeftOut) -> LostHouse {
        let (layer, key) = match &left.origin {
            Origin::Feature { layer, key } => (layer.to_string(), key.to_string()),
            Origin::Source(_) => Default::default(),
        };
        LostHouse {
            id: left.feature,
            layer,
            key,
            code: left.code.to_string(),
            reason: left.why.in_language(Language::English).to_string(),
        }
    }
}

/// A feature in a report.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct SkippedFeature {
    /// The layer.
    pub layer: String,
    /// The key.
    pub key: String,
    /// The code of a diagnostic, or a word.
    pub code: String,
    /// The reason.
    pub reason: String,
}
