//! Thick edges: the stack of shingles or bark at the eaves (nokizuke, docs/evidence.md 4.4: 0.10-0.15 m with kokera,
//! some tens of centimetres with bark), and the rounded edge of thatch.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::edge::rim::{Corner, Rim};
use hsd_ir::ast::RoofKind;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// How far an edge extends into the roof, metres.
const INTO: f64 = 0.12;
/// Distance of the edge below the upper surface, so that no faces are coplanar, metres.
const BELOW: f64 = 0.004;

/// Adds the thick edge along a rim, for coverings that have one.
pub(in crate::trim) fn edge(context: &TrimContext<'_>, rim: &Rim, bodies: &mut Vec<Body>) {
    if context.detail < Detail::Openings {
        return;
    }
    let fine = context.detail == Detail::Everything;
    let few = |count: u32| if fine { count } else { 1 };
    let body = |name: &str, profile: &dyn Fn(&Corner) -> Vec<(f64, f64)>| {
        rim.body(SurfaceId::named(name), profile)
    };
    bodies.extend(match context.roof.kind {
        RoofKind::Shingles => body("shingle", &|c| layers(c, (0.14, 0.022), few(4))),
        RoofKind::Bark => body("bark", &|c| layers(c, (0.34, 0.045), few(5))),
        RoofKind::Thatch => body("thatch", &|c| roll(c, 2 + few(3))).map(Body::smooth),
        _ => None,
    });
}

/// Returns layers that step in from top to bottom, given their smallest total height and the projection of the topmost,
/// metres.
fn layers(corner: &Corner, (least, out): (f64, f64), count: u32) -> Vec<(f64, f64)> {
    let height = (corner.deep + 0.02).max(least);
    let thick = (height - BELOW) / f64::from(count);
    let mut profile = vec![(-INTO, -height), (-INTO, -BELOW - 0.5 * thick.min(0.05))];
    for i in 0..count {
        let own = out * (1.0 - 0.8 * f64::from(i) / f64::from(count));
        let top = -BELOW - thick * f64::from(i);
        profile.extend([
            (own, top),
            (own - 0.3 * out / f64::from(count), top - thick),
        ]);
    }
    profile
}

/// Returns the profile of a roll around the edge.
fn roll(corner: &Corner, steps: u32) -> Vec<(f64, f64)> {
    let half = corner.deep / 2.0;
    let bulge = (0.28 * corner.deep).min(0.18);
    let mut profile = vec![(-INTO, -corner.deep + BELOW), (-INTO, -BELOW - 0.05)];
    for i in 0..=steps {
        let angle = std::f64::consts::PI * f64::from(i) / f64::from(steps);
        let up = half * libm::cos(angle);
        let out = bulge * libm::sin(angle);
        profile.push((out, -half + up * (1.0 - 2.0 * BELOW)));
    }
    profile
}
