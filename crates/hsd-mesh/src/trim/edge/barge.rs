//! Barge boards (hafu): boards under the edge of a verge that follow its curve, deeper at the apex and at the foot
//! (docs/evidence.md 4.4: 0.18-0.24 m deep on houses, 0.03 m thick), and the pendant (gegyo) where they meet.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::edge::gegyo;
use crate::trim::seams::{End, Seam};
use glam::{DVec2, DVec3};
use hsd_ir::ast::RoofKind;
use hsd_scene::Detail;

/// Height of the board at mid-length, measured vertically, on small roofs and on large ones, metres.
const DEEP: (f64, f64) = (0.18, 0.45);
/// The most of its length that its height is: less than the usual on the smallest roofs.
const DEEPEST: f64 = 0.06;
/// Additional depth at apex and foot, as a share of the height.
const SWELL: f64 = 0.25;
/// Height of plain boards, metres: that of the tiles' edge over them.
const PLAIN: f64 = 0.12;
/// Thickness, metres.
const THICK: f64 = 0.03;
/// Setback from the verge, and from the eaves, metres.
const BACK: f64 = 0.02;
/// How far it extends into the roof above it, metres.
const SUNK: f64 = 0.01;
/// The smallest verge with room for a board, metres.
const LEAST_VERGE: f64 = 0.1;
/// Verges shorter than this in plan have no boards, metres.
const SHORTEST: f64 = 0.5;

/// One verge from end to end.
struct Verge<'a> {
    seam: &'a Seam,
    /// Directions in plan: along it, and out of the roof.
    along: DVec2,
    out: DVec2,
    /// Height of the boards at mid-length, metres.
    deep: f64,
    /// Additional height at apex and foot, as a share.
    swell: f64,
}

/// Adds the boards along a verge.
pub(in crate::trim) fn boards(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let plan = |i: usize| seam.points[i].truncate();
    let last = seam.points.len() - 1;
    let run = plan(last) - plan(0);
    let trim = &context.roof.trim;
    if trim.verge < LEAST_VERGE || run.length() < SHORTEST {
        return;
    }
    let along = run.normalize_or_zero();
    // Those of houses are plain boards below the edge of the tiles.
    let tiled = matches!(context.roof.kind, RoofKind::Tiles | RoofKind::CoverTiles);
    let plain = tiled && !trim.pendant && trim.rafters < 2;
    let verge = Verge {
        seam,
        along,
        out: -along.perp(),
        deep: match plain {
            true => PLAIN.min(run.length() * DEEPEST),
            false => (run.length() * 0.032)
                .clamp(DEEP.0, DEEP.1)
                .min(run.length() * DEEPEST),
        },
        swell: if plain { 0.0 } else { SWELL },
    };
    let stations = verge.stations(context.detail >= Detail::Openings);
    let sections: Vec<Vec<DVec3>> = stations
        .iter()
        .zip(verge.rises(&stations))
        .map(|(s, rise)| verge.section(s, rise))
        .collect();
    let board = Body::loft(context.timber(), &sections);
    bodies.extend(board.map(Body::smooth));
    let apex = stations
        .iter()
        .filter(|s| s.apex)
        .max_by(|a, b| a.at.z.total_cmp(&b.at.z));
    if let Some(apex) = apex.filter(|_| trim.pendant) {
        // Before the boards, its head as high as theirs.
        let foot = apex.at - DVec3::Z * verge.depth(apex.share) * 0.35;
        let size = (1.3 * verge.deep, run.length() / 2.0);
        gegyo::pendant(context, (foot, verge.out), size, bodies);
    }
}

/// A point on the upper edge of the boards.
struct Station {
    at: DVec3,
    /// From 0 at the foot to 1 at the apex.
    share: f64,
    /// True if the verge is highest there and falls on both sides.
    apex: bool,
}

impl Verge<'_> {
    /// Returns corners of the boards along the verge, denser where their depth varies.
    fn stations(&self, fine: bool) -> Vec<Station> {
        let points = &self.seam.points;
        let last = points.len() - 1;
        let top = (0..=last).fold(0, |best, i| {
            if points[i].z > points[best].z {
                i
            } else {
                best
            }
        });
        let run = |i: usize| points[i].truncate().dot(self.along);
        let share = |at: f64, i: usize| {
            // Up to the apex from the side on which the place lies.
            let foot = if i < top { run(0) } else { run(last) };
            ((at - foot) / (run(top) - foot)).clamp(0.0, 1.0)
        };
        let mut stations = Vec::new();
        for i in 0..=last {
            let at = self.upper(i);
            let own = if i == top { 1.0 } else { share(run(i), i) };
            stations.push(Station {
                at,
                share: own,
                apex: i == top && i > 0 && i < last,
            });
            if i == last || !fine {
                continue;
            }
            // Straight verges get corners between, bent ones have them.
            let pieces = if last <= 2 { 2 } else { 1 };
            let next = self.upper(i + 1);
            for k in 1..pieces {
                let between = at.lerp(next, f64::from(k) / f64::from(pieces));
                let side = if i < top { i } else { i + 1 };
                stations.push(Station {
                    at: between,
                    share: share(between.truncate().dot(self.along), side),
                    apex: false,
                });
            }
        }
        stations
    }

    /// Returns the upper edge of the boards at a corner of the verge.
    fn upper(&self, i: usize) -> DVec3 {
        let deep = match i {
            0 => self.seam.spans[0].deep[0],
            _ => self.seam.spans[i - 1].deep[1],
        };
        let at = self.seam.points[i] - DVec3::Z * (deep - SUNK);
        at + self.drawn_in(i) - (self.out * BACK).extend(0.0)
    }

    /// Returns how far an end of the board is shortened along the slope, so that it does not project beyond the eaves.
    fn drawn_in(&self, i: usize) -> DVec3 {
        let points = &self.seam.points;
        let last = points.len() - 1;
        let (end, beside) = match i {
            0 => (self.seam.ends[0], 1),
            i if i == last => (self.seam.ends[1], last - 1),
            _ => return DVec3::ZERO,
        };
        let way = points[beside] - points[i];
        let run = way.truncate().dot(self.along).abs();
        match end == End::Free && run > BACK {
            true => way * (BACK / run),
            false => DVec3::ZERO,
        }
    }

    /// Returns the depth of the boards at a share of the way up.
    fn depth(&self, share: f64) -> f64 {
        let swell = (2.0 * share - 1.0) * (2.0 * share - 1.0);
        self.deep * (1.0 + self.swell * swell)
    }

    /// Returns the cut through the boards at a station: upright, at a free end square to the slope, so that it ends in no tip.
    fn section(&self, station: &Station, rise: Option<DVec3>) -> Vec<DVec3> {
        let by = (self.out * -THICK).extend(0.0);
        let (top, down) = (station.at, -DVec3::Z * self.depth(station.share));
        // From the upper edge to the lower one the short way.
        let low = top + rise.map_or(down, |up| down - up * down.dot(up));
        vec![top, low, low + by, top + by]
    }

    /// Returns the direction up the slope at the ends that are free, for the stations in their order.
    fn rises(&self, stations: &[Station]) -> Vec<Option<DVec3>> {
        let last = stations.len() - 1;
        let up = |i: usize, beside: usize, end: End| {
            let way = (stations[beside].at - stations[i].at).normalize_or_zero();
            (end == End::Free && way.z > 0.0).then_some(way)
        };
        let mut rises = vec![None; stations.len()];
        rises[0] = up(0, 1, self.seam.ends[0]);
        rises[last] = up(last, last - 1, self.seam.ends[1]);
        rises
    }
}
