//! Houses of a town and their features on its maps.

use glam::DVec2;
use hsd_base::diagnostic::{Code, Diagnostic, Diagnostics, Origin, Text};
#[cfg(feature = "models")]
use hsd_base::text;
use hsd_ir::{ast, program};
use hsd_passes::lower;
use hsd_syntax::messages::town::{not_laid, plain_body, too_large};

/// The distance by which the walls of a house may leave the hull of its outline, metres.
const LEAVES: f64 = 0.5;

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
    /// The plain body that replaces it if it has errors or leaves its outline.
    pub plain: Option<Box<ast::House>>,
    /// The convex hull of its outline, counter-clockwise, if its walls must not leave that.
    pub within: Option<Vec<DVec2>>,
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

/// The feature of a house, and the plain body that replaces the house if it has errors or leaves its outline.
pub(super) struct OfFeature {
    pub(super) on: OnFeature,
    pub(super) plain: Option<Box<ast::House>>,
    pub(super) within: Option<Vec<DVec2>>,
}

impl OfFeature {
    /// Returns why a house cannot stand as it was made, if it cannot: it has errors, or it is too large.
    pub(super) fn unfit(
        &self,
        house: &ast::House,
        made: Option<&program::House>,
        found: &Diagnostics,
    ) -> Option<Diagnostic> {
        let kind = house.name.as_ref().map_or("", |name| &name.value);
        let origin = self.on.origin.clone();
        match found.first_error() {
            Some(first) if self.plain.is_some() => Some(plain_body(origin, kind, &first.message)),
            Some(first) => Some(not_laid(origin, kind, &first.message)),
            None => {
                let off = self.leaves(made?)?;
                Some(too_large(origin, kind, off))
            }
        }
    }

    /// Returns how far the walls of a house leave the outline, metres, if that is too far.
    fn leaves(&self, house: &program::House) -> Option<f64> {
        let hull = self.within.as_ref()?;
        let house = lower::house(house.clone(), &mut Diagnostics::new());
        let rings = house.storeys.iter().flat_map(|storey| &storey.rings);
        let walls = rings.flat_map(|ring| &ring.walls);
        let most = walls
            .map(|wall| outside(hull, house.world(wall.from)))
            .fold(0.0, f64::max);
        (most > LEAVES).then_some(most)
    }
}

/// Returns the distance of a place from the nearest line along a side of a convex ring behind which it lies, 0 inside.
fn outside(hull: &[DVec2], place: DVec2) -> f64 {
    let sides = hull.iter().zip(hull.iter().cycle().skip(1));
    let beyond = sides.map(|(p, q)| (place - *p).perp_dot((*q - *p).normalize_or_zero()));
    beyond.fold(0.0, f64::max)
}
