//! Rows up a slope: the round cover tiles of hon-gawara with their discs (gato) and the curved flat tiles between them
//! at the eaves, and the standing seams of sheet metal. Rows match the textures of the coverings, in one phase over all
//! facets of a slope.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::level_left;
use crate::trim::seams::Seam;
use crate::trim::slope::{Field, places};
use crate::trim::tiles::ring;
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Spacing of rows of cover tiles, and their radius, metres: as in the texture.
const ROW: f64 = 0.272;
const RADIUS: f64 = 0.074;
/// Height of cover tiles above the slope, metres.
const RISE: f64 = 0.066;
/// Spacing of sheet metal seams, their half width and height, metres.
const SHEET: f64 = 0.455;
const SEAM: (f64, f64) = (0.009, 0.028);
/// Half the joint between two fronts, metres.
const JOINT: f64 = 0.001;
/// The disc at the end of a row: its radius, how high its middle lies over the edge and how far its rim stands before it,
/// metres; rings from its back to its face, metres before its rim and shares of its radius.
const DISC: f64 = 1.08 * RADIUS;
const DISC_UP: f64 = 0.004;
const DISC_OUT: f64 = 0.045;
const DISC_RINGS: [(f64, f64); 4] = [(-0.035, 1.0), (0.0, 1.0), (0.0, 0.78), (-0.012, 0.78)];
/// A comma from its head to its tail: the angle from its own direction, degrees, how far its spine lies from the middle and
/// half its width, shares of the face, and the height of its back over the face, metres; how far it extends into the face.
const COMMA: [[f64; 4]; 3] = [
    [-20.0, 0.42, 0.20, 0.008],
    [40.0, 0.58, 0.20, 0.010],
    [110.0, 0.80, 0.06, 0.005],
];
const SUNK_COMMA: f64 = 0.002;
/// How far rows extend into the slope, metres.
const SUNK: f64 = 0.012;

/// Adds the rows of all slopes.
pub(in crate::trim) fn cover_tiles(fields: &[Field], bodies: &mut Vec<Body>) {
    // Half round in four faces, shaded as a curve.
    let shoulder = (0.70 * RADIUS, 0.70 * RISE);
    let profile = [
        (-RADIUS, -SUNK),
        (RADIUS, -SUNK),
        shoulder,
        (0.0, RISE),
        (-shoulder.0, shoulder.1),
    ];
    let finish = SurfaceId::named("ibushi");
    for first in 0..fields.len() {
        let number = fields[first].slope();
        if fields[..first].iter().any(|f| f.slope() == number) {
            continue;
        }
        let slope: Vec<&Field> = fields.iter().filter(|f| f.slope() == number).collect();
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for (from, to) in slope.iter().map(|f| f.bounds()) {
            (lo, hi) = (lo.min(from.x), hi.max(to.x));
        }
        let right = fields[first].right();
        for s in places(lo + RADIUS, hi - RADIUS, ROW, ROW / 2.0) {
            let rows = Field::rows(&slope, finish, s, &profile).into_iter();
            bodies.extend(rows.map(|row| row.smooth().in_row("cover tiles", right)));
        }
    }
}

/// Adds the standing seams of a facet.
pub(in crate::trim) fn seams(field: &Field, bodies: &mut Vec<Body>) {
    let (half, high) = SEAM;
    let profile = [(-half, -SUNK), (half, -SUNK), (half, high), (-half, high)];
    let finish = SurfaceId::named("sheet_roof");
    for s in field.places(SHEET, 0.0, 4.0 * half) {
        bodies.extend(field.row(finish, s, &profile));
    }
}

/// Adds the eaves of cover tiles: a disc in front of each row, a concave front between two.
pub(in crate::trim) fn eaves(
    context: &TrimContext<'_>,
    fields: &[Field],
    seam: &Seam,
    bodies: &mut Vec<Body>,
) {
    if context.detail < Detail::Openings {
        return;
    }
    let finish = SurfaceId::named("ibushi");
    for (span, ends) in seam.spans.iter().zip(seam.points.windows(2)) {
        let field = &fields[span.left as usize];
        let out = -level_left(ends[1] - ends[0]);
        if context.detail < Detail::Everything {
            let sections = [hanging(ends[0], out, 0.09), hanging(ends[1], out, 0.09)];
            bodies.extend(Body::loft(finish, &sections));
            continue;
        }
        let (s0, s1) = (field.s(ends[0]), field.s(ends[1]));
        let at = |s: f64| ends[0].lerp(ends[1], (s - s0) / (s1 - s0));
        let (lo, hi) = (s0.min(s1), s0.max(s1));
        let right = field.right();
        // The flat tile sags between two rows, and its hanging front with it.
        let sag = |s: f64| {
            let share = (s / ROW - 0.5).rem_euclid(1.0);
            0.035 * libm::sin(std::f64::consts::PI * share)
        };
        for row in places(lo - ROW, hi, ROW, ROW / 2.0) {
            // The joint between two lies behind a disc.
            let (from, to) = ((row + JOINT).max(lo), (row + ROW - JOINT).min(hi));
            if to - from < 0.02 {
                continue;
            }
            let inner = [0.3, 0.7].map(|share| row + share * ROW);
            let inner = inner.iter().filter(|s| **s > from && **s < to);
            let cuts = std::iter::once(&from).chain(inner).chain([&to]);
            let sections: Vec<_> = cuts.map(|s| hanging(at(*s), out, 0.05 + sag(*s))).collect();
            let front = Body::loft(finish, &sections);
            bodies.extend(front.map(|body| body.smooth().in_row("eaves tiles", right)));
        }
        for row in places(lo + RADIUS, hi - RADIUS, ROW, ROW / 2.0) {
            let disc = rimmed_disc(finish, at(row), out);
            bodies.extend(disc.map(|body| body.in_row("eaves tiles", right)));
        }
    }
}

/// Builds the disc (瓦当 gato) that closes a row at the eaves: a rim round a sunken face, on which three commas whirl
/// (三つ巴 mitsudomoe).
fn rimmed_disc(finish: SurfaceId, at: DVec3, out: DVec2) -> Option<Body> {
    const SIDES: u32 = 8;
    let middle = |ahead: f64| at + DVec3::Z * DISC_UP + (out * (DISC_OUT + ahead)).extend(0.0);
    let section = |(ahead, share): (f64, f64)| ring(middle(ahead), out, DISC * share, SIDES);
    let sections: Vec<Vec<DVec3>> = DISC_RINGS.into_iter().map(section).collect();
    let disc = Body::loft(finish, &sections)?.smooth();
    let (face, share) = DISC_RINGS[DISC_RINGS.len() - 1];
    let commas = [0.0, 120.0, 240.0].map(|turn| {
        let sections = COMMA.map(|[angle, radius, half, high]| {
            let angle = f64::to_radians(angle + turn);
            let way = out.perp().extend(0.0) * libm::cos(angle) + DVec3::Z * libm::sin(angle);
            let off = |share_out: f64, ahead: f64| {
                middle(face + ahead) + way * (DISC * share * share_out)
            };
            vec![
                off(radius - half, -SUNK_COMMA),
                off(radius + half, -SUNK_COMMA),
                off(radius, high),
            ]
        });
        Body::loft(finish, &sections)
    });
    let whole = commas
        .iter()
        .flatten()
        .fold(disc, |disc, comma| disc.and(comma));
    Some(whole)
}

/// Returns a vertical section of the front with this hang, metres.
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
