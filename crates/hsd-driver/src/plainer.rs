//! Houses of towns with too many triangles: each is shown at the finest level of detail at which it has fewer.

use super::house::{LeftOut, OnFeature};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::messages::limits::{shown_plainer, too_many_triangles};
use hsd_ir::building::Built;
use hsd_ir::catalog::Catalog;
use hsd_mesh::{HouseDrafts, Options, Tessellator};
use hsd_scene::Detail;
use std::slice;

/// The parts of a house with too many triangles, or why it is left out.
pub(super) type Plainer = Result<HouseDrafts, LeftOut>;

/// Makes a house at a lower level of detail than that of the options, at which it has too many triangles, and reports that level.
///
/// `number` is its place in the run, counted from 1.
///
/// # Errors
/// The house, if it has too many triangles at every level of detail.
pub(super) fn plainer(
    (built, number): (&Built, usize),
    on: &OnFeature,
    (catalog, options): (&Catalog, Options),
    out: &mut Diagnostics,
) -> Plainer {
    let (place, most) = (built.house.span, options.triangles);
    let below = Detail::ALL.into_iter().filter(|d| *d < options.detail);
    let made = below.rev().find_map(|detail| {
        let tessellator = Tessellator::new(catalog, Options { detail, ..options });
        let mut drafts = tessellator.houses(slice::from_ref(built), number);
        let fits = drafts.take_oversized().is_empty();
        fits.then_some((drafts, detail))
    });
    let mut found = Diagnostics::new();
    found.push(match &made {
        Some((_, detail)) => {
            shown_plainer(place, most, (options.detail as usize, *detail as usize))
        }
        None => too_many_triangles(place, most),
    });
    let shown = made.map(|(drafts, _)| drafts);
    let shown = shown.ok_or_else(|| on.without_house(&found));
    out.append(found.of_feature(&on.origin));
    shown
}
