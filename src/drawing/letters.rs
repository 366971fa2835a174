//! Letters as outlines, from the file of a font: a drawing that looks the same wherever it is opened.

use crate::drawing::paper::{Anchor, Label, Shape, Sheet};
use glam::{DVec2, dvec2};
use ttf_parser::{Face, OutlineBuilder};

/// Strokes of a curve.
const STROKES: u32 = 5;

/// A font.
pub struct Font<'d> {
    face: Face<'d>,
}

impl<'d> Font<'d> {
    /// Reads the first font of a file (TTF, OTF, TTC); none if it is no font.
    pub fn read(bytes: &'d [u8]) -> Option<Font<'d>> {
        let face = Face::parse(bytes, 0).ok()?;
        Some(Font { face })
    }

    /// Returns the sheet with outlines instead of texts, and the letters that the font does not have.
    pub fn outlined(&self, sheet: &Sheet) -> (Sheet, Vec<char>) {
        let (mut sheet, mut missing) = (sheet.clone(), vec![]);
        for mark in sheet.views.iter_mut().flat_map(|v| &mut v.marks) {
            if let Shape::Label(label) = &mark.shape {
                mark.shape = Shape::Letters(self.rings(label, &mut missing));
            }
        }
        missing.sort_unstable();
        missing.dedup();
        (sheet, missing)
    }

    /// Returns the outlines of a text, from the start of its line; 1 is the size of the letters.
    pub fn lettering(&self, text: &str) -> Lettering {
        let em = f64::from(self.face.units_per_em()).max(1.0);
        let (pen, along, missing) = self.written(text);
        let scaled = |ring: Vec<DVec2>| ring.into_iter().map(|p| p / em).collect();
        Lettering {
            rings: pen.rings.into_iter().map(scaled).collect(),
            width: along / em,
            missing,
        }
    }

    /// Returns the outlines of a text and its width, in the units of the font, and the letters that it does not have.
    fn written(&self, text: &str) -> (Pen, f64, Vec<char>) {
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
        (pen, along, missing)
    }

    /// Returns the outlines of a label on its sheet.
    fn rings(&self, label: &Label, missing: &mut Vec<char>) -> Vec<Vec<DVec2>> {
        let em = f64::from(self.face.units_per_em()).max(1.0);
        let (pen, along, lacking) = self.written(&label.text);
        missing.extend(lacking);
        let back = match label.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => along / 2.0,
            Anchor::End => along,
        };
        let place = |p: &DVec2| {
            let off = (*p - dvec2(back, 0.0)) * (label.size / em);
            label.at + if label.upward { off.perp() } else { off }
        };
        let place_ring = |ring: &Vec<DVec2>| ring.iter().map(place).collect();
        pen.rings.iter().map(place_ring).collect()
    }
}

/// A text as outlines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lettering {
    /// The rings of its letters.
    pub rings: Vec<Vec<DVec2>>,
    /// Its width.
    pub width: f64,
    /// The letters that the font does not have.
    pub missing: Vec<char>,
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
