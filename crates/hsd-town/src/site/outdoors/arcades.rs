//! Arcades: a roof over a pavement along a line, on posts at the street. Bays are whole, corners closed (000-74...-76).

use super::solids::{Faces, beam, case};
use super::{Laid, LotSite, told};
use crate::shape::Segment;
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Text;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::street::Arcade;

/// The rise of the roof from the street to the houses, as a share of its depth.
const RISE: f64 = 0.12;
/// The thickness of the roof, the width of a post, the height of the beam at the eaves, metres.
const ROOF: f64 = 0.08;
const POST: f64 = 0.14;
const BEAM: f64 = 0.22;
/// How far posts stand behind the line, metres.
const BACK: f64 = 0.2;
/// A mitre reaches at most so many times the depth.
const MITRE: f64 = 3.0;

impl LotSite<'_> {
    /// Puts a roof along the lines of the feature.
    pub(super) fn arcade(&self, wish: &Arcade, span: Span) -> Result<Laid, Text> {
        let ways = self.ways();
        if ways.is_empty() {
            return Err(text!(
                "an arcade needs a line, whose left side is the street",
                "アーケードには線が要ります。線の左が通りになります"
            ));
        }
        let [mut roof, mut frame]: [Faces; 2] = Default::default();
        let mut bays = 0.0;
        for way in &ways {
            let back = offset(way, wish.depth);
            let posts = offset(way, BACK);
            let base = self.base();
            let low = |p: DVec2| (p - base).extend(self.height(p) + wish.height);
            // Both edges follow the ground at the street.
            let high = |n: usize| {
                let z = low(way[n]).z + wish.depth * RISE;
                (back[n] - base).extend(z)
            };
            for n in 0..way.len() - 1 {
                let (p, q) = (low(way[n]), low(way[n + 1]));
                let ends = [n == 0, n + 2 == way.len()];
                roof.extend(slab([p, q, high(n + 1), high(n)], ends));
                let under = DVec3::Z * (-ROOF - BEAM / 2.0);
                let [a, b] = [n, n + 1].map(|n| {
                    let at = (posts[n] - base).extend(low(way[n]).z + BACK * RISE);
                    at + under
                });
                frame.extend(beam(a, b, [POST, BEAM]));
                let side = Segment::new(posts[n], posts[n + 1]);
                let count = (side.length() / wish.bay).round().max(1.0);
                bays += count;
                // The post at a corner belongs to the stretch before it.
                for k in usize::from(n > 0)..=count as usize {
                    let at = side.from.lerp(side.to, k as f64 / count);
                    let top = a.z + (b.z - a.z) * k as f64 / count - BEAM / 2.0;
                    let foot = self.height(at);
                    let half = [POST / 2.0; 2];
                    frame.extend(case(at - base, side.direction(), half, [foot, top]));
                }
            }
        }
        let sheets = vec![
            self.sheet("seam_roof", 0, roof),
            self.sheet("sheet", 1, frame),
        ];
        Ok(Laid::new(
            vec![self.open(span, "arcade", sheets, vec![])],
            vec![told("bays", bays), told("depth", wish.depth)],
        ))
    }
}

/// Returns a line moved to its right, with mitred corners.
fn offset(line: &[DVec2], by: f64) -> Vec<DVec2> {
    let side = |n: usize| Segment::new(line[n], line[n + 1]).normal();
    let last = line.len() - 1;
    let place = |n: usize| {
        let (before, after) = (
            side(n.saturating_sub(1).min(last - 1)),
            side(n.min(last - 1)),
        );
        let middle = (before + after).normalize_or(after);
        let reach = (by / middle.dot(after).max(1.0 / MITRE)).min(by * MITRE);
        line[n] + middle * reach
    };
    (0..=last).map(place).collect()
}

/// Returns a roof over the corners of its upper side, with the ends that are free. The first two corners are the eaves.
fn slab(top: [DVec3; 4], [first, last]: [bool; 2]) -> Faces {
    let down = DVec3::Z * ROOF;
    let [a, b, c, d] = top;
    // To the right of the line lies the inside: seen from above the corners run clockwise.
    let mut faces: Faces = vec![];
    for [p, q, r] in [[a, c, b], [a, d, c]] {
        faces.push(vec![p, q, r]);
        faces.push(vec![p - down, r - down, q - down]);
    }
    faces.push(vec![b - down, a - down, a, b]);
    faces.push(vec![d - down, c - down, c, d]);
    if first {
        faces.push(vec![a - down, d - down, d, a]);
    }
    if last {
        faces.push(vec![c - down, b - down, b, c]);
    }
    faces
}
