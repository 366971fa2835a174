//! A first look at what rules make of features, without texts and messages.

use super::{TownInput, cache, context};
use crate::plan::{LotId, Plan};
use crate::site::LotSite;
use hsd_base::diagnostic::Diagnostics;
use hsd_syntax::parse::Values;
use hsd_syntax::parse::xml::{self, FeatureMade, FeatureOf, Trees};

/// Evaluates the rules for some features; `take` gets what they make, in the order of the features.
pub(super) fn made<R>(
    (plan, input): (&Plan, TownInput<'_>),
    lots: &[LotId],
    take: impl FnOnce(Vec<FeatureMade>, &[LotSite<'_>]) -> R,
) -> R {
    let (cache, values) = (cache(input), Values::default());
    let sites: Vec<LotSite<'_>> = lots.iter().map(|id| LotSite::new(plan, *id)).collect();
    let features = sites.iter().zip(lots).map(|(site, (layer, _))| FeatureOf {
        layer: &plan.layers[*layer].layer.name.value,
        site,
    });
    let features: Vec<FeatureOf<'_>> = features.collect();
    let setting = context(input, &cache, &values);
    let (mut trees, mut unsaid) = (Trees::default(), Diagnostics::new());
    let wanted = (&*features, false);
    let (made, _) = xml::features(input.source, setting, &mut trees, wanted, &mut unsaid);
    take(made, &sites)
}
