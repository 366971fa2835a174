//! Fences, hedges and walls: runs of parts along lines, whole units nearest to their true size (000-74...-76). They are houses of
//! one inner wall, so that their parts, corners and ends are those of every wall.

use super::{Laid, LotSite, segments, told};
use crate::layer::Shape;
use crate::shape::{Segment, azimuth};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SHAKU;
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::ast::{
    CodeText, Fence, House, Item, Loop, Part, Piece, RoofMode, Row, Settings, Storey, Value,
};

/// The unit of a house, metres.
const UNIT: f64 = 3.0 * SHAKU;
/// Units whose ground differs by more stand in steps, metres.
const LEVEL: f64 = 0.25;
/// The shortest line that bears a unit, metres.
const SHORT: f64 = 0.2;

impl LotSite<'_> {
    /// Sets units along the lines of the feature, or round it.
    pub(super) fn fence(&self, wish: &Fence, span: Span) -> Result<Laid, Text> {
        let lines = match &self.lot().shape {
            // Inside is to the left of its ring; of a fence outside is.
            Shape::Area(ring, _) => {
                let mut around: Vec<DVec2> = ring.iter().rev().copied().collect();
                around.extend(around.first().copied());
                let front = self.frontage().filter(|_| wish.gate > 0.0);
                vec![match front {
                    Some(found) => opened(&around, found.front.chord.middle(), wish.gate)?,
                    None => around,
                }]
            }
            _ => self.ways(),
        };
        let (mut houses, mut count, mut length) = (vec![], 0, 0.0);
        for line in &lines {
            let walls: Vec<Segment> = segments(line).filter(|s| s.length() > SHORT).collect();
            let runs = match self.has_ground() {
                true => walls
                    .iter()
                    .flat_map(|wall| self.steps(wish, *wall))
                    .collect(),
                false => vec![(walls, self.lot().z)],
            };
            let last = runs.len().saturating_sub(1);
            for (number, (walls, z)) in runs.into_iter().enumerate() {
                length += walls.iter().map(|wall| wall.length()).sum::<f64>();
                let ends = [number == 0, number == last];
                if let Some((house, units)) = run(wish, &walls, (z, ends), span) {
                    houses.push(house);
                    count += units;
                }
            }
        }
        if houses.is_empty() {
            return Err(text!(
                "a fence needs a line of 0.2 m at least",
                "柵には 0.2 m 以上の線が要ります"
            ));
        }
        let parameters = vec![
            (
                "code".to_owned(),
                Value::Text(wish.code.as_str().trim_end().to_owned()),
            ),
            told("units", f64::from(count)),
            told("length", length),
        ];
        Ok(Laid::new(houses, parameters))
    }

    /// Divides a wall where the ground under it rises or falls, between units; each piece with its lowest ground.
    fn steps(&self, wish: &Fence, wall: Segment) -> Vec<(Vec<Segment>, f64)> {
        let count = units(&wish.code, wall.length());
        let at = |n: u32| wall.from.lerp(wall.to, f64::from(n) / f64::from(count));
        let (mut found, mut from) = (vec![], 0);
        let first = self.height(wall.from);
        let (mut low, mut high) = (first, first);
        for n in 1..=count {
            let height = self.height(at(n));
            let (lower, higher) = (low.min(height), high.max(height));
            if higher - lower > LEVEL && n - from > 1 {
                found.push((vec![Segment::new(at(from), at(n - 1))], low));
                from = n - 1;
                let start = self.height(at(from));
                (low, high) = (start.min(height), start.max(height));
            } else {
                (low, high) = (lower, higher);
            }
        }
        found.push((vec![Segment::new(at(from), wall.to)], low));
        found
    }
}

/// Opens a closed line for a gate, in the middle of its side nearest to a place; returns it from one post of the gate round to
/// the other.
fn opened(around: &[DVec2], near: DVec2, gate: f64) -> Result<Vec<DVec2>, Text> {
    let sides: Vec<Segment> = segments(around).collect();
    let off = |n: &usize| sides[*n].nearest(near).distance(near);
    let front = (0..sides.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
    let side = front.map(|n| sides[n]);
    let (Some(n), Some(side)) = (front, side.filter(|s| s.length() > gate + 2.0 * SHORT)) else {
        return Err(text!([gate]
            "its front leaves no room for a gate of {gate} m",
            "正面に {gate} m の門が収まりません"
        ));
    };
    let reach = gate / 2.0 + SHORT;
    let middle = (near - side.from).dot(side.direction());
    let middle = middle.clamp(reach, side.length() - reach);
    let post = |t: f64| side.from + side.direction() * t;
    let whole = sides.len();
    let corners = (1..=whole).map(|k| sides[(n + k) % whole].from);
    let begin = std::iter::once(post(middle + gate / 2.0));
    Ok(begin
        .chain(corners)
        .chain([post(middle - gate / 2.0)])
        .collect())
}

/// Returns the width of a unit, metres.
pub(super) fn unit(code: &CodeText) -> f64 {
    let width = code.as_str().chars().nth(4).and_then(|c| c.to_digit(10));
    f64::from(width.unwrap_or(1).max(1)) * UNIT
}

/// Returns the whole number of units of a part whose size is nearest to their own on a wall of this length.
fn units(code: &CodeText, length: f64) -> u32 {
    (length / unit(code)).round().max(1.0) as u32
}

/// Returns the row of units on one of the walls that follow each other. `ends` says whether the first and the last of these are
/// those of the line.
fn row(
    wish: &Fence,
    walls: &[Segment],
    (number, [is_first, is_last]): (usize, [bool; 2]),
    span: Span,
) -> Row {
    let wall = walls[number];
    let count = units(&wish.code, wall.length());
    let width = wall.length() / f64::from(count) / UNIT;
    let code = |n: u32| {
        let begins = is_first && number == 0 && n == 0;
        let ends = is_last && number + 1 == walls.len() && n + 1 == count;
        let other = wish.first.as_ref().filter(|_| begins);
        let other = other.or(wish.last.as_ref().filter(|_| ends));
        other.unwrap_or(&wish.code).clone()
    };
    let part = |n: u32| {
        Item::One(Piece::Part(Box::new(Part {
            code: Spanned::new(code(n), wish.span),
            width: Some(Spanned::new(width, wish.span)),
            height: wish.height.map(|height| Spanned::new(height, wish.span)),
        })))
    };
    let turn = walls.get(number + 1).map_or(0.0, |next| {
        let (d, e) = (wall.direction(), next.direction());
        // To the right is positive; no negative zero.
        0.0 - libm::atan2(d.perp_dot(e), d.dot(e)).to_degrees()
    });
    Row {
        span,
        pieces: (0..count).map(part).collect(),
        turn: Some(Spanned::new(turn, span)),
    }
}

/// Returns the house of walls that follow each other, and the number of its units.
fn run(
    wish: &Fence,
    walls: &[Segment],
    (z, ends): (f64, [bool; 2]),
    span: Span,
) -> Option<(House, u32)> {
    let first = walls.first()?;
    let count = walls.iter().map(|wall| units(&wish.code, wall.length()));
    let count = count.sum();
    let rows = (0..walls.len()).map(|number| row(wish, walls, (number, ends), span));
    let rows = rows.map(Item::One).collect();
    let walk = Loop {
        span,
        inner: true,
        rows,
        ..Loop::default()
    };
    let mut house = House {
        span,
        name: Some(Spanned::new(wish.word.to_owned(), span)),
        storeys: vec![Item::One(Storey {
            span,
            height: wish.height.map(|height| Spanned::new(height, wish.span)),
            loops: vec![walk],
            ..Storey::default()
        })],
        ..House::default()
    };
    let at = |value: f64| Some(Spanned::new(value, span));
    house.settings = Settings {
        x: at(first.from.x),
        y: at(first.from.y),
        z: at(z),
        azimuth: at(azimuth(-first.normal())),
        ..Settings::default()
    }
    .into();
    house.roofs.span = Some(span);
    house.roofs.mode = Some(Spanned::new(RoofMode::Explicit, span));
    Some((house, count))
}
