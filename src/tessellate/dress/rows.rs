//! What runs up a slope in rows: the round cover tiles of hon-gawara with their discs (gato) and the curved flat
//! tiles between them at the eaves, and the standing seams of sheet metal. Rows stand where the pictures of the
//! coverings have them, in one phase over all facets of a slope.

use super::Tailor;
use super::body::Body;
use super::line::level_left;
use super::seams::Seam;
use super::slope::{Field, places};
use super::tiles::disc;
use crate::material::SurfaceId;
use crate::scene::Detail;
use glam::{DVec2, DVec3};

/// From row to row of cover tiles, and their radius, metres: as `texture` draws them.
const ROW: f64 = 0.272;
const RADIUS: f64 = 0.074;
/// How high cover tiles rise over the slope, metres.
const RISE: f64 = 0.066;
/// From seam to seam of sheet metal, their half width and height, metres.
const SHEET: f64 = 0.455;
const SEAM: (f64, f64) = (0.009, 0.028);
/// How far rows reach into the slope, metres.
const SUNK: f64 = 0.012;

/// The rows of a facet.
pub(super) fn cover_tiles(field: &Field, bodies: &mut Vec<Body>) {
    const STEPS: u32 = 5;
    let mut profile = vec![(-RADIUS, -SUNK), (RADIUS, -SUNK)];
    for i in 0..=STEPS {
        let angle = std::f64::consts::PI * f64::from(i) / f64::from(STEPS);
        profile.push((RADIUS * libm::cos(angle), RISE * libm::sin(angle)));
    }
    let finish = SurfaceId::named("ibushi");
    for s in field.places(ROW, ROW / 2.0, RADIUS) {
        let row = field.row(finish, s, &profile);
        bodies.extend(row.map(Body::softly));
    }
}

/// Standing seams of a facet.
pub(super) fn seams(field: &Field, bodies: &mut Vec<Body>) {
    let (half, high) = SEAM;
    let profile = [(-half, -SUNK), (half, -SUNK), (half, high), (-half, high)];
    let finish = SurfaceId::named("sheet_roof");
    for s in field.places(SHEET, 0.0, 4.0 * half) {
        bodies.extend(field.row(finish, s, &profile));
    }
}

/// The eaves of cover tiles: a disc before each row, a hollow front between two.
pub(super) fn eaves(tailor: &Tailor<'_>, fields: &[Field], seam: &Seam, bodies: &mut Vec<Body>) {
    if tailor.detail < Detail::Openings {
        return;
    }
    let finish = SurfaceId::named("ibushi");
    for (span, ends) in seam.spans.iter().zip(seam.points.windows(2)) {
        let field = &fields[span.left as usize];
        let out = -level_left(ends[1] - ends[0]);
        if tailor.detail < Detail::Everything {
            let sections = [hanging(ends[0], out, 0.09), hanging(ends[1], out, 0.09)];
            bodies.extend(Body::loft(finish, &sections));
            continue;
        }
        let (s0, s1) = (field.s(ends[0]), field.s(ends[1]));
        let at = |s: f64| ends[0].lerp(ends[1], (s - s0) / (s1 - s0));
        let (lo, hi) = (s0.min(s1), s0.max(s1));
        let mut cuts = vec![lo, hi];
        for row in places(lo - ROW, hi, ROW, ROW / 2.0) {
            let inner = [0.0, 0.3, 0.5, 0.7].map(|share| row + share * ROW);
            cuts.extend(
                inner
                    .into_iter()
                    .filter(|s| *s > lo + 0.02 && *s < hi - 0.02),
            );
        }
        cuts.sort_by(f64::total_cmp);
        // The flat tile sags between two rows, and its hanging front with it.
        let sag = |s: f64| {
            let share = (s / ROW - 0.5).rem_euclid(1.0);
            0.035 * libm::sin(std::f64::consts::PI * share)
        };
        let sections = cuts.iter().map(|s| hanging(at(*s), out, 0.05 + sag(*s)));
        bodies.extend(Body::loft(finish, &sections.collect::<Vec<_>>()));
        for row in places(lo + RADIUS, hi - RADIUS, ROW, ROW / 2.0) {
            bodies.extend(disc(
                finish,
                at(row),
                out,
                1.08 * RADIUS,
                (0.004, 0.045),
                10,
            ));
        }
    }
}

/// An upright section of the front that hangs so far.
fn hanging(at: DVec3, out: DVec2, hang: f64) -> Vec<DVec3> {
    let (fore, back) = ((out * 0.02).extend(0.0), (out * -0.012).extend(0.0));
    let (top, low) = (DVec3::Z * 0.004, DVec3::Z * -hang);
    vec![
        at + back + low,
        at + fore + low,
        at + fore + top,
        at + back + top,
    ]
}
