//! Plastered eaves and verges (漆喰塗込め shikkui nurigome) of storehouses and other houses whose walls are plastered over
//! their posts: instead of rafters and barge boards, stepped bands of plaster (鉢巻 hachimaki) run around the house under
//! the tiles, so that no timber is exposed to fire (docs/evidence.md 4.6, 4.7).

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::level_left;
use crate::trim::seams::{End, Kind, Seam};
use glam::{DVec2, DVec3};
use hsd_ir::ast::RoofShape;
use hsd_ir::material::SurfaceId;

/// Projection of a band from the wall line, and its depth below the roof, metres; the upper band first. The plaster
/// over the posts is itself 90 mm thick.
const BANDS: [(f64, f64); 2] = [(0.20, 0.13), (0.14, 0.26)];
/// Smallest setback of bands from the edge of the roof, metres.
const BACK: f64 = 0.025;
/// How far bands extend into the roof above and the wall behind them, metres.
const SUNK: f64 = 0.01;
/// Additional projection of a verge's band, so that it covers the ends of those of the eaves, metres.
const CLEAR: f64 = 0.002;
/// Overhangs below this have no room for bands, metres.
const LEAST: f64 = 0.12;

/// Adds the bands under eaves or a verge.
pub(in crate::trim) fn bands(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let trim = &context.roof.trim;
    let gable = matches!(
        context.roof.shape,
        RoofShape::Gable | RoofShape::BroadGable | RoofShape::LeanTo
    );
    let (own, other, clear) = match seam.kind {
        Kind::Verge => (trim.verge, trim.eaves, CLEAR),
        _ if gable => (trim.eaves, trim.verge, 0.0),
        _ => (trim.eaves, trim.eaves, 0.0),
    };
    if own < LEAST {
        return;
    }
    for (out, deep) in BANDS {
        let behind = (own - out - clear).max(BACK);
        let beside = (other - out - CLEAR + clear).max(BACK);
        let band = Band {
            own,
            behind,
            beside,
            deep,
        };
        let sections: Vec<Vec<DVec3>> = (0..seam.points.len())
            .map(|i| band.section(context, seam, i))
            .collect();
        bodies.extend(Body::loft(SurfaceId::named("plaster"), &sections));
    }
}

struct Band {
    /// Distance from the edge of the roof to the wall line, metres.
    own: f64,
    /// Distance from the edge of the roof to the band, metres.
    behind: f64,
    /// Setback where the roof turns its corner, metres.
    beside: f64,
    /// Depth below the roof, metres.
    deep: f64,
}

impl Band {
    /// Returns the section at a corner of the seam.
    fn section(&self, context: &TrimContext<'_>, seam: &Seam, i: usize) -> Vec<DVec3> {
        let last = seam.points.len() - 1;
        let way = seam.points[(i + 1).min(last)] - seam.points[i.max(1) - 1];
        let inward: DVec2 = level_left(way);
        let (span, deep) = match i {
            0 => (&seam.spans[0], seam.spans[0].deep[0]),
            _ => (&seam.spans[i - 1], seam.spans[i - 1].deep[1]),
        };
        let drawn = match i {
            0 if seam.ends[0] != End::Joint => self.beside,
            i if i == last && seam.ends[1] != End::Joint => -self.beside,
            _ => 0.0,
        };
        let run = way.truncate().length().max(1e-9);
        let along = way / run;
        // Where the roof's lower surface lies so far inside its edge.
        let rise = context.surface.facets[span.left as usize].rise;
        let at = |inside: f64| {
            let plan = along * drawn + (inward * inside).extend(0.0);
            let z = match seam.kind {
                Kind::Verge => plan.z,
                _ => rise.dot(plan.truncate()),
            };
            seam.points[i] + DVec3::new(plan.x, plan.y, z - deep)
        };
        let (near, far) = (at(self.behind), at(self.own + SUNK));
        let foot = near.z.min(far.z) - self.deep;
        let low = |p: DVec3| p.truncate().extend(foot);
        vec![
            near + DVec3::Z * SUNK,
            low(near),
            low(far),
            far + DVec3::Z * SUNK,
        ]
    }
}
