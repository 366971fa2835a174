//! `on="plot"`: a rectangle of its own behind the front of an outline.

use super::shape::{Segment, area, contains, distance, shared};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ir::ast::town::GapAt;

/// How far a rectangle may leave its outline, metres.
pub const LEAVES: f64 = 0.5;
/// The least overlap of a rectangle of full depth with its outline.
pub const LEAST_IOU: f64 = 0.8;
/// A rectangle is shortened to no less than this, metres and share of its depth.
const SHORTEST: f64 = 3.0;
const SHORTEST_SHARE: f64 = 0.4;
/// It is narrowed to no less than this, metres and share of its frontage.
const NARROWEST: f64 = 2.7;
const NARROWEST_SHARE: f64 = 0.6;
/// The step of both, metres.
const STEP: f64 = 0.25;
/// The area that houses may share beyond what their outlines do, square metres.
const OVERLAP: f64 = 0.05;

/// A rectangle behind a front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Its front, with the house on the left of its direction.
    pub front: Segment,
    /// Its depth, metres.
    pub depth: f64,
}

impl Rectangle {
    /// Returns its corners, counter-clockwise.
    pub fn corners(&self) -> [DVec2; 4] {
        let back = -self.front.normal() * self.depth;
        let (p, q) = (self.front.from, self.front.to);
        [p, q, q + back, p + back]
    }

    /// Returns the share of its overlap with a ring in the area of both.
    pub fn iou(&self, ring: &[DVec2]) -> f64 {
        let corners = self.corners();
        let both = shared(&corners, ring);
        let own = area(&corners, &[]);
        let whole = own + area(ring, &[]) - both;
        if whole > 0.0 { both / whole } else { 0.0 }
    }

    /// Returns how far it leaves a ring, metres.
    pub fn leaves(&self, ring: &[DVec2]) -> f64 {
        let corners = self.corners();
        let mut most = 0.0f64;
        for n in 0..4 {
            let side = Segment::new(corners[n], corners[(n + 1) % 4]);
            let steps = (side.length() / STEP).ceil().max(1.0) as usize;
            for step in 0..steps {
                let at = side.from.lerp(side.to, step as f64 / steps as f64);
                if !contains(ring, at) {
                    most = most.max(distance(ring, at));
                }
            }
        }
        most
    }

    /// Returns true if it meets a neighbour more than its outline does.
    fn meets(&self, ring: &[DVec2], neighbours: &[&[DVec2]]) -> bool {
        let corners = self.corners();
        let [low, high] = around(&corners);
        neighbours.iter().any(|other| {
            let [from, to] = around(other);
            if !(low.cmplt(to).all() && from.cmplt(high).all()) {
                return false;
            }
            let own = shared(&corners, other);
            own > OVERLAP && own > shared(ring, other) + OVERLAP
        })
    }

    fn fits(&self, ring: &[DVec2], neighbours: &[&[DVec2]]) -> bool {
        self.leaves(ring) <= LEAVES && !self.meets(ring, neighbours)
    }
}

/// Returns the box around a ring.
fn around(ring: &[DVec2]) -> [DVec2; 2] {
    let none = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let grow = |[low, high]: [DVec2; 2], p: &DVec2| [low.min(*p), high.max(*p)];
    ring.iter().fold(none, grow)
}

/// Returns the extent of a ring behind the line of its front, metres.
pub fn depth_behind(ring: &[DVec2], front: Segment) -> f64 {
    let inward = -front.normal();
    ring.iter()
        .map(|p| (*p - front.from).dot(inward))
        .fold(0.0, f64::max)
}

/// Returns the part of a front that is left between gaps at its left and its right end.
pub fn narrowed(front: Segment, [left, right]: [f64; 2]) -> Segment {
    let way = front.direction();
    Segment::new(front.from + way * left, front.to - way * right)
}

/// Why no rectangle stands on an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// The front is too short, metres.
    Short(f64),
    /// It would leave the outline by so much, metres, or meet a neighbour.
    Leaves(f64),
    /// It would meet a neighbour.
    Meets,
}

/// Returns a length to a tenth of a metre.
pub fn tenths(length: f64) -> f64 {
    (length * 10.0).round() / 10.0
}

impl Refused {
    /// Returns it in words.
    pub fn reason(self) -> Text {
        match self {
            Refused::Short(width) => {
                let width = tenths(width);
                text!([width] "its front is only {width} m long", "間口が {width} m しかありません")
            }
            Refused::Leaves(off) => {
                let off = tenths(off);
                text!([off]
                    "no rectangle behind its front fits; the whole one leaves the outline by {off} m",
                    "正面の後ろに収まる矩形がありません。全体では輪郭から {off} m はみ出します"
                )
            }
            Refused::Meets => text!(
                "every rectangle behind its front meets a neighbour",
                "正面の後ろの矩形がどれも隣家に重なります"
            ),
        }
    }
}

/// Fits a rectangle: of full width and the given depth if it can be, else shortened, then narrowed.
///
/// # Errors
/// Why none fits.
pub fn fitted(
    ring: &[DVec2],
    front: Segment,
    depth: f64,
    neighbours: &[&[DVec2]],
) -> Result<Rectangle, Refused> {
    let width = front.length();
    if width < NARROWEST {
        return Err(Refused::Short(width));
    }
    let whole = Rectangle { front, depth };
    if whole.fits(ring, neighbours) {
        return Ok(whole);
    }
    let least_depth = SHORTEST.max(depth * SHORTEST_SHARE).min(depth);
    let least_width = NARROWEST.max(width * NARROWEST_SHARE);
    let mut by = 0.0;
    while width - by >= least_width - 1e-9 {
        for front in sides_narrowed(front, by) {
            if let Some(found) = shortened(ring, front, (depth, least_depth), neighbours) {
                return Ok(found);
            }
        }
        by += STEP;
    }
    Err(match whole.leaves(ring) {
        off if off > LEAVES => Refused::Leaves(off),
        _ => Refused::Meets,
    })
}

/// Returns a front narrowed at both ends, and at either of them.
fn sides_narrowed(front: Segment, by: f64) -> Vec<Segment> {
    if by == 0.0 {
        return vec![front];
    }
    let ways = [GapAt::Both, GapAt::Left, GapAt::Right];
    ways.map(|at| narrowed(front, at.divide(by))).to_vec()
}

/// Returns the deepest rectangle of a front that fits.
fn shortened(
    ring: &[DVec2],
    front: Segment,
    (depth, least): (f64, f64),
    neighbours: &[&[DVec2]],
) -> Option<Rectangle> {
    let mut rectangle = Rectangle { front, depth };
    while rectangle.depth >= least - 1e-9 {
        if rectangle.fits(ring, neighbours) {
            return Some(rectangle);
        }
        rectangle.depth -= STEP;
    }
    None
}
