//! Houses in the place of others: only the larger one is built.

use super::TownInput;
use super::made::made;
use crate::plan::{Covered, LotId, Plan};
use hsd_ir::ast::town::Made;
use hsd_syntax::parse::xml::FeatureMade;
use std::collections::BTreeSet;

/// Returns true if the rules make a house on the front of a feature.
pub(super) fn has_house(made: &FeatureMade) -> bool {
    let mut made = made.made.iter();
    made.any(|made| matches!(&made.made, Made::Houses { unit: None, .. }))
}

/// Returns for each of some features the outline that covers it, if the rules make a house there too.
pub(super) fn covered(
    (plan, input): (&Plan, TownInput<'_>),
    lots: &[LotId],
    made: &[FeatureMade],
) -> Vec<Option<Covered>> {
    let found = lots.iter().zip(made).map(|(id, made)| {
        let is_house = has_house(made);
        is_house.then(|| plan.covered(*id)).flatten()
    });
    let found: Vec<Option<Covered>> = found.collect();
    let outer: BTreeSet<LotId> = found.iter().flatten().map(|c| c.by).collect();
    if outer.is_empty() {
        return found;
    }
    let built = with_house((plan, input), &outer.into_iter().collect::<Vec<LotId>>());
    let is_built = |covered: &Covered| built.contains(&covered.by);
    found.into_iter().map(|c| c.filter(is_built)).collect()
}

/// Returns those features of which the rules make a house.
fn with_house((plan, input): (&Plan, TownInput<'_>), lots: &[LotId]) -> BTreeSet<LotId> {
    made((plan, input), lots, |made, _| {
        let built = lots.iter().zip(&made).filter(|(_, made)| has_house(made));
        built.map(|(id, _)| *id).collect()
    })
}
