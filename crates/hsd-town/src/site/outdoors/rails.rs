//! Railways along lines: ballast, whole numbers of sleepers, two rails.

use super::bands::{Way, Ways};
use super::{Laid, LotSite, STEP, edges, lines, segments, told};
use crate::plan::BORDERS;
use crate::shape::Segment;
use hsd_base::diagnostic::Text;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::Railway;

/// How far ballast reaches outside the rails on either side, metres.
pub(super) const BALLAST: f64 = 0.95;
/// Heights over the ground: of the ballast, the sleepers, the rails, metres.
const HEIGHTS: [f64; 3] = [0.06, 0.08, 0.19];
/// From sleeper to sleeper, metres.
pub(super) const SLEEPERS: f64 = 0.65;
/// The most sleepers of a feature: each takes 5 kB.
pub(super) const MOST: f64 = 60_000.0;
/// A sleeper: its length beyond the gauge, and its width, metres.
const SLEEPER: [f64; 2] = [1.0, 0.22];
/// Wider than half of any road, metres.
const WIDEST: f64 = 1000.0;
/// The width of the head of a rail, metres.
const RAIL: f64 = 0.07;

impl LotSite<'_> {
    /// Makes a piece of railway.
    pub(super) fn rail(&self, wish: &Railway, span: Span) -> Result<Laid, Text> {
        let ways = self.ways();
        if ways.is_empty() {
            return Err(text!("a railway needs a line", "線路には線が要ります"));
        }
        let half = wish.gauge / 2.0 + BALLAST;
        let own = ways.iter().flat_map(|way| segments(way)).map(|line| Way {
            line,
            half: [half; BORDERS],
            own: true,
        });
        // Roads cross over the ballast, whatever their width.
        let lines: Vec<Segment> = self.lines().collect();
        let roads = self.plan.laid.roads.beside(&lines, half);
        let roads = roads.into_iter().map(|road| Way {
            line: road.line,
            half: [road.half[0] + WIDEST, road.half[0], road.half[0]],
            own: false,
        });
        let all = Ways::new(own.chain(roads).collect());
        let ballast = self.lie(&all.band(BORDERS - 1), HEIGHTS[0]);
        let depth = if self.has_ground() { 1.0 } else { HEIGHTS[0] };
        let (mut heads, mut sleepers) = (vec![], vec![]);
        for way in &ways {
            let course = lines::Course::new(way);
            let length = course.length();
            let whole = (0.0, length);
            for side in [-0.5, 0.5] {
                heads.extend(course.strip(whole, (side * wish.gauge, RAIL), STEP));
            }
            let crossings: Vec<_> = all.others(BORDERS - 1).collect();
            for (from, to) in lines::free(way, crossings.into_iter(), 0.0) {
                let count = ((to - from) / SLEEPERS).round().max(1.0);
                for n in 0..count as usize {
                    let middle = from + (to - from) * (n as f64 + 0.5) / count;
                    let own = (middle - SLEEPER[1] / 2.0, middle + SLEEPER[1] / 2.0);
                    sleepers.extend(course.strip(own, (0.0, wish.gauge + SLEEPER[0]), STEP));
                }
            }
        }
        let heads = self.lie(&heads, HEIGHTS[2]);
        let sheets = vec![
            self.sheet(
                "gravel",
                u8::from(!self.has_ground()),
                edges(&ballast, depth),
            ),
            self.sheet("gravel", 0, ballast),
            self.sheet("cedar_dark", 2, self.lie(&sleepers, HEIGHTS[1])),
            self.sheet("steel", 1, edges(&heads, HEIGHTS[2] - HEIGHTS[0])),
            self.sheet("steel", 0, heads),
        ];
        Ok(Laid::new(
            vec![self.open(span, "rail", sheets, vec![])],
            vec![told("gauge", wish.gauge)],
        ))
    }
}
