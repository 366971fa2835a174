//! Evaluates the rules of a town at features of its maps.

use super::language::Rules;
use super::read::{ReadSoFar, Reader};
use super::suggest::Suggest;
use super::trees::Trees;
use super::{DEEPEST, UNIT, tree};
use crate::parse::ReadContext;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::{Code, Diagnostics, Severity};
use hsd_base::source::{Source, Span};
use hsd_ir::ast::town::{Made, Site};
use std::collections::BTreeMap;

/// A feature, for the rules of its layer.
pub struct FeatureOf<'s> {
    /// The name of its layer in the town.
    pub layer: &'s str,
    /// What it knows of itself.
    pub site: &'s dyn Site,
}

/// What the rules made of a feature.
#[derive(Debug)]
pub struct RuleMade {
    /// The number of the rule that made it, in the order of the file.
    pub rule: usize,
    /// What it made.
    pub made: Made,
}

/// The result for a feature.
#[derive(Debug, Default)]
pub struct FeatureMade {
    /// In the order of the file.
    pub made: Vec<RuleMade>,
    /// The number of rules whose test it met.
    pub rules: usize,
    /// The first of the gravest problems found while it was evaluated.
    pub problem: Option<(Severity, Code)>,
}

/// How many features lacked a field, by the place that asked for it.
pub type MissingFields = BTreeMap<(Span, String), usize>;

/// Evaluates the rules of a town file at features, one after another; `writes` asks for the texts of houses.
pub fn features<'a>(
    source: &'a Source,
    setting: ReadContext<'a>,
    trees: &mut Trees<'a>,
    (features, writes): (&[FeatureOf<'_>], bool),
    out: &mut Diagnostics,
) -> (Vec<FeatureMade>, MissingFields) {
    let mut reporter = Reporter::new(source);
    let nesting = setting.limits.nesting.min(DEEPEST);
    let tree = match trees.find(source.id(), 0) {
        Some(tree) => tree,
        None => {
            let hints = crate::parse::schema::SCHEMA_HINTS;
            let tree = tree::read(&mut reporter, 0, nesting, hints);
            trees.keep(source.id(), 0, tree)
        }
    };
    reporter.say_once();
    let mut made = vec![];
    let mut rules = Rules::new(&tree, setting, nesting, trees, &mut reporter);
    for feature in features {
        let mut of_feature = FeatureMade::default();
        for rule in 0..rules.len() {
            let found = rules.apply(
                rule,
                feature.layer,
                feature.site,
                |tree, index, state, reporter| {
                    let mut reader = Reader {
                        turn: None,
                        unit: UNIT,
                        tree,
                        reporter,
                        suggest: Suggest::new(),
                        views: vec![],
                        again: ReadSoFar::default(),
                    };
                    reader.made(index, state.0, state.1, writes)
                },
            );
            if let Some(found) = found {
                of_feature.rules += 1;
                let found = found.into_iter().map(|made| RuleMade { rule, made });
                of_feature.made.extend(found);
            }
        }
        of_feature.problem = rules.take_problem();
        made.push(of_feature);
    }
    let missing = rules.finish();
    out.append(reporter.finish());
    (made, missing)
}
