//! The edges of a tiled slope: eaves tiles with a hanging front, flat (ichimonji) on the street side and with small
//! discs (manju) elsewhere, and verge tiles that lap over the barge. Sizes from docs/evidence.md 4.4.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::{Line, level_left};
use crate::trim::seams::{End, Seam};
use crate::trim::slope::{Field, places};
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

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
/// Half the width of the joint between two straight fronts, metres.
const JOINT: f64 = 0.002;
/// How far verge tiles project over the eaves, beyond the fronts there, metres.
const OVER: f64 = 0.028;
/// Verge tiles: how far they lap over the slope and down its edge, and their thickness, metres.
const LAP: (f64, f64, f64) = (0.10, 0.09, 0.022);
/// The length of a verge tile that shows, how much of it reaches under the next one, and how much higher its foot lies, metres.
const LENGTH: f64 = 0.235;
const UNDER_NEXT: f64 = 0.1;
const RISE: f64 = 0.014;
/// Shorter edges have one tile, metres.
const SHORTEST: f64 = 0.6;

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
        let (s0, s1) = (field.s(ends[0]), field.s(ends[1]));
        let at = |s: f64| ends[0].lerp(ends[1], (s - s0) / (s1 - s0));
        let (lo, hi) = (s0.min(s1), s0.max(s1));
        if !wavy {
            let mut cuts = vec![lo, hi];
            if context.detail == Detail::Everything {
                let crests = places(lo, hi, WIDTH, CREST);
                cuts.extend(crests.filter(|s| *s > lo + 0.05 && *s < hi - 0.05));
                cuts.sort_by(f64::total_cmp);
            }
            plain(finish, &cuts, at, out, bodies);
            if context.detail == Detail::Everything && out.dot(STREET) < 0.9 {
                discs(finish, (lo, hi), at, (out, 5), bodies);
            }
            continue;
        }
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
        discs(finish, (lo, hi), at, (out, 7), bodies);
    }
}

/// Adds the small discs (万十 manju) at the ends of the rolls between two places along the eaves, with a number of sides.
fn discs(
    finish: SurfaceId,
    (lo, hi): (f64, f64),
    at: impl Fn(f64) -> DVec3,
    (out, sides): (DVec2, u32),
    bodies: &mut Vec<Body>,
) {
    for crest in places(lo + DISC, hi - DISC, WIDTH, CREST) {
        let place = (-0.028, OUT + 0.016);
        let disc = disc(finish, at(crest), out, DISC, place, sides);
        bodies.extend(disc.map(|body| body.in_row("eaves tiles", out)));
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

/// Adds straight fronts from cut to cut, with joints between them.
fn plain(
    finish: SurfaceId,
    cuts: &[f64],
    at: impl Fn(f64) -> DVec3,
    out: DVec2,
    bodies: &mut Vec<Body>,
) {
    let last = cuts.len() - 2;
    for (i, cut) in cuts.windows(2).enumerate() {
        let from = if i > 0 { JOINT } else { 0.0 };
        let to = if i < last { JOINT } else { 0.0 };
        let sections = [cut[0] + from, cut[1] - to].map(|s| front(at(s), out, HANG));
        let body = Body::loft(finish, &sections);
        bodies.extend(body.map(|body| body.in_row("eaves tiles", out)));
    }
}

/// Adds a round plate facing out over the eaves; `from` and `up` give its start outside the edge and the height of its
/// centre.
fn disc(
    finish: SurfaceId,
    at: DVec3,
    out: DVec2,
    radius: f64,
    (up, to): (f64, f64),
    sides: u32,
) -> Option<Body> {
    let middle = at + DVec3::Z * up + (out * (to - 0.035)).extend(0.0);
    let ring = ring(middle, out, radius, sides);
    Body::sweep(finish, ring, (out * 0.035).extend(0.0)).map(Body::smooth)
}

/// Returns the corners of an upright regular polygon that faces out.
pub(super) fn ring(middle: DVec3, out: DVec2, radius: f64, sides: u32) -> Vec<DVec3> {
    let across = out.perp().extend(0.0);
    let corner = |i: u32| {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(sides);
        middle + across * (radius * libm::cos(angle)) + DVec3::Z * (radius * libm::sin(angle))
    };
    (0..sides).map(corner).collect()
}

/// Adds verge tiles over the outermost tiles and down the edge.
pub(super) fn verge(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    if context.detail < Detail::Openings {
        return;
    }
    let last = seam.points.len() - 1;
    let mut points = seam.points.clone();
    for (end, at, back) in [(0, 0, 1), (1, last, last - 1)] {
        let way = seam.points[at] - seam.points[back];
        if seam.ends[end] == End::Free && way.z < 0.0 {
            points[at] += way * (OVER / way.truncate().length().max(OVER));
        }
    }
    let whole = Line { points };
    if context.detail == Detail::Everything && whole.length() > SHORTEST {
        one_by_one(&whole, bodies);
        return;
    }
    let section = |i: usize| -> Vec<DVec3> {
        let way = seam.points[(i + 1).min(last)] - seam.points[i.max(1) - 1];
        lapped(whole.points[i], -level_left(way), 0.0)
    };
    let sections: Vec<Vec<DVec3>> = (0..=last).map(section).collect();
    let tiles = Body::loft(SurfaceId::named("ibushi"), &sections);
    bodies.extend(tiles.map(Body::smooth));
}

/// Adds the verge tiles of an edge, from each of its feet up to its apex.
fn one_by_one(edge: &Line, bodies: &mut Vec<Body>) {
    let points = &edge.points;
    let highest = |best: usize, i: usize| match points[i].z > points[best].z {
        true => i,
        false => best,
    };
    let top = (0..points.len()).fold(0, highest);
    for (half, falls) in [(&points[..=top], false), (&points[top..], true)] {
        if half.len() > 1 {
            let mut points = half.to_vec();
            if falls {
                points.reverse();
            }
            upwards(&Line { points }, falls, bodies);
        }
    }
}

/// Adds the verge tiles along a line that runs upwards, each with its foot on the head of the one below; `falls` is true if
/// the edge runs the other way.
fn upwards(line: &Line, falls: bool, bodies: &mut Vec<Body>) {
    let count = (line.length() / LENGTH).round().clamp(1.0, 400.0);
    let step = line.length() / count;
    for n in 0..count as u32 {
        let n = f64::from(n);
        // Each reaches under the next one, the last one under the ridge.
        let head = (n + 1.0 + UNDER_NEXT).min(count);
        let (foot, head) = (line.at(n * step), line.at(head * step));
        let along = if falls { foot - head } else { head - foot };
        let out = -level_left(along);
        let mut sections = [lapped(foot, out, RISE), lapped(head, out, 0.0)];
        if falls {
            sections.reverse();
        }
        let tile = Body::loft(SurfaceId::named("ibushi"), &sections);
        bodies.extend(tile.map(|tile| tile.smooth().in_row("verge tiles", out)));
    }
}

/// Returns the cut across a verge tile at a point of the edge, raised by some metres.
fn lapped(at: DVec3, out: DVec2, rise: f64) -> Vec<DVec3> {
    let (lap, down, thick) = LAP;
    let profile = [
        (-lap, -0.02),
        (0.0, -0.02),
        (0.0, -down),
        (thick, -down),
        (thick, 0.014 + rise),
        (0.0, 0.032 + rise),
        (-lap, 0.026 + rise),
    ];
    // Its side stands a little out with its head.
    let aside = |w: f64| if w > 0.0 { w + rise * 0.6 } else { w };
    profile
        .map(|(w, z)| at + (out * aside(w)).extend(z))
        .to_vec()
}
