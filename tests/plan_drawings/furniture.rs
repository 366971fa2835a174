//! Symbols of what stands in rooms, and of what lies round a surveyed house.

use super::rng::Rng;
use super::sheet::{Ink, Place, Role, Shape, Sheet};
use super::truth::{Area, Fixture, Furnishing, Plan};
use super::writing::{Script, figure, write};

/// The corners of an area on the sheet, drawn in by `inset`.
pub fn rectangle(sheet: &Sheet, area: &Area, inset: f32) -> Vec<Place> {
    let low = (area.from.0 as f32 + inset, area.from.1 as f32 + inset);
    let high = (area.to.0 as f32 - inset, area.to.1 as f32 - inset);
    [low, (high.0, low.1), high, (low.0, high.1)]
        .map(|p| sheet.near(p))
        .to_vec()
}

/// Draw one thing.
pub fn fixture_symbol(sheet: &mut Sheet, fixture: &Fixture, ink: Ink, thin: f32, rng: &mut Rng) {
    let area = fixture.area;
    let middle = sheet.near(area.middle());
    let outline = rectangle(sheet, &area, 0.0);
    let short = area.width().min(area.depth()) as f32;
    let mut put = |shape: Shape| sheet.put(Role::Fixture, ink, thin, shape);
    match fixture.what {
        Furnishing::Stairs => stairs(sheet, &area, ink, thin, rng),
        Furnishing::Alcove => put(Shape::Loop(outline)),
        Furnishing::Closet | Furnishing::Privy => {
            put(Shape::Line(vec![outline[0], outline[2]]));
            if fixture.what == Furnishing::Closet && rng.chance(0.5) {
                put(Shape::Line(vec![outline[1], outline[3]]));
            }
            put(Shape::Loop(outline));
        }
        Furnishing::Stove => {
            let inner = rectangle(sheet, &area, 0.12);
            sheet.put(Role::Fixture, ink, thin, Shape::Loop(inner));
            let (w, d) = (area.width() as f32, area.depth() as f32);
            let holes = rng.whole(2, 3);
            for k in 0..holes {
                let t = (k as f32 + 0.5) / holes as f32;
                let p = (
                    area.from.0 as f32 + if w > d { w * t } else { w / 2.0 },
                    area.from.1 as f32 + if w > d { d / 2.0 } else { d * t },
                );
                let p = sheet.near(p);
                sheet.put(Role::Fixture, ink, thin, Shape::Ring(p, short * 0.22));
            }
        }
        Furnishing::Well => {
            put(Shape::Ring(middle, short * 0.38));
            put(Shape::Ring(middle, short * 0.3));
        }
        Furnishing::Hearth => {
            put(Shape::Loop(outline));
            let inner = rectangle(sheet, &area, 0.14);
            sheet.put(Role::Fixture, ink, thin, Shape::Loop(inner));
        }
    }
}

/// Parallel treads and an arrow along the flight.
fn stairs(sheet: &mut Sheet, area: &Area, ink: Ink, thin: f32, rng: &mut Rng) {
    let along_a = area.width() > area.depth();
    let place = |along: f32, across: f32| {
        let (a, b) = if along_a {
            (along, across)
        } else {
            (across, along)
        };
        (area.from.0 as f32 + a, area.from.1 as f32 + b)
    };
    let (length, wide) = (
        area.width().max(area.depth()) as f32,
        area.width().min(area.depth()) as f32,
    );
    let treads = rng.whole(7, 11);
    for k in 0..=treads {
        let t = length * k as f32 / treads as f32;
        let (p, q) = (sheet.near(place(t, 0.0)), sheet.near(place(t, wide)));
        sheet.line(Role::Fixture, ink, thin, p, q);
    }
    let (start, end) = if rng.chance(0.5) {
        (0.2, length - 0.2)
    } else {
        (length - 0.2, 0.2)
    };
    let head = (end - start).signum() * 0.22;
    let arrow = [
        place(end - head, wide / 2.0 - 0.13),
        place(end, wide / 2.0),
        place(end - head, wide / 2.0 + 0.13),
    ]
    .map(|p| sheet.near(p));
    let (p, q) = (
        sheet.near(place(start, wide / 2.0)),
        sheet.near(place(end, wide / 2.0)),
    );
    sheet.line(Role::Fixture, ink, thin, p, q);
    sheet.put(Role::Fixture, ink, thin, Shape::Line(arrow.to_vec()));
}

/// Chains of dimensions with ticks and figures on some sides.
pub fn dimensions(sheet: &mut Sheet, plan: &Plan, ink: Ink, thin: f32, chains: i32, rng: &mut Rng) {
    let script = Script {
        ink,
        size: rng.between(0.22, 0.34),
        weight: 0.08,
        turn: 0,
        vertical: false,
    };
    let slash = rng.chance(0.5);
    let sides = rng.whole(2, 4);
    for side in 0..sides {
        for chain in 0..chains {
            let off = 1.0 + chain as f32 * 0.7;
            let n = if side % 2 == 0 {
                plan.width
            } else {
                plan.depth
            };
            let place = |t: f32, off: f32| match side {
                0 => (t, -off),
                1 => (plan.width as f32 + off, t),
                2 => (t, plan.depth as f32 + off),
                _ => (-off, t),
            };
            let (p, q) = (
                sheet.near(place(-0.2, off)),
                sheet.near(place(n as f32 + 0.2, off)),
            );
            sheet.line(Role::Dimension, ink, thin, p, q);
            let mut at = 0;
            while at <= n {
                let (lean, half) = if slash { (0.1, 0.1) } else { (0.0, 0.13) };
                let (p, q) = (
                    sheet.near(place(at as f32 - lean, off - half)),
                    sheet.near(place(at as f32 + lean, off + half)),
                );
                sheet.line(Role::Dimension, ink, thin, p, q);
                let step = if chain + 1 == chains {
                    n
                } else {
                    rng.whole(1, 4)
                }
                .min((n - at).max(1));
                if at < n {
                    let middle = sheet.near(place(at as f32 + step as f32 / 2.0, off + 0.28));
                    figure(
                        sheet,
                        &Script {
                            turn: if side % 2 == 1 { 1 } else { 0 },
                            ..script
                        },
                        middle,
                        rng,
                    );
                }
                at += step;
            }
        }
    }
}

/// Title, north arrow, scale bar, trees and stones, the edge of the plot.
pub fn surroundings(sheet: &mut Sheet, ink: Ink, thin: f32, site: bool, rng: &mut Rng) {
    let (w, h) = sheet.size;
    let script = Script {
        ink,
        size: rng.between(0.35, 0.6),
        weight: 0.09,
        turn: 0,
        vertical: false,
    };
    let title = (w * rng.between(0.25, 0.6), h - 0.45);
    write(sheet, &script, title, rng.whole(3, 9), Role::Margin, rng);
    let c = (w - 0.75, rng.between(0.75, 1.1));
    sheet.put(Role::Margin, ink, thin, Shape::Ring(c, 0.42));
    let turn = rng.between(0.0, std::f32::consts::TAU);
    let needle = |angle: f32, r: f32| (c.0 + r * angle.sin(), c.1 - r * angle.cos());
    sheet.put(
        Role::Margin,
        ink,
        0.0,
        Shape::Fill(vec![
            needle(turn, 0.6),
            needle(turn + 2.7, 0.4),
            needle(turn - 2.7, 0.4),
        ]),
    );
    for k in 0..4 {
        let x = 0.5 + k as f32 * 0.6;
        let bar = vec![
            (x, h - 0.35),
            (x + 0.6, h - 0.35),
            (x + 0.6, h - 0.25),
            (x, h - 0.25),
        ];
        sheet.put(
            Role::Margin,
            ink,
            thin,
            if k % 2 == 0 {
                Shape::Fill(bar)
            } else {
                Shape::Loop(bar)
            },
        );
    }
    if !site {
        return;
    }
    let edge = [
        ((0.25, 0.25), (w - 0.25, 0.25)),
        ((0.25, 0.25), (0.25, h - 0.7)),
        ((w - 0.25, 0.25), (w - 0.25, h - 0.7)),
    ];
    for ends in edge.into_iter().take(rng.whole(0, 3) as usize) {
        sheet.dashes(Role::Margin, ink, thin * 1.3, ends, 0.35);
    }
    for _ in 0..rng.whole(2, 8) {
        let (x, y) = if rng.chance(0.5) {
            (rng.between(0.3, w - 0.3), 0.6)
        } else {
            (0.6, rng.between(0.5, h - 1.0))
        };
        let r = rng.between(0.12, 0.34);
        let points = (0..9).map(|k| {
            let turn = k as f32 * 0.698;
            let r = r * rng.between(0.7, 1.2);
            (x + r * turn.cos(), y + r * turn.sin())
        });
        let points = points.collect();
        sheet.put(Role::Margin, ink, thin, Shape::Loop(points));
    }
}
