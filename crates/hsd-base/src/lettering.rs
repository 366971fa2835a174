//! Letters as outlines, from the file of a font, or of our own where there is none: what is written looks the same wherever it
//! is shown.

mod strokes;

pub use strokes::lettering;

use glam::{DVec2, dvec2};
use ttf_parser::{Face, OutlineBuilder};

/// Strokes of a curve.
const STROKES: u32 = 5;

/// A font.
pub struct Font<'d> {
    face: Face<'d>,
}

/// A text as outlines, from the start of its line, in the units of its font.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lettering {
    /// The rings of its letters.
    pub rings: Vec<Vec<DVec2>>,
    /// Its width.
    pub width: f64,
    /// The size of the letters.
    pub size: f64,
    /// The letters that the font does not have.
    pub missing: Vec<char>,
}

impl<'d> Font<'d> {
    /// Reads the first font of a file (TTF, OTF, TTC); none if it is no font.
    pub fn read(bytes: &'d [u8]) -> Option<Font<'d>> {
        let face = Face::parse(bytes, 0).ok()?;
        Some(Font { face })
    }

    /// Returns the outlines of a text.
    pub fn lettering(&self, text: &str) -> Lettering {
        let (mut pen, mut along, mut missing) = (Pen::default(), 0.0, vec![]);
        for letter in text.chars() {
            let Some(glyph) = self.face.glyph_index(letter) else {
                missing.push(letter);
                continue;
            };
            pen.origin = dvec2(along, 0.0);
            self.face.outline_glyph(glyph, &mut pen);
            along += f64::from(self.face.glyph_hor_advance(glyph).unwrap_or_default());
        }
        Lettering {
            rings: pen.rings,
            width: along,
            size: f64::from(self.face.units_per_em()).max(1.0),
            missing,
        }
    }
}

/// Collects outlines as straight strokes.
#[derive(Default)]
struct Pen {
    origin: DVec2,
    rings: Vec<Vec<DVec2>>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> DVec2 {
        self.origin + dvec2(f64::from(x), f64::from(y))
    }

    fn last(&self) -> DVec2 {
        let ring = self.rings.last();
        ring.and_then(|r| r.last()).copied().unwrap_or(self.origin)
    }

    fn add(&mut self, p: DVec2) {
        if let Some(ring) = self.rings.last_mut() {
            ring.push(p);
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.rings.push(vec![self.at(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add(self.at(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.last(), self.at(x1, y1), self.at(x, y));
        for k in 1..=STROKES {
            let t = f64::from(k) / f64::from(STROKES);
            self.add(a.lerp(b, t).lerp(b.lerp(c, t), t));
        }
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.last(), self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        for k in 1..=STROKES {
            let t = f64::from(k) / f64::from(STROKES);
            let (p, q, r) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
            self.add(p.lerp(q, t).lerp(q.lerp(r, t), t));
        }
    }

    fn close(&mut self) {}
}
