//! Houses of a town, and the features of its maps that they stand on.

#[cfg(feature = "models")]
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::{Code, Origin, Text};
#[cfg(feature = "models")]
use hsd_base::text;
use hsd_ir::ast;

/// A house of a town.
#[derive(Debug)]
pub struct FeatureHouse {
    /// The number of the layer of its feature, and the number of that in the layer.
    pub feature: (usize, usize),
    /// The house.
    pub house: ast::House,
    /// The feature on which it stands.
    pub origin: Origin,
    /// Its name in the model.
    pub name: String,
    /// What stands in its place if it has errors.
    pub plain: Option<Box<ast::House>>,
    /// Its text, if it was asked for.
    pub text: Option<ast::town::HouseText>,
}

/// A house of a town that is left out, since it would exceed a limit.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The feature on which it would stand: the number of its layer, and its number there.
    pub feature: (usize, usize),
    /// The place as diagnostics name it.
    pub origin: Origin,
    /// The code of the diagnostic.
    pub code: Code,
    /// The reason.
    pub why: Text,
}

/// The feature on which a house of a town stands.
#[derive(Clone, Debug)]
pub(crate) struct OnFeature {
    pub(crate) feature: (usize, usize),
    pub(crate) origin: Origin,
}

#[cfg(feature = "models")]
impl OnFeature {
    /// Returns the house that is left out for the reason that was found last.
    pub(crate) fn without_house(&self, found: &Diagnostics) -> LeftOut {
        let last = found.iter().last();
        LeftOut {
            feature: self.feature,
            origin: self.origin.clone(),
            code: last.map_or(Code(904), |found| found.code),
            why: last.map_or_else(
                || text!("it would exceed a limit", "上限を超えます"),
                |found| found.message.clone(),
            ),
        }
    }
}

/// The feature on which a house stands, its name, and what stands in its place if it has errors.
pub(super) struct OfFeature {
    pub(super) on: OnFeature,
    pub(super) name: String,
    pub(super) plain: Option<Box<ast::House>>,
}
