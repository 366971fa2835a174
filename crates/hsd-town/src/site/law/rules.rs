//! The rules for a lot, each with the plane that it makes.

use super::fronts::Front;
use crate::shape::{Segment, sides};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::envelope::{Half, Limit};
use hsd_base::text;
use hsd_ir::ast::law::{DistrictPlan, Terms};

/// A lot, as rules see it.
#[derive(Clone, Copy, Debug)]
pub struct Plot<'p> {
    /// Its outline.
    pub ring: &'p [DVec2],
    /// The roads in front of it.
    pub fronts: &'p [Front],
    /// The greatest ratio of floor area.
    pub ratio: Option<f64>,
}

/// A rule with the values that it has here; lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// A greatest height.
    Height(f64),
    /// The height at which a house of the greatest ground area has used up its floor area.
    Ratio {
        /// The height.
        height: f64,
        /// The ratio of floor area.
        ratio: f64,
        /// The ratio of ground area.
        coverage: f64,
        /// The height of a storey.
        storey: f64,
    },
    /// The slant line of a road (art. 56 (1) 1).
    Road {
        /// Its number among the roads in front, from 1.
        number: usize,
        /// Its width.
        width: f64,
        /// The rise per metre from its far side.
        gradient: f64,
        /// How far from there it counts.
        distance: f64,
        /// How much farther away the far side counts.
        setback: f64,
    },
    /// The slant line of adjacent land (art. 56 (1) 2).
    Side {
        /// The number of the side of the lot, from 1.
        number: usize,
        /// The height over it.
        height: f64,
        /// The rise per metre.
        gradient: f64,
    },
}

impl Rule {
    /// Returns the word for it.
    pub fn word(&self) -> &'static str {
        match self {
            Rule::Height(_) => "height",
            Rule::Ratio { .. } => "ratio",
            Rule::Road { .. } => "road",
            Rule::Side { .. } => "side",
        }
    }

    /// Returns its name among the rules of a lot.
    pub fn name(&self) -> String {
        match self {
            Rule::Road { number, .. } | Rule::Side { number, .. } => {
                format!("{} {number}", self.word())
            }
            Rule::Height(_) | Rule::Ratio { .. } => self.word().to_owned(),
        }
    }

    /// Returns its arithmetic: the height in metres over a place, where `d` is the distance from the far side of the road or from
    /// the neighbour.
    pub fn arithmetic(&self) -> String {
        let short = |x: f64| ((x * 1000.0).round() / 1000.0 + 0.0).to_string();
        match *self {
            Rule::Height(height) => short(height),
            #[rustfmt::skip]
            Rule::Ratio { height, ratio, coverage, storey } => format!(
                "{} / {} x {} = {}", short(ratio), short(coverage), short(storey), short(height)
            ),
            #[rustfmt::skip]
            Rule::Road { width, gradient, distance, setback, .. } => {
                let back = match setback > 0.0 {
                    true => format!(" + {}", short(setback)),
                    false => String::new(),
                };
                format!(
                    "{} x d; d = {}{back} + x <= {}",
                    short(gradient), short(width), short(distance)
                )
            }
            #[rustfmt::skip]
            Rule::Side { height, gradient, .. } => format!("{} + {} x d", short(height), short(gradient)),
        }
    }

    /// Returns the article that it comes from.
    pub fn source(&self) -> Text {
        match self {
            Rule::Height(_) => text!("height limit", "高さの限度"),
            Rule::Ratio { .. } => text!("art. 52", "法52条"),
            Rule::Road { .. } => text!("art. 56 (1) 1", "法56条1項1号"),
            Rule::Side { .. } => text!("art. 56 (1) 2", "法56条1項2号"),
        }
    }
}

/// Returns the rules for a lot; the first counts everywhere.
pub fn rules(plot: &Plot<'_>, terms: &Terms) -> Vec<(Rule, Limit)> {
    let mut found = vec![(Rule::Height(terms.limit), Limit::level(terms.limit))];
    if let (true, Some(ratio)) = (terms.by_ratio, plot.ratio) {
        let (coverage, storey) = (terms.coverage, terms.storey);
        let height = ratio / coverage * storey;
        #[rustfmt::skip]
        found.push((Rule::Ratio { height, ratio, coverage, storey }, Limit::level(height)));
    }
    if terms.plan == DistrictPlan::Guided {
        return found;
    }
    let roads = plot.fronts.iter().zip(1..);
    found.extend(roads.map(|(front, number)| road(plot, front, number, terms)));
    let all: Vec<Segment> = sides(plot.ring).collect();
    for (number, side) in all.iter().enumerate() {
        let is_road = plot
            .fronts
            .iter()
            .any(|front| front.sides.contains(&number));
        if is_road || side.length() == 0.0 {
            continue;
        }
        let rule = Rule::Side {
            number: number + 1,
            height: terms.side_height,
            gradient: terms.side_gradient,
        };
        let limit = Limit {
            from: behind(*side),
            base: terms.side_height,
            gradient: terms.side_gradient,
            within: region(&all, number),
        };
        found.push((rule, limit));
    }
    found
}

/// Returns what lies behind a side.
fn behind(side: Segment) -> Half {
    Half {
        at: side.from,
        inward: -side.normal(),
    }
}

/// Returns the slant line of a road: from its far side, over what lies behind the front, as far as it counts.
fn road(plot: &Plot<'_>, front: &Front, number: usize, terms: &Terms) -> (Rule, Limit) {
    let mut near = behind(front.chord);
    // A front that is bent lies before its chord in parts.
    let corners = front.sides.iter().flat_map(|n| {
        let next = (n + 1) % plot.ring.len();
        [plot.ring[*n], plot.ring[next]]
    });
    let before = corners.map(|p| near.depth(p)).fold(0.0, f64::min);
    near.at += near.inward * before;
    let mut far = front.far;
    far.at -= far.inward * terms.setback;
    let end = Half {
        at: far.at + far.inward * terms.distance,
        inward: -far.inward,
    };
    let rule = Rule::Road {
        number,
        width: front.width,
        gradient: terms.gradient,
        distance: terms.distance,
        setback: terms.setback,
    };
    let limit = Limit {
        from: far,
        base: 0.0,
        gradient: terms.gradient,
        within: vec![near, end],
    };
    (rule, limit)
}

/// Returns the part of a lot that a side of it governs: what lies behind it, within the wedge of each corner that it makes; at a
/// corner that turns inwards, up to the line that halves the corner. So the slant line of a side keeps to its own wing of a
/// concave lot, and where two meet they are equally high.
fn region(all: &[Segment], number: usize) -> Vec<Half> {
    let n = all.len();
    let (before, own, after) = (
        all[(number + n - 1) % n],
        all[number],
        all[(number + 1) % n],
    );
    let mut within = vec![behind(own)];
    for (other, corner, along) in [
        (before, own.from, own.direction()),
        (after, own.to, -own.direction()),
    ] {
        let turns_in = match corner == own.from {
            true => other.direction().perp_dot(own.direction()) < 0.0,
            false => own.direction().perp_dot(other.direction()) < 0.0,
        };
        within.push(match turns_in {
            false => behind(other),
            true => {
                // Both normals point into the lot; the line between them parts what is nearer to either side.
                let between = (-own.normal() - other.normal()).normalize_or_zero();
                let across = between.perp();
                Half {
                    at: corner,
                    inward: across * across.dot(along).signum(),
                }
            }
        });
    }
    within
}

/// Returns the strips along roads that houses keep clear, as half-planes that enclose them.
pub(super) fn strips(plot: &Plot<'_>, setback: f64) -> Vec<Vec<Half>> {
    /// At a blunt corner the strip goes on beyond the side, by this share of its depth.
    const BEYOND: f64 = 2.0;
    let all: Vec<Segment> = sides(plot.ring).collect();
    let fronts = plot.fronts.iter().flat_map(|front| &front.sides);
    let strip = |number: &usize| {
        let side = all[*number];
        let (near, way) = (behind(side), side.direction());
        let half = |at: DVec2, inward: DVec2| Half { at, inward };
        vec![
            near,
            half(side.from + near.inward * setback, -near.inward),
            half(side.from - way * setback * BEYOND, way),
            half(side.to + way * setback * BEYOND, -way),
        ]
    };
    fronts.map(strip).collect()
}
