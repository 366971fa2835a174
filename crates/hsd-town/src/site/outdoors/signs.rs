//! Signs (000-70): a board on a post, with the name of the place on both sides, in the letters of the town's font or our own.

use super::signals::nearest_way;
use super::solids::{Faces, case, column};
use super::{Laid, LotSite};
use crate::layer::Shape;
use crate::shape::{contains, sides};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::area2;
use hsd_base::geometry::triangulate::triangles;
use hsd_base::lettering::{Font, Lettering, lettering};
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::street::{Board, Sign};
use hsd_ir::ast::{Sheet, Value};

/// How far a board reaches beyond its letters, as a share of their size, and how thick it is, metres.
const MARGIN: f64 = 0.35;
const THICK: f64 = 0.03;
/// How far letters stand before the board, metres.
const BEFORE: f64 = 0.003;
/// How far letters reach below the line that they stand on, as a share of their size.
const BELOW: f64 = 0.15;
/// The most letters of a sign.
const MOST: usize = 60;

impl LotSite<'_> {
    /// Sets up a sign.
    pub(super) fn sign(&self, wish: &Sign, span: Span) -> Result<Laid, Text> {
        let Shape::Point(at) = self.lot().shape else {
            return Err(text!("a sign needs a point", "標識には点が要ります"));
        };
        let name = wish.text.trim();
        if name.is_empty() || name.chars().count() > MOST {
            let most = MOST;
            return Err(text!([most]
                "a sign needs a text of {most} letters at most",
                "標識には {most} 字までの文字が要ります"
            ));
        }
        let font = self.plan.font.as_deref().and_then(Font::read);
        let lettering = match &font {
            Some(font) => font.lettering(name),
            None => lettering(name),
        };
        if let (None, Some(letter)) = (&font, lettering.missing.first()) {
            return Err(text!([letter]
                "there is no letter of our own for \"{letter}\": name the file of a font in `<Town font=\"...\">`",
                "「{letter}」の字形がありません。`<Town font=\"...\">` にフォントのファイルを書いてください"
            ));
        }
        let mut parameters = vec![("text".to_owned(), Value::Text(name.to_owned()))];
        if !lettering.missing.is_empty() {
            let missing: String = lettering.missing.iter().collect();
            parameters.push(("missing".to_owned(), Value::Text(missing)));
        }
        let sheets = self.board(wish, &lettering, at);
        Ok(Laid::new(
            vec![self.open(span, "sign", sheets, vec![])],
            parameters,
        ))
    }

    /// Builds a sign: its post, its board, the letters on both sides.
    fn board(&self, wish: &Sign, lettering: &Lettering, at: DVec2) -> Vec<Sheet> {
        let facing = match wish.facing {
            Some(degrees) => {
                let angle = degrees.to_radians();
                dvec2(libm::sin(angle), libm::cos(angle))
            }
            None => nearest_way(&self.street_pieces(), at).unwrap_or(DVec2::Y),
        };
        let (size, width) = (wish.size, lettering.width / lettering.size);
        let half = [width * size / 2.0 + MARGIN * size, size * (0.5 + MARGIN)];
        let base = self.base();
        let foot = (at - base).extend(self.height(at));
        let middle = foot + DVec3::Z * (wish.height + half[1]);
        let right = facing.perp();
        let post = column(foot, wish.height + 2.0 * half[1], [0.035, 0.035], 6);
        let off = facing * (THICK / 2.0 + 0.035);
        let level = [middle.z - half[1], middle.z + half[1]];
        let board = case(
            middle.truncate() + off,
            right,
            [half[0], THICK / 2.0],
            level,
        );
        let mut letters: Faces = vec![];
        let shapes = shapes(lettering);
        for (way, out) in [(right, facing), (-right, -facing)] {
            let depth = off + out * (THICK / 2.0 + BEFORE);
            let place = |p: &DVec2| {
                let p = (*p / lettering.size - dvec2(width / 2.0, 0.5 - BELOW)) * size;
                middle + (depth + way * p.x).extend(p.y)
            };
            letters.extend(shapes.iter().map(|face| face.iter().map(place).collect()));
        }
        let (ground, ink) = match wish.board {
            Board::Blue => ("sign_blue", "road_paint"),
            Board::White => ("road_paint", "iron"),
            Board::Wood => ("cedar_brown", "iron"),
        };
        vec![
            self.sheet("sheet", 1, post),
            self.sheet(ground, 1, board),
            self.sheet(ink, 2, letters),
        ]
    }
}

/// Returns the letters as triangles. A ring in an odd number of others is a hole of the smallest of them.
fn shapes(lettering: &Lettering) -> Vec<[DVec2; 3]> {
    let rings: Vec<Vec<DVec2>> = lettering
        .rings
        .iter()
        .filter(|ring| ring.len() > 2)
        .cloned()
        .collect();
    // Strokes of a letter may cross: a ring in another has all of its sides there.
    let lies_in = |n: usize, other: usize| {
        let mut places = sides(&rings[n]).flat_map(|side| [side.from, side.middle()]);
        places.all(|p| contains(&rings[other], p))
    };
    let around = |n: usize| -> Vec<usize> {
        let others = (0..rings.len()).filter(|other| *other != n);
        others.filter(|other| lies_in(n, *other)).collect()
    };
    let around: Vec<Vec<usize>> = (0..rings.len()).map(around).collect();
    let turned = |n: usize, left: bool| {
        let mut ring = rings[n].clone();
        if (area2(&ring) > 0.0) != left {
            ring.reverse();
        }
        ring
    };
    let mut found = vec![];
    for n in (0..rings.len()).filter(|n| around[*n].len().is_multiple_of(2)) {
        let is_hole =
            |m: &usize| around[*m].len() == around[n].len() + 1 && around[*m].contains(&n);
        let holes: Vec<Vec<DVec2>> = (0..rings.len())
            .filter(is_hole)
            .map(|m| turned(m, false))
            .collect();
        found.extend(triangles(&turned(n, true), &holes));
    }
    found
}
