//! Ridges and hips: courses of ridge tiles under a cap, or the ridge of another covering, and the end tiles
//! (onigawara). Sizes from domain.md 4.4.

use super::body::Body;
use super::seams::{End, Kind, Seam, Surface};
use crate::ast::RoofKind;
use crate::building::Roof;
use crate::material::SurfaceId;
use glam::DVec3;

/// How far a cap reaches down beside the ridge line beyond the slopes, metres.
const SUNK: f64 = 0.02;

/// So far a cap runs on into what covers its end, metres.
const INTO: f64 = 0.15;

/// What is shorter gets no cap, metres.
const SHORTEST: f64 = 0.05;

/// The surface of a ridge.
pub(super) fn surface(kind: RoofKind) -> SurfaceId {
    SurfaceId::named(match kind {
        RoofKind::Tiles | RoofKind::Bark => "kawara_edge",
        RoofKind::CoverTiles => "noshi",
        RoofKind::Boards | RoofKind::Shingles => "cedar",
        RoofKind::Thatch => "bark",
        RoofKind::Metal => "sheet_roof",
    })
}

/// Width of a ridge, metres.
fn width(roof: &Roof) -> f64 {
    match roof.kind {
        // Small ridges take the 5-sun cap, large ones that of 6 sun.
        RoofKind::Tiles | RoofKind::CoverTiles => match roof.dress.noshi > 4 {
            true => 0.18,
            false => 0.15,
        },
        RoofKind::Boards => 0.20,
        RoofKind::Shingles => 0.24,
        RoofKind::Bark => 0.30,
        RoofKind::Thatch => 0.60,
        RoofKind::Metal => 0.16,
    }
}

/// The cap along a ridge or hip and the tiles at its free ends.
pub(super) fn cap(surface: &Surface, seam: &Seam, roof: &Roof, bodies: &mut Vec<Body>) {
    let (Some(first), Some(last)) = (seam.points.first(), seam.points.last()) else {
        return;
    };
    if first.distance(*last) < SHORTEST {
        return;
    }
    let hip = seam.kind == Kind::Hip;
    let (width, whole) = (width(roof), roof.dress.ridge_height(roof.kind));
    // The ridges of hips are two courses lower.
    let height = match hip {
        true => (whole - 0.07).max(whole * 0.6),
        false => whole,
    };
    let leans = seam.spans.iter().zip(seam.points.windows(2));
    let lean = leans
        .flat_map(|(span, w)| surface.leans(span, w[1] - w[0]))
        .fold(0.0, f64::max);
    let size = Size {
        half: width / 2.0,
        foot: SUNK + lean * width / 2.0,
        height,
    };
    let line = run_on(seam);
    let sections: Vec<Vec<DVec3>> = (0..line.len()).map(|i| size.section(&line, i)).collect();
    bodies.extend(Body::loft(self::surface(roof.kind), &sections));
    let tiled = matches!(roof.kind, RoofKind::Tiles | RoofKind::CoverTiles);
    if !tiled || !roof.dress.ends {
        return;
    }
    let n = line.len();
    for (end, at, back) in [(0, line[0], line[1]), (1, line[n - 1], line[n - 2])] {
        // The main ridge of a hipped roof ends in the open as well, over its hips.
        if seam.ends[end] == End::Free || (seam.ends[end] == End::Met && !hip) {
            bodies.extend(end_tile(at, at - back, &size, lean, roof));
        }
    }
}

/// Half width, depth below and height above the line, metres.
struct Size {
    half: f64,
    foot: f64,
    height: f64,
}

impl Size {
    /// The upright section at corner `i` of a line.
    fn section(&self, line: &[DVec3], i: usize) -> Vec<DVec3> {
        let (before, after) = (line[i.max(1) - 1], line[(i + 1).min(line.len() - 1)]);
        let across = (after - before)
            .truncate()
            .perp()
            .normalize_or_zero()
            .extend(0.0);
        let shoulder = self.height - (0.08_f64).min(self.height / 2.0);
        let profile = [
            (-1.0, -self.foot),
            (1.0, -self.foot),
            (1.0, shoulder),
            (0.5, self.height),
            (-0.5, self.height),
            (-1.0, shoulder),
        ];
        let corner = |(w, z): (f64, f64)| line[i] + across * (w * self.half) + DVec3::Z * z;
        profile.map(corner).to_vec()
    }
}

/// The line of a seam, run on a little into what covers its ends.
fn run_on(seam: &Seam) -> Vec<DVec3> {
    let mut line = seam.points.clone();
    let n = line.len();
    for (end, at, back) in [(0, 0, 1), (1, n - 1, n - 2)] {
        let out = (line[at] - line[back]).normalize_or_zero();
        line[at] += match (seam.ends[end], seam.kind) {
            (End::Joint, _) => out * INTO,
            (End::Met, Kind::Ridge) => out * 0.05,
            _ => DVec3::ZERO,
        };
    }
    line
}

/// The onigawara: a block with a rounded head, a little higher and wider than the ridge.
fn end_tile(at: DVec3, out: DVec3, size: &Size, lean: f64, roof: &Roof) -> Option<Body> {
    let out = out.truncate().normalize_or_zero().extend(0.0);
    let (half, top) = (size.half + 0.05, size.height + 0.08);
    let foot = SUNK + lean * half;
    let across = out.truncate().perp().extend(0.0);
    let profile = [
        (-half, -foot),
        (half, -foot),
        (half, top - half * 0.6),
        (half * 0.5, top),
        (-half * 0.5, top),
        (-half, top - half * 0.6),
    ];
    let back = at - out * 0.06;
    let section = profile.map(|(w, z)| back + across * w + DVec3::Z * z);
    Body::sweep(surface(roof.kind), section.to_vec(), out * 0.10)
}
