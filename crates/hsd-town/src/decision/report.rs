//! The account of a town, for `report.json`: the number of features by state, and the reasons.

use super::entry::{Entry, FeatureState, SkippedFeature};
use crate::site::law::EnvelopeRow;
use hsd_base::diagnostic::{Diagnostics, Language, Origin};
use serde::Serialize;

/// The account of a town: every feature is built, skipped or unused.
#[derive(Debug, Default, Serialize)]
pub struct TownReport {
    /// The number of features of all layers.
    pub features: usize,
    /// The number of features of which something exists.
    pub built: usize,
    /// The number of features in layers that no rule names.
    pub unused: usize,
    /// The numbers of each layer.
    pub layers: Vec<LayerCount>,
    /// All other features, with the reason.
    pub skipped: Vec<SkippedFeature>,
    /// Features that were changed before something was built on them.
    pub corrected: Vec<SkippedFeature>,
    /// Houses above the envelope of their lot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub above_envelope: Vec<SkippedFeature>,
}

/// The number of features of a layer in each state.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LayerCount {
    /// The name of the layer.
    pub name: String,
    /// All of them.
    pub features: usize,
    /// Those of which something exists.
    pub built: usize,
    /// Those of which nothing does.
    pub skipped: usize,
    /// Those that no rule names.
    pub unused: usize,
}

impl TownReport {
    /// Adds a feature and returns its envelopes. Houses behind its house are counted with it.
    pub fn add(&mut self, entry: Entry) -> Vec<EnvelopeRow> {
        if entry.is_part {
            return vec![];
        }
        let number = entry.id.0;
        if self.layers.len() <= number {
            self.layers.resize_with(number + 1, LayerCount::default);
        }
        let layer = &mut self.layers[number];
        self.features += 1;
        layer.features += 1;
        match entry.state {
            FeatureState::Built => {
                self.built += 1;
                layer.built += 1;
            }
            FeatureState::Skipped(why) => {
                self.skipped.push(why);
                layer.skipped += 1;
            }
            FeatureState::Unused => {
                self.unused += 1;
                layer.unused += 1;
            }
        }
        self.corrected.extend(entry.corrected);
        let above = entry.envelopes.iter().filter_map(EnvelopeRow::above);
        self.above_envelope.extend(above);
        entry.envelopes
    }

    /// Names its layers, those without features among them; layers without a name are not counted.
    pub fn name_layers<'n>(&mut self, names: impl Iterator<Item = Option<&'n str>>) {
        let mut counts = std::mem::take(&mut self.layers).into_iter();
        for name in names {
            let count = counts.next().unwrap_or_default();
            self.layers.extend(name.map(|name| LayerCount {
                name: name.to_owned(),
                ..count
            }));
        }
    }
}

/// Returns what was found in the houses of features while they were made.
pub fn problems(found: &Diagnostics) -> Vec<SkippedFeature> {
    let of = |d: &hsd_base::diagnostic::Diagnostic| match &d.origin {
        Origin::Feature { layer, key } => Some(SkippedFeature {
            layer: layer.to_string(),
            key: key.to_string(),
            code: d.code.to_string(),
            reason: d.message.in_language(Language::English).to_string(),
        }),
        Origin::Source(_) => None,
    };
    found.iter().filter_map(of).collect()
}
