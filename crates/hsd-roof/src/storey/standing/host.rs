//! The slopes of a storey's roofs as seen by what stands on them: dormers and monitors.

use crate::facet::{Sides, edges};
use crate::frame::Plane;
use crate::shape::form::RoofDraft;
use glam::DVec2;

/// How far from a border of facets a place still lies on them, metres.
const ON: f64 = 1e-6;

/// All facets of some roofs, before these meet.
pub(crate) struct Slopes {
    /// The roof, the borders and the upper surface of each facet.
    facets: Vec<(usize, Sides, Plane)>,
}

impl Slopes {
    /// Collects the facets of roofs.
    pub(crate) fn of(roofs: &[RoofDraft]) -> Slopes {
        let each = roofs.iter().enumerate();
        let facets = each.flat_map(|(n, r)| r.form.facets.iter().map(move |f| (n, f)));
        let sides = |f: &crate::facet::Facet| {
            let outline: Vec<DVec2> = f.outline.iter().map(|c| c.at).collect();
            edges(&outline)
        };
        Slopes {
            facets: facets.map(|(n, f)| (n, sides(f), f.plane)).collect(),
        }
    }

    /// Returns the highest roof over a place and its surface there.
    pub(crate) fn over(&self, p: DVec2) -> Option<(usize, Plane)> {
        let here = self
            .facets
            .iter()
            .filter(|(_, sides, _)| sides.iter().all(|s| s.depth(p) > -ON));
        here.max_by(|a, b| a.2.at(p).total_cmp(&b.2.at(p)))
            .map(|(n, _, plane)| (*n, *plane))
    }

    /// Returns the height of the highest roof over a place, metres.
    pub(crate) fn top(&self, p: DVec2) -> Option<f64> {
        self.over(p).map(|(_, plane)| plane.at(p))
    }
}
