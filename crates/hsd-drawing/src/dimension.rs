//! Dimensions: chains of lengths beside a view, in the measure of its builders and in metres.

use crate::paper::{Anchor, Label, Mark, Role, Shape};
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Language;
use hsd_base::geometry::SHAKU;

/// The height of figures, millimetres.
pub(super) const FIGURES: f64 = 2.0;

/// The distance of chains, millimetres.
pub(super) const APART: f64 = 8.0;

/// Half the length of the strokes at the ends of a length, and how far its line goes beyond them.
const TICK: f64 = 0.8;

/// The measure of a chain.
#[derive(Clone, Copy, Debug)]
pub(super) enum Measure {
    /// In ken of so many metres, for plans.
    Ken(f64),
    /// In shaku, for heights.
    Shaku,
}

impl Measure {
    /// Returns a length of so many metres as it is written.
    fn words(self, metres: f64, language: Language) -> String {
        let (value, word) = match (self, language) {
            (Measure::Ken(ken), Language::English) => (metres / ken, " ken"),
            (Measure::Ken(ken), Language::Japanese) => (metres / ken, "間"),
            (Measure::Shaku, Language::English) => (metres / SHAKU, " shaku"),
            (Measure::Shaku, Language::Japanese) => (metres / SHAKU, "尺"),
        };
        format!("{}{word}", short(value, 2))
    }
}

/// Writes a number with at most so many decimals, without zeros at its end.
pub(super) fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    match text {
        "-0" => "0".to_owned(),
        _ => text.to_owned(),
    }
}

/// A line beside a view along which lengths stand.
#[derive(Clone, Copy, Debug)]
pub(super) enum Line {
    /// Level, at this height on paper; lines lead to it from above, from this height on.
    Below { at: f64, from: f64 },
    /// Upright, at this place on paper; lines lead to it from the left, from this place on.
    Right { at: f64, from: f64 },
    /// Upright; lines lead to it from the right.
    Left { at: f64, from: f64 },
}

impl Line {
    fn point(self, along: f64) -> DVec2 {
        match self {
            Line::Below { at, .. } => dvec2(along, at),
            Line::Right { at, .. } | Line::Left { at, .. } => dvec2(at, along),
        }
    }

    /// The line that leads to it, with a gap at the view.
    fn leader(self, along: f64) -> [DVec2; 2] {
        match self {
            Line::Below { at, from } => [dvec2(along, from - 1.0), dvec2(along, at - TICK)],
            Line::Right { at, from } => [dvec2(from + 1.0, along), dvec2(at + TICK, along)],
            Line::Left { at, from } => [dvec2(from - 1.0, along), dvec2(at - TICK, along)],
        }
    }
}

/// Adds a chain of lengths between places along a line, millimetres on paper at `scale` millimetres to a metre.
pub(super) fn chain(
    places: &[f64],
    line: Line,
    measure: Measure,
    (scale, language): (f64, Language),
    marks: &mut Vec<Mark>,
) {
    let (Some(first), Some(last)) = (places.first(), places.last()) else {
        return;
    };
    let mut lines = vec![[line.point(*first), line.point(*last)]];
    for &place in places {
        let at = line.point(place);
        lines.push(line.leader(place));
        lines.push([at - TICK, at + TICK]);
    }
    marks.push(Mark::new(Role::Dimension, Shape::Lines(lines)));
    for pair in places.windows(2) {
        let (middle, length) = ((pair[0] + pair[1]) / 2.0, pair[1] - pair[0]);
        let metres = length / scale;
        let texts = [measure.words(metres, language), short(metres, 3)];
        for (text, side) in texts.into_iter().zip([0.6, -0.6 - FIGURES]) {
            // A length that has no room says so in the chain of the whole.
            if crate::paper::width(&text) * FIGURES > length.max(FIGURES * 2.0) {
                continue;
            }
            let upward = !matches!(line, Line::Below { .. });
            let at = match upward {
                false => line.point(middle) + dvec2(0.0, side),
                true => line.point(middle) - dvec2(side, 0.0),
            };
            marks.push(Mark::new(
                Role::Dimension,
                Shape::Label(Label {
                    at,
                    text,
                    size: FIGURES,
                    anchor: Anchor::Middle,
                    upward,
                }),
            ));
        }
    }
}

/// Returns places in order, each once.
pub(super) fn places(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < 0.05);
    values
}
