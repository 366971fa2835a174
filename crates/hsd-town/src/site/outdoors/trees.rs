//! Trees: at a point, along a line, over an area. Species, height, width and turn are drawn by the place of each (000-69).

use super::{Laid, LotSite, Walls, lines, told};
use crate::layer::Shape;
use crate::shape::Borders;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::grid::bounds;
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::town::PlaceOn;
use hsd_ir::ast::{House, Species, Tree, TreeWish, Value};
use std::f64::consts::TAU;

/// How far the middle of a trunk stands from walls at least, metres.
const CLEAR: f64 = 0.5;
/// How far from the walls of the house of its own feature, whose eaves reach over them, metres.
const FROM_EAVES: f64 = 2.0;
/// How far it stands from the outline of its area, where a fence may be, and from a gate, metres.
const FROM_EDGE: f64 = 1.0;
const FROM_GATE: f64 = 4.0;
/// The most trees of a feature.
const MOST: f64 = 20_000.0;
/// The number of trees that are one object of the model.
const TOGETHER: usize = 500;
/// How much trees of one feature differ from the height and width that its rule gives them, as a share.
const UNLIKE: f64 = 0.15;

impl LotSite<'_> {
    /// Plants trees.
    pub(super) fn trees(&self, wish: &TreeWish, span: Span, draws: Place) -> Result<Laid, Text> {
        let spots = self.spots(wish, draws)?;
        let alone = matches!(self.lot().shape, Shape::Point(_));
        let walls = self.walls();
        let built = self.built.borrow();
        let own = Walls::new(built.iter().map(Vec::as_slice));
        let free = |at: &DVec2| !walls.near(*at, CLEAR) && !own.near(*at, FROM_EAVES);
        let base = self.base();
        let grown = spots.iter().filter(|(at, _)| free(at)).map(|(at, draws)| {
            let place = (*at - base).extend(self.height(*at));
            tree(wish, alone, *draws, place)
        });
        let grown: Vec<Tree> = grown.collect();
        let Some(first) = grown.first() else {
            return Err(text!(
                "a tree would stand in the walls of a house",
                "木が建物の壁に入ります"
            ));
        };
        let mut parameters = match grown.len() {
            1 => vec![
                (
                    "species".to_owned(),
                    Value::Text(first.species.word().to_owned()),
                ),
                told("height", first.height),
                told("width", first.width),
            ],
            count => vec![told("trees", count as f64)],
        };
        if spots.len() > grown.len() {
            parameters.push(told("in_walls", (spots.len() - grown.len()) as f64));
        }
        let together = |trees: &[Tree]| self.open(span, "tree", vec![], trees.to_vec());
        let houses: Vec<House> = grown.chunks(TOGETHER).map(together).collect();
        Ok(Laid::new(houses, parameters))
    }

    /// Returns the places of trees with what keys the draws of each.
    fn spots(&self, wish: &TreeWish, draws: Place) -> Result<Vec<(DVec2, Place)>, Text> {
        let spacing = wish.spacing;
        let too_many = |count: f64| {
            let (count, most) = (count.round(), MOST);
            Err(text!([count, most]
                "{count} trees would stand here, of which there may be {most}: give a wider `spacing`",
                "{count} 本の木が立ちます。上限は {most} 本です。`spacing` を広げてください"
            ))
        };
        Ok(match &self.lot().shape {
            Shape::Point(at) => vec![(*at, draws)],
            Shape::Lines(_) => {
                let ways = self.ways();
                let total: f64 = ways.iter().map(|way| lines::length(way)).sum();
                if total / spacing > MOST {
                    return too_many(total / spacing);
                }
                self.along(&ways, wish, draws)
            }
            Shape::Area(ring, holes) => {
                let [low, high] = bounds(ring.iter().copied()).unwrap_or_default();
                let [from, to] = [low, high].map(|p| (p / spacing).floor());
                let cells = to - from + 1.0;
                if cells.x * cells.y > 4.0 * MOST {
                    return too_many(cells.x * cells.y);
                }
                let gate = self.open_gate();
                let borders = Borders::new(std::iter::once(ring).chain(holes));
                let is_free = |at: DVec2| {
                    !borders.reach(at, FROM_EDGE)
                        && borders.contain(at)
                        && gate.is_none_or(|gate| gate.distance(at) > FROM_GATE)
                };
                let mut spots = vec![];
                for y in from.y as i64..=to.y as i64 {
                    for x in from.x as i64..=to.x as i64 {
                        let draws = draws.at(x.cast_unsigned()).at(y.cast_unsigned());
                        let [east, north] = ["east", "north"].map(|way| draws.named(way).share());
                        let at = (dvec2(x as f64, y as f64) + dvec2(east, north)) * spacing;
                        if is_free(at) {
                            spots.push((at, draws));
                        }
                    }
                }
                if spots.len() as f64 > MOST {
                    return too_many(spots.len() as f64);
                }
                spots
            }
        })
    }
}

impl LotSite<'_> {
    /// Returns the place of the gate of the feature, if one was built.
    fn open_gate(&self) -> Option<DVec2> {
        let decisions = self.decisions.borrow();
        let has_gate = decisions.iter().any(|d| d.on == PlaceOn::Gate);
        let (at, _) = self.gate().filter(|_| has_gate)?;
        Some(at)
    }

    /// Returns places along lines: on them, or beside them on both sides, where no other street is.
    fn along(&self, ways: &[Vec<DVec2>], wish: &TreeWish, draws: Place) -> Vec<(DVec2, Place)> {
        let others = self.other_streets(ways, 0.0);
        let sides: &[f64] = if wish.offset > 0.0 {
            &[1.0, -1.0]
        } else {
            &[0.0]
        };
        let mut spots = vec![];
        for (number, way) in (0..).zip(ways) {
            let course = lines::Course::new(way);
            let length = course.length();
            let count = (length / wish.spacing).round().max(1.0);
            for n in 0..count as usize {
                let (middle, along) = course.at((n as f64 + 0.5) * length / count);
                for (side, k) in sides.iter().zip(0..) {
                    let at = middle + along.perp() * (side * wish.offset);
                    if *side == 0.0 || !others.reach(at, CLEAR) {
                        spots.push((at, draws.at(number).at(n as u64).at(k)));
                    }
                }
            }
        }
        spots
    }
}

/// Returns the tree of a place. One that is alone is as its rule says; others differ a little.
fn tree(wish: &TreeWish, alone: bool, draws: Place, at: glam::DVec3) -> Tree {
    let kinds = Species::WORDS.map(|(_, species)| species);
    let drawn = (draws.named("species").share() * kinds.len() as f64) as usize;
    let species = wish.species.unwrap_or(kinds[drawn.min(kinds.len() - 1)]);
    let between =
        |name: &str, [least, most]: [f64; 2]| least + draws.named(name).share() * (most - least);
    let given = |name: &str, size: f64| match alone {
        true => size,
        false => size * between(name, [1.0 - UNLIKE, 1.0 + UNLIKE]),
    };
    let (heights, widths) = species.usual();
    let height = match wish.height {
        Some(height) => given("height", height),
        None => between("height", heights),
    };
    let width = match wish.width {
        Some(width) => given("width", width),
        None => height * between("width", widths),
    };
    let turn = TAU * draws.named("turn").share();
    Tree {
        species,
        at,
        height,
        width,
        turn: dvec2(libm::cos(turn), libm::sin(turn)),
    }
}
