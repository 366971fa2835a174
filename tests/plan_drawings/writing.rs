//! Writing that nobody can read: clusters of short brush strokes in square boxes, and figures for dimensions.

use super::rng::Rng;
use super::sheet::{Ink, Place, Role, Shape, Sheet};

/// How writing is set: its ink, its size in units, how fat the brush is, quarter turns.
#[derive(Clone, Copy, Debug)]
pub struct Script {
    /// The ink.
    pub ink: Ink,
    /// The side of a sign in units.
    pub size: f32,
    /// Width of its strokes, as a share of its size.
    pub weight: f32,
    /// Quarter turns clockwise.
    pub turn: i32,
    /// Signs run downwards.
    pub vertical: bool,
}

/// Write `count` signs round a middle.
pub fn write(
    sheet: &mut Sheet,
    script: &Script,
    middle: Place,
    count: i32,
    role: Role,
    rng: &mut Rng,
) {
    for k in 0..count {
        let step = (k as f32 - (count - 1) as f32 / 2.0) * 1.12;
        let offset = if script.vertical {
            (0.0, step)
        } else {
            (step, 0.0)
        };
        for stroke in sign(rng) {
            let stroke = stroke.map(|p| turned((p.0 + offset.0, p.1 + offset.1), script, middle));
            let width = script.size * script.weight * rng.between(0.7, 1.3);
            sheet.put(role, script.ink, width, Shape::Line(stroke.to_vec()));
        }
    }
}

fn turned(p: Place, script: &Script, middle: Place) -> Place {
    let (mut x, mut y) = (p.0 * script.size, p.1 * script.size);
    for _ in 0..script.turn.rem_euclid(4) {
        (x, y) = (-y, x);
    }
    (middle.0 + x, middle.1 + y)
}

/// The strokes of one sign in a box of side 1 round (0, 0): mostly level and upright ones, a few slanting.
fn sign(rng: &mut Rng) -> Vec<[Place; 2]> {
    let mut strokes = Vec::new();
    let level = rng.whole(1, 4);
    for k in 0..level {
        let y = (k as f32 + 0.5) / level as f32 * 0.84 - 0.42 + rng.between(-0.05, 0.05);
        let half = rng.between(0.18, 0.44);
        let x = rng.between(-0.06, 0.06);
        strokes.push([(x - half, y + 0.03), (x + half, y - 0.03)]);
    }
    let upright = rng.whole(1, 3);
    for k in 0..upright {
        let x = (k as f32 + 0.5) / upright as f32 * 0.7 - 0.35 + rng.between(-0.08, 0.08);
        let top = rng.between(-0.45, -0.1);
        strokes.push([
            (x, top),
            (x + rng.between(-0.03, 0.03), top + rng.between(0.35, 0.55)),
        ]);
    }
    for _ in 0..rng.whole(0, 3) {
        let (x, y) = (rng.between(-0.15, 0.15), rng.between(-0.2, 0.2));
        let side = if rng.chance(0.5) { 1.0 } else { -1.0 };
        strokes.push([
            (x, y),
            (x + side * rng.between(0.1, 0.3), y + rng.between(0.1, 0.28)),
        ]);
    }
    strokes
}

/// Write a figure of a dimension: narrow signs of two or three strokes.
pub fn figure(sheet: &mut Sheet, script: &Script, middle: Place, rng: &mut Rng) {
    let count = rng.whole(1, 5);
    for k in 0..count {
        let x = (k as f32 - (count - 1) as f32 / 2.0) * 0.62;
        let half = rng.between(0.1, 0.2);
        let mut at = (x + rng.between(-half, half), -0.42);
        let mut line = vec![turned(at, script, middle)];
        for step in 1..=rng.whole(1, 4) {
            at = (
                x + if step % 2 == 0 { -half } else { half } * rng.between(0.4, 1.0),
                (at.1 + rng.between(0.1, 0.5)).min(0.42),
            );
            line.push(turned(at, script, middle));
        }
        line.push(turned((x + rng.between(-half, half), 0.42), script, middle));
        sheet.put(
            Role::Dimension,
            script.ink,
            script.size * script.weight,
            Shape::Line(line),
        );
    }
}
