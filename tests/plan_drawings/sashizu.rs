//! Edo sashizu: a faint grid, black walls, red screens, dots for posts, slips of coloured paper, names to be read from
//! all sides, folds.

use super::furniture::{fixture_symbol, rectangle};
use super::rng::Rng;
use super::sheet::{Frame, Ink, Role, Shape, Sheet, Variant};
use super::truth::{Floor, Kind, Plan, Run};
use super::writing::{Script, write};

const BLACK: Ink = [28, 24, 24];

/// Habits of a draughtsman.
struct Style {
    wall: f32,
    post: f32,
    thin: f32,
    red: Ink,
    /// Screens: 0 one red line, 1 two red lines, 2 two black lines.
    screens: i32,
    grid: Option<(Ink, i32)>,
    slips: bool,
    tints: [Ink; 4],
    ticks: i32,
    mats: bool,
    signs: f32,
}

impl Style {
    fn new(variant: Variant, rng: &mut Rng) -> Self {
        let mut tint = |base: Ink| {
            base.map(|c| (f32::from(c) + rng.between(-14.0, 12.0)).clamp(0.0, 255.0) as u8)
        };
        let tints = [
            tint([244, 226, 160]),
            tint([226, 206, 172]),
            tint([190, 204, 214]),
            tint([206, 218, 184]),
        ];
        let scored = [236, 228, 214];
        let grids = [
            None,
            Some(([232, 180, 168], 1)),
            Some((scored, 1)),
            Some((scored, 2)),
            Some(([214, 150, 140], 1)),
        ];
        Self {
            wall: if variant.unseen {
                rng.between(0.06, 0.3)
            } else {
                rng.between(0.1, 0.2)
            },
            post: if variant.unseen {
                rng.between(0.0, 0.2)
            } else {
                rng.between(0.1, 0.16)
            },
            thin: rng.between(0.022, 0.045),
            red: [
                rng.whole(170, 215) as u8,
                rng.whole(40, 80) as u8,
                rng.whole(35, 70) as u8,
            ],
            screens: if variant.unseen {
                rng.whole(0, 3)
            } else {
                rng.whole(0, 2)
            },
            grid: rng.pick(&grids),
            slips: rng.chance(0.7),
            tints,
            ticks: rng.whole(3, 6),
            mats: rng.chance(0.3),
            signs: rng.between(0.34, 0.55),
        }
    }
}

/// Draw the plan.
pub fn sheet(plan: &Plan, variant: Variant) -> Sheet {
    let mut rng = Rng::new(variant.seed, 12);
    let style = Style::new(variant, &mut rng);
    let margins = [0; 4].map(|_| rng.between(1.8, 3.6));
    let mut sheet = Sheet::new(plan, margins);
    if let Some((ink, step)) = style.grid {
        grid(&mut sheet, plan, ink, step);
    }
    sheet.by_hand(if variant.unseen { 0.035 } else { 0.018 }, &mut rng);
    slips(&mut sheet, plan, &style, &mut rng);
    for fixture in &plan.fixtures {
        fixture_symbol(&mut sheet, fixture, BLACK, style.thin, &mut rng);
    }
    for run in plan.runs() {
        stroke(&mut sheet, &run, &style, &mut rng);
    }
    for &post in &plan.posts {
        let c = sheet.at(post);
        sheet.put(Role::Post, BLACK, 0.0, Shape::Disc(c, style.post));
    }
    names(&mut sheet, plan, &style, &mut rng);
    if rng.chance(0.4) {
        worms(&mut sheet, &mut rng);
    }
    sheet
}

/// Bookworms ate winding holes through ink and paper; a light backing shows.
fn worms(sheet: &mut Sheet, rng: &mut Rng) {
    let (w, h) = sheet.size;
    for _ in 0..rng.whole(2, 14) {
        let mut at = (rng.unit() * w, rng.unit() * h);
        let mut turn = rng.between(0.0, std::f32::consts::TAU);
        let mut way = vec![at];
        for _ in 0..rng.whole(1, 9) {
            turn += rng.between(-0.9, 0.9);
            at = (at.0 + 0.12 * turn.cos(), at.1 + 0.12 * turn.sin());
            way.push(at);
        }
        sheet.put(
            Role::Margin,
            [250, 250, 252],
            rng.between(0.03, 0.08),
            Shape::Line(way),
        );
    }
}

/// The grid runs over the whole sheet, not only under the house.
fn grid(sheet: &mut Sheet, plan: &Plan, ink: Ink, step: i32) {
    let (w, h) = sheet.size;
    for a in (-4..=plan.width + 4).filter(|a| a.rem_euclid(step) == 0) {
        let x = sheet.at((a, 0)).0;
        sheet.line(Role::Grid, ink, 0.015, (x, 0.0), (x, h));
    }
    for b in (-4..=plan.depth + 4).filter(|b| b.rem_euclid(step) == 0) {
        let y = sheet.at((0, b)).1;
        sheet.line(Role::Grid, ink, 0.015, (0.0, y), (w, y));
    }
}

/// Slips of paper by floor, pasted a little off, and thin mats.
fn slips(sheet: &mut Sheet, plan: &Plan, style: &Style, rng: &mut Rng) {
    for room in &plan.rooms {
        let tint = match room.floor {
            Floor::Tatami => style.tints[0],
            Floor::Board => style.tints[1],
            Floor::Earth => style.tints[2],
            Floor::Veranda => style.tints[3],
        };
        if style.slips && rng.chance(0.85) {
            let outline = rectangle(sheet, &room.area, rng.between(-0.02, 0.06));
            sheet.put(Role::Floor, tint, 0.0, Shape::Fill(outline.clone()));
            let edge = tint.map(|c| c.saturating_sub(26));
            sheet.put(Role::Floor, edge, 0.02, Shape::Loop(outline));
        }
        if style.mats {
            for mat in &room.mats {
                let outline = rectangle(sheet, mat, 0.02);
                sheet.put(Role::Mat, [150, 130, 120], 0.016, Shape::Loop(outline));
            }
        }
    }
}

fn stroke(sheet: &mut Sheet, run: &Run, style: &Style, rng: &mut Rng) {
    let frame = sheet.frame(run, !run.outer && rng.chance(0.5));
    let length = run.length as f32;
    let line = |x0: f32, x1: f32, y: f32| Shape::Line(vec![(x0, y), (x1, y)]);
    let thin = style.thin;
    match run.kind {
        Kind::Wall => {
            let half = style.wall / 2.0;
            sheet.brush(
                Role::Wall,
                BLACK,
                style.wall * rng.between(0.85, 1.15),
                frame.to((-half, 0.0)),
                frame.to((length + half, 0.0)),
            );
        }
        Kind::Open => {}
        Kind::Slide => screens(sheet, &frame, run, style),
        Kind::Hinged => {
            let lean = rng.between(0.5, 1.0);
            let ink = if run.outer { style.red } else { BLACK };
            let leaf = Shape::Line(vec![
                (0.0, 0.0),
                (length * 0.9 * lean.cos(), length * 0.9 * lean.sin()),
            ]);
            sheet.symbol(&frame, Role::Door, ink, thin * 1.2, &[leaf]);
        }
        Kind::Window => {
            let half = 0.09;
            let faces = [
                line(0.05, length - 0.05, -half),
                line(0.05, length - 0.05, half),
            ];
            sheet.symbol(&frame, Role::Window, BLACK, thin, &faces);
            sheet.symbol(
                &frame,
                Role::Window,
                if style.screens == 2 { BLACK } else { style.red },
                thin,
                &[line(0.05, length - 0.05, 0.0)],
            );
        }
        Kind::Lattice => {
            sheet.symbol(&frame, Role::Window, BLACK, thin, &[line(0.0, length, 0.0)]);
            for k in 1..run.length * style.ticks {
                let x = k as f32 / style.ticks as f32;
                sheet.symbol(
                    &frame,
                    Role::Window,
                    BLACK,
                    thin,
                    &[Shape::Line(vec![(x, -0.13), (x, 0.13)])],
                );
            }
        }
    }
}

/// Screens are lines over the whole opening; the joints of the leaves are ticked by some.
fn screens(sheet: &mut Sheet, frame: &Frame, run: &Run, style: &Style) {
    let length = run.length as f32;
    let line = |y: f32| Shape::Line(vec![(0.04, y), (length - 0.04, y)]);
    let (ink, lines) = match style.screens {
        0 => (style.red, vec![line(0.0)]),
        1 => (style.red, vec![line(-0.06), line(0.06)]),
        2 => (
            if run.outer { style.red } else { BLACK },
            vec![line(-0.06), line(0.06)],
        ),
        _ => (style.red, vec![line(-0.09), line(0.0), line(0.09)]),
    };
    sheet.symbol(
        frame,
        Role::Door,
        ink,
        style.thin * if style.screens == 0 { 1.7 } else { 1.0 },
        &lines,
    );
}

/// Names are written towards the reader who sits in the room: any quarter turn, two to four signs in a column, and
/// the number of mats beside.
fn names(sheet: &mut Sheet, plan: &Plan, style: &Style, rng: &mut Rng) {
    for room in plan
        .rooms
        .iter()
        .filter(|room| room.area.width() * room.area.depth() >= 3)
    {
        let turn = rng.pick(&[0, 0, 0, 1, 2, 3]);
        let size = style.signs * rng.between(0.85, 1.2);
        let script = Script {
            ink: BLACK,
            size,
            weight: 0.11,
            turn,
            vertical: true,
        };
        let space = if turn % 2 == 0 {
            room.area.depth()
        } else {
            room.area.width()
        };
        let count = rng
            .whole(2, 5)
            .min((space as f32 / size / 1.3) as i32)
            .max(1);
        let (a, b) = room.area.middle();
        let middle = sheet.near((a + rng.between(-0.2, 0.2), b + rng.between(-0.2, 0.2)));
        write(sheet, &script, middle, count, Role::Text, rng);
    }
    let (w, h) = sheet.size;
    let script = Script {
        ink: BLACK,
        size: 0.7,
        weight: 0.12,
        turn: 0,
        vertical: true,
    };
    write(
        sheet,
        &script,
        (w - 0.7, h * 0.4),
        rng.whole(4, 8),
        Role::Margin,
        rng,
    );
    if rng.chance(0.5) {
        let seal = vec![
            (0.4, h - 1.3),
            (1.2, h - 1.3),
            (1.2, h - 0.5),
            (0.4, h - 0.5),
        ];
        sheet.put(Role::Margin, style.red, 0.05, Shape::Loop(seal));
        let script = Script {
            ink: style.red,
            size: 0.6,
            ..script
        };
        write(sheet, &script, (0.8, h - 0.9), 1, Role::Margin, rng);
    }
}
