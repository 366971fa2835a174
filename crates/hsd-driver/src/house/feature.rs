//! Houses of a town and their features on its maps.

#[cfg(feature = "models")]
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::{Code, Origin, Text};
#[cfg(feature = "models")]
use hsd_base::text;
use hsd_ir::ast;

/// A house of a town.
#[derive(Debug)]
pub struct FeatureHouse {
    /// The feature: the number of its layer, and its number in the layer.
    pub feature: (usize, usize),
    /// The house.
    pub house: ast::House,
    /// The feature as diagnostics name it.
    pub origin: Origin,
    /// The name in the model.
    pub name: String,
    /// The plain body that replaces it if it has errors.
    pub plain: Option<Box<ast::House>>,
    /// The source text, if requested.
    pub text: Option<ast::town::HouseText>,
}

/// A house of a town that is left out, since it would exceed a limit.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The feature: the number of its layer, and its number in the layer.
    pub feature: (usize, usize),
    /// The feature as diagnostics name it.
    pub origin: Origin,
    /// The name in the model.
    pub name: String,
    /// The code of the diagnostic.
    pub code: Code,
    /// The reason.
    pub why: Text,
}

/// The feature of a house, and the name of the house.
#[derive(Clone, Debug)]
pub(crate) struct OnFeature {
    pub(crate) feature: (usize, usize),
    pub(crate) origin: Origin,
    pub(crate) name: String,
}

#[cfg(feature = "models")]
impl OnFeature {
    /// Returns the omitted house with the last reported reason.
    pub(crate) fn without_house(&self, found: &Diagnostics) -> LeftOut {
        let last = found.iter().last();
        LeftOut {
            feature: self.feature,
            origin: self.origin.clone(),
            name: self.name.clone(),
            code: last.map_or(Code(904), |found| found.code),
            why: last.map_or_else(
                || text!("it would exceed a limit", "上限を超えます"),
                |found| found.message.clone(),
            ),
        }
    }
}

/// The feature of a house, and the plain body that replaces the house if it has errors.
pub(super) struct OfFeature {
    pub(super) on: OnFeature,
    pub(super) plain: Option<Box<ast::House>>,
}
