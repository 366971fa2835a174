//! A house of several sheets: its storeys over each other, and what its text says of where it comes from.

use super::register::register;
use super::shape::Shape;
use super::text::{self, Era, Head, Level, Written};

/// What is known of a house beside its plans.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Its name.
    pub name: String,
    /// The parts that stand for roles.
    pub era: Era,
    /// Heights of its storeys, shaku; those that are missing go by their number.
    pub heights: Vec<f64>,
    /// Shaku in a unit, if they are not 3.
    pub unit: Option<f64>,
    /// How each upper storey lies over the ground, where that is known: to the right and down, units.
    pub shifts: Vec<Option<(i32, i32)>>,
}

/// Heights of storeys by their number: a hiraya; then storeys of so-nikai and sangai-date (domain 4.2), shaku.
const HEIGHTS: [&[f64]; 3] = [&[10.0], &[9.5, 9.0], &[9.5, 9.0, 8.5]];

impl Wanted {
    /// The heights of so many storeys, shaku.
    pub fn heights(&self, storeys: usize) -> Vec<f64> {
        let usual = HEIGHTS[storeys.clamp(1, HEIGHTS.len()) - 1];
        let usual = usual.iter().chain(std::iter::repeat(&HEIGHTS[2][2]));
        let all = usual
            .enumerate()
            .map(|(k, usual)| self.heights.get(k).unwrap_or(usual));
        all.take(storeys).copied().collect()
    }
}

/// A house as it is written.
#[derive(Clone, Debug)]
pub struct House {
    /// Its text, and what in it is in doubt.
    pub written: Written,
    /// How each storey lies over the ground: to the right and down, units.
    pub shifts: Vec<(i32, i32)>,
}

/// Puts the storeys of a house over each other and writes it; `sheets` says of each storey what it was read from.
pub fn write(shapes: &[&Shape], sheets: &[String], wanted: &Wanted) -> Option<House> {
    let ground = shapes.first()?;
    let given = |k: usize| wanted.shifts.get(k).copied().flatten();
    let shift = |(k, shape): (usize, &&Shape)| match k.checked_sub(1) {
        None => (0, 0),
        Some(upper) => given(upper).unwrap_or_else(|| register(ground, shape)),
    };
    let shifts: Vec<(i32, i32)> = shapes.iter().enumerate().map(shift).collect();
    let heights = wanted.heights(shapes.len());
    let levels: Vec<Level<'_>> = shapes
        .iter()
        .zip(&shifts)
        .zip(&heights)
        .map(|((shape, shift), height)| Level {
            shape,
            shift: *shift,
            height: *height,
        })
        .collect();
    let head = Head {
        name: wanted.name.clone(),
        lines: lines(sheets, &heights, wanted),
        unit: wanted.unit,
    };
    let written = text::write(&levels, &head, wanted.era)?;
    Some(House { written, shifts })
}

/// The lines of the comment at the head: what was read, and what a plan cannot say.
fn lines(sheets: &[String], heights: &[f64], wanted: &Wanted) -> Vec<String> {
    let mut lines = sheets.to_vec();
    let heights: Vec<String> = heights.iter().map(f64::to_string).collect();
    lines.push(String::new());
    lines.push("A plan does not say these; they are usual and may be changed:".to_owned());
    lines.push(format!(
        "  heights of storeys: {} shaku; roof: kirizuma of tiles, 4.5 sun",
        heights.join(", ")
    ));
    lines.extend(
        wanted
            .era
            .lines()
            .into_iter()
            .map(|line| format!("  {line}")),
    );
    lines.push("Walls that were read with doubt are named in a comment before their row: correct the row, then delete the comment.".to_owned());
    lines
}
