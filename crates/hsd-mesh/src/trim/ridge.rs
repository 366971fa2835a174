//! Tiled ridges and hips: a bed, courses of flat tiles (noshi) that step in as they rise, round caps (kanmuri) and end
//! tiles. Sizes from docs/evidence.md 4.4.

pub(in crate::trim) mod chigo_mune;
pub(in crate::trim) mod onigawara;
pub(in crate::trim) mod finial;
pub(in crate::trim) mod stack;
pub(in crate::trim) mod crown;
pub(in crate::trim) mod descending;

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::Line;
use crate::trim::ridge::onigawara::Place;
use crate::trim::seams::{End, Kind, Seam};
use glam::{DVec2, DVec3};
use hsd_ir::ast::RoofKind;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// How far a ridge extends below the slopes beside its line, metres.
const SUNK: f64 = 0.02;
/// Height of a course, and of its joint, metres.
const COURSE: f64 = 0.035;
const JOINT: f64 = 0.010;
/// Height of the bed (dai), metres.
const BED: f64 = 0.015;
/// Height of the cap, metres.
const CAP: f64 = 0.08;
/// Additional width of each course over the one above, on both sides, metres.
const STEP: f64 = 0.007;
/// Length of a cap tile, metres.
const UNIT: f64 = 0.32;
/// Lines shorter than this have no ridge, metres.
const SHORTEST: f64 = 0.05;

/// Returns half the width of its cap, metres: 5 or 6 sun, wider on roofs of cover tiles.
pub(super) fn half_width(kind: RoofKind, noshi: u32) -> f64 {
    let half = if noshi > 4 { 0.09 } else { 0.075 };
    match kind {
        RoofKind::CoverTiles => half * 1.3,
        _ => half,
    }
}

/// Width of the ridges of hips as a share of that of the main ridge.
const HIP_WIDTH: f64 = 0.9;

/// Returns the courses of the ridges of hips: two fewer than the main ridge has.
fn hip_courses(noshi: u32) -> u32 {
    noshi.saturating_sub(2).max(1)
}

/// Adds a tiled ridge or hip with the end tiles at its free ends.
pub(super) fn tiles(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let Some(line) = run_on(context.roof.kind, seam) else {
        return;
    };
    let trim = &context.roof.trim;
    let (courses, width) = match seam.kind {
        Kind::Hip => (hip_courses(trim.noshi), HIP_WIDTH),
        _ => (trim.noshi, 1.0),
    };
    let lean = context.lean(seam);
    let Some((lower, upper)) = chigo_mune::parted(context, seam, &line, courses) else {
        let size = laid(context, &line, courses, width, lean, bodies);
        if trim.ends {
            ends(context, seam, &line, size, bodies);
        }
        return;
    };
    let size = laid(context, &upper, courses, width, lean, bodies);
    let out = upper.points[0] - upper.points[1];
    close(context, (upper.points[0], out), lean, size, bodies);
    let (courses, width) = chigo_mune::lower(courses, width);
    let size = laid(context, &lower, courses, width, lean, bodies);
    ends(context, seam, &lower, size, bodies);
}

/// Adds the courses and the cap along a line, `width` times as wide as a main ridge, between slopes that fall by `lean`
/// metres a metre across it; returns half the width and the height of its end.
fn laid(
    context: &TrimContext<'_>,
    line: &Line,
    courses: u32,
    width: f64,
    lean: f64,
    bodies: &mut Vec<Body>,
) -> (f64, f64) {
    let (kind, trim) = (context.roof.kind, &context.roof.trim);
    let half = half_width(kind, trim.noshi) * width;
    let top = BED + COURSE * f64::from(courses);
    let finish = SurfaceId::named("ibushi");
    match context.detail {
        Detail::Body | Detail::Flat => {
            let foot = SUNK + lean * half;
            let profile = plain(half, foot, top + CAP);
            let finish = SurfaceId::named(match kind {
                RoofKind::CoverTiles => "noshi",
                _ => "kawara_edge",
            });
            bodies.extend(Body::loft(finish, &line.sections(&profile)));
        }
        Detail::Openings => {
            let foot = SUNK + lean * (half + STEP);
            let wall = [
                (-half - STEP, -foot),
                (half + STEP, -foot),
                (half, top),
                (-half, top),
            ];
            let courses = SurfaceId::named("noshi");
            bodies.extend(Body::loft(courses, &line.sections(&wall)));
            // Its ends stand out, so that they lie in no plane of the courses' ends.
            let cap = line.longer(0.012).sections(&arch(half + 0.006, CAP, top));
            bodies.extend(Body::loft(finish, &cap).map(Body::smooth));
        }
        Detail::Everything => {
            let wall = line.sections(&stepped(half, lean, courses));
            bodies.extend(Body::loft(finish, &wall));
            caps(line, half, top, finish, bodies);
        }
    }
    (half + STEP * f64::from(courses) / 2.0, top + CAP)
}

/// Adds the tiles that close the free ends of a ridge of this half width and height.
fn ends(
    context: &TrimContext<'_>,
    seam: &Seam,
    line: &Line,
    size: (f64, f64),
    bodies: &mut Vec<Body>,
) {
    let (n, hip) = (line.points.len(), seam.kind == Kind::Hip);
    let ends = [
        (0, line.points[0], line.points[1]),
        (1, line.points[n - 1], line.points[n - 2]),
    ];
    for (end, at, back) in ends {
        let closed = match seam.ends[end] {
            // Hips run upwards, and lean on something above.
            End::Free => !hip || end == 0,
            // The main ridge of a hipped roof ends over its hips.
            End::Met => !hip,
            End::Joint => false,
        };
        if closed {
            close(context, (at, at - back), context.lean(seam), size, bodies);
        }
    }
}

/// Adds the tile that closes an end of a ridge: where it stands, and the direction it faces.
fn close(
    context: &TrimContext<'_>,
    (at, out): (DVec3, DVec3),
    lean: f64,
    (half, height): (f64, f64),
    bodies: &mut Vec<Body>,
) {
    let finish = SurfaceId::named("ibushi");
    let place = Place {
        at,
        out,
        half,
        height,
        lean,
    };
    let bar = context.roof.kind == RoofKind::CoverTiles;
    match context.detail {
        Detail::Body | Detail::Flat => onigawara::block(finish, &place, bodies),
        _ => onigawara::tile(finish, &place, bar, bodies),
    }
}

/// Returns the line of a seam, extended slightly into the surfaces at its ends; `None` if it is too short.
pub(super) fn run_on(kind: RoofKind, seam: &Seam) -> Option<Line> {
    let mut line = Line {
        points: seam.points.clone(),
    };
    if line.length() < SHORTEST {
        return None;
    }
    let n = line.points.len();
    for (end, at, back) in [(0, 0, 1), (1, n - 1, n - 2)] {
        let out = (line.points[at] - line.points[back]).normalize_or_zero();
        line.points[at] += match (seam.ends[end], seam.kind) {
            (End::Joint, _) => out * seam.runs[end],
            (End::Met, Kind::Ridge) => out * 0.05,
            (End::Free, Kind::Ridge) => out * beyond(kind),
            // The hips of an irimoya run in over the slope at the foot of its gable's verge.
            (End::Free, Kind::Hip) if end == 1 => out * 0.10,
            _ => DVec3::ZERO,
        };
    }
    Some(line)
}

/// Returns how far a ridge projects beyond the verge, metres: farther than all other trim, so that no faces are
/// coplanar.
fn beyond(kind: RoofKind) -> f64 {
    match kind {
        // Verge tiles.
        RoofKind::Tiles | RoofKind::CoverTiles => 0.03,
        // The topmost layer of a thick edge.
        RoofKind::Bark => 0.06,
        RoofKind::Shingles | RoofKind::Boards | RoofKind::Metal | RoofKind::Thatch => 0.03,
    }
}

/// Returns the profile of a plain block with chamfered upper edges.
pub(super) fn plain(half: f64, foot: f64, height: f64) -> [(f64, f64); 6] {
    let shoulder = height - CAP.min(height / 2.0);
    [
        (-half, -foot),
        (half, -foot),
        (half, shoulder),
        (half * 0.5, height),
        (-half * 0.5, height),
        (-half, shoulder),
    ]
}

/// Returns the profile of a half round over a base.
pub(super) fn arch(half: f64, height: f64, base: f64) -> Vec<(f64, f64)> {
    const STEPS: u32 = 3;
    let arc = (0..=STEPS).map(|i| {
        let angle = std::f64::consts::PI * f64::from(i) / f64::from(STEPS);
        // Its foot lies in what it covers.
        (
            half * libm::cos(angle),
            base - 0.006 + (height + 0.006) * libm::sin(angle),
        )
    });
    arc.collect()
}

/// Returns the profile of the bed and the courses on it, each tile projecting beyond its joint.
fn stepped(half: f64, lean: f64, courses: u32) -> Vec<(f64, f64)> {
    let width = |i: u32| half + STEP * f64::from(courses.saturating_sub(i + 1));
    let back = 0.012;
    let base = width(0) - back;
    let mut right = vec![(base, -SUNK - lean * base)];
    for i in 0..courses {
        let foot = BED + COURSE * f64::from(i);
        let own = width(i);
        right.extend([
            (own - back, foot + JOINT),
            (own, foot + JOINT),
            (own, foot + COURSE),
        ]);
        if i + 1 < courses {
            right.push((width(i + 1) - back, foot + COURSE));
        }
    }
    if courses == 0 {
        right.push((base, BED));
    }
    let left: Vec<(f64, f64)> = right.iter().rev().map(|(w, z)| (-w, *z)).collect();
    right.extend(left);
    right
}

/// Adds cap tiles one after the other, each slightly wider where it laps over the next.
fn caps(line: &Line, half: f64, top: f64, finish: SurfaceId, bodies: &mut Vec<Body>) {
    let length = line.length();
    let count = (length / UNIT).round().clamp(1.0, 2000.0);
    let unit = length / count;
    for i in 0..count as u32 {
        let from = f64::from(i) * unit;
        let part = Line {
            points: vec![line.at(from), line.at(from + unit)],
        };
        let (wide, narrow) = (
            arch(half + 0.012, CAP, top),
            arch(half + 0.002, CAP - 0.010, top),
        );
        let section = |i: usize, profile: &[(f64, f64)]| part.sections(profile).swap_remove(i);
        let sections = [section(0, &wide), section(1, &narrow)];
        let right = (part.points[1] - part.points[0]).truncate();
        let cap = Body::loft(finish, &sections).map(Body::smooth);
        bodies.extend(cap.map(|body| body.in_row("cap tiles", right.normalize_or(DVec2::X))));
    }
}
