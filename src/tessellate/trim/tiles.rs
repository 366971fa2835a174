//! The edges of a tiled slope: eaves tiles with a hanging front, flat (ichimonji) on the street side and with small
//! discs (manju) elsewhere, and verge tiles that lap over the barge. Sizes from docs/evidence.md 4.4.

use crate::material::SurfaceId;
use crate::scene::Detail;
use crate::tessellate::trim::TrimContext;
use crate::tessellate::trim::body::Body;
use crate::tessellate::trim::line::level_left;
use crate::tessellate::trim::seams::{End, Seam};
use crate::tessellate::trim::slope::{Field, places};
use glam::{DVec2, DVec3};

/// Working width of a tile, and the position of its roll's crest, metres: as in the texture.
const WIDTH: f64 = 0.265;
const CREST: f64 = 0.045;
/// How far fronts hang below the upper surface, and their thickness, metres.
const HANG: f64 = 0.075;
const THICK: f64 = 0.024;
/// How far fronts project beyond the edge, metres.
const OUT: f64 = 0.012;
/// The disc at the end of a roll: radius, metres.
const DISC: f64 = 0.040;
/// How far verge tiles project over the eaves, beyond the fronts there, metres.
const OVER: f64 = 0.028;
/// Verge tiles: how far they lap over the slope and down its edge, and their thickness, metres.
const LAP: (f64, f64, f64) = (0.10, 0.09, 0.022);

/// Direction of the street, in front of the first line: fronts that face it are flat (docs/evidence.md 4.4, S34).
const STREET: DVec2 = DVec2::NEG_Y;

/// Adds the fronts along the eaves.
pub(super) fn eaves(
    context: &TrimContext<'_>,
    fields: &[Field],
    seam: &Seam,
    bodies: &mut Vec<Body>,
) {
    if context.detail < Detail::Openings {
        return;
    }
    let finish = SurfaceId::named("ibushi");
    // Fronts tile by tile are for halls: on a house they would weigh as much as the rest of its roof.
    let great = context.detail == Detail::Everything && context.roof.trim.noshi > 4;
    for (span, ends) in seam.spans.iter().zip(seam.points.windows(2)) {
        let field = &fields[span.left as usize];
        let out = -level_left(ends[1] - ends[0]);
        let wavy = great && out.dot(STREET) < 0.9;
        if !wavy {
            plain(finish, ends, out, bodies);
            continue;
        }
        let (s0, s1) = (field.s(ends[0]), field.s(ends[1]));
        let at = |s: f64| ends[0].lerp(ends[1], (s - s0) / (s1 - s0));
        let (lo, hi) = (s0.min(s1), s0.max(s1));
        // From crest to crest the foot of the front sags as the pan does.
        let mut cuts = vec![lo, hi];
        for crest in places(lo - WIDTH, hi, WIDTH, CREST) {
            let inner = [0.0, 0.33, 0.67].map(|share| crest + share * WIDTH);
            cuts.extend(
                inner
                    .into_iter()
                    .filter(|s| *s > lo + 0.02 && *s < hi - 0.02),
            );
        }
        cuts.sort_by(f64::total_cmp);
        let sag = |s: f64| {
            let share = ((s - CREST) / WIDTH).rem_euclid(1.0);
            0.030 * libm::sin(std::f64::consts::PI * share)
        };
        let sections = cuts.iter().map(|s| front(at(*s), out, 0.055 + sag(*s)));
        let front = Body::loft(finish, &sections.collect::<Vec<_>>());
        bodies.extend(front.map(Body::smooth));
        for crest in places(lo + DISC, hi - DISC, WIDTH, CREST) {
            let place = (-0.028, OUT + 0.016);
            bodies.extend(disc(finish, at(crest), out, DISC, place, 7));
        }
    }
}

/// Returns a vertical section of a front with this hang, metres.
fn front(at: DVec3, out: DVec2, hang: f64) -> Vec<DVec3> {
    let (fore, back) = ((out * OUT).extend(0.0), (out * (OUT - THICK)).extend(0.0));
    let (top, low) = (DVec3::Z * 0.006, DVec3::Z * -hang);
    vec![
        at + fore + low,
        at + fore + top,
        at + back + top + low * 0.4,
    ]
}

/// Adds straight fronts, one per span.
fn plain(finish: SurfaceId, ends: &[DVec3], out: DVec2, bodies: &mut Vec<Body>) {
    let sections = [front(ends[0], out, HANG), front(ends[1], out, HANG)];
    bodies.extend(Body::loft(finish, &sections));
}

/// Adds a round plate facing out over the eaves; `from` and `up` give its start outside the edge and the height of its
/// centre.
pub(super) fn disc(
    finish: SurfaceId,
    at: DVec3,
    out: DVec2,
    radius: f64,
    (up, to): (f64, f64),
    sides: u32,
) -> Option<Body> {
    let (across, out) = (out.perp().extend(0.0), out.extend(0.0));
    let middle = at + DVec3::Z * up + out * (to - 0.035);
    let corner = |i: u32| {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(sides);
        middle + across * (radius * libm::cos(angle)) + DVec3::Z * (radius * libm::sin(angle))
    };
    let body = Body::sweep(finish, (0..sides).map(corner).collect(), out * 0.035);
    body.map(Body::smooth)
}

/// Adds verge tiles over the outermost tiles and down the edge.
pub(super) fn verge(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    if context.detail < Detail::Openings {
        return;
    }
    let (lap, down, thick) = LAP;
    let last = seam.points.len() - 1;
    let mut points = seam.points.clone();
    for (end, at, back) in [(0, 0, 1), (1, last, last - 1)] {
        let way = seam.points[at] - seam.points[back];
        if seam.ends[end] == End::Free && way.z < 0.0 {
            points[at] += way * (OVER / way.truncate().length().max(OVER));
        }
    }
    let section = |i: usize| -> Vec<DVec3> {
        let way = seam.points[(i + 1).min(last)] - seam.points[i.max(1) - 1];
        let out = -level_left(way);
        let place = |(w, z): (f64, f64)| points[i] + (out * w).extend(z);
        let profile = [
            (-lap, -0.02),
            (0.0, -0.02),
            (0.0, -down),
            (thick, -down),
            (thick, 0.012),
            (0.0, 0.034),
            (-lap + 0.02, 0.034),
            (-lap, 0.018),
        ];
        profile.into_iter().map(place).collect()
    };
    let sections: Vec<Vec<DVec3>> = (0..=last).map(section).collect();
    let tiles = Body::loft(SurfaceId::named("ibushi"), &sections);
    bodies.extend(tiles.map(Body::smooth));
}
